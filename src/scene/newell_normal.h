/* newell_normal.h - the normal of a polygon in space. */
#ifndef SCENE_NEWELL_NORMAL_H
#define SCENE_NEWELL_NORMAL_H

#include "scene/scene.h"

/* The Newell normal of a polygon.  Its length is twice the area, and it points
 * to the side from which the polygon is counter-clockwise.  Coordinates are
 * taken relative to the first corner, so that models far from the origin lose
 * no precision.
 * corner  `count` indices of points, at least two
 * Cost    linear in the corners.
 * Source  [Rogers1985] */
void newell_normal(const struct scene_point *point, const uint32_t *corner,
                   uint32_t count, double normal[3]);

/* The same for three corners. */
static inline void newell_normal_of_triangle(const struct scene_point *o,
                                             const struct scene_point *p,
                                             const struct scene_point *q,
                                             double normal[3]) {
  double ax = p->x - o->x, ay = p->y - o->y, az = p->z - o->z;
  double bx = q->x - o->x, by = q->y - o->y, bz = q->z - o->z;
  normal[0] = ay * bz - az * by;
  normal[1] = az * bx - ax * bz;
  normal[2] = ax * by - ay * bx;
}

/* That of a face of the scene. */
static inline void newell_normal_of_face(const struct scene *scene,
                                         uint32_t face, double normal[3]) {
  const struct scene_point *point = scene->point.item;
  const uint32_t start = scene_face_start(scene, face);
  const uint32_t count = scene_face_start(scene, face + 1) - start;
  const uint32_t *corner = scene->corner.item + start;
  if (count == 3)
    newell_normal_of_triangle(&point[corner[0]], &point[corner[1]],
                              &point[corner[2]], normal);
  else
    newell_normal(point, corner, count, normal);
}

#endif
