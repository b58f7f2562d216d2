/* test_triangulate.c - triangles cover a polygon, once and exactly.
 *
 * Polygons are made on whole numbers, where areas are exact.  If every side of
 * the polygon is the side of one triangle, every diagonal of two that run
 * along it in opposite directions, and all triangles have positive areas, then
 * they cover a simple polygon exactly once. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/exact.h"
#include "scene/triangulation/reflex_tree.h"
#include "scene/triangulation/triangulate.h"
#include "tests/memory_faults.h"
#include "tests/scenes/random.h"

enum { MOST = 2048 };

/* A polygon on whole numbers. */
struct flat {
  int64_t x[MOST], y[MOST];
  uint32_t count;
};

static void put(struct flat *flat, int64_t x, int64_t y) {
  assert_true(flat->count < MOST);
  flat->x[flat->count] = x;
  flat->y[flat->count++] = y;
}

static int64_t turn(const struct flat *p, uint32_t a, uint32_t b, uint32_t c) {
  return (p->x[b] - p->x[a]) * (p->y[c] - p->y[a]) -
         (p->y[b] - p->y[a]) * (p->x[c] - p->x[a]);
}

static int64_t area_of(const struct flat *p) {
  int64_t area = 0;
  for (uint32_t c = 1; c + 1 < p->count; c++)
    area += turn(p, 0, c, c + 1);
  return area;
}

/* ---- The polygon in space ------------------------------------------------ */

enum pose { POSE_XY, POSE_YZ, POSE_ZX, POSE_TILTED, POSE_COUNT };

static struct scene_point posed_point(double x, double y, enum pose pose) {
  switch (pose) {
  case POSE_XY:
    return (struct scene_point){x, y, 5};
  case POSE_YZ:
    return (struct scene_point){-7, x, y};
  case POSE_ZX:
    return (struct scene_point){y, 0, x};
  default:
    return (struct scene_point){x + 3 * y, 2 * y - x, 5 * x + y};
  }
}

static bool cut(struct triangulation *t, const struct flat *p, enum pose pose) {
  static struct scene_point point[MOST];
  static uint32_t corner[MOST];
  for (uint32_t c = 0; c < p->count; c++) {
    corner[c] = p->count - 1 - c; /* indices are not places */
    point[corner[c]] = posed_point((double)p->x[c], (double)p->y[c], pose);
  }
  return triangulate(t, point, corner, p->count);
}

/* Where corner c of a polygon is, as one number: -1 - c where all corners are
 * known to be apart. */
static int64_t place_number(const struct flat *p, uint32_t c) {
  return p ? p->x[c] * 0x100000 + p->y[c] : -1 - (int64_t)c;
}

/* Whether one side runs between the positions of another, in either
 * direction. */
static bool run_alike(const struct flat *p, uint32_t a, uint32_t b, uint32_t c,
                      uint32_t d) {
  int64_t one = place_number(p, a), two = place_number(p, b);
  int64_t three = place_number(p, c), four = place_number(p, d);
  return (one == three && two == four) || (one == four && two == three);
}

/* How many times the triangles run from one place to another, less the times
 * that they run back, and less those that the polygon does. */
static int sum_along(const struct triangulation *t, const struct flat *p,
                     uint32_t count, uint32_t a, uint32_t b) {
  int64_t from = place_number(p, a), to = place_number(p, b);
  int sum = 0;
  for (size_t i = 0; i < 3 * t->triangle.count; i++) {
    const uint32_t *corner = t->triangle.item[i / 3].corner;
    int64_t one = place_number(p, corner[i % 3]);
    int64_t two = place_number(p, corner[(i + 1) % 3]);
    sum += (one == from && two == to) - (one == to && two == from);
  }
  for (uint32_t c = 0; c < count; c++) {
    int64_t one = place_number(p, c), two = place_number(p, (c + 1) % count);
    sum -= (one == from && two == to) - (one == to && two == from);
  }
  return sum;
}

/* Whether the sides fit together, whatever the areas are: what the triangles
 * run along adds up to the polygon, and each side is where its name says. */
static void check_sides(const struct triangulation *t, const struct flat *p,
                        uint32_t count) {
  uint32_t sides = 2 * count;
  uint8_t *uses = calloc(sides, 1);
  uint32_t(*ends)[2] = calloc(sides, sizeof *ends);
  assert_true(t->triangle.count <= count - 2);
  for (uint32_t c = 0; c < count; c++) {
    ends[c][0] = c;
    ends[c][1] = (c + 1) % count;
    uses[c] = 1;
  }
  for (size_t i = 0; i < t->triangle.count; i++) {
    const struct triangulation_triangle *one = &t->triangle.item[i];
    for (int k = 0; k < 3; k++) {
      uint32_t from = one->corner[k], to = one->corner[(k + 1) % 3];
      uint32_t side = one->side[k];
      assert_true(from < count && to < count && side < sides);
      assert_true(place_number(p, from) != place_number(p, to));
      if (uses[side]++ == 0) {
        ends[side][0] = from;
        ends[side][1] = to;
      }
      assert_true(run_alike(p, from, to, ends[side][0], ends[side][1]));
      if (count < 32 || i == 0)
        assert_int_equal(sum_along(t, p, count, from, to), 0);
    }
  }
  if (t->triangle.count == count - 2)
    for (uint32_t side = 0; side < 2 * count - 3; side++)
      assert_int_equal(uses[side], 2);
  free(uses);
  free(ends);
}

/* Checks the cover of a polygon by so many triangles. */
static void check_areas(const struct flat *p, size_t triangles) {
  struct triangulation t = {0};
  int64_t whole = area_of(p);
  assert_true(whole != 0);
  for (int pose = 0; pose < POSE_COUNT; pose++) {
    assert_true(cut(&t, p, (enum pose)pose));
    check_sides(&t, p, p->count);
    assert_int_equal(t.triangle.count, triangles);
    assert_false(t.warped);
    int64_t sum = 0;
    for (size_t i = 0; i < t.triangle.count; i++) {
      const uint32_t *c = t.triangle.item[i].corner;
      int64_t area = turn(p, c[0], c[1], c[2]);
      assert_true(whole > 0 ? area > 0 : area < 0);
      sum += area;
    }
    assert_int_equal(sum, whole);
  }
  triangulation_fini(&t);
}

static void check_cover(const struct flat *p) { check_areas(p, p->count - 2); }

static void reverse(struct flat *p) {
  for (uint32_t a = 0, b = p->count - 1; a < b; a++, b--) {
    int64_t x = p->x[a], y = p->y[a];
    p->x[a] = p->x[b];
    p->y[a] = p->y[b];
    p->x[b] = x;
    p->y[b] = y;
  }
}

/* Starts at another corner. */
static void rotate(struct flat *p) {
  int64_t x = p->x[0], y = p->y[0];
  memmove(p->x, p->x + 1, (p->count - 1) * sizeof *p->x);
  memmove(p->y, p->y + 1, (p->count - 1) * sizeof *p->y);
  p->x[p->count - 1] = x;
  p->y[p->count - 1] = y;
}

/* From every corner and in both directions, for small ones. */
static void check_all_ways(struct flat *p) {
  uint32_t starts = p->count < 16 ? p->count : 1;
  for (int direction = 0; direction < 2; direction++) {
    for (uint32_t start = 0; start < starts; start++) {
      check_cover(p);
      rotate(p);
    }
    reverse(p);
  }
}

static void from_list(struct flat *p, const int *xy, uint32_t count) {
  p->count = 0;
  for (uint32_t c = 0; c < count; c++)
    put(p, xy[2 * c], xy[2 * c + 1]);
}

#define SET(p, ...)                                                            \
  do {                                                                         \
    static const int list[] = {__VA_ARGS__};                                   \
    from_list((p), list, sizeof list / sizeof *list / 2);                      \
  } while (0)

/* ---- Simple polygons ----------------------------------------------------- */

static void triangles_and_quadrilaterals_are_covered(void **state) {
  (void)state;
  struct flat *p = calloc(1, sizeof *p);
  SET(p, 0, 0, 4, 0, 1, 3);
  check_all_ways(p);
  SET(p, 0, 0, 4, 0, 4, 3, 0, 3);
  check_all_ways(p);
  SET(p, 0, 0, 4, 0, 1, 1, 0, 4); /* concave */
  check_all_ways(p);
  SET(p, 0, 0, 4, 0, 8, 0, 4, 4); /* a corner on a side */
  check_all_ways(p);
  free(p);
}

static void corners_on_straight_sides_never_make_empty_triangles(void **state) {
  (void)state;
  struct flat *p = calloc(1, sizeof *p);
  SET(p, 0, 0, 1, 0, 2, 0, 3, 0, 3, 1, 3, 2, 3, 3, 2, 3, 1, 3, 0, 3, 0, 2, 0,
      1);
  check_all_ways(p);
  SET(p, 0, 0, 3, 0, 6, 0, 4, 2, 2, 4, 0, 6, 0, 3); /* a triangle with them */
  check_all_ways(p);
  SET(p, 0, 0, 2, 0, 4, 0, 4, 2, 2, 2, 2, 4, 0, 4, 0, 2); /* an L */
  check_all_ways(p);
  free(p);
}

static void combs_and_spirals_are_covered(void **state) {
  (void)state;
  struct flat *p = calloc(1, sizeof *p);
  for (int64_t tooth = 0; tooth < 200; tooth++) {
    put(p, 2 * tooth, tooth % 3 + 1);
    put(p, 2 * tooth + 1, 100 + tooth % 7);
  }
  put(p, 400, 0);
  put(p, 400, -1);
  put(p, 0, -1);
  check_all_ways(p);
  p->count = 0;
  for (int64_t turn_no = 0; turn_no < 30; turn_no++) {
    int64_t r = 10 * (turn_no + 1);
    put(p, -r, -r);
    put(p, r, -r);
    put(p, r, r);
    put(p, -r - 10, r);
  }
  for (int64_t turn_no = 29; turn_no >= 0; turn_no--) {
    int64_t r = 10 * (turn_no + 1) - 5;
    put(p, -r - 10, r);
    put(p, r, r);
    put(p, r, -r);
    if (turn_no > 0)
      put(p, -r, -r);
  }
  check_all_ways(p);
  free(p);
}

/* No corner of a convex polygon is in more than a few triangles for each time
 * that it can be halved. */
static void a_large_disc_is_no_fan(void **state) {
  (void)state;
  struct flat *p = calloc(1, sizeof *p);
  for (int64_t i = -500; i < 500; i++) /* a parabola is strictly convex */
    put(p, i, i * i);
  check_all_ways(p);
  struct triangulation t = {0};
  assert_true(cut(&t, p, POSE_TILTED));
  unsigned uses[1000] = {0};
  for (size_t i = 0; i < t.triangle.count; i++)
    for (int k = 0; k < 3; k++)
      uses[t.triangle.item[i].corner[k]]++;
  for (size_t c = 0; c < p->count; c++)
    assert_in_range(uses[c], 1, 2 * 10 + 1);
  triangulation_fini(&t);
  free(p);
}

/* Every corner turns left, and yet no fan covers it. */
static void
a_star_that_goes_around_twice_is_not_taken_for_convex(void **state) {
  (void)state;
  struct flat *p = calloc(1, sizeof *p);
  SET(p, 0, 100, -59, -81, 95, 31, -95, 31, 59, -81);
  struct triangulation t = {0};
  assert_true(cut(&t, p, POSE_XY));
  check_sides(&t, NULL, 5);
  bool from_0 = true;
  for (size_t i = 0; i < 3; i++)
    from_0 = from_0 && t.triangle.item[i].corner[0] == 0 &&
             t.triangle.item[i].corner[1] == i + 1;
  assert_false(from_0);
  triangulation_fini(&t);
  free(p);
}

/* ---- Random simple polygons ---------------------------------------------- */

static int64_t turn_of(int64_t ax, int64_t ay, int64_t bx, int64_t by,
                       int64_t cx, int64_t cy) {
  return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
}

static bool in_box(int64_t ax, int64_t ay, int64_t bx, int64_t by, int64_t x,
                   int64_t y) {
  return (ax < bx ? ax <= x && x <= bx : bx <= x && x <= ax) &&
         (ay < by ? ay <= y && y <= by : by <= y && y <= ay);
}

/* Whether two closed segments have a point in common. */
static bool meet(int64_t ax, int64_t ay, int64_t bx, int64_t by, int64_t cx,
                 int64_t cy, int64_t dx, int64_t dy) {
  int64_t c = turn_of(ax, ay, bx, by, cx, cy);
  int64_t d = turn_of(ax, ay, bx, by, dx, dy);
  int64_t a = turn_of(cx, cy, dx, dy, ax, ay);
  int64_t b = turn_of(cx, cy, dx, dy, bx, by);
  if ((c > 0) != (d > 0) && (a > 0) != (b > 0) && c && d && a && b)
    return true;
  return (c == 0 && in_box(ax, ay, bx, by, cx, cy)) ||
         (d == 0 && in_box(ax, ay, bx, by, dx, dy)) ||
         (a == 0 && in_box(cx, cy, dx, dy, ax, ay)) ||
         (b == 0 && in_box(cx, cy, dx, dy, bx, by));
}

/* Whether (x, y) may go between corner c and the next: neither of the two new
 * sides meets another side but at its own ends. */
static bool may_insert(const struct flat *p, uint32_t c, int64_t x, int64_t y) {
  uint32_t n = (c + 1) % p->count;
  if (turn_of(p->x[c], p->y[c], p->x[n], p->y[n], x, y) == 0)
    return in_box(p->x[c], p->y[c], p->x[n], p->y[n], x, y) &&
           (x != p->x[c] || y != p->y[c]) && (x != p->x[n] || y != p->y[n]);
  for (uint32_t i = 0; i < p->count; i++) {
    uint32_t j = (i + 1) % p->count;
    if (i == c)
      continue;
    bool before = j == c, after = i == n;
    if (!after &&
        meet(p->x[i], p->y[i], p->x[j], p->y[j], x, y, p->x[n], p->y[n]))
      return false;
    if (!before &&
        meet(p->x[i], p->y[i], p->x[j], p->y[j], p->x[c], p->y[c], x, y))
      return false;
    /* A neighbouring side may be touched at the common corner alone. */
    if (before && (turn_of(x, y, p->x[c], p->y[c], p->x[i], p->y[i]) == 0 ||
                   in_box(x, y, x, y, p->x[i], p->y[i])))
      return false;
    if (after && turn_of(x, y, p->x[n], p->y[n], p->x[j], p->y[j]) == 0)
      return false;
  }
  return true;
}

static void grow(struct flat *p, struct random *random, uint32_t count,
                 int size) {
  p->count = 0;
  do {
    p->count = 0;
    for (int k = 0; k < 3; k++)
      put(p, random_int(random, 0, size), random_int(random, 0, size));
  } while (area_of(p) == 0);
  for (int tries = 0; p->count < count && tries < 4000; tries++) {
    int64_t x = random_int(random, 0, size), y = random_int(random, 0, size);
    uint32_t c = random_below(random, p->count);
    if (!may_insert(p, c, x, y))
      continue;
    memmove(p->x + c + 2, p->x + c + 1, (p->count - c - 1) * sizeof *p->x);
    memmove(p->y + c + 2, p->y + c + 1, (p->count - c - 1) * sizeof *p->y);
    p->x[c + 1] = x;
    p->y[c + 1] = y;
    p->count++;
  }
}

static void random_simple_polygons_are_covered(void **state) {
  (void)state;
  struct flat *p = calloc(1, sizeof *p);
  struct random random = {7};
  for (int i = 0; i < 1500; i++) {
    grow(p, &random, 4 + random_below(&random, 12), 3 + i % 20);
    check_cover(p);
    reverse(p);
    check_cover(p);
  }
  for (int i = 0; i < 20; i++) {
    grow(p, &random, 120, 40);
    check_cover(p);
  }
  free(p);
}

/* ---- Bridges to holes ---------------------------------------------------- */

static void a_hole_on_a_bridge_stays_open(void **state) {
  (void)state;
  struct flat *p = calloc(1, sizeof *p);
  SET(p, 0, 0, 9, 0, 9, 9, 0, 9, 0, 0, 3, 3, 3, 6, 6, 6, 6, 3, 3, 3);
  check_all_ways(p);
  /* Two holes, one bridge from the other. */
  SET(p, 0, 0, 20, 0, 20, 9, 0, 9, 0, 0, 3, 3, 3, 6, 6, 6, 12, 4, 12, 6, 15, 6,
      15, 3, 12, 4, 6, 6, 6, 3, 3, 3);
  check_all_ways(p);
  free(p);
}

/* Two squares need but four triangles, and their polygon has eight corners. */
static void loops_that_touch_at_a_corner_are_covered(void **state) {
  (void)state;
  struct flat *p = calloc(1, sizeof *p);
  SET(p, 0, 0, 4, 0, 4, 4, 8, 4, 8, 8, 4, 8, 4, 4, 0, 4);
  for (uint32_t start = 0; start < 8; start++) {
    check_areas(p, 4);
    rotate(p);
  }
  free(p);
}

/* ---- What is not simple -------------------------------------------------- */

static void check_ends(const struct flat *p) {
  struct triangulation a = {0}, b = {0};
  for (int pose = 0; pose < POSE_COUNT; pose++) {
    assert_true(cut(&a, p, (enum pose)pose));
    check_sides(&a, p, p->count);
    assert_true(cut(&b, p, (enum pose)pose));
    assert_memory_equal(a.triangle.item, b.triangle.item,
                        a.triangle.count * sizeof *a.triangle.item);
  }
  triangulation_fini(&a);
  triangulation_fini(&b);
}

static void crossing_and_empty_polygons_end(void **state) {
  (void)state;
  struct flat *p = calloc(1, sizeof *p);
  SET(p, 0, 0, 4, 4, 4, 0, 0, 4); /* a bow-tie */
  check_ends(p);
  SET(p, 0, 0, 1, 0, 2, 0, 3, 0, 4, 0); /* a line */
  check_ends(p);
  SET(p, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 0); /* to and fro */
  check_ends(p);
  SET(p, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1); /* a point */
  check_ends(p);
  SET(p, 0, 0, 4, 0, 9, 0, 4, 0, 4, 4, 0, 4); /* a spike */
  check_ends(p);
  SET(p, 0, 0, 4, 0, 4, 4, 0, 4, 0, 0, 4, 0, 4, 4, 0, 4); /* around twice */
  check_ends(p);
  free(p);
}

static void random_tangles_finish(void **state) {
  (void)state;
  struct flat *p = calloc(1, sizeof *p);
  struct random random = {11};
  for (int i = 0; i < 3000; i++) {
    uint32_t count = 3 + random_below(&random, 20);
    int size = random_int(&random, 1, 12);
    p->count = 0;
    while (p->count < count)
      put(p, random_int(&random, 0, size), random_int(&random, 0, size));
    check_ends(p);
  }
  free(p);
}

/* ---- Exactness ----------------------------------------------------------- */

/* A corner some units in the last place off a straight side, up or down: no
 * triangle may have the wrong winding, not even by that little. */
static void turns_of_one_last_place_are_seen(void **state) {
  (void)state;
  double y = 0.7 / 3;
  int convex = 0, reflex = 0;
  for (int i = 0; i < 8; i++)
    y = nextafter(y, -1);
  for (int i = 0; i < 16; i++, y = nextafter(y, 1)) {
    const double flat[5][2] = {
        {0, 0}, {0.7, y}, {1, 1.0 / 3}, {0.9, 8}, {0.1, 8}};
    struct scene_point point[5];
    const uint32_t corner[] = {0, 1, 2, 3, 4};
    for (int c = 0; c < 5; c++)
      point[c] = (struct scene_point){flat[c][0], flat[c][1], 0};
    convex += exact_orient2d(flat[0], flat[1], flat[2]) > 0;
    reflex += exact_orient2d(flat[0], flat[1], flat[2]) < 0;
    struct triangulation t = {0};
    assert_true(triangulate(&t, point, corner, 5));
    check_sides(&t, NULL, 5);
    for (size_t k = 0; k < 3; k++) {
      const uint32_t *c = t.triangle.item[k].corner;
      assert_true(exact_orient2d(flat[c[0]], flat[c[1]], flat[c[2]]) > 0);
    }
    triangulation_fini(&t);
  }
  assert_true(convex > 0 && reflex > 0);
}

static void powers_of_two_change_nothing(void **state) {
  (void)state;
  struct flat *p = calloc(1, sizeof *p);
  struct random random = {13};
  for (int i = 0; i < 100; i++) {
    struct scene_point point[16], scaled[16];
    uint32_t corner[16];
    grow(p, &random, 5 + random_below(&random, 10), 30);
    for (uint32_t c = 0; c < p->count; c++) {
      corner[c] = c;
      point[c] = posed_point((double)p->x[c], (double)p->y[c], POSE_TILTED);
    }
    struct triangulation a = {0}, b = {0};
    assert_true(triangulate(&a, point, corner, p->count));
    for (int exponent = -400; exponent <= 400; exponent += 160) {
      for (uint32_t c = 0; c < p->count; c++)
        scaled[c] = (struct scene_point){ldexp(point[c].x, exponent),
                                         ldexp(point[c].y, exponent),
                                         ldexp(point[c].z, exponent)};
      assert_true(triangulate(&b, scaled, corner, p->count));
      assert_int_equal(a.triangle.count, b.triangle.count);
      assert_memory_equal(a.triangle.item, b.triangle.item,
                          a.triangle.count * sizeof *a.triangle.item);
      assert_int_equal(a.warped, b.warped);
    }
    triangulation_fini(&a);
    triangulation_fini(&b);
  }
  free(p);
}

/* ---- Quadrilaterals ------------------------------------------------------ */

static bool has_diagonal_from_0(const struct scene_point point[4],
                                bool *warped) {
  const uint32_t corner[] = {0, 1, 2, 3};
  struct triangulation t = {0};
  assert_true(triangulate(&t, point, corner, 4));
  check_sides(&t, NULL, 4);
  uint32_t twice = 0;
  for (int k = 0; k < 3; k++)
    for (int j = 0; j < 3; j++)
      if (t.triangle.item[0].corner[k] == t.triangle.item[1].corner[j])
        twice |= 1U << t.triangle.item[0].corner[k];
  *warped = t.warped;
  triangulation_fini(&t);
  assert_true(twice == 5 || twice == 10);
  return twice == 5;
}

static void the_shorter_diagonal_cuts_a_quadrilateral(void **state) {
  (void)state;
  bool warped;
  const struct scene_point wide[] = {
      {-9, 0, 0}, {0, -1, 0}, {9, 0, 0}, {0, 1, 0}};
  const struct scene_point high[] = {
      {-1, 0, 0}, {0, -9, 0}, {1, 0, 0}, {0, 9, 0}};
  assert_false(has_diagonal_from_0(wide, &warped));
  assert_false(warped);
  assert_true(has_diagonal_from_0(high, &warped));
}

/* A warped square, from each of its corners and in both directions. */
static void of_two_diagonals_as_long_the_same_is_taken(void **state) {
  (void)state;
  const struct scene_point square[] = {
      {0, 0, 0}, {1, 0, 0.25}, {1, 1, 0}, {0, 1, 0.25}};
  for (uint32_t start = 0; start < 4; start++)
    for (uint32_t step = 1; step <= 3; step += 2) {
      struct scene_point point[4];
      bool warped;
      for (uint32_t c = 0; c < 4; c++)
        point[c] = square[(start + step * c) % 4];
      assert_int_equal(has_diagonal_from_0(point, &warped), start % 2 == 0);
      assert_true(warped);
    }
}

static void a_concave_quadrilateral_is_cut_from_its_hollow(void **state) {
  (void)state;
  bool warped;
  const struct scene_point dart[] = {
      {0, 0, 0}, {9, -9, 0}, {1, 0, 0}, {9, 9, 0}};
  assert_true(has_diagonal_from_0(dart, &warped));
}

static void a_warped_quadrilateral_is_counted(void **state) {
  (void)state;
  bool warped;
  struct scene_point square[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.01}, {0, 1, 0}};
  assert_false(has_diagonal_from_0(square, &warped));
  assert_true(warped);
  square[2].z = 1e-9; /* rounding of the file, no more */
  has_diagonal_from_0(square, &warped);
  assert_false(warped);
}

/* ---- Corners at one place ------------------------------------------------ */

static size_t count_triangles(const int *xy, uint32_t count) {
  struct flat *p = calloc(1, sizeof *p);
  struct triangulation t = {0};
  from_list(p, xy, count);
  assert_true(cut(&t, p, POSE_TILTED));
  check_sides(&t, p, count);
  size_t triangles = t.triangle.count;
  triangulation_fini(&t);
  free(p);
  return triangles;
}

#define COUNT(...)                                                             \
  count_triangles((const int[]){__VA_ARGS__},                                  \
                  sizeof(int[]){__VA_ARGS__} / sizeof(int) / 2)

/* Reported: a face that folds back made triangles with a corner twice. */
static void what_folds_back_makes_no_triangle(void **state) {
  (void)state;
  assert_int_equal(COUNT(0, 0, 4, 0, 4, 0), 0);
  assert_int_equal(COUNT(0, 0, 4, 0, 9, 5, 4, 0), 0);
  assert_int_equal(COUNT(0, 0, 4, 0, 9, 5, 9, 5, 4, 0), 0);
  assert_int_equal(COUNT(0, 0, 4, 0, 9, 5, 4, 0, 1, 7, 4, 0), 0);
  /* A triangle and a path there and back, of one side or of three. */
  assert_int_equal(COUNT(0, 0, 4, 0, 9, 5, 4, 0, 0, 4), 1);
  assert_int_equal(COUNT(0, 0, 4, 0, 9, 5, 9, 9, 9, 5, 4, 0, 0, 4), 1);
  assert_int_equal(COUNT(0, 0, 0, 0, 4, 0, 4, 0, 4, 0, 0, 4), 1);
}

/* ---- The rule ------------------------------------------------------------ */

/* The places of the triangles, so that two lists of them can be compared. */
struct places {
  double at[3][3];
};

static int compare_places(const void *a, const void *b) {
  const double *p = a, *q = b;
  for (int k = 0; k < 3; k++)
    if (p[k] != q[k])
      return p[k] < q[k] ? -1 : 1;
  return 0;
}

static int compare_triangles(const void *a, const void *b) {
  const struct places *s = a, *t = b;
  for (int k = 0; k < 3; k++) {
    int order = compare_places(s->at[k], t->at[k]);
    if (order != 0)
      return order;
  }
  return 0;
}

/* Cuts a polygon; its triangles in one order, mirrored back. */
static size_t cut_to_places(const struct scene_point *point, uint32_t count,
                            double mirror, struct places *places) {
  struct triangulation t = {0};
  uint32_t corner[16];
  for (uint32_t c = 0; c < count; c++)
    corner[c] = c;
  assert_true(triangulate(&t, point, corner, count));
  for (size_t i = 0; i < t.triangle.count; i++) {
    for (int k = 0; k < 3; k++) {
      const struct scene_point *p = &point[t.triangle.item[i].corner[k]];
      places[i].at[k][0] = p->x * mirror;
      places[i].at[k][1] = p->y;
      places[i].at[k][2] = p->z;
    }
    qsort(places[i].at, 3, sizeof places[i].at[0], compare_places);
  }
  size_t triangles = t.triangle.count;
  qsort(places, triangles, sizeof *places, compare_triangles);
  triangulation_fini(&t);
  return triangles;
}

/* A polygon about the origin, each corner off its plane. */
static void make_warped(struct scene_point *point, uint32_t count,
                        struct random *random) {
  for (uint32_t c = 0; c < count; c++) {
    double angle = 2 * acos(-1) * c / count;
    double r = 1 + 4 * random_unit(random);
    point[c] = (struct scene_point){r * cos(angle), r * sin(angle),
                                    2 * random_unit(random)};
  }
}

static void start_winding_and_mirror_change_no_triangle(void **state) {
  (void)state;
  struct random random = {23};
  for (int i = 0; i < 400; i++) {
    struct scene_point point[12], turned[12];
    struct places one[12], other[12];
    uint32_t count = 4 + random_below(&random, 8);
    make_warped(point, count, &random);
    size_t triangles = cut_to_places(point, count, 1, one);
    assert_int_equal(triangles, count - 2);
    for (uint32_t start = 0; start < count; start++)
      for (int way = 0; way < 4; way++) {
        for (uint32_t c = 0; c < count; c++) {
          uint32_t from = start + (way & 1 ? count - c : c);
          turned[c] = point[from % count];
          turned[c].x *= way & 2 ? -1 : 1;
        }
        size_t again = cut_to_places(turned, count, way & 2 ? -1 : 1, other);
        assert_int_equal(again, triangles);
        for (size_t k = 0; k < triangles; k++)
          assert_int_equal(compare_triangles(&one[k], &other[k]), 0);
      }
  }
}

/* Rounding in the last place does not choose between diagonals. */
static void equal_diagonals_stay_equal_when_rounded(void **state) {
  (void)state;
  for (int i = 0; i < 16; i++) {
    struct scene_point point[] = {
        {0.1, 0.1, 0}, {1.1, 0.1, 0.25}, {1.1, 1.1, 0}, {0.1, 1.1, 0.25}};
    bool warped;
    point[i / 4].x = nextafter(point[i / 4].x, i % 4 & 1 ? 9 : -9);
    point[i / 4].y = nextafter(point[i / 4].y, i % 4 & 2 ? 9 : -9);
    /* The first corner in space is 0 or 3, by x. */
    double x = point[3].x;
    point[3].x = nextafter(point[0].x, 9);
    assert_true(has_diagonal_from_0(point, &warped));
    point[3].x = x;
  }
}

/* ---- Faults -------------------------------------------------------------- */

static void a_failed_allocation_is_reported(void **state) {
  (void)state;
  struct flat *p = calloc(1, sizeof *p);
  struct random random = {17};
  grow(p, &random, 40, 30);
  /* Triangles, corners, queue, same sides, three of blockers. */
  struct memory_faults faults = {.least = 7};
  while (memory_faults_go_on(&faults)) {
    struct triangulation t = {0};
    memory_faults_begin(&faults);
    bool ok = cut(&t, p, POSE_XY);
    memory_faults_end(&faults, memory_faults_status(ok));
    triangulation_fini(&t);
  }
  free(p);
}

/* Counts the corners that it is asked about. */
static bool blocks_nothing(const void *user, uint32_t corner) {
  uint32_t *const *asked = user;
  (void)corner;
  ++**asked;
  return false;
}

/* Corners at the places of an ear's own corners do not block it: however many
 * there are, they are left out together. */
static void corners_at_those_of_an_ear_are_not_looked_at(void **state) {
  (void)state;
  enum { PLACES = 3, CORNERS = 3000 * PLACES };
  static double at[CORNERS][2];
  const double place[PLACES][2] = {{0, 0}, {3, 0.5}, {1, 2}};
  const double *triangle[PLACES] = {place[0], place[1], place[2]};
  uint32_t count = 0, *asked = &count;
  struct reflex_tree tree = {0};
  for (uint32_t i = 0; i < CORNERS; i++)
    memcpy(at[i], place[i % PLACES], sizeof at[i]);
  assert_true(reflex_tree_init(&tree, at, sizeof at[0], CORNERS));
  for (uint32_t i = 0; i < CORNERS; i++)
    reflex_tree_set(&tree, i, true);
  assert_false(reflex_tree_query(&tree, triangle, blocks_nothing, &asked));
  assert_true(count < 64);
  reflex_tree_fini(&tree);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(triangles_and_quadrilaterals_are_covered),
      cmocka_unit_test(corners_on_straight_sides_never_make_empty_triangles),
      cmocka_unit_test(combs_and_spirals_are_covered),
      cmocka_unit_test(a_large_disc_is_no_fan),
      cmocka_unit_test(a_star_that_goes_around_twice_is_not_taken_for_convex),
      cmocka_unit_test(random_simple_polygons_are_covered),
      cmocka_unit_test(a_hole_on_a_bridge_stays_open),
      cmocka_unit_test(loops_that_touch_at_a_corner_are_covered),
      cmocka_unit_test(crossing_and_empty_polygons_end),
      cmocka_unit_test(random_tangles_finish),
      cmocka_unit_test(turns_of_one_last_place_are_seen),
      cmocka_unit_test(powers_of_two_change_nothing),
      cmocka_unit_test(the_shorter_diagonal_cuts_a_quadrilateral),
      cmocka_unit_test(of_two_diagonals_as_long_the_same_is_taken),
      cmocka_unit_test(a_concave_quadrilateral_is_cut_from_its_hollow),
      cmocka_unit_test(a_warped_quadrilateral_is_counted),
      cmocka_unit_test(what_folds_back_makes_no_triangle),
      cmocka_unit_test(start_winding_and_mirror_change_no_triangle),
      cmocka_unit_test(equal_diagonals_stay_equal_when_rounded),
      cmocka_unit_test(a_failed_allocation_is_reported),
      cmocka_unit_test(corners_at_those_of_an_ear_are_not_looked_at),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
