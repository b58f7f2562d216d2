/* gaps_apart.c - keeps the segments that close gaps apart from the others while
 * overlaps are dropped. */
#include "base/sort.h"
#include "ink/lines/gap_ends.h"

static int compare_nodes(const void *first, const void *second, void *user) {
  const struct graph_segment *a = first, *b = second;
  (void)user;
  return a->node[0] != b->node[0] ? compare_numbers(a->node[0], b->node[0])
                                  : compare_numbers(a->node[1], b->node[1]);
}

bool gap_segments_merge(struct segment_graph *graph,
                        struct graph_segments *gap) {
  return sort_stable(gap->item, gap->count, sizeof *gap->item, compare_nodes,
                     NULL) &&
         graph_segments_merge(&graph->segment, gap);
}

/* No other segment joins the nodes of one that closes a gap. */
void segment_graph_set_gaps_apart(struct segment_graph *graph) {
  struct graph_segment *s = graph->segment.item, *gap = graph->gap.item;
  size_t kept = 0, apart = 0, g = 0;
  for (size_t i = 0; i < graph->segment.count; i++) {
    int order = 1;
    while (g < graph->gap.count &&
           (order = compare_nodes(&gap[g], &s[i], NULL)) < 0)
      g++; /* left out since */
    if (g < graph->gap.count && order == 0)
      gap[apart++] = gap[g++];
    else
      s[kept++] = s[i];
  }
  graph->segment.count = kept;
  graph->gap.count = apart;
}

void segment_graph_move_gaps(struct segment_graph *graph,
                             const uint32_t *root) {
  size_t kept = 0;
  for (size_t i = 0; i < graph->gap.count; i++) {
    struct graph_segment s = graph->gap.item[i];
    for (int k = 0; k < 2; k++)
      s.node[k] = root[s.node[k]];
    if (s.node[0] != s.node[1])
      graph->gap.item[kept++] = graph_segment_sorted(s);
  }
  graph->gap.count = kept;
}

static bool is_gap_still(const struct segment_graph *graph,
                         const struct graph_segment *s) {
  uint64_t key = gap_key(s);
  return gap_loose_end(graph, s->node[0], key) != GAP_NO_END &&
         gap_loose_end(graph, s->node[1], key) != GAP_NO_END &&
         !gap_nodes_are_joined(graph, s->node[0], s->node[1]);
}

recto_status segment_graph_merge_gaps(struct segment_graph *graph,
                                      recto_error *error) {
  struct graph_segments *gap = &graph->gap;
  size_t kept = 0;
  for (size_t i = 0; i < gap->count; i++)
    if (is_gap_still(graph, &gap->item[i]))
      gap->item[kept++] = gap->item[i];
  gap->count = kept;
  if (!gap_segments_merge(graph, gap))
    return error_memory(error);
  return segment_graph_index_ends(graph, error);
}
