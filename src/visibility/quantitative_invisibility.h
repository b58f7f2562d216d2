/* quantitative_invisibility.h - behind how many faces an edge runs. */
#ifndef VISIBILITY_QUANTITATIVE_INVISIBILITY_H
#define VISIBILITY_QUANTITATIVE_INVISIBILITY_H

#include "visibility/solver.h"

/* Finds where more than `most` >= 0 faces hide an edge that is drawn, and puts
 * these parts into map->deep.
 *
 * A face counts where it hides the point of the edge by the one predicate of
 * hiding (occlusion.h); along a side that two faces share, they count as one.  The
 * count depends on the sheet alone, not on the solver: where a raster method
 * is wrong about what is visible, the count is right all the same.
 *
 * request   threads are not used; its progress function is called
 * Errors    RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED.
 * Cost      as that of the pairs of hidden edges and triangles over or under
 *           them on the page */
USE_RESULT recto_status
quantitative_invisibility_find(struct map *map, const struct sheet *sheet,
                               int most, const struct solver_request *request,
                               struct report *report, recto_error *error);

#endif
