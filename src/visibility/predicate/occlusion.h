/* occlusion.h - the one occlusion test: which interval of an edge a triangle
 * hides.
 *
 * Definition.  A triangle hides a point p of the page at some depth where
 *   - p lies strictly inside the triangle's projection, and
 *   - the triangle is in front of p by more than the contact tolerance T:
 *
 *         (value(p) << 16) + T(p) < 0,   T(p) = t0 + t1 * z(p)
 *
 *     where value(p) is that of the triangle's plane (geom/predicate.h).
 *
 * Contact tolerance.  T is the sum of two parts:
 *   - the grid's: G (|nx| + |ny| + |nz|), the plane moved by G units in each of
 *     x, y and z.  Rounding to the grid moves a point over a triangle by up to
 *     one unit; where no contact length is given, G is
 *     TOLERANCE_CONTACT_GRID_UNITS;
 *   - the scene's: the plane moved back by `contact` scene units, which is the
 *     length that was given, or the bound of the input's rounding error for
 *     this plane (view/coordinate_error.h).
 *
 * Derivation of the scene's part.  In view space, with N of unit length, moving
 * the plane back turns N.X + D into N.X + D + contact.  The sheet's value is
 *     (N.X + D) / d * L     perspective, d being the distance along the view;
 *     (N.X + D) * L         orthographic,
 * for a factor L, so that the part of T is
 *     L contact / d         perspective: linear in z, because z is in 1 / d;
 *     L contact             orthographic.
 * L follows from the integer normal.  With S grid units per unit of X / d (of X
 * in orthographic views) and Z depth units per unit of 1 / d (of d),
 *     L^2 = (S nx)^2 + (S ny)^2 + third^2,
 *     third = nz Z / d_max - value at the foot of the view axis   perspective;
 *     third = Z nz                                                orthographic.
 * T is computed in doubles, rounded up, when the triangle is prepared; from
 * then on it is an integer and part of the definition.
 *
 * Shared corners.  An edge that starts on a corner of the triangle has value 0
 * there.  Whether it is hidden is decided once, at the point where it ends or
 * leaves the triangle's projection, so that it is hidden from its very start
 * or not at all.
 *
 * Edges along a side of the triangle's projection are occluded on one side
 * only; an edge is hidden where both of its sides are (edge_intervals.h).
 *
 * Own triangles.  An edge is never hidden by the two triangles that it names:
 * a mesh edge has value 0 there in any case, and an intersection, which lies on
 * both, was rounded and may be off them by more than contact.  Nor is it hidden
 * by the other triangles of these faces, if they are planar, nor by what else
 * clipping left of these triangles: seen edge-on, these are slivers, whose
 * planes rounding turned.
 *
 * Bits.  value < 2^105, shifted 2^121; T is capped at 2^122; their sum and the
 * difference of two such sums stay below 2^125, as ratio.h requires.
 */
#ifndef VISIBILITY_PREDICATE_OCCLUSION_H
#define VISIBILITY_PREDICATE_OCCLUSION_H

#include <math.h>

#include "base/report.h"
#include "view/sheet.h"
#include "visibility/predicate/box2.h"
#include "visibility/predicate/plane_cache.h"

/* A triangle prepared for the test. */
struct occluder {
  struct geom_point p[3]; /* counter-clockwise */
  struct geom_plane plane;
  int128 t0, t1;                       /* the tolerance T */
  double nx, ny, nz, t0_near, t1_near; /* nearest doubles, for the filter */
  int64_t z_max;                       /* of the nearest corner */
  struct box2 box;
};

/* Prepares a triangle that is not SHEET_EDGE_ON. */
void occluder_init(struct occluder *occluder, const struct sheet *sheet,
                   uint32_t triangle);

/* Does the edge belong to the triangle: is that one of the two that it names,
 * or in one plane with one of them? */
static inline bool occlusion_is_own(const struct sheet *sheet,
                                    const struct sheet_edge *edge,
                                    uint32_t triangle) {
  if (triangle == edge->triangle[0] || triangle == edge->triangle[1])
    return true;
  if ((sheet->triangle_flags[triangle] & (SHEET_COPLANAR | SHEET_PIECE)) == 0)
    return false;
  for (int k = 0; k < 2; k++)
    if (edge->triangle[k] != SHEET_NONE &&
        sheet_is_coplanar(sheet, edge->triangle[k], triangle))
      return true;
  return false;
}

/* A cheap rejection test: may the triangle hide any part of the edge p-q, by
 * the triangle's flags and by the two boxes on the page and in depth?
 * box  of the edge
 * Returns false only where it certainly does not. */
static inline bool occlusion_is_possible(const struct sheet *sheet,
                                         uint32_t triangle, struct geom_point p,
                                         struct geom_point q, struct box2 box) {
  const uint32_t *point = sheet->triangle.item[triangle].point;
  int64_t low = p.z < q.z ? p.z : q.z;
  if (sheet_is_edge_on(sheet, triangle))
    return false;
  if (sheet->point.item[point[0]].z < low &&
      sheet->point.item[point[1]].z < low &&
      sheet->point.item[point[2]].z < low)
    return false;
  return !box2_disjoint(box, box2_of_triangle(sheet, triangle));
}

/* Is a triangle on one side of the line through an edge p-q on the page, with
 * at most one corner on it?  Then its projection does not overlap the edge. */
static inline bool occlusion_is_beside(const struct geom_point *a,
                                       const struct geom_point *b,
                                       const struct geom_point *c,
                                       struct geom_point p,
                                       struct geom_point q) {
  int64_t dx = (int64_t)q.x - p.x, dy = (int64_t)q.y - p.y;
  int64_t at_a = dx * ((int64_t)a->y - p.y) - dy * ((int64_t)a->x - p.x),
          at_b = dx * ((int64_t)b->y - p.y) - dy * ((int64_t)b->x - p.x),
          at_c = dx * ((int64_t)c->y - p.y) - dy * ((int64_t)c->x - p.x);
  bool one_side = ((at_a | at_b | at_c) >= 0) | ((-at_a | -at_b | -at_c) >= 0);
  return one_side & ((at_a == 0) + (at_b == 0) + (at_c == 0) <= 1);
}

/* Sides of a directed edge. */
enum { OCCLUDED_LEFT = 1, OCCLUDED_RIGHT = 2, OCCLUDED_BOTH = 3 };

/* The open interval of an edge that a triangle hides, in the edge's
 * parameter. */
struct occluded_interval {
  struct ratio from, to; /* in [0, 1], from < to */
  int sides;             /* which sides of the edge are occluded there */
};

/* Counts for --stats, each a subset of the one before. */
struct occlusion_counts {
  uint64_t pairs;       /* of an edge and a triangle whose boxes meet */
  uint64_t depth_tests; /* of these, projections overlapped: depth decided */
  uint64_t exact_tests; /* of these, the filter could not certify a sign */
  uint64_t crossings;   /* of these, the edge passes through the tolerance */
};

/* Computes the interval of the edge p-q that the triangle hides.
 * p, q      at different places of the page
 * interval  scratch where nothing is hidden
 * Returns false where the triangle hides nothing. */
bool occlude_edge(const struct occluder *occluder, struct geom_point p,
                  struct geom_point q, struct occluded_interval *interval,
                  struct occlusion_counts *counts);

/* The same for a triangle that occlusion_is_possible and that has not been
 * prepared.  It is prepared only where its projection overlaps the edge and the
 * filter cannot decide, which is rare. */
bool occlude_edge_by_triangle(const struct sheet *sheet, uint32_t triangle,
                              struct geom_point p, struct geom_point q,
                              struct occluded_interval *interval,
                              struct occlusion_counts *counts);

/* The same with the plane of the cache, for many edges that are near each
 * other. */
bool occlude_edge_by_cached(struct plane_cache *cache, uint32_t triangle,
                            struct geom_point p, struct geom_point q,
                            struct occluded_interval *interval,
                            struct occlusion_counts *counts);

/* Computes the interval of the edge that lies within the triangle's projection,
 * whatever the depths. */
bool occlude_by_projection(const struct geom_point corner[3],
                           struct geom_point p, struct geom_point q,
                           struct occluded_interval *interval);

/* Whether a part of the edge within the triangle's projection is behind the
 * plane or in front of it by more than rounding: of the page grid and, where no
 * contact tolerance is given, of the coordinates.  In doubles: what differs
 * from that bound by their own rounding error may be taken for either. */
bool occluder_edge_is_off_plane(const struct occluder *occluder,
                                const struct sheet *sheet, struct geom_point p,
                                struct geom_point q);

void occlusion_counts_add(struct occlusion_counts *sum,
                          const struct occlusion_counts *more);
void occlusion_report(const struct occlusion_counts *counts,
                      struct report *report);

/* (value << 16) + T of a point: negative where it is behind the plane by more
 * than the contact tolerance.  Exact. */
int128 occluder_value(const struct occluder *occluder, struct geom_point p);

/* On which side of the plane a point is: -1 behind it and +1 in front of it by
 * more than the contact tolerance, 0 in contact with it.  Exact. */
int occluder_side(const struct occluder *occluder, struct geom_point p);

#endif
