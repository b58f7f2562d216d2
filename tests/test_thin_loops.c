/* test_thin_loops.c - which loops of contours are left out as noise. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/smooth_surfaces.h"
#include "visibility/contour/page_loop.h"

enum { AROUND = 64, ACROSS = 24 };

/* A torus with noise, whose quads are listed forwards or backwards. */
static recto_scene *rough_torus(bool backwards) {
  static double point[AROUND * ACROSS][3];
  static uint32_t corner[4 * AROUND * ACROSS];
  enum { COUNT = AROUND * ACROSS };
  for (uint32_t i = 0; i < AROUND; i++)
    for (uint32_t j = 0; j < ACROSS; j++) {
      uint32_t at = i * ACROSS + j, last = COUNT - 1;
      uint32_t next_i = (i + 1) % AROUND, next_j = (j + 1) % ACROSS;
      double x = 1e4 * sin(12.9 * i + 78.2 * j);
      smooth_torus(2 * M_PI * i / AROUND, 2 * M_PI * j / ACROSS, point[at]);
      for (int k = 0; k < 3; k++)
        point[at][k] *= 1 + 0.06 * (x - floor(x) - 0.5);
      uint32_t *of = corner + 4 * (size_t)(backwards ? last - at : at);
      of[0] = at;
      of[1] = i * ACROSS + next_j;
      of[2] = next_i * ACROSS + next_j;
      of[3] = next_i * ACROSS + j;
    }
  return smooth_quads(&point[0][0], COUNT, corner, 4 * (size_t)COUNT);
}

/* The length of one drawing's lines that is farther than half a millimetre from
 * the ink of another one, mm. */
static double length_away(const recto_drawing *of, const recto_drawing *from) {
  double sum = 0;
  for (size_t s = 0; s < recto_drawing_stroke_count(of); s++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(of, s, &stroke));
    for (size_t i = 0; i + 1 < stroke.count; i++) {
      const double *p = stroke.points + 2 * i;
      const double at[2] = {(p[0] + p[2]) / 2, (p[1] + p[3]) / 2};
      if (smooth_distance_to_ink(from, RECTO_EDGES_ALL, at) > 0.5)
        sum += hypot(p[2] - p[0], p[3] - p[1]);
    }
  }
  return sum;
}

/* Of loops that share a part the one was left out that ended first, and of a
 * closed curve that crosses itself any part: both depend on where the curve
 * begins, which the order of the faces says. */
static void lines_hardly_depend_on_the_order_of_faces(void **state) {
  (void)state;
  recto_scene *scene[2] = {rough_torus(false), rough_torus(true)};
  double differ = 0;
  for (int view = 0; view < SMOOTH_VIEWS; view++) {
    recto_options options;
    recto_drawing *drawing[2];
    smooth_view(&options, view);
    options.ink.exact = false;
    options.mesh.crease_deg = 80;
    for (int k = 0; k < 2; k++)
      drawing[k] = smooth_draw(scene[k], &options);
    differ += length_away(drawing[0], drawing[1]) +
              length_away(drawing[1], drawing[0]);
    for (int k = 0; k < 2; k++)
      recto_drawing_destroy(drawing[k]);
  }
  if (!(differ < 20)) /* 11; 39 before */
    fail_msg("%g mm of lines differ", differ);
  for (int k = 0; k < 2; k++)
    recto_scene_destroy(scene[k]);
}

/* Of a cow's shoulder a line of 12 mm was missing: a side of a loop in the
 * picture as large as this, over as few segments, whose curvature is not known
 * since creases are about it. */
static void large_loops_of_few_segments_are_folds(void **state) {
  (void)state;
  const double mm = SHEET_UNITS_PER_MM;
  struct page_loop loop = {.area = 29.6 * mm * mm,
                           .length = 42 * mm,
                           .height = 4.3 * mm,
                           .segments = 23};
  assert_true(page_loop_is_thin(&loop));
  assert_false(page_loop_is_fold(&loop, LONG_CURVE_HEIGHTS));
  loop.is_large = true;
  assert_true(page_loop_is_fold(&loop, LONG_CURVE_HEIGHTS));
  loop.segments = 11;
  assert_false(page_loop_is_fold(&loop, LONG_CURVE_HEIGHTS));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(large_loops_of_few_segments_are_folds),
      cmocka_unit_test(lines_hardly_depend_on_the_order_of_faces),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
