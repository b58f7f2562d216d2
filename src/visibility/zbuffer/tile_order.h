/* tile_order.h - the facets that a z-buffer draws, in the order of drawing.
 *
 * The frame is cut into bands of lines from the top, and these into tiles.  A
 * facet is drawn with the tile that holds its first line and about where it is,
 * so that the part of the frame at hand, and the corners that neighbours share,
 * stay in the cache.
 */
#ifndef VISIBILITY_ZBUFFER_TILE_ORDER_H
#define VISIBILITY_ZBUFFER_TILE_ORDER_H

#include "visibility/raster/raster.h"
#include "visibility/solver.h"

#define TILE_ORDER_BAND 16 /* lines */

/* A facet, and the corners of the triangle that it is known by. */
struct ordered_facet {
  uint32_t facet, corner[3];
};

struct tile_order {
  struct ordered_facet *item;
  size_t *past; /* of each band, from the top, the index past its pieces */
  size_t bands;
  int32_t tallest; /* lines that one facet covers at most */
};

/* Takes the facets that are drawn (with area, their backs not removed) and
 * cover a line.  False when memory ran out. */
USE_RESULT bool tile_order_init(struct tile_order *order,
                                const struct raster *raster,
                                const struct facets *facets,
                                const struct solver_request *request);
void tile_order_fini(struct tile_order *order);

#endif
