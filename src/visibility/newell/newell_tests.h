/* newell_tests.h - Newell's tests, which decide whether piece P may be painted
 * before piece Q. */
#ifndef VISIBILITY_NEWELL_NEWELL_TESTS_H
#define VISIBILITY_NEWELL_NEWELL_TESTS_H

#include "visibility/newell/newell_piece.h"

enum newell_result {
  NEWELL_FAILED,  /* memory ran out */
  NEWELL_P_FIRST, /* P is nowhere in front of Q */
  NEWELL_Q_FIRST, /* P is in front of Q somewhere, Q of P nowhere */
  NEWELL_PIERCE   /* each is in front of the other somewhere */
};

/* Applies the tests in order of increasing cost until one decides; that one is
 * counted.  If the planes are equal, the piece of the triangle of lower index
 * is in front.  Exact. */
enum newell_result newell_test(struct newell_order *order, uint32_t p,
                               uint32_t q);

/* The same by the first `order->tests` of the tests A to D alone, B and C with
 * both roles.  What they leave open, the depth of the farthest corner
 * decides. */
enum newell_result newell_test_some(struct newell_order *order, uint32_t p,
                                    uint32_t q);

/* The line where the planes of two pieces intersect, P being in front on its
 * left, and the same line reversed.
 * Returns 0; if the planes are parallel, another value as geom_line_between,
 * and no line. */
int newell_crossing(const struct newell_order *order, uint32_t p, uint32_t q,
                    struct geom_line *line, struct geom_line *reversed);

#endif
