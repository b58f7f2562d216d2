/* box.c - the box of all points of a scene. */
#include "bench/box.h"

#include <math.h>

double box_measure(const struct scene *scene, double middle[3]) {
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
