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

/* Sorts by key, equal keys in their given order (radix, 11 bits a pass, by as
 * many of the upper bits as tell most keys apart; passes in which all keys
 * agree are skipped).  `scratch` holds as many.  Large arrays are sorted by
 * several threads. */
void sort_keys(struct sort_key *item, struct sort_key *scratch, size_t count);

/* The same with scratch of its own.  False when memory ran out. */
USE_RESULT bool sort_keys_alone(struct sort_key *item, size_t count);

/* The same, and removes items whose key and value are those of the one before.
 * count  gets how many are left */
USE_RESULT bool sort_keys_unique(struct sort_key *item, size_t *count);

/* Stable merge sort of `count` items of `size` bytes by compare(a, b, user),
 * which returns <0, 0 or >0.  False when memory ran out. */
USE_RESULT bool sort_stable(void *item, size_t count, size_t size,
                            int (*compare)(const void *, const void *, void *),
                            void *user);

/* Sorts numbers in ascending order.  False when memory ran out. */
USE_RESULT bool sort_ids(uint32_t *id, size_t count);

/* <0, 0 or >0, as compare functions return. */
static inline int compare_numbers(uint32_t a, uint32_t b) {
  return (a > b) - (a < b);
}

/* Sets `i`, a size_t, to the first index from `low` to before `high` for which
 * the expression `is_below` of i is false, or to `high`: a lower bound in a
 * sorted array, by binary search. */
#define LOWER_BOUND(i, low, high, is_below)                                    \
  do {                                                                         \
    size_t first_ = (low), past_ = (high);                                     \
    while (first_ < past_) {                                                   \
      i = first_ + (past_ - first_) / 2;                                       \
      if (is_below)                                                            \
        first_ = i + 1;                                                        \
      else                                                                     \
        past_ = i;                                                             \
    }                                                                          \
    i = first_;                                                                \
  } while (0)

/* The key of two numbers in either order. */
static inline uint64_t sort_pair_key(uint32_t p, uint32_t q) {
  return p < q ? (uint64_t)p << 32 | q : (uint64_t)q << 32 | p;
}

/* Unsigned keys that order as the numbers do. */
static inline uint64_t sort_key_of_int64(int64_t value) {
  return (uint64_t)value ^ (UINT64_C(1) << 63);
}

#endif
