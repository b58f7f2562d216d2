/* pixels.h - from a frame's lines to the visible map: what the two z-buffers
 * share after a line was drawn. */
#ifndef VISIBILITY_RASTER_PIXELS_H
#define VISIBILITY_RASTER_PIXELS_H

#include "base/sort.h"
#include "visibility/progress.h"
#include "visibility/raster/raster.h"
#include "visibility/solver.h"
#include "visibility/scan/trapezoids.h"
#include "visibility/raster/subpixels.h"
#include "visibility/scan/edge_sampling.h"

struct pixels {
  const struct raster *raster;
  const struct solver_request *request;
  struct scan_grid grid; /* of the pixels */
  struct progress progress;
  struct subpixels subpixels; /* k > 1: the raster's pixels are sub-pixels */
  struct edge_sampling sampling;
  struct trapezoids trapezoids;
  uint32_t *above; /* what was seen on the line before */
};

/* The facets that are drawn (with area, their backs not removed) and cover a
 * line, by their top line, counted from the top, then by their order: the value
 * is the facet, the key the line.
 * Returns NULL when memory ran out. */
struct sort_key *pixels_buckets(const struct raster *raster,
                                const struct facets *facets,
                                const struct solver_request *request,
                                size_t *count);

/* subpixels  K: a pixel is made of K x K of the raster's; 1: of one */
USE_RESULT recto_status pixels_init(struct pixels *pixels,
                                    const struct raster *raster, int subpixels,
                                    const struct solver_request *request,
                                    recto_error *error);
void pixels_fini(struct pixels *pixels);

/* Takes a finished line of the frame; all come, from the top.
 * Errors  RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED. */
USE_RESULT recto_status pixels_line(struct pixels *pixels, int32_t line,
                                    recto_error *error);

/* Writes the map, and to `section` of the report what the frame was. */
USE_RESULT recto_status pixels_finish(struct pixels *pixels, struct map *map,
                                      struct report *report,
                                      const char *section, recto_error *error);

/* All of it for a frame that holds all its lines. */
USE_RESULT recto_status pixels_store(const struct raster *raster, int subpixels,
                                     const struct solver_request *request,
                                     struct map *map, struct report *report,
                                     const char *section, recto_error *error);

#endif
