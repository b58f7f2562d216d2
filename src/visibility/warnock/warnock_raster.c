/* warnock_raster.c - subdivision of a pixel frame: windows are divided until
 * one of five rules finishes them, down to single pixels, which are sampled at
 * their centres.
 *
 * A window is a block of pixels.  On the sheet it is their outline, rounded
 * outwards to the grid: so a face that is disjoint from it covers no centre of
 * it, and one that surrounds it covers all of them, whatever the rounding.
 * Whether one plane is nearer than another throughout a window is tested at its
 * four outermost centres: depths are linear, so what holds there holds between.
 *
 * Invariants
 *   the windows on the stack are disjoint, and with the finished ones tile the
 *   frame;
 *   a window's lists stand above its parent's in the pools, and hold all faces
 *   that may be visible in it, nearest first;
 *   a face that surrounds a window or is disjoint from it is not classified
 *   again below it.
 *
 * Stack   a window of 2^n pixels a side is replaced by four of half the size:
 *   at most 3 n + 1 windows, 3 (n - 1) + 5 with the current one.  Where windows
 *   are divided at the faces' bounding boxes there is no such bound.
 * Source  [Warnock1969]; [Rogers1985] ch. 4.
 */
#include "visibility/warnock/warnock_raster.h"

#include <math.h>
#include <string.h>

#include "base/sort.h"
#include "visibility/index/triangle_grid.h"
#include "visibility/raster/pixels.h"
#include "visibility/progress.h"
#include "visibility/raster/subpixels.h"
#include "visibility/warnock/warnock_sample.h"
#include "visibility/predicate/window.h"

/* A list of a window: the entries [from, to) of a pool. */
struct pixel_range {
  size_t from, to;
};

/* A window and its lists; on the stack, the lists of its parent. */
struct pixel_window {
  int32_t column, line, columns, lines;
  struct pixel_range faces, surrounders, edges;
};

/* A window clipped to the frame: pixels [from, past). */
struct block {
  int32_t column_from, column_past, line_from, line_past;
};

struct subdivision {
  const struct sheet *sheet;
  const struct facets *facets;
  const struct solver_request *request;
  struct warnock_frame *frame;
  struct progress progress;
  struct warnock_sample sample;
  ARRAY(struct pixel_window) stack;
  ARRAY(uint32_t) faces, surrounders, edges; /* the pools */
  uint32_t *count; /* scratch, one a column: sub-pixels covered */
  struct window_counts tests;
  uint64_t pixels_done;
};

/* ---- Windows ------------------------------------------------------------- */

static struct block block_of(const struct subdivision *s,
                             const struct pixel_window *win) {
  const struct scan_grid *grid = &s->frame->raster.grid;
  struct block b = {win->column, win->column + win->columns, win->line,
                    win->line + win->lines};
  if (b.column_past > grid->columns)
    b.column_past = grid->columns;
  if (b.line_past > grid->lines)
    b.line_past = grid->lines;
  return b;
}

static int32_t clamp_to_grid(int64_t value) {
  if (value > SHEET_XY_MAX)
    return SHEET_XY_MAX;
  return value < -SHEET_XY_MAX ? -SHEET_XY_MAX : (int32_t)value;
}

static int64_t floor_divide(int64_t num, int64_t den) {
  return num / den - (num % den < 0);
}

/* The block on the sheet, `margin` pixels wider on each side.  No face lies
 * beyond SHEET_XY_MAX: clipping the window there changes no class. */
static struct box2 window_of(const struct subdivision *s, const struct block *b,
                             int margin) {
  const struct scan_grid *g = &s->frame->raster.grid;
  int64_t x0 = g->x_first + (b->column_from - margin) * g->x_step;
  int64_t x1 = g->x_first + (b->column_past + margin) * g->x_step;
  int64_t y0 = g->y_first + (b->line_from - margin) * g->y_step;
  int64_t y1 = g->y_first + (b->line_past + margin) * g->y_step;
  return (struct box2){clamp_to_grid(floor_divide(x0, g->den)),
                       clamp_to_grid(floor_divide(y0, g->den)),
                       clamp_to_grid(-floor_divide(-x1, g->den)),
                       clamp_to_grid(-floor_divide(-y1, g->den))};
}

/* ---- Pixels -------------------------------------------------------------- */

static size_t pixel_at(const struct subdivision *s, int32_t column,
                       int32_t line) {
  return raster_row(&s->frame->raster, line) + (size_t)column;
}

static void set_pixel(struct subdivision *s, size_t pixel, uint32_t facet,
                      uint32_t covered) {
  s->frame->raster.seen[pixel] = raster_seen(facet);
  if (s->frame->coverage != NULL)
    s->frame->coverage[pixel] = (uint16_t)covered;
}

static void fill_block(struct subdivision *s, const struct block *b,
                       uint32_t facet) {
  uint32_t all = (uint32_t)(s->frame->subpixels * s->frame->subpixels);
  for (int32_t line = b->line_from; line < b->line_past; line++)
    for (int32_t c = b->column_from; c < b->column_past; c++)
      set_pixel(s, pixel_at(s, c, line), facet, all);
}

/* Counts for each pixel of a line the sub-pixels that the facet covers. */
static void count_line(struct subdivision *s, const struct block *b,
                       int32_t line, uint32_t facet) {
  int32_t k = s->frame->subpixels;
  int64_t from = (int64_t)b->column_from * k, to = (int64_t)b->column_past * k;
  memset(s->count + b->column_from, 0,
         (size_t)(b->column_past - b->column_from) * sizeof *s->count);
  for (int32_t sub = line * k; sub < (line + 1) * k; sub++) {
    int64_t first, past;
    if (!warnock_sample_columns(&s->sample, facet, sub, &first, &past))
      continue;
    first = first < from ? from : first;
    past = past > to ? to : past;
    for (int64_t c = first; c < past;) {
      int64_t next = (c / k + 1) * k;
      if (next > past)
        next = past;
      s->count[c / k] += (uint32_t)(next - c);
      c = next;
    }
  }
}

/* Rules 2 and 3: draws the part of a facet that lies in the block. */
static void draw_facet(struct subdivision *s, const struct block *b,
                       uint32_t facet) {
  uint32_t all = (uint32_t)(s->frame->subpixels * s->frame->subpixels);
  for (int32_t line = b->line_from; line < b->line_past; line++) {
    count_line(s, b, line, facet);
    for (int32_t c = b->column_from; c < b->column_past; c++)
      if (s->count[c] > 0)
        set_pixel(s, pixel_at(s, c, line),
                  2 * s->count[c] >= all ? facet : SHEET_NONE, s->count[c]);
  }
}

/* The facet visible at a sub-pixel's centre.  Faces come nearest first: after
 * one whose nearest corner is behind the visible facet no other can be
 * visible. */
static uint32_t find_seen(const struct subdivision *s,
                          const struct pixel_window *win, int32_t column,
                          int32_t line) {
  uint32_t seen = SHEET_NONE;
  double low = -INFINITY;
  for (size_t i = win->surrounders.from; i < win->surrounders.to; i++) {
    uint32_t t = s->surrounders.item[i];
    if (seen == SHEET_NONE ||
        warnock_sample_is_nearer(&s->sample, t, seen, column, line))
      seen = t;
  }
  for (size_t i = win->faces.from; i < win->faces.to; i++) {
    uint32_t t = s->faces.item[i];
    if (seen != SHEET_NONE && low == -INFINITY) {
      struct sample_depth d =
          warnock_sample_depth(&s->sample, seen, column, line);
      low = d.z - d.error;
    }
    if (s->sample.plane[t].nearest < low)
      break;
    if (warnock_sample_covers(&s->sample, t, column, line) &&
        (seen == SHEET_NONE ||
         warnock_sample_is_nearer(&s->sample, t, seen, column, line))) {
      seen = t;
      low = -INFINITY;
    }
  }
  return seen;
}

static void draw_pixel(struct subdivision *s, const struct pixel_window *win) {
  int32_t k = s->frame->subpixels;
  uint32_t seen[SUBPIXELS_MAX * SUBPIXELS_MAX], all = 0, covered, facet;
  for (int32_t y = win->line * k; y < (win->line + 1) * k; y++)
    for (int32_t x = win->column * k; x < (win->column + 1) * k; x++)
      seen[all++] = raster_seen(find_seen(s, win, x, y));
  facet = raster_facet(subpixels_resolve(seen, all, &covered));
  set_pixel(s, pixel_at(s, win->column, win->line), facet, covered);
}

/* ---- Lists --------------------------------------------------------------- */

/* Is facet a visible rather than `other` wherever both cover the block? */
static bool wins_everywhere(const struct subdivision *s, const struct block *b,
                            uint32_t a, uint32_t other) {
  int32_t k = s->frame->subpixels;
  const int32_t column[2] = {b->column_from * k, b->column_past * k - 1};
  const int32_t line[2] = {b->line_from * k, b->line_past * k - 1};
  for (int corner = 0; corner < 4; corner++)
    if (!warnock_sample_is_nearer(&s->sample, a, other, column[corner & 1],
                                  line[corner >> 1]))
      return false;
  return true;
}

/* A surrounder that no other one hides throughout the block, and a lower bound
 * of its depths there. */
struct pixel_front {
  uint32_t facet; /* SHEET_NONE: no surrounder */
  double low;
};

/* Makes a surrounder the front if it is nearer than it throughout the block. */
static void update_front(const struct subdivision *s, const struct block *b,
                         uint32_t facet, struct pixel_front *front) {
  int32_t k = s->frame->subpixels;
  if (front->facet != SHEET_NONE && !wins_everywhere(s, b, facet, front->facet))
    return;
  front->facet = facet;
  front->low = INFINITY;
  for (int corner = 0; corner < 4; corner++) {
    struct sample_depth d = warnock_sample_depth(
        &s->sample, facet,
        corner & 1 ? b->column_past * k - 1 : b->column_from * k,
        corner & 2 ? b->line_past * k - 1 : b->line_from * k);
    front->low = fmin(front->low, d.z - d.error);
  }
}

static enum window_class classify(struct subdivision *s,
                                  const struct box2 *window, uint32_t t) {
  const uint32_t *corner, *side;
  struct geom_point p[FACET_CORNERS_MAX];
  uint32_t count = facet_outline(s->facets, s->sheet, t, &corner, &side);
  for (uint32_t k = 0; k < count; k++)
    p[k] = s->sheet->point.item[corner[k]];
  s->frame->classified++;
  return window_classify(window, p, (int)count, &s->tests);
}

/* Replaces the parent's lists by those of the faces that meet the window and of
 * those that surround it.
 * hidden  gets whether the front hides the rest of the parent's faces
 * Returns false when memory ran out. */
static bool list_faces(struct subdivision *s, const struct box2 *window,
                       const struct block *b, struct pixel_window *win,
                       struct pixel_front *front, bool *hidden) {
  struct pixel_range faces = win->faces, surrounders = win->surrounders;
  win->faces.from = s->faces.count;
  win->surrounders.from = s->surrounders.count;
  *front = (struct pixel_front){SHEET_NONE, -INFINITY};
  for (size_t i = surrounders.from; i < surrounders.to; i++) {
    uint32_t t = s->surrounders.item[i];
    if (!ARRAY_PUSH(&s->surrounders, t))
      return false;
    update_front(s, b, t, front);
  }
  for (size_t i = faces.from; i < faces.to; i++) {
    uint32_t t = s->faces.item[i];
    enum window_class class;
    *hidden = s->sample.plane[t].nearest < front->low;
    if (*hidden)
      break;
    class = classify(s, window, t);
    if (class == WINDOW_SURROUNDING) {
      if (!ARRAY_PUSH(&s->surrounders, t))
        return false;
      update_front(s, b, t, front);
    } else if (class != WINDOW_DISJOINT && !ARRAY_PUSH(&s->faces, t)) {
      return false;
    }
  }
  win->faces.to = s->faces.count;
  win->surrounders.to = s->surrounders.count;
  return true;
}

/* Removes from a list the faces that the front hides throughout the block;
 * returns where the list ends then. */
static size_t drop_hidden(const struct subdivision *s, const struct block *b,
                          uint32_t front, uint32_t *item,
                          const struct pixel_range *list) {
  size_t kept = list->from;
  for (size_t i = list->from; i < list->to; i++)
    if (item[i] == front || !wins_everywhere(s, b, front, item[i]))
      item[kept++] = item[i];
  return kept;
}

static bool list_edges(struct subdivision *s, const struct block *b,
                       struct pixel_window *win) {
  struct pixel_range edges = win->edges;
  struct box2 window = window_of(s, b, 1);
  win->edges.from = s->edges.count;
  for (size_t i = edges.from; i < edges.to; i++) {
    uint32_t e = s->edges.item[i];
    const uint32_t *point = s->sheet->edge.item[e].point;
    if (window_meets_edge(&window, s->sheet->point.item[point[0]],
                          s->sheet->point.item[point[1]]) &&
        !ARRAY_PUSH(&s->edges, e))
      return false;
  }
  win->edges.to = s->edges.count;
  return true;
}

/* ---- Division ------------------------------------------------------------ */

/* The pixel in which a sheet coordinate lies. */
static int32_t pixel_of(int64_t value, int64_t first, int64_t step,
                        int64_t den) {
  return (int32_t)floor_divide(value * den - first, step);
}

/* Puts four parts of the window onto the stack.  It is divided in the middle,
 * or at sides of the bounding box of its nearest face. */
static bool divide(struct subdivision *s, const struct pixel_window *win) {
  const struct scan_grid *g = &s->frame->raster.grid;
  int32_t x = win->column + win->columns / 2, y = win->line + win->lines / 2;
  if (s->request->divide_by_box && win->faces.from < win->faces.to) {
    struct box2 box =
        box2_of_triangle(s->sheet, s->faces.item[win->faces.from]);
    x = window_split(win->column, win->column + win->columns,
                     pixel_of(box.x0, g->x_first, g->x_step, g->den),
                     pixel_of(box.x1, g->x_first, g->x_step, g->den) + 1);
    y = window_split(win->line, win->line + win->lines,
                     pixel_of(box.y0, g->y_first, g->y_step, g->den),
                     pixel_of(box.y1, g->y_first, g->y_step, g->den) + 1);
  }
  for (int k = 0; k < 4; k++) {
    struct pixel_window part = *win;
    part.column = k & 1 ? x : win->column;
    part.line = k & 2 ? y : win->line;
    part.columns = k & 1 ? win->column + win->columns - x : x - win->column;
    part.lines = k & 2 ? win->line + win->lines - y : y - win->line;
    if (part.columns > 0 && part.lines > 0 && part.column < g->columns &&
        part.line < g->lines && !ARRAY_PUSH(&s->stack, part))
      return false;
  }
  if (s->stack.count > s->frame->stack_most)
    s->frame->stack_most = s->stack.count;
  return true;
}

/* Finishes the window by one of the five rules, or divides it.  Sets *rule. */
static bool apply_rules(struct subdivision *s, struct pixel_window *win,
                        const struct block *b, enum warnock_rule *rule) {
  struct box2 window = window_of(s, b, 0);
  struct pixel_front front;
  size_t faces, surrounders;
  bool hidden = false;
  if (!list_faces(s, &window, b, win, &front, &hidden))
    return false;
  faces = win->faces.to - win->faces.from;
  surrounders = win->surrounders.to - win->surrounders.from;
  hidden |= faces + surrounders > 1;
  if (front.facet != SHEET_NONE) {
    s->faces.count = win->faces.to =
        drop_hidden(s, b, front.facet, s->faces.item, &win->faces);
    s->surrounders.count = win->surrounders.to =
        drop_hidden(s, b, front.facet, s->surrounders.item, &win->surrounders);
    faces = win->faces.to - win->faces.from;
    surrounders = win->surrounders.to - win->surrounders.from;
  }
  if (faces + surrounders == 0) {
    *rule = WARNOCK_BACKGROUND;
  } else if (faces + surrounders > 1) {
    *rule = WARNOCK_DIVIDED;
    return divide(s, win);
  } else if (surrounders == 1) {
    *rule = hidden ? WARNOCK_FRONT : WARNOCK_SURROUNDER;
    fill_block(s, b, front.facet);
  } else {
    uint32_t t = s->faces.item[win->faces.from];
    *rule = classify(s, &window, t) == WINDOW_CONTAINED ? WARNOCK_CONTAINED
                                                        : WARNOCK_INTERSECTING;
    draw_facet(s, b, t);
  }
  return true;
}

static bool process_window(struct subdivision *s) {
  struct pixel_window win = s->stack.item[--s->stack.count];
  struct warnock_record record = {win.column, win.line, win.columns, win.lines,
                                  WARNOCK_PIXEL};
  struct block b = block_of(s, &win);
  s->faces.count = win.faces.to;
  s->surrounders.count = win.surrounders.to;
  s->edges.count = win.edges.to;
  if (!s->request->fragments && !list_edges(s, &b, &win))
    return false;
  if (!s->request->fragments && win.edges.from == win.edges.to)
    record.rule = WARNOCK_NO_EDGE;
  else if (win.columns == 1 && win.lines == 1)
    draw_pixel(s, &win);
  else if (!apply_rules(s, &win, &b, &record.rule))
    return false;
  if (record.rule != WARNOCK_DIVIDED)
    s->pixels_done += (uint64_t)(b.column_past - b.column_from) *
                      (uint64_t)(b.line_past - b.line_from);
  s->frame->windows[record.rule]++;
  return !s->frame->keep_records || ARRAY_PUSH(&s->frame->record, record);
}

/* Work per face of a window, in the units of progress.h. */
enum { WINDOW_WORK = 8 };

/* ---- Subdivision --------------------------------------------------------- */

/* Lists all facets to be drawn, nearest first, and all drawable edges. */
static bool fill_pools(struct subdivision *s) {
  const struct sheet *sheet = s->sheet;
  int left_out = SHEET_FLAT | (s->request->remove_backs ? SHEET_FLIPPED : 0);
  size_t n = sheet->triangle.count, count = 0;
  struct sort_key *key = mem_alloc(2 * n, sizeof *key);
  bool ok = key != NULL && ARRAY_RESERVE(&s->faces, n);
  for (uint32_t t = 0; ok && t < n; t++)
    if ((sheet->triangle_flags[t] & left_out) == 0 &&
        facet_of(s->facets, t) == t)
      key[count++] = (struct sort_key){
          ~sort_key_of_int64((int64_t)s->sample.plane[t].nearest), t};
  if (ok)
    sort_keys(key, key + n, count);
  for (size_t i = 0; ok && i < count; i++)
    s->faces.item[s->faces.count++] = key[i].value;
  mem_free(key);
  for (uint32_t e = 0; ok && !s->request->fragments && e < sheet->edge.count;
       e++)
    if (sheet->edge.item[e].edge_class != 0)
      ok = ARRAY_PUSH(&s->edges, e);
  return ok;
}

static bool run(struct subdivision *s) {
  const struct scan_grid *g = &s->frame->raster.grid;
  double pixels = (double)g->columns * g->lines;
  struct pixel_window page = {0};
  if (!fill_pools(s))
    return false;
  page.columns = 1;
  while (page.columns < g->columns || page.columns < g->lines)
    page.columns *= 2;
  page.lines = page.columns;
  page.faces.to = s->faces.count;
  page.edges.to = s->edges.count;
  if (!ARRAY_PUSH(&s->stack, page))
    return false;
  s->frame->stack_most = 1;
  while (s->stack.count > 0) {
    const struct pixel_window *next = &s->stack.item[s->stack.count - 1];
    size_t work = WINDOW_WORK * (1 + next->faces.to - next->faces.from +
                                 next->surrounders.to - next->surrounders.from);
    s->progress.share = (double)s->pixels_done / pixels;
    if (!progress_step(&s->progress, work) || !process_window(s))
      return false;
  }
  return true;
}

recto_status warnock_frame_draw(struct warnock_frame *frame,
                                const struct facets *facets,
                                const struct solver_request *request,
                                recto_error *error) {
  struct subdivision s = {.sheet = frame->raster.sheet,
                          .facets = facets,
                          .request = request,
                          .frame = frame,
                          .progress = progress_of(request, "subdividing")};
  struct scan_grid fine =
      raster_grid(s.sheet, frame->raster.grid.lines * frame->subpixels);
  bool ok;
  s.count = mem_alloc((size_t)frame->raster.grid.columns, sizeof *s.count);
  ok = s.count != NULL &&
       warnock_sample_init(&s.sample, s.sheet, facets, &fine) && run(&s);
  warnock_sample_fini(&s.sample);
  mem_free(s.count);
  ARRAY_FREE(&s.stack);
  ARRAY_FREE(&s.faces);
  ARRAY_FREE(&s.surrounders);
  ARRAY_FREE(&s.edges);
  return ok ? RECTO_OK : progress_error(&s.progress, error);
}
