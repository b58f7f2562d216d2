/* stroke_loops.h - keeps a stroke's crossings with itself. */
#ifndef INK_CURVE_STROKE_LOOPS_H
#define INK_CURVE_STROKE_LOOPS_H

#include "ink/curve/own_crossings.h"
#include "ink/curve/part_fit.h"

struct stroke_loops {
  struct own_crossings of_stroke, of_pieces; /* memory */
};

/* Compares the crossings of a stroke with itself with those of the pieces that
 * were fitted to it, from a control point on.  Where these differ by one,
 * vertices within `about` mm of its places become corners, and the sides
 * between them straight.
 * same  gets whether they do not differ
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool stroke_loops_keep(struct stroke_loops *loops,
                                  struct stroke_shape *shape,
                                  const struct part_fit *pieces, size_t control,
                                  double about, bool *same);
void stroke_loops_fini(struct stroke_loops *loops);

#endif
