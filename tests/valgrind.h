/* valgrind.h - whether a test runs under valgrind, and is to be short. */
#ifndef TESTS_VALGRIND_H
#define TESTS_VALGRIND_H

#include <stdbool.h>
#include <stdlib.h>

/* As `make check-valgrind` says. */
static inline bool is_under_valgrind(void) {
  return getenv("RECTO_VALGRIND") != NULL;
}

#endif
