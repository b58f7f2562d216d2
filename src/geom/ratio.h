/* ratio.h - exact rational parameters along an edge. */
#ifndef GEOM_RATIO_H
#define GEOM_RATIO_H

#include <stdbool.h>
#include <stdint.h>

#include "geom/int128.h"

/* num / den with den > 0; not reduced.  |num|, den < 2^126. */
struct ratio {
  int128 num, den;
};

/* ratio_compare where some number has more than 64 bits. */
int ratio_compare_wide(struct ratio a, struct ratio b);

/* Whether a number has 64 bits.  Compared by its halves: from a comparison with
 * itself, cut to 64 bits, compilers conclude that they are the same, and
 * multiply 128 bits where 64 are enough. */
static inline bool ratio_fits(int128 a) {
  return (int64_t)(a >> 64) == (int64_t)a >> 63;
}

static inline bool ratio_is_narrow(struct ratio a) {
  return ratio_fits(a.num) && ratio_fits(a.den);
}

/* The sign of a - b.  Exact: products are formed in 256 bits where 128 are too
 * few. */
static inline int ratio_compare(struct ratio a, struct ratio b) {
  if (!ratio_is_narrow(a) || !ratio_is_narrow(b))
    return ratio_compare_wide(a, b);
  int128 left = (int128)(int64_t)a.num * (int64_t)b.den,
         right = (int128)(int64_t)b.num * (int64_t)a.den;
  return (left > right) - (left < right);
}

/* The nearest double (to within two units in the last place), for output and
 * for filters with an error bound. */
double ratio_to_double(struct ratio a);

/* p0 + t (p1 - p0) rounded to the nearest integer, halves up; depends only on
 * the ratio's value, not on how it is written.
 * t in [0, 1]; |p0|, |p1| < 2^42 */
int64_t ratio_lerp(struct ratio t, int64_t p0, int64_t p1);

static inline struct ratio ratio_of(int64_t num, int64_t den) {
  return (struct ratio){num, den};
}

#endif
