/* decimal.c - the nearest double to a decimal number, by long division.
 *
 * The number is a quotient of two integers: digits * 10^e is N / 1 for e >= 0
 * and N / 5^-e * 2^e below.  Scaled by powers of two until 1 <= N / D < 2, its
 * first 64 binary digits follow one by one; rounding also needs to know whether
 * a remainder is left.
 *
 * Robustness: a double, and the middle of two neighbouring ones, has at most
 * 767 significant decimal digits.  Of a longer number the digits past the
 * 800th cannot change which side of any such middle it lies on, only that it
 * is not on it: they are replaced by a single 1 where one of them is not 0.
 */
#include "base/decimal.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

enum {
  DIGITS_KEPT = 800,
  /* 801 digits are less than 2^2661.  The smallest exponent needed is
   * -330 - 801, and 5^1131 < 2^2627.  Aligned to each other both stay within
   * 2^2662, 84 limbs. */
  LIMB_COUNT = 88
};

/* A natural number, least limb first; limbs from `count` on are not there. */
struct natural {
  int count;
  uint32_t limb[LIMB_COUNT];
};

static void multiply_add(struct natural *n, uint32_t factor, uint32_t term) {
  uint64_t carry = term;
  for (int i = 0; i < n->count; i++) {
    carry += (uint64_t)n->limb[i] * factor;
    n->limb[i] = (uint32_t)carry;
    carry >>= 32;
  }
  if (carry)
    n->limb[n->count++] = (uint32_t)carry;
}

static void multiply_power_of_five(struct natural *n, int power) {
  for (; power >= 13; power -= 13)
    multiply_add(n, 1220703125, 0);
  for (; power > 0; power--)
    multiply_add(n, 5, 0);
}

static int bit_length(const struct natural *n) {
  int bits = 32 * n->count;
  if (n->count)
    for (uint32_t top = n->limb[n->count - 1]; !(top >> 31); top <<= 1)
      bits--;
  return bits;
}

static void shift_left(struct natural *n, int bits) {
  int limbs = bits / 32;
  multiply_add(n, UINT32_C(1) << bits % 32, 0);
  memmove(n->limb + limbs, n->limb, (size_t)n->count * sizeof *n->limb);
  memset(n->limb, 0, (size_t)limbs * sizeof *n->limb);
  n->count += limbs;
}

static int compare(const struct natural *a, const struct natural *b) {
  if (a->count != b->count)
    return a->count < b->count ? -1 : 1;
  for (int i = a->count; i-- > 0;)
    if (a->limb[i] != b->limb[i])
      return a->limb[i] < b->limb[i] ? -1 : 1;
  return 0;
}

/* a -= b, where a >= b. */
static void subtract_natural(struct natural *a, const struct natural *b) {
  uint64_t borrow = 0;
  for (int i = 0; i < a->count; i++) {
    uint64_t less = borrow + (i < b->count ? b->limb[i] : 0);
    borrow = a->limb[i] < less;
    a->limb[i] = (uint32_t)(a->limb[i] - less);
  }
  while (a->count && a->limb[a->count - 1] == 0)
    a->count--;
}

double decimal_round(uint64_t top, bool sticky, int exponent) {
  enum { EXPONENT_MAX = 1023, EXPONENT_MIN = -1022, DROPPED = 64 - 53 };
  int lead = exponent + 63; /* exponent of the highest bit */
  if (lead > EXPONENT_MAX)
    return INFINITY;
  int drop = DROPPED + (lead < EXPONENT_MIN ? EXPONENT_MIN - lead : 0);
  if (drop > 64)
    return 0;
  uint64_t kept = drop < 64 ? top >> drop : 0;
  uint64_t rest = drop < 64 ? top & ((UINT64_C(1) << drop) - 1) : top;
  uint64_t half = UINT64_C(1) << (drop - 1);
  if (rest > half || (rest == half && (sticky || (kept & 1))))
    kept++;
  /* The hidden bit of `kept` adds one to the exponent, and so does a carry
   * out of the significand: up to and including infinity. */
  uint64_t bits = kept;
  if (lead >= EXPONENT_MIN)
    bits += (uint64_t)(lead - EXPONENT_MIN) << 52;
  double value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

/* The digits as a number without leading zeros, cut as said above.  Returns
 * how many digits it has; *exponent grows by those left out. */
static int read_natural(struct natural *n, const char *text, const char *end,
                        int64_t *exponent) {
  int digits = 0;
  bool rest = false;
  n->count = 0;
  for (; text < end; text++) {
    if (*text < '0' || *text > '9' || (digits == 0 && *text == '0'))
      continue;
    if (digits < DIGITS_KEPT) {
      multiply_add(n, 10, (uint32_t)(*text - '0'));
      digits++;
    } else {
      rest = rest || *text != '0';
      ++*exponent;
    }
  }
  if (rest) {
    multiply_add(n, 10, 1);
    digits++;
    --*exponent;
  }
  return digits;
}

double decimal_to_double(const char *text, const char *end, int64_t exponent) {
  struct natural number, divisor = {1, {1}};
  int digits = read_natural(&number, text, end, &exponent);
  /* 10^(digits + exponent - 1) <= value < 10^(digits + exponent) */
  if (digits == 0 || digits + exponent < -330)
    return 0;
  if (digits + exponent > 310)
    return INFINITY;
  int power = (int)exponent;
  if (power >= 0)
    multiply_power_of_five(&number, power);
  else
    multiply_power_of_five(&divisor, -power);

  int shift = bit_length(&number) - bit_length(&divisor);
  if (shift > 0)
    shift_left(&divisor, shift);
  else
    shift_left(&number, -shift);
  if (compare(&number, &divisor) < 0) {
    shift_left(&number, 1);
    shift--;
  }
  uint64_t quotient = 0;
  for (int bit = 0; bit < 64; bit++) {
    quotient <<= 1;
    if (compare(&number, &divisor) >= 0) {
      subtract_natural(&number, &divisor);
      quotient |= 1;
    }
    shift_left(&number, 1);
  }
  return decimal_round(quotient, number.count > 0, shift - 63 + power);
}
