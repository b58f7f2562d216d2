/* warnock_windows.c - the windows of Warnock's subdivision: their stack, their
 * lists of facets and edges, and their division. */
#include "visibility/warnock/warnock_windows.h"

#include <math.h>

#include "base/poll.h"
#include "base/sort.h"

/* ---- The stack ----------------------------------------------------------- */

static double nearest_z(const struct warnock_windows *windows, uint32_t facet) {
  const uint32_t *corner, *side;
  double farthest, nearest;
  uint32_t count =
      facet_outline(windows->facets, windows->sheet, facet, &corner, &side);
  facet_depth_range(windows->sheet, corner, count, &farthest, &nearest);
  return nearest;
}

bool warnock_windows_init(struct warnock_windows *windows,
                          const struct box2 *first, int flags,
                          const uint8_t *left_out, bool edges) {
  const struct sheet *sheet = windows->sheet;
  size_t n = sheet->triangle.count, count = 0;
  struct sort_key *key = mem_alloc(2 * n, sizeof *key);
  windows->nearest = mem_alloc(n, sizeof *windows->nearest);
  bool ok = key != NULL && windows->nearest != NULL &&
            ARRAY_RESERVE(&windows->facet_pool, n);
  for (uint32_t t = 0; ok && t < n; t++)
    if ((sheet->triangle_flags[t] & flags) == 0 &&
        (left_out == NULL || left_out[t] == 0) &&
        facet_of(windows->facets, t) == t) {
      windows->nearest[t] = nearest_z(windows, t);
      key[count++] = (struct sort_key){
          ~sort_key_of_int64((int64_t)windows->nearest[t]), t};
    }
  if (ok)
    sort_keys(key, key + n, count);
  for (size_t i = 0; ok && i < count; i++)
    windows->facet_pool.item[windows->facet_pool.count++] = key[i].value;
  mem_free(key);
  for (uint32_t e = 0; ok && edges && e < sheet->edge.count; e++)
    if (sheet_edge_is_drawn(sheet, e))
      ok = ARRAY_PUSH(&windows->edge_pool, e);
  struct warnock_window win = {.box = *first,
                               .pairs = INFINITY,
                               .facets = {0, windows->facet_pool.count},
                               .edges = {0, windows->edge_pool.count}};
  return ok && ARRAY_PUSH(&windows->stack, win);
}

void warnock_windows_fini(struct warnock_windows *windows) {
  ARRAY_FREE(&windows->stack);
  ARRAY_FREE(&windows->facet_pool);
  ARRAY_FREE(&windows->surrounder_pool);
  ARRAY_FREE(&windows->edge_pool);
  mem_free(windows->nearest);
}

struct warnock_window warnock_windows_pop(struct warnock_windows *windows) {
  struct warnock_window win = windows->stack.item[--windows->stack.count];
  windows->facet_pool.count = win.facets.to;
  windows->surrounder_pool.count = win.surrounders.to;
  windows->edge_pool.count = win.edges.to;
  return win;
}

bool warnock_divide(struct warnock_windows *windows,
                    const struct warnock_window *win, int32_t x, int32_t y) {
  const struct box2 *b = &win->box;
  for (int k = 0; k < 4; k++) {
    struct warnock_window part = *win;
    part.box = (struct box2){k & 1 ? x : b->x0, k & 2 ? y : b->y0,
                             k & 1 ? b->x1 : box2_min(x, b->x1),
                             k & 2 ? b->y1 : box2_min(y, b->y1)};
    if (part.box.x0 < part.box.x1 && part.box.y0 < part.box.y1 &&
        !ARRAY_PUSH(&windows->stack, part))
      return false;
  }
  return true;
}

/* ---- Lists --------------------------------------------------------------- */

enum window_class warnock_classify(struct warnock_windows *windows,
                                   const struct box2 *on_sheet,
                                   uint32_t facet) {
  const uint32_t *corner, *side;
  struct geom_point p[FACET_CORNERS_MAX];
  uint32_t count =
      facet_outline(windows->facets, windows->sheet, facet, &corner, &side);
  for (uint32_t k = 0; k < count; k++)
    p[k] = windows->sheet->point.item[corner[k]];
  return window_classify(on_sheet, p, (int)count, &windows->classified);
}

/* Removes from a list what the front hides; returns where it ends then. */
static size_t drop_hidden(struct warnock_windows *windows,
                          const struct warnock_window *win,
                          const struct warnock_front *front, uint32_t *item,
                          struct warnock_range list) {
  size_t kept = list.from;
  for (size_t i = list.from; i < list.to; i++)
    if (item[i] == front->facet ||
        !windows->hides(windows->user, &win->box, front, item[i]))
      item[kept++] = item[i];
  windows->dropped += list.to - kept;
  return kept;
}

/* Ends the lists of a window, less what the front hides in it. */
static void end_lists(struct warnock_windows *windows,
                      struct warnock_window *win, struct warnock_front *front) {
  uint64_t dropped = windows->dropped;
  win->facets.to = windows->facet_pool.count;
  win->surrounders.to = windows->surrounder_pool.count;
  if (front->facet == SHEET_NONE)
    return;
  win->facets.to = windows->facet_pool.count =
      drop_hidden(windows, win, front, windows->facet_pool.item, win->facets);
  win->surrounders.to = windows->surrounder_pool.count = drop_hidden(
      windows, win, front, windows->surrounder_pool.item, win->surrounders);
  front->hides |= windows->dropped > dropped;
}

/* The parent's surrounders surround this window, too, and are not classified
 * again.  The parent's faces come nearest first, so that all others are behind
 * the front as soon as one is behind its farthest depth. */
bool warnock_list_facets(struct warnock_windows *windows,
                         struct warnock_window *win,
                         const struct box2 *on_sheet,
                         struct warnock_front *front) {
  struct warnock_range facets = win->facets, surrounders = win->surrounders;
  win->facets.from = windows->facet_pool.count;
  win->surrounders.from = windows->surrounder_pool.count;
  *front = (struct warnock_front){SHEET_NONE, .depth.low = -INFINITY};
  for (size_t i = surrounders.from; i < surrounders.to; i++)
    windows->update_front(windows->user, &win->box,
                          windows->surrounder_pool.item[i], front);
  for (size_t i = facets.from; i < facets.to; i++) {
    uint32_t t = windows->facet_pool.item[i];
    if (!poll_at(i))
      return false;
    front->hides = windows->nearest[t] < front->depth.low;
    if (front->hides) {
      windows->cut_short++;
      break;
    }
    enum window_class class = warnock_classify(windows, on_sheet, t);
    if (class == WINDOW_SURROUNDING) {
      if (!ARRAY_PUSH(&windows->surrounder_pool, t))
        return false;
      windows->update_front(windows->user, &win->box, t, front);
    } else if (class != WINDOW_DISJOINT &&
               !ARRAY_PUSH(&windows->facet_pool, t)) {
      return false;
    }
  }
  for (size_t i = surrounders.from; i < surrounders.to; i++)
    if (!ARRAY_PUSH(&windows->surrounder_pool,
                    windows->surrounder_pool.item[i]))
      return false;
  end_lists(windows, win, front);
  return true;
}

bool warnock_list_edges(struct warnock_windows *windows,
                        struct warnock_window *win, const struct box2 *on_sheet,
                        const uint8_t *deferred) {
  const struct sheet *sheet = windows->sheet;
  struct warnock_range edges = win->edges;
  win->edges.from = windows->edge_pool.count;
  for (size_t i = edges.from; i < edges.to; i++) {
    uint32_t e = windows->edge_pool.item[i];
    struct geom_segment s = sheet_ends(sheet, sheet->edge.item[e].point);
    if ((deferred == NULL || !deferred[e]) &&
        window_meets_edge(on_sheet, s.p, s.q) &&
        !ARRAY_PUSH(&windows->edge_pool, e))
      return false;
  }
  win->edges.to = windows->edge_pool.count;
  return true;
}
