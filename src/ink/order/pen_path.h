/* pen_path.h - orders strokes for short pen-up travel. */
#ifndef INK_ORDER_PEN_PATH_H
#define INK_ORDER_PEN_PATH_H

#include "ink/order/tour.h"

/* The limits of work that recto uses. */
extern const struct tour_effort pen_path_usual_effort;

/* Reorders and reverses the strokes of each layer, and chooses the starting
 * points of loops, to make the travel with the pen up short.  The strokes of a
 * layer must be consecutive.  Every stroke keeps its shape and its ids.
 * Guarantees  Equal drawings give equal results.  The travel does not become
 *             longer.
 * Cost        n log n for n points; see pen_path_usual_effort.
 * Returns false when memory ran out. */
USE_RESULT bool pen_path_order(struct drawing *drawing,
                               const struct tour_effort *effort);

/* How often the pen comes down: the number of strokes that do not begin where
 * the previous one of their layer ended. */
size_t pen_path_pen_lifts(const struct drawing *drawing);

#endif
