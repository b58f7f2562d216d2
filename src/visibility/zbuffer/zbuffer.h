/* zbuffer.h - the drawing step of the z-buffer, for its tests. */
#ifndef VISIBILITY_ZBUFFER_ZBUFFER_H
#define VISIBILITY_ZBUFFER_ZBUFFER_H

#include "visibility/raster/pixels.h"
#include "visibility/solver.h"

/* Draws all facets into the frame, which holds all lines.
 * pixels   receives each line as soon as it is finished; the frame becomes a
 *          ring buffer (raster_make_ring) that discards it; NULL: the frame is
 *          kept
 * covered  the number of pixels they cover, hidden or not, is added to it
 * Errors   RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED. */
USE_RESULT recto_status zbuffer_draw(struct raster *raster,
                                     const struct facets *facets,
                                     const struct solver_request *request,
                                     struct pixels *pixels, int64_t *covered,
                                     recto_error *error);

#endif
