/* memory.h - checked allocation, growing arrays, and an arena. */
#ifndef BASE_MEMORY_H
#define BASE_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

#include "base/status.h"

/* ---- Checked allocation -------------------------------------------------
 * count * size is checked for overflow.  All return NULL on failure; a zero
 * count gives a valid pointer. */
void *mem_alloc(size_t count, size_t size);
void *mem_calloc(size_t count, size_t size);
/* On failure the old block stays valid. */
void *mem_resize(void *block, size_t count, size_t size);
void mem_free(void *block);
char *mem_copy_text(const char *text);

/* Fetches into the cache what will be read soon. */
#if defined __GNUC__
#define MEM_PREFETCH(address) __builtin_prefetch(address)
#else
#define MEM_PREFETCH(address) ((void)(address))
#endif
#define MEM_PREFETCH_AHEAD 16 /* elements between a prefetch and the use */

/* Of a function that does no more: compilers remove calls of one that they have
 * not inlined before. */
#if defined(__GNUC__)
#define MEM_PREFETCH_INLINE static inline __attribute__((always_inline))
#else
#define MEM_PREFETCH_INLINE static inline
#endif

/* For tests: the n-th allocation from now (1-based) fails, once; 0 switches
 * this off. */
void mem_fail_after(unsigned long n);

/* How many bytes the process has held at most (the system's own figure for
 * the resident set, bytes; 0 where it is not known). */
size_t mem_peak_bytes(void);

/* ---- Growing arrays -----------------------------------------------------
 * struct { T *item; size_t count, capacity; }: ARRAY(T) declares one,
 * zero-initialised is empty. */
#define ARRAY(T)                                                               \
  struct {                                                                     \
    T *item;                                                                   \
    size_t count, capacity;                                                    \
  }

/* Makes room for `extra` more items.  False when memory ran out: the array is
 * as it was. */
#define ARRAY_RESERVE(array, extra)                                            \
  ((extra) <= (array)->capacity - (array)->count                               \
       ? true                                                                  \
       : array_grow((void **)&(array)->item, &(array)->capacity,               \
                    (array)->count, (extra), sizeof *(array)->item))

/* Appends a value: false when memory ran out. */
#define ARRAY_PUSH(array, value)                                               \
  (ARRAY_RESERVE(array, 1) ? ((array)->item[(array)->count++] = (value), true) \
                           : false)

/* The array of bytes that one function makes for another. */
struct byte_array {
  char *item;
  size_t count, capacity;
};

/* Gives back room for more items than there are; keeps it where that fails. */
#define ARRAY_TRIM(array)                                                      \
  array_trim((void **)&(array)->item, &(array)->capacity, (array)->count,      \
             sizeof *(array)->item)

#define ARRAY_FREE(array)                                                      \
  do {                                                                         \
    mem_free((array)->item);                                                   \
    (array)->item = NULL;                                                      \
    (array)->count = (array)->capacity = 0;                                    \
  } while (0)

/* The address of item `index`, up to one past the last; NULL where there is no
 * block yet: the sum of NULL and 0 is undefined in C. */
#define ARRAY_AT(array, index)                                                 \
  ((array)->item != NULL ? (array)->item + (index) : NULL)

USE_RESULT bool array_grow(void **item, size_t *capacity, size_t count,
                           size_t extra, size_t size);
void array_trim(void **item, size_t *capacity, size_t count, size_t size);

/* ---- Arena: many small blocks, freed at once ----------------------------- */
struct arena {
  struct arena_block *block; /* newest first */
  size_t used;               /* bytes of the newest block */
};

/* Zero-initialised is empty.  Blocks are aligned for any type; NULL when
 * memory ran out. */
void *arena_alloc(struct arena *arena, size_t count, size_t size);
/* Keeps the memory's largest block, and drops what was in it. */
void arena_reset(struct arena *arena);
void arena_fini(struct arena *arena);
/* Moves all blocks of another arena, which is empty then, to this one: they are
 * freed with it. */
void arena_adopt(struct arena *arena, struct arena *other);

#endif
