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

/* w / 10^digits, rounded once; 0 <= digits <= 27. */
double number_scale_down(uint64_t w, int digits);

/* Appends the digits at `text` to *sum, and returns how many there are, up to
 * 8. */
static inline int number_add_chunk(const char *text, uint64_t *sum) {
  uint64_t chunk;
  int count = digits_count(text, &chunk);
  if (count > 0)
    *sum =
        *sum * (uint64_t)number_power_of_ten[count] + digits_sum(chunk, count);
  return count;
}

/* Parses [-]digits[.digits] where there are at most 7 digits before the point,
 * or at most 2 where more than 15 are behind it, and 19 in all.  Whole numbers
 * up to 2^53 over a power of ten that is a double are divided, which rounds
 * once [Clinger].
 * text  has NUMBER_PLAIN_ROOM bytes at least
 * Returns where it stopped, or NULL where there is something else.
 * Exact: as number_parse_double. */
static inline const char *number_parse_plain(const char *text, double *value) {
  enum { CHUNK = 8, DIGITS_MAX = 19 /* so many fit in 64 bits */ };
  uint64_t sum = 0;
  bool negative = *text == '-';
  text += negative;
  int whole = number_add_chunk(text, &sum), decimals = 0;
  if (FLT_EVAL_METHOD != 0 || whole == 0 || whole == CHUNK)
    return NULL;
  text += whole;
  if (*text == '.') {
    decimals = number_add_chunk(++text, &sum);
    if (decimals == 0)
      return NULL;
    if (decimals == CHUNK)
      decimals += number_add_chunk(text + CHUNK, &sum);
    if (decimals == 2 * CHUNK) {
      if (whole > 2)
        return NULL;
      decimals += number_add_chunk(text + 2 * CHUNK, &sum);
    }
    if (whole + decimals > DIGITS_MAX)
      return NULL;
    text += decimals;
  }
  double magnitude = sum <= UINT64_C(1) << 53 && decimals < 16
                         ? (double)(int64_t)sum / number_power_of_ten[decimals]
                         : number_scale_down(sum, decimals);
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
