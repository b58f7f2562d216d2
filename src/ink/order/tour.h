/* tour.h - the order and direction in which strokes are drawn. */
#ifndef INK_ORDER_TOUR_H
#define INK_ORDER_TOUR_H

#include "drawing/drawing.h"

/* Limits of the work done by tour_improve, in all. */
struct tour_effort {
  double neighbours_examined_max; /* candidate neighbours examined */
  double strokes_moved_max;       /* moved within the array of the tour */
};

/* An open tour: it starts at `start`, and its last point is free.  Stroke i has
 * the ends 2 i and 2 i + 1. */
struct tour {
  const struct drawing_point *end; /* borrowed, not owned */
  uint32_t count;                  /* of strokes */
  struct drawing_point start;
  uint32_t *stroke; /* in order */
  bool *reversed;   /* of each stroke: drawn from end 2 i + 1 to end 2 i */
};

/* The length of the pen-up travel, in mm. */
double tour_travel(const struct tour *tour);

/* Shortens the travel by 2-opt and Or-opt moves between near neighbours.
 * Guarantees  The travel does not become longer.  Equal tours give equal
 *             results.
 * Returns false when memory ran out; the tour is then unchanged. */
USE_RESULT bool tour_improve(struct tour *tour,
                             const struct tour_effort *effort);

#endif
