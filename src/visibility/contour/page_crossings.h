/* page_crossings.h - where the images of contour curves pass behind lines at
 * which surfaces end, fold or meet. */
#ifndef VISIBILITY_CONTOUR_PAGE_CROSSINGS_H
#define VISIBILITY_CONTOUR_PAGE_CROSSINGS_H

#include "visibility/contour/contour_curves.h"
#include "visibility/map.h"

/* Adds cuts where the image of a curve crosses
 *   that of a curve or of a border, if the curve is the farther one there;
 *   an intersection of faces, if any part of it is visible.  Where a visible
 *   curve passes through a face, the intersection is visible there.  Hidden
 *   intersections are left out, as methods that cull hidden triangles do not
 *   find them: the drawing would depend on the method.  Intersections are the
 *   last edges of the sheet.
 * Exact   whether two segments cross; where is rounded
 * Cost    near linear in the segments and crossings
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool page_crossings_cut(struct contour_curves *curves,
                                   const struct sheet *sheet,
                                   const struct map *map);

#endif
