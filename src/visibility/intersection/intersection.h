/* intersection.h - where two triangles pierce each other.
 *
 * Two triangles pierce where each has corners on both sides of the other's
 * plane, in front of it and behind it by more than contact explains (occlusion.h),
 * and they meet along a segment.  Touching never makes a line: a box that
 * stands on a table, or sinks into it by a rounding, does not pierce it.
 *
 * Triangles may also cross along an edge: two that share it end on a plane,
 * one from behind and one from before, and so the surface passes through.
 * That is seen when all pairs were asked.
 *
 * A segment's ends are where an edge of one goes through the other: found
 * by exact signs of volumes, then rounded to the grid once, to become an edge
 * of the sheet like any other.  Neighbours that share the edge get the same
 * end, because it depends on the edge and the pierced triangle alone.
 */
#ifndef VISIBILITY_INTERSECTION_INTERSECTION_H
#define VISIBILITY_INTERSECTION_INTERSECTION_H

#include "base/report.h"
#include "visibility/index/triangle_grid.h"
#include "visibility/solver.h"

/* Finds the piercing pairs that share a listed cell of the grid, and adds
 * their edges.
 * cells    one a cell: where to look; NULL: everywhere
 * request  who is to be asked whether to go on; NULL: nobody
 * Errors   RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED. */
USE_RESULT recto_status intersection_find_all(
    struct sheet *sheet, const struct triangle_grid *grid, const uint8_t *cells,
    const struct solver_request *request, struct report *report,
    recto_error *error);

#endif
