/* window.h - how a polygon lies to a window of the page: Warnock's four
 * classes, by Warnock's tests.
 *
 * A window is closed: what only touches it intersects it.  A polygon is a
 * closed loop of integer points, either way round.
 *
 * Source  [Warnock1969]; [Rogers1985] ch. 4 for the tests.
 */
#ifndef VISIBILITY_PREDICATE_WINDOW_H
#define VISIBILITY_PREDICATE_WINDOW_H

#include "geom/predicate.h"

struct window {
  int32_t x0, y0, x1, y1; /* grid units, x0 < x1, y0 < y1 */
};

enum window_class {
  WINDOW_DISJOINT,
  WINDOW_CONTAINED,
  WINDOW_INTERSECTING,
  WINDOW_SURROUNDING
};

/* How many polygons each test settled. */
struct window_counts {
  uint64_t box, sign, angle;
};

enum window_class window_classify(const struct window *window,
                                  const struct geom_point *corner, int count,
                                  struct window_counts *counts);

/* Bounding boxes: DISJOINT, CONTAINED, or INTERSECTING where they do not
 * tell. */
enum window_class window_box_test(const struct window *window,
                                  const struct geom_point *corner, int count);

/* The line function of p-q, positive on its left, at the window's corners:
 * (x0, y0), (x0, y1), (x1, y1), (x1, y0). */
void window_line_function(const struct window *window, struct geom_point p,
                          struct geom_point q, int64_t value[4]);

/* Does the segment p-q meet the window?  By the signs of its line function at
 * the corners, and its box. */
bool window_meets_edge(const struct window *window, struct geom_point p,
                       struct geom_point q);

/* In which of the eight fields about the window a point lies: 0 to its right,
 * 1 upper right, and on counter-clockwise; -1 inside it. */
int window_octant(const struct window *window, int64_t x, int64_t y);

/* The sum of the octants' differences along a polygon no edge of which meets
 * the window: 0 where they are disjoint, +-8 n where it surrounds the window
 * n times.  A difference of 4 is ambiguous: the edge is halved until its parts
 * tell. */
int window_angle_count(const struct window *window,
                       const struct geom_point *corner, int count);

/* The same question by a ray from the window's lower left corner downwards:
 * how often the polygon crosses it; an even number: disjoint.  A corner on
 * the ray's line counts with the edge on its right alone. */
int window_ray_count(const struct window *window,
                     const struct geom_point *corner, int count);

/* The part of the segment p-q inside the closed window as parameters; false
 * where there is none. */
bool window_clip(const struct window *window, struct geom_point p,
                 struct geom_point q, struct ratio *from, struct ratio *to);

/* Where to cut the range from..to: at `low` or `high`, the sides of a box, the
 * one nearer to the middle, or in the middle where that would cut off less
 * than a quarter. */
int32_t window_cut(int32_t from, int32_t to, int32_t low, int32_t high);

#endif
