/* diagnostics.h - counts faults of elements that are read, passes them on as
 * warnings, and polls while reading. */
#ifndef SCENE_DIAGNOSTICS_H
#define SCENE_DIAGNOSTICS_H

#include <stddef.h>

#include "base/status.h"

enum scene_fault {
  SCENE_FAULT_NOT_FINITE,  /* NaN or infinite coordinate */
  SCENE_FAULT_INDEX,       /* index out of range */
  SCENE_FAULT_FEW_CORNERS, /* fewer than three distinct corners */
  SCENE_FAULT_ZERO_AREA,   /* corners on one line */
  SCENE_FAULT_BOW_TIE,     /* sides of a polygon cross (kept, warned) */
  SCENE_FAULT_WARPED,      /* not planar (kept, counted, not warned) */
  SCENE_FAULT_SYNTAX,      /* an element that cannot be parsed */
  SCENE_FAULT_MATERIAL,    /* a colour that is not there or makes no sense */
  SCENE_FAULT_COUNT
};

struct diagnostics {
  const char *file;         /* as the user wrote it, "-" for stdin */
  recto_warning_fn warning; /* NULL: silent */
  void *user;
  unsigned long count[SCENE_FAULT_COUNT];
  unsigned long settled[SCENE_FAULT_COUNT]; /* count at the last _finish */
  const char *poll_at; /* the first byte at which progress is polled again */
  const char *bytes;   /* what is read: all, or a block of it, */
  size_t bytes_before; /* before which there are so many */
  size_t byte_count;   /* of all; 0: not known */
};

/* Polls where reading has come a quarter of a megabyte farther: a few
 * milliseconds.
 * at      the byte that is read next
 * Errors  RECTO_ERROR_CANCELLED */
USE_RESULT recto_status diagnostics_poll_now(struct diagnostics *diagnostics,
                                             const char *at,
                                             recto_error *error);
static inline recto_status diagnostics_poll(struct diagnostics *diagnostics,
                                            const char *at,
                                            recto_error *error) {
  return diagnostics == NULL || at < diagnostics->poll_at
             ? RECTO_OK
             : diagnostics_poll_now(diagnostics, at, error);
}

/* Counts the fault; the first three of each kind are passed on.
 * diagnostics  NULL: not wanted
 * line         0 where there is none; in a binary file the element's number */
void diagnostics_fault(struct diagnostics *diagnostics, enum scene_fault fault,
                       unsigned long line, const char *format, ...)
    PRINTF_LIKE(4, 5);
/* Passes on a warning that is no fault of an element.
 * diagnostics  NULL: not wanted
 * file         as the user wrote it */
void diagnostics_warn(const struct diagnostics *diagnostics, const char *file,
                      const char *format, ...) PRINTF_LIKE(3, 4);
/* Passes on "... and N more" for kinds that had more than three since it was
 * last called.  scene_read does this at the end of each file. */
void diagnostics_finish(struct diagnostics *diagnostics);

#endif
