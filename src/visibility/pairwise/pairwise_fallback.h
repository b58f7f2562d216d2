/* pairwise_fallback.h - the edges and faces that a method leaves undecided, because its
 * own way with them would cost too much time or memory.
 *
 * Newell's splits, Warnock's windows and Watkins' trapezoids all grow with the
 * crossings of what is hidden, too.  Where they would grow out of bounds, each
 * method leaves the edge or the face to the lists of triangles by page tiles
 * (tile_candidates.h), where the tiles method solves what no tile decides: edges by
 * edge_query.h, faces by undecided_faces.h.  The answer is the same, for it depends on
 * the sheet alone; memory is linear in the triangles.
 */
#ifndef VISIBILITY_PAIRWISE_PAIRWISE_FALLBACK_H
#define VISIBILITY_PAIRWISE_PAIRWISE_FALLBACK_H

#include "visibility/pairwise/edge_query.h"
#include "visibility/pairwise/undecided_faces.h"
#include "visibility/progress.h"

struct pairwise_fallback {
  const struct sheet *sheet; /* lent */
  struct progress *progress; /* lent */
  struct tile_classification tiles;
  struct tile_candidates lists; /* of all tiles */
  uint8_t *wanted;              /* one a tile: all of them */
  struct edge_query edge;
  struct undecided_faces undecided_faces;
  uint8_t
      *state; /* one a triangle, as of undecided_faces.h; NULL: lines only */
};

/* Lists the triangles; zero-initialised is empty, and pairwise_fallback_fini is due
 * either way.
 * fragments  faces will be asked for, not only edges
 * Returns false when memory ran out. */
USE_RESULT bool pairwise_fallback_init(struct pairwise_fallback *fallback,
                                       const struct sheet *sheet,
                                       bool fragments,
                                       struct progress *progress);
void pairwise_fallback_fini(struct pairwise_fallback *fallback);

/* Finds what is hidden of an edge, which is not a point on the page.  Returns
 * NULL when memory ran out, or the caller wants no more. */
struct edge_intervals *
pairwise_fallback_edge(struct pairwise_fallback *fallback, uint32_t e);

/* Finds what is visible of these triangles, none of them flat, and hands it in;
 * puts them into another order.  Returns false when memory ran out, or the
 * caller wants no more. */
USE_RESULT bool pairwise_fallback_faces(struct pairwise_fallback *fallback,
                                        uint32_t *triangle, size_t count,
                                        struct fragments *fragments);

#endif
