/* parallel.h - a few threads for one loop, and as many as can be had. */
#ifndef BASE_PARALLEL_H
#define BASE_PARALLEL_H

#include <stdbool.h>
#include <stddef.h>

#include "base/poll.h"

/* Does a share of the work, which the threads take from a common counter.
 * is_caller  whether this is the thread that called parallel_run */
typedef void parallel_worker(void *user, bool is_caller);

/* Runs the worker in the caller's thread and in up to `threads` - 1 others,
 * and returns when all of them have ended.  The others are kept until the call
 * of the library ends for which this thread works; one that has not begun when
 * the caller's own has ended is not waited for.  Without a call each of them
 * does a share.
 *
 * Where the system starts no more threads (a limit on processes or on memory)
 * there are fewer of them: the caller's own always runs, so that the work is
 * done in any case.  The other threads take no signals.
 * Threads  may be called from several threads at once, and after fork */
void parallel_run(int threads, parallel_worker *worker, void *user);

/* Work that another thread may do while the caller goes on. */
struct parallel_aside {
  void (*work)(void *user);
  void *user;
  struct thread_pool *pool; /* that got it; NULL: none did */
  atomic_bool ended;        /* polls of that thread are false */
};

/* Gives work to another thread, if the call of the library may use several;
 * until it is finished the caller does nothing that the work may notice.  Loops
 * in the work are done by its own thread. */
void parallel_aside_begin(struct parallel_aside *aside,
                          void (*work)(void *user), void *user);

/* Waits until the work is done, which no other thread may have begun: then the
 * caller does it, if it is wanted, else it may end early.  The caller does it
 * from the beginning, too, where the process was forked since another thread
 * began, which goes on in the other process alone.
 * Returns false where the work is half done for that reason. */
bool parallel_aside_finish(struct parallel_aside *aside, bool is_wanted);

/* How many processors this process may run on; at least 1. */
int parallel_processors(void);

/* How many threads the call of the library that this thread works for may use,
 * by its options; 1 where there is none, as in the threads started here. */
int parallel_threads(void);

/* ---- Ranges of items ----------------------------------------------------- */

/* The items from `begin` to before `end`. */
struct parallel_range {
  size_t begin, end;
  int worker; /* which does them, from 0, the caller, to before `workers` */
};

/* Bytes at the end of what a worker writes that lies beside what another one
 * writes: so that no line of the cache, or pair of lines, has some of both, for
 * which each would wait at every write of the other. */
enum { PARALLEL_APART = 128 };

/* Returns false where the work is to end: memory ran out.  Polls in all workers
 * are false once it is. */
typedef bool parallel_task(void *user, struct parallel_range range);

/* How many items a range has; one in a fuzzer's build, so that the few items of
 * its inputs are divided among threads too. */
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
#define PARALLEL_RANGE(items) 1
#else
#define PARALLEL_RANGE(items) (items)
#endif

/* Items of a range where each takes some nanoseconds. */
enum { PARALLEL_ITEMS = PARALLEL_RANGE(POLL_ITEMS) };

/* How many workers are worth while for so many items: at most the threads that
 * the call may use.  Another call may return another number, as the processors
 * of the process may change; so what is allocated for each worker, and
 * parallel_ranges, take one result. */
int parallel_workers(size_t count, size_t items);

/* Divides `count` items into ranges of `items`, the last of which may be
 * shorter, and does them in at most `workers` threads, each range in one of
 * them.  Ranges begin at the same items for any number of threads, so a task
 * whose result depends on its range alone gives the same bytes.
 * Each worker begins with a share of consecutive ranges, and then takes what is
 * left of the other shares: so threads do not write to memory side by side,
 * where both of them would clear a large page that neither has written to.
 * workers  as from parallel_workers; the caller is one of them
 * Returns false when a task did, or the caller cancelled; the others may then
 * not have been run. */
bool parallel_ranges(int workers, size_t count, size_t items,
                     parallel_task *task, void *user);

/* The same, where ranges are begun in ascending order: for tasks that take less
 * time by what is known of those before. */
bool parallel_ranges_ascending(int workers, size_t count, size_t items,
                               parallel_task *task, void *user);

/* The number of these ranges. */
static inline size_t parallel_range_count(size_t count, size_t items) {
  return (count + items - 1) / items;
}

/* Moves together, in order, what tasks left at the beginnings of the ranges of
 * an array: so that a filter of its items is divided among threads.
 * item   an array of `count` items of `size` bytes
 * kept   one a range: how many of its items are left
 * Returns how many are left of all. */
size_t parallel_gather(void *item, size_t size, size_t count, size_t items,
                       const size_t *kept);

#endif
