/* number.c - numbers from text, correctly rounded, the same in every locale.
 *
 * Phases
 *   1. The digits are gathered into one 64-bit integer w, eight at a time,
 *      the point only counted: the number is w * 10^e.
 *   2. w < 2^53 and |e| <= 22: both w and 10^|e| are doubles, so one division
 *      or product rounds once [Clinger].
 *   3. |e| <= 27: 5^|e| fits in 64 bits, and the product, or the quotient
 *      with its remainder, is exact in 128 bits.
 *   4. The rest goes to decimal.c.
 * Source: [Clinger] How to read floating point numbers accurately, 1990.
 */
#include "base/number.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/decimal.h"
#include "base/digits.h"

__extension__ typedef unsigned __int128 uint128;

enum {
  DIGITS_SAFE = 19, /* so many digits always fit in 64 bits */
  POWER_OF_TEN_MAX = 22,
  POWER_OF_FIVE_MAX = 27
};

static const double power_of_ten[POWER_OF_TEN_MAX + 1] = {
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

#if DIGITS_CHUNKS
const double number_power_of_ten[16] = {1e0,  1e1,  1e2,  1e3, 1e4,  1e5,
                                        1e6,  1e7,  1e8,  1e9, 1e10, 1e11,
                                        1e12, 1e13, 1e14, 1e15};
#endif

static uint64_t power_of_five(int power) {
  uint64_t result = 1;
  for (; power >= 5; power -= 5)
    result *= 3125;
  for (; power > 0; power--)
    result *= 5;
  return result;
}

/* How many zero bits stand above the highest one of x > 0. */
static int leading_zeros(uint64_t x) { return __builtin_clzll(x); }

/* Reads e[+-]digits at `text`, where it stands, and returns its end; a huge
 * exponent is capped where no amount of digits makes up for it. */
static const char *parse_exponent(const char *text, const char *end,
                                  int64_t *exponent) {
  static const int64_t cap = INT64_C(1000000000000000);
  const char *p = text + 1;
  bool negative = p < end && *p == '-';
  if (p < end && (*p == '-' || *p == '+'))
    p++;
  if (p == end || !digits_is_one(*p))
    return text;
  int64_t sum = 0;
  for (; p < end && digits_is_one(*p); p++)
    if (sum < cap)
      sum = sum * 10 + (*p - '0');
  *exponent += negative ? -sum : sum;
  return p;
}

/* ---- Rounding ------------------------------------------------------------ */

/* w * 10^e for w > 0, |e| <= POWER_OF_FIVE_MAX: rounds once. */
static double scale_exactly(uint64_t w, int e) {
  int shift = leading_zeros(w);
  if (e >= 0) {
    uint128 product = (uint128)w * power_of_five(e);
    uint64_t high = (uint64_t)(product >> 64), low = (uint64_t)product;
    if (high == 0)
      return decimal_round(low << leading_zeros(low), false,
                           e - leading_zeros(low));
    int up = leading_zeros(high);
    product <<= up;
    return decimal_round((uint64_t)(product >> 64), (uint64_t)product != 0,
                         e + 64 - up);
  }
  /* Both are shifted to have their top bits set, and w half a bit less, so
   * that the quotient has 63 or 64 bits.  A bit that it lacks at its end is
   * made up for by the remainder: rounding looks at 54 bits and whether
   * anything follows. */
  uint64_t five = power_of_five(-e);
  int five_shift = leading_zeros(five);
  uint64_t divisor = five << five_shift;
  uint128 dividend = (uint128)(w << shift) << 63;
  uint64_t quotient = (uint64_t)(dividend / divisor);
  bool rest = dividend != (uint128)quotient * divisor;
  int up = leading_zeros(quotient);
  return decimal_round(quotient << up, rest, five_shift - shift - 63 + e - up);
}

/* ---- Parsing ------------------------------------------------------------- */

/* Whether the letters of `word` stand at `text`, in any case. */
static bool starts_with(const char *text, const char *end, const char *word) {
  for (; *word; word++, text++)
    if (text >= end || (*text | 0x20) != *word)
      return false;
  return true;
}

static const char *parse_special(const char *text, const char *end,
                                 double *value) {
  if (starts_with(text, end, "inf")) {
    *value = INFINITY;
    return text + (starts_with(text, end, "infinity") ? 8 : 3);
  }
  if (starts_with(text, end, "nan")) {
    *value = NAN;
    return text + 3;
  }
  return NULL;
}

/* How many digits of [text, end) follow the leading zeros. */
static ptrdiff_t count_significant(const char *text, const char *end) {
  ptrdiff_t count = 0;
  for (; text < end; text++)
    if (digits_is_one(*text) && (count > 0 || *text != '0'))
      count++;
  return count;
}

/* The double nearest to the digits in [first, last), whose last 64 bits are w,
 * times 10^exponent. */
static double scale_digits(const char *first, const char *last, uint64_t w,
                           int64_t exponent) {
  bool fits = last - first <= DIGITS_SAFE ||
              count_significant(first, last) <= DIGITS_SAFE;
  if (fits && w == 0)
    return 0;
  if (fits && FLT_EVAL_METHOD == 0 && w <= UINT64_C(1) << 53 &&
      exponent >= -POWER_OF_TEN_MAX && exponent <= POWER_OF_TEN_MAX)
    return exponent < 0 ? (double)w / power_of_ten[-exponent]
                        : (double)w * power_of_ten[exponent];
  if (fits && exponent >= -POWER_OF_FIVE_MAX && exponent <= POWER_OF_FIVE_MAX)
    return scale_exactly(w, (int)exponent);
  return decimal_to_double(first, last, exponent);
}

const char *number_parse_double(const char *text, const char *end,
                                double *value) {
  const char *p = text;
  bool negative = p < end && *p == '-';
  if (p < end && (*p == '-' || *p == '+'))
    p++;
  const char *first = p;
  uint64_t w = 0;
  int64_t exponent = 0;
  p = digits_gather_singly(p, end, &w);
  ptrdiff_t digits = p - first;
  if (p < end && *p == '.') {
    const char *fraction = p + 1;
    p = digits_gather(fraction, end, &w);
    exponent = fraction - p;
    digits += p - fraction;
  }
  double magnitude;
  if (digits == 0) {
    p = parse_special(first, end, &magnitude);
    if (p != NULL)
      *value = negative ? -magnitude : magnitude;
    return p;
  }
  const char *last = p;
  if (p < end && (*p | 0x20) == 'e')
    p = parse_exponent(p, end, &exponent);
  magnitude = scale_digits(first, last, w, exponent);
  *value = negative ? -magnitude : magnitude;
  return p;
}

const char *number_parse_int(const char *text, const char *end,
                             int64_t *value) {
  const char *p = text;
  bool negative = p < end && *p == '-';
  if (p < end && (*p == '-' || *p == '+'))
    p++;
  if (p == end || !digits_is_one(*p))
    return NULL;
  /* Summed below zero, where there is room for INT64_MIN. */
  int64_t sum = 0;
  for (; p < end && digits_is_one(*p); p++)
    if (__builtin_mul_overflow(sum, 10, &sum) ||
        __builtin_sub_overflow(sum, *p - '0', &sum))
      return NULL;
  if (!negative && __builtin_sub_overflow(0, sum, &sum))
    return NULL;
  *value = sum;
  return p;
}
