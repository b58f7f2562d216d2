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
 * Invariants  those of warnock_windows.h.
 * Source  [Warnock1969]; [Rogers1985] ch. 4.
 */
#include "visibility/warnock/warnock_raster.h"

#include <math.h>
#include <string.h>

#include "visibility/progress.h"
#include "visibility/raster/pixels.h"
#include "visibility/raster/subpixels.h"
#include "visibility/warnock/warnock_sample.h"
#include "visibility/warnock/warnock_windows.h"

struct subdivision {
  const struct solver_request *request;
  struct warnock_frame *frame;
  struct progress progress;
  struct warnock_sample sample;
  struct warnock_windows windows;
  uint32_t *count; /* scratch, one a column: sub-pixels covered */
  uint64_t pixels_done;
};

/* ---- Windows ------------------------------------------------------------- */

static int32_t clamp_to_grid(int64_t value) {
  if (value > SHEET_XY_MAX)
    return SHEET_XY_MAX;
  return value < -SHEET_XY_MAX ? -SHEET_XY_MAX : (int32_t)value;
}

static int64_t floor_divide(int64_t num, int64_t den) {
  return num / den - (num % den < 0);
}

/* A window on the sheet, `margin` pixels wider on each side.  No face lies
 * beyond SHEET_XY_MAX: clipping the window there changes no class. */
static struct box2 window_of(const struct subdivision *s, const struct box2 *b,
                             int margin) {
  const struct scan_grid *g = &s->frame->raster.grid;
  int64_t x0 = g->x_first + (b->x0 - margin) * g->x_step;
  int64_t x1 = g->x_first + (b->x1 + margin) * g->x_step;
  int64_t y0 = g->y_first + (b->y0 - margin) * g->y_step;
  int64_t y1 = g->y_first + (b->y1 + margin) * g->y_step;
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

static void fill_block(struct subdivision *s, const struct box2 *b,
                       uint32_t facet) {
  uint32_t all = (uint32_t)(s->frame->subpixels * s->frame->subpixels);
  for (int32_t line = b->y0; line < b->y1; line++)
    for (int32_t c = b->x0; c < b->x1; c++)
      set_pixel(s, pixel_at(s, c, line), facet, all);
}

/* Counts for each pixel of a line the sub-pixels that the facet covers. */
static void count_line(struct subdivision *s, const struct box2 *b,
                       int32_t line, uint32_t facet) {
  int32_t k = s->frame->subpixels;
  int64_t from = (int64_t)b->x0 * k, to = (int64_t)b->x1 * k;
  memset(s->count + b->x0, 0, (size_t)(b->x1 - b->x0) * sizeof *s->count);
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
static void draw_facet_in_block(struct subdivision *s, const struct box2 *b,
                                uint32_t facet) {
  uint32_t all = (uint32_t)(s->frame->subpixels * s->frame->subpixels);
  for (int32_t line = b->y0; line < b->y1; line++) {
    count_line(s, b, line, facet);
    for (int32_t c = b->x0; c < b->x1; c++)
      if (s->count[c] > 0)
        set_pixel(s, pixel_at(s, c, line),
                  2 * s->count[c] >= all ? facet : SHEET_NONE, s->count[c]);
  }
}

/* The facet visible at a sub-pixel's centre.  Faces come nearest first: after
 * one whose nearest corner is behind the visible facet no other can be
 * visible. */
static uint32_t facet_at_subpixel(const struct subdivision *s,
                                  const struct warnock_window *win,
                                  int32_t column, int32_t line) {
  uint32_t seen = SHEET_NONE;
  double low = -INFINITY;
  for (size_t i = win->surrounders.from; i < win->surrounders.to; i++) {
    uint32_t t = s->windows.surrounder_pool.item[i];
    if (seen == SHEET_NONE ||
        warnock_sample_is_nearer(&s->sample, t, seen, column, line))
      seen = t;
  }
  for (size_t i = win->facets.from; i < win->facets.to; i++) {
    uint32_t t = s->windows.facet_pool.item[i];
    if (seen != SHEET_NONE && low == -INFINITY) {
      struct sample_depth d =
          warnock_sample_depth(&s->sample, seen, column, line);
      low = d.z - d.error;
    }
    if (s->windows.nearest[t] < low)
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

static void draw_pixel(struct subdivision *s,
                       const struct warnock_window *win) {
  int32_t k = s->frame->subpixels;
  uint32_t seen[SUBPIXELS_MAX * SUBPIXELS_MAX], all = 0, covered, facet;
  for (int32_t y = win->box.y0 * k; y < win->box.y1 * k; y++)
    for (int32_t x = win->box.x0 * k; x < win->box.x1 * k; x++)
      seen[all++] = raster_seen(facet_at_subpixel(s, win, x, y));
  facet = raster_facet(subpixels_resolve(seen, all, &covered));
  set_pixel(s, pixel_at(s, win->box.x0, win->box.y0), facet, covered);
}

/* ---- The front ----------------------------------------------------------- */

/* Is facet a visible rather than `other` wherever both cover the block? */
static bool is_nearer_in_block(const struct subdivision *s,
                               const struct box2 *b, uint32_t a,
                               uint32_t other) {
  int32_t k = s->frame->subpixels;
  const int32_t column[2] = {b->x0 * k, b->x1 * k - 1};
  const int32_t line[2] = {b->y0 * k, b->y1 * k - 1};
  for (int corner = 0; corner < 4; corner++)
    if (!warnock_sample_is_nearer(&s->sample, a, other, column[corner & 1],
                                  line[corner >> 1]))
      return false;
  return true;
}

/* Makes a surrounder the front if it is nearer than it throughout the block. */
static void update_block_front(void *user, const struct box2 *b, uint32_t facet,
                               struct warnock_front *front) {
  const struct subdivision *s = user;
  int32_t k = s->frame->subpixels;
  if (front->facet != SHEET_NONE &&
      !is_nearer_in_block(s, b, facet, front->facet))
    return;
  front->facet = facet;
  front->depth.low = INFINITY;
  for (int corner = 0; corner < 4; corner++) {
    struct sample_depth d = warnock_sample_depth(
        &s->sample, facet, corner & 1 ? b->x1 * k - 1 : b->x0 * k,
        corner & 2 ? b->y1 * k - 1 : b->y0 * k);
    front->depth.low = fmin(front->depth.low, d.z - d.error);
  }
}

static bool block_front_hides(void *user, const struct box2 *b,
                              const struct warnock_front *front,
                              uint32_t facet) {
  return is_nearer_in_block(user, b, front->facet, facet);
}

/* ---- Division ------------------------------------------------------------ */

/* The pixel in which a sheet coordinate lies. */
static int32_t pixel_of(int64_t value, int64_t first, int64_t step,
                        int64_t den) {
  return (int32_t)floor_divide(value * den - first, step);
}

/* Divides the window into quarters whose sides are powers of two, less what
 * lies outside the frame, or at sides of the bounding box of its nearest
 * face. */
static bool divide_block(struct subdivision *s,
                         const struct warnock_window *win) {
  const struct scan_grid *g = &s->frame->raster.grid;
  const struct box2 *b = &win->box;
  int32_t half = 1;
  while (2 * half < b->x1 - b->x0 || 2 * half < b->y1 - b->y0)
    half *= 2;
  int32_t x = b->x0 + half, y = b->y0 + half;
  if (s->request->divide_by_box && warnock_count(win->facets) > 0) {
    struct box2 face = box2_of_triangle(
        s->windows.sheet, s->windows.facet_pool.item[win->facets.from]);
    x = window_split(b->x0, b->x1,
                     pixel_of(face.x0, g->x_first, g->x_step, g->den),
                     pixel_of(face.x1, g->x_first, g->x_step, g->den) + 1);
    y = window_split(b->y0, b->y1,
                     pixel_of(face.y0, g->y_first, g->y_step, g->den),
                     pixel_of(face.y1, g->y_first, g->y_step, g->den) + 1);
  }
  return warnock_divide(&s->windows, win, x, y);
}

/* Finishes the window by one of the five rules, or divides it.  Sets *rule. */
static bool apply_rules(struct subdivision *s, struct warnock_window *win,
                        enum warnock_rule *rule) {
  struct box2 on_sheet = window_of(s, &win->box, 0);
  struct warnock_front front;
  if (!warnock_list_facets(&s->windows, win, &on_sheet, &front))
    return false;
  size_t faces = warnock_count(win->facets),
         surrounders = warnock_count(win->surrounders);
  if (faces + surrounders == 0) {
    *rule = WARNOCK_BACKGROUND;
  } else if (faces + surrounders > 1) {
    *rule = WARNOCK_DIVIDED;
    return divide_block(s, win);
  } else if (surrounders == 1) {
    *rule = front.hides ? WARNOCK_FRONT : WARNOCK_SURROUNDER;
    fill_block(s, &win->box, front.facet);
  } else {
    uint32_t t = s->windows.facet_pool.item[win->facets.from];
    *rule = warnock_classify(&s->windows, &on_sheet, t) == WINDOW_CONTAINED
                ? WARNOCK_CONTAINED
                : WARNOCK_INTERSECTING;
    draw_facet_in_block(s, &win->box, t);
  }
  return true;
}

/* Work per face of a window, in the units of progress.h. */
enum { WINDOW_WORK = 8 };

static bool process_block(struct subdivision *s) {
  struct warnock_window win = warnock_windows_pop(&s->windows);
  struct box2 nearby = {0};
  bool lines_only = !s->request->fragments;
  if (lines_only)
    nearby = window_of(s, &win.box, 1);
  enum warnock_rule rule = WARNOCK_PIXEL;
  uint64_t pixels =
      (uint64_t)(win.box.x1 - win.box.x0) * (uint64_t)(win.box.y1 - win.box.y0);
  if (!progress_step(&s->progress,
                     WINDOW_WORK * (1 + warnock_count(win.facets) +
                                    warnock_count(win.surrounders))) ||
      (lines_only && !warnock_list_edges(&s->windows, &win, &nearby, NULL)))
    return false;
  if (lines_only && warnock_count(win.edges) == 0)
    rule = WARNOCK_NO_EDGE;
  else if (pixels == 1)
    draw_pixel(s, &win);
  else if (!apply_rules(s, &win, &rule))
    return false;
  if (rule != WARNOCK_DIVIDED)
    s->pixels_done += pixels;
  s->frame->windows[rule]++;
  return true;
}

static bool subdivide_frame(struct subdivision *s) {
  const struct scan_grid *grid = &s->frame->raster.grid;
  struct box2 frame = {0, 0, grid->columns, grid->lines};
  int left_out = SHEET_EDGE_ON | (s->request->remove_backs ? SHEET_FLIPPED : 0);
  if (!warnock_windows_init(&s->windows, &frame, left_out, NULL,
                            !s->request->fragments))
    return false;
  while (s->windows.stack.count > 0) {
    s->progress.share =
        (double)s->pixels_done / ((double)grid->columns * grid->lines);
    if (!process_block(s))
      return false;
  }
  return true;
}

recto_status warnock_frame_draw(struct warnock_frame *frame,
                                const struct facets *facets,
                                const struct solver_request *request,
                                recto_error *error) {
  const struct sheet *sheet = frame->raster.sheet;
  struct subdivision s = {.request = request,
                          .frame = frame,
                          .progress = progress_of(request, "subdividing"),
                          .windows = {.sheet = sheet,
                                      .facets = facets,
                                      .update_front = update_block_front,
                                      .hides = block_front_hides,
                                      .user = &s}};
  struct scan_grid fine =
      raster_grid(sheet, frame->raster.grid.lines * frame->subpixels);
  s.count = mem_alloc((size_t)frame->raster.grid.columns, sizeof *s.count);
  bool ok = s.count != NULL &&
            warnock_sample_init(&s.sample, sheet, facets, &fine) &&
            subdivide_frame(&s);
  warnock_sample_fini(&s.sample);
  warnock_windows_fini(&s.windows);
  mem_free(s.count);
  return ok ? RECTO_OK : error_memory(error);
}
