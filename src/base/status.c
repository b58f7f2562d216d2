/* status.c - the codes' names and the filling of the error record. */
#include "base/status.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/poll.h"

const char *recto_status_name(recto_status status) {
  switch (status) {
  case RECTO_OK:
    return "ok";
  case RECTO_ERROR_ARGUMENT:
    return "argument";
  case RECTO_ERROR_MEMORY:
    return "memory";
  case RECTO_ERROR_IO:
    return "io";
  case RECTO_ERROR_FORMAT:
    return "format";
  case RECTO_ERROR_UNSUPPORTED:
    return "unsupported";
  case RECTO_ERROR_EMPTY:
    return "empty";
  case RECTO_ERROR_LIMIT:
    return "limit";
  case RECTO_ERROR_CANCELLED:
    return "cancelled";
  case RECTO_ERROR_VERIFY:
    return "verify";
  case RECTO_STATUS_COUNT:
    break;
  }
  return "unknown";
}

/* Copies a path; of one that is too long the tail, where the file's own name
 * stands, after three dots. */
static void copy_path(char *to, size_t size, const char *path) {
  size_t length = strlen(path);
  if (length < size) {
    memcpy(to, path, length + 1);
    return;
  }
  to[0] = to[1] = to[2] = '.';
  memcpy(to + 3, path + length - (size - 4), size - 3);
}

/* The text may quote a broken file: nothing in it may move a terminal's
 * cursor or start a new line. */
static void replace_control_characters(char *text) {
  for (; *text; text++)
    if ((unsigned char)*text < 0x20 || *text == 0x7f)
      *text = '?';
}

/* A cut may have gone through a UTF-8 character: drops its first part. */
static void drop_partial_character(char *text, size_t length) {
  size_t back = 0;
  while (back < 3 && back < length &&
         ((unsigned char)text[length - 1 - back] & 0xc0) == 0x80)
    back++;
  if (back < length && (unsigned char)text[length - 1 - back] >= 0xc0)
    text[length - 1 - back] = '\0';
}

recto_status error_set(recto_error *error, recto_status code, const char *file,
                       unsigned long line, const char *format, ...) {
  if (error == NULL)
    return code;
  error->code = code;
  copy_path(error->file, sizeof error->file, file != NULL ? file : "");
  error->line = line;
  va_list arguments;
  va_start(arguments, format);
  int length = vsnprintf(error->text, sizeof error->text, format, arguments);
  va_end(arguments);
  if (length < 0)
    error->text[0] = '\0';
  else if ((size_t)length >= sizeof error->text)
    drop_partial_character(error->text, sizeof error->text - 1);
  replace_control_characters(error->text);
  return code;
}

recto_status error_cancelled(recto_error *error) {
  return error_set(error, RECTO_ERROR_CANCELLED, NULL, 0, "cancelled");
}

recto_status error_memory(recto_error *error) {
  if (poll_is_cancelled())
    return error_cancelled(error);
  return error_set(error, RECTO_ERROR_MEMORY, NULL, 0, "out of memory");
}

recto_status error_null(recto_error *error, const char *name) {
  return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                   "NULL was given for %s", name);
}
