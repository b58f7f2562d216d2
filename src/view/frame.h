/* frame.h - the directions of the camera's axes in the scene. */
#ifndef VIEW_FRAME_H
#define VIEW_FRAME_H

#include <stdbool.h>

/* A right-handed orthonormal basis, right x up = back; the viewer looks along
 * -back. */
struct frame {
  double right[3], up[3], back[3];
};

/* The view from the scene's front, turned to the right by the azimuth and up by
 * the elevation.  Where up is +Y the front is at +Z; where it is +Z the front
 * is at -Y.  At the right is +X less its component along up.
 * up  finite, not zero
 * Guarantees: angles that are multiples of 90 degrees about an up along an
 *             axis give only 0, 1 and -1. */
struct frame frame_from_direction(const double up[3], double azimuth_deg,
                                  double elevation_deg);

enum frame_fault { FRAME_OK = 0, FRAME_NO_DIRECTION, FRAME_UP_ALONG_VIEW };

/* The view from eye to target; all finite.
 * may_turn  where up is parallel to the view, the up of frame_from_direction at
 *           an elevation of +-90 degrees is used; else that is an error */
enum frame_fault frame_from_eye(struct frame *frame, const double eye[3],
                                const double target[3], const double up[3],
                                bool may_turn);

#endif
