/* test_predicate.c - orientation and planes, compared with GMP at the ends of
 * their ranges. */
#include "exact_fixture/rational.h"
#include "exact_fixture/sheet.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#define XY_MAX ((1 << 30) - 1)
#define Z_MAX ((INT64_C(1) << 40) - 1)

enum { ROUNDS = 20000, EXTREMES = 18 };

/* The corners of the range's box and the middles of two of its faces. */
static struct geom_point extreme(int k) {
  static const int32_t xy[3] = {-XY_MAX, XY_MAX, 0};
  return (struct geom_point){xy[k % 3], xy[k / 3 % 3], k < 9 ? 0 : Z_MAX};
}

static struct geom_point draw(uint64_t *r) {
  struct geom_point p = extreme(exact_random_below(r, EXTREMES));
  switch (exact_random_below(r, 3)) {
  case 0: /* small, so that all kinds of coincidence happen */
    return (struct geom_point){exact_random_below(r, 7) - 3,
                               exact_random_below(r, 7) - 3,
                               exact_random_below(r, 4)};
  case 1:
    p.x += p.x > 0 ? -exact_random_below(r, 3) : exact_random_below(r, 3);
    p.y += p.y > 0 ? -exact_random_below(r, 3) : exact_random_below(r, 3);
    p.z += p.z > 0 ? -exact_random_below(r, 3) : exact_random_below(r, 3);
    return p;
  default:
    return (struct geom_point){exact_random_below(r, 2 * XY_MAX) - XY_MAX,
                               exact_random_below(r, 2 * XY_MAX) - XY_MAX,
                               (int64_t)(exact_random(r) & (uint64_t)Z_MAX)};
  }
}

/* ---- By GMP -------------------------------------------------------------- */

static void set_row(mpz_t row[3], struct geom_point from,
                    struct geom_point to) {
  mpz_set_si(row[0], (long)to.x - from.x);
  mpz_set_si(row[1], (long)to.y - from.y);
  mpz_set_si(row[2], to.z - from.z);
}

/* to = a[i] b[j] - a[j] b[i] */
static void minor(mpz_t to, const mpz_t a[3], const mpz_t b[3], int i, int j) {
  mpz_mul(to, a[i], b[j]);
  mpz_submul(to, a[j], b[i]);
}

struct reference {
  mpz_t u[3], v[3], w[3], n[3], value;
};

static void reference_init(struct reference *f) {
  for (int k = 0; k < 3; k++)
    mpz_inits(f->u[k], f->v[k], f->w[k], f->n[k], NULL);
  mpz_init(f->value);
}

static void reference_clear(struct reference *f) {
  for (int k = 0; k < 3; k++)
    mpz_clears(f->u[k], f->v[k], f->w[k], f->n[k], NULL);
  mpz_clear(f->value);
}

/* The normal of a, b, c and its plane's value at p. */
static void compute(struct reference *f, struct geom_point a,
                    struct geom_point b, struct geom_point c,
                    struct geom_point p) {
  set_row(f->u, a, b);
  set_row(f->v, a, c);
  set_row(f->w, a, p);
  minor(f->n[0], f->u, f->v, 1, 2);
  minor(f->n[1], f->u, f->v, 2, 0);
  minor(f->n[2], f->u, f->v, 0, 1);
  mpz_set_ui(f->value, 0);
  for (int k = 0; k < 3; k++)
    mpz_addmul(f->value, f->n[k], f->w[k]);
}

static bool is_same(const mpz_t exact, int128 value) {
  mpz_t wide;
  bool same;
  mpz_init(wide);
  rational_set_int128(wide, value);
  same = mpz_cmp(exact, wide) == 0;
  mpz_clear(wide);
  return same;
}

static void check(struct reference *f, const struct geom_point p[4]) {
  struct geom_plane plane = geom_plane_of(p[0], p[1], p[2]);
  compute(f, p[0], p[1], p[2], p[3]);
  assert_true(is_same(f->n[2], geom_orient2d(p[0], p[1], p[2])));
  assert_true(is_same(f->n[0], plane.nx));
  assert_true(is_same(f->n[1], plane.ny));
  assert_true(is_same(f->n[2], plane.nz));
  assert_true(is_same(f->value, geom_plane_value(&plane, p[3])));
}

static void all_extremes_of_the_ranges_are_exact(void **state) {
  struct reference f;
  size_t widest_normal = 0, widest_value = 0;
  (void)state;
  reference_init(&f);
  for (int i = 0; i < EXTREMES * EXTREMES * EXTREMES * EXTREMES; i++) {
    const struct geom_point p[4] = {
        extreme(i % EXTREMES), extreme(i / EXTREMES % EXTREMES),
        extreme(i / (EXTREMES * EXTREMES) % EXTREMES),
        extreme(i / (EXTREMES * EXTREMES * EXTREMES))};
    check(&f, p);
    if (mpz_sizeinbase(f.n[0], 2) > widest_normal)
      widest_normal = mpz_sizeinbase(f.n[0], 2);
    if (mpz_sizeinbase(f.value, 2) > widest_value)
      widest_value = mpz_sizeinbase(f.value, 2);
  }
  /* The header's bounds, and that they are not idle. */
  assert_in_range(widest_normal, 71, 72);
  assert_in_range(widest_value, 102, 105);
  reference_clear(&f);
}

static void random_points_are_exact(void **state) {
  uint64_t r = 1;
  struct reference f;
  (void)state;
  reference_init(&f);
  for (int i = 0; i < ROUNDS; i++) {
    const struct geom_point p[4] = {draw(&r), draw(&r), draw(&r), draw(&r)};
    check(&f, p);
  }
  reference_clear(&f);
}

static void orient2d_is_antisymmetric(void **state) {
  uint64_t r = 2;
  (void)state;
  for (int i = 0; i < ROUNDS; i++) {
    struct geom_point a = draw(&r), b = draw(&r), c = draw(&r);
    int64_t area = geom_orient2d(a, b, c);
    assert_true(geom_orient2d(b, c, a) == area);
    assert_true(geom_orient2d(c, a, b) == area);
    assert_true(geom_orient2d(b, a, c) == -area);
    assert_true(geom_orient2d(a, c, b) == -area);
    assert_true(geom_orient2d(a, a, b) == 0);
    assert_true(geom_orient2d(a, b, a) == 0);
  }
}

static void orient2d_is_positive_counter_clockwise(void **state) {
  const struct geom_point o = {0, 0, 5}, x = {1, 0, 9}, y = {0, 1, 7};
  (void)state;
  assert_true(geom_orient2d(o, x, y) == 1);
}

static void a_plane_is_zero_at_its_corners(void **state) {
  uint64_t r = 3;
  (void)state;
  for (int i = 0; i < ROUNDS; i++) {
    struct geom_point p[3] = {draw(&r), draw(&r), draw(&r)};
    struct geom_plane plane = geom_plane_of(p[0], p[1], p[2]);
    for (int k = 0; k < 3; k++)
      assert_true(geom_plane_value(&plane, p[k]) == 0);
  }
}

static void a_plane_is_positive_towards_the_viewer(void **state) {
  uint64_t r = 4;
  (void)state;
  for (int i = 0; i < ROUNDS; i++) {
    struct geom_point p[3] = {draw(&r), draw(&r), draw(&r)}, q = p[i % 3];
    struct geom_plane plane;
    if (geom_orient2d(p[0], p[1], p[2]) <= 0)
      continue;
    plane = geom_plane_of(p[0], p[1], p[2]);
    q.z++;
    assert_true(geom_plane_value(&plane, q) == plane.nz && plane.nz > 0);
    q.z -= 2;
    assert_true(geom_plane_value(&plane, q) == -(int128)plane.nz);
  }
}

static void signs_are_signs(void **state) {
  (void)state;
  assert_int_equal(geom_sign64(INT64_MIN), -1);
  assert_int_equal(geom_sign64(0), 0);
  assert_int_equal(geom_sign64(INT64_MAX), 1);
  assert_int_equal(geom_sign128((int128)1 << 100), 1);
  assert_int_equal(geom_sign128(-((int128)1 << 100)), -1);
  assert_int_equal(geom_sign128(0), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_extremes_of_the_ranges_are_exact),
      cmocka_unit_test(random_points_are_exact),
      cmocka_unit_test(orient2d_is_antisymmetric),
      cmocka_unit_test(orient2d_is_positive_counter_clockwise),
      cmocka_unit_test(a_plane_is_zero_at_its_corners),
      cmocka_unit_test(a_plane_is_positive_towards_the_viewer),
      cmocka_unit_test(signs_are_signs),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
