/* writers.c - the table of formats we write, and looking one up. */
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

/* Whether a[0 .. length) and b[0 .. length) are the same but for case. */
static bool same_word(const char *a, const char *b, size_t length) {
  for (size_t i = 0; i < length; i++)
    if (lower(a[i]) != lower(b[i]))
      return false;
  return true;
}

/* Whether `word` is one of the space-separated words of `list`, or where
 * `as_extension` is set, ends in one of them behind a dot. */
static bool is_among(const char *word, const char *list, bool as_extension) {
  size_t length = strlen(word);
  while (list != NULL && *list != '\0') {
    size_t here = strcspn(list, " ");
    const char *end = word + length - (here < length ? here : length);
    bool fits = as_extension ? end > word && end[-1] == '.' : end == word;
    if (fits && strlen(end) == here && same_word(end, list, here))
      return true;
    list += here;
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
