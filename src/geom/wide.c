/* wide.c - integers of up to 640 bits in fixed memory, for the rare wide path.
 *
 * Sign and magnitude, by the methods that are taught for numbers on paper: of
 * ten limbs none other is faster.  Quotients are small, so that doubles find
 * them. */
#include "geom/wide.h"

#include <math.h>

/* ---- To and from --------------------------------------------------------- */

static void trim(struct wide *a) {
  while (a->count > 0 && a->limb[a->count - 1] == 0)
    a->count--;
  if (a->count == 0)
    a->sign = 0;
}

struct wide wide_of_int128(int128 value) {
  uint128 size = value < 0 ? -(uint128)value : (uint128)value;
  struct wide a;
  a.sign = (value > 0) - (value < 0);
  a.limb[0] = (uint64_t)size;
  a.limb[1] = (uint64_t)(size >> 64);
  a.count = a.limb[1] != 0 ? 2 : a.limb[0] != 0;
  return a;
}

struct wide wide_of_limbs(const uint64_t *limb, int count, int sign) {
  struct wide a;
  a.sign = sign;
  a.count = count;
  for (int i = 0; i < count; i++)
    a.limb[i] = limb[i];
  trim(&a);
  return a;
}

static int bits_of_limb(uint64_t a) { return 64 - __builtin_clzll(a); }

static int wide_bits(const struct wide *a) {
  return a->count == 0
             ? 0
             : 64 * (a->count - 1) + bits_of_limb(a->limb[a->count - 1]);
}

double wide_to_double(const struct wide *a) {
  enum { DIGITS = 53 };
  int bits = wide_bits(a), below = bits - DIGITS;
  uint64_t top;
  if (bits == 0)
    return 0;
  if (below <= 0)
    return (double)a->limb[0] * a->sign;
  top = a->limb[below / 64] >> below % 64;
  if (below % 64 > 64 - DIGITS)
    top |= a->limb[below / 64 + 1] << (64 - below % 64);
  return a->sign * ldexp((double)top, below);
}

/* ---- Sums ---------------------------------------------------------------- */

static int compare_sizes(const struct wide *a, const struct wide *b) {
  if (a->count != b->count)
    return a->count < b->count ? -1 : 1;
  for (int i = a->count - 1; i >= 0; i--)
    if (a->limb[i] != b->limb[i])
      return a->limb[i] < b->limb[i] ? -1 : 1;
  return 0;
}

/* to = |a| + |b|, |a| of at least as many limbs */
static void add_sizes(struct wide *to, const struct wide *a,
                      const struct wide *b) {
  uint128 sum = 0;
  for (int i = 0; i < a->count; i++) {
    sum += (uint128)a->limb[i] + (i < b->count ? b->limb[i] : 0);
    to->limb[i] = (uint64_t)sum;
    sum >>= 64;
  }
  to->count = a->count;
  if (sum != 0)
    to->limb[to->count++] = (uint64_t)sum;
}

/* to = |a| - |b|, |a| >= |b|; to may be one of them */
static void subtract_sizes(struct wide *to, const struct wide *a,
                           const struct wide *b) {
  uint64_t borrow = 0;
  for (int i = 0; i < a->count; i++) {
    uint128 left =
        (uint128)a->limb[i] - (i < b->count ? b->limb[i] : 0) - borrow;
    to->limb[i] = (uint64_t)left;
    borrow = (uint64_t)(left >> 64) & 1;
  }
  to->count = a->count;
}

void wide_negate(struct wide *a) { a->sign = -a->sign; }

/* to = a + b, b taken with that sign */
static void add_signed(struct wide *to, const struct wide *a,
                       const struct wide *b, int sign) {
  if (sign == 0 || a->sign == 0) {
    *to = sign == 0 ? *a : *b;
    if (sign != 0)
      to->sign = sign;
  } else if (a->sign == sign) {
    bool first = a->count >= b->count;
    add_sizes(to, first ? a : b, first ? b : a);
    to->sign = sign;
  } else {
    int order = compare_sizes(a, b);
    subtract_sizes(to, order < 0 ? b : a, order < 0 ? a : b);
    to->sign = order < 0 ? sign : a->sign;
    trim(to);
  }
}

void wide_add(struct wide *to, const struct wide *a, const struct wide *b) {
  add_signed(to, a, b, b->sign);
}

/* ---- Products ------------------------------------------------------------ */

void wide_multiply(struct wide *to, const struct wide *a,
                   const struct wide *b) {
  to->sign = a->sign * b->sign;
  to->count = 0;
  if (to->sign == 0)
    return;
  to->count = a->count + b->count;
  for (int i = 0; i < to->count; i++)
    to->limb[i] = 0;
  for (int i = 0; i < a->count; i++) {
    uint64_t carry = 0;
    for (int k = 0; k < b->count; k++) {
      uint128 sum = (uint128)a->limb[i] * b->limb[k] + to->limb[i + k] + carry;
      to->limb[i + k] = (uint64_t)sum;
      carry = (uint64_t)(sum >> 64);
    }
    to->limb[i + b->count] = carry;
  }
  if (to->limb[to->count - 1] == 0)
    to->count--;
}

void wide_cross(struct wide *to, const struct wide *p, const struct wide *q,
                const struct wide *r, const struct wide *s) {
  struct wide left, right;
  wide_multiply(&left, p, q);
  wide_multiply(&right, r, s);
  add_signed(to, &left, &right, -right.sign);
}

/* ---- Quotients ----------------------------------------------------------- */

/* a = 2^bits a */
static void shift_up(struct wide *a, int bits) {
  int limbs = bits / 64, rest = bits % 64;
  if (a->sign == 0 || bits == 0)
    return;
  a->limb[a->count] = 0;
  for (int i = a->count; i >= 0; i--) {
    uint64_t below = rest > 0 && i > 0 ? a->limb[i - 1] >> (64 - rest) : 0;
    a->limb[i + limbs] = a->limb[i] << rest | below;
  }
  for (int i = 0; i < limbs; i++)
    a->limb[i] = 0;
  a->count += limbs + 1;
  trim(a);
}

/* |a| -= q |b|, which is no more */
static void subtract_times(struct wide *a, const struct wide *b, uint64_t q) {
  uint64_t carry = 0, borrow = 0;
  for (int i = 0; i < a->count; i++) {
    uint128 part = (uint128)q * (i < b->count ? b->limb[i] : 0) + carry;
    uint128 left = (uint128)a->limb[i] - (uint64_t)part - borrow;
    carry = (uint64_t)(part >> 64);
    a->limb[i] = (uint64_t)left;
    borrow = (uint64_t)(left >> 64) & 1;
  }
  trim(a);
}

/* floor(|a| / |b|), which fits into 64 bits; a becomes the rest, positive.
 * The doubles' quotient is off by less than 2^-50 of itself: taken so much too
 * small it leaves a rest of 2^14 times b at most, and then of b. */
static uint64_t divide_sizes(struct wide *a, const struct wide *b) {
  double by = fabs(wide_to_double(b));
  uint64_t quotient = 0;
  a->sign = a->sign != 0;
  while (compare_sizes(a, b) >= 0) {
    double about = wide_to_double(a) / by * (1 - 0x1p-50);
    uint64_t q = about < 0x1p64 ? (uint64_t)about : UINT64_MAX;
    if (q == 0)
      q = 1;
    subtract_times(a, b, q);
    quotient += q;
  }
  return quotient;
}

int64_t wide_round_quotient(const struct wide *num, const struct wide *den,
                            int bits) {
  struct wide shifted = *num, twice = *den, sum;
  uint64_t quotient;
  shift_up(&shifted, bits + 1);
  shift_up(&twice, 1);
  wide_add(&sum, &shifted, den);
  if (sum.sign >= 0)
    return (int64_t)divide_sizes(&sum, &twice);
  quotient = divide_sizes(&sum, &twice);
  if (sum.sign != 0)
    quotient++;
  return (int64_t)-quotient;
}

/* ---- Common divisors ----------------------------------------------------- */

static int low_zeros(const struct wide *a) {
  int i = 0;
  while (a->limb[i] == 0)
    i++;
  return 64 * i + __builtin_ctzll(a->limb[i]);
}

static void shift_down(struct wide *a, int bits) {
  int limbs = bits / 64, rest = bits % 64;
  for (int i = limbs; i < a->count; i++) {
    uint64_t above =
        rest > 0 && i + 1 < a->count ? a->limb[i + 1] << (64 - rest) : 0;
    a->limb[i - limbs] = a->limb[i] >> rest | above;
  }
  a->count -= limbs;
  trim(a);
}

/* a = the greatest common divisor of |a| and |b|, by Stein's method; b is
 * lost. */
static void divide_common(struct wide *a, struct wide *b) {
  int twos, of_a, of_b;
  if (b->sign == 0)
    return;
  if (a->sign == 0) {
    *a = *b;
    return;
  }
  of_a = low_zeros(a);
  of_b = low_zeros(b);
  twos = of_a < of_b ? of_a : of_b;
  shift_down(a, of_a);
  shift_down(b, of_b);
  for (;;) {
    int order = compare_sizes(a, b);
    if (order == 0)
      break;
    if (order < 0) {
      subtract_sizes(b, b, a);
      trim(b);
      shift_down(b, low_zeros(b));
    } else {
      subtract_sizes(a, a, b);
      trim(a);
      shift_down(a, low_zeros(a));
    }
  }
  shift_up(a, twos);
}

/* Whether all are below 2^64 once they are divided: no more is certain. */
static bool may_fit(const struct wide v[3], const struct wide *divisor) {
  for (int k = 0; k < 3; k++)
    if (wide_bits(&v[k]) - wide_bits(divisor) >= 64)
      return false;
  return true;
}

bool wide_reduce(const struct wide v[3], int64_t reduced[3]) {
  struct wide divisor = v[0], other = v[1];
  divide_common(&divisor, &other);
  if (divisor.sign != 0 && !may_fit(v, &divisor))
    return false;
  other = v[2];
  divide_common(&divisor, &other);
  if (!may_fit(v, &divisor))
    return false;
  for (int k = 0; k < 3; k++) {
    const uint64_t most = (uint64_t)INT64_MAX + (v[k].sign < 0);
    struct wide rest = v[k];
    uint64_t size = divide_sizes(&rest, &divisor);
    if (size > most)
      return false;
    reduced[k] = v[k].sign < 0 ? (int64_t)(0 - size) : (int64_t)size;
  }
  return true;
}
