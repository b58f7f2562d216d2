/* exact.h - which methods compute the visible map itself, unless a pitch or a
 * resolution is requested. */
#ifndef TESTS_SCENES_EXACT_H
#define TESTS_SCENES_EXACT_H

#include "visibility/solver.h"

static inline bool is_exact(const struct solver *solver) {
  return solver == &solver_newell || solver == &solver_warnock ||
         solver == &solver_watkins || solver == &solver_tiles ||
         solver == &solver_brute;
}

#endif
