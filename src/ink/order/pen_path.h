/* pen_path.h - the order of strokes that keeps the pen's way in the air short.
 * */
#ifndef INK_ORDER_PEN_PATH_H
#define INK_ORDER_PEN_PATH_H

#include "ink/order/tour.h"

extern const struct tour_effort pen_path_usual_effort;

/* Reorders the strokes of each layer, which stand together, and turns them
 * round, so that the way between them is short; loops start where it suits.
 * Every stroke keeps its shape and its ids.
 * Guarantees  The same for the same drawing; the travel is not longer than it
 *             was.
 * Cost        n log n for n points; see pen_path_usual_effort. */
USE_RESULT bool pen_path_order(struct drawing *drawing,
                               const struct tour_effort *effort);

/* How often the pen comes down: strokes that do not begin where the one before
 * ended. */
size_t pen_path_pen_lifts(const struct drawing *drawing);

#endif
