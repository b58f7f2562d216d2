/* segments.c - turns the visible and hidden intervals of the drawable edges
 * into segments of the page.
 *
 * Phases, by ranges of edges or of points
 *   1 count    the segments of each range and the ends of intervals that are no
 *              points of the sheet, and mark the points that are ends
 *   2 number   these points, which are the first nodes
 *   3 store    the segments, visible ones before hidden ones, in the order of
 *              the edges, and the other nodes in the order of the ranges */
#include "base/parallel.h"
#include "ink/lines/segment_graph.h"

#include <string.h>

#include "base/sort.h"
#include "ink/pens.h"

/* Segment s has ends 2 s and 2 s + 1, in 32 bits. */
#define SEGMENT_LIMIT (UINT32_MAX / 2)

/* What the edges of a range have or, of a range of points, how many are ends;
 * then where these begin among all. */
struct collected_range {
  size_t segments[2]; /* visible, hidden */
  size_t nodes, dots;
};

struct segment_collection {
  struct segment_graph *graph;
  const struct sheet *sheet;
  const struct map *map;
  const struct pens *pens;
  const recto_options *options;
  /* One a sheet point: whether it is an end; then its node. */
  atomic_uint *node_of_point;
  struct collected_range *edges, *points; /* one a range */
};

/* The walk over the edges of a range. */
struct collector {
  const struct segment_collection *of;
  bool hidden, counting;
  struct collected_range range; /* counted; or where to store the next one */
  uint32_t pen_key;             /* of edges of this class and group */
  uint32_t edge_class, group;
};

void segment_graph_init(struct segment_graph *graph) {
  *graph = (struct segment_graph){0};
}

void segment_graph_fini(struct segment_graph *graph) {
  ARRAY_FREE(&graph->node);
  ARRAY_FREE(&graph->segment);
  ARRAY_FREE(&graph->isolated);
  mem_free(graph->near_segment);
  mem_free(graph->has_near);
  number_lists_fini(&graph->ends);
  mem_free(graph->approximate);
  ARRAY_FREE(&graph->gap_end);
  ARRAY_FREE(&graph->gap);
  segment_graph_init(graph);
}

/* ---- Segments ------------------------------------------------------------ */

/* The node of a point of the sheet; while counting 0. */
static inline uint32_t node_of_point(const struct collector *c,
                                     uint32_t point) {
  atomic_uint *node = &c->of->node_of_point[point];
  if (c->counting)
    atomic_store_explicit(node, 1, memory_order_relaxed);
  return c->counting ? 0 : atomic_load_explicit(node, memory_order_relaxed);
}

/* The node of the point at t on the edge; while counting 0. */
static uint32_t node_at(struct collector *c, const struct sheet_edge *edge,
                        struct ratio t) {
  const struct segment_collection *of = c->of;
  if (t.num == 0 || t.num == t.den)
    return node_of_point(c, edge->point[t.num != 0]);
  size_t node = c->range.nodes++;
  if (c->counting)
    return 0;
  const struct geom_point *p = &of->sheet->point.item[edge->point[0]];
  const struct geom_point *q = &of->sheet->point.item[edge->point[1]];
  of->graph->node.item[node] = (struct ink_point){
      (int32_t)ratio_lerp(t, p->x, q->x), (int32_t)ratio_lerp(t, p->y, q->y)};
  return (uint32_t)node;
}

/* Sets the pen key for an edge: segments may be joined where one pen draws
 * them with one weight.  Mostly it is that of the edge before. */
static void set_pen_key(struct collector *c, const struct sheet_edge *e) {
  const struct segment_collection *of = c->of;
  uint32_t group = sheet_edge_group(of->sheet, e);
  if (e->edge_class == c->edge_class && group == c->group)
    return;
  c->edge_class = e->edge_class;
  c->group = group;
  c->pen_key =
      c->hidden
          ? 2 * pens_of_hidden(of->pens, of->options, e->edge_class, group) + 1
          : 2 * (pens_of_line(of->pens, e->edge_class, group) *
                     RECTO_EDGE_CLASS_COUNT +
                 pens_weight_id(of->pens, e->edge_class));
}

/* Adds a segment between two nodes, or counts it. */
static inline void store_or_count(struct collector *c, uint32_t edge,
                                  uint32_t from, uint32_t to) {
  const struct sheet_edge *e = &c->of->sheet->edge.item[edge];
  size_t segment = c->range.segments[c->hidden]++;
  if (c->counting)
    return;
  struct ink_point p = c->of->graph->node.item[from];
  struct ink_point q = c->of->graph->node.item[to];
  c->range.dots += p.x == q.x && p.y == q.y;
  c->of->graph->segment.item[segment] = (struct graph_segment){
      .node = {from, to},
      .edge = edge,
      .pen_key = c->pen_key,
      .style_key = sheet_edge_group(c->of->sheet, e) << RECTO_EDGE_CLASS_COUNT |
                   e->edge_class};
}

static void collect_segment(struct collector *c, uint32_t edge, struct ratio t0,
                            struct ratio t1) {
  const struct sheet_edge *e = &c->of->sheet->edge.item[edge];
  uint32_t from = node_at(c, e, t0), to = node_at(c, e, t1);
  store_or_count(c, edge, from, to);
}

/* The intervals of one edge, sorted and disjoint. */
struct intervals {
  const struct map_interval *item;
  uint32_t count;
};

static void add_visible_intervals(struct collector *c, uint32_t edge,
                                  struct intervals visible) {
  for (uint32_t i = 0; i < visible.count; i++)
    collect_segment(c, edge, visible.item[i].t0, visible.item[i].t1);
}

/* Adds the complement of the visible intervals and of those hidden by more
 * faces than requested. */
static void add_hidden_intervals(struct collector *c, uint32_t edge,
                                 struct intervals visible,
                                 struct intervals deep) {
  struct ratio from = ratio_of(0, 1), end = ratio_of(1, 1);
  while (visible.count + deep.count > 0) {
    bool take_deep =
        deep.count > 0 && (visible.count == 0 ||
                           ratio_compare(deep.item->t0, visible.item->t0) < 0);
    struct intervals *next = take_deep ? &deep : &visible;
    if (ratio_compare(from, next->item->t0) < 0)
      collect_segment(c, edge, from, next->item->t0);
    if (ratio_compare(from, next->item->t1) < 0)
      from = next->item->t1;
    next->item++;
    next->count--;
  }
  if (ratio_compare(from, end) < 0)
    collect_segment(c, edge, from, end);
}

/* Rows of a map, from that of an edge on. */
struct mixed_rows {
  const struct map_mixed *next, *end;
  const struct map_interval *interval;
};

/* The rows of the edges from `edge` on. */
static struct mixed_rows rows_from(const struct map_mixed *row, size_t count,
                                   const struct map_interval *interval,
                                   size_t edge) {
  size_t i;
  if (count == 0)
    return (struct mixed_rows){NULL, NULL, NULL};
  LOWER_BOUND(i, 0, count, row[i].edge < edge);
  return (struct mixed_rows){row + i, row + count, interval};
}

/* The intervals of an edge, if the next row is the edge's, past which it then
 * advances. */
static struct intervals next_intervals(struct mixed_rows *rows, uint32_t edge) {
  struct intervals taken = {NULL, 0};
  if (rows->next < rows->end && rows->next->edge == edge) {
    taken = (struct intervals){rows->interval + rows->next->interval,
                               rows->next->count};
    rows->next++;
  }
  return taken;
}

/* Adds the visible intervals of the drawable edges of a range, in order.
 * Memory  of hidden edges nothing but their states is read */
static void collect_visible(struct collector *c, struct parallel_range range) {
  const struct map *map = c->of->map;
  struct mixed_rows mixed = rows_from(map->mixed.item, map->mixed.count,
                                      map->interval.item, range.begin);
  c->edge_class = 0; /* no drawn edge's */
  for (uint32_t i = (uint32_t)range.begin; i < range.end; i++) {
    if (map->edge_state[i] == MAP_HIDDEN)
      continue;
    struct intervals visible = next_intervals(&mixed, i);
    const struct sheet_edge *edge = &c->of->sheet->edge.item[i];
    if (edge->edge_class == 0)
      continue;
    if (!c->counting)
      set_pen_key(c, edge);
    if (map->edge_state[i] != MAP_VISIBLE)
      add_visible_intervals(c, i, visible);
    else
      store_or_count(c, i, node_of_point(c, edge->point[0]),
                     node_of_point(c, edge->point[1]));
  }
}

/* Adds the hidden ones. */
static void collect_hidden(struct collector *c, struct parallel_range range) {
  const struct map *map = c->of->map;
  struct mixed_rows mixed = rows_from(map->mixed.item, map->mixed.count,
                                      map->interval.item, range.begin);
  struct mixed_rows deep =
      rows_from(map->over_limit.item, map->over_limit.count,
                map->over_limit_interval.item, range.begin);
  c->hidden = true;
  c->edge_class = 0; /* no drawn edge's */
  for (uint32_t i = (uint32_t)range.begin; i < range.end; i++) {
    struct intervals visible = next_intervals(&mixed, i);
    struct intervals too_deep = next_intervals(&deep, i);
    const struct sheet_edge *edge = &c->of->sheet->edge.item[i];
    if (edge->edge_class == 0 || map->edge_state[i] == MAP_VISIBLE)
      continue;
    if (!c->counting)
      set_pen_key(c, edge);
    add_hidden_intervals(c, i, visible, too_deep);
  }
}

static void collect_edges_of_range(const struct segment_collection *of,
                                   struct parallel_range range, bool counting) {
  struct collected_range *own = &of->edges[range.begin / PARALLEL_ITEMS];
  struct collector c = {.of = of, .counting = counting, .range = *own};
  collect_visible(&c, range);
  if (of->options->ink.hidden != RECTO_HIDDEN_NONE)
    collect_hidden(&c, range);
  *own = c.range;
}

/* ---- Ranges -------------------------------------------------------------- */

static bool count_range(void *user, struct parallel_range range) {
  collect_edges_of_range(user, range, true);
  return true;
}

static bool store_range(void *user, struct parallel_range range) {
  collect_edges_of_range(user, range, false);
  return true;
}

static bool count_points_of_range(void *user, struct parallel_range range) {
  const struct segment_collection *of = user;
  size_t *nodes = &of->points[range.begin / PARALLEL_ITEMS].nodes;
  for (size_t i = range.begin; i < range.end; i++)
    *nodes += atomic_load_explicit(&of->node_of_point[i], memory_order_relaxed);
  return true;
}

static bool number_points_of_range(void *user, struct parallel_range range) {
  const struct segment_collection *of = user;
  size_t node = of->points[range.begin / PARALLEL_ITEMS].nodes;
  for (size_t i = range.begin; i < range.end; i++) {
    const struct geom_point *p = &of->sheet->point.item[i];
    atomic_uint *at = &of->node_of_point[i];
    if (atomic_load_explicit(at, memory_order_relaxed) == 0)
      continue;
    of->graph->node.item[node] = (struct ink_point){p->x, p->y};
    atomic_store_explicit(at, (unsigned)node++, memory_order_relaxed);
  }
  return true;
}

/* Replaces counts by where each range begins, and returns the sum. */
static size_t add_up(size_t *count, size_t before) {
  size_t here = *count;
  *count = before;
  return before + here;
}

/* Makes room for what was counted.
 * ranges  of edges, points */
static recto_status place_ranges(struct segment_collection *of,
                                 const size_t ranges[2], recto_error *error) {
  size_t nodes = 0, segments = 0;
  for (size_t r = 0; r < ranges[1]; r++)
    nodes = add_up(&of->points[r].nodes, nodes);
  for (size_t r = 0; r < ranges[0]; r++)
    nodes = add_up(&of->edges[r].nodes, nodes);
  for (int hidden = 0; hidden < 2; hidden++)
    for (size_t r = 0; r < ranges[0]; r++)
      segments = add_up(&of->edges[r].segments[hidden], segments);
  if (segments >= SEGMENT_LIMIT || nodes >= SEGMENT_LIMIT)
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "more than 2^31 visible lines");
  if (!ARRAY_RESERVE(&of->graph->node, nodes) ||
      !ARRAY_RESERVE(&of->graph->segment, segments))
    return error_memory(error);
  of->graph->node.count = nodes;
  of->graph->segment.count = segments;
  return RECTO_OK;
}

static recto_status collect_in_ranges(struct segment_collection *of,
                                      recto_error *error) {
  const size_t count[2] = {of->map->edge_count, of->sheet->point.count};
  const size_t ranges[2] = {parallel_range_count(count[0], PARALLEL_ITEMS),
                            parallel_range_count(count[1], PARALLEL_ITEMS)};
  const int workers[2] = {parallel_workers(count[0], PARALLEL_ITEMS),
                          parallel_workers(count[1], PARALLEL_ITEMS)};
  of->edges = mem_calloc(ranges[0], sizeof *of->edges);
  of->points = mem_calloc(ranges[1], sizeof *of->points);
  if (of->edges == NULL || of->points == NULL ||
      !parallel_ranges(workers[0], count[0], PARALLEL_ITEMS, count_range, of) ||
      !parallel_ranges(workers[1], count[1], PARALLEL_ITEMS,
                       count_points_of_range, of))
    return error_memory(error);
  recto_status status = place_ranges(of, ranges, error);
  if (status != RECTO_OK)
    return status;
  if (!parallel_ranges(workers[1], count[1], PARALLEL_ITEMS,
                       number_points_of_range, of) ||
      !parallel_ranges(workers[0], count[0], PARALLEL_ITEMS, store_range, of))
    return error_memory(error);
  for (size_t r = 0; r < ranges[0]; r++)
    of->graph->dots += of->edges[r].dots;
  return RECTO_OK;
}

recto_status
segment_graph_collect(struct segment_graph *graph, const struct sheet *sheet,
                      const struct map *map, const struct pens *pens,
                      const recto_options *options, recto_error *error) {
  if (map->edge_state == NULL)
    return RECTO_OK;
  struct segment_collection all = {.graph = graph,
                                   .sheet = sheet,
                                   .map = map,
                                   .pens = pens,
                                   .options = options};
  all.node_of_point = mem_calloc(sheet->point.count, sizeof *all.node_of_point);
  recto_status status = all.node_of_point != NULL
                            ? collect_in_ranges(&all, error)
                            : error_memory(error);
  mem_free(all.node_of_point);
  mem_free(all.edges);
  mem_free(all.points);
  return status;
}

/* ---- Changes of a collected graph ---------------------------------------- */

recto_status segment_graph_drop_segments(struct segment_graph *graph,
                                         const uint8_t *drop,
                                         recto_error *error) {
  size_t kept = 0;
  for (size_t i = 0; i < graph->segment.count; i++) {
    (void)poll_at(i);
    if (!drop[i])
      graph->segment.item[kept++] = graph->segment.item[i];
  }
  graph->segment.count = kept;
  return segment_graph_index_ends(graph, error);
}

/* Whether two consecutive edges are of one polyline. */
static bool is_same_wire(const struct sheet_edge *a,
                         const struct sheet_edge *b) {
  return a->edge_class == RECTO_EDGE_WIRE && b->edge_class == RECTO_EDGE_WIRE &&
         a->source == b->source;
}

recto_status segment_graph_key_by_source(struct segment_graph *graph,
                                         const struct sheet *sheet,
                                         recto_error *error) {
  size_t count = sheet->edge.count;
  const struct sheet_edge *edge = sheet->edge.item;
  uint32_t *source = mem_alloc(count, sizeof *source); /* its first edge */
  if (source == NULL)
    return error_memory(error);
  for (uint32_t i = 0; i < count; i++)
    source[i] =
        i > 0 && is_same_wire(&edge[i - 1], &edge[i]) ? source[i - 1] : i;
  for (size_t i = 0; i < graph->segment.count; i++) {
    struct graph_segment *s = &graph->segment.item[i];
    s->pen_key = 2 * source[s->edge] + graph_segment_is_hidden(s);
  }
  mem_free(source);
  return RECTO_OK;
}

/* No fewer than there are pen keys, of a pen, a weight and whether a line is
 * hidden. */
enum { PEN_KEYS = 1 << 15 };

void segment_graph_key_by_group(struct segment_graph *graph,
                                const struct sheet *sheet) {
  for (size_t i = 0; i < graph->segment.count; i++) {
    struct graph_segment *s = &graph->segment.item[i];
    s->pen_key +=
        PEN_KEYS * sheet_edge_group(sheet, &sheet->edge.item[s->edge]);
  }
}
