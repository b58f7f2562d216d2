/* test_smooth_solids.c - smooth contours within another solid are not visible,
 * and those in front of it or in a gap beside it are. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/smooth_surfaces.h"

/* The same surfaces with their faces turned over. */
static void turned_sphere(double u, double v, double p[3]) {
  smooth_sphere(-u, v, p);
}

static void turned_torus(double u, double v, double p[3]) {
  smooth_torus(-u, v, p);
}

/* ---- In a box ------------------------------------------------------------ */

/* Adds a box, of which z is at most `top`. */
static void add_box(recto_scene *scene, double least_x, double top) {
  double point[8][3];
  for (int i = 0; i < 8; i++) {
    point[i][0] = i & 1 ? 1.6 : least_x;
    point[i][1] = i & 2 ? 1.6 : -1.6;
    point[i][2] = i & 4 ? top : -1.6;
  }
  static const uint32_t corner[24] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4,
                                      2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  const recto_mesh mesh = {.points = point[0],
                           .point_count = 8,
                           .corners = corner,
                           .corner_count = 24,
                           .face_size = 4};
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
}

static recto_drawing *draw_from_front(const recto_scene *scene) {
  recto_options options;
  smooth_view(&options, 0);
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  options.ink.exact = false;
  return smooth_draw(scene, &options);
}

/* Checks that a circle about the middle of the page is drawn, or that none of
 * it is, where x is more than a tenth of its radius, or less than minus that.
 * side  1 or -1 */
static void check_arc(const recto_drawing *drawing, double radius, int side,
                      bool drawn) {
  for (int i = -90; i <= 90; i++) {
    double angle = i * M_PI / 200, mm = SMOOTH_SCALE_MM * radius;
    const double at[2] = {SMOOTH_PAGE_MM / 2 + side * mm * cos(angle),
                          SMOOTH_PAGE_MM / 2 + mm * sin(angle)};
    double away = smooth_distance_to_ink(drawing, RECTO_EDGE_SILHOUETTE, at);
    if (drawn ? away > 0.1 : away < 0.5)
      fail_msg("%g mm from a circle of %g mm, side %d", away, mm, side);
  }
}

static const double tops[] = {0.02, 0.05, 0.1, 0.3, -0.02, -0.05, -0.1};
enum { TOPS = sizeof tops / sizeof *tops };

/* The contour of a sphere is on a level with z = 0. */
static void the_contour_of_a_sunk_sphere_is_hidden(void **state) {
  static smooth_surface *const sphere[] = {smooth_sphere, turned_sphere};
  (void)state;
  for (int i = 0; i < 2 * TOPS; i++)
    for (int n = 32; n <= 64; n *= 2) {
      double top = tops[i / 2];
      recto_scene *scene = smooth_scene(sphere[i % 2], true, n, n / 2);
      add_box(scene, -1.6, top);
      recto_drawing *drawing = draw_from_front(scene);
      check_arc(drawing, 1, 1, top < 0);
      check_arc(drawing, 1, -1, top < 0);
      recto_drawing_destroy(drawing);
      recto_scene_destroy(scene);
    }
}

/* So are the two of a torus, of which half is within the box. */
static void the_contours_of_a_torus_end_at_a_box(void **state) {
  static smooth_surface *const torus[] = {smooth_torus, turned_torus};
  (void)state;
  for (int i = 0; i < 2 * TOPS; i++) {
    double top = tops[i / 2];
    recto_scene *scene = smooth_scene(torus[i % 2], false, 64, 32);
    add_box(scene, 0, top);
    recto_drawing *drawing = draw_from_front(scene);
    for (int k = -1; k <= 1; k += 2) {
      double radius = 1 + k * SMOOTH_TORUS_RADIUS;
      check_arc(drawing, radius, 1, top < 0);
      check_arc(drawing, radius, -1, true);
    }
    recto_drawing_destroy(drawing);
    recto_scene_destroy(scene);
  }
}

/* ---- In a narrow gap ----------------------------------------------------- */

/* A sphere behind the hole of the torus, which has a radius of 0.6. */
#define SMALL_RADIUS 0.595
static void sphere_behind(double u, double v, double p[3]) {
  turned_sphere(u, v, p);
  for (int k = 0; k < 3; k++)
    p[k] *= SMALL_RADIUS;
  p[2] -= 1.5;
}

/* Its triangles are 14 to 22 times as high as the gap is wide. */
static void a_contour_in_a_narrow_gap_is_visible(void **state) {
  (void)state;
  for (int n = 24; n <= 36; n += 12) {
    recto_scene *scene = smooth_scene(smooth_torus, false, 96, 48);
    smooth_add(scene, sphere_behind, true, n, n / 2);
    recto_drawing *drawing = draw_from_front(scene);
    check_arc(drawing, SMALL_RADIUS, 1, true);
    check_arc(drawing, SMALL_RADIUS, -1, true);
    recto_drawing_destroy(drawing);
    recto_scene_destroy(scene);
  }
}

/* ---- As of a fine mesh --------------------------------------------------- */

/* The farthest point of a drawing's silhouettes from the ink of another one,
 * mm. */
static double farthest_ink(const recto_drawing *drawing,
                           const recto_drawing *other, double at[2]) {
  double most = 0;
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, s, &stroke));
    if (stroke.edge_class != RECTO_EDGE_SILHOUETTE)
      continue;
    for (size_t i = 0; i < stroke.count; i++) {
      const double *p = stroke.points + 2 * i;
      double away = smooth_distance_to_ink(other, RECTO_EDGES_ALL, p);
      if (away > most)
        memcpy(at, p, 2 * sizeof *at);
      most = fmax(most, away);
    }
  }
  return most;
}

/* Compares smooth contours with the lines of a finer mesh.
 * most  how far from there silhouettes may be drawn, mm */
static void compare_views(const recto_scene *coarse, const recto_scene *fine,
                          double most) {
  for (int view = 0; view < SMOOTH_VIEWS; view++) {
    recto_options options;
    double at[2] = {0, 0};
    smooth_view(&options, view);
    options.ink.edges |= RECTO_EDGE_INTERSECTION;
    options.ink.exact = false;
    recto_drawing *smooth = smooth_draw(coarse, &options);
    options.ink.contours = RECTO_CONTOURS_MESH;
    options.ink.exact = true;
    recto_drawing *mesh = smooth_draw(fine, &options);
    double away = farthest_ink(smooth, mesh, at);
    if (away > most)
      fail_msg("view %d: ink at %g, %g is %g mm from the lines of a finer mesh",
               view, at[0], at[1], away);
    recto_drawing_destroy(smooth);
    recto_drawing_destroy(mesh);
  }
}

/* A torus through another one. */
static void other_torus(double u, double v, double p[3]) {
  double q[3];
  smooth_torus(u, v, q);
  p[0] = q[0];
  p[1] = q[2] + 0.3;
  p[2] = q[1];
}

static void contours_of_tori_end_where_they_intersect(void **state) {
  static smooth_surface *const torus[] = {smooth_torus, turned_torus};
  (void)state;
  for (int i = 0; i < 2; i++) {
    recto_scene *coarse = smooth_scene(torus[i], false, 64, 32);
    smooth_add(coarse, other_torus, false, 64, 32);
    recto_scene *fine = smooth_scene(torus[i], false, 256, 128);
    smooth_add(fine, other_torus, false, 256, 128);
    compare_views(coarse, fine, 0.6);
    recto_scene_destroy(coarse);
    recto_scene_destroy(fine);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_contour_of_a_sunk_sphere_is_hidden),
      cmocka_unit_test(the_contours_of_a_torus_end_at_a_box),
      cmocka_unit_test(a_contour_in_a_narrow_gap_is_visible),
      cmocka_unit_test(contours_of_tori_end_where_they_intersect)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
