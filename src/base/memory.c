/* memory.c - checked allocation, growing arrays, and an arena. */
#include "base/memory.h"

#include <stdalign.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

/* For tests alone: see mem_fail_after. */
static atomic_ulong allocations_to_failure;

/* Whether this allocation is the one that a test makes fail. */
static bool is_made_to_fail(void) {
  unsigned long left =
      atomic_load_explicit(&allocations_to_failure, memory_order_relaxed);
  while (left > 0)
    if (atomic_compare_exchange_weak(&allocations_to_failure, &left, left - 1))
      return left == 1;
  return false;
}

void mem_fail_after(unsigned long n) {
  atomic_store(&allocations_to_failure, n);
}

/* The size of a block; false where it does not fit.  Never zero, so that an
 * empty array has an address of its own. */
static bool block_size(size_t count, size_t size, size_t *bytes) {
  if (size && count > PTRDIFF_MAX / size)
    return false;
  *bytes = count * size;
  if (*bytes == 0)
    *bytes = 1;
  return true;
}

#ifdef MADV_HUGEPAGE
/* The least bytes of a block for which large pages are requested: of one that
 * is a mapping of its own, and of one of the heap. */
enum { LARGE_MAPPING = 1 << 22, LARGE_IN_HEAP = 1 << 17 };

/* The same for a block of the heap: for all that the heap has grown by since
 * the last request, as the mapping goes on past the block.  What comes later
 * there is not written to yet. */
static void request_of_heap(uintptr_t start, uintptr_t end,
                            uintptr_t heap_end) {
  static _Atomic uintptr_t requested;
  uintptr_t from = atomic_load_explicit(&requested, memory_order_relaxed);
  if (end <= from)
    return;
  if (from == 0)
    from = start;
  (void)madvise((void *)from, heap_end - from, MADV_HUGEPAGE);
  atomic_store_explicit(&requested, heap_end, memory_order_relaxed);
}
#endif

/* Requests that the system hold a large block in large pages: of the time of a
 * drawing of a million triangles an eighth went into the faults of small ones
 * (doc/decisions/0080).  The request is for whole small pages, all that the
 * block has a part of, so that it is for all of a mapping that malloc made for
 * this block alone: one of which only a part is in large pages cannot be
 * resized in place.  Where the system has no large pages, nothing changes. */
static void *request_large_pages(void *block, size_t bytes) {
#ifdef MADV_HUGEPAGE
  if (block == NULL || bytes < LARGE_IN_HEAP)
    return block;
  uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE),
            start = (uintptr_t)block & ~(page - 1),
            end = (uintptr_t)block + bytes, heap_end = (uintptr_t)sbrk(0);
  if (start < heap_end)
    request_of_heap(start, end, heap_end);
  else if (bytes >= LARGE_MAPPING)
    (void)madvise((void *)start, end - start, MADV_HUGEPAGE);
#else
  (void)bytes;
#endif
  return block;
}

void *mem_alloc(size_t count, size_t size) {
  size_t bytes;
  if (is_made_to_fail() || !block_size(count, size, &bytes))
    return NULL;
  return request_large_pages(malloc(bytes), bytes);
}

void *mem_calloc(size_t count, size_t size) {
  size_t bytes;
  if (is_made_to_fail() || !block_size(count, size, &bytes))
    return NULL;
  return request_large_pages(calloc(bytes, 1), bytes);
}

void *mem_resize(void *block, size_t count, size_t size) {
  size_t bytes;
  if (is_made_to_fail() || !block_size(count, size, &bytes))
    return NULL;
  return request_large_pages(realloc(block, bytes), bytes);
}

void mem_free(void *block) { free(block); }

size_t mem_peak_bytes(void) {
  struct rusage usage;
  if (getrusage(RUSAGE_SELF, &usage) != 0 || usage.ru_maxrss < 0)
    return 0;
#ifdef __APPLE__
  return (size_t)usage.ru_maxrss;
#else
  return (size_t)usage.ru_maxrss * 1024;
#endif
}

char *mem_copy_text(const char *text) {
  size_t size = strlen(text) + 1;
  char *copy = mem_alloc(size, 1);
  if (copy != NULL)
    memcpy(copy, text, size);
  return copy;
}

/* ---- Growing arrays ------------------------------------------------------ */

/* Doubling keeps appending linear; the pages not yet written to cost no
 * memory, and the system moves large blocks without copying them. */
bool array_grow(void **item, size_t *capacity, size_t count, size_t extra,
                size_t size) {
  enum { SMALLEST = 16 };
  if (extra > SIZE_MAX - count)
    return false;
  size_t wanted = count + extra;
  size_t doubled = *capacity <= SIZE_MAX / 2 ? 2 * *capacity : wanted;
  if (wanted < doubled)
    wanted = doubled;
  if (wanted < SMALLEST)
    wanted = SMALLEST;
  void *grown = mem_resize(*item, wanted, size);
  if (grown == NULL)
    return false;
  *item = grown;
  *capacity = wanted;
  return true;
}

void array_trim(void **item, size_t *capacity, size_t count, size_t size) {
  void *trimmed =
      count > 0 && count < *capacity ? mem_resize(*item, count, size) : NULL;
  if (trimmed == NULL)
    return;
  *item = trimmed;
  *capacity = count;
}

/* ---- Arena --------------------------------------------------------------- */

struct arena_block {
  struct arena_block *next; /* older */
  size_t size;              /* bytes that follow */
  alignas(max_align_t) unsigned char bytes[];
};

enum { ARENA_BLOCK_SIZE = 1 << 16 };

static size_t align_size(size_t bytes) {
  return (bytes + alignof(max_align_t) - 1) & ~(alignof(max_align_t) - 1);
}

void *arena_alloc(struct arena *arena, size_t count, size_t size) {
  size_t bytes;
  if (!block_size(count, size, &bytes) || bytes > PTRDIFF_MAX / 2)
    return NULL;
  bytes = align_size(bytes);
  struct arena_block *block = arena->block;
  if (block == NULL || bytes > block->size - arena->used) {
    size_t capacity = block != NULL ? 2 * block->size : ARENA_BLOCK_SIZE;
    if (capacity < bytes)
      capacity = bytes;
    block = mem_alloc(sizeof *block + capacity, 1);
    if (block == NULL)
      return NULL;
    block->next = arena->block;
    block->size = capacity;
    arena->block = block;
    arena->used = 0;
  }
  void *start = block->bytes + arena->used;
  arena->used += bytes;
  return start;
}

void arena_reset(struct arena *arena) {
  /* Blocks of one arena only ever grow, so the newest is the largest. */
  struct arena_block *newest = arena->block;
  if (newest != NULL) {
    struct arena_block *older = newest->next;
    while (older != NULL) {
      struct arena_block *next = older->next;
      mem_free(older);
      older = next;
    }
    newest->next = NULL;
  }
  arena->used = 0;
}

void arena_fini(struct arena *arena) {
  arena_reset(arena);
  mem_free(arena->block);
  arena->block = NULL;
}

void arena_adopt(struct arena *arena, struct arena *other) {
  struct arena_block **last = &arena->block;
  if (arena->block == NULL)
    arena->used = other->used;
  while (*last != NULL)
    last = &(*last)->next;
  *last = other->block;
  *other = (struct arena){0};
}
