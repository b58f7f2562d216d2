/* warnock_edges.c - occluded intervals of edges window by window, and the
 * visible intervals of whole edges from them.
 *
 * Memory: each window adds occluded intervals of its own.  They are united each
 * time that their number has doubled, so that memory stays linear in what the
 * united intervals take.
 */
#include "base/sort.h"
#include "visibility/warnock/warnock_subdivision.h"

/* ---- Occluded intervals -------------------------------------------------- */

/* The occluded intervals sorted by edge; NULL when memory ran out. */
static struct sort_key *sort_occlusions(const struct warnock *w) {
  size_t n = w->occlusion.count;
  struct sort_key *key = mem_alloc(2 * n, sizeof *key);
  for (size_t i = 0; key != NULL && i < n; i++)
    key[i] = (struct sort_key){w->occlusion.item[i].edge, (uint32_t)i};
  if (key != NULL)
    sort_keys(key, key + n, n);
  return key;
}

/* Unites the occluded intervals of each edge, and discards those of deferred
 * edges. */
static bool unite_occlusions(struct warnock *w) {
  struct sort_key *key = sort_occlusions(w);
  size_t n = w->occlusion.count;
  edge_occlusions united = {0};
  bool ok = key != NULL;
  for (size_t i = 0, past; ok && i < n; i = past) {
    uint32_t e = (uint32_t)key[i].key;
    const occluded_intervals *parts;
    edge_intervals_start(&w->intervals);
    for (past = i; ok && past < n && key[past].key == e; past++)
      ok = w->edge_deferred[e] ||
           edge_intervals_occlude(&w->intervals,
                                  w->occlusion.item[key[past].value].interval);
    parts = edge_intervals_unite(&w->intervals);
    ok = ok && parts != NULL;
    for (size_t k = 0; ok && k < parts->count; k++) {
      struct edge_occlusion hidden = {e, parts->item[k]};
      ok = ARRAY_PUSH(&united, hidden);
    }
  }
  mem_free(key);
  ARRAY_FREE(&w->occlusion);
  w->occlusion = united;
  w->occlusion_limit = 2 * united.count + WARNOCK_UNITE_FROM;
  return ok;
}

static bool add_occlusion(struct warnock *w, struct edge_occlusion hidden) {
  return (w->occlusion.count < w->occlusion_limit || unite_occlusions(w)) &&
         ARRAY_PUSH(&w->occlusion, hidden);
}

/* ---- One edge in one window ---------------------------------------------- */

/* The current edge, and the interval [from, to] of it inside the window. */
struct edge_task {
  uint32_t number;
  const struct sheet_edge *edge;
  struct geom_point p, q;
  struct box2 box;
  struct ratio from, to;
  bool hidden; /* all of that interval */
};

/* Sets the task; false where the edge has at most a point in the window. */
static bool start_edge(const struct warnock *w, const struct box2 *window,
                       uint32_t e, struct edge_task *task) {
  const struct sheet_edge *edge = &w->sheet->edge.item[e];
  task->number = e;
  task->edge = edge;
  task->p = w->sheet->point.item[edge->point[0]];
  task->q = w->sheet->point.item[edge->point[1]];
  task->box = box2_of_segment(task->p, task->q);
  task->hidden = false;
  return window_clip(window, task->p, task->q, &task->from, &task->to) &&
         ratio_compare(task->from, task->to) < 0;
}

/* Is the whole edge behind the front, and its interval in the window inside the
 * front's outline?  An axis-parallel edge might run along the window's border,
 * and there along a side of the front. */
static bool is_edge_behind(const struct warnock *w,
                           const struct warnock_front *front, uint32_t e) {
  struct geom_segment s = sheet_ends(w->sheet, w->sheet->edge.item[e].point);
  return (double)s.p.z < front->depth.low && (double)s.q.z < front->depth.low &&
         s.p.x != s.q.x && s.p.y != s.q.y;
}

bool warnock_drop_hidden_edges(struct warnock *w, struct warnock_window *win,
                               const struct warnock_front *front) {
  size_t kept = win->edges.from;
  if (front->facet == SHEET_NONE)
    return true;
  for (size_t i = win->edges.from; i < win->edges.to; i++) {
    uint32_t e = w->windows.edge_pool.item[i];
    struct edge_task task;
    struct edge_occlusion hidden = {.edge = e, .interval.sides = OCCLUDED_BOTH};
    if (!is_edge_behind(w, front, e)) {
      w->windows.edge_pool.item[kept++] = e;
      continue;
    }
    if (!start_edge(w, &win->box, e, &task))
      continue;
    hidden.interval.from = task.from;
    hidden.interval.to = task.to;
    if (!add_occlusion(w, hidden))
      return false;
  }
  win->edges.to = w->windows.edge_pool.count = kept;
  return true;
}

/* Do the intervals found so far hide all of the edge inside the window? */
static bool is_edge_hidden(const struct warnock *w,
                           const struct edge_task *task) {
  const occluded_intervals *both = &w->intervals.merged;
  return both->count == 1 &&
         ratio_compare(both->item[0].from, task->from) == 0 &&
         ratio_compare(both->item[0].to, task->to) == 0;
}

/* Adds the interval that triangle t occludes of the edge inside the window. */
static bool occlude_by(struct warnock *w, struct edge_task *task, uint32_t t) {
  struct occluded_interval hidden;
  if (occlusion_is_own(w->sheet, task->edge, t) ||
      !occlusion_is_possible(w->sheet, t, task->p, task->q, task->box) ||
      !occlude_edge_by_triangle(w->sheet, t, task->p, task->q, &hidden,
                                &w->occlusion_counts))
    return true;
  if (ratio_compare(hidden.from, task->from) < 0)
    hidden.from = task->from;
  if (ratio_compare(task->to, hidden.to) < 0)
    hidden.to = task->to;
  if (ratio_compare(hidden.from, hidden.to) >= 0)
    return true;
  if (!edge_intervals_occlude(&w->intervals, hidden))
    return false;
  task->hidden = is_edge_hidden(w, task);
  return true;
}

bool warnock_solve_edge(struct warnock *w, const struct warnock_window *win,
                        uint32_t e) {
  struct edge_task task;
  const occluded_intervals *parts;
  if (!start_edge(w, &win->box, e, &task))
    return true;
  edge_intervals_start(&w->intervals);
  for (size_t k = win->surrounders.from;
       k < win->surrounders.to && !task.hidden; k++)
    if (!occlude_by(w, &task, w->windows.surrounder_pool.item[k]))
      return false;
  for (size_t k = win->facets.from; k < win->facets.to && !task.hidden; k++)
    if (!occlude_by(w, &task, w->windows.facet_pool.item[k]))
      return false;
  parts = edge_intervals_unite(&w->intervals);
  for (size_t i = 0; parts != NULL && i < parts->count; i++) {
    struct edge_occlusion hidden = {e, parts->item[i]};
    if (!ARRAY_PUSH(&w->occlusion, hidden))
      return false;
  }
  return parts != NULL &&
         (w->occlusion.count < w->occlusion_limit || unite_occlusions(w));
}

/* ---- All edges ----------------------------------------------------------- */

bool warnock_store_edges(struct warnock *w, struct pairwise_fallback *fallback,
                         struct map *map) {
  const struct sheet *sheet = w->sheet;
  size_t n = w->occlusion.count, i = 0;
  struct sort_key *key = sort_occlusions(w);
  bool ok = key != NULL && edge_intervals_open_map(map, sheet->edge.count);
  for (uint32_t e = 0; ok && e < sheet->edge.count; e++) {
    struct edge_intervals *intervals = &w->intervals;
    edge_intervals_start(intervals);
    for (; ok && i < n && key[i].key == e; i++)
      ok = edge_intervals_occlude(intervals,
                                  w->occlusion.item[key[i].value].interval);
    if (!sheet_edge_is_drawn(sheet, e))
      continue;
    if (ok && w->edge_deferred[e]) {
      intervals = pairwise_fallback_edge(fallback, e);
      ok = intervals != NULL;
    }
    ok = ok && edge_intervals_store(intervals, e, map);
  }
  mem_free(key);
  return ok;
}
