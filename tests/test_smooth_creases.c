/* test_smooth_creases.c - creases of bodies with smooth sides reach the smooth
 * contours that end on them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/smooth_surfaces.h"

enum { RINGS = 10, SIDES_MAX = 64 };

#define BORE 0.1 /* its radius */

/* The rings of points of a post on a disc, with a bore: radius and height.  On
 * the post every other ring is turned by half of a side, so that the edges at
 * which the mesh folds over zigzag. */
static const double ring[RINGS][2] = {
    {BORE, -0.9}, {1.1, -0.9}, {1.1, -0.7}, {0.6, -0.7}, {0.6, -0.4},
    {0.6, -0.1},  {0.6, 0.2},  {0.6, 0.5},  {0.6, 0.8},  {BORE, 0.8}};
static const double turned[RINGS] = {0, 0, 0, 0, 0.5, 0, 0.5, 0, 0, 0};

static recto_scene *post_on_disc(uint32_t sides) {
  static double point[RINGS * SIDES_MAX][3];
  static uint32_t corner[RINGS * SIDES_MAX * 6];
  recto_mesh mesh = {.points = &point[0][0],
                     .point_count = (size_t)RINGS * sides,
                     .corners = corner,
                     .face_size = 3};
  recto_scene *scene;
  for (uint32_t k = 0; k < RINGS; k++)
    for (uint32_t i = 0; i < sides; i++) {
      uint32_t next = (i + 1) % sides, up = (k + 1) % RINGS;
      bool back = turned[k] > turned[up];
      const uint32_t at[4] = {k * sides + i, k * sides + next,
                              up * sides + next, up * sides + i};
      const uint32_t cut[6] = {at[0], at[1], at[back ? 2 : 3], at[back ? 0 : 1],
                               at[2], at[3]};
      double u = 2 * M_PI * (i + turned[k]) / sides, *p = point[k * sides + i];
      p[0] = ring[k][0] * cos(u);
      p[1] = ring[k][1];
      p[2] = -ring[k][0] * sin(u);
      for (int c = 0; c < 6; c++)
        corner[mesh.corner_count++] = cut[c];
    }
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  return scene;
}

/* How far a place is from all strokes but one, mm. */
static double distance_to_others(const recto_drawing *drawing, size_t stroke,
                                 const double at[2]) {
  double least = 1e9;
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke other;
    assert_true(recto_drawing_stroke(drawing, s, &other));
    for (size_t i = 0; s != stroke && i < other.count - !other.closed; i++)
      least = fmin(least, smooth_distance_to_segment(
                              at, other.points + 2 * i,
                              other.points + 2 * ((i + 1) % other.count)));
  }
  return least;
}

/* How many ends of creases are farther than 0.3 mm from other lines. */
static int count_loose_creases(const recto_drawing *drawing) {
  int loose = 0;
  for (size_t s = 0; s < recto_drawing_stroke_count(drawing); s++) {
    recto_stroke own;
    assert_true(recto_drawing_stroke(drawing, s, &own));
    for (int k = 0; own.edge_class == RECTO_EDGE_CREASE && !own.closed && k < 2;
         k++)
      loose +=
          distance_to_others(
              drawing, s, own.points + 2 * (k == 0 ? 0 : own.count - 1)) > 0.3;
  }
  return loose;
}

static int count_in_views(uint32_t sides) {
  recto_scene *scene = post_on_disc(sides);
  int loose = 0;
  for (int view = 0; view < SMOOTH_VIEWS; view++) {
    recto_options options;
    smooth_view(&options, view);
    options.ink.edges = RECTO_EDGE_SILHOUETTE | RECTO_EDGE_CREASE;
    options.ink.exact = false;
    recto_drawing *drawing = smooth_draw(scene, &options);
    loose += count_loose_creases(drawing);
    recto_drawing_destroy(drawing);
  }
  recto_scene_destroy(scene);
  return loose;
}

/* Without what lets hidden creases be seen up to contours there are nine loose
 * ends of 24 sides and two of 64; where the side of a contour tells what of a
 * crease is cut off there is one of 24 sides. */
static void the_foot_of_a_post_reaches_its_contours(void **state) {
  (void)state;
  for (uint32_t sides = 24; sides <= SIDES_MAX; sides += 4)
    assert_int_equal(count_in_views(sides), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_foot_of_a_post_reaches_its_contours),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
