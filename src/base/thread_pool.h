/* thread_pool.h - threads that are kept from one loop of a call to the next.
 *
 * A pool belongs to one thread, which offers work to it and does a part of that
 * itself.  Between offers the threads of the pool sleep. */
#ifndef BASE_THREAD_POOL_H
#define BASE_THREAD_POOL_H

#include <stdbool.h>

enum { THREAD_POOL_MAX = 1023 }; /* threads of a pool */

struct thread_pool;

/* Does a share of some work, of which several threads take what is left. */
typedef void thread_pool_work(void *user);

/* Offers work to up to so many threads, at most THREAD_POOL_MAX.  Each of them
 * does one share of it as soon as it runs.  Threads that the pool lacks are
 * started, without signals; where the system starts no more, there are fewer.
 * pool  NULL: there is none yet; one is made
 * Returns false, and offers nothing, where memory ran out, while other work is
 * offered, and in a process that was forked since the pool was made, in which
 * its threads are not. */
bool thread_pool_offer(struct thread_pool **pool, int threads,
                       thread_pool_work *work, void *user);

/* Withdraws the offer, so that no further thread begins, and waits for those
 * that have begun. */
void thread_pool_withdraw(struct thread_pool *pool);

/* Gives work to one thread of the pool, which does it beside what is offered to
 * all; thread_pool_take_back is to follow.
 * pool  as of thread_pool_offer
 * Returns false, and gives nothing, where thread_pool_offer would, or no thread
 * could be started, or other work was given and not taken back. */
bool thread_pool_give(struct thread_pool **pool, thread_pool_work *work,
                      void *user);

/* Takes that work back if it has not begun, or waits until it ends.  Returns
 * how far it came: it began, but does not end, in a process that was forked
 * meanwhile. */
enum thread_pool_given {
  THREAD_POOL_WAITS,
  THREAD_POOL_BEGAN,
  THREAD_POOL_ENDED
};
enum thread_pool_given thread_pool_take_back(struct thread_pool *pool);

/* Ends the threads, once all to which work is offered have done their share,
 * and frees the pool, which may be NULL. */
void thread_pool_end(struct thread_pool *pool);

#endif
