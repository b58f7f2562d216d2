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

/* Whether `word` is one of the space-separated words of `list`. */
static bool is_among(const char *word, const char *list) {
  size_t length = strlen(word);
  while (*list != '\0') {
    size_t here = strcspn(list, " ");
    if (here == length && same_word(word, list, length))
      return true;
    list += here;
    list += strspn(list, " ");
  }
  return false;
}

const struct writer *writer_by_name(const char *name) {
  for (const struct writer *const *w = table; *w != NULL; w++)
    if (is_among(name, (*w)->name) || is_among(name, (*w)->extensions))
      return *w;
  return NULL;
}

const struct writer *writer_by_path(const char *path) {
  const char *slash = strrchr(path, '/');
  const char *dot = strrchr(slash != NULL ? slash : path, '.');
  if (dot == NULL)
    return NULL;
  for (const struct writer *const *w = table; *w != NULL; w++)
    if (is_among(dot + 1, (*w)->extensions))
      return *w;
  return NULL;
}
