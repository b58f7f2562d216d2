/* tour.h - in which order, and from which end, strokes are drawn. */
#ifndef INK_ORDER_TOUR_H
#define INK_ORDER_TOUR_H

#include "drawing/drawing.h"

/* What may be spent on a better tour, in all. */
struct tour_effort {
  double looks; /* neighbours weighed */
  double moves; /* strokes put elsewhere in the tour's memory */
};

/* Stroke i has ends 2 i and 2 i + 1.  The tour starts at `start` and ends
 * wherever it likes. */
struct tour {
  const struct drawing_point *end; /* lent */
  uint32_t count;                  /* of strokes */
  struct drawing_point start;
  uint32_t *stroke; /* in order */
  bool *turned;     /* of each stroke: entered at end 2 i + 1 */
};

double tour_travel(const struct tour *tour);

/* Shortens a tour by 2-opt and Or-opt moves between near neighbours.
 * Guarantees  not longer than it was; the same for the same tour. */
USE_RESULT bool tour_improve(struct tour *tour,
                             const struct tour_effort *effort);

#endif
