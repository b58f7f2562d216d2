/* pixels.h - from a frame's lines to the visible map: what the two z-buffers
 * share after a line was drawn. */
#ifndef VISIBILITY_PIXELS_H
#define VISIBILITY_PIXELS_H

#include "base/sort.h"
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

/* The facets that are drawn (with area, their backs not removed) and cover a
 * line, by the band of 2^shift lines, from the top, in which their top line is,
 * then by their order: the value is the facet, the key the band.
 * Returns NULL when memory ran out. */
struct sort_key *pixels_buckets(const struct raster *raster,
                                const struct facets *facets,
                                const struct solver_request *request, int shift,
                                size_t *count);

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
