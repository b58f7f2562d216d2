/* smooth_surfaces.c - meshes that sample smooth surfaces, and their
 * drawings. */
#include "tests/smooth_surfaces.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

void smooth_circle(double u, double p[3]) {
  p[0] = cos(u);
  p[1] = sin(u);
  p[2] = 0;
}

void smooth_trefoil(double u, double p[3]) {
  p[0] = (2 + cos(3 * u)) * cos(2 * u) / 2.6;
  p[1] = (2 + cos(3 * u)) * sin(2 * u) / 2.6;
  p[2] = sin(3 * u) / 1.8;
}

void smooth_frame(smooth_curve *at, double u, double normal[3],
                  double binormal[3]) {
  double p[3], q[3], t[3], length = 0;
  at(u - 1e-6, p);
  at(u + 1e-6, q);
  for (int k = 0; k < 3; k++) {
    t[k] = q[k] - p[k];
    length += t[k] * t[k];
  }
  for (int k = 0; k < 3; k++)
    t[k] /= sqrt(length);
  double across = hypot(t[0], t[1]);
  normal[0] = t[1] / across;
  normal[1] = -t[0] / across;
  normal[2] = 0;
  binormal[0] = -normal[1] * t[2];
  binormal[1] = normal[0] * t[2];
  binormal[2] = normal[1] * t[0] - normal[0] * t[1];
}

static void tube_about(smooth_curve *at, double radius, double u, double v,
                       double p[3]) {
  double normal[3], binormal[3];
  at(u, p);
  smooth_frame(at, u, normal, binormal);
  for (int k = 0; k < 3; k++)
    p[k] += radius * (cos(v) * normal[k] - sin(v) * binormal[k]);
}

void smooth_torus(double u, double v, double p[3]) {
  tube_about(smooth_circle, SMOOTH_TORUS_RADIUS, u, v, p);
}

void smooth_knot(double u, double v, double p[3]) {
  tube_about(smooth_trefoil, SMOOTH_KNOT_RADIUS, u, v, p);
}

void smooth_sphere(double u, double v, double p[3]) {
  p[0] = sin(v / 2) * cos(u);
  p[1] = sin(v / 2) * sin(u);
  p[2] = cos(v / 2);
}

void smooth_ellipsoid(double u, double v, double p[3]) {
  smooth_sphere(u, v, p);
  p[1] *= 0.7;
  p[2] *= 0.5;
}

/* ---- Drawing ------------------------------------------------------------- */

void smooth_add(recto_scene *scene, smooth_surface *at, bool poles, int n,
                int m) {
  size_t points = (size_t)n * (size_t)(m + 1), corners = 0;
  double *point = malloc(points * 3 * sizeof *point);
  uint32_t *corner = malloc(points * 6 * sizeof *corner);
  assert_non_null(point);
  assert_non_null(corner);
  for (int j = 0; j <= m; j++)
    for (int i = 0; i < n; i++)
      at(2 * M_PI * i / n, 2 * M_PI * j / m,
         point + 3 * ((size_t)j * (size_t)n + (size_t)i));
  for (int j = 0; j < m; j++)
    for (int i = 0; i < n; i++) {
      int next = (i + 1) % n, up = poles ? j + 1 : (j + 1) % m;
      uint32_t a = (uint32_t)(j * n + i), b = (uint32_t)(j * n + next);
      uint32_t c = (uint32_t)(up * n + next), d = (uint32_t)(up * n + i);
      bool first = poles && j == 0, last = poles && j == m - 1;
      const uint32_t two[6] = {a, b, c, a, c, d};
      /* At a pole, all points of a row are its first one. */
      for (int k = 0; k < 6; k++) {
        uint32_t p = two[k];
        if ((k < 3 && first) || (k >= 3 && last))
          continue;
        if (poles && p < (uint32_t)n)
          p = 0;
        if (poles && p >= (uint32_t)(m * n))
          p = (uint32_t)(m * n);
        corner[corners++] = p;
      }
    }
  const recto_mesh mesh = {.points = point,
                           .point_count = points,
                           .corners = corner,
                           .corner_count = corners,
                           .face_size = 3};
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  free(point);
  free(corner);
}

recto_scene *smooth_scene(smooth_surface *at, bool poles, int n, int m) {
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  smooth_add(scene, at, poles, n, m);
  return scene;
}

recto_scene *smooth_quads(const double *point, size_t points,
                          const uint32_t *corner, size_t corners) {
  const recto_mesh mesh = {.points = point,
                           .point_count = points,
                           .corners = corner,
                           .corner_count = corners,
                           .face_size = 4};
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  return scene;
}

void smooth_view(recto_options *options, int view) {
  recto_options_init(options);
  options->camera.azimuth_deg = 17 + 37.3 * view;
  options->camera.elevation_deg = 71 * sin(1 + 2.4 * view);
  options->camera.has_target = true; /* the origin */
  options->camera.fit = RECTO_FIT_SCALE;
  options->camera.scale = SMOOTH_SCALE_MM;
  options->page.width_mm = options->page.height_mm = SMOOTH_PAGE_MM;
  options->ink.edges = RECTO_EDGE_SILHOUETTE;
  options->ink.contours = RECTO_CONTOURS_SMOOTH;
  options->ink.exact = true;
}

struct smooth_axes smooth_axes_of(const recto_options *options) {
  double a = options->camera.azimuth_deg * (M_PI / 180);
  double e = options->camera.elevation_deg * (M_PI / 180);
  return (struct smooth_axes){{cos(a), 0, -sin(a)},
                              {-sin(a) * sin(e), cos(e), -cos(a) * sin(e)},
                              {sin(a) * cos(e), sin(e), cos(a) * cos(e)}};
}

double smooth_dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

recto_drawing *smooth_draw(const recto_scene *scene,
                           const recto_options *options) {
  recto_drawing *drawing;
  assert_int_equal(recto_scene_render(scene, options, &drawing, NULL),
                   RECTO_OK);
  return drawing;
}

/* ---- Distances ----------------------------------------------------------- */

double smooth_distance_to_segment(const double at[2], const double p[2],
                                  const double q[2]) {
  double x = q[0] - p[0], y = q[1] - p[1], square = x * x + y * y;
  double t = ((at[0] - p[0]) * x + (at[1] - p[1]) * y) / square;
  t = !(square > 0) || t < 0 ? 0 : t > 1 ? 1 : t;
  double dx = p[0] + t * x - at[0], dy = p[1] + t * y - at[1];
  return sqrt(dx * dx + dy * dy); /* most of the time of these tests */
}

/* The distance from a point to the strokes of these classes but one, mm. */
static double distance_to_others(const recto_drawing *drawing, size_t but,
                                 unsigned classes, const double at[2]) {
  double least = 1e9;
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, s, &stroke));
    for (size_t i = 0; s != but && (stroke.edge_class & classes) &&
                       i + 1 < stroke.count + stroke.closed;
         i++)
      least = fmin(least, smooth_distance_to_segment(
                              at, stroke.points + 2 * i,
                              stroke.points + 2 * ((i + 1) % stroke.count)));
  }
  return least;
}

double smooth_distance_to_ink(const recto_drawing *drawing, unsigned classes,
                              const double at[2]) {
  return distance_to_others(drawing, SIZE_MAX, classes, at);
}

double smooth_farthest_middle(const recto_drawing *of,
                              const recto_drawing *from) {
  double most = 0;
  for (size_t s = 0; s < recto_drawing_stroke_count(of); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(of, s, &stroke));
    for (size_t i = 0; i + 1 < stroke.count; i++) {
      const double *p = stroke.points + 2 * i;
      const double middle[2] = {(p[0] + p[2]) / 2, (p[1] + p[3]) / 2};
      most = fmax(most, smooth_distance_to_ink(from, RECTO_EDGES_ALL, middle));
    }
  }
  return most;
}

int smooth_loose_ends(const recto_drawing *drawing, unsigned classes,
                      unsigned others, double mm) {
  int count = 0;
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, s, &stroke));
    if (stroke.closed || !(stroke.edge_class & classes))
      continue;
    const double *last = stroke.points + 2 * (stroke.count - 1);
    count += distance_to_others(drawing, s, others, stroke.points) > mm;
    count += distance_to_others(drawing, s, others, last) > mm;
  }
  return count;
}
