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

/* Zero where a number has 64 bits: the upper half is the lower one's sign then.
 * From a comparison with the number cut to 64 bits compilers conclude that both
 * are the same, and multiply 128 bits where 64 are enough. */
static inline int64_t ratio_excess(int128 a) {
  return (int64_t)(a >> 64) ^ (int64_t)a >> 63;
}

static inline bool ratio_is_narrow(struct ratio a) {
  return (ratio_excess(a.num) | ratio_excess(a.den)) == 0;
}

/* The sign of a - b.  Exact: products are formed in 256 bits where 128 are too
 * few. */
static inline int ratio_compare(struct ratio a, struct ratio b) {
  if ((ratio_excess(a.num) | ratio_excess(a.den) | ratio_excess(b.num) |
       ratio_excess(b.den)) != 0)
    return ratio_compare_wide(a, b);
  int128 more = (int128)(int64_t)a.num * (int64_t)b.den -
                (int128)(int64_t)b.num * (int64_t)a.den;
  return (more > 0) - (more < 0);
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
