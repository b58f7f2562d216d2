/* planar_subdivision.h - finds what lies beside each side of each fragment: the
 * half-edges of the planar subdivision that the fragments are.
 *
 * Every method that makes fragments adds, for each corner of the map, the
 * number of the line that its side lies on: sides that overlap have the same
 * number.  Fragments are disjoint and lie to the left of their sides.  So, of
 * the sides on one line, the forward ones are disjoint, and so are the reversed
 * ones, and a stretch that one of each has in common separates two neighbours.
 *
 * Where corners of neighbours lie within a side (T-junctions), the side is
 * divided into several half-edges.  The loops of the map keep their corners: a
 * side is one straight line, whatever lies beside it.
 *
 * Invariants
 *   twin(twin(h)) = h.  In maps of exact methods twins have the same two end
 *   points, and a half-edge without a twin has no visible face beside it.  In
 *   other maps ends of twins may differ by the rounding of their corners, and
 *   sides that leave the line of their edge have twins only if their two ends
 *   are the same.
 * Source  [Berg2008] ch. 2 (doubly connected edge list)
 */
#ifndef VISIBILITY_FRAGMENTS_PLANAR_SUBDIVISION_H
#define VISIBILITY_FRAGMENTS_PLANAR_SUBDIVISION_H

#include "geom/line.h"
#include "visibility/map.h"

/* The lines of the map's sides, to be freed with ARRAY_FREE. */
typedef ARRAY(uint64_t) side_lines;

/* Adds the side that starts at the map's next corner.
 * line  that the side lies on; not read if it is a piece of an edge
 * Returns false when memory ran out, as all functions below. */
USE_RESULT bool side_lines_add(side_lines *lines,
                               const struct map_corner *corner,
                               const struct geom_line *line);
/* The same for a line that has a key, not 0, by the caller's own rule. */
USE_RESULT bool side_lines_add_key(side_lines *lines, uint64_t key);

/* Writes the half-edges to the map, when all its sides have been added.
 * Cost  linear but for the sides on one line, which are sorted */
USE_RESULT bool planar_subdivision_store(const side_lines *lines,
                                         const struct sheet *sheet,
                                         struct map *map);

#endif
