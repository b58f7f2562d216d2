/* partial_grid.h - a grid of triangles with lists of those cells alone in which
 * queries will be. */
#ifndef VISIBILITY_INDEX_PARTIAL_GRID_H
#define VISIBILITY_INDEX_PARTIAL_GRID_H

#include "visibility/index/triangle_grid.h"

struct partial_grid {
  struct triangle_grid grid; /* the lists of other cells are empty */
  uint8_t *wanted;           /* one a cell */
};

/* The three steps: chooses the cells, wants those that a box meets, and lists
 * the triangles of these.
 * partial  zero-initialised; the caller frees it
 * Cost     a few operations for each triangle elsewhere
 * The first and the last return false when memory ran out, or the caller
 * cancelled. */
USE_RESULT bool partial_grid_shape(struct partial_grid *partial,
                                   const struct sheet *sheet);
void partial_grid_want(struct partial_grid *partial, struct box2 box);
USE_RESULT bool partial_grid_fill(struct partial_grid *partial,
                                  const struct sheet *sheet);
void partial_grid_fini(struct partial_grid *partial);

#endif
