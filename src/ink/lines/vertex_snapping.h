/* vertex_snapping.h - merges nodes that the output cannot distinguish.
 *
 * The output step is the finest step of the output, in grid units.  Rounding
 * moves a point by at most half a step in x and in y, so two points can become
 * one only if they are within a step in both: such points are called near. */
#ifndef INK_LINES_VERTEX_SNAPPING_H
#define INK_LINES_VERTEX_SNAPPING_H

#include "ink/lines/segment_graph.h"

/* Clusters of near nodes.  They follow from the nodes' positions, which stay
 * from round to round. */
struct node_clusters {
  const struct segment_graph *graph;
  const struct node_rows *rows;
  int32_t step;      /* see above */
  uint32_t *of_node; /* the node whose cluster each is in, which is itself for
                        the first node of a cluster and one with none near */
  uint8_t *others;   /* of each node that begins a cluster: how many further
                        nodes the cluster has, up to a limit */
  size_t moved;      /* nodes that are in the cluster of another */
};

/* False when memory ran out or the caller cancelled; node_clusters_fini is
 * called in any case.
 * Cost  near linear; in parallel, but for what is near */
USE_RESULT bool node_clusters_init(struct node_clusters *clusters,
                                   const struct segment_graph *graph,
                                   const struct node_rows *rows, int32_t step);
void node_clusters_fini(struct node_clusters *clusters);

struct vertex_snapping {
  struct segment_graph *graph;
  int32_t output_step;
  uint32_t *root;  /* of each node: the node that it was merged into, or
                      itself */
  uint8_t *anchor; /* of each node: another one was merged into it */
  uint8_t *gone;   /* of each segment: removed */
  size_t gone_count;
};

USE_RESULT bool vertex_snapping_init(struct vertex_snapping *snapping,
                                     struct segment_graph *graph,
                                     int32_t output_step);
void vertex_snapping_fini(struct vertex_snapping *snapping);

/* Whether two nodes are near at their current positions. */
bool vertex_snapping_is_near(const struct vertex_snapping *snapping, uint32_t a,
                             uint32_t b);

/* Merges `from` into `to` or, if others were merged into `from` already, `to`
 * into `from`.  Returns false, and does nothing, if that would move a node by
 * more than a step. */
bool vertex_snapping_unite(struct vertex_snapping *snapping, uint32_t from,
                           uint32_t to);

/* Contracts the segments inside a large cluster of near nodes, and of segments
 * whose ends are pairwise near keeps the best.
 * Cost  near linear. */
USE_RESULT bool
vertex_snapping_drop_duplicates(struct vertex_snapping *snapping,
                                const struct node_clusters *clusters);

static inline struct ink_point
vertex_snapping_at(const struct vertex_snapping *snapping, uint32_t node) {
  return snapping->graph->node.item[snapping->root[node]];
}

#endif
