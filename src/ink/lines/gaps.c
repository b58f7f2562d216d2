/* gaps.c - closes the gaps in lines that the pen's width would close.
 *
 * Phases
 *   1 collect  the loose ends: the only ones at their nodes
 *   2 find     of those with equal pen keys and classes, the pairs of which
 *              each is the other's nearest, at most half a pen away, and which
 *              do not turn back
 *   3 close    with a segment between the two nodes
 * Nothing that is drawn moves.  Ink is added at most half a pen from ink, and
 * half a pen long. */
#include "base/parallel.h"
#include "base/sort.h"
#include "ink/lines/nearest.h"
#include "ink/lines/segment_graph.h"
#include "ink/pens.h"

enum { ENDS_IN_RANGE = PARALLEL_RANGE(1 << 10) };

struct gaps {
  struct segment_graph *graph;
  const struct pens *pens;
  ARRAY(struct sort_key) loose;   /* pen key and class, end */
  ARRAY(struct drawing_point) at; /* of a group of equal keys, grid units */
  struct graph_segments added;    /* those that close gaps */
};

static const struct graph_segment *segment_of(const struct gaps *g,
                                              uint32_t end) {
  return &g->graph->segment.item[end >> 1];
}

static struct ink_point end_point(const struct gaps *g, uint32_t end) {
  return g->graph->node.item[segment_of(g, end)->node[end & 1]];
}

/* Whether one segment ends at a node. */
static bool has_one_end(const struct segment_graph *graph, uint32_t node) {
  return graph->ends.start[node + 1] - graph->ends.start[node] == 1;
}

static bool collect_loose_ends(struct gaps *g) {
  const struct segment_graph *graph = g->graph;
  for (size_t n = 0; n < graph->node.count; n++) {
    uint32_t first = graph->ends.start[n];
    if (!poll_at(n))
      return false;
    if (!has_one_end(graph, (uint32_t)n))
      continue;
    uint32_t end = graph->ends.item[first];
    const struct graph_segment *s = segment_of(g, end);
    unsigned edge_class = s->style_key & RECTO_EDGES_ALL;
    struct sort_key loose = {(uint64_t)s->pen_key << 8 | edge_class, end};
    if (!graph_segment_is_hidden(s) && (edge_class & SEGMENT_GRAPH_FEATURES) &&
        !ARRAY_PUSH(&g->loose, loose))
      return false;
  }
  struct sort_key *scratch = mem_alloc(g->loose.count, sizeof *scratch);
  if (scratch != NULL)
    sort_keys(g->loose.item, scratch, g->loose.count);
  mem_free(scratch);
  return scratch != NULL;
}

/* The direction of the segment from its other end to this one. */
static struct drawing_point direction_to(const struct gaps *g, uint32_t end) {
  struct ink_point p = end_point(g, end), q = end_point(g, end ^ 1);
  return (struct drawing_point){(double)p.x - q.x, (double)p.y - q.y};
}

/* Whether the two lines end within `near` of each other, and one goes on in
 * about the direction of the other. */
static bool is_gap(const struct gaps *g, uint32_t a, uint32_t b, double near) {
  struct ink_point p = end_point(g, a), q = end_point(g, b);
  struct drawing_point u = direction_to(g, a), v = direction_to(g, b);
  double dx = (double)p.x - q.x, dy = (double)p.y - q.y;
  return a >> 1 != b >> 1 && dx * dx + dy * dy <= near * near &&
         u.x * v.x + u.y * v.y < 0;
}

/* Adds a segment from one end to the other, which is merged in later. */
static bool close_gap(struct gaps *g, uint32_t a, uint32_t b) {
  struct segment_graph *graph = g->graph;
  struct graph_segment s = *segment_of(g, a);
  uint32_t from = s.node[a & 1], to = segment_of(g, b)->node[b & 1];
  s.node[0] = from < to ? from : to;
  s.node[1] = from < to ? to : from;
  return ARRAY_PUSH(&graph->gap_end, graph->node.item[from]) &&
         ARRAY_PUSH(&graph->gap_end, graph->node.item[to]) &&
         ARRAY_PUSH(&g->added, s);
}

/* The search for the other end of a gap, for each of a group. */
struct gap_search {
  const struct nearest *tree;
  const struct drawing_point *at;
  uint32_t *next; /* of each: the nearest other one; NEAREST_NONE: none */
  double most;    /* what is as far away is the end of no gap */
};

static bool find_next_of_range(void *user, struct parallel_range range) {
  const struct gap_search *search = user;
  for (uint32_t i = (uint32_t)range.begin; i < range.end; i++) {
    uint32_t found[2] = {NEAREST_NONE, NEAREST_NONE};
    (void)nearest_list(search->tree, search->at[i], NEAREST_NONE, search->most,
                       found, 2);
    search->next[i] = found[0] == i ? found[1] : found[0];
  }
  return true;
}

/* Closes the gaps between the ends of a group.
 * loose  `count` of them, with equal keys */
static bool close_group(struct gaps *g, const struct sort_key *loose,
                        uint32_t count) {
  uint32_t pen = (uint32_t)(loose->key >> 9) / RECTO_EDGE_CLASS_COUNT;
  double near = pens_width_mm(g->pens, pen) / 2 * SHEET_UNITS_PER_MM;
  struct nearest tree;
  g->at.count = 0;
  for (uint32_t i = 0; i < count; i++) {
    struct ink_point p = end_point(g, loose[i].value);
    if (!ARRAY_PUSH(&g->at, ((struct drawing_point){p.x, p.y})))
      return false;
  }
  uint32_t *next = mem_alloc(count, sizeof *next);
  bool ok = next != NULL && nearest_init(&tree, g->at.item, count);
  struct gap_search search = {&tree, g->at.item, next, near + 1};
  ok = ok && parallel_ranges(parallel_workers(count, ENDS_IN_RANGE), count,
                             ENDS_IN_RANGE, find_next_of_range, &search);
  for (uint32_t i = 0; ok && i < count; i++)
    if (next[i] != NEAREST_NONE && next[i] > i && next[next[i]] == i &&
        is_gap(g, loose[i].value, loose[next[i]].value, near))
      ok = close_gap(g, loose[i].value, loose[next[i]].value);
  if (next != NULL)
    nearest_fini(&tree);
  mem_free(next);
  return ok;
}

static bool close_all(struct gaps *g) {
  const struct sort_key *loose = g->loose.item;
  for (size_t i = 0, end; i < g->loose.count; i = end) {
    for (end = i + 1; end < g->loose.count && loose[end].key == loose[i].key;
         end++)
      continue;
    if (end > i + 1 && !close_group(g, loose + i, (uint32_t)(end - i)))
      return false;
  }
  return true;
}

static int compare_nodes(const void *first, const void *second, void *user) {
  const struct graph_segment *a = first, *b = second;
  (void)user;
  return a->node[0] != b->node[0] ? compare_numbers(a->node[0], b->node[0])
                                  : compare_numbers(a->node[1], b->node[1]);
}

static bool merge_added(struct gaps *g) {
  return sort_stable(g->added.item, g->added.count, sizeof *g->added.item,
                     compare_nodes, NULL) &&
         graph_segments_merge(&g->graph->segment, &g->added);
}

recto_status segment_graph_close_gaps(struct segment_graph *graph,
                                      const struct pens *pens,
                                      recto_error *error) {
  struct gaps g = {.graph = graph, .pens = pens};
  bool ok = collect_loose_ends(&g) && close_all(&g) && merge_added(&g);
  bool changed = g.added.count > 0;
  ARRAY_FREE(&g.loose);
  ARRAY_FREE(&g.at);
  graph->gap = g.added;
  if (!ok)
    return error_memory(error);
  return changed ? segment_graph_index_ends(graph, error) : RECTO_OK;
}

/* ---- While overlaps are dropped ------------------------------------------ */

/* At both of its nodes a gap had one end: nothing else joins them. */
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

recto_status segment_graph_merge_gaps(struct segment_graph *graph,
                                      recto_error *error) {
  struct graph_segments *gap = &graph->gap;
  size_t kept = 0;
  for (size_t i = 0; i < gap->count; i++)
    if (has_one_end(graph, gap->item[i].node[0]) &&
        has_one_end(graph, gap->item[i].node[1]))
      gap->item[kept++] = gap->item[i];
  gap->count = kept;
  if (!sort_stable(gap->item, gap->count, sizeof *gap->item, compare_nodes,
                   NULL) ||
      !graph_segments_merge(&graph->segment, gap))
    return error_memory(error);
  return segment_graph_index_ends(graph, error);
}
