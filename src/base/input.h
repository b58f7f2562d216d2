/* input.h - a whole file in memory. */
#ifndef BASE_INPUT_H
#define BASE_INPUT_H

#include <stddef.h>

#include "base/memory.h"
#include "base/path.h"
#include "base/status.h"

struct input {
  const char *bytes; /* a NUL stands behind the last */
  size_t count;
  struct byte_array buffer; /* what `bytes` points to */
  bool is_file;             /* it was a regular file, and this one */
  struct file_identity file;
};

/* How many bytes a file may have: half of the machine's memory, at most
 * 64 GiB.  More could not be read and drawn in any case, and an endless stream
 * must end somewhere. */
size_t input_size_max(void);

/* The same for a character device, such as a terminal: most are endless. */
#define INPUT_DEVICE_MAX (INT64_C(64) << 20)

/* Loads a file; "-" is standard input.  What is compressed with gzip, by its
 * first bytes, is expanded.
 * Errors  RECTO_ERROR_IO, also where the file is cut short in the meantime,
 *         RECTO_ERROR_LIMIT (too large), RECTO_ERROR_FORMAT (broken gzip data),
 *         RECTO_ERROR_UNSUPPORTED (gzip data in a build without zlib),
 *         RECTO_ERROR_MEMORY; input_unload it in any case. */
USE_RESULT recto_status input_load(struct input *input, const char *path,
                                   recto_error *error);

/* Copies bytes from memory, expanded where they are compressed with gzip.
 * name    for messages
 * Errors  as of input_load */
USE_RESULT recto_status input_copy(struct input *input, const void *bytes,
                                   size_t count, const char *name,
                                   recto_error *error);

/* Loads a file whose name stands in another one, which may name anything:
 * only regular files of at most INPUT_NAMED_MAX bytes are read, and gzip data
 * are expanded to no more than that.
 * Errors  as of input_load */
#define INPUT_NAMED_MAX (INT64_C(16) << 20)
USE_RESULT recto_status input_load_named(struct input *input, const char *path,
                                         recto_error *error);

void input_unload(struct input *input);

#endif
