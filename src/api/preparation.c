/* preparation.c - computes once what several views of a scene share. */
#include "api/preparation.h"

#include "scene/edge_classes.h"

#include <math.h>

recto_status preparation_init(struct preparation *preparation,
                              const struct scene *scene,
                              const recto_options *options, bool classes,
                              recto_error *error) {
  recto_options scaled;
  *preparation =
      (struct preparation){.weld = options->mesh.weld,

                           .coordinate_bits = options->mesh.coordinate_bits};
  recto_options_init(&scaled);
  scaled.mesh.weld = options->mesh.weld;
  recto_status status = rescale(&preparation->rescaled, scene, error);
  if (status == RECTO_OK)
    status = rescale_options(&preparation->rescaled, &scaled, error);
  if (status != RECTO_OK)
    return status;
  const struct weld_request request = {
      scaled.mesh.weld, precision_of_bits(options->mesh.coordinate_bits)};
  status = weld_near(&preparation->welded, &preparation->topology,
                     &preparation->rescaled.scene, &request, error);
  if (status == RECTO_OK && classes &&
      !topology_store_class_masks(&preparation->topology,
                                  &preparation->welded.scene,
                                  options->mesh.crease_deg))
    status = error_memory(error);
  return status;
}

void preparation_fini(struct preparation *preparation) {
  topology_fini(&preparation->topology);
  welded_fini(&preparation->welded);
  rescale_fini(&preparation->rescaled);
}

bool preparation_is_valid_for(const struct preparation *preparation,
                              const recto_options *options) {
  return preparation->weld == options->mesh.weld &&
         preparation->coordinate_bits == options->mesh.coordinate_bits;
}
