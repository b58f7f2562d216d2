/* parallel.h - a few threads for one loop, and as many as can be had. */
#ifndef BASE_PARALLEL_H
#define BASE_PARALLEL_H

#include <stdbool.h>

/* Does a share of the work, which the threads take from a common counter.
 * callers  whether this is the thread that called parallel_run */
typedef void parallel_worker(void *user, bool callers);

/* Runs the worker in the caller's thread and in up to `threads` - 1 others,
 * and returns when all of them have ended.
 *
 * Where the system starts no more threads (a limit on processes or on memory)
 * there are fewer of them: the caller's own always runs, so that the work is
 * done in any case.  The other threads take no signals.
 * Threads  may be called from several threads at once, and after fork */
void parallel_run(int threads, parallel_worker *worker, void *user);

/* How many processors this process may run on; at least 1. */
int parallel_processors(void);

#endif
