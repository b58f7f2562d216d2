/* watkins_exact.h - Watkins' method without a pitch: the exact visible map. */
#ifndef VISIBILITY_WATKINS_EXACT_WATKINS_EXACT_H
#define VISIBILITY_WATKINS_EXACT_WATKINS_EXACT_H

#include "visibility/solver.h"

/* Solves as struct solver's `solve` does.
 * Errors  those of `solve`; RECTO_ERROR_LIMIT: the sweep exceeds the limits of
 *         sweep.h or trapezoid_cells.h. */
USE_RESULT recto_status watkins_solve_exactly(
    struct sheet *sheet, const struct solver_request *request, struct map *map,
    struct report *report, recto_error *error);

#endif
