/* shared_sides.h - finds the stretches that sides of different fragments have
 * in common.
 *
 * Two kinds of sides are matched, as their ends may differ from one fragment to
 * its neighbour: horizontal sides where a scan-line method has split a face,
 * and pieces of mesh edges. */
#ifndef INK_HATCH_SHARED_SIDES_H
#define INK_HATCH_SHARED_SIDES_H

#include "base/memory.h"
#include "visibility/map.h"

struct shared_side_point {
  double x, y; /* grid units */
};

struct shared_side {
  /* The line that it lies on: the y of a horizontal split, the index of a mesh
   * edge. */
  double line;
  double low, high; /* its ends: x on a horizontal split, y on a mesh edge */
  bool reversed;    /* the side leads from high to low */
  struct shared_side_point from, to; /* the points at low and at high */
  uint32_t item;                     /* for the caller */
};

typedef ARRAY(struct shared_side) shared_sides;

/* Adds the side from a corner to the next if it is a horizontal split
 * (MAP_SIDE_CLIP); does nothing otherwise.  False when memory ran out. */
USE_RESULT bool shared_sides_add_split(shared_sides *list,
                                       const struct map_corner *corner,
                                       const struct map_corner *next,
                                       uint32_t item);

/* Adds the side from a corner to the next if it is a piece of a mesh edge and
 * not horizontal; does nothing otherwise.  False when memory ran out. */
USE_RESULT bool shared_sides_add_edge(shared_sides *list,
                                      const struct map_corner *corner,
                                      const struct map_corner *next,
                                      uint32_t item);

/* Calls visit(user, forward, reversed) for every pair of a forward and a
 * reversed side on the same line that have a stretch in common; the pairs of
 * one side come in order from its low end.  The callback may raise the low
 * ends.  Sides of the same direction must be disjoint.  Sorts the list.
 * Cost  n log n for n sides
 * Returns false when memory ran out. */
USE_RESULT bool shared_sides_match(shared_sides *list,
                                   void (*visit)(void *user,
                                                 struct shared_side *forward,
                                                 struct shared_side *reversed),
                                   void *user);

#endif
