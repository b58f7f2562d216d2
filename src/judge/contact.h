/* contact.h - the judge's contact tolerance of each triangle. */
#ifndef JUDGE_CONTACT_H
#define JUDGE_CONTACT_H

#include "judge/judge.h"

/* Sets the contact tolerance of every triangle: the options' length, or where
 * that is negative the sum of the rounding errors of its face's corners and of
 * a point that touches it, in the direction of its normal. */
void judge_contact_set(struct judge_triangles *all,
                       const struct judge_options *options);

#endif
