/* region.h - the union of convex pieces that do not overlap, in the one form
 * that depends on the union alone.
 *
 * Canonical form
 *   loops run with the region on their left;
 *   corners stand only where the boundary turns;
 *   a loop starts at its lowest corner in (x, y) (of several visits to it, the
 *   one whose next corner is lowest);
 *   loops that touch themselves at a corner are split or joined there by
 *   taking the sharpest left turn, so that the region stays on the left;
 *   each outer loop is followed by its holes; outers and holes are ordered by
 *   their first corners.
 */
#ifndef GEOM_REGION_H
#define GEOM_REGION_H

#include "geom/convex.h"

/* A corner and the line that the boundary follows from it. */
struct geom_region_side {
  struct geom_corner corner;
  const struct geom_line *line; /* of one piece; the region on its left */
};

struct geom_region_loop {
  uint32_t side, count;
  bool hole; /* belongs to the last loop before it that is none */
};

struct geom_region {
  ARRAY(struct geom_region_side) side;
  ARRAY(struct geom_region_loop) loop;
};

void geom_region_fini(struct geom_region *region);

/* Unites `count` pieces with disjoint interiors.  The region borrows their
 * lines.
 * Exact.  Returns false when memory ran out. */
USE_RESULT bool geom_region_unite(struct geom_region *region,
                                  const struct geom_convex *piece,
                                  size_t count);

#endif
