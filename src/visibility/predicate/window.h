/* window.h - classifies polygons against a window of the page: Warnock's four
 * classes, by Warnock's tests.
 *
 * A window is a box2 with x0 < x1 and y0 < y1.  It is closed: a polygon that
 * only touches it intersects it.  A polygon is a closed loop of integer points
 * in either orientation.
 *
 * Source  [Warnock1969]; [Rogers1985] ch. 4 for the tests.
 */
#ifndef VISIBILITY_PREDICATE_WINDOW_H
#define VISIBILITY_PREDICATE_WINDOW_H

#include "geom/predicate.h"
#include "visibility/predicate/box2.h"

enum window_class {
  WINDOW_DISJOINT,
  WINDOW_CONTAINED,    /* the polygon lies within the window */
  WINDOW_INTERSECTING, /* its boundary meets the window's */
  WINDOW_SURROUNDING   /* it contains the window */
};

/* How many polygons each test decided. */
struct window_counts {
  uint64_t box, sign, angle;
};

/* Classifies by bounding boxes, then by the signs of the edges' line functions,
 * then by the angle count. */
enum window_class window_classify(const struct box2 *window,
                                  const struct geom_point *corner, int count,
                                  struct window_counts *counts);

/* Classifies by bounding boxes alone: DISJOINT, CONTAINED, or INTERSECTING
 * where they do not decide. */
enum window_class window_box_test(const struct box2 *window,
                                  const struct geom_point *corner, int count);

/* The line function of p-q, positive on its left, at the window's corners:
 * (x0, y0), (x0, y1), (x1, y1), (x1, y0). */
void window_line_function(const struct box2 *window, struct geom_point p,
                          struct geom_point q, int64_t value[4]);

/* Does the segment p-q meet the window?  By the signs of its line function at
 * the corners, and by its box. */
bool window_meets_edge(const struct box2 *window, struct geom_point p,
                       struct geom_point q);

/* In which of the eight regions around the window the point (x, y) / 2^bits
 * lies: 0 to its right, 1 to its upper right, and on counter-clockwise; -1
 * inside it. */
int window_octant(const struct box2 *window, int64_t x, int64_t y, int bits);

/* The winding number of a polygon about the window, in octants: the sum of the
 * differences of octants along its edges, none of which may meet the window.
 * 0 where they are disjoint, +-8 n where the polygon surrounds the window n
 * times.  A difference of 4 is ambiguous: such an edge is bisected until its
 * parts decide. */
int window_angle_count(const struct box2 *window,
                       const struct geom_point *corner, int count);

/* Clips the segment p-q to the closed window.
 * from, to  get the parameters of the clipped segment
 * Returns false where nothing is left. */
bool window_clip(const struct box2 *window, struct geom_point p,
                 struct geom_point q, struct ratio *from, struct ratio *to);

/* The coordinate at which to split the range from..to, given a box with sides
 * at `low` and `high`: at the side nearer to the middle, or in the middle where
 * a side would split off less than a quarter. */
int32_t window_split(int32_t from, int32_t to, int32_t low, int32_t high);

#endif
