/* pairwise_fallback.h - solves single edges and faces for a method whose own
 * algorithm would take too much time or memory for them.
 *
 * The number of Newell's splits, of Warnock's windows and of Watkins'
 * trapezoids grows with the crossings among hidden edges and faces too.  Where
 * that number exceeds a method's limit, the method defers the edge or the
 * face.  Deferred ones are solved from lists of candidate triangles per
 * page tile (tile_candidates.h), as the tiles method does: edges by
 * edge_query.h, faces by deferred_triangles.h.  The result is the same, since
 * it depends on the sheet alone; memory is linear in the number of triangles.
 */
#ifndef VISIBILITY_PAIRWISE_PAIRWISE_FALLBACK_H
#define VISIBILITY_PAIRWISE_PAIRWISE_FALLBACK_H

#include "visibility/pairwise/deferred_triangles.h"
#include "visibility/pairwise/edge_query.h"
#include "visibility/progress.h"

struct pairwise_fallback {
  const struct sheet *sheet; /* borrowed, not owned */
  struct progress *progress; /* borrowed, not owned */
  struct tile_classification tiles;
  struct tile_candidates lists; /* of all tiles */
  uint8_t *wanted;              /* one per tile: 1, as all have lists */
  struct edge_query edge;
  struct deferred_triangles deferred_triangles;
  uint8_t *state; /* one per triangle, as in deferred_triangles.h; NULL: the
                     fallback serves edges only */
};

/* Lists the triangles.
 * fragments  whether faces will be solved, not only edges
 * Returns false when memory ran out; end with pairwise_fallback_fini either
 * way, which also accepts a zero-initialised fallback. */
USE_RESULT bool pairwise_fallback_init(struct pairwise_fallback *fallback,
                                       const struct sheet *sheet,
                                       bool fragments,
                                       struct progress *progress);
void pairwise_fallback_fini(struct pairwise_fallback *fallback);

/* Computes the occluded intervals of edge e, whose ends differ on the page.
 * Returns NULL when memory ran out or the caller cancelled.
 * Owner  the fallback; valid until the next call */
struct edge_intervals *
pairwise_fallback_edge(struct pairwise_fallback *fallback, uint32_t e);

/* Computes the visible pieces of triangles, none of them edge-on, and adds them
 * to the fragments.  Reorders the list.
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool pairwise_fallback_faces(struct pairwise_fallback *fallback,
                                        uint32_t *triangle, size_t count,
                                        struct fragments *fragments);

#endif
