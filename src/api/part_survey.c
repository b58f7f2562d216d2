/* part_survey.c - looks at a whole model for its parts.
 *
 * Phases
 *   open    the model; its points, where it is not held
 *   aim     the camera, at the whole scene; the windows of the page
 *   pick    faces, in a pass over the model: of one that is not held, only this
 *           shows which points are used: where they are others than those
 *           assumed, the camera is aimed again
 *   marks   of creases that count
 *   common  what all parts of the drawing have */
#include "api/part_survey.h"

#include <math.h>
#include <string.h>

#include "api/part_check.h"
#include "api/part_marks.h"
#include "api/part_tones.h"
#include "base/hash.h"
#include "ink/tone.h"
#include "parts/part_common.h"
#include "scene/weld/weld_candidates.h"
#include "scene/weld/weld_near.h"
#include "view/camera_aim.h"
#include "view/project.h"
#include "view/rescale.h"
#include "view/used.h"

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

static recto_status make_common(struct part_survey *survey,
                                recto_error *error) {
  const recto_options *o = survey->options;
  struct part_common *common = &survey->common;
  const char *path = survey->model->path != NULL ? survey->model->path : "";
  common->edges = o->ink.edges;
  common->has_fragments = o->ink.fill != RECTO_FILL_NONE;
  common->has_hidden = o->ink.hidden != RECTO_HIDDEN_NONE;
  common->hidden_by_max = part_hidden_by_max(o);
  common->has_ids = o->ink.ids;
  common->has_tones = part_tones_are_wanted(o);
  if (common->has_tones)
    tones_set_light(common->light, &survey->camera, o);
  common->has_marks = survey->marks.side.count > 0;
  common->crease_deg = o->mesh.crease_deg;
  common->crease_start_deg = o->mesh.crease_start_deg;
  common->camera = survey->camera;
  common->camera_kind = o->camera.kind;
  common->azimuth_deg = o->camera.azimuth_deg;
  common->elevation_deg = o->camera.elevation_deg;
  memcpy(common->eye, o->camera.eye, sizeof common->eye);
  common->fov_deg = o->camera.fov_deg;
  uint64_t sum;
  if (!copy_names(common, path, survey->pick.source.scene))
    return error_memory(error);
  recto_status status = part_common_checksum(common, &sum, error);
  common->id = hash_add(hash_model(&survey->pick), sum);
  common->id = hash_add_double(common->id, o->mesh.weld);
  for (size_t i = 0; i < survey->marks.side.count; i++)
    common->id = hash_add(common->id, survey->marks.side.item[i]);
  return status;
}

/* ---- The camera and the window ------------------------------------------- */

/* Aims the camera.
 * used  one a point */
static recto_status aim_part(struct part_survey *survey, const uint8_t *used,
                             recto_error *error) {
  const struct scene *scene = survey->pick.source.scene;
  if (rescale_is_wanted(scene, used))
    return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                     "a scene of extreme size cannot be drawn in parts");
  recto_status status = camera_aim_at_points(
      &survey->camera, scene, (struct known_points){.used = used},
      survey->options, error);
  if (status != RECTO_OK)
    return status;
  if (!survey->camera.all_on_page)
    return error_set(error, RECTO_ERROR_UNSUPPORTED, NULL, 0,
                     "what the page or the near plane may clip cannot be drawn "
                     "in parts: let the drawing fill the page");
  const recto_mesh_options *mesh = &survey->options->mesh;
  const struct weld_request weld = {
      .length = mesh->weld,
      .unstated = precision_of_bits(mesh->coordinate_bits)};
  survey->weld = weld_near_length_most(scene, &weld);
  if (survey->weld == 0 && mesh->weld != 0)
    survey->weld = WELD_LENGTH_OF_SLITS;
  return RECTO_OK;
}

int64_t part_survey_margin(const struct part_survey *survey) {
  const struct camera *camera = &survey->camera;
  const double most = 1 << 30;
  double weld = survey->weld < WELD_LENGTH_LEAST ? 0 : survey->weld;
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

bool part_survey_owned(const recto_options *options) {
  return options->ink.fill != RECTO_FILL_NONE || options->ink.ids;
}

struct part_window *part_survey_windows(const struct part_survey *survey,
                                        const struct page_place *place) {
  uint32_t count = survey->common.parts;
  struct part_window *window = mem_alloc(count, sizeof *window);
  if (window != NULL &&
      !page_windows_make(&survey->camera, place,
                         survey->pick.source.scene->point.count, count,
                         window)) {
    mem_free(window);
    window = NULL;
  }
  return window;
}

/* Chooses the window, and what is picked for it. */
static recto_status aim_pick(struct part_survey *survey, recto_error *error) {
  const struct scene *scene = survey->pick.source.scene;
  struct page_place *place = page_places(&survey->camera, scene);
  struct part_window *window =
      place != NULL ? part_survey_windows(survey, place) : NULL;
  bool ok = window != NULL;
  if (ok) {
    survey->window = window[survey->index];
    survey->request = (struct part_scene_request){
        .camera = &survey->camera,
        .window = survey->window,
        .margin = part_survey_margin(survey),
        .reach = reach_of_window(&survey->camera, scene->point.count),
        .owned = part_survey_owned(survey->options)};
    ok = part_scene_aim(&survey->pick, &survey->request, place);
  }
  mem_free(window);
  mem_free(place);
  return ok ? RECTO_OK : error_memory(error);
}

/* ---- The model ----------------------------------------------------------- */

/* Opens the model, whose points are then known. */
static recto_status open_model(struct part_survey *survey, recto_error *error) {
  const recto_scene *model = survey->model;
  struct face_source *source = &survey->pick.source;
  source->scene = &model->scene;
  scene_init(&survey->read);
  if (!model->is_deferred)
    return RECTO_OK;
  if (model->scene.point.count > 0)
    return error_set(error, RECTO_ERROR_ARGUMENT, NULL, 0,
                     "a model that was read for parts is not alone in its "
                     "scene");
  survey->diagnostics =
      (struct diagnostics){.file = model->path,
                           .warning = survey->options->warning,
                           .user = survey->options->user};
  survey->read.needs_crease_marks =
      survey->options->mesh.crease_marks != RECTO_CREASE_MARKS_NONE;
  survey->read.needs_colours = survey->options->ink.fill == RECTO_FILL_PAINT;
  recto_status status =
      read_passes_open(&source->passes, model->path, model->format, 0, error);
  if (status == RECTO_OK && source->passes == NULL)
    return error_set(error, RECTO_ERROR_IO, model->path, 0,
                     "cannot be read any more as it was when it was opened");
  source->scene = &survey->read;
  return status == RECTO_OK ? read_passes_points(source->passes, &survey->read,
                                                 &survey->diagnostics, error)
                            : status;
}

/* Sets which points are used, as the last pass found; returns whether that is
 * new. */
static bool take_used(const struct part_survey *survey, uint8_t *used) {
  bool is_new = false;
  for (size_t p = 0; p < survey->pick.source.scene->point.count; p++) {
    is_new = is_new || (used[p] != 0) != face_pick_uses(&survey->pick, p);
    used[p] = face_pick_uses(&survey->pick, p);
  }
  return is_new;
}

/* Aims the camera by what is known to be used, and passes over the model.
 * used  one a point */
static recto_status aim_and_pick(struct part_survey *survey,
                                 const uint8_t *used, recto_error *error) {
  recto_status status = aim_part(survey, used, error);
  if (status == RECTO_OK && survey->aims)
    status = aim_pick(survey, error);
  return status == RECTO_OK ? face_pick_pass(&survey->pick, error) : status;
}

/* The same where only a pass shows which points are used: those that seem to be
 * are assumed at first. */
static recto_status guess_and_pick(struct part_survey *survey, uint8_t *used,
                                   recto_error *error) {
  read_passes_guess_used(survey->pick.source.passes, used);
  recto_status guessed = aim_part(survey, used, error);
  if (guessed == RECTO_OK && survey->aims)
    guessed = aim_pick(survey, error);
  const struct camera guess = survey->camera;
  recto_error of_pass;
  recto_status status = face_pick_pass(&survey->pick, &of_pass);
  if (status != RECTO_OK && error != NULL)
    *error = of_pass;
  if (status != RECTO_OK || !take_used(survey, used))
    return status != RECTO_OK ? status : guessed;
  status = aim_part(survey, used, error);
  bool is_same = guessed == RECTO_OK && status == RECTO_OK &&
                 memcmp(&guess, &survey->camera, sizeof guess) == 0;
  return status != RECTO_OK || is_same || !survey->aims
             ? status
             : aim_and_pick(survey, used, error);
}

recto_status part_survey_run(struct part_survey *survey, recto_error *error) {
  recto_status status = open_model(survey, error);
  survey->pick.counts_groups = survey->options->ink.ids;
  survey->pick.picks_all = survey->picks_all;
  if (status != RECTO_OK)
    return status;
  const struct scene *scene = survey->pick.source.scene;
  bool is_held = survey->pick.source.passes == NULL;
  uint8_t *used =
      is_held ? used_points(scene, NULL) : mem_alloc(scene->point.count, 1);
  if (used == NULL)
    return error_memory(error);
  status = is_held ? aim_and_pick(survey, used, error)
                   : guess_and_pick(survey, used, error);
  mem_free(used);
  if (status == RECTO_OK)
    status = part_marks_find(&survey->marks, survey->model,
                             &survey->pick.source, survey->options, error);
  return status == RECTO_OK ? make_common(survey, error) : status;
}

void part_survey_drop_model(struct part_survey *survey) {
  read_passes_close(survey->pick.source.passes);
  survey->pick.source.passes = NULL;
  ARRAY_FREE(&survey->read.point);
  ARRAY_FREE(&survey->marks.side);
  face_pick_fini(&survey->pick);
}

void part_survey_fini(struct part_survey *survey) {
  part_common_fini(&survey->common);
  part_survey_drop_model(survey);
  scene_fini(&survey->read);
}
