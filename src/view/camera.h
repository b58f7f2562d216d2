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

/* Aims the camera at the scene by the options' view, fit, near distance and
 * section.
 * Errors  RECTO_ERROR_ARGUMENT: the eye equals the target, up is parallel to
 *         the view, margins that leave no room, a page above 2 m, a field of
 *         view out of range;
 *         RECTO_ERROR_EMPTY: nothing to draw, or all of it behind the viewer;
 *         RECTO_ERROR_LIMIT: the scene is too large, too small, too far
 *         or too close. */
USE_RESULT recto_status camera_aim(struct camera *camera,
                                   const struct scene *scene,
                                   const recto_options *options,
                                   recto_error *error);

/* Sets the 3 x 4 matrix from scene units to homogeneous page mm, row by
 * row. */
void camera_matrix(const struct camera *camera, double matrix[12]);

#endif
