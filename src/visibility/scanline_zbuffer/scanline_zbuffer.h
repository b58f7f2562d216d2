/* scanline_zbuffer.h - the lists of the scan-line z-buffer, for its tests. */
#ifndef VISIBILITY_SCANLINE_ZBUFFER_SCANLINE_ZBUFFER_H
#define VISIBILITY_SCANLINE_ZBUFFER_SCANLINE_ZBUFFER_H

#include "base/sort.h"
#include "visibility/raster/active_edge_pair.h"
#include "visibility/solver.h"

struct scanline {
  struct raster *raster; /* holds one line */
  const struct facets *facets;
  struct sort_key *bucket; /* facets by first line from the top, then order */
  size_t bucket_count, entered;
  /* Unordered: of equally near facets the one of lower index is kept whichever
   * is drawn first. */
  ARRAY(struct active_edge_pair) active;
  int64_t covered;
};

/* Sorts the facets that are drawn into buckets.  False when memory ran out. */
USE_RESULT bool scanline_init(struct scanline *scanline, struct raster *raster,
                              const struct facets *facets,
                              const struct solver_request *request);
void scanline_fini(struct scanline *scanline);

/* Adds the facets that start on the line to the active list.  False when memory
 * ran out. */
USE_RESULT bool scanline_enter(struct scanline *scanline, int32_t line);

/* Draws the active facets into the one line of the frame. */
void scanline_draw(struct scanline *scanline);

/* Moves the active pairs to the next line, and removes those that end. */
void scanline_step(struct scanline *scanline);

#endif
