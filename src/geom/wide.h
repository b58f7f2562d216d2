/* wide.h - integers of up to 640 bits in fixed memory, for the rare wide path.
 *
 * Nothing is allocated, so nothing can fail.  The widest value there is comes
 * from two crossings of plane intersections (line.h): with |a|, |b| < 2^137 and
 * |c| < 2^170, a crossing has |x|, |y| < 2^308 and |w| < 2^275, and
 * x1 w2 - x2 w1 < 2^584.  A corner times 2^(bits + 1), bits <= 64, is below
 * 2^374. */
#ifndef GEOM_WIDE_H
#define GEOM_WIDE_H

#include <stdbool.h>
#include <stdint.h>

#include "geom/int128.h"

enum { WIDE_LIMBS = 10 };

/* sign times the sum of limb[i] 2^(64 i); the last limb is not 0. */
struct wide {
  int sign;  /* -1, 0, +1 */
  int count; /* of limbs; 0 for 0 */
  uint64_t limb[WIDE_LIMBS];
};

struct wide wide_of_int128(int128 value);

/* From `count` limbs, the least first; the last may be 0. */
struct wide wide_of_limbs(const uint64_t *limb, int count, int sign);

void wide_negate(struct wide *a);
/* *to is none of the others. */
void wide_multiply(struct wide *to, const struct wide *a, const struct wide *b);
void wide_add(struct wide *to, const struct wide *a, const struct wide *b);
/* to = p q - r s */
void wide_cross(struct wide *to, const struct wide *p, const struct wide *q,
                const struct wide *r, const struct wide *s);

/* The double next to it on the side of 0, or itself: what does not fit into 53
 * bits is cut off. */
double wide_to_double(const struct wide *a);

/* floor(2^bits num / den + 1/2); den > 0, 0 <= bits <= 64.  The result fits
 * into 64 bits. */
int64_t wide_round_quotient(const struct wide *num, const struct wide *den,
                            int bits);

/* Divides all three by their greatest common divisor.
 * Returns false where one of them is then too large for 64 bits, with a sign.
 * They are not all 0, and |v[k]| < 2^192. */
bool wide_reduce(const struct wide v[3], int64_t reduced[3]);

#endif
