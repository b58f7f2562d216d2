/* star.c - the compound of five tetrahedra, which pierce each other. */
#include <math.h>
#include <stdio.h>

#include "examples/models.h"

enum { bodies = 5, corners = 4 };

static const double scale = 25;

/* Turns about the unit vector `axis`, by Rodrigues' formula. */
static struct point3 turned(struct point3 p, struct point3 axis,
                            double radians) {
  double c = cos(radians), s = sin(radians);
  double along = (1 - c) * (p.x * axis.x + p.y * axis.y + p.z * axis.z);
  return point3_of(c * p.x + s * (axis.y * p.z - axis.z * p.y) + along * axis.x,
                   c * p.y + s * (axis.z * p.x - axis.x * p.z) + along * axis.y,
                   c * p.z + s * (axis.x * p.y - axis.y * p.x) +
                       along * axis.z);
}

/* The corners of all five are those of a dodecahedron: the first body has four
 * of a cube's, the others are turned about the axis of a face. */
void models_star(struct shape *shape) {
  static const signed char sign[corners][3] = {
      {1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const double golden = (1 + sqrt(5)) / 2, length = hypot(1, golden);
  struct point3 axis = point3_of(1 / length, 0, golden / length);
  for (unsigned body = 0; body < bodies; body++) {
    char name[16];
    snprintf(name, sizeof name, "body_%c", (char)('a' + body));
    shape_group(shape, name);
    uint32_t first = corners * body;
    for (unsigned k = 0; k < corners; k++) {
      struct point3 corner =
          point3_of(scale * sign[k][0], scale * sign[k][1], scale * sign[k][2]);
      shape_point(shape, turned(corner, axis, 2 * acos(-1) * body / bodies));
    }
    shape_triangle(shape, first, first + 1, first + 2);
    shape_triangle(shape, first, first + 3, first + 1);
    shape_triangle(shape, first, first + 2, first + 3);
    shape_triangle(shape, first + 1, first + 3, first + 2);
  }
}
