/* blur.h - nodes that the output cannot tell apart, and making one of them.
 *
 * A unit here is the output's, in grid units.  Rounding moves a point by half
 * a unit at most in x and in y, so two points can become one only where they
 * are within a unit in both: they are near. */
#ifndef INK_BLUR_H
#define INK_BLUR_H

#include "ink/net.h"

struct blur {
  struct net *net;
  int32_t unit;
  uint32_t *root;  /* of each node: the one it has become */
  uint8_t *anchor; /* of each node: another one has become it */
  uint8_t *gone;   /* of each segment */
  size_t gone_count;
};

USE_RESULT bool blur_init(struct blur *blur, struct net *net, int32_t unit);
void blur_fini(struct blur *blur);

/* Whether two nodes are near, as they stand now. */
bool blur_is_near(const struct blur *blur, uint32_t a, uint32_t b);

/* Makes `from` become `to`, or, where others have become `from` already, `to`
 * become it.  Returns false where that would move a node by more than a
 * unit. */
bool blur_unite(struct blur *blur, uint32_t from, uint32_t to);

/* Shrinks the segments whose ends are near many others, and keeps of those
 * whose ends are near each other's the best one. Cost  near linear */
USE_RESULT bool blur_drop_twins(struct blur *blur, const struct net_rows *rows);

static inline struct ink_point blur_at(const struct blur *blur, uint32_t node) {
  return blur->net->node.item[blur->root[node]];
}

#endif
