/* status.h - filling the error record; the codes are the public ones. */
#ifndef BASE_STATUS_H
#define BASE_STATUS_H

#include "recto.h"

#define USE_RESULT RECTO_USE_RESULT

#if defined __GNUC__
#define PRINTF_LIKE(text, first) __attribute__((format(printf, text, first)))
#else
#define PRINTF_LIKE(text, first)
#endif

/* Fills `error`, where it is not NULL, and returns `code`, so that a failing
 * function ends in `return error_set(...)`.
 * file  NULL or "" where no file is at fault; a long path keeps its tail
 * line  1-based, 0 where none is at fault
 * text  cut at the record's size, never overrun */
recto_status error_set(recto_error *error, recto_status code, const char *file,
                       unsigned long line, const char *format, ...)
    PRINTF_LIKE(5, 6);

/* error_set(error, RECTO_ERROR_ARGUMENT, ...): `name` says which argument may
 * not be NULL. */
recto_status error_null(recto_error *error, const char *name);

/* error_set(error, RECTO_ERROR_CANCELLED, ...) with its usual words. */
recto_status error_cancelled(recto_error *error);

/* The same with RECTO_ERROR_MEMORY, for work that ended early: with
 * RECTO_ERROR_CANCELLED where the caller has cancelled (base/poll.h). */
recto_status error_memory(recto_error *error);

#endif
