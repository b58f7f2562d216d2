/* quantitative_invisibility.h - how many faces hide each point of an edge. */
#ifndef VISIBILITY_QUANTITATIVE_INVISIBILITY_H
#define VISIBILITY_QUANTITATIVE_INVISIBILITY_H

#include "visibility/solver.h"

/* Finds where more than `limit` >= 0 faces hide an edge that is drawn, and
 * stores these intervals in map->over_limit; with `counts` it stores all that
 * are hidden, with the number of faces, in map->invisible.
 *
 * A face counts where occlusion.h says that it hides the point of the edge;
 * two faces that meet along a shared side count as one there.  The count
 * depends on the sheet alone, not on the solver: where a raster method is
 * wrong about what is visible, the count is right all the same.
 *
 * Errors    RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED.
 * Cost      proportional to the pairs of a hidden edge and a triangle whose
 *           grid cells it crosses on the page
 * Source    [Appel1967] */
USE_RESULT recto_status quantitative_invisibility_find(
    struct map *map, const struct sheet *sheet, int limit, bool counts,
    struct report *report, recto_error *error);

#endif
