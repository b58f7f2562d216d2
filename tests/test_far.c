/* test_far.c - distant objects do not affect near ones: a castle with a ground
 * plane of any size below it, or a point that no face uses. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "recto.h"

struct view {
  const char *name;
  double azimuth, elevation, scale; /* orthographic, where scale > 0 */
  double eye[3], target[3], fov;
};

static const struct view views[] = {
    {.name = "iso", .azimuth = 45, .elevation = 35.26, .scale = 2},
    {.name = "front", .scale = 1.5},
    {"outside", .eye = {120, 60, 150}, .target = {0, 5, 0}, .fov = 40},
    {"yard", .eye = {0, 8, 12}, .target = {-20, 6, -10}, .fov = 60},
    {"yard, low", .eye = {3, 1.7, 5}, .target = {20, 8, -20}, .fov = 50},
};

static recto_options options_of(const struct view *view) {
  recto_options options;
  recto_options_init(&options);
  options.ink.edges = RECTO_EDGES_ALL;
  options.ink.ids = true;
  options.ink.min_stroke_mm = 0;
  options.verify = 400;
  options.camera.azimuth_deg = view->azimuth;
  options.camera.elevation_deg = view->elevation;
  options.camera.fit = view->scale > 0 ? RECTO_FIT_SCALE : RECTO_FIT_NONE;
  options.camera.has_target = true;
  if (view->scale > 0) {
    options.camera.scale = view->scale;
    return options;
  }
  options.camera.kind = RECTO_CAMERA_EYE;
  memcpy(options.camera.eye, view->eye, sizeof options.camera.eye);
  memcpy(options.camera.target, view->target, sizeof options.camera.target);
  options.camera.fov_deg = view->fov;
  return options;
}

static recto_scene *read_castle(void) {
  const char *srcdir = getenv("srcdir");
  char path[4096];
  recto_scene *scene;
  recto_error error;
  snprintf(path, sizeof path, "%s/examples/models/castle.obj",
           srcdir != NULL ? srcdir : ".");
  assert_int_equal(recto_scene_create(&scene, &error), RECTO_OK);
  assert_int_equal(recto_scene_read(scene, path, NULL, NULL, &error), RECTO_OK);
  return scene;
}

static uint32_t add_point(recto_scene *scene, double x, double y, double z) {
  const double at[3] = {x, y, z};
  uint32_t point;
  assert_int_equal(recto_scene_add_point(scene, at, &point, NULL), RECTO_OK);
  return point;
}

/* A level quad of that side, below the castle and in a group of its own. */
static void add_ground(recto_scene *scene, double side) {
  static const int sign[4][2] = {{-1, 1}, {1, 1}, {1, -1}, {-1, -1}};
  uint32_t corner[4];
  for (int k = 0; k < 4; k++)
    corner[k] =
        add_point(scene, sign[k][0] * side / 2, -4, sign[k][1] * side / 2);
  assert_int_equal(recto_scene_add_group(scene, "ground", NULL), RECTO_OK);
  assert_int_equal(recto_scene_add_face(scene, corner, 4, NULL), RECTO_OK);
}

static double stroke_length(const recto_stroke *stroke) {
  double sum = 0;
  for (size_t i = 1; i < stroke->count; i++)
    sum += hypot(stroke->points[2 * i] - stroke->points[2 * i - 2],
                 stroke->points[2 * i + 1] - stroke->points[2 * i - 1]);
  return sum;
}

/* That the ground goes on beyond the page is as it should be. */
static void count_warning(void *user, const char *file, unsigned long line,
                          const char *text) {
  (void)file, (void)line;
  print_message("%s\n", text);
  *(int *)user += strstr(text, "clipped at the page's margins") == NULL;
}

/* The length of the castle's own lines in mm; the drawing is verified.
 * ground  the group to leave out */
static double castle_length(recto_scene *scene, const struct view *view,
                            uint32_t ground) {
  recto_options options = options_of(view);
  recto_drawing *drawing;
  recto_error error = {.text = ""};
  double sum = 0;
  int warnings = 0;
  options.warning = count_warning;
  options.user = &warnings;
  recto_status status = recto_scene_render(scene, &options, &drawing, &error);
  if (status != RECTO_OK)
    fail_msg("%s: %s", view->name, error.text);
  assert_int_equal(warnings, 0);
  for (size_t i = 0; i < recto_drawing_stroke_count(drawing); i++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, i, &stroke));
    if (stroke.group != ground)
      sum += stroke_length(&stroke);
  }
  recto_drawing_destroy(drawing);
  return sum;
}

/* The groups of the castle's file, before the ground's. */
static uint32_t count_groups(recto_scene *scene) {
  recto_options options;
  recto_drawing *drawing;
  recto_options_init(&options);
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  const char *groups = strstr(recto_drawing_stats(drawing), "\"groups\":");
  assert_non_null(groups);
  uint32_t count = (uint32_t)strtoul(groups + strlen("\"groups\":"), NULL, 10);
  recto_drawing_destroy(drawing);
  return count;
}

static void a_ground_of_any_size_changes_nothing_above_it(void **state) {
  (void)state;
  recto_scene *castle = read_castle();
  uint32_t ground = count_groups(castle);
  for (size_t v = 0; v < sizeof views / sizeof views[0]; v++) {
    double alone = castle_length(castle, &views[v], ground);
    assert_true(alone > 1000);
    for (double side = 2e3; side < 1e9; side *= 10) {
      recto_scene *scene = read_castle();
      add_ground(scene, side);
      double length = castle_length(scene, &views[v], ground);
      if (!(fabs(length - alone) <= 1e-6 * alone))
        fail_msg("%s, ground %g: %.9g mm, not %.9g", views[v].name, side,
                 length, alone);
      recto_scene_destroy(scene);
    }
  }
  recto_scene_destroy(castle);
}

static void a_point_that_nothing_uses_changes_nothing(void **state) {
  (void)state;
  recto_scene *castle = read_castle(), *scene = read_castle();
  (void)add_point(scene, 1e9, 2e9, 3e9);
  for (size_t v = 0; v < sizeof views / sizeof views[0]; v++)
    assert_true(castle_length(castle, &views[v], UINT32_MAX) ==
                castle_length(scene, &views[v], UINT32_MAX));
  recto_scene_destroy(castle);
  recto_scene_destroy(scene);
}

/* An eye on a wall: the wall reaches nearer than any near plane. */
static void faces_clipped_by_the_near_plane_are_reported(void **state) {
  (void)state;
  recto_scene *scene;
  recto_options options;
  recto_drawing *drawing;
  int warnings = 0;
  uint32_t corner[3];
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  corner[0] = add_point(scene, -5, -5, -10);
  corner[1] = add_point(scene, 5, -5, -10);
  corner[2] = add_point(scene, 0, 4, 10);
  assert_int_equal(recto_scene_add_face(scene, corner, 3, NULL), RECTO_OK);
  recto_options_init(&options);
  options.camera.kind = RECTO_CAMERA_EYE;
  options.camera.fit = RECTO_FIT_NONE;
  options.camera.fov_deg = 60;
  options.camera.eye[1] = 1e-5 - 0.5;
  options.camera.has_target = true;
  options.camera.target[1] = -0.5;
  options.camera.target[2] = -10;
  options.warning = count_warning;
  options.user = &warnings;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  recto_drawing_destroy(drawing);
  assert_int_equal(warnings, 1);
  options.camera.near_distance = 1e-3;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  recto_drawing_destroy(drawing);
  assert_int_equal(warnings, 1);
  recto_scene_destroy(scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_ground_of_any_size_changes_nothing_above_it),
      cmocka_unit_test(a_point_that_nothing_uses_changes_nothing),
      cmocka_unit_test(faces_clipped_by_the_near_plane_are_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
