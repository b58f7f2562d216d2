/* plane_filter.h - a floating-point filter for the side-of-plane tests, with
 * contact tolerance.
 *
 * All results are certified by an error bound: a test returns 0, or "may", when
 * the bound cannot certify a sign, and the caller then decides exactly
 * (occlusion.h).
 *
 * Two triangles can only pierce each other where each straddles the other's
 * plane or ends on it (intersection.h).  On a dense mesh nearly all neighbours
 * are within contact of each other's planes, and doubles suffice to see that.
 *
 * Source  [Shewchuk1997] for filters.
 */
#ifndef VISIBILITY_PREDICATE_PLANE_FILTER_H
#define VISIBILITY_PREDICATE_PLANE_FILTER_H

#include <math.h>

#include "view/sheet.h"

/* A triangle's plane and its contact tolerance as occlusion.h defines them, in
 * doubles with error bounds.  With d = p - corner,
 *     value(p)      is  n d,             off by less than  e |d|
 *     T(p) / 2^16   is  t0 + t1 z,       too small by less than
 *                                        t0_more + t1_more z,
 *                                        and off by less than t_error. */
struct plane_filter {
  double x, y, z;    /* a corner of the triangle */
  double nx, ny, nz; /* n, the normal */
  double ex, ey, ez; /* e, the error bound of the normal */
  double t0, t1;
  double t0_more, t1_more; /* what occlusion.h adds by rounding up */
  double t_error;          /* INFINITY where the filter cannot be used */
};

/* The plane of a triangle, which may be SHEET_EDGE_ON. */
struct plane_filter plane_filter_of(const struct sheet *sheet,
                                    uint32_t triangle);

/* The same for what asks for no contact: it takes a tenth of the time. */
struct plane_filter plane_filter_without_contact(const struct sheet *sheet,
                                                 uint32_t triangle);

/* An upper bound of the contact tolerance as a difference of depth; INFINITY
 * where there is none. */
double plane_filter_thickness(const struct plane_filter *plane);

/* May a triangle with these corners straddle the plane or end on it?  That is,
 * beyond the contact tolerance there are corners on both sides, or there is
 * just one corner.  False is certain. */
bool plane_filter_may_intersect(const struct plane_filter *plane,
                                const struct geom_point corner[3]);

/* May all three corners be in contact with the plane?  False is certain. */
bool plane_filter_may_touch(const struct plane_filter *plane,
                            const struct geom_point corner[3]);

/* May two triangles touch (triangle_pair.h)?  False is certain.
 * sf, sg  their planes */
bool triangles_may_touch(const struct sheet *sheet,
                         const struct plane_filter *sf, uint32_t f,
                         const struct plane_filter *sg, uint32_t g);

/* The sign of value + T at p: -1 where the point is behind the plane by more
 * than the contact tolerance, so that the triangle hides it; +1 where it is
 * not; 0 where that is not certain. */
int plane_filter_contact_sign(const struct plane_filter *plane,
                              struct geom_point p);

/* The same sign all along a part of the segment p-q, from parameter `from` to
 * `to`, in [0, 1] and rounded; 0 where it changes or is not certain. */
int plane_filter_contact_sign_between(const struct plane_filter *plane,
                                      struct geom_point p, struct geom_point q,
                                      double from, double to);

/* Compares the depths of two planes at a point of the page known to a quarter
 * of a unit: +1 where g is strictly nearer, -1 where f is, 0 where that is not
 * certain. */
int plane_filter_compare(const struct plane_filter *f,
                         const struct plane_filter *g, double x, double y);

/* The sign of the value alone: +1 in front of the plane, -1 behind it, 0 where
 * that is not certain. */
static inline int plane_filter_sign(const struct plane_filter *plane,
                                    struct geom_point p) {
  double dx = p.x - plane->x, dy = p.y - plane->y, dz = (double)p.z - plane->z;
  double value = plane->nx * dx + plane->ny * dy + plane->nz * dz;
  double off =
      plane->ex * fabs(dx) + plane->ey * fabs(dy) + plane->ez * fabs(dz);
  return (value > off) - (value < -off);
}

#endif
