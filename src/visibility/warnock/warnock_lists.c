/* warnock_lists.c - which faces and edges of its parent's lists meet a window,
 * and which of them are hidden there. */
#include "visibility/warnock/warnock_subdivision.h"

/* ---- Faces --------------------------------------------------------------- */

/* Makes surrounder t the front if its farthest depth there is nearer. */
static void update_front(struct warnock *w, const struct box2 *window,
                         uint32_t t, struct window_front *front) {
  struct surrounder_depths depth;
  surrounder_depths_of(w->sheet, t, window, &depth);
  if (front->triangle == SHEET_NONE || depth.low > front->depth.low) {
    front->triangle = t;
    front->depth = depth;
  }
}

/* The parent's surrounders surround this window, too, and are not classified
 * again.  The parent's faces come nearest first, so that all others are behind
 * the front as soon as one is behind its farthest depth. */
bool warnock_list_faces(struct warnock *w, struct warnock_window *win,
                        struct window_front *front) {
  struct warnock_range faces = win->faces, surrounders = win->surrounders;
  win->faces.from = w->faces.count;
  win->surrounders.from = w->surrounders.count;
  front->triangle = SHEET_NONE;
  for (size_t i = surrounders.from; i < surrounders.to; i++)
    update_front(w, &win->window, w->surrounders.item[i], front);
  for (size_t i = faces.from; i < faces.to; i++) {
    uint32_t t = w->faces.item[i];
    enum window_class class;
    bool pushed = true;
    if (front->triangle != SHEET_NONE &&
        (double)triangle_nearest_z(w->sheet, t) < front->depth.low) {
      w->cut_short++;
      break;
    }
    class = window_classify(&win->window, sheet_corners(w->sheet, t).p, 3,
                            &w->class_counts);
    if (class == WINDOW_SURROUNDING) {
      pushed = ARRAY_PUSH(&w->surrounders, t);
      update_front(w, &win->window, t, front);
    } else if (class != WINDOW_DISJOINT) {
      pushed = ARRAY_PUSH(&w->faces, t);
    }
    if (!pushed)
      return false;
  }
  for (size_t i = surrounders.from; i < surrounders.to; i++)
    if (!ARRAY_PUSH(&w->surrounders, w->surrounders.item[i]))
      return false;
  win->faces.to = w->faces.count;
  win->surrounders.to = w->surrounders.count;
  return true;
}

/* Is the triangle not behind the front at every corner of the window? */
static bool may_be_visible(struct warnock *w, const struct box2 *window,
                           const struct window_front *front,
                           uint32_t triangle) {
  bool hidden = surrounder_hides(w->sheet, &front->depth, window, triangle);
  w->dropped += hidden;
  return !hidden;
}

void warnock_drop_hidden_faces(struct warnock *w, struct warnock_window *win,
                               const struct window_front *front) {
  size_t kept = win->faces.from;
  if (front->triangle == SHEET_NONE)
    return;
  for (size_t i = win->faces.from; i < win->faces.to; i++) {
    uint32_t t = w->faces.item[i];
    if (may_be_visible(w, &win->window, front, t))
      w->faces.item[kept++] = t;
  }
  win->faces.to = w->faces.count = kept;
  kept = win->surrounders.from;
  for (size_t i = win->surrounders.from; i < win->surrounders.to; i++) {
    uint32_t t = w->surrounders.item[i];
    if (t == front->triangle || may_be_visible(w, &win->window, front, t))
      w->surrounders.item[kept++] = t;
  }
  win->surrounders.to = w->surrounders.count = kept;
}

/* ---- Edges --------------------------------------------------------------- */

bool warnock_list_edges(struct warnock *w, struct warnock_window *win) {
  struct warnock_range edges = win->edges;
  win->edges.from = w->edges.count;
  for (size_t i = edges.from; i < edges.to; i++) {
    uint32_t e = w->edges.item[i];
    const uint32_t *point = w->sheet->edge.item[e].point;
    if (w->edge_deferred[e])
      continue;
    if (window_meets_edge(&win->window, w->sheet->point.item[point[0]],
                          w->sheet->point.item[point[1]]) &&
        !ARRAY_PUSH(&w->edges, e))
      return false;
  }
  win->edges.to = w->edges.count;
  return true;
}
