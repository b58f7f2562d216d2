/* test_wide.c - wide integers, compared with GMP's. */
#include "exact_fixture/rational.h"
#include "exact_fixture/sheet.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "geom/wide.h"

enum { ROUNDS = 200000 };

/* A number of `limbs` limbs at most, often with long runs of equal digits. */
static struct wide draw(uint64_t *r, int limbs) {
  uint64_t limb[WIDE_LIMBS] = {0};
  int count = exact_random_below(r, limbs + 1);
  for (int i = 0; i < count; i++) {
    int how = exact_random_below(r, 4);
    limb[i] = how == 0 ? 0 : how == 1 ? UINT64_MAX : exact_random(r);
    if (how == 3)
      limb[i] >>= exact_random_below(r, 64);
  }
  return wide_of_limbs(limb, count, exact_random_below(r, 2) ? 1 : -1);
}

static void assert_is(const struct wide *a, const mpz_t wanted) {
  mpz_t got;
  mpz_init(got);
  assert_int_equal(a->sign, mpz_sgn(wanted));
  assert_int_equal(a->count, mpz_size(wanted));
  rational_set_wide(got, a);
  assert_int_equal(mpz_cmp(got, wanted), 0);
  mpz_clear(got);
}

static void products_and_sums_are_those_of_gmp(void **state) {
  uint64_t r = 1;
  mpz_t a, b, c, d, want;
  (void)state;
  mpz_inits(a, b, c, d, want, NULL);
  for (int i = 0; i < ROUNDS; i++) {
    struct wide p = draw(&r, 5), q = draw(&r, 4), s = draw(&r, 5),
                t = draw(&r, 4), to;
    if (exact_random_below(&r, 4) == 0)
      s = p, t = q; /* what is left is 0 */
    rational_set_wide(a, &p);
    rational_set_wide(b, &q);
    rational_set_wide(c, &s);
    rational_set_wide(d, &t);
    wide_multiply(&to, &p, &q);
    mpz_mul(want, a, b);
    assert_is(&to, want);
    wide_add(&to, &p, &s);
    mpz_add(want, a, c);
    assert_is(&to, want);
    wide_cross(&to, &p, &q, &s, &t);
    mpz_mul(want, a, b);
    mpz_submul(want, c, d);
    assert_is(&to, want);
    wide_negate(&to);
    mpz_neg(want, want);
    assert_is(&to, want);
  }
  mpz_clears(a, b, c, d, want, NULL);
}

static void machine_words_and_doubles_are_those_of_gmp(void **state) {
  uint64_t r = 2;
  mpz_t a;
  (void)state;
  mpz_init(a);
  for (int i = 0; i < ROUNDS; i++) {
    int128 value = (int128)((uint128)exact_random(&r) << 64 | exact_random(&r));
    struct wide p = draw(&r, 10);
    value >>= exact_random_below(&r, 128);
    rational_set_wide(a, &p);
    assert_true(wide_to_double(&p) == mpz_get_d(a));
    p = wide_of_int128(value);
    rational_set_int128(a, value);
    assert_is(&p, a);
    assert_true(wide_to_double(&p) == mpz_get_d(a));
  }
  mpz_clear(a);
}

static void quotients_are_rounded_as_gmp_would(void **state) {
  uint64_t r = 3;
  mpz_t num, den;
  (void)state;
  mpz_inits(num, den, NULL);
  for (int i = 0; i < ROUNDS; i++) {
    int bits = exact_random_below(&r, 30);
    int64_t about =
        (int64_t)exact_random(&r) >> (bits + 2 + exact_random_below(&r, 32));
    struct wide d = draw(&r, 5), q = wide_of_int128(about), n, sum,
                off = draw(&r, 4);
    if (d.sign <= 0)
      continue;
    wide_multiply(&n, &d, &q);
    wide_add(&sum, &n, &off);
    if (off.count >= d.count)
      sum = n;
    rational_set_wide(num, &sum);
    rational_set_wide(den, &d);
    mpz_mul_2exp(num, num, (mp_bitcnt_t)bits + 1);
    mpz_add(num, num, den);
    mpz_mul_2exp(den, den, 1);
    mpz_fdiv_q(num, num, den);
    assert_true(mpz_fits_slong_p(num));
    assert_true(wide_round_quotient(&sum, &d, bits) == mpz_get_si(num));
  }
  mpz_clears(num, den, NULL);
}

static void divided_by_their_common_divisor_they_are_as_gmp_says(void **state) {
  uint64_t r = 4;
  mpz_t v[3], divisor;
  int fitting = 0;
  (void)state;
  mpz_inits(v[0], v[1], v[2], divisor, NULL);
  for (int i = 0; i < ROUNDS; i++) {
    struct wide w[3], times = draw(&r, 2);
    int64_t got[3];
    bool fits = true;
    for (int k = 0; k < 3; k++) {
      struct wide part = draw(&r, 1);
      wide_multiply(&w[k], &part, &times);
    }
    if (w[0].sign == 0 && w[1].sign == 0 && w[2].sign == 0)
      continue;
    mpz_set_ui(divisor, 0);
    for (int k = 0; k < 3; k++) {
      rational_set_wide(v[k], &w[k]);
      mpz_gcd(divisor, divisor, v[k]);
    }
    for (int k = 0; k < 3; k++) {
      mpz_divexact(v[k], v[k], divisor);
      fits = fits && mpz_fits_slong_p(v[k]);
    }
    assert_int_equal(wide_reduce(w, got), fits);
    for (int k = 0; fits && k < 3; k++)
      assert_true(got[k] == mpz_get_si(v[k]));
    fitting += fits;
  }
  assert_in_range(fitting, ROUNDS / 4, ROUNDS - ROUNDS / 100);
  mpz_clears(v[0], v[1], v[2], divisor, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(products_and_sums_are_those_of_gmp),
      cmocka_unit_test(machine_words_and_doubles_are_those_of_gmp),
      cmocka_unit_test(quotients_are_rounded_as_gmp_would),
      cmocka_unit_test(divided_by_their_common_divisor_they_are_as_gmp_says),
  };
  return cmocka_run_group_tests_name("wide", tests, NULL, NULL);
}
