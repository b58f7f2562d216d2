/* active_edge_pair.h - an active polygon of the z-buffers: its pair of active
 * edges and the depth along the left one.
 *
 * The plane of a facet is a x + b y + c z + d = 0 in frame units, so that
 *     z = -(a x + b y + d) / c,   dz_x = a / c,   dz_y = b / c.
 * One line down x_left moves by dx_left and y by -1, hence
 *     z_left := z_left - dz_x dx_left + dz_y,
 * and one column to the right z := z - dz_x.  x_left, dx_left and dy_left (the
 * lines left) are edges.left.x, .dx and .dy; those of the right likewise.
 *
 * Source   Rogers ch. 4; Foley, van Dam, Feiner & Hughes 15.6.
 */
#ifndef VISIBILITY_RASTER_ACTIVE_EDGE_PAIR_H
#define VISIBILITY_RASTER_ACTIVE_EDGE_PAIR_H

#include "visibility/raster/raster.h"

struct active_edge_pair {
  uint32_t facet;
  uint32_t count;
  const uint32_t *corner; /* the facet's `count` sheet points; borrowed, not
                             owned */
  struct scan_convex edges;
  double z_left, dz_x, dz_y;
  double z_low, z_high; /* of the facet's corners */
  bool steep;           /* see facet_is_steep */
};

/* Starts a facet at its topmost line.  Returns false where it covers no line.
 * facet  a triangle that identifies its facet (facet_of) and is not edge-on */
bool active_edge_pair_start(struct active_edge_pair *pair,
                            const struct raster *raster,
                            const struct facets *facets, uint32_t facet);

/* Draws the current line into the frame where the facet is nearer than what is
 * there.  A facet covers the pixels whose centres lie on its left or right
 * side, too: depth decides between it and its neighbour.  Returns how many
 * pixels it covers, hidden ones included. */
size_t active_edge_pair_draw(const struct active_edge_pair *pair,
                             struct raster *raster);

/* Moves one line down; false past the last line. */
bool active_edge_pair_next(struct active_edge_pair *pair,
                           const struct raster *raster);

#endif
