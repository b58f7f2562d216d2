/* test_line.c - exact lines and corners, compared with rational arithmetic. */
#include "exact_fixture/rational.h"
#include "exact_fixture/sheet.h"
#include "geom/line_key.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#define XY_MAX ((1 << 30) - 1)
#define Z_MAX ((INT64_C(1) << 40) - 1)

/* A line of src/geom and the same one in rationals. */
struct twin {
  struct geom_line line;
  struct rational_line exact;
};

static void twin_init(struct twin *t) { rational_line_init(&t->exact); }
static void twin_clear(struct twin *t) { rational_line_clear(&t->exact); }

static void twin_through(struct twin *t, struct geom_point p,
                         struct geom_point q) {
  geom_line_through(&t->line, p, q);
  rational_line_through(&t->exact, p, q);
}

static struct geom_plane plane_of(const struct geom_point p[3]) {
  return geom_plane_of(p[0], p[1], p[2]);
}

/* Returns as geom_line_between. */
static int twin_between(struct twin *t, const struct geom_point f[3],
                        const struct geom_point g[3]) {
  struct geom_plane front = plane_of(f), back = plane_of(g);
  rational_line_between(&t->exact, f, g);
  return geom_line_between(&t->line, &front, &back);
}

static void twin_reverse(struct twin *t) {
  t->line = geom_line_reversed(&t->line);
  mpq_neg(t->exact.a, t->exact.a);
  mpq_neg(t->exact.b, t->exact.b);
  mpq_neg(t->exact.c, t->exact.c);
}

/* ---- Random input -------------------------------------------------------- */

/* A whole number of at most `bits` bits, often at the ends of its range. */
static int64_t number(uint64_t *r, int bits) {
  int64_t limit = (INT64_C(1) << bits) - 1;
  switch (exact_random_below(r, 8)) {
  case 0:
    return exact_random_below(r, 3) - 1;
  case 1:
    return exact_random_below(r, 2) ? limit : -limit;
  case 2:
    return (exact_random_below(r, 2) ? limit : -limit) / 2 +
           exact_random_below(r, 3);
  default:
    return (int64_t)(exact_random(r) % (2 * (uint64_t)limit + 1)) - limit;
  }
}

static struct geom_point point(uint64_t *r, int bits) {
  int64_t z = number(r, 40);
  return (struct geom_point){(int32_t)number(r, bits), (int32_t)number(r, bits),
                             z < 0 ? -z : z};
}

static int32_t clamp_xy(int64_t v) {
  return (int32_t)(v < -XY_MAX ? -XY_MAX : v > XY_MAX ? XY_MAX : v);
}

/* A point at most `reach` away. */
static struct geom_point near(uint64_t *r, struct geom_point p, int reach) {
  p.x = clamp_xy((int64_t)p.x + exact_random_below(r, 2 * reach + 1) - reach);
  p.y = clamp_xy((int64_t)p.y + exact_random_below(r, 2 * reach + 1) - reach);
  p.z += exact_random_below(r, 2 * reach + 1) - reach;
  if (p.z < 0)
    p.z = 0;
  if (p.z > Z_MAX)
    p.z = Z_MAX;
  return p;
}

static int bits_of_scene(uint64_t *r) {
  static const int bits[] = {2, 4, 12, 30, 30};
  return bits[exact_random_below(r, 5)];
}

static bool same_place(struct geom_point p, struct geom_point q) {
  return p.x == q.x && p.y == q.y;
}

/* A counter-clockwise triangle. */
static void triangle(uint64_t *r, int bits, struct geom_point p[3]) {
  do {
    for (int k = 0; k < 3; k++)
      p[k] = point(r, bits);
  } while (!exact_turn_triangle(p));
}

/* A grid line, near the one from p to q or anywhere. */
static void draw_grid_line(uint64_t *r, int bits, struct twin *t,
                           struct geom_point p, struct geom_point q) {
  struct geom_point a, b;
  do {
    switch (exact_random_below(r, 3)) {
    case 0:
      a = point(r, bits), b = point(r, bits);
      break;
    case 1:
      a = near(r, p, 2), b = near(r, q, 2);
      break;
    default:
      a = near(r, p, 1), b = point(r, bits);
    }
  } while (same_place(a, b));
  twin_through(t, a, b);
  if (exact_random_below(r, 2))
    twin_reverse(t);
}

/* The intersection of two planes of one family, so that these often meet on
 * each other: all of a family's planes go through a common point or, nearly,
 * through one line. */
static bool wide(uint64_t *r, const struct geom_point family[4],
                 struct twin *t) {
  struct geom_point f[2][3];
  for (int i = 0; i < 2; i++) {
    int64_t area;
    for (int k = 0; k < 3; k++) {
      f[i][k] = family[(k + exact_random_below(r, 2)) % 4];
      if (exact_random_below(r, 4) == 0)
        f[i][k] = near(r, f[i][k], 1);
    }
    area = geom_orient2d(f[i][0], f[i][1], f[i][2]);
    if (area == 0)
      return false;
    if (area < 0) {
      struct geom_point swap = f[i][0];
      f[i][0] = f[i][1];
      f[i][1] = swap;
    }
  }
  if (twin_between(t, f[0], f[1]) != 0)
    return false;
  if (exact_random_below(r, 2))
    twin_reverse(t);
  return true;
}

enum { LINES = 5, ROUNDS = 3000 };

/* Lines that know each other: many cross in one point or nearly so. */
static void draw_lines(uint64_t *r, struct twin t[LINES]) {
  int bits = bits_of_scene(r);
  struct geom_point family[4];
  for (int k = 0; k < 4; k++)
    family[k] = point(r, bits);
  for (int k = 0; k < LINES; k++)
    if (exact_random_below(r, 2) || !wide(r, family, &t[k]))
      draw_grid_line(r, bits, &t[k], family[0], family[1]);
}

/* ---- Questions ----------------------------------------------------------- */

static int sign_of_products(const struct twin *p, const struct twin *q,
                            bool dot) {
  mpq_t left, right;
  int sign;
  mpq_inits(left, right, NULL);
  mpq_mul(left, p->exact.a, dot ? q->exact.a : q->exact.b);
  mpq_mul(right, dot ? p->exact.b : q->exact.a, dot ? q->exact.b : p->exact.b);
  if (dot)
    mpq_add(left, left, right);
  else
    mpq_sub(left, left, right);
  sign = mpq_sgn(left);
  mpq_clears(left, right, NULL);
  return sign;
}

static void orientation_and_direction_are_signs_of_products(void **state) {
  uint64_t r = 11;
  int zeros = 0;
  struct twin t[LINES];
  (void)state;
  for (int k = 0; k < LINES; k++)
    twin_init(&t[k]);
  for (int i = 0; i < ROUNDS; i++) {
    draw_lines(&r, t);
    for (int j = 0; j < LINES; j++)
      for (int k = 0; k < LINES; k++) {
        int turn = sign_of_products(&t[j], &t[k], false),
            along = sign_of_products(&t[j], &t[k], true);
        zeros += (j != k && turn == 0) + (along == 0);
        assert_int_equal(geom_line_turn(&t[j].line, &t[k].line), turn);
        assert_int_equal(geom_line_along(&t[j].line, &t[k].line), along);
      }
  }
  assert_true(zeros > 100);
  for (int k = 0; k < LINES; k++)
    twin_clear(&t[k]);
}

/* A corner of src/geom and the same point in rationals. */
struct twin_corner {
  struct geom_corner corner;
  struct rational_point exact;
};

static bool on_page(const struct rational_point *p) {
  mpq_t limit;
  bool inside;
  mpq_init(limit);
  mpq_set_si(limit, XY_MAX, 1);
  inside = mpq_cmp(p->x, limit) <= 0 && mpq_cmp(p->y, limit) <= 0;
  mpq_neg(limit, limit);
  inside = inside && mpq_cmp(p->x, limit) >= 0 && mpq_cmp(p->y, limit) >= 0;
  mpq_clear(limit);
  return inside;
}

/* All crossings on the page, and an integer point; returns how many. */
static int draw_corners(uint64_t *r, const struct twin t[LINES],
                        struct twin_corner *c) {
  int count = 0;
  for (int j = 0; j < LINES; j++)
    for (int k = 0; k < LINES; k++)
      if (j != k &&
          rational_point_meet(&c[count].exact, &t[j].exact, &t[k].exact) &&
          on_page(&c[count].exact)) {
        c[count].corner = geom_corner_of(&t[j].line, &t[k].line);
        count++;
      }
  for (int k = 0; k < LINES && t[k].line.is_grid_line; k++) {
    struct geom_point p = {t[k].line.x0, t[k].line.y0, 0};
    if (exact_random_below(r, 2))
      p = near(r, p, 1);
    rational_point_at(&c[count].exact, p);
    c[count++].corner = geom_corner_at(p);
  }
  return count;
}

enum { CORNERS = LINES * LINES };

static void twins_init(struct twin t[LINES], struct twin_corner c[CORNERS]) {
  for (int k = 0; k < LINES; k++)
    twin_init(&t[k]);
  for (int k = 0; k < CORNERS; k++)
    rational_point_init(&c[k].exact);
}

static void twins_clear(struct twin t[LINES], struct twin_corner c[CORNERS]) {
  for (int k = 0; k < LINES; k++)
    twin_clear(&t[k]);
  for (int k = 0; k < CORNERS; k++)
    rational_point_clear(&c[k].exact);
}

static void side_is_the_sign_of_the_value(void **state) {
  uint64_t r = 12;
  long zeros = 0, wide_zeros = 0;
  struct twin t[LINES];
  struct twin_corner c[CORNERS];
  (void)state;
  twins_init(t, c);
  for (int i = 0; i < ROUNDS; i++) {
    int count;
    draw_lines(&r, t);
    count = draw_corners(&r, t, c);
    for (int j = 0; j < LINES; j++)
      for (int k = 0; k < count; k++) {
        int want = rational_line_side(&t[j].exact, &c[k].exact);
        assert_int_equal(geom_line_side(&t[j].line, &c[k].corner), want);
        if (want == 0 && c[k].corner.l1 != &t[j].line &&
            c[k].corner.l2 != &t[j].line) {
          zeros++;
          wide_zeros += !t[j].line.is_grid_line;
        }
      }
  }
  assert_true(zeros > 1000 && wide_zeros > 100);
  twins_clear(t, c);
}

static int compare_places(const struct rational_point *p,
                          const struct rational_point *q) {
  int order = mpq_cmp(p->x, q->x);
  if (order == 0)
    order = mpq_cmp(p->y, q->y);
  return (order > 0) - (order < 0);
}

static void corners_compare_by_x_then_y(void **state) {
  uint64_t r = 13;
  long same = 0;
  struct twin t[LINES];
  struct twin_corner c[CORNERS];
  (void)state;
  twins_init(t, c);
  for (int i = 0; i < ROUNDS; i++) {
    int count;
    draw_lines(&r, t);
    count = draw_corners(&r, t, c);
    for (int j = 0; j < count; j++)
      for (int k = 0; k < count; k++) {
        int want = compare_places(&c[j].exact, &c[k].exact),
            got = geom_corner_compare(&c[j].corner, &c[k].corner);
        assert_int_equal((got > 0) - (got < 0), want);
        same += j < k && want == 0;
      }
  }
  assert_true(same > 1000);
  twins_clear(t, c);
}

/* floor(2^bits v + 1/2) */
static int64_t round_half_up(const mpq_t v, int bits) {
  mpz_t num;
  int64_t rounded;
  mpz_init(num);
  mpz_mul_2exp(num, mpq_numref(v), (mp_bitcnt_t)bits + 1);
  mpz_add(num, num, mpq_denref(v));
  mpz_fdiv_q(num, num, mpq_denref(v));
  mpz_fdiv_q_2exp(num, num, 1);
  rounded = mpz_get_si(num);
  mpz_clear(num);
  return rounded;
}

static void corners_round_to_the_nearest_halves_up(void **state) {
  uint64_t r = 14;
  struct twin t[LINES];
  struct twin_corner c[CORNERS];
  struct rational_point exact;
  (void)state;
  rational_point_init(&exact);
  twins_init(t, c);
  for (int i = 0; i < ROUNDS / 2; i++) {
    int count;
    draw_lines(&r, t);
    count = draw_corners(&r, t, c);
    for (int k = 0; k < count; k++)
      for (int bits = 0; bits <= 20; bits += 4) {
        int64_t x, y;
        geom_corner_round(&c[k].corner, bits, &x, &y);
        assert_true(x == round_half_up(c[k].exact.x, bits));
        assert_true(y == round_half_up(c[k].exact.y, bits));
        rational_point_at_corner(&exact, &c[k].corner);
        assert_int_equal(compare_places(&exact, &c[k].exact), 0);
      }
  }
  twins_clear(t, c);
  rational_point_clear(&exact);
}

static void a_half_is_rounded_up_also_below_zero(void **state) {
  struct twin level, steep;
  (void)state;
  twin_init(&level);
  twin_init(&steep);
  for (int x = -3; x <= 3; x++) {
    struct geom_point p = {x, 0, 0}, q = {x + 1, 2, 0}, u = {-9, 1, 0},
                      v = {9, 1, 0};
    struct geom_corner corner;
    int64_t rx, ry;
    twin_through(&level, u, v);
    twin_through(&steep, p, q);
    corner = geom_corner_of(&level.line, &steep.line); /* x + 1/2, 1 */
    geom_corner_round(&corner, 0, &rx, &ry);
    assert_int_equal(rx, x + 1);
    assert_int_equal(ry, 1);
    geom_corner_round(&corner, 1, &rx, &ry);
    assert_int_equal(rx, 2 * x + 1);
  }
  twin_clear(&level);
  twin_clear(&steep);
}

/* These lines differ only in their c, which doubles round. */
static void lines_nearly_level_cross_where_they_should(void **state) {
  struct rational_point exact;
  (void)state;
  rational_point_init(&exact);
  for (int k = 1; k < 99; k++) {
    struct geom_line rising, falling;
    struct geom_corner corner;
    int32_t top = XY_MAX - 5 * k, left = -XY_MAX + 3 * k,
            right = XY_MAX - 7 * k;
    geom_line_through(&rising, (struct geom_point){left, top, 0},
                      (struct geom_point){right, top + 1, 0});
    geom_line_through(&falling, (struct geom_point){left, top + 1, 0},
                      (struct geom_point){right + k, top, 0});
    corner = geom_corner_of(&rising, &falling);
    rational_point_at_corner(&exact, &corner);
    assert_true(fabs(corner.x - mpq_get_d(exact.x)) <= 0.25);
    geom_line_through(&rising, (struct geom_point){top, left, 0},
                      (struct geom_point){top + 1, right, 0});
    geom_line_through(&falling, (struct geom_point){top + 1, left, 0},
                      (struct geom_point){top, right + k, 0});
    corner = geom_corner_of(&rising, &falling);
    rational_point_at_corner(&exact, &corner);
    assert_true(fabs(corner.y - mpq_get_d(exact.y)) <= 0.25);
  }
  rational_point_clear(&exact);
}

/* The boxes and filters of convex.c and region.c rely on this. */
static void corners_doubles_are_within_a_quarter_unit(void **state) {
  uint64_t r = 15;
  struct twin t[LINES];
  struct twin_corner c[CORNERS];
  (void)state;
  twins_init(t, c);
  for (int i = 0; i < ROUNDS; i++) {
    int count;
    draw_lines(&r, t);
    count = draw_corners(&r, t, c);
    for (int k = 0; k < count; k++) {
      int64_t x = round_half_up(c[k].exact.x, 16),
              y = round_half_up(c[k].exact.y, 16);
      assert_true(fabs(c[k].corner.x - (double)x * 0x1p-16) <= 0.25);
      assert_true(fabs(c[k].corner.y - (double)y * 0x1p-16) <= 0.25);
    }
  }
  twins_clear(t, c);
}

/* ---- Wide lines ---------------------------------------------------------- */

/* All corners of the range's box, and next to them. */
static struct geom_point extreme(uint64_t *r) {
  struct geom_point p = {exact_random_below(r, 2) ? XY_MAX : -XY_MAX,
                         exact_random_below(r, 2) ? XY_MAX : -XY_MAX,
                         exact_random_below(r, 2) ? Z_MAX : 0};
  return exact_random_below(r, 2) ? near(r, p, 3) : p;
}

static void extreme_triangle(uint64_t *r, struct geom_point p[3]) {
  do {
    for (int k = 0; k < 3; k++)
      p[k] = extreme(r);
  } while (!exact_turn_triangle(p));
}

/* The limbs of a plane intersection as an integer. */
static void wide_coefficient(mpz_t to, const struct geom_line *line, int k) {
  mpz_import(to, GEOM_LINE_LIMBS, -1, sizeof(mp_limb_t), 0, 0, line->limb[k]);
  if (line->sign[k] < 0)
    mpz_neg(to, to);
}

static void wide_lines_hold_the_extremes_of_the_ranges(void **state) {
  uint64_t r = 16;
  size_t widest = 0;
  mpz_t coefficient[3];
  mpq_t scaled;
  struct twin t;
  (void)state;
  mpz_inits(coefficient[0], coefficient[1], coefficient[2], NULL);
  mpq_init(scaled);
  twin_init(&t);
  for (int i = 0; i < ROUNDS; i++) {
    struct geom_point f[3], g[3];
    mpq_t *exact[3] = {&t.exact.a, &t.exact.b, &t.exact.c};
    extreme_triangle(&r, f);
    extreme_triangle(&r, g);
    if (twin_between(&t, f, g) != 0)
      continue;
    for (int k = 0; k < 3; k++) {
      /* The depth difference times both nz. */
      wide_coefficient(coefficient[k], &t.line, k);
      mpq_set_si(scaled, geom_orient2d(f[0], f[1], f[2]), 1);
      mpq_mul(scaled, scaled, *exact[k]);
      mpq_canonicalize(scaled);
      mpz_mul_si(mpq_numref(scaled), mpq_numref(scaled),
                 geom_orient2d(g[0], g[1], g[2]));
      mpq_canonicalize(scaled);
      assert_int_equal(mpz_cmp_ui(mpq_denref(scaled), 1), 0);
      assert_int_equal(mpz_cmp(mpq_numref(scaled), coefficient[k]), 0);
      if (mpz_sizeinbase(coefficient[k], 2) > widest)
        widest = mpz_sizeinbase(coefficient[k], 2);
    }
  }
  assert_true(widest > 160 && widest <= 170);
  mpz_clears(coefficient[0], coefficient[1], coefficient[2], NULL);
  mpq_clear(scaled);
  twin_clear(&t);
}

static void three_planes_meet_in_one_corner(void **state) {
  uint64_t r = 17;
  struct twin fg, gh, fh;
  int met = 0;
  (void)state;
  twin_init(&fg);
  twin_init(&gh);
  twin_init(&fh);
  for (int i = 0; i < ROUNDS; i++) {
    struct geom_point f[3], g[3], h[3];
    struct geom_corner corner, other;
    int bits = bits_of_scene(&r);
    triangle(&r, bits, f);
    triangle(&r, bits, g);
    triangle(&r, bits, h);
    if (twin_between(&fg, f, g) != 0 || twin_between(&gh, g, h) != 0 ||
        twin_between(&fh, f, h) != 0 || geom_line_turn(&fg.line, &gh.line) == 0)
      continue;
    corner = geom_corner_of(&fg.line, &gh.line);
    other = geom_corner_of(&fh.line, &fg.line);
    assert_int_equal(geom_line_side(&fh.line, &corner), 0);
    assert_int_equal(geom_line_side(&gh.line, &other), 0);
    if (isfinite(corner.x) && fabs(corner.x) < XY_MAX &&
        fabs(corner.y) < XY_MAX) {
      assert_int_equal(geom_corner_compare(&corner, &other), 0);
      met++;
    }
  }
  assert_true(met > 100);
  twin_clear(&fg);
  twin_clear(&gh);
  twin_clear(&fh);
}

static void parallel_planes_have_no_line_but_an_order(void **state) {
  uint64_t r = 18;
  (void)state;
  for (int i = 0; i < 1000; i++) {
    struct geom_point f[3], g[3];
    struct geom_plane front, back;
    struct geom_line line;
    int bits = bits_of_scene(&r), shift = exact_random_below(&r, 3) - 1;
    triangle(&r, bits, f);
    for (int k = 0; k < 3; k++) {
      if (f[k].z == 0)
        f[k].z = 1;
      if (f[k].z >= Z_MAX)
        f[k].z = Z_MAX - 1;
    }
    for (int k = 0; k < 3; k++) {
      g[k] = f[(k + 1) % 3];
      g[k].z += shift;
    }
    front = plane_of(g);
    back = plane_of(f);
    assert_int_equal(geom_line_between(&line, &front, &back),
                     shift == 0 ? GEOM_SAME_PLANE : shift);
  }
}

static void a_line_turned_round_has_its_sides_swapped(void **state) {
  uint64_t r = 19;
  struct twin t[LINES];
  struct twin_corner c[CORNERS];
  (void)state;
  twins_init(t, c);
  for (int i = 0; i < 500; i++) {
    int count;
    draw_lines(&r, t);
    count = draw_corners(&r, t, c);
    for (int j = 0; j < LINES; j++) {
      struct geom_line back = t[j].line;
      back = geom_line_reversed(&back);
      for (int k = 0; k < count; k++)
        assert_int_equal(geom_line_side(&back, &c[k].corner),
                         -geom_line_side(&t[j].line, &c[k].corner));
      assert_int_equal(geom_line_turn(&back, &t[j].line), 0);
      assert_int_equal(geom_line_along(&back, &t[j].line), -1);
    }
  }
  twins_clear(t, c);
}

/* A line through two places k and l steps from a point. */
static struct geom_line stepped(struct geom_point p, int dx, int dy, int k,
                                int l) {
  struct geom_line line;
  geom_line_through(&line, (struct geom_point){p.x + k * dx, p.y + k * dy, 0},
                    (struct geom_point){p.x + l * dx, p.y + l * dy, 0});
  return line;
}

static void lines_have_one_key_however_they_are_given(void **state) {
  uint64_t r = 3;
  int alike = 0;
  (void)state;
  for (int i = 0; i < 2000; i++) {
    struct geom_point p = {exact_random_below(&r, 1 << 28),
                           exact_random_below(&r, 1 << 28), 0};
    int dx = exact_random_below(&r, 2001) - 1000,
        dy = exact_random_below(&r, 2001) - 1000;
    uint64_t a, b, c, d;
    if (dx == 0 && dy == 0)
      continue;
    struct geom_line line = stepped(p, dx, dy, -3, 4);
    assert_true(geom_line_key(&line, &a));
    line = stepped(p, dx, dy, 1000, 1000 - 7 * (1 + i % 5));
    assert_true(geom_line_key(&line, &b));
    assert_true(a == b);
    /* Two planes that cross above it. */
    const struct geom_point f[3] = {{p.x, p.y, 900},
                                    {p.x + dx, p.y + dy, 905},
                                    {p.x - dy, p.y + dx, 0}},
                            g[3] = {{p.x, p.y, 900},
                                    {p.x + dx, p.y + dy, 905},
                                    {p.x - dy, p.y + dx, 7}};
    struct geom_plane front = plane_of(g), back = plane_of(f);
    assert_int_equal(geom_line_between(&line, &front, &back), 0);
    assert_true(geom_line_key(&line, &c));
    assert_true(a == c);
    p.x++;
    line = stepped(p, dx, dy, 0, 1);
    assert_true(geom_line_key(&line, &d));
    alike += a == d && dy != 0;
  }
  assert_int_equal(alike, 0);
}

/* A plane by a random triangle, and the same one by a larger triangle. */
static void draw_plane(uint64_t *r, struct geom_plane plane[2]) {
  struct geom_point p[3];
  for (int k = 0; k < 3; k++)
    p[k] = (struct geom_point){exact_random_below(r, 1 << 26),
                               exact_random_below(r, 1 << 26),
                               exact_random_below(r, 1 << 30)};
  (void)exact_turn_triangle(p);
  plane[0] = plane_of(p);
  for (int k = 1; k < 3; k++) {
    p[k].x += (1 + k) * (p[k].x - p[0].x);
    p[k].y += (1 + k) * (p[k].y - p[0].y);
    p[k].z += (1 + k) * (p[k].z - p[0].z);
  }
  plane[1] = plane_of(p);
}

static void lines_without_grid_points_have_one_key_too(void **state) {
  uint64_t r = 4, last = 0;
  (void)state;
  for (int i = 0; i < 500; i++) {
    struct geom_plane f[2], g[2];
    struct geom_line line;
    uint64_t key[3];
    draw_plane(&r, f);
    draw_plane(&r, g);
    assert_int_equal(geom_line_between(&line, &f[0], &g[0]), 0);
    assert_false(geom_line_key(&line, &key[0]));
    assert_int_equal(geom_line_between(&line, &f[1], &g[0]), 0);
    assert_false(geom_line_key(&line, &key[1]));
    assert_int_equal(geom_line_between(&line, &g[1], &f[1]), 0);
    assert_false(geom_line_key(&line, &key[2]));
    assert_true(key[0] == key[1] && key[0] == key[2]);
    assert_true(key[0] != last);
    last = key[0];
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(orientation_and_direction_are_signs_of_products),
      cmocka_unit_test(side_is_the_sign_of_the_value),
      cmocka_unit_test(corners_compare_by_x_then_y),
      cmocka_unit_test(corners_round_to_the_nearest_halves_up),
      cmocka_unit_test(a_half_is_rounded_up_also_below_zero),
      cmocka_unit_test(lines_nearly_level_cross_where_they_should),
      cmocka_unit_test(corners_doubles_are_within_a_quarter_unit),
      cmocka_unit_test(wide_lines_hold_the_extremes_of_the_ranges),
      cmocka_unit_test(three_planes_meet_in_one_corner),
      cmocka_unit_test(parallel_planes_have_no_line_but_an_order),
      cmocka_unit_test(a_line_turned_round_has_its_sides_swapped),
      cmocka_unit_test(lines_have_one_key_however_they_are_given),
      cmocka_unit_test(lines_without_grid_points_have_one_key_too),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
