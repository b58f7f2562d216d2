/* surfaces.c - graphs of functions. */
#include <math.h>

#include "tests/scenes/scenes.h"

static double bowl(double x, double y) { return x * x + y * y; }

static double ripple(double x, double y) {
  double r = hypot(12 * x, 12 * y);
  return r == 0 ? 1 : sin(r) / r;
}

/* Adds z = height(x, y) over [-1, 1]^2 in n x n cells of two triangles. */
static void add_surface(struct scene *scene, unsigned n,
                        double (*height)(double, double)) {
  uint32_t first = (uint32_t)scene->point.count;
  for (unsigned y = 0; y <= n; y++) {
    for (unsigned x = 0; x <= n; x++) {
      double u = 2.0 * x / n - 1, v = 2.0 * y / n - 1;
      build_point(scene, u, v, height(u, v));
    }
  }
  build_grid(scene, first, n, n, true);
}

void scenes_paraboloid(struct scene *scene, recto_options *options,
                       unsigned n) {
  add_surface(scene, n, bowl);
  scenes_view_direction(options, 26, 17);
  options->ink.edges = RECTO_EDGES_ALL;
}

void scenes_sinc(struct scene *scene, recto_options *options, unsigned n) {
  add_surface(scene, n, ripple);
  scenes_view_direction(options, 33, 22);
  options->ink.edges = RECTO_EDGES_ALL;
}
