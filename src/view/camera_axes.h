/* camera_axes.h - the directions of the camera's axes in the scene. */
#ifndef VIEW_CAMERA_AXES_H
#define VIEW_CAMERA_AXES_H

#include <stdbool.h>

/* A right-handed orthonormal basis, right x up = back; the viewer looks along
 * -back. */
struct camera_axes {
  double right[3], up[3], back[3];
};

/* The view from the scene's front, turned to the right by the azimuth and up by
 * the elevation.  Where up is +Y the front is at +Z; where it is +Z the front
 * is at -Y.  At the right is +X less its component along up.
 * up  finite, not zero
 * Guarantees: angles that are multiples of 90 degrees about an up along an
 *             axis give only 0, 1 and -1. */
struct camera_axes camera_axes_from_direction(const double up[3],
                                              double azimuth_deg,
                                              double elevation_deg);

enum camera_axes_fault {
  CAMERA_AXES_OK = 0,
  CAMERA_AXES_NO_DIRECTION,
  CAMERA_AXES_UP_ALONG_VIEW
};

/* The view from eye to target; all finite.
 * may_turn  where up is parallel to the view, the up of
 *           camera_axes_from_direction at
 *           an elevation of +-90 degrees is used; else that is an error */
enum camera_axes_fault camera_axes_from_eye(struct camera_axes *axes,
                                            const double eye[3],
                                            const double target[3],
                                            const double up[3], bool may_turn);

#endif
