/* part.c - draws one part of a drawing, and writes it to a file.
 *
 * Phases
 *   check    whether the parts can be joined exactly
 *   aim      the camera, at the whole scene; the windows of the page
 *   pick     the faces that may matter to the part, in a pass over the model;
 *            of one that is not held, only this tells which points are used:
 *            where others than were taken for it, the camera is aimed again
 *   keep     the faces that meet the part's window, as a scene of their own;
 *            the model is then dropped
 *   solve    that scene, on the page grid of the whole
 *   collect  what lies in the window; write */
#include <limits.h>
#include <math.h>
#include <string.h>

#include "api/handle.h"
#include "api/options.h"
#include "api/part_check.h"
#include "api/part_tones.h"
#include "api/shares.h"
#include "base/clock.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "base/stream.h"
#include "ink/tone.h"
#include "parts/part_collect.h"
#include "parts/part_common.h"
#include "parts/part_file.h"
#include "scene/weld_near.h"
#include "view/camera_aim.h"
#include "view/rescale.h"
#include "view/layout.h"
#include "view/project.h"
#include "view/used.h"
#include "visibility/quantitative_invisibility.h"
#include "visibility/solver.h"

/* The state of one part; zero-initialised is empty. */
struct part_work {
  const recto_scene *model;
  const recto_options *options;
  struct scene read; /* of a model that is not held: its points and groups */
  struct diagnostics diagnostics;
  struct face_pick pick;
  struct camera camera; /* aimed at the whole scene */
  struct part_scene_request request;
  double weld; /* the most that welding could join */
  struct part part;
  struct part_scene scene;
  struct part_tones tones;
  struct topology topology;
  struct sheet sheet;
  struct map map;
};

static void part_work_fini(struct part_work *work) {
  map_fini(&work->map);
  sheet_fini(&work->sheet);
  topology_fini(&work->topology);
  part_scene_fini(&work->scene);
  part_tones_fini(&work->tones);
  part_fini(&work->part);
  face_pick_fini(&work->pick);
  read_passes_close(work->pick.source.passes);
  scene_fini(&work->read);
}

/* ---- What all parts have in common --------------------------------------- */

/* A hash of the model's geometry and groups, when its faces were passed
 * over. */
static uint64_t hash_model(const struct face_pick *pick) {
  const struct scene *scene = pick->source.scene;
  uint64_t hash = 0;
  for (size_t p = 0; p < scene->point.count; p++) {
    const struct scene_point *at = &scene->point.item[p];
    hash = hash_add_double(hash, at->x);
    hash = hash_add_double(hash, at->y);
    hash = hash_add_double(hash, at->z);
  }
  return hash_add(hash_add(hash, pick->face_hash), pick->wire_hash);
}

static bool copy_names(struct part_common *common, const char *path,
                       const struct scene *scene) {
  const char *slash = strrchr(path, '/');
  common->path = mem_copy_text(slash != NULL ? slash + 1 : path);
  for (size_t g = 0; common->path != NULL && g < scene->group.count; g++) {
    struct scene_group own = scene->group.item[g];
    own.name = mem_copy_text(own.name != NULL ? own.name : "");
    if (own.name == NULL || !ARRAY_PUSH(&common->group, own)) {
      mem_free(own.name);
      return false;
    }
  }
  for (size_t r = 0; r < scene->precision.count; r++) {
    struct precision_range own = scene->precision.item[r];
    size_t last = common->precision.count;
    if (last > 0 &&
        common->precision.item[last - 1].first_point == own.first_point)
      common->precision.item[last - 1] = own;
    else if (!ARRAY_PUSH(&common->precision, own))
      return false;
  }
  return common->path != NULL;
}

static recto_status make_common(struct part_work *work, recto_error *error) {
  const recto_options *o = work->options;
  struct part_common *common = &work->part.common;
  const char *path = work->model->path != NULL ? work->model->path : "";
  common->edges = o->ink.edges;
  common->has_fragments = o->ink.fill != RECTO_FILL_NONE;
  common->has_hidden = o->ink.hidden != RECTO_HIDDEN_NONE;
  common->hidden_by_max = part_hidden_by_max(o);
  common->has_ids = o->ink.ids;
  common->has_tones = part_tones_are_wanted(o);
  if (common->has_tones)
    tones_set_light(common->light, &work->camera, o);
  common->crease_deg = o->mesh.crease_deg;
  common->crease_start_deg = o->mesh.crease_start_deg;
  common->camera = work->camera;
  common->camera_kind = o->camera.kind;
  common->azimuth_deg = o->camera.azimuth_deg;
  common->elevation_deg = o->camera.elevation_deg;
  memcpy(common->eye, o->camera.eye, sizeof common->eye);
  common->fov_deg = o->camera.fov_deg;
  uint64_t sum;
  if (!copy_names(common, path, work->pick.source.scene))
    return error_memory(error);
  recto_status status = part_common_checksum(common, &sum, error);
  common->id = hash_add(hash_model(&work->pick), sum);
  common->id = hash_add_double(common->id, o->mesh.weld);
  return status;
}

/* ---- The camera and the window ------------------------------------------- */

/* Aims the camera.
 * used  one a point */
static recto_status aim_part(struct part_work *work, const uint8_t *used,
                             recto_error *error) {
  const struct scene *scene = work->pick.source.scene;
  if (rescale_is_wanted(scene, used))
    return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                     "a scene of extreme size cannot be drawn in parts");
  recto_status status =
      camera_aim_at_used(&work->camera, scene, used, work->options, error);
  if (status != RECTO_OK)
    return status;
  if (!work->camera.all_on_page)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                     "what the page or the near plane may clip cannot be drawn "
                     "in parts: let the drawing fill the page");
  const recto_mesh_options *mesh = &work->options->mesh;
  const struct weld_request weld = {mesh->weld,
                                    precision_of_bits(mesh->coordinate_bits)};
  work->weld = weld_near_length_most(scene, &weld);
  return RECTO_OK;
}

/* How far beyond the window, in grid units, something may matter within it:
 * rounding, contact, which moves the ends of intersections, and corners with
 * which welding might join one within it.
 * weld  the longest distance of such corners, scene units */
static int64_t margin_of_window(const struct camera *camera, double weld) {
  const double most = 1 << 30;
  double units =
      (4 * camera->contact_most + weld) * camera->s * SHEET_UNITS_PER_MM;
  if (camera->perspective)
    units /= camera->d_min;
  return 64 + (int64_t)(units < most ? ceil(units) : most);
}

/* How far beyond the window faces are picked that may be needed: some times the
 * distance of points that cover the page evenly. */
static int64_t reach_of_window(const struct camera *camera, size_t points) {
  enum { TIMES = 12 };
  const struct projection projection = projection_of(camera);
  double area = 4 * projection.half[0] * projection.half[1];
  double reach = TIMES * sqrt(area / (double)points);
  return reach < SHEET_XY_MAX ? (int64_t)reach : SHEET_XY_MAX;
}

/* Chooses the window, and what is picked for it. */
static recto_status aim_pick(struct part_work *work, recto_error *error) {
  const struct scene *scene = work->pick.source.scene;
  uint32_t count = work->part.common.parts;
  struct page_place *place = page_places(&work->camera, scene);
  struct part_window *window = mem_alloc(count, sizeof *window);
  bool ok = place != NULL && window != NULL &&
            page_windows_make(&work->camera, place, scene->point.count, count,
                              window);
  if (ok) {
    work->part.window = window[work->part.index];
    work->request = (struct part_scene_request){
        .camera = &work->camera,
        .window = work->part.window,
        .margin = margin_of_window(&work->camera, work->weld),
        .reach = reach_of_window(&work->camera, scene->point.count),
        .owned = work->options->ink.fill != RECTO_FILL_NONE ||
                 work->options->ink.ids};
    ok = part_scene_aim(&work->pick, &work->request, place);
  }
  mem_free(window);
  mem_free(place);
  return ok ? RECTO_OK : error_memory(error);
}

/* ---- The model ----------------------------------------------------------- */

/* Opens the model, whose points are then known. */
static recto_status open_model(struct part_work *work, recto_error *error) {
  const recto_scene *model = work->model;
  struct face_source *source = &work->pick.source;
  source->scene = &model->scene;
  scene_init(&work->read);
  if (!model->is_deferred)
    return RECTO_OK;
  if (model->scene.point.count > 0)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "a model that was read for parts is not alone in its "
                     "scene");
  work->diagnostics = (struct diagnostics){.file = model->path,
                                           .warning = work->options->warning,
                                           .user = work->options->user};
  work->read.needs_colours = work->options->ink.fill == RECTO_FILL_PAINT;
  recto_status status =
      read_passes_open(&source->passes, model->path, model->format, 0, error);
  if (status == RECTO_OK && source->passes == NULL)
    return error_set(error, RECTO_ERROR_IO, model->path, 0,
                     "cannot be read any more as it was when it was opened");
  source->scene = &work->read;
  return status == RECTO_OK ? read_passes_points(source->passes, &work->read,
                                                 &work->diagnostics, error)
                            : status;
}

/* Sets which points are used, as the last pass found; returns whether that is
 * new. */
static bool take_used(const struct part_work *work, uint8_t *used) {
  bool is_new = false;
  for (size_t p = 0; p < work->pick.source.scene->point.count; p++) {
    is_new = is_new || (used[p] != 0) != face_pick_uses(&work->pick, p);
    used[p] = face_pick_uses(&work->pick, p);
  }
  return is_new;
}

/* Aims the camera by what is known to be used, and picks faces.
 * used   one a point
 * picks  faces are picked, else the model is only looked at */
static recto_status aim_and_pick(struct part_work *work, const uint8_t *used,
                                 bool picks, recto_error *error) {
  recto_status status = aim_part(work, used, error);
  if (status == RECTO_OK && picks)
    status = aim_pick(work, error);
  return status == RECTO_OK ? face_pick_pass(&work->pick, error) : status;
}

/* The same where a pass is needed to know what is used, and what seems to be is
 * taken for it at first. */
static recto_status guess_and_pick(struct part_work *work, uint8_t *used,
                                   bool picks, recto_error *error) {
  read_passes_guess_used(work->pick.source.passes, used);
  recto_status guessed = aim_part(work, used, error);
  if (guessed == RECTO_OK && picks)
    guessed = aim_pick(work, error);
  const struct camera guess = work->camera;
  recto_error of_pass;
  recto_status status = face_pick_pass(&work->pick, &of_pass);
  if (status != RECTO_OK && error != NULL)
    *error = of_pass;
  if (status != RECTO_OK || !take_used(work, used))
    return status != RECTO_OK ? status : guessed;
  status = aim_part(work, used, error);
  bool is_same = guessed == RECTO_OK && status == RECTO_OK &&
                 memcmp(&guess, &work->camera, sizeof guess) == 0;
  return status != RECTO_OK || is_same ? status
                                       : aim_and_pick(work, used, picks, error);
}

/* Reads the model so far as the part needs it. */
static recto_status survey_model(struct part_work *work, bool picks,
                                 recto_error *error) {
  recto_status status = open_model(work, error);
  work->pick.counts_groups = work->options->ink.ids;
  if (status != RECTO_OK)
    return status;
  const struct scene *scene = work->pick.source.scene;
  bool is_held = work->pick.source.passes == NULL;
  uint8_t *used =
      is_held ? used_points(scene, NULL) : mem_alloc(scene->point.count, 1);
  if (used == NULL)
    return error_memory(error);
  status = is_held ? aim_and_pick(work, used, picks, error)
                   : guess_and_pick(work, used, picks, error);
  mem_free(used);
  return status == RECTO_OK ? make_common(work, error) : status;
}

/* Frees what the part needs no more of its model. */
static void drop_model(struct part_work *work) {
  read_passes_close(work->pick.source.passes);
  work->pick.source.passes = NULL;
  ARRAY_FREE(&work->read.point);
  face_pick_fini(&work->pick);
}

/* ---- Phases -------------------------------------------------------------- */

static recto_status keep_part(struct part_work *work, recto_error *error) {
  bool may_weld = false;
  recto_status status =
      part_scene_make(&work->scene, &work->pick, &work->request, error);
  if (status == RECTO_OK && work->part.common.has_tones &&
      scene_face_count(&work->scene.scene) > 0)
    status = part_tones_find(&work->tones, &work->scene, &work->pick.source,
                             &work->camera, work->options, error);
  drop_model(work);
  if (status == RECTO_OK)
    status = topology_init(&work->topology, &work->scene.scene, error);
  if (status == RECTO_OK && !part_scene_may_weld(&work->scene, &work->topology,
                                                 work->weld, &may_weld))
    status = error_memory(error);
  if (status == RECTO_OK && may_weld)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                     "corners of borders lie within %.3g of each other, which "
                     "parts cannot weld; --weld 0 leaves them apart",
                     work->weld);
  return status;
}

static recto_status solve_part_scene(struct part_work *work,
                                     recto_error *error) {
  const recto_options *o = work->options;
  recto_options lower = *o; /* of two angles of creases: part_join.c */
  struct solver_request request = solver_request_of(o);
  const char *why;
  lower.mesh.crease_start_deg = 0;
  recto_status status = layout_sheet(&work->sheet, &work->scene.scene,
                                     &work->topology, &work->camera, &lower,
                                     work->part.common.has_fragments, error);
  if (status != RECTO_OK)
    return status;
  request.fragments = work->part.common.has_fragments;
  request.threads = parallel_threads();
  work->map.keeps_side_lines = true;
  const struct solver *solver =
      o->solver.method == RECTO_METHOD_AUTO
          ? solver_choose(&work->sheet, &request, &why)
          : solver_by_method(o->solver.method);
  struct report *report = report_create();
  status = solver->solve(&work->sheet, &request, &work->map, report, error);
  if (status == RECTO_OK && part_hidden_by_max(o) > 0 &&
      work->map.edge_state != NULL)
    status = quantitative_invisibility_find(
        &work->map, &work->sheet, o->ink.hidden_by_max, false, report, error);
  report_destroy(report);
  return status;
}

static recto_status collect_part(struct part_work *work, recto_error *error) {
  const struct part_sources sources = {.scene = &work->scene,
                                       .topology = &work->topology,
                                       .sheet = &work->sheet,
                                       .map = &work->map,
                                       .tone = work->tones.corner,
                                       .uniform = work->tones.uniform};
  return part_collect(&work->part, &sources, error);
}

/* Writes the part, unless that would replace the model. */
static recto_status save_part(struct part_work *work, const char *path,
                              recto_error *error) {
  const struct scene *scene = work->pick.source.scene;
  struct byte_array bytes = {.item = NULL};
  struct stream *stream = NULL;
  recto_status status = part_file_make(&work->part, &bytes, error);
  if (status == RECTO_OK)
    status = stream_open(&stream, path, error);
  for (size_t i = 0; status == RECTO_OK && i < scene->file.count; i++)
    if (stream_replaces(stream, scene->file.item[i]))
      status = error_set(error, RECTO_ERROR_ARGUMENT, path, 0,
                         "the part would replace the model");
  if (status == RECTO_OK) {
    stream_write(stream, bytes.item, bytes.count);
    status = stream_finish(stream, error);
  } else {
    stream_discard(stream);
  }
  ARRAY_FREE(&bytes);
  return status;
}

/* ---- The calls ----------------------------------------------------------- */

/* Checks the arguments, and copies the options. */
static recto_status begin_part(struct part_work *work, recto_options *own,
                               const recto_scene *scene,
                               const recto_options *options, unsigned number,
                               unsigned count, const char *path,
                               recto_error *error) {
  if (scene == NULL || path == NULL)
    return error_null(error, scene == NULL ? "the scene" : "the path");
  if (count < 1 || count > RECTO_PARTS_MAX || number < 1 || number > count)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "there is no part %u of %u: there are at most %d", number,
                     count, RECTO_PARTS_MAX);
  recto_status status = options_copy_valid(own, options, error);
  if (status == RECTO_OK)
    status = options_settle_scale(own, &scene->scene, error);
  if (status == RECTO_OK)
    status = part_check_solve(own, error);
  *work = (struct part_work){.model = scene, .options = own};
  work->part.index = number - 1;
  work->part.common.parts = count;
  return status;
}

recto_status recto_scene_write_part(const recto_scene *scene,
                                    const recto_options *options,
                                    unsigned number, unsigned count,
                                    const char *path, recto_error *error) {
  recto_options own;
  struct part_work work;
  struct poll poll;
  recto_status status =
      begin_part(&work, &own, scene, options, number, count, path, error);
  if (status != RECTO_OK)
    return status;
  double share[SHARE_STAGES + 1];
  shares_plan(share, &own);
  shares_open_poll(&poll, &own, SHARE_READ, "read");
  status = survey_model(&work, true, error);
  if (status == RECTO_OK &&
      !poll_stage(share[SHARE_TOPOLOGY], share[SHARE_SOLVE + 1], "part"))
    status = error_cancelled(error);
  if (status == RECTO_OK)
    status = keep_part(&work, error);
  if (status == RECTO_OK && scene_face_count(&work.scene.scene) +
                                    scene_wire_count(&work.scene.scene) >
                                0) {
    status = solve_part_scene(&work, error);
    if (status == RECTO_OK)
      status = collect_part(&work, error);
  }
  if (status == RECTO_OK)
    status = save_part(&work, path, error);
  part_work_fini(&work);
  poll_close(&poll);
  return status;
}

recto_status recto_scene_has_part(const recto_scene *scene,
                                  const recto_options *options, unsigned number,
                                  unsigned count, const char *path,
                                  bool *is_there, recto_error *error) {
  recto_options own;
  struct part_work work;
  struct part part;
  struct input input = {.bytes = NULL};
  struct poll poll;
  if (is_there == NULL)
    return error_null(error, "whether it is there");
  *is_there = false;
  recto_status status =
      begin_part(&work, &own, scene, options, number, count, path, error);
  if (status != RECTO_OK)
    return status;
  own.warning = NULL;
  shares_open_poll(&poll, &own, SHARE_READ, "read");
  if (input_load(&input, path, NULL) == RECTO_OK &&
      part_file_parse(&part, input.bytes, input.count, path, NULL) ==
          RECTO_OK) {
    status = survey_model(&work, false, error);
    *is_there = status == RECTO_OK && part.index == work.part.index &&
                part.common.id == work.part.common.id;
    part_fini(&part);
  }
  input_unload(&input);
  part_work_fini(&work);
  poll_close(&poll);
  return status;
}
