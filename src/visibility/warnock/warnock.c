/* warnock.c - Warnock's subdivision in vector mode: windows of the page are
 * divided until their lists are simple, and then yield clipped fragments and
 * edge intervals, never pixels.
 *
 * A window holds the faces that meet it, nearest first, the faces that surround
 * it in a list of their own, and the drawable edges that meet it.  It is
 * finished where
 *   - it has no drawable edge and no fragments are requested,
 *   - it has no face,
 *   - it has at most SMALL_LIST_MAX faces, or it is at most about as large as a
 *     mean edge is long and its list is not too long: then its lists are solved
 *     by pairs, exactly;
 *   - division is futile, because one quarter keeps nearly all of its pairs:
 *     then its edges and faces are deferred to pairwise_fallback.h;
 * otherwise it is divided.  The front, its surrounder whose farthest depth is
 * the nearest, removes from its lists whatever lies behind it by more than the
 * contact tolerance at every corner of the window.  A face that surrounds a
 * window is not classified again in the windows below it.
 *
 * Invariants
 *   the windows tile the page;
 *   a window's border is never drawn: an edge on both sides of it is united by
 *   its parameters (edge_intervals.h), a face by the union of its pieces
 *   (fragments.h);
 *   what is removed from a window's list is hidden there by what stays.
 *
 * Memory: see warnock_edges.c and warnock_faces.c.
 *
 * Stack: explicit; the lists of a window stand above its parent's in the pools
 * and are discarded when the stack falls back to it.
 *
 * Source  [Warnock1969]; [Rogers1985] ch. 4.
 */
#include <math.h>

#include "base/sort.h"
#include "visibility/intersection/intersection.h"
#include "visibility/warnock/warnock_raster.h"
#include "visibility/warnock/warnock_subdivision.h"
#include "visibility/warnock/warnock_window.h"

/* Lists of at most so many faces, surrounders included, are solved by pairs. */
enum { SMALL_LIST_MAX = 12 };

/* In a small window, lists of up to so many pairs are solved by pairs. */
enum { SMALL_WINDOW_PAIRS_MAX = 1 << 12 };

/* Consecutive futile divisions after which a window of more pairs is no longer
 * divided; a small window is not divided after the first. */
enum { FUTILE_MAX = 4 };

/* Entries in the lists of all windows for each face and edge of the sheet:
 * beyond that no window with a long list is divided. */
enum { LISTED_PER_ITEM_MAX = 256 };

/* ---- Finished windows ---------------------------------------------------- */

/* Solves the window's own lists by pairs. */
static bool solve_window(struct warnock *w, const struct warnock_window *win) {
  for (size_t i = win->edges.from; i < win->edges.to; i++) {
    uint32_t e = w->edges.item[i];
    if (!progress_step(&w->progress, win->surrounders.to -
                                         win->surrounders.from + win->faces.to -
                                         win->faces.from))
      return false;
    if (!warnock_solve_edge(w, win, e))
      return false;
  }
  if (!w->request->fragments)
    return true;
  for (size_t k = win->surrounders.from; k < win->surrounders.to; k++)
    if (!warnock_solve_face(w, win, w->surrounders.item[k]))
      return false;
  for (size_t k = win->faces.from; k < win->faces.to; k++)
    if (!warnock_solve_face(w, win, w->faces.item[k]))
      return false;
  return true;
}

/* Defers everything in the window's lists to pairwise_fallback.h. */
static bool defer_window(struct warnock *w, const struct warnock_window *win) {
  for (size_t i = win->edges.from; i < win->edges.to; i++)
    w->edge_deferred[w->edges.item[i]] = 1;
  for (size_t i = win->surrounders.from; i < win->surrounders.to; i++)
    w->face_deferred[w->surrounders.item[i]] = w->request->fragments;
  for (size_t i = win->faces.from; i < win->faces.to; i++)
    w->face_deferred[w->faces.item[i]] = w->request->fragments;
  w->any_deferred = true;
  w->windows.deferred++;
  return true;
}

/* ---- Division ------------------------------------------------------------ */

/* Where to divide: in the middle, or at a side of the bounding box of the
 * window's nearest face. */
static void choose_cut(const struct warnock *w,
                       const struct warnock_window *win, int32_t *x,
                       int32_t *y) {
  const struct box2 *v = &win->window;
  *x = (int32_t)(((int64_t)v->x0 + v->x1) / 2);
  *y = (int32_t)(((int64_t)v->y0 + v->y1) / 2);
  if (w->request->divide_by_box && win->faces.from < win->faces.to) {
    struct box2 box =
        box2_of_triangle(w->sheet, w->faces.item[win->faces.from]);
    *x = window_split(v->x0, v->x1, box.x0, box.x1);
    *y = window_split(v->y0, v->y1, box.y0, box.y1);
  }
}

/* Puts the four quarters of the window onto the stack. */
static bool divide(struct warnock *w, const struct warnock_window *win) {
  const struct box2 *v = &win->window;
  int32_t x, y;
  choose_cut(w, win, &x, &y);
  for (int k = 0; k < 4; k++) {
    struct warnock_window quarter = *win;
    quarter.window = (struct box2){k & 1 ? x : v->x0, k & 2 ? y : v->y0,
                                   k & 1 ? v->x1 : x, k & 2 ? v->y1 : y};
    if (!ARRAY_PUSH(&w->stack, quarter))
      return false;
  }
  w->windows.divided++;
  return true;
}

static bool is_small(const struct warnock *w, const struct box2 *v) {
  int64_t width = (int64_t)v->x1 - v->x0, height = (int64_t)v->y1 - v->y0;
  return width < 2 || height < 2 || (width <= w->floor && height <= w->floor);
}

/* The edges and faces of the window that are not yet deferred. */
static size_t count_unsolved(const struct warnock *w,
                             const struct warnock_window *win) {
  size_t unsolved = win->edges.to - win->edges.from;
  if (!w->request->fragments)
    return unsolved;
  for (size_t i = win->surrounders.from; i < win->surrounders.to; i++)
    unsolved += !w->face_deferred[w->surrounders.item[i]];
  for (size_t i = win->faces.from; i < win->faces.to; i++)
    unsolved += !w->face_deferred[w->faces.item[i]];
  return unsolved;
}

/* Divides a window of many faces, or solves or defers its lists where division
 * is futile. */
static bool handle_long_list(struct warnock *w, struct warnock_window *win,
                             size_t faces) {
  double pairs = (double)count_unsolved(w, win) * (double)faces;
  bool small = is_small(w, &win->window);
  if (pairs == 0) {
    w->windows.deferred++;
    return true;
  }
  if (w->listed > w->listed_max)
    return defer_window(w, win);
  win->futile = pairs > win->pairs / 2 ? win->futile + 1 : 0;
  win->pairs = pairs;
  if (pairs > SMALL_WINDOW_PAIRS_MAX) {
    bool is_point = win->window.x1 - (int64_t)win->window.x0 < 2 ||
                    win->window.y1 - (int64_t)win->window.y0 < 2;
    return is_point || win->futile >= (small ? 1 : FUTILE_MAX)
               ? defer_window(w, win)
               : divide(w, win);
  }
  if (!small)
    return divide(w, win);
  w->windows.floor++;
  return solve_window(w, win);
}

/* Takes a window from the stack and finishes or divides it. */
static bool process_window(struct warnock *w) {
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
  if (!warnock_list_edges(w, &win))
    return false;
  if (win.edges.from == win.edges.to && !w->request->fragments) {
    w->windows.no_edge++;
    return true;
  }
  if (!warnock_list_faces(w, &win, &front))
    return false;
  warnock_drop_hidden_faces(w, &win, &front);
  if (!warnock_drop_hidden_edges(w, &win, &front))
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
  else if (faces <= SMALL_LIST_MAX)
    w->windows.few++;
  else
    return handle_long_list(w, &win, faces);
  return solve_window(w, &win);
}

/* ---- The solver ---------------------------------------------------------- */

/* Lists all faces, nearest first, and all drawable edges. */
static bool fill_pools(struct warnock *w, const struct triangle_grid *grid) {
  const struct sheet *sheet = w->sheet;
  size_t n = sheet->triangle.count;
  struct sort_key *key = mem_alloc(2 * n, sizeof *key);
  bool ok = key != NULL && ARRAY_RESERVE(&w->faces, n);
  for (size_t t = 0; ok && t < n; t++)
    key[t] = (struct sort_key){
        ~sort_key_of_int64(triangle_nearest_z(sheet, (uint32_t)t)),
        (uint32_t)t};
  if (ok)
    sort_keys(key, key + n, n);
  for (size_t t = 0; ok && t < n; t++)
    if (!(sheet->triangle_flags[key[t].value] & SHEET_FLAT) &&
        !triangle_grid_leaves_out(grid, key[t].value))
      w->faces.item[w->faces.count++] = key[t].value;
  mem_free(key);
  for (size_t e = 0; ok && w->request->strokes && e < sheet->edge.count; e++)
    if (sheet_edge_is_drawn(sheet, e))
      ok = ARRAY_PUSH(&w->edges, (uint32_t)e);
  return ok;
}

static bool run(struct warnock *w, const struct triangle_grid *grid) {
  struct warnock_window page;
  w->edge_deferred = mem_calloc(w->sheet->edge.count, 1);
  w->face_deferred = mem_calloc(w->sheet->triangle.count, 1);
  w->occlusion_limit = OCCLUSIONS_MIN;
  w->piece_limit = PIECES_MIN;
  if (w->edge_deferred == NULL || w->face_deferred == NULL ||
      !fill_pools(w, grid))
    return false;
  page = (struct warnock_window){
      warnock_page_window(w->sheet), INFINITY, 0,
      {0, w->faces.count},           {0, 0},   {0, w->edges.count}};
  w->floor = warnock_edge_length(w->sheet);
  w->listed_max =
      LISTED_PER_ITEM_MAX * (uint64_t)(w->faces.count + w->edges.count + 1024);
  if (!ARRAY_PUSH(&w->stack, page))
    return false;
  while (w->stack.count > 0) {
    if (!process_window(w))
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
  report_int(report, "warnock", "of_least_size", (int64_t)w->windows.floor);
  report_int(report, "warnock", "deferred", (int64_t)w->windows.deferred);
  report_int(report, "warnock", "divided", (int64_t)w->windows.divided);
  report_text(report, "warnock", "division",
              w->request->divide_by_box ? "box" : "four");
  report_int(report, "warnock", "classified_by_box",
             (int64_t)w->class_counts.box);
  report_int(report, "warnock", "classified_by_sign",
             (int64_t)w->class_counts.sign);
  report_int(report, "warnock", "classified_by_angle",
             (int64_t)w->class_counts.angle);
  report_int(report, "warnock", "stopped_by_depth_order",
             (int64_t)w->cut_short);
  report_int(report, "warnock", "dropped_by_corner_depths",
             (int64_t)w->dropped);
  occlusion_report(&w->occlusion_counts, report);
}

/* Writes the edges and faces to the map. */
static bool store_all(struct warnock *w, const struct triangle_grid *grid,
                      struct map *map, struct report *report) {
  struct pairwise_fallback fallback = {0};
  bool ok = !w->any_deferred ||
            pairwise_fallback_init(&fallback, w->sheet, w->request->fragments,
                                   &w->progress);
  w->progress.stage = "edges";
  ok = ok && (!w->request->strokes || warnock_store_edges(w, &fallback, map));
  w->progress.stage = "faces";
  ok = ok && (!w->request->fragments ||
              warnock_store_faces(w, &fallback, grid, map, report));
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
  ARRAY_FREE(&w.occlusion);
  ARRAY_FREE(&w.piece);
  edge_intervals_fini(&w.intervals);
  mem_free(w.edge_deferred);
  mem_free(w.face_deferred);
  arena_fini(&w.arena);
  triangle_grid_fini(&grid);
  return status;
}

const struct solver solver_warnock = {RECTO_METHOD_WARNOCK, "warnock", true,
                                      solve};
