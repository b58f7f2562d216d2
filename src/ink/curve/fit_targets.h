/* fit_targets.h - the smooth line about which a stroke zigzags. */
#ifndef INK_CURVE_FIT_TARGETS_H
#define INK_CURVE_FIT_TARGETS_H

#include "base/memory.h"
#include "ink/curve/cubic_fit.h"

/* The share of the allowed distance by which a target may be off; the rest is
 * that of the curve from the targets. */
#define FIT_TARGET_SHARE 0.5

/* Memory for the samples of a part. */
struct fit_targets {
  ARRAY(struct drawing_point) line, integral, mean, twice;
};

/* Sets the targets of samples, but of the first and the last, whose targets
 * stay.
 * limit      one a sample, mm: how far from it its target may be
 * tolerance  mm: the most that is allowed
 * Returns false when memory ran out.
 * Source     [Tukey1977], twicing */
USE_RESULT bool fit_targets_set(struct fit_targets *targets,
                                struct fit_sample *sample, size_t samples,
                                const double *limit, double tolerance);
void fit_targets_fini(struct fit_targets *targets);

#endif
