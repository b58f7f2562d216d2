/* gunzip.h - expands data compressed with gzip. */
#ifndef BASE_GUNZIP_H
#define BASE_GUNZIP_H

#include <stdint.h>

#include "base/memory.h"

/* Expanded data may have so many bytes whatever it was made from; beyond, at
 * most GUNZIP_RATIO for each compressed one.  Models are compressed to a third
 * or a tenth; a hundredth is a file made to fill the memory. */
#define GUNZIP_SIZE_ALWAYS_ALLOWED (INT64_C(256) << 20)
#define GUNZIP_RATIO 100

/* Whether the bytes begin as those of a gzip file do [RFC 1952 2.3.1]. */
bool gunzip_is_wanted(const char *bytes, size_t count);

/* Replaces gzip data by what they expand to, with a NUL behind the last byte;
 * several members are joined, zeros after the last are passed over.  On a
 * failure the data stay.
 * path      for messages
 * size_max  bytes that it may expand to
 * Errors    RECTO_ERROR_FORMAT (broken or cut short), RECTO_ERROR_LIMIT,
 *           RECTO_ERROR_MEMORY; RECTO_ERROR_UNSUPPORTED without zlib */
USE_RESULT recto_status gunzip(struct byte_array *data, const char *path,
                               size_t size_max, recto_error *error);

#endif
