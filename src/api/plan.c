/* plan.c - makes the plan of a drawing's parts in one go over the model, and
 * draws parts by it.
 *
 * Phases of making it
 *   survey    as for a part, but all faces are picked
 *   tones     of all faces, where they are wanted
 *   list      which faces the part of each window has
 *   sections  one after the other
 * Phases of a part
 *   section   what the plan holds of it
 *   solve, write */
#include "api/options.h"
#include "api/part_check.h"
#include "api/part_solve.h"
#include "api/part_survey.h"
#include "api/shares.h"
#include "base/stream.h"
#include "parts/plan_file.h"

/* ---- Making a plan ------------------------------------------------------- */

/* The state of a plan that is made; zero-initialised is empty. */
struct plan_making {
  struct part_survey survey;
  struct scene whole; /* all that was picked; borrowed */
  uint8_t *mark;      /* of creases, as of side_marks_select; NULL: none */
  struct tones tones;
  struct plan_window *window; /* of each part */
  uint32_t count;
};

static void plan_making_fini(struct plan_making *making) {
  for (uint32_t w = 0; making->window != NULL && w < making->count; w++) {
    ARRAY_FREE(&making->window[w].face);
    ARRAY_FREE(&making->window[w].wire);
  }
  mem_free(making->window);
  mem_free(making->mark);
  tones_fini(&making->tones);
  part_survey_fini(&making->survey);
}

/* Lists what the part of each window has. */
static recto_status list_windows(struct plan_making *making,
                                 recto_error *error) {
  struct part_survey *survey = &making->survey;
  struct page_place *place = page_places(&survey->camera, &making->whole);
  struct part_window *window =
      place != NULL ? part_survey_windows(survey, place) : NULL;
  const struct plan_faces_request request = {
      &making->whole, place, part_survey_margin(survey),
      part_survey_owned(survey->options)};
  making->window = mem_calloc(making->count, sizeof *making->window);
  recto_status status = RECTO_OK;
  if (window == NULL || making->window == NULL)
    status = error_memory(error);
  for (uint32_t w = 0; status == RECTO_OK && w < making->count; w++)
    making->window[w].window = window[w];
  if (status == RECTO_OK)
    status = plan_faces_list(making->window, making->count, &request, error);
  mem_free(window);
  mem_free(place);
  return status;
}

static recto_status write_sections(struct plan_making *making,
                                   struct plan_writer *writer,
                                   recto_error *error) {
  struct plan_section_maker maker = {.all = &making->survey.pick.picked,
                                     .scene = &making->whole,
                                     .tone = making->tones.corner,
                                     .uniform = making->tones.uniform,
                                     .mark = making->mark};
  recto_status status = RECTO_OK;
  for (uint32_t w = 0; status == RECTO_OK && w < making->count &&
                       stream_status(writer->bytes.stream) == RECTO_OK;
       w++) {
    struct plan_section section = {.index = 0};
    status = poll_now() ? plan_section_make(&section, &maker,
                                            &making->window[w], error)
                        : error_cancelled(error);
    if (status == RECTO_OK)
      status = plan_writer_add(writer, &section, error);
    plan_section_fini(&section);
    ARRAY_FREE(&making->window[w].face);
  }
  plan_section_maker_fini(&maker);
  return status;
}

/* Writes the plan, unless that would replace the model. */
static recto_status save_plan(struct plan_making *making, const char *path,
                              recto_error *error) {
  struct part_survey *survey = &making->survey;
  const struct scene *read = survey->pick.source.scene;
  struct stream *stream = NULL;
  struct plan_writer writer = {.section = {NULL, 0, 0}};
  recto_status status = stream_open(&stream, path, error);
  for (size_t i = 0; status == RECTO_OK && i < read->file.count; i++)
    if (stream_replaces(stream, read->file.item[i]))
      status = error_set(error, RECTO_ERROR_ARGUMENT, path, 0,
                         "the plan would replace the model");
  if (status == RECTO_OK) {
    plan_writer_begin(&writer, stream, &survey->common, error);
    status = write_sections(making, &writer, error);
  }
  /* A fault of the stream is reported when that is finished. */
  if (status == RECTO_OK)
    status = plan_writer_end(&writer, &survey->common, survey->weld, error);
  plan_writer_fini(&writer);
  if (status == RECTO_OK)
    return stream_finish(stream, error);
  stream_discard(stream);
  return status;
}

static recto_status make_plan(struct plan_making *making, const char *path,
                              const double share[SHARE_STAGES + 1],
                              recto_error *error) {
  struct part_survey *survey = &making->survey;
  recto_status status = part_survey_run(survey, error);
  if (status == RECTO_OK &&
      !poll_stage(share[SHARE_TOPOLOGY], share[SHARE_WRITE], "plan"))
    status = error_cancelled(error);
  if (status != RECTO_OK)
    return status;
  making->whole = face_pick_scene(&survey->pick);
  read_passes_close(survey->pick.source.passes);
  survey->pick.source.passes = NULL;
  if (survey->common.has_marks) {
    making->mark = side_marks_select(&survey->marks, &making->whole,
                                     survey->pick.picked.face_number.item);
    if (making->mark == NULL)
      return error_memory(error);
  }
  ARRAY_FREE(&survey->marks.side);
  if (survey->common.has_tones)
    status = part_tones_of_whole(&making->tones, &making->whole, making->mark,
                                 &survey->camera, survey->options, error);
  if (status == RECTO_OK)
    status = list_windows(making, error);
  return status == RECTO_OK ? save_plan(making, path, error) : status;
}

recto_status recto_scene_write_plan(const recto_scene *scene,
                                    const recto_options *options,
                                    unsigned count, const char *path,
                                    recto_error *error) {
  recto_options own;
  struct poll poll;
  if (scene == NULL || path == NULL)
    return error_null(error, scene == NULL ? "the scene" : "the path");
  recto_status status = part_check_number(1, count, error);
  if (status == RECTO_OK)
    status = options_copy_valid(&own, options, error);
  if (status == RECTO_OK)
    status = options_settle_scale(&own, &scene->scene, error);
  if (status == RECTO_OK)
    status = part_check_solve(&own, error);
  if (status != RECTO_OK)
    return status;
  struct plan_making making = {.count = count};
  double share[SHARE_STAGES + 1];
  making.survey =
      (struct part_survey){.model = scene, .options = &own, .picks_all = true};
  making.survey.common.parts = count;
  shares_plan(share, &own);
  shares_open_poll(&poll, &own, SHARE_READ, "read");
  status = make_plan(&making, path, share, error);
  plan_making_fini(&making);
  poll_close(&poll);
  return status;
}

/* ---- A part by a plan ---------------------------------------------------- */

/* The state of a part that is made by a plan; zero-initialised is empty. */
struct planned_part {
  struct plan plan;
  recto_options options;
  struct part_solve solve;
};

static void planned_part_fini(struct planned_part *planned) {
  part_solve_fini(&planned->solve);
  plan_close(&planned->plan);
}

/* Sets what the plan decides. */
static void take_plan_options(recto_options *o,
                              const struct part_common *common) {
  o->ink.edges = common->edges;
  o->ink.ids = common->has_ids;
  o->ink.hidden_by_max = (int)common->hidden_by_max;
  if (!common->has_hidden)
    o->ink.hidden = RECTO_HIDDEN_NONE;
  else if (o->ink.hidden == RECTO_HIDDEN_NONE)
    o->ink.hidden = RECTO_HIDDEN_LAYER;
  if (!common->has_fragments)
    o->ink.fill = RECTO_FILL_NONE;
  else if (o->ink.fill == RECTO_FILL_NONE)
    o->ink.fill = RECTO_FILL_SHADE;
  o->mesh.crease_deg = common->crease_deg;
  o->mesh.crease_start_deg = common->crease_start_deg;
}

/* Checks the arguments, and opens the plan. */
static recto_status begin_planned(struct planned_part *planned,
                                  const char *plan,
                                  const recto_options *options, unsigned number,
                                  unsigned count, const char *path,
                                  recto_error *error) {
  *planned = (struct planned_part){.plan = {.path = NULL}};
  if (plan == NULL || path == NULL)
    return error_null(error, plan == NULL ? "the plan" : "the path");
  recto_options *own = &planned->options;
  recto_status status = part_check_number(number, count, error);
  if (status == RECTO_OK)
    status = options_copy_valid(own, options, error);
  if (status == RECTO_OK)
    status = part_check_solve(own, error);
  if (status == RECTO_OK)
    status = plan_open(&planned->plan, plan, error);
  const struct part_common *common = &planned->plan.common;
  if (status == RECTO_OK && common->parts != count)
    status = error_set(error, RECTO_ERROR_ARGUMENT, plan, 0,
                       "the plan is one of %lu parts, not of %u",
                       (unsigned long)common->parts, count);
  if (status == RECTO_OK)
    status = part_check_ink(own, common, true, error);
  if (status == RECTO_OK)
    take_plan_options(own, common);
  return status;
}

/* Takes what the plan holds of a part. */
static recto_status take_section(struct planned_part *planned, uint32_t index,
                                 recto_error *error) {
  struct plan_section section = {.index = 0};
  struct part_solve *solve = &planned->solve;
  struct plan *plan = &planned->plan;
  recto_status status = plan_read_section(plan, index, &section, error);
  if (status != RECTO_OK) {
    plan_section_fini(&section);
    return status;
  }
  solve->options = &planned->options;
  solve->weld = plan->weld;
  solve->scene = section.part;
  solve->tones = (struct part_tones){section.tone, section.uniform};
  solve->part.index = index;
  solve->part.window = section.window;
  solve->part.common = plan->common;
  plan->common = (struct part_common){0};
  struct scene *scene = &solve->scene.scene;
  scene->group.item = solve->part.common.group.item;
  scene->group.count = solve->part.common.group.count;
  if (!part_scene_needs_places(&solve->part.common))
    return RECTO_OK;
  solve->scene.place = page_places(&solve->part.common.camera, scene);
  return solve->scene.place != NULL ? RECTO_OK : error_memory(error);
}

recto_status recto_plan_write_part(const char *plan,
                                   const recto_options *options,
                                   unsigned number, unsigned count,
                                   const char *path, recto_error *error) {
  struct planned_part planned;
  struct poll poll;
  recto_status status =
      begin_planned(&planned, plan, options, number, count, path, error);
  if (status == RECTO_OK) {
    shares_open_poll(&poll, &planned.options, SHARE_SOLVE, "part");
    status = take_section(&planned, number - 1, error);
    if (status == RECTO_OK)
      status = part_solve_run(&planned.solve, error);
    if (status == RECTO_OK)
      status = part_solve_save(&planned.solve, path, &planned.plan.reader.file,
                               1, "plan", error);
    poll_close(&poll);
  }
  planned_part_fini(&planned);
  return status;
}

recto_status recto_plan_has_part(const char *plan, const recto_options *options,
                                 unsigned number, unsigned count,
                                 const char *path, bool *is_there,
                                 recto_error *error) {
  struct planned_part planned;
  uint64_t id;
  if (is_there == NULL)
    return error_null(error, "whether it is there");
  *is_there = false;
  recto_status status =
      begin_planned(&planned, plan, options, number, count, path, error);
  if (status == RECTO_OK)
    *is_there =
        part_solve_find(path, number - 1, &id) && id == planned.plan.common.id;
  planned_part_fini(&planned);
  return status;
}
