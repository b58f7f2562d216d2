/* sweep_edges.c - the edges of the sweep, collected from the sheet. */
#include <string.h>

#include "base/poll.h"
#include "visibility/watkins/exact/sweep.h"

/* Sides of triangles and drawn edges, keyed by their two points. */
struct sweep_gathering {
  struct sort_key *key;
  size_t count;
};

bool sweep_includes_line(const struct sheet *sheet, size_t e) {
  const struct sheet_edge *edge = &sheet->edge.item[e];
  return edge->triangle[0] != SHEET_NONE &&
         edge->edge_class != RECTO_EDGE_INTERSECTION &&
         sheet_edge_is_drawn(sheet, e);
}

/* The value of a key is
 *     3 t + k            for side k of triangle t,
 *     3 triangles + e    for drawn edge e. */
static void list_keys(struct sweep_gathering *g, const struct sheet *sheet,
                      const uint8_t *left_out, bool drawn) {
  uint32_t triangles = (uint32_t)sheet->triangle.count;
  for (uint32_t t = 0; t < triangles; t++) {
    const uint32_t *point = sheet->triangle.item[t].point;
    (void)poll_at(t);
    if (sheet_is_edge_on(sheet, t) || (left_out != NULL && left_out[t] != 0))
      continue;
    for (int k = 0; k < 3; k++)
      g->key[g->count++] =
          (struct sort_key){sort_pair_key(point[k], point[geom_next_corner(k)]),
                            3 * t + (uint32_t)k};
  }
  for (uint32_t e = 0; drawn && e < sheet->edge.count; e++)
    if (sweep_includes_line(sheet, e))
      g->key[g->count++] =
          (struct sort_key){sort_pair_key(sheet->edge.item[e].point[0],
                                          sheet->edge.item[e].point[1]),
                            3 * triangles + e};
}

/* A point as a key in the order of events: from the top, then from the left. */
static uint64_t key_of_end(int32_t x, int32_t y) {
  return ((uint64_t)((INT64_C(1) << 30) - y) << 31) |
         (uint64_t)((INT64_C(1) << 30) + x);
}

static bool add_sweep_edge(struct sweep *sweep, uint64_t points,
                           uint32_t side) {
  const struct geom_point *p = &sweep->sheet->point.item[points >> 32];
  const struct geom_point *q = &sweep->sheet->point.item[points & UINT32_MAX];
  struct sweep_edge edge = {.bounded = (uint32_t)sweep->bounded.count,
                            .side = side};
  if (key_of_end(p->x, p->y) > key_of_end(q->x, q->y)) {
    const struct geom_point *swap = p;
    p = q;
    q = swap;
  }
  edge.x0 = p->x;
  edge.y0 = p->y;
  edge.x1 = q->x;
  edge.y1 = q->y;
  return ARRAY_PUSH(&sweep->edge, edge);
}

/* Adds one edge for all sides of triangles between the same two points, with
 * the first drawn edge there, and one for each further drawn edge. */
static bool add_edges_between(struct sweep *sweep, const struct sort_key *key,
                              size_t count) {
  uint32_t sides = 3 * (uint32_t)sweep->sheet->triangle.count;
  size_t i = 0;
  if (key->value < sides) {
    if (!add_sweep_edge(sweep, key->key, SHEET_NONE))
      return false;
    for (; i < count && key[i].value < sides; i++)
      if (!ARRAY_PUSH(&sweep->bounded, key[i].value / 3))
        return false;
    sweep->edge.item[sweep->edge.count - 1].bounded_count = (uint32_t)i;
    if (i < count)
      sweep->edge.item[sweep->edge.count - 1].side = key[i++].value - sides;
  }
  for (; i < count; i++)
    if (!add_sweep_edge(sweep, key->key, key[i].value - sides))
      return false;
  return true;
}

/* Sorts the ends of all edges in the order of events. */
static bool sort_ends(struct sweep *sweep) {
  size_t count = sweep->edge.count;
  sweep->end = mem_alloc(2 * count, sizeof *sweep->end);
  if (sweep->end == NULL)
    return false;
  for (size_t e = 0; e < count; e++) {
    const struct sweep_edge *edge = &sweep->edge.item[e];
    (void)poll_at(e);
    sweep->end[2 * e] =
        (struct sort_key){key_of_end(edge->x0, edge->y0), (uint32_t)e};
    sweep->end[2 * e + 1] =
        (struct sort_key){key_of_end(edge->x1, edge->y1), SWEEP_NONE};
  }
  sweep->ends = 2 * count;
  return sort_keys_alone(sweep->end, sweep->ends);
}

bool sweep_init(struct sweep *sweep, const struct sheet *sheet,
                const uint8_t *left_out, bool drawn) {
  size_t most = 3 * sheet->triangle.count + (drawn ? sheet->edge.count : 0);
  struct sweep_gathering g = {mem_alloc(2 * most, sizeof *g.key), 0};
  bool ok = g.key != NULL;
  memset(sweep, 0, sizeof *sweep);
  sweep->sheet = sheet;
  sweep->covering_max = SWEEP_COVERING_MAX;
  sweep->events_max = SWEEP_EVENTS_MAX;
  if (ok) {
    list_keys(&g, sheet, left_out, drawn);
    sort_keys(g.key, g.key + most, g.count);
  }
  for (size_t i = 0, past, n = 0; ok && i < g.count; i = past, n++) {
    for (past = i + 1; past < g.count && g.key[past].key == g.key[i].key;)
      past++;
    ok = poll_at(n) && add_edges_between(sweep, &g.key[i], past - i);
  }
  mem_free(g.key);
  return ok && sort_ends(sweep);
}

void sweep_fini(struct sweep *sweep) {
  for (size_t e = 0; e < sweep->edge.count; e++)
    ARRAY_FREE(&sweep->edge.item[e].covering);
  ARRAY_FREE(&sweep->edge);
  ARRAY_FREE(&sweep->bounded);
  ARRAY_FREE(&sweep->crossing);
  ARRAY_FREE(&sweep->height);
  ARRAY_FREE(&sweep->active);
  ARRAY_FREE(&sweep->outgoing);
  ARRAY_FREE(&sweep->starting);
  ARRAY_FREE(&sweep->incident);
  mem_free(sweep->end);
  sweep->end = NULL;
}
