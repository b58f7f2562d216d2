/* memory_faults.h - runs something once for each of its allocations, which
 * fails then:
 *
 *   struct memory_faults faults = {.least = 10};
 *   while (memory_faults_go_on(&faults)) {
 *     memory_faults_begin(&faults);
 *     memory_faults_end(&faults, status of what is tested);
 *   }
 *
 * The first run that succeeds is the last one, or where not every failure is an
 * error, the last of `in_a_row` that succeed one after the other.  It asserts
 * that each other one ended with RECTO_ERROR_MEMORY, and that at least `least`
 * did. */
#ifndef TESTS_MEMORY_FAULTS_H
#define TESTS_MEMORY_FAULTS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/memory.h"

struct memory_faults {
  unsigned long least, failed;
  unsigned long in_a_row;   /* 0 stands for 1 */
  unsigned long allocation; /* of the last run, that failed; increase it between
                               runs to leave some out */
  unsigned long succeeded;  /* runs since the last that failed */
};

static inline bool memory_faults_go_on(const struct memory_faults *faults) {
  bool ended = faults->succeeded > 0 && faults->succeeded >= faults->in_a_row;
  if (ended)
    assert_in_range(faults->failed, faults->least, 20000);
  return !ended;
}

static inline void memory_faults_begin(struct memory_faults *faults) {
  assert_true(faults->failed < 20000);
  mem_fail_after(++faults->allocation);
}

static inline void memory_faults_end(struct memory_faults *faults,
                                     recto_status status) {
  mem_fail_after(0);
  faults->succeeded = status == RECTO_OK ? faults->succeeded + 1 : 0;
  faults->failed += status != RECTO_OK;
  if (status != RECTO_OK)
    assert_int_equal(status, RECTO_ERROR_MEMORY);
}

/* The status of what returns false when memory runs out. */
static inline recto_status memory_faults_status(bool ok) {
  return ok ? RECTO_OK : RECTO_ERROR_MEMORY;
}

#endif
