/* camera.h - from scene units to the page, as one homogeneous map. */
#ifndef VIEW_CAMERA_H
#define VIEW_CAMERA_H

#include "scene/precision.h"
#include "scene/scene.h"

/* View coordinates: x right, y up, the viewer looks along -z; the depth of a
 * point is d = -z.  On the page, perspective: mm = middle + s (x, y) / d;
 * orthographic: mm = middle + s (x, y). */
struct camera {
  double right[3], up[3], back[3]; /* unit, orthogonal, scene space */
  double eye[3]; /* scene units; orthographic: any point that has
                    every visible one in front */
  bool perspective;
  double s;            /* perspective: mm; orthographic: mm a scene unit */
  double middle_mm[2]; /* where the view axis meets the page */
  double near_d;       /* nothing with d < near_d is drawn; > 0 in
                          perspective */
  double d_min, d_max; /* depth range of the scene, near_d <= d_min; in a sheet
                          of what is on its page */
  double page_mm[2];   /* width, height */
  double margin_mm;    /* on every side of it; nothing is drawn there */
  double size;         /* diagonal of the scene's bounding box */
  double contact;      /* scene units; negative: what rounding explains of
                          each face (coordinate_error.h) */
  double contact_most; /* no face's contact tolerance exceeds it */
  struct precision unstated; /* of points whose precision nobody stated */
  bool near_chosen; /* nobody gave near_d: it is as near as depths allow */
  bool all_on_page; /* nothing drawn leaves the page or the depth range */
};

/* Aims the camera at the scene as the options ask (view, fit, near, section).
 * Errors  RECTO_ERROR_ARGUMENT: eye on target, up along the view, a page or
 *         margin that leaves no room, a page beyond 2 m, a bad fov;
 *         RECTO_ERROR_EMPTY: nothing to draw, or all behind the viewer. */
USE_RESULT recto_status camera_aim(struct camera *camera,
                                   const struct scene *scene,
                                   const recto_options *options,
                                   recto_error *error);

/* The 3 x 4 matrix from model to page mm (homogeneous), row by row. */
void camera_matrix(const struct camera *camera, double matrix[12]);

#endif
