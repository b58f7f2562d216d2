/* join.c - joins the parts of a drawing, and inks it.
 *
 * Phases
 *   read   each file whole, and check it
 *   merge  what the parts say of each edge and each face
 *   lay    the faces that ink needs out, with their visible map
 *   ink    as for a drawing made at once */
#include <string.h>

#include "api/captions.h"
#include "api/handle.h"
#include "api/options.h"
#include "api/output_format.h"
#include "api/part_check.h"
#include "api/result.h"
#include "api/stats.h"
#include "base/clock.h"
#include "base/poll.h"
#include "ink/ink.h"
#include "ink/pens.h"
#include "parts/part_file.h"
#include "parts/part_join.h"
#include "view/rescale.h"

struct join {
  const char *const *path;
  struct part *part;
  size_t parts;
  size_t bytes; /* of all their files */
  recto_options options;
  bool sets_margin; /* of itself, not for the format */
  struct part_join join;
  recto_drawing *made;
};

/* ---- Reading ------------------------------------------------------------- */

static recto_status read_part_file(struct join *join, const char *path,
                                   recto_error *error) {
  struct input input = {.bytes = NULL};
  struct part *part = &join->part[join->parts];
  recto_status status = input_load(&input, path, error);
  if (status == RECTO_OK)
    status = part_file_parse(part, input.bytes, input.count, path, error);
  /* So that no output replaces it. */
  if (status == RECTO_OK) {
    join->parts++;
    join->bytes += input.count;
    if (input.is_file && !ARRAY_PUSH(&join->made->file, input.file))
      status = error_memory(error);
  }
  input_unload(&input);
  return status;
}

static recto_status read_part_files(struct join *join, size_t count,
                                    recto_error *error) {
  join->part = mem_calloc(count, sizeof *join->part);
  if (join->part == NULL)
    return error_memory(error);
  for (size_t i = 0; i < count; i++) {
    recto_status status = poll_now()
                              ? read_part_file(join, join->path[i], error)
                              : error_cancelled(error);
    if (status != RECTO_OK)
      return status;
  }
  return part_merge_check(join->part, join->path, count, error);
}

/* ---- Inking -------------------------------------------------------------- */

/* Replaces the options that the parts were made with. */
static void take_options(recto_options *o, const struct part_common *common) {
  o->ink.edges = common->edges;
  o->mesh.crease_deg = common->crease_deg;
  o->mesh.crease_start_deg = common->crease_start_deg;
  o->camera.kind = common->camera_kind;
  o->camera.azimuth_deg = common->azimuth_deg;
  o->camera.elevation_deg = common->elevation_deg;
  memcpy(o->camera.eye, common->eye, sizeof common->eye);
  o->camera.fov_deg = common->fov_deg;
  o->page.width_mm = common->camera.page_mm[0];
  o->page.height_mm = common->camera.page_mm[1];
  o->page.margin_mm = common->camera.margin_mm;
}

/* Refuses parts that a plotter would cut: their drawing fills the page up to
 * margins that are narrower than it needs.  Where the caller sets a margin, the
 * parts were to have that, as in a drawing that is made at once. */
static recto_status check_margin(const struct join *join, recto_error *error) {
  recto_options o = join->options;
  const struct camera *camera = &join->part[0].common.camera;
  o.page.width_mm = camera->page_mm[0];
  o.page.height_mm = camera->page_mm[1];
  double needed_mm = output_needed_margin_mm(&o);
  if (join->sets_margin || needed_mm <= camera->margin_mm)
    return RECTO_OK;
  return error_set(error, RECTO_ERROR_UNSUPPORTED, join->path[0], 0,
                   "the plotter needs a margin of %.0f mm, and the parts were "
                   "made with one of %.4g mm: make them with --format %s and "
                   "the same --device, or join them with their --margin",
                   needed_mm, camera->margin_mm, o.output.format);
}

static recto_status ink_join(struct join *join, recto_error *error) {
  struct pens pens;
  struct part_join *joined = &join->join;
  const recto_options *o = &join->options;
  recto_status status = pens_init(&pens, &joined->scene, o, error);
  if (status == RECTO_OK)
    pens_warn_unused(&pens, o);
  pens_fini(&pens);
  double cpu = clock_cpu();
  output_adapt_drawing(&join->made->drawing, o);
  if (status == RECTO_OK)
    status = ink_draw(&join->made->drawing, &joined->sheet, &joined->scene,
                      &joined->map, o, error);
  stats_add_seconds(join->made->report, "ink_cpu_s", clock_cpu() - cpu);
  if (status == RECTO_OK)
    pens_warn_absent(&joined->sheet, o);
  return status;
}

/* The number of a face or a polyline within its group. */
static uint32_t in_group_at(const struct part_element *element, size_t count,
                            uint32_t at) {
  return at < count ? element[at].in_group : DRAWING_NONE;
}

/* Sets the sources of strokes and fills, as group_numbers.h does. */
static bool set_sources(struct join *join) {
  struct drawing *drawing = &join->made->drawing;
  const struct part *all = &join->join.all;
  uint32_t *edge = part_join_edge_numbers(&join->join);
  bool ok = edge != NULL &&
            ARRAY_RESERVE(&drawing->stroke_source, drawing->stroke.count) &&
            ARRAY_RESERVE(&drawing->fill_source, drawing->fill.count);
  for (size_t i = 0; ok && i < drawing->stroke.count; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    struct drawing_source own = {
        in_group_at(all->face.item, all->face.count, stroke->face),
        stroke->edge_class == RECTO_EDGE_WIRE
            ? in_group_at(all->wire.item, all->wire.count, stroke->edge)
        : stroke->edge < join->join.topology.edge.count ? edge[stroke->edge]
                                                        : DRAWING_NONE};
    drawing->stroke_source.item[drawing->stroke_source.count++] = own;
  }
  for (size_t i = 0; ok && i < drawing->fill.count; i++)
    drawing->fill_source.item[drawing->fill_source.count++] =
        (struct drawing_source){in_group_at(all->face.item, all->face.count,
                                            drawing->fill.item[i].face),
                                DRAWING_NONE};
  mem_free(edge);
  return ok;
}

/* Gives faces their numbers in the model; edges have none here. */
static void number_faces(struct join *join) {
  struct drawing *drawing = &join->made->drawing;
  const struct part_element *face = join->join.all.face.item;
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    struct drawing_stroke *stroke = &drawing->stroke.item[i];
    bool is_wire = stroke->edge_class == RECTO_EDGE_WIRE;
    if (stroke->face != DRAWING_NONE)
      stroke->face = face[stroke->face].number;
    if (stroke->edge != DRAWING_NONE)
      stroke->edge = is_wire ? join->join.all.wire.item[stroke->edge].number
                             : DRAWING_NONE;
  }
  for (size_t i = 0; i < drawing->fill.count; i++) {
    uint32_t *number = &drawing->fill.item[i].face;
    *number = *number == DRAWING_NONE ? *number : face[*number].number;
  }
}

static void report_join(struct join *join) {
  struct report *report = join->made->report;
  const struct part_join *joined = &join->join;
  report_count(report, "join", "parts", joined->all.common.parts);
  report_count(report, "join", "file_bytes", join->bytes);
  report_count(report, "join", "faces", joined->counts.faces);
  report_count(report, "join", "edges", joined->counts.edges);
  report_count(report, "join", "intersections", joined->counts.intersections);
  report_count(report, "join", "fragments", joined->counts.fragments);
  stats_add_drawing(report, &join->made->drawing, &join->options);
  report_count(report, "memory", "peak_bytes", mem_peak_bytes());
}

static recto_status join_and_ink(struct join *join, size_t count,
                                 recto_error *error) {
  struct part_join *joined = &join->join;
  double cpu = clock_cpu();
  recto_status status = read_part_files(join, count, error);
  if (status == RECTO_OK)
    status =
        part_check_ink(&join->options, &join->part[0].common, false, error);
  if (status == RECTO_OK)
    status = check_margin(join, error);
  stats_add_seconds(join->made->report, "read_cpu_s", clock_cpu() - cpu);
  cpu = clock_cpu();
  if (status == RECTO_OK)
    status = part_merge(&joined->all, join->part, join->path, count, error);
  if (status != RECTO_OK)
    return status;
  take_options(&join->options, &joined->all.common);
  status = part_join_make(joined, &join->options, error);
  if (status != RECTO_OK)
    return status;
  stats_add_seconds(join->made->report, "join_cpu_s", clock_cpu() - cpu);
  const struct rescaled rescaled = {.exponent = 0};
  drawing_store_projection(join->made, &joined->all.common.camera, &rescaled);
  status = ink_join(join, error);
  if (status != RECTO_OK)
    return status;
  const char *path = joined->all.common.path;
  if (!captions_set(&join->made->drawing, path[0] != '\0' ? path : NULL,
                    &join->options))
    return error_memory(error);
  if (join->options.ink.ids && !set_sources(join))
    return error_memory(error);
  number_faces(join);
  report_join(join);
  return RECTO_OK;
}

recto_status recto_join_parts(const char *const *paths, size_t count,
                              const recto_options *options,
                              recto_drawing **drawing, recto_error *error) {
  struct join join = {.path = paths};
  struct poll poll;
  if (drawing == NULL)
    return error_null(error, "the drawing");
  *drawing = NULL;
  if (paths == NULL || count == 0)
    return error_null(error, "the parts");
  for (size_t i = 0; i < count; i++)
    if (paths[i] == NULL)
      return error_null(error, "the path of a part");
  recto_options given;
  recto_status status = options_copy(&given, options, error);
  if (status == RECTO_OK)
    status = options_copy_valid(&join.options, &given, error);
  if (status != RECTO_OK)
    return status;
  join.sets_margin = given.page.margin_mm >= 0;
  join.made = mem_calloc(1, sizeof *join.made);
  if (join.made == NULL)
    return error_memory(error);
  drawing_init(&join.made->drawing);
  join.made->report = report_create();
  poll_open(&poll, &join.options);
  status = join_and_ink(&join, count, error);
  part_join_fini(&join.join);
  for (size_t i = 0; i < join.parts; i++)
    part_fini(&join.part[i]);
  mem_free(join.part);
  if (status == RECTO_OK && poll_is_cancelled())
    status = error_cancelled(error);
  poll_close(&poll);
  if (status != RECTO_OK) {
    recto_drawing_destroy(join.made);
    return status;
  }
  *drawing = join.made;
  return RECTO_OK;
}
