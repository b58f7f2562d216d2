/* newell_normal.c - sums the areas of the projections of a polygon. */
#include "scene/newell_normal.h"

void newell_normal(const struct scene_point *point, const uint32_t *corner,
                   uint32_t count, double normal[3]) {
  struct scene_point o = point[corner[0]], p = point[corner[1]];
  struct scene_point a = {p.x - o.x, p.y - o.y, p.z - o.z};
  normal[0] = normal[1] = normal[2] = 0;
  for (uint32_t c = 2; c < count; c++) {
    p = point[corner[c]];
    struct scene_point b = {p.x - o.x, p.y - o.y, p.z - o.z};
    normal[0] += a.y * b.z - a.z * b.y;
    normal[1] += a.z * b.x - a.x * b.z;
    normal[2] += a.x * b.y - a.y * b.x;
    a = b;
  }
}
