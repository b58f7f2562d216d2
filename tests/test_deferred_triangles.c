/* test_deferred_triangles.c - triangles that tiles defer are painted as by
 * the oracle, and mostly without subtracting anything. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/parallel.h"
#include "base/poll.h"
#include "tests/scenes/pipeline.h"

static void start(struct scene *scene, recto_options *options) {
  recto_options_init(options);
  scene_init(scene);
}

/* What --stats says of a painted scene by tiles. */
struct counts {
  int64_t hidden, whole, mixed, by_contours, united, pieces, pairs, culled;
};

static struct counts paint_in_threads(const struct scene *scene,
                                      recto_options *options, int threads) {
  struct pipeline pipeline;
  struct poll poll;
  struct counts counts;
  options->ink.fill = RECTO_FILL_PAINT;
  options->solver.threads = threads;
  poll_open(&poll, options);
  pipeline_run(&pipeline, scene, options, &solver_tiles);
  poll_close(&poll);
  assert_int_equal(pipeline.status, RECTO_OK);
  const struct report *report = pipeline.report;
  counts =
      (struct counts){report_get(report, "faces", "hidden", -1),
                      report_get(report, "faces", "whole", -1),
                      report_get(report, "faces", "mixed", -1),
                      report_get(report, "faces", "hidden_by_contours", -1),
                      report_get(report, "fragments", "faces_united", -1),
                      report_get(report, "fragments", "pieces_united", -1),
                      report_get(report, "faces", "pairs", -1),
                      report_get(report, "tiles", "triangles_culled", -1)};
  /* Each of them is one of the three. */
  assert_int_equal(counts.hidden + counts.whole + counts.mixed,
                   report_get(report, "tiles", "triangles_deferred", -1));
  pipeline_fini(&pipeline);
  return counts;
}

static struct counts paint(const struct scene *scene, recto_options *options) {
  return paint_in_threads(scene, options, 1);
}

static void assert_as_oracle(const struct scene *scene,
                             const recto_options *options) {
  size_t length[2];
  char *tiles = pipeline_draw(scene, options, &solver_tiles, &length[0]);
  char *brute = pipeline_draw(scene, options, &solver_brute, &length[1]);
  assert_true(length[0] > 1000);
  assert_string_equal(tiles, brute);
  mem_free(tiles);
  mem_free(brute);
}

/* Waves, one behind the other: silhouettes, and faces under whole layers. */
static void a_face_that_no_contour_crosses_is_not_split(void **state) {
  struct scene scene;
  recto_options options;
  (void)state;
  start(&scene, &options);
  scenes_sinc(&scene, &options, 60);
  options.camera.elevation_deg = 12;
  struct counts counts = paint(&scene, &options);
  assert_true(counts.by_contours > 20);
  assert_true(counts.mixed > 20);
  assert_true(counts.whole > counts.mixed);
  assert_as_oracle(&scene, &options);
  scene_fini(&scene);
}

/* n bars over n bars cross n^2 times. */
static void bars_over_bars_are_cut_where_they_cross(void **state) {
  struct scene scene;
  recto_options options;
  (void)state;
  start(&scene, &options);
  scenes_lattice(&scene, &options, 12);
  assert_true(paint(&scene, &options).mixed > 12);
  assert_as_oracle(&scene, &options);
  scene_fini(&scene);
}

/* Deep inside a sponge nearly all is hidden, by what is hidden itself; some of
 * it is culled before. */
static void most_of_a_sponge_is_hidden(void **state) {
  struct scene scene;
  recto_options options;
  (void)state;
  start(&scene, &options);
  scenes_menger(&scene, &options, 2);
  struct counts counts = paint(&scene, &options);
  assert_true(counts.hidden + counts.culled >
              2 * (counts.whole + counts.mixed));
  assert_true(counts.hidden > counts.whole + counts.mixed);
  assert_as_oracle(&scene, &options);
  scene_fini(&scene);
}

/* A face of very many corners: its sides are labelled in no time, too. */
static void a_face_may_have_very_many_corners(void **state) {
  (void)state;
  for (int bsp = 0; bsp < SCENES_NEEDLES_FLAT_FAN; bsp++) {
    struct scene scene;
    recto_options options;
    start(&scene, &options);
    scenes_needles(&scene, &options, (enum scenes_needles)bsp, 400, 5);
    (void)paint(&scene, &options);
    assert_as_oracle(&scene, &options);
    scene_fini(&scene);
    start(&scene, &options);
    scenes_needles(&scene, &options, (enum scenes_needles)bsp, 20000, 5);
    struct counts counts = paint(&scene, &options);
    assert_int_equal(counts.united, 1);
    scene_fini(&scene);
  }
}

/* Threads know of hidden triangles at the same times, however many there
 * are. */
static void threads_change_no_count(void **state) {
  (void)state;
  if (parallel_processors() < 2)
    skip();
  struct scene scene;
  recto_options options;
  start(&scene, &options);
  scenes_menger(&scene, &options, 3);
  struct counts one = paint_in_threads(&scene, &options, 1),
                two = paint_in_threads(&scene, &options, 2);
  assert_true(one.hidden + one.whole + one.mixed > 10000);
  assert_memory_equal(&one, &two, sizeof one);
  scene_fini(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_face_that_no_contour_crosses_is_not_split),
      cmocka_unit_test(bars_over_bars_are_cut_where_they_cross),
      cmocka_unit_test(most_of_a_sponge_is_hidden),
      cmocka_unit_test(a_face_may_have_very_many_corners),
      cmocka_unit_test(threads_change_no_count),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
