/* warnock_tests.h - depths over a window: which faces a surrounder hides. */
#ifndef VISIBILITY_WARNOCK_TESTS_H
#define VISIBILITY_WARNOCK_TESTS_H

#include "geom/line.h"
#include "view/sheet.h"
#include "visibility/window.h"

/* Depths of a triangle's plane at a window's corners, less what contact and
 * rounding explain: the plane is nowhere in the window farther than that. */
struct warnock_corners {
  double at[4]; /* as window_line_function orders them */
  double low;   /* the least of them */
};

struct warnock_depth_counts {
  uint64_t sorted;  /* lists cut short: the rest is behind the front */
  uint64_t corners; /* faces dropped by depths at the corners */
};

/* Depths that a surrounder, not flat, surely reaches over the window. */
void warnock_corner_depths(const struct sheet *sheet, uint32_t triangle,
                           const struct window *window,
                           struct warnock_corners *depth);

/* The nearest depth of a triangle's corners. */
int64_t warnock_nearest(const struct sheet *sheet, uint32_t triangle);

/* Is the triangle behind the front at every corner of the window, for
 * certain?  By its nearest corner, else by its plane: sufficient, not
 * necessary. */
bool warnock_is_behind(const struct sheet *sheet, uint32_t triangle,
                       const struct window *window,
                       const struct warnock_corners *front,
                       struct warnock_depth_counts *counts);

/* The window's borders as lines with the window on their left, and turned
 * round. */
void warnock_window_lines(const struct window *window, struct geom_line line[4],
                          struct geom_line back[4]);

/* A square window around everything; the mean length of what is in it. */
struct window warnock_page_window(const struct sheet *sheet);
int64_t warnock_edge_length(const struct sheet *sheet);

#endif
