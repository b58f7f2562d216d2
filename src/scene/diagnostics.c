/* diagnostics.c - counts bad elements and passes on the first few of each
 * kind. */
#include "scene/diagnostics.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/poll.h"

/* Faults of a kind of which each has a warning; the rest are counted. */
enum { WARNINGS_MAX = 3 };

static const char *fault_text(enum scene_fault fault) {
  switch (fault) {
  case SCENE_FAULT_NOT_FINITE:
    return "coordinates that are not finite";
  case SCENE_FAULT_INDEX:
    return "indices out of range";
  case SCENE_FAULT_FEW_CORNERS:
    return "too few distinct corners";
  case SCENE_FAULT_ZERO_AREA:
    return "corners all on one line";
  case SCENE_FAULT_BOW_TIE:
    return "sides that cross";
  case SCENE_FAULT_WARPED:
    return "corners not in one plane";
  case SCENE_FAULT_SYNTAX:
    return "statements that cannot be parsed";
  case SCENE_FAULT_MATERIAL:
    return "materials that are missing or broken";
  case SCENE_FAULT_COUNT:
    break;
  }
  return "faults";
}

void diagnostics_fault(struct diagnostics *diagnostics, enum scene_fault fault,
                       unsigned long line, const char *format, ...) {
  if (diagnostics == NULL)
    return;
  unsigned long before =
      diagnostics->count[fault]++ - diagnostics->settled[fault];
  if (before >= WARNINGS_MAX || !diagnostics->warning ||
      fault == SCENE_FAULT_WARPED)
    return;
  char text[256];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  diagnostics->warning(diagnostics->user,
                       diagnostics->file != NULL ? diagnostics->file : "", line,
                       text);
}

void diagnostics_warn(const struct diagnostics *diagnostics, const char *file,
                      const char *format, ...) {
  if (diagnostics == NULL || diagnostics->warning == NULL)
    return;
  char text[256];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  diagnostics->warning(diagnostics->user, file, 0, text);
}

void diagnostics_finish(struct diagnostics *diagnostics) {
  if (diagnostics == NULL)
    return;
  for (int i = 0; i < SCENE_FAULT_COUNT; i++) {
    unsigned long count = diagnostics->count[i] - diagnostics->settled[i];
    diagnostics->settled[i] = diagnostics->count[i];
    if (count <= WARNINGS_MAX || !diagnostics->warning ||
        i == SCENE_FAULT_WARPED)
      continue;
    char text[128];
    snprintf(text, sizeof text, "... and %lu more with %s",
             count - WARNINGS_MAX, fault_text((enum scene_fault)i));
    diagnostics->warning(diagnostics->user,
                         diagnostics->file != NULL ? diagnostics->file : "", 0,
                         text);
  }
}

recto_status diagnostics_poll_now(struct diagnostics *diagnostics,
                                  const char *at, recto_error *error) {
  enum { STEP = 1 << 18 };
  diagnostics->poll_at = at + STEP;
  if (diagnostics->byte_count > 0)
    poll_set_share(((double)diagnostics->bytes_before +
                    (double)(at - diagnostics->bytes)) /
                   (double)diagnostics->byte_count);
  return poll_now() ? RECTO_OK : error_cancelled(error);
}
