/* edge_intervals.h - from what triangles hide of an edge to its visible intervals. */
#ifndef VISIBILITY_PREDICATE_EDGE_INTERVALS_H
#define VISIBILITY_PREDICATE_EDGE_INTERVALS_H

#include "visibility/predicate/occlusion.h"
#include "visibility/map.h"

typedef ARRAY(struct occluded_interval) occluded_intervals;

/* What is hidden of the edge at hand; one a thread, used edge by edge. */
struct edge_intervals {
  occluded_intervals
      both; /* parts with both sides covered: in order and apart, a
                        few at most */
  occluded_intervals part;        /* the others, as they came */
  occluded_intervals left, right; /* scratch: united, by side */
  bool whole; /* hidden from end to end: no more need be asked */
};

/* Zero-initialised is empty. */
void edge_intervals_fini(struct edge_intervals *intervals);

/* Forgets the last edge. */
static inline void edge_intervals_start(struct edge_intervals *intervals) {
  intervals->both.count = 0;
  intervals->part.count = 0;
  intervals->whole = false;
}

/* Adds a hidden part; false when memory ran out. */
USE_RESULT bool edge_intervals_occlude(struct edge_intervals *intervals,
                                       struct occluded_interval part);

/* The hidden parts united: those of one side in order and apart.  They are valid
 * until the next call.  Returns NULL when memory ran out. */
const occluded_intervals *
edge_intervals_unite(struct edge_intervals *intervals);

/* The stretch of the edge, from end to end, beyond which all is known to be
 * hidden. */
struct occluded_interval
edge_intervals_rest(const struct edge_intervals *intervals);

/* Room in the map for the edges of the sheet; those it had no room for yet
 * are hidden at first. */
USE_RESULT bool edge_intervals_open_map(struct map *map, size_t edge_count);

/* Files the visible intervals of `edge` in the map.  Edges come in ascending
 * order.  An edge is hidden where both of its sides are covered; a visible
 * piece without length is none. */
USE_RESULT bool edge_intervals_store(struct edge_intervals *intervals,
                                     uint32_t edge, struct map *map);

#endif
