/* warnock_window.h - the windows that warnock starts from and clips to. */
#ifndef VISIBILITY_WARNOCK_WARNOCK_WINDOW_H
#define VISIBILITY_WARNOCK_WARNOCK_WINDOW_H

#include "geom/line.h"
#include "view/sheet.h"
#include "visibility/predicate/window.h"

/* The window's borders as lines with the window on their left, and turned
 * round. */
void warnock_window_lines(const struct window *window, struct geom_line line[4],
                          struct geom_line back[4]);

/* A square window around everything; the mean length of what is in it. */
struct window warnock_page_window(const struct sheet *sheet);
int64_t warnock_edge_length(const struct sheet *sheet);

#endif
