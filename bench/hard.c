/* hard.c - the scenes at which such programs are slow or never end: each by
 * every exact method and by auto, in CPU seconds from the scene in memory to
 * the drawing; and what auto takes over the best of them.
 *
 *   hard                 prints the table
 *   hard SCENE METHOD    draws one, for the table: its CPU time is the answer
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/table.h"
#include "tests/scenes/pipeline.h"

enum { limit_s = 20 };

static void fill_lattice(struct scene *scene, recto_options *options) {
  scenes_lattice(scene, options, 200);
}

static void fill_sponge(struct scene *scene, recto_options *options) {
  scenes_menger(scene, options, 3);
}

static void fill_pipe(struct scene *scene, recto_options *options) {
  scenes_pipe(scene, options, 200, 100);
}

static void fill_honeycomb(struct scene *scene, recto_options *options) {
  scenes_honeycomb(scene, options, 40);
}

static void fill_sticks(struct scene *scene, recto_options *options) {
  scenes_sticks(scene, options, 1000, 1);
}

static void fill_soup(struct scene *scene, recto_options *options) {
  scenes_soup(scene, options, 10000, 1);
}

static void fill_large_soup(struct scene *scene, recto_options *options) {
  scenes_soup(scene, options, 100000, 1);
}

static void fill_disc(struct scene *scene, recto_options *options) {
  scenes_crowd(scene, options, SCENES_CROWD_DISC, 100000, 1);
}

static void fill_comb(struct scene *scene, recto_options *options) {
  scenes_crowd(scene, options, SCENES_CROWD_COMB, 100000, 1);
}

static void fill_cone(struct scene *scene, recto_options *options) {
  scenes_crowd(scene, options, SCENES_CROWD_CONE, 100000, 1);
}

static const struct hard_scene {
  const char *name;
  void (*fill)(struct scene *scene, recto_options *options);
} hard_scenes[] = {
    {"honeycomb-40", fill_honeycomb}, {"lattice-200", fill_lattice},
    {"sponge-3", fill_sponge},        {"pipe-200x100", fill_pipe},
    {"sticks-1000", fill_sticks},     {"soup-10000", fill_soup},
    {"soup-100000", fill_large_soup}, {"disc-100000", fill_disc},
    {"comb-100000", fill_comb},       {"cone-100000", fill_cone},
};
enum { hard_count = sizeof hard_scenes / sizeof *hard_scenes };

static recto_status solve_auto(struct sheet *sheet,
                               const struct solver_request *request,
                               struct map *map, struct report *report,
                               recto_error *error) {
  const char *why;
  return solver_choose(sheet, request, &why)
      ->solve(sheet, request, map, report, error);
}

static const struct solver solver_auto = {RECTO_METHOD_AUTO, "auto", true,
                                          solve_auto};

/* Draws one scene; the exit status. */
static int draw(const char *name, const char *method) {
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  const struct solver *solver = strcmp(method, solver_auto.name) == 0
                                    ? &solver_auto
                                    : solver_by_name(method);
  int k = 0;
  while (k < hard_count && strcmp(hard_scenes[k].name, name) != 0)
    k++;
  if (k == hard_count || solver == NULL)
    return 2;
  recto_options_init(&options);
  scene_init(&scene);
  hard_scenes[k].fill(&scene, &options);
  options.threads = 1;
  pipeline_run(&pipeline, &scene, &options, solver);
  int status = pipeline.status == RECTO_OK ? 0 : 1;
  pipeline_fini(&pipeline);
  scene_fini(&scene);
  return status;
}

/* CPU seconds of one scene by one method; infinite where it took too long. */
static double measure(const char *self, const char *scene, const char *method) {
  const char *const argv[] = {self, scene, method, NULL};
  struct run run;
  run_program(&run, argv, limit_s);
  return run.status == 0 ? run.cpu_s : INFINITY;
}

static void print_scene(const char *self, const char *scene) {
  double best = INFINITY, by_auto = measure(self, scene, solver_auto.name);
  printf("%-14s", scene);
  for (const struct solver *const *s = solvers(); *s != NULL; s++) {
    if (!(*s)->exact)
      continue;
    double cpu = measure(self, scene, (*s)->name);
    best = fmin(best, cpu);
    if (isfinite(cpu))
      printf(" %8.3f", cpu);
    else
      printf("   > %d s", limit_s);
    fflush(stdout);
  }
  printf(" %8.3f %10.2f\n", by_auto, by_auto / best);
  fflush(stdout);
}

int main(int argc, char **argv) {
  if (argc == 3)
    return draw(argv[1], argv[2]);
  printf("\nHard scenes: CPU seconds, one run each, one thread\n%-14s",
         "scene");
  for (const struct solver *const *s = solvers(); *s != NULL; s++)
    if ((*s)->exact)
      printf(" %8s", (*s)->name);
  printf(" %8s %10s\n", solver_auto.name, "auto/best");
  for (int k = 0; k < hard_count; k++)
    print_scene(argv[0], hard_scenes[k].name);
  return 0;
}
