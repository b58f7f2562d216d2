/* drawn_outlines.h - the outlines that are drawn where contours are smooth: the
 * visible contours, and the borders and the silhouettes of coarse parts. */
#ifndef VISIBILITY_FIT_DRAWN_OUTLINES_H
#define VISIBILITY_FIT_DRAWN_OUTLINES_H

#include "visibility/contour/segment_grid.h"
#include "visibility/map.h"

struct drawn_outlines {
  const struct map *map;     /* borrowed, not owned */
  const struct sheet *sheet; /* borrowed, not owned */
  uint32_t first;            /* of the sheet's edges: the first contour's */
  struct segment_grid grid;
};

/* The nearest place on one. */
struct drawn_place {
  double at[2];    /* grid units */
  double distance; /* INFINITY: there is none */
  uint32_t edge;   /* of the sheet */
};

/* Lists them.  Creases are none: ink may leave them out.
 * drawn   zero-initialised but for what is borrowed, and `first`; the caller
 *         frees it
 * Returns false when memory ran out. */
USE_RESULT bool drawn_outlines_list(struct drawn_outlines *drawn);
void drawn_outlines_fini(struct drawn_outlines *drawn);

/* The nearest place to a point that is not farther than a radius.
 * along  the direction of a side there, with the surface on its left; contours
 *        that turn from it by more than 120 degrees count as farther; 0, 0: no
 *        contour does */
struct drawn_place drawn_outlines_find(const struct drawn_outlines *drawn,
                                       const double p[2], const double along[2],
                                       double radius);

#endif
