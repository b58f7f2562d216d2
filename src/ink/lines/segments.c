/* segments.c - turns the visible and hidden intervals of the drawable edges
 * into segments of the page. */
#include "base/poll.h"
#include "ink/lines/segment_graph.h"

#include <string.h>

#include "ink/pens.h"

/* Segment s has ends 2 s and 2 s + 1, in 32 bits. */
#define SEGMENT_LIMIT (UINT32_MAX / 2)

struct collector {
  struct segment_graph *graph;
  const struct sheet *sheet;
  const struct map *map;
  const struct pens *pens;
  const recto_options *options;
  uint32_t
      *node_of_point; /* sheet point -> node; SEGMENT_GRAPH_NONE: none yet */
  uint32_t pen_key;   /* of edges of this class and group */
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
  number_lists_fini(&graph->ends);
  mem_free(graph->approximate);
  ARRAY_FREE(&graph->gap_end);
  segment_graph_init(graph);
}

static bool add_graph_node(struct segment_graph *graph, struct ink_point at,
                           uint32_t *node) {
  *node = (uint32_t)graph->node.count;
  return ARRAY_PUSH(&graph->node, at);
}

static bool node_of_point(struct collector *c, uint32_t point, uint32_t *node) {
  *node = c->node_of_point[point];
  if (*node != SEGMENT_GRAPH_NONE)
    return true;
  const struct geom_point *p = &c->sheet->point.item[point];
  if (!add_graph_node(c->graph, (struct ink_point){p->x, p->y}, node))
    return false;
  c->node_of_point[point] = *node;
  return true;
}

static bool node_at(struct collector *c, const struct sheet_edge *edge,
                    struct ratio t, uint32_t *node) {
  if (t.num == 0)
    return node_of_point(c, edge->point[0], node);
  if (t.num == t.den)
    return node_of_point(c, edge->point[1], node);
  const struct geom_point *p = &c->sheet->point.item[edge->point[0]];
  const struct geom_point *q = &c->sheet->point.item[edge->point[1]];
  struct ink_point at = {(int32_t)ratio_lerp(t, p->x, q->x),
                         (int32_t)ratio_lerp(t, p->y, q->y)};
  return add_graph_node(c->graph, at, node);
}

/* Sets the pen key for an edge: segments may be joined where one pen draws
 * them with one weight.  Mostly it is that of the edge before. */
static void set_pen_key(struct collector *c, uint32_t edge, bool hidden) {
  const struct sheet_edge *e = &c->sheet->edge.item[edge];
  if (e->edge_class == c->edge_class && e->group == c->group)
    return;
  c->edge_class = e->edge_class;
  c->group = e->group;
  c->pen_key =
      hidden
          ? 2 * pens_of_hidden(c->pens, c->options, e->edge_class, e->group) + 1
          : 2 * (pens_of_line(c->pens, e->edge_class, e->group) *
                     RECTO_EDGE_CLASS_COUNT +
                 pens_weight_id(c->pens, e->edge_class));
}

static bool collect_segment(struct collector *c, uint32_t edge, struct ratio t0,
                            struct ratio t1) {
  const struct sheet_edge *e = &c->sheet->edge.item[edge];
  struct graph_segment s = {.edge = edge,
                            .pen_key = c->pen_key,
                            .style_key = e->group << RECTO_EDGE_CLASS_COUNT |
                                         e->edge_class};
  if (!node_at(c, e, t0, &s.node[0]) || !node_at(c, e, t1, &s.node[1]))
    return false;
  const struct ink_point *node = c->graph->node.item;
  if (node[s.node[0]].x == node[s.node[1]].x &&
      node[s.node[0]].y == node[s.node[1]].y) {
    c->graph->dots++;
    return true;
  }
  return ARRAY_PUSH(&c->graph->segment, s);
}

/* The intervals of one edge, sorted and disjoint. */
struct intervals {
  const struct map_interval *item;
  uint32_t count;
};

static bool add_visible_intervals(struct collector *c, uint32_t edge,
                                  struct intervals visible) {
  for (uint32_t i = 0; i < visible.count; i++)
    if (!collect_segment(c, edge, visible.item[i].t0, visible.item[i].t1))
      return false;
  return true;
}

/* Adds the complement of the visible intervals and of those hidden by more
 * faces than requested. */
static bool add_hidden_intervals(struct collector *c, uint32_t edge,
                                 struct intervals visible,
                                 struct intervals deep) {
  struct ratio from = ratio_of(0, 1), end = ratio_of(1, 1);
  while (visible.count + deep.count > 0) {
    bool take_deep =
        deep.count > 0 && (visible.count == 0 ||
                           ratio_compare(deep.item->t0, visible.item->t0) < 0);
    struct intervals *next = take_deep ? &deep : &visible;
    if (ratio_compare(from, next->item->t0) < 0 &&
        !collect_segment(c, edge, from, next->item->t0))
      return false;
    if (ratio_compare(from, next->item->t1) < 0)
      from = next->item->t1;
    next->item++;
    next->count--;
  }
  return ratio_compare(from, end) >= 0 || collect_segment(c, edge, from, end);
}

/* The intervals of an edge, if the row at *mixed is the edge's, which it then
 * advances past. */
static struct intervals next_intervals(const struct map_mixed **mixed,
                                       const struct map_mixed *end,
                                       const struct map_interval *interval,
                                       uint32_t edge) {
  struct intervals taken = {NULL, 0};
  if (*mixed < end && (*mixed)->edge == edge) {
    taken = (struct intervals){interval + (*mixed)->interval, (*mixed)->count};
    ++*mixed;
  }
  return taken;
}

/* Adds the visible or the hidden intervals of all drawable edges, in order. */
static bool add_all(struct collector *c, bool hidden) {
  const struct map *map = c->map;
  c->edge_class = 0; /* no drawn edge's */
  const struct map_mixed *mixed = map->mixed.item, *deep = map->over_limit.item;
  const struct map_mixed *mixed_end = ARRAY_AT(&map->mixed, map->mixed.count);
  const struct map_mixed *deep_end =
      ARRAY_AT(&map->over_limit, map->over_limit.count);
  for (uint32_t i = 0; i < map->edge_count; i++) {
    struct intervals visible =
        next_intervals(&mixed, mixed_end, map->interval.item, i);
    struct intervals too_deep =
        next_intervals(&deep, deep_end, map->over_limit_interval.item, i);
    uint8_t state = map->edge_state[i];
    bool ok = true;
    if (!poll_at(i))
      return false;
    if (c->sheet->edge.item[i].edge_class == 0)
      continue;
    set_pen_key(c, i, hidden);
    if (hidden && state != MAP_VISIBLE)
      ok = add_hidden_intervals(c, i, visible, too_deep);
    else if (!hidden && state == MAP_VISIBLE)
      ok = collect_segment(c, i, ratio_of(0, 1), ratio_of(1, 1));
    else if (!hidden)
      ok = add_visible_intervals(c, i, visible);
    if (!ok)
      return false;
  }
  return true;
}

recto_status
segment_graph_collect(struct segment_graph *graph, const struct sheet *sheet,
                      const struct map *map, const struct pens *pens,
                      const recto_options *options, recto_error *error) {
  if (map->edge_state == NULL)
    return RECTO_OK;
  size_t points = sheet->point.count;
  struct collector c = {.graph = graph,
                        .sheet = sheet,
                        .map = map,
                        .pens = pens,
                        .options = options};
  c.node_of_point = mem_alloc(points, sizeof *c.node_of_point);
  if (c.node_of_point == NULL)
    return error_memory(error);
  memset(c.node_of_point, 0xff, points * sizeof *c.node_of_point);

  bool ok = add_all(&c, false);
  if (ok && options->ink.hidden != RECTO_HIDDEN_NONE)
    ok = add_all(&c, true);
  mem_free(c.node_of_point);
  if (!ok)
    return error_memory(error);
  if (graph->segment.count >= SEGMENT_LIMIT ||
      graph->node.count >= SEGMENT_LIMIT)
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "more than 2^31 visible lines");
  return RECTO_OK;
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
    s->pen_key += PEN_KEYS * sheet->edge.item[s->edge].group;
  }
}
