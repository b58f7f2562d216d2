/* test_sort.c - sorting is right and stable, and lists and sets are what was
 * put in. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/memory.h"
#include "base/number_filter.h"
#include "base/number_lists.h"
#include "base/poll.h"
#include "base/ranked_set.h"
#include "base/sort.h"
#include "tests/memory_faults.h"
#include "tests/scenes/random.h"

/* ---- Keys ---------------------------------------------------------------- */

/* Each value is the item's place before sorting. */
static void assert_sorted_stably(const struct sort_key *item, size_t count) {
  for (size_t i = 1; i < count; i++) {
    assert_true(item[i - 1].key <= item[i].key);
    if (item[i - 1].key == item[i].key)
      assert_true(item[i - 1].value < item[i].value);
  }
}

/* Sorts `count` random keys under a mask, and checks that they are the same
 * ones afterwards. */
static void sort_random_keys(struct random *random, size_t count,
                             uint64_t mask) {
  struct sort_key *item = calloc(count + 1, sizeof *item);
  struct sort_key *scratch = calloc(count + 1, sizeof *scratch);
  uint64_t *key = calloc(count + 1, sizeof *key);
  assert_true(item != NULL && scratch != NULL && key != NULL);
  for (size_t i = 0; i < count; i++) {
    key[i] = random_next(random) & mask;
    item[i] = (struct sort_key){key[i], (uint32_t)i};
  }
  scratch[count].value = item[count].value = 12345; /* not ours to touch */
  sort_keys(item, scratch, count);
  assert_int_equal(item[count].value, 12345);
  assert_int_equal(scratch[count].value, 12345);
  assert_sorted_stably(item, count);
  for (size_t i = 0; i < count; i++) {
    assert_true(item[i].value < count);
    assert_true(item[i].key == key[item[i].value]);
  }
  free(item);
  free(scratch);
  free(key);
}

static void keys_are_sorted_stably_at_every_size(void **state) {
  (void)state;
  static const uint64_t masks[] = {
      UINT64_MAX, 0, 1, 7, 0x7ff, 0x800, 0xffffffff, UINT64_C(1) << 63,
      UINT64_C(0xfff0000000000000), UINT64_C(0x8000000000000001),
      /* long runs agree in the upper bits */
      UINT64_C(0xf0000000000fffff), UINT64_C(0xff0000000fffffff)};
  enum { MASKS = sizeof masks / sizeof *masks };
  struct random random = {1};
  for (size_t count = 0; count < 140; count++)
    sort_random_keys(&random, count, masks[count % MASKS]);
  for (size_t i = 0; i < MASKS; i++) {
    sort_random_keys(&random, 1023, masks[i]);
    sort_random_keys(&random, 1024, masks[i]);
    sort_random_keys(&random, 3000, masks[i]);
    sort_random_keys(&random, 20001, masks[i]);
  }
}

static void several_threads_sort_stably(void **state) {
  (void)state;
  struct random random = {5};
  struct poll poll;
  recto_options options;
  recto_options_init(&options);
  options.solver.threads = 2;
  poll_open(&poll, &options);
  sort_random_keys(&random, 300001, UINT64_MAX);
  sort_random_keys(&random, 200003, 0xfff0);
  sort_random_keys(&random, 200003, UINT64_C(0xf0000000000fffff));
  poll_close(&poll);
}

static void sorted_and_reversed_keys_are_sorted(void **state) {
  (void)state;
  enum { COUNT = 5000 };
  static struct sort_key item[COUNT], scratch[COUNT];
  for (uint32_t i = 0; i < COUNT; i++)
    item[i] = (struct sort_key){COUNT - i, i};
  sort_keys(item, scratch, COUNT);
  for (uint32_t i = 0; i < COUNT; i++)
    assert_int_equal(item[i].value, COUNT - 1 - i);
  sort_keys(item, scratch, COUNT);
  for (uint32_t i = 0; i < COUNT; i++)
    assert_int_equal(item[i].value, COUNT - 1 - i);
}

static void keys_of_signed_numbers_keep_their_order(void **state) {
  (void)state;
  static const int64_t number[] = {INT64_MIN, INT64_MIN + 1, -5, -1, 0, 1,
                                   5,         INT64_MAX};
  for (size_t i = 1; i < sizeof number / sizeof *number; i++)
    assert_true(sort_key_of_int64(number[i - 1]) <
                sort_key_of_int64(number[i]));
}

/* ---- Merging ------------------------------------------------------------- */

struct record {
  int key;
  uint32_t place;
  char rest[12];
};

/* Compares keys in the direction that `user` points to. */
static int compare_records(const void *a, const void *b, void *user) {
  const struct record *left = a, *right = b;
  int direction = *(const int *)user;
  return direction * ((left->key > right->key) - (left->key < right->key));
}

static void sort_random_records(struct random *random, uint32_t count, int keys,
                                int direction) {
  struct record *item = calloc(count + 1, sizeof *item);
  assert_non_null(item);
  for (uint32_t i = 0; i < count; i++)
    item[i] = (struct record){random_int(random, 0, keys), i, "rest"};
  assert_true(
      sort_stable(item, count, sizeof *item, compare_records, &direction));
  for (uint32_t i = 0; i < count; i++) {
    assert_string_equal(item[i].rest, "rest");
    if (i == 0)
      continue;
    int order = compare_records(&item[i - 1], &item[i], &direction);
    assert_true(order < 0 || (order == 0 && item[i - 1].place < item[i].place));
  }
  free(item);
}

static void records_are_sorted_stably_at_every_size(void **state) {
  (void)state;
  struct random random = {2};
  for (uint32_t count = 0; count < 200; count++)
    sort_random_records(&random, count, 5 + (int)count / 2, count % 2 ? 1 : -1);
  sort_random_records(&random, 20000, 100, 1);
  sort_random_records(&random, 16384, 1000000, -1);
}

static void without_memory_nothing_is_sorted(void **state) {
  (void)state;
  struct record item[3] = {{3, 0, ""}, {1, 1, ""}, {2, 2, ""}};
  struct record before[3];
  int direction = 1;
  memcpy(before, item, sizeof item);
  mem_fail_after(1);
  assert_false(sort_stable(item, 3, sizeof *item, compare_records, &direction));
  mem_fail_after(0);
  assert_memory_equal(item, before, sizeof item);
  assert_true(sort_stable(item, 0, sizeof *item, compare_records, &direction));
  assert_true(sort_stable(NULL, 0, sizeof *item, compare_records, &direction));
}

/* ---- Lower bounds -------------------------------------------------------- */

static void lower_bounds_are_where_a_linear_search_ends(void **state) {
  (void)state;
  static const int sorted[] = {1, 3, 3, 3, 5, 8, 8, 9};
  for (size_t low = 0; low <= 8; low++)
    for (size_t high = low; high <= 8; high++)
      for (int key = 0; key <= 10; key++) {
        size_t found, expected = low;
        LOWER_BOUND(found, low, high, sorted[found] < key);
        while (expected < high && sorted[expected] < key)
          expected++;
        assert_int_equal(found, expected);
      }
}

/* ---- Lists of numbers ---------------------------------------------------- */

/* Lists 0 to `lists` - 1 by the remainders of the squares of 0 to `count` - 1,
 * which leaves some lists empty. */
static bool list_squares(struct number_lists *made, uint32_t lists,
                         uint32_t count) {
  if (!number_lists_init(made, lists))
    return false;
  for (uint32_t i = 0; i < count; i++)
    number_lists_put(made, i * i % lists, i);
  if (!number_lists_allocate(made, lists))
    return false;
  for (uint32_t i = count; i-- > 0;)
    number_lists_put(made, i * i % lists, i);
  return true;
}

static void a_list_has_its_numbers_in_reverse_of_the_second_pass(void **state) {
  (void)state;
  for (uint32_t lists = 1; lists <= 7; lists++)
    for (uint32_t count = 0; count <= 20; count++) {
      struct number_lists made;
      assert_true(list_squares(&made, lists, count));
      assert_int_equal(made.start[0], 0);
      assert_int_equal(made.start[lists], count);
      for (uint32_t k = 0; k < lists; k++) {
        uint32_t at = made.start[k];
        for (uint32_t i = 0; i < count; i++)
          if (i * i % lists == k)
            assert_int_equal(made.item[at++], i);
        assert_int_equal(at, made.start[k + 1]);
      }
      number_lists_fini(&made);
    }
}

static void lists_of_numbers_report_that_memory_ran_out(void **state) {
  (void)state;
  struct memory_faults faults = {.least = 2};
  while (memory_faults_go_on(&faults)) {
    struct number_lists made;
    memory_faults_begin(&faults);
    memory_faults_end(&faults, memory_faults_status(list_squares(&made, 3, 9)));
    number_lists_fini(&made);
  }
}

static void four_billion_numbers_are_refused(void **state) {
  (void)state;
  struct number_lists made;
  assert_true(number_lists_init(&made, 2));
  made.start[0] = made.start[1] = UINT32_C(1) << 31;
  assert_false(number_lists_allocate(&made, 2));
  number_lists_fini(&made);
}

/* As list_squares, of a range. */
static void put_squares(void *user, struct number_lists *lists,
                        struct parallel_range range) {
  const uint32_t *count = user;
  for (size_t i = range.end; i-- > range.begin;)
    number_lists_put(lists, i * i % *count, (uint32_t)i);
}

static void lists_do_not_depend_on_their_parts(void **state) {
  (void)state;
  for (uint32_t lists = 1; lists <= 7; lists += 3)
    for (uint32_t count = 0; count <= 40; count += 5)
      for (int workers = 1; workers <= 20; workers++) {
        struct number_lists expected, made;
        assert_true(list_squares(&expected, lists, count));
        assert_true(number_lists_make(&made, lists, workers, count, put_squares,
                                      &lists));
        assert_memory_equal(made.start, expected.start,
                            (lists + 1) * sizeof *made.start);
        if (count > 0)
          assert_memory_equal(made.item, expected.item,
                              count * sizeof *made.item);
        number_lists_fini(&expected);
        number_lists_fini(&made);
      }
}

static void parts_of_lists_report_that_memory_ran_out(void **state) {
  (void)state;
  struct memory_faults faults = {.least = 4};
  while (memory_faults_go_on(&faults)) {
    struct number_lists made;
    uint32_t lists = 3;
    memory_faults_begin(&faults);
    memory_faults_end(&faults, memory_faults_status(number_lists_make(
                                   &made, 3, 3, 9, put_squares, &lists)));
    number_lists_fini(&made);
  }
}

/* ---- Filters of numbers -------------------------------------------------- */

static size_t keep_multiples(const void *user, struct parallel_range range,
                             uint32_t *kept) {
  const size_t *of = user;
  size_t count = 0;
  for (size_t i = range.begin; i < range.end; i++)
    if (i % *of == 0)
      kept[count++] = (uint32_t)i;
  return count;
}

static void a_filter_keeps_the_same_numbers_by_several_threads(void **state) {
  (void)state;
  struct poll poll;
  recto_options options;
  recto_options_init(&options);
  for (size_t of = 1; of < 50000; of *= 7)
    for (size_t count = 0; count < 200000; count += 40001) {
      size_t kept;
      options.solver.threads = count % 2 == 0 ? 1 : 2;
      poll_open(&poll, &options);
      uint32_t *number = number_filter(count, keep_multiples, &of, &kept);
      poll_close(&poll);
      assert_non_null(number);
      assert_int_equal(kept, (count + of - 1) / of);
      for (size_t i = 0; i < kept; i++)
        assert_int_equal(number[i], i * of);
      mem_free(number);
    }
}

static void a_filter_reports_that_memory_ran_out(void **state) {
  (void)state;
  struct memory_faults faults = {.least = 2};
  while (memory_faults_go_on(&faults)) {
    size_t of = 3, kept;
    memory_faults_begin(&faults);
    uint32_t *number = number_filter(10, keep_multiples, &of, &kept);
    memory_faults_end(&faults, memory_faults_status(number != NULL));
    mem_free(number);
  }
}

/* ---- Ranked sets --------------------------------------------------------- */

/* The squares below a bound, of which some words of the set have none. */
static bool rank_squares(struct ranked_set *set, uint32_t bound) {
  if (!ranked_set_init(set, bound))
    return false;
  for (uint32_t i = 0; i * i < bound; i++)
    ranked_set_add(set, i * i);
  ranked_set_index(set);
  return true;
}

static void a_place_is_the_number_of_lower_members(void **state) {
  (void)state;
  for (uint32_t bound = 1; bound <= 1000; bound += 37) {
    struct ranked_set set;
    uint32_t root = 0;
    assert_true(rank_squares(&set, bound));
    for (uint32_t n = 0; n < bound; n++) {
      assert_int_equal(ranked_set_rank(&set, n), root);
      assert_int_equal(ranked_set_has(&set, n), root * root == n);
      root += root * root == n;
    }
    assert_int_equal(set.count, root);
    ranked_set_fini(&set);
  }
}

static void a_ranked_set_reports_that_memory_ran_out(void **state) {
  (void)state;
  struct memory_faults faults = {.least = 2};
  while (memory_faults_go_on(&faults)) {
    struct ranked_set set;
    memory_faults_begin(&faults);
    memory_faults_end(&faults, memory_faults_status(rank_squares(&set, 100)));
    ranked_set_fini(&set);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(keys_are_sorted_stably_at_every_size),
      cmocka_unit_test(several_threads_sort_stably),
      cmocka_unit_test(sorted_and_reversed_keys_are_sorted),
      cmocka_unit_test(keys_of_signed_numbers_keep_their_order),
      cmocka_unit_test(records_are_sorted_stably_at_every_size),
      cmocka_unit_test(lower_bounds_are_where_a_linear_search_ends),
      cmocka_unit_test(without_memory_nothing_is_sorted),
      cmocka_unit_test(a_list_has_its_numbers_in_reverse_of_the_second_pass),
      cmocka_unit_test(lists_of_numbers_report_that_memory_ran_out),
      cmocka_unit_test(four_billion_numbers_are_refused),
      cmocka_unit_test(lists_do_not_depend_on_their_parts),
      cmocka_unit_test(parts_of_lists_report_that_memory_ran_out),
      cmocka_unit_test(a_filter_keeps_the_same_numbers_by_several_threads),
      cmocka_unit_test(a_filter_reports_that_memory_ran_out),
      cmocka_unit_test(a_place_is_the_number_of_lower_members),
      cmocka_unit_test(a_ranked_set_reports_that_memory_ran_out),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
