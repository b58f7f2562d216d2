/* page_overflow.h - measures the requested lines that the page's margins clip
 * away. */
#ifndef VIEW_PAGE_OVERFLOW_H
#define VIEW_PAGE_OVERFLOW_H

#include "scene/topology/topology.h"
#include "view/camera.h"

struct page_overflow {
  uint64_t edges;   /* lines of which a part is outside the margins */
  double mm;        /* total length outside, hidden parts included */
  double excess_mm; /* the largest distance of any of them from the margins */
  bool axis[2];     /* some leave at the left or right; at the top or bottom */
};

/* Measures the edges and polylines of the requested classes as they would be
 * drawn on an unbounded page.  Intersections are not counted.  Visibility is
 * not computed outside the margins, so hidden parts there are counted too.
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status page_overflow_measure(struct page_overflow *overflow,
                                              const struct scene *scene,
                                              const struct topology *topology,
                                              const struct camera *camera,
                                              const recto_options *options,
                                              recto_error *error);

#endif
