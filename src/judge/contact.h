/* contact.h - how far apart the judge lets a face and what touches it be. */
#ifndef JUDGE_CONTACT_H
#define JUDGE_CONTACT_H

#include "judge/judge.h"

/* Sets the contact of every triangle: the options' length, or where that is
 * negative what rounding of its face's corners and of a point that touches it
 * explains in the direction of its normal. */
void judge_contact_set(struct judge_triangles *all,
                       const struct judge_options *options);

#endif
