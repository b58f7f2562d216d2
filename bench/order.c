/* order.c - how much shorter --order near makes the pen's way in the air, how
 * long that takes, and how much more the same moves would gain without a
 * budget.
 *
 *   order EXAMPLES
 *
 * RECTO_MODELS in the environment names the folder of the real meshes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "ink/order/stroke_order.h"
#include "scene/read.h"
#include "tests/scenes/pipeline.h"
#include "tests/scenes/random.h"

/* Makes an initialised, empty drawing; false: there is none. */
typedef bool (*draw_fn)(const void *how, struct drawing *drawing);

/* ---- Drawings ------------------------------------------------------------ */

struct plot {
  const char *path;
  unsigned edges;
  recto_fill fill;
  bool lit, ids;
};

static bool draw_plot(const void *how, struct drawing *drawing) {
  const struct plot *plot = how;
  struct diagnostics silent = {.file = plot->path};
  struct pipeline pipeline;
  struct scene scene;
  recto_options options;
  recto_options_init(&options);
  options.ink.edges = plot->edges;
  options.ink.fill = plot->fill;
  options.ink.ids = plot->ids;
  if (plot->lit) {
    options.ink.light[0] = -1;
    options.ink.light[1] = options.ink.light[2] = 1;
  }
  scene_init(&scene);
  bool ok = scene_read(&scene, plot->path, NULL, &silent, NULL) == RECTO_OK;
  if (ok) {
    pipeline_run(&pipeline, &scene, &options, &solver_tiles);
    ok = pipeline.status == RECTO_OK;
    if (ok) {
      *drawing = pipeline.drawing;
      drawing_init(&pipeline.drawing);
    }
    pipeline_fini(&pipeline);
  }
  scene_fini(&scene);
  return ok;
}

struct scatter {
  uint32_t count;
  double length;
};

/* Straight strokes at random over a page. */
static bool draw_scatter(const void *how, struct drawing *drawing) {
  const struct scatter *scatter = how;
  struct random random = {1};
  bool ok = ARRAY_PUSH(&drawing->layer, ((struct drawing_layer){.pen = 1}));
  for (uint32_t i = 0; ok && i < scatter->count; i++) {
    struct drawing_stroke stroke = {.point = 2 * i, .count = 2};
    double turn = random_between(&random, 0, 2 * acos(-1.0));
    struct drawing_point p = {random_between(&random, 10, 200),
                              random_between(&random, 10, 287)};
    struct drawing_point q = {p.x + scatter->length * cos(turn),
                              p.y + scatter->length * sin(turn)};
    ok = ARRAY_PUSH(&drawing->stroke, stroke) &&
         ARRAY_PUSH(&drawing->point, p) && ARRAY_PUSH(&drawing->point, q);
  }
  return ok;
}

/* ---- The table ----------------------------------------------------------- */

static void print_row(const char *name, const char *what, draw_fn draw,
                      const void *how) {
  const struct tour_effort endless = {INFINITY, INFINITY};
  const struct tour_effort *effort[] = {&stroke_order_usual_effort, &endless};
  double after[2], seconds[2];
  for (int i = 0; i < 2; i++) {
    struct drawing drawing;
    drawing_init(&drawing);
    if (!draw(how, &drawing)) {
      drawing_fini(&drawing);
      return;
    }
    if (i == 0)
      printf("%-16s %-14s %8zu %10.0f", name, what, drawing.stroke.count,
             drawing_travel_mm(&drawing));
    double start = clock_cpu();
    bool ok = stroke_order_improve(&drawing, effort[i]);
    seconds[i] = ok ? clock_cpu() - start : NAN;
    after[i] = drawing_travel_mm(&drawing);
    drawing_fini(&drawing);
  }
  printf(" %9.0f %7.3f %10.0f %8.3f %+6.2f %%\n", after[0], seconds[0],
         after[1], seconds[1], 100 * (after[0] / after[1] - 1));
  fflush(stdout);
}

static void print_model(const char *folder, const char *name) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%s.obj", folder, name);
  const struct {
    const char *what;
    struct plot plot;
  } row[] = {
      {"features", {path, RECTO_EDGES_DEFAULT, RECTO_FILL_NONE, false, false}},
      {"all edges", {path, RECTO_EDGES_ALL, RECTO_FILL_NONE, false, false}},
      {"edge by edge", {path, RECTO_EDGES_ALL, RECTO_FILL_NONE, false, true}},
      {"hatched", {path, RECTO_EDGES_DEFAULT, RECTO_FILL_HATCH, false, false}},
      {"hatched, lit",
       {path, RECTO_EDGES_DEFAULT, RECTO_FILL_HATCH, true, false}},
  };
  for (size_t i = 0; i < sizeof row / sizeof *row; i++)
    print_row(name, row[i].what, draw_plot, &row[i].plot);
}

int main(int argc, char **argv) {
  static const char *const own[] = {"castle", "gears", "knot"};
  static const char *const real[] = {"suzanne", "spot",    "cow",
                                     "teapot",  "fandisk", "stanford-bunny"};
  const char *models = getenv("RECTO_MODELS");
  if (argc != 2) {
    fputs("usage: order EXAMPLES\n", stderr);
    return 2;
  }
  printf("\nOrder of strokes: pen-up travel in mm and CPU seconds; what the "
         "same moves reach\nwithout a budget, and how much longer the travel "
         "is than that.\n");
  printf("%-16s %-14s %8s %10s %9s %7s %10s %8s %8s\n", "model", "lines",
         "strokes", "before", "after", "s", "endless", "s", "longer");
  for (size_t i = 0; i < sizeof own / sizeof *own; i++)
    print_model(argv[1], own[i]);
  for (size_t i = 0; models != NULL && i < sizeof real / sizeof *real; i++)
    print_model(models, real[i]);
  for (double length = 0.1; length < 11; length *= 10) {
    char what[32];
    struct scatter scatter = {100000, length};
    snprintf(what, sizeof what, "of %g mm", length);
    print_row("at random", what, draw_scatter, &scatter);
  }
  return 0;
}
