/* open_surfaces.h - surfaces that are not closed where the scene is cut. */
#ifndef JUDGE_OPEN_SURFACES_H
#define JUDGE_OPEN_SURFACES_H

#include "judge/triangles.h"

/* What is known of a face's sides. */
enum judge_border {
  JUDGE_NO_BORDER,
  JUDGE_BORDER,    /* one is a border */
  JUDGE_BORDER_CUT /* ... which a plane of the cut meets */
};

/* Whether a plane of the cut meets the segment between two points. */
bool judge_is_cut_between(const struct judge_removed *removed,
                          struct judge_point3 a, struct judge_point3 b);

/* Sets has_border of the triangles of faces with a border, and of all that are
 * joined, by points, to a face whose border is cut: what planes cut of such a
 * surface may not be closed, wherever it is met.
 * border  of each face, an enum judge_border
 * Returns false when memory ran out. */
USE_RESULT bool judge_mark_borders(struct judge_triangles *all,
                                   const uint8_t *border);

#endif
