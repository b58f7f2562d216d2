/* svg_text.h - text in SVG: escaped, as colours, and as ids. */
#ifndef BACKENDS_SVG_TEXT_H
#define BACKENDS_SVG_TEXT_H

#include "base/stream.h"

/* Writes text as the value of an attribute or as content.  Bytes that are not
 * part of a character of XML, as in a name that is not UTF-8, are replaced by
 * U+FFFD. */
void svg_write_text(struct stream *stream, const char *text);

/* Writes a colour as #rrggbb. */
void svg_write_colour(struct stream *stream, uint32_t colour);

/* A name for each of `count` groups that may be part of an id: no two are
 * equal.  It is the group's name, with underlines in place of what no id holds;
 * where several are alike then, all but the one that is its name itself have a
 * point and a number made of the name alone behind.  A group without a name has
 * NULL.  Free with svg_ids_free.  NULL when memory ran out. */
USE_RESULT char **svg_ids_make(char *const *name, size_t count);
void svg_ids_free(char **id, size_t count);

#endif
