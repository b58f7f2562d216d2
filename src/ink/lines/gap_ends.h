/* gap_ends.h - ends of lines that may end a gap. */
#ifndef INK_LINES_GAP_ENDS_H
#define INK_LINES_GAP_ENDS_H

#include "ink/lines/segment_graph.h"

#define GAP_NO_END UINT32_MAX

/* What ends must have in common for a gap: the pen key and the class. */
static inline uint64_t gap_key(const struct graph_segment *s) {
  return (uint64_t)s->pen_key << 8 | (s->style_key & RECTO_EDGES_ALL);
}

/* The ends at a node of which one may end a gap, at most. */
enum { GAP_ENDS_MAX = 16 };

/* The only end of a key at a node; GAP_NO_END: there is none, or there are
 * several, or too many of any keys. */
static inline uint32_t gap_loose_end(const struct segment_graph *graph,
                                     uint32_t node, uint64_t key) {
  const uint32_t *start = graph->ends.start;
  uint32_t found = GAP_NO_END;
  if (start[node + 1] - start[node] > GAP_ENDS_MAX)
    return GAP_NO_END;
  for (uint32_t i = start[node]; i < start[node + 1]; i++) {
    uint32_t end = graph->ends.item[i];
    if (gap_key(&graph->segment.item[end >> 1]) != key)
      continue;
    if (found != GAP_NO_END)
      return GAP_NO_END;
    found = end;
  }
  return found;
}

/* Whether a segment leads from one node to another. */
static inline bool gap_nodes_are_joined(const struct segment_graph *graph,
                                        uint32_t from, uint32_t to) {
  uint32_t last = graph->ends.start[from + 1];
  for (uint32_t i = graph->ends.start[from]; i < last; i++) {
    uint32_t end = graph->ends.item[i];
    if (graph->segment.item[end >> 1].node[~end & 1] == to)
      return true;
  }
  return false;
}

/* Sorts the segments that close gaps, and merges them into those of the graph.
 * Returns false when memory ran out. */
USE_RESULT bool gap_segments_merge(struct segment_graph *graph,
                                   struct graph_segments *gap);

#endif
