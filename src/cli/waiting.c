/* waiting.c - lets idle OpenMP threads sleep rather than spin.
 *
 * Spinning costs small scenes more than they gain where cores are shared.  The
 * runtime reads its variables when it is loaded, before main: so this stands
 * where the loader looks even earlier.  What the user has set wins. */
#ifdef _OPENMP

#include <stdlib.h>

typedef void early_function(int argc, char **argv, char **environment);

static void choose_passive_waiting(int argc, char **argv, char **environment) {
  (void)argc;
  (void)argv;
  (void)environment;
  (void)setenv("OMP_WAIT_POLICY", "passive", 0);
}

__attribute__((section(".preinit_array"),
               used)) static early_function *const early =
    choose_passive_waiting;

#endif
