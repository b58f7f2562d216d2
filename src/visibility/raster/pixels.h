/* pixels.h - from the finished lines of a pixel frame to the visible map. */
#ifndef VISIBILITY_RASTER_PIXELS_H
#define VISIBILITY_RASTER_PIXELS_H

#include "base/sort.h"
#include "visibility/progress.h"
#include "visibility/raster/raster.h"
#include "visibility/raster/subpixels.h"
#include "visibility/scan/edge_sampling.h"
#include "visibility/scan/trapezoids.h"
#include "visibility/solver.h"

/* The lines so far, and what they make of edges and faces. */
struct pixels {
  const struct raster *raster;
  const struct solver_request *request;
  struct scan_grid grid; /* of the pixels */
  struct progress progress;
  struct subpixels subpixels; /* k > 1: the raster's pixels are sub-pixels */
  struct edge_sampling sampling;
  struct trapezoids trapezoids;
  uint32_t *above; /* the facets visible on the line above */
};

/* Bucket-sorts the facets that are drawn (with area, not removed as backs) and
 * cover a line: by top line, counted from the top, then by index.  The key is
 * the line, the value the facet.
 * Returns NULL when memory ran out.
 * Owner  the caller: mem_free */
struct sort_key *pixels_buckets(const struct raster *raster,
                                const struct facets *facets,
                                const struct solver_request *request,
                                size_t *count);

/* Adds a finished line of the frame.  To be called for all lines, from the top.
 * Errors  RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED. */
USE_RESULT recto_status pixels_line(struct pixels *pixels, int32_t line,
                                    recto_error *error);

/* Writes the map of a frame that holds all its lines, and its size to `section`
 * of the report.
 * subpixels  K: a pixel is made of K x K pixels of the raster; 1: of one */
USE_RESULT recto_status pixels_store(const struct raster *raster, int subpixels,
                                     const struct solver_request *request,
                                     struct map *map, struct report *report,
                                     const char *section, recto_error *error);

/* Draws all facets into an empty frame and passes each line to pixels_line.
 * covered  the number of pixels that facets cover, hidden or not, is added */
typedef recto_status pixels_draw_fn(struct raster *raster,
                                    const struct facets *facets,
                                    const struct solver_request *request,
                                    struct pixels *pixels, int64_t *covered,
                                    recto_error *error);

/* Solves a sheet by a z-buffer.
 * whole    the frame holds all lines of the request, else one
 * section  of the report */
USE_RESULT recto_status pixels_solve(struct sheet *sheet,
                                     const struct solver_request *request,
                                     bool whole, pixels_draw_fn *draw,
                                     const char *section, struct map *map,
                                     struct report *report, recto_error *error);

#endif
