/* occlusion.h - the one predicate of hiding: what a triangle hides of an edge.
 *
 * A triangle hides a point of the page at some depth where
 *   - the point lies strictly inside the triangle's outline, and
 *   - the triangle is in front of it by more than the contact tolerance:
 *         (value(p) << 16) + T(p) < 0,   T(p) = t0 + t1 * z(p)
 *     where value is that of the triangle's plane (predicate.h).
 *
 * T gathers what rounding can explain and what the user calls contact:
 *   - the grid's: G units in each of x, y and z, G (|nx| + |ny| + |nz|).  One
 *     unit is what rounding to the grid explains of a point over a triangle;
 *     where no contact length is given, G is
 *     TOLERANCE_CONTACT_GRID_UNITS;
 *   - the scene's: the plane moved back by `contact` scene units, the length
 *     that was given, or what rounding of the input explains of this plane
 *     (view/coordinate_error.h).  In view
 *     space that turns N.X + D into N.X + D + contact (N of unit length); the
 *     sheet's value is (N.X + D) / d times a factor L, so T is L contact / d,
 *     which is linear in z because z is in 1 / d.  Orthographic: L contact.
 *     L follows from the integer normal: with S grid units per unit of X / d
 *     (X) and Z depth units per unit of 1 / d (d),
 *         L^2 = (S nx)^2 + (S ny)^2 + (third)^2,
 *     third = Z nz, orthographic; in perspective nz Z / d_max - value at the
 *     foot of the view axis.
 *   T is computed in doubles, rounded up, when the triangle is prepared; from
 *   then on it is an integer and part of the definition.
 *
 * Corners shared.  An edge that starts on a corner of the triangle has value
 * 0 there; whether it is hidden is asked once, where it ends or leaves the
 * outline, so that it is hidden from its very start or not at all.
 *
 * An edge along a side of the triangle is covered on one side of itself only;
 * it is hidden where both of its sides are covered (edge_intervals.h).
 *
 * An edge is never hidden by the two triangles that it names: a mesh edge has
 * value 0 there in any case, and an intersection, which lies on both, was
 * rounded and may be off them by more than contact.
 *
 * Bits: value < 2^105, shifted 2^121; T is capped at 2^122; their sum and the
 * difference of two such sums stay below 2^125: what ratio.h asks for.
 */
#ifndef VISIBILITY_PREDICATE_OCCLUSION_H
#define VISIBILITY_PREDICATE_OCCLUSION_H

#include "base/report.h"
#include "view/sheet.h"
#include "visibility/predicate/box2.h"

struct occluder {
  struct geom_point p[3]; /* counter-clockwise */
  struct geom_plane plane;
  int128 t0, t1;
  double nx, ny, nz, t0_near, t1_near; /* nearest doubles, for the filter */
  int64_t z_max;                       /* its nearest corner's */
  struct box2 box;
};

/* How many grid units in x, y and z count as contact: G above. */
double occlusion_grid_units(const struct sheet *sheet);

/* Prepares a triangle that is not SHEET_FLAT. */
void occluder_init(struct occluder *occluder, const struct sheet *sheet,
                   uint32_t triangle);

/* A cheap no: may the triangle hide anything of the edge, by its flags and by
 * the boxes of the two on the page and in depth? */
static inline bool occlusion_is_possible(const struct sheet *sheet,
                                         uint32_t triangle, struct geom_point p,
                                         struct geom_point q, struct box2 box) {
  const uint32_t *point = sheet->triangle.item[triangle].point;
  int64_t low = p.z < q.z ? p.z : q.z;
  if (sheet->triangle_flags[triangle] & SHEET_FLAT)
    return false;
  if (sheet->point.item[point[0]].z < low &&
      sheet->point.item[point[1]].z < low &&
      sheet->point.item[point[2]].z < low)
    return false;
  return !box2_disjoint(box, box2_of_triangle(sheet, triangle));
}

enum { OCCLUDED_LEFT = 1, OCCLUDED_RIGHT = 2, OCCLUDED_BOTH = 3 };

/* The open interval of an edge that a triangle covers. */
struct occluded_interval {
  struct ratio from, to; /* in [0, 1], from < to */
  int sides;             /* which sides of the edge are covered there */
};

/* Counts for --stats, each of them monotone. */
struct occlusion_counts {
  uint64_t pairs;     /* edge and triangle whose boxes meet */
  uint64_t depth;     /* of these, depth had to be asked */
  uint64_t exact;     /* of these, the doubles could not tell */
  uint64_t crossings; /* of these, the edge goes through the tolerance */
};

/* occlude_edge for a triangle that occlusion_is_possible, prepared only where its outline
 * meets the edge: most do not. */
bool occlude_edge_by(const struct sheet *sheet, uint32_t triangle,
                     struct geom_point p, struct geom_point q,
                     struct occluded_interval *part,
                     struct occlusion_counts *counts);

void occlusion_counts_add(struct occlusion_counts *sum,
                          const struct occlusion_counts *more);
void occlusion_report(const struct occlusion_counts *counts,
                      struct report *report);

/* What the triangle hides of the edge from p to q (different places on the
 * page); false: nothing. */
bool occlude_edge(const struct occluder *occluder, struct geom_point p,
                  struct geom_point q, struct occluded_interval *part,
                  struct occlusion_counts *counts);

/* The part of the edge that lies within the triangle's outline, whatever the
 * depths. */
bool occlude_by_outline(const struct geom_point corner[3], struct geom_point p,
                        struct geom_point q, struct occluded_interval *part);

/* An upper bound of T, in units of value, for the plane with this normal
 * (doubles of the integer one) through a point; at any depth of the sheet. */
double occlusion_tolerance_bound(const struct sheet *sheet, uint32_t triangle,
                                 struct geom_point a, double nx, double ny,
                                 double nz);

/* The same for any point of the sheet, coarser: the bound is at most
 * 1 + level * nz + slope * (|nx| + |ny|). */
struct occlusion_bound {
  double level, slope;
};
struct occlusion_bound occlusion_tolerance_bound_all(const struct sheet *sheet);

/* (value << 16) + T of a point: negative where it is behind the plane by more
 * than contact explains.  Exact. */
int128 occluder_depth(const struct occluder *occluder, struct geom_point p);

/* Where a point is: -1 behind the plane by more than contact explains, +1 in
 * front of it by more, 0 touching it.  Exact. */
int occluder_side(const struct occluder *occluder, struct geom_point p);

#endif
