/* svg_text.h - a drawing as SVG in memory. */
#ifndef TESTS_SVG_TEXT_H
#define TESTS_SVG_TEXT_H

#include <stdlib.h>
#include <string.h>

#include "recto.h"

struct svg_text {
  char *bytes;
  size_t count;
};

static inline bool append_svg(void *user, const void *bytes, size_t count) {
  struct svg_text *text = user;
  char *more = realloc(text->bytes, text->count + count + 1);
  if (more == NULL)
    return false;
  memcpy(more + text->count, bytes, count);
  text->bytes = more;
  text->count += count;
  more[text->count] = '\0';
  return true;
}

/* options  NULL: the defaults
 * Returns text that ends with a zero byte and is the caller's to free; NULL
 * where writing fails. */
static inline char *svg_text_of(const recto_drawing *drawing,
                                const recto_options *options) {
  struct svg_text text = {NULL, 0};
  if (recto_drawing_write_to(drawing, "svg", options, append_svg, &text,
                             NULL) != RECTO_OK) {
    free(text.bytes);
    return NULL;
  }
  return text.bytes;
}

#endif
