/* corner_normals.h - the normals that a file gives to the corners of faces.
 *
 * A normal is a code of 32 bits, rounded to about a tenth of a degree; 0 is
 * none.  Most points have one normal in all of their faces, and those of a file
 * without edges that are marked as hard have no other: the scene stores one a
 * point.  From the first face on that disagrees it stores one a corner too. */
#ifndef SCENE_CORNER_NORMALS_H
#define SCENE_CORNER_NORMALS_H

#include "scene/scene.h"

/* The code of a direction of any length; 0 where it has none. */
uint32_t corner_normal_encode(double x, double y, double z);

/* The direction of a code other than 0, of any length. */
static inline void corner_normal_decode(uint32_t code, int direction[3]) {
  enum { MIDDLE = 512, MASK = 1023 };
  direction[0] = (int)(code >> 20 & MASK) - MIDDLE;
  direction[1] = (int)(code >> 10 & MASK) - MIDDLE;
  direction[2] = (int)(code & MASK) - MIDDLE;
}

/* The code of the opposite direction, of one other than 0. */
static inline uint32_t corner_normal_opposite(uint32_t code) {
  return UINT32_C(0x40100400) - code; /* 1024 less each coordinate */
}

/* Whether two normals are one, within TOLERANCE_NORMAL_SQUARED_COSINE; none is
 * one with none alone. */
bool corner_normals_agree(uint32_t a, uint32_t b);

/* The normal of a corner of a face. */
static inline uint32_t corner_normal_of(const struct scene *scene,
                                        uint32_t corner) {
  uint32_t point = scene->corner.item[corner];
  if (corner < scene->corner_normal.count)
    return scene->corner_normal.item[corner];
  return point < scene->point_normal.count ? scene->point_normal.item[point]
                                           : 0;
}

/* Turns the normals of the points from one on, and of the corners from one on,
 * about X from +Y up to +Z up, or back. */
void corner_normals_turn(struct scene *scene, size_t first_point,
                         size_t first_corner, bool to_z);

/* Gives the corners of `to` from `first` on, its last, the normals of a face
 * that another scene has, or none where some of its corners are left out. */
USE_RESULT bool corner_normals_copy(struct scene *to, size_t first,
                                    const struct scene *from, uint32_t face);

/* Makes point_normal hold a normal of each point so far: then those of the
 * points that a file adds may be appended, instead of normals of corners, if
 * each has one in all of its faces.  Returns false when memory ran out. */
USE_RESULT bool corner_normals_begin_points(struct scene *scene);

/* Notes the normals of corners that were added last, from `first` on.
 * normal  of each; NULL: they have none
 * Returns false when memory ran out. */
USE_RESULT bool corner_normals_add(struct scene *scene, size_t first,
                                   const uint32_t *normal);

#endif
