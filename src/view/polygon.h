/* polygon.h - a polygon of the scene, and its image along a coordinate axis. */
#ifndef VIEW_POLYGON_H
#define VIEW_POLYGON_H

#include <math.h>

#include "scene/scene.h"

struct polygon {
  const struct scene_point *point;
  const uint32_t *corner; /* indices of points */
  uint32_t count;
};

/* Twice the area seen along each axis, and how large the polygon is. */
struct polygon_areas {
  double value[3];
  double extent; /* the largest difference of any coordinate */
};

struct polygon_areas polygon_measure(const struct polygon *polygon);

/* Whether a corner lies off the plane through the first one, by more than
 * rounding of the input explains. */
bool polygon_is_warped(const struct polygon *polygon,
                       const struct polygon_areas *areas);

/* The image of the corners along the axis that shows most of the polygon, so
 * that it runs counter-clockwise there.
 * at  of the first corner, two doubles; `stride` bytes to the next
 * Rule  areas are compared in single precision, so that what is equal but for
 *   rounding is equal; of equal ones z goes before x before y.  Where none is
 *   more than TOLERANCE_NO_AREA_SHARE of the extent's square, as of a bow-tie,
 *   whose lobes cancel, the axis is the one along which the polygon is
 *   thinnest, and its first corner from the left turns left. */
void polygon_flatten(const struct polygon *polygon,
                     const struct polygon_areas *areas, void *at,
                     size_t stride);

static inline void polygon_place(const struct polygon *polygon, uint32_t c,
                                 double to[3]) {
  const struct scene_point *p = &polygon->point[polygon->corner[c]];
  to[0] = p->x;
  to[1] = p->y;
  to[2] = p->z;
}

/* Compares the places of two corners by x, then y, then z. */
static inline int polygon_compare(const struct polygon *polygon, uint32_t c,
                                  uint32_t d) {
  double a[3], b[3];
  polygon_place(polygon, c, a);
  polygon_place(polygon, d, b);
  for (int k = 0; k < 3; k++)
    if (a[k] != b[k])
      return a[k] < b[k] ? -1 : 1;
  return 0;
}

/* The square of the distance between two corners, rounded to 24 bits, so that
 * distances that are equal but for rounding are equal. */
double polygon_distance(const struct polygon *polygon, uint32_t c, uint32_t d);

#endif
