/* test_thread_pool.c - threads begin on another processor than the one that
 * starts them, and then may run wherever that may. */
#ifdef __linux__
#define _GNU_SOURCE /* RTLD_NEXT, pthread_attr_getaffinity_np */
#endif
#include "base/thread_pool.h"

#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#ifdef HAVE_PTHREAD_ATTR_SETAFFINITY_NP

enum { THREADS = 3 };

static cpu_set_t first[THREADS]; /* where each thread may begin */
static int started;
static bool refuses_choice; /* where a thread begins may not be chosen */

typedef int creator(pthread_t *thread, const pthread_attr_t *attributes,
                    void *(*start)(void *), void *argument);

/* Stands before the system's own, for all of this program. */
int pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                   void *(*start)(void *), void *argument) {
  creator *real;
  *(void **)&real = dlsym(RTLD_NEXT, "pthread_create");
  if (refuses_choice)
    return attributes == NULL ? real(thread, NULL, start, argument) : EPERM;
  if (started < THREADS)
    assert_int_equal(
        pthread_attr_getaffinity_np(attributes, sizeof *first, &first[started]),
        0);
  started++;
  return real(thread, attributes, start, argument);
}

struct places {
  pthread_mutex_t lock;
  int threads;
  cpu_set_t set[THREADS]; /* where each may run while it works */
};

static void note_place(void *user) {
  struct places *places = user;
  (void)pthread_mutex_lock(&places->lock);
  cpu_set_t *set = &places->set[places->threads++];
  assert_int_equal(pthread_getaffinity_np(pthread_self(), sizeof *set, set), 0);
  (void)pthread_mutex_unlock(&places->lock);
}

/* Lets a pool's threads work once each, where the caller may run on `own`. */
static void run_pool(struct places *places, const cpu_set_t *own) {
  struct thread_pool *pool = NULL;
  *places = (struct places){.lock = PTHREAD_MUTEX_INITIALIZER};
  started = 0;
  assert_int_equal(pthread_setaffinity_np(pthread_self(), sizeof *own, own), 0);
  assert_true(thread_pool_offer(&pool, THREADS, note_place, places));
  thread_pool_end(pool);
  assert_int_equal(places->threads, THREADS);
  for (int t = 0; t < THREADS; t++)
    assert_true(CPU_EQUAL(&places->set[t], own));
}

static void threads_begin_elsewhere_and_may_run_anywhere(void **state) {
  struct places places;
  cpu_set_t own;
  (void)state;
  assert_int_equal(pthread_getaffinity_np(pthread_self(), sizeof own, &own), 0);
  run_pool(&places, &own);
  for (int t = 0; CPU_COUNT(&own) > 1 && t < THREADS; t++) {
    cpu_set_t both;
    CPU_AND(&both, &first[t], &own);
    assert_true(CPU_EQUAL(&both, &first[t]));
    assert_int_equal(CPU_COUNT(&first[t]), CPU_COUNT(&own) - 1);
  }
}

static void a_single_processor_is_shared(void **state) {
  struct places places;
  cpu_set_t own, one;
  (void)state;
  assert_int_equal(pthread_getaffinity_np(pthread_self(), sizeof own, &own), 0);
  CPU_ZERO(&one);
  for (size_t c = 0; CPU_COUNT(&one) == 0 && c < CPU_SETSIZE; c++)
    if (CPU_ISSET(c, &own))
      CPU_SET(c, &one);
  run_pool(&places, &one);
  assert_int_equal(pthread_setaffinity_np(pthread_self(), sizeof own, &own), 0);
}

static void threads_begin_where_no_processor_can_be_chosen(void **state) {
  struct places places;
  cpu_set_t own;
  (void)state;
  assert_int_equal(pthread_getaffinity_np(pthread_self(), sizeof own, &own), 0);
  refuses_choice = true;
  run_pool(&places, &own);
  refuses_choice = false;
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(threads_begin_elsewhere_and_may_run_anywhere),
      cmocka_unit_test(a_single_processor_is_shared),
      cmocka_unit_test(threads_begin_where_no_processor_can_be_chosen),
  };
  return cmocka_run_group_tests_name("thread_pool", tests, NULL, NULL);
}

#else

int main(void) { return 77; /* skipped: processors cannot be chosen */ }

#endif
