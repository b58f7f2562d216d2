/* doubled_contours.h - of contours that coincide on the page, as those of a
 * torus that is seen along its plane, the nearest one is drawn. */
#ifndef VISIBILITY_CONTOUR_DOUBLED_CONTOURS_H
#define VISIBILITY_CONTOUR_DOUBLED_CONTOURS_H

#include "visibility/map.h"

/* Hides parts of visible contours that lie beside a nearer visible one in about
 * the same direction: over its surface, by no more than a tenth of its
 * triangles' height, within which visibility is not sampled, or beyond it by no
 * more than `beyond`.
 * A part is shorter than eight such heights only where it is all of what is
 * visible there.  What goes on where the nearer contour ends is led to its end.
 * first    of the sheet's edges: the first one of a contour; they have their
 *          surface on the left, and follow each other along the curves
 * height   one a contour's edge: that of its triangle, grid units
 * beyond   grid units
 * compared  gets how many contours were compared with places, too
 * Cost     near linear in the contours
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool doubled_contours_hide(struct sheet *sheet, struct map *map,
                                      uint32_t first, const float *height,
                                      double beyond, uint64_t *compared);

#endif
