/* judge_camera.c - cameras for the judge, from a place and from a drawing's
 * report. */
#include "tests/scenes/judge_camera.h"

#include <string.h>

#include "judge/camera.h"

/* Fills one row of the matrix, which is 0 at the eye. */
static void set_row(double row[4], struct judge_point3 direction) {
  row[0] = direction.x;
  row[1] = direction.y;
  row[2] = direction.z;
  row[3] = 0;
}

void judge_camera_look(struct judge_camera *camera, struct judge_point3 eye,
                       struct judge_point3 target, struct judge_point3 up,
                       double fov_deg, double width_mm, double height_mm,
                       double margin_mm) {
  memset(camera, 0, sizeof *camera);
  struct judge_point3 zero = {0, 0, 0};
  struct judge_point3 ahead = point3_unit(point3_sub(target, eye));
  struct judge_point3 right = point3_unit(point3_cross(ahead, up));
  struct judge_point3 above = point3_cross(right, ahead);
  double half_fov = fov_deg / 360 * acos(-1);
  double s = (height_mm - 2 * margin_mm) / (2 * tan(half_fov));
  /* page = middle + s (x, y) / d: row = middle d-row + s x-row. */
  struct judge_point3 x =
      point3_along(point3_along(zero, s, right), width_mm / 2, ahead);
  struct judge_point3 y =
      point3_along(point3_along(zero, s, above), height_mm / 2, ahead);
  set_row(camera->matrix, x);
  set_row(camera->matrix + 4, y);
  set_row(camera->matrix + 8, ahead);
  camera->perspective = true;
  camera->eye = eye;
  camera->back = point3_along(zero, -1, ahead);
  camera->width_mm = width_mm;
  camera->height_mm = height_mm;
}

/* The point that the matrix maps to (0, 0, 0): the intersection of the planes
 * of its three rows. */
static struct judge_point3 common_point(const double m[12]) {
  struct judge_point3 a = {m[0], m[1], m[2]}, b = {m[4], m[5], m[6]};
  struct judge_point3 c = {m[8], m[9], m[10]}, zero = {0, 0, 0};
  double volume = point3_dot(a, point3_cross(b, c));
  struct judge_point3 position =
      point3_along(zero, -m[3] / volume, point3_cross(b, c));
  position = point3_along(position, -m[7] / volume, point3_cross(c, a));
  return point3_along(position, -m[11] / volume, point3_cross(a, b));
}

void judge_camera_matrix(struct judge_camera *camera, const double matrix[12],
                         double width_mm, double height_mm) {
  struct judge_point3 third = {matrix[8], matrix[9], matrix[10]};
  memset(camera, 0, sizeof *camera);
  camera->perspective = point3_length(third) > 0;
  /* Scaled so that the third row is a depth in scene units, or 1. */
  double scale =
      camera->perspective ? 1 / point3_length(third) : 1 / matrix[11];
  for (int i = 0; i < 12; i++)
    camera->matrix[i] = matrix[i] * scale;
  if (camera->perspective) {
    camera->eye = common_point(camera->matrix);
    for (int i = 0; i < 3; i++)
      camera->matrix[4 * i + 3] = 0;
    camera->back = point3_unit(judge_point3_of(-third.x, -third.y, -third.z));
  } else {
    camera->near_d = -INFINITY;
    struct judge_point3 x = {matrix[0], matrix[1], matrix[2]};
    struct judge_point3 y = {matrix[4], matrix[5], matrix[6]};
    camera->back = point3_unit(point3_cross(x, y));
  }
  camera->width_mm = width_mm;
  camera->height_mm = height_mm;
}
