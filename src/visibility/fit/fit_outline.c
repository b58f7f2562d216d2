/* fit_outline.c - moves the outline of the visible fragments onto the lines
 * that are drawn there.
 *
 * Phases
 *   1 move the corners of the fragments' outline onto drawn ones
 *   2 put points of these into its sides, and where the nearest outline
 *     changes within one, of the way to where the two meet
 *   3 move the other corners of the fragments that this has turned over, where
 *     they are beyond a drawn contour
 *   4 put points of the outlines also into the other sides of such fragments:
 *     they lay between such a side and the mesh's outline, beyond the drawn one
 * Beyond a side of the outline there is no fragment, so that its shape is free;
 * a corner is moved with all that are at its place. */
#include "visibility/fit/fit_outline.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "base/tolerance.h"
#include "visibility/fit/loop_changes.h"
#include "visibility/zero_set/zero_segments.h"

/* The distance between two places of a side that are looked at, grid units, and
 * how many there are in one half-edge, at most. */
#define FIT_SPACING 0x1p18
enum { FIT_SAMPLES_MAX = 4096 };

/* How many points a way along the drawn outlines between two places has, at
 * most. */
enum { WAY_POINTS_MAX = 32 };

/* A fragment that is turned over collapses if at most this share of its area is
 * left. */
#define COLLAPSED_SHARE 0.25

/* How far sides that two fragments share are moved, at most, grid units: 2 mm.
 */
#define SHARED_RADIUS 0x1p21

/* From one place of the page to another one. */
struct place_move {
  double from[2];
  struct drawn_place to;
};

struct outline_fit {
  struct map *map;
  const struct sheet *sheet;
  const struct drawn_outlines *drawn;
  struct loop_changes changes;
  ARRAY(struct place_move) move;
  uint8_t *is_turned_over; /* one a fragment */
  struct large_face_size last;
};

/* Whether a place is to be moved to another one. */
static bool is_off(const struct drawn_place *to) {
  return to->distance > TOLERANCE_FILL_UNITS && to->distance < INFINITY;
}

/* ---- The fragments' outline ---------------------------------------------- */

static bool is_on_outline(const struct outline_fit *f, uint32_t h) {
  const struct map_half_edge *half = &f->map->half_edge.item[h];
  return half->twin == SHEET_NONE &&
         f->map->corner.item[half->side].side != MAP_SIDE_CLIP;
}

/* Where a corner is, or will be. */
static void place_of_corner(const struct outline_fit *f, uint32_t corner,
                            double at[2]) {
  const struct map_corner *c = &f->map->corner.item[corner];
  at[0] = f->changes.is_moved[corner] ? f->changes.to[corner][0] : c->x;
  at[1] = f->changes.is_moved[corner] ? f->changes.to[corner][1] : c->y;
}

static void ends_of_half(const struct outline_fit *f, uint32_t h, double a[2],
                         double b[2]) {
  const struct map_half_edge *all = f->map->half_edge.item;
  place_of_corner(f, all[h].origin, a);
  place_of_corner(f, all[all[h].next].origin, b);
}

static double radius_about(struct outline_fit *f, uint32_t h) {
  uint32_t fragment = f->map->half_edge.item[h].fragment;
  uint32_t face = f->map->fragment.item[fragment].face;
  return fmin(extent_of_face_by(&f->last, f->sheet, face), SHEET_XY_MAX);
}

/* ---- 1 Corners ----------------------------------------------------------- */

static int compare_places(const void *a, const void *b, void *user) {
  const double *p = ((const struct place_move *)a)->from;
  const double *q = ((const struct place_move *)b)->from;
  (void)user;
  if (p[0] != q[0])
    return p[0] < q[0] ? -1 : 1;
  return (p[1] > q[1]) - (p[1] < q[1]);
}

/* Finds the moves of the places at which sides of the outline start. */
static bool find_place_moves(struct outline_fit *f) {
  for (uint32_t h = 0; h < f->map->half_edge.count; h++) {
    double from[2], next[2];
    if (!poll_at(h))
      return false;
    if (!is_on_outline(f, h))
      continue;
    ends_of_half(f, h, from, next);
    const double along[2] = {next[0] - from[0], next[1] - from[1]};
    struct place_move move = {
        {from[0], from[1]},
        drawn_outlines_find(f->drawn, from, along, radius_about(f, h))};
    if (is_off(&move.to) && !ARRAY_PUSH(&f->move, move))
      return false;
  }
  return true;
}

/* Moves a corner if its place is; of several moves, by the shortest one. */
static void move_corner(struct outline_fit *f, uint32_t corner) {
  const struct map_corner *c = &f->map->corner.item[corner];
  const struct place_move at = {.from = {c->x, c->y}};
  const struct drawn_place *best = NULL;
  size_t i = 0;
  LOWER_BOUND(i, 0, f->move.count,
              compare_places(&f->move.item[i], &at, NULL) < 0);
  for (; i < f->move.count && compare_places(&f->move.item[i], &at, NULL) == 0;
       i++)
    if (best == NULL || f->move.item[i].to.distance < best->distance)
      best = &f->move.item[i].to;
  if (best == NULL)
    return;
  f->changes.is_moved[corner] = 1;
  memcpy(f->changes.to[corner], best->at, sizeof best->at);
}

/* Moves all corners whose places are. */
static bool move_all_places(struct outline_fit *f) {
  if (!sort_stable(f->move.item, f->move.count, sizeof *f->move.item,
                   compare_places, NULL))
    return false;
  for (uint32_t c = 0; f->move.count > 0 && c < f->map->corner.count; c++)
    move_corner(f, c);
  return true;
}

/* ---- 2 Sides ------------------------------------------------------------- */

static bool add_side_point(struct outline_fit *f, const double at[2]) {
  struct side_point made = {loop_changes_round(at[0]),
                            loop_changes_round(at[1]), SHEET_NONE};
  return ARRAY_PUSH(&f->changes.point, made);
}

/* Goes on from one place of the drawn outlines to another one.  Where the
 * middle between them is off the outlines, as between two that meet at an
 * angle, the way leads through the place that is nearest to it: so it gets
 * nearer and nearer to where they meet. */
static bool lead_along_drawn(struct outline_fit *f, const double from[2],
                             const double to[2], double radius) {
  static const double any[2] = {0, 0};
  double ahead[WAY_POINTS_MAX + 1][2] = {{to[0], to[1]}}; /* the last is next */
  double at[2] = {from[0], from[1]};
  int count = 1, made = 0;
  while (count > 0) {
    const double *next = ahead[count - 1];
    const double p[2] = {(at[0] + next[0]) / 2, (at[1] + next[1]) / 2};
    if (made < WAY_POINTS_MAX &&
        hypot(next[0] - at[0], next[1] - at[1]) > TOLERANCE_FILL_UNITS) {
      struct drawn_place place = drawn_outlines_find(f->drawn, p, any, radius);
      if (is_off(&place)) {
        memcpy(ahead[count++], place.at, sizeof place.at);
        made++;
        continue;
      }
    }
    memcpy(at, next, sizeof at);
    if (--count > 0 && !add_side_point(f, at))
      return false;
  }
  return true;
}

/* Puts places of the drawn outlines within a radius into a half-edge where it
 * is off them. */
static bool bend_half(struct outline_fit *f, uint32_t h, double radius) {
  double a[2], b[2];
  ends_of_half(f, h, a, b);
  const double from[2] = {a[0], a[1]};
  const double along[2] = {b[0] - a[0], b[1] - a[1]};
  double samples = ceil(hypot(along[0], along[1]) / FIT_SPACING);
  int n = (int)fmin(samples, FIT_SAMPLES_MAX);
  for (int k = 1; k < n; k++) {
    const double p[2] = {from[0] + along[0] * k / n,
                         from[1] + along[1] * k / n};
    struct drawn_place to = drawn_outlines_find(f->drawn, p, along, radius);
    if (!is_off(&to))
      continue;
    if (!lead_along_drawn(f, a, to.at, radius) || !add_side_point(f, to.at))
      return false;
    memcpy(a, to.at, sizeof a);
  }
  return lead_along_drawn(f, a, b, radius);
}

/* Puts the same places, in the opposite order, into its twin. */
static bool bend_twin(struct outline_fit *f, uint32_t h, double radius) {
  size_t first = f->changes.point.count;
  bool ok = bend_half(f, h, radius);
  for (size_t i = first, k = f->changes.point.count; ok && i + 1 < k; i++) {
    struct side_point point = f->changes.point.item[i];
    f->changes.point.item[i] = f->changes.point.item[--k];
    f->changes.point.item[k] = point;
  }
  return ok;
}

static bool bend_sides(struct outline_fit *f) {
  for (uint32_t h = 0; h < f->map->half_edge.count; h++) {
    if (!poll_at(h) ||
        (is_on_outline(f, h) && !bend_half(f, h, radius_about(f, h))))
      return false;
    f->changes.start[h + 1] = (uint32_t)f->changes.point.count;
  }
  return true;
}

/* ---- Areas --------------------------------------------------------------- */

/* Twice the signed area between a half-edge and the origin. */
static double area_of_half(const struct outline_fit *f, uint32_t h) {
  double at[2], end[2], sum = 0;
  ends_of_half(f, h, at, end);
  for (uint32_t i = f->changes.start[h]; i < f->changes.start[h + 1]; i++) {
    const struct side_point *p = &f->changes.point.item[i];
    sum += at[0] * p->y - at[1] * p->x;
    at[0] = p->x;
    at[1] = p->y;
  }
  return sum + at[0] * end[1] - at[1] * end[0];
}

/* Finds the areas of the fragments, doubled. */
static void find_areas(const struct outline_fit *f, double *area) {
  memset(area, 0, f->map->fragment.count * sizeof *area);
  for (uint32_t h = 0; h < f->map->half_edge.count; h++)
    area[f->map->half_edge.item[h].fragment] += area_of_half(f, h);
}

/* ---- 3 Corners beyond ---------------------------------------------------- */

/* Whether a place lies beyond the contour that is the nearest line to it. */
static bool is_beyond_contour(const struct outline_fit *f, const double from[2],
                              const struct drawn_place *to) {
  const struct sheet *sheet = f->sheet;
  if (!is_off(to) || to->edge < f->drawn->first)
    return false;
  struct geom_segment s = sheet_ends(sheet, sheet->edge.item[to->edge].point);
  return ((double)s.q.x - s.p.x) * (from[1] - s.p.y) <
         ((double)s.q.y - s.p.y) * (from[0] - s.p.x);
}

/* Moves the corners of fragments that are turned over which still lie beyond a
 * contour: those that they share with others.
 * area  of each fragment */
static bool move_corners_beyond(struct outline_fit *f, const double *area) {
  static const double any[2] = {0, 0};
  f->move.count = 0;
  for (uint32_t h = 0; h < f->map->half_edge.count; h++) {
    const struct map_half_edge *half = &f->map->half_edge.item[h];
    if (area[half->fragment] >= 0 || f->changes.is_moved[half->origin])
      continue;
    const struct map_corner *c = &f->map->corner.item[half->origin];
    double radius = fmin(radius_about(f, h), SHARED_RADIUS);
    struct place_move move = {.from = {c->x, c->y}};
    move.to = drawn_outlines_find(f->drawn, move.from, any, radius);
    if (!poll_at(h) || (is_beyond_contour(f, move.from, &move.to) &&
                        !ARRAY_PUSH(&f->move, move)))
      return false;
  }
  return move_all_places(f);
}

/* ---- 4 Fragments that are turned over ------------------------------------ */

/* The half-edge on whose right a fragment is turned over, of one that two
 * fragments share and its twin; SHEET_NONE. */
static uint32_t beside_turned_over(const struct outline_fit *f, uint32_t h) {
  const struct map_half_edge *all = f->map->half_edge.item;
  uint32_t twin = all[h].twin;
  if (twin == SHEET_NONE || f->is_turned_over[all[h].fragment] ==
                                f->is_turned_over[all[twin].fragment])
    return SHEET_NONE;
  return f->is_turned_over[all[h].fragment] ? twin : h;
}

/* Bends the sides that fragments which are turned over share with others.  All
 * others keep their points.
 * start, point  those of all half-edges so far */
static bool bend_shared_sides(struct outline_fit *f, const uint32_t *start,
                              const struct side_point *point) {
  struct loop_changes *c = &f->changes;
  bool ok = true;
  c->point.count = 0;
  for (uint32_t h = 0; ok && h < f->map->half_edge.count; h++) {
    uint32_t inner = beside_turned_over(f, h);
    for (uint32_t i = start[h]; ok && i < start[h + 1]; i++)
      ok = ARRAY_PUSH(&c->point, point[i]);
    if (ok && inner != SHEET_NONE) {
      double radius = fmin(radius_about(f, inner), SHARED_RADIUS);
      ok = poll_at(h) && (h == inner ? bend_half(f, inner, radius)
                                     : bend_twin(f, inner, radius));
    }
    c->start[h + 1] = (uint32_t)c->point.count;
  }
  return ok;
}

/* Bends the sides of fragments that are turned over, where next to nothing is
 * left of them then.
 * area  memory for two a fragment */
static bool collapse_turned_over(struct outline_fit *f, double *area,
                                 uint32_t *start, struct side_point *point) {
  size_t fragments = f->map->fragment.count, halves = f->map->half_edge.count;
  find_areas(f, area);
  bool ok = move_corners_beyond(f, area);
  memcpy(start, f->changes.start, (halves + 1) * sizeof *start);
  if (start[halves] > 0)
    memcpy(point, f->changes.point.item, start[halves] * sizeof *point);
  for (size_t i = 0; i < fragments; i++)
    f->is_turned_over[i] = area[i] < 0;
  for (int round = 0; ok && round < 2; round++) {
    ok = bend_shared_sides(f, start, point);
    find_areas(f, area + fragments);
    for (size_t i = 0; i < fragments; i++)
      f->is_turned_over[i] =
          f->is_turned_over[i] &&
          fabs(area[fragments + i]) <= COLLAPSED_SHARE * -area[i];
  }
  return ok;
}

static bool bend_turned_over(struct outline_fit *f) {
  size_t fragments = f->map->fragment.count, halves = f->map->half_edge.count;
  double *area = mem_calloc(fragments, 2 * sizeof *area);
  uint32_t *start = mem_alloc(halves + 1, sizeof *start);
  struct side_point *point = mem_alloc(f->changes.point.count, sizeof *point);
  f->is_turned_over = mem_calloc(fragments, 1);
  bool ok = area != NULL && start != NULL && point != NULL &&
            f->is_turned_over != NULL &&
            collapse_turned_over(f, area, start, point);
  mem_free(area);
  mem_free(start);
  mem_free(point);
  mem_free(f->is_turned_over);
  return ok;
}

bool fit_outline(struct map *map, const struct sheet *sheet,
                 const struct drawn_outlines *drawn) {
  struct outline_fit f = {.map = map, .sheet = sheet, .drawn = drawn};
  bool ok = loop_changes_init(&f.changes, map) && find_place_moves(&f) &&
            move_all_places(&f) && bend_sides(&f) && bend_turned_over(&f) &&
            loop_changes_apply(&f.changes);
  loop_changes_fini(&f.changes);
  ARRAY_FREE(&f.move);
  return ok;
}
