/* camera_extent.h - the bounding box of a view before it has a scale. */
#ifndef VIEW_CAMERA_EXTENT_H
#define VIEW_CAMERA_EXTENT_H

#include "view/camera.h"
#include "view/extent.h"

/* Measures what the options' parallel projection draws, whatever their fit.
 * box     in scene units, from where the target is, which with RECTO_FIT_SCALE
 *         is placed on the middle of the page
 * camera  aimed; its scale and its place on the page have no meaning
 * Errors  as of camera_aim */
USE_RESULT recto_status camera_extent(struct extent *box, struct camera *camera,
                                      const struct scene *scene,
                                      const recto_options *options,
                                      recto_error *error);

/* Where the target is along an axis of such a camera, in scene units. */
static inline double camera_extent_target(const struct camera *camera,
                                          int axis) {
  return (camera->page_mm[axis] / 2 - camera->middle_mm[axis]) / camera->s;
}

#endif
