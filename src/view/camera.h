/* camera.h - the camera: a homogeneous map from scene units to page mm. */
#ifndef VIEW_CAMERA_H
#define VIEW_CAMERA_H

#include "scene/precision.h"
#include "scene/scene.h"

/* View coordinates: x right, y up, the viewer looks along -z; the depth of a
 * point is d = -z.  Its place on the page is
 *   perspective   mm = middle + s (x, y) / d
 *   orthographic  mm = middle + s (x, y) */
struct camera {
  double right[3], up[3], back[3]; /* unit, orthogonal, scene space */
  double eye[3]; /* scene units; orthographic: any point that all visible
                    points are in front of */
  bool perspective;
  double s;            /* perspective: mm; orthographic: mm a scene unit */
  double middle_mm[2]; /* where the view axis meets the page */
  double near_d;       /* the near plane: nothing with d < near_d is drawn;
                          > 0 in perspective */
  double d_min, d_max; /* depth range of the scene, near_d <= d_min; in a
                          sheet's camera, of what is on the page */
  double page_mm[2];   /* width, height */
  double margin_mm;    /* on every side of the page; nothing is drawn there */
  double size;         /* diagonal of the scene's bounding box */
  double contact;      /* contact tolerance, scene units; negative: for each
                          face the rounding error of its coordinates
                          (coordinate_error.h) */
  double contact_most; /* upper bound of all faces' contact tolerances */
  double error;        /* of all coordinates, coordinate_error_common */
  struct precision unstated; /* of points whose precision is not stated */
  bool near_chosen;          /* near_d is the default, not an option */
  bool all_on_page; /* nothing drawn leaves the page or the depth range */
};

/* x right, y up, d the depth in front of the eye. */
struct view_point {
  double x, y, d;
};

/* The view coordinates of a scene point.  All code must use this function: the
 * camera's depth range and the sheet's clipping need the same depth of a point,
 * bit for bit. */
static inline struct view_point camera_view(const struct camera *camera,
                                            const struct scene_point *at) {
  double p[3] = {at->x - camera->eye[0], at->y - camera->eye[1],
                 at->z - camera->eye[2]};
  const double *r = camera->right, *u = camera->up, *b = camera->back;
  return (struct view_point){r[0] * p[0] + r[1] * p[1] + r[2] * p[2],
                             u[0] * p[0] + u[1] * p[1] + u[2] * p[2],
                             -(b[0] * p[0] + b[1] * p[1] + b[2] * p[2])};
}

/* Sets the 3 x 4 matrix from scene units to homogeneous page mm, row by
 * row. */
void camera_matrix(const struct camera *camera, double matrix[12]);

#endif
