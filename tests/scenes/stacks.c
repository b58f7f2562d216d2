/* stacks.c - large faces over each other: a few plates, or nested shells. */
#include "tests/scenes/scenes.h"

void scenes_plates(struct scene *scene, recto_options *options, unsigned n,
                   bool above) {
  for (unsigned i = 0; i < n; i++) {
    double x = 0.37 * (i * 5 % 7), y = 0.41 * (i * 3 % 5);
    double z = 8.0 * i / (n > 1 ? n : 1);
    build_parallelogram(scene, vector_of(x, y, z), vector_of(10, 0, 0),
                        vector_of(0, 8, 0));
  }
  if (above)
    scenes_view_above(options);
  else
    scenes_view_direction(options, 28.1, 17.3);
}

void scenes_shells(struct scene *scene, recto_options *options, unsigned n,
                   unsigned rings) {
  for (unsigned i = 0; i < n; i++) {
    size_t first = scene->point.count;
    scenes_globe(scene, options, rings);
    double radius = 1.0 - 0.5 * i / n;
    for (size_t k = first; k < scene->point.count; k++) {
      struct scene_point *p = &scene->point.item[k];
      *p = (struct scene_point){radius * p->x, radius * p->y, radius * p->z};
    }
  }
}
