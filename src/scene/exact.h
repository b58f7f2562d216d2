/* exact.h - signs that are right for any finite doubles, not only for points
 * on the page grid. */
#ifndef SCENE_EXACT_H
#define SCENE_EXACT_H

#include <float.h>
#include <math.h>
#include <stdbool.h>

#include "scene/scene.h"

/* The side of the line from a to b on which c lies, for points x, y.
 * Returns 1 where a, b, c turn counter-clockwise, -1 clockwise, 0 on it.
 * Exact: for all finite coordinates, the smallest and the largest too. */
int exact_orient2d(const double a[2], const double b[2], const double c[2]);

/* Whether three points surely are not on one line, decided from one view along
 * an axis: a no says nothing.  The bound is that of exact.c. */
static inline bool exact_surely_not_collinear(double ax, double ay, double bx,
                                              double by, double cx, double cy) {
  double left = (bx - ax) * (cy - ay);
  double right = (by - ay) * (cx - ax);
  double bound = 2.5 * DBL_EPSILON * (fabs(left) + fabs(right)) + DBL_MIN;
  return fabs(left - right) > bound;
}

/* Whether three points lie on one line; also where two of them are equal.
 * Exact: likewise. */
bool exact_are_collinear(const struct scene_point *a,
                         const struct scene_point *b,
                         const struct scene_point *c);

#endif
