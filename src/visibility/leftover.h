/* leftover.h - the faces that tiles (tilemap.h) leave over: by the triangles
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
#ifndef VISIBILITY_LEFTOVER_H
#define VISIBILITY_LEFTOVER_H

#include "visibility/rivals.h"
#include "visibility/tilelist.h"

struct leftover_counts {
  uint64_t hidden, whole, mixed; /* triangles, as it turned out */
  uint64_t uncrossed;            /* of the first two, those told by contours */
};

struct leftover {
  const struct sheet *sheet;
  const struct tilelist *lists; /* lent */
  uint8_t *state;               /* lent: one a triangle, enum map_state */
  uint32_t *start, *contour; /* of tile i: contour[start[i] .. start[i + 1]) */
  struct pagegrid_query query;
  struct rivals rivals;
  struct leftover_counts counts;
};

/* wanted  the tiles that have lists
 * state   one a triangle: MAP_HIDDEN where it is known to be hidden; what is
 *         found to be so is noted there */
USE_RESULT bool leftover_init(struct leftover *leftover,
                              const struct sheet *sheet,
                              const struct tilelist *lists,
                              const uint8_t *wanted, uint8_t *state);
void leftover_fini(struct leftover *leftover);

/* Puts triangles into the order in which they are best solved. */
USE_RESULT bool leftover_sort(const struct leftover *leftover,
                              uint32_t *triangle, size_t count);

/* Finds what is visible of a triangle, not flat, all of whose tiles have
 * lists, and hands it in. */
USE_RESULT bool leftover_solve(struct leftover *leftover, uint32_t triangle,
                               struct fragments *fragments);

void leftover_report(const struct leftover *leftover, struct report *report);

#endif
