/* dense_edges.h - closes short gaps of edges that are visible in very many
 * parts.
 *
 * Where thousands of slivers cross each other, the visible parts of their edges
 * are as many as the pairs, though the pen covers the gaps between them.  Ink
 * closes gaps no longer than half a pen (ink/lines/gaps.c); of an edge with so
 * many parts these are closed before, as it is solved, so that memory does not
 * follow the pairs.
 */
#ifndef VISIBILITY_DENSE_EDGES_H
#define VISIBILITY_DENSE_EDGES_H

#include "visibility/map.h"

enum { DENSE_EDGES_PARTS = 256 }; /* an edge with more of them is dense */

/* Closes the gaps of an edge of the map, if it is dense: the intervals on both
 * sides of a gap become one.  Once closed, nothing is left to close.
 * gap  the longest that is closed, grid units; 0: none is */
void dense_edges_close(struct map *map, struct map_mixed *mixed,
                       const struct sheet *sheet, double gap);

/* The same for all edges of the map. */
void dense_edges_close_all(struct map *map, const struct sheet *sheet,
                           double gap);

#endif
