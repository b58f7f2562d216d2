/* camera.c - the judge's own projection. */
#include <string.h>

#include "base/tolerance.h"
#include "judge/camera.h"

/* Fills one row of the matrix: (direction, value at the eye). */
static void set_row(double row[4], struct judge_point3 direction,
                    double offset) {
  row[0] = direction.x;
  row[1] = direction.y;
  row[2] = direction.z;
  row[3] = offset;
}

static struct judge_point3 point3_of(const double xyz[3]) {
  return judge_point3_of(xyz[0], xyz[1], xyz[2]);
}

void judge_camera_axes(struct judge_camera *camera, const double right[3],
                       const double up[3], const double back[3],
                       const double eye[3], bool perspective, double s,
                       const double middle_mm[2], const double page_mm[2]) {
  const double *axis[2] = {right, up};
  const struct judge_point3 zero = {0, 0, 0};
  memset(camera, 0, sizeof *camera);
  camera->perspective = perspective;
  camera->eye = point3_of(eye);
  camera->back = point3_of(back);
  camera->near_d = -INFINITY;
  camera->width_mm = page_mm[0];
  camera->height_mm = page_mm[1];
  struct judge_point3 ahead = point3_along(zero, -1, camera->back);
  for (int k = 0; k < 2; k++) {
    struct judge_point3 row = point3_along(zero, s, point3_of(axis[k]));
    if (perspective)
      row = point3_along(row, middle_mm[k], ahead);
    set_row(camera->matrix + 4 * k, row, perspective ? 0 : middle_mm[k]);
  }
  if (perspective)
    set_row(camera->matrix + 8, ahead, 0);
  else
    set_row(camera->matrix + 8, zero, 1);
}

static double apply_row(const double row[4], struct judge_point3 v) {
  return row[0] * v.x + row[1] * v.y + row[2] * v.z;
}

/* By the offset from the eye, exact near it: the products of a position
 * there are as large as those of the eye, and cancel but for their rounding. */
struct judge_homogeneous judge_homogeneous_of(const struct judge_camera *camera,
                                              struct judge_point3 p) {
  const double *m = camera->matrix;
  struct judge_homogeneous h =
      judge_homogeneous_along(camera, point3_sub(p, camera->eye));
  return (struct judge_homogeneous){h.x + m[3], h.y + m[7], h.w + m[11]};
}

struct judge_homogeneous
judge_homogeneous_along(const struct judge_camera *camera,
                        struct judge_point3 v) {
  const double *m = camera->matrix;
  return (struct judge_homogeneous){apply_row(m, v), apply_row(m + 4, v),
                                    apply_row(m + 8, v)};
}

double judge_homogeneous_w(const struct judge_camera *camera,
                           struct judge_point3 p) {
  return judge_homogeneous_of(camera, p).w;
}

double judge_view_depth(const struct judge_camera *camera,
                        struct judge_point3 p) {
  return camera->perspective
             ? judge_homogeneous_w(camera, p)
             : point3_dot(camera->back, point3_sub(camera->eye, p));
}

/* Depths at the near plane are rounded like all others: at either end of what
 * is clipped, and once more where a plane goes through the rounded ends.  A
 * near plane that is chosen goes through the scene's nearest point, which a cut
 * may have made. */
double judge_near_tolerance(const struct judge_camera *camera) {
  if (!isfinite(camera->near_d))
    return 0;
  double unit = camera->perspective ? camera->near_d * camera->near_d : 1;
  return fabs(camera->near_d) * TOLERANCE_JUDGE_NEAR_SHARE +
         4 * camera->depth_contact * unit + camera->near_error;
}

double judge_near(const struct judge_camera *camera) {
  return camera->near_d - judge_near_tolerance(camera);
}

struct judge_point2 judge_project(const struct judge_camera *camera,
                                  struct judge_point3 p) {
  struct judge_homogeneous h = judge_homogeneous_of(camera, p);
  return (struct judge_point2){h.x / h.w, h.y / h.w};
}

/* With P's image at m(P) / d(P), a step v that keeps the depth moves the image
 * by
 *     (row_x . v, row_y . v) / d.
 * The v wanted is a linear combination of the rows' components perpendicular to
 * the view direction. */
struct judge_point3 judge_shift(const struct judge_camera *camera,
                                struct judge_point3 p, double dx, double dy) {
  const double *m = camera->matrix;
  struct judge_point3 x = {m[0], m[1], m[2]}, y = {m[4], m[5], m[6]};
  x = point3_along(x, -point3_dot(x, camera->back), camera->back);
  y = point3_along(y, -point3_dot(y, camera->back), camera->back);
  double depth = judge_homogeneous_w(camera, p);
  p = point3_along(p, dx * depth / point3_dot(x, x), x);
  return point3_along(p, dy * depth / point3_dot(y, y), y);
}
