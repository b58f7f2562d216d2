/* merge.c - merges neighbouring visible fragments of one colour to one fill.
 *
 * Phases
 *   1 collect the fragments' sides that lie on smooth edges, grouped by edge
 *   2 along each edge, cancel the intervals over which two sides of fragments
 *     of one colour run in opposite directions, and unite the sets of the two
 *     fragments (union-find)
 *   3 join the remaining sides of each set end to end to the outline of a fill
 * Invariants
 *   As many sides end at a point as start there.  Phase 2 keeps this, since it
 *   removes sides over an interval only in pairs of opposite directions.  So
 *   the remaining sides can be joined to closed loops, whether the map is exact
 *   or not.  Fills are filled even-odd, so the choice of the loops does not
 *   affect what is filled.
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
  const struct drawing_fill *prototype; /* one a fragment, without loops */
  double crease_deg;
  uint32_t *root;   /* of each fragment: its parent in the union-find forest */
  uint8_t *merged;  /* of each fragment: its loops must be traced anew */
  uint8_t *dropped; /* of each corner: the side that begins there is cancelled,
                       wholly or over the intervals not in `remainder` */
  ARRAY(struct merge_side) side;
  struct outline remainder; /* the remaining parts of sides cancelled in part */
  struct outline outline;   /* of the current fill */
  struct ink_paths loops;   /* of the current fill */
};

static struct outline_point corner_position(const struct merge *merge,
                                            uint32_t corner) {
  const struct map_corner *c = &merge->map->corner.item[corner];
  return (struct outline_point){c->x, c->y};
}

static void unite_fragments(struct merge *merge, uint32_t first,
                            uint32_t second) {
  sets_join(merge->root, first, second);
  merge->merged[first] = merge->merged[second] = 1;
}

/* ---- 1. Sides by edge ---------------------------------------------------- */

/* Whether a sheet edge is smooth.  An edge without a class, since its class is
 * not drawn, is classified here. */
static bool is_smooth(const struct merge *merge, uint32_t id) {
  const struct sheet_edge *edge = &merge->sheet->edge.item[id];
  if (edge->edge_class != 0)
    return edge->edge_class == RECTO_EDGE_SMOOTH;
  const struct topology *topology = merge->sheet->topology;
  return topology != NULL && edge->source < topology->edge.count &&
         topology_natures(topology, merge->scene, edge->source,
                          merge->crease_deg) == RECTO_EDGE_SMOOTH;
}

/* Whether the side that begins at the corner lies on a smooth edge.
 * smooth  cache, one a sheet edge: 0 not known yet, 1 no, 2 yes */
static bool is_on_smooth_edge(const struct merge *merge,
                              const struct map_corner *corner,
                              uint8_t *smooth) {
  if (corner->side != MAP_SIDE_EDGE || corner->id >= merge->sheet->edge.count)
    return false;
  if (smooth[corner->id] == 0)
    smooth[corner->id] = is_smooth(merge, corner->id) ? 2 : 1;
  return smooth[corner->id] == 2;
}

static bool collect_loop(struct merge *merge, uint32_t fragment,
                         const struct map_loop *loop, uint8_t *smooth) {
  for (uint32_t i = 0; i < loop->count; i++) {
    uint32_t corner = loop->corner + i;
    if (!is_on_smooth_edge(merge, &merge->map->corner.item[corner], smooth))
      continue;
    uint32_t next = loop->corner + (i + 1 < loop->count ? i + 1 : 0);
    struct merge_side side = {corner, next, fragment};
    if (!ARRAY_PUSH(&merge->side, side))
      return false;
  }
  return true;
}

/* Sorts the collected sides by edge. */
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

static bool collect_sides(struct merge *merge) {
  const struct map *map = merge->map;
  uint8_t *smooth = mem_calloc(merge->sheet->edge.count, sizeof *smooth);
  bool ok = smooth != NULL;
  for (uint32_t f = 0; ok && f < map->fragment.count; f++) {
    const struct map_fragment *fragment = &map->fragment.item[f];
    for (uint32_t l = 0; ok && l < fragment->loops; l++)
      ok = collect_loop(merge, f, &map->loop.item[fragment->loop + l], smooth);
  }
  mem_free(smooth);
  return ok && (merge->side.count == 0 || sort_sides(merge));
}

/* ---- 2. Cancellation along each edge ------------------------------------- */

static bool have_same_colour(const struct merge *merge, uint32_t f,
                             uint32_t g) {
  const struct drawing_fill *a = &merge->prototype[f],
                            *b = &merge->prototype[g];
  return a->colour == b->colour;
}

/* Whether b is a with its ends exchanged. */
static bool is_reverse(const struct merge *merge, const struct merge_side *a,
                       const struct merge_side *b) {
  return outline_compare(corner_position(merge, a->corner),
                         corner_position(merge, b->next)) == 0 &&
         outline_compare(corner_position(merge, a->next),
                         corner_position(merge, b->corner)) == 0;
}

/* An event of the sweep along an edge: a side begins or ends. */
struct merge_event {
  struct outline_point at;
  uint32_t fragment;
  bool forward; /* the side runs from its lesser to its greater end */
  bool begins;
};

static int compare_events(const void *a, const void *b, void *user) {
  const struct merge_event *p = a, *q = b;
  (void)user;
  int order = outline_compare(p->at, q->at);
  /* At one point, ends come before beginnings. */
  return order != 0 ? order : (int)p->begins - (int)q->begins;
}

/* Keeps the part of a side between low and high. */
static bool keep_part(struct merge *merge, struct outline_point low,
                      struct outline_point high, bool forward,
                      uint32_t fragment) {
  struct outline_segment segment = {forward ? low : high, forward ? high : low,
                                    fragment, false};
  return ARRAY_PUSH(&merge->remainder.segment, segment);
}

/* A side that contains the current interval. */
struct merge_active {
  uint32_t fragment;
  bool forward;
  bool cancelled; /* over the current interval */
};

typedef ARRAY(struct merge_active) active_sides;

/* Cancels, over the current interval, pairs of sides of opposite directions
 * whose fragments have one colour. */
static void cancel_interval(struct merge *merge, active_sides *active) {
  struct merge_active *r = active->item;
  for (size_t i = 0; i < active->count; i++)
    r[i].cancelled = false;
  for (size_t i = 0; i < active->count; i++)
    for (size_t j = i + 1; !r[i].cancelled && j < active->count; j++)
      if (r[i].forward != r[j].forward && !r[j].cancelled &&
          have_same_colour(merge, r[i].fragment, r[j].fragment)) {
        r[i].cancelled = r[j].cancelled = true;
        unite_fragments(merge, r[i].fragment, r[j].fragment);
      }
}

/* Processes the interval between two consecutive events: sides that are not
 * cancelled are kept.  In maps that are not exact there may be several sides in
 * each direction. */
static bool process_interval(struct merge *merge, struct outline_point low,
                             struct outline_point high, active_sides *active) {
  if (outline_compare(low, high) == 0)
    return true;
  cancel_interval(merge, active);
  for (size_t i = 0; i < active->count; i++) {
    const struct merge_active *r = &active->item[i];
    if (!r->cancelled && !keep_part(merge, low, high, r->forward, r->fragment))
      return false;
  }
  return true;
}

/* Updates the list of active sides. */
static bool apply_event(active_sides *active, const struct merge_event *event) {
  struct merge_active side = {event->fragment, event->forward, false};
  if (event->begins)
    return ARRAY_PUSH(active, side);
  for (size_t i = 0; i < active->count; i++)
    if (active->item[i].fragment == event->fragment &&
        active->item[i].forward == event->forward) {
      active->item[i] = active->item[--active->count];
      break;
    }
  return true;
}

/* Adds the two events of a side, which is replaced by its remaining parts. */
static void add_events(struct merge *merge, const struct merge_side *side,
                       struct merge_event event[2]) {
  struct outline_point from = corner_position(merge, side->corner);
  struct outline_point to = corner_position(merge, side->next);
  bool forward = outline_compare(from, to) < 0;
  event[0] =
      (struct merge_event){forward ? from : to, side->fragment, forward, true};
  event[1] =
      (struct merge_event){forward ? to : from, side->fragment, forward, false};
  merge->dropped[side->corner] = 1;
}

/* Sweeps along an edge from event to event.
 * event  scratch, two a side */
static bool sweep_edge(struct merge *merge, const struct merge_side *side,
                       size_t count, struct merge_event *event) {
  active_sides active = {0};
  for (size_t i = 0; i < count; i++)
    add_events(merge, &side[i], &event[2 * i]);
  bool ok = sort_stable(event, 2 * count, sizeof *event, compare_events, NULL);
  for (size_t i = 0; ok && i < 2 * count; i++)
    ok = (i == 0 ||
          process_interval(merge, event[i - 1].at, event[i].at, &active)) &&
         apply_event(&active, &event[i]);
  ARRAY_FREE(&active);
  return ok;
}

/* Whether another side may cancel with the first one at all.  Exact for two
 * sides. */
static bool any_same_colour(const struct merge *merge,
                            const struct merge_side *side, size_t count) {
  for (size_t i = 1; i < count; i++)
    if (side[i].fragment != side[0].fragment &&
        have_same_colour(merge, side[0].fragment, side[i].fragment))
      return true;
  return false;
}

/* Whether all sides lie on the edge's line, up to rounding.  The fragments of
 * scan-line methods have sides that cross it. */
static bool are_on_line(const struct merge *merge, uint32_t edge,
                        const struct merge_side *side, size_t count) {
  const struct sheet *sheet = merge->sheet;
  const struct geom_point *p =
      &sheet->point.item[sheet->edge.item[edge].point[0]];
  const struct geom_point *q =
      &sheet->point.item[sheet->edge.item[edge].point[1]];
  double dx = (double)q->x - p->x, dy = (double)q->y - p->y;
  double max_cross = TOLERANCE_COINCIDENT_UNITS * hypot(dx, dy);
  for (size_t i = 0; i < 2 * count; i++) {
    struct outline_point at = corner_position(
        merge, i % 2 == 0 ? side[i / 2].corner : side[i / 2].next);
    if (fabs(dx * (at.y - p->y) - dy * (at.x - p->x)) > max_cross)
      return false;
  }
  return true;
}

/* Cancels pairs of sides of which one is the reverse of the other. */
static void cancel_reverses(struct merge *merge, const struct merge_side *side,
                            size_t count) {
  for (size_t i = 0; i < count; i++)
    for (size_t j = i + 1; j < count && !merge->dropped[side[i].corner]; j++)
      if (!merge->dropped[side[j].corner] &&
          is_reverse(merge, &side[i], &side[j]) &&
          have_same_colour(merge, side[i].fragment, side[j].fragment)) {
        merge->dropped[side[i].corner] = merge->dropped[side[j].corner] = 1;
        unite_fragments(merge, side[i].fragment, side[j].fragment);
      }
}

/* Cancels the sides on one edge.  A single pair of exact reverses needs no
 * sweep.  Where sides leave the edge's line a sweep along it is not possible,
 * so only exact reverses cancel. */
static bool cancel_edge(struct merge *merge, uint32_t edge,
                        const struct merge_side *side, size_t count) {
  if (count < 2 || (count == 2 && !any_same_colour(merge, side, count)))
    return true;
  if (!are_on_line(merge, edge, side, count) ||
      (count == 2 && is_reverse(merge, &side[0], &side[1]))) {
    cancel_reverses(merge, side, count);
    return true;
  }
  struct merge_event *event = mem_alloc(2 * count, sizeof *event);
  bool ok = event != NULL && sweep_edge(merge, side, count, event);
  mem_free(event);
  /* The sides are replaced by their remaining parts even if nothing cancelled,
   * so their fragments are traced anew. */
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

/* Adds a fill with the colour and ids of the fragment and these loops, after
 * the removal of points within straight sides.  If all loops are too thin to
 * have an area, no fill is added. */
static bool add_fill(struct merge *merge, uint32_t fragment,
                     struct ink_paths *loops) {
  struct drawing *drawing = merge->drawing;
  struct drawing_fill fill = merge->prototype[fragment];
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

/* Adds the sides of fragment f that are not cancelled to the outline. */
static bool add_sides(struct merge *merge, uint32_t f) {
  const struct map *map = merge->map;
  const struct map_fragment *fragment = &map->fragment.item[f];
  for (uint32_t l = 0; l < fragment->loops; l++) {
    const struct map_loop *loop = &map->loop.item[fragment->loop + l];
    for (uint32_t i = 0; i < loop->count; i++) {
      uint32_t corner = loop->corner + i;
      uint32_t next = loop->corner + (i + 1 < loop->count ? i + 1 : 0);
      struct outline_segment segment = {corner_position(merge, corner),
                                        corner_position(merge, next), f, false};
      if (!merge->dropped[corner] &&
          !ARRAY_PUSH(&merge->outline.segment, segment))
        return false;
    }
  }
  return true;
}

/* Copies the loops of a fragment that is not merged. */
static bool copy_loops(struct merge *merge, uint32_t f) {
  const struct map *map = merge->map;
  const struct map_fragment *fragment = &map->fragment.item[f];
  bool ok = true;
  for (uint32_t l = 0; ok && l < fragment->loops; l++) {
    const struct map_loop *loop = &map->loop.item[fragment->loop + l];
    ok = outline_begin_loop(&merge->loops);
    for (uint32_t i = 0; ok && i < loop->count; i++)
      ok = outline_add_point(&merge->loops,
                             corner_position(merge, loop->corner + i));
  }
  return ok;
}

/* Sorts fragments, or if `segment` is not NULL these remaining parts, by the
 * root of their fragment's set, that is by fill.
 * key  2 count elements, of which the first half is the result */
static void sort_by_root(struct merge *merge, struct sort_key *key,
                         const struct outline_segment *segment, size_t count) {
  for (uint32_t i = 0; i < count; i++)
    key[i] = (struct sort_key){
        sets_root(merge->root, segment ? segment[i].fragment : i), i};
  sort_keys(key, key + count, count);
}

/* Traces the loops of a merged fill, from the sides of its fragments that are
 * not cancelled and the remaining parts of others. */
static bool trace_merged(struct merge *merge, const struct sort_key *fragment,
                         size_t count, const struct sort_key *part,
                         size_t parts) {
  bool ok = true;
  merge->outline.segment.count = 0;
  for (size_t i = 0; ok && i < count; i++)
    ok = add_sides(merge, fragment[i].value);
  for (size_t i = 0; ok && i < parts; i++)
    ok = ARRAY_PUSH(&merge->outline.segment,
                    merge->remainder.segment.item[part[i].value]);
  return ok && outline_trace(&merge->outline, &merge->loops);
}

static bool add_fills(struct merge *merge) {
  size_t count = merge->map->fragment.count,
         parts = merge->remainder.segment.count;
  struct sort_key *fragment = mem_alloc(count, 2 * sizeof *fragment);
  struct sort_key *part = mem_alloc(parts, 2 * sizeof *part);
  bool ok = fragment != NULL && part != NULL;
  if (ok) {
    sort_by_root(merge, fragment, NULL, count);
    sort_by_root(merge, part, merge->remainder.segment.item, parts);
  }
  for (size_t i = 0, j, r = 0, s; ok && i < count; i = j, r = s) {
    for (j = i + 1; j < count && fragment[j].key == fragment[i].key;)
      j++;
    for (s = r; s < parts && part[s].key == fragment[i].key;)
      s++;
    merge->loops.path.count = merge->loops.point.count = 0;
    ok = (merge->merged[fragment[i].value]
              ? trace_merged(merge, &fragment[i], j - i, &part[r], s - r)
              : copy_loops(merge, fragment[i].value)) &&
         add_fill(merge, fragment[i].value, &merge->loops);
  }
  mem_free(part);
  mem_free(fragment);
  return ok;
}

bool merge_fills(struct drawing *drawing, const struct sheet *sheet,
                 const struct scene *scene, const struct map *map,
                 const struct drawing_fill *prototype,
                 const recto_options *options) {
  size_t count = map->fragment.count;
  struct merge merge = {
      .drawing = drawing,
      .sheet = sheet,
      .scene = scene,
      .map = map,
      .prototype = prototype,
      .crease_deg = options->crease_deg,
      .root = sets_create(count),
      .merged = mem_calloc(count, sizeof *merge.merged),
      .dropped = mem_calloc(map->corner.count, sizeof *merge.dropped)};
  bool ok = merge.root && merge.merged && merge.dropped;
  if (!options->ids)
    ok = ok && collect_sides(&merge) && cancel_sides(&merge);
  ok = ok && add_fills(&merge);
  mem_free(merge.root);
  mem_free(merge.merged);
  mem_free(merge.dropped);
  ARRAY_FREE(&merge.side);
  ARRAY_FREE(&merge.remainder.segment);
  ARRAY_FREE(&merge.outline.segment);
  paths_fini(&merge.loops);
  return ok;
}
