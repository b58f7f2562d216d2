/* fit_fragments.h - lets visible fragments end at smooth contours instead of at
 * the mesh's own outlines. */
#ifndef VISIBILITY_FIT_FIT_FRAGMENTS_H
#define VISIBILITY_FIT_FIT_FRAGMENTS_H

#include "visibility/fit/drawn_outlines.h"

/* Moves corners of fragments onto the visible contours.
 *
 * The mesh's outline lies beyond the contour on the page, by the height of an
 * arc over its chord.  A corner on an outline that is not drawn is moved to the
 * nearest point of the contours in the faces about the outline's edge; so is a
 * corner on any other mesh edge that lies beyond a contour in the faces about
 * it.  A point of the page is moved as one, whatever fragments meet there: they
 * remain a subdivision of the page, on both sides of a contour, without gaps.
 * Sides along contours get their ids.  Where there is no contour in the faces
 * about an edge nothing is moved, nor where a corner is on a contour already.
 *
 * Bound   no corner leaves the images of the faces about its edge; between two
 *         corners a side is the chord of the contour there
 * Cost    linear in the scene's points and the map's corners
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool fit_fragments(struct map *map, const struct sheet *sheet,
                              const struct topology *topology,
                              const struct drawn_outlines *drawn);

#endif
