/* bench.c - how long recto takes: stage by stage, in CPU seconds, with peak
 * memory; on the example models, on real meshes where they are, and on finer
 * and finer versions of one of them.
 *
 *   bench RECTO ZRASTER EXAMPLES [METHOD]...
 *
 * RECTO_MODELS in the environment names the folder of the real meshes.  Each
 * figure is the median of several runs of the whole program, file to SVG. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/report.h"
#include "bench/model.h"
#include "scene/read.h"

enum { runs = 3, limit_s = 120 };

struct bench {
  const char *recto, *zraster;
  char folder[64];           /* temporary */
  const char *const *method; /* methods to try, ended by NULL */
};

/* ---- Models -------------------------------------------------------------- */

static void put_float(unsigned char **at, double value) {
  float number = (float)value;
  memcpy(*at, &number, sizeof number);
  *at += sizeof number;
}

/* Writes triangles as binary STL (on a little-endian machine). */
static bool write_stl(const char *path, const struct scene *scene) {
  FILE *file = fopen(path, "wb");
  if (file == NULL)
    return false;
  unsigned char header[84] = {0};
  uint32_t count = scene_face_count(scene);
  memcpy(header + 80, &count, sizeof count);
  fwrite(header, sizeof header, 1, file);
  for (uint32_t i = 0; i < count; i++) {
    unsigned char facet[50] = {0}, *at = facet + 12;
    const uint32_t *corner = scene->corner.item + scene_face_start(scene, i);
    for (int k = 0; k < 3; k++) {
      const struct scene_point *p = &scene->point.item[corner[k]];
      put_float(&at, p->x);
      put_float(&at, p->y);
      put_float(&at, p->z);
    }
    fwrite(facet, sizeof facet, 1, file);
  }
  bool ok = !ferror(file);
  return fclose(file) == 0 && ok;
}

/* ---- Measuring ----------------------------------------------------------- */

enum { columns = MODEL_STAGES + 3 };

/* The medians of a row: the stages, CPU, wall, peak.  False where a run
 * failed or took too long. */
static bool measure(const struct bench *bench, const struct model *model,
                    const char *method, const char *edges,
                    double row[columns]) {
  double cell[columns][RUNS_MAX];
  const struct model_job job = {bench->recto, bench->folder, method,
                                edges,        "0",           limit_s};
  for (size_t i = 0; i < runs; i++) {
    struct run run;
    double stage[MODEL_STAGES];
    model_draw(&run, stage, model, &job);
    if (run.status != 0)
      return false;
    for (size_t k = 0; k < MODEL_STAGES; k++)
      cell[k][i] = stage[k];
    cell[MODEL_STAGES][i] = run.cpu_s;
    cell[MODEL_STAGES + 1][i] = run.wall_s;
    cell[MODEL_STAGES + 2][i] = run.peak_mb;
  }
  for (size_t k = 0; k < columns; k++)
    row[k] = median_of(cell[k], runs);
  return true;
}

static void print_heading(void) {
  printf("\n%-16s %9s %-8s %-8s", "model", "triangles", "method", "lines");
  for (size_t k = 0; k < MODEL_STAGES; k++)
    printf(" %7s", model_stage_name[k]);
  printf(" %8s %7s %6s %5s\n", "CPU", "wall", "MB", "B/tri");
}

static void print_row(const struct bench *bench, const struct model *model,
                      const char *method, const char *edges) {
  double row[columns];
  printf("%-16s %9.0f %-8s %-8s", model->name, model->triangles, method,
         strcmp(edges, "all") == 0 ? "all" : "features");
  if (!measure(bench, model, method, edges, row)) {
    printf(" failed, or over %d s\n", limit_s);
    return;
  }
  for (size_t k = 0; k < MODEL_STAGES; k++)
    printf(" %7.3f", row[k]);
  printf(" %8.3f %7.3f %6.0f %5.0f\n", row[MODEL_STAGES], row[MODEL_STAGES + 1],
         row[MODEL_STAGES + 2], 1e6 * row[MODEL_STAGES + 2] / model->triangles);
  fflush(stdout);
}

static void print_model(const struct bench *bench, const struct model *model) {
  for (size_t i = 0; bench->method[i] != NULL; i++) {
    print_row(bench, model, bench->method[i], model_features);
    print_row(bench, model, bench->method[i], "all");
  }
}

static void print_yardstick(const struct bench *bench,
                            const struct model *model) {
  double cpu[RUNS_MAX], peak[RUNS_MAX];
  for (size_t i = 0; i < runs; i++) {
    struct run run;
    model_raster(&run, model, bench->zraster, limit_s);
    cpu[i] = run.status == 0 ? run.cpu_s : NAN;
    peak[i] = run.peak_mb;
  }
  printf("%-16s %9.0f depth buffer of 4096 x 4096, whole process: %.3f s, "
         "%.0f MB\n",
         model->name, model->triangles, median_of(cpu, runs),
         median_of(peak, runs));
}

/* The median CPU seconds of the solver by a method with an option, drawing
 * these edges; *pixels gets how many pixels are covered, where the method says.
 * NAN where a run failed. */
static double take_solver(const struct bench *bench, const struct model *model,
                          const char *method, const char *option,
                          const char *edges, double *pixels) {
  char stats[100], report[90], output[90];
  double cpu[RUNS_MAX];
  snprintf(report, sizeof report, "%s/report.json", bench->folder);
  snprintf(stats, sizeof stats, "--stats=%s", report);
  snprintf(output, sizeof output, "%s/drawing.svg", bench->folder);
  const char *const argv[] = {bench->recto, model->path, "-m",   method,
                              option,       "-e",        edges,  "-p",
                              "200x200mm",  "--margin",  "5mm",  "-q",
                              stats,        "--azimuth", "15",   "--elevation",
                              "30",         "-o",        output, NULL};
  for (size_t i = 0; i < runs; i++) {
    struct run run;
    run_program(&run, argv, limit_s);
    char *text = read_file(report, NULL);
    cpu[i] = run.status == 0 ? report_number(text, "solve_cpu_s") : NAN;
    *pixels = report_number(text, "pixels_covered");
    free(text);
  }
  return median_of(cpu, runs);
}

/* The z-buffers' frame alone, and lines by Watkins and by a z-buffer of as many
 * lines, each beside the yardstick that it is held to. */
static void print_scans(const struct bench *bench, const struct model *model) {
  double pixels, none;
  double frame = take_solver(bench, model, "zbuffer", "--resolution=4096",
                             "none", &pixels);
  double allowed = 2e-9 * pixels + 100e-9 * model->triangles;
  double line = take_solver(bench, model, "scanline-zbuffer",
                            "--resolution=4096", "none", &none);
  double same = take_solver(bench, model, "zbuffer", "--resolution=667",
                            "silhouette", &none);
  double watkins = take_solver(bench, model, "watkins", "--pitch=0.3mm",
                               "silhouette", &none);
  printf("%-16s %9.0f zbuffer at 4096: %.3f s, %.1f times 2 ns a covered pixel "
         "and 100 ns a triangle; scanline-zbuffer: %.3f s, %.1f times that\n",
         model->name, model->triangles, frame, frame / allowed, line,
         line / frame);
  printf("%-16s %9.0f outlines by watkins at 0.3 mm: %.3f s, %.1f times a "
         "zbuffer of as many lines (%.3f s)\n",
         model->name, model->triangles, watkins, watkins / same, same);
}

/* How fast a file is read by itself: in MB a second of CPU time. */
static void print_reading(const char *path, const char *what) {
  double cpu[RUNS_MAX], bytes = 0;
  for (size_t i = 0; i < runs; i++) {
    struct scene scene;
    struct diagnostics silent = {.file = path};
    size_t length = 0;
    free(read_file(path, &length)); /* into the system's cache */
    bytes = (double)length;
    scene_init(&scene);
    double start = clock_cpu();
    bool ok = scene_read(&scene, path, NULL, &silent, NULL) == RECTO_OK;
    cpu[i] = ok ? clock_cpu() - start : NAN;
    scene_fini(&scene);
  }
  double median = median_of(cpu, runs);
  printf("%-16s %6.1f MB in %.3f s: %.0f MB/s\n", what, bytes / 1e6, median,
         bytes / 1e6 / median);
}

/* ---- All of it ----------------------------------------------------------- */

static void print_folder(const struct bench *bench, const char *folder,
                         const char *const *name) {
  for (size_t i = 0; name[i] != NULL; i++) {
    struct model model;
    struct scene scene;
    if (!model_open(&model, &scene, folder, name[i]))
      continue;
    print_model(bench, &model);
    scene_fini(&scene);
  }
}

/* Smooths the model twice and takes its measure each time. */
static void print_growth(const struct bench *bench, struct model *model,
                         struct scene *scene) {
  static const char *const level[] = {"... x 4", "... x 16"};
  char stl[100];
  snprintf(stl, sizeof stl, "%s/model.stl", bench->folder);
  print_yardstick(bench, model);
  print_scans(bench, model);
  for (size_t i = 0; i < 2; i++) {
    if (!model_refine(model, scene, bench->folder, level[i])) {
      fputs("bench: cannot write the finer model\n", stderr);
      break;
    }
    print_model(bench, model);
    print_yardstick(bench, model);
    print_scans(bench, model);
  }
  printf("\nReading alone\n");
  print_reading(model->path, "OBJ");
  if (write_stl(stl, scene))
    print_reading(stl, "binary STL");
  unlink(model->path);
  unlink(stl);
}

static void print_all(const struct bench *bench, const char *examples,
                      const char *models) {
  static const char *const own[] = {"castle", "gears", "knot", NULL};
  static const char *const real[] = {"suzanne", "spot",    "cow",
                                     "teapot",  "fandisk", NULL};
  struct model model;
  struct scene scene;
  print_heading();
  print_folder(bench, examples, own);
  if (models != NULL)
    print_folder(bench, models, real);
  /* The bunny grows, where it is; else the knot does. */
  if (models == NULL || !model_open(&model, &scene, models, "stanford-bunny")) {
    if (!model_open(&model, &scene, examples, "knot"))
      return;
  }
  print_model(bench, &model);
  print_growth(bench, &model, &scene);
  scene_fini(&scene);
}

int main(int argc, char **argv) {
  static const char *const usual[] = {"newell", "auto", NULL};
  struct bench bench = {.folder = "/tmp/recto-bench-XXXXXX"};
  if (argc < 4) {
    fputs("usage: bench RECTO ZRASTER EXAMPLES [METHOD]...\n", stderr);
    return 2;
  }
  bench.recto = argv[1];
  bench.zraster = argv[2];
  bench.method = argc > 4 ? (const char *const *)argv + 4 : usual;
  if (mkdtemp(bench.folder) == NULL) {
    fputs("bench: no temporary folder\n", stderr);
    return 1;
  }
  printf("CPU seconds, medians of %d runs; the whole process under CPU.\n",
         runs);
  print_all(&bench, argv[3], getenv("RECTO_MODELS"));
  char path[100];
  snprintf(path, sizeof path, "%s/report.json", bench.folder);
  unlink(path);
  snprintf(path, sizeof path, "%s/drawing.svg", bench.folder);
  unlink(path);
  rmdir(bench.folder);
  return 0;
}
