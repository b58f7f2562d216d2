/* test_api_memory_faults.c - where memory runs out, calls that take and give
 * data end with an error, and leave what they were given as it was. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/box_mesh.h"
#include "tests/memory_faults.h"

/* A box in a box that is open at its front, so that something is hidden. */
static const double points[] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0,
                                0, 0, 4, 4, 0, 4, 4, 4, 4, 0, 4, 4,
                                1, 1, 1, 3, 1, 1, 3, 3, 1, 1, 3, 1};
static const uint32_t corners[] = {3, 2, 1, 0, 0, 1, 5, 4, 1,  2,  6, 5,
                                   2, 3, 7, 6, 3, 0, 4, 7, 11, 10, 9, 8};
static const uint32_t groups[] = {0, 0, 0, 0, 1, 1};
static const char *const names[] = {"box", "card"};
static const recto_mesh mesh = {.points = points,
                                .point_count = 12,
                                .corners = corners,
                                .corner_count = 24,
                                .face_size = 4,
                                .face_groups = groups,
                                .group_names = names,
                                .group_count = 2};

static bool count_bytes(void *user, const void *bytes, size_t count) {
  (void)bytes;
  *(size_t *)user += count;
  return true;
}

/* The size of the scene's drawing as SVG. */
static size_t size_of(const recto_scene *scene) {
  recto_drawing *drawing;
  size_t size = 0;
  assert_int_equal(recto_scene_render(scene, NULL, &drawing, NULL), RECTO_OK);
  assert_int_equal(
      recto_drawing_write_to(drawing, "svg", NULL, count_bytes, &size, NULL),
      RECTO_OK);
  recto_drawing_destroy(drawing);
  return size;
}

static void a_mesh_is_added_whole_or_not_at_all(void **state) {
  (void)state;
  static const double far[] = {90, 0, 0, 91, 0, 0, 90, 1, 0};
  static const uint32_t three[] = {0, 1, 2};
  const recto_mesh other = {
      .points = far, .point_count = 3, .corners = three, .corner_count = 3};
  struct memory_faults faults = {.least = 1};
  recto_scene *plain = box_scene(&mesh);
  size_t size = size_of(plain);
  recto_scene_destroy(plain);
  while (memory_faults_go_on(&faults)) {
    recto_scene *scene = box_scene(&mesh);
    memory_faults_begin(&faults);
    recto_status status = recto_scene_add_mesh(scene, &other, NULL);
    memory_faults_end(&faults, status);
    if (status != RECTO_OK)
      assert_int_equal(size_of(scene), size);
    recto_scene_destroy(scene);
  }
}

static void a_model_in_memory_is_read_whole_or_not_at_all(void **state) {
  (void)state;
  static const char obj[] = "v 90 0 0\nv 91 0 0\nv 90 1 0\ng far\nf 1 2 3\n"
                            "f 1 1 1\n";
  struct memory_faults faults = {.least = 3};
  recto_scene *plain = box_scene(&mesh);
  size_t size = size_of(plain);
  recto_scene_destroy(plain);
  while (memory_faults_go_on(&faults)) {
    recto_scene *scene = box_scene(&mesh);
    memory_faults_begin(&faults);
    recto_status status = recto_scene_read_memory(scene, obj, sizeof obj - 1,
                                                  "obj", "far.obj", NULL, NULL);
    memory_faults_end(&faults, status);
    if (status != RECTO_OK)
      assert_int_equal(size_of(scene), size);
    recto_scene_destroy(scene);
  }
}

static void a_scene_that_could_not_be_prepared_is_drawn(void **state) {
  (void)state;
  struct memory_faults faults = {.least = 5};
  recto_scene *scene = box_scene(&mesh);
  size_t size = size_of(scene);
  while (memory_faults_go_on(&faults)) {
    memory_faults_begin(&faults);
    memory_faults_end(&faults, recto_scene_prepare(scene, NULL, NULL));
    assert_int_equal(size_of(scene), size);
  }
  recto_scene_destroy(scene);
}

static void check_results(const recto_drawing *drawing) {
  recto_edge edge;
  size_t loops, half_edges;
  assert_int_equal(recto_drawing_edge_count(drawing), 16);
  for (size_t i = 0; i < 16; i++) {
    assert_true(recto_drawing_edge(drawing, i, &edge));
    assert_true(edge.interval_count > 0);
  }
  assert_true(recto_drawing_fragment_count(drawing) > 3);
  assert_non_null(recto_drawing_loops(drawing, &loops));
  assert_non_null(recto_drawing_half_edges(drawing, &half_edges));
  assert_true(half_edges >= 3 * loops);
}

/* A drawing may do without what only makes it fast, or without statistics, so
 * that not every failure is an error. */
static void a_drawing_has_all_of_its_results_or_is_none(void **state) {
  (void)state;
  recto_scene *scene = box_scene(&mesh);
  recto_options options;
  struct memory_faults faults = {.least = 50, .in_a_row = 100};
  recto_options_init(&options);
  options.results = RECTO_RESULTS_ALL;
  options.solver.threads = 1;
  while (memory_faults_go_on(&faults)) {
    recto_drawing *drawing = NULL;
    memory_faults_begin(&faults);
    recto_status status = recto_scene_render(scene, &options, &drawing, NULL);
    memory_faults_end(&faults, status);
    assert_true((drawing != NULL) == (status == RECTO_OK));
    if (status == RECTO_OK)
      check_results(drawing);
    recto_drawing_destroy(drawing);
  }
  recto_scene_destroy(scene);
}

static void nothing_is_handed_over_of_an_output_that_failed(void **state) {
  (void)state;
  recto_scene *scene = box_scene(&mesh);
  recto_drawing *drawing;
  assert_int_equal(recto_scene_render(scene, NULL, &drawing, NULL), RECTO_OK);
  struct memory_faults faults = {.least = 1};
  while (memory_faults_go_on(&faults)) {
    size_t size = 0;
    memory_faults_begin(&faults);
    memory_faults_end(&faults,
                      recto_drawing_write_to(drawing, "svgz", NULL, count_bytes,
                                             &size, NULL));
    assert_true((size > 0) == faults.succeeded);
  }
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_mesh_is_added_whole_or_not_at_all),
      cmocka_unit_test(a_model_in_memory_is_read_whole_or_not_at_all),
      cmocka_unit_test(a_scene_that_could_not_be_prepared_is_drawn),
      cmocka_unit_test(a_drawing_has_all_of_its_results_or_is_none),
      cmocka_unit_test(nothing_is_handed_over_of_an_output_that_failed),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
