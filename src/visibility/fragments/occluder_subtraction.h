/* occluder_subtraction.h - subtracts nearer triangles from one triangle, one
 * after another.
 *
 * The plain algorithm, on which the brute-force solver relies as the reference
 * for face_occluders.h.
 */
#ifndef VISIBILITY_FRAGMENTS_OCCLUDER_SUBTRACTION_H
#define VISIBILITY_FRAGMENTS_OCCLUDER_SUBTRACTION_H

#include "visibility/predicate/triangle_pair.h"
#include "visibility/fragments/fragments.h"

struct occluder_subtraction {
  const struct sheet *sheet;
  uint32_t triangle; /* the current one */
  struct triangle_plane plane;
  struct box2 box;
  geom_pieces left, scratch; /* what remains of it, in disjoint pieces */
  bool whole;                /* nothing was subtracted yet */
  /* Counts for --stats: pairs whose boxes overlap; of these, pairs that share
   * area, so that their depth order was computed; of these, the planes
   * intersect. */
  uint64_t pairs, overlapping, crossings;
  struct arena arena;
};

void occluder_subtraction_init(struct occluder_subtraction *subtraction,
                               const struct sheet *sheet);
void occluder_subtraction_fini(struct occluder_subtraction *subtraction);

/* Makes a triangle, which is not flat, the current one.
 * part  the part of it to start with; NULL: all of it
 * Returns false when memory ran out, as all functions below. */
USE_RESULT bool
occluder_subtraction_start(struct occluder_subtraction *subtraction,
                           uint32_t triangle, const struct geom_convex *part);

/* Subtracts the region where triangle g, which is not flat, is nearer than the
 * current one.  Exact. */
USE_RESULT bool
occluder_subtraction_take_nearer(struct occluder_subtraction *subtraction,
                                 uint32_t g);

/* Subtracts the convex region to the left of `count` lines.
 * back  the same lines reversed; both are copied */
USE_RESULT bool
occluder_subtraction_take(struct occluder_subtraction *subtraction,
                          const struct geom_line *line,
                          const struct geom_line *back, int count);

/* Intersects what remains with the convex region to the left of `count` lines.
 * back  the same lines reversed; both are copied */
USE_RESULT bool
occluder_subtraction_keep(struct occluder_subtraction *subtraction,
                          const struct geom_line *line,
                          const struct geom_line *back, int count);

static inline bool
occluder_subtraction_is_empty(const struct occluder_subtraction *subtraction) {
  return subtraction->left.count == 0;
}

/* Adds what remains to the fragments. */
USE_RESULT bool
occluder_subtraction_store(struct occluder_subtraction *subtraction,
                           struct fragments *fragments);

/* Adds the counts to the report. */
void occluder_subtraction_report(const struct occluder_subtraction *subtraction,
                                 struct report *report);

#endif
