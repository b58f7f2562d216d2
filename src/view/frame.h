/* frame.h - which way the camera's axes point in the scene. */
#ifndef VIEW_FRAME_H
#define VIEW_FRAME_H

#include <stdbool.h>

/* Unit vectors at right angles: right x up = back; the viewer looks along
 * -back. */
struct frame {
  double right[3], up[3], back[3];
};

/* Looks at the scene from its front, turned to the right by the azimuth and
 * up by the elevation.  Where up is +Y the front is at +Z, where it is +Z the
 * front is at -Y, and +X is at the right of both; other ups tilt these about
 * the X axis, or for a part along X about the axis that serves.
 * up  finite, not zero
 * Guarantees: angles that are multiples of 90 degrees about an up along an
 *             axis give only 0, 1 and -1. */
struct frame frame_from_direction(const double up[3], double azimuth_deg,
                                  double elevation_deg);

enum frame_fault { FRAME_OK = 0, FRAME_NO_DIRECTION, FRAME_UP_ALONG_VIEW };

/* Looks from eye to target; all finite.
 * may_turn  where up is along the view, take what is up in the view of a
 *           scene from right above it, or right below, as
 *           frame_from_direction has it */
enum frame_fault frame_from_eye(struct frame *frame, const double eye[3],
                                const double target[3], const double up[3],
                                bool may_turn);

#endif
