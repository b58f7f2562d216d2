/* number.h - numbers to and from text, the same in every locale. */
#ifndef BASE_NUMBER_H
#define BASE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Room for any number these functions write, with its terminating NUL. */
#define NUMBER_TEXT_SIZE 48

/* Parses a decimal number [+-]digits[.digits][e[+-]digits], or inf, nan in
 * any case, at `text`, not reading at or past `end`.
 * Returns where it stopped, or NULL when there is no number.
 * Exact: the nearest double, ties to even (an overflow gives infinity). */
const char *number_parse_double(const char *text, const char *end,
                                double *value);

/* Parses [+-]digits.  Returns where it stopped, or NULL when there is none or
 * it does not fit. */
const char *number_parse_int(const char *text, const char *end, int64_t *value);

/* Parses a whole NUL-terminated string as a number; false if anything is
 * left over. */
bool number_from_string(const char *text, double *value);

/* Writes `value` with at most `decimals` (0 to 9) decimals, rounded half away
 * from zero, no exponent, no trailing zeros, no "-0", always ".".
 * value  finite, |value| < 1e9
 * Returns the length; `text` is NUL-terminated. */
size_t number_format(char text[NUMBER_TEXT_SIZE], double value, int decimals);

/* Writes the shortest text that reads back as the same double. */
size_t number_format_exact(char text[NUMBER_TEXT_SIZE], double value);

size_t number_format_int(char text[NUMBER_TEXT_SIZE], int64_t value);

#endif
