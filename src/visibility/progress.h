/* progress.h - polls (base/poll.h) by the work of a method.
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
  bool fragments;    /* the method makes them too, after the edges */
  const char *stage; /* name of the current stage, as the caller sees it */
  double share;      /* of the work of this stage that is done, 0 to 1 */
  int64_t work_left; /* units until the next poll */
};

static inline struct progress progress_of(const struct solver_request *request,
                                          const char *stage) {
  return (struct progress){.fragments = request->fragments, .stage = stage};
}

/* Polls now.  Returns false when the caller cancelled. */
bool progress_poll(struct progress *progress);

/* Counts units of work, done or about to be done, and polls when enough have
 * accumulated.
 * progress  NULL: never polled
 * Returns false when the caller cancelled. */
static inline bool progress_step(struct progress *progress, size_t work) {
  if (progress == NULL)
    return true;
  progress->work_left -= (int64_t)work;
  return progress->work_left > 0 || progress_poll(progress);
}

/* The same, and sets the share: `done` items of `all`. */
static inline bool progress_step_at(struct progress *progress, size_t work,
                                    size_t done, size_t all) {
  progress->share = all > 0 ? (double)done / (double)all : 0;
  return progress_step(progress, work);
}

#endif
