/* outline.h - joins directed segments of outlines to closed loops. */
#ifndef INK_FILL_OUTLINE_H
#define INK_FILL_OUTLINE_H

#include "ink/lines/paths.h"

struct outline_point {
  double x, y; /* page grid units, as in map_corner */
};

struct outline_segment {
  struct outline_point from, to;
  bool used; /* already in a loop */
};

struct outline {
  ARRAY(struct outline_segment) segment;
};

/* Begins a loop, which is a closed path; adds a point, rounded to the page
 * grid, to the loop begun last.  Both return false when memory ran out. */
USE_RESULT bool outline_begin_loop(struct ink_paths *loops);
USE_RESULT bool outline_add_point(struct ink_paths *loops,
                                  struct outline_point at);

/* Joins segments to closed loops.  As many segments must end at each point as
 * start there.  Where several start at a point, the one with the sharpest turn
 * to the left continues the loop.  The loop with the lexicographically least
 * starting point comes first.
 * outline  its segments are sorted, and all marked used afterwards
 * Returns false when memory ran out.
 * Cost  n log n */
USE_RESULT bool outline_trace(struct outline *outline, struct ink_paths *loops);

/* Removes the spikes of loops, where they run to a point and back and have no
 * area, and loops of which nothing else is left. */
void outline_remove_spikes(struct ink_paths *loops);

#endif
