/* test_parallel_aside.c - work that another thread does while the caller goes
 * on. */
#define _GNU_SOURCE /* RTLD_NEXT */
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/parallel.h"

static bool refuses_threads;

typedef int creator(pthread_t *thread, const pthread_attr_t *attributes,
                    void *(*start)(void *), void *argument);

/* Stands before the system's own, for all of this program. */
int pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                   void *(*start)(void *), void *argument) {
  creator *real;
  *(void **)&real = dlsym(RTLD_NEXT, "pthread_create");
  return refuses_threads ? EAGAIN : real(thread, attributes, start, argument);
}

/* ---- The work ------------------------------------------------------------ */

struct work {
  atomic_int begun, done;
  atomic_bool may_end; /* it goes on until it may, or polls are false */
  atomic_bool was_cancelled;
  pthread_t thread; /* that did it last */
};

static void do_work(void *user) {
  struct work *work = user;
  work->thread = pthread_self();
  atomic_fetch_add(&work->begun, 1);
  while (!atomic_load(&work->may_end) && poll_now())
    (void)sched_yield();
  atomic_store(&work->was_cancelled, !atomic_load(&work->may_end));
  atomic_fetch_add(&work->done, 1);
}

struct call {
  recto_options options;
  struct poll poll;
  struct work work;
  struct parallel_aside aside;
};

/* Begins the work within a call with so many threads; waits until another
 * thread has begun if there is one. */
static void begin(struct call *call, int threads) {
  *call = (struct call){.work = {.done = 0}};
  recto_options_init(&call->options);
  call->options.solver.threads = threads;
  poll_open(&call->poll, &call->options);
  parallel_aside_begin(&call->aside, do_work, &call->work);
  while (call->aside.pool != NULL && atomic_load(&call->work.begun) == 0)
    (void)sched_yield();
}

static void finish(struct call *call, bool is_wanted) {
  atomic_store(&call->work.may_end, is_wanted);
  assert_true(parallel_aside_finish(&call->aside, is_wanted));
  poll_close(&call->poll);
}

static bool is_by_caller(const struct call *call) {
  return pthread_equal(call->work.thread, pthread_self()) != 0;
}

/* ---- Tests --------------------------------------------------------------- */

static bool count_items(void *user, struct parallel_range range) {
  atomic_fetch_add((atomic_size_t *)user, range.end - range.begin);
  return true;
}

static void another_thread_does_it_beside_loops(void **state) {
  enum { ITEMS = 100 * PARALLEL_ITEMS };
  struct call call;
  atomic_size_t items = 0;
  (void)state;
  begin(&call, 2);
  for (int i = 0; i < 3; i++)
    assert_true(parallel_ranges(2, ITEMS, PARALLEL_ITEMS, count_items, &items));
  assert_int_equal(items, 3 * ITEMS);
  finish(&call, true);
  assert_int_equal(call.work.done, 1);
  assert_int_equal(is_by_caller(&call), parallel_processors() == 1);
}

static void with_one_thread_the_caller_does_it(void **state) {
  struct call call;
  (void)state;
  begin(&call, 1);
  assert_int_equal(call.work.begun, 0);
  finish(&call, true);
  assert_int_equal(call.work.done, 1);
  assert_true(is_by_caller(&call));
}

static void where_no_thread_starts_the_caller_does_it(void **state) {
  struct call call;
  (void)state;
  refuses_threads = true;
  begin(&call, 2);
  finish(&call, true);
  refuses_threads = false;
  assert_int_equal(call.work.done, 1);
  assert_true(is_by_caller(&call));
}

static void what_is_not_wanted_ends_or_is_not_done(void **state) {
  struct call call;
  (void)state;
  begin(&call, 1);
  finish(&call, false);
  assert_int_equal(call.work.done, 0);
  begin(&call, 2);
  bool is_given = call.aside.pool != NULL;
  finish(&call, false);
  assert_int_equal(call.work.done, is_given);
  assert_int_equal(call.work.was_cancelled, is_given);
}

static void a_call_may_give_work_more_than_once(void **state) {
  struct call call;
  (void)state;
  begin(&call, 2);
  atomic_store(&call.work.may_end, true);
  assert_true(parallel_aside_finish(&call.aside, true));
  parallel_aside_begin(&call.aside, do_work, &call.work);
  finish(&call, true);
  assert_int_equal(call.work.done, 2);
}

/* The thread that had begun is not in the new process. */
static void a_forked_process_does_it_from_the_beginning(void **state) {
  struct call call;
  int status;
  (void)state;
  for (int wanted = 0; wanted < 2; wanted++) {
    begin(&call, 2);
    bool is_given = call.aside.pool != NULL;
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
      atomic_store(&call.work.may_end, true);
      bool is_whole = parallel_aside_finish(&call.aside, wanted != 0);
      poll_close(&call.poll);
      _exit(is_whole == (wanted != 0 || !is_given) &&
                    atomic_load(&call.work.done) == wanted
                ? 0
                : 1);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    finish(&call, true);
    assert_int_equal(call.work.done, 1);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(another_thread_does_it_beside_loops),
      cmocka_unit_test(with_one_thread_the_caller_does_it),
      cmocka_unit_test(where_no_thread_starts_the_caller_does_it),
      cmocka_unit_test(what_is_not_wanted_ends_or_is_not_done),
      cmocka_unit_test(a_call_may_give_work_more_than_once),
      cmocka_unit_test(a_forked_process_does_it_from_the_beginning),
  };
  return cmocka_run_group_tests_name("parallel_aside", tests, NULL, NULL);
}
