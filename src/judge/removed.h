/* removed.h - what a cut removes: the part of space that is beyond all of some
 * planes. */
#ifndef JUDGE_REMOVED_H
#define JUDGE_REMOVED_H

#include "judge/point.h"

enum { JUDGE_PLANES_MAX = 3 };

struct judge_plane {
  struct judge_point3 normal; /* unit */
  double offset;              /* beyond it is where normal . p > offset */
};

struct judge_removed {
  struct judge_plane plane[JUDGE_PLANES_MAX];
  int planes;     /* 0: nothing is removed */
  double near;    /* this close to a plane it is undecided, scene units */
  double contact; /* the largest of all faces */
};

static inline double judge_plane_height(const struct judge_plane *plane,
                                        struct judge_point3 p) {
  return point3_dot(plane->normal, p) - plane->offset;
}

/* How deep within what is removed a point lies; negative: it is not. */
static inline double judge_removed_depth(const struct judge_removed *removed,
                                         struct judge_point3 p) {
  double depth = removed->planes > 0 ? INFINITY : -INFINITY;
  for (int k = 0; k < removed->planes; k++)
    depth = fmin(depth, judge_plane_height(&removed->plane[k], p));
  return depth;
}

/* The parameters from *t0 to *t1 of the segment between a and b that lie higher
 * than `least` over all planes but number `but`, which may be -1.  Returns
 * false where none do.
 * least  -near: what may be removed; near: what surely is */
static inline bool judge_removed_part(const struct judge_removed *removed,
                                      double least, int but,
                                      struct judge_point3 a,
                                      struct judge_point3 b, double *t0,
                                      double *t1) {
  *t0 = 0;
  *t1 = 1;
  for (int k = 0; k < removed->planes; k++) {
    double from = judge_plane_height(&removed->plane[k], a) - least;
    double to = judge_plane_height(&removed->plane[k], b) - least;
    if (k == but)
      continue;
    if (from < 0 && to < 0)
      return false;
    if (from < 0)
      *t0 = fmax(*t0, from / (from - to));
    if (to < 0)
      *t1 = fmin(*t1, from / (from - to));
  }
  return removed->planes > 0 && *t0 < *t1;
}

#endif
