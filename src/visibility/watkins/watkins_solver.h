/* watkins_solver.h - Watkins' method with a pitch and without. */
#ifndef VISIBILITY_WATKINS_WATKINS_SOLVER_H
#define VISIBILITY_WATKINS_WATKINS_SOLVER_H

#include "visibility/solver.h"

/* Both solve as struct solver's `solve` does: on scan lines at request's pitch;
 * exactly, whatever that is.
 * Errors  those of `solve`; RECTO_ERROR_LIMIT: too many scan lines, or the
 *         sweep exceeds the limits of sweep.h or visible_trapezoids.h. */
USE_RESULT recto_status watkins_solve_at_pitch(
    struct sheet *sheet, const struct solver_request *request, struct map *map,
    struct report *report, recto_error *error);
USE_RESULT recto_status watkins_solve_exactly(
    struct sheet *sheet, const struct solver_request *request, struct map *map,
    struct report *report, recto_error *error);

#endif
