/* triangulation.h - cutting a face into triangles by the rule of doc/algorithms.md, for
 * the judge. */
#ifndef JUDGE_TRIANGULATION_H
#define JUDGE_TRIANGULATION_H

#include "scene/scene.h"

struct judge_triangulation_corner {
  double at[2];          /* in the image along an axis, counter-clockwise */
  double length;         /* of the diagonal past it, as the rule compares */
  uint32_t next, before; /* of those that are left */
  int turn;              /* left 1, right -1 */
  bool gone, refused;    /* refused: it is no ear as things are */
};

struct judge_piece {
  uint32_t corner[3]; /* numbers of the face's corners */
};

/* Zero-initialised is empty; one serves any number of faces. */
struct judge_triangulation {
  ARRAY(struct judge_piece) piece; /* of the face cut last */
  ARRAY(struct judge_triangulation_corner) corner;
};

/* Most corners that a face may have: each cut looks at all of them. */
enum { JUDGE_TRIANGULATION_MOST = 256 };

/* Cuts a face of at most JUDGE_TRIANGULATION_MOST corners.
 * point  as they were given: the rule asks for their last digits
 * Returns false when memory ran out. */
USE_RESULT bool judge_triangulation_make(struct judge_triangulation *cuts,
                                         const struct scene_point *point,
                                         const uint32_t *corner,
                                         uint32_t count);
void judge_triangulation_fini(struct judge_triangulation *cuts);

#endif
