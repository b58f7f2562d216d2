/* smooth_surface.c - finds a smooth surface once for all that ask for it. */
#include "visibility/smooth_surface.h"

#include "visibility/zero_set/zero_set.h"

recto_status smooth_surface_find(struct smooth_surface *surface,
                                 const struct scene *scene,
                                 const struct topology *topology,
                                 const struct camera *camera, double crease_deg,
                                 recto_error *error) {
  if (surface->facing != NULL)
    return RECTO_OK;
  surface->facing = mem_calloc(1, sizeof *surface->facing);
  return surface->facing != NULL ? facing_init(surface->facing, scene, topology,
                                               camera, crease_deg, error)
                                 : error_memory(error);
}

void smooth_surface_fini(struct smooth_surface *surface) {
  if (surface->facing != NULL)
    facing_fini(surface->facing);
  mem_free(surface->facing);
  surface->facing = NULL;
}

recto_status smooth_surface_grow_extent(struct extent *extent,
                                        const struct smooth_surface *surface,
                                        recto_error *error) {
  return zero_set_grow_extent(extent, surface->facing, error);
}
