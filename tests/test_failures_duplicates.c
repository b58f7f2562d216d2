/* test_failures_duplicates.c - very many faces at nearly one position: the
 * solvers finish with the right drawing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/scenes/pipeline.h"
#include "tests/scenes/random.h"
#include "tests/scenes/solver_named.h"

static const struct solver *const quick[] = {&solver_tiles, &solver_newell,
                                             &solver_warnock, NULL};

static void start(struct scene *scene, recto_options *options) {
  recto_options_init(options);
  scene_init(scene);
  options->ink.edges = RECTO_EDGES_ALL;
  options->ink.min_stroke_mm = 0;
  options->output.precision = 6;
  options->solver.threads = 1;
  options->ink.ids = true;
}

/* Draws by every method what brute draws, lines and faces, and ends the
 * scene. */
static void agree(struct scene *scene, recto_options *options,
                  const char *what) {
  size_t length;
  for (int fill = 0; fill < 2; fill++) {
    options->ink.fill = fill ? RECTO_FILL_PAINT : RECTO_FILL_NONE;
    char *right = pipeline_draw(scene, options, &solver_brute, &length);
    for (const struct solver *const *s = quick; *s != NULL; s++) {
      char *text = pipeline_draw(scene, options, *s, &length);
      if (strcmp(right, text) != 0)
        fail_msg("%s by %s, fill %d", what, solver_name(*s), fill);
      mem_free(text);
    }
    mem_free(right);
  }
  scene_fini(scene);
}

static void duplicates_are_drawn_as_by_brute(void **state) {
  struct scene scene;
  recto_options options;
  (void)state;
  for (int eye = 0; eye < 2; eye++) {
    start(&scene, &options);
    scenes_duplicates(&scene, &options, 400, true, 0);
    options.camera.fov_deg = eye ? 40 : 0;
    agree(&scene, &options, "duplicates");
  }
}

static void near_duplicates_are_drawn_as_by_brute(void **state) {
  struct scene scene;
  recto_options options;
  (void)state;
  start(&scene, &options);
  scenes_duplicates(&scene, &options, 40, false, 1e-8);
  agree(&scene, &options, "near duplicates");
}

/* Boxes and separate walls at the same positions: their edges are not
 * duplicates though their walls are. */
static void add_boxes(struct scene *scene, struct random *random, unsigned n) {
  for (unsigned i = 0; i < n; i++) {
    double at = 0.25 * random_below(random, 2);
    if (random_below(random, 3) > 0)
      build_parallelepiped(scene, vector_of(at, 0, 0), vector_of(1, 0, 0),
                           vector_of(0, 1, 0), vector_of(0, 0, 1));
    else
      build_parallelogram(scene, vector_of(at, 0, 0), vector_of(1, 0, 0),
                          vector_of(0, 0, 1));
  }
  build_parallelogram(scene, vector_of(-1, -1, 0.5), vector_of(3, 0, 0),
                      vector_of(0, 3, 0.1));
}

static void duplicate_boxes_are_drawn_as_by_brute(void **state) {
  struct scene scene;
  recto_options options;
  struct random random = {5};
  (void)state;
  start(&scene, &options);
  add_boxes(&scene, &random, 100);
  agree(&scene, &options, "boxes");
}

static void pages_are_drawn_as_by_brute(void **state) {
  struct scene scene;
  recto_options options;
  (void)state;
  for (int turns = 1; turns <= 4; turns++) {
    start(&scene, &options);
    scenes_book(&scene, &options, 400, 0.25 * turns);
    agree(&scene, &options, "pages");
  }
}

/* ---- Work ---------------------------------------------------------------- */

/* Pairs that were tested: of edge and triangle, and of two triangles. */
static int64_t pairs_met(const struct report *report) {
  return report_get(report, "occlusion", "pairs", 0) +
         report_get(report, "intersections", "pairs_tested", 0) +
         report_get(report, "faces", "pairs", 0);
}

/* A face and its duplicates have 200 million pairs. */
static void duplicates_20000_cost_as_much_as_a_few_faces(void **state) {
  (void)state;
  for (int pierced = 0; pierced < 2; pierced++)
    for (const struct solver *const *s = quick; *s != NULL; s++) {
      struct scene scene;
      recto_options options;
      struct pipeline pipeline;
      start(&scene, &options);
      scenes_duplicates(&scene, &options, 20000, pierced != 0, 0);
      pipeline_run(&pipeline, &scene, &options, *s);
      assert_int_equal(pipeline.status, RECTO_OK);
      assert_in_range(pairs_met(pipeline.report), 1, 1000);
      pipeline_fini(&pipeline);
      scene_fini(&scene);
    }
}

/* 48 million pairs of edge and triangle are tested if each window tests every
 * edge all that its faces hide. */
static void warnock_stops_testing_hidden_edges(void **state) {
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  (void)state;
  start(&scene, &options);
  scenes_soup(&scene, &options, 1000, 3);
  pipeline_run(&pipeline, &scene, &options, &solver_warnock);
  assert_int_equal(pipeline.status, RECTO_OK);
  assert_in_range(report_get(pipeline.report, "occlusion", "pairs", 0), 1,
                  5000000);
  pipeline_fini(&pipeline);
  scene_fini(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(duplicates_are_drawn_as_by_brute),
      cmocka_unit_test(near_duplicates_are_drawn_as_by_brute),
      cmocka_unit_test(duplicate_boxes_are_drawn_as_by_brute),
      cmocka_unit_test(pages_are_drawn_as_by_brute),
      cmocka_unit_test(duplicates_20000_cost_as_much_as_a_few_faces),
      cmocka_unit_test(warnock_stops_testing_hidden_edges),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
