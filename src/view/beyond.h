/* beyond.h - how much of what was asked for the page's margins cut away. */
#ifndef VIEW_BEYOND_H
#define VIEW_BEYOND_H

#include "scene/topology.h"
#include "view/camera.h"

struct beyond {
  uint64_t edges;  /* that leave the paper inside the margins, or are outside */
  double mm;       /* of them that is outside, hidden parts counted */
  double reach_mm; /* the farthest that one of them gets */
  bool axis[2];    /* they leave it to the sides; to the top or bottom */
};

/* Measures the edges and polylines of the classes asked for, but those where
 * faces pierce each other, as they would be drawn on an endless page.  What is
 * hidden out there nobody knows: all of it is counted.
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status beyond_measure(struct beyond *beyond,
                                       const struct scene *scene,
                                       const struct topology *topology,
                                       const struct camera *camera,
                                       const recto_options *options,
                                       recto_error *error);

#endif
