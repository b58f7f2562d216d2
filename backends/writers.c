/* writers.c - the table of output formats, and its look-up by name or path. */
#include "backends/writer.h"

#include "base/word.h"

static const struct writer *const table[] = {
    &writer_svg, &writer_hpgl,
#ifdef HAVE_CAIRO
    &writer_pdf, &writer_eps,  &writer_ps, &writer_png,
#endif
    NULL,
};

const struct writer *const *writers(void) { return table; }

const struct writer *writer_by_name(const char *name) {
  for (const struct writer *const *w = table; *w != NULL; w++)
    if (word_is_among(name, (*w)->name, false) ||
        word_is_among(name, (*w)->extensions, false) ||
        word_is_among(name, (*w)->compressed, false))
      return *w;
  return NULL;
}

const struct writer *writer_by_path(const char *path) {
  for (const struct writer *const *w = table; *w != NULL; w++)
    if (word_is_among(path, (*w)->extensions, true) ||
        word_is_among(path, (*w)->compressed, true))
      return *w;
  return NULL;
}

static bool is_compressed(const char *word, bool as_extension) {
  for (const struct writer *const *w = table; *w != NULL; w++)
    if (word_is_among(word, (*w)->compressed, as_extension))
      return true;
  return false;
}

bool writer_name_is_compressed(const char *name) {
  return is_compressed(name, false);
}

bool writer_path_is_compressed(const char *path) {
  return is_compressed(path, true);
}

double writer_screen_seam_mm(const struct writer_options *options) {
  (void)options;
  return 0.4;
}
