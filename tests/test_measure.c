/* test_measure.c - the measure of errors, on maps built from numbers and on
 * exact ones. */
#include "tests/measure/measure.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/near.h"
#include "tests/scenes/pipeline.h"

static const double unit = SHEET_UNITS_PER_MM;

/* An empty page of 100 x 100 mm. */
static void empty_sheet(struct sheet *sheet) {
  memset(sheet, 0, sizeof *sheet);
  sheet->camera.page_mm[0] = sheet->camera.page_mm[1] = 100;
}

/* Adds a loop of `count` corners in mm, x y after each other. */
static void add_loop(struct map *map, const double *mm, uint32_t count) {
  struct map_loop loop = {(uint32_t)map->corner.count, count, 0};
  for (uint32_t i = 0; i < count; i++) {
    struct map_corner corner = {.x = mm[2 * i] * unit,
                                .y = mm[2 * i + 1] * unit};
    assert_true(ARRAY_PUSH(&map->corner, corner));
  }
  assert_true(ARRAY_PUSH(&map->loop, loop));
}

static void add_fragment(struct map *map, uint32_t face, uint32_t loops) {
  struct map_fragment fragment = {face, (uint32_t)map->loop.count - loops,
                                  loops};
  assert_true(ARRAY_PUSH(&map->fragment, fragment));
}

static void add_box(struct map *map, uint32_t face, double x0, double y0,
                    double x1, double y1) {
  const double mm[] = {x0, y0, x1, y0, x1, y1, x0, y1};
  add_loop(map, mm, 4);
  add_fragment(map, face, 1);
}

/* An empty page and two maps of it. */
static void start(struct sheet *sheet, struct map *exact, struct map *map) {
  empty_sheet(sheet);
  map_init(exact);
  map_init(map);
}

/* Two faces of 10 x 10 mm beside each other, as they truly are. */
static void start_two(struct sheet *sheet, struct map *exact, struct map *map) {
  start(sheet, exact, map);
  add_box(exact, 0, 0, 0, 10, 10);
  add_box(exact, 1, 10, 0, 20, 10);
}

static void areas_are_reported_by_kind_of_error(void **state) {
  struct sheet sheet;
  struct map exact, map;
  struct measure m;
  (void)state;
  start_two(&sheet, &exact, &map);
  add_box(&map, 0, 2, 1, 13, 10);  /* 2 and 1 short, 3 too far */
  add_box(&map, 1, 13, 1, 20, 12); /* 3 and 1 short, 2 too high */
  assert_true(measure_map(&m, &sheet, &exact, &sheet, &map));
  assert_near(m.true_area, 200);
  assert_near(m.wrong_face, 3 * 9);
  assert_near(m.missing_area, 2 * 10 + 18 * 1);
  assert_near(m.false_area, 7 * 2);
  assert_near(measure_area_share(&m), (27 + 38 + 14) / 200.);
  map_fini(&exact);
  map_fini(&map);
}

/* What is given twice is not missing elsewhere. */
static void area_covered_twice_is_reported_separately(void **state) {
  struct sheet sheet;
  struct map exact, map;
  struct measure m;
  (void)state;
  start_two(&sheet, &exact, &map);
  add_box(&map, 0, 0, 0, 12, 8);
  add_box(&map, 1, 9, 0, 20, 8);
  assert_true(measure_map(&m, &sheet, &exact, &sheet, &map));
  assert_near(m.twice_area, 3 * 8);
  assert_near(m.wrong_face, 3 * 8);
  assert_near(m.missing_area, 20 * 2);
  assert_near(m.false_area, 0);
  map_fini(&exact);
  map_fini(&map);
}

/* A frame with a hole, and an L: neither is convex. */
static void holes_and_corners_that_turn_in_are_kept_out(void **state) {
  static const double outer[] = {-9, -9, 9, -9, 9, 9, -9, 9};
  static const double hole[] = {-3, -3, -3, 3, 3, 3, 3, -3};
  static const double l[] = {-5, -5, 5, -5, 5, 0, 0, 0, 0, 5, -5, 5};
  struct sheet sheet;
  struct map frame, bend;
  struct measure m;
  (void)state;
  start(&sheet, &frame, &bend);
  add_loop(&frame, outer, 4);
  add_loop(&frame, hole, 4);
  add_fragment(&frame, 7, 2);
  add_loop(&bend, l, 6);
  add_fragment(&bend, 7, 1);
  /* The hole takes 27 of the L's 75. */
  assert_true(measure_map(&m, &sheet, &frame, &sheet, &bend));
  assert_near(m.true_area, 18 * 18 - 36);
  assert_near(m.wrong_face, 0);
  assert_near(m.false_area, 27);
  assert_near(m.missing_area, 18 * 18 - 36 - 48);
  assert_true(measure_map(&m, &sheet, &bend, &sheet, &frame));
  assert_near(m.true_area, 75);
  assert_near(m.missing_area, 27);
  assert_near(m.false_area, 18 * 18 - 36 - 48);
  map_fini(&frame);
  map_fini(&bend);
}

static void one_map_has_no_error_against_itself(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    recto_options options;
    struct pipeline pipeline;
    struct measure m;
    pipeline_fill(&scene, &options, entry);
    options.ink.fill = RECTO_FILL_PAINT;
    pipeline_run(&pipeline, &scene, &options, &solver_tiles);
    if (pipeline.status == RECTO_OK) {
      double page = options.page.width_mm * options.page.height_mm;
      assert_true(measure_map(&m, &pipeline.sheet, &pipeline.map,
                              &pipeline.sheet, &pipeline.map));
      /* Corners are rounded to 1 / 256 unit: fragments may overlap by that. */
      if (!(fabs(m.wrong_face) < 1e-9 * page &&
            fabs(m.missing_area) < 1e-9 * page &&
            fabs(m.false_area) < 1e-9 * page))
        fail_msg("%s: %g %g %g of %g mm2", entry->name, m.wrong_face,
                 m.missing_area, m.false_area, m.true_area);
      assert_true(m.missing_ink == 0 && m.false_ink == 0);
    }
    pipeline_fini(&pipeline);
    scene_fini(&scene);
  }
}

/* ---- Ink ----------------------------------------------------------------- */

/* A sheet of three edges of 10 mm. */
static void three_edges(struct sheet *sheet) {
  empty_sheet(sheet);
  for (uint32_t e = 0; e < 3; e++) {
    struct geom_point p = {0, (int32_t)e, 0}, q = {10 << 20, (int32_t)e, 0};
    struct sheet_edge edge = {.point = {2 * e, 2 * e + 1},
                              .edge_class = RECTO_EDGE_CREASE};
    assert_true(ARRAY_PUSH(&sheet->point, p));
    assert_true(ARRAY_PUSH(&sheet->point, q));
    assert_true(ARRAY_PUSH(&sheet->edge, edge));
  }
}

static void set_states(struct map *map, int a, int b, int c) {
  map->edge_count = 3;
  map->edge_state = mem_alloc(3, 1);
  assert_non_null(map->edge_state);
  map->edge_state[0] = (uint8_t)a;
  map->edge_state[1] = (uint8_t)b;
  map->edge_state[2] = (uint8_t)c;
}

static void add_interval(struct map *map, int from, int to, int den) {
  struct map_interval interval = {{from, den}, {to, den}};
  assert_true(ARRAY_PUSH(&map->interval, interval));
}

static void ink_is_compared_interval_by_interval(void **state) {
  struct sheet sheet;
  struct map exact, map;
  struct measure m;
  (void)state;
  three_edges(&sheet);
  map_init(&exact);
  map_init(&map);
  set_states(&exact, MAP_VISIBLE, MAP_MIXED, MAP_MIXED);
  set_states(&map, MAP_MIXED, MAP_MIXED, MAP_HIDDEN);
  /* Edge 0: all; but 1/4 to 1/2 and 3/4 to 1. */
  add_interval(&map, 1, 2, 4);
  add_interval(&map, 3, 4, 4);
  assert_true(ARRAY_PUSH(&map.mixed, ((struct map_mixed){0, 0, 2})));
  /* Edge 1: 0 to 1/2; but 3/10 to 7/10. */
  add_interval(&exact, 0, 1, 2);
  add_interval(&map, 3, 7, 10);
  assert_true(ARRAY_PUSH(&exact.mixed, ((struct map_mixed){1, 0, 1})));
  assert_true(ARRAY_PUSH(&map.mixed, ((struct map_mixed){1, 2, 1})));
  /* Edge 2: 1/3 to 2/3; but nothing. */
  add_interval(&exact, 1, 2, 3);
  assert_true(ARRAY_PUSH(&exact.mixed, ((struct map_mixed){2, 1, 1})));
  assert_true(measure_map(&m, &sheet, &exact, &sheet, &map));
  assert_near(m.true_ink, 10 + 5 + 10 / 3.);
  assert_near(m.missing_ink, 5 + 3 + 10 / 3.);
  assert_near(m.false_ink, 2);
  assert_near(measure_ink_share(&m), (5 + 3 + 10 / 3. + 2) / (15 + 10 / 3.));
  map_fini(&exact);
  map_fini(&map);
  ARRAY_FREE(&sheet.point);
  ARRAY_FREE(&sheet.edge);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(areas_are_reported_by_kind_of_error),
      cmocka_unit_test(area_covered_twice_is_reported_separately),
      cmocka_unit_test(holes_and_corners_that_turn_in_are_kept_out),
      cmocka_unit_test(one_map_has_no_error_against_itself),
      cmocka_unit_test(ink_is_compared_interval_by_interval),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
