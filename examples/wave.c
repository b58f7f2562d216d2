/* wave.c - the graph of a function of two variables over a square, in quads. */
#include <math.h>

#include "examples/models.h"

enum { squares = 48 };

static const double half_side = 10, scale = 6;

static double wave_at(double x, double y) {
  double r = hypot(x, y);
  return r > 0 ? sin(r) / r : 1;
}

void models_wave(struct shape *shape) {
  shape_group(shape, "wave");
  for (unsigned j = 0; j <= squares; j++)
    for (unsigned i = 0; i <= squares; i++) {
      double x = half_side * (2.0 * i / squares - 1);
      double y = half_side * (2.0 * j / squares - 1);
      shape_point(shape, point3_of(x, y, scale * wave_at(x, y)));
    }
  for (uint32_t j = 0; j < squares; j++)
    for (uint32_t i = 0; i < squares; i++) {
      uint32_t first = j * (squares + 1) + i;
      shape_quad(shape, first, first + 1, first + squares + 2,
                 first + squares + 1);
    }
}
