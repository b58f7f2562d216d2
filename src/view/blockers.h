/* blockers.h - the corners of a polygon that may block an ear: those that are
 * not convex, found by where they are. */
#ifndef VIEW_BLOCKERS_H
#define VIEW_BLOCKERS_H

#include "base/memory.h"
#include "base/sort.h"

/* A run of corners that are near each other, or two such nodes. */
struct blockers_node {
  double low[2], high[2]; /* the box of its corners */
  uint32_t bent;          /* how many of them may block */
};

struct blockers {
  ARRAY(struct sort_key) place; /* corners, near ones together, and scratch */
  ARRAY(struct blockers_node) node; /* node k is over 2k and 2k + 1, from 1 */
  ARRAY(uint32_t) leaf;             /* of each corner, its node */
  uint32_t count, leaves;           /* corners; nodes of the lowest row */
};

/* Zero-initialised is empty; one object serves any number of polygons. */
void blockers_fini(struct blockers *blockers);

/* Sets the corners; none blocks at first.
 * at      `count` points, `stride` bytes from one to the next
 * Returns false when memory ran out. */
USE_RESULT bool blockers_init(struct blockers *blockers, const void *at,
                              size_t stride, uint32_t count);

/* A corner becomes one that may block, or ceases to be. */
void blockers_change(struct blockers *blockers, uint32_t corner, bool bent);

/* Calls `blocks(user, corner)` for corners that may block and may lie in the
 * closed counter-clockwise triangle, each once, till it says yes.
 * Returns whether it did.  Cost: of the nodes whose boxes meet the triangle. */
USE_RESULT bool blockers_ask(const struct blockers *blockers,
                             const double *triangle[3],
                             bool (*blocks)(const void *user, uint32_t corner),
                             const void *user);

#endif
