/* ear_clipping.h - the judge's ear clipping for polygons of very many corners.
 */
#ifndef JUDGE_EAR_CLIPPING_H
#define JUDGE_EAR_CLIPPING_H

#include "judge/point.h"

struct judge_ear {
  uint32_t corner[3]; /* indices into the face's corners */
};

/* An entry of the corners sorted by x, or by y. */
struct judge_sorted_corner {
  double at; /* the coordinate */
  uint32_t corner;
};

/* The result and the work space, kept from face to face; zero-initialised is
 * empty. */
struct judge_ears {
  ARRAY(struct judge_ear) ear;        /* of the last face */
  ARRAY(struct judge_point2) at;      /* its corners, projected */
  ARRAY(uint32_t) left, next, before; /* the corners that are left */
  /* The corners sorted by x and by y. */
  ARRAY(struct judge_sorted_corner) by[2];
};

/* Triangulates a face into at most count - 2 triangles, in doubles, projected
 * along the largest component of its Newell normal.  A face that crosses itself
 * gets some triangles that cover it.  It does not follow the rule of
 * triangulation.h, which is too slow for so many corners; for a planar face
 * that makes no difference.
 * Returns false when memory ran out.
 * Cost  each ear tests only the corners within its range of x or of y,
 *   whichever are fewer. */
USE_RESULT bool judge_clip_ears(struct judge_ears *ears,
                                const struct scene *scene,
                                const uint32_t *corner, uint32_t count);
void judge_ears_fini(struct judge_ears *ears);

#endif
