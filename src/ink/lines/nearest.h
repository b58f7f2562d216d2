/* nearest.h - nearest-neighbour search in a point set with deletion. */
#ifndef INK_LINES_NEAREST_H
#define INK_LINES_NEAREST_H

#include "drawing/drawing.h"

/* A k-d tree: a balanced binary tree of bounding boxes, each split at the
 * median along its longer side, down to leaves of at most eight points. */
struct nearest {
  uint32_t count;
  int levels;                /* below the root; 2^levels leaves */
  struct nearest_item *item; /* the points, grouped by leaf */
  uint32_t *position;        /* of each point: its index in `item` */
  struct nearest_box *box;   /* in heap order: 1 is the root, 2 i and
                                2 i + 1 are the children of i */
};

#define NEAREST_NONE UINT32_MAX

/* Builds the tree.  The points are copied.  Returns false when memory ran out.
 * Cost  n log n */
USE_RESULT bool nearest_init(struct nearest *nearest,
                             const struct drawing_point *point, uint32_t count);
/* The same of a tree that nearest_split builds.  Cost  linear */
USE_RESULT bool nearest_init_unsplit(struct nearest *nearest,
                                     const struct drawing_point *point,
                                     uint32_t count);

/* Builds as much of that tree as nearest_list with `most` visits from so many
 * places; that then finds the same points in the same order as in the whole
 * tree.  Returns false when the caller cancelled. */
USE_RESULT bool nearest_split(struct nearest *nearest,
                              const struct drawing_point *from, size_t count,
                              double most);

void nearest_fini(struct nearest *nearest);

/* Deletes a point, which must not have been deleted before.
 * Cost  log n */
void nearest_remove(struct nearest *nearest, uint32_t point);

/* The index of the point nearest to `from`; NEAREST_NONE if all are deleted.
 * Cost  expected log n */
uint32_t nearest_find(const struct nearest *nearest, struct drawing_point from);

/* Stores in `found` the indices of the `count` <= NEAREST_LIST_MAX points that
 * are nearest to `from`, nearest first, without those at a distance of `most`
 * or more and the points i with i / 2 == skip.  Returns how many there are. */
#define NEAREST_LIST_MAX 16
uint32_t nearest_list(const struct nearest *nearest, struct drawing_point from,
                      uint32_t skip, double most, uint32_t *found,
                      uint32_t count);

#endif
