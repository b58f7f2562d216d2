/* part.c - draws one part of a drawing, and writes it to a file.
 *
 * Phases
 *   check    whether the parts can be joined exactly
 *   aim      the camera, at the whole scene; the windows of the page
 *   keep     the faces that meet the part's window, as a scene of their own
 *   solve    that scene, on the page grid of the whole
 *   collect  what lies in the window; write */
#include <limits.h>
#include <math.h>
#include <string.h>

#include "api/handle.h"
#include "api/options.h"
#include "api/part_check.h"
#include "api/shares.h"
#include "base/clock.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "base/stream.h"
#include "parts/part_collect.h"
#include "parts/part_file.h"
#include "scene/weld_near.h"
#include "view/camera_aim.h"
#include "view/layout.h"
#include "view/used.h"
#include "visibility/solver.h"

/* The state of one part; zero-initialised is empty. */
struct part_work {
  const recto_scene *model;
  const recto_options *options;
  struct camera camera; /* aimed at the whole scene */
  uint8_t *used;        /* one a point of it */
  struct page_place *place;
  double weld; /* the most that welding could join */
  struct part part;
  struct part_scene scene;
  struct topology topology;
  struct sheet sheet;
  struct map map;
};

static void part_work_fini(struct part_work *work) {
  map_fini(&work->map);
  sheet_fini(&work->sheet);
  topology_fini(&work->topology);
  part_scene_fini(&work->scene);
  part_fini(&work->part);
  mem_free(work->place);
  mem_free(work->used);
}

/* ---- What all parts have in common --------------------------------------- */

static uint64_t hash_ids(uint64_t hash, const uint32_t *id, size_t count) {
  hash = hash_add(hash, count);
  for (size_t i = 0; i + 1 < count; i += 2)
    hash = hash_add(hash, (uint64_t)id[i] << 32 | id[i + 1]);
  return count % 2 ? hash_add(hash, id[count - 1]) : hash;
}

/* A hash of the scene's geometry and groups. */
static uint64_t hash_scene(const struct scene *scene) {
  uint64_t hash = 0;
  for (size_t p = 0; p < scene->point.count; p++) {
    const struct scene_point *at = &scene->point.item[p];
    hash = hash_add_double(hash, at->x);
    hash = hash_add_double(hash, at->y);
    hash = hash_add_double(hash, at->z);
  }
  hash = hash_ids(hash, scene->corner.item, scene->corner.count);
  hash = hash_ids(hash, scene->face_start.item, scene->face_start.count);
  hash = hash_ids(hash, scene->face_group.item, scene->face_group.count);
  hash = hash_ids(hash, scene->face_skipped.item, scene->face_skipped.count);
  hash = hash_ids(hash, scene->wire_corner.item, scene->wire_corner.count);
  hash = hash_ids(hash, scene->wire_start.item, scene->wire_start.count);
  return hash_ids(hash, scene->wire_group.item, scene->wire_group.count);
}

static bool copy_names(struct part_common *common, const recto_scene *model) {
  const char *path = model->path != NULL ? model->path : "";
  const char *slash = strrchr(path, '/');
  common->path = mem_copy_text(slash != NULL ? slash + 1 : path);
  for (size_t g = 0; common->path != NULL && g < model->scene.group.count;
       g++) {
    struct scene_group own = model->scene.group.item[g];
    own.name = mem_copy_text(own.name != NULL ? own.name : "");
    if (own.name == NULL || !ARRAY_PUSH(&common->group, own)) {
      mem_free(own.name);
      return false;
    }
  }
  for (size_t r = 0; r < model->scene.precision.count; r++) {
    struct precision_range own = model->scene.precision.item[r];
    size_t last = common->precision.count;
    if (last > 0 &&
        common->precision.item[last - 1].first_point == own.first_point)
      common->precision.item[last - 1] = own;
    else if (!ARRAY_PUSH(&common->precision, own))
      return false;
  }
  return common->path != NULL;
}

static recto_status make_common(struct part_work *work, uint32_t count,
                                recto_error *error) {
  const recto_options *o = work->options;
  struct part_common *common = &work->part.common;
  common->parts = count;
  common->edges = o->ink.edges;
  common->has_fragments = o->ink.fill != RECTO_FILL_NONE;
  common->has_hidden = o->ink.hidden != RECTO_HIDDEN_NONE;
  common->crease_deg = o->mesh.crease_deg;
  common->camera = work->camera;
  common->camera_kind = o->camera.kind;
  common->azimuth_deg = o->camera.azimuth_deg;
  common->elevation_deg = o->camera.elevation_deg;
  memcpy(common->eye, o->camera.eye, sizeof common->eye);
  common->fov_deg = o->camera.fov_deg;
  uint64_t sum;
  if (!copy_names(common, work->model))
    return error_memory(error);
  recto_status status = part_file_checksum_common(common, &sum, error);
  common->id = hash_add(hash_scene(&work->model->scene), sum);
  common->id = hash_add_double(common->id, o->mesh.weld);
  return status;
}

/* ---- Phases -------------------------------------------------------------- */

/* Aims the camera, and finds where the points lie. */
static recto_status aim_part(struct part_work *work, uint32_t count,
                             recto_error *error) {
  const struct scene *scene = &work->model->scene;
  struct rescaled rescaled;
  recto_status status = rescale(&rescaled, scene, error);
  if (status != RECTO_OK)
    return status;
  bool is_extreme = rescaled.exponent != 0;
  rescale_fini(&rescaled);
  if (is_extreme)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                     "a scene of extreme size cannot be drawn in parts");
  status = camera_aim(&work->camera, scene, work->options, error);
  if (status != RECTO_OK)
    return status;
  if (!work->camera.all_on_page)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                     "what the page or the near plane may clip cannot be drawn "
                     "in parts: let the drawing fill the page");
  work->used = used_points(scene, NULL);
  if (work->used != NULL)
    work->place = page_places(&work->camera, scene, work->used);
  if (work->place == NULL)
    return error_memory(error);
  const recto_mesh_options *mesh = &work->options->mesh;
  const struct weld_request weld = {mesh->weld,
                                    precision_of_bits(mesh->coordinate_bits)};
  work->weld = weld_near_length_most(scene, &weld);
  return make_common(work, count, error);
}

static recto_status choose_window(struct part_work *work, recto_error *error) {
  uint32_t count = work->part.common.parts;
  struct part_window *window = mem_alloc(count, sizeof *window);
  bool ok = window != NULL &&
            page_windows_make(&work->camera, work->place, work->used,
                              work->model->scene.point.count, count, window);
  if (ok)
    work->part.window = window[work->part.index];
  mem_free(window);
  return ok ? RECTO_OK : error_memory(error);
}

/* How far beyond the window, in grid units, something may matter within it:
 * rounding, and contact, which moves the ends of intersections. */
static int64_t margin_of_window(const struct camera *camera) {
  const double most = 1 << 30;
  double units = camera->contact_most * camera->s * SHEET_UNITS_PER_MM;
  if (camera->perspective)
    units /= camera->d_min;
  return 64 + (int64_t)(4 * units < most ? ceil(4 * units) : most);
}

static recto_status keep_part(struct part_work *work, recto_error *error) {
  const struct part_scene_request request = {work->part.window,
                                             margin_of_window(&work->camera),
                                             work->part.common.has_fragments};
  bool may_weld = false;
  recto_status status = part_scene_make(&work->scene, &work->model->scene,
                                        work->place, &request, error);
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
  struct solver_request request = solver_request_of(o);
  const char *why;
  recto_status status =
      layout_sheet(&work->sheet, &work->scene.scene, &work->topology,
                   &work->camera, o, work->part.common.has_fragments, error);
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
  report_destroy(report);
  return status;
}

static recto_status collect_part(struct part_work *work, recto_error *error) {
  const struct part_sources sources = {.scene = &work->scene,
                                       .topology = &work->topology,
                                       .place = work->place,
                                       .sheet = &work->sheet,
                                       .map = &work->map};
  return part_collect(&work->part, &sources, error);
}

/* Writes the part, unless that would replace the model. */
static recto_status save_part(struct part_work *work, const char *path,
                              recto_error *error) {
  const struct scene *scene = &work->model->scene;
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
  shares_open_poll(&poll, &own, SHARE_SOLVE, "part");
  status = aim_part(&work, count, error);
  if (status == RECTO_OK)
    status = choose_window(&work, error);
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
  shares_open_poll(&poll, &own, SHARE_CAMERA, "part");
  if (input_load(&input, path, NULL) == RECTO_OK &&
      part_file_parse(&part, input.bytes, input.count, path, NULL) ==
          RECTO_OK) {
    status = aim_part(&work, count, error);
    *is_there = status == RECTO_OK && part.index == work.part.index &&
                part.common.id == work.part.common.id;
    part_fini(&part);
  }
  input_unload(&input);
  part_work_fini(&work);
  poll_close(&poll);
  return status;
}
