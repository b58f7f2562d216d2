/* newell_tests.h - Newell's tests: may P be painted before Q? */
#ifndef VISIBILITY_NEWELL_NEWELL_TESTS_H
#define VISIBILITY_NEWELL_NEWELL_TESTS_H

#include "visibility/predicate/triangle_pair.h"
#include "visibility/newell/newell_order.h"

enum newell_result {
  NEWELL_FAILED,  /* memory ran out */
  NEWELL_P_FIRST, /* P is nowhere in front of Q */
  NEWELL_Q_FIRST, /* P is in front of Q somewhere, Q of P nowhere */
  NEWELL_PIERCE   /* each is in front of the other somewhere */
};

/* The tests in rising cost; the first that settles the pair is counted.
 * Exact; equal planes by index, the earlier in front. */
enum newell_result newell_test(struct newell_order *order, uint32_t p,
                               uint32_t q);

/* The shape of a piece, in the scratch arena where it is a whole triangle. */
USE_RESULT bool newell_shape(struct newell_order *order, uint32_t piece,
                             struct geom_convex *shape);

/* Where the planes of two pieces cross, P in front on the line's left.
 * Returns as geom_line_between. */
int newell_crossing(const struct newell_order *order, uint32_t p, uint32_t q,
                    struct geom_line *line, struct geom_line *back);

#endif
