/* intersection.h - finds the lines in which faces pierce each other.
 *
 * Two triangles pierce each other where each straddles the other's plane, with
 * corners in front of it and behind it by more than the contact tolerance
 * (occlusion.h), and their intersection is a segment.  Touching never makes a
 * line: a box that stands on a table, or sinks into it by a rounding error,
 * does not pierce it.
 *
 * A surface may also pass through another along one of its own edges, where of
 * the two triangles that share the edge one ends on a plane from behind and one
 * from in front.  This is decided after all pairs (edge_crossing.h).
 *
 * The ends of a segment are where an edge of one triangle passes through the
 * other: decided by the exact signs of volumes, then rounded to the grid once,
 * to become an edge of the sheet like any other.  Neighbours that share the
 * edge get the same end, because it depends only on the edge and on the
 * triangle that is pierced.
 */
#ifndef VISIBILITY_INTERSECTION_INTERSECTION_H
#define VISIBILITY_INTERSECTION_INTERSECTION_H

#include "base/report.h"
#include "visibility/index/triangle_grid.h"
#include "visibility/solver.h"

/* Says whether a segment is certainly hidden, so that it need not be an edge of
 * the sheet: one of which each point is off that of p-q by less than `xy` on
 * the page and `z` in depth. */
struct hidden_segments {
  bool (*hides)(const void *user, struct geom_point p, struct geom_point q,
                double xy, double z);
  const void *user;
};

/* Finds the piercing pairs that share a cell of the grid with a list, and
 * appends their edges to the sheet's.
 * cells    per cell, not 0: pairs are sought there; NULL: everywhere
 * request  its progress function is called; NULL: none is
 * Errors   RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED. */
USE_RESULT recto_status intersection_find_all(
    struct sheet *sheet, const struct triangle_grid *grid, const uint8_t *cells,
    const struct solver_request *request, struct report *report,
    recto_error *error);

/* The same, and leaves out most segments that are hidden. */
USE_RESULT recto_status intersection_find_visible(
    struct sheet *sheet, const struct triangle_grid *grid, const uint8_t *cells,
    const struct hidden_segments *hidden, const struct solver_request *request,
    struct report *report, recto_error *error);

/* The same as the first with a grid of its own, everywhere, where intersections
 * are requested. */
USE_RESULT recto_status intersection_find_everywhere(
    struct sheet *sheet, const struct solver_request *request,
    struct report *report, recto_error *error);

struct intersection_segments; /* intersection_segment.h */

/* Adds segments to the sheet as drawable edges, each of them once, sorted by
 * their triangles.  Returns false when memory ran out. */
USE_RESULT bool
intersection_add_edges(struct sheet *sheet,
                       const struct intersection_segments *segments);

#endif
