/* test_memory.c - allocations are checked, arrays grow, arenas align. */
#include <setjmp.h>
#include <stdalign.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/memory.h"
#include "base/sanitizer.h"
#include "tests/valgrind.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

typedef ARRAY(int) int_array;

/* ---- Allocation ---------------------------------------------------------- */

static void a_size_that_overflows_is_refused(void **state) {
  (void)state;
  size_t half = SIZE_MAX / 2 + 1;
  assert_null(mem_alloc(half, 2));
  assert_null(mem_calloc(half, 2));
  assert_null(mem_alloc(SIZE_MAX, 1));
  assert_null(mem_alloc(SIZE_MAX / 8, 16));
  char *block = mem_alloc(4, 1);
  assert_non_null(block);
  memcpy(block, "abc", 4);
  assert_null(mem_resize(block, half, 2));
  assert_string_equal(block, "abc");
  mem_free(block);
}

static void nothing_has_an_address_too(void **state) {
  (void)state;
  void *a = mem_alloc(0, 8), *b = mem_calloc(8, 0), *c = mem_alloc(0, 0);
  assert_non_null(a);
  assert_non_null(b);
  assert_non_null(c);
  c = mem_resize(c, 0, 4);
  assert_non_null(c);
  mem_free(a);
  mem_free(b);
  mem_free(c);
  mem_free(NULL);
}

static void cleared_memory_is_clear(void **state) {
  (void)state;
  unsigned char *block = mem_calloc(1000, 3);
  assert_non_null(block);
  for (int i = 0; i < 3000; i++)
    assert_int_equal(block[i], 0);
  mem_free(block);
}

#ifdef __GLIBC__
/* Whether large pages were requested for the mapping that has an address; -1:
 * the system does not say. */
static int has_large_pages(const void *at) {
  FILE *file = fopen("/proc/self/smaps", "re");
  char line[512];
  bool is_here = false;
  int found = -1;
  while (file != NULL && found < 0 && fgets(line, sizeof line, file) != NULL) {
    unsigned long long from, end;
    if (sscanf(line, "%llx-%llx ", &from, &end) == 2)
      is_here = from <= (uintptr_t)at && (uintptr_t)at < end;
    else if (is_here && strncmp(line, "VmFlags:", 8) == 0)
      found = strstr(line, " hg") != NULL;
  }
  if (file != NULL)
    fclose(file);
  return found;
}
#endif

/* Blocks of the heap follow each other in one mapping; what comes after one of
 * them will be the next one's. */
static void blocks_of_the_heap_are_in_large_pages(void **state) {
  (void)state;
#ifdef __GLIBC__
  enum { MB = 1 << 20, COUNT = 8 };
  char *block[COUNT];
  FILE *file = fopen("/sys/kernel/mm/transparent_hugepage/enabled", "re");
  if (file == NULL || is_under_valgrind() || SANITIZER_OF_ADDRESSES ||
      SANITIZER_OF_THREADS)
    skip();
  fclose(file);
  assert_true(mallopt(M_MMAP_THRESHOLD, 64 * MB) &&
              mallopt(M_TOP_PAD, 32 * MB));
  for (int i = 0; i < COUNT; i++) {
    block[i] = mem_alloc(MB, 1);
    assert_non_null(block[i]);
    assert_int_not_equal(has_large_pages(block[i] + MB - 1), 0);
    assert_int_not_equal(has_large_pages(block[i] + 4 * MB), 0);
  }
  for (int i = 0; i < COUNT; i++)
    mem_free(block[i]);
#else
  skip();
#endif
}

static void the_nth_allocation_fails_and_no_other(void **state) {
  (void)state;
  mem_fail_after(3);
  void *a = mem_alloc(1, 1), *b = mem_calloc(1, 1);
  assert_non_null(a);
  assert_non_null(b);
  assert_null(mem_resize(a, 2, 1));
  a = mem_resize(a, 2, 1);
  assert_non_null(a);
  mem_fail_after(1);
  mem_fail_after(0);
  void *c = mem_alloc(1, 1);
  assert_non_null(c);
  mem_free(a);
  mem_free(b);
  mem_free(c);
}

static void the_peak_rises_with_what_is_held(void **state) {
  (void)state;
  if (mem_peak_bytes() == 0)
    skip();
  size_t before = mem_peak_bytes(), size = (size_t)64 << 20;
  char *block = mem_alloc(size, 1);
  assert_non_null(block);
  for (size_t i = 0; i < size; i += 4096)
    ((volatile char *)block)[i] = 1;
  mem_free(block);
  assert_true(mem_peak_bytes() >= before);
  assert_true(mem_peak_bytes() >= size);
}

/* ---- Arrays -------------------------------------------------------------- */

static void an_array_keeps_what_was_pushed(void **state) {
  (void)state;
  int_array array = {0};
  for (int i = 0; i < 100000; i++)
    assert_true(ARRAY_PUSH(&array, 3 * i));
  assert_int_equal(array.count, 100000);
  assert_true(array.capacity >= array.count);
  for (int i = 0; i < 100000; i++)
    assert_int_equal(array.item[i], 3 * i);
  ARRAY_FREE(&array);
  assert_null(array.item);
  assert_int_equal(array.count, 0);
  assert_int_equal(array.capacity, 0);
}

static void room_that_was_reserved_is_not_moved(void **state) {
  (void)state;
  int_array array = {0};
  assert_true(ARRAY_RESERVE(&array, 1000));
  const int *item = array.item;
  mem_fail_after(1);
  for (int i = 0; i < 1000; i++)
    assert_true(ARRAY_PUSH(&array, i));
  mem_fail_after(0);
  assert_ptr_equal(array.item, item);
  ARRAY_FREE(&array);
}

static void growing_takes_few_steps(void **state) {
  (void)state;
  int_array array = {0};
  int steps = 0;
  size_t capacity = 0;
  for (int i = 0; i < 1 << 20; i++) {
    assert_true(ARRAY_PUSH(&array, i));
    steps += array.capacity != capacity;
    capacity = array.capacity;
  }
  assert_true(steps <= 20);
  ARRAY_FREE(&array);
}

static void an_array_that_cannot_grow_is_as_it_was(void **state) {
  (void)state;
  int_array array = {0};
  for (int i = 0; i < 16; i++)
    assert_true(ARRAY_PUSH(&array, i));
  int_array before = array;
  assert_int_equal(array.count, array.capacity);
  mem_fail_after(1);
  bool pushed = ARRAY_PUSH(&array, 16);
  assert_false(pushed);
  assert_false(ARRAY_RESERVE(&array, SIZE_MAX));
  assert_false(ARRAY_RESERVE(&array, SIZE_MAX / 2));
  assert_false(ARRAY_RESERVE(&array, SIZE_MAX / sizeof(int)));
  assert_memory_equal(&array, &before, sizeof array);
  for (int i = 0; i < 16; i++)
    assert_int_equal(array.item[i], i);
  ARRAY_FREE(&array);
}

/* ---- Arena --------------------------------------------------------------- */

static void arena_blocks_are_aligned_and_apart(void **state) {
  (void)state;
  enum { COUNT = 5000 };
  struct arena arena = {0};
  unsigned char *block[COUNT];
  for (size_t i = 0; i < COUNT; i++) {
    size_t size = i % 97;
    block[i] = arena_alloc(&arena, size, 1);
    assert_non_null(block[i]);
    assert_int_equal((uintptr_t)block[i] % alignof(max_align_t), 0);
    memset(block[i], (int)(i % 251), size);
  }
  for (size_t i = 0; i < COUNT; i++)
    for (size_t k = 0; k < i % 97; k++)
      assert_int_equal(block[i][k], i % 251);
  arena_fini(&arena);
  assert_null(arena.block);
}

static void an_arena_takes_blocks_of_any_size(void **state) {
  (void)state;
  struct arena arena = {0};
  char *small = arena_alloc(&arena, 3, 1);
  char *large = arena_alloc(&arena, 1 << 20, 8);
  char *after = arena_alloc(&arena, 3, 1);
  assert_non_null(small);
  assert_non_null(large);
  assert_non_null(after);
  memcpy(small, "ab", 3);
  memset(large, 'x', (size_t)8 << 20);
  memcpy(after, "cd", 3);
  assert_string_equal(small, "ab");
  assert_null(arena_alloc(&arena, SIZE_MAX, 1));
  assert_null(arena_alloc(&arena, SIZE_MAX / 2, 4));
  assert_null(arena_alloc(&arena, SIZE_MAX - 8, 1));
  assert_string_equal(after, "cd");
  arena_fini(&arena);
}

static void a_reset_arena_needs_no_more_memory(void **state) {
  (void)state;
  struct arena arena = {0};
  for (int i = 0; i < 10000; i++)
    assert_non_null(arena_alloc(&arena, 100, 1));
  arena_reset(&arena);
  mem_fail_after(1);
  for (int i = 0; i < 1000; i++)
    assert_non_null(arena_alloc(&arena, 100, 1));
  mem_fail_after(0);
  arena_fini(&arena);
}

static void an_arena_without_memory_still_ends(void **state) {
  (void)state;
  struct arena arena = {0};
  mem_fail_after(1);
  assert_null(arena_alloc(&arena, 1, 1));
  assert_non_null(arena_alloc(&arena, 1, 1));
  mem_fail_after(1);
  assert_null(arena_alloc(&arena, 1, 1 << 20));
  assert_non_null(arena_alloc(&arena, 1, 1));
  mem_fail_after(0);
  arena_fini(&arena);
  arena_fini(&arena);
  arena_reset(&arena);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_size_that_overflows_is_refused),
      cmocka_unit_test(nothing_has_an_address_too),
      cmocka_unit_test(cleared_memory_is_clear),
      cmocka_unit_test(blocks_of_the_heap_are_in_large_pages),
      cmocka_unit_test(the_nth_allocation_fails_and_no_other),
      cmocka_unit_test(the_peak_rises_with_what_is_held),
      cmocka_unit_test(an_array_keeps_what_was_pushed),
      cmocka_unit_test(room_that_was_reserved_is_not_moved),
      cmocka_unit_test(growing_takes_few_steps),
      cmocka_unit_test(an_array_that_cannot_grow_is_as_it_was),
      cmocka_unit_test(arena_blocks_are_aligned_and_apart),
      cmocka_unit_test(an_arena_takes_blocks_of_any_size),
      cmocka_unit_test(a_reset_arena_needs_no_more_memory),
      cmocka_unit_test(an_arena_without_memory_still_ends),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
