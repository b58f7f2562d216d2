/* test_smooth_intersections.c - smooth contours end where their surface enters
 * another one. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/smooth_surfaces.h"

enum { CONTOUR_SAMPLES = 2000 };

/* Two spheres of radius 1 that intersect. */
static const double centre[2][3] = {{-0.4, 0.1, 0.2}, {0.4, -0.2, -0.1}};

static void first_sphere(double u, double v, double p[3]) {
  smooth_sphere(u, v, p);
  for (int k = 0; k < 3; k++)
    p[k] += centre[0][k];
}

static void second_sphere(double u, double v, double p[3]) {
  smooth_sphere(u, v, p);
  for (int k = 0; k < 3; k++)
    p[k] += centre[1][k];
}

/* The same, with their faces turned over. */
static void first_turned(double u, double v, double p[3]) {
  first_sphere(-u, v, p);
}

static void second_turned(double u, double v, double p[3]) {
  second_sphere(-u, v, p);
}

static void on_page(const struct smooth_axes *axes, const double p[3],
                    double mm[2]) {
  mm[0] = SMOOTH_PAGE_MM / 2 + SMOOTH_SCALE_MM * smooth_dot(p, axes->right);
  mm[1] = SMOOTH_PAGE_MM / 2 + SMOOTH_SCALE_MM * smooth_dot(p, axes->up);
}

/* A place on the contour of a sphere. */
struct contour_place {
  double mm[2];
  double depth; /* within the other sphere, mm; negative outside of it */
  bool beside;  /* it is not near the outline of the other sphere */
  bool hidden;  /* the other sphere is in front of it */
};

static struct contour_place place_at(const struct smooth_axes *axes, int sphere,
                                     double angle, double arc) {
  const double *own = centre[sphere], *other = centre[1 - sphere];
  double p[3], from[3], middle[2];
  for (int k = 0; k < 3; k++) {
    p[k] = own[k] + cos(angle) * axes->right[k] + sin(angle) * axes->up[k];
    from[k] = p[k] - other[k];
  }
  struct contour_place place;
  on_page(axes, p, place.mm);
  on_page(axes, other, middle);
  double away = hypot(place.mm[0] - middle[0], place.mm[1] - middle[1]);
  double behind = -smooth_dot(from, axes->back);
  place.depth = SMOOTH_SCALE_MM * (1 - sqrt(smooth_dot(from, from)));
  place.beside = fabs(away - SMOOTH_SCALE_MM) > 3 * arc;
  place.hidden = away < SMOOTH_SCALE_MM && (behind > 0 || place.depth > 0);
  return place;
}

/* The height of a mesh's arcs over its chords, mm. */
static double arc_of(int n) {
  return 2 * SMOOTH_SCALE_MM * (1 - cos(M_PI / n));
}

/* Compares the contour of a sphere with the drawing: what is drawn of it within
 * the other sphere, and what is not drawn outside of it, is not farther from
 * there than less than half the side of a quad. */
static void check_contour(const recto_drawing *drawing,
                          const struct smooth_axes *axes, int sphere, int n) {
  double arc = arc_of(n), most = 0.4 * 2 * M_PI * SMOOTH_SCALE_MM / n;
  for (int i = 0; i < CONTOUR_SAMPLES; i++) {
    struct contour_place place =
        place_at(axes, sphere, 2 * M_PI * i / CONTOUR_SAMPLES, arc);
    if (!place.beside || fabs(place.depth) < most)
      continue;
    double away =
        smooth_distance_to_ink(drawing, RECTO_EDGE_SILHOUETTE, place.mm);
    if (place.hidden)
      assert_true(away > arc);
    else
      assert_true(away < 1.2 * arc);
  }
}

static void check_views(unsigned classes, smooth_surface *first,
                        smooth_surface *second) {
  for (int n = 16; n <= 64; n *= 2) {
    recto_scene *scene = smooth_scene(first, true, n, n / 2);
    smooth_add(scene, second, true, n, n / 2);
    for (int view = 0; view < SMOOTH_VIEWS; view++) {
      recto_options options;
      smooth_view(&options, view);
      options.ink.edges = classes;
      struct smooth_axes axes = smooth_axes_of(&options);
      recto_drawing *drawing = smooth_draw(scene, &options);
      for (int sphere = 0; sphere < 2; sphere++)
        check_contour(drawing, &axes, sphere, n);
      recto_drawing_destroy(drawing);
    }
    recto_scene_destroy(scene);
  }
}

static void contours_end_where_surfaces_intersect(void **state) {
  (void)state;
  check_views(RECTO_EDGE_SILHOUETTE | RECTO_EDGE_INTERSECTION, first_sphere,
              second_sphere);
}

static void they_end_where_intersections_are_not_drawn(void **state) {
  (void)state;
  check_views(RECTO_EDGE_SILHOUETTE, first_sphere, second_sphere);
}

static void it_does_not_matter_which_way_faces_are_turned(void **state) {
  (void)state;
  check_views(RECTO_EDGE_SILHOUETTE, first_turned, second_turned);
  check_views(RECTO_EDGE_SILHOUETTE, first_turned, second_sphere);
}

/* A Klein bottle: a tube that passes through its own side. */
static void bottle(double u, double v, double p[3]) {
  double round = 4 - 2 * cos(u), straight = u < M_PI ? cos(u) : -1;
  p[0] = (6 * cos(u) * (1 + sin(u)) + round * straight * cos(v)) / 12;
  p[1] = (16 * sin(u) + (u < M_PI ? round * sin(u) * cos(v) : 0)) / 12;
  p[2] = round * sin(v) / 12;
}

enum { BOTTLE_ALONG = 48, BOTTLE_AROUND = 24 };

static recto_scene *klein_bottle(void) {
  static double point[(BOTTLE_ALONG + 1) * BOTTLE_AROUND][3];
  static uint32_t corner[BOTTLE_ALONG * BOTTLE_AROUND * 4];
  size_t corners = 0;
  for (uint32_t i = 0; i <= BOTTLE_ALONG; i++)
    for (uint32_t j = 0; j < BOTTLE_AROUND; j++) {
      uint32_t row = i * BOTTLE_AROUND, next = (j + 1) % BOTTLE_AROUND;
      const uint32_t quad[4] = {row + j, row + BOTTLE_AROUND + j,
                                row + BOTTLE_AROUND + next, row + next};
      bottle(2 * M_PI * i / BOTTLE_ALONG, 2 * M_PI * j / BOTTLE_AROUND,
             point[row + j]);
      for (int k = 0; i < BOTTLE_ALONG && k < 4; k++)
        corner[corners++] = quad[k];
    }
  return smooth_quads(point[0], sizeof point / sizeof point[0], corner,
                      corners);
}

/* Seen across its plane of symmetry, in which all its contours lie: where two
 * cross none of them is the nearer one, and both end. */
static void contours_that_cross_at_one_depth_both_end(void **state) {
  (void)state;
  recto_scene *scene = klein_bottle();
  recto_options options;
  smooth_view(&options, 0);
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  options.ink.exact = false;
  recto_drawing *drawing = smooth_draw(scene, &options);
  options.ink.contours = RECTO_CONTOURS_MESH;
  recto_drawing *mesh = smooth_draw(scene, &options);
  double most = 0;
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, s, &stroke));
    for (size_t i = 0; i < stroke.count; i++)
      most = fmax(most, smooth_distance_to_ink(mesh, RECTO_EDGE_SILHOUETTE,
                                               stroke.points + 2 * i));
  }
  /* 6 where none of them ends. */
  assert_true(most < 0.5);
  recto_drawing_destroy(mesh);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

/* Spheres along a helix, each of which intersects the next one. */
enum { SPHERES = 6 };

static int sphere_of_helix;

static void helix_sphere(double u, double v, double p[3]) {
  smooth_sphere(u, v, p);
  const double at = 1.1 * sphere_of_helix;
  const double centre_of[3] = {0.7 * cos(at), 0.7 * sin(at),
                               0.3 * (sphere_of_helix - 2.5)};
  for (int k = 0; k < 3; k++)
    p[k] = 0.55 * p[k] + centre_of[k];
}

/* Of a mesh, an intersection winds about the outline of the nearer surface,
 * ends there and begins again, and the contour of the surface ends elsewhere:
 * 38 ends lay open. */
static void intersections_lead_on_to_contours(void **state) {
  (void)state;
  int loose = 0;
  for (int n = 24; n <= 48; n *= 2) {
    recto_scene *scene = NULL;
    for (sphere_of_helix = 0; sphere_of_helix < SPHERES; sphere_of_helix++)
      if (scene == NULL)
        scene = smooth_scene(helix_sphere, true, n, n / 2);
      else
        smooth_add(scene, helix_sphere, true, n, n / 2);
    for (int view = 0; view < SMOOTH_VIEWS; view++) {
      recto_options options;
      smooth_view(&options, view);
      options.ink.edges = RECTO_EDGE_SILHOUETTE | RECTO_EDGE_INTERSECTION;
      options.ink.exact = false;
      recto_drawing *drawing = smooth_draw(scene, &options);
      loose += smooth_loose_ends(drawing, RECTO_EDGE_INTERSECTION, ~0u, 0.35);
      recto_drawing_destroy(drawing);
    }
    recto_scene_destroy(scene);
  }
  assert_true(loose <= 8);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(contours_end_where_surfaces_intersect),
      cmocka_unit_test(they_end_where_intersections_are_not_drawn),
      cmocka_unit_test(it_does_not_matter_which_way_faces_are_turned),
      cmocka_unit_test(contours_that_cross_at_one_depth_both_end),
      cmocka_unit_test(intersections_lead_on_to_contours),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
