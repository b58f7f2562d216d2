/* heap.c - what the program's heap keeps.
 *
 * A drawing of a million triangles makes some hundred large blocks, one after
 * another.  By the C library's own rules many are mappings of their own, which
 * are given back when they are freed, so that the next one is cleared by the
 * system anew, and begin and end in small pages.
 */
#include "cli/heap.h"

#include <limits.h>
#include <stdlib.h>

#ifdef __GLIBC__
#include <malloc.h>
#include <stdbool.h>
#include <sys/resource.h>

/* Sizes in bytes. */
enum {
  /* Larger blocks stay mappings of their own where the heap has no room: these
   * grow without being copied. */
  HEAP_BLOCK = 20 << 20,
  /* What the heap grows by, besides what was asked for. */
  HEAP_STEP = 32 << 20
};

/* Whether this process may allocate far more than a step. */
static bool may_grow_far(void) {
  struct rlimit data, all;
  return getrlimit(RLIMIT_DATA, &data) == 0 &&
         getrlimit(RLIMIT_AS, &all) == 0 && data.rlim_cur / 32 >= HEAP_STEP &&
         all.rlim_cur / 32 >= HEAP_STEP;
}

void heap_keep_blocks(void) {
  if (may_grow_far() && mallopt(M_MMAP_THRESHOLD, HEAP_BLOCK) &&
      mallopt(M_TOP_PAD, HEAP_STEP))
    (void)mallopt(M_TRIM_THRESHOLD, INT_MAX);
}
#else
void heap_keep_blocks(void) {}
#endif
