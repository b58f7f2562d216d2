/* test_pairwise_fallback.c - scenes in which Newell's splits, Warnock's windows
 * and Watkins' trapezoids would grow out of bounds: each method draws them as
 * the oracle does, in bounded memory. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "base/sanitizer.h"
#include "tests/memory_faults.h"
#include "tests/memory_peak.h"
#include "tests/polled.h"
#include "tests/scenes/pipeline.h"
#include "tests/scenes/random.h"
#include "tests/scenes/solver_named.h"
#include "tests/sheet_fixture.h"

static const struct solver *const bounded[] = {
    &solver_tiles, &solver_newell, &solver_warnock, &solver_watkins, NULL};

static void start(struct scene *scene, recto_options *options) {
  recto_options_init(options);
  scene_init(scene);
  options->ink.edges = RECTO_EDGES_ALL;
  options->ink.min_stroke_mm = 0;
  options->output.precision = 6;
  options->solver.threads = 1;
}

/* ---- Scenes -------------------------------------------------------------- */

/* Large triangles about one place, nearly all of which pierce each other.
 * lattice  corners have small whole numbers, and coincide */
static void add_piercing(struct scene *scene, unsigned n, bool lattice) {
  struct random random = {n};
  for (unsigned i = 0; i < n; i++) {
    uint32_t corner[3];
    double sum[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
      double p[3];
      for (int axis = 0; axis < 3; axis++) {
        p[axis] = lattice  ? random_int(&random, 0, 5)
                  : k == 2 ? random_between(&random, -0.02, 0.02) - sum[axis]
                           : random_between(&random, -2, 2);
        sum[axis] += p[axis];
      }
      corner[k] = build_point(scene, p[0], p[1], p[2]);
    }
    build_triangle(scene, corner[0], corner[1], corner[2]);
  }
}

/* A cone of n triangles. */
static void add_fan(struct scene *scene, unsigned n) {
  uint32_t shared_vertex = build_point(scene, 0.3, 0.1, 1), first = 0, last = 0;
  for (unsigned i = 0; i <= n; i++) {
    double turn = 2 * 3.14159265358979 * i / n;
    uint32_t next = i < n ? build_point(scene, cos(turn), sin(turn), 0) : first;
    if (i == 0)
      first = next;
    else
      build_triangle(scene, shared_vertex, last, next);
    last = next;
  }
}

/* Needles across a disc at any height, and lines that bound no face. */
static void add_needles(struct scene *scene, unsigned n) {
  struct random random = {n};
  for (unsigned i = 0; i < n; i++) {
    double turn = random_between(&random, 0, 6.28), up = random_unit(&random);
    double x = cos(turn), y = sin(turn), z = random_unit(&random);
    uint32_t p = build_point(scene, x, y, up),
             q = build_point(scene, -x, 0.2 - y, z);
    if (i % 8 == 0)
      build_segment(scene, p, q);
    else
      build_triangle(scene, p, q, build_point(scene, 0.01 - x, 0.2 - y, z));
  }
}

static void add_scene(struct scene *scene, int kind) {
  switch (kind) {
  case 0:
    add_piercing(scene, 60, false);
    break;
  case 1:
    add_piercing(scene, 60, true);
    break;
  case 2:
    add_fan(scene, 300);
    break;
  case 3:
    add_needles(scene, 100);
    break;
  default:
    add_piercing(scene, 8, true);
    break;
  }
}

/* ---- The same drawing ---------------------------------------------------- */

static void long_lists_are_drawn_as_by_brute(void **state) {
  (void)state;
  for (int kind = 0; kind < 5; kind++)
    for (int fill = 0; fill < 2; fill++) {
      struct scene scene;
      recto_options options;
      size_t length;
      start(&scene, &options);
      add_scene(&scene, kind);
      options.ink.fill = fill ? RECTO_FILL_PAINT : RECTO_FILL_NONE;
      char *right = pipeline_draw(&scene, &options, &solver_brute, &length);
      for (const struct solver *const *s = bounded; *s != NULL; s++) {
        char *text = pipeline_draw(&scene, &options, *s, &length);
        if (strcmp(right, text) != 0)
          fail_msg("kind %d by %s, fill %d", kind, solver_name(*s), fill);
        mem_free(text);
      }
      mem_free(right);
      scene_fini(&scene);
    }
}

static int64_t left_over(const struct solver *solver, recto_fill fill,
                         const char *name) {
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  int64_t count;
  start(&scene, &options);
  add_piercing(&scene, 60, false);
  options.ink.fill = fill;
  pipeline_run(&pipeline, &scene, &options, solver);
  assert_int_equal(pipeline.status, RECTO_OK);
  count = report_get(pipeline.report, solver_name(solver), name, 0);
  pipeline_fini(&pipeline);
  scene_fini(&scene);
  return count;
}

static void faces_that_pierce_too_many_are_deferred(void **state) {
  (void)state;
  assert_true(left_over(&solver_warnock, RECTO_FILL_NONE, "deferred") > 0);
  assert_true(left_over(&solver_newell, RECTO_FILL_NONE, "without_order") > 50);
  assert_true(left_over(&solver_watkins, RECTO_FILL_PAINT, "deferred") > 0);
}

/* ---- Memory -------------------------------------------------------------- */

/* Draws 200 triangles that pierce each other. */
static bool draw_piercing(const void *solver) {
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  start(&scene, &options);
  add_piercing(&scene, 200, false);
  pipeline_run(&pipeline, &scene, &options, solver);
  return pipeline.status == RECTO_OK;
}

/* They have 20,000 intersections; warnock once took 300 MB, watkins found more
 * places than it may, and newell did not end. */
static void two_hundred_piercing_triangles_take_little_memory(void **state) {
  (void)state;
#if SANITIZER_OF_ADDRESSES
  skip(); /* what is freed is kept, and counts */
#else
  for (const struct solver *const *s = bounded; *s != NULL; s++)
    assert_in_range(memory_peak_of(draw_piercing, *s), 1, 64 << 20);
#endif
}

/* ---- Ends ---------------------------------------------------------------- */

struct patience {
  int polled, most;
};

static bool stop_in_a_while(void *user, double share, const char *stage) {
  struct patience *patience = user;
  assert_true(share >= 0 && share <= 1);
  assert_non_null(stage);
  return ++patience->polled < patience->most;
}

/* Solves for lines and faces. */
static recto_status solve(struct sheet_fixture *fixture,
                          const struct solver *solver,
                          struct patience *patience) {
  const struct solver_request request = {
      .edges = true, .fragments = true, .intersections = true, .threads = 1};
  struct polled polled;
  size_t edges = fixture->sheet.edge.count, points = fixture->sheet.point.count;
  struct report *report = report_create();
  struct map map;
  recto_error error;
  map_init(&map);
  polled_begin(&polled, stop_in_a_while, patience);
  recto_status status =
      solver->solve(&fixture->sheet, &request, &map, report, &error);
  polled_end(&polled);
  map_fini(&map);
  report_destroy(report);
  fixture->sheet.edge.count = edges;
  fixture->sheet.point.count = points;
  return status;
}

static void cancelling_ends_the_work_at_any_time(void **state) {
  struct sheet_fixture fixture;
  (void)state;
  sheet_fixture_start(&fixture);
  add_piercing(&fixture.scene, 60, false);
  sheet_fixture_out(&fixture, true);
  for (const struct solver *const *s = bounded; *s != NULL; s++) {
    recto_status status = RECTO_ERROR_CANCELLED;
    for (int most = 1; status != RECTO_OK; most += 1 + most / 4) {
      struct patience patience = {0, most};
      status = solve(&fixture, *s, &patience);
      assert_true(patience.polled <= most);
      assert_int_equal(status, patience.polled == most ? RECTO_ERROR_CANCELLED
                                                       : RECTO_OK);
    }
  }
  sheet_fixture_fini(&fixture);
}

static void running_out_of_memory_is_reported(void **state) {
  struct sheet_fixture fixture;
  (void)state;
  sheet_fixture_start(&fixture);
  add_piercing(&fixture.scene, 24, false);
  sheet_fixture_out(&fixture, true);
  for (const struct solver *const *s = bounded; *s != NULL; s++) {
    struct memory_faults faults = {.least = 10, .in_a_row = 20};
    while (memory_faults_go_on(&faults)) {
      struct patience patience = {0, 1 << 30};
      memory_faults_begin(&faults);
      memory_faults_end(&faults, solve(&fixture, *s, &patience));
      faults.allocation += faults.allocation / 32;
    }
  }
  sheet_fixture_fini(&fixture);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(long_lists_are_drawn_as_by_brute),
      cmocka_unit_test(faces_that_pierce_too_many_are_deferred),
      cmocka_unit_test(two_hundred_piercing_triangles_take_little_memory),
      cmocka_unit_test(cancelling_ends_the_work_at_any_time),
      cmocka_unit_test(running_out_of_memory_is_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
