/* memory_peak.h - how much memory something takes. */
#ifndef TESTS_MEMORY_PEAK_H
#define TESTS_MEMORY_PEAK_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

/* The peak in bytes of the resident set of a process that runs something, which
 * asserts that this returns true.  It starts with what this process has. */
static inline size_t memory_peak_of(bool (*run)(const void *user),
                                    const void *user) {
  int status;
  struct rusage usage;
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0)
    _exit(run(user) ? 0 : 1);
  assert_int_equal(wait4(child, &status, 0, &usage), child);
  assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  assert_true(usage.ru_maxrss > 0);
  return (size_t)usage.ru_maxrss * 1024;
}

#endif
