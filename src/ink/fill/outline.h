/* outline.h - directed pieces of outline, joined end to end. */
#ifndef INK_FILL_OUTLINE_H
#define INK_FILL_OUTLINE_H

#include "ink/lines/paths.h"

struct outline_place {
  double x, y; /* grid units, as in map_corner */
};

struct outline_piece {
  struct outline_place from, to;
  uint32_t fragment; /* the caller's */
  bool used;
};

struct outline {
  ARRAY(struct outline_piece) piece;
};

/* By x, then by y: <0, 0 or >0. */
int outline_compare(struct outline_place a, struct outline_place b);

/* Loops are closed paths; begins one, adds a point to the one begun last,
 * rounded to the grid.  False when memory ran out. */
USE_RESULT bool outline_begin_loop(struct ink_paths *loops);
USE_RESULT bool outline_add_point(struct ink_paths *loops,
                                  struct outline_place at);

/* Joins pieces, of which as many come to a point as leave it, to loops; where
 * several leave a point by the sharpest turn to the left.  The loop with the
 * lowest point comes first.
 * outline  its pieces are sorted, and used afterwards */
USE_RESULT bool outline_trace(struct outline *outline, struct ink_paths *loops);

#endif
