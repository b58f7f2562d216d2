/* intersection_cuts.h - where contour curves pass through faces of other
 * surfaces. */
#ifndef VISIBILITY_CONTOUR_INTERSECTION_CUTS_H
#define VISIBILITY_CONTOUR_INTERSECTION_CUTS_H

#include "visibility/contour/contour_curves.h"
#include "visibility/map.h"

/* Adds cuts where curves pass through faces: where they are nearest to an end
 * of what is visible of an intersection, if they are as near as a triangle is
 * large.  Where a visible curve passes through a face, the intersection is
 * visible up to there.
 * Cost    near linear in the segments, and the ends with what is near them
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool intersection_cuts_add(struct contour_curves *curves,
                                      const struct sheet *sheet,
                                      const struct map *map);

#endif
