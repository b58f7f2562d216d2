/* ear_clipping.h - cutting a polygon of very many corners into triangles, for the
 * judge. */
#ifndef JUDGE_EAR_CLIPPING_H
#define JUDGE_EAR_CLIPPING_H

#include "judge/point.h"

struct judge_ear {
  uint32_t corner[3]; /* numbers of the face's corners */
};

struct judge_rank {
  double at; /* x, or y, of a corner */
  uint32_t corner;
};

/* Room that is kept from face to face; zero-initialised is empty. */
struct judge_ears {
  ARRAY(struct judge_ear) ear;        /* of the face cut last */
  ARRAY(struct judge_point2) at;      /* its corners in a plane */
  ARRAY(uint32_t) left, next, before; /* corners still there */
  ARRAY(struct judge_rank) by[2];     /* corners by x and by y */
};

/* Cuts a face into at most count - 2 triangles.  Works in doubles in the plane
 * of the face's own normal; a face that crosses itself gives some triangles
 * that cover it.  How it is cut is not the rule of triangulation.h, which takes too long
 * for so many: of a planar face it makes no difference.
 * Returns false when memory ran out.
 * Cost: of many corners each ear asks those beside it alone, in x or in y. */
USE_RESULT bool judge_clip_ears(struct judge_ears *ears,
                                const struct scene *scene,
                                const uint32_t *corner, uint32_t count);
void judge_ears_fini(struct judge_ears *ears);

#endif
