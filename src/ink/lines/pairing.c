/* pairing.c - decides which of the ends that meet at a node are joined.
 *
 * Phases at a node
 *   two ends                 joined if their pen keys are equal
 *   up to SMALL_FAN_MAX      the straightest pair is joined and removed, again
 *                            and again; pairs with equal style keys first
 *   more                     sorted by pen key, style key and direction, each
 *                            end is joined to the one half of its run further
 *                            on, which in a full fan is the opposite one; ends
 *                            left over by odd counts are paired in the same way
 *                            across styles
 * Robustness  Directions are unit vectors in float: they choose between pairs,
 *   and any choice is a valid drawing.  The result is the same on every
 *   machine, as only correctly rounded operations are used. */
#include "ink/lines/pairing.h"

#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "base/sort.h"

enum { SMALL_FAN_MAX = 16 };

struct end_direction {
  float x, y;
};

/* One end at the current node. */
struct node_end {
  uint32_t end, pen_key, style_key;
  struct end_direction away; /* from the node */
};

struct pairing {
  const struct segment_graph *graph;
  uint32_t *mate;
  struct end_direction *along; /* of each segment, from its first node */
  ARRAY(struct node_end) fan;
};

static bool find_directions_of_range(void *user, struct parallel_range range) {
  const struct pairing *p = user;
  const struct segment_graph *graph = p->graph;
  for (size_t i = range.begin; i < range.end; i++) {
    const struct graph_segment *s = &graph->segment.item[i];
    struct ink_point a = graph->node.item[s->node[0]];
    struct ink_point b = graph->node.item[s->node[1]];
    double x = (double)b.x - a.x, y = (double)b.y - a.y;
    double scale = 1 / sqrt(x * x + y * y);
    p->along[i] =
        (struct end_direction){(float)(x * scale), (float)(y * scale)};
  }
  return true;
}

static struct node_end node_end(const struct pairing *p, uint32_t end) {
  const struct graph_segment *s = &p->graph->segment.item[end >> 1];
  struct end_direction d = p->along[end >> 1];
  if (end & 1)
    d = (struct end_direction){-d.x, -d.y};
  return (struct node_end){end, s->pen_key, s->style_key, d};
}

static void pair_ends(struct pairing *p, uint32_t a, uint32_t b) {
  p->mate[a] = b;
  p->mate[b] = a;
}

/* ---- Small fans ---------------------------------------------------------- */

/* Greater than any sum of a cosine and a penalty. */
enum { NO_PAIR = 4 };

/* Finds the straightest pair of a fan.
 * alike  all ends have one pen key and one style key
 * Returns NO_PAIR where no two have one pen key. */
static inline float find_straightest(const struct node_end *fan, uint32_t count,
                                     bool alike, uint32_t pair[2]) {
  float best = NO_PAIR;
  /* Ties go to the first: ends are sorted by position on the page. */
  for (uint32_t i = 0; i + 1 < count; i++) {
    for (uint32_t k = i + 1; k < count; k++) {
      if (!alike && fan[i].pen_key != fan[k].pen_key)
        continue;
      float bend =
          fan[i].away.x * fan[k].away.x + fan[i].away.y * fan[k].away.y;
      if (!alike && fan[i].style_key != fan[k].style_key)
        bend += 2.5f; /* more than any two cosines differ */
      if (bend < best) {
        best = bend;
        pair[0] = i;
        pair[1] = k;
      }
    }
  }
  return best;
}

static void pair_small_fan(struct pairing *p, const uint32_t *end,
                           uint32_t count) {
  struct node_end fan[SMALL_FAN_MAX];
  bool alike = true;
  for (uint32_t i = 0; i < count; i++) {
    fan[i] = node_end(p, end[i]);
    alike = alike && fan[i].pen_key == fan[0].pen_key &&
            fan[i].style_key == fan[0].style_key;
  }
  while (count > 1) {
    uint32_t pair[2] = {0, 0}, kept = 0;
    float best = alike ? find_straightest(fan, count, true, pair)
                       : find_straightest(fan, count, false, pair);
    if (best >= NO_PAIR)
      return;
    pair_ends(p, fan[pair[0]].end, fan[pair[1]].end);
    for (uint32_t i = 0; i < count; i++)
      if (i != pair[0] && i != pair[1])
        fan[kept++] = fan[i];
    count = kept;
  }
}

/* ---- Large fans ---------------------------------------------------------- */

/* A monotonic function of the angle, from 0 up to 4. */
static float turn_of(struct end_direction d) {
  float t = d.y / (fabsf(d.x) + fabsf(d.y));
  return d.x < 0 ? 2 - t : d.y < 0 ? 4 + t : t;
}

static int compare_by_style(const void *first, const void *second, void *user) {
  const struct node_end *a = first, *b = second;
  (void)user;
  if (a->pen_key != b->pen_key)
    return compare_numbers(a->pen_key, b->pen_key);
  if (a->style_key != b->style_key)
    return compare_numbers(a->style_key, b->style_key);
  float ta = turn_of(a->away), tb = turn_of(b->away);
  return (ta > tb) - (ta < tb);
}

static int compare_by_turn(const void *first, const void *second, void *user) {
  const struct node_end *a = first, *b = second;
  (void)user;
  if (a->pen_key != b->pen_key)
    return compare_numbers(a->pen_key, b->pen_key);
  float ta = turn_of(a->away), tb = turn_of(b->away);
  return (ta > tb) - (ta < tb);
}

/* Pairs each end with the one half of its run further on; the odd one of a run
 * stays in the fan.  A run has one pen key and, if `by_style`, one style key.
 * */
static void pair_runs(struct pairing *p, bool by_style) {
  struct node_end *fan = p->fan.item;
  size_t left = 0;
  for (size_t i = 0, end; i < p->fan.count; i = end) {
    for (end = i + 1;
         end < p->fan.count && fan[end].pen_key == fan[i].pen_key &&
         (!by_style || fan[end].style_key == fan[i].style_key);
         end++)
      continue;
    size_t half = (end - i) / 2;
    for (size_t k = 0; k < half; k++)
      pair_ends(p, fan[i + k].end, fan[i + half + k].end);
    if ((end - i) % 2)
      fan[left++] = fan[end - 1];
  }
  p->fan.count = left;
}

static bool pair_large_fan(struct pairing *p, const uint32_t *end,
                           uint32_t count) {
  p->fan.count = 0;
  if (!ARRAY_RESERVE(&p->fan, count))
    return false;
  for (uint32_t i = 0; i < count; i++)
    p->fan.item[p->fan.count++] = node_end(p, end[i]);
  if (!sort_stable(p->fan.item, count, sizeof *p->fan.item, compare_by_style,
                   NULL))
    return false;
  pair_runs(p, true);
  if (!sort_stable(p->fan.item, p->fan.count, sizeof *p->fan.item,
                   compare_by_turn, NULL))
    return false;
  pair_runs(p, false);
  return true;
}

/* ---- All nodes ----------------------------------------------------------- */

/* Pairs the ends at a node. */
static bool pair_node(struct pairing *p, size_t n) {
  const struct segment_graph *graph = p->graph;
  const uint32_t *end = graph->ends.item + graph->ends.start[n];
  uint32_t count = graph->ends.start[n + 1] - graph->ends.start[n];
  if (count > SMALL_FAN_MAX)
    return pair_large_fan(p, end, count);
  if (count > 2)
    pair_small_fan(p, end, count);
  else if (count == 2 && graph->segment.item[end[0] >> 1].pen_key ==
                             graph->segment.item[end[1] >> 1].pen_key)
    pair_ends(p, end[0], end[1]);
  return true;
}

/* Each end is at one node: what one range pairs is no other's. */
static bool pair_range(void *user, struct parallel_range range) {
  struct pairing p = *(const struct pairing *)user; /* a fan of its own */
  bool ok = true;
  for (size_t n = range.begin; ok && n < range.end; n++)
    ok = pair_node(&p, n);
  ARRAY_FREE(&p.fan);
  return ok;
}

bool pairing_find(uint32_t *mate, const struct segment_graph *graph) {
  struct pairing p = {.graph = graph, .mate = mate};
  size_t count = graph->segment.count, nodes = graph->node.count;
  p.along = mem_alloc(count, sizeof *p.along);
  if (p.along != NULL)
    memset(mate, 0xff, 2 * count * sizeof *mate);
  bool ok = p.along != NULL &&
            parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                            PARALLEL_ITEMS, find_directions_of_range, &p) &&
            parallel_ranges(parallel_workers(nodes, PARALLEL_ITEMS), nodes,
                            PARALLEL_ITEMS, pair_range, &p);
  mem_free(p.along);
  return ok;
}
