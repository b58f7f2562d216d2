/* progress.h - reports progress to the caller, and learns of cancellation.
 *
 * Progress is polled once per amount of work, not once per edge or window,
 * because one of these may take minutes. */
#ifndef VISIBILITY_PROGRESS_H
#define VISIBILITY_PROGRESS_H

#include "visibility/solver.h"

enum {
  /* Units of work between two calls of the caller's progress function.  A unit
   * takes from a few nanoseconds to a microsecond: the comparison of two boxes,
   * or that of a pair in exact numbers. */
  PROGRESS_WORK = 1 << 17,
  PROGRESS_LINE = PROGRESS_WORK / 64, /* units that a scan line counts as */
  PROGRESS_PIXELS = 8                 /* pixels filled that count as one unit */
};

struct progress {
  const struct solver_request *request; /* NULL: never polled */
  const char *stage; /* name of the current stage, as the caller sees it */
  double share;      /* of the work of this stage that is done, 0 to 1 */
  int64_t work_left; /* units until the next poll */
  bool cancelled;    /* the caller cancelled; it is not polled any more */
};

static inline struct progress progress_of(const struct solver_request *request,
                                          const char *stage) {
  return (struct progress){.request = request, .stage = stage};
}

/* Calls the caller's progress function now.  Returns false when the caller
 * cancels. */
bool progress_poll(struct progress *progress);

/* Counts units of work, done or about to be done, and polls when enough have
 * accumulated.
 * progress  NULL: never polled
 * Returns false when the caller cancelled. */
static inline bool progress_step(struct progress *progress, size_t work) {
  if (progress == NULL)
    return true;
  progress->work_left -= (int64_t)work;
  return progress->work_left > 0 ? !progress->cancelled
                                 : progress_poll(progress);
}

/* The same, and sets the share: `done` items of `all`. */
static inline bool progress_step_at(struct progress *progress, size_t work,
                                    size_t done, size_t all) {
  progress->share = all > 0 ? (double)done / (double)all : 0;
  return progress_step(progress, work);
}

/* Sets and returns the error that ended the work: RECTO_ERROR_CANCELLED where
 * the caller cancelled, else RECTO_ERROR_MEMORY.
 * progress  NULL: never polled, so memory ran out */
recto_status progress_error(const struct progress *progress,
                            recto_error *error);

#endif
