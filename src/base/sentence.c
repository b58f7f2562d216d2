/* sentence.c - a message that is put together part by part. */
#include "base/sentence.h"

#include <stdarg.h>
#include <stdio.h>

void sentence_add(struct sentence *sentence, const char *format, ...) {
  va_list arguments;
  size_t capacity = sizeof sentence->text - sentence->length;
  va_start(arguments, format);
  int length =
      vsnprintf(sentence->text + sentence->length, capacity, format, arguments);
  va_end(arguments);
  if (length > 0)
    sentence->length +=
        (size_t)length < capacity ? (size_t)length : capacity - 1;
}
