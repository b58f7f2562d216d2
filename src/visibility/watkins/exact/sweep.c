/* sweep.c - the walk through the exact heights. */
#include "visibility/watkins/exact/sweep.h"

#include <string.h>

#include "visibility/progress.h"

#define PLACE_WORK 8 /* in units of a pulse */
#define FEW 16       /* edges at a place that are sorted by insertion */

/* ---- A place ------------------------------------------------------------- */

/* Takes the first of the places ahead; the edges that start there are
 * `starting`.  False: there is none, or memory ran out. */
static bool take_place(struct sweep *sweep, struct sweep_event *place,
                       bool *more) {
  bool at_end = sweep->met < sweep->ends;
  uint64_t key = at_end ? sweep->end[sweep->met].key : 0;
  sweep->starting.count = 0;
  *more = at_end || sweep->crossing.count > 0;
  if (!*more)
    return true;
  if (at_end) {
    *place = sweep_event_at(
        (int32_t)((int64_t)(key & ((UINT64_C(1) << 31) - 1)) - (1 << 30)),
        (int32_t)((1 << 30) - (int64_t)(key >> 31)));
    at_end = sweep->crossing.count == 0 ||
             sweep_event_compare(place, &sweep->crossing.item[0]) <= 0;
  }
  if (!at_end)
    *place = sweep->crossing.item[0];
  for (;
       at_end && sweep->met < sweep->ends && sweep->end[sweep->met].key == key;
       sweep->met++)
    if (sweep->end[sweep->met].value != SWEEP_NONE &&
        !ARRAY_PUSH(&sweep->starting, sweep->end[sweep->met].value))
      return false;
  while (sweep->crossing.count > 0 &&
         sweep_event_compare(place, &sweep->crossing.item[0]) == 0)
    sweep_drop_crossing(sweep);
  return true;
}

static bool reach_height(struct sweep *sweep, const struct sweep_event *place) {
  struct ratio height = {place->y, place->den};
  size_t count = sweep->height.count;
  return (count > 0 &&
          ratio_compare(sweep->height.item[count - 1], height) == 0) ||
         ARRAY_PUSH(&sweep->height, height);
}

/* The active edges through the place are [*low, *high). */
static void find_through(const struct sweep *sweep,
                         const struct sweep_event *place, size_t *low,
                         size_t *high) {
  const uint32_t *active = sweep->active.item;
  size_t past = sweep->active.count;
  *low = 0;
  for (*high = past; *low < *high;) {
    size_t middle = *low + (*high - *low) / 2;
    if (sweep_side(&sweep->edge.item[active[middle]], place) > 0)
      *low = middle + 1;
    else
      *high = middle;
  }
  while (*high < past &&
         sweep_side(&sweep->edge.item[active[*high]], place) == 0)
    (*high)++;
}

/* The interval after the active edge of that rank ends at this height. */
static bool close_interval(struct sweep *sweep, size_t rank) {
  uint32_t left = sweep->active.item[rank];
  const struct sweep_edge *edge = &sweep->edge.item[left];
  struct sweep_cell cell = {.left = left,
                            .top = edge->top,
                            .bottom = (uint32_t)sweep->height.count - 1,
                            .in = edge->in.item,
                            .count = edge->in.count};
  if (sweep->cell == NULL || cell.count == 0 || cell.top == cell.bottom)
    return true;
  cell.right = sweep->active.item[rank + 1];
  return sweep_same_line(edge, &sweep->edge.item[cell.right]) ||
         sweep->cell(sweep->user, sweep, &cell);
}

static int compare_out(const void *a, const void *b, void *user) {
  const struct sweep *sweep = user;
  uint32_t p = *(const uint32_t *)a, q = *(const uint32_t *)b;
  int turn = sweep_turn(&sweep->edge.item[p], &sweep->edge.item[q]);
  return turn != 0 ? -turn : (p > q) - (p < q);
}

/* Lists in `out` the edges that leave the place, from the left. */
static bool list_out(struct sweep *sweep, const struct sweep_event *place,
                     size_t low, size_t high) {
  sweep_list *out = &sweep->out;
  out->count = 0;
  if (!ARRAY_RESERVE(out, high - low + sweep->starting.count))
    return false;
  for (size_t i = low; i < high; i++) {
    uint32_t e = sweep->active.item[i];
    struct sweep_edge *edge = &sweep->edge.item[e];
    if (place->den != 1 || edge->x1 != place->x || edge->y1 != place->y) {
      out->item[out->count++] = e;
      continue;
    }
    sweep->in -= edge->in.count;
    ARRAY_FREE(&edge->in);
  }
  for (size_t i = 0; i < sweep->starting.count; i++)
    out->item[out->count++] = sweep->starting.item[i];
  if (out->count > FEW)
    return sort_stable(out->item, out->count, sizeof *out->item, compare_out,
                       sweep);
  for (size_t i = 1; i < out->count; i++) {
    uint32_t moving = out->item[i];
    size_t hole = i;
    for (; hole > 0 && compare_out(&out->item[hole - 1], &moving, sweep) > 0;
         hole--)
      out->item[hole] = out->item[hole - 1];
    out->item[hole] = moving;
  }
  return true;
}

/* Puts `out` in the place of active[low..high). */
static bool replace_active(struct sweep *sweep, size_t low, size_t high) {
  sweep_list *active = &sweep->active;
  size_t out = sweep->out.count;
  if (!ARRAY_RESERVE(active, out))
    return false;
  memmove(active->item + low + out, active->item + high,
          (active->count - high) * sizeof *active->item);
  if (out > 0)
    memcpy(active->item + low, sweep->out.item, out * sizeof *active->item);
  active->count = active->count - (high - low) + out;
  return true;
}

/* Finds the triangles that are in after the active edge of that rank, from
 * those before it: those that are in just one of two ascending lists, for the
 * triangles of an edge begin or end there. */
static bool set_in(struct sweep *sweep, size_t rank) {
  struct sweep_edge *edge = &sweep->edge.item[sweep->active.item[rank]];
  const sweep_list *before =
      rank > 0 ? &sweep->edge.item[sweep->active.item[rank - 1]].in : NULL;
  size_t i = 0, k = 0, n = before != NULL ? before->count : 0, in = 0;
  sweep->in -= edge->in.count;
  edge->in.count = 0;
  if (!ARRAY_RESERVE(&edge->in, n + edge->toggles))
    return false;
  while (i < n && k < edge->toggles) {
    uint32_t old = before->item[i],
             toggle = sweep->toggle.item[edge->toggle + k];
    if (old != toggle)
      edge->in.item[in++] = old < toggle ? old : toggle;
    i += old <= toggle;
    k += toggle <= old;
  }
  for (; i < n; i++)
    edge->in.item[in++] = before->item[i];
  for (; k < edge->toggles; k++)
    edge->in.item[in++] = sweep->toggle.item[edge->toggle + k];
  edge->in.count = in;
  sweep->in += in;
  return true;
}

static bool watch_neighbours(struct sweep *sweep, size_t left) {
  const struct sweep_edge *edge = sweep->edge.item;
  struct sweep_event place;
  if (left + 1 >= sweep->active.count ||
      !sweep_crossing(&edge[sweep->active.item[left]],
                      &edge[sweep->active.item[left + 1]], &place))
    return true;
  sweep->crossings++;
  return sweep_add_crossing(sweep, &place);
}

/* ---- What may hide a line ------------------------------------------------ */

/* Adds the triangles that begin or end at some of the edges to `around`. */
static bool list_around(struct sweep *sweep, const uint32_t *edge,
                        size_t count) {
  for (size_t i = 0; i < count; i++) {
    const struct sweep_edge *at = &sweep->edge.item[edge[i]];
    for (uint32_t k = 0; k < at->toggles; k++)
      if (!ARRAY_PUSH(&sweep->around, sweep->toggle.item[at->toggle + k]))
        return false;
  }
  return true;
}

static bool meet_all(struct sweep *sweep, uint32_t edge,
                     const sweep_list *list) {
  for (size_t i = 0; i < list->count; i++)
    if (!sweep->meet(sweep->user, sweep, edge, list->item[i]))
      return false;
  return true;
}

/* Lines that leave the place meet the triangles that end at it; those that
 * start there also the ones that are in beside it. */
static bool meet_triangles(struct sweep *sweep, size_t low) {
  for (size_t i = 0; i < sweep->out.count; i++) {
    uint32_t e = sweep->out.item[i];
    if (sweep->edge.item[e].side != SHEET_NONE &&
        !meet_all(sweep, e, &sweep->around))
      return false;
  }
  for (size_t i = 0; low > 0 && i < sweep->starting.count; i++) {
    uint32_t e = sweep->starting.item[i];
    if (sweep->edge.item[e].side != SHEET_NONE &&
        !meet_all(sweep, e, &sweep->edge.item[sweep->active.item[low - 1]].in))
      return false;
  }
  return true;
}

/* ---- The walk ------------------------------------------------------------ */

static bool pass_place(struct sweep *sweep, const struct sweep_event *place,
                       struct progress *progress) {
  size_t low, high, past;
  uint32_t height;
  if (!reach_height(sweep, place))
    return false;
  find_through(sweep, place, &low, &high);
  for (size_t i = low > 0 ? low - 1 : low; i < high; i++)
    if (!close_interval(sweep, i))
      return false;
  sweep->around.count = 0;
  if ((sweep->meet != NULL &&
       !list_around(sweep, ARRAY_AT(&sweep->active, low), high - low)) ||
      !list_out(sweep, place, low, high) ||
      (sweep->meet != NULL &&
       !list_around(sweep, sweep->starting.item, sweep->starting.count)) ||
      !replace_active(sweep, low, high))
    return false;
  past = low + sweep->out.count;
  height = (uint32_t)sweep->height.count - 1;
  for (size_t i = low; i < past; i++)
    if (!set_in(sweep, i) ||
        !progress_step(progress,
                       sweep->edge.item[sweep->active.item[i]].in.count))
      return false;
  for (size_t i = low > 0 ? low - 1 : low; i < past; i++)
    sweep->edge.item[sweep->active.item[i]].top = height;
  if ((low > 0 && !watch_neighbours(sweep, low - 1)) ||
      (past > low && !watch_neighbours(sweep, past - 1)))
    return false;
  return sweep->meet == NULL || meet_triangles(sweep, low);
}

static recto_status refuse(const struct sweep *sweep, recto_error *error) {
  if (sweep->in > sweep->most_in)
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "too much for watkins without a pitch: more than %zu "
                     "faces over each other, counted in every interval; "
                     "-m auto has no such limit",
                     sweep->most_in);
  return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                   "too much for watkins without a pitch: edges end or cross "
                   "in more than %zu places; -m auto has no such limit",
                   sweep->most_places);
}

recto_status sweep_run(struct sweep *sweep,
                       const struct solver_request *request, double from,
                       double to, recto_error *error) {
  struct progress progress = progress_of(request, "visibility");
  for (;;) {
    struct sweep_event place;
    bool more;
    if (!take_place(sweep, &place, &more))
      return error_memory(error);
    if (!more)
      return RECTO_OK;
    if (!progress_step(&progress, PLACE_WORK) ||
        !pass_place(sweep, &place, &progress))
      return progress_error(&progress, error);
    sweep->places++;
    if (sweep->places > sweep->most_places || sweep->in > sweep->most_in)
      return refuse(sweep, error);
    progress.share =
        from + (to - from) * (double)sweep->met / (double)sweep->ends;
  }
}
