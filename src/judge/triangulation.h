/* triangulation.h - the judge's own implementation of the rule by which faces
 * are triangulated (doc/algorithms.md). */
#ifndef JUDGE_TRIANGULATION_H
#define JUDGE_TRIANGULATION_H

#include "scene/scene.h"

struct judge_triangulation_corner {
  double at[2];          /* in the projection, which is counter-clockwise */
  double length;         /* squared, of the diagonal that cuts it off */
  uint32_t next, before; /* among the corners that are left */
  int turn;              /* left 1, right -1 */
  bool gone;             /* cut off or removed */
  bool refused;          /* tested: not an ear at present */
};

struct judge_triangulation_triangle {
  uint32_t corner[3]; /* indices into the face's corners */
};

/* Zero-initialised is empty; one serves any number of faces. */
struct judge_triangulation {
  /* Of the face cut last. */
  ARRAY(struct judge_triangulation_triangle) triangle;
  ARRAY(struct judge_triangulation_corner) corner;
};

/* The most corners that a face may have; each cut tests all of them, so the
 * cost is cubic at worst. */
enum { JUDGE_TRIANGULATION_MAX = 256 };

/* Triangulates a face of at most JUDGE_TRIANGULATION_MAX corners.
 * point  the original coordinates: the rule depends on their last bits
 * Returns false when memory ran out. */
USE_RESULT bool
judge_triangulation_make(struct judge_triangulation *triangulation,
                         const struct scene_point *point,
                         const uint32_t *corner, uint32_t count);
void judge_triangulation_fini(struct judge_triangulation *triangulation);

#endif
