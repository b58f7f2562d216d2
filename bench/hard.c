/* hard.c - the scenes at which such programs are slow or never end, and those
 * that one method or another is best at: each by every exact method and by
 * auto, in CPU milliseconds from the scene in memory to the drawing; and what
 * auto takes over the best of them, for the whole and for its solver alone.
 *
 *   hard                        prints the table
 *   hard NAME...                prints the rows of these scenes
 *   hard --draw SCENE METHOD    draws one scene once, for other instruments
 *
 * A figure is the median of rounds in which all methods take turns; within a
 * round a drawing that takes no time is made again and again.  Drawings of
 * more than a second are made once.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "bench/table.h"
#include "tests/scenes/exact.h"
#include "tests/scenes/pipeline.h"
#include "tests/scenes/solver_named.h"

enum { LIMIT_S = 20, ROUNDS = 5, AGAIN_MAX = 400, METHODS_MAX = 12 };

static const double ROUND_S = 0.04, SLOW_S = 1;

/* ---- Scenes -------------------------------------------------------------- */

#define FILL(name, call)                                                       \
  static void fill_##name(struct scene *scene, recto_options *options) { call; }

FILL(cube, scenes_cube(scene, options, 0))
FILL(globe, scenes_globe(scene, options, 10))
FILL(fine_globe, scenes_globe(scene, options, 150))
FILL(sinc, scenes_sinc(scene, options, 200))
FILL(sinc_above, scenes_sinc(scene, options, 200); scenes_view_above(options))
FILL(globe_outline, scenes_globe(scene, options, 150);
     options->ink.edges = RECTO_EDGE_SILHOUETTE | RECTO_EDGE_CREASE)
FILL(stack, scenes_cube_stack(scene, options, 30, 0))
FILL(table, scenes_large_table(scene, options))
FILL(cycles, scenes_cycle_field(scene, options, 12))
FILL(plates_10, scenes_plates(scene, options, 10, false))
FILL(plates_40, scenes_plates(scene, options, 40, false))
FILL(plates_200, scenes_plates(scene, options, 200, false))
FILL(plates_1000, scenes_plates(scene, options, 1000, false))
FILL(above_40, scenes_plates(scene, options, 40, true))
FILL(above_200, scenes_plates(scene, options, 200, true))
FILL(above_1000, scenes_plates(scene, options, 1000, true))
FILL(shells_5, scenes_shells(scene, options, 5, 12))
FILL(shells_50, scenes_shells(scene, options, 50, 12))
FILL(shells_fine, scenes_shells(scene, options, 12, 60))
FILL(fan_200, scenes_fan(scene, options, 200))
FILL(fan_2000, scenes_fan(scene, options, 2000))
FILL(honeycomb, scenes_honeycomb(scene, options, 40))
FILL(lattice, scenes_lattice(scene, options, 200))
FILL(sponge, scenes_menger(scene, options, 3))
FILL(pipe, scenes_pipe(scene, options, 200, 100))
FILL(sticks, scenes_sticks(scene, options, 1000, 1))
FILL(soup_100, scenes_soup(scene, options, 100, 1))
FILL(soup_1000, scenes_soup(scene, options, 1000, 1))
FILL(soup, scenes_soup(scene, options, 10000, 1))
FILL(large_soup, scenes_soup(scene, options, 100000, 1))
FILL(disc, scenes_needles(scene, options, SCENES_NEEDLES_DISC, 100000, 1))
FILL(comb, scenes_needles(scene, options, SCENES_NEEDLES_COMB, 100000, 1))
FILL(cone, scenes_needles(scene, options, SCENES_NEEDLES_CONE, 100000, 1))

static const struct hard_scene {
  const char *name;
  void (*fill)(struct scene *scene, recto_options *options);
  bool painted; /* faces too, in a row of its own */
} hard_scenes[] = {
    {"cube", fill_cube, true},
    {"globe-10", fill_globe, true},
    {"globe-150", fill_fine_globe, true},
    {"globe-outline", fill_globe_outline, false},
    {"sinc-200", fill_sinc, true},
    {"sinc-above", fill_sinc_above, true},
    {"cube-stack-30", fill_stack, true},
    {"table", fill_table, true},
    {"cycles-12x12", fill_cycles, true},
    {"plates-10", fill_plates_10, true},
    {"plates-40", fill_plates_40, true},
    {"plates-200", fill_plates_200, true},
    {"plates-1000", fill_plates_1000, false},
    {"above-40", fill_above_40, true},
    {"above-200", fill_above_200, true},
    {"above-1000", fill_above_1000, true},
    {"shells-5x12", fill_shells_5, true},
    {"shells-50x12", fill_shells_50, true},
    {"shells-12x60", fill_shells_fine, false},
    {"fan-200", fill_fan_200, true},
    {"fan-2000", fill_fan_2000, true},
    {"honeycomb-40", fill_honeycomb, false},
    {"lattice-200", fill_lattice, true},
    {"sponge-3", fill_sponge, true},
    {"pipe-200x100", fill_pipe, false},
    {"sticks-1000", fill_sticks, false},
    {"soup-100", fill_soup_100, true},
    {"soup-1000", fill_soup_1000, true},
    {"soup-10000", fill_soup, false},
    {"soup-100000", fill_large_soup, false},
    {"disc-100000", fill_disc, true},
    {"comb-100000", fill_comb, true},
    {"cone-100000", fill_cone, true},
};
enum { SCENES = sizeof hard_scenes / sizeof *hard_scenes };

/* ---- Methods ------------------------------------------------------------- */

/* The current solver, and the time of its last run. */
static const struct solver *timed;
static double timed_s;

static recto_status solve_timed(struct sheet *sheet,
                                const struct solver_request *request,
                                struct map *map, struct report *report,
                                recto_error *error) {
  const char *why;
  double start = clock_cpu();
  const struct solver *solver =
      timed != NULL ? timed : solver_choose(sheet, request, &why);
  recto_status status = solver->solve(sheet, request, map, report, error);
  timed_s = clock_cpu() - start;
  return status;
}

static const struct solver solver_timed = {RECTO_METHOD_AUTO, solve_timed};

/* ---- Measuring ----------------------------------------------------------- */

/* CPU seconds of a drawing; infinite where it took too long or failed. */
struct cost {
  double whole, solver;
};

static bool draw(const struct scene *scene, const recto_options *options,
                 struct cost *cost) {
  struct pipeline pipeline;
  double start = clock_cpu();
  pipeline_run(&pipeline, scene, options, &solver_timed);
  bool ok = pipeline.status == RECTO_OK;
  pipeline_fini(&pipeline);
  cost->whole = clock_cpu() - start;
  cost->solver = timed_s;
  return ok;
}

static void fill_scene(const struct hard_scene *what, bool painted,
                       struct scene *scene, recto_options *options) {
  recto_options_init(options);
  scene_init(scene);
  what->fill(scene, options);
  options->solver.threads = 1;
  if (painted)
    options->ink.fill = RECTO_FILL_PAINT;
}

/* Draws as often as a round has time for: the medians. */
static struct cost draw_again(const struct hard_scene *what, bool painted) {
  static double whole[AGAIN_MAX], solver[AGAIN_MAX];
  struct scene scene;
  recto_options options;
  struct cost cost = {INFINITY, INFINITY};
  size_t n = 0;
  fill_scene(what, painted, &scene, &options);
  double start = clock_cpu();
  do {
    if (!draw(&scene, &options, &cost))
      return (struct cost){INFINITY, INFINITY};
    whole[n] = cost.whole;
    solver[n++] = cost.solver;
  } while (n < AGAIN_MAX && clock_cpu() - start < ROUND_S);
  scene_fini(&scene);
  return (struct cost){median_of(whole, n), median_of(solver, n)};
}

/* One round in a process of its own.
 * solver  NULL: auto */
static struct cost measure(const struct hard_scene *what, bool painted,
                           const struct solver *solver) {
  struct cost cost = {INFINITY, INFINITY};
  int ends[2];
  fflush(NULL);
  if (pipe(ends) != 0)
    return cost;
  pid_t child = fork();
  if (child == 0) {
    timed = solver;
    cost = draw_again(what, painted);
    _exit(write(ends[1], &cost, sizeof cost) != (ssize_t)sizeof cost);
  }
  close(ends[1]);
  struct cost answer;
  if (child > 0 && run_answer(child, ends[0], LIMIT_S, &answer,
                              sizeof answer) == RUN_ANSWERED)
    cost = answer;
  return cost;
}

/* What one method took, round by round. */
struct series {
  double whole[ROUNDS], solver[ROUNDS];
  size_t count;
};

static void keep(struct series *series, struct cost cost) {
  series->whole[series->count] = cost.whole;
  series->solver[series->count++] = cost.solver;
}

static void print_figure(double s) {
  if (isfinite(s))
    printf(" %9.3f", 1e3 * s);
  else
    printf("   > %3d s", LIMIT_S);
}

/* The exact methods; the last one, NULL, is auto. */
static size_t list_methods(const struct solver *method[METHODS_MAX]) {
  size_t n = 0;
  for (const struct solver *const *s = solvers(); *s != NULL; s++)
    if (is_exact(*s) && n + 1 < METHODS_MAX)
      method[n++] = *s;
  method[n++] = NULL;
  return n;
}

static void print_row(const struct hard_scene *what, bool painted) {
  const struct solver *method[METHODS_MAX];
  static struct series series[METHODS_MAX];
  size_t methods = list_methods(method);
  for (size_t m = 0; m < methods; m++)
    series[m].count = 0;
  for (size_t round = 0; round < ROUNDS; round++)
    for (size_t m = 0; m < methods; m++)
      if (round == 0 || series[m].whole[0] < SLOW_S)
        keep(&series[m], measure(what, painted, method[m]));
  struct cost best = {INFINITY, INFINITY}, cost = best;
  printf("%-14s %-5s", what->name, painted ? "faces" : "lines");
  for (size_t m = 0; m < methods; m++) {
    cost.whole = median_of(series[m].whole, series[m].count);
    cost.solver = median_of(series[m].solver, series[m].count);
    print_figure(cost.whole);
    if (method[m] != NULL) {
      best.whole = fmin(best.whole, cost.whole);
      best.solver = fmin(best.solver, cost.solver);
    }
  }
  printf(" %9.2f %6.2f\n", cost.whole / best.whole, cost.solver / best.solver);
  fflush(stdout);
}

static void print_heading(void) {
  const struct solver *method[METHODS_MAX];
  size_t methods = list_methods(method);
  printf("\nHard scenes: CPU milliseconds, medians of %d runs, one thread\n"
         "%-20s",
         ROUNDS, "scene");
  for (size_t m = 0; m < methods; m++)
    printf(" %9s", method[m] != NULL ? solver_name(method[m]) : "auto");
  printf(" %9s %6s\n", "auto/best", "solver");
}

/* ---- One drawing --------------------------------------------------------- */

static int draw_one(const char *name, const char *method) {
  struct scene scene;
  recto_options options;
  struct cost cost;
  int k = 0;
  while (k < SCENES && strcmp(hard_scenes[k].name, name) != 0)
    k++;
  timed = strcmp(method, "auto") == 0 ? NULL : solver_named(method);
  if (k == SCENES || (timed == NULL && strcmp(method, "auto") != 0))
    return 2;
  fill_scene(&hard_scenes[k], false, &scene, &options);
  bool ok = draw(&scene, &options, &cost);
  scene_fini(&scene);
  return !ok;
}

static bool is_named(const char *name, int argc, char **argv) {
  for (int i = 1; i < argc; i++)
    if (strcmp(name, argv[i]) == 0)
      return true;
  return argc < 2;
}

int main(int argc, char **argv) {
  if (argc == 4 && strcmp(argv[1], "--draw") == 0)
    return draw_one(argv[2], argv[3]);
  print_heading();
  for (int k = 0; k < SCENES; k++) {
    if (!is_named(hard_scenes[k].name, argc, argv))
      continue;
    print_row(&hard_scenes[k], false);
    if (hard_scenes[k].painted)
      print_row(&hard_scenes[k], true);
  }
  return 0;
}
