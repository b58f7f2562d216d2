/* loop_changes.c - makes the loops of visible fragments anew. */
#include "visibility/fit/loop_changes.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"

/* The loops as they will be. */
struct new_loops {
  const struct loop_changes *changes;
  uint8_t *is_bent;     /* one a corner: something of its side changes */
  uint32_t *new_corner; /* one a corner */
  ARRAY(struct map_corner) corner;
  ARRAY(struct map_half_edge) half_edge;
};

double loop_changes_round(double x) {
  return rint(x * MAP_CORNER_SCALE) / MAP_CORNER_SCALE;
}

bool loop_changes_init(struct loop_changes *c, struct map *map) {
  size_t halves = map->half_edge.count;
  *c = (struct loop_changes){.map = map};
  c->to = mem_alloc(map->corner.count, sizeof *c->to);
  c->is_moved = mem_calloc(map->corner.count, 1);
  c->starts_side = mem_calloc(halves, 1);
  c->first_id = mem_alloc(halves, sizeof *c->first_id);
  c->start = mem_calloc(halves + 1, sizeof *c->start);
  if (c->to == NULL || c->is_moved == NULL || c->starts_side == NULL ||
      c->first_id == NULL || c->start == NULL)
    return false;
  memset(c->first_id, 0xff, halves * sizeof *c->first_id);
  return true;
}

void loop_changes_fini(struct loop_changes *c) {
  mem_free(c->to);
  mem_free(c->is_moved);
  mem_free(c->starts_side);
  mem_free(c->first_id);
  mem_free(c->start);
  ARRAY_FREE(&c->point);
}

static uint32_t points_of(const struct loop_changes *c, size_t half) {
  return c->start[half + 1] - c->start[half];
}

/* What a half-edge becomes starts here. */
static uint32_t new_half(const struct loop_changes *c, uint32_t half) {
  return half + c->start[half];
}

/* Sides of which something changes bend at each of their neighbours' corners.
 */
static bool find_bent_sides(struct new_loops *n) {
  const struct loop_changes *c = n->changes;
  const struct map_half_edge *half = c->map->half_edge.item;
  n->is_bent = mem_calloc(c->map->corner.count, 1);
  for (size_t h = 0; n->is_bent != NULL && h < c->map->half_edge.count; h++)
    if (c->is_moved[half[h].origin] || c->is_moved[half[half[h].next].origin] ||
        c->starts_side[h] || points_of(c, h) > 0)
      n->is_bent[half[h].side] = 1;
  return n->is_bent != NULL;
}

/* Whether a half-edge starts a side. */
static bool starts_side(const struct new_loops *n, uint32_t h) {
  const struct map_half_edge *half = &n->changes->map->half_edge.item[h];
  return half->origin == half->side || n->is_bent[half->side];
}

static bool add_half_edge(struct new_loops *n, struct map_half_edge half) {
  half.next = (uint32_t)n->half_edge.count + 1;
  return ARRAY_PUSH(&n->half_edge, half);
}

static bool add_side(struct new_loops *n, struct map_corner corner,
                     struct map_half_edge half) {
  half.side = half.origin = (uint32_t)n->corner.count;
  return ARRAY_PUSH(&n->corner, corner) && add_half_edge(n, half);
}

/* Adds what half-edge h becomes: one more than there are points in it. */
static bool add_half_edges(struct new_loops *n, uint32_t h) {
  const struct loop_changes *c = n->changes;
  const struct map_half_edge *old = &c->map->half_edge.item[h];
  struct map_corner corner = c->map->corner.item[old->side];
  const struct map_corner *from = &c->map->corner.item[old->origin];
  struct map_half_edge half = *old;
  uint32_t points = points_of(c, h), id = corner.id;
  if (old->twin != SHEET_NONE)
    half.twin = new_half(c, old->twin) + points;
  if (!starts_side(n, h)) {
    half.side = (uint32_t)n->corner.count - 1;
    return add_half_edge(n, half);
  }
  bool moved = c->is_moved[old->origin];
  corner.x = moved ? loop_changes_round(c->to[old->origin][0]) : from->x;
  corner.y = moved ? loop_changes_round(c->to[old->origin][1]) : from->y;
  if (c->first_id[h] != SHEET_NONE)
    corner.id = c->first_id[h];
  if (old->origin == old->side)
    n->new_corner[old->side] = (uint32_t)n->corner.count;
  if (!add_side(n, corner, half))
    return false;
  for (uint32_t i = c->start[h]; i < c->start[h + 1]; i++) {
    const struct side_point *p = &c->point.item[i];
    corner.x = p->x;
    corner.y = p->y;
    corner.id = p->id != SHEET_NONE ? p->id : id;
    half.twin -= half.twin != SHEET_NONE;
    if (!add_side(n, corner, half))
      return false;
  }
  return true;
}

/* The corners at which half-edges start that are no sides of their own. */
static void set_origins(struct new_loops *n) {
  const struct loop_changes *c = n->changes;
  for (uint32_t h = 0; h < c->map->half_edge.count; h++)
    if (!starts_side(n, h))
      n->half_edge.item[new_half(c, h)].origin =
          n->new_corner[c->map->half_edge.item[h].origin];
}

static bool make_loops(struct new_loops *n) {
  struct map *map = n->changes->map;
  n->new_corner = mem_alloc(map->corner.count, sizeof *n->new_corner);
  if (n->new_corner == NULL)
    return false;
  for (size_t l = 0; l < map->loop.count; l++) {
    struct map_loop *loop = &map->loop.item[l];
    uint32_t first = loop->half_edge, h = first;
    uint32_t corner = (uint32_t)n->corner.count;
    if (!poll_at(l))
      return false;
    do {
      if (!add_half_edges(n, h))
        return false;
      h = map->half_edge.item[h].next;
    } while (h != first);
    n->half_edge.item[n->half_edge.count - 1].next =
        new_half(n->changes, first);
    *loop = (struct map_loop){corner, (uint32_t)n->corner.count - corner,
                              new_half(n->changes, first)};
  }
  set_origins(n);
  return true;
}

bool loop_changes_apply(struct loop_changes *c) {
  struct new_loops n = {.changes = c};
  struct map *map = c->map;
  bool ok = find_bent_sides(&n) && make_loops(&n);
  if (ok) {
    ARRAY_FREE(&map->corner);
    ARRAY_FREE(&map->half_edge);
    memcpy(&map->corner, &n.corner, sizeof n.corner);
    memcpy(&map->half_edge, &n.half_edge, sizeof n.half_edge);
  } else {
    ARRAY_FREE(&n.corner);
    ARRAY_FREE(&n.half_edge);
  }
  mem_free(n.is_bent);
  mem_free(n.new_corner);
  return ok;
}
