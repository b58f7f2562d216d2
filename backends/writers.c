/* writers.c - the table of output formats, and its look-up by name or path. */
#include "backends/writer.h"

#include <string.h>

static const struct writer *const table[] = {
    &writer_svg, &writer_hpgl,
#ifdef HAVE_CAIRO
    &writer_pdf, &writer_eps,  &writer_ps, &writer_png,
#endif
    NULL,
};

const struct writer *const *writers(void) { return table; }

static int lower(char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; }

/* Whether a[0 .. length) and b[0 .. length) are equal, ignoring case. */
static bool equal_words(const char *a, const char *b, size_t length) {
  for (size_t i = 0; i < length; i++)
    if (lower(a[i]) != lower(b[i]))
      return false;
  return true;
}

/* Whether `word` is one of the words of `list`, which are separated by spaces,
 * or if `as_extension`, ends in a dot and one of them.  A list may be NULL. */
static bool is_among(const char *word, const char *list, bool as_extension) {
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

const struct writer *writer_by_name(const char *name) {
  for (const struct writer *const *w = table; *w != NULL; w++)
    if (is_among(name, (*w)->name, false) ||
        is_among(name, (*w)->extensions, false) ||
        is_among(name, (*w)->compressed, false))
      return *w;
  return NULL;
}

const struct writer *writer_by_path(const char *path) {
  for (const struct writer *const *w = table; *w != NULL; w++)
    if (is_among(path, (*w)->extensions, true) ||
        is_among(path, (*w)->compressed, true))
      return *w;
  return NULL;
}

static bool is_compressed(const char *word, bool as_extension) {
  for (const struct writer *const *w = table; *w != NULL; w++)
    if (is_among(word, (*w)->compressed, as_extension))
      return true;
  return false;
}

bool writer_name_is_compressed(const char *name) {
  return is_compressed(name, false);
}

bool writer_path_is_compressed(const char *path) {
  return is_compressed(path, true);
}
