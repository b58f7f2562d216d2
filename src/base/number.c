/* number.c - numbers from text, correctly rounded, the same in every locale.
 *
 * Phases
 *   1. The digits are gathered into one 64-bit integer w, eight at a time,
 *      the point only counted: the number is w * 10^e.
 *   2. w < 2^53 and |e| <= 22: both w and 10^|e| are doubles, so one division
 *      or product rounds once [Clinger].
 *   3. |e| <= 27: 5^|e| fits in 64 bits, and the product, or the quotient
 *      with its remainder, is exact in 128 bits.  Nearly always an estimate
 *      of the quotient is enough (number_scale_down).
 *   4. The rest goes to decimal.c.
 * Sources
 *   [Clinger] How to read floating point numbers accurately, 1990.
 *   [Lemire] Lemire: Number parsing at a gigabyte per second, 2021.
 *   [Moller] Moller, Granlund: Improved division by invariant integers, 2011.
 */
#include "base/number.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/decimal.h"
#include "base/digits.h"

enum {
  DIGITS_SAFE = 19, /* so many digits always fit in 64 bits */
  POWER_OF_TEN_MAX = 22,
  POWER_OF_FIVE_MAX = 27
};

static const double power_of_ten[POWER_OF_TEN_MAX + 1] = {
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

#if DIGITS_CHUNKS
const uint64_t number_power_of_ten[9] = {
    1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};
#endif

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

/* 5^k, shifted to have its top bit set, and its reciprocal [Moller]:
 * floor((2^128 - 1) / shifted) - 2^64. */
struct power_of_five {
  uint64_t shifted, reciprocal;
  int shift;
};

static const struct power_of_five power_of_five[POWER_OF_FIVE_MAX + 1] = {
    {UINT64_C(0x8000000000000000), UINT64_C(0xffffffffffffffff), 63},
    {UINT64_C(0xa000000000000000), UINT64_C(0x9999999999999999), 61},
    {UINT64_C(0xc800000000000000), UINT64_C(0x47ae147ae147ae14), 59},
    {UINT64_C(0xfa00000000000000), UINT64_C(0x0624dd2f1a9fbe76), 57},
    {UINT64_C(0x9c40000000000000), UINT64_C(0xa36e2eb1c432ca57), 54},
    {UINT64_C(0xc350000000000000), UINT64_C(0x4f8b588e368f0846), 52},
    {UINT64_C(0xf424000000000000), UINT64_C(0x0c6f7a0b5ed8d36b), 50},
    {UINT64_C(0x9896800000000000), UINT64_C(0xad7f29abcaf48578), 47},
    {UINT64_C(0xbebc200000000000), UINT64_C(0x5798ee2308c39df9), 45},
    {UINT64_C(0xee6b280000000000), UINT64_C(0x12e0be826d694b2e), 43},
    {UINT64_C(0x9502f90000000000), UINT64_C(0xb7cdfd9d7bdbab7d), 40},
    {UINT64_C(0xba43b74000000000), UINT64_C(0x5fd7fe17964955fd), 38},
    {UINT64_C(0xe8d4a51000000000), UINT64_C(0x19799812dea11197), 36},
    {UINT64_C(0x9184e72a00000000), UINT64_C(0xc25c268497681c26), 33},
    {UINT64_C(0xb5e620f480000000), UINT64_C(0x6849b86a12b9b01e), 31},
    {UINT64_C(0xe35fa931a0000000), UINT64_C(0x203af9ee756159b2), 29},
    {UINT64_C(0x8e1bc9bf04000000), UINT64_C(0xcd2b297d889bc2b6), 26},
    {UINT64_C(0xb1a2bc2ec5000000), UINT64_C(0x70ef54646d496892), 24},
    {UINT64_C(0xde0b6b3a76400000), UINT64_C(0x2725dd1d243aba0e), 22},
    {UINT64_C(0x8ac7230489e80000), UINT64_C(0xd83c94fb6d2ac34a), 19},
    {UINT64_C(0xad78ebc5ac620000), UINT64_C(0x79ca10c9242235d5), 17},
    {UINT64_C(0xd8d726b7177a8000), UINT64_C(0x2e3b40a0e9b4f7dd), 15},
    {UINT64_C(0x878678326eac9000), UINT64_C(0xe392010175ee5962), 12},
    {UINT64_C(0xa968163f0a57b400), UINT64_C(0x82db34012b25144e), 10},
    {UINT64_C(0xd3c21bcecceda100), UINT64_C(0x357c299a88ea76a5), 8},
    {UINT64_C(0x84595161401484a0), UINT64_C(0xef2d0f5da7dd8aa2), 5},
    {UINT64_C(0xa56fa5b99019a5c8), UINT64_C(0x8c240c4aecb13bb5), 3},
    {UINT64_C(0xcecb8f27f4200f3a), UINT64_C(0x3ce9a36f23c0fc90), 1},
};

/* The quotient of high * 2^64 + low and a divisor that is more than `high`, by
 * its reciprocal, and whether a remainder is left [Moller, algorithm 4]. */
static inline uint64_t divide_by_power(uint64_t high, uint64_t low,
                                       const struct power_of_five *divisor,
                                       bool *rest) {
  uint64_t d = divisor->shifted;
  number_uint128 estimate = (number_uint128)divisor->reciprocal * high +
                            ((number_uint128)high << 64 | low);
  uint64_t quotient = (uint64_t)(estimate >> 64) + 1;
  uint64_t remainder = low - quotient * d;
  if (remainder > (uint64_t)estimate) {
    quotient--;
    remainder += d;
  }
  if (remainder >= d) {
    quotient++;
    remainder -= d;
  }
  *rest = remainder != 0;
  return quotient;
}

/* The product of w, its top bit shifted to the 64th, and `scaled` is that of w
 * and 2^(63 + b), where 2^b is the next power of two from 5^digits on.  The
 * exponents are 1023 + 52 + 11 - b - digits, without the shifts, for a
 * significand whose hidden bit adds one. */
const struct number_reciprocal number_reciprocal[POWER_OF_FIVE_MAX + 1] = {
    {UINT64_C(0x8000000000000000), 1086}, {UINT64_C(0xcccccccccccccccc), 1082},
    {UINT64_C(0xa3d70a3d70a3d70a), 1079}, {UINT64_C(0x83126e978d4fdf3b), 1076},
    {UINT64_C(0xd1b71758e219652b), 1072}, {UINT64_C(0xa7c5ac471b478423), 1069},
    {UINT64_C(0x8637bd05af6c69b5), 1066}, {UINT64_C(0xd6bf94d5e57a42bc), 1062},
    {UINT64_C(0xabcc77118461cefc), 1059}, {UINT64_C(0x89705f4136b4a597), 1056},
    {UINT64_C(0xdbe6fecebdedd5be), 1052}, {UINT64_C(0xafebff0bcb24aafe), 1049},
    {UINT64_C(0x8cbccc096f5088cb), 1046}, {UINT64_C(0xe12e13424bb40e13), 1042},
    {UINT64_C(0xb424dc35095cd80f), 1039}, {UINT64_C(0x901d7cf73ab0acd9), 1036},
    {UINT64_C(0xe69594bec44de15b), 1032}, {UINT64_C(0xb877aa3236a4b449), 1029},
    {UINT64_C(0x9392ee8e921d5d07), 1026}, {UINT64_C(0xec1e4a7db69561a5), 1022},
    {UINT64_C(0xbce5086492111aea), 1019}, {UINT64_C(0x971da05074da7bee), 1016},
    {UINT64_C(0xf1c90080baf72cb1), 1012}, {UINT64_C(0xc16d9a0095928a27), 1009},
    {UINT64_C(0x9abe14cd44753b52), 1006}, {UINT64_C(0xf79687aed3eec551), 1002},
    {UINT64_C(0xc612062576589dda), 999},  {UINT64_C(0x9e74d1b791e07e48), 996},
};

/* The quotient below has 63 or 64 bits, as both numbers have their top bits set
 * and the dividend half a bit less.  A bit that it lacks at its end is made up
 * for by the remainder: rounding looks at 54 bits and whether anything
 * follows. */
double number_divide(uint64_t w, int digits) {
  const struct power_of_five *five = &power_of_five[digits];
  bool rest;
  int shift = leading_zeros(w);
  w <<= shift;
  uint64_t quotient = divide_by_power(w >> 1, w << 63, five, &rest);
  int up = leading_zeros(quotient);
  return decimal_round(quotient << up, rest,
                       five->shift - shift - 63 - digits - up);
}

/* w * 10^e for w > 0, |e| <= POWER_OF_FIVE_MAX: rounds once. */
static double scale_exactly(uint64_t w, int e) {
  if (e < 0)
    return number_scale_down(w, -e);
  const struct power_of_five *five = &power_of_five[e];
  number_uint128 product = (number_uint128)w * (five->shifted >> five->shift);
  uint64_t high = (uint64_t)(product >> 64), low = (uint64_t)product;
  if (high == 0)
    return decimal_round(low << leading_zeros(low), false,
                         e - leading_zeros(low));
  int up = leading_zeros(high);
  product <<= up;
  return decimal_round((uint64_t)(product >> 64), (uint64_t)product != 0,
                       e + 64 - up);
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
