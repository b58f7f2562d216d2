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

/* The line that leads on from a crossing to a cusp is one side of a loop
 * thinner than triangles, and has a gap where the mesh alone folds over. */
static void thin_swallowtails_are_drawn(void **state) {
  (void)state;
  recto_scene *scene = smooth_scene(dented, true, 256, 128);
  recto_drawing *mesh = draw_from(scene, 17, 8, RECTO_CONTOURS_MESH);
  recto_drawing *drawing = draw_from(scene, 17, 8, RECTO_CONTOURS_SMOOTH);
  double most = farthest(mesh, drawing);
  if (!(most < 1.5))
    fail_msg("a line is %g mm from ink", most);
  recto_drawing_destroy(mesh);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

/* The mesh folds over three times where the surface is nearly edge-on. */
static void a_fold_of_several_outlines_is_one_line(void **state) {
  (void)state;
  recto_scene *scene = smooth_scene(dented, true, 128, 64);
  recto_drawing *drawing = draw_from(scene, 309, -33.7, RECTO_CONTOURS_SMOOTH);
  assert_int_equal(recto_drawing_stroke_count(drawing), 3);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(folds_of_few_outlines_are_drawn),
      cmocka_unit_test(thin_swallowtails_are_drawn),
      cmocka_unit_test(a_fold_of_several_outlines_is_one_line),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
