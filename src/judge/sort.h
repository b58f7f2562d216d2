/* sort.h - qsort that accepts an empty array. */
#ifndef JUDGE_SORT_H
#define JUDGE_SORT_H

#include <stdlib.h>

/* Sorts `count` items.  The C standard leaves qsort undefined for a null
 * pointer even where count is 0; here an empty array may be NULL. */
static inline void judge_sort(void *item, size_t count, size_t size,
                              int (*compare)(const void *, const void *)) {
  if (count > 1)
    qsort(item, count, size, compare);
}

#endif
