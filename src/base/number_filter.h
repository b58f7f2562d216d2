/* number_filter.h - the numbers of a range that a test keeps, found by several
 * threads. */
#ifndef BASE_NUMBER_FILTER_H
#define BASE_NUMBER_FILTER_H

#include <stddef.h>
#include <stdint.h>

#include "base/parallel.h"
#include "base/status.h"

/* Writes those of the range's numbers that are kept, ascending, to `kept`,
 * which has room for all of them; returns how many. */
typedef size_t number_filter_task(const void *user, struct parallel_range range,
                                  uint32_t *kept);

/* The numbers from 0 to before `count` that the task keeps, ascending; NULL
 * when memory ran out, or the caller cancelled.  Free it with mem_free.
 * kept  gets how many there are */
USE_RESULT uint32_t *number_filter(size_t count, number_filter_task *task,
                                   const void *user, size_t *kept);

#endif
