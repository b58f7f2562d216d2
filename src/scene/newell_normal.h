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

/* That of a face of the scene. */
static inline void newell_normal_of_face(const struct scene *scene,
                                         uint32_t face, double normal[3]) {
  const uint32_t start[2] = {scene_face_start(scene, face),
                             scene_face_start(scene, face + 1)};
  newell_normal(scene->point.item, scene->corner.item + start[0],
                start[1] - start[0], normal);
}

#endif
