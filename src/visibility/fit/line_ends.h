/* line_ends.h - lets the visible intervals of other lines end at smooth
 * contours instead of at the mesh's own outlines. */
#ifndef VISIBILITY_FIT_LINE_ENDS_H
#define VISIBILITY_FIT_LINE_ENDS_H

#include "visibility/map.h"

/* Moves ends of visible intervals along their edge to where it crosses a
 * visible contour.
 *   A line that passes behind a contour ends at it: the mesh's outline, which
 *   hides it, lies a little before or beyond.
 *   A line of the contour's own surface is cut off at it; a crease into which
 *   the contour turns, on the side on which it leads along the crease.
 * Bound  no end moves farther on the page than the image of the contour's
 *        triangle there is wide
 * first  of the sheet's edges: the first one of a contour.  The surface is on
 *        their left
 * Cost   near linear in the edges drawn
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool line_ends_move(struct map *map, const struct sheet *sheet,
                               uint32_t first);

#endif
