/* word.h - letters and words of text; the locale does not matter. */
#ifndef BASE_WORD_H
#define BASE_WORD_H

#include <stdbool.h>
#include <stdint.h>

/* Whether a character separates words within a line. */
static inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/* Whether `word`, in any case, is one of the words of `list`, which are
 * separated by spaces; if `as_extension`, whether it ends in a dot and one of
 * them.  A list may be NULL. */
bool word_is_among(const char *word, const char *list, bool as_extension);

/* What a noun ends in after a number. */
static inline const char *plural_ending(uint64_t count) {
  return count == 1 ? "" : "s";
}

#endif
