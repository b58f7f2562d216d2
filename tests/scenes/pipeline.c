/* pipeline.c - see pipeline.h. */
#include "tests/scenes/pipeline.h"

#include <math.h>
#include <string.h>

#include "backends/writer.h"
#include "ink/ink.h"
#include "view/camera_aim.h"
#include "view/layout.h"

static recto_status solve(struct pipeline *pipeline,
                          const recto_options *options,
                          const struct solver *solver) {
  struct solver_request request = solver_request_of(options);
  if (options->solver.threads > 0)
    request.threads = options->solver.threads;
  return solver->solve(&pipeline->sheet, &request, &pipeline->map,
                       pipeline->report, &pipeline->error);
}

void pipeline_run(struct pipeline *pipeline, const struct scene *scene,
                  const recto_options *options, const struct solver *solver) {
  memset(pipeline, 0, sizeof *pipeline);
  map_init(&pipeline->map);
  drawing_init(&pipeline->drawing);
  pipeline->report = report_create();
  recto_error *error = &pipeline->error;
  bool all_edges = options->ink.fill != RECTO_FILL_NONE;
  pipeline->status = topology_init(&pipeline->topology, scene, error);
  if (pipeline->status == RECTO_OK)
    pipeline->status = camera_aim(&pipeline->camera, scene, options, error);
  if (pipeline->status == RECTO_OK)
    pipeline->status =
        layout_sheet(&pipeline->sheet, scene, &pipeline->topology,
                     &pipeline->camera, options, all_edges, error);
  if (pipeline->status == RECTO_OK)
    pipeline->status = solve(pipeline, options, solver);
  if (pipeline->status == RECTO_OK)
    pipeline->status = ink_draw(&pipeline->drawing, &pipeline->sheet, scene,
                                &pipeline->map, options, error);
}

void pipeline_fini(struct pipeline *pipeline) {
  drawing_fini(&pipeline->drawing);
  map_fini(&pipeline->map);
  sheet_fini(&pipeline->sheet);
  topology_fini(&pipeline->topology);
  report_destroy(pipeline->report);
}

char *pipeline_svg(const struct pipeline *pipeline,
                   const recto_options *options, size_t *length) {
  const struct writer_options writing = {.precision =
                                             options->output.precision};
  struct stream *stream = NULL;
  build_require(stream_open_memory(&stream, NULL) == RECTO_OK);
  recto_status status = pipeline->status;
  if (status == RECTO_OK)
    status = writer_svg.write(&pipeline->drawing, &writing, stream, NULL);
  if (status != RECTO_OK)
    stream_text(stream, recto_status_name(status));
  const char *text = stream_memory(stream, length);
  build_require(text != NULL);
  char *copy = mem_alloc(*length + 1, 1);
  build_require(copy != NULL);
  memcpy(copy, text, *length + 1);
  stream_discard(stream);
  return copy;
}

char *pipeline_draw(const struct scene *scene, const recto_options *options,
                    const struct solver *solver, size_t *length) {
  struct pipeline pipeline;
  pipeline_run(&pipeline, scene, options, solver);
  char *text = pipeline_svg(&pipeline, options, length);
  pipeline_fini(&pipeline);
  return text;
}

void pipeline_fill(struct scene *scene, recto_options *options,
                   const struct scenes_entry *entry) {
  recto_options_init(options);
  scene_init(scene);
  entry->fill(scene, options);
  options->ink.min_stroke_mm = 0;
  options->output.precision = 6;
  options->solver.threads = 1;
}

double pipeline_length(const struct pipeline *pipeline, unsigned classes,
                       bool hidden) {
  const struct drawing *drawing = &pipeline->drawing;
  double length = 0;
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    const char *label = drawing->layer.item[stroke->layer].label;
    if ((stroke->edge_class & classes) == 0 ||
        (strstr(label, "hidden") != NULL) != hidden)
      continue;
    const struct drawing_point *p = drawing->point.item + stroke->point;
    for (uint32_t k = 1; k < stroke->count; k++)
      length += hypot(p[k].x - p[k - 1].x, p[k].y - p[k - 1].y);
    if (stroke->closed)
      length += hypot(p[0].x - p[stroke->count - 1].x,
                      p[0].y - p[stroke->count - 1].y);
  }
  return length;
}
