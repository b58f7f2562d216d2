/* accuracy.c - what approximate methods get wrong, and how long they take:
 * their maps against the exact one, finer and finer.  Areas: given to the wrong
 * face, to none, beyond the exact map's, to a second fragment.
 *
 *   accuracy CHART.svg
 *
 * RECTO_MODELS in the environment names the folder of the real meshes; without
 * it only the soup is drawn.  A table goes to standard output, the chart to
 * the file. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/chart.h"
#include "bench/table.h"
#include "scene/read.h"
#include "tests/measure/trial.h"
#include "tests/scenes/pipeline.h"

enum { runs = 3, page_mm = 200 };

static const int lines[] = {128, 256, 512, 1024, 2048, 4096};
enum { line_counts = sizeof lines / sizeof *lines };

/* By name: a method that this build does not have is passed over. */
static const char *const rough[] = {"zbuffer", "scanline-zbuffer", "watkins",
                                    "warnock", "painter",          NULL};
static const char *const exact[] = {"tiles", "newell", "warnock", "watkins",
                                    NULL};

struct row {
  struct measure measure;
  double fragments_s, strokes_s; /* CPU of the solver, medians */
  bool ok;
};

static void set_view(recto_options *options) {
  recto_options_init(options);
  options->camera.azimuth_deg = 30;
  options->camera.elevation_deg = 20;
  options->page.width_mm = options->page.height_mm = page_mm;
  options->page.margin_mm = 5;
}

/* The median time of a part; the last map against the exact one. */
static double take_part(const struct scene *scene, const recto_options *options,
                        const struct solver *solver, int count,
                        enum trial_part part, const struct trial *truth,
                        struct measure *measure, bool *good) {
  double seconds[RUNS_MAX];
  for (size_t i = 0; i < runs; i++) {
    struct trial trial;
    trial_run(&trial, scene, options, solver, count, part);
    seconds[i] = trial.solve_s;
    if (trial.status != RECTO_OK ||
        (i == 0 && !measure_map(measure, &truth->sheet, &truth->map,
                                &trial.sheet, &trial.map)))
      *good = false;
    trial_fini(&trial);
  }
  return median_of(seconds, runs);
}

static void take_row(struct row *row, const struct scene *scene,
                     const recto_options *options, const struct solver *solver,
                     int count, const struct trial truth[2]) {
  struct measure ink = {0};
  row->ok = true;
  row->fragments_s = take_part(scene, options, solver, count, TRIAL_FRAGMENTS,
                               &truth[0], &row->measure, &row->ok);
  row->strokes_s = take_part(scene, options, solver, count, TRIAL_EDGES,
                             &truth[1], &ink, &row->ok);
  row->measure.true_ink = ink.true_ink;
  row->measure.missing_ink = ink.missing_ink;
  row->measure.false_ink = ink.false_ink;
}

static void print_heading(const char *name, const struct measure *truth) {
  printf("\n%s: %.0f mm2 covered, %.0f mm of lines seen\n", name,
         truth->true_area, truth->true_ink);
  printf("%-17s %5s %8s %9s %9s %9s %9s %8s %9s %9s %8s\n", "method", "lines",
         "pitch mm", "wrong", "missing", "false", "twice", "faces s", "missing",
         "false", "lines s");
}

/* A sum of areas that is nothing but rounding is nothing. */
static double clean(double area) { return fabs(area) < 0.0005 ? 0 : area; }

static void print_row(const char *method, int count, const struct row *row) {
  const struct measure *m = &row->measure;
  printf("%-17s ", method);
  if (!row->ok) {
    printf("failed\n");
    return;
  }
  if (count > 0)
    printf("%5d %8.4f ", count, (double)page_mm / count);
  else
    printf("%5s %8s ", "", "");
  printf("%9.3f %9.3f %9.3f %9.3f %8.4f %9.3f %9.3f %8.4f\n",
         clean(m->wrong_face), clean(m->missing_area), clean(m->false_area),
         clean(m->twice_area), row->fragments_s, m->missing_ink, m->false_ink,
         row->strokes_s);
  fflush(stdout);
}

/* A method's rows: one for each number of lines; one for a method without. */
static void take_method(struct chart *chart, const struct scene *scene,
                        const recto_options *options, const char *name,
                        bool has_lines, const struct trial truth[2]) {
  const struct solver *solver = solver_by_name(name);
  if (solver == NULL)
    return;
  for (size_t i = 0; i < (has_lines ? line_counts : 1); i++) {
    int count = has_lines ? lines[i] : 0;
    struct row row;
    take_row(&row, scene, options, solver, count, truth);
    print_row(name, count, &row);
    if (!row.ok)
      continue;
    chart_add(chart, CHART_AREA, name, row.fragments_s,
              clean(measure_area_share(&row.measure) * row.measure.true_area) /
                  row.measure.true_area);
    chart_add(chart, CHART_INK, name, row.strokes_s,
              measure_ink_share(&row.measure));
  }
}

static void take_exact(struct chart *chart, const struct scene *scene,
                       const recto_options *options, const char *name,
                       const struct trial truth[2]) {
  const struct solver *solver = solver_by_name(name);
  struct row row;
  if (solver == NULL)
    return;
  take_row(&row, scene, options, solver, 0, truth);
  print_row(name, 0, &row);
  if (row.ok) {
    chart_add(chart, CHART_AREA, name, row.fragments_s, 0);
    chart_add(chart, CHART_INK, name, row.strokes_s, 0);
  }
}

static void take_scene(struct chart *chart, const struct scene *scene,
                       const recto_options *options, const char *name) {
  static const enum trial_part part[2] = {TRIAL_FRAGMENTS, TRIAL_EDGES};
  struct trial truth[2];
  struct row against = {0};
  for (int i = 0; i < 2; i++)
    trial_run(&truth[i], scene, options, &solver_tiles, 0, part[i]);
  if (truth[0].status == RECTO_OK && truth[1].status == RECTO_OK) {
    chart_open(chart, name);
    take_row(&against, scene, options, &solver_tiles, 0, truth);
    print_heading(name, &against.measure);
    for (size_t i = 0; exact[i] != NULL; i++)
      take_exact(chart, scene, options, exact[i], truth);
    for (size_t i = 0; rough[i] != NULL; i++)
      take_method(chart, scene, options, rough[i],
                  strcmp(rough[i], "painter") != 0, truth);
  }
  for (int i = 0; i < 2; i++)
    trial_fini(&truth[i]);
}

static void take_model(struct chart *chart, const char *folder,
                       const char *name) {
  char path[4096];
  struct scene scene;
  struct diagnostics silent = {.file = path};
  recto_options options;
  snprintf(path, sizeof path, "%s/%s.obj", folder, name);
  set_view(&options);
  scene_init(&scene);
  if (scene_read(&scene, path, NULL, &silent, NULL) == RECTO_OK)
    take_scene(chart, &scene, &options, name);
  scene_fini(&scene);
}

static void take_soup(struct chart *chart) {
  struct scene scene;
  recto_options options;
  set_view(&options);
  scene_init(&scene);
  scenes_soup(&scene, &options, 1000, 1);
  take_scene(chart, &scene, &options, "soup of 1000");
  scene_fini(&scene);
}

int main(int argc, char **argv) {
  const char *folder = getenv("RECTO_MODELS");
  struct chart chart;
  if (argc != 2) {
    fputs("usage: accuracy CHART.svg\n", stderr);
    return 2;
  }
  printf("Against the exact map, in mm2 and mm; CPU seconds of the solver, "
         "medians of %d runs.\n",
         runs);
  chart_init(&chart);
  if (folder != NULL) {
    take_model(&chart, folder, "spot");
    take_model(&chart, folder, "fandisk");
  }
  take_soup(&chart);
  bool ok = chart_write(&chart, argv[1]);
  chart_fini(&chart);
  if (!ok)
    fprintf(stderr, "accuracy: cannot write %s\n", argv[1]);
  return ok ? 0 : 1;
}
