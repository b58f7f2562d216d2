/* thin_loops.h - leaves out loops of contour curves that are thinner than the
 * mesh can tell. */
#ifndef VISIBILITY_CONTOUR_THIN_LOOPS_H
#define VISIBILITY_CONTOUR_THIN_LOOPS_H

#include "visibility/contour/contour_curves.h"
#include "visibility/contour/part_size.h"

/* Where the image of a curve crosses itself after a few segments, what is
 * between is a loop: a swallowtail, two cusps and what joins them, or noise of
 * the normals.  If its mean width is less than a share of its triangles'
 * heights, the curve goes on at the crossing instead.  A whole curve that is
 * such a loop is left out, unless it is the contour of a body of few faces.
 * Long loops are folds of the surface, and stay.
 * set     the curves'; gets nodes and segments
 * Exact   whether two segments cross; where is rounded
 * Bound   what is left out lies in such a loop
 * Cost    linear in the segments
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool thin_loops_remove(struct contour_curves *curves,
                                  struct zero_set *set,
                                  const struct sheet *sheet,
                                  const struct topology *topology);

#endif
