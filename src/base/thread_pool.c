/* thread_pool.c - threads that are kept from one loop of a call to the next.
 *
 * A thread that is created for a loop is often put on its creator's processor
 * first, and runs when the system next balances its load: later than a short
 * loop takes (doc/decisions/0119).  One that slept wakes where it last ran. */
#ifdef __linux__
#define _GNU_SOURCE /* pthread_attr_setaffinity_np, sched_getcpu */
#endif
#include "base/thread_pool.h"

#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

struct thread_pool {
  pthread_mutex_t lock;
  pthread_cond_t wake;    /* there is work, or the pool ends */
  pthread_cond_t is_idle; /* no thread works */
  thread_pool_work *work; /* what is offered; NULL: nothing is */
  void *user;
  int places;              /* threads that may still begin with it */
  int working;             /* threads that do it */
  thread_pool_work *given; /* to one thread; NULL: nothing is */
  void *given_user;
  enum thread_pool_given given_state;
  bool ends;
  pid_t process; /* in which the threads are */
  size_t threads;
  pthread_t thread[THREAD_POOL_MAX];
#ifdef HAVE_PTHREAD_ATTR_SETAFFINITY_NP
  cpu_set_t processors; /* on which they may run; none: as the system says */
#endif
};

/* ---- Processors ---------------------------------------------------------- */

#ifdef HAVE_PTHREAD_ATTR_SETAFFINITY_NP

/* Lets the threads of a pool run where the caller may. */
static void set_processors(struct thread_pool *pool) {
  if (pthread_getaffinity_np(pthread_self(), sizeof pool->processors,
                             &pool->processors) != 0)
    CPU_ZERO(&pool->processors);
}

/* Lets a thread begin on another processor than the caller's, where there is
 * one. */
static void start_elsewhere(const struct thread_pool *pool,
                            pthread_attr_t *attributes) {
  cpu_set_t others = pool->processors;
  int own = sched_getcpu();
  if (own < 0 || own >= CPU_SETSIZE)
    return;
  CPU_CLR((size_t)own, &others);
  if (CPU_COUNT(&others) > 0)
    (void)pthread_attr_setaffinity_np(attributes, sizeof others, &others);
}

/* Lets the thread that calls this, and has begun, go where the pool's may. */
static void allow_all_processors(const struct thread_pool *pool) {
  if (CPU_COUNT(&pool->processors) > 0)
    (void)pthread_setaffinity_np(pthread_self(), sizeof pool->processors,
                                 &pool->processors);
}

#else

static void set_processors(struct thread_pool *pool) { (void)pool; }

static void start_elsewhere(const struct thread_pool *pool,
                            pthread_attr_t *attributes) {
  (void)pool;
  (void)attributes;
}

static void allow_all_processors(const struct thread_pool *pool) { (void)pool; }

#endif

/* ---- Threads ------------------------------------------------------------- */

static bool waits_given(const struct thread_pool *pool) {
  return pool->given != NULL && pool->given_state == THREAD_POOL_WAITS;
}

/* Does what is given to one thread. */
static void do_given(struct thread_pool *pool) {
  pool->given_state = THREAD_POOL_BEGAN;
  (void)pthread_mutex_unlock(&pool->lock);
  pool->given(pool->given_user);
  (void)pthread_mutex_lock(&pool->lock);
  pool->given_state = THREAD_POOL_ENDED;
  (void)pthread_cond_signal(&pool->is_idle);
}

static void *serve(void *argument) {
  struct thread_pool *pool = argument;
  allow_all_processors(pool);
  (void)pthread_mutex_lock(&pool->lock);
  for (;;) {
    if (waits_given(pool))
      do_given(pool);
    while (pool->places == 0 && !pool->ends && !waits_given(pool))
      (void)pthread_cond_wait(&pool->wake, &pool->lock);
    if (waits_given(pool))
      continue;
    if (pool->places == 0)
      break;
    pool->places--;
    pool->working++;
    (void)pthread_mutex_unlock(&pool->lock);
    pool->work(pool->user);
    (void)pthread_mutex_lock(&pool->lock);
    if (--pool->working == 0)
      (void)pthread_cond_signal(&pool->is_idle);
  }
  (void)pthread_mutex_unlock(&pool->lock);
  return NULL;
}

/* As what starting threads allocates, this is none of the allocations that
 * tests let fail (mem_fail_after): the work is done without. */
static struct thread_pool *create_pool(void) {
  struct thread_pool *pool = calloc(1, sizeof *pool);
  if (pool == NULL)
    return NULL;
  (void)pthread_mutex_init(&pool->lock, NULL);
  (void)pthread_cond_init(&pool->wake, NULL);
  (void)pthread_cond_init(&pool->is_idle, NULL);
  pool->process = getpid();
  set_processors(pool);
  return pool;
}

/* Starts a thread, wherever the system likes where it may not be elsewhere: a
 * sandbox may refuse that processors are chosen. */
static bool start_one_thread(struct thread_pool *pool,
                             const pthread_attr_t *attributes) {
  pthread_t *thread = &pool->thread[pool->threads];
  return pthread_create(thread, attributes, serve, pool) == 0 ||
         pthread_create(thread, NULL, serve, pool) == 0;
}

/* Starts threads until there are so many, or no more can be had.  They inherit
 * a mask that blocks all signals, so that the host's handlers run in the host's
 * own threads. */
static void start_threads(struct thread_pool *pool, size_t wanted) {
  sigset_t all, before;
  pthread_attr_t attributes;
  if (pool->threads >= wanted || sigfillset(&all) != 0 ||
      pthread_attr_init(&attributes) != 0)
    return;
  start_elsewhere(pool, &attributes);
  if (pthread_sigmask(SIG_SETMASK, &all, &before) == 0) {
    while (pool->threads < wanted && start_one_thread(pool, &attributes))
      pool->threads++;
    (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
  }
  (void)pthread_attr_destroy(&attributes);
}

/* ---- Work ---------------------------------------------------------------- */

bool thread_pool_offer(struct thread_pool **kept, int threads,
                       thread_pool_work *work, void *user) {
  if (*kept == NULL)
    *kept = create_pool();
  struct thread_pool *pool = *kept;
  if (pool == NULL || pool->work != NULL || pool->process != getpid())
    return false;
  start_threads(pool, (size_t)threads);
  if ((size_t)threads > pool->threads)
    threads = (int)pool->threads;
  (void)pthread_mutex_lock(&pool->lock);
  pool->work = work;
  pool->user = user;
  pool->places = threads;
  (void)pthread_mutex_unlock(&pool->lock);
  for (int i = 0; i < threads; i++)
    (void)pthread_cond_signal(&pool->wake);
  return true;
}

void thread_pool_withdraw(struct thread_pool *pool) {
  (void)pthread_mutex_lock(&pool->lock);
  pool->places = 0;
  while (pool->working > 0)
    (void)pthread_cond_wait(&pool->is_idle, &pool->lock);
  pool->work = NULL;
  (void)pthread_mutex_unlock(&pool->lock);
}

bool thread_pool_give(struct thread_pool **kept, thread_pool_work *work,
                      void *user) {
  if (*kept == NULL)
    *kept = create_pool();
  struct thread_pool *pool = *kept;
  if (pool == NULL || pool->work != NULL || pool->given != NULL ||
      pool->process != getpid())
    return false;
  start_threads(pool, 1);
  if (pool->threads == 0)
    return false;
  (void)pthread_mutex_lock(&pool->lock);
  pool->given = work;
  pool->given_user = user;
  pool->given_state = THREAD_POOL_WAITS;
  (void)pthread_mutex_unlock(&pool->lock);
  (void)pthread_cond_signal(&pool->wake);
  return true;
}

enum thread_pool_given thread_pool_take_back(struct thread_pool *pool) {
  bool is_here = pool->process == getpid();
  if (is_here)
    (void)pthread_mutex_lock(&pool->lock);
  while (is_here && pool->given_state == THREAD_POOL_BEGAN)
    (void)pthread_cond_wait(&pool->is_idle, &pool->lock);
  pool->given = NULL;
  if (is_here)
    (void)pthread_mutex_unlock(&pool->lock);
  return pool->given_state;
}

void thread_pool_end(struct thread_pool *pool) {
  if (pool == NULL)
    return;
  if (pool->process == getpid()) {
    (void)pthread_mutex_lock(&pool->lock);
    pool->ends = true;
    (void)pthread_cond_broadcast(&pool->wake);
    (void)pthread_mutex_unlock(&pool->lock);
    for (size_t i = 0; i < pool->threads; i++)
      (void)pthread_join(pool->thread[i], NULL);
    (void)pthread_cond_destroy(&pool->is_idle);
    (void)pthread_cond_destroy(&pool->wake);
    (void)pthread_mutex_destroy(&pool->lock);
  }
  free(pool);
}
