/* trial.c - see trial.h. */
#include "tests/measure/trial.h"

#include "base/clock.h"
#include "view/camera_aim.h"
#include "view/layout.h"

#include <string.h>

struct solver_request trial_request(const recto_options *options, int lines,
                                    enum trial_part part) {
  struct solver_request request = solver_request_of(options);
  request.edges = (part & TRIAL_EDGES) != 0;
  request.fragments = (part & TRIAL_FRAGMENTS) != 0;
  request.hidden = false;
  request.intersections &= request.edges;
  request.resolution = lines;
  request.pitch_mm = lines > 0 ? options->page.height_mm / lines : 0;
  return request;
}

static recto_status solve(struct trial *trial, const struct solver *solver,
                          const struct solver_request *request) {
  const char *why;
  double start = clock_cpu();
  if (solver == NULL)
    solver = solver_choose(&trial->sheet, request, &why);
  recto_status status =
      solver->solve(&trial->sheet, request, &trial->map, NULL, NULL);
  trial->solve_s = clock_cpu() - start;
  return status;
}

void trial_run_request(struct trial *trial, const struct scene *scene,
                       const recto_options *options,
                       const struct solver *solver,
                       const struct solver_request *request) {
  memset(trial, 0, sizeof *trial);
  map_init(&trial->map);
  trial->status = topology_init(&trial->topology, scene, NULL);
  if (trial->status == RECTO_OK)
    trial->status = camera_aim(&trial->camera, scene, options, NULL);
  if (trial->status == RECTO_OK)
    trial->status =
        layout_sheet(&trial->sheet, scene, &trial->topology, &trial->camera,
                     options, request->fragments, NULL);
  if (trial->status == RECTO_OK)
    trial->status = solve(trial, solver, request);
}

void trial_run(struct trial *trial, const struct scene *scene,
               const recto_options *options, const struct solver *solver,
               int lines, enum trial_part part) {
  struct solver_request request = trial_request(options, lines, part);
  trial_run_request(trial, scene, options, solver, &request);
}

void trial_fini(struct trial *trial) {
  map_fini(&trial->map);
  sheet_fini(&trial->sheet);
  topology_fini(&trial->topology);
}
