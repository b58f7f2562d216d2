/* test_window.c - Warnock's four classes of faces and his tests of them: worked
 * numbers, and comparison with other methods. */
#include "exact_fixture/sheet.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "visibility/predicate/window.h"

enum { CORNERS_MAX = 8, FAR_OFF = (1 << 30) - 1 };

static enum window_class classify(const struct box2 *window,
                                  const struct geom_point *corner, int count) {
  struct window_counts counts = {0, 0, 0};
  enum window_class class = window_classify(window, corner, count, &counts);
  assert_int_equal(counts.box + counts.sign + counts.angle, 1);
  return class;
}

/* ---- Worked numbers ------------------------------------------------------ */

/* The decision of window_angle_count by the even-odd rule: how often the
 * polygon crosses a ray from the window's lower left corner downwards; where
 * that is even, they are disjoint.  A corner on the ray's line counts as left
 * of it. */
static int ray_count(const struct box2 *window, const struct geom_point *corner,
                     int count) {
  struct geom_point start = {window->x0, window->y0, 0};
  int crossings = 0;
  for (int k = 0; k < count; k++) {
    struct geom_point p = corner[k], q = corner[k + 1 == count ? 0 : k + 1];
    if ((p.x <= start.x) == (q.x <= start.x))
      continue;
    if ((geom_orient2d(p, q, start) > 0) == (p.x < q.x))
      crossings++;
  }
  return crossings;
}

static void a_box_contains_or_is_disjoint_as_listed(void **state) {
  const struct box2 window = {0, 0, 32, 32};
  const struct geom_point right[] = {{36, 8, 0}, {48, 24, 0}, {56, 4, 0}};
  const struct geom_point within[] = {{8, 4, 0}, {12, 24, 0}, {24, 12, 0}};
  (void)state;
  assert_int_equal(window_box_test(&window, right, 3), WINDOW_DISJOINT);
  assert_int_equal(classify(&window, right, 3), WINDOW_DISJOINT);
  assert_int_equal(window_box_test(&window, within, 3), WINDOW_CONTAINED);
  assert_int_equal(classify(&window, within, 3), WINDOW_CONTAINED);
}

/* The line function is a multiple of the one listed. */
static void assert_line_function(const struct box2 *window, struct geom_point p,
                                 struct geom_point q, int64_t times,
                                 const int listed[4]) {
  int64_t value[4];
  window_line_function(window, p, q, value);
  for (int k = 0; k < 4; k++)
    assert_int_equal(value[k], times * listed[k]);
}

static void a_line_function_with_both_signs_intersects(void **state) {
  const struct box2 window = {8, 8, 32, 32};
  const struct geom_point p[] = {{8, 4, 0}, {12, 24, 0}, {40, 12, 0}};
  (void)state;
  /* 4 (y - 5 x + 36) */
  assert_line_function(&window, p[0], p[1], 4, (const int[]){4, 28, -92, -116});
  assert_true(window_meets_edge(&window, p[0], p[1]));
  assert_int_equal(classify(&window, p, 3), WINDOW_INTERSECTING);
}

static void line_functions_of_one_sign_surround(void **state) {
  const struct box2 window = {8, 8, 32, 32};
  const struct geom_point p[] = {
      {4, 4, 0}, {4, 36, 0}, {40, 36, 0}, {32, 4, 0}};
  (void)state;
  assert_line_function(&window, p[0], p[1], -32, (const int[]){4, 4, 28, 28});
  assert_line_function(&window, p[1], p[2], 36,
                       (const int[]){-28, -4, -4, -28});
  assert_line_function(&window, p[2], p[3], -8, (const int[]){100, 124, 28, 4});
  assert_line_function(&window, p[3], p[0], -28, (const int[]){4, 28, 28, 4});
  for (int k = 0; k < 4; k++)
    assert_false(window_meets_edge(&window, p[k], p[(k + 1) % 4]));
  assert_int_equal(window_angle_count(&window, p, 4), -8);
  assert_int_equal(classify(&window, p, 4), WINDOW_SURROUNDING);
}

static void assert_octants(const struct geom_point *corner, int count,
                           const int *octant, const int *difference, int sum) {
  const struct box2 window = {8, 8, 32, 32};
  for (int k = 0; k < count; k++) {
    int next = (k + 1) % count, d = octant[next] - octant[k];
    assert_int_equal(window_octant(&window, corner[k].x, corner[k].y, 0),
                     octant[k]);
    assert_false(window_meets_edge(&window, corner[k], corner[next]));
    assert_int_equal(d > 4 ? d - 8 : d < -4 ? d + 8 : d, difference[k]);
    sum -= difference[k];
  }
  assert_int_equal(sum, 0);
}

static void octants_7_2_3_5_surround(void **state) {
  const struct box2 window = {8, 8, 32, 32};
  const struct geom_point p[] = {
      {50, 4, 0}, {31, 50, 0}, {4, 40, 0}, {4, 4, 0}};
  (void)state;
  assert_octants(p, 4, (const int[]){7, 2, 3, 5}, (const int[]){3, 1, 2, 2}, 8);
  assert_int_equal(window_angle_count(&window, p, 4), 8);
  assert_int_equal(classify(&window, p, 4), WINDOW_SURROUNDING);
}

static void octants_7_1_2_0_6_are_disjoint(void **state) {
  const struct box2 window = {8, 8, 32, 32};
  const struct geom_point p[] = {
      {50, 4, 0}, {40, 40, 0}, {20, 50, 0}, {60, 10, 0}, {31, 0, 0}};
  (void)state;
  assert_octants(p, 5, (const int[]){7, 1, 2, 0, 6},
                 (const int[]){2, 1, -2, -2, 1}, 0);
  assert_int_equal(window_angle_count(&window, p, 5), 0);
  assert_int_equal(classify(&window, p, 5), WINDOW_DISJOINT);
}

static void octants_run_counter_clockwise_from_the_right(void **state) {
  const struct box2 window = {8, 8, 32, 32};
  static const int at[9][3] = {{33, 20, 0}, {33, 33, 1}, {20, 33, 2},
                               {7, 33, 3},  {7, 20, 4},  {7, 7, 5},
                               {20, 7, 6},  {33, 7, 7},  {20, 20, -1}};
  (void)state;
  for (int i = 0; i < 9; i++)
    assert_int_equal(window_octant(&window, at[i][0], at[i][1], 0), at[i][2]);
  assert_int_equal(window_octant(&window, 8, 32, 0), -1);
  assert_int_equal(window_octant(&window, 32, 33, 0), 2);
}

/* ---- The ambiguous case -------------------------------------------------- */

/* A point turned about the window's middle by quarters, for a window that is a
 * square about the origin. */
static struct geom_point turn(struct geom_point p, int quarters) {
  for (; quarters > 0; quarters--)
    p = (struct geom_point){-p.y, p.x, 0};
  return p;
}

static void assert_counts(const struct box2 *window, const struct geom_point *p,
                          int want) {
  const struct geom_point back[] = {p[2], p[1], p[0]};
  assert_int_equal(window_angle_count(window, p, 3), want);
  assert_int_equal(window_angle_count(window, back, 3), -want);
  assert_int_equal(ray_count(window, p, 3) % 2, want != 0);
}

/* An edge from the lower left to the upper right field passes the window on its
 * lower right; the third corner says on which side the window is. */
static void a_difference_of_4_is_split(void **state) {
  const struct box2 window = {-12, -12, 12, 12};
  (void)state;
  for (int quarter = 0; quarter < 4; quarter++) {
    const struct geom_point p = turn((struct geom_point){-20, -40, 0}, quarter);
    const struct geom_point q = turn((struct geom_point){80, 40, 0}, quarter);
    const struct geom_point upper =
        turn((struct geom_point){-40, 60, 0}, quarter);
    const struct geom_point lower =
        turn((struct geom_point){80, -40, 0}, quarter);
    assert_int_equal(abs(window_octant(&window, p.x, p.y, 0) -
                         window_octant(&window, q.x, q.y, 0)),
                     4);
    assert_false(window_meets_edge(&window, p, q));
    assert_counts(&window, (const struct geom_point[]){p, q, upper}, 8);
    assert_counts(&window, (const struct geom_point[]){q, p, lower}, 0);
  }
}

/* Edges as long as the grid, which pass a window of two units by a unit: halves
 * are ambiguous over and over. */
static void long_edges_past_small_windows_are_split_often(void **state) {
  const struct box2 window = {-1, -1, 1, 1};
  uint64_t seed = 5;
  (void)state;
  for (int round = 0; round < 2000; round++) {
    int quarter = round % 4,
        near = 2 + exact_random_below(&seed, 1 << (round % 29));
    int far = FAR_OFF - 4 - exact_random_below(&seed, 1 << 28);
    const struct geom_point p =
        turn((struct geom_point){-far, -far - 3, 0}, quarter);
    const struct geom_point q =
        turn((struct geom_point){near + 3, near, 0}, quarter);
    const struct geom_point upper =
        turn((struct geom_point){-FAR_OFF, FAR_OFF, 0}, quarter);
    const struct geom_point lower =
        turn((struct geom_point){FAR_OFF, -FAR_OFF, 0}, quarter);
    assert_false(window_meets_edge(&window, p, q));
    assert_counts(&window, (const struct geom_point[]){p, q, upper}, 8);
    assert_counts(&window, (const struct geom_point[]){q, p, lower}, 0);
  }
}

/* ---- Other ways of asking ------------------------------------------------ */

static bool is_inside(const struct box2 *w, struct geom_point p) {
  return p.x >= w->x0 && p.x <= w->x1 && p.y >= w->y0 && p.y <= w->y1;
}

static bool lies_between(struct geom_point a, struct geom_point b,
                         struct geom_point p) {
  return geom_orient2d(a, b, p) == 0 &&
         (p.x - a.x) * (int64_t)(p.x - b.x) <= 0 &&
         (p.y - a.y) * (int64_t)(p.y - b.y) <= 0;
}

static bool segments_meet(struct geom_point a, struct geom_point b,
                          struct geom_point c, struct geom_point d) {
  int abc = geom_sign64(geom_orient2d(a, b, c));
  int abd = geom_sign64(geom_orient2d(a, b, d));
  int cda = geom_sign64(geom_orient2d(c, d, a));
  int cdb = geom_sign64(geom_orient2d(c, d, b));
  return (abc * abd < 0 && cda * cdb < 0) || lies_between(a, b, c) ||
         lies_between(a, b, d) || lies_between(c, d, a) ||
         lies_between(c, d, b);
}

/* By the window's four sides. */
static bool edge_meets(const struct box2 *w, struct geom_point p,
                       struct geom_point q) {
  const struct geom_point c[] = {{w->x0, w->y0, 0},
                                 {w->x1, w->y0, 0},
                                 {w->x1, w->y1, 0},
                                 {w->x0, w->y1, 0}};
  bool meets = is_inside(w, p) || is_inside(w, q);
  for (int k = 0; k < 4; k++)
    meets |= segments_meet(p, q, c[k], c[(k + 1) % 4]);
  return meets;
}

/* How often the polygon runs round the window's middle, counter-clockwise: by
 * signed crossings of a ray to the right, all in half units. */
static int winding(const struct box2 *w, const struct geom_point *corner,
                   int count) {
  struct geom_point middle = {w->x0 + w->x1, w->y0 + w->y1, 0};
  int turns = 0;
  for (int k = 0; k < count; k++) {
    struct geom_point p = corner[k], q = corner[(k + 1) % count];
    p = (struct geom_point){2 * p.x, 2 * p.y, 0};
    q = (struct geom_point){2 * q.x, 2 * q.y, 0};
    if ((p.y <= middle.y) == (q.y <= middle.y))
      continue;
    if (p.y < q.y && geom_orient2d(p, q, middle) > 0)
      turns++;
    if (p.y > q.y && geom_orient2d(p, q, middle) < 0)
      turns--;
  }
  return turns;
}

/* A polygon on a lattice that may cross itself, and a window: anywhere, or
 * small and in the middle, where polygons run round it. */
static int random_case(uint64_t *seed, struct box2 *window,
                       struct geom_point *corner) {
  int lattice = 4 + exact_random_below(seed, 40),
      count = 3 + exact_random_below(seed, 6);
  if (exact_random_below(seed, 2) == 0) {
    window->x0 = exact_random_below(seed, lattice) - 2;
    window->y0 = exact_random_below(seed, lattice) - 2;
    window->x1 = window->x0 + 1 + exact_random_below(seed, lattice);
    window->y1 = window->y0 + 1 + exact_random_below(seed, lattice);
  } else {
    window->x0 = window->y0 = lattice / 2 - 1;
    window->x1 = window->y1 = lattice / 2;
  }
  for (int k = 0; k < count; k++)
    corner[k] = (struct geom_point){exact_random_below(seed, lattice),
                                    exact_random_below(seed, lattice), 0};
  return count;
}

static bool outline_meets(const struct box2 *window,
                          const struct geom_point *corner, int count) {
  bool meets = false;
  for (int k = 0; k < count; k++)
    meets |= edge_meets(window, corner[k], corner[(k + 1) % count]);
  return meets;
}

static void the_sign_test_finds_the_edges_that_meet(void **state) {
  uint64_t seed = 1;
  int met = 0;
  (void)state;
  for (int round = 0; round < 60000; round++) {
    struct box2 window;
    struct geom_point p[CORNERS_MAX];
    random_case(&seed, &window, p);
    assert_int_equal(window_meets_edge(&window, p[0], p[1]),
                     edge_meets(&window, p[0], p[1]));
    met += edge_meets(&window, p[0], p[1]);
  }
  assert_in_range(met, 5000, 55000);
}

static void angles_count_how_often_a_polygon_surrounds(void **state) {
  uint64_t seed = 2;
  int times[4] = {0};
  (void)state;
  for (int round = 0; round < 100000; round++) {
    struct box2 window;
    struct geom_point p[CORNERS_MAX];
    int count = random_case(&seed, &window, p), turns;
    if (outline_meets(&window, p, count))
      continue;
    turns = winding(&window, p, count);
    times[abs(turns)]++;
    assert_int_equal(window_angle_count(&window, p, count), 8 * turns);
  }
  assert_true(times[0] > 10000 && times[1] > 1000 && times[2] > 100);
}

static void rays_and_angles_agree(void **state) {
  uint64_t seed = 3;
  int odd = 0;
  (void)state;
  for (int round = 0; round < 100000; round++) {
    struct box2 window;
    struct geom_point p[CORNERS_MAX];
    int count = random_case(&seed, &window, p), crossings;
    if (outline_meets(&window, p, count))
      continue;
    crossings = ray_count(&window, p, count);
    odd += crossings % 2;
    assert_int_equal(crossings % 2,
                     abs(window_angle_count(&window, p, count)) / 8 % 2);
  }
  assert_true(odd > 1000);
}

static void classes_are_those_of_the_definition(void **state) {
  uint64_t seed = 4;
  int met[4] = {0};
  (void)state;
  for (int round = 0; round < 100000; round++) {
    struct box2 window;
    struct geom_point p[CORNERS_MAX];
    int count = random_case(&seed, &window, p), inside = 0;
    enum window_class want;
    for (int k = 0; k < count; k++)
      inside += is_inside(&window, p[k]);
    want = inside == count                    ? WINDOW_CONTAINED
           : outline_meets(&window, p, count) ? WINDOW_INTERSECTING
           : winding(&window, p, count) == 0  ? WINDOW_DISJOINT
                                              : WINDOW_SURROUNDING;
    met[want]++;
    assert_int_equal(classify(&window, p, count), want);
  }
  for (int class = 0; class < 4; class ++)
    assert_true(met[class] > 400);
}

static void what_touches_the_window_intersects_it(void **state) {
  const struct box2 window = {0, 0, 10, 10};
  const struct geom_point corner[] = {{10, 10, 0}, {20, 10, 0}, {20, 20, 0}};
  const struct geom_point side[] = {{10, 2, 0}, {20, 2, 0}, {10, 8, 0}};
  const struct geom_point diagonal[] = {{5, 15, 0}, {15, 5, 0}, {20, 20, 0}};
  const struct geom_point apart[] = {{5, 16, 0}, {15, 6, 0}, {20, 20, 0}};
  const struct geom_point same[] = {
      {0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  (void)state;
  assert_int_equal(classify(&window, corner, 3), WINDOW_INTERSECTING);
  assert_int_equal(classify(&window, side, 3), WINDOW_INTERSECTING);
  assert_int_equal(classify(&window, diagonal, 3), WINDOW_INTERSECTING);
  assert_int_equal(classify(&window, apart, 3), WINDOW_DISJOINT);
  assert_int_equal(classify(&window, same, 4), WINDOW_CONTAINED);
}

/* ---- Clipping ------------------------------------------------------------ */

/* Is the point p + t (q - p) inside? */
static bool is_inside_at(const struct box2 *w, struct geom_point p,
                         struct geom_point q, struct ratio t) {
  int128 x = p.x * t.den + ((int64_t)q.x - p.x) * t.num;
  int128 y = p.y * t.den + ((int64_t)q.y - p.y) * t.num;
  return x >= w->x0 * t.den && x <= w->x1 * t.den && y >= w->y0 * t.den &&
         y <= w->y1 * t.den;
}

/* The part kept begins and ends inside, and a little further on is outside. */
static void assert_clipped(const struct box2 *window, struct geom_point p,
                           struct geom_point q) {
  struct ratio from, to, zero = ratio_of(0, 1), one = ratio_of(1, 1);
  bool kept = window_clip(window, p, q, &from, &to);
  assert_int_equal(kept, edge_meets(window, p, q));
  if (!kept)
    return;
  assert_true(ratio_compare(from, to) <= 0);
  assert_true(ratio_compare(zero, from) <= 0 && ratio_compare(to, one) <= 0);
  assert_true(is_inside_at(window, p, q, from));
  assert_true(is_inside_at(window, p, q, to));
  if (ratio_compare(from, zero) > 0) {
    struct ratio before = {from.num * 4095, from.den * 4096};
    assert_false(is_inside_at(window, p, q, before));
  }
  if (ratio_compare(to, one) < 0) {
    struct ratio past = {to.num * 4095 + to.den, to.den * 4096};
    assert_false(is_inside_at(window, p, q, past));
  }
}

static void clipping_keeps_what_is_inside_and_no_less(void **state) {
  uint64_t seed = 6;
  (void)state;
  for (int round = 0; round < 40000; round++) {
    struct box2 window;
    struct geom_point p[CORNERS_MAX];
    random_case(&seed, &window, p);
    assert_clipped(&window, p[0], p[1]);
  }
}

/* ---- Cutting ------------------------------------------------------------- */

static void cuts_are_at_a_box_but_cut_no_slivers_off(void **state) {
  (void)state;
  assert_int_equal(window_split(0, 100, 30, 60), 60);
  assert_int_equal(window_split(0, 100, 45, 60), 45);
  assert_int_equal(window_split(0, 100, 40, 60), 40);
  assert_int_equal(window_split(0, 100, 25, 99), 25);
  assert_int_equal(window_split(0, 100, 24, 99), 50);
  assert_int_equal(window_split(0, 100, -7, 300), 50);
  assert_int_equal(window_split(-100, 0, -200, -75), -75);
  assert_int_equal(window_split(-FAR_OFF, FAR_OFF, -FAR_OFF, FAR_OFF), 0);
  for (int32_t low = -12; low < 24; low++)
    for (int32_t width = 0; width < 24; width++)
      for (int32_t past = 2; past < 12; past++) {
        int32_t cut = window_split(0, past, low, low + width);
        assert_true(4 * cut >= past - 1 && 4 * (past - cut) >= past);
      }
}

/* ---- Range --------------------------------------------------------------- */

static void the_ends_of_the_grid_are_no_harder(void **state) {
  const struct box2 page = {-FAR_OFF, -FAR_OFF, FAR_OFF, FAR_OFF};
  const struct box2 corner = {FAR_OFF - 1, FAR_OFF - 1, FAR_OFF, FAR_OFF};
  const struct geom_point low = {-FAR_OFF, -FAR_OFF, 0};
  const struct geom_point right = {FAR_OFF, -FAR_OFF, 0};
  const struct geom_point high = {FAR_OFF, FAR_OFF, 0};
  const struct geom_point p[] = {low, right, high};
  (void)state;
  assert_int_equal(classify(&page, p, 3), WINDOW_CONTAINED);
  assert_int_equal(classify(&corner, p, 3), WINDOW_INTERSECTING);
  assert_true(window_meets_edge(&corner, low, high));
  assert_false(window_meets_edge(&corner, low, right));
  assert_clipped(&page, low, high);
  assert_clipped(&corner, low, high);
  assert_clipped(&corner, low, right);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_box_contains_or_is_disjoint_as_listed),
      cmocka_unit_test(a_line_function_with_both_signs_intersects),
      cmocka_unit_test(line_functions_of_one_sign_surround),
      cmocka_unit_test(octants_7_2_3_5_surround),
      cmocka_unit_test(octants_7_1_2_0_6_are_disjoint),
      cmocka_unit_test(octants_run_counter_clockwise_from_the_right),
      cmocka_unit_test(a_difference_of_4_is_split),
      cmocka_unit_test(long_edges_past_small_windows_are_split_often),
      cmocka_unit_test(the_sign_test_finds_the_edges_that_meet),
      cmocka_unit_test(angles_count_how_often_a_polygon_surrounds),
      cmocka_unit_test(rays_and_angles_agree),
      cmocka_unit_test(classes_are_those_of_the_definition),
      cmocka_unit_test(what_touches_the_window_intersects_it),
      cmocka_unit_test(clipping_keeps_what_is_inside_and_no_less),
      cmocka_unit_test(cuts_are_at_a_box_but_cut_no_slivers_off),
      cmocka_unit_test(the_ends_of_the_grid_are_no_harder),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
