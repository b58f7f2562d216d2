/* border_ends.h - lets borders and creases be visible up to where a smooth
 * contour ends on them. */
#ifndef VISIBILITY_FIT_BORDER_ENDS_H
#define VISIBILITY_FIT_BORDER_ENDS_H

#include "visibility/fold/outline_gaps.h"

/* Shows the hidden borders from where a visible contour of their surface ends
 * on one of them to where the next visible border along them ends: the mesh
 * folds over the border there, beyond its contour.  That is ahead of the
 * contour, if there is one, else back along it.  Hidden creases are shown in
 * the same way, along creases.
 * Bound  the border shown is no longer than the image of the contour's triangle
 *        there is wide
 * Cost   near linear in the contours' ends, the borders and the creases
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool border_ends_show(const struct outline_gaps_input *input);

#endif
