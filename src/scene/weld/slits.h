/* slits.h - finds where borders run along each other from one point to
 * another, between different points: a slit without width. */
#ifndef SCENE_WELD_SLITS_H
#define SCENE_WELD_SLITS_H

#include "scene/topology/topology.h"

/* A point that lies on a side of a face. */
struct slit_point {
  uint32_t corner; /* of the scene: the side runs from there to the next one */
  uint32_t place;  /* ascending along the side */
  uint32_t point;
};

typedef ARRAY(struct slit_point) slit_points;

/* Finds the points that the faces on either side of a slit have and those on
 * the other do not: where these are given them, the borders are no more.  Two
 * borders that begin at one point begin a slit if the end of the one lies on
 * the other, exactly or within the rounding of the points (thin_faces_length),
 * and if from there on borders go along each other until they meet at a point.
 * found  appended to, ascending by corner and place; the caller owns them, also
 *        on failure
 * Returns false when memory ran out.
 * Cost  of sorting the ends of borders, if two faces have borders at a point */
USE_RESULT bool slits_find(const struct scene *scene,
                           const struct topology *topology,
                           struct precision unstated, slit_points *found);

#endif
