/* progress.h - asks the caller whether to go on, after so much work, not after so
 * many edges or windows: one of them may take minutes. */
#ifndef VISIBILITY_PROGRESS_H
#define VISIBILITY_PROGRESS_H

#include "visibility/solver.h"

/* Units of work between two questions.  A unit takes from a few nanoseconds to
 * a microsecond: a pair of boxes, or a pair in exact numbers. */
enum { PROGRESS_WORK = 1 << 17, PROGRESS_PIXELS = 8 /* in a unit */ };

struct progress {
  const struct solver_request *request; /* NULL: nobody is asked */
  const char *stage;
  double share;   /* of the work of the stages that were named, done */
  int64_t left;   /* work before the next question */
  bool cancelled; /* the caller wants no more, and is asked no more */
};

static inline struct progress progress_of(const struct solver_request *request,
                                          const char *stage) {
  return (struct progress){.request = request, .stage = stage};
}

/* Asks now; false: the caller wants no more. */
bool progress_poll(struct progress *progress);

/* Notes that work was done, or is to be done at once; false where the caller
 * wants no more.
 * pulse  NULL: nobody is asked */
static inline bool progress_step(struct progress *progress, size_t work) {
  if (progress == NULL)
    return true;
  progress->left -= (int64_t)work;
  return progress->left > 0 ? !progress->cancelled : progress_poll(progress);
}

/* The same, `done` of `all` being done. */
static inline bool progress_step_at(struct progress *progress, size_t work,
                                    size_t done, size_t all) {
  progress->share = all > 0 ? (double)done / (double)all : 0;
  return progress_step(progress, work);
}

/* What ended the work: RECTO_ERROR_CANCELLED, or _MEMORY.
 * pulse  NULL: nobody was asked */
recto_status progress_error(const struct progress *progress,
                            recto_error *error);

#endif
