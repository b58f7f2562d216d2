/* duplicates.c - very many faces at nearly one position: copies of a triangle,
 * and the pages of a book. */
#include <math.h>

#include "tests/scenes/random.h"
#include "tests/scenes/scenes.h"

static struct vector moved(struct vector at, double by, struct random *random) {
  return vector_of(at.x + random_between(random, -by, by),
                   at.y + random_between(random, -by, by),
                   at.z + random_between(random, -by, by));
}

void scenes_duplicates(struct scene *scene, recto_options *options, unsigned n,
                       bool pierced, double by) {
  const struct vector at[2][3] = {
      {{0, 0, 0}, {1, 0, 0.3}, {0.2, 1, 0.7}},
      {{0.2, 0.1, 1}, {0.7, 0.1, -1}, {0.5, 0.8, 0.1}}};
  struct random random = {n};
  for (unsigned i = 0; i < n; i++) {
    const struct vector *corner = at[pierced && i % 2];
    uint32_t p[3];
    for (int k = 0; k < 3; k++)
      p[k] = build_vector(scene, moved(corner[k], by, &random));
    if (i % 3 == 2) /* seen from behind */
      build_triangle(scene, p[0], p[2], p[1]);
    else
      build_triangle(scene, p[0], p[1], p[2]);
  }
  scenes_view_direction(options, 30, 20);
}

void scenes_book(struct scene *scene, recto_options *options, unsigned n,
                 double turns) {
  uint32_t a = build_point(scene, 0, 0, 0), b = build_point(scene, 0, 1, 0);
  for (unsigned i = 0; i < n; i++) {
    double angle = 2 * acos(-1) * turns * (i + 0.5) / n;
    uint32_t c = build_point(scene, cos(angle), 1, sin(angle)),
             d = build_point(scene, cos(angle), 0, sin(angle));
    build_quad(scene, a, b, c, d);
  }
  scenes_view_direction(options, 30, 20);
}
