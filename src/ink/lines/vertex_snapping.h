/* vertex_snapping.h - nodes that the output cannot tell apart, and making one of them.
 *
 * A unit here is the output's, in grid units.  Rounding moves a point by half
 * a unit at most in x and in y, so two points can become one only where they
 * are within a unit in both: they are near. */
#ifndef INK_LINES_VERTEX_SNAPPING_H
#define INK_LINES_VERTEX_SNAPPING_H

#include "ink/lines/segment_graph.h"

struct vertex_snapping {
  struct segment_graph *graph;
  int32_t unit;
  uint32_t *root;  /* of each node: the one it has become */
  uint8_t *anchor; /* of each node: another one has become it */
  uint8_t *gone;   /* of each segment */
  size_t gone_count;
};

USE_RESULT bool vertex_snapping_init(struct vertex_snapping *snapping,
                                     struct segment_graph *graph, int32_t unit);
void vertex_snapping_fini(struct vertex_snapping *snapping);

/* Whether two nodes are near, as they stand now. */
bool vertex_snapping_is_near(const struct vertex_snapping *snapping, uint32_t a,
                             uint32_t b);

/* Makes `from` become `to`, or, where others have become `from` already, `to`
 * become it.  Returns false where that would move a node by more than a
 * unit. */
bool vertex_snapping_unite(struct vertex_snapping *snapping, uint32_t from,
                           uint32_t to);

/* Shrinks the segments whose ends are near many others, and keeps of those
 * whose ends are near each other's the best one. Cost  near linear */
USE_RESULT bool vertex_snapping_drop_twins(struct vertex_snapping *snapping,
                                           const struct node_rows *rows);

static inline struct ink_point
vertex_snapping_at(const struct vertex_snapping *snapping, uint32_t node) {
  return snapping->graph->node.item[snapping->root[node]];
}

#endif
