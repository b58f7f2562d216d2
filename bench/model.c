/* model.c - the models of the bench, and one run of a program over them. */
#include "bench/model.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/stream.h"
#include "scene/read.h"
#include "tests/scenes/box.h"
#include "tests/scenes/subdivide.h"
#include "tests/scenes/write_obj.h"

const char *const model_stage_name[MODEL_STAGES] = {
    "read", "edges", "camera", "sheet", "solve", "ink", "write"};

static const char *const stage_key[MODEL_STAGES] = {
    "read_cpu_s",  "topology_cpu_s", "camera_cpu_s", "sheet_cpu_s",
    "solve_cpu_s", "ink_cpu_s",      "write_cpu_s"};

const char model_features[] =
    "silhouette,border,crease,group,intersection,wire";

/* Looks from three radii away, along an arbitrary direction. */
static void choose_view(struct model *model, const struct scene *scene) {
  const double direction[3] = {0.6, 0.5, 0.62};
  double radius = box_measure(scene, model->middle);
  for (int k = 0; k < 3; k++)
    model->eye[k] = model->middle[k] + 3 * radius * direction[k];
}

static double count_triangles(const struct scene *scene) {
  double corners = (double)scene->corner.count;
  return corners - 2 * (double)scene_face_count(scene);
}

bool model_open(struct model *model, struct scene *scene, const char *folder,
                const char *name) {
  struct diagnostics silent = {.file = model->path};
  size_t length;
  model->name = name;
  snprintf(model->path, sizeof model->path, "%s/%s.obj", folder, name);
  char *text = read_file(model->path, &length);
  if (text == NULL)
    return false;
  free(text);
  scene_init(scene);
  if (scene_read(scene, model->path, NULL, &silent, NULL) != RECTO_OK)
    return false;
  model->bytes = (double)length;
  model->triangles = count_triangles(scene);
  choose_view(model, scene);
  return true;
}

static bool write_obj(struct model *model, const struct scene *scene) {
  struct stream *stream = NULL;
  if (stream_open(&stream, model->path, NULL) != RECTO_OK)
    return false;
  scene_write_obj(scene, stream);
  return stream_finish(stream, NULL) == RECTO_OK;
}

bool model_refine(struct model *model, struct scene *scene, const char *folder,
                  const char *name) {
  struct scene finer;
  scene_init(&finer);
  scenes_subdivide(&finer, scene, SUBDIVIDE_LOOP);
  scene_fini(scene);
  *scene = finer;
  model->name = name;
  snprintf(model->path, sizeof model->path, "%s/model.obj", folder);
  model->triangles = count_triangles(scene);
  return write_obj(model, scene);
}

/* Three numbers as an option has them. */
static void write_triple(char text[200], const double number[3]) {
  snprintf(text, 200, "%.17g,%.17g,%.17g", number[0], number[1], number[2]);
}

void model_draw(struct run *run, double stage[MODEL_STAGES],
                const struct model *model, const struct model_job *job) {
  char camera[200], target[200], stats[PATH_MAX], report[PATH_MAX - 10],
      output[PATH_MAX];
  write_triple(camera, model->eye);
  write_triple(target, model->middle);
  snprintf(report, sizeof report, "%s/report.json", job->folder);
  snprintf(stats, sizeof stats, "--stats=%s", report);
  snprintf(output, sizeof output, "%s/drawing.svg", job->folder);
  const char *const argv[] = {
      job->recto,   model->path, "-m",   job->method, "-e",
      job->edges,   "-c",        camera, "-l",        target,
      "-F",         "30",        "-u",   "0,1,0",     "-p",
      "200x200mm",  "--margin",  "5mm",  "-q",        "--threads",
      job->threads, stats,       "-o",   output,      NULL};
  run_program(run, argv, job->limit_s);
  char *text = read_file(report, NULL);
  for (size_t k = 0; k < MODEL_STAGES; k++)
    stage[k] = report_number(text, stage_key[k]);
  free(text);
}

void model_raster(struct run *run, const struct model *model,
                  const char *zraster, unsigned limit_s) {
  char eye[3][40];
  for (int k = 0; k < 3; k++)
    snprintf(eye[k], sizeof eye[k], "%.17g", model->eye[k]);
  const char *const argv[] = {zraster, model->path, eye[0],
                              eye[1],  eye[2],      NULL};
  run_program(run, argv, limit_s);
}
