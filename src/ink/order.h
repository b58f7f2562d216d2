/* order.h - the order of strokes that keeps the pen's way in the air short. */
#ifndef INK_ORDER_H
#define INK_ORDER_H

#include "ink/tour.h"

extern const struct tour_effort order_usual_effort;

/* Reorders the strokes of each layer, which stand together, and turns them
 * round, so that the way between them is short; loops start where it suits.
 * Every stroke keeps its shape and its ids.
 * Guarantees  The same for the same drawing; the travel is not longer than it
 *             was.
 * Cost        n log n for n points; see order_usual_effort. */
USE_RESULT bool order_near(struct drawing *drawing,
                           const struct tour_effort *effort);

/* How often the pen comes down: strokes that do not begin where the one before
 * ended. */
size_t order_pen_lifts(const struct drawing *drawing);

#endif
