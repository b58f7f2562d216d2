/* test_smooth_margins.c - smooth contours of coarse meshes bulge beyond the
 * mesh: a drawing that fills its page has room for them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "tests/smooth_surfaces.h"
#include "tests/temporary.h"

#define MARGIN_MM 10.0

/* By what two drawings of one outline may differ: coordinates are rounded to
 * the grid of the page, and lines are simplified by less than this. */
#define TOLERANCE_MM 0.02

/* Contours beyond the margins by no more than a quarter of this are moved
 * there. */
#define PEN_MM 0.04

struct box {
  double low[2], high[2];
};

static struct box box_of(const recto_drawing *drawing, unsigned classes) {
  struct box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, s, &stroke));
    if (!(stroke.edge_class & classes))
      continue;
    for (size_t i = 0; i < 2 * stroke.count; i++) {
      box.low[i % 2] = fmin(box.low[i % 2], stroke.points[i]);
      box.high[i % 2] = fmax(box.high[i % 2], stroke.points[i]);
    }
  }
  return box;
}

/* How much of the page inside its margins the drawing fills, the larger share
 * of width and height; fails where it leaves that. */
static double filled(const recto_drawing *drawing) {
  struct box box = box_of(drawing, RECTO_EDGES_ALL);
  double page[2], most = 0;
  recto_drawing_page(drawing, page);
  for (int k = 0; k < 2; k++) {
    assert_true(box.low[k] > MARGIN_MM - 0.001);
    assert_true(box.high[k] < page[k] - MARGIN_MM + 0.001);
    most = fmax(most, (box.high[k] - box.low[k]) / (page[k] - 2 * MARGIN_MM));
  }
  return most;
}

/* How far the points of a drawing are from the ink of another one of the same
 * scale, mm, where the middles of their boxes are one place. */
static double distance_apart(const recto_drawing *drawing,
                             const recto_drawing *other) {
  struct box a = box_of(drawing, RECTO_EDGES_ALL),
             b = box_of(other, RECTO_EDGES_ALL);
  double most = 0;
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, s, &stroke));
    for (size_t i = 0; i < stroke.count; i++) {
      double at[2];
      for (int k = 0; k < 2; k++)
        at[k] = stroke.points[2 * i + (size_t)k] +
                (b.low[k] + b.high[k] - a.low[k] - a.high[k]) / 2;
      most = fmax(most, smooth_distance_to_ink(other, RECTO_EDGES_ALL, at));
    }
  }
  return most;
}

/* Draws the same view at a scale, on a page beyond which nothing is. */
static recto_drawing *draw_at_scale(const recto_scene *scene,
                                    const recto_options *options,
                                    double scale) {
  recto_options of = *options;
  of.sheet = (recto_sheet_options){.arrangement = RECTO_ARRANGEMENT_NONE};
  of.camera.fit = RECTO_FIT_SCALE;
  of.camera.scale = scale;
  of.page.width_mm = of.page.height_mm = 600;
  return smooth_draw(scene, &of);
}

/* A drawing that fills the page, and the same at the same scale on a larger
 * page, differ by that little. */
static void check_shape(const recto_scene *scene, const recto_options *options,
                        const char *what) {
  enum { X, Y };
  recto_drawing *drawing = smooth_draw(scene, options);
  recto_drawing *other = draw_at_scale(scene, options, 60);
  struct box box = box_of(drawing, RECTO_EDGES_ALL),
             wanted = box_of(other, RECTO_EDGES_ALL);
  double ratio[2];
  for (int k = 0; k < 2; k++)
    ratio[k] = (box.high[k] - box.low[k]) / (wanted.high[k] - wanted.low[k]);
  recto_drawing_destroy(other);
  if (!(fabs(ratio[X] / ratio[Y] - 1) < TOLERANCE_MM / 100))
    fail_msg("%s is %g times as wide, and %g times as high", what, ratio[X],
             ratio[Y]);
  other = draw_at_scale(scene, options, 60 * (ratio[X] + ratio[Y]) / 2);
  double mm = distance_apart(drawing, other);
  if (!(mm < TOLERANCE_MM))
    fail_msg("%s is %g mm from its shape", what, mm);
  double share = filled(drawing);
  if (!(share > 1 - TOLERANCE_MM / 190))
    fail_msg("%s fills %g of the page", what, share);
  recto_drawing_destroy(other);
  recto_drawing_destroy(drawing);
}

struct mesh {
  const char *name;
  smooth_surface *at;
  bool poles;
};

static const struct mesh meshes[] = {{"sphere", smooth_sphere, true},
                                     {"ellipsoid", smooth_ellipsoid, true},
                                     {"torus", smooth_torus, false}};
enum { MESHES = sizeof meshes / sizeof meshes[0] };

/* In parallel and in perspective views. */
static void the_outline_is_round_at_the_margins(void **state) {
  static const int sides[] = {12, 16, 24, 32};
  (void)state;
  for (size_t m = 0; m < MESHES; m++)
    for (size_t k = 0; k < sizeof sides / sizeof sides[0]; k++) {
      recto_scene *scene =
          smooth_scene(meshes[m].at, meshes[m].poles, sides[k], sides[k] / 2);
      for (int view = 0; view < SMOOTH_VIEWS; view++) {
        recto_options options, direction;
        char what[64];
        smooth_view(&direction, view);
        recto_options_init(&options);
        options.camera.azimuth_deg = direction.camera.azimuth_deg;
        options.camera.elevation_deg = direction.camera.elevation_deg;
        options.ink.contours = RECTO_CONTOURS_SMOOTH;
        options.camera.fov_deg = view % 4 == 3 ? 30 : 0;
        options.ink.pen_mm = PEN_MM;
        snprintf(what, sizeof what, "view %d of the %s of %d", view,
                 meshes[m].name, sides[k]);
        check_shape(scene, &options, what);
      }
      recto_scene_destroy(scene);
    }
}

/* Of the one view of a sheet. */
static void it_is_on_sheets(void **state) {
  static const recto_sheet_view view = {.name = NULL}; /* the camera's */
  (void)state;
  for (size_t m = 0; m < MESHES; m++) {
    recto_scene *scene = smooth_scene(meshes[m].at, meshes[m].poles, 16, 8);
    recto_options options;
    recto_options_init(&options);
    options.camera.azimuth_deg = 17;
    options.ink.contours = RECTO_CONTOURS_SMOOTH;
    options.sheet.arrangement = RECTO_ARRANGEMENT_FIRST;
    options.sheet.view = &view;
    options.sheet.view_count = 1;
    check_shape(scene, &options, meshes[m].name);
    recto_scene_destroy(scene);
  }
}

/* Adds a triangle in the middle of a torus. */
static void add_triangle(recto_scene *scene) {
  uint32_t corner[3];
  for (int i = 0; i < 3; i++) {
    const double at[3] = {0.2 * cos(2 * i), 0.2 * sin(2 * i), 0};
    assert_int_equal(recto_scene_add_point(scene, at, &corner[i], NULL),
                     RECTO_OK);
  }
  assert_int_equal(recto_scene_add_face(scene, corner, 3, NULL), RECTO_OK);
}

/* Drawings at a scale, and exact ones, are those that were fitted to the mesh:
 * the borders of a triangle are in the same place. */
static void exact_drawings_are_fitted_to_the_mesh(void **state) {
  (void)state;
  recto_scene *scene = smooth_scene(smooth_torus, false, 32, 16);
  recto_options options;
  recto_drawing *drawing[3];
  add_triangle(scene);
  for (int k = 0; k < 3; k++) {
    recto_options_init(&options);
    options.camera.azimuth_deg = 17;
    options.ink.edges = RECTO_EDGE_SILHOUETTE | RECTO_EDGE_BORDER;
    options.ink.exact = k != 2;
    options.ink.contours = k == 0 ? RECTO_CONTOURS_MESH : RECTO_CONTOURS_SMOOTH;
    drawing[k] = smooth_draw(scene, &options);
  }
  struct box mesh = box_of(drawing[0], RECTO_EDGE_BORDER),
             exact = box_of(drawing[1], RECTO_EDGE_BORDER),
             other = box_of(drawing[2], RECTO_EDGE_BORDER);
  for (int k = 0; k < 2; k++) {
    assert_true(exact.low[k] == mesh.low[k] && exact.high[k] == mesh.high[k]);
    assert_true(other.high[k] - other.low[k] < mesh.high[k] - mesh.low[k]);
  }
  for (int k = 0; k < 3; k++)
    recto_drawing_destroy(drawing[k]);
  recto_scene_destroy(scene);
}

/* Adds a triangle before a sphere, seen from the front. */
static void add_front(recto_scene *scene, const struct smooth_axes *axes) {
  uint32_t corner[3];
  for (int i = 0; i < 3; i++) {
    double at[3];
    for (int k = 0; k < 3; k++)
      at[k] =
          0.9 * (cos(2.1 * i) * axes->right[k] + sin(2.1 * i) * axes->up[k]) +
          2 * axes->back[k];
    assert_int_equal(recto_scene_add_point(scene, at, &corner[i], NULL),
                     RECTO_OK);
  }
  assert_int_equal(recto_scene_add_face(scene, corner, 3, NULL), RECTO_OK);
}

/* A drawing is checked where it was fitted to smooth contours: its borders,
 * which are a third of the lines and more, are found. */
static void they_are_checked_there(void **state) {
  static const recto_sheet_view view = {.name = NULL};
  const char *path = temporary_path(state, "sphere.svg");
  recto_scene *scene = smooth_scene(smooth_sphere, true, 12, 6);
  recto_options options, direction;
  smooth_view(&direction, 0);
  const struct smooth_axes axes = smooth_axes_of(&direction);
  add_front(scene, &axes);
  for (int is_sheet = 0; is_sheet < 2; is_sheet++) {
    recto_verdict verdict;
    recto_options_init(&options);
    options.camera.azimuth_deg = direction.camera.azimuth_deg;
    options.camera.elevation_deg = direction.camera.elevation_deg;
    options.ink.edges = RECTO_EDGE_SILHOUETTE | RECTO_EDGE_BORDER;
    options.ink.contours = RECTO_CONTOURS_SMOOTH;
    if (is_sheet) {
      options.sheet.arrangement = RECTO_ARRANGEMENT_FIRST;
      options.sheet.view = &view;
      options.sheet.view_count = 1;
    }
    recto_drawing *drawing = smooth_draw(scene, &options);
    assert_int_equal(recto_drawing_write(drawing, path, "svg", &options, NULL),
                     RECTO_OK);
    recto_drawing_destroy(drawing);
    assert_int_equal(recto_scene_check(scene, path, &options, &verdict, NULL),
                     RECTO_OK);
    assert_true(verdict.missing_mm < 2 * verdict.visible_mm / 3);
    assert_true(verdict.false_mm < 2 * verdict.drawn_mm / 3);
  }
  recto_scene_destroy(scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_outline_is_round_at_the_margins),
      cmocka_unit_test(it_is_on_sheets),
      cmocka_unit_test(exact_drawings_are_fitted_to_the_mesh),
      cmocka_unit_test_setup_teardown(they_are_checked_there, temporary_set_up,
                                      temporary_tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
