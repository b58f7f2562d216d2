/* contact.h - the judge's contact tolerance of each triangle. */
#ifndef JUDGE_CONTACT_H
#define JUDGE_CONTACT_H

#include "judge/options.h"
#include "judge/triangles.h"

/* Sets the contact tolerance of every triangle: the options' length, or where
 * that is negative the sum of the rounding errors of its face's corners and of
 * a point that touches it, in the direction of its normal; planar is that
 * length, or that of the sum as a vector.
 * Returns false when memory ran out. */
USE_RESULT bool judge_contact_set(struct judge_triangles *all,
                                  const struct judge_options *options);

#endif
