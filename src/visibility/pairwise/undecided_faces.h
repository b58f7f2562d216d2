/* undecided_faces.h - the faces that tiles (tile_classification.h) leave over: by the triangles
 * listed there, and as few of them as will do.
 *
 * What covers a face from nearer by changes only where a contour (sheet.h)
 * crosses it, or a triangle its plane.  So where neither is the case the face
 * is wholly visible, or wholly hidden, and any nearer triangle that overlaps it
 * tells which: no piece is cut.
 *
 * What is hidden need not be asked about: where it covers something, what hides
 * it does.  So the nearest are solved first.
 */
#ifndef VISIBILITY_PAIRWISE_UNDECIDED_FACES_H
#define VISIBILITY_PAIRWISE_UNDECIDED_FACES_H

#include "visibility/fragments/face_occluders.h"
#include "visibility/pairwise/tile_candidates.h"

struct undecided_faces_counts {
  uint64_t hidden, whole, mixed; /* triangles, as it turned out */
  uint64_t uncrossed;            /* of the first two, those told by contours */
};

struct undecided_faces {
  const struct sheet *sheet;
  const struct tile_candidates *lists; /* lent */
  uint8_t *state;            /* lent: one a triangle, enum map_state */
  uint32_t *start, *contour; /* of tile i: contour[start[i] .. start[i + 1]) */
  struct triangle_grid_query query;
  struct face_occluders occluders;
  struct undecided_faces_counts counts;
};

/* wanted  the tiles that have lists
 * state   one a triangle: MAP_HIDDEN where it is known to be hidden; what is
 *         found to be so is noted there */
USE_RESULT bool undecided_faces_init(struct undecided_faces *undecided_faces,
                                     const struct sheet *sheet,
                                     const struct tile_candidates *lists,
                                     const uint8_t *wanted, uint8_t *state);
void undecided_faces_fini(struct undecided_faces *undecided_faces);

/* Puts triangles into the order in which they are best solved. */
USE_RESULT bool
undecided_faces_sort(const struct undecided_faces *undecided_faces,
                     uint32_t *triangle, size_t count);

/* Finds what is visible of a triangle, not flat, all of whose tiles have
 * lists, and hands it in. */
USE_RESULT bool undecided_faces_solve(struct undecided_faces *undecided_faces,
                                      uint32_t triangle,
                                      struct fragments *fragments);

void undecided_faces_report(const struct undecided_faces *undecided_faces,
                            struct report *report);

#endif
