/* smooth_surface.h - the smooth surface that a mesh samples, as a camera sees
 * it. */
#ifndef VISIBILITY_SMOOTH_SURFACE_H
#define VISIBILITY_SMOOTH_SURFACE_H

#include "scene/topology/topology.h"
#include "view/extent.h"

struct facing;

/* Zero-initialised is not known yet. */
struct smooth_surface {
  struct facing *facing; /* owned; NULL: it is not known */
};

/* Finds the surface, unless it is known.
 * scene       to live as long as the surface
 * topology    of the scene, with its corners; likewise
 * camera      its axes and its eye are set; likewise
 * crease_deg  where normals are split
 * Errors      RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED; smooth_surface_fini it
 *             in any case
 * Cost        linear in the mesh */
USE_RESULT recto_status smooth_surface_find(struct smooth_surface *surface,
                                            const struct scene *scene,
                                            const struct topology *topology,
                                            const struct camera *camera,
                                            double crease_deg,
                                            recto_error *error);
void smooth_surface_fini(struct smooth_surface *surface);

/* Includes its contour, which lies beyond the mesh where this is coarse.
 * surface  its camera has a scale, whichever
 * Errors   RECTO_ERROR_MEMORY */
USE_RESULT recto_status smooth_surface_grow_extent(
    struct extent *extent, const struct smooth_surface *surface,
    recto_error *error);

#endif
