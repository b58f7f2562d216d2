/* nodes_near_segment.h - looking along a segment for the nodes near it. */
#ifndef INK_LINES_NODES_NEAR_SEGMENT_H
#define INK_LINES_NODES_NEAR_SEGMENT_H

#include "ink/lines/segment_graph.h"

/* What is done at a node near the segment; false ends the walk. */
typedef bool (*node_visit_fn)(void *user, uint32_t segment, uint32_t node);

struct node_search {
  const struct segment_graph *graph;
  const struct node_rows *rows;
  int32_t near; /* grid units in x and y */
  node_visit_fn look;
  void *user;
};

/* Calls look for every node within `near` of the segment's line, and not
 * beyond its ends by more, but for its own nodes.  Some a little farther off
 * may be among them.
 * Returns false where look did. */
USE_RESULT bool nodes_near_segment_visit(const struct node_search *search,
                                         uint32_t segment);

#endif
