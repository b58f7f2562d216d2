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
