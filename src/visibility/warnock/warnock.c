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
 *   - division gains nothing, as one quarter keeps nearly all of its pairs:
 *     then its edges and faces are deferred to pairwise_fallback.h;
 * otherwise it is divided.  The front, its surrounder whose farthest depth is
 * the nearest, removes from its lists whatever lies behind it by more than the
 * contact tolerance at every corner of the window.
 *
 * Invariants  those of warnock_windows.h;
 *   a window's border is never drawn: an edge on both sides of it is united by
 *   its parameters (edge_intervals.h), a face by the union of its pieces
 *   (fragments.h).
 *
 * Memory: see warnock_edges.c and warnock_faces.c.
 *
 * Source  [Warnock1969]; [Rogers1985] ch. 4.
 */
#include <math.h>

#include "visibility/intersection/intersection.h"
#include "visibility/warnock/warnock_raster.h"
#include "visibility/warnock/warnock_subdivision.h"

/* Lists of at most so many faces, surrounders included, are solved by pairs. */
enum { SMALL_LIST_MAX = 12 };

/* In a small window, lists of up to so many pairs are solved by pairs. */
enum { SMALL_WINDOW_PAIRS_MAX = 1 << 12 };

/* Consecutive divisions without gain after which a window of more pairs is no
 * longer divided; a small window is not divided after the first. */
enum { DIVISIONS_WITHOUT_GAIN_MAX = 4 };

/* Entries in the lists of all windows for each face and edge of the sheet:
 * beyond that no window with a long list is divided. */
enum { LISTED_PER_ITEM_MAX = 256 };

/* ---- Finished windows ---------------------------------------------------- */

/* Solves the window's own lists by pairs. */
static bool solve_window(struct warnock *w, const struct warnock_window *win) {
  for (size_t i = win->edges.from; i < win->edges.to; i++) {
    uint32_t e = w->windows.edge_pool.item[i];
    if (!progress_step(&w->progress, warnock_count(win->surrounders) +
                                         warnock_count(win->facets)) ||
        !warnock_solve_edge(w, win, e))
      return false;
  }
  if (!w->request->fragments)
    return true;
  for (size_t k = win->surrounders.from; k < win->surrounders.to; k++)
    if (!warnock_solve_face(w, win, w->windows.surrounder_pool.item[k]))
      return false;
  for (size_t k = win->facets.from; k < win->facets.to; k++)
    if (!warnock_solve_face(w, win, w->windows.facet_pool.item[k]))
      return false;
  return true;
}

/* Defers everything in the window's lists to pairwise_fallback.h. */
static bool defer_window(struct warnock *w, const struct warnock_window *win) {
  for (size_t i = win->edges.from; i < win->edges.to; i++)
    w->edge_deferred[w->windows.edge_pool.item[i]] = 1;
  for (size_t i = win->surrounders.from; i < win->surrounders.to; i++)
    w->triangle_deferred[w->windows.surrounder_pool.item[i]] =
        w->request->fragments;
  for (size_t i = win->facets.from; i < win->facets.to; i++)
    w->triangle_deferred[w->windows.facet_pool.item[i]] = w->request->fragments;
  w->any_deferred = true;
  w->counts.deferred++;
  return true;
}

/* ---- Division ------------------------------------------------------------ */

/* Divides the window in the middle, or at sides of the bounding box of its
 * nearest face. */
static bool divide_window(struct warnock *w, const struct warnock_window *win) {
  const struct box2 *b = &win->box;
  int32_t x = (int32_t)(((int64_t)b->x0 + b->x1) / 2),
          y = (int32_t)(((int64_t)b->y0 + b->y1) / 2);
  if (w->request->divide_by_box && warnock_count(win->facets) > 0) {
    struct box2 face = box2_of_triangle(
        w->sheet, w->windows.facet_pool.item[win->facets.from]);
    x = window_split(b->x0, b->x1, face.x0, face.x1);
    y = window_split(b->y0, b->y1, face.y0, face.y1);
  }
  w->counts.divided++;
  return warnock_divide(&w->windows, win, x, y);
}

static bool is_small(const struct warnock *w, const struct box2 *v) {
  int64_t width = (int64_t)v->x1 - v->x0, height = (int64_t)v->y1 - v->y0;
  return width < 2 || height < 2 ||
         (width <= w->least_side && height <= w->least_side);
}

/* The edges and faces of the window that are not yet deferred. */
static size_t count_unsolved(const struct warnock *w,
                             const struct warnock_window *win) {
  size_t unsolved = warnock_count(win->edges);
  if (!w->request->fragments)
    return unsolved;
  for (size_t i = win->surrounders.from; i < win->surrounders.to; i++)
    unsolved += !w->triangle_deferred[w->windows.surrounder_pool.item[i]];
  for (size_t i = win->facets.from; i < win->facets.to; i++)
    unsolved += !w->triangle_deferred[w->windows.facet_pool.item[i]];
  return unsolved;
}

/* Divides a window of many faces, or solves or defers its lists where division
 * gains nothing. */
static bool handle_long_list(struct warnock *w, struct warnock_window *win,
                             size_t faces) {
  double pairs = (double)count_unsolved(w, win) * (double)faces;
  bool small = is_small(w, &win->box);
  if (pairs == 0) {
    w->counts.deferred++;
    return true;
  }
  if (w->listed > w->listed_max)
    return defer_window(w, win);
  win->divisions_without_gain =
      pairs > win->pairs / 2 ? win->divisions_without_gain + 1 : 0;
  win->pairs = pairs;
  if (pairs > SMALL_WINDOW_PAIRS_MAX) {
    bool is_point = win->box.x1 - (int64_t)win->box.x0 < 2 ||
                    win->box.y1 - (int64_t)win->box.y0 < 2;
    return is_point || win->divisions_without_gain >=
                           (small ? 1 : DIVISIONS_WITHOUT_GAIN_MAX)
               ? defer_window(w, win)
               : divide_window(w, win);
  }
  if (!small)
    return divide_window(w, win);
  w->counts.of_least_size++;
  return solve_window(w, win);
}

/* Takes a window from the stack and finishes or divides it. */
static bool process_page_window(struct warnock *w) {
  struct warnock_window win = warnock_windows_pop(&w->windows);
  bool fragments = w->request->fragments;
  struct warnock_front front;
  w->counts.all++;
  if (!progress_step(&w->progress, warnock_count(win.facets) +
                                       warnock_count(win.surrounders) +
                                       warnock_count(win.edges)) ||
      !warnock_list_edges(&w->windows, &win, &win.box, w->edge_deferred))
    return false;
  if ((fragments || warnock_count(win.edges) > 0) &&
      (!warnock_list_facets(&w->windows, &win, &win.box, &front) ||
       !warnock_drop_hidden_edges(w, &win, &front)))
    return false;
  if (!fragments && warnock_count(win.edges) == 0) {
    w->counts.no_edge++;
    return true;
  }
  size_t faces = warnock_count(win.facets) + warnock_count(win.surrounders);
  w->listed += faces + warnock_count(win.edges);
  if (faces == 0) {
    w->counts.no_face++;
    return true;
  }
  if (faces == 1 && warnock_count(win.facets) == 0)
    w->counts.one_surrounder++;
  else if (faces <= SMALL_LIST_MAX)
    w->counts.few++;
  else
    return handle_long_list(w, &win, faces);
  return solve_window(w, &win);
}

/* ---- The solver ---------------------------------------------------------- */

/* The smallest square window about all points of the sheet, at least 2 units
 * wide, moved to lie within the grid's range. */
static struct box2 page_window(const struct sheet *sheet) {
  struct box2 all = box2_of_sheet(sheet);
  int64_t x0 = all.x0, y0 = all.y0;
  int64_t width = all.x1 - x0, height = all.y1 - y0;
  int64_t side = width > height ? width : height;
  if (side < 2)
    side = 2;
  /* The square is moved where it would leave the grid's range. */
  if (x0 + side > SHEET_XY_MAX)
    x0 = SHEET_XY_MAX - side;
  if (y0 + side > SHEET_XY_MAX)
    y0 = SHEET_XY_MAX - side;
  if (x0 < -SHEET_XY_MAX)
    x0 = -SHEET_XY_MAX;
  if (y0 < -SHEET_XY_MAX)
    y0 = -SHEET_XY_MAX;
  return (struct box2){(int32_t)x0, (int32_t)y0, (int32_t)(x0 + side),
                       (int32_t)(y0 + side)};
}

/* Half the mean larger side of the triangles' bounding boxes, from a sample of
 * about 4096 of them; grid units, at least 1. */
static int64_t edge_length(const struct sheet *sheet) {
  enum { SAMPLE = 4096 };
  size_t n = sheet->triangle.count, stride = n / SAMPLE + 1, count = 0;
  int64_t sum = 0;
  for (size_t t = 0; t < n; t += stride, count++) {
    struct box2 b = box2_of_triangle(sheet, (uint32_t)t);
    int64_t width = (int64_t)b.x1 - b.x0, height = (int64_t)b.y1 - b.y0;
    sum += width > height ? width : height;
  }
  return count == 0 ? 1 : sum / (int64_t)count / 2 + 1;
}

/* Makes surrounder t the front if its farthest depth there is nearer. */
static void update_nearer_front(void *user, const struct box2 *window,
                                uint32_t t, struct warnock_front *front) {
  const struct warnock *w = user;
  struct surrounder_depths depth;
  surrounder_depths_of(w->sheet, t, window, &depth);
  if (front->facet == SHEET_NONE || depth.low > front->depth.low) {
    front->facet = t;
    front->depth = depth;
  }
}

/* Is triangle t behind the front at every corner of the window? */
static bool front_hides(void *user, const struct box2 *window,
                        const struct warnock_front *front, uint32_t t) {
  const struct warnock *w = user;
  return surrounder_hides(w->sheet, &front->depth, window, t);
}

static bool subdivide_page(struct warnock *w,
                           const struct triangle_grid *grid) {
  static const struct facets triangles = {0};
  const struct sheet *sheet = w->sheet;
  struct box2 page = page_window(sheet);
  w->edge_deferred = mem_calloc(sheet->edge.count, 1);
  w->triangle_deferred = mem_calloc(sheet->triangle.count, 1);
  w->occlusion_limit = WARNOCK_UNITE_FROM;
  w->piece_limit = WARNOCK_LIMIT_FROM;
  w->least_side = edge_length(sheet);
  w->windows = (struct warnock_windows){.sheet = sheet,
                                        .facets = &triangles,
                                        .update_front = update_nearer_front,
                                        .hides = front_hides,
                                        .user = w};
  if (w->edge_deferred == NULL || w->triangle_deferred == NULL ||
      !warnock_windows_init(&w->windows, &page, SHEET_EDGE_ON, grid->left_out,
                            w->request->edges))
    return false;
  w->listed_max =
      LISTED_PER_ITEM_MAX * (uint64_t)(w->windows.facet_pool.count +
                                       w->windows.edge_pool.count + 1024);
  while (w->windows.stack.count > 0)
    if (!process_page_window(w))
      return false;
  return true;
}

static void report_windows(const struct warnock *w, struct report *report) {
  report_count(report, "warnock", "windows", w->counts.all);
  report_count(report, "warnock", "without_edge", w->counts.no_edge);
  report_count(report, "warnock", "without_face", w->counts.no_face);
  report_count(report, "warnock", "one_surrounder", w->counts.one_surrounder);
  report_count(report, "warnock", "few_faces", w->counts.few);
  report_count(report, "warnock", "of_least_size", w->counts.of_least_size);
  report_count(report, "warnock", "deferred", w->counts.deferred);
  report_count(report, "warnock", "divided", w->counts.divided);
  report_text(report, "warnock", "division",
              w->request->divide_by_box ? "box" : "four");
  report_count(report, "warnock", "classified_by_box",
               w->windows.classified.box);
  report_count(report, "warnock", "classified_by_sign",
               w->windows.classified.sign);
  report_count(report, "warnock", "classified_by_angle",
               w->windows.classified.angle);
  report_count(report, "warnock", "stopped_by_depth_order",
               w->windows.cut_short);
  report_count(report, "warnock", "dropped_by_corner_depths",
               w->windows.dropped);
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
  ok = ok && (!w->request->edges || warnock_store_edges(w, &fallback, map));
  w->progress.stage = "faces";
  ok = ok && (!w->request->fragments ||
              warnock_store_faces(w, &fallback, grid, map, report));
  pairwise_fallback_fini(&fallback);
  return ok;
}

static recto_status solve_warnock(struct sheet *sheet,
                                  const struct solver_request *request,
                                  struct map *map, struct report *report,
                                  recto_error *error) {
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
    ok = subdivide_page(&w, &grid) && store_all(&w, &grid, map, report);
    if (!ok)
      status = error_memory(error);
    if (request->fragments)
      occluder_subtraction_report(&w.subtraction.counts, report);
    occluder_subtraction_fini(&w.subtraction);
  }
  report_windows(&w, report);
  warnock_windows_fini(&w.windows);
  ARRAY_FREE(&w.occlusion);
  ARRAY_FREE(&w.piece);
  edge_intervals_fini(&w.intervals);
  mem_free(w.edge_deferred);
  mem_free(w.triangle_deferred);
  arena_fini(&w.arena);
  triangle_grid_fini(&grid);
  return status;
}

const struct solver solver_warnock = {RECTO_METHOD_WARNOCK, solve_warnock};
