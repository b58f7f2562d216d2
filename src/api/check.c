/* check.c - checks any program's drawing of a scene by the judge.
 *
 * The page is the file's own.  Lines may be off, along and across, by a quarter
 * of the pen's width, which is invisible, and by what the options allow ink to
 * move them (ink_deviation_mm). */
#include <float.h>
#include <math.h>

#include "api/contour_fit.h"
#include "api/handle.h"
#include "api/judge_input.h"
#include "api/multiview.h"
#include "api/options.h"
#include "api/sized.h"
#include "base/input.h"
#include "base/poll.h"
#include "ink/dash_pattern.h"
#include "ink/ink.h"
#include "ink/pens.h"
#include "judge/svg/svg.h"
#include "scene/weld/weld_near.h"

/* The number of samples of the drawing, and of the edges. */
enum { SAMPLES = 200000 };

static recto_status read_drawing(struct judge_drawing *drawing,
                                 const char *path, recto_error *error) {
  struct input input;
  recto_status status = input_load(&input, path, error);
  if (status == RECTO_OK) {
    const char *fault = judge_read_svg(drawing, input.bytes, input.count);
    if (fault == JUDGE_NO_MEMORY)
      status = error_memory(error);
    else if (fault != NULL)
      status = error_set(error, RECTO_ERROR_FORMAT, path, 0, "%s", fault);
  }
  input_unload(&input);
  return status;
}

static void fill_verdict(recto_verdict *to, const struct judge_verdict *from) {
  *to = (recto_verdict){
      .drawn_mm = from->drawn.mm,
      .false_mm = from->false_ink.mm,
      .visible_mm = from->visible.mm,
      .missing_mm = from->missing.mm,
      .undecided_mm = from->undecided_ink.mm + from->undecided.mm,
      .false_at_mm = {from->false_at.at.x, from->false_at.at.y},
      .missing_at_mm = {from->missing_at.at.x, from->missing_at.at.y},
  };
}

/* The largest of all pens' least stroke lengths: which pen drew a line of the
 * file is unknown. */
static recto_status find_shortest(struct judge_options *options,
                                  const struct scene *scene,
                                  const recto_options *o, recto_error *error) {
  struct pens pens;
  recto_status status = pens_init(&pens, scene, o, error);
  for (uint32_t pen = 0; status == RECTO_OK && pen <= o->ink.pen_count; pen++) {
    double line = pens_shortest_line_mm(&pens, pen);
    double crease = pens_short_cycle_mm(&pens, pen);
    options->shortest_mm = fmax(options->shortest_mm, line);
    options->shortest_crease_mm =
        fmax(options->shortest_crease_mm, fmax(line, crease));
    if ((o->ink.edges & RECTO_EDGES_DEFAULT) == RECTO_EDGES_DEFAULT)
      options->shortest_silhouette_mm =
          fmax(options->shortest_silhouette_mm,
               pens_shortest_isolated_mm(&pens, pen));
  }
  pens_fini(&pens);
  return status;
}

/* Moves a drawing whose page was cropped to the place that its coordinates had
 * on a page of that height. */
static void undo_cropping(struct judge_drawing *drawing, double height_mm) {
  double up = height_mm - drawing->height_mm - drawing->top_mm;
  for (size_t i = 0; i < drawing->point.count; i++) {
    drawing->point.item[i].x += drawing->left_mm;
    drawing->point.item[i].y += up;
  }
}

/* Where the drawing of a view, or of a detail, is on the page. */
struct part_place {
  double shift_mm[2]; /* from where the options place it */
  struct judge_circle circle;
};

static recto_status aim_for_check(struct camera *camera,
                                  const struct preparation *prepared,
                                  const recto_options *options,
                                  recto_error *error) {
  struct smooth_surface surface = {.facing = NULL};
  recto_status status = contour_fit_aim(camera, &surface, prepared,
                                        &prepared->topology, options, error);
  smooth_surface_fini(&surface);
  return status;
}

/* Checks the drawing of a view, or of a detail.
 * o  its lengths are scaled as the scene is */
static recto_status judge_file_drawing(const struct preparation *prepared,
                                       const recto_options *o,
                                       const struct part_place *place,
                                       struct judge_drawing *drawing,
                                       struct judge_verdict *verdict,
                                       recto_error *error) {
  struct camera camera;
  struct judge_input input;
  const struct scene *scene = &prepared->welded.scene;
  recto_status status = aim_for_check(&camera, prepared, o, error);
  if (status != RECTO_OK)
    return status;
  for (int k = 0; k < 2; k++)
    camera.middle_mm[k] += place->shift_mm[k];
  if (!judge_input_init(&input, scene))
    return error_memory(error);
  judge_input_cut(&input, prepared);
  struct judge_camera seen = judge_input_camera(&input, &camera, o);
  seen.circle = place->circle;
  struct judge_options options = judge_input_options(&input, &camera, o);
  options.samples = SAMPLES;
  options.edges &= ~dash_pattern_classes(o); /* nothing is missing in gaps */
  options.ink_distance_mm = options.lateral_mm =
      o->ink.pen_mm / 4 + ink_deviation_mm(o);
  if (!o->ink.exact) /* half a pen, as of lines that others cover */
    options.ink_distance_mm += o->ink.pen_mm / 4;
  options.crease_start_deg =
      fmax(options.crease_start_deg, pens_zigzag_start_deg(o));
  if (prepared->topology.crease_mark != NULL)
    judge_input_allow_marks(&options, o);
  status = find_shortest(&options, scene, o, error);
  if (status == RECTO_OK &&
      !judge_drawing(verdict, drawing, &input.scene, &seen, &options))
    status = error_memory(error);
  judge_input_fini(&input);
  return status;
}

/* ---- Views --------------------------------------------------------------- */

static recto_status check_view_alone(const struct preparation *prepared,
                                     const recto_options *options,
                                     struct judge_drawing *drawing,
                                     struct judge_verdict *verdict,
                                     recto_error *error) {
  static const struct part_place place = {{0, 0}, {0, 0, 0}};
  struct camera camera;
  recto_options o = *options;
  recto_status status = preparation_rescale(prepared, &o, error);
  if (status == RECTO_OK && o.output.tight) {
    status = aim_for_check(&camera, prepared, &o, error);
    if (status == RECTO_OK)
      undo_cropping(drawing, camera.page_mm[1]);
  }
  return status == RECTO_OK
             ? judge_file_drawing(prepared, &o, &place, drawing, verdict, error)
             : status;
}

/* How far a point is from the box of a view, squared. */
static double distance_to_view(const struct multiview_view *view,
                               struct judge_point2 p) {
  double dx = fmax(fmax(view->low_mm[0] - p.x, p.x - view->high_mm[0]), 0);
  double dy = fmax(fmax(view->low_mm[1] - p.y, p.y - view->high_mm[1]), 0);
  return dx * dx + dy * dy;
}

/* Whether all of a stroke is in the larger circle of a detail.
 * step_mm  by which coordinates are rounded */
static bool is_in_detail(const struct multiview_detail *detail,
                         const struct judge_drawing *drawing,
                         const struct judge_stroke *stroke, double step_mm) {
  for (uint32_t i = 0; i < stroke->count; i++) {
    struct judge_point2 p = drawing->point.item[stroke->point + i];
    if (hypot(p.x - detail->centre_mm[0], p.y - detail->centre_mm[1]) >
        detail->radius_mm + RECTO_FINEST_MM + step_mm)
      return false;
  }
  return true;
}

/* The view that a stroke is of: the nearest one; past these, the detail. */
static size_t view_of_stroke(const struct multiview *views,
                             const struct judge_drawing *drawing,
                             const struct judge_stroke *stroke,
                             double step_mm) {
  size_t nearest = 0;
  struct judge_point2 at = drawing->point.item[stroke->point];
  for (size_t i = 0; i < views->details; i++)
    if (is_in_detail(&views->detail[i], drawing, stroke, step_mm))
      return views->count + i;
  for (size_t i = 1; i < views->count; i++)
    if (distance_to_view(&views->view[i], at) <
        distance_to_view(&views->view[nearest], at))
      nearest = i;
  return nearest;
}

/* The circle in which all lines of a detail are drawn: wider lines than that of
 * the circle end before it. */
static recto_status find_circle(struct judge_circle *circle,
                                const struct multiview_detail *detail,
                                const struct scene *scene,
                                const recto_options *o, recto_error *error) {
  struct pens pens;
  double widest_mm = 0, weight = 1;
  recto_status status = pens_init(&pens, scene, o, error);
  for (unsigned i = 0; status == RECTO_OK && i < RECTO_EDGE_CLASS_COUNT; i++)
    weight = fmax(weight, pens_weight(&pens, 1u << i));
  for (uint32_t pen = 0; status == RECTO_OK && pen <= o->ink.pen_count; pen++)
    widest_mm = fmax(widest_mm, pens_width_mm(&pens, pen) * weight);
  pens_fini(&pens);
  /* DBL_MIN: nothing is drawn. */
  *circle =
      (struct judge_circle){detail->centre_mm[0], detail->centre_mm[1],
                            fmax(detail->radius_mm - widest_mm / 2, DBL_MIN)};
  return status;
}

/* Collects the strokes of a view or a detail, which refer to the points of
 * `drawing`. */
static bool collect_strokes_of_view(struct judge_drawing *part,
                                    const struct judge_drawing *drawing,
                                    const struct multiview *views, size_t index,
                                    double step_mm) {
  part->stroke.count = 0;
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct judge_stroke *stroke = &drawing->stroke.item[i];
    if (!poll_at(i) ||
        (stroke->count > 0 &&
         view_of_stroke(views, drawing, stroke, step_mm) == index &&
         !ARRAY_PUSH(&part->stroke, *stroke)))
      return false;
  }
  return true;
}

static void add_count(struct judge_count *sum, const struct judge_count *part) {
  sum->samples += part->samples;
  sum->mm += part->mm;
}

static void add_verdict(struct judge_verdict *sum,
                        const struct judge_verdict *part) {
  if (sum->false_ink.samples == 0)
    sum->false_at = part->false_at;
  if (sum->missing.samples == 0)
    sum->missing_at = part->missing_at;
  add_count(&sum->drawn, &part->drawn);
  add_count(&sum->false_ink, &part->false_ink);
  add_count(&sum->undecided_ink, &part->undecided_ink);
  add_count(&sum->visible, &part->visible);
  add_count(&sum->missing, &part->missing);
  add_count(&sum->hidden, &part->hidden);
  add_count(&sum->undecided, &part->undecided);
}

static recto_status check_sheet(const struct preparation *prepared,
                                const recto_options *o,
                                struct judge_drawing *drawing,
                                struct judge_verdict *verdict,
                                recto_error *error) {
  struct multiview views;
  recto_status status = multiview_arrange(
      &views, prepared, o, options_unit_mm(o, &prepared->welded.scene), error);
  if (status != RECTO_OK)
    return status;
  if (o->output.tight)
    undo_cropping(drawing, views.page_mm[1]);
  struct judge_drawing part = *drawing;
  part.stroke.item = NULL;
  part.stroke.count = part.stroke.capacity = 0;
  *verdict = (struct judge_verdict){.drawn = {0, 0}};
  for (size_t i = 0; i < views.count + views.details && status == RECTO_OK;
       i++) {
    recto_options of_view;
    struct part_place place = {.circle = {.radius_mm = 0}};
    struct judge_verdict found;
    multiview_options(&views, i, o, &of_view, place.shift_mm);
    if (i >= views.count)
      status = find_circle(&place.circle, &views.detail[i - views.count],
                           &prepared->welded.scene, &of_view, error);
    if (status != RECTO_OK)
      break;
    status = preparation_rescale(prepared, &of_view, error);
    if (status == RECTO_OK &&
        !collect_strokes_of_view(&part, drawing, &views, i, o->output.unit_mm))
      status = error_memory(error);
    if (status == RECTO_OK)
      status =
          judge_file_drawing(prepared, &of_view, &place, &part, &found, error);
    if (status == RECTO_OK)
      add_verdict(verdict, &found);
  }
  ARRAY_FREE(&part.stroke);
  return status;
}

/* ---- The whole check ----------------------------------------------------- */

/* Judges a drawing by its own page, unless the options take its box. */
static recto_status check_views(const struct scene *scene,
                                recto_options *options,
                                struct judge_drawing *drawing,
                                struct judge_verdict *found,
                                recto_error *error) {
  struct preparation prepared;
  if (!options->output.tight) {
    options->page.width_mm = drawing->width_mm;
    options->page.height_mm = drawing->height_mm;
    options->page.may_turn = false;
  }
  recto_status status =
      preparation_init(&prepared, scene, options, PREPARATION_FOR_VIEW, error);
  if (!contour_fit_is_wanted(options)) /* the judge has its own */
    topology_fini(&prepared.topology);
  if (status == RECTO_OK)
    status = (multiview_is_requested(options) ? check_sheet : check_view_alone)(
        &prepared, options, drawing, found, error);
  preparation_fini(&prepared);
  return status;
}

recto_status recto_scene_check_sized(const recto_scene *scene, const char *path,
                                     const recto_options *options,
                                     recto_verdict *verdict, size_t size,
                                     recto_error *error) {
  recto_verdict own = {0};
  struct judge_drawing drawing = {0};
  struct judge_verdict found;
  recto_options checked;
  struct poll poll;
  if (!sized_copy_out(verdict, size, &own, sizeof own))
    return error_null(error, "the verdict");
  if (scene == NULL || path == NULL)
    return error_null(error, scene == NULL ? "the scene" : "the path");
  recto_status status = options_copy_valid(&checked, options, error);
  if (status == RECTO_OK)
    status = options_settle_scale(&checked, &scene->scene, error);
  if (status != RECTO_OK)
    return status;
  if (checked.output.unit_mm == 0) /* text formats round to their decimals */
    checked.output.unit_mm = pow(10, -checked.output.precision);
  poll_open(&poll, &checked);
  status = poll_stage(0, 1, "check") ? read_drawing(&drawing, path, error)
                                     : error_cancelled(error);
  if (status == RECTO_OK)
    status = check_views(&scene->scene, &checked, &drawing, &found, error);
  if (status == RECTO_OK) {
    fill_verdict(&own, &found);
    (void)sized_copy_out(verdict, size, &own, sizeof own);
  }
  judge_drawing_fini(&drawing);
  poll_close(&poll);
  return status;
}
