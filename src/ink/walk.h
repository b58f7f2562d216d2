/* walk.h - looking along a segment for the nodes near it. */
#ifndef INK_WALK_H
#define INK_WALK_H

#include "ink/net.h"

/* What is done at a node near the segment; false ends the walk. */
typedef bool (*walk_fn)(void *user, uint32_t segment, uint32_t node);

struct walk {
  const struct net *net;
  const struct net_rows *rows;
  int32_t near; /* grid units in x and y */
  walk_fn look;
  void *user;
};

/* Calls look for every node within `near` of the segment's line, and not
 * beyond its ends by more, but for its own nodes.  Some a little farther off
 * may be among them.
 * Returns false where look did. */
USE_RESULT bool walk_along(const struct walk *walk, uint32_t segment);

#endif
