/* parallel_read.c - bytes of a regular file, read by several threads. */
#include "base/parallel_read.h"

#include <unistd.h>

#include "base/memory.h"
#include "base/parallel.h"

struct parallel_reading {
  int descriptor;
  off_t from;
  char *to;
  size_t *got; /* of each part */
};

/* Ends where anything is wrong. */
static bool read_part(void *user, struct parallel_range range) {
  const struct parallel_reading *reading = user;
  size_t at = range.begin;
  ssize_t got = 1;
  for (; at < range.end && got > 0; at += got > 0 ? (size_t)got : 0)
    got = pread(reading->descriptor, reading->to + at, range.end - at,
                reading->from + (off_t)at);
  reading->got[range.begin / PARALLEL_READ_PART] = at - range.begin;
  return true;
}

bool parallel_read_is_worth(size_t count) {
  return parallel_workers(count, PARALLEL_READ_PART) > 1;
}

size_t parallel_read(int descriptor, off_t from, char *to, size_t count) {
  size_t parts = parallel_range_count(count, PARALLEL_READ_PART), sum = 0;
  size_t *got = mem_calloc(parts, sizeof *got);
  if (got == NULL)
    return 0;
  struct parallel_reading reading = {descriptor, from, to, got};
  (void)parallel_ranges(parallel_workers(count, PARALLEL_READ_PART), count,
                        PARALLEL_READ_PART, read_part, &reading);
  for (size_t i = 0; i < parts && sum == i * PARALLEL_READ_PART; i++)
    sum += got[i];
  mem_free(got);
  return sum;
}
