/* fold_bridges.h - closes short gaps of smooth contours where the mesh itself
 * folds over. */
#ifndef VISIBILITY_FOLD_FOLD_BRIDGES_H
#define VISIBILITY_FOLD_FOLD_BRIDGES_H

#include "visibility/fold/outline_gaps.h"

/* Adds a visible edge of the class silhouette from where one contour ends to
 * where another one begins, if it goes on in about the direction of both over
 * at most a few heights of the triangles there, and if everywhere along it,
 * nearer than such a height, a visible fold of the mesh runs in that direction
 * and no contour does.  Where a thin loop was left out (thin_loops.h) a contour
 * counts as one that ends or begins, for gaps that have no other end there.
 * A surface that folds over in a strip narrower than a triangle has no vertex
 * whose mean normal is turned away, and so no contour.
 * heights  one a contour's edge, as many as bulges: that of its triangle, grid
 *          units
 * Cost     near linear in the contours and outlines
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool fold_bridges_add(const struct outline_gaps_input *input,
                                 const float *heights);

#endif
