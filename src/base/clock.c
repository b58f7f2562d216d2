/* clock.c - the time that has passed. */
#include "base/clock.h"

#include <time.h>

static double read_clock(clockid_t id) {
  struct timespec now;
  if (clock_gettime(id, &now) != 0)
    return 0;
  return (double)now.tv_sec + (double)now.tv_nsec / 1e9;
}

double clock_cpu(void) { return read_clock(CLOCK_PROCESS_CPUTIME_ID); }

double clock_wall(void) { return read_clock(CLOCK_MONOTONIC); }
