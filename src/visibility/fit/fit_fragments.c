/* fit_fragments.c - moves corners of visible fragments onto smooth contours,
 * and lets the sides between them follow the contours. */
#include "visibility/fit/fit_fragments.h"

#include <math.h>

#include "base/poll.h"
#include "visibility/fit/corner_moves.h"
#include "visibility/fit/loop_changes.h"

/* The points of the contour between two places, and the edges after them. */
enum { WAY_MAX = 64 };
struct fit_way {
  uint32_t point[WAY_MAX], edge[WAY_MAX];
  uint32_t count;
};

struct fit {
  struct map *map;
  struct corner_moves moves;
  struct loop_changes changes;
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

/* ---- The fragments ----------------------------------------------------- */

static void move_corners(struct fit *f) {
  for (uint32_t c = 0; c < f->map->corner.count; c++) {
    const struct corner_move *move = corner_moves_at(&f->moves, c);
    f->changes.is_moved[c] = move != NULL;
    for (int k = 0; k < 2 && move != NULL; k++)
      f->changes.to[c][k] = move->to[k];
  }
}

/* Puts the points of the contour along which a half-edge runs into it. */
static bool follow_along_half(struct fit *f, uint32_t h) {
  const struct map_half_edge *all = f->map->half_edge.item, *half = &all[h];
  const struct map_half_edge *twin =
      half->twin == SHEET_NONE ? NULL : &all[half->twin];
  const struct corner_move *from = corner_moves_at(&f->moves, half->origin);
  const struct corner_move *to =
      corner_moves_at(&f->moves, all[half->next].origin);
  bool along = is_along(f, half);
  f->changes.starts_side[h] = along;
  if (along && from != NULL)
    f->changes.first_id[h] = from->edge;
  if (from == NULL || to == NULL ||
      !(along || (twin != NULL && is_along(f, twin))) ||
      (twin != NULL && !is_matched(f->map, half, twin)))
    return true;
  struct fit_way way = way_between(f, from, to);
  for (uint32_t i = 0; i < way.count; i++) {
    struct geom_point p = f->moves.sheet->point.item[way.point[i]];
    struct side_point made = {p.x, p.y, along ? way.edge[i] : SHEET_NONE};
    if (!ARRAY_PUSH(&f->changes.point, made))
      return false;
  }
  return true;
}

static bool follow_contours(struct fit *f) {
  for (uint32_t h = 0; h < f->map->half_edge.count; h++) {
    if (!poll_at(h) || !follow_along_half(f, h))
      return false;
    f->changes.start[h + 1] = (uint32_t)f->changes.point.count;
  }
  return true;
}

bool fit_fragments(struct map *map, const struct sheet *sheet,
                   const struct topology *topology,
                   const struct drawn_outlines *drawn) {
  struct fit f = {.map = map,
                  .moves = {.map = map,
                            .sheet = sheet,
                            .topology = topology,
                            .first = drawn->first,
                            .drawn = drawn}};
  bool ok = corner_moves_find(&f.moves) && loop_changes_init(&f.changes, map);
  if (ok) {
    move_corners(&f);
    ok = follow_contours(&f) && loop_changes_apply(&f.changes);
  }
  corner_moves_fini(&f.moves);
  loop_changes_fini(&f.changes);
  return ok;
}
