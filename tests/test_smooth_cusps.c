/* test_smooth_cusps.c - no line goes on beyond a cusp of a smooth contour where
 * the mesh alone folds over. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/smooth_surfaces.h"

/* The steps of the parameters by which the contour of a surface is found. */
enum { STEPS_U = 1024, STEPS_V = 256, CONTOUR_MAX = 16 * STEPS_U };

/* Where the contour of a surface is on the page, seen or not, mm. */
struct contour {
  double mm[CONTOUR_MAX][2];
  int count;
};

static void knot_axis(double u, double p[3]) {
  double out = 2 + cos(3 * u);
  p[0] = out * cos(2 * u);
  p[1] = out * sin(2 * u);
  p[2] = sin(3 * u);
}

/* A tube about a torus knot whose quads are sheared, as v begins away from the
 * knot's torus; they are cut along their longer diagonals. */
static void thick_knot(double u, double v, double p[3]) {
  const double h = 1e-5, radius = 0.42, scale = 0.45;
  double n[3] = {cos(3 * u) * cos(2 * u), cos(3 * u) * sin(2 * u), sin(3 * u)};
  double from[3], to[3], t[3], b[3];
  knot_axis(u - h, from);
  knot_axis(u + h, to);
  for (int k = 0; k < 3; k++)
    t[k] = to[k] - from[k];
  double along = smooth_dot(n, t) / smooth_dot(t, t);
  for (int k = 0; k < 3; k++)
    n[k] -= along * t[k];
  for (int k = 0; k < 3; k++)
    b[k] = t[(k + 1) % 3] * n[(k + 2) % 3] - t[(k + 2) % 3] * n[(k + 1) % 3];
  double across = sqrt(smooth_dot(n, n)), up = sqrt(smooth_dot(b, b));
  knot_axis(u, p);
  for (int k = 0; k < 3; k++)
    p[k] =
        scale * (p[k] + radius * (cos(v) * n[k] / across - sin(v) * b[k] / up));
}

/* A sphere with six dents. */
static void six_dents(double u, double v, double p[3]) {
  double s = sin(v / 2), c = cos(v / 2);
  double size = 1 + 0.25 * sin(3 * u) * s * s * s * cos(2 * v);
  p[0] = size * s * cos(u);
  p[1] = size * c;
  p[2] = size * s * sin(u);
}

/* How a surface faces the viewer: the area of its image in the parameters. */
static double facing_at(smooth_surface *at, const struct smooth_axes *axes,
                        double u, double v) {
  const double h = 1e-5;
  double p[2][2][3], d[2][3];
  for (int k = 0; k < 2; k++) {
    at(u + (k == 0 ? h : -h), v, p[0][k]);
    at(u, v + (k == 0 ? h : -h), p[1][k]);
  }
  for (int i = 0; i < 2; i++)
    for (int k = 0; k < 3; k++)
      d[i][k] = p[i][0][k] - p[i][1][k];
  return smooth_dot(d[0], axes->right) * smooth_dot(d[1], axes->up) -
         smooth_dot(d[0], axes->up) * smooth_dot(d[1], axes->right);
}

static void add_contour_point(struct contour *contour, smooth_surface *at,
                              const struct smooth_axes *axes, double u,
                              double v) {
  double p[3], *mm = contour->mm[contour->count++];
  assert_true(contour->count < CONTOUR_MAX);
  at(u, v, p);
  mm[0] = SMOOTH_PAGE_MM / 2 + SMOOTH_SCALE_MM * smooth_dot(p, axes->right);
  mm[1] = SMOOTH_PAGE_MM / 2 + SMOOTH_SCALE_MM * smooth_dot(p, axes->up);
}

/* Finds where the facing changes its sign along either parameter.
 * poles  v runs from pole to pole */
static void find_contour(struct contour *contour, smooth_surface *at,
                         bool poles, const struct smooth_axes *axes) {
  static double g[STEPS_V][STEPS_U];
  const double step[2] = {2 * M_PI / STEPS_U, 2 * M_PI / STEPS_V};
  for (int j = 0; j < STEPS_V; j++)
    for (int i = 0; i < STEPS_U; i++)
      g[j][i] = facing_at(at, axes, i * step[0], (j + 0.5) * step[1]);
  contour->count = 0;
  for (int j = 0; j < STEPS_V; j++)
    for (int i = 0; i < STEPS_U; i++) {
      double here = g[j][i], u = i * step[0], v = (j + 0.5) * step[1];
      double next = g[j][(i + 1) % STEPS_U], up = g[(j + 1) % STEPS_V][i];
      if (here * next < 0)
        add_contour_point(contour, at, axes, u + step[0] * here / (here - next),
                          v);
      if (here * up < 0 && !(poles && j == STEPS_V - 1))
        add_contour_point(contour, at, axes, u,
                          v + step[1] * here / (here - up));
    }
}

static double distance_to_points(const struct contour *contour,
                                 const double p[2]) {
  double best = INFINITY;
  for (int i = 0; i < contour->count; i++)
    best =
        fmin(best, hypot(p[0] - contour->mm[i][0], p[1] - contour->mm[i][1]));
  return best;
}

/* The farthest that a point of a drawing's lines is from the contour. */
static double farthest_ink(const recto_drawing *drawing,
                           const struct contour *contour) {
  double most = 0;
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, s, &stroke));
    for (size_t i = 0; i < stroke.count; i++)
      most = fmax(most, distance_to_points(contour, stroke.points + 2 * i));
  }
  return most;
}

/* Fails where a line is far from the contour.
 * poles  v runs from pole to pole */
static void check_lines(smooth_surface *at, bool poles, int n, int m,
                        const double view[2]) {
  static struct contour contour;
  recto_options options;
  smooth_view(&options, 0);
  options.camera.azimuth_deg = view[0];
  options.camera.elevation_deg = view[1];
  options.ink.exact = false;
  struct smooth_axes axes = smooth_axes_of(&options);
  recto_scene *scene = smooth_scene(at, poles, n, m);
  recto_drawing *drawing = smooth_draw(scene, &options);
  find_contour(&contour, at, poles, &axes);
  double most = farthest_ink(drawing, &contour);
  if (!(most < 1))
    fail_msg("%g/%g degrees: a line is %g mm from the contour", view[0],
             view[1], most);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

/* Along the tube's inflections the mesh folds over in its faces alone. */
static void no_line_goes_on_beyond_the_cusps_of_a_knot(void **state) {
  (void)state;
  static const double view[][2] = {
      {197.67, 39.31}, {184.46, 19.92}, {334.16, -44.76}, {21.89, 20.69}};
  for (size_t i = 0; i < sizeof view / sizeof *view; i++)
    check_lines(thick_knot, false, 192, 32, view[i]);
}

static void no_line_goes_on_beyond_the_cusps_of_dents(void **state) {
  (void)state;
  static const double view[2] = {21.89, 20.69};
  check_lines(six_dents, true, 64, 32, view);
  check_lines(six_dents, true, 128, 64, view);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(no_line_goes_on_beyond_the_cusps_of_a_knot),
      cmocka_unit_test(no_line_goes_on_beyond_the_cusps_of_dents),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
