/* watkins_exact.h - Watkins without a pitch, as the visible map. */
#ifndef VISIBILITY_WATKINS_EXACT_WATKINS_EXACT_H
#define VISIBILITY_WATKINS_EXACT_WATKINS_EXACT_H

#include "visibility/solver.h"

/* Solves as struct solver's `solve` does.
 * Errors  RECTO_ERROR_LIMIT: the scene is too much for the sweep. */
USE_RESULT recto_status watkins_solve_exactly(
    struct sheet *sheet, const struct solver_request *request, struct map *map,
    struct report *report, recto_error *error);

#endif
