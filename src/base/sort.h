/* sort.h - stable sorting, so that equal keys never change the output. */
#ifndef BASE_SORT_H
#define BASE_SORT_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

struct sort_key {
  uint64_t key;
  uint32_t value;
};

/* Sorts by key, equal keys in their given order (radix, 11 bits a pass,
 * passes in which all keys agree are skipped).  `scratch` holds as many. */
void sort_keys(struct sort_key *item, struct sort_key *scratch, size_t count);

/* Stable merge sort of `count` items of `size` bytes by compare(a, b, user),
 * which returns <0, 0 or >0.  False when memory ran out. */
USE_RESULT bool sort_stable(void *item, size_t count, size_t size,
                            int (*compare)(const void *, const void *, void *),
                            void *user);

/* Unsigned keys that order as the numbers do. */
static inline uint64_t sort_key_of_int64(int64_t value) {
  return (uint64_t)value ^ (UINT64_C(1) << 63);
}

#endif
