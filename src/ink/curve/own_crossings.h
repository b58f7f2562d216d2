/* own_crossings.h - where a line crosses itself. */
#ifndef INK_CURVE_OWN_CROSSINGS_H
#define INK_CURVE_OWN_CROSSINGS_H

#include "base/memory.h"
#include "drawing/drawing.h"

/* A point of a line, and how far along its stroke that is, mm. */
struct own_point {
  struct drawing_point at;
  double along;
};

struct own_crossing {
  struct drawing_point at;
  double along[2]; /* the two places on the line, mm */
};

/* Extents in x, y, x + y and x - y, mm. */
enum { OWN_DIRECTIONS = 4 };
struct own_bounds {
  double least[OWN_DIRECTIONS], most[OWN_DIRECTIONS];
};

/* A line and its crossings. */
struct own_crossings {
  ARRAY(struct own_point) line; /* to be set */
  ARRAY(struct own_crossing) crossing;
  size_t compared; /* bounds of sides, of the last search */
  /* A complete binary tree: 1 is the root, 2 i and 2 i + 1 are the children of
   * i. */
  ARRAY(struct own_bounds) node;
};

/* Finds all crossings of sides of the line that do not follow each other, in
 * the order of the line.
 * Cost     n log n in the points, and linear in the pairs of a side and some
 *          neighbouring ones whose bounds overlap
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool own_crossings_find(struct own_crossings *own);

/* Removes from both those crossings that have a place in common, one for one,
 * within a distance, mm.
 * Cost     linear in the pairs of crossings of both
 * Returns false when the caller cancelled. */
USE_RESULT bool own_crossings_remove_common(struct own_crossings *a,
                                            struct own_crossings *b,
                                            double within);

void own_crossings_fini(struct own_crossings *own);

#endif
