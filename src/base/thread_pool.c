/* thread_pool.c - threads that are kept from one loop of a call to the next.
 *
 * A thread that is created for a loop is often put on its creator's processor
 * first, and runs when the system next balances its load: later than a short
 * loop takes (doc/decisions/0119).  One that slept wakes where it last ran. */
#include "base/thread_pool.h"

#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

struct thread_pool {
  pthread_mutex_t lock;
  pthread_cond_t wake;    /* there is work, or the pool ends */
  pthread_cond_t is_idle; /* no thread works */
  thread_pool_work *work; /* what is offered; NULL: nothing is */
  void *user;
  int places;  /* threads that may still begin with it */
  int working; /* threads that do it */
  bool ends;
  pid_t process; /* in which the threads are */
  size_t threads;
  pthread_t thread[THREAD_POOL_MAX];
};

static void *serve(void *argument) {
  struct thread_pool *pool = argument;
  (void)pthread_mutex_lock(&pool->lock);
  for (;;) {
    while (pool->places == 0 && !pool->ends)
      (void)pthread_cond_wait(&pool->wake, &pool->lock);
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
  return pool;
}

/* Starts threads until there are so many, or no more can be had.  They inherit
 * a mask that blocks all signals, so that the host's handlers run in the host's
 * own threads. */
static void start_threads(struct thread_pool *pool, size_t wanted) {
  sigset_t all, before;
  if (pool->threads >= wanted || sigfillset(&all) != 0 ||
      pthread_sigmask(SIG_SETMASK, &all, &before) != 0)
    return;
  while (pool->threads < wanted &&
         pthread_create(&pool->thread[pool->threads], NULL, serve, pool) == 0)
    pool->threads++;
  (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
}

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
