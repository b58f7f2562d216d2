/* shared_sides.h - sides that fragments on both sides may have in common in
 * part: the level cuts that a method of lines leaves, pieces of mesh edges. */
#ifndef INK_HATCH_SHARED_SIDES_H
#define INK_HATCH_SHARED_SIDES_H

#include "base/memory.h"
#include "visibility/map.h"

struct shared_side_point {
  double x, y; /* grid units */
};

struct shared_side {
  double line;      /* what it lies on: the height of level cuts, an edge */
  double low, high; /* its ends along it */
  bool turned;      /* its side leads from high to low */
  struct shared_side_point from, to; /* low, high */
  uint32_t item;                     /* the caller's */
};

typedef ARRAY(struct shared_side) shared_sides;

/* Adds the side from a corner to the next, if it is a level cut of the method's
 * own.  False when memory ran out. */
USE_RESULT bool shared_sides_add_level(shared_sides *list,
                                       const struct map_corner *corner,
                                       const struct map_corner *next,
                                       uint32_t item);

/* Adds it if it is a piece of a mesh edge and not level. */
USE_RESULT bool shared_sides_add_edge(shared_sides *list,
                                      const struct map_corner *corner,
                                      const struct map_corner *next,
                                      uint32_t item);

/* Calls meet(user, ahead, turned) for all pairs of which one is turned and one
 * is not, and that have a stretch in common: along each of them from its low
 * end.  Those that are turned alike are disjoint.  Sorts the cuts.  False when
 * memory ran out. */
USE_RESULT bool shared_sides_match(shared_sides *list,
                                   void (*meet)(void *user,
                                                struct shared_side *ahead,
                                                struct shared_side *turned),
                                   void *user);

#endif
