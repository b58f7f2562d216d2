/* precision.c - how far rounding may have moved the coordinates of a scene.
 *
 * A binary format says how it rounds.  In a text file the literals show it:
 *   integers   A literal without a point or an exponent, and zero in any form,
 *              say nothing; a file of these alone is exact.
 *   short      A literal of fewer than five digits, such as 0.5 or 12.25 (the
 *              zero before the point is not counted), was written by hand or
 *              by a program that meant just this: no program rounds to so few
 *              digits, and half a place of it would be a visible distance.
 *              Where nine in ten of the literals are short the file is exact.
 *   long       Of the others, let S be the most significant digits that at
 *              least one in ten of them has, and F the finest decimal place at
 *              which at least one in ten of them ends; one in ten, because one
 *              odd literal says nothing of the rest.
 *   places     Where as many end at F as have S digits, the places are fixed,
 *              as those of %.6f: rounding moved a number by half of 10^F.
 *   digits     Otherwise the digits are fixed and the places vary, as those of
 *              %g and %e: rounding moved a number by half a unit in its S-th
 *              digit, which is at most 10^(1 - S) / 2 of it.  So -4.371139e-08
 *              among numbers of seven digits does not make 10^-14 the finest
 *              place.
 *   singles    Where each literal is within half of its last place of a number
 *              of single precision, the file was written from such numbers, so
 *              their own rounding counts too: a model that was moved far away
 *              in single precision is off by more than its literals show.
 *              500000.123 is not one of them.
 */
#include "scene/precision.h"

#include <float.h>

#include "base/digits.h"

enum {
  LONG_DIGITS = 5,
  DIGITS_SAFE = 19, /* so many always fit in 64 bits */
  ONE_IN = 10,      /* a share too small to speak for the file */
  POWER_MAX = 400
};

struct precision precision_of_bits(int bits) {
  if (bits >= DBL_MANT_DIG)
    return (struct precision){0, 0};
  return (struct precision){0, ldexp(1, -(bits > 0 ? bits : FLT_MANT_DIG))};
}

/* ---- Looking at literals ------------------------------------------------- */

struct literal {
  int digits;        /* from the first that is not 0 to the last */
  int written;       /* all but zeros before the point at the start */
  int place;         /* the last digit counts 10^place */
  uint64_t mantissa; /* the digits as an integer; of those that are too many
                        only the first */
  bool decimal;      /* it has a point with digits after it, or an exponent */
};

static int read_exponent(const char *at, const char *end) {
  bool negative = at < end && *at == '-';
  int sum = 0;
  for (; at < end; at++)
    if (digits_is_one(*at) && sum < POWER_MAX)
      sum = 10 * sum + (*at - '0');
  return negative ? -sum : sum;
}

/* Appends the digits at `at` to the literal, and returns where they end. */
static const char *append_digits(struct literal *literal, const char *at,
                                 const char *end) {
  uint64_t mantissa = literal->mantissa;
  int digits = literal->digits;
  for (; at < end && digits_is_one(*at); at++) {
    if (digits < DIGITS_SAFE)
      mantissa = 10 * mantissa + (uint64_t)(*at - '0');
    digits += mantissa > 0;
  }
  literal->mantissa = mantissa;
  literal->digits = digits;
  return at;
}

static struct literal read_literal(const char *at, const char *end) {
  struct literal literal = {0};
  if (*at == '-' || *at == '+')
    at++;
  at = append_digits(&literal, at, end);
  literal.written = literal.digits;
  if (at < end && *at == '.') {
    const char *fraction = at + 1;
    at = append_digits(&literal, fraction, end);
    literal.place = (int)(fraction - at);
    literal.written -= literal.place;
  }
  literal.decimal = literal.place < 0 || at < end;
  if (at < end)
    literal.place += read_exponent(at + 1, end);
  return literal;
}

static int place_slot(int place) {
  int slot = place - PRECISION_PLACE_LEAST;
  if (slot < 0)
    return 0;
  return slot < PRECISION_PLACES ? slot : PRECISION_PLACES - 1;
}

/* Whether the value is within half of its last place of a single-precision
 * number.  The last place counts |value| / mantissa. */
static bool is_single(const struct literal *literal, double value) {
  const double rounding_up = 1 + 0x1p-40; /* the product rounds */
  double size = fabs(value);
  if (!(size <= FLT_MAX))
    return false;
  double off = fabs(value - (double)(float)value);
  if (literal->digits > DIGITS_SAFE)
    return off == 0;
  return 2 * off * (double)literal->mantissa <= size * rounding_up;
}

void precision_add_literal(struct precision_sample *sample, const char *text,
                           const char *end, double value) {
  struct literal literal = read_literal(text, end);
  if (!literal.decimal || literal.digits == 0)
    return;
  sample->decimals += sample->weight;
  sample->not_single = sample->not_single || !is_single(&literal, value);
  if (literal.written < LONG_DIGITS)
    return;
  int digits =
      literal.digits < PRECISION_DIGITS ? literal.digits : PRECISION_DIGITS;
  sample->long_ones += sample->weight;
  sample->digits[digits] += sample->weight;
  sample->place[place_slot(literal.place)] += sample->weight;
}

/* ---- Conclusions --------------------------------------------------------- */

/* The most significant digits that enough literals have. */
static int most_digits(const struct precision_sample *sample) {
  uint64_t sum = 0;
  int digits = PRECISION_DIGITS + 1;
  while (digits > 1 && ONE_IN * sum < sample->long_ones)
    sum += sample->digits[--digits];
  return digits;
}

/* The slot of the finest place at which enough literals end. */
static int finest_place(const struct precision_sample *sample) {
  uint64_t sum = 0;
  int slot = -1;
  while (slot + 1 < PRECISION_PLACES && ONE_IN * sum < sample->long_ones)
    sum += sample->place[++slot];
  return slot;
}

struct precision precision_estimate(const struct precision_sample *sample) {
  struct precision precision = {0, 0};
  if (ONE_IN * sample->long_ones <= sample->decimals)
    return precision;
  int digits = most_digits(sample), slot = finest_place(sample);
  precision.relative = sample->not_single ? PRECISION_DOUBLE : PRECISION_SINGLE;
  if (sample->digits[digits] <= sample->place[slot])
    precision.absolute = 0.5 * pow(10, slot + PRECISION_PLACE_LEAST);
  else
    precision.relative = fmax(precision.relative, 0.5 * pow(10, 1 - digits));
  return precision;
}
