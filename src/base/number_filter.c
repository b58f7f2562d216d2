/* number_filter.c - the numbers of a range that a test keeps, found by several
 * threads. */
#include "base/number_filter.h"

#include "base/memory.h"

struct filtering {
  number_filter_task *task;
  const void *user;
  uint32_t *number; /* room for all */
  size_t *kept;     /* per range */
};

static bool filter_range(void *user, struct parallel_range range) {
  const struct filtering *f = user;
  f->kept[range.begin / PARALLEL_ITEMS] =
      f->task(f->user, range, f->number + range.begin);
  return true;
}

uint32_t *number_filter(size_t count, number_filter_task *task,
                        const void *user, size_t *kept) {
  size_t ranges = parallel_range_count(count, PARALLEL_ITEMS);
  struct filtering f = {
      .task = task,
      .user = user,
      .number = mem_alloc(count, sizeof *f.number),
      .kept = mem_alloc(ranges, sizeof *f.kept),
  };
  bool ok = f.number != NULL && f.kept != NULL &&
            parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                            PARALLEL_ITEMS, filter_range, &f);
  if (ok) {
    *kept = parallel_gather(f.number, sizeof *f.number, count, PARALLEL_ITEMS,
                            f.kept);
  } else {
    mem_free(f.number);
    f.number = NULL;
  }
  mem_free(f.kept);
  return f.number;
}
