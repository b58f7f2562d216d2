/* predicate.h - exact predicates on points of the page grid.
 *
 * Ranges: |x|, |y| < 2^30, 0 <= z < 2^40, so coordinate differences are below
 * 2^31 in x, y and 2^40 in z.
 *
 *   orient2d   two products of 31-bit differences: each below 2^62, their
 *              difference below 2^63.
 *   normal     nx, ny: 2 * 2^31 * 2^40 < 2^72;  nz: below 2^63, and below 2^62
 *              for three corners inside one square of side 2^31.
 *   plane      nx dx + ny dy + nz dz < 2 * 2^103 + 2^103 < 2^105.
 */
#ifndef GEOM_PREDICATE_H
#define GEOM_PREDICATE_H

#include "geom/ratio.h"

/* The error bound of a floating-point filter: a sum in doubles, of terms that
 * together with the sum take fewer than 14 roundings each, is off by less than
 * this share of the sum of their magnitudes [Shewchuk1997]. */
#define FILTER_ERROR (16 * 0x1p-53)

struct geom_point {
  int32_t x, y;
  int64_t z;
};

struct geom_segment {
  struct geom_point p, q;
};

struct geom_triangle {
  struct geom_point p[3];
};

/* The corner after corner k of a triangle, in its order. */
static inline int geom_next_corner(int k) { return k == 2 ? 0 : k + 1; }

/* The farthest and the nearest depth of three corners. */
static inline void geom_depth_range(const struct geom_point p[3], int64_t *low,
                                    int64_t *high) {
  *low = *high = p[0].z;
  for (int k = 1; k < 3; k++) {
    if (p[k].z < *low)
      *low = p[k].z;
    if (p[k].z > *high)
      *high = p[k].z;
  }
}

static inline int geom_sign64(int64_t a) { return (a > 0) - (a < 0); }
static inline int geom_sign128(int128 a) { return (a > 0) - (a < 0); }

/* Twice the signed area of a, b, c on the page: positive counter-clockwise. */
static inline int64_t geom_orient2d(struct geom_point a, struct geom_point b,
                                    struct geom_point c) {
  int64_t abx = (int64_t)b.x - a.x, aby = (int64_t)b.y - a.y;
  int64_t acx = (int64_t)c.x - a.x, acy = (int64_t)c.y - a.y;
  return abx * acy - aby * acx;
}

/* The plane of a triangle: value(p) = nx (x - a.x) + ny (y - a.y) +
 * nz (z - a.z).  With a counter-clockwise triangle nz > 0 and the value is
 * positive in front of the plane, towards the viewer. */
struct geom_plane {
  int128 nx, ny;
  int64_t nz;
  struct geom_point a;
};

static inline struct geom_plane
geom_plane_of(struct geom_point a, struct geom_point b, struct geom_point c) {
  int64_t ux = (int64_t)b.x - a.x, uy = (int64_t)b.y - a.y, uz = b.z - a.z;
  int64_t vx = (int64_t)c.x - a.x, vy = (int64_t)c.y - a.y, vz = c.z - a.z;
  struct geom_plane plane;
  plane.nx = (int128)uy * vz - (int128)uz * vy;
  plane.ny = (int128)uz * vx - (int128)ux * vz;
  plane.nz = ux * vy - uy * vx;
  plane.a = a;
  return plane;
}

static inline int128 geom_plane_value(const struct geom_plane *plane,
                                      struct geom_point p) {
  return plane->nx * ((int64_t)p.x - plane->a.x) +
         plane->ny * ((int64_t)p.y - plane->a.y) +
         (int128)plane->nz * (p.z - plane->a.z);
}

static inline bool geom_same_point(struct geom_point a, struct geom_point b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* An order of points: by x, then by y, then by z. */
static inline int geom_compare_points(struct geom_point a,
                                      struct geom_point b) {
  if (a.x != b.x)
    return a.x < b.x ? -1 : 1;
  if (a.y != b.y)
    return a.y < b.y ? -1 : 1;
  return (a.z > b.z) - (a.z < b.z);
}

#endif
