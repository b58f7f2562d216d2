/* poll.c - the poll of each thread. */
#include "base/poll.h"

static _Thread_local struct poll *current; /* NULL: none is open */

void poll_open(struct poll *poll, const recto_options *options) {
  *poll =
      (struct poll){.options = options, .to = 1, .stage = "", .outer = current};
  current = poll;
}

void poll_close(struct poll *poll) { current = poll->outer; }

const recto_options *poll_options(void) {
  return current != NULL ? current->options : NULL;
}

bool poll_is_cancelled(void) { return current != NULL && current->cancelled; }

/* The caller's function may call the library, whose work there is not this
 * call's. */
bool poll_now(void) {
  struct poll *poll = current;
  if (poll == NULL || poll->cancelled || poll->options->progress == NULL)
    return !poll_is_cancelled();
  current = NULL;
  poll->cancelled =
      !poll->options->progress(poll->options->user, poll->share, poll->stage);
  current = poll;
  return !poll->cancelled;
}

bool poll_share(double share, const char *stage) {
  struct poll *poll = current;
  if (poll == NULL)
    return true;
  double whole = poll->from + share * (poll->to - poll->from);
  if (whole > poll->share)
    poll->share = whole;
  if (stage != NULL)
    poll->stage = stage;
  return poll_now();
}

bool poll_stage(double from, double to, const char *stage) {
  if (current != NULL) {
    current->from = from;
    current->to = to;
  }
  return poll_share(0, stage);
}
