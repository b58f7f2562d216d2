/* occlusion.c - the one occlusion test: which interval of an edge a triangle
 * hides. */
#include "visibility/predicate/occlusion.h"

#include <math.h>
#include <string.h>

#include "visibility/predicate/contact.h"
#include "visibility/predicate/plane_filter.h"

#define FIXED_ONE 65536 /* 2^16: T has 16 fraction bits */
#define T_CAP 0x1p121   /* of each part of T (occlusion.h, Bits) */

/* Rounded up, and capped. */
static int128 round_up_capped(double value) {
  return (int128)ceil(value < T_CAP ? value : T_CAP);
}

/* Unrolls the loop over corners that follows. */
#define UNROLL_CORNERS _Pragma("GCC unroll 3")

static int128 absolute(int128 a) { return a < 0 ? -a : a; }

void occluder_init(struct occluder *occluder, const struct sheet *sheet,
                   uint32_t triangle) {
  const struct camera *camera = &sheet->camera;
  struct geom_triangle corners = sheet_corners(sheet, triangle);
  memcpy(occluder->p, corners.p, sizeof occluder->p);
  occluder->plane = geom_plane_of(corners.p[0], corners.p[1], corners.p[2]);
  const double n[3] = {(double)occluder->plane.nx, (double)occluder->plane.ny,
                       (double)occluder->plane.nz},
               m[3] = {fabs(n[0]), fabs(n[1]), fabs(n[2])};
  occluder->nx = n[0];
  occluder->ny = n[1];
  occluder->nz = n[2];
  double length =
      contact_length_of(sheet, triangle, corners.p[0], n, m).length * FIXED_ONE;
  occluder->t0 = (absolute(occluder->plane.nx) + absolute(occluder->plane.ny) +
                  occluder->plane.nz) *
                 (int128)(contact_grid_units(sheet) * FIXED_ONE);
  occluder->t1 = 0;
  if (camera->perspective) {
    occluder->t0 += round_up_capped(length / camera->d_max);
    occluder->t1 = round_up_capped(length / sheet->z_scale);
    if (occluder->t1 > (int128)1 << 81)
      occluder->t1 = (int128)1 << 81;
  } else {
    occluder->t0 += round_up_capped(length);
  }
  occluder->t0_near = (double)occluder->t0;
  occluder->t1_near = (double)occluder->t1;
  occluder->z_max = sheet_nearest_z(sheet, triangle);
  occluder->box = box2_of_triangle(sheet, triangle);
}

int128 occluder_value(const struct occluder *occluder, struct geom_point p) {
  return geom_plane_value(&occluder->plane, p) * FIXED_ONE + occluder->t0 +
         occluder->t1 * p.z;
}

/* The value of the plane at a point in units of 2^-16, the tolerance there, and
 * a bound of the error of each of their sums and differences. */
struct filtered_value {
  double value, tolerance, bound;
};

static inline struct filtered_value
filtered_value_at(const struct occluder *occluder, struct geom_point p) {
  double x = occluder->nx * (double)((int64_t)p.x - occluder->p[0].x),
         y = occluder->ny * (double)((int64_t)p.y - occluder->p[0].y),
         z = occluder->nz * (double)(p.z - occluder->p[0].z),
         t = occluder->t0_near + occluder->t1_near * (double)p.z;
  return (struct filtered_value){
      (x + y + z) * FIXED_ONE, t,
      FILTER_ERROR * ((fabs(x) + fabs(y) + fabs(z)) * FIXED_ONE + t)};
}

/* The sign of occluder_value where doubles certify it, else 0. */
static int depth_filter(const struct occluder *occluder, struct geom_point p) {
  struct filtered_value at = filtered_value_at(occluder, p);
  double value = at.value + at.tolerance;
  return (value > at.bound) - (value < -at.bound);
}

int occluder_side(const struct occluder *occluder, struct geom_point p) {
  int128 tolerance, value;
  struct filtered_value at = filtered_value_at(occluder, p);
  if (at.value + at.tolerance < -at.bound)
    return -1;
  if (at.value - at.tolerance > at.bound)
    return 1;
  tolerance = occluder->t0 + occluder->t1 * p.z;
  value = geom_plane_value(&occluder->plane, p) * FIXED_ONE;
  return (value > tolerance) - (value < -tolerance);
}

/* Intersects the interval with [t, 1]. */
static void clip_before(struct occluded_interval *interval, struct ratio t) {
  if (ratio_compare(interval->from, t) < 0)
    interval->from = t;
}

/* Intersects the interval with [0, t]. */
static void clip_after(struct occluded_interval *interval, struct ratio t) {
  if (ratio_compare(t, interval->to) < 0)
    interval->to = t;
}

/* Sets the interval from 0 to 1 clipped to where all three values, s at 0 and t
 * at 1, are not negative.  Returns false where nothing is left. */
static bool clip_to_sides(const int64_t s[3], const int64_t t[3],
                          struct occluded_interval *interval) {
  int64_t from = 0, from_den = 1, to = 1, to_den = 1;
  UNROLL_CORNERS /* the first time the parameters are known */
      for (int k = 0; k < 3; k++) {
    int64_t den = s[k] < 0 ? t[k] - s[k] : s[k] - t[k];
    if (s[k] < 0 && (int128)from * den < (int128)-s[k] * from_den) {
      from = -s[k];
      from_den = den;
    } else if (s[k] >= 0 && t[k] < 0 &&
               (int128)s[k] * to_den < (int128)to * den) {
      to = s[k];
      to_den = den;
    }
  }
  interval->from = ratio_of(from, from_den);
  interval->to = ratio_of(to, to_den);
  return (int128)from * to_den < (int128)to * from_den;
}

/* The corners c of a triangle relative to the start p of an edge, and the
 * twofold areas d x c of p, the end q = p + d and each corner. */
struct edge_corners {
  int64_t x[3], y[3], line[3];
};

/* Sets the corners.  Returns false where all are on one side of the line p-q,
 * at most one of them on it: the projection does not overlap the edge. */
static inline bool edge_corners_set(struct edge_corners *corners,
                                    const struct geom_point *a,
                                    const struct geom_point *b,
                                    const struct geom_point *c,
                                    struct geom_point p, struct geom_point q) {
  const struct geom_point *corner[3] = {a, b, c};
  int64_t dx = (int64_t)q.x - p.x, dy = (int64_t)q.y - p.y, line[3];
  UNROLL_CORNERS
  for (int k = 0; k < 3; k++) {
    int64_t x = corners->x[k] = (int64_t)corner[k]->x - p.x,
            y = corners->y[k] = (int64_t)corner[k]->y - p.y;
    corners->line[k] = line[k] = dx * y - dy * x;
  }
  bool one_side = (line[0] | line[1] | line[2]) >= 0 ||
                  (-line[0] | -line[1] | -line[2]) >= 0;
  return !one_side || (line[0] == 0) + (line[1] == 0) + (line[2] == 0) > 1;
}

/* Which side of the edge p-q is occluded by a triangle that it runs along: the
 * triangle is on the left of its side from corner a to corner b. */
static int occluded_side(const struct edge_corners *corners, int a, int b,
                         struct geom_point p, struct geom_point q) {
  int64_t along = ((int64_t)q.x - p.x) * (corners->x[b] - corners->x[a]) +
                  ((int64_t)q.y - p.y) * (corners->y[b] - corners->y[a]);
  return along > 0 ? OCCLUDED_LEFT : OCCLUDED_RIGHT;
}

/* Sets the interval to the part of the edge p-q within the triangle's
 * projection.  With the areas
 *     s[k]    = c[k] x c[k + 1]                 of side k and p;
 *     t[k]    = s[k] + line[k] - line[k + 1]    of side k and q.
 * Each is below 2^63; the intermediate sum may overflow, hence unsigned.
 * Returns false where nothing is left. */
static inline bool clip_to_outline(const struct edge_corners *corners,
                                   struct geom_point p, struct geom_point q,
                                   struct occluded_interval *interval) {
  int64_t s[3], t[3];
  interval->sides = OCCLUDED_BOTH;
  UNROLL_CORNERS
  for (int k = 0; k < 3; k++) {
    int next = geom_next_corner(k);
    s[k] = corners->x[k] * corners->y[next] - corners->y[k] * corners->x[next];
    t[k] = (int64_t)((uint64_t)s[k] + (uint64_t)corners->line[k] -
                     (uint64_t)corners->line[next]);
    if (s[k] <= 0 && t[k] <= 0) {
      if (s[k] < 0 || t[k] < 0)
        return false;
      interval->sides = occluded_side(corners, k, next, p, q);
    }
  }
  return clip_to_sides(s, t, interval);
}

/* Is an edge hidden of which one end is a corner of the triangle?  All of the
 * interval is, or none of it.  Decided where the edge leaves the projection:
 * farther on the plane is no longer that of the triangle, and its rounding
 * error grows beyond the contact tolerance.
 * p_shared  p is the corner, else q is
 * gp, gq    occluder_value of p and q */
static bool is_behind_at_exit(const struct occluded_interval *interval,
                              bool p_shared, int128 gp, int128 gq) {
  if (p_shared)
    return gq < 0 &&
           ratio_compare((struct ratio){gp, gp - gq}, interval->to) < 0;
  return gp < 0 &&
         ratio_compare(interval->from, (struct ratio){-gp, gq - gp}) < 0;
}

/* Clips the interval to where the edge is behind the plane by more than the
 * contact tolerance.  Returns false where nothing is left. */
static bool clip_to_depth(const struct occluder *occluder, struct geom_point p,
                          struct geom_point q,
                          struct occluded_interval *interval,
                          struct occlusion_counts *counts) {
  int sp = depth_filter(occluder, p), sq = depth_filter(occluder, q);
  bool p_shared = false, q_shared = false;
  int128 gp, gq;
  if (sp < 0 && sq < 0)
    return true;
  for (int k = 0; k < 3; k++) {
    p_shared |= geom_same_point(occluder->p[k], p);
    q_shared |= geom_same_point(occluder->p[k], q);
  }
  if (sp > 0 && sq > 0)
    return false;
  counts->exact_tests++;
  gp = occluder_value(occluder, p);
  gq = occluder_value(occluder, q);
  if (p_shared != q_shared)
    return is_behind_at_exit(interval, p_shared, gp, gq);
  if (gp >= 0 && gq >= 0)
    return false;
  if (gp < 0 && gq < 0)
    return true;
  counts->crossings++;
  if (gp >= 0)
    clip_before(interval, (struct ratio){gp, gp - gq});
  else
    clip_after(interval, (struct ratio){-gp, gq - gp});
  return ratio_compare(interval->from, interval->to) < 0;
}

bool occlude_by_projection(const struct geom_point corner[3],
                           struct geom_point p, struct geom_point q,
                           struct occluded_interval *interval) {
  struct edge_corners relative;
  return edge_corners_set(&relative, &corner[0], &corner[1], &corner[2], p,
                          q) &&
         clip_to_outline(&relative, p, q, interval);
}

bool occluder_edge_is_off_plane(const struct occluder *occluder,
                                const struct sheet *sheet, struct geom_point p,
                                struct geom_point q) {
  struct occluded_interval part;
  if (!occlude_by_projection(occluder->p, p, q, &part))
    return false;
  bool given = sheet->camera.contact >= 0;
  double grid = contact_grid_units(sheet) * FIXED_ONE *
                (fabs(occluder->nx) + fabs(occluder->ny) + occluder->nz);
  const struct geom_point end[2] = {p, q};
  double value[2], tolerance[2];
  for (int k = 0; k < 2; k++) {
    value[k] = (double)geom_plane_value(&occluder->plane, end[k]) * FIXED_ONE;
    tolerance[k] =
        given ? grid : (double)(occluder->t0 + occluder->t1 * end[k].z);
  }
  for (int k = 0; k < 2; k++) {
    double t = ratio_to_double(k == 0 ? part.from : part.to);
    if (fabs(value[0] + t * (value[1] - value[0])) >
        tolerance[0] + t * (tolerance[1] - tolerance[0]))
      return true;
  }
  return false;
}

bool occlude_edge(const struct occluder *occluder, struct geom_point p,
                  struct geom_point q, struct occluded_interval *interval,
                  struct occlusion_counts *counts) {
  if (p.z > occluder->z_max && q.z > occluder->z_max)
    return false;
  if (box2_disjoint(occluder->box, box2_of_segment(p, q)))
    return false;
  counts->pairs++;
  if (!occlude_by_projection(occluder->p, p, q, interval))
    return false;
  counts->depth_tests++;
  return clip_to_depth(occluder, p, q, interval, counts);
}

/* Is one of the points a corner of the triangle? */
static bool has_corner_at(const struct geom_triangle *corners,
                          struct geom_point p, struct geom_point q) {
  bool found = false;
  for (int k = 0; k < 3; k++)
    found |=
        geom_same_point(corners->p[k], p) || geom_same_point(corners->p[k], q);
  return found;
}

/* The sign of the plane along the interval of the edge, as
 * plane_filter_contact_sign_between has it; 0 where an end of the edge is a
 * corner of the triangle, which is_behind_at_exit is for. */
static int sign_along(const struct plane_filter *plane,
                      const struct geom_triangle *corners, struct geom_point p,
                      struct geom_point q,
                      const struct occluded_interval *interval) {
  int sign = plane_filter_contact_sign_between(plane, p, q,
                                               ratio_to_double(interval->from),
                                               ratio_to_double(interval->to));
  return sign != 0 && has_corner_at(corners, p, q) ? 0 : sign;
}

/* Decides by the triangle's plane what is left of the interval, which the
 * outline has clipped. */
static bool decide_depth(const struct sheet *sheet, uint32_t triangle,
                         const struct geom_triangle *corners,
                         const struct plane_filter *plane, struct geom_point p,
                         struct geom_point q,
                         struct occluded_interval *interval,
                         struct occlusion_counts *counts) {
  struct occluder occluder;
  int at_p = plane_filter_contact_sign(plane, p),
      at_q = plane_filter_contact_sign(plane, q);
  if (at_p == at_q && at_p != 0)
    return at_p < 0;
  int sign = sign_along(plane, corners, p, q, interval);
  if (sign != 0)
    return sign < 0;
  occluder_init(&occluder, sheet, triangle);
  return clip_to_depth(&occluder, p, q, interval, counts);
}

bool occlude_edge_by_triangle(const struct sheet *sheet, uint32_t triangle,
                              struct geom_point p, struct geom_point q,
                              struct occluded_interval *interval,
                              struct occlusion_counts *counts) {
  const struct geom_triangle corners = sheet_corners(sheet, triangle);
  counts->pairs++;
  if (!occlude_by_projection(corners.p, p, q, interval) ||
      sheet_is_edge_on(sheet, triangle))
    return false;
  counts->depth_tests++;
  struct plane_filter plane = plane_filter_of(sheet, triangle);
  return decide_depth(sheet, triangle, &corners, &plane, p, q, interval,
                      counts);
}

bool occlude_edge_by_cached(struct plane_cache *cache, uint32_t triangle,
                            struct geom_point p, struct geom_point q,
                            struct occluded_interval *interval,
                            struct occlusion_counts *counts) {
  const struct sheet *sheet = cache->sheet;
  const uint32_t *corner = sheet->triangle.item[triangle].point;
  const struct geom_point *point = sheet->point.item;
  struct edge_corners relative;
  counts->pairs++;
  if (!edge_corners_set(&relative, &point[corner[0]], &point[corner[1]],
                        &point[corner[2]], p, q) ||
      !clip_to_outline(&relative, p, q, interval) ||
      sheet_is_edge_on(sheet, triangle))
    return false;
  counts->depth_tests++;
  const struct geom_triangle corners = sheet_corners(sheet, triangle);
  struct coarse_plane plane = coarse_plane_of(&cache->all, corners.p);
  int at_p = coarse_plane_contact_sign(&plane, p),
      at_q = coarse_plane_contact_sign(&plane, q);
  if (at_p == at_q && at_p != 0)
    return at_p < 0;
  int sign = coarse_plane_contact_sign_between(&plane, p, q,
                                               ratio_to_double(interval->from),
                                               ratio_to_double(interval->to));
  if (sign != 0 && !has_corner_at(&corners, p, q))
    return sign < 0;
  return decide_depth(sheet, triangle, &corners,
                      plane_cache_get(cache, triangle), p, q, interval, counts);
}

void occlusion_counts_add(struct occlusion_counts *sum,
                          const struct occlusion_counts *more) {
  sum->pairs += more->pairs;
  sum->depth_tests += more->depth_tests;
  sum->exact_tests += more->exact_tests;
  sum->crossings += more->crossings;
}

void occlusion_report(const struct occlusion_counts *counts,
                      struct report *report) {
  report_add(report, "occlusion", "pairs", counts->pairs);
  report_add(report, "occlusion", "depth_tests", counts->depth_tests);
  report_add(report, "occlusion", "filter_failures", counts->exact_tests);
  report_add(report, "occlusion", "depth_crossings", counts->crossings);
}
