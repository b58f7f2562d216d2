/* poll.h - calls the caller's progress function from work of any layer, which
 * may cancel it.
 *
 * A call of the library that may last opens a poll, which is its thread's until
 * it is closed.  Work for that call in that thread polls without having it
 * passed down.  Polls in threads that the library starts do not call the
 * caller's function, but are false once the work there is to end.  Once the
 * caller has cancelled, every poll is false without a call: work ends as it
 * does where memory runs out, and error_memory says which of the two it was
 * (doc/decisions/0033). */
#ifndef BASE_POLL_H
#define BASE_POLL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#include "recto.h"

/* Items of a loop between two polls, which take a millisecond as a rule. */
enum { POLL_ITEMS = 1 << 13 };

struct thread_pool;

struct poll {
  const recto_options *options; /* its progress function and user */
  double from, to; /* of the whole work: shares where the stage begins, ends */
  double share;    /* as reported last; never falls */
  const char *stage;
  bool cancelled;
  struct thread_pool *pool; /* for its loops; NULL: none was needed yet */
  struct poll *outer;       /* of the call within which this one was made */
};

/* Makes `poll` the thread's own, until poll_close; as if one stage were all. */
void poll_open(struct poll *poll, const recto_options *options);
void poll_close(struct poll *poll);

/* Begins a stage, and polls. */
bool poll_stage(double from, double to, const char *stage);

/* Sets the share of the stage that is done, 0 to 1, for the polls to come. */
void poll_set_share(double share);

/* Polls, with a share of the stage that is done.
 * stage  its name from now on; NULL: as it was */
bool poll_share(double share, const char *stage);

/* Polls.  False: cancelled; true also where there is no poll. */
bool poll_now(void);

/* Polls in a loop over many items, at one of POLL_ITEMS of them. */
static inline bool poll_at(size_t index) {
  return index % POLL_ITEMS != 0 || poll_now();
}

bool poll_is_cancelled(void);

/* Lets all polls of this thread, which the library started, be false once
 * *ended is true; NULL: no longer. */
void poll_follow(const atomic_bool *ended);

/* The options of the call that this thread works for; NULL: it does not. */
const recto_options *poll_options(void);

/* The threads that are kept for loops of that call; NULL: there is no call. */
struct thread_pool **poll_pool(void);

#endif
