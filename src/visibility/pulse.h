/* pulse.h - asks the caller whether to go on, after so much work, not after so
 * many edges or windows: one of them may take minutes. */
#ifndef VISIBILITY_PULSE_H
#define VISIBILITY_PULSE_H

#include "visibility/solver.h"

/* Units of work between two questions.  A unit takes from a few nanoseconds to
 * a microsecond: a pair of boxes, or a pair in exact numbers. */
enum { PULSE_WORK = 1 << 17, PULSE_PIXELS = 8 /* in a unit */ };

struct pulse {
  const struct solver_request *request; /* NULL: nobody is asked */
  const char *stage;
  double share;   /* of the work of the stages that were named, done */
  int64_t left;   /* work before the next question */
  bool cancelled; /* the caller wants no more, and is asked no more */
};

static inline struct pulse pulse_of(const struct solver_request *request,
                                    const char *stage) {
  return (struct pulse){.request = request, .stage = stage};
}

/* Asks now; false: the caller wants no more. */
bool pulse_ask(struct pulse *pulse);

/* Notes that work was done, or is to be done at once; false where the caller
 * wants no more.
 * pulse  NULL: nobody is asked */
static inline bool pulse_beat(struct pulse *pulse, size_t work) {
  if (pulse == NULL)
    return true;
  pulse->left -= (int64_t)work;
  return pulse->left > 0 ? !pulse->cancelled : pulse_ask(pulse);
}

/* The same, `done` of `all` being done. */
static inline bool pulse_beat_at(struct pulse *pulse, size_t work, size_t done,
                                 size_t all) {
  pulse->share = all > 0 ? (double)done / (double)all : 0;
  return pulse_beat(pulse, work);
}

/* What ended the work: RECTO_ERROR_CANCELLED, or _MEMORY.
 * pulse  NULL: nobody was asked */
recto_status pulse_error(const struct pulse *pulse, recto_error *error);

#endif
