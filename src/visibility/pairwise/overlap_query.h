/* overlap_query.h - finds the triangles of the candidate lists that may overlap
 * one on the page.
 *
 * On a dense mesh most of those whose 8-DOPs (kdop8.h) overlap that of a
 * triangle have a corner in common with it, and are beyond one of its sides.
 */
#ifndef VISIBILITY_PAIRWISE_OVERLAP_QUERY_H
#define VISIBILITY_PAIRWISE_OVERLAP_QUERY_H

#include "visibility/pairwise/tile_candidates.h"

/* The state of the queries of one thread, one triangle after another. */
struct overlap_query {
  const struct sheet *sheet;           /* borrowed, not owned */
  const struct tile_candidates *lists; /* borrowed, not owned */
  struct triangle_grid_query found;    /* the result */
  /* The current triangle. */
  uint32_t triangle;
  struct geom_triangle corners;
  struct box2 box;
  struct kdop8 kdop;
};

/* Returns false when memory ran out; end with overlap_query_fini either way. */
USE_RESULT bool overlap_query_init(struct overlap_query *query,
                                   const struct sheet *sheet,
                                   const struct tile_candidates *lists);
void overlap_query_fini(struct overlap_query *query);

/* Finds the triangles, not edge-on, that may overlap a triangle on the page in
 * an area and are not certainly behind all of it; the triangle is none of them.
 * All tiles that it meets must have lists.
 * Returns false when memory ran out. */
USE_RESULT bool overlap_query_find_nearer(struct overlap_query *query,
                                          uint32_t triangle);

/* Adds the others, which are behind it. */
USE_RESULT bool overlap_query_add_behind(struct overlap_query *query);

#endif
