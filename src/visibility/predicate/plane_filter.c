/* plane_filter.c - how points lie to the plane of a triangle, in doubles.
 *
 * Robustness  With u = 2^-53.  The differences of corners are exact.  A part
 * of the normal is a difference of two products: it is off by less than 3u
 * (|a| + |b|) =: 3u m.  The value sums three products of these: off by less
 * than 7u times the sum of m |d|.  The tolerance of occlusion.h takes its
 * length from the normal rounded once: the two lengths differ by no more than
 * the vectors do, and the third coordinate of these is a sum of four terms.  So
 * 32u times the sums of the magnitudes is room enough for all.  What
 * occlusion.h rounds up makes the tolerance larger by less than one unit of
 * 2^-16 each.
 */
#include "visibility/predicate/plane_filter.h"

#include <math.h>

#include "view/coordinate_error.h"
#include "visibility/predicate/occlusion.h"

#define SLACK (32 * 0x1p-53)

/* From here on occlusion.h may cap its numbers. */
#define T0_LARGE 0x1p104
#define T1_LARGE 0x1p64

/* T(p) has 16 bits below the value's unit. */
#define T_UNIT 0x1p-16

/* The contact tolerance times the length of a plane's normal, and the sum of
 * the magnitudes in it (occlusion.c).
 * n, m  the normal along the camera's axes; magnitudes that bound it */
static double contact_times_length(const struct sheet *sheet, uint32_t triangle,
                                   const double n[3], const double m[3],
                                   double *most) {
  const struct camera *camera = &sheet->camera;
  double error[3], sum = 0;
  if (camera->contact >= 0) {
    *most = camera->contact * (m[0] + m[1] + m[2]);
    return camera->contact * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  }
  coordinate_error_of_face(sheet, sheet->triangle.item[triangle].face, error);
  *most = 0;
  for (int k = 0; k < 3; k++) {
    const double axis[3] = {camera->right[k], camera->up[k], camera->back[k]};
    sum += error[k] * fabs(n[0] * axis[0] + n[1] * axis[1] + n[2] * axis[2]);
    *most += error[k] * (m[0] * fabs(axis[0]) + m[1] * fabs(axis[1]) +
                         m[2] * fabs(axis[2]));
  }
  return sum;
}

struct plane_filter plane_filter_of(const struct sheet *sheet,
                                    uint32_t triangle) {
  const uint32_t *t = sheet->triangle.item[triangle].point;
  const struct camera *camera = &sheet->camera;
  struct geom_point a = sheet->point.item[t[0]], b = sheet->point.item[t[1]],
                    c = sheet->point.item[t[2]];
  double ux = (double)b.x - a.x, uy = (double)b.y - a.y,
         uz = (double)(b.z - a.z), vx = (double)c.x - a.x,
         vy = (double)c.y - a.y, vz = (double)(c.z - a.z);
  double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
  double mx = fabs(uy * vz) + fabs(uz * vy), my = fabs(uz * vx) + fabs(ux * vz),
         mz = fabs(ux * vy) + fabs(uy * vx);
  double s = sheet->units_per_view, third = sheet->z_scale * nz,
         third_most = sheet->z_scale * mz, by_near = 1, by_z = 0;
  if (camera->perspective) {
    struct sheet_axis axis = sheet_view_axis(sheet);
    double x = axis.x - a.x, y = axis.y - a.y,
           z = sheet->z_scale / camera->d_max + (double)a.z;
    third = nz * z - (nx * x + ny * y);
    third_most = mz * fabs(z) + mx * fabs(x) + my * fabs(y);
    by_near = 1 / camera->d_max;
    by_z = 1 / sheet->z_scale;
  }
  const double n[3] = {s * nx, s * ny, third},
               m[3] = {s * mx, s * my, third_most};
  double grid = occlusion_grid_units(sheet), length_most;
  double length = contact_times_length(sheet, triangle, n, m, &length_most);
  struct plane_filter plane = {
      .x = a.x,
      .y = a.y,
      .z = (double)a.z,
      .nx = nx,
      .ny = ny,
      .nz = nz,
      .ex = SLACK * mx,
      .ey = SLACK * my,
      .ez = SLACK * mz,
      .t0 = (fabs(nx) + fabs(ny) + fabs(nz)) * grid + length * by_near,
      .t1 = length * by_z,
      .t0_more = T_UNIT,
      .t1_more = camera->perspective ? T_UNIT : 0,
      .t_off = SLACK * ((mx + my + mz) * grid +
                        length_most * (by_near + by_z * (double)SHEET_Z_MAX))};
  if (!(length_most * by_near < T0_LARGE && length_most * by_z < T1_LARGE))
    plane.t_off = INFINITY;
  return plane;
}

/* The value at a point, and between what the tolerance is there, the value's
 * own error taken in. */
struct reading {
  double value, least, most;
};

static inline struct reading read_at(const struct plane_filter *plane,
                                     struct geom_point p) {
  double z = (double)p.z, dx = p.x - plane->x, dy = p.y - plane->y,
         dz = z - plane->z;
  double off = plane->ex * fabs(dx) + plane->ey * fabs(dy) +
               plane->ez * fabs(dz) + plane->t_off;
  double least = plane->t0 + plane->t1 * z;
  return (struct reading){plane->nx * dx + plane->ny * dy + plane->nz * dz,
                          least - off,
                          least + plane->t0_more + plane->t1_more * z + off};
}

bool plane_filter_may_intersect(const struct plane_filter *plane,
                                const struct geom_point corner[3]) {
  int behind = 0, before = 0;
  for (int k = 0; k < 3; k++) {
    struct reading at = read_at(plane, corner[k]);
    bool is_behind = at.value<-at.most, is_before = at.value> at.most;
    if (!is_behind && !is_before && !(fabs(at.value) < at.least))
      return true;
    behind += is_behind;
    before += is_before;
  }
  return (behind > 0 && before > 0) || behind + before == 1;
}

bool plane_filter_may_touch(const struct plane_filter *plane,
                            const struct geom_point corner[3]) {
  for (int k = 0; k < 3; k++) {
    struct reading at = read_at(plane, corner[k]);
    if (fabs(at.value) > at.most)
      return false;
  }
  return true;
}

/* May the triangle's corners touch the plane? */
static bool may_touch(const struct plane_filter *plane,
                      const struct sheet *sheet, uint32_t triangle) {
  const uint32_t *point = sheet->triangle.item[triangle].point;
  const struct geom_point corner[3] = {sheet->point.item[point[0]],
                                       sheet->point.item[point[1]],
                                       sheet->point.item[point[2]]};
  return plane_filter_may_touch(plane, corner);
}

bool plane_filters_may_touch(const struct sheet *sheet,
                             const struct plane_filter *sf, uint32_t f,
                             const struct plane_filter *sg, uint32_t g) {
  return may_touch(sf, sheet, g) || may_touch(sg, sheet, f);
}

int plane_filter_occludes(const struct plane_filter *plane,
                          struct geom_point p) {
  struct reading at = read_at(plane, p);
  return (at.value > -at.least) - (at.value < -at.most);
}

/* How much farther than its corner a plane is at a place, and by how much that
 * may be off.  The normal's parts are off by less than e, and the place by less
 * than PLACE. */
#define PLACE 0.25

struct fall {
  double depth, off;
};

static struct fall fall_at(const struct plane_filter *plane, double x,
                           double y) {
  double dx = x - plane->x, dy = y - plane->y, room = plane->nz - plane->ez;
  double depth = (plane->nx * dx + plane->ny * dy) / plane->nz;
  double off = plane->ex * (fabs(dx) + PLACE) + plane->ey * (fabs(dy) + PLACE) +
               PLACE * (fabs(plane->nx) + fabs(plane->ny)) +
               plane->ez * fabs(depth);
  if (!(room > 0))
    return (struct fall){0, INFINITY};
  return (struct fall){depth, off / room + SLACK * fabs(depth)};
}

int plane_filter_nearer(const struct plane_filter *f,
                        const struct plane_filter *g, double x, double y) {
  struct fall of_f = fall_at(f, x, y), of_g = fall_at(g, x, y);
  double apart = (g->z - f->z) - (of_g.depth - of_f.depth);
  double off =
      of_f.off + of_g.off +
      SLACK * (fabs(g->z - f->z) + fabs(of_g.depth) + fabs(of_f.depth));
  return (apart > off) - (apart < -off);
}
