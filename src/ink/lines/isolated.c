/* isolated.c - sets apart the segments that certainly overlap no other one.
 *
 * Where two segments overlap, an end of one is near the other, or both have the
 * same ends.  So a segment is isolated that has no node near it but its own,
 * which no other segment has near it.  Most are.  The search that shows it
 * runs in parallel, and what looks for overlaps has the other segments alone.
 * Invariants  Nodes have their positions throughout.  Where a segment gets
 *   other ends, its new surroundings are searched
 *   (segment_graph_mark_near_nodes), and isolated segments that have an end
 *   there join the others again (segment_graph_restore_near_isolated). */
#include "ink/lines/segment_graph.h"

#include <math.h>

#include "base/parallel.h"
#include "base/poll.h"
#include "base/tolerance.h"
#include "ink/lines/nodes_near_segment.h"

/* More than the tolerance of collinear overlaps, and than their pieces are
 * beside the segments. */
enum { NEAR_MARGIN = 4 * TOLERANCE_COINCIDENT_UNITS };

/* What a search finds. */
struct node_marks {
  atomic_uchar *near_segment;
  bool found;
};

static bool mark_node(void *user, uint32_t segment, uint32_t node) {
  struct node_marks *marks = user;
  (void)segment;
  atomic_store_explicit(&marks->near_segment[node], 1, memory_order_relaxed);
  marks->found = true;
  return true;
}

bool segment_graph_mark_near_nodes(struct segment_graph *graph,
                                   const struct node_rows *rows, int32_t near,
                                   uint32_t segment) {
  struct node_marks marks = {graph->near_segment, false};
  const struct node_search search = {graph, rows, near, mark_node, &marks};
  return nodes_near_segment_visit(&search, segment) && marks.found;
}

/* ---- All segments -------------------------------------------------------- */

struct isolation {
  struct segment_graph *graph;
  const struct node_rows *rows;
  int32_t near;
  uint8_t *found; /* one a segment: it has a node near it */
};

static bool search_range(void *user, struct parallel_range range) {
  const struct isolation *work = user;
  for (size_t i = range.begin; i < range.end; i++)
    work->found[i] = segment_graph_mark_near_nodes(work->graph, work->rows,
                                                   work->near, (uint32_t)i);
  return true;
}

static bool has_end_near_segment(const struct segment_graph *graph,
                                 const struct graph_segment *s) {
  return graph->near_segment[s->node[0]] || graph->near_segment[s->node[1]];
}

static bool have_same_ends(const struct graph_segment *a,
                           const struct graph_segment *b) {
  return a->node[0] == b->node[0] && a->node[1] == b->node[1];
}

/* Leaves those in `segment` that are not isolated, and in `found` what it says
 * of these. */
static bool set_apart(struct segment_graph *graph, uint8_t *found) {
  struct graph_segments all = graph->segment, others = {NULL, 0, 0};
  struct graph_segment *s = all.item;
  size_t kept = 0;
  bool same_before = false, ok = true;
  for (size_t i = 0; ok && i < all.count; i++) {
    bool same_after = i + 1 < all.count && have_same_ends(&s[i], &s[i + 1]);
    if (found[i] || same_before || same_after ||
        has_end_near_segment(graph, &s[i])) {
      found[others.count] = found[i];
      ok = ARRAY_PUSH(&others, s[i]);
    } else {
      s[kept++] = s[i];
    }
    same_before = same_after;
  }
  all.count = kept;
  graph->isolated = all;
  graph->segment = others;
  return ok;
}

recto_status segment_graph_separate_isolated(struct segment_graph *graph,
                                             const struct node_rows *rows,
                                             double output_step,
                                             recto_error *error) {
  size_t count = graph->segment.count;
  int32_t near = (int32_t)ceil(output_step) + NEAR_MARGIN;
  struct isolation work = {graph, rows, near, mem_alloc(count, 1)};
  mem_free(graph->near_segment);
  graph->near_segment =
      mem_calloc(graph->node.count, sizeof *graph->near_segment);
  bool ok = work.found != NULL && graph->near_segment != NULL &&
            parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                            PARALLEL_ITEMS, search_range, &work) &&
            set_apart(graph, work.found);
  mem_free(graph->has_near);
  graph->has_near = work.found;
  return ok ? RECTO_OK : error_memory(error);
}

/* ---- Those that are isolated no more ------------------------------------- */

bool segment_graph_restore_near_isolated(struct segment_graph *graph) {
  struct graph_segments *isolated = &graph->isolated;
  size_t kept = 0;
  bool ok = true;
  for (size_t i = 0; ok && i < isolated->count; i++)
    if (has_end_near_segment(graph, &isolated->item[i]))
      ok = ARRAY_PUSH(&graph->segment, isolated->item[i]);
    else
      isolated->item[kept++] = isolated->item[i];
  isolated->count = kept;
  return ok;
}

recto_status segment_graph_merge_isolated(struct segment_graph *graph,
                                          recto_error *error) {
  struct graph_segments all = graph->isolated;
  if (!graph_segments_merge(&all, &graph->segment))
    return error_memory(error);
  ARRAY_FREE(&graph->segment);
  graph->segment = all;
  graph->isolated = (struct graph_segments){NULL, 0, 0};
  return segment_graph_index_ends(graph, error);
}
