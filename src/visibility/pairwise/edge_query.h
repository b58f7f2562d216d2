/* edge_query.h - what hides an edge, by lists of triangles by page tiles
 * (tile_candidates.h): the nearest triangles first, and only those that may meet the
 * stretch of the edge that is not known to be hidden. */
#ifndef VISIBILITY_PAIRWISE_EDGE_QUERY_H
#define VISIBILITY_PAIRWISE_EDGE_QUERY_H

#include "visibility/predicate/edge_intervals.h"
#include "visibility/pairwise/tile_candidates.h"

/* One a thread, used edge by edge. */
struct edge_query {
  const struct sheet *sheet;           /* lent */
  const struct tile_candidates *lists; /* lent */
  struct triangle_grid_query found;
  struct edge_intervals intervals; /* what is hidden of the edge: the answer */
  struct occlusion_counts counts;
  /* The current edge. */
  uint32_t triangle[2]; /* its own */
  struct geom_point p, q;
  /* What is not known to be hidden of it, and is still asked about. */
  struct geom_point end[2];
  struct kdop8 kdop;
  struct occluded_interval rest; /* the stretch between them */
  double share;                  /* of its length */
  bool several; /* it meets several tiles, and may meet a triangle in each */
};

/* Returns false when memory ran out; ends with edge_query_fini either way. */
USE_RESULT bool edge_query_init(struct edge_query *query,
                                const struct sheet *sheet,
                                const struct tile_candidates *lists);
void edge_query_fini(struct edge_query *query);

/* Finds what is hidden of an edge all of whose tiles have lists, into
 * query->strokes.  Returns false when memory ran out. */
USE_RESULT bool edge_query_solve(struct edge_query *query, uint32_t e);

#endif
