/* part_merge.c - all parts of a drawing as one.
 *
 * Each list of a part is ascending, so the lists of all parts are gone through
 * together, by groups of equal items.  What is merged is freed before the next
 * list. */
#include "parts/part_merge.h"

#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "parts/interval_lists.h"
#include "parts/merge_order.h"
#include "scene/limit.h"

/* ---- Is it one drawing? -------------------------------------------------- */

static bool is_same_drawing(const struct part_common *a,
                            const struct part_common *b) {
  return a->id == b->id && a->parts == b->parts && a->edges == b->edges &&
         a->has_fragments == b->has_fragments &&
         a->has_hidden == b->has_hidden &&
         a->hidden_by_max == b->hidden_by_max && a->has_ids == b->has_ids &&
         a->has_tones == b->has_tones && a->has_marks == b->has_marks &&
         a->group.count == b->group.count;
}

static recto_status report_missing(const struct part *part, size_t count,
                                   recto_error *error) {
  uint32_t first = 0, missing = part->common.parts - (uint32_t)count;
  for (size_t i = 0; i < count; i++)
    if (part[i].index == first) {
      first++;
      i = (size_t)-1;
    }
  if (missing > 1)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "%lu of the %lu parts are missing, the first is part %lu",
                     (unsigned long)missing, (unsigned long)part->common.parts,
                     (unsigned long)first + 1);
  return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                   "part %lu of the %lu parts is missing",
                   (unsigned long)first + 1, (unsigned long)part->common.parts);
}

recto_status part_merge_check(const struct part *part, const char *const *path,
                              size_t count, recto_error *error) {
  for (size_t i = 1; i < count; i++)
    if (!is_same_drawing(&part[0].common, &part[i].common))
      return error_set(error, RECTO_ERROR_ARGUMENT, path[i], 0,
                       "the part belongs to another drawing than %.100s",
                       path[0]);
  for (size_t i = 1; i < count; i++)
    for (size_t k = 0; k < i; k++)
      if (part[k].index == part[i].index)
        return error_set(error, RECTO_ERROR_ARGUMENT, path[i], 0,
                         "part %lu of %lu is there twice, also as %.100s",
                         (unsigned long)part[i].index + 1,
                         (unsigned long)part[i].common.parts, path[k]);
  return count < part->common.parts ? report_missing(part, count, error)
                                    : RECTO_OK;
}

/* ---- Appending ----------------------------------------------------------- */

#define APPEND(to, from)                                                       \
  (ARRAY_RESERVE(to, (from)->count)                                            \
       ? ((from)->count > 0 ? memcpy((to)->item + (to)->count, (from)->item,   \
                                     (from)->count * sizeof *(from)->item)     \
                            : NULL,                                            \
          (to)->count += (from)->count, true)                                  \
       : false)

/* The merge of all parts. */
struct merge_work {
  struct part *all, *part;
  const char *const *path;
  size_t parts;
  struct merge_order order;
  bool is_whole; /* the current edge is visible all along, or else */
  struct interval_list visible,
      over_limit; /* where it is, and over the limit */
  struct interval_list scratch;
  recto_error *error;
};

static recto_status contradiction(const struct merge_work *work,
                                  struct origin at) {
  return error_set(work->error, RECTO_ERROR_FORMAT, work->path[at.part], 0,
                   "the part contradicts another part of the drawing");
}

static const struct part_point *part_point_at(const struct merge_work *work,
                                              struct origin at) {
  return &work->part[at.part].point.item[at.index];
}

static const struct part_edge *part_edge_at(const struct merge_work *work,
                                            struct origin at) {
  return &work->part[at.part].edge.item[at.index];
}

static const struct part_crossing *
part_crossing_at(const struct merge_work *work, struct origin at) {
  return &work->part[at.part].crossing.item[at.index];
}

/* Keys that order the items as the lists are. */
static uint64_t key_of_numbers(uint32_t high, uint32_t low) {
  return (uint64_t)high << 32 | low;
}

static uint64_t merge_key_of_point(const struct part *part, uint32_t index) {
  return part->point.item[index].number;
}

static uint64_t merge_key_of_face(const struct part *part, uint32_t index) {
  return part->face.item[index].number;
}

static uint64_t merge_key_of_wire(const struct part *part, uint32_t index) {
  return part->wire.item[index].number;
}

static uint64_t merge_key_of_edge(const struct part *part, uint32_t index) {
  return part_edge_key_number(part->edge.item[index].key);
}

static uint64_t merge_key_of_run(const struct part *part, uint32_t index) {
  const struct part_edge_run *run = &part->run.item[index];
  return key_of_numbers(run->face, run->place);
}

static uint64_t merge_key_of_fragment(const struct part *part, uint32_t index) {
  return part->fragment.item[index].face;
}

static int compare_crossing_origins(const void *a, const void *b, void *user) {
  return part_crossing_compare(
      part_crossing_at(user, *(const struct origin *)a),
      part_crossing_at(user, *(const struct origin *)b));
}

/* Frees a list of all parts. */
#define FREE_LISTS(work, list)                                                 \
  do {                                                                         \
    for (size_t p_ = 0; p_ < (work)->parts; p_++)                              \
      ARRAY_FREE(&(work)->part[p_].list);                                      \
  } while (0)

/* ---- Points and faces ---------------------------------------------------- */

static bool same_position_in_parts(const struct scene_point *a,
                                   const struct scene_point *b) {
  return a->x == b->x && a->y == b->y && a->z == b->z;
}

static recto_status merge_points(struct merge_work *work) {
  struct part *all = work->all;
  struct origin at;
  merge_order_begin(&work->order, MERGE_LIST(point), merge_key_of_point);
  if (!ARRAY_RESERVE(&all->point, merge_order_count(&work->order)))
    return error_memory(work->error);
  while (merge_order_next(&work->order, &at)) {
    const struct part_point *point = part_point_at(work, at);
    const struct part_point *last =
        all->point.count > 0 ? &all->point.item[all->point.count - 1] : NULL;
    if (last == NULL || last->number != point->number)
      all->point.item[all->point.count++] = *point;
    else if (!same_position_in_parts(&last->at, &point->at))
      return contradiction(work, at);
  }
  return RECTO_OK;
}

/* Whether two elements are the same.
 * p, q  what they are of: a is of the merged parts */
static bool same_element(const struct part *p, const struct part_element *a,
                         const struct part *q, const struct part_element *b,
                         bool wires) {
  return a->group == b->group && a->in_group == b->in_group &&
         a->count == b->count &&
         memcmp(p->corner.item + a->corner, q->corner.item + b->corner,
                a->count * sizeof *p->corner.item) == 0 &&
         a->uniform == b->uniform &&
         (wires || !q->common.has_tones ||
          memcmp(p->tone.item + a->corner, q->tone.item + b->corner,
                 a->count * sizeof *p->tone.item) == 0) &&
         (wires || !q->common.has_marks ||
          memcmp(p->mark.item + a->corner, q->mark.item + b->corner,
                 a->count) == 0);
}

/* The elements of a part: its faces, or its polylines. */
struct elements {
  const struct part_element *item;
  size_t count;
};

static struct elements elements_of(const struct part *part, bool wires) {
  if (wires)
    return (struct elements){part->wire.item, part->wire.count};
  return (struct elements){part->face.item, part->face.count};
}

/* Makes room for the elements of all parts. */
static bool have_room_for_elements(struct merge_work *work, bool wires) {
  struct part *all = work->all;
  size_t count = merge_order_count(&work->order), corners = 0, tones = 0,
         marks = 0;
  for (size_t p = 0; p < work->parts; p++) {
    corners += work->part[p].corner.count; /* of polylines too */
    tones += work->part[p].tone.count;
    marks += work->part[p].mark.count;
  }
  if (wires)
    return ARRAY_RESERVE(&all->wire, count);
  return ARRAY_RESERVE(&all->face, count) &&
         ARRAY_RESERVE(&all->corner, corners) &&
         ARRAY_RESERVE(&all->tone, tones) && ARRAY_RESERVE(&all->mark, marks);
}

static void add_merged_element(struct part *all, const struct part *from,
                               const struct part_element *element, bool wires) {
  struct part_element own = *element;
  own.corner = (uint32_t)all->corner.count;
  for (uint32_t i = 0; i < own.count; i++)
    all->corner.item[all->corner.count++] =
        from->corner.item[element->corner + i];
  for (uint32_t i = 0; !wires && from->common.has_tones && i < own.count; i++)
    all->tone.item[all->tone.count++] = from->tone.item[element->corner + i];
  for (uint32_t i = 0; !wires && from->common.has_marks && i < own.count; i++)
    all->mark.item[all->mark.count++] = from->mark.item[element->corner + i];
  if (wires)
    all->wire.item[all->wire.count++] = own;
  else
    all->face.item[all->face.count++] = own;
}

static recto_status merge_elements(struct merge_work *work, bool wires) {
  struct part *all = work->all;
  struct origin at;
  if (wires)
    merge_order_begin(&work->order, MERGE_LIST(wire), merge_key_of_wire);
  else
    merge_order_begin(&work->order, MERGE_LIST(face), merge_key_of_face);
  if (!have_room_for_elements(work, wires))
    return error_memory(work->error);
  while (merge_order_next(&work->order, &at)) {
    const struct part_element *element =
        &elements_of(&work->part[at.part], wires).item[at.index];
    struct elements before = elements_of(all, wires);
    const struct part_element *last =
        before.count > 0 ? &before.item[before.count - 1] : NULL;
    if (last != NULL && last->number == element->number) {
      if (!same_element(all, last, &work->part[at.part], element, wires))
        return contradiction(work, at);
    } else if (all->corner.count + element->count >= SCENE_LIMIT) {
      return error_set(work->error, RECTO_ERROR_LIMIT, NULL, 0,
                       "the parts have more than 2^31 corners");
    } else {
      add_merged_element(all, &work->part[at.part], element, wires);
    }
  }
  return RECTO_OK;
}

/* ---- Visible intervals --------------------------------------------------- */

static const struct map_interval whole_edge = {{0, 1}, {1, 1}};

/* Begins with an edge that is visible all along. */
static void start_visibility(struct merge_work *work) {
  work->is_whole = true;
  work->visible.count = work->over_limit.count = 0;
}

/* Leaves no more of what is visible than these intervals. */
static bool keep_visible(struct merge_work *work,
                         const struct map_interval *interval, size_t count) {
  bool ok = !work->is_whole || ARRAY_PUSH(&work->visible, whole_edge);
  work->is_whole = false;
  return ok && interval_list_intersect(&work->visible, interval, count,
                                       &work->scratch);
}

/* Removes what a part says to be hidden. */
static bool hide_by_part(struct merge_work *work, const struct part *part,
                         const struct part_visibility *visibility,
                         const struct part_over_limit *over) {
  if (visibility->state == MAP_HIDDEN) {
    work->is_whole = false;
    work->visible.count = 0;
  }
  return (visibility->state != MAP_MIXED ||
          keep_visible(work, part->interval.item + visibility->interval,
                       visibility->count)) &&
         (over->count == 0 ||
          interval_list_unite(&work->over_limit,
                              part->over_limit.item + over->interval,
                              over->count, &work->scratch));
}

/* Stores what is left. */
static bool finish_visibility(struct merge_work *work,
                              struct part_visibility *to,
                              struct part_over_limit *over) {
  struct part *all = work->all;
  *over = (struct part_over_limit){(uint32_t)all->over_limit.count,
                                   (uint32_t)work->over_limit.count};
  if (all->over_limit.count + work->over_limit.count >= UINT32_MAX ||
      !APPEND(&all->over_limit, &work->over_limit))
    return false;
  const struct map_interval *first = work->visible.item;
  bool is_whole =
      work->is_whole || (work->visible.count == 1 && first->t0.num == 0 &&
                         first->t1.num == first->t1.den);
  *to = (struct part_visibility){.interval = (uint32_t)all->interval.count};
  to->state = is_whole                   ? MAP_VISIBLE
              : work->visible.count == 0 ? MAP_HIDDEN
                                         : MAP_MIXED;
  if (to->state != MAP_MIXED)
    return true;
  to->count = (uint32_t)work->visible.count;
  return all->interval.count + work->visible.count < UINT32_MAX &&
         APPEND(&all->interval, &work->visible);
}

static recto_status merge_edges(struct merge_work *work) {
  struct part *all = work->all;
  struct origin at;
  merge_order_begin(&work->order, MERGE_LIST(edge), merge_key_of_edge);
  if (!ARRAY_RESERVE(&all->edge, merge_order_count(&work->order)))
    return error_memory(work->error);
  for (bool more = merge_order_next(&work->order, &at); more;) {
    struct part_edge edge = *part_edge_at(work, at);
    const struct part_edge *other = &edge;
    bool ok = true;
    start_visibility(work);
    do {
      if (other->edge_class != edge.edge_class)
        return contradiction(work, at);
      ok = hide_by_part(work, &work->part[at.part], &other->visibility,
                        &other->over_limit);
      more = merge_order_next(&work->order, &at);
      other = more ? part_edge_at(work, at) : NULL;
    } while (ok && more && part_edge_key_compare(edge.key, other->key) == 0);
    if (!ok || !finish_visibility(work, &edge.visibility, &edge.over_limit))
      return error_memory(work->error);
    all->edge.item[all->edge.count++] = edge;
    if (!poll_at(all->edge.count))
      return error_cancelled(work->error);
  }
  return RECTO_OK;
}

/* ---- Intersections ------------------------------------------------------- */

/* Narrows the interval from t0 to t1 to where a segment from p to q lies in
 * [low, high] along one axis; false where it does not. */
static bool clip_to_range(struct map_interval *range, int32_t p, int32_t q,
                          int32_t low, int32_t high) {
  if (p == q)
    return low <= p && p <= high;
  int64_t d = (int64_t)q - p, enter = (int64_t)(d > 0 ? low : high) - p,
          leave = (int64_t)(d > 0 ? high : low) - p;
  if (d < 0) {
    d = -d;
    enter = -enter;
    leave = -leave;
  }
  range->t0 = interval_greater(range->t0, ratio_of(enter, d));
  range->t1 = interval_lesser(range->t1, ratio_of(leave, d));
  return ratio_compare(range->t0, range->t1) < 0;
}

/* Makes a segment hidden inside of a window. */
static bool hide_in_window(struct merge_work *work,
                           const struct part_crossing *crossing,
                           const struct part_window *window) {
  struct geom_point p = crossing->end[0], q = crossing->end[1];
  struct map_interval hidden = whole_edge, rest[2];
  size_t count = 0;
  if (window->low[0] > window->high[0] ||
      !clip_to_range(&hidden, p.x, q.x, window->low[0], window->high[0]) ||
      !clip_to_range(&hidden, p.y, q.y, window->low[1], window->high[1]))
    return true;
  if (hidden.t0.num > 0)
    rest[count++] = (struct map_interval){whole_edge.t0, hidden.t0};
  if (hidden.t1.num < hidden.t1.den)
    rest[count++] = (struct map_interval){hidden.t1, whole_edge.t1};
  return keep_visible(work, rest, count);
}

/* Merges the intersections of a group of equal ones, and appends it.
 * lists  scratch, a byte a part */
static bool merge_crossing(struct merge_work *work, const struct origin *at,
                           size_t count, uint8_t *lists) {
  struct part_crossing own = *part_crossing_at(work, at[0]);
  bool ok = true;
  start_visibility(work);
  memset(lists, 0, work->parts);
  for (size_t i = 0; ok && i < count; i++) {
    const struct part_crossing *other = part_crossing_at(work, at[i]);
    lists[at[i].part] = 1;
    ok = hide_by_part(work, &work->part[at[i].part], &other->visibility,
                      &other->over_limit);
  }
  for (size_t p = 0; ok && p < work->parts; p++)
    ok = lists[p] || hide_in_window(work, &own, &work->part[p].window);
  return ok && finish_visibility(work, &own.visibility, &own.over_limit) &&
         ARRAY_PUSH(&work->all->crossing, own);
}

/* They are few, and have no key that fits into a number. */
static recto_status merge_crossings(struct merge_work *work) {
  ARRAY(struct origin) order = {.item = NULL};
  uint8_t *lists = mem_alloc(work->parts, 1);
  bool ok = lists != NULL;
  for (uint32_t p = 0; p < work->parts; p++)
    for (uint32_t i = 0; ok && i < work->part[p].crossing.count; i++)
      ok = ARRAY_PUSH(&order, ((struct origin){p, i}));
  ok = ok && sort_stable(order.item, order.count, sizeof *order.item,
                         compare_crossing_origins, work);
  for (size_t i = 0, next; ok && i < order.count && poll_at(i); i = next) {
    for (next = i + 1; next < order.count; next++)
      if (compare_crossing_origins(&order.item[i], &order.item[next], work) !=
          0)
        break;
    ok = merge_crossing(work, order.item + i, next - i, lists);
  }
  mem_free(lists);
  ARRAY_FREE(&order);
  return ok && !poll_is_cancelled() ? RECTO_OK : error_memory(work->error);
}

/* ---- Runs ---------------------------------------------------------------- */

/* Each edge is in a run of one part. */
static recto_status merge_runs(struct merge_work *work) {
  struct part *all = work->all;
  struct origin at;
  merge_order_begin(&work->order, MERGE_LIST(run), merge_key_of_run);
  if (!ARRAY_RESERVE(&all->run, merge_order_count(&work->order)))
    return error_memory(work->error);
  while (merge_order_next(&work->order, &at)) {
    const struct part_edge_run *run = &work->part[at.part].run.item[at.index];
    size_t before = all->run.count;
    if (before > 0 &&
        part_edge_run_compare(&all->run.item[before - 1], run) == 0)
      return contradiction(work, at);
    all->run.item[all->run.count++] = *run;
  }
  return RECTO_OK;
}

/* ---- Fragments ----------------------------------------------------------- */

/* Appends a fragment.
 * corner  where its corners begin in the part's list; moves on */
static bool take_fragment(struct part *all, const struct part *part,
                          uint32_t fragment, size_t *corner) {
  struct part_fragment own = part->fragment.item[fragment];
  const uint32_t *loop = part->loop.item + own.loop;
  own.loop = (uint32_t)all->loop.count;
  if (!ARRAY_PUSH(&all->fragment, own))
    return false;
  for (uint32_t l = 0; l < own.loops; l++) {
    if (!ARRAY_PUSH(&all->loop, loop[l]) ||
        !ARRAY_RESERVE(&all->fragment_corner, loop[l]))
      return false;
    memcpy(all->fragment_corner.item + all->fragment_corner.count,
           part->fragment_corner.item + *corner,
           loop[l] * sizeof *part->fragment_corner.item);
    all->fragment_corner.count += loop[l];
    *corner += loop[l];
  }
  return true;
}

/* Makes room for all fragments, so that no list is copied as it grows. */
static bool have_room_for_fragments(const struct merge_work *work) {
  struct part *all = work->all;
  size_t fragments = 0, loops = 0, corners = 0;
  for (size_t p = 0; p < work->parts; p++) {
    fragments += work->part[p].fragment.count;
    loops += work->part[p].loop.count;
    corners += work->part[p].fragment_corner.count;
  }
  return ARRAY_RESERVE(&all->fragment, fragments) &&
         ARRAY_RESERVE(&all->loop, loops) &&
         ARRAY_RESERVE(&all->fragment_corner, corners);
}

/* The fragments of a face come from one part, in its order. */
static recto_status merge_fragments(struct merge_work *work) {
  struct part *all = work->all;
  struct origin at;
  uint32_t last_part = 0;
  recto_status status = RECTO_OK;
  size_t *corner = mem_calloc(work->parts, sizeof *corner);
  bool ok = corner != NULL && have_room_for_fragments(work);
  merge_order_begin(&work->order, MERGE_LIST(fragment), merge_key_of_fragment);
  while (ok && status == RECTO_OK && merge_order_next(&work->order, &at)) {
    const struct part *part = &work->part[at.part];
    size_t before = all->fragment.count;
    if (before > 0 && at.part != last_part &&
        all->fragment.item[before - 1].face ==
            part->fragment.item[at.index].face)
      status = contradiction(work, at);
    else
      ok = take_fragment(all, part, at.index, &corner[at.part]) &&
           poll_at(before);
    last_part = at.part;
  }
  mem_free(corner);
  return ok && !poll_is_cancelled() ? status : error_memory(work->error);
}

/* ---- All ----------------------------------------------------------------- */

static recto_status merge_lists(struct merge_work *work) {
  recto_status status = merge_points(work);
  FREE_LISTS(work, point);
  if (status == RECTO_OK)
    status = merge_elements(work, false);
  if (status == RECTO_OK)
    status = merge_elements(work, true);
  if (status != RECTO_OK)
    return status;
  FREE_LISTS(work, face);
  FREE_LISTS(work, wire);
  FREE_LISTS(work, corner);
  FREE_LISTS(work, tone);
  FREE_LISTS(work, mark);
  status = merge_edges(work);
  FREE_LISTS(work, edge);
  if (status == RECTO_OK)
    status = merge_crossings(work);
  if (status == RECTO_OK)
    status = merge_runs(work);
  FREE_LISTS(work, crossing);
  FREE_LISTS(work, interval);
  FREE_LISTS(work, over_limit);
  FREE_LISTS(work, run);
  return status == RECTO_OK ? merge_fragments(work) : status;
}

recto_status part_merge(struct part *all, struct part *part,
                        const char *const *path, size_t count,
                        recto_error *error) {
  struct merge_work work = {
      .all = all, .part = part, .path = path, .parts = count, .error = error};
  recto_status status = merge_order_init(&work.order, part, count)
                            ? merge_lists(&work)
                            : error_memory(error);
  merge_order_fini(&work.order);
  ARRAY_FREE(&work.visible);
  ARRAY_FREE(&work.over_limit);
  ARRAY_FREE(&work.scratch);
  all->common = part->common;
  part->common = (struct part_common){.path = NULL};
  for (size_t i = 0; i < count; i++)
    part_fini(&part[i]);
  return status;
}
