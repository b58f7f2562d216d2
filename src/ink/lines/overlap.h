/* overlap.h - splits collinear segments into pieces that do not overlap. */
#ifndef INK_LINES_OVERLAP_H
#define INK_LINES_OVERLAP_H

#include "base/sort.h"
#include "ink/lines/segment_graph.h"

/* Whether two segments are collinear and overlap by more than the tolerance. */
bool overlap_is_along(const struct segment_graph *graph, uint32_t a,
                      uint32_t b);

/* The priority of a segment: where two overlap, the one with the smaller number
 * is drawn. */
static inline uint64_t overlap_priority(const struct segment_graph *graph,
                                        uint32_t segment) {
  const struct graph_segment *s = &graph->segment.item[segment];
  uint64_t edge_class = s->style_key & RECTO_EDGES_ALL;
  if (edge_class == RECTO_EDGE_SECTION)
    edge_class = 0; /* the widest */
  return (uint64_t)graph_segment_is_hidden(s) << 40 | edge_class << 32 |
         s->edge;
}

/* Work space for clusters of a given number of segments, and the resulting
 * pieces. */
struct overlap {
  struct sort_key *key, *scratch; /* two a segment */
  uint32_t *slot;                 /* two a segment */
  uint32_t *node, *owner, *next;  /* two a segment, and one */
  uint32_t *near, *rest;          /* one a segment */
  ARRAY(struct graph_segment) piece;
};

USE_RESULT bool overlap_init(struct overlap *overlap, size_t segments);
void overlap_fini(struct overlap *overlap);

/* Replaces `count` collinear segments by pieces that do not overlap.
 * member  their numbers; the caller removes them from the graph
 * Cost    count log count */
USE_RESULT bool overlap_resolve(struct overlap *overlap,
                                const struct segment_graph *graph,
                                const uint32_t *member, size_t count);

#endif
