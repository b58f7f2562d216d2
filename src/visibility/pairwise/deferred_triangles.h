/* deferred_triangles.h - solves the triangles that the tiles defer
 * (tile_classification.h), by the triangles of the candidate lists.
 *
 * Along a path inside a triangle, occlusion changes only at a contour (sheet.h)
 * or where a nearer triangle intersects its plane.  A triangle that neither
 * crosses is entirely visible or entirely hidden; it is hidden if any nearer
 * one overlaps it.  No piece has to be subtracted then.  The proof is in
 * deferred_triangles.c.
 *
 * A hidden triangle need not be tested as an occluder: whatever it occludes is
 * also occluded by the triangles that hide it.  Triangles are therefore solved
 * from near to far.
 */
#ifndef VISIBILITY_PAIRWISE_DEFERRED_TRIANGLES_H
#define VISIBILITY_PAIRWISE_DEFERRED_TRIANGLES_H

#include "base/number_lists.h"
#include "visibility/fragments/occluder_subtraction.h"
#include "visibility/pairwise/tile_candidates.h"

struct deferred_triangles_counts {
  uint64_t hidden, whole, mixed; /* triangles by result: hidden, visible as a
                                    whole, visible in part */
  uint64_t uncrossed;            /* of those hidden, the ones decided because
                                    no contour crosses them */
  struct occluder_subtraction_counts subtraction;
};

struct deferred_triangles {
  const struct sheet *sheet;
  const struct tile_candidates *lists; /* borrowed, not owned */
  uint8_t *state;               /* one per triangle, enum map_state; borrowed */
  struct number_lists contours; /* of each tile, ascending */
  struct deferred_triangles_counts counts;
};

/* Lists the contours by tile.
 * wanted  one per tile: not 0 where it has a list of triangles
 * state   one per triangle: MAP_HIDDEN where it is known to be hidden;
 *         triangles that are found to be hidden are marked there
 * Returns false when memory ran out; end with deferred_triangles_fini either
 * way. */
USE_RESULT bool deferred_triangles_init(struct deferred_triangles *d,
                                        const struct sheet *sheet,
                                        const struct tile_candidates *lists,
                                        const uint8_t *wanted, uint8_t *state);
void deferred_triangles_fini(struct deferred_triangles *d);

/* Computes the visible pieces of triangles and adds them to the fragments, by
 * as many threads as the call may use; pieces and counts are the same for any
 * number.
 * triangle  none is edge-on, all their tiles have lists; sorted from near to
 *           far, by depth bucket
 * progress  is polled, in each thread by a copy of its own
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool deferred_triangles_solve(struct deferred_triangles *d,
                                         uint32_t *triangle, size_t count,
                                         struct fragments *fragments,
                                         const struct progress *progress);

void deferred_triangles_report(const struct deferred_triangles *d,
                               struct report *report);

#endif
