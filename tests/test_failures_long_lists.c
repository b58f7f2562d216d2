/* test_failures_long_lists.c - many needles that overlap: the solvers finish
 * with the right drawing, and do not test all pairs. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/scenes/pipeline.h"
#include "tests/scenes/random.h"
#include "tests/scenes/solver_named.h"

static void fill_needles(struct scene *scene, recto_options *options,
                         enum scenes_needles kind, unsigned n) {
  recto_options_init(options);
  scene_init(scene);
  scenes_needles(scene, options, kind, n, 7 + kind);
  options->ink.edges = RECTO_EDGES_ALL;
  options->ink.min_stroke_mm = 0;
  options->output.precision = 6;
  options->solver.threads = 1;
}

/* The pairs tested, of edges with triangles and of triangles. */
static int64_t count_pairs_of(const struct scene *scene,
                              const recto_options *options,
                              const struct solver *solver) {
  struct pipeline pipeline;
  pipeline_run(&pipeline, scene, options, solver);
  assert_int_equal(pipeline.status, RECTO_OK);
  int64_t pairs =
      report_get(pipeline.report, "occlusion", "pairs", 0) +
      report_get(pipeline.report, "intersections", "pairs_tested", 0);
  pipeline_fini(&pipeline);
  return pairs;
}

static int64_t count_pairs(enum scenes_needles kind, unsigned n,
                           const struct solver *solver) {
  struct scene scene;
  recto_options options;
  fill_needles(&scene, &options, kind, n);
  int64_t pairs = count_pairs_of(&scene, &options, solver);
  scene_fini(&scene);
  return pairs;
}

static void pairs_grow_as_the_corners_do(void **state) {
  (void)state;
  /* Except for the umbrella, whose needles truly overlap. */
  for (int kind = 0; kind < SCENES_NEEDLES_UMBRELLA; kind++) {
    const unsigned n = 16000;
    int64_t pairs = count_pairs((enum scenes_needles)kind, n, &solver_tiles);
    /* All pairs would be 8000 times n. */
    if (pairs > 500 * (int64_t)n)
      fail_msg("kind %d: %ld pairs", kind, (long)pairs);
  }
}

/* Asserts that more than `segments_min` intersections are found, all of them,
 * and that at most `pairs_max` pairs of triangles are tested. */
static void assert_intersections(const struct scene *scene,
                                 int64_t segments_min, int64_t pairs_max) {
  recto_options options;
  int64_t segments[2];
  recto_options_init(&options);
  options.ink.edges = RECTO_EDGE_INTERSECTION;
  options.ink.hidden = RECTO_HIDDEN_LAYER; /* hidden ones count, too */
  options.solver.threads = 1;
  for (int k = 0; k < 2; k++) {
    struct pipeline pipeline;
    pipeline_run(&pipeline, scene, &options,
                 k == 0 ? &solver_tiles : &solver_brute);
    assert_int_equal(pipeline.status, RECTO_OK);
    segments[k] = report_get(pipeline.report, "intersections", "segments", 0);
    assert_in_range(
        report_get(pipeline.report, "intersections", "pairs_tested", 0),
        segments[k], pairs_max);
    pipeline_fini(&pipeline);
  }
  assert_true(segments[0] > segments_min);
  assert_int_equal(segments[0], segments[1]);
}

/* The triangles of one polygon are not tested with each other, but with what
 * pierces it, all of which is found. */
static void a_polygon_is_not_tested_with_itself(void **state) {
  (void)state;
  enum { CORNERS = 4000 };
  struct scene scene;
  struct random random = {3};
  double *xyz = calloc(CORNERS, 3 * sizeof *xyz);
  assert_non_null(xyz);
  for (int i = 0; i < CORNERS; i++)
    for (int k = 0; k < 2; k++)
      xyz[3 * i + k] = random_unit(&random);
  scene_init(&scene);
  build_polygon(&scene, xyz, CORNERS);
  free(xyz);
  for (int i = 1; i < 9; i++)
    build_parallelogram(&scene, vector_of(0.1 * i, 0.1, -0.5),
                        vector_of(0.01, 0.8, 0), vector_of(0, 0, 1));
  assert_intersections(&scene, CORNERS / 8, 100 * CORNERS);
  scene_fini(&scene);
}

/* Nor are triangles about one edge, but with what pierces them. */
static void pages_are_not_tested_with_each_other(void **state) {
  (void)state;
  enum { PAGES = 2000 };
  struct scene scene;
  scene_init(&scene);
  uint32_t a = build_point(&scene, 0, 0, -1), b = build_point(&scene, 0, 0, 1);
  for (int i = 0; i < PAGES; i++) {
    double angle = 2 * acos(-1) * i / PAGES;
    build_triangle(&scene, a, b,
                   build_point(&scene, cos(angle), sin(angle), 0));
  }
  build_parallelogram(&scene, vector_of(-2, 0.3, -0.5), vector_of(4, 0, 0),
                      vector_of(0, 0, 1));
  assert_intersections(&scene, PAGES / 4, 100 * PAGES);
  scene_fini(&scene);
}

/* Near copies of a slanted square all overlap in depth: each is tested with few
 * but those in contact with it, and with what pierces it. */
static void near_copies_are_tested_with_those_in_contact(void **state) {
  (void)state;
  enum { COPIES = 2000 };
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  recto_options_init(&options);
  scene_init(&scene);
  for (int i = 0; i < COPIES; i++)
    build_parallelogram(&scene, vector_of(0, 0, i * 0x1p-30),
                        vector_of(1, 0, 0), vector_of(0, 1, 0));
  for (int i = 1; i < 4; i++)
    build_parallelogram(&scene, vector_of(0.2 * i, 0.1, -0.3),
                        vector_of(0.1, 0.3, 0), vector_of(0, 0.01, 0.6));
  options.ink.edges = RECTO_EDGE_INTERSECTION;
  options.ink.hidden = RECTO_HIDDEN_LAYER; /* hidden ones count, too */
  options.solver.threads = 1;
  int64_t segments[2];
  for (int k = 0; k < 2; k++) {
    pipeline_run(&pipeline, &scene, &options,
                 k == 0 ? &solver_tiles : &solver_brute);
    assert_int_equal(pipeline.status, RECTO_OK);
    segments[k] = report_get(pipeline.report, "intersections", "segments", 0);
    /* All pairs would be 8 million. */
    assert_in_range(
        report_get(pipeline.report, "intersections", "pairs_tested", 0),
        segments[k], 2000 * COPIES);
    pipeline_fini(&pipeline);
  }
  assert_true(segments[0] > 2 * COPIES);
  assert_int_equal(segments[0], segments[1]);
  scene_fini(&scene);
}

/* The scenes are large enough for their lists to be split by a BSP. */
static void solvers_agree_on_long_lists(void **state) {
  (void)state;
  const struct solver *other[] = {&solver_tiles, &solver_warnock,
                                  &solver_newell};
  for (int kind = 0; kind < SCENES_NEEDLES_COUNT; kind++) {
    struct scene scene;
    recto_options options;
    size_t length;
    fill_needles(&scene, &options, (enum scenes_needles)kind, 1300);
    char *right = pipeline_draw(&scene, &options, &solver_brute, &length);
    for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
      char *text = pipeline_draw(&scene, &options, other[i], &length);
      if (strcmp(right, text) != 0)
        fail_msg("kind %d by %s", kind, solver_name(other[i]));
      mem_free(text);
    }
    mem_free(right);
    scene_fini(&scene);
  }
}

/* Of triangles around one edge a few near ones hide most edges of others, and a
 * BVH knows which triangles are behind an edge or beside it. */
static void edges_around_one_edge_are_tested_with_few(void **state) {
  (void)state;
  enum { PAGES = 4000 };
  struct scene scene;
  recto_options options;
  recto_options_init(&options);
  scene_init(&scene);
  uint32_t a = build_point(&scene, 0, 0, -1), b = build_point(&scene, 0, 0, 1);
  for (int i = 0; i < PAGES; i++) {
    double angle = 2 * acos(-1) * i / PAGES;
    build_triangle(&scene, a, b,
                   build_point(&scene, cos(angle), sin(angle), 0));
  }
  options.solver.threads = 1;
  int64_t pairs[2];
  for (int k = 0; k < 2; k++) {
    struct pipeline pipeline;
    options.solver.threads = k + 1;
    pipeline_run(&pipeline, &scene, &options, &solver_tiles);
    assert_int_equal(pipeline.status, RECTO_OK);
    pairs[k] = report_get(pipeline.report, "occlusion", "pairs", 0);
    pipeline_fini(&pipeline);
  }
  assert_true(pairs[0] < 100 * (int64_t)PAGES);
  assert_int_equal(pairs[0], pairs[1]);
  scene_fini(&scene);
}

static void a_bellows_of_1300_is_the_same_by_all(void **state) {
  (void)state;
  struct scene scene;
  recto_options options;
  size_t length;
  recto_options_init(&options);
  scene_init(&scene);
  scenes_fan(&scene, &options, 1300);
  options.solver.threads = 1;
  char *tiles = pipeline_draw(&scene, &options, &solver_tiles, &length);
  char *brute = pipeline_draw(&scene, &options, &solver_brute, &length);
  assert_string_equal(tiles, brute);
  mem_free(tiles);
  mem_free(brute);
  scene_fini(&scene);
}

static void triangles_100000_on_one_vertex_finish(void **state) {
  (void)state;
  (void)count_pairs(SCENES_NEEDLES_CONE, 100000, &solver_tiles);
}

static void check_soup(unsigned n, const struct solver *const *solver) {
  struct scene scene;
  recto_options options;
  char *first = NULL;
  size_t length;
  recto_options_init(&options);
  scene_init(&scene);
  scenes_soup(&scene, &options, n, 3);
  options.ink.edges = RECTO_EDGES_ALL;
  options.ink.min_stroke_mm = 0;
  options.output.precision = 6;
  options.solver.threads = 1;
  for (; *solver != NULL; solver++) {
    char *text = pipeline_draw(&scene, &options, *solver, &length);
    if (first == NULL)
      first = text;
    else if (strcmp(first, text) != 0)
      fail_msg("soup of %u by %s", n, solver_name(*solver));
    if (first != text)
      mem_free(text);
  }
  mem_free(first);
  scene_fini(&scene);
}

static void soups_that_pierce_are_the_same_by_all(void **state) {
  (void)state;
  const struct solver *const all[] = {&solver_brute, &solver_tiles,
                                      &solver_warnock, &solver_newell, NULL};
  check_soup(100, all);
  check_soup(1000, all);
}

static void a_soup_of_10000_is_the_same_by_tiles_and_warnock(void **state) {
  (void)state;
  const struct solver *const two[] = {&solver_tiles, &solver_warnock, NULL};
  check_soup(10000, two);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(pairs_grow_as_the_corners_do),
      cmocka_unit_test(a_polygon_is_not_tested_with_itself),
      cmocka_unit_test(pages_are_not_tested_with_each_other),
      cmocka_unit_test(near_copies_are_tested_with_those_in_contact),
      cmocka_unit_test(solvers_agree_on_long_lists),
      cmocka_unit_test(edges_around_one_edge_are_tested_with_few),
      cmocka_unit_test(a_bellows_of_1300_is_the_same_by_all),
      cmocka_unit_test(triangles_100000_on_one_vertex_finish),
      cmocka_unit_test(soups_that_pierce_are_the_same_by_all),
      cmocka_unit_test(a_soup_of_10000_is_the_same_by_tiles_and_warnock),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
