/* word.c - words in lists. */
#include "base/word.h"

#include <string.h>

static int lower(char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; }

static bool equal_words(const char *a, const char *b, size_t length) {
  for (size_t i = 0; i < length; i++)
    if (lower(a[i]) != lower(b[i]))
      return false;
  return true;
}

bool word_is_among(const char *word, const char *list, bool as_extension) {
  size_t length = strlen(word);
  while (list != NULL && *list != '\0') {
    size_t list_length = strcspn(list, " ");
    const char *end =
        word + length - (list_length < length ? list_length : length);
    bool fits = as_extension ? end > word && end[-1] == '.' : end == word;
    if (fits && strlen(end) == list_length &&
        equal_words(end, list, list_length))
      return true;
    list += list_length;
    list += strspn(list, " ");
  }
  return false;
}
