/* extent.h - the bounding box of the projected scene, before it is scaled to
 * the page. */
#ifndef VIEW_EXTENT_H
#define VIEW_EXTENT_H

#include <math.h>

#include "view/camera.h"

/* In x / d, y / d for perspective, in x, y for orthographic views. */
struct extent {
  double low[2], high[2]; /* low > high where it is empty */
};

static inline struct extent extent_empty(void) {
  return (struct extent){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
}

/* Includes another box. */
static inline void extent_include(struct extent *extent,
                                  const struct extent *other) {
  for (int k = 0; k < 2; k++) {
    extent->low[k] = fmin(extent->low[k], other->low[k]);
    extent->high[k] = fmax(extent->high[k], other->high[k]);
  }
}

/* Includes a point that is not in front of the near plane. */
void extent_grow(struct extent *extent, const struct camera *camera,
                 struct view_point at);

/* The box of the used points that are not in front of the near plane.
 * camera  its axes, eye and near plane are set
 * used    one a point: see used.h
 * cuts    whether the points in which sides cross the near plane are included.
 *         At a near plane close to the eye of a perspective view they would
 *         make all else tiny. */
struct extent extent_of_drawing(const struct camera *camera,
                                const struct scene *scene, const uint8_t *used,
                                bool cuts);

#endif
