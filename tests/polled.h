/* polled.h - work of one layer, polled as a call of the library is. */
#ifndef TESTS_POLLED_H
#define TESTS_POLLED_H

#include "base/poll.h"

struct polled {
  recto_options options;
  struct poll poll;
};

/* Until polled_end the work of this thread asks that function. */
static inline void polled_begin(struct polled *polled,
                                recto_progress_fn progress, void *user) {
  polled->options = (recto_options){.progress = progress, .user = user};
  poll_open(&polled->poll, &polled->options);
}

static inline void polled_end(struct polled *polled) {
  poll_close(&polled->poll);
}

#endif
