/* sweep.c - the plane sweep over the exact heights. */
#include "visibility/watkins/exact/sweep.h"

#include <string.h>

#include "base/sort.h"
#include "visibility/progress.h"

#define EVENT_WORK 8          /* of an event, in the units of progress.h */
#define INSERTION_SORT_MAX 16 /* edges; more are sorted by merging */

/* ---- One event ----------------------------------------------------------- */

/* Removes the next event from the queue, and lists the edges that start there
 * in `starting`.
 * more  gets whether there was one
 * Returns false when memory ran out. */
static bool pop_event(struct sweep *sweep, struct sweep_event *event,
                      bool *more) {
  bool at_end = sweep->ends_passed < sweep->ends;
  uint64_t key = at_end ? sweep->end[sweep->ends_passed].key : 0;
  sweep->starting.count = 0;
  *more = at_end || sweep->crossing.count > 0;
  if (!*more)
    return true;
  if (at_end) {
    *event = sweep_event_at(
        (int32_t)((int64_t)(key & ((UINT64_C(1) << 31) - 1)) - (1 << 30)),
        (int32_t)((1 << 30) - (int64_t)(key >> 31)));
    at_end = sweep->crossing.count == 0 ||
             sweep_event_compare(event, &sweep->crossing.item[0]) <= 0;
  }
  if (!at_end)
    *event = sweep->crossing.item[0];
  for (; at_end && sweep->ends_passed < sweep->ends &&
         sweep->end[sweep->ends_passed].key == key;
       sweep->ends_passed++)
    if (sweep->end[sweep->ends_passed].value != SWEEP_NONE &&
        !ARRAY_PUSH(&sweep->starting, sweep->end[sweep->ends_passed].value))
      return false;
  while (sweep->crossing.count > 0 &&
         sweep_event_compare(event, &sweep->crossing.item[0]) == 0)
    sweep_drop_crossing(sweep);
  return true;
}

/* Appends the event's height, unless it is that of the event before. */
static bool advance_to_height(struct sweep *sweep,
                              const struct sweep_event *event) {
  struct ratio height = {event->y, event->den};
  size_t count = sweep->height.count;
  return (count > 0 &&
          ratio_compare(sweep->height.item[count - 1], height) == 0) ||
         ARRAY_PUSH(&sweep->height, height);
}

/* Finds the active edges through the event: [*low, *high). */
static void find_edges_through(const struct sweep *sweep,
                               const struct sweep_event *event, size_t *low,
                               size_t *high) {
  const uint32_t *active = sweep->active.item;
  size_t i, past = sweep->active.count;
  LOWER_BOUND(i, 0, past, sweep_side(&sweep->edge.item[active[i]], event) > 0);
  *low = i;
  while (i < past && sweep_side(&sweep->edge.item[active[i]], event) == 0)
    i++;
  *high = i;
}

/* Ends the interval after the active edge of that rank at the current height,
 * and reports its trapezoid. */
static bool close_interval(struct sweep *sweep, size_t rank) {
  uint32_t left = sweep->active.item[rank];
  const struct sweep_edge *edge = &sweep->edge.item[left];
  struct sweep_trapezoid trapezoid = {.left = left,
                                      .top = edge->top,
                                      .bottom =
                                          (uint32_t)sweep->height.count - 1,
                                      .covering = edge->covering.item,
                                      .count = edge->covering.count};
  if (sweep->on_trapezoid == NULL || trapezoid.count == 0 ||
      trapezoid.top == trapezoid.bottom)
    return true;
  trapezoid.right = sweep->active.item[rank + 1];
  return sweep_same_line(edge, &sweep->edge.item[trapezoid.right]) ||
         sweep->on_trapezoid(sweep->user, sweep, &trapezoid);
}

static int compare_outgoing(const void *a, const void *b, void *user) {
  const struct sweep *sweep = user;
  uint32_t p = *(const uint32_t *)a, q = *(const uint32_t *)b;
  int turn = sweep_turn(&sweep->edge.item[p], &sweep->edge.item[q]);
  return turn != 0 ? -turn : (p > q) - (p < q);
}

/* Lists the edges that leave the event in `outgoing`, from the left. */
static bool list_outgoing(struct sweep *sweep, const struct sweep_event *event,
                          size_t low, size_t high) {
  sweep_list *out = &sweep->outgoing;
  out->count = 0;
  if (!ARRAY_RESERVE(out, high - low + sweep->starting.count))
    return false;
  for (size_t i = low; i < high; i++) {
    uint32_t e = sweep->active.item[i];
    struct sweep_edge *edge = &sweep->edge.item[e];
    if (event->den != 1 || edge->x1 != event->x || edge->y1 != event->y) {
      out->item[out->count++] = e;
      continue;
    }
    sweep->covering_total -= edge->covering.count;
    ARRAY_FREE(&edge->covering);
  }
  for (size_t i = 0; i < sweep->starting.count; i++)
    out->item[out->count++] = sweep->starting.item[i];
  if (out->count > INSERTION_SORT_MAX)
    return sort_stable(out->item, out->count, sizeof *out->item,
                       compare_outgoing, sweep);
  for (size_t i = 1; i < out->count; i++) {
    uint32_t moving = out->item[i];
    size_t hole = i;
    for (;
         hole > 0 && compare_outgoing(&out->item[hole - 1], &moving, sweep) > 0;
         hole--)
      out->item[hole] = out->item[hole - 1];
    out->item[hole] = moving;
  }
  return true;
}

/* Replaces active[low..high) by `outgoing`. */
static bool replace_active(struct sweep *sweep, size_t low, size_t high) {
  sweep_list *active = &sweep->active;
  size_t out = sweep->outgoing.count;
  if (!ARRAY_RESERVE(active, out))
    return false;
  memmove(active->item + low + out, active->item + high,
          (active->count - high) * sizeof *active->item);
  if (out > 0)
    memcpy(active->item + low, sweep->outgoing.item,
           out * sizeof *active->item);
  active->count = active->count - (high - low) + out;
  return true;
}

/* Finds the triangles that cover the interval after the active edge of that
 * rank: the symmetric difference of those before it and those that the edge
 * bounds, two ascending lists, for each of the latter begins or ends there. */
static bool find_covering(struct sweep *sweep, size_t rank) {
  struct sweep_edge *edge = &sweep->edge.item[sweep->active.item[rank]];
  const sweep_list *before =
      rank > 0 ? &sweep->edge.item[sweep->active.item[rank - 1]].covering
               : NULL;
  size_t i = 0, k = 0, n = before != NULL ? before->count : 0, all = 0;
  sweep->covering_total -= edge->covering.count;
  edge->covering.count = 0;
  if (!ARRAY_RESERVE(&edge->covering, n + edge->bounded_count))
    return false;
  while (i < n && k < edge->bounded_count) {
    uint32_t old = before->item[i],
             side = sweep->bounded.item[edge->bounded + k];
    if (old != side)
      edge->covering.item[all++] = old < side ? old : side;
    i += old <= side;
    k += side <= old;
  }
  for (; i < n; i++)
    edge->covering.item[all++] = before->item[i];
  for (; k < edge->bounded_count; k++)
    edge->covering.item[all++] = sweep->bounded.item[edge->bounded + k];
  edge->covering.count = all;
  sweep->covering_total += all;
  return true;
}

/* Adds the crossing, if any, of the active edges of ranks left and left + 1. */
static bool add_crossing_of_neighbours(struct sweep *sweep, size_t left) {
  const struct sweep_edge *edge = sweep->edge.item;
  struct sweep_event event;
  if (left + 1 >= sweep->active.count ||
      !sweep_crossing(&edge[sweep->active.item[left]],
                      &edge[sweep->active.item[left + 1]], &event))
    return true;
  sweep->crossings++;
  return sweep_add_crossing(sweep, &event);
}

/* ---- Triangles that may occlude an edge ---------------------------------- */

/* Appends the triangles that the edges bound to `incident`. */
static bool list_incident(struct sweep *sweep, const uint32_t *edge,
                          size_t count) {
  for (size_t i = 0; i < count; i++) {
    const struct sweep_edge *at = &sweep->edge.item[edge[i]];
    for (uint32_t k = 0; k < at->bounded_count; k++)
      if (!ARRAY_PUSH(&sweep->incident, sweep->bounded.item[at->bounded + k]))
        return false;
  }
  return true;
}

static bool report_pairs(struct sweep *sweep, uint32_t edge,
                         const sweep_list *list) {
  for (size_t i = 0; i < list->count; i++)
    if (!sweep->on_pair(sweep->user, sweep, edge, list->item[i]))
      return false;
  return true;
}

/* Reports the pairs of the event.  Drawn edges that leave it are paired with
 * the triangles incident to it; those that start at it also with the triangles
 * that cover the interval to its left. */
static bool report_occluders(struct sweep *sweep, size_t low) {
  for (size_t i = 0; i < sweep->outgoing.count; i++) {
    uint32_t e = sweep->outgoing.item[i];
    if (sweep->edge.item[e].side != SHEET_NONE &&
        !report_pairs(sweep, e, &sweep->incident))
      return false;
  }
  for (size_t i = 0; low > 0 && i < sweep->starting.count; i++) {
    uint32_t e = sweep->starting.item[i];
    if (sweep->edge.item[e].side != SHEET_NONE &&
        !report_pairs(sweep, e,
                      &sweep->edge.item[sweep->active.item[low - 1]].covering))
      return false;
  }
  return true;
}

/* ---- The sweep ----------------------------------------------------------- */

static bool process_event(struct sweep *sweep, const struct sweep_event *event,
                          struct progress *progress) {
  size_t low, high, past;
  uint32_t height;
  if (!advance_to_height(sweep, event))
    return false;
  find_edges_through(sweep, event, &low, &high);
  for (size_t i = low > 0 ? low - 1 : low; i < high; i++)
    if (!close_interval(sweep, i))
      return false;
  sweep->incident.count = 0;
  if ((sweep->on_pair != NULL &&
       !list_incident(sweep, ARRAY_AT(&sweep->active, low), high - low)) ||
      !list_outgoing(sweep, event, low, high) ||
      (sweep->on_pair != NULL &&
       !list_incident(sweep, sweep->starting.item, sweep->starting.count)) ||
      !replace_active(sweep, low, high))
    return false;
  past = low + sweep->outgoing.count;
  height = (uint32_t)sweep->height.count - 1;
  for (size_t i = low; i < past; i++)
    if (!find_covering(sweep, i) ||
        !progress_step(progress,
                       sweep->edge.item[sweep->active.item[i]].covering.count))
      return false;
  for (size_t i = low > 0 ? low - 1 : low; i < past; i++)
    sweep->edge.item[sweep->active.item[i]].top = height;
  if ((low > 0 && !add_crossing_of_neighbours(sweep, low - 1)) ||
      (past > low && !add_crossing_of_neighbours(sweep, past - 1)))
    return false;
  return sweep->on_pair == NULL || report_occluders(sweep, low);
}

static recto_status limit_error(const struct sweep *sweep, recto_error *error) {
  if (sweep->covering_total > sweep->covering_max)
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "too much for watkins without a pitch: more than %zu "
                     "faces over each other, counted in every interval; "
                     "-m auto has no such limit",
                     sweep->covering_max);
  return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                   "too much for watkins without a pitch: edges end or cross "
                   "in more than %zu places; -m auto has no such limit",
                   sweep->events_max);
}

recto_status sweep_run(struct sweep *sweep,
                       const struct solver_request *request, double from,
                       double to, recto_error *error) {
  struct progress progress = progress_of(request, "visibility");
  for (;;) {
    struct sweep_event event;
    bool more;
    if (!pop_event(sweep, &event, &more))
      return error_memory(error);
    if (!more)
      return RECTO_OK;
    if (!progress_step(&progress, EVENT_WORK) ||
        !process_event(sweep, &event, &progress))
      return error_memory(error);
    sweep->events++;
    if (sweep->events > sweep->events_max ||
        sweep->covering_total > sweep->covering_max)
      return limit_error(sweep, error);
    progress.share =
        from + (to - from) * (double)sweep->ends_passed / (double)sweep->ends;
  }
}
