/* parallel.c - a few threads for one loop, and as many as can be had.
 *
 * Threads are kept until the call of the library ends, or, where there is none,
 * the loop: nothing remains that a fork could break, no environment variable is
 * read, no thread spins.  Where the system starts no thread, the work is done
 * by those that are there. */
#ifdef __linux__
#define _GNU_SOURCE /* sched_getaffinity */
#endif
#include "base/parallel.h"

#include <stdatomic.h>
#include <string.h>
#include <unistd.h>
#ifdef __linux__
#include <sched.h>
#endif

#include "base/thread_pool.h"

enum { THREADS_MAX = THREAD_POOL_MAX + 1 };

struct others {
  parallel_worker *worker;
  void *user;
};

static void start_worker(void *argument) {
  const struct others *others = argument;
  others->worker(others->user, false);
}

void parallel_run(int threads, parallel_worker *worker, void *user) {
  struct others others = {worker, user};
  struct thread_pool *own = NULL, **kept = poll_pool();
  int wanted = threads <= THREADS_MAX ? threads - 1 : THREADS_MAX - 1;
  bool by_kept = wanted > 0 && kept != NULL &&
                 thread_pool_offer(kept, wanted, start_worker, &others);
  if (wanted > 0 && !by_kept)
    (void)thread_pool_offer(&own, wanted, start_worker, &others);
  worker(user, true);
  if (by_kept)
    thread_pool_withdraw(*kept);
  thread_pool_end(own);
}

static void do_aside(void *user) {
  struct parallel_aside *aside = user;
  poll_follow(&aside->ended);
  aside->work(aside->user);
  poll_follow(NULL);
}

void parallel_aside_begin(struct parallel_aside *aside,
                          void (*work)(void *user), void *user) {
  struct thread_pool **kept = poll_pool();
  aside->work = work;
  aside->user = user;
  aside->pool = NULL;
  atomic_init(&aside->ended, false);
  if (kept != NULL && parallel_threads() > 1 &&
      thread_pool_give(kept, do_aside, aside))
    aside->pool = *kept;
}

bool parallel_aside_finish(struct parallel_aside *aside, bool is_wanted) {
  if (!is_wanted)
    atomic_store(&aside->ended, true);
  enum thread_pool_given came = aside->pool != NULL
                                    ? thread_pool_take_back(aside->pool)
                                    : THREAD_POOL_WAITS;
  if (came != THREAD_POOL_ENDED && is_wanted)
    aside->work(aside->user);
  return came != THREAD_POOL_BEGAN || is_wanted;
}

int parallel_processors(void) {
  long there = 0;
#ifdef __linux__
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0)
    there = CPU_COUNT(&set);
#endif
  if (there < 1)
    there = sysconf(_SC_NPROCESSORS_ONLN);
  if (there < 1)
    return 1;
  return there < THREADS_MAX ? (int)there : THREADS_MAX;
}

int parallel_threads(void) {
  const recto_options *options = poll_options();
  if (options == NULL || options->solver.threads == 1)
    return 1;
  int there = parallel_processors();
  return 0 < options->solver.threads && options->solver.threads < there
             ? options->solver.threads
             : there;
}

/* ---- Ranges of items ----------------------------------------------------- */

/* With fewer for each a thread is not worth while. */
enum { RANGES_PER_THREAD = 4 };

/* With more workers than that several of them begin with one share. */
enum { SHARES_MAX = 16 };

/* Consecutive ranges. */
struct share {
  atomic_size_t next; /* the first that no worker has taken; */
  size_t end;         /* not less: none is left */
  char apart[PARALLEL_APART];
};

struct ranges {
  size_t count, items;
  parallel_task *task;
  void *user;
  atomic_int workers; /* that have begun, beside the caller */
  atomic_bool ended;
  size_t shares;
  struct share share[SHARES_MAX];
};

static void make_shares(struct ranges *ranges, int shares) {
  size_t count = parallel_range_count(ranges->count, ranges->items);
  size_t most = count < SHARES_MAX ? count : (size_t)SHARES_MAX;
  ranges->shares = (size_t)shares < most ? (size_t)shares : most;
  for (size_t s = 0; s < ranges->shares; s++) {
    atomic_init(&ranges->share[s].next, count * s / ranges->shares);
    ranges->share[s].end = count * (s + 1) / ranges->shares;
  }
}

/* Does the ranges of a share that are left; false when the work is to end. */
static bool do_share(struct ranges *ranges, struct share *share, int worker) {
  size_t i;
  while ((i = atomic_fetch_add(&share->next, 1)) < share->end) {
    struct parallel_range range = {i * ranges->items, (i + 1) * ranges->items,
                                   worker};
    if (range.end > ranges->count)
      range.end = ranges->count;
    if (!poll_now() || !ranges->task(ranges->user, range))
      return false;
  }
  return true;
}

/* Does the worker's own share, and what is left of the others. */
static void do_ranges(void *user, bool is_caller) {
  struct ranges *ranges = user;
  int worker = is_caller ? 0 : 1 + atomic_fetch_add(&ranges->workers, 1);
  bool ok = true;
  if (!is_caller)
    poll_follow(&ranges->ended);
  for (size_t k = 0; ok && k < ranges->shares; k++)
    ok = do_share(ranges, &ranges->share[((size_t)worker + k) % ranges->shares],
                  worker);
  if (!ok)
    atomic_store(&ranges->ended, true);
  if (!is_caller)
    poll_follow(NULL);
}

int parallel_workers(size_t count, size_t items) {
  size_t worthwhile = count / items / RANGES_PER_THREAD;
  if (worthwhile < 2)
    return 1; /* without asking the system, which short loops would feel */
  int threads = parallel_threads();
  return worthwhile < (size_t)threads ? (int)worthwhile : threads;
}

static bool run_ranges(int workers, int shares, size_t count, size_t items,
                       parallel_task *task, void *user) {
  struct ranges ranges;
  ranges.count = count;
  ranges.items = items;
  ranges.task = task;
  ranges.user = user;
  atomic_init(&ranges.workers, 0);
  atomic_init(&ranges.ended, false);
  make_shares(&ranges, shares);
  parallel_run(workers, do_ranges, &ranges);
  return !atomic_load(&ranges.ended);
}

bool parallel_ranges(int workers, size_t count, size_t items,
                     parallel_task *task, void *user) {
  return run_ranges(workers, workers, count, items, task, user);
}

bool parallel_ranges_ascending(int workers, size_t count, size_t items,
                               parallel_task *task, void *user) {
  return run_ranges(workers, 1, count, items, task, user);
}

size_t parallel_gather(void *item, size_t size, size_t count, size_t items,
                       const size_t *kept) {
  char *bytes = item;
  size_t all = 0;
  for (size_t r = 0; r < parallel_range_count(count, items); r++) {
    memmove(bytes + all * size, bytes + r * items * size, kept[r] * size);
    all += kept[r];
  }
  return all;
}
