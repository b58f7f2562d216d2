/* test_ratio.c - exact ratios, compared with GMP's. */
#include "exact_fixture/rational.h"
#include "exact_fixture/sheet.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { ROUNDS = 50000, BITS = 125, LERP_BITS = 42 };

/* A whole number below 2^bits, often at the end of its range. */
static int128 below(uint64_t *r, int bits) {
  uint128 wide = ((uint128)exact_random(r) << 64) | exact_random(r);
  uint128 limit = (uint128)1 << bits;
  switch (exact_random_below(r, 8)) {
  case 0:
    return (int128)(limit - 1);
  case 1:
    return (int128)((limit - 1) & ~(wide & 3));
  case 2:
    return (int128)((limit - 1) & wide & 3);
  default:
    return (int128)(wide & (limit - 1));
  }
}

/* A ratio of any width, at times just wide enough for the next path. */
static struct ratio draw(uint64_t *r) {
  static const int edges[] = {1, 30, 62, 63, 64, 65, 80, 81, 82, 124, BITS};
  enum { EDGES = sizeof edges / sizeof *edges };
  struct ratio ratio = {
      below(r, exact_random_below(r, 2) ? edges[exact_random_below(r, EDGES)]
                                        : 1 + exact_random_below(r, BITS)),
      below(r, exact_random_below(r, 2) ? edges[exact_random_below(r, EDGES)]
                                        : 1 + exact_random_below(r, BITS))};
  if (ratio.den == 0)
    ratio.den = 1;
  if (exact_random_below(r, 2))
    ratio.num = -ratio.num;
  return ratio;
}

/* A ratio close to `a`, the same in value at times. */
static struct ratio draw_near(uint64_t *r, struct ratio a) {
  const int128 limit = (int128)1 << (BITS - 3);
  if (-limit < a.num && a.num < limit && a.den < limit) {
    int factor = 1 + exact_random_below(r, 7);
    a.num = a.num * factor + exact_random_below(r, 3) - 1;
    a.den = a.den * factor + exact_random_below(r, 2);
  } else if (exact_random_below(r, 2)) {
    a.num /= 2;
    a.den = a.den / 2 + 1;
  } else {
    a.num += a.num > 0 ? -1 : 1;
  }
  return a;
}

static int sign(int v) { return (v > 0) - (v < 0); }

static void comparing_is_what_gmp_says(void **state) {
  uint64_t r = 1;
  long same = 0;
  mpq_t p, q;
  (void)state;
  mpq_inits(p, q, NULL);
  for (int i = 0; i < ROUNDS; i++) {
    struct ratio a = draw(&r),
                 b = exact_random_below(&r, 2) ? draw(&r) : draw_near(&r, a);
    rational_set_ratio(p, a);
    rational_set_ratio(q, b);
    assert_int_equal(sign(ratio_compare(a, b)), sign(mpq_cmp(p, q)));
    same += mpq_equal(p, q);
  }
  assert_true(same > ROUNDS / 100);
  mpq_clears(p, q, NULL);
}

static void comparing_holds_the_ends_of_the_range(void **state) {
  const int128 top = ((int128)1 << 125) - 1;
  const struct ratio largest = {top, 1}, least = {-top, 1},
                     nearly_one = {top - 1, top}, one = {top, top},
                     tiny = {1, top}, zero = {0, top};
  (void)state;
  assert_true(ratio_compare(least, largest) < 0);
  assert_true(ratio_compare(nearly_one, one) < 0);
  assert_true(ratio_compare(one, ratio_of(1, 1)) == 0);
  assert_true(ratio_compare(zero, tiny) < 0);
  assert_true(ratio_compare(zero, ratio_of(0, 1)) == 0);
  assert_true(ratio_compare((struct ratio){top - 1, top},
                            (struct ratio){top - 2, top - 1}) > 0);
  assert_true(ratio_compare((struct ratio){1 - top, top},
                            (struct ratio){2 - top, top - 1}) < 0);
}

static void comparing_is_antisymmetric_and_reflexive(void **state) {
  uint64_t r = 2;
  (void)state;
  for (int i = 0; i < ROUNDS; i++) {
    struct ratio a = draw(&r),
                 b = exact_random_below(&r, 2) ? draw(&r) : draw_near(&r, a);
    assert_int_equal(sign(ratio_compare(a, b)), -sign(ratio_compare(b, a)));
    assert_int_equal(ratio_compare(a, a), 0);
  }
}

static void comparing_is_transitive(void **state) {
  uint64_t r = 3;
  (void)state;
  for (int i = 0; i < ROUNDS; i++) {
    struct ratio a = draw(&r), b = draw_near(&r, a), c = draw_near(&r, b);
    int ab = ratio_compare(a, b), bc = ratio_compare(b, c);
    if (ab <= 0 && bc <= 0)
      assert_int_equal(sign(ratio_compare(a, c)), ab < 0 || bc < 0 ? -1 : 0);
    if (ab >= 0 && bc >= 0)
      assert_int_equal(sign(ratio_compare(a, c)), ab > 0 || bc > 0 ? 1 : 0);
  }
}

/* ---- ratio_lerp ---------------------------------------------------------- */

/* A parameter in [0, 1]. */
static struct ratio draw_share(uint64_t *r) {
  struct ratio t = draw(r);
  if (t.num < 0)
    t.num = -t.num;
  if (t.num > t.den) {
    int128 swap = t.num;
    t.num = t.den;
    t.den = swap;
  }
  return t;
}

static int64_t draw_end(uint64_t *r) {
  int64_t v = (int64_t)below(r, exact_random_below(r, 2) ? LERP_BITS : 31);
  return exact_random_below(r, 2) ? v : -v;
}

/* floor(p0 + t (p1 - p0) + 1/2) */
static int64_t lerp_by_gmp(struct ratio t, int64_t p0, int64_t p1) {
  mpq_t share, value;
  mpz_t rounded;
  int64_t result;
  mpq_inits(share, value, NULL);
  mpz_init(rounded);
  rational_set_ratio(share, t);
  mpq_set_si(value, p1 - p0, 1);
  mpq_mul(value, value, share);
  mpq_set_si(share, 2 * p0 + 1, 2);
  mpq_canonicalize(share);
  mpq_add(value, value, share);
  mpz_fdiv_q(rounded, mpq_numref(value), mpq_denref(value));
  result = mpz_get_si(rounded);
  mpq_clears(share, value, NULL);
  mpz_clear(rounded);
  return result;
}

static void lerp_is_what_gmp_says(void **state) {
  uint64_t r = 4;
  (void)state;
  for (int i = 0; i < ROUNDS; i++) {
    struct ratio t = draw_share(&r);
    int64_t p0 = draw_end(&r), p1 = draw_end(&r);
    assert_true(ratio_lerp(t, p0, p1) == lerp_by_gmp(t, p0, p1));
  }
}

/* Also at halves and next to them, where doubles decide nothing. */
static void lerp_rounds_halves_up(void **state) {
  uint64_t r = 5;
  (void)state;
  for (int i = 0; i < ROUNDS; i++) {
    int64_t p0 = draw_end(&r), d = 1 + (int64_t)below(&r, LERP_BITS),
            num = (int64_t)below(&r, LERP_BITS) % (2 * d);
    struct ratio t = {num, 2 * d};
    assert_true(ratio_lerp(t, p0, p0 + d) == lerp_by_gmp(t, p0, p0 + d));
    t = (struct ratio){(int128)num * (INT64_C(1) << 50) - 1,
                       (int128)2 * d * (INT64_C(1) << 50)};
    if (num > 0)
      assert_true(ratio_lerp(t, p0, p0 + d) == lerp_by_gmp(t, p0, p0 + d));
  }
}

static void lerp_depends_on_the_value_alone(void **state) {
  uint64_t r = 5;
  (void)state;
  for (int i = 0; i < ROUNDS; i++) {
    struct ratio t = draw_share(&r), again;
    int64_t p0 = draw_end(&r), p1 = draw_end(&r);
    /* Written so narrow that it stays in range when written wider. */
    t.num >>= BITS / 2;
    t.den = (t.den >> BITS / 2) + 1;
    if (t.num > t.den)
      t.num = t.den;
    again = (struct ratio){t.num << (BITS / 2 - 1), t.den << (BITS / 2 - 1)};
    assert_int_equal(ratio_compare(t, again), 0);
    assert_true(ratio_lerp(t, p0, p1) == ratio_lerp(again, p0, p1));
  }
}

static void lerp_rounds_halves_up_whatever_the_direction(void **state) {
  const struct ratio half = {1, 2}, same = {(int128)1 << 123, (int128)1 << 124};
  (void)state;
  for (int64_t p = -4; p <= 4; p++) {
    assert_true(ratio_lerp(half, p, p + 1) == p + 1);
    assert_true(ratio_lerp(half, p + 1, p) == p + 1);
    assert_true(ratio_lerp(same, p, p + 1) == p + 1);
    assert_true(ratio_lerp(same, p + 1, p) == p + 1);
  }
}

static void lerp_meets_both_ends(void **state) {
  uint64_t r = 6;
  (void)state;
  for (int i = 0; i < 1000; i++) {
    int64_t p0 = draw_end(&r), p1 = draw_end(&r);
    int128 den = draw_share(&r).den;
    assert_true(ratio_lerp((struct ratio){0, den}, p0, p1) == p0);
    assert_true(ratio_lerp((struct ratio){den, den}, p0, p1) == p1);
  }
}

/* ---- ratio_to_double ----------------------------------------------------- */

static void the_double_is_within_two_units_in_the_last_place(void **state) {
  uint64_t r = 7;
  mpq_t exact, error, bound;
  (void)state;
  mpq_inits(exact, error, bound, NULL);
  for (int i = 0; i < ROUNDS; i++) {
    struct ratio a = draw(&r);
    rational_set_ratio(exact, a);
    mpq_set_d(error, ratio_to_double(a));
    mpq_sub(error, error, exact);
    mpq_abs(error, error);
    /* A last place is at most 2^-52 of the value. */
    mpq_abs(bound, exact);
    mpq_div_2exp(bound, bound, 51);
    assert_true(mpq_cmp(error, bound) <= 0);
  }
  mpq_clears(exact, error, bound, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(comparing_is_what_gmp_says),
      cmocka_unit_test(comparing_holds_the_ends_of_the_range),
      cmocka_unit_test(comparing_is_antisymmetric_and_reflexive),
      cmocka_unit_test(comparing_is_transitive),
      cmocka_unit_test(lerp_is_what_gmp_says),
      cmocka_unit_test(lerp_rounds_halves_up),
      cmocka_unit_test(lerp_depends_on_the_value_alone),
      cmocka_unit_test(lerp_rounds_halves_up_whatever_the_direction),
      cmocka_unit_test(lerp_meets_both_ends),
      cmocka_unit_test(the_double_is_within_two_units_in_the_last_place),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
