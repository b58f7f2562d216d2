/* test_watkins_exact.c - without a pitch Watkins gives the bytes of tiles:
 * soups, scenes of known failures, and models where found. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/read.h"
#include "tests/scenes/pipeline.h"
#include "tests/valgrind.h"

static void assert_same_as_tiles(const struct scene *scene,
                                 const recto_options *options,
                                 const char *name) {
  size_t length, want_length;
  char *want = pipeline_draw(scene, options, &solver_tiles, &want_length);
  char *text = pipeline_draw(scene, options, &solver_watkins, &length);
  assert_int_equal(strncmp(want, "<?xml", 5), 0);
  if (length != want_length || memcmp(text, want, length) != 0)
    fail_msg("%s: watkins disagrees with tiles", name);
  mem_free(text);
  mem_free(want);
}

static void soups_of_a_thousand_are_the_same(void **state) {
  int seeds = is_under_valgrind() ? 1 : 3;
  (void)state;
  for (int seed = 1; seed <= seeds; seed++) {
    struct scene scene;
    recto_options options;
    char name[32];
    snprintf(name, sizeof name, "soup %d", seed);
    recto_options_init(&options);
    scene_init(&scene);
    scenes_soup(&scene, &options, 1000, (uint64_t)seed);
    options.output.precision = 6;
    options.ink.edges = RECTO_EDGES_ALL;
    options.ink.fill = seed % 3 == 0 ? RECTO_FILL_NONE : RECTO_FILL_PAINT;
    options.camera.fov_deg = seed % 2 == 0 ? 40 : 0;
    assert_same_as_tiles(&scene, &options, name);
    scene_fini(&scene);
  }
}

/* Every scene of the list, from its own view. */
static void listed_scenes_are_the_same(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    recto_options options;
    pipeline_fill(&scene, &options, entry);
    options.ink.fill = RECTO_FILL_PAINT;
    assert_same_as_tiles(&scene, &options, entry->name);
    scene_fini(&scene);
  }
}

/* Compares on a model; false where it is not there. */
static bool compare_model(const char *folder, const char *name) {
  char path[1000];
  struct diagnostics silent = {.file = path};
  struct scene scene;
  recto_options options;
  bool there;
  recto_options_init(&options);
  options.camera.azimuth_deg = 27;
  options.camera.elevation_deg = 31;
  options.output.precision = 6;
  options.ink.fill = RECTO_FILL_PAINT;
  snprintf(path, sizeof path, "%.900s/%s.obj", folder, name);
  scene_init(&scene);
  there = scene_read(&scene, path, NULL, &silent, NULL) == RECTO_OK;
  if (there)
    assert_same_as_tiles(&scene, &options, name);
  scene_fini(&scene);
  return there;
}

static void models_are_the_same(void **state) {
  static const char *const name[] = {"teapot", "suzanne", "spot", "fandisk",
                                     "cow"};
  const char *folder = getenv("RECTO_MODELS");
  (void)state;
  if (folder == NULL || is_under_valgrind())
    skip();
  for (size_t i = 0; i < sizeof name / sizeof *name; i++)
    if (!compare_model(folder, name[i]))
      print_message("no %s\n", name[i]);
}

static void the_example_models_are_drawn_alike(void **state) {
  const char *source = getenv("srcdir");
  char folder[600];
  (void)state;
  if (is_under_valgrind())
    skip();
  snprintf(folder, sizeof folder, "%.500s/examples/models",
           source != NULL ? source : ".");
  assert_true(compare_model(folder, "castle"));
  assert_true(compare_model(folder, "knot"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(soups_of_a_thousand_are_the_same),
      cmocka_unit_test(listed_scenes_are_the_same),
      cmocka_unit_test(models_are_the_same),
      cmocka_unit_test(the_example_models_are_drawn_alike),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
