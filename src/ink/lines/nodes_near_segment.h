/* nodes_near_segment.h - enumerates the nodes near a segment. */
#ifndef INK_LINES_NODES_NEAR_SEGMENT_H
#define INK_LINES_NODES_NEAR_SEGMENT_H

#include "ink/lines/segment_graph.h"

/* Called for a node near the segment; false ends the enumeration. */
typedef bool (*node_visit_fn)(void *user, uint32_t segment, uint32_t node);

struct node_search {
  const struct segment_graph *graph;
  const struct node_rows *rows;
  int32_t near; /* grid units in x and y */
  node_visit_fn visit;
  void *user;
};

/* Calls visit for every node within `near` of the segment's line, and no
 * farther beyond its ends, except its own nodes.  A few nodes slightly farther
 * away may be included.
 * Returns false where visit did. */
USE_RESULT bool nodes_near_segment_visit(const struct node_search *search,
                                         uint32_t segment);

#endif
