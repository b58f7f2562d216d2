/* knot.c - a round tube along a torus knot, in triangles. */
#include <math.h>

#include "examples/models.h"

enum { windings = 2, turns = 3, sections = 300, sides = 16 };

static const double ring = 30, reach = 13, tube = 5.2;

/* A point of the knot, which winds about a torus. */
static struct point3 knot_at(double t) {
  double across = ring + reach * cos(turns * t);
  return point3_polar(across, windings * t, reach * sin(turns * t));
}

static struct point3 unit(struct point3 a) {
  double length = sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
  return point3_of(a.x / length, a.y / length, a.z / length);
}

static struct point3 cross(struct point3 a, struct point3 b) {
  return point3_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                   a.x * b.y - a.y * b.x);
}

/* Adds the ring of points about the knot at `t`. */
static void add_section(struct shape *shape, double t) {
  const double step = 1e-4, turn = 2 * acos(-1);
  struct point3 at = knot_at(t), before = knot_at(t - step);
  struct point3 after = knot_at(t + step);
  struct point3 along = unit(
      point3_of(after.x - before.x, after.y - before.y, after.z - before.z));
  /* The torus's own normal makes the frame close after a round. */
  struct point3 core = point3_polar(ring, windings * t, 0);
  struct point3 out = point3_of(at.x - core.x, at.y - core.y, at.z - core.z);
  struct point3 side = unit(cross(out, along));
  out = cross(along, side);
  for (unsigned k = 0; k < sides; k++) {
    double c = tube * cos(turn * k / sides), s = tube * sin(turn * k / sides);
    shape_point(shape, point3_of(at.x + c * out.x + s * side.x,
                                 at.y + c * out.y + s * side.y,
                                 at.z + c * out.z + s * side.z));
  }
}

void models_knot(struct shape *shape) {
  shape_group(shape, "knot");
  for (unsigned i = 0; i < sections; i++)
    add_section(shape, 2 * acos(-1) * i / sections);
  for (uint32_t i = 0; i < sections; i++) {
    uint32_t here = i * sides, there = (i + 1) % sections * sides;
    for (uint32_t k = 0; k < sides; k++) {
      uint32_t l = (k + 1) % sides;
      shape_triangle(shape, here + k, there + l, here + l);
      shape_triangle(shape, here + k, there + k, there + l);
    }
  }
}
