/* utf8.h - text in UTF-8 that every format can hold. */
#ifndef BASE_UTF8_H
#define BASE_UTF8_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

/* The length of the well-formed UTF-8 sequence at `text`, which NUL ends, if it
 * is a character that XML 1.0 allows; else 0.
 * code  gets the character; NULL: not wanted */
size_t utf8_measure(const char *text, uint32_t *code);

/* Whether a character is a digit of any script, also a raised, lowered or
 * circled one: in Unicode 15 of the numeric type decimal or digit. */
bool utf8_is_digit(uint32_t code);

/* A copy in which each byte that is not part of such a character is replaced by
 * U+FFFD, and line ends and tabs by spaces; the caller frees it.  NULL when
 * memory ran out. */
USE_RESULT char *utf8_clean(const char *text);

#endif
