/* test_warnock_raster.c - subdivision of a pixel frame: the worked frames, the
 * rules, the z-buffer's pixels, sub-pixels. */
#include "exact_fixture/pixels.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "visibility/warnock/warnock_raster.h"
#include "visibility/zbuffer/zbuffer.h"

/* ---- Frames -------------------------------------------------------------- */

static void draw_frame(struct warnock_frame *frame, const struct sheet *sheet,
                       const struct solver_request *request) {
  struct facets facets;
  assert_true(facets_init(&facets, sheet));
  assert_int_equal(warnock_frame_init(frame, sheet, request, NULL), RECTO_OK);
  assert_int_equal(warnock_frame_draw(frame, &facets, request, NULL), RECTO_OK);
  facets_fini(&facets);
}

static size_t pixels_of(const struct raster *raster) {
  return (size_t)raster->grid.columns * (size_t)raster->grid.lines;
}

static int face_at(const struct warnock_frame *frame, int column, int line) {
  const struct raster *raster = &frame->raster;
  uint32_t facet =
      raster_facet(raster->seen[line * raster->grid.columns + column]);
  return facet == SHEET_NONE ? -1
                             : (int)raster->sheet->triangle.item[facet].face;
}

static void assert_zbuffer_sees_the_same(const struct warnock_frame *frame,
                                         const char *what) {
  const struct sheet *sheet = frame->raster.sheet;
  const struct solver_request request = {.fragments = true, .threads = 1};
  struct raster raster;
  struct facets facets;
  int64_t covered = 0;
  assert_true(facets_init(&facets, sheet));
  assert_int_equal(
      raster_init(&raster, sheet, frame->raster.grid.lines, 0, true, NULL),
      RECTO_OK);
  assert_int_equal(
      zbuffer_draw(&raster, &facets, &request, NULL, &covered, NULL), RECTO_OK);
  for (size_t i = 0; i < pixels_of(&raster); i++)
    if (raster.seen[i] != frame->raster.seen[i])
      fail_msg("%s: pixel %zu %zu: facet %d, not %d", what,
               i % (size_t)raster.grid.columns, i / (size_t)raster.grid.columns,
               (int)raster_facet(frame->raster.seen[i]),
               (int)raster_facet(raster.seen[i]));
  raster_fini(&raster);
  facets_fini(&facets);
}

static uint64_t sum_windows(const struct warnock_frame *frame) {
  uint64_t sum = 0;
  for (int rule = 0; rule < WARNOCK_RULE_COUNT; rule++)
    sum += frame->windows[rule];
  return sum;
}

/* ---- The worked frames --------------------------------------------------- */

static void assert_worked_frame(const struct pixels_scene *scene,
                                int (*seen)(int, int), bool by_box) {
  const struct solver_request request = {.fragments = true,
                                         .threads = 1,
                                         .resolution = 32,
                                         .divide_by_box = by_box};
  struct sheet sheet;
  struct warnock_frame frame;
  pixels_sheet(&sheet, scene);
  draw_frame(&frame, &sheet, &request);
  for (int y = 0; y < 32; y++)
    for (int x = 0; x < 32; x++)
      assert_int_equal(face_at(&frame, x, y), seen(x, y));
  warnock_frame_fini(&frame);
  exact_sheet_fini(&sheet);
}

static void the_worked_frames_are_right_in_every_pixel(void **state) {
  (void)state;
  for (int by_box = 0; by_box < 2; by_box++) {
    assert_worked_frame(&pixels_pierced_rectangle,
                        pixels_frame_of_pierced_rectangle, by_box == 1);
    assert_worked_frame(&pixels_two_rectangles, pixels_frame_of_two_rectangles,
                        by_box == 1);
  }
}

/* ---- The rules ----------------------------------------------------------- */

static void assert_first_rule(const struct pixels_scene *scene,
                              enum warnock_rule rule) {
  const struct solver_request request = {
      .fragments = true, .threads = 1, .resolution = 32};
  struct sheet sheet;
  struct warnock_frame frame;
  pixels_sheet(&sheet, scene);
  draw_frame(&frame, &sheet, &request);
  assert_int_equal(frame.windows[WARNOCK_DIVIDED] > 0, rule == WARNOCK_DIVIDED);
  assert_true(rule == WARNOCK_DIVIDED ||
              (frame.windows[rule] == 1 && sum_windows(&frame) == 1));
  assert_zbuffer_sees_the_same(&frame, "a rule");
  warnock_frame_fini(&frame);
  exact_sheet_fini(&sheet);
}

#define ALL_ROUND(z)                                                           \
  {                                                                            \
    4, {                                                                       \
      {-1, -1, z}, {33, -1, z}, {33, 33, z}, { -1, 33, z }                     \
    }                                                                          \
  }

static void each_rule_finishes_the_window_it_is_for(void **state) {
  static const struct pixels_scene disjoint = {
      1, {{3, {{40, 8, 1}, {48, 24, 1}, {56, 4, 1}}}}};
  static const struct pixels_scene contained = {
      1, {{3, {{8, 4, 1}, {12, 24, 2}, {24, 12, 3}}}}};
  static const struct pixels_scene intersecting = {
      1, {{3, {{8, 4, 1}, {12, 24, 2}, {40, 12, 3}}}}};
  static const struct pixels_scene surrounding = {1, {ALL_ROUND(7)}};
  static const struct pixels_scene first = {
      3,
      {{3, {{8, 4, 1}, {12, 24, 2}, {24, 12, 3}}},
       ALL_ROUND(7),
       {3, {{8, 4, 0}, {12, 24, 6}, {40, 12, 3}}}}};
  static const struct pixels_scene divided = {
      2, {ALL_ROUND(2), {3, {{8, 4, 1}, {12, 24, 2}, {24, 12, 3}}}}};
  (void)state;
  assert_first_rule(&disjoint, WARNOCK_BACKGROUND);
  assert_first_rule(&contained, WARNOCK_CONTAINED);
  assert_first_rule(&intersecting, WARNOCK_INTERSECTING);
  assert_first_rule(&surrounding, WARNOCK_SURROUNDER);
  assert_first_rule(&first, WARNOCK_FRONT);
  assert_first_rule(&divided, WARNOCK_DIVIDED);
}

/* Surrounders that tie everywhere, or at corners of the window: the earlier
 * face is seen, by rule 5, without a division. */
static void ties_are_decided_for_whole_windows(void **state) {
  static const struct pixels_scene equal = {
      3, {ALL_ROUND(7), ALL_ROUND(7), ALL_ROUND(7)}};
  static const struct pixels_scene below = {
      2,
      {{4, {{-1, -1, 7}, {33, -1, 7}, {33, 33, 7}, {-1, 33, 7}}},
       {4, {{-1, -1, 7}, {33, -1, 7}, {33, 33, 3}, {-1, 33, 3}}}}};
  (void)state;
  assert_first_rule(&equal, WARNOCK_FRONT);
  assert_first_rule(&below, WARNOCK_FRONT);
}

/* ---- The z-buffer's pixels ----------------------------------------------- */

static void random_scenes_are_right_in_every_pixel(void **state) {
  static const int lines[] = {1, 7, 32, 45, 64, 100};
  (void)state;
  for (uint64_t seed = 0; seed < 150; seed++) {
    const struct solver_request request = {.fragments = true,
                                           .threads = 1,
                                           .resolution = lines[seed % 6],
                                           .divide_by_box = seed % 4 == 1};
    struct pixels_scene scene;
    struct sheet sheet;
    struct warnock_frame frame;
    pixels_random_scene(&scene, seed);
    pixels_sheet(&sheet, &scene);
    draw_frame(&frame, &sheet, &request);
    for (int y = 0; y < request.resolution; y++)
      for (int x = 0; x < request.resolution; x++)
        assert_int_equal(face_at(&frame, x, y),
                         pixels_seen(&scene, request.resolution, x, y, NULL));
    assert_zbuffer_sees_the_same(&frame, "random");
    warnock_frame_fini(&frame);
    exact_sheet_fini(&sheet);
  }
}

static int32_t anywhere(uint64_t *seed, int bits) {
  int32_t half = (1 << bits) - 1;
  return (int32_t)(exact_random(seed) % (2 * (uint64_t)half + 1)) - half;
}

/* Anything the grid can hold: needles, walls a unit thick, all depths. */
static void triangles_of_any_kind_give_the_pixels_of_the_zbuffer(void **state) {
  uint64_t seed = 4711;
  (void)state;
  for (int round = 0; round < 150; round++) {
    const struct solver_request request = {
        .fragments = true,
        .threads = 1,
        .resolution = 20 + exact_random_below(&seed, 100),
        .divide_by_box = round % 3 == 0};
    struct sheet sheet;
    struct warnock_frame frame;
    exact_sheet_init(&sheet);
    sheet.camera.page_mm[0] = 300 + exact_random_below(&seed, 1700);
    sheet.camera.page_mm[1] = 300 + exact_random_below(&seed, 1700);
    for (uint32_t t = 0; t < 14; t++) {
      int bits = 2 + exact_random_below(&seed, 29);
      struct geom_point p[3], at = {anywhere(&seed, 29), anywhere(&seed, 29),
                                    (int64_t)(exact_random(&seed) >> 24)};
      for (int k = 0; k < 3; k++) {
        p[k].x = bits > 29 ? anywhere(&seed, 30) : at.x + anywhere(&seed, bits);
        p[k].y = k == 2 || bits > 29 ? anywhere(&seed, 30)
                                     : at.y + anywhere(&seed, bits);
        p[k].z = exact_random_below(&seed, 3) == 0
                     ? at.z
                     : (int64_t)(exact_random(&seed) >> 24);
        if (exact_random_below(&seed, 4) == 0)
          p[k].z = exact_random_below(&seed, 2) == 0 ? 0 : SHEET_Z_MAX;
      }
      exact_add_triangle(&sheet, p, t);
    }
    draw_frame(&frame, &sheet, &request);
    assert_zbuffer_sees_the_same(&frame, "any kind");
    warnock_frame_fini(&frame);
    exact_sheet_fini(&sheet);
  }
}

static void solve_with(const struct solver *solver,
                       const struct solver_request *request,
                       const struct pixels_scene *scene, struct sheet *sheet,
                       struct map *map, struct report *report) {
  pixels_sheet(sheet, scene);
  map_init(map);
  assert_int_equal(solver->solve(sheet, request, map, report, NULL), RECTO_OK);
}

static void assert_same_map(const struct map *a, const struct map *b) {
  assert_int_equal(a->edge_count, b->edge_count);
  if (a->edge_count > 0)
    assert_memory_equal(a->edge_state, b->edge_state, a->edge_count);
  assert_int_equal(a->interval.count, b->interval.count);
  for (size_t i = 0; i < a->interval.count; i++) {
    const struct map_interval *p = &a->interval.item[i];
    const struct map_interval *q = &b->interval.item[i];
    assert_int_equal(ratio_compare(p->t0, q->t0), 0);
    assert_int_equal(ratio_compare(p->t1, q->t1), 0);
  }
  assert_int_equal(a->fragment.count, b->fragment.count);
  assert_int_equal(a->corner.count, b->corner.count);
  for (size_t f = 0; f < a->fragment.count; f++)
    assert_int_equal(a->fragment.item[f].face, b->fragment.item[f].face);
  for (size_t c = 0; c < a->corner.count; c++) {
    assert_true(a->corner.item[c].x == b->corner.item[c].x);
    assert_true(a->corner.item[c].y == b->corner.item[c].y);
  }
}

/* With fragments, and lines alone: there windows without a drawable edge are
 * finished at once, and yet the lines are the same. */
static void maps_are_those_of_the_zbuffer(void **state) {
  (void)state;
  for (uint64_t seed = 600; seed < 660; seed++) {
    const struct solver_request request = {.edges = true,
                                           .fragments = seed % 2 == 0,
                                           .intersections = seed % 3 == 0,
                                           .remove_backs = seed % 5 == 0,
                                           .threads = 1,
                                           .resolution = 32 << seed % 4};
    struct report *report = report_create();
    struct pixels_scene scene;
    struct sheet sheet[2];
    struct map map[2];
    pixels_random_scene(&scene, seed);
    solve_with(&solver_zbuffer, &request, &scene, &sheet[0], &map[0], NULL);
    solve_with(&solver_warnock, &request, &scene, &sheet[1], &map[1], report);
    assert_same_map(&map[0], &map[1]);
    if (request.fragments)
      assert_int_equal(report_get(report, "warnock", "without_edge", -1), 0);
    else if (request.resolution == 256)
      assert_true(report_get(report, "warnock", "without_edge", -1) > 0);
    report_destroy(report);
    for (int s = 0; s < 2; s++) {
      map_fini(&map[s]);
      exact_sheet_fini(&sheet[s]);
    }
  }
}

/* ---- Sub-pixels ---------------------------------------------------------- */

/* How many of a pixel's sub-pixels see a facet, by a finer frame. */
static uint32_t count_in(const struct raster *fine, int32_t k, size_t column,
                         size_t line, uint32_t facet) {
  uint32_t count = 0;
  for (size_t y = line * (size_t)k; y < (line + 1) * (size_t)k; y++)
    for (size_t x = column * (size_t)k; x < (column + 1) * (size_t)k; x++)
      count +=
          fine->seen[y * (size_t)fine->grid.columns + x] == raster_seen(facet);
  return count;
}

static void sub_pixels_are_those_of_a_finer_frame(void **state) {
  (void)state;
  for (uint64_t seed = 700; seed < 740; seed++) {
    int k = 2 + (int)seed % 4, lines = 11 + (int)seed % 30;
    uint32_t all = (uint32_t)(k * k);
    const struct solver_request averaged = {
        .fragments = true, .threads = 1, .resolution = lines, .subpixels = k};
    const struct solver_request finer = {
        .fragments = true, .threads = 1, .resolution = lines * k};
    struct pixels_scene scene;
    struct sheet sheet;
    struct warnock_frame frame, fine;
    pixels_random_scene(&scene, seed);
    pixels_sheet(&sheet, &scene);
    draw_frame(&frame, &sheet, &averaged);
    draw_frame(&fine, &sheet, &finer);
    assert_null(fine.coverage);
    for (size_t i = 0; i < pixels_of(&frame.raster); i++) {
      size_t x = i % (size_t)lines, y = i / (size_t)lines;
      uint32_t seen = raster_facet(frame.raster.seen[i]), most = 0;
      uint32_t none = count_in(&fine.raster, k, x, y, SHEET_NONE);
      assert_int_equal(frame.coverage[i], all - none);
      assert_int_equal(seen != SHEET_NONE, 2 * (all - none) >= all);
      if (seen == SHEET_NONE)
        continue;
      most = count_in(&fine.raster, k, x, y, seen);
      for (uint32_t t = 0; t < sheet.triangle.count; t++)
        assert_true(count_in(&fine.raster, k, x, y, t) < most + (t >= seen));
    }
    warnock_frame_fini(&frame);
    warnock_frame_fini(&fine);
    exact_sheet_fini(&sheet);
  }
}

/* The share of the page that is covered, as reported. */
static double covered_share(int lines, int subpixels) {
  const struct solver_request request = {.fragments = true,
                                         .threads = 1,
                                         .resolution = lines,
                                         .subpixels = subpixels};
  struct sheet sheet;
  struct warnock_frame frame;
  uint64_t covered = 0;
  pixels_sheet(&sheet, &pixels_pierced_rectangle);
  draw_frame(&frame, &sheet, &request);
  for (size_t i = 0; i < pixels_of(&frame.raster); i++)
    covered +=
        frame.coverage == NULL ? frame.raster.seen[i] != 0 : frame.coverage[i];
  warnock_frame_fini(&frame);
  exact_sheet_fini(&sheet);
  return (double)covered / (lines * lines) /
         (subpixels > 1 ? subpixels * subpixels : 1);
}

/* 300 for the rectangle, 100 / 3 for what of the triangle lies beside it. */
static void averaging_comes_nearer_to_the_area(void **state) {
  double want = (300 + 100 / 3.) / 1024, plain = 0, averaged = 0;
  (void)state;
  for (int lines = 5; lines < 20; lines++) {
    plain += fabs(covered_share(lines, 0) - want);
    averaged += fabs(covered_share(lines, 16) - want);
    assert_true(fabs(covered_share(lines, 16) - want) < 0.003);
  }
  assert_true(10 * averaged < plain);
  assert_true(covered_share(10, 1) == covered_share(10, 0));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_worked_frames_are_right_in_every_pixel),
      cmocka_unit_test(each_rule_finishes_the_window_it_is_for),
      cmocka_unit_test(ties_are_decided_for_whole_windows),
      cmocka_unit_test(random_scenes_are_right_in_every_pixel),
      cmocka_unit_test(triangles_of_any_kind_give_the_pixels_of_the_zbuffer),
      cmocka_unit_test(maps_are_those_of_the_zbuffer),
      cmocka_unit_test(sub_pixels_are_those_of_a_finer_frame),
      cmocka_unit_test(averaging_comes_nearer_to_the_area),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
