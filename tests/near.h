/* near.h - asserts that numbers are as expected, but for rounding. */
#ifndef TESTS_NEAR_H
#define TESTS_NEAR_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static inline void assert_within(double got, double want, double off) {
  if (!(fabs(got - want) <= off))
    fail_msg("%.17g is not within %g of %.17g", got, off, want);
}

/* Of numbers of the page's size, in units of about one. */
static inline void assert_near(double got, double want) {
  assert_within(got, want, 0x1p-30);
}

#endif
