/* used_box.h - the bounding box of the points of a scene that are used. */
#ifndef VIEW_USED_BOX_H
#define VIEW_USED_BOX_H

#include "scene/scene.h"
#include "view/camera.h"

/* Empty where low is more than high. */
struct used_box {
  double low[3], high[3];
};

/* Finds the box of the points as they are, or of what a camera sees of them:
 * across, up and the depth.
 * used    a byte a point, not 0 where it is used; NULL: all are
 * camera  NULL: points as they are
 * Returns false where the caller cancelled. */
USE_RESULT bool used_box_find(struct used_box *box, const struct scene *scene,
                              const uint8_t *used, const struct camera *camera);

/* Points of a part. */
enum { USED_BOX_POINTS = 64 };

/* The same of all points as they are, and of each part of them in order.
 * part  room for the boxes of all parts */
USE_RESULT bool used_box_find_parts(struct used_box *box, struct used_box *part,
                                    const struct scene *scene);

/* The same of what a camera sees of all points, of which only those parts are
 * looked at that may matter.
 * part  their boxes */
USE_RESULT bool used_box_find_seen(struct used_box *box,
                                   const struct used_box *part,
                                   const struct scene *scene,
                                   const struct camera *camera);

#endif
