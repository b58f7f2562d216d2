/* progress.c - polls by the work of a method. */
#include "visibility/progress.h"

#include <string.h>

#include "base/poll.h"

/* The share of all work of the method that is done. */
static double share_of_method(const struct progress *progress) {
  static const struct {
    const char *name;
    double from, to, to_with_fragments;
  } known[] = {
      {"intersections", 0, 0.15, 0.1},
      {"ordering", 0.15, 0.92, 0.6},
      {"visibility", 0.2, 1, 0.9},
      {"subdividing", 0.2, 1, 0.9},
      {"painting", 0.2, 1, 0.9},
      {"edges", 0.15, 1, 0.4},
      {"faces", 0.4, 1, 1},
  };
  for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
    if (strcmp(progress->stage, known[i].name) == 0) {
      double to =
          progress->fragments ? known[i].to_with_fragments : known[i].to;
      return known[i].from + progress->share * (to - known[i].from);
    }
  return progress->share;
}

/* Once the caller has cancelled, no work is left and each step polls. */
bool progress_poll(struct progress *progress) {
  bool ok = poll_share(share_of_method(progress), progress->stage);
  progress->work_left = ok ? PROGRESS_WORK : 0;
  return ok;
}
