/* render_multiview.c - draws several views of a scene on one page.
 *
 * Phases
 *   prepare the scene, unless that was done, and arrange the views;
 *   draw each by itself, on the page of all and moved to its place there;
 *   put the drawings together. */
#include "api/render_multiview.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "api/captions.h"
#include "api/multiview.h"
#include "api/multiview_labels.h"
#include "api/multiview_text.h"
#include "api/options.h"
#include "api/render.h"
#include "api/render_warnings.h"
#include "api/shares.h"
#include "api/stats.h"
#include "base/clock.h"
#include "drawing/append.h"
#include "drawing/circle_clip.h"

struct multiview_work {
  const recto_scene *scene;
  const recto_options *options;
  struct preparation own;             /* empty where the scene has one */
  const struct preparation *prepared; /* that one, or its own */
  struct multiview views;
  recto_drawing *view[MULTIVIEW_MAX + RECTO_DETAIL_MAX]; /* then details */
  recto_drawing *made;
  ARRAY(char *) warning; /* those that views gave */
};

/* How many drawings make the sheet. */
static size_t count_parts(const struct multiview_work *work) {
  return work->views.count + work->views.details;
}

/* ---- Calls to the caller ------------------------------------------------- */

/* What the drawing of one view reports: its share of the whole work, and its
 * warnings. */
struct view_calls {
  struct multiview_work *work;
  double from, to;   /* of the whole work */
  double begin, end; /* of that of a drawing of one view */
};

static bool pass_view_progress(void *user, double share, const char *stage) {
  const struct view_calls *view = user;
  const recto_options *options = view->work->options;
  double done = (share - view->begin) / (view->end - view->begin);
  return options->progress(options->user,
                           view->from + done * (view->to - view->from), stage);
}

/* Passes what no view before warned of. */
static void pass_view_warning(void *user, const char *file, unsigned long line,
                              const char *text) {
  const struct view_calls *view = user;
  struct multiview_work *work = view->work;
  for (size_t i = 0; i < work->warning.count; i++)
    if (strcmp(work->warning.item[i], text) == 0)
      return;
  char *copy = mem_copy_text(text);
  if (copy != NULL && !ARRAY_PUSH(&work->warning, copy))
    mem_free(copy);
  work->options->warning(work->options->user, file, line, text);
}

static void warn_of_empty_part(const struct multiview_work *work,
                               const char *what, const char *name) {
  char text[64];
  (void)snprintf(text, sizeof text, "the %s %s is empty", what, name);
  work->options->warning(work->options->user, "", 0, text);
}

/* Warns of a sheet without any ink, else of the views and details that have
 * none. */
static void warn_of_empty_parts(const struct multiview_work *work) {
  bool is_empty[MULTIVIEW_MAX + RECTO_DETAIL_MAX], all = true;
  if (work->options->warning == NULL)
    return;
  for (size_t i = 0; i < count_parts(work); i++) {
    const struct drawing *drawing = &work->view[i]->drawing;
    is_empty[i] = drawing->stroke.count == 0 && drawing->fill.count == 0;
    all = all && is_empty[i];
  }
  if (all)
    warn_of_nothing(work->options);
  for (size_t i = 0; !all && i < count_parts(work); i++)
    if (is_empty[i] && i < work->views.count)
      warn_of_empty_part(work, "view", multiview_name(&work->views, i));
    else if (is_empty[i])
      warn_of_empty_part(
          work, "detail",
          multiview_labels_letter(&work->views.detail[i - work->views.count]));
}

/* Makes the drawing of a part call back by `calls`.  A detail would warn of
 * what lies beyond its circle. */
static void divide_work(struct view_calls *calls, struct multiview_work *work,
                        size_t index, recto_options *of_view) {
  double begin[SHARE_STAGES + 1];
  shares_plan(begin, work->options);
  double first = begin[SHARE_TOPOLOGY], last = begin[SHARE_WRITE];
  double each = (last - first) / (double)count_parts(work);
  *calls = (struct view_calls){.work = work,
                               .from = first + (double)index * each,
                               .to = first + (double)(index + 1) * each,
                               .begin = first,
                               .end = last};
  of_view->user = calls;
  if (of_view->progress != NULL)
    of_view->progress = pass_view_progress;
  if (of_view->warning != NULL)
    of_view->warning = index < work->views.count ? pass_view_warning : NULL;
}

/* ---- Stages -------------------------------------------------------------- */

static recto_status prepare(struct multiview_work *work, recto_error *error) {
  const struct preparation *shared = work->scene->prepared;
  struct poll poll;
  recto_status status = RECTO_OK;
  shares_open_poll(&poll, work->options, SHARE_TOPOLOGY, "topology");
  work->prepared = &work->own;
  if (shared != NULL && preparation_is_valid_for(shared, work->options))
    work->prepared = shared;
  else
    status = preparation_init(&work->own, &work->scene->scene, work->options,
                              PREPARATION_FOR_VIEWS, error);
  if (status == RECTO_OK)
    status = multiview_arrange(
        &work->views, work->prepared, work->options,
        options_unit_mm(work->options, &work->scene->scene), error);
  poll_close(&poll);
  return status;
}

/* Says which view an error of verification is in. */
static void name_view_of_error(const char *view, recto_error *error) {
  char text[sizeof error->text];
  if (error == NULL || error->code != RECTO_ERROR_VERIFY)
    return;
  memcpy(text, error->text, sizeof text);
  (void)snprintf(error->text, sizeof error->text, "the view %s: %.220s", view,
                 text);
}

/* Removes what is outside of a detail's circle. */
static recto_status clip_detail(struct multiview_work *work, size_t index,
                                recto_error *error) {
  const struct multiview_detail *detail =
      &work->views.detail[index - work->views.count];
  const struct drawing_circle circle = {
      detail->centre_mm[0], detail->centre_mm[1], detail->radius_mm};
  struct poll poll;
  shares_open_poll(&poll, work->options, SHARE_WRITE, "sheet");
  recto_status status =
      drawing_clip_circle(&work->view[index]->drawing, &circle,
                          multiview_text_pen_mm(work->options))
          ? RECTO_OK
          : error_memory(error);
  poll_close(&poll);
  return status;
}

static recto_status draw_views(struct multiview_work *work,
                               recto_error *error) {
  recto_status status = RECTO_OK;
  bool hide = multiview_has_hidden(&work->views, work->options);
  for (size_t i = 0; i < count_parts(work) && status == RECTO_OK; i++) {
    recto_options of_view;
    struct view_calls calls;
    struct render_request request = {.scene = work->scene,
                                     .options = &of_view,
                                     .prepared = work->prepared,
                                     .may_be_empty = true,
                                     .others_hide = hide};
    multiview_options(&work->views, i, work->options, &of_view,
                      request.shift_mm);
    divide_work(&calls, work, i, &of_view);
    status = render_view(&work->view[i], &request, error);
    if (status == RECTO_OK && i >= work->views.count)
      status = clip_detail(work, i, error);
    if (status != RECTO_OK)
      name_view_of_error(multiview_name(&work->views, i), error);
  }
  if (status == RECTO_OK)
    warn_of_empty_parts(work);
  return status;
}

static recto_status put_together(struct multiview_work *work,
                                 recto_error *error) {
  struct poll poll;
  struct drawing *drawing = &work->made->drawing;
  recto_status status = RECTO_OK;
  shares_open_poll(&poll, work->options, SHARE_WRITE, "sheet");
  for (size_t i = 0; i < count_parts(work) && status == RECTO_OK; i++) {
    status = drawing_append(drawing, &work->view[i]->drawing,
                            multiview_name(&work->views, i), error);
    drawing_fini(&work->view[i]->drawing);
    drawing_init(&work->view[i]->drawing);
  }
  if (status == RECTO_OK &&
      !(multiview_text_add(drawing, &work->views, work->options) &&
        captions_set_sheet(drawing, work->scene, work->options, &work->views)))
    status = error_memory(error);
  poll_close(&poll);
  return status;
}

/* ---- Reports ------------------------------------------------------------- */

static void sum_verdicts(struct multiview_work *work) {
  struct verify_counts sum = {0, 0, 0};
  for (size_t i = 0; i < count_parts(work); i++) {
    const struct verify_counts *counts = &work->view[i]->verified;
    sum.visible += counts->visible;
    sum.hidden += counts->hidden;
    sum.undecided += counts->undecided;
  }
  work->made->verified = sum;
  if (work->options->verify > 0)
    verify_summarise(work->made->verdict, &sum);
}

static void report_sheet(struct multiview_work *work) {
  struct report *report = work->made->report;
  const struct multiview *views = &work->views;
  report_count(report, "sheet", "views", views->count);
  report_text(report, "sheet", "projection",
              work->options->sheet.arrangement == RECTO_ARRANGEMENT_FIRST
                  ? "first-angle"
                  : "third-angle");
  report_double(report, "sheet", "scale",
                fmin(views->scale / views->unit_mm, DBL_MAX));
  report_double(report, "sheet", "gap_mm", views->gap_mm);
  for (size_t i = 0; i < count_parts(work); i++) {
    report_adopt(report, "views", multiview_name(views, i),
                 work->view[i]->report);
    work->view[i]->report = NULL;
  }
  stats_add_drawing(report, &work->made->drawing, work->options);
  report_count(report, "memory", "peak_bytes", mem_peak_bytes());
}

/* Takes what the sheet has of its first view: its projection, and the files of
 * the scene. */
static void take_from_first(recto_drawing *made, recto_drawing *first) {
  memcpy(made->matrix, first->matrix, sizeof made->matrix);
  memcpy(made->depth, first->depth, sizeof made->depth);
  made->file.item = first->file.item;
  made->file.count = first->file.count;
  made->file.capacity = first->file.capacity;
  first->file.item = NULL;
  first->file.count = first->file.capacity = 0;
}

/* ---- The whole ----------------------------------------------------------- */

static recto_status run(struct multiview_work *work, recto_error *error) {
  double cpu = clock_cpu(), wall = clock_wall();
  work->made = mem_calloc(1, sizeof *work->made);
  if (work->made == NULL)
    return error_memory(error);
  drawing_init(&work->made->drawing);
  work->made->report = report_create();
  stats_add_scene(work->made->report, work->scene);
  recto_status status = prepare(work, error);
  stats_add_seconds(work->made->report, "topology_cpu_s", clock_cpu() - cpu);
  stats_add_seconds(work->made->report, "topology_wall_s", clock_wall() - wall);
  if (status == RECTO_OK)
    status = draw_views(work, error);
  if (status == RECTO_OK)
    status = put_together(work, error);
  if (status != RECTO_OK)
    return status;
  take_from_first(work->made, work->view[0]);
  sum_verdicts(work);
  stats_add_seconds(work->made->report, "render_cpu_s", clock_cpu() - cpu);
  stats_add_seconds(work->made->report, "render_wall_s", clock_wall() - wall);
  report_sheet(work);
  return RECTO_OK;
}

recto_status render_multiview(recto_drawing **drawing, const recto_scene *scene,
                              const recto_options *options,
                              recto_error *error) {
  struct multiview_work work = {.scene = scene, .options = options};
  recto_status status = run(&work, error);
  for (size_t i = 0; i < count_parts(&work); i++)
    recto_drawing_destroy(work.view[i]);
  for (size_t i = 0; i < work.warning.count; i++)
    mem_free(work.warning.item[i]);
  ARRAY_FREE(&work.warning);
  preparation_fini(&work.own);
  *drawing = status == RECTO_OK ? work.made : NULL;
  if (status != RECTO_OK)
    recto_drawing_destroy(work.made);
  return status;
}
