/* edge_intervals.h - unites the occluded intervals of an edge, and stores the
 * complement, its visible intervals. */
#ifndef VISIBILITY_PREDICATE_EDGE_INTERVALS_H
#define VISIBILITY_PREDICATE_EDGE_INTERVALS_H

#include "base/sort.h"
#include "visibility/map.h"
#include "visibility/predicate/occlusion.h"

typedef ARRAY(struct occluded_interval) occluded_intervals;

/* The occluded intervals of the current edge.  One such struct serves all edges
 * of a thread, one after the other. */
struct edge_intervals {
  /* Intervals with both sides occluded, united as they are added: ascending
   * and disjoint, a limited number of them. */
  occluded_intervals merged;
  occluded_intervals unmerged;    /* all others, in the order they were added */
  occluded_intervals left, right; /* scratch: the union by side of the edge */
  ARRAY(struct sort_key) order;   /* scratch: intervals by their starts */
  bool occluded; /* from end to end: further occluders change nothing */
};

/* Zero-initialised is empty. */
void edge_intervals_fini(struct edge_intervals *intervals);

/* Starts a new edge. */
static inline void edge_intervals_start(struct edge_intervals *intervals) {
  intervals->merged.count = 0;
  intervals->unmerged.count = 0;
  intervals->occluded = false;
}

/* Adds an occluded interval; false when memory ran out. */
USE_RESULT bool edge_intervals_occlude(struct edge_intervals *intervals,
                                       struct occluded_interval interval);

/* The union of the occluded intervals.  Intervals with equal `sides` are
 * ascending and disjoint.  The result is valid until the next call.  Returns
 * NULL when memory ran out. */
const occluded_intervals *
edge_intervals_unite(struct edge_intervals *intervals);

/* The edge less what is known to be occluded from either end on: an interval
 * outside of which nothing is visible. */
struct occluded_interval
edge_intervals_remaining(const struct edge_intervals *intervals);

/* Makes room in the map for the states of `edge_count` edges; the new ones are
 * MAP_HIDDEN. */
USE_RESULT bool edge_intervals_open_map(struct map *map, size_t edge_count);

/* Stores the visible intervals of `edge` in the map, where edges must come in
 * ascending order.  An edge is hidden where both of its sides are occluded; a
 * visible interval of length zero is dropped. */
USE_RESULT bool edge_intervals_store(struct edge_intervals *intervals,
                                     uint32_t edge, struct map *map);

#endif
