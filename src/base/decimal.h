/* decimal.h - the nearest double to a decimal number of any length. */
#ifndef BASE_DECIMAL_H
#define BASE_DECIMAL_H

#include <stdbool.h>
#include <stdint.h>

/* The double nearest to top * 2^exponent, ties to even; overflow gives
 * infinity, underflow zero.
 * top     its highest bit is set
 * sticky  whether the true value is a little larger, by less than one */
double decimal_round(uint64_t top, bool sticky, int exponent);

/* The double nearest to the digits in [text, end), taken as an integer, times
 * 10^exponent.  Characters other than digits (the point) are passed over.
 * Exact for any number of digits.
 * Cost: microseconds; number_parse_double comes here only with what it cannot
 * settle in 128 bits. */
double decimal_to_double(const char *text, const char *end, int64_t exponent);

#endif
