/* number_format.c - numbers to text, the same in every locale. */
#include "base/number.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

__extension__ typedef unsigned __int128 uint128;

enum { DIGITS_MAX = 20 }; /* of 64 bits, in decimal */

/* Writes the digits of `value`, at least `least`, and returns their end. */
static char *put_digits(char *text, uint64_t value, int least) {
  char reversed[DIGITS_MAX];
  int count = 0;
  for (; value || count < least; value /= 10)
    reversed[count++] = (char)('0' + value % 10);
  while (count > 0)
    *text++ = reversed[--count];
  return text;
}

/* fraction * scale, rounded half up, for 0 <= fraction < 1, scale <= 10^9.
 * Exact: the fraction is m 2^-e with m < 2^53, so m * scale < 2^83, and at
 * e > 84 the product is below a half. */
static uint64_t scale_fraction(double fraction, uint64_t scale) {
  int exponent;
  double significand = frexp(fraction, &exponent);
  uint64_t m = (uint64_t)ldexp(significand, 53);
  int shift = 53 - exponent;
  if (shift > 84)
    return 0;
  uint128 product = (uint128)m * scale;
  return (uint64_t)((product + ((uint128)1 << (shift - 1))) >> shift);
}

static const uint64_t powers_of_ten[10] = {
    1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000, 1000000000};

/* Writes whole + part / 10^decimals, for part < 10^decimals. */
static size_t put_fixed_point(char *text, bool negative, uint64_t whole,
                              uint64_t part, int decimals) {
  char *p = text;
  if (negative && (whole || part))
    *p++ = '-';
  p = put_digits(p, whole, 1);
  if (part) {
    *p++ = '.';
    for (; part % 10 == 0; part /= 10)
      decimals--;
    p = put_digits(p, part, decimals);
  }
  *p = '\0';
  return (size_t)(p - text);
}

size_t number_format(char text[NUMBER_TEXT_SIZE], double value, int decimals) {
  assert(isfinite(value) && fabs(value) < 1e9);
  assert(decimals >= 0 && decimals <= 9);
  double magnitude = fabs(value);
  uint64_t scale = powers_of_ten[decimals];
  uint64_t whole = (uint64_t)magnitude;
  uint64_t part = scale_fraction(magnitude - (double)whole, scale);
  if (part == scale) {
    whole++;
    part = 0;
  }
  return put_fixed_point(text, value < 0, whole, part, decimals);
}

/* The numbers from 00 to 99. */
static const char pairs_of_digits[] =
    "000102030405060708091011121314151617181920212223242526272829"
    "303132333435363738394041424344454647484950515253545556575859"
    "606162636465666768697071727374757677787980818283848586878889"
    "90919293949596979899";

static inline char *put_pair_before(char *end, uint32_t pair) {
  memcpy(end - 2, pairs_of_digits + 2 * pair, 2);
  return end - 2;
}

/* Writes the digits of `value` so that they end there, none of 0; returns where
 * they begin. */
static inline char *put_digits_before(char *end, uint64_t value) {
  for (; value > UINT32_MAX; value /= 100)
    end = put_pair_before(end, (uint32_t)(value % 100));
  uint32_t rest = (uint32_t)value;
  for (; rest >= 100; rest /= 100)
    end = put_pair_before(end, rest % 100);
  if (rest >= 10)
    return put_pair_before(end, rest);
  if (rest > 0)
    *--end = (char)('0' + rest);
  return end;
}

/* The digits before and after the point are one number's, which takes no
 * division by a power of ten that is not known to the compiler.  As many bytes
 * are always copied as there may be, which takes no call; what is too much is
 * written over, or left behind the end. */
size_t number_format_scaled(char text[NUMBER_TEXT_SIZE], int64_t value,
                            int decimals) {
  assert(decimals >= 0 && decimals <= 9);
  enum { WHOLE_MAX = 24, PART_MAX = 16 };
  char digits[DIGITS_MAX + WHOLE_MAX] = {0}, *end = digits + DIGITS_MAX;
  char *first =
      put_digits_before(end, value < 0 ? 0 - (uint64_t)value : (uint64_t)value);
  while (end - first <= decimals)
    *--first = '0';
  const char *point = end - decimals;
  while (end > point && end[-1] == '0')
    end--;
  char *p = text;
  *p = '-';
  p += value < 0;
  memcpy(p, first, WHOLE_MAX);
  p += point - first;
  if (point < end) {
    *p++ = '.';
    memcpy(p, point, PART_MAX);
    p += end - point;
  }
  *p = '\0';
  return (size_t)(p - text);
}

size_t number_format_int(char text[NUMBER_TEXT_SIZE], int64_t value) {
  char *p = text;
  if (value < 0)
    *p++ = '-';
  p = put_digits(p, value < 0 ? 0 - (uint64_t)value : (uint64_t)value, 1);
  *p = '\0';
  return (size_t)(p - text);
}

/* ---- Shortest ------------------------------------------------------------ */

/* digits * 10^exponent */
struct decimal {
  uint64_t digits;
  int exponent;
};

/* The `precision` digit decimal nearest to `value`.  Of what printf writes
 * only the digits are looked at: the point is the locale's. */
static struct decimal nearest_decimal(double value, int precision) {
  char text[64];
  snprintf(text, sizeof text, "%.*e", precision - 1, value);
  const char *exponent = strchr(text, 'e');
  struct decimal decimal = {0, 1 - precision};
  for (const char *p = text; p < exponent; p++)
    if (*p >= '0' && *p <= '9')
      decimal.digits = decimal.digits * 10 + (uint64_t)(*p - '0');
  int64_t scale = 0;
  number_parse_int(exponent + 1, exponent + strlen(exponent), &scale);
  decimal.exponent += (int)scale;
  return decimal;
}

static bool reads_back(struct decimal decimal, double value) {
  char text[NUMBER_TEXT_SIZE];
  char *p = put_digits(text, decimal.digits, 1);
  *p++ = 'e';
  p += number_format_int(p, decimal.exponent);
  double parsed;
  return number_parse_double(text, p, &parsed) == p && parsed == value;
}

/* A decimal of at most DBL_DIG digits survives the way to a double and back,
 * so among so few the nearest one, less its zeros, is the shortest.  That is
 * not promised for subnormal numbers, which are tried from one digit on; and
 * below a power of two doubles lie closer than above, so that of 16 digits a
 * neighbour of the nearest may be the one that reads back. */
static struct decimal shortest_decimal(double value) {
  int precision = value < DBL_MIN ? 1 : DBL_DIG;
  for (; precision < DBL_DECIMAL_DIG; precision++) {
    struct decimal decimal = nearest_decimal(value, precision);
    if (reads_back(decimal, value))
      return decimal;
    struct decimal above = {decimal.digits + 1, decimal.exponent};
    if (precision > DBL_DIG && reads_back(above, value))
      return above;
  }
  return nearest_decimal(value, DBL_DECIMAL_DIG);
}

static char *put_zeros(char *text, int count) {
  for (; count > 0; count--)
    *text++ = '0';
  return text;
}

/* With a plain point where 10^-6 < value < 10^17, else with an exponent. */
static char *put_decimal(char *p, struct decimal decimal) {
  while (decimal.digits % 10 == 0) {
    decimal.digits /= 10;
    decimal.exponent++;
  }
  char digits[DIGITS_MAX];
  int count = (int)(put_digits(digits, decimal.digits, 1) - digits);
  int point = count + decimal.exponent; /* how many digits stand before it */
  bool plain = point > -5 && point <= 17;
  int whole = plain ? point : 1;
  if (whole <= 0) {
    *p++ = '0';
    *p++ = '.';
    p = put_zeros(p, -whole);
    whole = 0;
  }
  for (int i = 0; i < count; i++) {
    if (i == whole && i > 0)
      *p++ = '.';
    *p++ = digits[i];
  }
  p = put_zeros(p, whole - count);
  if (!plain) {
    *p++ = 'e';
    p += number_format_int(p, point - 1);
  }
  return p;
}

size_t number_format_exact(char text[NUMBER_TEXT_SIZE], double value) {
  assert(isfinite(value));
  char *p = text;
  if (signbit(value))
    *p++ = '-';
  if (value == 0)
    *p++ = '0';
  else
    p = put_decimal(p, shortest_decimal(fabs(value)));
  *p = '\0';
  return (size_t)(p - text);
}
