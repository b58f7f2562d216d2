/* dense.c - dense meshes: how long a whole drawing takes beside a plain depth
 * buffer of the same mesh, and how both grow with it.
 *
 *   dense RECTO ZRASTER EXAMPLES [LEVELS]
 *
 * The bunny from the folder RECTO_MODELS names, or else the knot of the
 * examples, LEVELS times (default 2) four times as fine by Loop's rule.
 * Depth buffer, features and all edges take turns, run after run, one thread
 * each; the figures are medians. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "bench/model.h"

enum { RUNS = 5, LIMIT_S = 300, LEVELS_MAX = 4 };

/* What all runs of a kind gave. */
struct series {
  double stage[MODEL_STAGES][RUNS], cpu[RUNS], wall[RUNS], peak[RUNS];
};

struct dense {
  const char *recto, *zraster;
  char folder[64];
  double coarse[2]; /* CPU seconds a triangle at the first level */
};

static void print_heading(void) {
  printf("\n%-9s %-8s", "triangles", "lines");
  for (size_t k = 0; k < MODEL_STAGES; k++)
    printf(" %7s", model_stage_name[k]);
  printf(" %8s %7s %6s %6s %7s %7s\n", "CPU", "wall", "MB", "B/tri", "ratio",
         "growth");
}

static void keep(struct series *series, size_t i, const struct run *run) {
  bool ok = run->status == 0;
  series->cpu[i] = ok ? run->cpu_s : NAN;
  series->wall[i] = ok ? run->wall_s : NAN;
  series->peak[i] = ok ? run->peak_mb : NAN;
}

static void draw(const struct dense *dense, const struct model *model,
                 const char *edges, struct series *series, size_t i) {
  const struct model_job job = {dense->recto, dense->folder, "auto",
                                edges,        "1",           LIMIT_S};
  struct run run;
  double stage[MODEL_STAGES];
  model_draw(&run, stage, model, &job);
  for (size_t k = 0; k < MODEL_STAGES; k++)
    series->stage[k][i] = stage[k];
  keep(series, i, &run);
}

/* One row; `coarse` is set at the first level and compared with after it. */
static void print_row(const struct model *model, const char *lines,
                      struct series *series, double raster, double *coarse) {
  double cpu = median_of(series->cpu, RUNS),
         peak = median_of(series->peak, RUNS);
  if (*coarse == 0)
    *coarse = cpu / model->triangles;
  printf("%9.0f %-8s", model->triangles, lines);
  for (size_t k = 0; k < MODEL_STAGES; k++)
    printf(" %7.3f", median_of(series->stage[k], RUNS));
  printf(" %8.3f %7.3f %6.0f %6.0f %7.2f %7.2f\n", cpu,
         median_of(series->wall, RUNS), peak, 1e6 * peak / model->triangles,
         cpu / raster, cpu / model->triangles / *coarse);
}

static void print_level(struct dense *dense, const struct model *model) {
  static struct series raster, features, all;
  for (size_t i = 0; i < RUNS; i++) {
    struct run run;
    model_raster(&run, model, dense->zraster, LIMIT_S);
    keep(&raster, i, &run);
    draw(dense, model, model_features, &features, i);
    draw(dense, model, "all", &all, i);
  }
  double seconds = median_of(raster.cpu, RUNS);
  printf("%9.0f depth buffer: CPU %.3f s, %.0f MB\n", model->triangles, seconds,
         median_of(raster.peak, RUNS));
  print_row(model, "features", &features, seconds, &dense->coarse[0]);
  print_row(model, "all", &all, seconds, &dense->coarse[1]);
  fflush(stdout);
}

static int measure(struct dense *dense, const char *examples, int levels) {
  static const char *const level[LEVELS_MAX] = {"x 4", "x 16", "x 64", "x 256"};
  const char *models = getenv("RECTO_MODELS");
  struct model model;
  struct scene scene;
  if ((models == NULL ||
       !model_open(&model, &scene, models, "stanford-bunny")) &&
      !model_open(&model, &scene, examples, "knot")) {
    fputs("dense: no model\n", stderr);
    return 1;
  }
  print_heading();
  print_level(dense, &model);
  int done = 0;
  for (; done < levels; done++) {
    if (!model_refine(&model, &scene, dense->folder, level[done]))
      break;
    print_level(dense, &model);
  }
  if (done > 0)
    unlink(model.path);
  scene_fini(&scene);
  if (done < levels)
    fputs("dense: cannot write the finer model\n", stderr);
  return done < levels;
}

int main(int argc, char **argv) {
  static const char *const made[] = {"report.json", "drawing.svg"};
  struct dense dense = {.folder = "/tmp/recto-dense-XXXXXX"};
  int levels = argc == 5 ? atoi(argv[4]) : 2;
  if (argc < 4 || argc > 5 || levels < 0 || levels > LEVELS_MAX) {
    fputs("usage: dense RECTO ZRASTER EXAMPLES [LEVELS]\n", stderr);
    return 2;
  }
  dense.recto = argv[1];
  dense.zraster = argv[2];
  if (mkdtemp(dense.folder) == NULL) {
    fputs("dense: no temporary folder\n", stderr);
    return 1;
  }
  printf(
      "Dense meshes, one thread, CPU seconds, medians of %d runs; ratio: the "
      "whole\nprocess over a depth buffer of 4096 x 4096; growth: CPU a "
      "triangle over that of\nthe first mesh.\n",
      RUNS);
  int status = measure(&dense, argv[3], levels);
  for (size_t i = 0; i < 2; i++) {
    char path[100];
    snprintf(path, sizeof path, "%s/%s", dense.folder, made[i]);
    unlink(path);
  }
  rmdir(dense.folder);
  return status;
}
