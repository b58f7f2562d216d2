/* candidate_pairs.h - pairs of triangles that may pierce each other. */
#ifndef VISIBILITY_INTERSECTION_CANDIDATE_PAIRS_H
#define VISIBILITY_INTERSECTION_CANDIDATE_PAIRS_H

#include "visibility/intersection/pair_sweep.h"

/* The caller sets the members up to `progress`, the others to 0. */
void pair_sweep_fini(struct pair_sweep *sweep);

/* Calls visit(user, f, g, straddle), f's number below g's, for candidate pairs,
 * each of which one cell gives.  Their coarse planes are computed; where
 * `straddle`, each certainly straddles that of the other, no corner in contact.
 * The two
 *   - share a cell of the grid that has a list and is selected by `cells`,
 *   - have boxes that meet on the page and in depth,
 *   - share less than an edge, and
 *   - are not certainly on one side of each other's planes.
 * begin, end  the cells, row by row: from `begin` to before `end`
 * Returns false when memory ran out, or as soon as visit returns false or the
 * caller cancels. */
USE_RESULT bool pair_sweep_cells(struct pair_sweep *sweep, size_t begin,
                                 size_t end);

#endif
