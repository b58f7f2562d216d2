/* test_judged.c - drawings of hard scenes and of real meshes, sampled every
 * 0.02 mm by an independent judge: no drawn point is hidden and no visible
 * point of a requested edge is without ink. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "judge/svg/svg.h"
#include "scene/read.h"
#include "tests/judged.h"
#include "tests/scenes/judge_camera.h"
#include "tests/temporary.h"
#include "tests/valgrind.h"
#include "view/camera_aim.h"

static void the_shared_scenes_are_drawn_right(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    recto_options options;
    pipeline_fill(&scene, &options, entry);
    /* Sheets nearer to each other than the distance by which the judge's rays
     * are moved are left to test_failures_lines. */
    if (strncmp(entry->name, "sheets ", 7) != 0 ||
        strstr(entry->name, "1e-3") != NULL)
      judged_assert(&scene, &options, options.ink.edges, entry->name);
    scene_fini(&scene);
  }
}

static void eyes_in_degenerate_positions_see_all_that_is_visible(void **state) {
  (void)state;
  for (int eye = SCENES_EYE_INSIDE; eye <= SCENES_EYE_ON_LINE; eye++) {
    struct scene scene;
    recto_options options;
    char name[32];
    snprintf(name, sizeof name, "eye %d", eye);
    recto_options_init(&options);
    scene_init(&scene);
    scenes_room(&scene, &options, (enum scenes_eye)eye);
    options.ink.min_stroke_mm = 0;
    options.output.precision = 6;
    options.ink.edges = RECTO_EDGES_ALL;
    judged_assert(&scene, &options, options.ink.edges, name);
    struct pipeline pipeline;
    pipeline_run(&pipeline, &scene, &options, &solver_newell);
    assert_true(pipeline_length(&pipeline, RECTO_EDGES_ALL, false) > 50);
    pipeline_fini(&pipeline);
    scene_fini(&scene);
  }
}

static void surfaces_do_not_leak_at_any_step(void **state) {
  (void)state;
  for (unsigned n = 5; n <= 26; n += 7) {
    static void (*const fill[])(struct scene *, recto_options *,
                                unsigned) = {scenes_paraboloid, scenes_sinc};
    for (size_t i = 0; i < 2; i++) {
      struct scene scene;
      recto_options options;
      char name[32];
      snprintf(name, sizeof name, "surface %u, %u cells", (unsigned)i, n);
      recto_options_init(&options);
      scene_init(&scene);
      fill[i](&scene, &options, n);
      options.ink.min_stroke_mm = 0;
      options.output.precision = 6;
      judged_assert(&scene, &options, options.ink.edges, name);
      scene_fini(&scene);
    }
  }
}

static void random_small_scenes_are_drawn_right(void **state) {
  (void)state;
  uint64_t count = is_under_valgrind() ? 10 : 150;
  for (uint64_t seed = 0; seed < count; seed++) {
    struct scene scene;
    recto_options options;
    struct camera camera;
    char name[32];
    snprintf(name, sizeof name, "seed %lu", (unsigned long)seed);
    recto_options_init(&options);
    scene_init(&scene);
    scenes_small(&scene, &options, seed);
    options.ink.min_stroke_mm = 0;
    options.output.precision = 6;
    /* Without a contact tolerance the grid decides, which doubles cannot. */
    options.solver.contact = -1;
    if (camera_aim(&camera, &scene, &options, NULL) == RECTO_OK)
      judged_assert(&scene, &options,
                    options.ink.edges & ~(unsigned)RECTO_EDGE_INTERSECTION,
                    name);
    scene_fini(&scene);
  }
}

/* ---- Real meshes --------------------------------------------------------- */

/* Reads a model; false where it is not there. */
static bool read_model(struct scene *scene, char *path, size_t room,
                       const char *folder, const char *name) {
  if (folder == NULL)
    return false;
  snprintf(path, room, "%s/%s.obj", folder, name);
  scene_init(scene);
  struct diagnostics silent = {.file = path};
  if (scene_read(scene, path, NULL, &silent, NULL) == RECTO_OK)
    return true;
  scene_fini(scene);
  return false;
}

/* The middle of the scene and the diagonal of its box. */
static struct judge_point3 middle_of(const struct scene *scene, double *size) {
  struct judge_point3 low = {INFINITY, INFINITY, INFINITY};
  struct judge_point3 high = {-INFINITY, -INFINITY, -INFINITY};
  for (size_t i = 0; i < scene->point.count; i++) {
    const struct scene_point *p = &scene->point.item[i];
    low = judge_point3_of(fmin(low.x, p->x), fmin(low.y, p->y),
                          fmin(low.z, p->z));
    high = judge_point3_of(fmax(high.x, p->x), fmax(high.y, p->y),
                           fmax(high.z, p->z));
  }
  *size = point3_length(point3_sub(high, low));
  return point3_along(low, 0.5, point3_sub(high, low));
}

/* Draws the model as --no-fit --camera ... --lookat ... --fov 30 --page
 * 200x200mm --margin 0 does, and checks the file with a camera from the
 * specification for that camera. */
static void check_model_of(void **state, const char *folder, const char *name,
                           unsigned edges) {
  char path[1000];
  struct scene scene;
  if (is_under_valgrind() ||
      !read_model(&scene, path, sizeof path, folder, name))
    skip();
  double size;
  struct judge_point3 target = middle_of(&scene, &size);
  struct judge_point3 eye =
      point3_along(target, 1.7 * size, judge_point3_of(0.6, 0.5, 0.62));
  recto_options options;
  recto_options_init(&options);
  options.camera.kind = RECTO_CAMERA_EYE;
  memcpy(options.camera.eye, (double[]){eye.x, eye.y, eye.z},
         sizeof options.camera.eye);
  memcpy(options.camera.target, (double[]){target.x, target.y, target.z},
         sizeof options.camera.target);
  options.camera.has_target = true;
  options.camera.fov_deg = 30;
  options.camera.fit = RECTO_FIT_NONE;
  options.page.width_mm = options.page.height_mm = 200;
  options.page.margin_mm = 0;
  options.ink.edges = edges;
  options.ink.min_stroke_mm =
      0; /* the judge reports even the shortest missing line */
  const char *file = temporary_path(state, "drawing.svg");
  assert_int_equal(recto_draw_file(path, NULL, file, NULL, &options, NULL),
                   RECTO_OK);
  size_t length;
  char *text = temporary_read(file, &length);
  struct judge_drawing drawing;
  struct judge_camera camera;
  struct judge_options judging;
  struct judge_verdict verdict;
  assert_non_null(text);
  assert_null(judge_read_svg(&drawing, text, length));
  judge_camera_look(&camera, eye, target, judge_point3_of(0, 1, 0), 30, 200,
                    200, 0);
  judge_options_init(&judging);
  judging.edges = edges;
  assert_true(judge_drawing(&verdict, &drawing, &scene, &camera, &judging));
  assert_true(verdict.drawn.samples > 10000 && verdict.visible.samples > 10000);
  if (verdict.false_ink.samples > 0 || verdict.missing.samples > 0)
    fail_msg("%s: false ink in %lu of %lu samples (%.3f %.3f), missing in %lu "
             "of %lu (%.3f %.3f)",
             name, (unsigned long)verdict.false_ink.samples,
             (unsigned long)verdict.drawn.samples, verdict.false_at.at.x,
             verdict.false_at.at.y, (unsigned long)verdict.missing.samples,
             (unsigned long)verdict.visible.samples, verdict.missing_at.at.x,
             verdict.missing_at.at.y);
  judge_drawing_fini(&drawing);
  free(text);
  scene_fini(&scene);
}

/* One of the real meshes, where they are. */
static void check_model(void **state, const char *name, unsigned edges) {
  check_model_of(state, getenv("RECTO_MODELS"), name, edges);
}

static void the_example_models_are_drawn_right(void **state) {
  const char *source = getenv("srcdir");
  char folder[600];
  snprintf(folder, sizeof folder, "%s/examples/models",
           source != NULL ? source : ".");
  check_model_of(state, folder, "castle", RECTO_EDGES_DEFAULT);
  check_model_of(state, folder, "gears", RECTO_EDGES_DEFAULT);
  check_model_of(state, folder, "knot", RECTO_EDGES_DEFAULT);
}

static void spot_is_drawn_right(void **state) {
  check_model(state, "spot", RECTO_EDGES_DEFAULT);
  check_model(state, "spot", RECTO_EDGES_ALL);
}

static void the_bunny_is_drawn_right(void **state) {
  check_model(state, "stanford-bunny", RECTO_EDGES_DEFAULT);
}

static void all_edges_of_the_bunny_are_drawn_right(void **state) {
  check_model(state, "stanford-bunny", RECTO_EDGES_ALL);
}

static void other_models_are_drawn_right(void **state) {
  check_model(state, "teapot", RECTO_EDGES_DEFAULT);
  check_model(state, "fandisk", RECTO_EDGES_DEFAULT);
  check_model(state, "cow", RECTO_EDGES_DEFAULT);
}

#define WITH_FOLDER(test)                                                      \
  cmocka_unit_test_setup_teardown(test, temporary_set_up, temporary_tear_down)

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_shared_scenes_are_drawn_right),
      cmocka_unit_test(eyes_in_degenerate_positions_see_all_that_is_visible),
      cmocka_unit_test(surfaces_do_not_leak_at_any_step),
      cmocka_unit_test(random_small_scenes_are_drawn_right),
      WITH_FOLDER(the_example_models_are_drawn_right),
      WITH_FOLDER(spot_is_drawn_right),
      WITH_FOLDER(the_bunny_is_drawn_right),
      WITH_FOLDER(all_edges_of_the_bunny_are_drawn_right),
      WITH_FOLDER(other_models_are_drawn_right),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
