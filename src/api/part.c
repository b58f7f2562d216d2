/* part.c - draws one part of a drawing, and writes it to a file.
 *
 * Phases
 *   check    whether the parts can be joined exactly
 *   survey   the whole model, for the camera and the windows of the page
 *   keep     the faces that meet the part's window, as a scene of their own;
 *            the model is then dropped
 *   solve    that scene, on the page grid of the whole; write */
#include "api/options.h"
#include "api/part_check.h"
#include "api/part_solve.h"
#include "api/part_survey.h"
#include "api/shares.h"

/* The state of one part; zero-initialised is empty. */
struct part_work {
  struct part_survey survey;
  struct part_solve solve;
};

static void part_work_fini(struct part_work *work) {
  part_solve_fini(&work->solve);
  part_survey_fini(&work->survey);
}

/* Takes the faces of the part from the model, which is dropped. */
static recto_status keep_part(struct part_work *work, recto_error *error) {
  struct part_survey *survey = &work->survey;
  struct part_solve *solve = &work->solve;
  recto_status status =
      part_scene_make(&solve->scene, &survey->pick, &survey->request, error);
  if (status == RECTO_OK && survey->common.has_marks) {
    struct part_scene *part = &solve->scene;
    part->crease_mark =
        side_marks_select(&survey->marks, &part->scene, part->face_number);
    if (part->crease_mark == NULL)
      status = error_memory(error);
  }
  if (status == RECTO_OK && survey->common.has_tones &&
      scene_face_count(&solve->scene.scene) > 0)
    status = part_tones_find(&solve->tones, &solve->scene, &survey->pick.source,
                             &survey->marks, &survey->camera, survey->options,
                             error);
  part_survey_drop_model(survey);
  solve->options = survey->options;
  solve->weld = survey->weld;
  solve->part.index = survey->index;
  solve->part.window = survey->window;
  solve->part.common = survey->common;
  survey->common = (struct part_common){0};
  return status;
}

/* Checks the arguments, and copies the options. */
static recto_status begin_part(struct part_work *work, recto_options *own,
                               const recto_scene *scene,
                               const recto_options *options, unsigned number,
                               unsigned count, const char *path,
                               recto_error *error) {
  if (scene == NULL || path == NULL)
    return error_null(error, scene == NULL ? "the scene" : "the path");
  recto_status status = part_check_number(number, count, error);
  if (status == RECTO_OK)
    status = options_copy_valid(own, options, error);
  if (status == RECTO_OK)
    status = options_settle_scale(own, &scene->scene, error);
  if (status == RECTO_OK)
    status = part_check_solve(own, error);
  *work = (struct part_work){
      .survey = {.model = scene, .options = own, .index = number - 1}};
  work->survey.common.parts = count;
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
  work.survey.aims = true;
  status = part_survey_run(&work.survey, error);
  if (status == RECTO_OK &&
      !poll_stage(share[SHARE_TOPOLOGY], share[SHARE_SOLVE + 1], "part"))
    status = error_cancelled(error);
  if (status == RECTO_OK)
    status = keep_part(&work, error);
  if (status == RECTO_OK)
    status = part_solve_run(&work.solve, error);
  const struct scene *read = work.survey.pick.source.scene;
  if (status == RECTO_OK)
    status = part_solve_save(&work.solve, path, read->file.item,
                             read->file.count, "model", error);
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
  struct poll poll;
  uint64_t id;
  if (is_there == NULL)
    return error_null(error, "whether it is there");
  *is_there = false;
  recto_status status =
      begin_part(&work, &own, scene, options, number, count, path, error);
  if (status != RECTO_OK)
    return status;
  own.warning = NULL;
  shares_open_poll(&poll, &own, SHARE_READ, "read");
  if (part_solve_find(path, number - 1, &id)) {
    status = part_survey_run(&work.survey, error);
    *is_there = status == RECTO_OK && id == work.survey.common.id;
  }
  part_work_fini(&work);
  poll_close(&poll);
  return status;
}
