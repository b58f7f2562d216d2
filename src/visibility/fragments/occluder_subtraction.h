/* occluder_subtraction.h - what nearer triangles leave of one triangle. */
#ifndef VISIBILITY_FRAGMENTS_OCCLUDER_SUBTRACTION_H
#define VISIBILITY_FRAGMENTS_OCCLUDER_SUBTRACTION_H

#include "visibility/predicate/triangle_pair.h"
#include "visibility/fragments/fragments.h"

struct occluder_subtraction {
  const struct sheet *sheet;
  uint32_t triangle; /* the one at hand */
  struct triangle_plane plane;
  struct box2 box;
  geom_pieces left, scratch; /* what is left of it, in disjoint pieces */
  bool whole;                /* nothing was taken yet */
  /* Counts for --stats: pairs whose boxes meet; of these, depth had to be
   * asked; of these, the planes cross. */
  uint64_t pairs, overlapping, crossings;
  struct arena arena;
};

void occluder_subtraction_init(struct occluder_subtraction *subtraction,
                               const struct sheet *sheet);
void occluder_subtraction_fini(struct occluder_subtraction *subtraction);

/* Starts anew with a triangle that is not flat.
 * part  a part of it to start with; NULL: all of it */
USE_RESULT bool
occluder_subtraction_start(struct occluder_subtraction *subtraction,
                           uint32_t triangle, const struct geom_convex *part);

/* Takes away where triangle g, not flat, is nearer. */
USE_RESULT bool
occluder_subtraction_take_nearer(struct occluder_subtraction *subtraction,
                                 uint32_t g);

/* Takes away the convex region left of `count` lines; they are copied. */
USE_RESULT bool
occluder_subtraction_take(struct occluder_subtraction *subtraction,
                          const struct geom_line *line,
                          const struct geom_line *back, int count);

/* Keeps only what is left of `count` lines; they are copied. */
USE_RESULT bool
occluder_subtraction_keep(struct occluder_subtraction *subtraction,
                          const struct geom_line *line,
                          const struct geom_line *back, int count);

static inline bool
occluder_subtraction_is_empty(const struct occluder_subtraction *subtraction) {
  return subtraction->left.count == 0;
}

/* Hands what is left to the fragments. */
USE_RESULT bool
occluder_subtraction_store(struct occluder_subtraction *subtraction,
                           struct fragments *fragments);

/* Adds the counts. */
void occluder_subtraction_report(const struct occluder_subtraction *subtraction,
                                 struct report *report);

#endif
