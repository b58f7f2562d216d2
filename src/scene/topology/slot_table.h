/* slot_table.h - which of many items share a hash with another.
 *
 * A slot is two bits, which are set once a first and once a second item is in
 * it, 32 slots in a word.  So it does not depend on the order in which threads
 * enter items. */
#ifndef SCENE_TOPOLOGY_SLOT_TABLE_H
#define SCENE_TOPOLOGY_SLOT_TABLE_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/memory.h"

struct slot_table {
  _Atomic uint64_t *word;
  int bits;
  bool is_alone; /* one thread enters items */
};

/* So many items pass between the fetch of a slot and its use: most slots are
 * not in the cache. */
enum { SLOT_TABLE_AHEAD = 32 };

/* Makes a table with so many slots, or up to twice as many, and no more than
 * 2^31, which are all empty.
 * workers  threads that enter items
 * Returns false when memory ran out. */
USE_RESULT bool slot_table_init(struct slot_table *table, size_t slots,
                                int workers);
void slot_table_fini(struct slot_table *table);

static inline void slot_table_fetch(const struct slot_table *table,
                                    size_t slot) {
  MEM_PREFETCH((const void *)&table->word[slot / 32]);
}

/* The slot of a hash, by its upper bits, which is fetched. */
static inline size_t slot_table_find(const struct slot_table *table,
                                     uint64_t hash) {
  size_t slot = (size_t)(hash >> (64 - table->bits));
  slot_table_fetch(table, slot);
  return slot;
}

static inline void slot_table_enter(const struct slot_table *table,
                                    size_t slot) {
  _Atomic uint64_t *word = &table->word[slot / 32];
  uint64_t first = UINT64_C(1) << slot % 32 * 2;
  uint64_t is = atomic_load_explicit(word, memory_order_relaxed);
  if (table->is_alone) {
    is |= (is & first) << 1 | first;
    atomic_store_explicit(word, is, memory_order_relaxed);
  } else if ((is & first << 1) == 0) {
    is = atomic_fetch_or_explicit(word, first, memory_order_relaxed);
    if (is & first)
      (void)atomic_fetch_or_explicit(word, first << 1, memory_order_relaxed);
  }
}

/* Whether two items or more are in a slot. */
static inline bool slot_table_is_shared(const struct slot_table *table,
                                        size_t slot) {
  return atomic_load_explicit(&table->word[slot / 32], memory_order_relaxed) >>
             slot % 32 * 2 &
         2;
}

#endif
