/* solver.c - the table of visibility methods. */
#include "visibility/solver.h"

#include <string.h>

static const struct solver *const table[] = {
    &solver_newell,  &solver_warnock,
    &solver_watkins, &solver_tiles,
    &solver_zbuffer, &solver_scanline_zbuffer,
    &solver_painter, &solver_painter_given,
    &solver_brute,   NULL};

const struct solver *const *solvers(void) { return table; }

const struct solver *solver_by_method(recto_method method) {
  for (size_t i = 0; table[i] != NULL; i++)
    if (table[i]->method == method)
      return table[i];
  return NULL;
}

const struct solver *solver_by_name(const char *name) {
  for (size_t i = 0; table[i] != NULL; i++)
    if (strcmp(table[i]->name, name) == 0)
      return table[i];
  return NULL;
}
