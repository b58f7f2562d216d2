/* ranked_set.h - a set of some of many numbers, as a bit vector, with the rank
 * of each, in less than two bits for each of the many. */
#ifndef BASE_RANKED_SET_H
#define BASE_RANKED_SET_H

#include <string.h>

#include "base/memory.h"

struct ranked_set {
  uint64_t *word;   /* a bit a number: it is in the set; NULL: none is */
  uint32_t *before; /* one a word: how many numbers are in those before it */
  size_t words;
  uint32_t count; /* of numbers in the set, once ranks are indexed */
};

/* An empty set of numbers below `numbers`.  Returns false when memory ran
 * out; to be freed all the same. */
USE_RESULT static inline bool ranked_set_init(struct ranked_set *set,
                                              size_t numbers) {
  set->words = numbers / 64 + 1;
  set->count = 0;
  set->word = mem_calloc(set->words, sizeof *set->word);
  set->before = mem_alloc(set->words, sizeof *set->before);
  return set->word != NULL && set->before != NULL;
}

static inline void ranked_set_fini(struct ranked_set *set) {
  mem_free(set->word);
  mem_free(set->before);
}

static inline void ranked_set_clear(struct ranked_set *set) {
  memset(set->word, 0, set->words * sizeof *set->word);
}

static inline void ranked_set_add(struct ranked_set *set, uint32_t number) {
  set->word[number / 64] |= UINT64_C(1) << number % 64;
}

/* Prepares queries of ranks, when all numbers have been added. */
static inline void ranked_set_index(struct ranked_set *set) {
  set->count = 0;
  for (size_t w = 0; w < set->words; w++) {
    set->before[w] = set->count;
    if (set->word[w] != 0)
      set->count += (uint32_t)__builtin_popcountll(set->word[w]);
  }
}

static inline bool ranked_set_has(const struct ranked_set *set,
                                  uint32_t number) {
  return (set->word[number / 64] >> number % 64 & 1) != 0;
}

/* The rank of a number: how many lower ones are in the set. */
static inline uint32_t ranked_set_rank(const struct ranked_set *set,
                                       uint32_t number) {
  uint64_t lower = (UINT64_C(1) << number % 64) - 1;
  return set->before[number / 64] +
         (uint32_t)__builtin_popcountll(set->word[number / 64] & lower);
}

#endif
