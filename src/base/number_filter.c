/* number_filter.c - the numbers of a range that a test keeps, found by several
 * threads.
 *
 * Each worker appends what its ranges keep to an array of its own, so that the
 * memory follows the numbers that are kept; those of one worker are in order,
 * those of several are put in order at the end. */
#include "base/number_filter.h"

#include <string.h>

#include "base/memory.h"

/* What a worker keeps. */
struct kept_numbers {
  ARRAY(uint32_t) number;
  char apart[PARALLEL_APART];
};

/* What a range keeps: in its worker's array. */
struct kept_range {
  int worker;
  size_t first, count;
};

struct filtering {
  number_filter_task *task;
  const void *user;
  struct kept_numbers *worker;
  struct kept_range *range;
};

static bool filter_range(void *user, struct parallel_range range) {
  const struct filtering *f = user;
  struct kept_numbers *own = &f->worker[range.worker];
  if (!ARRAY_RESERVE(&own->number, range.end - range.begin))
    return false;
  size_t first = own->number.count,
         count = f->task(f->user, range, own->number.item + first);
  own->number.count += count;
  f->range[range.begin / PARALLEL_ITEMS] =
      (struct kept_range){range.worker, first, count};
  return true;
}

/* Puts what several workers keep in order. */
static uint32_t *order_numbers(const struct filtering *f, size_t ranges,
                               size_t kept) {
  uint32_t *number = mem_alloc(kept, sizeof *number), *to = number;
  for (size_t r = 0; number != NULL && r < ranges; r++) {
    const struct kept_range *range = &f->range[r];
    if (range->count > 0)
      memcpy(to, f->worker[range->worker].number.item + range->first,
             range->count * sizeof *to);
    to += range->count;
  }
  return number;
}

/* Gives the array of the only worker. */
static uint32_t *take_numbers(struct kept_numbers *only) {
  uint32_t *number = only->number.item;
  if (number == NULL)
    return mem_alloc(0, sizeof *number);
  only->number.item = NULL;
  return number;
}

uint32_t *number_filter(size_t count, number_filter_task *task,
                        const void *user, size_t *kept) {
  size_t ranges = parallel_range_count(count, PARALLEL_ITEMS), sum = 0;
  int workers = parallel_workers(count, PARALLEL_ITEMS);
  struct filtering f = {
      .task = task,
      .user = user,
      .worker = mem_calloc((size_t)workers, sizeof *f.worker),
      .range = mem_alloc(ranges, sizeof *f.range),
  };
  uint32_t *number = NULL;
  bool ok = f.worker != NULL && f.range != NULL &&
            parallel_ranges(workers, count, PARALLEL_ITEMS, filter_range, &f);
  for (int w = 0; f.worker != NULL && w < workers; w++) {
    ARRAY_TRIM(&f.worker[w].number);
    sum += f.worker[w].number.count;
  }
  if (ok)
    number = workers == 1 ? take_numbers(&f.worker[0])
                          : order_numbers(&f, ranges, sum);
  *kept = sum;
  for (int w = 0; f.worker != NULL && w < workers; w++)
    ARRAY_FREE(&f.worker[w].number);
  mem_free(f.worker);
  mem_free(f.range);
  return number;
}
