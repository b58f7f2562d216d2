/* watkins_solver.c - chooses between Watkins' method with a pitch and without.
 */
#include "visibility/watkins/watkins_solver.h"

static recto_status solve_watkins(struct sheet *sheet,
                                  const struct solver_request *request,
                                  struct map *map, struct report *report,
                                  recto_error *error) {
  return request->pitch_mm == 0
             ? watkins_solve_exactly(sheet, request, map, report, error)
             : watkins_solve_at_pitch(sheet, request, map, report, error);
}

const struct solver solver_watkins = {RECTO_METHOD_WATKINS, solve_watkins};
