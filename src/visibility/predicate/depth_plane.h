/* depth_plane.h - a triangle's plane as depths over the page, in doubles.
 *
 * One of three forms of a plane:
 *   geom_plane (geom/predicate.h)  exact: the side of a point, by integers;
 *   plane_filter                   the same in doubles with an error bound, and
 *                                  the contact tolerance;
 *   depth_plane                    the depth at any point of the page.
 * Frames of pixels and lines step from depth to depth by facet_slopes
 * (scan/facets.h), where the error is that of the steps.
 *
 * Error bound.  With u = 2^-53, each slope is the quotient of two numbers that
 * are rounded once, so it is off by 3 u relatively; by 4 u where it is divided
 * by the fraction of a unit in which x and y are integers.  A term of the sum
 * has a difference, which is exact for integers, a product and two sums: with
 * the slope's, at most 7 u, and z itself at most 3 u.  FILTER_ERROR of the sum
 * of the magnitudes is more than both.
 */
#ifndef VISIBILITY_PREDICATE_DEPTH_PLANE_H
#define VISIBILITY_PREDICATE_DEPTH_PLANE_H

#include <math.h>

#include "geom/predicate.h"

struct depth_plane {
  double x, y, z;      /* a point of it */
  double per_x, per_y; /* change of depth per grid unit */
};

/* The depths of a plane with nz > 0. */
static inline struct depth_plane
depth_plane_of(const struct geom_plane *plane) {
  double scale = -(double)plane->nz;
  return (struct depth_plane){plane->a.x, plane->a.y, (double)plane->a.z,
                              (double)plane->nx / scale,
                              (double)plane->ny / scale};
}

static inline double depth_plane_at(const struct depth_plane *plane, double x,
                                    double y) {
  return plane->z + plane->per_x * (x - plane->x) +
         plane->per_y * (y - plane->y);
}

/* An upper bound of the error of depth_plane_at for integers x and y. */
static inline double depth_plane_error(const struct depth_plane *plane,
                                       double x, double y) {
  return FILTER_ERROR * (fabs(plane->z) + fabs(plane->per_x * (x - plane->x)) +
                         fabs(plane->per_y * (y - plane->y)));
}

#endif
