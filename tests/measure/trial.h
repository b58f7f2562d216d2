/* trial.h - a scene by one method: the map, and the CPU time to find it. */
#ifndef TESTS_MEASURE_TRIAL_H
#define TESTS_MEASURE_TRIAL_H

#include "tests/measure/measure.h"
#include "visibility/solver.h"

struct trial {
  struct topology topology;
  struct camera camera;
  struct sheet sheet;
  struct map map;
  double solve_s; /* CPU, of the solver alone */
  recto_status status;
};

enum trial_part { TRIAL_EDGES = 1, TRIAL_FRAGMENTS = 2, TRIAL_BOTH = 3 };

/* What is requested of a solver for a part: no hidden lines, one thread.
 * lines  over the page, for methods that have a number of them, and as
 *        many a page is the pitch between; 0: exact, where a method is */
struct solver_request trial_request(const recto_options *options, int lines,
                                    enum trial_part part);

/* Solves the scene; look at `status` first.  Always ends with trial_fini.
 * lines  as of trial_request */
void trial_run(struct trial *trial, const struct scene *scene,
               const recto_options *options, const struct solver *solver,
               int lines, enum trial_part part);
/* The same by a request of one's own.
 * solver  NULL: the one that the method auto takes; its choice is timed too */
void trial_run_request(struct trial *trial, const struct scene *scene,
                       const recto_options *options,
                       const struct solver *solver,
                       const struct solver_request *request);
void trial_fini(struct trial *trial);

#endif
