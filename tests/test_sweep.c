/* test_sweep.c - the exact sweep: its events compared with all pairs of edges,
 * its trapezoids with the triangles' areas. */
#include "exact_fixture/rational.h"
#include "exact_fixture/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/polled.h"
#include "visibility/watkins/exact/visible_trapezoids.h"

static const struct solver_request plain = {.threads = 1};

static void make_sheet(struct sheet *sheet, uint64_t seed) {
  uint64_t r = seed;
  exact_random_sheet(sheet, (enum exact_kind)(seed % EXACT_KINDS),
                     2 + exact_random_below(&r, 10), &r);
}

/* ---- Places -------------------------------------------------------------- */

/* Distinct points of the page. */
struct point_set {
  ARRAY(struct rational_point) point;
};

static void add_point(struct point_set *set, struct rational_point *p) {
  struct rational_point copy;
  for (size_t i = 0; i < set->point.count; i++)
    if (mpq_equal(set->point.item[i].x, p->x) &&
        mpq_equal(set->point.item[i].y, p->y))
      return;
  rational_point_init(&copy);
  mpq_set(copy.x, p->x);
  mpq_set(copy.y, p->y);
  assert_true(ARRAY_PUSH(&set->point, copy));
}

static void free_points(struct point_set *set) {
  for (size_t i = 0; i < set->point.count; i++)
    rational_point_clear(&set->point.item[i]);
  ARRAY_FREE(&set->point);
}

static struct geom_point start_of(const struct sweep_edge *edge) {
  return (struct geom_point){edge->x0, edge->y0, 0};
}

static struct geom_point end_of(const struct sweep_edge *edge) {
  return (struct geom_point){edge->x1, edge->y1, 0};
}

static bool parts(const struct sweep_edge *a, const struct sweep_edge *b) {
  int s = geom_sign64(geom_orient2d(start_of(a), end_of(a), start_of(b)));
  int t = geom_sign64(geom_orient2d(start_of(a), end_of(a), end_of(b)));
  return s * t < 0;
}

/* All ends, and all places where two edges cross. */
static void find_points(struct point_set *set, const struct sweep *sweep) {
  struct rational_line l, m;
  struct rational_point p;
  rational_line_init(&l);
  rational_line_init(&m);
  rational_point_init(&p);
  for (size_t i = 0; i < sweep->edge.count; i++) {
    const struct sweep_edge *a = &sweep->edge.item[i];
    rational_point_at(&p, start_of(a));
    add_point(set, &p);
    rational_point_at(&p, end_of(a));
    add_point(set, &p);
    rational_line_through(&l, start_of(a), end_of(a));
    for (size_t j = 0; j < i; j++) {
      const struct sweep_edge *b = &sweep->edge.item[j];
      if (!parts(a, b) || !parts(b, a))
        continue;
      rational_line_through(&m, start_of(b), end_of(b));
      assert_true(rational_point_meet(&p, &l, &m));
      add_point(set, &p);
    }
  }
  rational_line_clear(&l);
  rational_line_clear(&m);
  rational_point_clear(&p);
}

static void every_end_and_crossing_is_met_once(void **state) {
  size_t crossings = 0;
  (void)state;
  for (uint64_t seed = 1; seed <= 210; seed++) {
    struct sheet sheet;
    struct sweep sweep;
    struct point_set set = {{0}};
    make_sheet(&sheet, seed);
    assert_true(sweep_init(&sweep, &sheet, NULL, true));
    find_points(&set, &sweep);
    assert_int_equal(sweep_run(&sweep, &plain, 0, 1, NULL), RECTO_OK);
    if (sweep.events != set.point.count)
      fail_msg("seed %u: %zu places, not %zu", (unsigned)seed, sweep.events,
               set.point.count);
    assert_int_equal(sweep.active.count, 0);
    assert_int_equal(sweep.covering_total, 0);
    for (size_t h = 1; h < sweep.height.count; h++)
      assert_true(
          ratio_compare(sweep.height.item[h - 1], sweep.height.item[h]) > 0);
    crossings += sweep.crossings;
    free_points(&set);
    sweep_fini(&sweep);
    exact_sheet_fini(&sheet);
  }
  assert_true(crossings > 1000);
}

/* Directions up to the ends of the page, so that products are as large as they
 * may be; the crossing lies on both edges, and its doubles are near it. */
static void a_crossing_lies_on_both_edges(void **state) {
  enum { HALF = (1 << 30) - 1 };
  uint64_t r = 4711;
  int crossings = 0;
  (void)state;
  for (int round = 0; round < 20000; round++) {
    struct sweep_edge e[2];
    struct sweep_event event;
    int reach = round % 3 == 0 ? 8 : HALF;
    for (int k = 0; k < 2; k++)
      e[k] = (struct sweep_edge){.x0 = exact_random_below(&r, reach) *
                                       (exact_random_below(&r, 2) * 2 - 1),
                                 .y0 = exact_random_below(&r, reach),
                                 .x1 = exact_random_below(&r, reach) *
                                       (exact_random_below(&r, 2) * 2 - 1),
                                 .y1 = -1 - exact_random_below(&r, reach)};
    if (!sweep_crossing(&e[0], &e[1], &event) &&
        !sweep_crossing(&e[1], &e[0], &event)) {
      assert_true(!parts(&e[0], &e[1]) || !parts(&e[1], &e[0]));
      continue;
    }
    crossings++;
    for (int k = 0; k < 2; k++) {
      struct sweep_edge shifted = e[k];
      shifted.x0 -= 1;
      shifted.x1 -= 1;
      assert_int_equal(sweep_side(&e[k], &event), 0);
      assert_int_equal(sweep_side(&shifted, &event), 1);
    }
    assert_true(event.den > 0);
    assert_true(event.x_near - (double)(event.x / event.den) < 1.001);
    assert_true(event.y_near - (double)(event.y / event.den) < 1.001);
  }
  assert_true(crossings > 2000);
}

/* ---- Trapezoids ---------------------------------------------------------- */

struct areas {
  mpq_t *sum; /* one a triangle: twice its area */
  size_t trapezoids;
};

/* x of an edge at a height. */
static void edge_at(mpq_t x, const struct sweep_edge *edge, const mpq_t y) {
  mpq_t slope;
  mpq_init(slope);
  mpq_set_si(slope, (long)edge->x1 - edge->x0,
             (unsigned long)((long)edge->y0 - edge->y1));
  mpq_canonicalize(slope);
  mpq_set_si(x, edge->y0, 1);
  mpq_sub(x, x, y);
  mpq_mul(x, x, slope);
  mpq_set_si(slope, edge->x0, 1);
  mpq_add(x, x, slope);
  mpq_clear(slope);
}

static bool add_trapezoid(void *user, const struct sweep *sweep,
                          const struct sweep_trapezoid *trapezoid) {
  struct areas *areas = user;
  mpq_t height[2], x, wide, sum;
  mpq_inits(height[0], height[1], x, wide, sum, NULL);
  rational_set_ratio(height[0], sweep->height.item[trapezoid->top]);
  rational_set_ratio(height[1], sweep->height.item[trapezoid->bottom]);
  assert_true(mpq_cmp(height[0], height[1]) > 0);
  for (int k = 0; k < 2; k++) {
    edge_at(wide, &sweep->edge.item[trapezoid->right], height[k]);
    edge_at(x, &sweep->edge.item[trapezoid->left], height[k]);
    mpq_sub(wide, wide, x);
    assert_true(mpq_sgn(wide) >= 0);
    mpq_add(sum, sum, wide);
  }
  assert_true(mpq_sgn(sum) > 0);
  mpq_sub(x, height[0], height[1]);
  mpq_mul(sum, sum, x);
  for (size_t i = 0; i < trapezoid->count; i++)
    mpq_add(areas->sum[trapezoid->covering[i]],
            areas->sum[trapezoid->covering[i]], sum);
  areas->trapezoids++;
  mpq_clears(height[0], height[1], x, wide, sum, NULL);
  return true;
}

static void assert_areas(const struct sheet *sheet, const struct areas *areas) {
  for (size_t t = 0; t < sheet->triangle.count; t++) {
    const uint32_t *p = sheet->triangle.item[t].point;
    long area =
        (long)geom_orient2d(sheet->point.item[p[0]], sheet->point.item[p[1]],
                            sheet->point.item[p[2]]);
    assert_int_equal(mpq_cmp_si(areas->sum[t], area, 1), 0);
  }
}

static void trapezoids_tile_every_triangle(void **state) {
  size_t trapezoids = 0;
  (void)state;
  for (uint64_t seed = 1; seed <= 210; seed++) {
    struct sheet sheet;
    struct sweep sweep;
    struct areas areas = {0};
    make_sheet(&sheet, seed);
    areas.sum = mem_alloc(sheet.triangle.count, sizeof *areas.sum);
    for (size_t t = 0; t < sheet.triangle.count; t++)
      mpq_init(areas.sum[t]);
    assert_true(sweep_init(&sweep, &sheet, NULL, seed % 2 == 0));
    sweep.on_trapezoid = add_trapezoid;
    sweep.user = &areas;
    assert_int_equal(sweep_run(&sweep, &plain, 0, 1, NULL), RECTO_OK);
    assert_areas(&sheet, &areas);
    trapezoids += areas.trapezoids;
    for (size_t t = 0; t < sheet.triangle.count; t++)
      mpq_clear(areas.sum[t]);
    mem_free(areas.sum);
    sweep_fini(&sweep);
    exact_sheet_fini(&sheet);
  }
  assert_true(trapezoids > 2000);
}

/* ---- Depth --------------------------------------------------------------- */

/* Two squares that pierce each other, and one behind both. */
static void piercing_squares(struct sheet *sheet) {
  static const int square[3][4][3] = {
      {{0, 0, 0}, {8, 0, 8}, {8, 8, 8}, {0, 8, 0}},
      {{0, 0, 8}, {8, 0, 0}, {8, 8, 0}, {0, 8, 8}},
      {{-1, -1, -1}, {9, -1, -1}, {9, 9, -1}, {-1, 9, -1}}};
  exact_sheet_init(sheet);
  for (int f = 0; f < 3; f++)
    exact_add_face(sheet, square[f], 4, 1 << 20);
}

static void doubles_leave_only_piercing_pairs_to_exact_planes(void **state) {
  struct sheet sheet;
  struct sweep sweep;
  struct visible_trapezoids visible;
  (void)state;
  piercing_squares(&sheet);
  assert_true(visible_trapezoids_init(&visible, &sheet));
  assert_true(sweep_init(&sweep, &sheet, NULL, false));
  visible.keep = true;
  sweep.on_trapezoid = visible_trapezoids_add;
  sweep.user = &visible;
  assert_int_equal(sweep_run(&sweep, &plain, 0, 1, NULL), RECTO_OK);
  assert_true(visible.filter_failures > 0 &&
              visible.filter_failures < visible.count);
  for (size_t i = 0; i < visible.part.count; i++) {
    const struct visible_trapezoid *part = &visible.part.item[i];
    uint32_t face = sheet.triangle.item[part->triangle].face;
    if (part->count == 0)
      continue;
    assert_true(face != 2); /* the one behind is never a candidate */
    assert_int_equal(part->count, 2);
  }
  sweep_fini(&sweep);
  visible_trapezoids_fini(&visible);
  exact_sheet_fini(&sheet);
}

/* ---- Limits -------------------------------------------------------------- */

static void a_scene_beyond_the_limits_is_refused(void **state) {
  struct sheet sheet;
  struct visible_trapezoids visible;
  (void)state;
  piercing_squares(&sheet);
  assert_true(visible_trapezoids_init(&visible, &sheet));
  visible.keep = true;
  visible.pieces_max = 0;
  for (int limit = 0; limit < 3; limit++) {
    static const char *const word[] = {"places", "over each other",
                                       "trapezoids"};
    recto_error error = {0};
    recto_status status;
    struct sweep sweep;
    assert_true(sweep_init(&sweep, &sheet, NULL, true));
    sweep.on_trapezoid = visible_trapezoids_add;
    sweep.user = &visible;
    if (limit == 0)
      sweep.events_max = 5;
    if (limit == 1)
      sweep.covering_max = 2;
    status = sweep_run(&sweep, &plain, 0, 1, &error);
    if (limit == 2) {
      assert_int_equal(status, RECTO_OK);
      status = visible_trapezoids_finish(&visible, &sweep, NULL, &error);
    }
    assert_int_equal(status, RECTO_ERROR_LIMIT);
    assert_non_null(strstr(error.text, word[limit]));
    sweep_fini(&sweep);
  }
  visible_trapezoids_fini(&visible);
  exact_sheet_fini(&sheet);
}

static bool count_and_stop(void *user, double share, const char *stage) {
  int *polled = user;
  assert_true(share >= 0 && share <= 1);
  assert_non_null(stage);
  return ++*polled < 2;
}

static void a_sweep_can_be_cancelled(void **state) {
  enum { SIDE = 70 };
  int polled = 0;
  const struct solver_request request = {
      .fragments = true, .edges = true, .threads = 1};
  struct polled with;
  struct sheet sheet;
  struct map map;
  (void)state;
  exact_sheet_init(&sheet);
  for (int i = 0; i < SIDE * SIDE; i++) {
    int x = i % SIDE, y = i / SIDE;
    const int corner[3][3] = {{x, y, 0}, {x + 1, y, 0}, {x, y + 1, 0}};
    exact_add_face(&sheet, corner, 3, 1 << 20);
  }
  polled_begin(&with, count_and_stop, &polled);
  assert_int_equal(
      exact_solve_as(&solver_watkins, &request, &sheet, &map, NULL),
      RECTO_ERROR_CANCELLED);
  polled_end(&with);
  assert_int_equal(polled, 2);
  map_fini(&map);
  exact_sheet_fini(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_end_and_crossing_is_met_once),
      cmocka_unit_test(a_crossing_lies_on_both_edges),
      cmocka_unit_test(trapezoids_tile_every_triangle),
      cmocka_unit_test(doubles_leave_only_piercing_pairs_to_exact_planes),
      cmocka_unit_test(a_scene_beyond_the_limits_is_refused),
      cmocka_unit_test(a_sweep_can_be_cancelled),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
