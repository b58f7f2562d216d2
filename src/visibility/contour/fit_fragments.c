/* fit_fragments.c - moves corners of visible fragments onto smooth contours,
 * and lets the sides between them follow the contours. */
#include "visibility/contour/fit_fragments.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "visibility/contour/corner_moves.h"

/* The points of the contour between two places, and the edges after them. */
enum { WAY_MAX = 64 };
struct fit_way {
  uint32_t point[WAY_MAX], edge[WAY_MAX];
  uint32_t count;
};

struct fit {
  struct map *map;
  struct corner_moves moves;
  uint32_t *new_half;   /* one a half-edge and one more: the first it becomes */
  uint32_t *new_corner; /* one a corner */
  uint8_t *is_bent;     /* one a corner: a point of its side is moved */
  ARRAY(struct map_corner) corner; /* the new ones */
  ARRAY(struct map_half_edge) half_edge;
};

/* ---- Sides along the contour ------------------------------------------- */

/* Whether a half-edge runs along an outline that is not drawn. */
static bool is_along(const struct fit *f, const struct map_half_edge *half) {
  return corner_moves_is_along(&f->moves, &f->map->corner.item[half->side]);
}

/* Whether twins have the same two end points. */
static bool is_matched(const struct map *map, const struct map_half_edge *half,
                       const struct map_half_edge *twin) {
  const struct map_half_edge *all = map->half_edge.item;
  const struct map_corner *c = map->corner.item;
  const struct map_corner *p = &c[half->origin], *r = &c[twin->origin];
  const struct map_corner *q = &c[all[half->next].origin];
  const struct map_corner *s = &c[all[twin->next].origin];
  return p->x == s->x && p->y == s->y && q->x == r->x && q->y == r->y;
}

/* Follows a contour from one moved point on an edge to another one on the last
 * edge, through an end of the first one, for no longer than `most`.  Returns
 * the length of the way; INFINITY: it does not lead there. */
static double follow_contour(const struct fit *f,
                             const struct corner_move *from, uint32_t edge,
                             const struct corner_move *to, uint32_t last,
                             int end, double most, struct fit_way *way) {
  const struct sheet *sheet = f->moves.sheet;
  double length = 0, at[2] = {from->to[0], from->to[1]};
  way->count = 0;
  while (edge != last) {
    uint32_t point = sheet->edge.item[edge].point[end];
    const uint32_t *two = f->moves.at_point[point - f->moves.first_point];
    struct geom_point p = sheet->point.item[point];
    length += hypot(p.x - at[0], p.y - at[1]);
    edge = two[two[0] == edge];
    if (edge == SHEET_NONE || way->count == WAY_MAX || length > most)
      return INFINITY;
    way->point[way->count] = point;
    way->edge[way->count++] = edge;
    at[0] = p.x;
    at[1] = p.y;
    end = sheet->edge.item[edge].point[0] == point;
  }
  return length + hypot(to->to[0] - at[0], to->to[1] - at[1]);
}

/* The shortest way along a contour between two moved points; one without points
 * where all are more than twice as long as that between the points. */
static struct fit_way way_between(const struct fit *f,
                                  const struct corner_move *a,
                                  const struct corner_move *b) {
  struct fit_way best = {.count = 0}, way;
  double least = 2 * (hypot(a->from[0] - b->from[0], a->from[1] - b->from[1]) +
                      sqrt(a->distance) + sqrt(b->distance));
  for (int k = 0; k < 8; k++) {
    uint32_t from = k & 1 ? a->farther : a->edge;
    uint32_t to = k & 2 ? b->farther : b->edge;
    if (from == SHEET_NONE || to == SHEET_NONE)
      continue;
    double length = follow_contour(f, a, from, b, to, k >> 2, least, &way);
    if (length < least) {
      least = length;
      best = way;
    }
  }
  return best;
}

/* Finds how many points of the contour each half-edge gets. */
static bool count_points(struct fit *f) {
  const struct map_half_edge *half = f->map->half_edge.item;
  f->new_half = mem_alloc(f->map->half_edge.count + 1, sizeof *f->new_half);
  if (f->new_half == NULL)
    return false;
  f->new_half[0] = 0;
  for (size_t h = 0; h < f->map->half_edge.count; h++) {
    const struct map_half_edge *twin =
        half[h].twin == SHEET_NONE ? NULL : &half[half[h].twin];
    uint32_t between = 0;
    if (!poll_at(h))
      return false;
    const struct corner_move *from = corner_moves_at(&f->moves, half[h].origin);
    const struct corner_move *to =
        corner_moves_at(&f->moves, half[half[h].next].origin);
    if (from != NULL && to != NULL &&
        (is_along(f, &half[h]) || (twin != NULL && is_along(f, twin))) &&
        (twin == NULL || is_matched(f->map, &half[h], twin)))
      between = way_between(f, from, to).count;
    f->new_half[h + 1] = f->new_half[h] + 1 + between;
  }
  return true;
}

/* ---- The fragments ----------------------------------------------------- */

static double map_coordinate(double x) {
  return rint(x * MAP_CORNER_SCALE) / MAP_CORNER_SCALE;
}

/* Whether a half-edge starts a side of its own: sides of which a point is moved
 * bend at each of their neighbours' corners. */
static bool starts_side(const struct fit *f, const struct map_half_edge *half) {
  return half->origin == half->side || f->is_bent[half->side] ||
         is_along(f, half);
}

static bool find_bent_sides(struct fit *f) {
  const struct map_half_edge *half = f->map->half_edge.item;
  f->is_bent = mem_calloc(f->map->corner.count, 1);
  for (size_t h = 0; f->is_bent != NULL && h < f->map->half_edge.count; h++)
    if (corner_moves_at(&f->moves, half[h].origin) != NULL ||
        corner_moves_at(&f->moves, half[half[h].next].origin) != NULL)
      f->is_bent[half[h].side] = 1;
  return f->is_bent != NULL;
}

static bool add_half_edge(struct fit *f, struct map_half_edge half) {
  half.next = (uint32_t)f->half_edge.count + 1;
  return ARRAY_PUSH(&f->half_edge, half);
}

static bool add_side(struct fit *f, struct map_corner corner,
                     struct map_half_edge half) {
  half.side = half.origin = (uint32_t)f->corner.count;
  return ARRAY_PUSH(&f->corner, corner) && add_half_edge(f, half);
}

/* Adds what half-edge h becomes: one, or one for each edge of the contour along
 * which it runs. */
static bool add_half_edges(struct fit *f, uint32_t h) {
  const struct map_half_edge *all = f->map->half_edge.item, *old = &all[h];
  const struct corner_move *from = corner_moves_at(&f->moves, old->origin);
  struct map_corner corner = f->map->corner.item[old->side];
  struct map_half_edge half = *old;
  uint32_t between = f->new_half[h + 1] - f->new_half[h] - 1;
  if (old->twin != SHEET_NONE)
    half.twin = f->new_half[old->twin] + between;
  if (!starts_side(f, old)) {
    half.side = (uint32_t)f->corner.count - 1;
    return add_half_edge(f, half);
  }
  corner.x = f->map->corner.item[old->origin].x;
  corner.y = f->map->corner.item[old->origin].y;
  if (from != NULL) {
    corner.x = map_coordinate(from->to[0]);
    corner.y = map_coordinate(from->to[1]);
    if (is_along(f, old))
      corner.id = from->edge;
  }
  if (old->origin == old->side)
    f->new_corner[old->side] = (uint32_t)f->corner.count;
  if (!add_side(f, corner, half))
    return false;
  const struct corner_move *to =
      corner_moves_at(&f->moves, all[old->next].origin);
  struct fit_way way = {.count = 0};
  if (between > 0)
    way = way_between(f, from, to);
  for (uint32_t i = 0; i < between; i++) {
    struct geom_point p = f->moves.sheet->point.item[way.point[i]];
    corner.x = p.x;
    corner.y = p.y;
    if (is_along(f, old))
      corner.id = way.edge[i];
    half.twin -= half.twin != SHEET_NONE;
    if (!add_side(f, corner, half))
      return false;
  }
  return true;
}

/* Makes the map's loops anew. */
static bool make_loops(struct fit *f) {
  struct map *map = f->map;
  f->new_corner = mem_alloc(map->corner.count, sizeof *f->new_corner);
  if (f->new_corner == NULL)
    return false;
  for (size_t l = 0; l < map->loop.count; l++) {
    struct map_loop *loop = &map->loop.item[l];
    uint32_t first = loop->half_edge, h = first;
    uint32_t corner = (uint32_t)f->corner.count;
    if (!poll_at(l))
      return false;
    do {
      if (!add_half_edges(f, h))
        return false;
      h = map->half_edge.item[h].next;
    } while (h != first);
    f->half_edge.item[f->half_edge.count - 1].next = f->new_half[first];
    *loop = (struct map_loop){corner, (uint32_t)f->corner.count - corner,
                              f->new_half[first]};
  }
  for (size_t h = 0; h < map->half_edge.count; h++)
    if (!starts_side(f, &map->half_edge.item[h]))
      f->half_edge.item[f->new_half[h]].origin =
          f->new_corner[map->half_edge.item[h].origin];
  return true;
}

static void replace_loops(struct fit *f) {
  struct map *map = f->map;
  ARRAY_FREE(&map->corner);
  ARRAY_FREE(&map->half_edge);
  memcpy(&map->corner, &f->corner, sizeof f->corner);
  memcpy(&map->half_edge, &f->half_edge, sizeof f->half_edge);
  memset(&f->corner, 0, sizeof f->corner);
  memset(&f->half_edge, 0, sizeof f->half_edge);
}

bool fit_fragments(struct map *map, const struct sheet *sheet,
                   const struct topology *topology, uint32_t first) {
  struct fit f = {
      .map = map,
      .moves = {
          .map = map, .sheet = sheet, .topology = topology, .first = first}};
  bool ok = corner_moves_find(&f.moves) && count_points(&f) &&
            find_bent_sides(&f) && make_loops(&f);
  if (ok)
    replace_loops(&f);
  corner_moves_fini(&f.moves);
  mem_free(f.new_half);
  mem_free(f.new_corner);
  mem_free(f.is_bent);
  ARRAY_FREE(&f.corner);
  ARRAY_FREE(&f.half_edge);
  return ok;
}
