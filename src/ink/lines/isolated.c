/* isolated.c - sets apart the segments that certainly overlap no other one.
 *
 * Where two segments overlap, an end of one is near the other, or both have the
 * same ends.  So a segment is isolated that has no node near it but its own,
 * which no other segment has near it.  Most are.  The search that shows it
 * runs in parallel, and what looks for overlaps has the other segments alone.
 * Invariants  Nodes have their positions throughout, and none but those near
 *   each other are merged, so that ends of isolated segments are not.  Where
 *   another segment gets other ends, its new surroundings are searched
 *   (segment_graph_mark_near_nodes), and isolated segments that have an end
 *   there join the others again (segment_graph_take_isolated). */
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
  struct segment_graph *graph;
  bool found;
};

static bool mark_node(void *user, uint32_t segment, uint32_t node) {
  struct node_marks *marks = user;
  atomic_uchar *mark = &marks->graph->near_segment[node];
  (void)segment;
  marks->found = true;
  if (atomic_load_explicit(mark, memory_order_relaxed) != 0)
    return true;
  atomic_store_explicit(mark, 1, memory_order_relaxed);
  atomic_store_explicit(&marks->graph->near_is_new, true, memory_order_relaxed);
  return true;
}

bool segment_graph_mark_near_nodes(struct segment_graph *graph,
                                   const struct node_rows *rows, int32_t near,
                                   uint32_t segment) {
  struct node_marks marks = {graph, false};
  const struct node_search search = {graph, rows, near, mark_node, &marks};
  return nodes_near_segment_visit(&search, segment) && marks.found;
}

/* ---- All segments -------------------------------------------------------- */

struct isolation {
  struct segment_graph *graph;
  const struct node_rows *rows;
  int32_t near;
  uint8_t *found;    /* one a segment: it has a node near it */
  uint8_t *is_other; /* one a segment: it is not isolated */
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

/* Finds which segments of a range are not isolated, of the whole search. */
static bool find_others_of_range(void *user, struct parallel_range range) {
  const struct isolation *work = user;
  const struct graph_segments *all = &work->graph->segment;
  const struct graph_segment *s = all->item;
  for (size_t i = range.begin; i < range.end; i++)
    work->is_other[i] =
        work->found[i] || has_end_near_segment(work->graph, &s[i]) ||
        (i > 0 && have_same_ends(&s[i - 1], &s[i])) ||
        (i + 1 < all->count && have_same_ends(&s[i], &s[i + 1]));
  return true;
}

/* Leaves those in `segment` that are not isolated, and in has_near what was
 * found near these. */
static bool set_apart(const struct isolation *work) {
  struct segment_graph *graph = work->graph;
  struct graph_segments others = {NULL, 0, 0};
  size_t count = graph->segment.count, kept = 0;
  bool ok = graph_segments_take(&graph->segment, work->is_other, &others);
  for (size_t i = 0; i < count; i++)
    if (work->is_other[i])
      work->found[kept++] = work->found[i];
  graph->isolated = graph->segment;
  graph->segment = others;
  mem_free(graph->has_near);
  graph->has_near = work->found;
  return ok;
}

recto_status segment_graph_separate_isolated(struct segment_graph *graph,
                                             const struct node_rows *rows,
                                             double output_step,
                                             recto_error *error) {
  size_t count = graph->segment.count;
  int32_t near = (int32_t)ceil(output_step) + NEAR_MARGIN;
  int workers = parallel_workers(count, PARALLEL_ITEMS);
  struct isolation work = {graph, rows, near, mem_alloc(count, 1),
                           mem_alloc(count, 1)};
  mem_free(graph->near_segment);
  graph->near_segment =
      mem_calloc(graph->node.count, sizeof *graph->near_segment);
  bool ok =
      work.found != NULL && work.is_other != NULL &&
      graph->near_segment != NULL &&
      parallel_ranges(workers, count, PARALLEL_ITEMS, search_range, &work) &&
      parallel_ranges(workers, count, PARALLEL_ITEMS, find_others_of_range,
                      &work);
  if (ok)
    ok = set_apart(&work);
  else
    mem_free(work.found);
  graph->near_is_new = false;
  mem_free(work.is_other);
  return ok ? RECTO_OK : error_memory(error);
}

/* ---- Those that are isolated no more ------------------------------------- */

struct isolated_search {
  const struct segment_graph *graph;
  uint8_t *is_taken; /* one an isolated segment */
  atomic_bool any;
};

static bool find_taken_of_range(void *user, struct parallel_range range) {
  struct isolated_search *search = user;
  const struct graph_segment *s = search->graph->isolated.item;
  bool any = false;
  for (size_t i = range.begin; i < range.end; i++) {
    bool is_taken = has_end_near_segment(search->graph, &s[i]);
    search->is_taken[i] = is_taken;
    any = any || is_taken;
  }
  if (any)
    atomic_store_explicit(&search->any, true, memory_order_relaxed);
  return true;
}

bool segment_graph_take_isolated(struct segment_graph *graph,
                                 struct graph_segments *taken) {
  size_t count = graph->isolated.count;
  if (!graph->near_is_new)
    return true;
  graph->near_is_new = false;
  struct isolated_search search = {graph, mem_alloc(count, 1), false};
  bool ok = search.is_taken != NULL &&
            parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                            PARALLEL_ITEMS, find_taken_of_range, &search);
  if (ok && search.any)
    ok = graph_segments_take(&graph->isolated, search.is_taken, taken);
  mem_free(search.is_taken);
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
