/* merge.c - visible fragments of one style become one fill.
 *
 * Phases
 *   1 gather the sides that are pieces of smooth edges, edge by edge
 *   2 along each edge, drop what two fragments of one style have on either
 *     side of it, and note that they are of one fill
 *   3 join what is left of each fill's outline end to end
 * Invariants
 *   As many sides come to a point as leave it, for what goes from a stretch of
 *   an edge are two sides that run along it one each way; so what is left
 *   joins to closed loops, be the map exact or not.  A fill is even-odd: which
 *   loops they are makes no difference to it.
 */
#include "ink/fill/merge.h"

#include <math.h>
#include <string.h>

#include "base/sets.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "ink/fill/outline.h"

/* A side of a fragment on a smooth edge. */
struct merge_side {
  uint32_t corner, next; /* in the map */
  uint32_t fragment;
};

struct merge {
  struct drawing *drawing;
  const struct sheet *sheet;
  const struct scene *scene;
  const struct map *map;
  const struct drawing_fill *like;
  double crease_deg;
  uint32_t *root;   /* of each fragment: towards the first one of its fill */
  uint8_t *merged;  /* of each fragment: it lost a side */
  uint8_t *dropped; /* of each corner: the side that leaves it is gone */
  ARRAY(struct merge_side) side;
  struct outline rest;    /* of sides that were dropped in part */
  struct outline outline; /* of the fill being made */
  struct ink_paths loops;
};

static struct outline_place place_of(const struct merge *merge,
                                     uint32_t corner) {
  const struct map_corner *c = &merge->map->corner.item[corner];
  return (struct outline_place){c->x, c->y};
}

static void join(struct merge *merge, uint32_t first, uint32_t second) {
  sets_join(merge->root, first, second);
  merge->merged[first] = merge->merged[second] = 1;
}

/* ---- 1. Sides by edge ---------------------------------------------------- */

static bool is_smooth(const struct merge *merge, uint32_t id) {
  const struct sheet_edge *edge = &merge->sheet->edge.item[id];
  if (edge->edge_class != 0)
    return edge->edge_class == RECTO_EDGE_SMOOTH;
  const struct topology *topology = merge->sheet->topology;
  return topology != NULL && edge->source < topology->edge.count &&
         topology_natures(topology, merge->scene, edge->source,
                          merge->crease_deg) == RECTO_EDGE_SMOOTH;
}

/* Whether the side that leaves the corner may go: looked up once an edge.
 * smooth  one a sheet edge: 0 not known, 1 no, 2 yes */
static bool may_go(const struct merge *merge, const struct map_corner *corner,
                   uint8_t *smooth) {
  if (corner->side != MAP_SIDE_EDGE || corner->id >= merge->sheet->edge.count)
    return false;
  if (smooth[corner->id] == 0)
    smooth[corner->id] = is_smooth(merge, corner->id) ? 2 : 1;
  return smooth[corner->id] == 2;
}

static bool gather_loop(struct merge *merge, uint32_t fragment,
                        const struct map_loop *loop, uint8_t *smooth) {
  for (uint32_t i = 0; i < loop->count; i++) {
    uint32_t corner = loop->corner + i;
    if (!may_go(merge, &merge->map->corner.item[corner], smooth))
      continue;
    uint32_t next = loop->corner + (i + 1 < loop->count ? i + 1 : 0);
    struct merge_side side = {corner, next, fragment};
    if (!ARRAY_PUSH(&merge->side, side))
      return false;
  }
  return true;
}

static bool sort_sides(struct merge *merge) {
  size_t count = merge->side.count;
  struct sort_key *key = mem_alloc(count, 2 * sizeof *key);
  struct merge_side *sorted = mem_alloc(count, sizeof *sorted);
  bool ok = key != NULL && sorted != NULL;
  for (uint32_t i = 0; ok && i < count; i++)
    key[i] = (struct sort_key){
        merge->map->corner.item[merge->side.item[i].corner].id, i};
  if (ok) {
    sort_keys(key, key + count, count);
    for (size_t i = 0; i < count; i++)
      sorted[i] = merge->side.item[key[i].value];
    memcpy(merge->side.item, sorted, count * sizeof *sorted);
  }
  mem_free(sorted);
  mem_free(key);
  return ok;
}

static bool gather_sides(struct merge *merge) {
  const struct map *map = merge->map;
  uint8_t *smooth = mem_calloc(merge->sheet->edge.count, sizeof *smooth);
  bool ok = smooth != NULL;
  for (uint32_t f = 0; ok && f < map->fragment.count; f++) {
    const struct map_fragment *fragment = &map->fragment.item[f];
    for (uint32_t l = 0; ok && l < fragment->loops; l++)
      ok = gather_loop(merge, f, &map->loop.item[fragment->loop + l], smooth);
  }
  mem_free(smooth);
  return ok && (merge->side.count == 0 || sort_sides(merge));
}

/* ---- 2. What two fragments have on either side of an edge ---------------- */

static bool is_of_one_style(const struct merge *merge, uint32_t f, uint32_t g) {
  const struct drawing_fill *a = &merge->like[f], *b = &merge->like[g];
  return a->colour == b->colour;
}

static bool is_reverse(const struct merge *merge, const struct merge_side *a,
                       const struct merge_side *b) {
  return outline_compare(place_of(merge, a->corner),
                         place_of(merge, b->next)) == 0 &&
         outline_compare(place_of(merge, a->next),
                         place_of(merge, b->corner)) == 0;
}

/* Where a side begins or ends along its edge. */
struct merge_event {
  struct outline_place at;
  uint32_t fragment;
  bool forward; /* the side runs upwards in (x, y) */
  bool begins;
};

static int compare_events(const void *a, const void *b, void *user) {
  const struct merge_event *p = a, *q = b;
  (void)user;
  int order = outline_compare(p->at, q->at);
  /* What ends comes first. */
  return order != 0 ? order : (int)p->begins - (int)q->begins;
}

static bool add_rest(struct merge *merge, struct outline_place low,
                     struct outline_place high, bool forward,
                     uint32_t fragment) {
  struct outline_piece piece = {forward ? low : high, forward ? high : low,
                                fragment, false};
  return ARRAY_PUSH(&merge->rest.piece, piece);
}

/* A side that runs along the stretch at hand. */
struct running {
  uint32_t fragment;
  bool forward;
  bool gone; /* from this stretch */
};

typedef ARRAY(struct running) runners;

/* Lets sides that run both ways along a stretch go by twos, where they are of
 * one style. */
static void cancel_stretch(struct merge *merge, runners *running) {
  struct running *r = running->item;
  for (size_t i = 0; i < running->count; i++)
    r[i].gone = false;
  for (size_t i = 0; i < running->count; i++)
    for (size_t j = i + 1; !r[i].gone && j < running->count; j++)
      if (r[i].forward != r[j].forward && !r[j].gone &&
          is_of_one_style(merge, r[i].fragment, r[j].fragment)) {
        r[i].gone = r[j].gone = true;
        join(merge, r[i].fragment, r[j].fragment);
      }
}

/* The stretch between two neighbouring events: what does not go stays.  Maps
 * that are not exact may have several sides each way there. */
static bool settle(struct merge *merge, struct outline_place low,
                   struct outline_place high, runners *running) {
  if (outline_compare(low, high) == 0)
    return true;
  cancel_stretch(merge, running);
  for (size_t i = 0; i < running->count; i++) {
    const struct running *r = &running->item[i];
    if (!r->gone && !add_rest(merge, low, high, r->forward, r->fragment))
      return false;
  }
  return true;
}

static bool take_event(runners *running, const struct merge_event *event) {
  struct running begun = {event->fragment, event->forward, false};
  if (event->begins)
    return ARRAY_PUSH(running, begun);
  for (size_t i = 0; i < running->count; i++)
    if (running->item[i].fragment == event->fragment &&
        running->item[i].forward == event->forward) {
      running->item[i] = running->item[--running->count];
      break;
    }
  return true;
}

static void add_events(struct merge *merge, const struct merge_side *side,
                       struct merge_event event[2]) {
  struct outline_place from = place_of(merge, side->corner);
  struct outline_place to = place_of(merge, side->next);
  bool forward = outline_compare(from, to) < 0;
  event[0] =
      (struct merge_event){forward ? from : to, side->fragment, forward, true};
  event[1] =
      (struct merge_event){forward ? to : from, side->fragment, forward, false};
  merge->dropped[side->corner] = 1;
}

/* Goes along an edge from event to event. */
static bool sweep_edge(struct merge *merge, const struct merge_side *side,
                       size_t count, struct merge_event *event) {
  runners running = {0};
  for (size_t i = 0; i < count; i++)
    add_events(merge, &side[i], &event[2 * i]);
  bool ok = sort_stable(event, 2 * count, sizeof *event, compare_events, NULL);
  for (size_t i = 0; ok && i < 2 * count; i++)
    ok = (i == 0 || settle(merge, event[i - 1].at, event[i].at, &running)) &&
         take_event(&running, &event[i]);
  ARRAY_FREE(&running);
  return ok;
}

/* Whether two sides of the run may cancel at all. */
static bool can_cancel(const struct merge *merge, const struct merge_side *side,
                       size_t count) {
  for (size_t i = 1; i < count; i++)
    if (side[i].fragment != side[0].fragment &&
        is_of_one_style(merge, side[0].fragment, side[i].fragment))
      return true;
  return false;
}

/* Whether all sides are on the edge's line, up to rounding.  Spans have sides
 * that cut across it. */
static bool are_on_line(const struct merge *merge, uint32_t edge,
                        const struct merge_side *side, size_t count) {
  const struct sheet *sheet = merge->sheet;
  const struct geom_point *p =
      &sheet->point.item[sheet->edge.item[edge].point[0]];
  const struct geom_point *q =
      &sheet->point.item[sheet->edge.item[edge].point[1]];
  double dx = (double)q->x - p->x, dy = (double)q->y - p->y;
  double most = TOLERANCE_COINCIDENT_UNITS * hypot(dx, dy);
  for (size_t i = 0; i < 2 * count; i++) {
    struct outline_place at =
        place_of(merge, i % 2 == 0 ? side[i / 2].corner : side[i / 2].next);
    if (fabs(dx * (at.y - p->y) - dy * (at.x - p->x)) > most)
      return false;
  }
  return true;
}

/* Cancels the sides that are one another's reverse. */
static void cancel_reverses(struct merge *merge, const struct merge_side *side,
                            size_t count) {
  for (size_t i = 0; i < count; i++)
    for (size_t j = i + 1; j < count && !merge->dropped[side[i].corner]; j++)
      if (!merge->dropped[side[j].corner] &&
          is_reverse(merge, &side[i], &side[j]) &&
          is_of_one_style(merge, side[i].fragment, side[j].fragment)) {
        merge->dropped[side[i].corner] = merge->dropped[side[j].corner] = 1;
        join(merge, side[i].fragment, side[j].fragment);
      }
}

static bool cancel_edge(struct merge *merge, uint32_t edge,
                        const struct merge_side *side, size_t count) {
  if (count < 2 || (count == 2 && !can_cancel(merge, side, count)))
    return true;
  if (!are_on_line(merge, edge, side, count) ||
      (count == 2 && is_reverse(merge, &side[0], &side[1]))) {
    cancel_reverses(merge, side, count);
    return true;
  }
  struct merge_event *event = mem_alloc(2 * count, sizeof *event);
  bool ok = event != NULL && sweep_edge(merge, side, count, event);
  mem_free(event);
  /* Its fragments are traced anew, whatever became of it. */
  for (size_t i = 0; i < count; i++)
    merge->merged[side[i].fragment] = 1;
  return ok;
}

static bool cancel_sides(struct merge *merge) {
  const struct merge_side *side = merge->side.item;
  for (size_t i = 0, j; i < merge->side.count; i = j) {
    uint32_t edge = merge->map->corner.item[side[i].corner].id;
    for (j = i + 1; j < merge->side.count &&
                    merge->map->corner.item[side[j].corner].id == edge;)
      j++;
    if (!cancel_edge(merge, edge, &side[i], j - i))
      return false;
  }
  return true;
}

/* ---- 3. Fills ------------------------------------------------------------ */

static bool add_loop(struct merge *merge, const struct ink_point *point,
                     uint32_t count) {
  struct drawing *drawing = merge->drawing;
  struct drawing_loop loop = {(uint32_t)drawing->point.count, count};
  if (!ARRAY_PUSH(&drawing->loop, loop) ||
      !ARRAY_RESERVE(&drawing->point, count))
    return false;
  for (uint32_t i = 0; i < count; i++)
    drawing->point.item[drawing->point.count++] =
        (struct drawing_point){sheet_x_mm(merge->sheet, point[i].x),
                               sheet_y_mm(merge->sheet, point[i].y)};
  return true;
}

/* A fill like that of the fragment, from loops; straight sides are made so.
 * Where all are too thin to have an area there is none. */
static bool add_fill(struct merge *merge, uint32_t fragment,
                     struct ink_paths *loops) {
  struct drawing *drawing = merge->drawing;
  struct drawing_fill fill = merge->like[fragment];
  fill.loop = (uint32_t)drawing->loop.count;
  paths_straighten(loops, 0);
  for (size_t i = 0; i < loops->path.count; i++) {
    const struct ink_path *path = &loops->path.item[i];
    if (path->closed &&
        !add_loop(merge, loops->point.item + path->point, path->count))
      return false;
  }
  fill.loops = (uint32_t)drawing->loop.count - fill.loop;
  return fill.loops == 0 || ARRAY_PUSH(&drawing->fill, fill);
}

static bool take_sides(struct merge *merge, uint32_t f) {
  const struct map *map = merge->map;
  const struct map_fragment *fragment = &map->fragment.item[f];
  for (uint32_t l = 0; l < fragment->loops; l++) {
    const struct map_loop *loop = &map->loop.item[fragment->loop + l];
    for (uint32_t i = 0; i < loop->count; i++) {
      uint32_t corner = loop->corner + i;
      uint32_t next = loop->corner + (i + 1 < loop->count ? i + 1 : 0);
      struct outline_piece piece = {place_of(merge, corner),
                                    place_of(merge, next), f, false};
      if (!merge->dropped[corner] && !ARRAY_PUSH(&merge->outline.piece, piece))
        return false;
    }
  }
  return true;
}

/* A fragment that kept all its sides has its loops already. */
static bool take_loops(struct merge *merge, uint32_t f) {
  const struct map *map = merge->map;
  const struct map_fragment *fragment = &map->fragment.item[f];
  bool ok = true;
  for (uint32_t l = 0; ok && l < fragment->loops; l++) {
    const struct map_loop *loop = &map->loop.item[fragment->loop + l];
    ok = outline_begin_loop(&merge->loops);
    for (uint32_t i = 0; ok && i < loop->count; i++)
      ok = outline_add_point(&merge->loops, place_of(merge, loop->corner + i));
  }
  return ok;
}

/* Keys that order fragments, or what is left of them, by their fills. */
static void key_by_root(struct merge *merge, struct sort_key *key,
                        const struct outline_piece *piece, size_t count) {
  for (uint32_t i = 0; i < count; i++)
    key[i] = (struct sort_key){
        sets_root(merge->root, piece ? piece[i].fragment : i), i};
  sort_keys(key, key + count, count);
}

static bool join_rest(struct merge *merge, const struct sort_key *fragment,
                      size_t count, const struct sort_key *rest, size_t rests) {
  bool ok = true;
  merge->outline.piece.count = 0;
  for (size_t i = 0; ok && i < count; i++)
    ok = take_sides(merge, fragment[i].value);
  for (size_t i = 0; ok && i < rests; i++)
    ok = ARRAY_PUSH(&merge->outline.piece,
                    merge->rest.piece.item[rest[i].value]);
  return ok && outline_trace(&merge->outline, &merge->loops);
}

static bool add_fills(struct merge *merge) {
  size_t count = merge->map->fragment.count, rests = merge->rest.piece.count;
  struct sort_key *fragment = mem_alloc(count, 2 * sizeof *fragment);
  struct sort_key *rest = mem_alloc(rests, 2 * sizeof *rest);
  bool ok = fragment != NULL && rest != NULL;
  if (ok) {
    key_by_root(merge, fragment, NULL, count);
    key_by_root(merge, rest, merge->rest.piece.item, rests);
  }
  for (size_t i = 0, j, r = 0, s; ok && i < count; i = j, r = s) {
    for (j = i + 1; j < count && fragment[j].key == fragment[i].key;)
      j++;
    for (s = r; s < rests && rest[s].key == fragment[i].key;)
      s++;
    merge->loops.path.count = merge->loops.point.count = 0;
    ok = (merge->merged[fragment[i].value]
              ? join_rest(merge, &fragment[i], j - i, &rest[r], s - r)
              : take_loops(merge, fragment[i].value)) &&
         add_fill(merge, fragment[i].value, &merge->loops);
  }
  mem_free(rest);
  mem_free(fragment);
  return ok;
}

bool merge_fills(struct drawing *drawing, const struct sheet *sheet,
                 const struct scene *scene, const struct map *map,
                 const struct drawing_fill *like,
                 const recto_options *options) {
  size_t count = map->fragment.count;
  struct merge merge = {
      .drawing = drawing,
      .sheet = sheet,
      .scene = scene,
      .map = map,
      .like = like,
      .crease_deg = options->crease_deg,
      .root = sets_create(count),
      .merged = mem_calloc(count, sizeof *merge.merged),
      .dropped = mem_calloc(map->corner.count, sizeof *merge.dropped)};
  bool ok = merge.root && merge.merged && merge.dropped;
  if (!options->ids)
    ok = ok && gather_sides(&merge) && cancel_sides(&merge);
  ok = ok && add_fills(&merge);
  mem_free(merge.root);
  mem_free(merge.merged);
  mem_free(merge.dropped);
  ARRAY_FREE(&merge.side);
  ARRAY_FREE(&merge.rest.piece);
  ARRAY_FREE(&merge.outline.piece);
  paths_fini(&merge.loops);
  return ok;
}
