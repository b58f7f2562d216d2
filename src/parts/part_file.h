/* part_file.h - parts as bytes of a file: doc/part-format.md. */
#ifndef PARTS_PART_FILE_H
#define PARTS_PART_FILE_H

#include "parts/part.h"

/* Makes the bytes of a file, to be freed with ARRAY_FREE.
 * Errors  RECTO_ERROR_MEMORY */
USE_RESULT recto_status part_file_make(struct part *part,
                                       struct byte_array *bytes,
                                       recto_error *error);

/* Reads the bytes of a file, which may be hostile: what is accepted has its
 * numbers in range and its lists in order, so that the join need not check them
 * again.
 * path    for messages
 * Errors  RECTO_ERROR_FORMAT: it is no part, cut short or damaged;
 *         RECTO_ERROR_UNSUPPORTED: of another version; RECTO_ERROR_MEMORY; the
 *         part is then empty */
USE_RESULT recto_status part_file_parse(struct part *part, const void *bytes,
                                        size_t count, const char *path,
                                        recto_error *error);

#endif
