/* warnock_window.h - the window that Warnock's subdivision starts from, the
 * size at which it ends, and the lines of a window for clipping. */
#ifndef VISIBILITY_WARNOCK_WARNOCK_WINDOW_H
#define VISIBILITY_WARNOCK_WARNOCK_WINDOW_H

#include "geom/line.h"
#include "view/sheet.h"
#include "visibility/predicate/window.h"

/* The window's borders as lines with the window on their left, and the same
 * lines reversed. */
void warnock_window_lines(const struct box2 *window, struct geom_line line[4],
                          struct geom_line back[4]);

/* The smallest square window about all points of the sheet, at least 2 units
 * wide, moved to lie within the grid's range. */
struct box2 warnock_page_window(const struct sheet *sheet);

/* Half the mean larger side of the triangles' bounding boxes, from a sample of
 * about 4096 of them; grid units, at least 1. */
int64_t warnock_edge_length(const struct sheet *sheet);

#endif
