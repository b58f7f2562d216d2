/* input.h - a whole file in memory. */
#ifndef BASE_INPUT_H
#define BASE_INPUT_H

#include <stddef.h>

#include "base/memory.h"
#include "base/status.h"

struct input {
  const char *bytes; /* a NUL stands behind the last */
  size_t count;
  size_t mapped; /* length of the mapping; 0: the bytes are in `slurped` */
  ARRAY(char) slurped;
};

/* Loads a file; "-" is standard input.
 * Errors  RECTO_ERROR_IO, RECTO_ERROR_MEMORY; input_unload it in any case. */
USE_RESULT recto_status input_load(struct input *input, const char *path,
                                   recto_error *error);

/* Loads a file whose name stands in another one, which may name anything:
 * only files proper of at most INPUT_NAMED_MOST bytes are read.
 * Errors  as input_load, RECTO_ERROR_LIMIT */
#define INPUT_NAMED_MOST (INT64_C(16) << 20)
USE_RESULT recto_status input_load_named(struct input *input, const char *path,
                                         recto_error *error);

void input_unload(struct input *input);

#endif
