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
#include <string.h>

#include "base/parallel.h"
#include "base/sort.h"
#include "ink/lines/nearest.h"
#include "ink/lines/segment_graph.h"
#include "ink/pens.h"

enum { ENDS_IN_RANGE = PARALLEL_RANGE(1 << 10) };
#define NO_END UINT32_MAX
#define SEVERAL_ENDS (UINT32_MAX - 1)

struct gaps {
  struct segment_graph *graph;
  const struct pens *pens;
  const struct node_rows *rows;
  ARRAY(struct sort_key) loose; /* pen key and class, end; then by node */
  struct graph_segments added;  /* those that close gaps */
};

static const struct graph_segment *segment_of(const struct gaps *g,
                                              uint32_t end) {
  return &g->graph->segment.item[end >> 1];
}

static uint32_t node_of_loose_end(const struct gaps *g, uint32_t end) {
  return segment_of(g, end)->node[end & 1];
}

static struct ink_point end_point(const struct gaps *g, uint32_t end) {
  return g->graph->node.item[node_of_loose_end(g, end)];
}

/* What ends must have in common for a gap: the pen key and the class. */
static uint64_t key_of_gap(const struct gaps *g, uint32_t end) {
  const struct graph_segment *s = segment_of(g, end);
  return (uint64_t)s->pen_key << 8 | (s->style_key & RECTO_EDGES_ALL);
}

/* Whether one segment ends at a node. */
static bool has_one_end(const struct segment_graph *graph, uint32_t node) {
  return graph->ends.start[node + 1] - graph->ends.start[node] == 1;
}

/* What a range of nodes has. */
struct loose_range {
  ARRAY(struct sort_key) loose; /* as of the gaps */
};

struct loose_collection {
  const struct gaps *gaps;
  struct loose_range *range;
};

static bool collect_of_range(void *user, struct parallel_range range) {
  const struct loose_collection *all = user;
  const struct segment_graph *graph = all->gaps->graph;
  struct loose_range *own = &all->range[range.begin / PARALLEL_ITEMS];
  for (size_t n = range.begin; n < range.end; n++) {
    if (!has_one_end(graph, (uint32_t)n))
      continue;
    uint32_t end = graph->ends.item[graph->ends.start[n]];
    const struct graph_segment *s = segment_of(all->gaps, end);
    struct sort_key loose = {key_of_gap(all->gaps, end), end};
    if (!graph_segment_is_hidden(s) &&
        (s->style_key & SEGMENT_GRAPH_FEATURES) != 0 &&
        !ARRAY_PUSH(&own->loose, loose))
      return false;
  }
  return true;
}

/* Joins what the ranges have, in order. */
static bool join_loose_ends(struct gaps *g, struct loose_range *range,
                            size_t ranges) {
  size_t sum = 0;
  for (size_t r = 0; r < ranges; r++)
    sum += range[r].loose.count;
  if (!ARRAY_RESERVE(&g->loose, sum))
    return false;
  for (size_t r = 0; r < ranges; r++) {
    size_t count = range[r].loose.count;
    if (count > 0)
      memcpy(g->loose.item + g->loose.count, range[r].loose.item,
             count * sizeof *g->loose.item);
    g->loose.count += count;
  }
  return true;
}

static bool collect_loose_ends(struct gaps *g) {
  size_t nodes = g->graph->node.count,
         ranges = parallel_range_count(nodes, PARALLEL_ITEMS);
  struct loose_collection all = {g, mem_calloc(ranges, sizeof *all.range)};
  bool ok = all.range != NULL &&
            parallel_ranges(parallel_workers(nodes, PARALLEL_ITEMS), nodes,
                            PARALLEL_ITEMS, collect_of_range, &all) &&
            join_loose_ends(g, all.range, ranges);
  for (size_t r = 0; all.range != NULL && r < ranges; r++)
    ARRAY_FREE(&all.range[r].loose);
  mem_free(all.range);
  struct sort_key *scratch =
      ok ? mem_alloc(g->loose.count, sizeof *scratch) : NULL;
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

/* A group of loose ends, which have equal keys, and the search in it for the
 * other end of each gap. */
struct gap_group {
  const struct gaps *g;
  const struct sort_key *loose;
  uint32_t count, *next; /* of each: the nearest other one; NO_END: none;
                            SEVERAL_ENDS: several are equally near */
  double near, most;     /* what is as far away as `most` ends no gap */
  uint8_t *ends_gap;     /* of each: it is the lower end of one */
};

/* The end for which another one is sought, and the nearest one so far. */
struct nearest_end {
  struct ink_point from;
  uint32_t found;   /* as of gap_group */
  double distance2; /* of a node that is to be nearer */
};

/* The loose end of the group at a node; NO_END: there is none. */
static uint32_t loose_end_at(const struct gap_group *group, uint32_t node) {
  const struct segment_graph *graph = group->g->graph;
  if (!has_one_end(graph, node))
    return NO_END;
  uint32_t end = graph->ends.item[graph->ends.start[node]];
  return key_of_gap(group->g, end) == group->loose->key ? end : NO_END;
}

/* Tests node k; returns whether its x is near enough, so that those beyond it
 * in its row may be. */
static bool test_node(const struct gap_group *group, struct nearest_end *best,
                      uint32_t k) {
  struct ink_point p = group->g->graph->node.item[k];
  double dx = (double)p.x - best->from.x, dy = (double)p.y - best->from.y;
  if (dx * dx > best->distance2)
    return false;
  double distance2 = dx * dx + dy * dy;
  if (distance2 > best->distance2)
    return true;
  uint32_t end = loose_end_at(group, k);
  if (end != NO_END && distance2 < best->distance2)
    best->found = end;
  else if (end != NO_END && best->found != NO_END)
    best->found = SEVERAL_ENDS;
  if (end != NO_END)
    best->distance2 = distance2;
  return true;
}

/* Tests the nodes of a row: those from `first` to the right, and those before
 * `past` to the left. */
static void test_row(const struct gap_group *group, struct nearest_end *best,
                     uint32_t r, size_t first, size_t past) {
  const struct node_rows *rows = group->g->rows;
  for (size_t k = first; k < rows->start[r + 1]; k++)
    if (!test_node(group, best, (uint32_t)k))
      break;
  for (size_t k = past; k > rows->start[r]; k--)
    if (!test_node(group, best, (uint32_t)(k - 1)))
      break;
}

/* The same of a row without the end itself. */
static void test_other_row(const struct gap_group *group,
                           struct nearest_end *best, uint32_t r) {
  const struct node_rows *rows = group->g->rows;
  const struct ink_point *at = group->g->graph->node.item;
  size_t k;
  LOWER_BOUND(k, rows->start[r], rows->start[r + 1], at[k].x < best->from.x);
  test_row(group, best, r, k, k);
}

/* The nearest other end of the group, as of gap_group. */
static uint32_t find_next(const struct gap_group *group, uint32_t node) {
  const struct node_rows *rows = group->g->rows;
  struct nearest_end best = {group->g->graph->node.item[node], NO_END,
                             group->most * group->most};
  uint32_t own = rows->row[node];
  double y = best.from.y, away;
  test_row(group, &best, own, (size_t)node + 1, node);
  for (uint32_t r = own; r > 0; r--) {
    away = y - (double)rows->low[r];
    if (away * away > best.distance2)
      break;
    test_other_row(group, &best, r - 1);
  }
  for (uint32_t r = own + 1; r < rows->count; r++) {
    away = (double)rows->low[r] - y;
    if (away * away > best.distance2)
      break;
    test_other_row(group, &best, r);
  }
  return best.found;
}

static bool find_next_of_range(void *user, struct parallel_range range) {
  const struct gap_group *group = user;
  for (size_t i = range.begin; i < range.end; i++)
    group->next[i] =
        find_next(group, node_of_loose_end(group->g, group->loose[i].value));
  return true;
}

/* The search for the others where several are equally near: as a search of a
 * k-d tree finds the first of them. */
struct several_search {
  const struct gap_group *group;
  struct nearest tree;
  struct drawing_point *at;            /* one an end of the group */
  ARRAY(struct drawing_point) several; /* the places of those sought for */
};

static bool place_several(struct several_search *search) {
  const struct gap_group *group = search->group;
  search->at = mem_alloc(group->count, sizeof *search->at);
  for (uint32_t i = 0; search->at != NULL && i < group->count; i++) {
    struct ink_point p = end_point(group->g, group->loose[i].value);
    search->at[i] = (struct drawing_point){p.x, p.y};
    if (group->next[i] == SEVERAL_ENDS &&
        !ARRAY_PUSH(&search->several, search->at[i]))
      return false;
  }
  return search->at != NULL;
}

static bool find_several_of_range(void *user, struct parallel_range range) {
  const struct several_search *search = user;
  const struct gap_group *group = search->group;
  for (uint32_t i = (uint32_t)range.begin; i < range.end; i++) {
    uint32_t found[2] = {i, i};
    if (group->next[i] != SEVERAL_ENDS)
      continue;
    (void)nearest_list(&search->tree, search->at[i], NEAREST_NONE, group->most,
                       found, 2);
    group->next[i] = group->loose[found[found[0] == i]].value;
  }
  return true;
}

/* Returns false when memory ran out or the caller cancelled. */
static bool find_among_several(const struct gap_group *group) {
  struct several_search search = {.group = group};
  size_t count = group->count;
  bool ok = place_several(&search) &&
            nearest_init_unsplit(&search.tree, search.at, group->count) &&
            nearest_split(&search.tree, search.several.item,
                          search.several.count, group->most) &&
            parallel_ranges(parallel_workers(count, ENDS_IN_RANGE), count,
                            ENDS_IN_RANGE, find_several_of_range, &search);
  nearest_fini(&search.tree);
  mem_free(search.at);
  ARRAY_FREE(&search.several);
  return ok;
}

/* Finds the nearest other end of each of the group.  Returns false when memory
 * ran out or the caller cancelled. */
static bool find_nearest_ends(struct gap_group *group) {
  if (!parallel_ranges(parallel_workers(group->count, ENDS_IN_RANGE),
                       group->count, ENDS_IN_RANGE, find_next_of_range, group))
    return false;
  for (uint32_t i = 0; i < group->count; i++)
    if (group->next[i] == SEVERAL_ENDS)
      return find_among_several(group);
  return true;
}

/* The place of an end in the group, which is sorted by node. */
static size_t place_in_group(const struct gap_group *group, uint32_t end) {
  uint32_t node = node_of_loose_end(group->g, end);
  size_t i;
  LOWER_BOUND(i, 0, group->count,
              node_of_loose_end(group->g, group->loose[i].value) < node);
  return i;
}

/* Finds the ends of a range that end a gap to a later node. */
static bool find_gaps_of_range(void *user, struct parallel_range range) {
  const struct gap_group *group = user;
  const struct gaps *g = group->g;
  for (size_t i = range.begin; i < range.end; i++) {
    uint32_t end = group->loose[i].value, next = group->next[i];
    group->ends_gap[i] =
        next != NO_END &&
        node_of_loose_end(g, next) > node_of_loose_end(g, end) &&
        is_gap(g, end, next, group->near) &&
        group->next[place_in_group(group, next)] == end;
  }
  return true;
}

/* Closes the gaps between the ends of a group.
 * loose  `count` of them, with equal keys */
static bool close_group(struct gaps *g, const struct sort_key *loose,
                        uint32_t count) {
  uint32_t pen = (uint32_t)(loose->key >> 9) / RECTO_EDGE_CLASS_COUNT;
  double near = pens_width_mm(g->pens, pen) / 2 * SHEET_UNITS_PER_MM;
  struct gap_group group = {.g = g,
                            .loose = loose,
                            .count = count,
                            .next = mem_alloc(count, sizeof *group.next),
                            .near = near,
                            .most = near + 1,
                            .ends_gap = mem_alloc(count, 1)};
  bool ok = group.next != NULL && group.ends_gap != NULL &&
            find_nearest_ends(&group) &&
            parallel_ranges(parallel_workers(count, ENDS_IN_RANGE), count,
                            ENDS_IN_RANGE, find_gaps_of_range, &group);
  for (uint32_t i = 0; ok && i < count; i++)
    if (group.ends_gap[i])
      ok = close_gap(g, loose[i].value, group.next[i]);
  mem_free(group.next);
  mem_free(group.ends_gap);
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
                                      const struct node_rows *rows,
                                      const struct pens *pens,
                                      recto_error *error) {
  struct gaps g = {.graph = graph, .pens = pens, .rows = rows};
  bool ok = collect_loose_ends(&g) && close_all(&g) && merge_added(&g);
  bool changed = g.added.count > 0;
  ARRAY_FREE(&g.loose);
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
