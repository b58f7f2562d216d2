/* intersection_estimate.h - where two triangles intersect, in doubles: enough
 * to know that nobody sees it, in a third of the time of the exact segment.
 *
 * Robustness.  Each corner of one triangle is off the plane of the other by
 * more than `most` (coarse_plane.h), at least 1024 times a value's error E.
 * So the parameter at which a side meets the plane, a / (a - b), is off by less
 * than 2 E / most; and its point by that share of the triangle's extent, and
 * rounding.
 *   The segment is what the two parts of the common line within the triangles
 * have in common.  With each end off by e at most on the page, and the first
 * part longer than 64 e along an axis, the parameters on it where the other
 * part ends are off by less than 8 e / length.
 */
#ifndef VISIBILITY_INTERSECTION_INTERSECTION_ESTIMATE_H
#define VISIBILITY_INTERSECTION_INTERSECTION_ESTIMATE_H

#include "visibility/predicate/coarse_plane.h"

struct intersection_estimate {
  bool empty; /* the triangles do not intersect */
  struct geom_point end[2];
  double xy_error,
      z_error; /* each coordinate of each point of the exact segment
                               is off the estimate by less */
};

/* Estimates the segment of two triangles that straddle each other's planes, no
 * corner in contact.  Returns false where the error is too large.
 * f, g    their corners
 * cf, cg  their planes
 * all     the bound with which these were made */
bool intersection_estimate_of(struct intersection_estimate *estimate,
                              const struct geom_point f[3],
                              const struct geom_point g[3],
                              const struct coarse_plane *cf,
                              const struct coarse_plane *cg,
                              const struct occlusion_bound *all);

#endif
