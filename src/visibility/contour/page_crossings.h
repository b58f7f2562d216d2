/* page_crossings.h - where the images of contour curves pass behind lines at
 * which surfaces end or fold. */
#ifndef VISIBILITY_CONTOUR_PAGE_CROSSINGS_H
#define VISIBILITY_CONTOUR_PAGE_CROSSINGS_H

#include "visibility/contour/contour_curves.h"

/* Adds cuts where the image of a curve crosses that of a curve or of a border,
 * if the curve is the farther one there.
 * Exact   whether two segments cross; where is rounded
 * Cost    near linear in the segments and crossings
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool page_crossings_cut(struct contour_curves *curves,
                                   const struct camera *camera);

#endif
