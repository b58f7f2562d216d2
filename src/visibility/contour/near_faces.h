/* near_faces.h - whether a face is near another one along the surface. */
#ifndef VISIBILITY_CONTOUR_NEAR_FACES_H
#define VISIBILITY_CONTOUR_NEAR_FACES_H

#include "scene/topology/topology.h"

/* What one search after the other needs; zero-initialised but for what is
 * borrowed.  A search about the same face as the one before it goes on where
 * that ended. */
struct near_faces {
  const struct scene *scene;       /* borrowed, not owned */
  const struct topology *topology; /* borrowed, not owned */
  uint8_t *found;                  /* one a face: it is in `face` */
  ARRAY(uint32_t) face;            /* those found about the first of them */
  size_t passed;                   /* so many of them, with those beside */
  uint64_t searched;               /* faces that were passed: the work done */
};

/* Finds whether a face is among the nearest ones of another, which are a
 * hundred or so about it, as edges connect them.
 * is_near  gets the answer
 * Cost     a constant, after the first call
 * Returns false when memory ran out. */
USE_RESULT bool near_faces_find(struct near_faces *near, uint32_t face,
                                uint32_t other, bool *is_near);

/* Forgets what was found about the last face, which would serve again. */
void near_faces_clear(struct near_faces *near);
void near_faces_fini(struct near_faces *near);

#endif
