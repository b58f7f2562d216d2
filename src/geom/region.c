/* region.c - the union of convex pieces that do not overlap.
 *
 * Phases
 *   1 gather the sides of all pieces, sorted by the line they lie on
 *   2 along each line add up what runs forwards and backwards: where both do
 *     the line is inside the union, where one does it is its boundary
 *   3 join boundary segments end to end, taking the sharpest left turn, and
 *     drop the corners that go straight on
 *   4 distinguish outer loops from holes, give each hole to the innermost outer
 *     loop around it, and order everything
 * Invariants
 *   What phase 2 keeps depends on the union alone, because inner sides cancel
 *   however they were divided; where it is divided does not.
 *   Boundary is divided wherever the union's angle beside it ends at a point
 *   within it, for a piece ends there: so a loop turns away there too, and
 *   every corner of a loop spans one whole angle of the union.
 */
#include "geom/region.h"

#include <string.h>

#include "base/sort.h"

/* A directed piece of boundary: from `low` to `high` in (x, y) order where
 * forward, else the other way. */
struct segment {
  struct geom_corner low, high;
  const struct geom_line *line; /* runs as the segment does */
  bool forward;
  bool used;
};

typedef ARRAY(struct segment) segments;

void geom_region_fini(struct geom_region *region) {
  ARRAY_FREE(&region->side);
  ARRAY_FREE(&region->loop);
}

/* ---- 1. Sides by line ---------------------------------------------------- */

static bool gather_sides(const struct geom_convex *piece, size_t count,
                         segments *sides) {
  for (size_t i = 0; i < count; i++)
    for (uint32_t k = 0; k < piece[i].count; k++) {
      const struct geom_corner *p = &piece[i].corner[k],
                               *q = &piece[i].corner[(k + 1) % piece[i].count];
      int order = geom_corner_compare(p, q);
      struct segment side = {order < 0 ? *p : *q, order < 0 ? *q : *p,
                             piece[i].side[k], order < 0, false};
      if (order != 0 && !ARRAY_PUSH(sides, side))
        return false;
    }
  return true;
}

/* The sign of the turn from segment p's line to q's, both taken forwards. */
static int turn_forward(const struct segment *p, const struct segment *q) {
  int turn = geom_line_turn(p->line, q->line);
  return p->forward == q->forward ? turn : -turn;
}

/* Orders sides by the direction of their line, then by its place, then by
 * where they begin. */
static int compare_region_sides(const void *a, const void *b, void *user) {
  const struct segment *p = *(const struct segment *const *)a,
                       *q = *(const struct segment *const *)b;
  int order = -turn_forward(p, q);
  (void)user;
  if (order == 0) {
    order = -geom_line_side(p->line, &q->low);
    if (!p->forward)
      order = -order;
  }
  return order != 0 ? order : geom_corner_compare(&p->low, &q->low);
}

static bool on_same_line(const struct segment *p, const struct segment *q) {
  return turn_forward(p, q) == 0 && geom_line_side(p->line, &q->low) == 0;
}

/* ---- 2. Boundary along a line -------------------------------------------- */

struct region_event {
  struct geom_corner at;
  int change; /* of the count of forward less backward sides */
};

static int compare_events(const void *a, const void *b, void *user) {
  (void)user;
  return geom_corner_compare(&((const struct region_event *)a)->at,
                             &((const struct region_event *)b)->at);
}

static const struct geom_line *line_running(const struct segment *const *side,
                                            size_t count, bool forward) {
  for (size_t i = 0; i < count; i++)
    if (side[i]->forward == forward)
      return side[i]->line;
  return NULL;
}

/* The boundary on the one line that `count` sides lie on. */
static bool sweep_line(const struct segment *const *side, size_t count,
                       struct region_event *event, segments *boundary) {
  struct geom_corner from = {0};
  int net = 0;
  for (size_t i = 0; i < count; i++) {
    int change = side[i]->forward ? 1 : -1;
    event[2 * i] = (struct region_event){side[i]->low, change};
    event[2 * i + 1] = (struct region_event){side[i]->high, -change};
  }
  if (!sort_stable(event, 2 * count, sizeof *event, compare_events, NULL))
    return false;
  for (size_t i = 0; i < 2 * count;) {
    size_t j = i;
    int before = net;
    while (j < 2 * count &&
           geom_corner_compare(&event[i].at, &event[j].at) == 0)
      net += event[j++].change;
    if (before != 0) {
      struct segment s = {from, event[i].at,
                          line_running(side, count, before > 0), before > 0,
                          false};
      if (!ARRAY_PUSH(boundary, s))
        return false;
    }
    from = event[i].at;
    i = j;
  }
  return true;
}

static bool find_boundary(const segments *sides, segments *boundary) {
  size_t n = sides->count;
  struct region_event *event = mem_alloc(2 * n, sizeof *event);
  const struct segment **side = mem_alloc(n, sizeof *side);
  bool ok = event != NULL && side != NULL;
  for (size_t i = 0; ok && i < n; i++)
    side[i] = &sides->item[i];
  ok = ok && sort_stable(side, n, sizeof *side, compare_region_sides, NULL);
  for (size_t i = 0, j; ok && i < n; i = j) {
    for (j = i + 1; j < n && on_same_line(side[i], side[j]);)
      j++;
    ok = sweep_line(&side[i], j - i, event, boundary);
  }
  mem_free(event);
  mem_free(side);
  return ok;
}

/* ---- 3. Loops ------------------------------------------------------------ */

static const struct geom_corner *segment_start(const struct segment *s) {
  return s->forward ? &s->low : &s->high;
}

static int compare_segment_starts(const void *a, const void *b, void *user) {
  (void)user;
  return geom_corner_compare(segment_start(a), segment_start(b));
}

/* True where going on along u turns left of going on along v, after `in`. */
static bool sharper_left(const struct geom_line *in, const struct geom_line *u,
                         const struct geom_line *v) {
  int tu = geom_line_turn(in, u), tv = geom_line_turn(in, v);
  if (tu != tv)
    return tu > tv;
  return geom_line_turn(v, u) > 0;
}

/* The segment that goes on from `in`; segments are sorted by start. */
static struct segment *next_segment(segments *boundary,
                                    const struct segment *in) {
  const struct geom_corner *end = in->forward ? &in->high : &in->low;
  struct segment *best = NULL;
  size_t i;
  LOWER_BOUND(i, 0, boundary->count,
              geom_corner_compare(segment_start(&boundary->item[i]), end) < 0);
  for (; i < boundary->count; i++) {
    struct segment *s = &boundary->item[i];
    if (geom_corner_compare(segment_start(s), end) != 0)
      break;
    if (best == NULL || sharper_left(in->line, s->line, best->line))
      best = s;
  }
  return best;
}

/* Rotates the sides of a loop so that it starts at its lowest corner. */
static bool rotate_loop(struct geom_region_side *side, uint32_t count) {
  struct geom_region_side *copy = mem_alloc(count, sizeof *copy);
  uint32_t first = 0;
  if (copy == NULL)
    return false;
  for (uint32_t k = 1; k < count; k++) {
    int order = geom_corner_compare(&side[k].corner, &side[first].corner);
    if (order == 0)
      order = geom_corner_compare(&side[(k + 1) % count].corner,
                                  &side[(first + 1) % count].corner);
    if (order < 0)
      first = k;
  }
  for (uint32_t k = 0; k < count; k++)
    copy[k] = side[(first + k) % count];
  memcpy(side, copy, count * sizeof *copy);
  mem_free(copy);
  return true;
}

/* Drops the corners that go straight on; returns how many are left. */
static uint32_t drop_straight(struct geom_region_side *side, uint32_t count) {
  const struct geom_line *before = side[count - 1].line;
  uint32_t kept = 0;
  for (uint32_t k = 0; k < count; k++) {
    const struct geom_line *line = side[k].line;
    if (geom_line_turn(before, line) != 0)
      side[kept++] = side[k];
    before = line;
  }
  return kept;
}

/* A loop that starts at its lowest corner turns right there if it is a hole;
 * of several visits to that corner, one does. */
static bool is_hole(const struct geom_region_side *side, uint32_t count) {
  const struct geom_line *before = side[count - 1].line;
  bool hole = false;
  for (uint32_t k = 0; k < count; k++) {
    if (geom_corner_compare(&side[k].corner, &side[0].corner) == 0)
      hole |= geom_line_turn(before, side[k].line) < 0;
    before = side[k].line;
  }
  return hole;
}

static bool trace_region_loop(segments *boundary, struct segment *start,
                              struct geom_region *region) {
  struct geom_region_loop loop = {(uint32_t)region->side.count, 0, false};
  struct geom_region_side *side;
  for (struct segment *s = start; !s->used; s = next_segment(boundary, s)) {
    struct geom_region_side next = {*segment_start(s), s->line};
    s->used = true;
    if (!ARRAY_PUSH(&region->side, next))
      return false;
    loop.count++;
  }
  side = region->side.item + loop.side;
  loop.count = drop_straight(side, loop.count);
  region->side.count = loop.side + loop.count;
  if (!rotate_loop(side, loop.count))
    return false;
  loop.hole = is_hole(side, loop.count);
  return ARRAY_PUSH(&region->loop, loop);
}

/* ---- 4. Outer loops and holes -------------------------------------------- */

/* +1 where p is inside the loop, -1 outside, 0 on it. */
static int inside_loop(const struct geom_region *region,
                       const struct geom_region_loop *loop,
                       const struct geom_corner *p) {
  const struct geom_region_side *side = region->side.item + loop->side;
  bool inside = false;
  for (uint32_t k = 0; k < loop->count; k++) {
    const struct geom_corner *u = &side[k].corner,
                             *v = &side[(k + 1) % loop->count].corner;
    int cu = geom_corner_compare(u, p), cv = geom_corner_compare(v, p), s;
    if (cu == 0 || cv == 0)
      return 0;
    if ((cu < 0) == (cv < 0))
      continue;
    s = geom_line_side(side[k].line, p);
    if (s == 0)
      return 0;
    /* The side crosses the vertical through p; below p where p is left of it
     * and it runs to the right, or right of it and it runs to the left. */
    if ((s > 0) == (cu < 0))
      inside = !inside;
  }
  return inside ? 1 : -1;
}

/* A direction away from a corner: a line's, or the opposite one. */
struct region_ray {
  const struct geom_line *line;
  int sign;
};

/* Whether p is to the right of q; both are in the right half plane. */
static bool is_right_of(struct region_ray p, struct region_ray q) {
  return geom_line_turn(p.line, q.line) * p.sign * q.sign > 0;
}

/* The lowest of a loop's directions away from its first corner.  Nothing of it
 * is to the left of that, nor below it. */
static struct region_ray lowest_ray(const struct geom_region_side *side,
                                    uint32_t count) {
  struct region_ray lowest = {side[0].line, 1};
  const struct geom_line *before = side[count - 1].line;
  for (uint32_t k = 0; k < count; k++) {
    struct region_ray in = {before, -1}, out = {side[k].line, 1};
    before = side[k].line;
    if (geom_corner_compare(&side[k].corner, &side[0].corner) != 0)
      continue;
    if (is_right_of(in, lowest))
      lowest = in;
    if (is_right_of(out, lowest))
      lowest = out;
  }
  return lowest;
}

/* The outer loop does not begin after the hole. */
static bool contains_hole(const struct geom_region *region,
                          const struct geom_region_loop *outer,
                          const struct geom_region_loop *hole) {
  const struct geom_region_side *side = region->side.item + hole->side,
                                *round = region->side.item + outer->side;
  for (uint32_t k = 0; k < hole->count; k++) {
    int inside = inside_loop(region, outer, &side[k].corner);
    if (inside != 0)
      return inside > 0;
  }
  /* Touches it with every corner: a hole of it, or around it.  The one that is
   * around the other begins first, or else its sides are the outermost of
   * those that begin there. */
  if (geom_corner_compare(&round[0].corner, &side[0].corner) != 0)
    return true;
  return is_right_of(lowest_ray(round, outer->count),
                     lowest_ray(side, hole->count));
}

struct nested_loop {
  struct geom_region_loop loop;
  const struct geom_region *region;
  size_t outer; /* index of the outer loop it belongs to, or its own */
};

static const struct geom_region_side *first_side(const struct nested_loop *p) {
  return p->region->side.item + p->loop.side;
}

static int compare_first(const void *a, const void *b, void *user) {
  const struct nested_loop *p = a, *q = b;
  int order =
      geom_corner_compare(&first_side(p)->corner, &first_side(q)->corner);
  (void)user;
  if (order == 0)
    order =
        geom_corner_compare(&first_side(p)[1].corner, &first_side(q)[1].corner);
  return order;
}

static int compare_nesting(const void *a, const void *b, void *user) {
  const struct nested_loop *p = a, *q = b;
  (void)user;
  if (p->outer != q->outer)
    return p->outer < q->outer ? -1 : 1;
  return (int)p->loop.hole - (int)q->loop.hole;
}

static bool nest_loops(struct geom_region *region) {
  size_t n = region->loop.count;
  struct nested_loop *nested;
  bool ok = false;
  if (n < 2)
    return true;
  nested = mem_alloc(n, sizeof *nested);
  if (nested == NULL)
    return false;
  for (size_t i = 0; i < n; i++)
    nested[i] = (struct nested_loop){region->loop.item[i], region, i};
  if (!sort_stable(nested, n, sizeof *nested, compare_first, NULL))
    goto end;
  for (size_t i = 0; i < n; i++) {
    nested[i].outer = i;
    if (!nested[i].loop.hole)
      continue;
    /* The innermost outer loop around it is the last that holds it. */
    for (size_t j = i; j-- > 0;)
      if (!nested[j].loop.hole &&
          contains_hole(region, &nested[j].loop, &nested[i].loop)) {
        nested[i].outer = j;
        break;
      }
  }
  if (!sort_stable(nested, n, sizeof *nested, compare_nesting, NULL))
    goto end;
  for (size_t i = 0; i < n; i++)
    region->loop.item[i] = nested[i].loop;
  ok = true;
end:
  mem_free(nested);
  return ok;
}

bool geom_region_unite(struct geom_region *region,
                       const struct geom_convex *piece, size_t count) {
  segments sides = {0}, boundary = {0};
  bool ok = false;
  region->side.count = 0;
  region->loop.count = 0;
  if (!gather_sides(piece, count, &sides) ||
      !find_boundary(&sides, &boundary) ||
      !sort_stable(boundary.item, boundary.count, sizeof *boundary.item,
                   compare_segment_starts, NULL))
    goto end;
  for (size_t i = 0; i < boundary.count; i++)
    if (!boundary.item[i].used &&
        !trace_region_loop(&boundary, &boundary.item[i], region))
      goto end;
  ok = nest_loops(region);
end:
  ARRAY_FREE(&sides);
  ARRAY_FREE(&boundary);
  return ok;
}
