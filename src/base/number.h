/* number.h - numbers to and from text, the same in every locale. */
#ifndef BASE_NUMBER_H
#define BASE_NUMBER_H

#include <float.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/digits.h"

/* Room for any number these functions write, with its terminating NUL. */
#define NUMBER_TEXT_SIZE 48

/* Parses a decimal number [+-]digits[.digits][e[+-]digits], or inf, nan in
 * any case, at `text`, not reading at or past `end`.
 * Returns where it stopped, or NULL when there is no number.
 * Exact: the nearest double, ties to even (an overflow gives infinity). */
const char *number_parse_double(const char *text, const char *end,
                                double *value);

#if DIGITS_CHUNKS
/* So many bytes are read at once. */
enum { NUMBER_PLAIN_ROOM = 32 };

/* 1e0 to 1e15, all of them exact. */
extern const double number_power_of_ten[16];

/* Parses [-]digits[.digits] where there are at most 7 digits before the point
 * and 15 behind it: whole numbers up to 2^53 over a power of ten that is a
 * double, so one division rounds once [Clinger].
 * text  has NUMBER_PLAIN_ROOM bytes at least
 * Returns where it stopped, or NULL where there is something else.
 * Exact: as number_parse_double. */
static inline const char *number_parse_plain(const char *text, double *value) {
  enum { DIGITS_MAX = 19 }; /* so many fit in 64 bits */
  uint64_t chunk;
  bool negative = *text == '-';
  text += negative;
  int whole = digits_count(text, &chunk), decimals = 0;
  if (FLT_EVAL_METHOD != 0 || whole == 0 || whole == 8)
    return NULL;
  uint64_t sum = digits_sum(chunk, whole);
  text += whole;
  if (*text == '.') {
    decimals = digits_count(++text, &chunk);
    if (decimals == 0)
      return NULL;
    sum = sum * (uint64_t)number_power_of_ten[decimals] +
          digits_sum(chunk, decimals);
    text += decimals;
    if (decimals == 8 && digits_is_one(*text)) {
      int more = digits_count(text, &chunk);
      decimals += more;
      if (more == 8 || whole + decimals > DIGITS_MAX)
        return NULL;
      sum = sum * (uint64_t)number_power_of_ten[more] + digits_sum(chunk, more);
      text += more;
      if (sum > UINT64_C(1) << 53)
        return NULL;
    }
  }
  double magnitude = (double)(int64_t)sum / number_power_of_ten[decimals];
  *value = negative ? -magnitude : magnitude;
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
