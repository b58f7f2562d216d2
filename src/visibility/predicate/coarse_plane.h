/* coarse_plane.h - a triangle's plane in doubles with one bound of its contact
 * tolerance for all depths: it decides most pairs, in a tenth of the time that
 * the tolerance itself takes (plane_filter.h).
 *
 * Robustness  Let u = 2^-53, and m >= |n| the sums of the magnitudes of the two
 * products of which each component of the normal is the difference.
 *   - The differences of points are exact, a component of the normal is off by
 *     less than 3u m, the value by less than 8u times the sum of m |d|, where
 *     |d| is at most the extent of the sheet.
 *   - The bound of the tolerance is linear in |n|, which may be too small by
 *     3u m; its factors are rounded up by more than its own roundings.
 *   - So is the lower bound; what |n| is too large by there is far less than
 *     the error bound of the value has to spare.
 */
#ifndef VISIBILITY_PREDICATE_COARSE_PLANE_H
#define VISIBILITY_PREDICATE_COARSE_PLANE_H

#include <math.h>

#include "view/sheet.h"

/* An upper bound of T (occlusion.h) over all depths of the sheet, for any
 * triangle of it, in units of value: at most 1 + level * nz + slope * (|nx| +
 * |ny|).  Coarse: see plane_filter_thickness. */
struct occlusion_bound {
  double level, slope;
  double grid; /* a lower bound of T: grid (|nx| + |ny| + nz) */
};
struct occlusion_bound occlusion_tolerance_bound_all(const struct sheet *sheet);

/* That bound of a triangle.
 * nz  gets the third component of its normal; the bound divided by it is one of
 *     the tolerance as a depth */
static inline double occlusion_bound_of(const struct occlusion_bound *all,
                                        const struct geom_triangle *corners,
                                        double *nz) {
  const struct geom_point *p = corners->p;
  double ux = p[1].x - p[0].x, uy = p[1].y - p[0].y,
         uz = (double)(p[1].z - p[0].z), vx = p[2].x - p[0].x,
         vy = p[2].y - p[0].y, vz = (double)(p[2].z - p[0].z);
  *nz = ux * vy - uy * vx;
  return 1 + all->level * *nz +
         all->slope * (fabs(uy * vz - uz * vy) + fabs(uz * vx - ux * vz));
}

struct coarse_plane {
  double x, y, z;    /* a corner of the triangle */
  double nx, ny, nz; /* the normal */
  double most;       /* more than the contact tolerance and the error of the
                        value at any point */
  double least;      /* less than the tolerance less that error */
};

static inline struct coarse_plane
coarse_plane_of(const struct occlusion_bound *all,
                const struct geom_point p[3]) {
  const double page = 2 * (double)SHEET_XY_MAX, depth = (double)SHEET_Z_MAX;
  double ux = p[1].x - p[0].x, uy = p[1].y - p[0].y,
         uz = (double)(p[1].z - p[0].z), vx = p[2].x - p[0].x,
         vy = p[2].y - p[0].y, vz = (double)(p[2].z - p[0].z);
  double x0 = uy * vz, x1 = uz * vy, y0 = uz * vx, y1 = ux * vz, z0 = ux * vy,
         z1 = uy * vx;
  double page_most = fabs(x0) + fabs(x1) + fabs(y0) + fabs(y1),
         depth_most = fabs(z0) + fabs(z1);
  struct coarse_plane plane = {.x = p[0].x,
                               .y = p[0].y,
                               .z = (double)p[0].z,
                               .nx = x0 - x1,
                               .ny = y0 - y1,
                               .nz = z0 - z1};
  double across = fabs(plane.nx) + fabs(plane.ny), along = fabs(plane.nz),
         error = FILTER_ERROR * (page * page_most + depth * depth_most);
  plane.most =
      error + 1 + all->level * along + all->slope * across +
      FILTER_ERROR * (all->slope * page_most + all->level * depth_most);
  plane.least = all->grid * (across + along) - error;
  return plane;
}

static inline double coarse_plane_value(const struct coarse_plane *plane,
                                        struct geom_point p) {
  return plane->nx * (p.x - plane->x) + plane->ny * (p.y - plane->y) +
         plane->nz * ((double)p.z - plane->z);
}

/* The sign of value + T at p: -1 where the triangle hides the point, being in
 * front of it by more than the contact tolerance; +1 where it does not; 0 where
 * that is not certain. */
static inline int coarse_plane_contact_sign(const struct coarse_plane *plane,
                                            struct geom_point p) {
  double value = coarse_plane_value(plane, p);
  return (value > -plane->least) - (value < -plane->most);
}

/* May all three corners be in contact with the plane?  False is certain; it is
 * true where there is no bound of the tolerance. */
static inline bool coarse_plane_may_touch(const struct coarse_plane *plane,
                                          const struct geom_point corner[3]) {
  return !(fabs(coarse_plane_value(plane, corner[0])) > plane->most ||
           fabs(coarse_plane_value(plane, corner[1])) > plane->most ||
           fabs(coarse_plane_value(plane, corner[2])) > plane->most);
}

/* The same sign all along a part of the segment p-q, from parameter `from` to
 * `to`, in [0, 1] and rounded.  That and interpolation make the value differ by
 * less than a part of the error bound more, for which most is doubled. */
static inline int
coarse_plane_contact_sign_between(const struct coarse_plane *plane,
                                  struct geom_point p, struct geom_point q,
                                  double from, double to) {
  double at_p = coarse_plane_value(plane, p),
         more = coarse_plane_value(plane, q) - at_p, a = at_p + from * more,
         b = at_p + to * more, most = 2 * plane->most;
  return ((a > most) & (b > most)) - ((a < -most) & (b < -most));
}

/* The corners of a triangle that are certainly behind the plane, in front of
 * it, and in contact with it. */
struct coarse_counts {
  int behind, in_front, touching;
};

static inline struct coarse_counts
coarse_plane_counts(const struct coarse_plane *plane,
                    const struct geom_point corner[3]) {
  struct coarse_counts count = {0, 0, 0};
  for (int k = 0; k < 3; k++) {
    double value = coarse_plane_value(plane, corner[k]);
    count.behind += value < -plane->most;
    count.in_front += value > plane->most;
    count.touching += fabs(value) < plane->least;
  }
  return count;
}

/* Is the triangle certainly on both sides of the plane, no corner in contact
 * with it? */
static inline bool coarse_counts_straddle(struct coarse_counts count) {
  return count.behind + count.in_front == 3 && count.behind % 3 != 0;
}

/* May the triangle straddle the plane or end on it, as
 * plane_filter_may_intersect has it?  False is certain; it is true where the
 * triangle certainly straddles. */
static inline bool coarse_counts_may_intersect(struct coarse_counts count) {
  return count.behind + count.in_front + count.touching < 3 ||
         (count.behind > 0 && count.in_front > 0) || count.touching == 2;
}

#endif
