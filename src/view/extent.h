/* extent.h - how large the drawing is before it is scaled to the page. */
#ifndef VIEW_EXTENT_H
#define VIEW_EXTENT_H

#include "view/camera.h"

/* A rectangle in x / d, y / d for perspective, in x, y for orthographic. */
struct extent {
  double low[2], high[2]; /* x, y; low above high where there is nothing */
};

/* The rectangle of the used points that are not before the near plane.
 * camera  its axes, eye and near plane are set
 * used    one a point: see used.h
 * cuts    sides that cross the near plane count up to it.  A section is to be
 *         seen whole; a near plane chosen close before the eye would make all
 *         else tiny. */
struct extent extent_of_drawing(const struct camera *camera,
                                const struct scene *scene, const uint8_t *used,
                                bool cuts);

#endif
