/* svg_text.h - text in SVG: escaped, as colours, and as ids. */
#ifndef BACKENDS_SVG_TEXT_H
#define BACKENDS_SVG_TEXT_H

#include "base/memory.h"
#include "base/stream.h"

/* Writes text as the value of an attribute or as content.  Bytes that are not
 * part of a character of XML, as in a name that is not UTF-8, are replaced by
 * U+FFFD. */
void svg_write_text(struct stream *stream, const char *text);

/* Writes a colour as #rrggbb. */
void svg_write_colour(struct stream *stream, uint32_t colour);

/* A name for each of some groups that may be part of an id; no two are
 * equal. */
struct svg_ids {
  char **id;         /* NULL of a group without a name */
  struct arena text; /* private */
};

/* Makes the names of `count` groups.  Each is the group's name, with underlines
 * in place of what no id holds; where several are alike then, all but the one
 * that is its name itself have a point and a number made of the name alone
 * behind.  False when memory ran out; end with svg_ids_fini either way. */
USE_RESULT bool svg_ids_init(struct svg_ids *ids, char *const *name,
                             size_t count);
void svg_ids_fini(struct svg_ids *ids);

#endif
