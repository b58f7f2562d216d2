/* slot_table.c - makes and frees tables of slots. */
#include "scene/topology/slot_table.h"

bool slot_table_init(struct slot_table *table, size_t slots, int workers) {
  enum { BITS_LEAST = 10, BITS_MOST = 31, SLOTS_IN_WORD_BITS = 5 };
  *table = (struct slot_table){.bits = BITS_LEAST, .is_alone = workers == 1};
  while (table->bits < BITS_MOST && slots >> table->bits)
    table->bits++;
  table->word = mem_calloc((size_t)1 << (table->bits - SLOTS_IN_WORD_BITS),
                           sizeof *table->word);
  return table->word != NULL;
}

void slot_table_fini(struct slot_table *table) {
  mem_free((void *)table->word);
  table->word = NULL;
}
