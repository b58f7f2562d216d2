/* camera_extent.c - the bounding box of a view before it has a scale. */
#include "view/camera_extent.h"

#include "view/camera_aim.h"
#include "view/used.h"

recto_status camera_extent(struct extent *box, struct camera *camera,
                           const struct scene *scene,
                           const recto_options *options, recto_error *error) {
  recto_options sphere = *options; /* which has a scale that no scene exceeds */
  sphere.camera.fit = RECTO_FIT_SPHERE;
  recto_status status = camera_aim(camera, scene, &sphere, error);
  if (status != RECTO_OK)
    return status;
  uint8_t *used = used_points(scene, NULL);
  if (used == NULL)
    return error_memory(error);
  *box = extent_of_drawing(camera, scene, used, true);
  mem_free(used);
  for (int k = 0; k < 2; k++) {
    double target = camera_extent_target(camera, k);
    box->low[k] -= target;
    box->high[k] -= target;
  }
  return RECTO_OK;
}
