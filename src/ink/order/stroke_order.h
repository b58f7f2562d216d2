/* stroke_order.h - orders strokes for short pen-up travel. */
#ifndef INK_ORDER_STROKE_ORDER_H
#define INK_ORDER_STROKE_ORDER_H

#include "ink/order/tour.h"

/* The limits of work that recto uses. */
extern const struct tour_effort stroke_order_usual_effort;

/* Reorders and reverses the strokes of each layer, and chooses the starting
 * points of loops, to make the travel with the pen up short.  The strokes of a
 * layer must be consecutive; where classes differ in weight, those of a class
 * are, and remain so.  Every stroke keeps its shape and its ids.
 * Guarantees  Equal drawings give equal results.  The travel does not become
 *             longer.
 * Cost        n log n for n points; see stroke_order_usual_effort.
 * Returns false when memory ran out. */
USE_RESULT bool stroke_order_improve(struct drawing *drawing,
                                     const struct tour_effort *effort);

/* How often the pen comes down: the number of strokes that do not begin where
 * the previous one of their layer ended. */
size_t stroke_order_pen_lifts(const struct drawing *drawing);

#endif
