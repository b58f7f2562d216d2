/* candidate_pairs.h - pairs of triangles that may pierce each other. */
#ifndef VISIBILITY_INTERSECTION_CANDIDATE_PAIRS_H
#define VISIBILITY_INTERSECTION_CANDIDATE_PAIRS_H

#include "visibility/index/triangle_grid.h"
#include "visibility/progress.h"

/* Calls visit(user, f, g), f < g, once for every candidate pair.  The two
 *   - share a cell of the grid that has a list and is selected by `cells`,
 *   - have boxes that meet on the page and in depth,
 *   - share less than an edge, and
 *   - are not certainly on one side of each other's planes.
 * cells     per cell, not 0: selected; NULL: all are
 * progress  counts the work; NULL: never polled
 * met       gets added the number of pairs of one list whose depths overlap
 * Returns false when memory ran out, or as soon as visit returns false or the
 * caller cancels. */
USE_RESULT bool
candidate_pairs(const struct sheet *sheet, const struct triangle_grid *grid,
                const uint8_t *cells,
                bool (*visit)(void *user, uint32_t f, uint32_t g), void *user,
                struct progress *progress, uint64_t *met);

#endif
