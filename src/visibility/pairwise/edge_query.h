/* edge_query.h - finds the occluded intervals of an edge from the candidate
 * lists of the page tiles it crosses (tile_candidates.h).
 *
 * Each list is searched from near to far.  A candidate is tested only if its
 * 8-DOP (kdop8.h) overlaps that of the remaining part of the edge: the interval
 * outside of which the edge is known to be hidden, which shrinks as occluders
 * are found.  Where triangles were culled it begins as what the occlusion
 * buffer does not hide: what hides only the rest changes nothing.
 *
 * Where a list is so long that it has a BVH, only what may hide the remaining
 * part by its bounds is tested, and the triangles that hid much of the edges
 * before are tested first: where many overlap, the same few near ones hide most
 * edges, and what they hide is tested against no other.
 */
#ifndef VISIBILITY_PAIRWISE_EDGE_QUERY_H
#define VISIBILITY_PAIRWISE_EDGE_QUERY_H

#include "base/parallel.h"
#include "visibility/culling/occlusion_culling.h"
#include "visibility/pairwise/tile_candidates.h"
#include "visibility/predicate/edge_intervals.h"

enum { EDGE_QUERY_RECENT = 16 };

/* The state of the queries of one thread, one edge after another. */
struct edge_query {
  const struct sheet *sheet;               /* borrowed, not owned */
  const struct tile_candidates *lists;     /* borrowed, not owned */
  const struct occlusion_culling *culling; /* borrowed; NULL: none */
  struct triangle_grid_query found;
  struct plane_cache planes; /* where the lists have no prepared occluders */
  struct edge_intervals intervals; /* the occluded ones: the result */
  struct occlusion_counts counts;
  /* Triangles that hid much of the edges before, the latest first; 0 of them to
   * forget them. */
  uint32_t recent[EDGE_QUERY_RECENT];
  size_t recent_count;
  /* The current edge. */
  const struct sheet_edge *edge;
  struct geom_point p, q;
  /* The remaining part of the edge, outside of which it is known to be
   * hidden. */
  struct geom_point end[2];
  struct kdop8 kdop;
  struct occluded_interval rest; /* its parameters on the edge */
  double from, to, share;        /* the same, and the difference */
  bool tried_recent;             /* it met a list with a BVH */
  bool several_cells; /* the edge crosses several cells, so that a triangle may
                         be found more than once */
  char apart[PARALLEL_APART];
};

/* Returns false when memory ran out; end with edge_query_fini either way. */
USE_RESULT bool edge_query_init(struct edge_query *query,
                                const struct sheet *sheet,
                                const struct tile_candidates *lists,
                                const struct occlusion_culling *culling);
void edge_query_fini(struct edge_query *query);

/* Computes the occluded intervals of edge e into query->intervals.  All tiles
 * that the edge crosses must have lists.
 * Returns false when memory ran out. */
USE_RESULT bool edge_query_solve(struct edge_query *query, uint32_t e);

#endif
