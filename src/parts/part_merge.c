/* part_merge.c - all parts of a drawing as one.
 *
 * Each list of a part is ascending, so the lists of all parts are appended to
 * each other, sorted, and then gone through by groups of equal items.  What is
 * merged is freed before the next list. */
#include "parts/part_merge.h"

#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "parts/interval_lists.h"
#include "scene/limit.h"

/* ---- Is it one drawing? -------------------------------------------------- */

static bool is_same_drawing(const struct part_common *a,
                            const struct part_common *b) {
  return a->id == b->id && a->parts == b->parts && a->edges == b->edges &&
         a->has_fragments == b->has_fragments &&
         a->has_hidden == b->has_hidden &&
         a->hidden_by_max == b->hidden_by_max && a->has_ids == b->has_ids &&
         a->has_tones == b->has_tones && a->group.count == b->group.count;
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

/* What an item of a sorted list came from. */
struct origin {
  uint32_t part, index;
};

typedef ARRAY(struct origin) origin_list;

/* The merge of all parts, and the comparison that sorts the current list. */
struct merge_work {
  struct part *all, *part;
  const char *const *path;
  size_t parts;
  origin_list order;
  struct interval_list visible, over_limit; /* of the current edge */
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

static const struct part_edge_run *part_run_at(const struct merge_work *work,
                                               struct origin at) {
  return &work->part[at.part].run.item[at.index];
}

static int compare_point_origins(const void *a, const void *b, void *user) {
  return compare_numbers(
      part_point_at(user, *(const struct origin *)a)->number,
      part_point_at(user, *(const struct origin *)b)->number);
}

static int compare_edge_origins(const void *a, const void *b, void *user) {
  return part_edge_key_compare(
      part_edge_at(user, *(const struct origin *)a)->key,
      part_edge_at(user, *(const struct origin *)b)->key);
}

static int compare_crossing_origins(const void *a, const void *b, void *user) {
  return part_crossing_compare(
      part_crossing_at(user, *(const struct origin *)a),
      part_crossing_at(user, *(const struct origin *)b));
}

static int compare_run_origins(const void *a, const void *b, void *user) {
  return part_edge_run_compare(part_run_at(user, *(const struct origin *)a),
                               part_run_at(user, *(const struct origin *)b));
}

/* Lists the items of all parts, in order.
 * count  of those of each part: set by the caller */
static bool sort_origins(struct merge_work *work, const size_t *count,
                         int (*compare)(const void *, const void *, void *)) {
  work->order.count = 0;
  for (uint32_t p = 0; p < work->parts; p++)
    for (uint32_t i = 0; i < count[p]; i++)
      if (!ARRAY_PUSH(&work->order, ((struct origin){p, i})))
        return false;
  return sort_stable(work->order.item, work->order.count,
                     sizeof *work->order.item, compare, work) &&
         !poll_is_cancelled();
}

#define SORT_LIST(work, list, compare)                                         \
  (list_counts((work), count, offsetof(struct part, list.count)),              \
   sort_origins((work), count, (compare)))

/* Frees a list of all parts. */
#define FREE_LISTS(work, list)                                                 \
  do {                                                                         \
    for (size_t p_ = 0; p_ < (work)->parts; p_++)                              \
      ARRAY_FREE(&(work)->part[p_].list);                                      \
  } while (0)

static void list_counts(const struct merge_work *work, size_t *count,
                        size_t offset) {
  for (size_t p = 0; p < work->parts; p++)
    memcpy(&count[p], (const char *)&work->part[p] + offset, sizeof *count);
}

/* ---- Points and faces ---------------------------------------------------- */

static bool same_position_in_parts(const struct scene_point *a,
                                   const struct scene_point *b) {
  return a->x == b->x && a->y == b->y && a->z == b->z;
}

static recto_status merge_points(struct merge_work *work) {
  struct part *all = work->all;
  for (size_t i = 0; i < work->order.count; i++) {
    const struct part_point *point = part_point_at(work, work->order.item[i]);
    const struct part_point *last =
        all->point.count > 0 ? &all->point.item[all->point.count - 1] : NULL;
    if (last == NULL || last->number != point->number) {
      if (!ARRAY_PUSH(&all->point, *point))
        return error_memory(work->error);
    } else if (!same_position_in_parts(&last->at, &point->at)) {
      return contradiction(work, work->order.item[i]);
    }
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
                 a->count * sizeof *p->tone.item) == 0);
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

struct element_order {
  const struct merge_work *work;
  bool wires;
};

static const struct part_element *
part_element_at(const struct element_order *order, struct origin at) {
  return &elements_of(&order->work->part[at.part], order->wires).item[at.index];
}

static int compare_element_origins(const void *a, const void *b, void *user) {
  return compare_numbers(
      part_element_at(user, *(const struct origin *)a)->number,
      part_element_at(user, *(const struct origin *)b)->number);
}

static bool add_merged_element(struct part *all, const struct part *from,
                               const struct part_element *element, bool wires) {
  struct part_element own = *element;
  own.corner = (uint32_t)all->corner.count;
  for (uint32_t i = 0; i < own.count; i++)
    if (!ARRAY_PUSH(&all->corner, from->corner.item[element->corner + i]) ||
        (!wires && from->common.has_tones &&
         !ARRAY_PUSH(&all->tone, from->tone.item[element->corner + i])))
      return false;
  return wires ? ARRAY_PUSH(&all->wire, own) : ARRAY_PUSH(&all->face, own);
}

static recto_status merge_elements(struct merge_work *work, bool wires) {
  struct part *all = work->all;
  struct element_order order = {work, wires};
  work->order.count = 0;
  for (uint32_t p = 0; p < work->parts; p++)
    for (uint32_t i = 0; i < elements_of(&work->part[p], wires).count; i++)
      if (!ARRAY_PUSH(&work->order, ((struct origin){p, i})))
        return error_memory(work->error);
  if (!sort_stable(work->order.item, work->order.count,
                   sizeof *work->order.item, compare_element_origins, &order))
    return error_memory(work->error);
  for (size_t i = 0; i < work->order.count; i++) {
    struct origin at = work->order.item[i];
    const struct part_element *element = part_element_at(&order, at);
    struct elements before = elements_of(all, wires);
    const struct part_element *last =
        before.count > 0 ? &before.item[before.count - 1] : NULL;
    if (last != NULL && last->number == element->number) {
      if (!same_element(all, last, &work->part[at.part], element, wires))
        return contradiction(work, at);
    } else if (all->corner.count + element->count >= SCENE_LIMIT) {
      return error_set(work->error, RECTO_ERROR_LIMIT, NULL, 0,
                       "the parts have more than 2^31 corners");
    } else if (!add_merged_element(all, &work->part[at.part], element, wires)) {
      return error_memory(work->error);
    }
  }
  return RECTO_OK;
}

/* ---- Visible intervals --------------------------------------------------- */

static const struct map_interval whole_edge = {{0, 1}, {1, 1}};

/* Begins with an edge that is visible all along. */
static bool start_visibility(struct merge_work *work) {
  work->visible.count = work->over_limit.count = 0;
  return ARRAY_PUSH(&work->visible, whole_edge);
}

/* Removes what a part says to be hidden. */
static bool hide_by_part(struct merge_work *work, const struct part *part,
                         const struct part_visibility *visibility,
                         const struct part_over_limit *over) {
  if (visibility->state == MAP_HIDDEN)
    work->visible.count = 0;
  return (visibility->state != MAP_MIXED ||
          interval_list_intersect(&work->visible,
                                  part->interval.item + visibility->interval,
                                  visibility->count, &work->scratch)) &&
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
  bool is_whole = work->visible.count == 1 && first->t0.num == 0 &&
                  first->t1.num == first->t1.den;
  *to = (struct part_visibility){.interval = (uint32_t)all->interval.count};
  to->state = work->visible.count == 0 ? MAP_HIDDEN
              : is_whole               ? MAP_VISIBLE
                                       : MAP_MIXED;
  if (to->state != MAP_MIXED)
    return true;
  to->count = (uint32_t)work->visible.count;
  return all->interval.count + work->visible.count < UINT32_MAX &&
         APPEND(&all->interval, &work->visible);
}

static recto_status merge_edges(struct merge_work *work) {
  struct part *all = work->all;
  for (size_t i = 0, next; i < work->order.count; i = next) {
    struct part_edge edge = *part_edge_at(work, work->order.item[i]);
    bool ok = start_visibility(work);
    for (next = i; ok && next < work->order.count; next++) {
      struct origin at = work->order.item[next];
      const struct part_edge *other = part_edge_at(work, at);
      if (part_edge_key_compare(edge.key, other->key) != 0)
        break;
      if (other->edge_class != edge.edge_class)
        return contradiction(work, at);
      ok = hide_by_part(work, &work->part[at.part], &other->visibility,
                        &other->over_limit);
    }
    if (!ok || !finish_visibility(work, &edge.visibility, &edge.over_limit) ||
        !ARRAY_PUSH(&all->edge, edge))
      return error_memory(work->error);
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
  return interval_list_intersect(&work->visible, rest, count, &work->scratch);
}

static recto_status merge_crossings(struct merge_work *work) {
  struct part *all = work->all;
  recto_status status = RECTO_OK;
  uint8_t *lists = mem_alloc(work->parts, 1);
  for (size_t i = 0, next; lists != NULL && i < work->order.count; i = next) {
    struct part_crossing own = *part_crossing_at(work, work->order.item[i]);
    bool ok = start_visibility(work);
    memset(lists, 0, work->parts);
    for (next = i; ok && next < work->order.count; next++) {
      struct origin at = work->order.item[next];
      const struct part_crossing *other = part_crossing_at(work, at);
      if (part_crossing_compare(&own, other) != 0)
        break;
      lists[at.part] = 1;
      ok = hide_by_part(work, &work->part[at.part], &other->visibility,
                        &other->over_limit);
    }
    for (size_t p = 0; ok && p < work->parts; p++)
      ok = lists[p] || hide_in_window(work, &own, &work->part[p].window);
    if (!ok || !finish_visibility(work, &own.visibility, &own.over_limit) ||
        !ARRAY_PUSH(&all->crossing, own)) {
      status = error_memory(work->error);
      break;
    }
  }
  if (lists == NULL)
    status = error_memory(work->error);
  mem_free(lists);
  return status;
}

/* ---- Runs ---------------------------------------------------------------- */

/* Each edge is in a run of one part. */
static recto_status merge_runs(struct merge_work *work) {
  struct part *all = work->all;
  if (!ARRAY_RESERVE(&all->run, work->order.count))
    return error_memory(work->error);
  for (size_t i = 0; i < work->order.count; i++) {
    const struct part_edge_run *run = part_run_at(work, work->order.item[i]);
    if (i > 0 && part_edge_run_compare(&all->run.item[i - 1], run) == 0)
      return contradiction(work, work->order.item[i]);
    all->run.item[all->run.count++] = *run;
  }
  return RECTO_OK;
}

/* ---- Fragments ----------------------------------------------------------- */

/* Where the current fragment of a part begins in its lists. */
struct fragment_reader {
  size_t fragment, corner;
};

static bool take_fragment(struct merge_work *work, const struct part *part,
                          struct fragment_reader *reader) {
  struct part *all = work->all;
  struct part_fragment own = part->fragment.item[reader->fragment++];
  const uint32_t *loop = part->loop.item + own.loop;
  own.loop = (uint32_t)all->loop.count;
  if (!ARRAY_PUSH(&all->fragment, own))
    return false;
  for (uint32_t l = 0; l < own.loops; l++) {
    if (!ARRAY_PUSH(&all->loop, loop[l]))
      return false;
    for (uint32_t k = 0; k < loop[l]; k++)
      if (!ARRAY_PUSH(&all->fragment_corner,
                      part->fragment_corner.item[reader->corner++]))
        return false;
  }
  return true;
}

struct face_origin {
  uint32_t face, part;
};

static int compare_face_origins(const void *a, const void *b, void *user) {
  (void)user;
  return compare_numbers(((const struct face_origin *)a)->face,
                         ((const struct face_origin *)b)->face);
}

/* The fragments of a face come from one part, in its order. */
static recto_status merge_fragments(struct merge_work *work) {
  ARRAY(struct face_origin) order = {.item = NULL};
  struct fragment_reader *reader = mem_calloc(work->parts, sizeof *reader);
  recto_status status = RECTO_OK;
  bool ok = reader != NULL;
  for (uint32_t p = 0; p < work->parts; p++)
    for (size_t i = 0; ok && i < work->part[p].fragment.count; i++)
      ok = ARRAY_PUSH(&order, ((struct face_origin){
                                  work->part[p].fragment.item[i].face, p}));
  ok = ok && sort_stable(order.item, order.count, sizeof *order.item,
                         compare_face_origins, NULL);
  for (size_t i = 0; ok && status == RECTO_OK && i < order.count; i++) {
    uint32_t p = order.item[i].part;
    if (i > 0 && order.item[i].face == order.item[i - 1].face &&
        p != order.item[i - 1].part)
      status = contradiction(work, (struct origin){p, 0});
    else
      ok = take_fragment(work, &work->part[p], &reader[p]);
  }
  mem_free(reader);
  ARRAY_FREE(&order);
  return ok ? status : error_memory(work->error);
}

/* ---- All ----------------------------------------------------------------- */

static recto_status merge_lists(struct merge_work *work, size_t *count) {
  recto_status status = RECTO_OK;
  if (!SORT_LIST(work, point, compare_point_origins))
    return error_memory(work->error);
  status = merge_points(work);
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
  if (!SORT_LIST(work, edge, compare_edge_origins))
    return error_memory(work->error);
  status = merge_edges(work);
  FREE_LISTS(work, edge);
  if (status != RECTO_OK)
    return status;
  if (!SORT_LIST(work, crossing, compare_crossing_origins))
    return error_memory(work->error);
  status = merge_crossings(work);
  if (status == RECTO_OK && !SORT_LIST(work, run, compare_run_origins))
    return error_memory(work->error);
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
  size_t *counts = mem_alloc(count, sizeof *counts);
  recto_status status =
      counts != NULL ? merge_lists(&work, counts) : error_memory(error);
  mem_free(counts);
  ARRAY_FREE(&work.order);
  ARRAY_FREE(&work.visible);
  ARRAY_FREE(&work.over_limit);
  ARRAY_FREE(&work.scratch);
  all->common = part->common;
  part->common = (struct part_common){.path = NULL};
  for (size_t i = 0; i < count; i++)
    part_fini(&part[i]);
  return status;
}
