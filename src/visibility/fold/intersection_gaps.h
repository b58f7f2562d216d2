/* intersection_gaps.h - leads from where visible intersections end to smooth
 * contours. */
#ifndef VISIBILITY_FOLD_INTERSECTION_GAPS_H
#define VISIBILITY_FOLD_INTERSECTION_GAPS_H

#include "visibility/fold/outline_gaps.h"

/* Adds visible edges of the class silhouette along the mesh's outlines, from
 * where visible intersections end on them, as far as nothing hides the outline
 * and no visible contour runs beside it, nearer than a height of its triangles:
 * to the contour there, or to where the next intersection ends.
 * Where an intersection passes from what is seen of a surface to what is not,
 * the surface's outline continues it.  Of a mesh the intersection winds about
 * the outline and ends on it several times, at other places than where the
 * contour passes through the other surface.
 * Cost   near linear in the outlines, the lines and what is added
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool intersection_gaps_close(const struct outline_gaps_input *input);

#endif
