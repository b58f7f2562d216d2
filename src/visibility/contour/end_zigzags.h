/* end_zigzags.h - takes off what open contours overshoot at their ends. */
#ifndef VISIBILITY_CONTOUR_END_ZIGZAGS_H
#define VISIBILITY_CONTOUR_END_ZIGZAGS_H

#include "visibility/contour/contour_curves.h"

/* Where an open curve's image turns back at its last segment, which is shorter
 * than its triangle is high and runs along no crease, that and the one before
 * it become one straight segment, as part of the last one; and so do its first
 * two.  At a border the surface is seen edge-on, and the curve zigzags about
 * the line of sight there.
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool end_zigzags_straighten(struct contour_curves *curves,
                                       struct zero_set *set,
                                       const struct camera *camera);

#endif
