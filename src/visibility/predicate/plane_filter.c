/* plane_filter.c - a floating-point filter for the side-of-plane tests.
 *
 * Robustness  Let u = 2^-53.
 *   - The differences of corners are exact.
 *   - A component of the normal is a difference a - b of two products: it is
 *     off by less than 3u (|a| + |b|) =: 3u m.
 *   - The value is the sum of three products of these and of d: it is off by
 *     less than 7u times the sum of m |d|.
 *   - The tolerance of occlusion.h takes its length from the exact normal, each
 *     component rounded once: the two lengths differ by no more than the two
 *     vectors do.  The third component of these is a sum of four terms.
 * So 32u times the sums of the magnitudes bounds every error here.  What
 * occlusion.h rounds up makes each of t0 and t1 larger by less than one unit of
 * 2^-16.
 */
#include "visibility/predicate/plane_filter.h"

#include <math.h>

#include "visibility/predicate/contact.h"

#define ERROR_BOUND (2 * FILTER_ERROR)

/* From these magnitudes on occlusion.h may cap the tolerance; the filter is
 * then not used. */
#define T0_LARGE 0x1p104
#define T1_LARGE 0x1p64

/* The unit of T(p), which has 16 fraction bits. */
#define T_UNIT 0x1p-16

struct plane_filter plane_filter_without_contact(const struct sheet *sheet,
                                                 uint32_t triangle) {
  const struct geom_triangle corners = sheet_corners(sheet, triangle);
  struct geom_point a = corners.p[0], b = corners.p[1], c = corners.p[2];
  double ux = (double)b.x - a.x, uy = (double)b.y - a.y,
         uz = (double)(b.z - a.z), vx = (double)c.x - a.x,
         vy = (double)c.y - a.y, vz = (double)(c.z - a.z);
  return (struct plane_filter){
      .x = a.x,
      .y = a.y,
      .z = (double)a.z,
      .nx = uy * vz - uz * vy,
      .ny = uz * vx - ux * vz,
      .nz = ux * vy - uy * vx,
      .ex = ERROR_BOUND * (fabs(uy * vz) + fabs(uz * vy)),
      .ey = ERROR_BOUND * (fabs(uz * vx) + fabs(ux * vz)),
      .ez = ERROR_BOUND * (fabs(ux * vy) + fabs(uy * vx)),
      .t_error = INFINITY};
}

struct plane_filter plane_filter_of(const struct sheet *sheet,
                                    uint32_t triangle) {
  const struct camera *camera = &sheet->camera;
  struct plane_filter plane = plane_filter_without_contact(sheet, triangle);
  const double n[3] = {plane.nx, plane.ny, plane.nz},
               m[3] = {plane.ex / ERROR_BOUND, plane.ey / ERROR_BOUND,
                       plane.ez / ERROR_BOUND}; /* exact: a power of two */
  struct geom_point a =
      sheet->point.item[sheet->triangle.item[triangle].point[0]];
  struct contact_length contact = contact_length_of(sheet, triangle, a, n, m);
  double grid = contact_grid_units(sheet), by_near = 1, by_z = 0;
  if (camera->perspective) {
    by_near = 1 / camera->d_max;
    by_z = 1 / sheet->z_scale;
  }
  if (!(contact.most * by_near < T0_LARGE && contact.most * by_z < T1_LARGE))
    return plane;
  plane.t0 =
      (fabs(n[0]) + fabs(n[1]) + fabs(n[2])) * grid + contact.length * by_near;
  plane.t1 = contact.length * by_z;
  plane.t0_more = T_UNIT;
  plane.t1_more = camera->perspective ? T_UNIT : 0;
  plane.t_error =
      ERROR_BOUND * ((m[0] + m[1] + m[2]) * grid +
                     contact.most * (by_near + by_z * (double)SHEET_Z_MAX));
  return plane;
}

double plane_filter_thickness(const struct plane_filter *plane) {
  double least = plane->nz - plane->ez;
  double most = plane->t0 + plane->t0_more + plane->t_error +
                (plane->t1 + plane->t1_more) * (double)SHEET_Z_MAX;
  return least > 0 ? most / least * (1 + ERROR_BOUND) : INFINITY;
}

/* The value of a plane at a point, and bounds for the tolerance there, widened
 * by the error bound of the value. */
struct bounded_value {
  double value, least, most;
};

static inline struct bounded_value value_at(const struct plane_filter *plane,
                                            struct geom_point p) {
  double z = (double)p.z, dx = p.x - plane->x, dy = p.y - plane->y,
         dz = z - plane->z;
  double off = plane->ex * fabs(dx) + plane->ey * fabs(dy) +
               plane->ez * fabs(dz) + plane->t_error;
  double least = plane->t0 + plane->t1 * z;
  return (struct bounded_value){
      plane->nx * dx + plane->ny * dy + plane->nz * dz, least - off,
      least + plane->t0_more + plane->t1_more * z + off};
}

bool plane_filter_may_intersect(const struct plane_filter *plane,
                                const struct geom_point corner[3]) {
  int behind = 0, in_front = 0;
  for (int k = 0; k < 3; k++) {
    struct bounded_value at = value_at(plane, corner[k]);
    bool is_in_front = at.value > at.most, is_behind = -at.value > at.most;
    if (!is_behind && !is_in_front && !(fabs(at.value) < at.least))
      return true;
    behind += is_behind;
    in_front += is_in_front;
  }
  return (behind > 0 && in_front > 0) || behind + in_front == 1;
}

bool plane_filter_may_touch(const struct plane_filter *plane,
                            const struct geom_point corner[3]) {
  for (int k = 0; k < 3; k++) {
    struct bounded_value at = value_at(plane, corner[k]);
    if (fabs(at.value) > at.most)
      return false;
  }
  return true;
}

/* plane_filter_may_touch for the corners of a triangle. */
static bool may_touch(const struct plane_filter *plane,
                      const struct sheet *sheet, uint32_t triangle) {
  const struct geom_triangle corners = sheet_corners(sheet, triangle);
  return plane_filter_may_touch(plane, corners.p);
}

bool triangles_may_touch(const struct sheet *sheet,
                         const struct plane_filter *sf, uint32_t f,
                         const struct plane_filter *sg, uint32_t g) {
  return may_touch(sf, sheet, g) || may_touch(sg, sheet, f);
}

int plane_filter_contact_sign(const struct plane_filter *plane,
                              struct geom_point p) {
  struct bounded_value at = value_at(plane, p);
  return (at.value > -at.least) - (at.value < -at.most);
}

/* value + T is linear along the segment, so bounds of it at p and q bound it
 * anywhere.  A rounded parameter moves it by a few u times what it is at p and
 * q. */
int plane_filter_contact_sign_between(const struct plane_filter *plane,
                                      struct geom_point p, struct geom_point q,
                                      double from, double to) {
  struct bounded_value at_p = value_at(plane, p), at_q = value_at(plane, q);
  double low_p = at_p.value + at_p.least, low_q = at_q.value + at_q.least,
         high_p = at_p.value + at_p.most, high_q = at_q.value + at_q.most;
  double off =
      ERROR_BOUND * (fabs(low_p) + fabs(low_q) + fabs(high_p) + fabs(high_q));
  bool in_front = low_p + from * (low_q - low_p) > off &&
                  low_p + to * (low_q - low_p) > off;
  bool is_behind = high_p + from * (high_q - high_p) < -off &&
                   high_p + to * (high_q - high_p) < -off;
  return in_front - is_behind;
}

/* The coordinates given to plane_filter_compare are off by less than this. */
#define POINT_ERROR 0.25

/* By how much a plane is farther at a point than at its corner, and the error
 * bound of that. */
struct depth_drop {
  double depth, off;
};

static struct depth_drop depth_drop_at(const struct plane_filter *plane,
                                       double x, double y) {
  double dx = x - plane->x, dy = y - plane->y, nz_least = plane->nz - plane->ez;
  double depth = (plane->nx * dx + plane->ny * dy) / plane->nz;
  double off = plane->ex * (fabs(dx) + POINT_ERROR) +
               plane->ey * (fabs(dy) + POINT_ERROR) +
               POINT_ERROR * (fabs(plane->nx) + fabs(plane->ny)) +
               plane->ez * fabs(depth);
  if (!(nz_least > 0))
    return (struct depth_drop){0, INFINITY};
  return (struct depth_drop){depth, off / nz_least + ERROR_BOUND * fabs(depth)};
}

int plane_filter_compare(const struct plane_filter *f,
                         const struct plane_filter *g, double x, double y) {
  struct depth_drop of_f = depth_drop_at(f, x, y),
                    of_g = depth_drop_at(g, x, y);
  double nearer = (g->z - f->z) - (of_g.depth - of_f.depth);
  double off =
      of_f.off + of_g.off +
      ERROR_BOUND * (fabs(g->z - f->z) + fabs(of_g.depth) + fabs(of_f.depth));
  return (nearer > off) - (nearer < -off);
}
