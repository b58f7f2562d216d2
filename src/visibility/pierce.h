/* pierce.h - where two triangles pierce each other.
 *
 * Two triangles pierce where each has corners on both sides of the other's
 * plane, in front of it and behind it by more than contact explains (hide.h),
 * and they meet along a segment.  Touching never makes a line: a box that
 * stands on a table, or sinks into it by a rounding, does not pierce it.
 *
 * The segment's ends are where an edge of one goes through the other: found
 * by exact signs of volumes, then rounded to the grid once, to become an edge
 * of the sheet like any other.  Neighbours that share the edge get the same
 * end, because it depends on the edge and the pierced triangle alone.
 */
#ifndef VISIBILITY_PIERCE_H
#define VISIBILITY_PIERCE_H

#include "base/report.h"
#include "visibility/hide.h"
#include "visibility/pagegrid.h"

struct pierce_segment {
  uint32_t triangle[2]; /* the lower first */
  struct geom_point end[2];
};

typedef ARRAY(struct pierce_segment) pierce_segments;

struct pierce_counts {
  uint64_t pairs;     /* triangles whose boxes and depths meet */
  uint64_t straddle;  /* of these, each is on both sides of the other */
  uint64_t segments;  /* of these, they meet */
};

/* Where triangle f, prepared as a hider (a flat one too), and triangle g
 * pierce each other; false: they do not, or only along the line of sight. */
bool pierce_pair(const struct sheet *sheet, const struct hider *hf, uint32_t f,
                 uint32_t g, struct pierce_segment *segment,
                 struct pierce_counts *counts);

/* Adds the segments to the sheet as drawable edges of class intersection,
 * ordered by their triangles; ends at the same place become one point.
 * Sorts `segments`. */
USE_RESULT bool pierce_add_edges(struct sheet *sheet,
                                 pierce_segments *segments);

/* Finds the piercing pairs that share a listed cell of the grid, and adds
 * their edges. */
USE_RESULT recto_status pierce_all(struct sheet *sheet,
                                   const struct pagegrid *grid,
                                   struct report *report, recto_error *error);

#endif
