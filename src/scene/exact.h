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

/* The same from any of the three views. */
static inline bool exact_surely_not_on_one_line(const struct scene_point *a,
                                                const struct scene_point *b,
                                                const struct scene_point *c) {
  return exact_surely_not_collinear(a->x, a->y, b->x, b->y, c->x, c->y) ||
         exact_surely_not_collinear(a->y, a->z, b->y, b->z, c->y, c->z) ||
         exact_surely_not_collinear(a->z, a->x, b->z, b->x, c->z, c->x);
}

/* Whether triangles a, b, c and a, c, d turn the same way, so that b and d lie
 * on either side of the diagonal and the sides cannot cross.  Rounding may
 * give a false no, which costs a closer look, or, where the two are all but
 * square to each other, a yes that a closer look would have given too. */
static inline bool exact_halves_agree(const struct scene_point *a,
                                      const struct scene_point *b,
                                      const struct scene_point *c,
                                      const struct scene_point *d) {
  double bx = b->x - a->x, by = b->y - a->y, bz = b->z - a->z;
  double cx = c->x - a->x, cy = c->y - a->y, cz = c->z - a->z;
  double dx = d->x - a->x, dy = d->y - a->y, dz = d->z - a->z;
  double x = (by * cz - bz * cy) * (cy * dz - cz * dy);
  double y = (bz * cx - bx * cz) * (cz * dx - cx * dz);
  double z = (bx * cy - by * cx) * (cx * dy - cy * dx);
  return x + y + z > 0;
}

/* Whether three points lie on one line; also where two of them are equal.
 * Exact: likewise. */
bool exact_are_collinear(const struct scene_point *a,
                         const struct scene_point *b,
                         const struct scene_point *c);

#endif
