/* needles.c - many thin triangles that overlap: polygons of very many corners,
 * and fans about one vertex. */
#include <math.h>
#include <stdlib.h>

#include "tests/scenes/random.h"
#include "tests/scenes/scenes.h"

/* A place at an angle, in turns. */
static struct vector around(double turns, double radius, double z) {
  const double turn = 2 * acos(-1);
  return vector_of(radius * cos(turn * turns), radius * sin(turn * turns), z);
}

static void add_polygon(struct scene *scene, const struct vector *at,
                        uint32_t count) {
  uint32_t *corner = malloc(count * sizeof *corner);
  build_require(corner != NULL);
  for (uint32_t i = 0; i < count; i++)
    corner[i] = build_vector(scene, at[i]);
  build_face(scene, corner, count);
  free(corner);
}

/* Teeth on a bar, four corners each. */
static uint32_t place_comb(struct vector *at, uint32_t count) {
  uint32_t teeth = (count - 2) / 4, n = 0;
  at[n++] = vector_of(0, 0, 0);
  at[n++] = vector_of(2, 0, 0);
  for (uint32_t k = teeth; k-- > 0;) {
    double left = 2.0 * (2 * k) / (2 * teeth);
    double right = 2.0 * (2 * k + 1) / (2 * teeth);
    at[n++] = vector_of(right, 0.1, 0);
    at[n++] = vector_of(right, 1, 0);
    at[n++] = vector_of(left, 1, 0);
    at[n++] = vector_of(left, 0.1, 0);
  }
  return n;
}

static uint32_t place_spiral(struct vector *at, uint32_t count) {
  uint32_t half = count / 2;
  double turns = fmax(3, floor(sqrt(count) / 4));
  for (uint32_t i = 0; i < half; i++) {
    double t = turns * i / (half - 1);
    at[i] = around(t, 0.1 + (t + 0.4) / turns, 0);
    at[2 * half - 1 - i] = around(t, 0.1 + t / turns, 0);
  }
  return 2 * half;
}

static uint32_t place_corners(struct vector *at, enum scenes_needles kind,
                              uint32_t count, struct random *random) {
  if (kind == SCENES_NEEDLES_COMB)
    return place_comb(at, count);
  if (kind == SCENES_NEEDLES_SPIRAL)
    return place_spiral(at, count);
  for (uint32_t i = 0; i < count; i++) {
    double radius = 1, z = 0;
    if (kind == SCENES_NEEDLES_SPIKES || kind == SCENES_NEEDLES_UMBRELLA)
      radius = random_between(random, 0.4, 1);
    if (kind == SCENES_NEEDLES_UMBRELLA)
      z = random_between(random, -0.02, 0.02);
    at[i] = around((double)i / count, radius, z);
  }
  return count;
}

void scenes_needles(struct scene *scene, recto_options *options,
                    enum scenes_needles kind, unsigned n, uint64_t seed) {
  struct random random = {seed};
  struct vector *at = malloc(n * sizeof *at);
  build_require(at != NULL);
  uint32_t count = place_corners(at, kind, n, &random);
  if (kind < SCENES_NEEDLES_FLAT_FAN) {
    add_polygon(scene, at, count);
  } else {
    double height = kind == SCENES_NEEDLES_FLAT_FAN ? 0
                    : kind == SCENES_NEEDLES_CONE   ? 2
                                                    : 0.5;
    uint32_t hub = build_point(scene, 0, 0, height);
    for (uint32_t i = 0; i < count; i++)
      build_vector(scene, at[i]);
    for (uint32_t i = 0; i < count; i++)
      build_triangle(scene, hub, hub + 1 + i, hub + 1 + (i + 1) % count);
  }
  free(at);
  scenes_view_direction(options, 31, 33);
}
