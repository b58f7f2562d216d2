/* box.h - the box of all points of a scene. */
#ifndef TESTS_SCENES_BOX_H
#define TESTS_SCENES_BOX_H

#include <math.h>

#include "scene/scene.h"

/* middle  gets that of the box
 * Returns half its diagonal. */
static inline double box_measure(const struct scene *scene, double middle[3]) {
  double low[3] = {INFINITY, INFINITY, INFINITY};
  double high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (size_t i = 0; i < scene->point.count; i++) {
    const struct scene_point *p = &scene->point.item[i];
    const double at[3] = {p->x, p->y, p->z};
    for (int k = 0; k < 3; k++) {
      low[k] = fmin(low[k], at[k]);
      high[k] = fmax(high[k], at[k]);
    }
  }
  for (int k = 0; k < 3; k++)
    middle[k] = (low[k] + high[k]) / 2;
  return hypot(hypot(high[0] - low[0], high[1] - low[1]), high[2] - low[2]) / 2;
}

#endif
