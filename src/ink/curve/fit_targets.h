/* fit_targets.h - the smooth line about which a stroke zigzags. */
#ifndef INK_CURVE_FIT_TARGETS_H
#define INK_CURVE_FIT_TARGETS_H

#include "base/memory.h"
#include "ink/curve/cubic_fit.h"

/* Memory for the samples of a part. */
struct fit_targets {
  ARRAY(struct drawing_point) line, integral, mean, twice;
  ARRAY(double) limit;
};

/* Sets the targets of samples: the first and the last stay where they are, and
 * each other one is off by at most half of what is allowed there, and up to the
 * next sample at which a curve may end: so from each such sample's target the
 * straight line to the next one is within what is allowed, too.
 * knot       one a sample: not 0 where a curve may end
 * tolerance  mm: the most that is allowed
 * Returns false when memory ran out.
 * Source     [Tukey1977], twicing */
USE_RESULT bool fit_targets_set(struct fit_targets *targets,
                                struct fit_sample *sample, size_t samples,
                                const uint8_t *knot, double tolerance);
/* How far from a sample, mm, whatever stands for it may be. */
double fit_targets_limit(const struct fit_targets *targets, size_t sample);
void fit_targets_fini(struct fit_targets *targets);

#endif
