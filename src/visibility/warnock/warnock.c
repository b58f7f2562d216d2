/* warnock.c - subdivision of the page, in vector mode: windows are divided
 * until what is in them is simple, and then give clipped fragments and edge
 * intervals, never pixels.
 *
 * A window holds the faces that meet it, nearest first, those that surround it
 * apart, and the drawable edges that meet it.  It is finished where
 *   - no drawable edge is in it and no fragments are asked for,
 *   - no face is in it,
 *   - few faces are in it, or it is about as small as an edge is long: then
 *     its own list is solved by pairs, exactly;
 *   - division is of no use, because the parts hold nearly what the whole did:
 *     its edges and faces are left to pairwise_fallback.h;
 * otherwise it is divided.  A surrounder takes from its list whatever is
 * behind it by more than contact explains, at every corner of the window; a
 * face that surrounds a window is never asked again about its outline below.
 *
 * Invariants
 *   the windows tile the page; a piece of an edge or a face on a window's
 *   border is joined with its other half again, by parameter (edge_intervals.h) or by
 *   uniting (region.h), so borders are never drawn;
 *   what is dropped from a window's list is hidden there by what stays.
 *
 * Memory: of an edge hidden parts are kept, one for each window at first.  They
 * are united each time that there are twice as many of them.
 *
 * An explicit stack: the lists of a window stand above its parent's and are
 * forgotten when the stack falls back to it.
 *
 * Source  [Warnock1969]; [Rogers1985] ch. 4.
 */
#include <math.h>
#include <string.h>

#include "base/sort.h"
#include "visibility/fragments/occluder_subtraction.h"
#include "visibility/intersection/intersection.h"
#include "visibility/progress.h"
#include "visibility/solver.h"
#include "visibility/predicate/edge_intervals.h"
#include "visibility/predicate/surrounder.h"
#include "visibility/pairwise/pairwise_fallback.h"
#include "visibility/warnock/warnock_raster.h"
#include "visibility/warnock/warnock_window.h"

/* Where a window's lists stand in the pools. */
struct window_range {
  size_t from, to;
};

struct warnock_window {
  struct window window;
  double pairs; /* of the parent: see count_pairs */
  int vain;     /* divisions before that left most of the pairs in one part */
  struct window_range faces, surrounders, edges; /* of the parent */
};

/* A hidden part of an edge inside one window. */
struct edge_part {
  uint32_t edge;
  struct occluded_interval part;
};

typedef ARRAY(struct edge_part) edge_parts;

/* A visible piece of a triangle inside one window. */
struct face_piece {
  uint32_t triangle;
  struct geom_convex piece;
};
typedef ARRAY(struct face_piece) face_pieces;

struct warnock {
  const struct sheet *sheet;
  const struct solver_request *request;
  struct progress progress;
  ARRAY(struct warnock_window) stack;
  ARRAY(uint32_t) faces, surrounders, edges; /* the pools */
  edge_parts part;
  size_t room; /* parts are united when there are so many */
  face_pieces piece;
  size_t piece_room; /* pieces are thinned out when there are so many */
  struct edge_intervals intervals; /* of the edge at hand */
  uint64_t listed, listed_most;    /* faces and edges, over all windows */
  uint8_t *left_edge, *left_face;  /* one each: left to pairwise_fallback.h */
  bool any_left;
  struct arena arena; /* of the pieces */
  struct occluder_subtraction subtraction;
  int64_t floor; /* no smaller window is divided */
  struct window_counts tests;
  uint64_t cut_short; /* lists of which the rest is behind the front */
  uint64_t dropped;   /* faces behind it at every corner of a window */
  struct occlusion_counts hide;
  struct {
    uint64_t all, no_edge, no_face, one_surrounder, few, floor, left, divided;
  } windows;
};

/* At most so many faces, surrounders included, are solved by pairs. */
enum { FEW = 12 };

/* Up to so many pairs are solved by pairs where the window is small. */
enum { CROWDED = 1 << 12 };

/* Divisions in vain, one after the other, after which a crowded window is no
 * longer divided; one that is small is not after the first. */
enum { VAIN_MOST = 4 };

/* Faces and edges in the lists of all windows, for each that there is: when
 * there are more, no crowded window is divided. */
enum { LISTED_MOST = 256 };

/* Hidden parts that need not be united. */
enum { PARTS_FEW = 1 << 16 };

/* Pieces of faces that need not be thinned out, and the pieces that a face may
 * have after that. */
enum { PIECES_FEW = 1 << 15, PIECES_OF_FACE = 8 };

/* Is the edge to be drawn, and not seen end-on? */
static bool is_drawn(const struct sheet *sheet, uint32_t e) {
  const struct sheet_edge *edge = &sheet->edge.item[e];
  struct geom_point p = sheet->point.item[edge->point[0]],
                    q = sheet->point.item[edge->point[1]];
  return edge->edge_class != 0 && (p.x != q.x || p.y != q.y);
}

/* ---- Lists --------------------------------------------------------------- */

/* The surrounder whose farthest depth in the window is nearest: the front. */
struct window_front {
  uint32_t triangle; /* SHEET_NONE: no surrounder */
  struct surrounder_depths depth;
};

static void meet_surrounder(struct warnock *w, const struct window *window,
                            uint32_t t, struct window_front *front) {
  struct surrounder_depths depth;
  surrounder_depths_of(w->sheet, t, window, &depth);
  if (front->triangle == SHEET_NONE || depth.low > front->depth.low) {
    front->triangle = t;
    front->depth = depth;
  }
}

/* Sorts the parent's faces out for this window: those that meet it and those
 * that surround it.  They come nearest first, so the rest is behind the front
 * as soon as one is behind its farthest depth. */
static bool list_faces(struct warnock *w, struct warnock_window *win,
                       struct window_front *front) {
  struct window_range faces = win->faces, surrounders = win->surrounders;
  win->faces.from = w->faces.count;
  win->surrounders.from = w->surrounders.count;
  front->triangle = SHEET_NONE;
  for (size_t i = surrounders.from; i < surrounders.to; i++)
    meet_surrounder(w, &win->window, w->surrounders.item[i], front);
  for (size_t i = faces.from; i < faces.to; i++) {
    uint32_t t = w->faces.item[i];
    struct geom_point p[3];
    enum window_class class;
    bool pushed = true;
    if (front->triangle != SHEET_NONE &&
        (double)triangle_nearest(w->sheet, t) < front->depth.low) {
      w->cut_short++;
      break;
    }
    for (int k = 0; k < 3; k++)
      p[k] = w->sheet->point.item[w->sheet->triangle.item[t].point[k]];
    class = window_classify(&win->window, p, 3, &w->tests);
    if (class == WINDOW_SURROUNDING) {
      pushed = ARRAY_PUSH(&w->surrounders, t);
      meet_surrounder(w, &win->window, t, front);
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
static bool is_seen(struct warnock *w, const struct window *window,
                    const struct window_front *front, uint32_t triangle) {
  bool hidden = surrounder_hides(w->sheet, &front->depth, window, triangle);
  w->dropped += hidden;
  return !hidden;
}

/* Drops what is behind the front. */
static void drop_hidden(struct warnock *w, struct warnock_window *win,
                        const struct window_front *front) {
  size_t kept = win->faces.from;
  if (front->triangle == SHEET_NONE)
    return;
  for (size_t i = win->faces.from; i < win->faces.to; i++) {
    uint32_t t = w->faces.item[i];
    if (is_seen(w, &win->window, front, t))
      w->faces.item[kept++] = t;
  }
  win->faces.to = w->faces.count = kept;
  kept = win->surrounders.from;
  for (size_t i = win->surrounders.from; i < win->surrounders.to; i++) {
    uint32_t t = w->surrounders.item[i];
    if (t == front->triangle || is_seen(w, &win->window, front, t))
      w->surrounders.item[kept++] = t;
  }
  win->surrounders.to = w->surrounders.count = kept;
}

static bool list_edges(struct warnock *w, struct warnock_window *win) {
  struct window_range edges = win->edges;
  win->edges.from = w->edges.count;
  for (size_t i = edges.from; i < edges.to; i++) {
    uint32_t e = w->edges.item[i];
    const uint32_t *point = w->sheet->edge.item[e].point;
    if (w->left_edge[e])
      continue;
    if (window_meets_edge(&win->window, w->sheet->point.item[point[0]],
                          w->sheet->point.item[point[1]]) &&
        !ARRAY_PUSH(&w->edges, e))
      return false;
  }
  win->edges.to = w->edges.count;
  return true;
}

/* The edge at hand, and the part of it inside the window. */
struct edge_task {
  uint32_t number;
  const struct sheet_edge *edge;
  struct geom_point p, q;
  struct box2 box;
  struct ratio from, to;
  bool hidden; /* all of that part */
};

/* False: no more than a point of the edge is inside the window. */
static bool start_edge(const struct warnock *w, const struct window *window,
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

/* Is all of the edge behind the front, and inside its outline where it is
 * inside the window?  On the window's border it might run along a side. */
static bool is_behind(const struct warnock *w, const struct window_front *front,
                      uint32_t e) {
  const uint32_t *point = w->sheet->edge.item[e].point;
  struct geom_point p = w->sheet->point.item[point[0]],
                    q = w->sheet->point.item[point[1]];
  return (double)p.z < front->depth.low && (double)q.z < front->depth.low &&
         p.x != q.x && p.y != q.y;
}

/* The parts, by their edges; NULL when memory ran out. */
static struct sort_key *sort_parts(const struct warnock *w) {
  size_t n = w->part.count;
  struct sort_key *key = mem_alloc(2 * n, sizeof *key);
  for (size_t i = 0; key != NULL && i < n; i++)
    key[i] = (struct sort_key){w->part.item[i].edge, (uint32_t)i};
  if (key != NULL)
    sort_keys(key, key + n, n);
  return key;
}

/* Unites the parts of each edge, and drops those of edges left over. */
static bool unite_parts(struct warnock *w) {
  struct sort_key *key = sort_parts(w);
  size_t n = w->part.count;
  edge_parts united = {0};
  bool ok = key != NULL;
  for (size_t i = 0, past; ok && i < n; i = past) {
    uint32_t e = (uint32_t)key[i].key;
    const occluded_intervals *parts;
    edge_intervals_start(&w->intervals);
    for (past = i; ok && past < n && key[past].key == e; past++)
      ok = w->left_edge[e] ||
           edge_intervals_occlude(&w->intervals,
                                  w->part.item[key[past].value].part);
    parts = edge_intervals_unite(&w->intervals);
    ok = ok && parts != NULL;
    for (size_t k = 0; ok && k < parts->count; k++) {
      struct edge_part part = {e, parts->item[k]};
      ok = ARRAY_PUSH(&united, part);
    }
  }
  mem_free(key);
  ARRAY_FREE(&w->part);
  w->part = united;
  w->room = 2 * united.count + PARTS_FEW;
  return ok;
}

static bool add_part(struct warnock *w, struct edge_part part) {
  return (w->part.count < w->room || unite_parts(w)) &&
         ARRAY_PUSH(&w->part, part);
}

/* Files the edges behind the front as hidden in the window, and drops them. */
static bool drop_hidden_edges(struct warnock *w, struct warnock_window *win,
                              const struct window_front *front) {
  size_t kept = win->edges.from;
  if (front->triangle == SHEET_NONE)
    return true;
  for (size_t i = win->edges.from; i < win->edges.to; i++) {
    uint32_t e = w->edges.item[i];
    struct edge_task task;
    struct edge_part part = {.edge = e, .part.sides = OCCLUDED_BOTH};
    if (!is_behind(w, front, e)) {
      w->edges.item[kept++] = e;
      continue;
    }
    if (!start_edge(w, &win->window, e, &task))
      continue;
    part.part.from = task.from;
    part.part.to = task.to;
    if (!add_part(w, part))
      return false;
  }
  win->edges.to = w->edges.count = kept;
  return true;
}

/* ---- Finished windows ---------------------------------------------------- */

/* Do the parts found so far hide all of the edge inside the window? */
static bool is_hidden(const struct warnock *w, const struct edge_task *task) {
  const occluded_intervals *both = &w->intervals.both;
  return both->count == 1 &&
         ratio_compare(both->item[0].from, task->from) == 0 &&
         ratio_compare(both->item[0].to, task->to) == 0;
}

/* Adds what one triangle hides of the edge at hand inside the window. */
static bool solve_pair(struct warnock *w, struct edge_task *task, uint32_t t) {
  struct occluded_interval part;
  if (t == task->edge->triangle[0] || t == task->edge->triangle[1] ||
      !occlusion_is_possible(w->sheet, t, task->p, task->q, task->box) ||
      !occlude_edge_by(w->sheet, t, task->p, task->q, &part, &w->hide))
    return true;
  if (ratio_compare(part.from, task->from) < 0)
    part.from = task->from;
  if (ratio_compare(task->to, part.to) < 0)
    part.to = task->to;
  if (ratio_compare(part.from, part.to) >= 0)
    return true;
  if (!edge_intervals_occlude(&w->intervals, part))
    return false;
  task->hidden = is_hidden(w, task);
  return true;
}

/* Asks what hides the edge inside the window, the nearest first, until all of
 * it is hidden there. */
static bool solve_edge(struct warnock *w, const struct warnock_window *win,
                       uint32_t e) {
  struct edge_task task;
  const occluded_intervals *parts;
  if (!start_edge(w, &win->window, e, &task))
    return true;
  edge_intervals_start(&w->intervals);
  for (size_t k = win->surrounders.from;
       k < win->surrounders.to && !task.hidden; k++)
    if (!solve_pair(w, &task, w->surrounders.item[k]))
      return false;
  for (size_t k = win->faces.from; k < win->faces.to && !task.hidden; k++)
    if (!solve_pair(w, &task, w->faces.item[k]))
      return false;
  parts = edge_intervals_unite(&w->intervals);
  for (size_t i = 0; parts != NULL && i < parts->count; i++) {
    struct edge_part part = {e, parts->item[i]};
    if (!ARRAY_PUSH(&w->part, part))
      return false;
  }
  return parts != NULL && (w->part.count < w->room || unite_parts(w));
}

static int compare_pieces(const void *a, const void *b, void *user) {
  const struct face_piece *p = a, *q = b;
  (void)user;
  return (p->triangle > q->triangle) - (p->triangle < q->triangle);
}

/* Sorts the pieces by their faces. */
static bool sort_pieces(struct warnock *w) {
  return sort_stable(w->piece.item, w->piece.count, sizeof *w->piece.item,
                     compare_pieces, NULL);
}

/* Leaves the faces of many pieces to pairwise_fallback.h, and drops their pieces. */
static bool thin_out_pieces(struct warnock *w) {
  struct face_piece *piece = w->piece.item;
  size_t n = w->piece.count, kept = 0;
  struct arena arena = {0};
  bool ok = sort_pieces(w);
  for (size_t i = 0, past; ok && i < n; i = past) {
    uint32_t t = piece[i].triangle;
    for (past = i; past < n && piece[past].triangle == t;)
      past++;
    if (past - i > PIECES_OF_FACE)
      w->left_face[t] = w->any_left = true;
    for (size_t k = i; ok && k < past && !w->left_face[t]; k++) {
      struct face_piece copy = {.triangle = t};
      ok = geom_convex_copy(&copy.piece, &piece[k].piece, &arena);
      piece[kept++] = copy;
    }
  }
  arena_fini(&w->arena);
  w->arena = arena;
  w->piece.count = kept;
  w->piece_room = 2 * kept + PIECES_FEW;
  return ok;
}

/* Each face of the window, clipped to it, less what is nearer. */
static bool solve_face(struct warnock *w, const struct warnock_window *win,
                       uint32_t t) {
  struct geom_line border[8];
  const struct window_range *list[2] = {&win->surrounders, &win->faces};
  if ((w->sheet->triangle_flags[t] & SHEET_FLAT) || w->left_face[t])
    return true;
  warnock_window_lines(&win->window, border, border + 4);
  if (!occluder_subtraction_start(&w->subtraction, t, NULL) ||
      !occluder_subtraction_keep(&w->subtraction, border, border + 4, 4))
    return false;
  for (int l = 0; l < 2; l++) {
    const uint32_t *pool = l == 0 ? w->surrounders.item : w->faces.item;
    for (size_t i = list[l]->from; i < list[l]->to; i++) {
      uint32_t g = pool[i];
      if (occluder_subtraction_is_empty(&w->subtraction))
        return true;
      if (g != t && !(w->sheet->triangle_flags[g] & SHEET_FLAT) &&
          (!progress_step(&w->progress, 1 + w->subtraction.left.count) ||
           !occluder_subtraction_take_nearer(&w->subtraction, g)))
        return false;
    }
  }
  for (size_t i = 0; i < w->subtraction.left.count; i++) {
    struct face_piece piece = {.triangle = t};
    if (!geom_convex_copy(&piece.piece, &w->subtraction.left.item[i],
                          &w->arena) ||
        !ARRAY_PUSH(&w->piece, piece))
      return false;
  }
  return w->piece.count < w->piece_room || thin_out_pieces(w);
}

/* Solves the window's own lists by pairs. */
static bool solve_window(struct warnock *w, const struct warnock_window *win) {
  for (size_t i = win->edges.from; i < win->edges.to; i++) {
    uint32_t e = w->edges.item[i];
    if (!progress_step(&w->progress, win->surrounders.to -
                                         win->surrounders.from + win->faces.to -
                                         win->faces.from))
      return false;
    if (!solve_edge(w, win, e))
      return false;
  }
  if (!w->request->fragments)
    return true;
  for (size_t k = win->surrounders.from; k < win->surrounders.to; k++)
    if (!solve_face(w, win, w->surrounders.item[k]))
      return false;
  for (size_t k = win->faces.from; k < win->faces.to; k++)
    if (!solve_face(w, win, w->faces.item[k]))
      return false;
  return true;
}

/* Leaves all that is in the window to pairwise_fallback.h. */
static bool leave_window(struct warnock *w, const struct warnock_window *win) {
  for (size_t i = win->edges.from; i < win->edges.to; i++)
    w->left_edge[w->edges.item[i]] = 1;
  for (size_t i = win->surrounders.from; i < win->surrounders.to; i++)
    w->left_face[w->surrounders.item[i]] = w->request->fragments;
  for (size_t i = win->faces.from; i < win->faces.to; i++)
    w->left_face[w->faces.item[i]] = w->request->fragments;
  w->any_left = true;
  w->windows.left++;
  return true;
}

/* ---- Division ------------------------------------------------------------ */

/* Where to divide: in the middle, or at a side of the box of the window's
 * nearest face. */
static void choose_cut(const struct warnock *w,
                       const struct warnock_window *win, int32_t *x,
                       int32_t *y) {
  const struct window *v = &win->window;
  *x = (int32_t)(((int64_t)v->x0 + v->x1) / 2);
  *y = (int32_t)(((int64_t)v->y0 + v->y1) / 2);
  if (w->request->divide_by_box && win->faces.from < win->faces.to) {
    struct box2 box =
        box2_of_triangle(w->sheet, w->faces.item[win->faces.from]);
    *x = window_cut(v->x0, v->x1, box.x0, box.x1);
    *y = window_cut(v->y0, v->y1, box.y0, box.y1);
  }
}

static bool divide(struct warnock *w, const struct warnock_window *win) {
  const struct window *v = &win->window;
  int32_t x, y;
  choose_cut(w, win, &x, &y);
  for (int k = 0; k < 4; k++) {
    struct warnock_window part = *win;
    part.window = (struct window){k & 1 ? x : v->x0, k & 2 ? y : v->y0,
                                  k & 1 ? v->x1 : x, k & 2 ? v->y1 : y};
    if (!ARRAY_PUSH(&w->stack, part))
      return false;
  }
  w->windows.divided++;
  return true;
}

static bool is_small(const struct warnock *w, const struct window *v) {
  int64_t width = (int64_t)v->x1 - v->x0, height = (int64_t)v->y1 - v->y0;
  return width < 2 || height < 2 || (width <= w->floor && height <= w->floor);
}

/* The edges and faces of the window about which something is to be found. */
static size_t count_asked(const struct warnock *w,
                          const struct warnock_window *win) {
  size_t asked = win->edges.to - win->edges.from;
  if (!w->request->fragments)
    return asked;
  for (size_t i = win->surrounders.from; i < win->surrounders.to; i++)
    asked += !w->left_face[w->surrounders.item[i]];
  for (size_t i = win->faces.from; i < win->faces.to; i++)
    asked += !w->left_face[w->faces.item[i]];
  return asked;
}

/* Divides a window of many faces, or finishes it where that is of no use. */
static bool take_bsp(struct warnock *w, struct warnock_window *win,
                     size_t faces) {
  double pairs = (double)count_asked(w, win) * (double)faces;
  bool small = is_small(w, &win->window);
  if (pairs == 0) {
    w->windows.left++;
    return true;
  }
  if (w->listed > w->listed_most)
    return leave_window(w, win);
  win->vain = pairs > win->pairs / 2 ? win->vain + 1 : 0;
  win->pairs = pairs;
  if (pairs > CROWDED) {
    bool is_point = win->window.x1 - (int64_t)win->window.x0 < 2 ||
                    win->window.y1 - (int64_t)win->window.y0 < 2;
    return is_point || win->vain >= (small ? 1 : VAIN_MOST)
               ? leave_window(w, win)
               : divide(w, win);
  }
  if (!small)
    return divide(w, win);
  w->windows.floor++;
  return solve_window(w, win);
}

static bool take_window(struct warnock *w) {
  struct warnock_window win = w->stack.item[--w->stack.count];
  struct window_front front;
  size_t faces;
  w->windows.all++;
  if (!progress_step(&w->progress,
                     win.faces.to - win.faces.from + win.surrounders.to -
                         win.surrounders.from + win.edges.to - win.edges.from))
    return false;
  w->faces.count = win.faces.to;
  w->surrounders.count = win.surrounders.to;
  w->edges.count = win.edges.to;
  if (!list_edges(w, &win))
    return false;
  if (win.edges.from == win.edges.to && !w->request->fragments) {
    w->windows.no_edge++;
    return true;
  }
  if (!list_faces(w, &win, &front))
    return false;
  drop_hidden(w, &win, &front);
  if (!drop_hidden_edges(w, &win, &front))
    return false;
  if (win.edges.from == win.edges.to && !w->request->fragments) {
    w->windows.no_edge++;
    return true;
  }
  faces =
      win.faces.to - win.faces.from + win.surrounders.to - win.surrounders.from;
  w->listed += faces + win.edges.to - win.edges.from;
  if (faces == 0) {
    w->windows.no_face++;
    return true;
  }
  if (win.faces.from == win.faces.to && faces == 1)
    w->windows.one_surrounder++;
  else if (faces <= FEW)
    w->windows.few++;
  else
    return take_bsp(w, &win, faces);
  return solve_window(w, &win);
}

/* ---- What the windows gave ----------------------------------------------- */

static bool store_strokes(struct warnock *w, struct pairwise_fallback *fallback,
                          struct map *map) {
  const struct sheet *sheet = w->sheet;
  size_t n = w->part.count, i = 0;
  struct sort_key *key = sort_parts(w);
  bool ok = key != NULL && edge_intervals_open_map(map, sheet->edge.count);
  for (uint32_t e = 0; ok && e < sheet->edge.count; e++) {
    struct edge_intervals *intervals = &w->intervals;
    edge_intervals_start(intervals);
    for (; ok && i < n && key[i].key == e; i++)
      ok = edge_intervals_occlude(intervals, w->part.item[key[i].value].part);
    if (!is_drawn(sheet, e))
      continue;
    if (ok && w->left_edge[e]) {
      intervals = pairwise_fallback_edge(fallback, e);
      ok = intervals != NULL;
    }
    ok = ok && edge_intervals_store(intervals, e, map);
  }
  mem_free(key);
  return ok;
}

/* Hands in the faces that were left over. */
static bool store_left_faces(struct warnock *w,
                             struct pairwise_fallback *fallback,
                             struct fragments *fragments) {
  ARRAY(uint32_t) left = {0};
  bool ok = true;
  for (uint32_t t = 0; ok && t < w->sheet->triangle.count; t++)
    if (w->left_face[t])
      ok = ARRAY_PUSH(&left, t);
  ok =
      ok && pairwise_fallback_faces(fallback, left.item, left.count, fragments);
  ARRAY_FREE(&left);
  return ok;
}

static bool store_fragments(struct warnock *w,
                            struct pairwise_fallback *fallback,
                            const struct triangle_grid *grid, struct map *map,
                            struct report *report) {
  struct fragments fragments;
  geom_pieces piece = {0};
  size_t n = w->piece.count;
  bool ok = fragments_init(&fragments, w->sheet, grid, true) && sort_pieces(w);
  fragments.progress = &w->progress;
  fragments.report = report;
  for (size_t i = 0, j; ok && i < n; i = j) {
    piece.count = 0;
    for (j = i;
         ok && j < n && w->piece.item[j].triangle == w->piece.item[i].triangle;
         j++)
      ok = ARRAY_PUSH(&piece, w->piece.item[j].piece);
    ok = ok && (w->left_face[w->piece.item[i].triangle] ||
                fragments_add(&fragments, w->piece.item[i].triangle, piece.item,
                              piece.count));
  }
  if (w->any_left)
    ok = ok && store_left_faces(w, fallback, &fragments);
  ok = ok && fragments_finish(&fragments, w->request->areas, map);
  ARRAY_FREE(&piece);
  fragments_fini(&fragments);
  return ok;
}

/* ---- The solver ---------------------------------------------------------- */

/* All faces, nearest first, and all drawable edges. */
static bool fill_pools(struct warnock *w, const struct triangle_grid *grid) {
  const struct sheet *sheet = w->sheet;
  size_t n = sheet->triangle.count;
  struct sort_key *key = mem_alloc(2 * n, sizeof *key);
  bool ok = key != NULL && ARRAY_RESERVE(&w->faces, n);
  for (size_t t = 0; ok && t < n; t++)
    key[t] = (struct sort_key){
        ~sort_key_of_int64(triangle_nearest(sheet, (uint32_t)t)), (uint32_t)t};
  if (ok)
    sort_keys(key, key + n, n);
  for (size_t t = 0; ok && t < n; t++)
    if (!(sheet->triangle_flags[key[t].value] & SHEET_FLAT) &&
        !triangle_grid_leaves_out(grid, key[t].value))
      w->faces.item[w->faces.count++] = key[t].value;
  mem_free(key);
  for (size_t e = 0; ok && w->request->strokes && e < sheet->edge.count; e++)
    if (is_drawn(sheet, (uint32_t)e))
      ok = ARRAY_PUSH(&w->edges, (uint32_t)e);
  return ok;
}

static bool run(struct warnock *w, const struct triangle_grid *grid) {
  struct warnock_window page;
  w->left_edge = mem_calloc(w->sheet->edge.count, 1);
  w->left_face = mem_calloc(w->sheet->triangle.count, 1);
  w->room = PARTS_FEW;
  w->piece_room = PIECES_FEW;
  if (w->left_edge == NULL || w->left_face == NULL || !fill_pools(w, grid))
    return false;
  page = (struct warnock_window){
      warnock_page_window(w->sheet), INFINITY, 0,
      {0, w->faces.count},           {0, 0},   {0, w->edges.count}};
  w->floor = warnock_edge_length(w->sheet);
  w->listed_most =
      LISTED_MOST * (uint64_t)(w->faces.count + w->edges.count + 1024);
  if (!ARRAY_PUSH(&w->stack, page))
    return false;
  while (w->stack.count > 0) {
    if (!take_window(w))
      return false;
  }
  return true;
}

static void report_windows(const struct warnock *w, struct report *report) {
  report_int(report, "warnock", "windows", (int64_t)w->windows.all);
  report_int(report, "warnock", "without_edge", (int64_t)w->windows.no_edge);
  report_int(report, "warnock", "without_face", (int64_t)w->windows.no_face);
  report_int(report, "warnock", "one_surrounder",
             (int64_t)w->windows.one_surrounder);
  report_int(report, "warnock", "few_faces", (int64_t)w->windows.few);
  report_int(report, "warnock", "at_the_floor", (int64_t)w->windows.floor);
  report_int(report, "warnock", "left_over", (int64_t)w->windows.left);
  report_int(report, "warnock", "divided", (int64_t)w->windows.divided);
  report_text(report, "warnock", "division",
              w->request->divide_by_box ? "box" : "four");
  report_int(report, "warnock", "settled_by_box", (int64_t)w->tests.box);
  report_int(report, "warnock", "settled_by_sign", (int64_t)w->tests.sign);
  report_int(report, "warnock", "settled_by_angle", (int64_t)w->tests.angle);
  report_int(report, "warnock", "stopped_by_depth_order",
             (int64_t)w->cut_short);
  report_int(report, "warnock", "dropped_by_corner_depths",
             (int64_t)w->dropped);
  occlusion_report(&w->hide, report);
}

/* Writes what was found to the map. */
static bool store_all(struct warnock *w, const struct triangle_grid *grid,
                      struct map *map, struct report *report) {
  struct pairwise_fallback fallback = {0};
  bool ok = !w->any_left ||
            pairwise_fallback_init(&fallback, w->sheet, w->request->fragments,
                                   &w->progress);
  w->progress.stage = "edges";
  ok = ok && (!w->request->strokes || store_strokes(w, &fallback, map));
  w->progress.stage = "faces";
  ok = ok && (!w->request->fragments ||
              store_fragments(w, &fallback, grid, map, report));
  pairwise_fallback_fini(&fallback);
  return ok;
}

static recto_status solve(struct sheet *sheet,
                          const struct solver_request *request, struct map *map,
                          struct report *report, recto_error *error) {
  struct warnock w = {.sheet = sheet,
                      .request = request,
                      .progress = progress_of(request, "subdividing")};
  struct triangle_grid grid;
  recto_status status = RECTO_OK;
  bool ok;
  if (request->resolution > 0)
    return warnock_raster_solve(sheet, request, map, report, error);
  if (!triangle_grid_init(&grid, sheet))
    return error_memory(error);
  if (request->intersections)
    status = intersection_find_all(sheet, &grid, NULL, request, report, error);
  if (status == RECTO_OK) {
    occluder_subtraction_init(&w.subtraction, sheet);
    ok = run(&w, &grid) && store_all(&w, &grid, map, report);
    if (!ok)
      status = progress_error(&w.progress, error);
    if (request->fragments)
      occluder_subtraction_report(&w.subtraction, report);
    occluder_subtraction_fini(&w.subtraction);
  }
  report_windows(&w, report);
  ARRAY_FREE(&w.stack);
  ARRAY_FREE(&w.faces);
  ARRAY_FREE(&w.surrounders);
  ARRAY_FREE(&w.edges);
  ARRAY_FREE(&w.part);
  ARRAY_FREE(&w.piece);
  edge_intervals_fini(&w.intervals);
  mem_free(w.left_edge);
  mem_free(w.left_face);
  arena_fini(&w.arena);
  triangle_grid_fini(&grid);
  return status;
}

const struct solver solver_warnock = {RECTO_METHOD_WARNOCK, "warnock", true,
                                      solve};
