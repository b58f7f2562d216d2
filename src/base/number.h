/* number.h - numbers to and from text, the same in every locale. */
#ifndef BASE_NUMBER_H
#define BASE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "base/digits.h"

/* Room for any number these functions write, with its terminating NUL. */
#define NUMBER_TEXT_SIZE 48

/* Parses a decimal number [+-]digits[.digits][e[+-]digits], or inf, nan in
 * any case, at `text`, not reading at or past `end`.
 * Returns where it stopped, or NULL when there is no number.
 * Exact: the nearest double, ties to even (an overflow gives infinity). */
const char *number_parse_double(const char *text, const char *end,
                                double *value);

__extension__ typedef unsigned __int128 number_uint128;

/* 1 / 5^digits as `scaled` * 2^-n, whose top bit is set, rounded down. */
struct number_reciprocal {
  uint64_t scaled;
  int exponent; /* of a double: see number_scale_down */
};

extern const struct number_reciprocal number_reciprocal[28];

/* w / 10^digits, rounded once; w > 0, 0 <= digits <= 27. */
double number_divide(uint64_t w, int digits);

/* The same, also of w = 0, nearly always by one product and without a branch
 * that depends on w [Lemire].
 * Both factors have their top bits set.  The first 64 bits of the exact product
 * are no less than those of this one, and less than two more: the reciprocal
 * is too small by less than one, and so is what is left out of the product.
 * Moved up by a bit, that is four.  So rounding to 53 bits is certain unless
 * the half of a last bit is that near above. */
static inline double number_scale_down(uint64_t w, int digits) {
  enum { DROPPED = 64 - 53, HALF = 1 << (DROPPED - 1), ERROR = 4 };
  if (w == 0)
    return 0;
  const struct number_reciprocal *by = &number_reciprocal[digits];
  int shift = __builtin_clzll(w);
  uint64_t high = (uint64_t)(((number_uint128)(w << shift) * by->scaled) >> 64);
  int up = !(high >> 63);
  high <<= up;
  uint64_t rest = high & ((UINT64_C(1) << DROPPED) - 1);
  if (rest + ERROR > HALF && rest <= HALF)
    return number_divide(w, digits);
  /* The hidden bit adds one to the exponent, and so does a carry. */
  uint64_t bits = (((high >> (DROPPED - 1)) + 1) >> 1) +
                  ((uint64_t)(by->exponent - shift - up) << 52);
  double value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

#if DIGITS_CHUNKS
/* So many bytes are read at once. */
enum { NUMBER_PLAIN_ROOM = 32 };

/* 10^0 to 10^8. */
extern const uint64_t number_power_of_ten[9];

/* The same number below zero where `negative`, without a branch. */
static inline double number_with_sign(double magnitude, bool negative) {
  uint64_t bits;
  memcpy(&bits, &magnitude, sizeof bits);
  bits |= (uint64_t)negative << 63;
  memcpy(&magnitude, &bits, sizeof bits);
  return magnitude;
}

/* Appends the digits at `text` to *sum, and returns how many there are, up to
 * 8. */
static inline int number_add_chunk(const char *text, uint64_t *sum) {
  uint64_t chunk;
  int count = digits_count(text, &chunk);
  if (count > 0)
    *sum = *sum * number_power_of_ten[count] + digits_sum(chunk, count);
  return count;
}

/* The same; false where *sum would not fit. */
static inline bool number_add_last_chunk(const char *text, uint64_t *sum,
                                         int *count) {
  uint64_t chunk;
  *count = digits_count(text, &chunk);
  return *count == 0 ||
         (!__builtin_mul_overflow(*sum, number_power_of_ten[*count], sum) &&
          !__builtin_add_overflow(*sum, digits_sum(chunk, *count), sum));
}

/* Parses [-]digits[.digits] where there are at most 7 digits before the point,
 * or at most 2 where more than 15 are behind it, and as many in all as fit in
 * 64 bits, or 19.
 * text  has NUMBER_PLAIN_ROOM bytes at least
 * Returns where it stopped, or NULL where there is something else.
 * Exact: as number_parse_double. */
static inline const char *number_parse_plain(const char *text, double *value) {
  enum { CHUNK = 8, DIGITS_MAX = 19 /* so many fit in 64 bits */ };
  uint64_t sum = 0;
  bool negative = *text == '-';
  text += negative;
  int whole = 1, decimals = 0;
  if (text[1] == '.' && digits_is_one(*text))
    sum = (uint64_t)(*text - '0'); /* nearly all: the branch is foreseen */
  else
    whole = number_add_chunk(text, &sum);
  if (whole == 0 || whole == CHUNK)
    return NULL;
  text += whole;
  if (*text == '.') {
    decimals = number_add_chunk(++text, &sum);
    if (decimals == 0)
      return NULL;
    if (decimals == CHUNK)
      decimals += number_add_chunk(text + CHUNK, &sum);
    if (decimals == 2 * CHUNK) {
      int more;
      if (whole > 2 || !number_add_last_chunk(text + 2 * CHUNK, &sum, &more))
        return NULL;
      decimals += more;
    } else if (whole + decimals > DIGITS_MAX) {
      return NULL;
    }
    text += decimals;
  }
  *value = number_with_sign(number_scale_down(sum, decimals), negative);
  return text;
}
#endif

/* Parses [+-]digits.  Returns where it stopped, or NULL when there is none or
 * it does not fit. */
const char *number_parse_int(const char *text, const char *end, int64_t *value);

/* Writes `value` with at most `decimals` (0 to 9) decimals, rounded half away
 * from zero, no exponent, no trailing zeros, no "-0", always ".".
 * value  finite, |value| < 1e9
 * Returns the length; `text` is NUL-terminated. */
size_t number_format(char text[NUMBER_TEXT_SIZE], double value, int decimals);

/* Writes value / 10^decimals (0 to 9) in the same form; exact. */
size_t number_format_scaled(char text[NUMBER_TEXT_SIZE], int64_t value,
                            int decimals);

/* Writes the shortest text that reads back as the same double. */
size_t number_format_exact(char text[NUMBER_TEXT_SIZE], double value);

size_t number_format_int(char text[NUMBER_TEXT_SIZE], int64_t value);

#endif
