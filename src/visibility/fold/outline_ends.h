/* outline_ends.h - where visible intersections end on a mesh's outlines. */
#ifndef VISIBILITY_FOLD_OUTLINE_ENDS_H
#define VISIBILITY_FOLD_OUTLINE_ENDS_H

#include "visibility/fold/outline_gaps.h"

/* Where an intersection ends on an outline. */
struct outline_end {
  uint32_t outline;
  double t;             /* of it */
  struct geom_point at; /* on the page */
  bool is_closed[2];    /* what leads there, and on from there, is known */
};

/* Ascending by outline and t. */
struct outline_ends {
  struct outline_end *item;
  size_t count, capacity;
};

/* Lists them; one that passes behind an outline does not end on it.
 * Cost  near linear in the outlines, and the ends
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool outline_ends_list(struct outline_ends *ends,
                                  const struct outline_gaps_input *input);

/* The first end of an outline on the way from a parameter to another one but
 * for one end; SIZE_MAX: none. */
size_t outline_ends_between(const struct outline_ends *ends, uint32_t outline,
                            double from, double to, size_t but);

#endif
