/* test_parallel.c - a loop is done by as many threads as can be had. */
#define _GNU_SOURCE /* RTLD_NEXT */
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "tests/sheet_fixture.h"
#include "visibility/solver.h"

/* ---- A system that starts no more threads -------------------------------- */

static int to_start = 10000; /* so many threads can still be had */
static int started;

typedef int creator(pthread_t *thread, const pthread_attr_t *attributes,
                    void *(*start)(void *), void *argument);

/* Stands before the system's own, for all of this program. */
int pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                   void *(*start)(void *), void *argument) {
  creator *real;
  *(void **)&real = dlsym(RTLD_NEXT, "pthread_create");
  if (to_start-- <= 0)
    return EAGAIN;
  started++;
  return real(thread, attributes, start, argument);
}

static int reset(void **state) {
  (void)state;
  to_start = 10000;
  started = 0;
  return 0;
}

/* ---- The loop ------------------------------------------------------------ */

enum { THINGS = 5000 };

struct work {
  atomic_size_t next;
  atomic_uchar done[THINGS];
  atomic_int workers, callers, awake; /* awake: with a signal not blocked */
};

static void do_some(void *user, bool callers) {
  struct work *work = user;
  sigset_t mask;
  size_t i;
  atomic_fetch_add(&work->workers, 1);
  atomic_fetch_add(&work->callers, callers);
  assert_int_equal(pthread_sigmask(SIG_SETMASK, NULL, &mask), 0);
  atomic_fetch_add(&work->awake, sigismember(&mask, SIGINT) == 0);
  while ((i = atomic_fetch_add(&work->next, 1)) < THINGS)
    atomic_fetch_add(&work->done[i], 1);
}

/* Runs the loop; how many threads took part. */
static int run(int threads) {
  static struct work work;
  memset((void *)&work, 0, sizeof work);
  parallel_run(threads, do_some, &work);
  for (size_t i = 0; i < THINGS; i++)
    assert_int_equal(work.done[i], 1);
  assert_int_equal(work.callers, 1);
  assert_int_equal(work.awake, 1); /* signals reach the caller's thread alone */
  return work.workers;
}

static void all_is_done_once_by_any_number_of_threads(void **state) {
  static const int threads[] = {-1, 0, 1, 2, 3, 16, 100};
  (void)state;
  for (size_t k = 0; k < sizeof threads / sizeof *threads; k++) {
    started = 0;
    assert_int_equal(run(threads[k]), threads[k] > 1 ? threads[k] : 1);
    assert_int_equal(started, threads[k] > 1 ? threads[k] - 1 : 0);
  }
}

static void one_thread_starts_no_other(void **state) {
  (void)state;
  to_start = 0;
  assert_int_equal(run(1), 1);
  assert_int_equal(to_start, 0); /* none was needed */
}

static void threads_that_cannot_start_are_done_without(void **state) {
  (void)state;
  for (int there = 0; there < 5; there++) {
    to_start = there;
    assert_int_equal(run(8), 1 + there);
  }
}

static void a_forked_process_has_threads_too(void **state) {
  int status;
  (void)state;
  assert_int_equal(run(3), 3);
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0)
    _exit(run(3) == 3 ? 0 : 1);
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

static void there_is_a_processor(void **state) {
  (void)state;
  assert_in_range(parallel_processors(), 1, 1024);
}

/* ---- Ranges -------------------------------------------------------------- */

enum { ITEMS = 1000000 };

struct items {
  atomic_uchar done[ITEMS];
  atomic_size_t count;
  atomic_int workers; /* the highest number of a worker, plus 1 */
  size_t fails_at;    /* the range that begins there fails */
};

static bool do_items(void *user, struct parallel_range range) {
  struct items *items = user;
  int known = atomic_load(&items->workers);
  assert_int_equal(range.begin % PARALLEL_ITEMS, 0);
  assert_true(range.end == ITEMS || range.end - range.begin == PARALLEL_ITEMS);
  while (
      known <= range.worker &&
      !atomic_compare_exchange_weak(&items->workers, &known, range.worker + 1))
    continue;
  for (size_t i = range.begin; i < range.end; i++)
    atomic_fetch_add(&items->done[i], 1);
  atomic_fetch_add(&items->count, range.end - range.begin);
  return range.begin != items->fails_at;
}

/* A host that cancels at its n-th call; 0: never. */
struct canceller {
  int calls, at;
};
static bool cancel_at(void *user, double share, const char *stage) {
  struct canceller *canceller = user;
  (void)share;
  (void)stage;
  return ++canceller->calls != canceller->at;
}

/* Does the items for a call with these options. */
static bool run_items(struct items *items, int threads,
                      struct canceller *canceller) {
  recto_options options;
  struct poll poll;
  recto_options_init(&options);
  options.solver.threads = threads;
  options.progress = cancel_at;
  options.user = canceller;
  poll_open(&poll, &options);
  int workers = parallel_workers(ITEMS, PARALLEL_ITEMS);
  bool ok = parallel_ranges(workers, ITEMS, PARALLEL_ITEMS, do_items, items);
  assert_true(items->workers <= workers);
  poll_close(&poll);
  return ok;
}

static void ranges_are_done_once_by_any_number_of_threads(void **state) {
  (void)state;
  for (int threads = 0; threads <= 4; threads++) {
    static struct items items;
    struct canceller never = {.at = 0};
    memset((void *)&items, 0, sizeof items);
    items.fails_at = ITEMS;
    assert_true(run_items(&items, threads, &never));
    for (size_t i = 0; i < ITEMS; i++)
      assert_int_equal(items.done[i], 1);
    assert_true(threads != 1 || never.calls == (int)parallel_range_count(
                                                   ITEMS, PARALLEL_ITEMS));
  }
}

static void a_range_that_fails_ends_the_others(void **state) {
  (void)state;
  for (int threads = 1; threads <= 2; threads++) {
    static struct items items;
    struct canceller never = {.at = 0};
    memset((void *)&items, 0, sizeof items);
    items.fails_at = 0;
    assert_false(run_items(&items, threads, &never));
    assert_true(threads > 1 || items.count == PARALLEL_ITEMS);
  }
}

static void ranges_are_cancelled(void **state) {
  (void)state;
  for (int threads = 1; threads <= 2; threads++) {
    static struct items items;
    struct canceller third = {.at = 3};
    memset((void *)&items, 0, sizeof items);
    items.fails_at = ITEMS;
    /* With two threads the other may do all but a few. */
    assert_true(!run_items(&items, threads, &third) || third.calls < 3);
    assert_true(threads > 1 || items.count == 2 * PARALLEL_ITEMS);
  }
}

/* What was allocated for so many workers must do, whatever the options say. */
static void there_are_no_more_workers_than_given(void **state) {
  static struct items items;
  struct poll poll;
  recto_options options;
  (void)state;
  recto_options_init(&options);
  for (int workers = 1; workers <= 3; workers++) {
    memset((void *)&items, 0, sizeof items);
    items.fails_at = ITEMS;
    started = 0;
    poll_open(&poll, &options);
    assert_true(
        parallel_ranges(workers, ITEMS, PARALLEL_ITEMS, do_items, &items));
    poll_close(&poll);
    assert_int_equal(started, workers - 1);
    assert_true(items.workers <= workers);
    assert_int_equal(items.count, ITEMS);
  }
}

/* ---- Threads of a call --------------------------------------------------- */

/* The same loop as `run`, within a call: threads that come too late for it are
 * not waited for. */
static void run_in_call(int threads) {
  static struct work work;
  memset((void *)&work, 0, sizeof work);
  parallel_run(threads, do_some, &work);
  for (size_t i = 0; i < THINGS; i++)
    assert_int_equal(work.done[i], 1);
  assert_int_equal(work.callers, 1);
  assert_int_equal(work.awake, 1);
  assert_in_range(work.workers, 1, threads);
}

static void threads_are_kept_until_the_call_ends(void **state) {
  static const int threads[] = {3, 3, 2, 5, 1, 3}, all[] = {2, 2, 2, 4, 4, 4};
  recto_options options;
  struct poll poll;
  (void)state;
  recto_options_init(&options);
  for (int call = 0; call < 2; call++) {
    started = 0;
    poll_open(&poll, &options);
    for (size_t k = 0; k < sizeof threads / sizeof *threads; k++) {
      run_in_call(threads[k]);
      assert_int_equal(started, all[k]);
    }
    poll_close(&poll);
  }
}

static void run_within(void *user, bool callers) {
  struct work *work = user;
  atomic_fetch_add(&work->workers, 1);
  if (callers)
    assert_int_equal(run(3), 3);
}

static void a_loop_within_a_loop_has_threads_of_its_own(void **state) {
  static struct work work;
  recto_options options;
  struct poll poll;
  (void)state;
  recto_options_init(&options);
  poll_open(&poll, &options);
  for (int k = 0; k < 3; k++)
    parallel_run(2, run_within, &work);
  poll_close(&poll);
  assert_int_equal(started, 1 + 3 * 2);
  assert_in_range(work.workers, 3, 6);
}

/* A host may fork in its progress function, and let the new process go on. */
static void a_process_forked_in_a_call_goes_on(void **state) {
  recto_options options;
  struct poll poll;
  int status;
  (void)state;
  recto_options_init(&options);
  poll_open(&poll, &options);
  run_in_call(3);
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    bool all = run(3) == 3;
    poll_close(&poll);
    _exit(all ? 0 : 1);
  }
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  run_in_call(3);
  poll_close(&poll);
  assert_int_equal(started, 2);
}

/* Which range each of some workers begins with; none goes on before all have
 * begun. */
enum { BEGINNERS = 3 };

struct beginnings {
  atomic_int begun;
  bool has[BEGINNERS];
  size_t first[BEGINNERS];
};

static bool note_first(void *user, struct parallel_range range) {
  struct beginnings *of = user;
  if (of->has[range.worker])
    return true;
  of->has[range.worker] = true;
  of->first[range.worker] = range.begin;
  atomic_fetch_add(&of->begun, 1);
  while (atomic_load(&of->begun) < BEGINNERS)
    (void)sched_yield();
  return true;
}

static void workers_begin_with_shares_or_in_order(void **state) {
  struct beginnings of = {.begun = 0}, up = {.begun = 0};
  (void)state;
  assert_true(parallel_ranges(BEGINNERS, 30, 1, note_first, &of));
  assert_true(parallel_ranges_ascending(BEGINNERS, 30, 1, note_first, &up));
  for (size_t w = 0; w < BEGINNERS; w++) {
    assert_int_equal(of.first[w], 10 * w);
    assert_in_range(up.first[w], 0, BEGINNERS - 1);
  }
}

static void few_items_and_no_call_have_one_worker(void **state) {
  static struct items items;
  struct poll poll;
  recto_options options;
  (void)state;
  recto_options_init(&options);
  options.solver.threads = 2;
  poll_open(&poll, &options);
  assert_int_equal(parallel_workers(PARALLEL_ITEMS, PARALLEL_ITEMS), 1);
  assert_int_equal(parallel_workers(ITEMS, PARALLEL_ITEMS),
                   parallel_processors() > 1 ? 2 : 1);
  poll_close(&poll);
  items.fails_at = ITEMS;
  assert_int_equal(parallel_workers(ITEMS, PARALLEL_ITEMS), 1);
  assert_true(parallel_ranges(1, ITEMS, PARALLEL_ITEMS, do_items, &items));
  assert_int_equal(items.workers, 1);
  assert_int_equal(items.count, ITEMS);
}

/* ---- The solver that has threads ----------------------------------------- */

static void solve(struct sheet_fixture *fixture, struct map *map, int threads,
                  recto_status expected) {
  const struct solver_request request = {
      .edges = true, .intersections = true, .threads = threads};
  struct report *report = report_create();
  recto_error error;
  assert_non_null(report);
  map_init(map);
  sheet_fixture_start(fixture);
  scenes_soup(&fixture->scene, &fixture->options, 1500, 3);
  sheet_fixture_out(fixture, true);
  assert_int_equal(
      solver_tiles.solve(&fixture->sheet, &request, map, report, &error),
      expected);
  mem_fail_after(0);
  report_destroy(report);
}

static void assert_same(const struct map *a, const struct map *b) {
  assert_int_equal(a->edge_count, b->edge_count);
  assert_memory_equal(a->edge_state, b->edge_state, a->edge_count);
  assert_int_equal(a->interval.count, b->interval.count);
  assert_memory_equal(a->interval.item, b->interval.item,
                      a->interval.count * sizeof *a->interval.item);
}

static void lines_do_not_depend_on_what_threads_there_are(void **state) {
  struct sheet_fixture fixture;
  struct map alone, map;
  (void)state;
  solve(&fixture, &alone, 1, RECTO_OK);
  sheet_fixture_fini(&fixture);
  assert_int_equal(started, 0);
  for (int there = 0; there < 3; there++) {
    to_start = 3 * there;
    started = 0;
    solve(&fixture, &map, 8, RECTO_OK);
    assert_int_equal(started, 3 * there);
    assert_same(&alone, &map);
    map_fini(&map);
    sheet_fixture_fini(&fixture);
  }
  map_fini(&alone);
}

static void what_ranges_keep_is_gathered_in_order(void **state) {
  int item[] = {1, 2, 0, 0, 0, 0, 3, 0, 0, 4, 5, 6, 7};
  const size_t kept[] = {2, 0, 1, 3, 1};
  (void)state;
  assert_int_equal(parallel_gather(item, sizeof *item, 13, 3, kept), 7);
  for (int i = 0; i < 7; i++)
    assert_int_equal(item[i], i + 1);
  assert_int_equal(parallel_gather(NULL, sizeof *item, 0, 3, kept), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup(all_is_done_once_by_any_number_of_threads, reset),
      cmocka_unit_test_setup(one_thread_starts_no_other, reset),
      cmocka_unit_test_setup(threads_that_cannot_start_are_done_without, reset),
      cmocka_unit_test_setup(a_forked_process_has_threads_too, reset),
      cmocka_unit_test_setup(there_is_a_processor, reset),
      cmocka_unit_test_setup(ranges_are_done_once_by_any_number_of_threads,
                             reset),
      cmocka_unit_test_setup(a_range_that_fails_ends_the_others, reset),
      cmocka_unit_test_setup(ranges_are_cancelled, reset),
      cmocka_unit_test_setup(there_are_no_more_workers_than_given, reset),
      cmocka_unit_test_setup(threads_are_kept_until_the_call_ends, reset),
      cmocka_unit_test_setup(a_loop_within_a_loop_has_threads_of_its_own,
                             reset),
      cmocka_unit_test_setup(a_process_forked_in_a_call_goes_on, reset),
      cmocka_unit_test(what_ranges_keep_is_gathered_in_order),
      cmocka_unit_test_setup(few_items_and_no_call_have_one_worker, reset),
      cmocka_unit_test_setup(workers_begin_with_shares_or_in_order, reset),
      cmocka_unit_test_setup(lines_do_not_depend_on_what_threads_there_are,
                             reset),
  };
  return cmocka_run_group_tests_name("parallel", tests, NULL, NULL);
}
