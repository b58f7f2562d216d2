/* overlap.c - splits collinear segments into pieces that do not overlap.
 *
 * Phases, for a cluster of segments that overlap
 *   1 the longest one defines the line; segments off it are left to a line of
 *     their own
 *   2 all ends are sorted along the line; ends within the tolerance are one
 *     breakpoint, and between two breakpoints is a slot
 *   3 in order of priority each segment takes the free slots it covers; a
 *     union-find of next free slots makes that near linear
 *   4 adjacent slots of one owner become one piece
 * Robustness  Positions along the line are integers: |dx|, |dy| < 2^31, so the
 *   sum of two products is below 2^63.  Only the tolerance is a double. */
#include "ink/lines/overlap.h"

#include <math.h>

#include "base/tolerance.h"
#include "base/union_find.h"

struct overlap_line {
  struct ink_point from;
  int64_t dx, dy;
  double length;
};

static struct overlap_line line_of_segment(const struct segment_graph *graph,
                                           uint32_t segment) {
  const struct graph_segment *s = &graph->segment.item[segment];
  struct ink_point p = graph->node.item[s->node[0]];
  struct ink_point q = graph->node.item[s->node[1]];
  struct overlap_line line = {p, (int64_t)q.x - p.x, (int64_t)q.y - p.y, 0};
  line.length = sqrt((double)(line.dx * line.dx + line.dy * line.dy));
  return line;
}

/* The position along the line, times its length. */
static int64_t position_on(const struct overlap_line *line,
                           struct ink_point p) {
  return line->dx * ((int64_t)p.x - line->from.x) +
         line->dy * ((int64_t)p.y - line->from.y);
}

static double distance_from(const struct overlap_line *line,
                            struct ink_point p) {
  int64_t cross = line->dx * ((int64_t)p.y - line->from.y) -
                  line->dy * ((int64_t)p.x - line->from.x);
  return fabs((double)cross) / line->length;
}

/* Whether the point is within the tolerance of the segment itself. */
static bool is_near_overlap_line(const struct overlap_line *line,
                                 struct ink_point p) {
  double tolerance = TOLERANCE_COINCIDENT_UNITS * line->length;
  double along = (double)position_on(line, p);
  return distance_from(line, p) <= TOLERANCE_COINCIDENT_UNITS &&
         along >= -tolerance &&
         along <= line->length * line->length + tolerance;
}

bool overlap_is_along(const struct segment_graph *graph, uint32_t a,
                      uint32_t b) {
  struct overlap_line on_a = line_of_segment(graph, a),
                      on_b = line_of_segment(graph, b);
  double low = INFINITY, high = -INFINITY;
  for (int k = 0; k < 4; k++) {
    const struct overlap_line *other = k < 2 ? &on_b : &on_a;
    uint32_t segment = k < 2 ? a : b;
    struct ink_point p =
        graph->node.item[graph->segment.item[segment].node[k & 1]];
    if (!is_near_overlap_line(other, p))
      continue;
    double along = (double)position_on(&on_a, p);
    low = along < low ? along : low;
    high = along > high ? along : high;
  }
  return high - low > TOLERANCE_COINCIDENT_UNITS * on_a.length;
}

/* ---- Work space ---------------------------------------------------------- */

bool overlap_init(struct overlap *o, size_t segments) {
  *o = (struct overlap){0};
  o->key = mem_alloc(2 * segments, sizeof *o->key);
  o->scratch = mem_alloc(2 * segments, sizeof *o->scratch);
  o->slot = mem_alloc(2 * segments, sizeof *o->slot);
  o->node = mem_alloc(2 * segments, sizeof *o->node);
  o->owner = mem_alloc(2 * segments, sizeof *o->owner);
  o->next = mem_alloc(2 * segments + 1, sizeof *o->next);
  o->near = mem_alloc(segments, sizeof *o->near);
  o->rest = mem_alloc(segments, sizeof *o->rest);
  return o->key != NULL && o->scratch != NULL && o->slot != NULL &&
         o->node != NULL && o->owner != NULL && o->next != NULL &&
         o->near != NULL && o->rest != NULL;
}

void overlap_fini(struct overlap *o) {
  mem_free(o->key);
  mem_free(o->scratch);
  mem_free(o->slot);
  mem_free(o->node);
  mem_free(o->owner);
  mem_free(o->next);
  mem_free(o->near);
  mem_free(o->rest);
  ARRAY_FREE(&o->piece);
  *o = (struct overlap){0};
}

/* ---- 1 The line ---------------------------------------------------------- */

static struct overlap_line choose_line(const struct segment_graph *graph,
                                       const uint32_t *member, size_t count) {
  struct overlap_line best = line_of_segment(graph, member[0]);
  uint32_t chosen = member[0];
  for (size_t i = 1; i < count; i++) {
    struct overlap_line line = line_of_segment(graph, member[i]);
    if (line.length > best.length ||
        (line.length == best.length && overlap_priority(graph, member[i]) <
                                           overlap_priority(graph, chosen))) {
      best = line;
      chosen = member[i];
    }
  }
  return best;
}

/* A member of a cluster may overlap one that overlaps the line, so that it may
 * be twice the tolerance away. */
static bool is_member_near(const struct segment_graph *graph,
                           const struct overlap_line *line, uint32_t segment) {
  const uint32_t *node = graph->segment.item[segment].node;
  return distance_from(line, graph->node.item[node[0]]) <=
             2 * TOLERANCE_COINCIDENT_UNITS &&
         distance_from(line, graph->node.item[node[1]]) <=
             2 * TOLERANCE_COINCIDENT_UNITS;
}

/* ---- 2 Breakpoints ------------------------------------------------------- */

/* Fills slot[2 i + k] with the breakpoint of end k of near[i], node[] with
 * the node of each breakpoint.  Returns how many there are. */
static uint32_t find_breakpoints(struct overlap *o,
                                 const struct segment_graph *graph,
                                 const struct overlap_line *line,
                                 uint32_t count) {
  for (uint32_t i = 0; i < 2 * count; i++) {
    uint32_t node = graph->segment.item[o->near[i / 2]].node[i & 1];
    int64_t along = position_on(line, graph->node.item[node]);
    o->key[i] = (struct sort_key){sort_key_of_int64(along), i};
  }
  sort_keys(o->key, o->scratch, 2 * count);
  uint64_t tolerance = (uint64_t)(TOLERANCE_COINCIDENT_UNITS * line->length),
           first = 0;
  uint32_t points = 0;
  for (uint32_t k = 0; k < 2 * count; k++) {
    uint32_t i = o->key[k].value;
    if (k == 0 || o->key[k].key - first > tolerance) {
      first = o->key[k].key;
      o->node[points++] = graph->segment.item[o->near[i / 2]].node[i & 1];
    }
    o->slot[i] = points - 1;
  }
  return points;
}

/* ---- 3 Owners ------------------------------------------------------------ */

static void assign_slots(struct overlap *o, const struct segment_graph *graph,
                         uint32_t count, uint32_t points) {
  for (uint32_t k = 0; k < points; k++) {
    o->owner[k] = SEGMENT_GRAPH_NONE;
    o->next[k] = k;
  }
  for (uint32_t i = 0; i < count; i++)
    o->key[i] = (struct sort_key){overlap_priority(graph, o->near[i]), i};
  sort_keys(o->key, o->scratch, count);
  for (uint32_t k = 0; k < count; k++) {
    uint32_t i = o->key[k].value, a = o->slot[2 * i], b = o->slot[2 * i + 1];
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    for (uint32_t s = union_find_root(o->next, low); s < high;
         s = union_find_root(o->next, s)) {
      o->owner[s] = i;
      o->next[s] = s + 1;
    }
  }
}

/* ---- 4 Pieces ------------------------------------------------------------ */

static bool add_uncovered_pieces(struct overlap *o,
                                 const struct segment_graph *graph,
                                 uint32_t points) {
  uint32_t end;
  for (uint32_t s = 0; s + 1 < points; s = end) {
    uint32_t i = o->owner[s];
    for (end = s + 1; end + 1 < points && o->owner[end] == i; end++)
      continue;
    if (i == SEGMENT_GRAPH_NONE)
      continue;
    struct graph_segment piece = graph->segment.item[o->near[i]];
    uint32_t p = o->node[s], q = o->node[end];
    piece.node[0] = p < q ? p : q;
    piece.node[1] = p < q ? q : p;
    if (!ARRAY_PUSH(&o->piece, piece))
      return false;
  }
  return true;
}

bool overlap_resolve(struct overlap *o, const struct segment_graph *graph,
                     const uint32_t *member, size_t count) {
  while (count > 0) {
    struct overlap_line line = choose_line(graph, member, count);
    uint32_t near = 0;
    size_t rest = 0;
    for (size_t i = 0; i < count; i++) {
      if (is_member_near(graph, &line, member[i]))
        o->near[near++] = member[i];
      else
        o->rest[rest++] = member[i];
    }
    uint32_t points = find_breakpoints(o, graph, &line, near);
    assign_slots(o, graph, near, points);
    if (!add_uncovered_pieces(o, graph, points))
      return false;
    member = o->rest;
    count = rest;
  }
  return true;
}
