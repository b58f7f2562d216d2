/* fold_lines.h - draws long folds of a mesh beside which there is no smooth
 * contour. */
#ifndef VISIBILITY_FOLD_FOLD_LINES_H
#define VISIBILITY_FOLD_FOLD_LINES_H

#include "visibility/fold/outline_gaps.h"

/* Adds visible edges of the class silhouette along chains of the mesh's
 * outlines that nothing hides, and beside which, nearer than a height of their
 * triangles, no visible contour and no other line but creases is drawn, if they
 * are several such heights long and of many outlines, or a contour that ends
 * there continues them.
 * A surface that folds over in a strip narrower than a triangle has no vertex
 * whose mean normal is turned away, and so no contour.  The line is smoothed:
 * it leads from place to place of the mean of a chain's zigzag, and from and to
 * ends of contours that it continues.
 * Cost   near linear in the outlines
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool fold_lines_add(const struct outline_gaps_input *input);

#endif
