/* circle_clip.h - what of a drawing lies in a circle of its page. */
#ifndef DRAWING_CIRCLE_CLIP_H
#define DRAWING_CIRCLE_CLIP_H

#include "drawing/drawing.h"

/* Removes what is outside of a circle.  Nothing sticks out of a line of
 * `width_mm` along the circle: wider lines end before it, and fills with their
 * seams too.  Curves that leave the circle become polylines.
 * Returns false when memory ran out. */
USE_RESULT bool drawing_clip_circle(struct drawing *drawing,
                                    const struct drawing_circle *circle,
                                    double width_mm);

#endif
