/* gzip.h - compresses bytes on their way. */
#ifndef BASE_GZIP_H
#define BASE_GZIP_H

#include <stddef.h>

#include "base/status.h"

/* What zlib allocates with. */
void *gzip_allocate(void *user, unsigned count, unsigned size);
void gzip_release(void *user, void *block);

struct gzip;

typedef void gzip_sink(void *user, const void *bytes, size_t count);

/* What is written comes out compressed, in the format of gzip: with no name, no
 * time, and nothing else that differs from one run to the next.
 * sink    gets the compressed bytes, until gzip_end has returned
 * Errors  RECTO_ERROR_UNSUPPORTED: built without zlib; RECTO_ERROR_MEMORY */
USE_RESULT recto_status gzip_create(struct gzip **gzip, gzip_sink *sink,
                                    void *user, recto_error *error);
void gzip_write(struct gzip *gzip, const void *bytes, size_t count);
/* Lets the sink have all that is still held back. */
void gzip_end(struct gzip *gzip);
/* Accepts NULL. */
void gzip_destroy(struct gzip *gzip);

#endif
