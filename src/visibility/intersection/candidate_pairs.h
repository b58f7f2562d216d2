/* candidate_pairs.h - pairs of triangles that may pierce each other. */
#ifndef VISIBILITY_INTERSECTION_CANDIDATE_PAIRS_H
#define VISIBILITY_INTERSECTION_CANDIDATE_PAIRS_H

#include "visibility/index/triangle_grid.h"
#include "visibility/progress.h"

/* Calls visit(user, f, g), f < g, once for every pair that shares a cell of
 * the grid which has a list and is among `cells`, and may pierce: the boxes
 * meet on the page and in depth, they share less than an edge, and neither is
 * surely apart from the other's plane.
 * cells  one a cell; NULL: all
 * pulse  of the work
 * met    counts the pairs of triangles in one list whose depths overlap
 * Returns false when memory ran out, or as soon as visit or the pulse does. */
USE_RESULT bool
candidate_pairs(const struct sheet *sheet, const struct triangle_grid *grid,
                const uint8_t *cells,
                bool (*visit)(void *user, uint32_t f, uint32_t g), void *user,
                struct progress *progress, uint64_t *met);

#endif
