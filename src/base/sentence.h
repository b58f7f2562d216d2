/* sentence.h - a message that is put together part by part. */
#ifndef BASE_SENTENCE_H
#define BASE_SENTENCE_H

#include <stddef.h>

#include "base/status.h"

/* Zero-initialised is empty.  What does not fit is cut off. */
struct sentence {
  char text[400];
  size_t length;
};

/* Adds a part, as printf would write it. */
void sentence_add(struct sentence *sentence, const char *format, ...)
    PRINTF_LIKE(2, 3);

#endif
