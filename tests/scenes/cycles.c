/* cycles.c - faces that overlap in a ring, so that none is rearmost. */
#include <math.h>

#include "tests/scenes/random.h"
#include "tests/scenes/scenes.h"

/* Adds a ring of n flat bars about `middle`, seen from +z: each starts over
 * the one before it and ends under the one after. */
static void add_ring(struct scene *scene, struct vector middle, double radius,
                     unsigned n) {
  const double turn = 2 * acos(-1);
  for (unsigned i = 0; i < n; i++) {
    double angle = turn * (i + 0.1) / n;
    struct vector out = {cos(angle), sin(angle), 0};
    struct vector along = {-out.y, out.x, 0};
    /* Bar i runs along the tangent at a distance, from half a side before
     * the corner to half a side beyond it, rising towards the viewer. */
    double reach = radius * (tan(turn / (2 * n)) + 0.45);
    struct vector rise = {0, 0, 0.3 * radius};
    struct vector start = vector_add(
        vector_add(middle, vector_scale(out, radius)),
        vector_add(vector_scale(along, -reach), vector_scale(rise, -1)));
    build_parallelogram(
        scene, start,
        vector_add(vector_scale(along, 2 * reach), vector_scale(rise, 2)),
        vector_scale(out, 0.25 * radius));
  }
}

void scenes_cycle(struct scene *scene, recto_options *options, unsigned n) {
  add_ring(scene, vector_of(0, 0, 0), 1, n);
  scenes_view_above(options);
}

void scenes_nested_cycles(struct scene *scene, recto_options *options,
                          unsigned depth) {
  double radius = 1;
  for (unsigned i = 0; i < depth; i++) {
    add_ring(scene, vector_of(0, 0, 0.1 * i), radius, 3 + i % 2);
    radius *= 0.6;
  }
  scenes_view_above(options);
}

void scenes_cycle_field(struct scene *scene, recto_options *options,
                        unsigned n) {
  for (unsigned y = 0; y < n; y++)
    for (unsigned x = 0; x < n; x++)
      add_ring(scene, vector_of(5.5 * x, 5.5 * y, 0.01 * x), 1, 3);
  scenes_view_above(options);
}

void scenes_sticks(struct scene *scene, recto_options *options, unsigned n,
                   uint64_t seed) {
  struct random random = {seed};
  for (unsigned i = 0; i < n; i++) {
    struct vector at, along, across;
    at.x = random_between(&random, -10, 10);
    at.y = random_between(&random, -10, 10);
    at.z = random_between(&random, -2, 2);
    double angle = random_between(&random, 0, 2 * acos(-1));
    double length = random_between(&random, 2, 8);
    along = vector_of(length * cos(angle), length * sin(angle),
                      random_between(&random, -1, 1));
    across = vector_of(-0.15 * sin(angle), 0.15 * cos(angle),
                       random_between(&random, -0.05, 0.05));
    build_parallelogram(scene, at, along, across);
  }
  scenes_view_above(options);
}
