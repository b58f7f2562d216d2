/* vase.c - a hollow vase, a surface of revolution, in quads. */
#include <math.h>

#include "examples/models.h"

enum { sides = 96, rows = 48 };

static const double height = 120, wall = 4;

/* The outer radius at a height, 0 to 1. */
static double radius_at(double t) {
  return 30 + 14 * sin(2 * acos(-1) * (0.9 * t - 0.12)) - 6 * t * t * t +
         9 * pow(t, 12);
}

/* Adds a ring of points; returns the first. */
static uint32_t add_ring(struct shape *shape, double radius, double z) {
  uint32_t first = (uint32_t)shape->points;
  for (unsigned k = 0; k < sides; k++)
    shape_point(shape, point3_polar(radius, 2 * acos(-1) * k / sides, z));
  return first;
}

void models_vase(struct shape *shape) {
  shape_group(shape, "vase");
  uint32_t low = add_ring(shape, radius_at(0), 0), outer = low;
  shape_lid(shape, low, sides, false);
  for (unsigned i = 1; i <= rows; i++) {
    double t = (double)i / rows;
    uint32_t ring = add_ring(shape, radius_at(t), height * t);
    shape_band(shape, outer, ring, sides);
    outer = ring;
  }
  /* The inner surface runs down from the lip to the floor. */
  for (unsigned i = rows; i > 1; i--) {
    double t = (double)i / rows;
    uint32_t ring = add_ring(shape, radius_at(t) - wall, height * t);
    shape_band(shape, outer, ring, sides);
    outer = ring;
  }
  shape_lid(shape, outer, sides, true);
}
