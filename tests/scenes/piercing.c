/* piercing.c - faces that run through each other. */
#include <math.h>

#include "tests/scenes/scenes.h"

void scenes_crossed_boxes(struct scene *scene, recto_options *options) {
  build_group(scene, "upright");
  build_box(scene, vector_of(-1, -1, -3), vector_of(1, 1, 3));
  build_group(scene, "lying");
  build_box(scene, vector_of(-3, -0.6, -0.75), vector_of(3, 0.6, 0.5));
  scenes_view_direction(options, 33, 21);
}

void scenes_three_sheets(struct scene *scene, recto_options *options) {
  build_group(scene, "x");
  build_parallelogram(scene, vector_of(0.1, -2, -2), vector_of(0, 4, 0.5),
                      vector_of(0.5, 0, 4));
  build_group(scene, "y");
  build_parallelogram(scene, vector_of(-2, 0.2, -2), vector_of(4, 0.5, 0),
                      vector_of(0, 0.25, 4));
  build_group(scene, "z");
  build_parallelogram(scene, vector_of(-2, -2, -0.1), vector_of(4, 0, 0.5),
                      vector_of(0.5, 4, 0.25));
  scenes_view_direction(options, 28, 31);
}

void scenes_edge_through_vertex(struct scene *scene, recto_options *options) {
  /* A pyramid whose apex (0, 0, 2) lies on an edge of the first triangle, on
   * the inside of the second and on a corner of the third. */
  static const double first[9] = {-2, -1, 2, 2, 1, 2, 0, 3, 3};
  static const double second[9] = {-1, -2, 1, 1, -2, 1, 0, 4, 4};
  static const double third[9] = {0, 0, 2, 3, -1, 2, 3, -2, 3};
  uint32_t base = build_point(scene, -1, -1, 0);
  build_point(scene, 1, -1, 0);
  build_point(scene, 1, 1, 0);
  build_point(scene, -1, 1, 0);
  uint32_t apex = build_point(scene, 0, 0, 2);
  build_quad(scene, base + 3, base + 2, base + 1, base);
  for (uint32_t i = 0; i < 4; i++)
    build_triangle(scene, base + i, base + (i + 1) % 4, apex);
  build_polygon(scene, first, 3);
  build_polygon(scene, second, 3);
  build_polygon(scene, third, 3);
  scenes_view_direction(options, 17, 35);
}

void scenes_self_intersecting(struct scene *scene, recto_options *options) {
  /* The tube's axis is a lemniscate that crosses itself at the middle. */
  enum { rings = 36, sides = 7 };
  const double turn = 2 * acos(-1);
  for (unsigned i = 0; i < rings; i++) {
    double t = turn * (i + 0.25) / rings;
    struct vector at = {2 * sin(t), sin(2 * t), 0.15 * cos(t)};
    struct vector along = {2 * cos(t), 2 * cos(2 * t), -0.15 * sin(t)};
    along = vector_scale(along, 1 / sqrt(vector_dot(along, along)));
    struct vector side = vector_cross(along, vector_of(0, 0, 1));
    side = vector_scale(side, 1 / sqrt(vector_dot(side, side)));
    struct vector over = vector_cross(side, along);
    for (unsigned k = 0; k < sides; k++) {
      double angle = turn * k / sides;
      build_vector(
          scene,
          vector_add(at, vector_add(vector_scale(side, 0.5 * cos(angle)),
                                    vector_scale(over, 0.5 * sin(angle)))));
    }
  }
  for (uint32_t i = 0; i < rings; i++) {
    uint32_t next = (i + 1) % rings;
    for (uint32_t k = 0; k < sides; k++) {
      uint32_t l = (k + 1) % sides;
      build_triangle(scene, i * sides + k, next * sides + l, i * sides + l);
      build_triangle(scene, i * sides + k, next * sides + k, next * sides + l);
    }
  }
  scenes_view_direction(options, 20, 40);
}

void scenes_pierced_along_diagonal(struct scene *scene,
                                   recto_options *options) {
  /* The upright sheet stands on one diagonal of the square, on the other of
   * the kite, and through an edge that two triangles share. */
  build_group(scene, "square");
  build_parallelogram(scene, vector_of(-2, -2, 0), vector_of(4, 0, 0),
                      vector_of(0, 4, 0));
  build_group(scene, "fan");
  uint32_t first = build_point(scene, 3, 3, 0);
  build_point(scene, 5, 5, 0);
  build_point(scene, 3, 5, 0.5);
  build_point(scene, 5, 3, 0.5);
  build_triangle(scene, first, first + 1, first + 2);
  build_triangle(scene, first, first + 3, first + 1);
  build_group(scene, "sheets");
  build_parallelogram(scene, vector_of(-1.5, -1.5, -1), vector_of(6, 6, 0),
                      vector_of(0, 0, 2));
  build_parallelogram(scene, vector_of(-1.5, 1.5, -1), vector_of(3, -3, 0),
                      vector_of(0, 0, 2));
  scenes_view_direction(options, 14, 38);
}

void scenes_crossed_in_diagonal(struct scene *scene, recto_options *options) {
  const double corner[6][3] = {{0, 0, 0},   {3, 0, 0},     {-1, 2, 0},
                               {-1, -2, 0}, {0.5, 0.5, 2}, {0.5, -0.5, -2}};
  for (uint32_t copy = 0; copy < 2; copy++) {
    uint32_t at = 6 * copy;
    for (int k = 0; k < 6; k++)
      build_point(scene, corner[k][0], corner[k][1] + 6 * copy, corner[k][2]);
    build_quad(scene, at + 2, at, at + 3, at + 1);
    if (copy == 0)
      build_quad(scene, at + 4, at, at + 5, at + 1);
    else {
      build_triangle(scene, at + 4, at, at + 1);
      build_triangle(scene, at + 5, at + 1, at);
    }
  }
  scenes_view_direction(options, 200, 50);
}
