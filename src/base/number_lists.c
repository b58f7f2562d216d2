/* number_lists.c - lists of numbers, one after the other in one block, made
 * by a counting sort. */
#include "base/number_lists.h"

#include "base/memory.h"

bool number_lists_init(struct number_lists *lists, size_t count) {
  lists->item = NULL;
  lists->start = mem_calloc(count + 1, sizeof *lists->start);
  return lists->start != NULL;
}

bool number_lists_allocate(struct number_lists *lists, size_t count) {
  uint64_t sum = 0;
  for (size_t k = 0; k <= count; k++) {
    sum += lists->start[k];
    lists->start[k] = (uint32_t)sum;
  }
  if (sum <= UINT32_MAX)
    lists->item = mem_alloc(sum, sizeof *lists->item);
  return lists->item != NULL;
}

void number_lists_fini(struct number_lists *lists) {
  mem_free(lists->start);
  mem_free(lists->item);
  lists->start = lists->item = NULL;
}

/* ---- By several threads -------------------------------------------------- */

/* The most parts: adding up the starts of all parts is left to one thread. */
enum { PARTS_MAX = 8 };

struct making {
  number_lists_task *task;
  void *user;
  size_t items; /* of the numbers, in a part */
  struct number_lists part[PARTS_MAX];
};

static bool put_part(void *user, struct parallel_range range) {
  struct making *making = user;
  making->task(making->user, &making->part[range.begin / making->items], range);
  return true;
}

/* Replaces the counts of the parts by the ends of their numbers in the lists.
 * Returns how many numbers there are. */
static uint64_t sum_parts(struct making *making, size_t parts, size_t count) {
  uint64_t sum = 0;
  for (size_t k = 0; k <= count; k++)
    for (size_t p = 0; p < parts; p++) {
      sum += making->part[p].start[k];
      making->part[p].start[k] = (uint32_t)sum;
    }
  return sum;
}

static bool allocate_parts(struct making *making, size_t parts, size_t count) {
  uint64_t sum = sum_parts(making, parts, count);
  uint32_t *item =
      sum <= UINT32_MAX ? mem_alloc(sum, sizeof *making->part[0].item) : NULL;
  for (size_t p = 0; p < parts; p++)
    making->part[p].item = item;
  return item != NULL;
}

bool number_lists_make(struct number_lists *lists, size_t count, int workers,
                       size_t numbers, number_lists_task *task, void *user) {
  struct making making = {.task = task, .user = user};
  size_t parts = workers < PARTS_MAX ? (size_t)workers : PARTS_MAX, made = 0;
  making.items = numbers / parts + 1;
  while (made < parts && number_lists_init(&making.part[made], count))
    made++;
  bool ok =
      made == parts &&
      parallel_ranges(workers, numbers, making.items, put_part, &making) &&
      allocate_parts(&making, parts, count) &&
      parallel_ranges(workers, numbers, making.items, put_part, &making);
  for (size_t p = 1; p < parts; p++)
    mem_free(making.part[p].start);
  *lists = making.part[0];
  return ok;
}
