/* line_key.h - hashes of lines. */
#ifndef GEOM_LINE_KEY_H
#define GEOM_LINE_KEY_H

#include "geom/line.h"

/* A hash: lines that are the same, in either direction, have the same key, and
 * few others do.  Returns false where no two grid points can have it. */
bool geom_line_key(const struct geom_line *line, uint64_t *key);

#endif
