/* nearest.h - the nearest of a set of points that shrinks. */
#ifndef INK_ORDER_NEAREST_H
#define INK_ORDER_NEAREST_H

#include "drawing/drawing.h"

/* A balanced tree of boxes over the points, halved along their longer side
 * down to a handful. */
struct nearest {
  uint32_t count;
  int levels;                /* of halving; 2^levels leaves */
  struct nearest_item *item; /* the points, leaf by leaf */
  uint32_t *place;           /* of each point among them */
  struct nearest_box *box;   /* heap: box 1 holds all, 2 i and 2 i + 1 its
                                halves */
};

#define NEAREST_NONE UINT32_MAX

/* Copies what it needs of the points. */
USE_RESULT bool nearest_init(struct nearest *nearest,
                             const struct drawing_point *point, uint32_t count);
void nearest_fini(struct nearest *nearest);

/* Takes a point out; it must be there. */
void nearest_remove(struct nearest *nearest, uint32_t point);

/* The point nearest to `from`; NEAREST_NONE where none is left. */
uint32_t nearest_find(const struct nearest *nearest, struct drawing_point from);

/* Up to `count` <= NEAREST_MOST points nearest to `from`, those with i / 2 ==
 * skip left out, nearest first.  Returns how many. */
#define NEAREST_MOST 16
uint32_t nearest_list(const struct nearest *nearest, struct drawing_point from,
                      uint32_t skip, uint32_t *found, uint32_t count);

#endif
