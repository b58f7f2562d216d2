/* union_find.h - items that are joined, one by one, to disjoint sets. */
#ifndef BASE_UNION_FIND_H
#define BASE_UNION_FIND_H

#include "base/memory.h"

/* Every item a set of its own: item i is at i; NULL when memory ran out.  To
 * be freed with mem_free. */
static inline uint32_t *union_find_create(size_t count) {
  uint32_t *sets = mem_alloc(count, sizeof *sets);
  for (size_t i = 0; sets != NULL && i < count; i++)
    sets[i] = (uint32_t)i;
  return sets;
}

/* The lowest item of the set, its representative: so no set depends on the
 * order of joining. */
static inline uint32_t union_find_root(uint32_t *sets, uint32_t i) {
  while (sets[i] != i) {
    sets[i] = sets[sets[i]];
    i = sets[i];
  }
  return i;
}

static inline void union_find_join(uint32_t *sets, uint32_t a, uint32_t b) {
  /* Most are joined already, and are near their representative. */
  if (sets[a] == sets[b])
    return;
  a = union_find_root(sets, a);
  b = union_find_root(sets, b);
  sets[a > b ? a : b] = a > b ? b : a;
}

#endif
