/* folded_faces.h - warped faces that fold over along a diagonal, so that their
 * triangles differ in the way they face. */
#ifndef VISIBILITY_ZERO_SET_FOLDED_FACES_H
#define VISIBILITY_ZERO_SET_FOLDED_FACES_H

#include "visibility/zero_set/zero_segments.h"

struct folded_faces {
  const struct sheet *sheet; /* borrowed, not owned */
  uint8_t *is_folded;        /* one a face; NULL: none is */
};

/* Whether a sheet's edge is such a diagonal: it is none of the mesh's. */
bool folded_faces_is_diagonal(const struct sheet *sheet,
                              const struct sheet_edge *edge);

/* Marks them.
 * folded  zero-initialised but for what is borrowed; the caller frees it
 * Returns false when memory ran out. */
USE_RESULT bool folded_faces_mark(struct folded_faces *folded);
void folded_faces_fini(struct folded_faces *folded);

static inline bool folded_faces_has(const struct folded_faces *folded,
                                    uint32_t face) {
  return folded->is_folded != NULL && folded->is_folded[face];
}

/* How the triangle of a folded face that has a side with this image faces the
 * viewer: FACING_FRONT or FACING_BACK; 0: there is none, or it is edge-on. */
unsigned folded_faces_sign(const struct folded_faces *folded, uint32_t face,
                           struct geom_segment side);

#endif
