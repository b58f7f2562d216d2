/* test_smooth_dents.c - where a mesh samples a smooth surface well its folds
 * are no noise, however few edges they have. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/smooth_surfaces.h"

/* A sphere with six dents. */
static void dented(double u, double v, double p[3]) {
  double s = sin(v / 2), c = cos(v / 2);
  double size = 1 + 0.25 * sin(3 * u) * s * s * s * cos(2 * v);
  p[0] = size * s * cos(u);
  p[1] = size * c;
  p[2] = size * s * sin(u);
}

/* A ring whose tube has three ridges that wind about it. */
static void twisted(double u, double v, double p[3]) {
  double radius = 0.35 + 0.12 * cos(3 * v + 2 * u);
  double away = 1 + radius * cos(v);
  p[0] = away * cos(u);
  p[1] = radius * sin(v);
  p[2] = away * sin(u);
}

static recto_drawing *draw_from(const recto_scene *scene, double azimuth_deg,
                                double elevation_deg, recto_contours contours) {
  recto_options options;
  smooth_view(&options, 0);
  options.camera.azimuth_deg = azimuth_deg;
  options.camera.elevation_deg = elevation_deg;
  options.ink.contours = contours;
  options.ink.exact = false;
  return smooth_draw(scene, &options);
}

/* Coarse ridges are no creases. */
static recto_drawing *draw_twisted(const recto_scene *scene,
                                   const double view[2]) {
  recto_options options;
  smooth_view(&options, 0);
  options.camera.azimuth_deg = view[0];
  options.camera.elevation_deg = view[1];
  options.ink.contours = RECTO_CONTOURS_SMOOTH;
  options.ink.exact = false;
  options.mesh.crease_deg = 100;
  return smooth_draw(scene, &options);
}

/* The farthest that a point of one drawing's lines is from the ink of another
 * one, mm. */
static double farthest(const recto_drawing *of, const recto_drawing *from) {
  double most = 0;
  for (size_t s = 0; s < recto_drawing_stroke_count(of); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(of, s, &stroke));
    for (size_t i = 0; i < stroke.count; i++)
      most = fmax(most, smooth_distance_to_ink(from, RECTO_EDGES_ALL,
                                               stroke.points + 2 * i));
  }
  return most;
}

/* The length of one drawing's lines that is farther than `away` from the ink of
 * another one, mm. */
static double length_beyond(const recto_drawing *of, const recto_drawing *from,
                            double away) {
  double sum = 0;
  for (size_t s = 0; s < recto_drawing_stroke_count(of); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(of, s, &stroke));
    for (size_t i = 0; i + 1 < stroke.count; i++) {
      const double *p = stroke.points + 2 * i;
      const double at[2] = {(p[0] + p[2]) / 2, (p[1] + p[3]) / 2};
      if (smooth_distance_to_ink(from, RECTO_EDGES_ALL, at) > away)
        sum += hypot(p[2] - p[0], p[3] - p[1]);
    }
  }
  return sum;
}

/* Of folds without a zero set, of three to six outlines, nothing was drawn. */
static void folds_of_few_outlines_are_drawn(void **state) {
  (void)state;
  static const double view[][2] = {{48.4, 55.6}, {126, 64}, {134, -64}};
  recto_scene *coarse = smooth_scene(dented, true, 64, 32);
  recto_scene *fine = smooth_scene(dented, true, 256, 128);
  for (size_t i = 0; i < sizeof view / sizeof *view; i++) {
    recto_drawing *mesh =
        draw_from(fine, view[i][0], view[i][1], RECTO_CONTOURS_MESH);
    recto_drawing *drawing =
        draw_from(coarse, view[i][0], view[i][1], RECTO_CONTOURS_SMOOTH);
    double most = farthest(mesh, drawing);
    /* As far as their ends differ: a triangle's height is 4 mm. */
    if (!(most < 6))
      fail_msg("%g/%g degrees: a line is %g mm from ink", view[i][0],
               view[i][1], most);
    recto_drawing_destroy(mesh);
    recto_drawing_destroy(drawing);
  }
  recto_scene_destroy(fine);
  recto_scene_destroy(coarse);
}

/* Across the ridges of such a ring the curvature changes from vertex to vertex
 * as noise does, but not along them. */
static void folds_of_long_quads_are_drawn(void **state) {
  (void)state;
  static const double view[][2] = {
      {116.6, -55.9}, {234.3, -68.4}, {225.9, 71.6}};
  recto_scene *coarse = smooth_scene(twisted, false, 192, 24);
  recto_scene *fine = smooth_scene(twisted, false, 768, 192);
  for (size_t i = 0; i < sizeof view / sizeof *view; i++) {
    recto_drawing *surface = draw_twisted(fine, view[i]);
    recto_drawing *drawing = draw_twisted(coarse, view[i]);
    double missing = length_beyond(surface, drawing, 2);
    /* At their ends: a quad is 5 mm long. */
    if (!(missing < 10))
      fail_msg("%g/%g degrees: %g mm of lines are missing", view[i][0],
               view[i][1], missing);
    recto_drawing_destroy(surface);
    recto_drawing_destroy(drawing);
  }
  recto_scene_destroy(fine);
  recto_scene_destroy(coarse);
}

/* The chain of such a fold runs along a long side of a triangle, and back
 * hidden to the next one. */
static void folds_that_double_back_are_drawn(void **state) {
  (void)state;
  static const double view[2] = {44.6, -44.3};
  recto_scene *coarse = smooth_scene(twisted, false, 384, 48);
  recto_scene *fine = smooth_scene(twisted, false, 768, 192);
  recto_drawing *surface = draw_twisted(fine, view);
  recto_drawing *drawing = draw_twisted(coarse, view);
  double missing = length_beyond(surface, drawing, 2);
  if (!(missing < 6))
    fail_msg("%g mm of lines are missing", missing);
  recto_drawing_destroy(surface);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(fine);
  recto_scene_destroy(coarse);
}

/* A strip of 80 x 4 quads about the Y axis, straight across. */
static recto_scene *ramp_scene(void) {
  enum { ALONG = 80, ACROSS = 4, ROW = ALONG + 1 };
  double point[(ACROSS + 1) * ROW * 3];
  uint32_t corner[ALONG * ACROSS * 4];
  size_t corners = 0;
  for (uint32_t j = 0; j <= ACROSS; j++)
    for (uint32_t i = 0; i <= ALONG; i++) {
      double *p = point + 3 * ((size_t)j * ROW + i);
      double turn = 5 * M_PI * i / ALONG, radius = 0.4 + 0.6 * j / ACROSS;
      p[0] = radius * cos(turn);
      p[1] = 1.6 * i / ALONG - 0.8;
      p[2] = -radius * sin(turn);
      if (i == ALONG || j == ACROSS)
        continue;
      const uint32_t quad[] = {j * ROW + i, j * ROW + i + 1,
                               (j + 1) * ROW + i + 1, (j + 1) * ROW + i};
      for (int k = 0; k < 4; k++)
        corner[corners++] = quad[k];
    }
  return smooth_quads(point, (size_t)(ACROSS + 1) * ROW, corner, corners);
}

/* Where a fold is of edges between two borders no curvature is known. */
static void folds_across_a_strip_are_drawn(void **state) {
  (void)state;
  recto_scene *scene = ramp_scene();
  recto_drawing *mesh = draw_from(scene, 263.4, 12.2, RECTO_CONTOURS_MESH);
  recto_drawing *drawing = draw_from(scene, 263.4, 12.2, RECTO_CONTOURS_SMOOTH);
  double missing = length_beyond(mesh, drawing, 1);
  if (!(missing < 30))
    fail_msg("%g mm of lines are missing", missing);
  recto_drawing_destroy(mesh);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

/* A bump of 24 x 24 quads, exp(-2 (x^2 + z^2)). */
static recto_scene *bump_scene(void) {
  enum { SIDE = 24, ROW = SIDE + 1 };
  static double point[ROW * ROW][3];
  static uint32_t corner[4 * SIDE * SIDE];
  size_t corners = 0;
  for (uint32_t j = 0; j < ROW; j++)
    for (uint32_t i = 0; i < ROW; i++) {
      double *p = point[j * ROW + i];
      p[0] = 4.0 * j / SIDE - 2;
      p[2] = 4.0 * i / SIDE - 2;
      p[1] = exp(-2 * (p[0] * p[0] + p[2] * p[2]));
      if (i == SIDE || j == SIDE)
        continue;
      const uint32_t quad[] = {j * ROW + i, (j + 1) * ROW + i,
                               (j + 1) * ROW + i + 1, j * ROW + i + 1};
      for (int k = 0; k < 4; k++)
        corner[corners++] = quad[k];
    }
  return smooth_quads(&point[0][0], (size_t)ROW * ROW, corner, corners);
}

static recto_drawing *draw_bump(const recto_scene *scene,
                                recto_contours contours) {
  recto_options options;
  recto_options_init(&options);
  options.camera.azimuth_deg = 244.1;
  options.camera.elevation_deg = 47.9;
  options.ink.contours = contours;
  return smooth_draw(scene, &options);
}

/* Two outlines follow the fold, of which one doubles back. */
static void what_doubles_back_does_not_replace_a_line(void **state) {
  (void)state;
  recto_scene *scene = bump_scene();
  recto_drawing *mesh = draw_bump(scene, RECTO_CONTOURS_MESH);
  recto_drawing *drawing = draw_bump(scene, RECTO_CONTOURS_SMOOTH);
  double missing = length_beyond(mesh, drawing, 1);
  if (!(missing < 8))
    fail_msg("%g mm of lines are missing", missing);
  recto_drawing_destroy(mesh);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

/* The line that leads on from a crossing to a cusp is one side of a loop
 * thinner than triangles.  The mesh alone folds over in a gap of it, and for
 * some millimetres beyond the cusp; a finer mesh tells where the surface
 * does. */
static void thin_swallowtails_are_drawn(void **state) {
  (void)state;
  recto_scene *fine = smooth_scene(dented, true, 1024, 512);
  recto_scene *scene = smooth_scene(dented, true, 256, 128);
  recto_drawing *mesh = draw_from(fine, 17, 8, RECTO_CONTOURS_MESH);
  recto_drawing *drawing = draw_from(scene, 17, 8, RECTO_CONTOURS_SMOOTH);
  double missing = farthest(mesh, drawing), added = farthest(drawing, mesh);
  if (!(missing < 1.5 && added < 1.5))
    fail_msg("a line is %g mm from ink, ink %g mm from a line", missing, added);
  recto_drawing_destroy(mesh);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(fine);
  recto_scene_destroy(scene);
}

/* The mesh folds over several times where the surface is nearly edge-on. */
static void a_fold_of_several_outlines_is_one_line(void **state) {
  (void)state;
  static const double view[2] = {290.9, 37.6};
  recto_scene *scene = smooth_scene(twisted, false, 384, 48);
  recto_drawing *drawing = draw_twisted(scene, view);
  /* As many as of 768 x 192 quads. */
  assert_int_equal(recto_drawing_stroke_count(drawing), 5);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

/* A view of the sphere with dents, the quads of a coarse mesh along both axes,
 * and how many visible pieces the surface's contour has; 0: not given. */
struct dented_view {
  double view[2];
  int n, m;
  size_t pieces;
};

/* Fails where the ink of a coarse mesh is far from a finer one's, or has not as
 * many strokes as there are pieces, if those are given. */
static void check_no_false_lines(const recto_scene *fine,
                                 const struct dented_view *v) {
  recto_scene *coarse = smooth_scene(dented, true, v->n, v->m);
  recto_drawing *surface =
      draw_from(fine, v->view[0], v->view[1], RECTO_CONTOURS_SMOOTH);
  recto_drawing *drawing =
      draw_from(coarse, v->view[0], v->view[1], RECTO_CONTOURS_SMOOTH);
  double added = length_beyond(drawing, surface, 1);
  if (!(added < 1))
    fail_msg("%g/%g degrees, %d x %d quads: %g mm of lines are false",
             v->view[0], v->view[1], v->n, v->m, added);
  if (v->pieces > 0) {
    assert_int_equal(recto_drawing_stroke_count(surface), v->pieces);
    assert_int_equal(recto_drawing_stroke_count(drawing), v->pieces);
  }
  recto_drawing_destroy(surface);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(coarse);
}

/* Where the surface is nearly edge-on between two cusps, a coarse mesh folds
 * over all along, or from one of them on.  Lines of 17 to 37 mm led from
 * contour to contour, or on from one. */
static void folds_that_the_surface_denies_are_not_drawn(void **state) {
  (void)state;
  static const struct dented_view view[] = {
      {{290.9, 37.6}, 64, 32, 3},  {{322.4, -33.1}, 64, 32, 2},
      {{290.9, 37.6}, 128, 64, 3}, {{322.4, -33.1}, 128, 64, 2},
      {{309, -33.7}, 128, 64, 4},  {{55.6, 41.3}, 64, 32, 4}};
  recto_scene *fine = smooth_scene(dented, true, 256, 128);
  for (size_t i = 0; i < sizeof view / sizeof *view; i++)
    check_no_false_lines(fine, &view[i]);
  recto_scene_destroy(fine);
}

/* Where a contour passes behind another line it is hidden from there on.  A
 * line led from such a place on across the surface, to a cusp and beyond. */
static void no_gap_begins_behind_a_line(void **state) {
  (void)state;
  static const struct dented_view view = {{356, 14.1}, 64, 32, 0};
  recto_scene *fine = smooth_scene(dented, true, 256, 128);
  check_no_false_lines(fine, &view);
  recto_scene_destroy(fine);
}

/* A contour that enters and leaves a face by one side crosses it twice: its
 * ends are turned alike, and its middle is not. */
static void sides_are_crossed_twice(void **state) {
  (void)state;
  static const double view[][2] = {{227.7, 54.9}, {197, 48.6}};
  recto_scene *coarse = smooth_scene(dented, true, 64, 32);
  recto_scene *fine = smooth_scene(dented, true, 256, 128);
  for (size_t i = 0; i < sizeof view / sizeof *view; i++) {
    recto_drawing *surface =
        draw_from(fine, view[i][0], view[i][1], RECTO_CONTOURS_SMOOTH);
    recto_drawing *drawing =
        draw_from(coarse, view[i][0], view[i][1], RECTO_CONTOURS_SMOOTH);
    double missing = length_beyond(surface, drawing, 1);
    /* Beside cusps: a triangle's height is 4 mm. */
    if (!(missing < 6))
      fail_msg("%g/%g degrees: %g mm of lines are missing", view[i][0],
               view[i][1], missing);
    recto_drawing_destroy(surface);
    recto_drawing_destroy(drawing);
  }
  recto_scene_destroy(fine);
  recto_scene_destroy(coarse);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(folds_of_few_outlines_are_drawn),
      cmocka_unit_test(folds_of_long_quads_are_drawn),
      cmocka_unit_test(folds_that_double_back_are_drawn),
      cmocka_unit_test(folds_across_a_strip_are_drawn),
      cmocka_unit_test(what_doubles_back_does_not_replace_a_line),
      cmocka_unit_test(thin_swallowtails_are_drawn),
      cmocka_unit_test(a_fold_of_several_outlines_is_one_line),
      cmocka_unit_test(folds_that_the_surface_denies_are_not_drawn),
      cmocka_unit_test(no_gap_begins_behind_a_line),
      cmocka_unit_test(sides_are_crossed_twice),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
