/* solver_named.h - solvers by the names of their methods. */
#ifndef TESTS_SCENES_SOLVER_NAMED_H
#define TESTS_SCENES_SOLVER_NAMED_H

#include <string.h>

#include "visibility/solver.h"

/* The solver of a method with that name; NULL where there is none. */
static inline const struct solver *solver_named(const char *name) {
  for (const struct solver *const *s = solvers(); *s != NULL; s++)
    if (strcmp(recto_method_name((*s)->method), name) == 0)
      return *s;
  return NULL;
}

static inline const char *solver_name(const struct solver *solver) {
  return recto_method_name(solver->method);
}

#endif
