/* poll.c - the poll of each thread. */
#include "base/poll.h"

#include "base/thread_pool.h"

static _Thread_local struct poll *current;        /* NULL: none is open */
static _Thread_local const atomic_bool *followed; /* NULL: none is */

void poll_open(struct poll *poll, const recto_options *options) {
  *poll =
      (struct poll){.options = options, .to = 1, .stage = "", .outer = current};
  current = poll;
}

void poll_close(struct poll *poll) {
  current = poll->outer;
  thread_pool_end(poll->pool);
}

void poll_follow(const atomic_bool *ended) { followed = ended; }

const recto_options *poll_options(void) {
  return current != NULL ? current->options : NULL;
}

struct thread_pool **poll_pool(void) {
  return current != NULL ? &current->pool : NULL;
}

bool poll_is_cancelled(void) { return current != NULL && current->cancelled; }

/* The caller's function may call the library, whose work there is not this
 * call's. */
bool poll_now(void) {
  struct poll *poll = current;
  if (followed != NULL && atomic_load(followed))
    return false;
  if (poll == NULL || poll->cancelled || poll->options->progress == NULL)
    return !poll_is_cancelled();
  current = NULL;
  poll->cancelled =
      !poll->options->progress(poll->options->user, poll->share, poll->stage);
  current = poll;
  return !poll->cancelled;
}

void poll_set_share(double share) {
  if (current == NULL)
    return;
  double whole = current->from + share * (current->to - current->from);
  if (whole > current->share)
    current->share = whole;
}

bool poll_share(double share, const char *stage) {
  poll_set_share(share);
  if (current != NULL && stage != NULL)
    current->stage = stage;
  return poll_now();
}

bool poll_stage(double from, double to, const char *stage) {
  if (current != NULL) {
    current->from = from;
    current->to = to;
  }
  return poll_share(0, stage);
}
