/* painter.h - whole faces painted in a given order, right or wrong. */
#ifndef VISIBILITY_NEWELL_PAINTER_H
#define VISIBILITY_NEWELL_PAINTER_H

#include "visibility/index/triangle_grid.h"
#include "visibility/solver.h"

/* Solves the sheet as if its triangles were painted in an order: one hides what
 * it covers of those painted before it, whatever their depths.  Lines of
 * intersection are not found.
 * rank  one per triangle; the lowest is painted first
 * Errors  RECTO_ERROR_MEMORY, _CANCELLED */
USE_RESULT recto_status painter_solve(const struct sheet *sheet,
                                      const struct triangle_grid *grid,
                                      const uint32_t *rank,
                                      const struct solver_request *request,
                                      struct map *map, recto_error *error);

#endif
