/* polygon.h - a polygon in space, and its projection along a coordinate axis.
 */
#ifndef SCENE_TRIANGULATION_POLYGON_H
#define SCENE_TRIANGULATION_POLYGON_H

#include <math.h>

#include "scene/scene.h"

struct polygon {
  const struct scene_point *point;
  const uint32_t *corner; /* indices of points */
  uint32_t count;
};

/* Twice the signed area of the projection along each axis, and the extent. */
struct polygon_areas {
  double value[3];
  double extent; /* the largest difference of any coordinate */
};

struct polygon_areas polygon_measure(const struct polygon *polygon);

/* The distance of the farthest corner from the plane of the polygon's Newell
 * normal through its first corner; 0 for triangles and where it has no area. */
double polygon_off_plane(const struct polygon *polygon,
                         const struct polygon_areas *areas);

/* Projects the corners along the axis of largest projected area, mirrored where
 * needed so that the projection runs counter-clockwise.
 * at  two doubles for the first corner; `stride` bytes to the next
 * Rule
 *   Areas are compared in single precision, so that those that differ by
 *   rounding only are equal; among equal ones z is chosen before x before y.
 *   Where no area exceeds TOLERANCE_NO_AREA_SHARE of the extent's square, as in
 *   a bow-tie, whose lobes cancel, it is the axis along which the polygon is
 *   thinnest, and the leftmost corner of the projection turns left. */
void polygon_project(const struct polygon *polygon,
                     const struct polygon_areas *areas, void *at,
                     size_t stride);

static inline void polygon_position(const struct polygon *polygon, uint32_t c,
                                    double to[3]) {
  const struct scene_point *p = &polygon->point[polygon->corner[c]];
  to[0] = p->x;
  to[1] = p->y;
  to[2] = p->z;
}

/* Compares the positions of two corners by x, then y, then z. */
static inline int polygon_compare(const struct polygon *polygon, uint32_t c,
                                  uint32_t d) {
  const struct scene_point *a = &polygon->point[polygon->corner[c]],
                           *b = &polygon->point[polygon->corner[d]];
  if (a->x != b->x)
    return a->x < b->x ? -1 : 1;
  if (a->y != b->y)
    return a->y < b->y ? -1 : 1;
  return (a->z > b->z) - (a->z < b->z);
}

/* The square of the distance between two corners, rounded to 24 bits, so that
 * distances that differ by rounding only are equal. */
double polygon_distance(const struct polygon *polygon, uint32_t c, uint32_t d);

#endif
