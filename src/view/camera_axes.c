/* camera_axes.c - the directions of the camera's axes in the scene. */
#include "view/camera_axes.h"

#include <string.h>

#include "base/tolerance.h"
#include "geom/vector.h"
#include "scene/angle.h"

/* The right axis of the front view: +X less its component along `up`.  Where
 * that is zero it is -Y or +Y, by the shortest rotation of +Y onto `up`.  No
 * choice is continuous for all directions of up (hairy ball theorem); this one
 * is except at +X and -X. */
static void find_right(const double up[3], double right[3]) {
  if (up[1] == 0 && up[2] == 0) {
    right[0] = right[2] = 0;
    right[1] = up[0] > 0 ? -1 : 1;
    return;
  }
  /* X - up (up . X), written without cancellation; up is a unit vector. */
  right[0] = up[1] * up[1] + up[2] * up[2];
  right[1] = -up[0] * up[1];
  right[2] = -up[0] * up[2];
  vector_normalise(right);
}

struct camera_axes camera_axes_from_direction(const double up[3],
                                              double azimuth_deg,
                                              double elevation_deg) {
  double u[3], r[3], f[3]; /* up, right and front of the scene */
  memcpy(u, up, sizeof u);
  vector_normalise(u);
  find_right(u, r);
  vector_cross(r, u, f);
  struct angle azimuth = angle_of_degrees(azimuth_deg);
  struct angle elevation = angle_of_degrees(elevation_deg);
  struct camera_axes axes;
  for (int k = 0; k < 3; k++) {
    double level = azimuth.cosine * f[k] + azimuth.sine * r[k];
    axes.back[k] = elevation.cosine * level + elevation.sine * u[k] + 0.0;
    axes.right[k] = azimuth.cosine * r[k] - azimuth.sine * f[k] + 0.0;
    axes.up[k] = elevation.cosine * u[k] - elevation.sine * level + 0.0;
  }
  return axes;
}

enum camera_axes_fault camera_axes_from_eye(struct camera_axes *axes,
                                            const double eye[3],
                                            const double target[3],
                                            const double up[3], bool may_turn) {
  double u[3];
  memcpy(u, up, sizeof u);
  for (int k = 0; k < 3; k++)
    axes->back[k] = eye[k] - target[k];
  if (!vector_is_finite(axes->back))
    for (int k = 0; k < 3; k++)
      axes->back[k] = eye[k] / 2 - target[k] / 2;
  if (!vector_normalise(axes->back))
    return CAMERA_AXES_NO_DIRECTION;
  if (!vector_normalise(u))
    return CAMERA_AXES_UP_ALONG_VIEW;
  vector_cross(u, axes->back, axes->right);
  if (!(vector_length(axes->right) > TOLERANCE_UP_SINE)) {
    if (!may_turn)
      return CAMERA_AXES_UP_ALONG_VIEW;
    double elevation_deg = vector_dot(u, axes->back) > 0 ? 90 : -90;
    struct camera_axes level = camera_axes_from_direction(up, 0, elevation_deg);
    vector_cross(level.up, axes->back, axes->right);
  }
  vector_normalise(axes->right);
  vector_cross(axes->back, axes->right, axes->up);
  vector_normalise(axes->up);
  return CAMERA_AXES_OK;
}
