/* draw_order.h - the facets that a z-buffer draws, sorted by tiles.
 *
 * The frame is divided into bands of lines from the top, and these into tiles.
 * A facet is drawn with the tile of its first line and its first corner's
 * column, so that the current part of the frame, and the corners that
 * neighbouring facets share, stay in the cache.
 */
#ifndef VISIBILITY_ZBUFFER_DRAW_ORDER_H
#define VISIBILITY_ZBUFFER_DRAW_ORDER_H

#include "visibility/raster/raster.h"
#include "visibility/solver.h"

#define DRAW_ORDER_BAND 16 /* lines */

/* A facet, and the corners of the triangle that identifies it. */
struct ordered_facet {
  uint32_t facet, corner[3];
};

struct draw_order {
  struct ordered_facet *item;
  size_t *past; /* of each band, from the top, the index past its facets */
  size_t bands;
  int32_t tallest; /* the most lines that one facet covers */
};

/* Sorts the facets that are drawn (with area, not removed as backs) and cover a
 * line.  Returns false when memory ran out. */
USE_RESULT bool draw_order_init(struct draw_order *order,
                                const struct raster *raster,
                                const struct facets *facets,
                                const struct solver_request *request);
void draw_order_fini(struct draw_order *order);

#endif
