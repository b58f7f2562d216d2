/* plane_filter.h - how points lie to the plane of a triangle, contact allowed, told
 * in doubles that know when they cannot tell.
 *
 * Two triangles can only pierce each other where each straddles the other's
 * plane, or ends on it (intersection.h).  On a dense mesh nearly all neighbours lie
 * within contact of each other's planes, and doubles suffice to see it.
 */
#ifndef VISIBILITY_PREDICATE_PLANE_FILTER_H
#define VISIBILITY_PREDICATE_PLANE_FILTER_H

#include <math.h>

#include "view/sheet.h"

/* A plane as occlusion.h has it, value(p) against the tolerance T(p) / 2^16, with
 * bounds for what the doubles are off. */
struct plane_filter {
  double x, y, z;          /* of a corner */
  double nx, ny, nz;       /* value(p) = n (p - corner) */
  double ex, ey, ez;       /* it is off by less than e |p - corner| */
  double t0, t1;           /* the tolerance is t0 + t1 z ... */
  double t0_more, t1_more; /* ... or more, by less than this ... */
  double t_off;            /* ... or more or less, by less than that */
};

/* The plane of a triangle, which may be SHEET_FLAT. */
struct plane_filter plane_filter_of(const struct sheet *sheet,
                                    uint32_t triangle);

/* May these corners straddle the plane, or end on it: some behind it and some
 * before it by more than the tolerance, or just one of them?  A no is
 * certain. */
bool plane_filter_may_intersect(const struct plane_filter *plane,
                                const struct geom_point corner[3]);

/* May all three corners touch the plane?  A no is certain. */
bool plane_filter_may_touch(const struct plane_filter *plane,
                            const struct geom_point corner[3]);

/* May two triangles touch (triangle_pair.h)?  A no is certain.
 * sf, sg  their planes */
bool plane_filters_may_touch(const struct sheet *sheet,
                             const struct plane_filter *sf, uint32_t f,
                             const struct plane_filter *sg, uint32_t g);

/* The sign of value + tolerance: -1 where the triangle is in front of the
 * point by more than contact explains, so that it hides it; 0: not known. */
int plane_filter_occludes(const struct plane_filter *plane,
                          struct geom_point p);

/* Which of two planes is nearer at a place of the page, known to a quarter of a
 * unit: +1 the second one, -1 the first one, strictly; 0: not known. */
int plane_filter_nearer(const struct plane_filter *f,
                        const struct plane_filter *g, double x, double y);

/* The sign of the value alone: before the plane or behind it; 0: not known. */
static inline int plane_filter_sign(const struct plane_filter *plane,
                                    struct geom_point p) {
  double dx = p.x - plane->x, dy = p.y - plane->y, dz = (double)p.z - plane->z;
  double value = plane->nx * dx + plane->ny * dy + plane->nz * dz;
  double off =
      plane->ex * fabs(dx) + plane->ey * fabs(dy) + plane->ez * fabs(dz);
  return (value > off) - (value < -off);
}

#endif
