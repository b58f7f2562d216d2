/* contour_cusps.h - where the image of a contour turns back.
 *
 * At a cusp a contour of a smooth surface runs along the line of sight: its
 * image turns back, and the radial curvature changes its sign.  Before it the
 * surface bends away from the line of sight and beyond it into it, or the other
 * way round. */
#ifndef VISIBILITY_CONTOUR_CONTOUR_CUSPS_H
#define VISIBILITY_CONTOUR_CONTOUR_CUSPS_H

#include "visibility/contour/contour_curves.h"

/* Adds cuts at cusps, where creases begin and end, and where loops were left
 * out.  Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool contour_cusps_cut(struct contour_curves *curves);

#endif
