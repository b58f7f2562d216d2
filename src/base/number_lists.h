/* number_lists.h - lists of numbers, one after the other in one block, made
 * by a counting sort. */
#ifndef BASE_NUMBER_LISTS_H
#define BASE_NUMBER_LISTS_H

#include <stddef.h>
#include <stdint.h>

#include "base/parallel.h"
#include "base/status.h"

/* List k is item[start[k]] to before item[start[k + 1]].
 *
 * They are made in two passes over the same numbers: after number_lists_init
 * each is put into its list to be counted and, after number_lists_allocate,
 * once more to be stored.  A list has its numbers in the reverse of the order
 * in which the second pass puts them. */
struct number_lists {
  uint32_t *start, *item;
};

/* Returns false when memory ran out. */
USE_RESULT bool number_lists_init(struct number_lists *lists, size_t count);

/* Between the passes.  Returns false when memory ran out, or where there are
 * 2^32 numbers or more. */
USE_RESULT bool number_lists_allocate(struct number_lists *lists, size_t count);

/* Zero-initialised is empty, and so is what this leaves. */
void number_lists_fini(struct number_lists *lists);

static inline void number_lists_put(struct number_lists *lists, size_t list,
                                    uint32_t number) {
  uint32_t *end = &lists->start[list];
  if (lists->item != NULL)
    lists->item[--*end] = number;
  else
    ++*end;
}

/* ---- By several threads -------------------------------------------------- */

/* Puts what is of a range of the numbers, from its last to its first. */
typedef void number_lists_task(void *user, struct number_lists *lists,
                               struct parallel_range range);

/* Makes lists with both passes over `numbers` numbers divided among threads:
 * each counts and stores a part of them, by starts of its own of four bytes a
 * list.  A list has the numbers of the first part first, so that its order does
 * not depend on the parts.
 * lists    uninitialised
 * workers  as from parallel_workers
 * Returns false when memory ran out, or the caller cancelled. */
USE_RESULT bool number_lists_make(struct number_lists *lists, size_t count,
                                  int workers, size_t numbers,
                                  number_lists_task *task, void *user);

#endif
