/* pixels.h - from a frame's lines to the visible map: what the two z-buffers
 * share after a line was drawn. */
#ifndef VISIBILITY_PIXELS_H
#define VISIBILITY_PIXELS_H

#include "visibility/raster.h"
#include "visibility/solver.h"
#include "visibility/spans.h"
#include "visibility/trace.h"

struct pixels {
  const struct raster *raster;
  const struct solver_request *request;
  struct trace trace;
  struct spans spans;
  uint32_t *above; /* the facets seen on the line before */
};

/* Is the facet of a triangle drawn at all: it has area, and its back is not
 * removed? */
static inline bool pixels_draws(const struct sheet *sheet,
                                const struct solver_request *request,
                                uint32_t triangle) {
  unsigned left_out = SHEET_FLAT | (request->remove_backs ? SHEET_FLIPPED : 0u);
  return (sheet->triangle_flags[triangle] & left_out) == 0;
}

USE_RESULT recto_status pixels_init(struct pixels *pixels,
                                    const struct raster *raster,
                                    const struct solver_request *request,
                                    recto_error *error);
void pixels_fini(struct pixels *pixels);

/* Takes a finished line of the frame; all come, from the top.
 * Errors  RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED. */
USE_RESULT recto_status pixels_line(struct pixels *pixels, int32_t line,
                                    recto_error *error);

USE_RESULT recto_status pixels_finish(struct pixels *pixels, struct map *map,
                                      recto_error *error);

#endif
