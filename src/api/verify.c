/* verify.c - has the judge check a drawing that was just made.
 *
 * Phases
 *   scene    converts the scene for the judge: judge_input.h.
 *   strokes  collects the drawing's lines, and those that were too short: the
 *            judge must not miss these.  Where the output is coarse, it also
 *            draws the scene again more finely, to find lines that were longer
 *            before.
 *   verdict  makes a report, a summary or an error of the judge's verdict. */
#include "api/verify.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "api/judge_input.h"
#include "base/sentence.h"
#include "base/tolerance.h"
#include "ink/ink.h"

/* ---- The strokes --------------------------------------------------------- */

static bool add_judged_stroke(struct judge_drawing *to,
                              const struct drawing_stroke *stroke,
                              const struct drawing_point *point,
                              enum judge_role role) {
  struct judge_stroke taken = {(uint32_t)to->point.count,
                               stroke->count + stroke->closed, role};
  if (!ARRAY_RESERVE(&to->point, taken.count) ||
      !ARRAY_PUSH(&to->stroke, taken))
    return false;
  for (uint32_t i = 0; i < taken.count; i++) {
    const struct drawing_point *p = &point[i < stroke->count ? i : 0];
    to->point.item[to->point.count++] = (struct judge_point2){p->x, p->y};
  }
  return true;
}

/* Collects the lines of edges, but no hatching, and the gaps that were closed.
 */
static bool add_drawn(struct judge_drawing *to, const struct drawing *drawing) {
  for (size_t i = 0; i < drawing->gap_end.count; i += 2) {
    struct drawing_stroke gap = {.count = 2};
    if (!add_judged_stroke(to, &gap, drawing->gap_end.item + i, JUDGE_ADDED))
      return false;
  }
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    if (stroke->edge_class != 0 &&
        !add_judged_stroke(to, stroke, drawing->point.item + stroke->point,
                           stroke->hidden ? JUDGE_HIDDEN : JUDGE_INK))
      return false;
  }
  return true;
}

/* Where the output's unit is larger than FINE_UNIT_MM, lines of less than so
 * many units may collapse to a point. */
#define FINE_UNIT_MM 0.01
#define COLLAPSED_UNITS 4

/* Collects the lines of a drawing that are not drawn or that are shorter than
 * half a pen and a length more.
 * more  mm; hidden lines are drawn as well, since lines end where these begin
 */
static bool add_short(struct judge_drawing *to, const struct drawing *drawing,
                      double more) {
  for (size_t i = 0; i < drawing->dropped.count; i++) {
    const struct drawing_stroke *stroke = &drawing->dropped.item[i];
    if (!add_judged_stroke(to, stroke,
                           drawing->dropped_point.item + stroke->point,
                           JUDGE_DROPPED))
      return false;
  }
  for (size_t i = 0; more > 0 && i < drawing->stroke.count; i++) {
    const struct drawing_stroke *stroke = &drawing->stroke.item[i];
    double half_pen = drawing->layer.item[stroke->layer].width_mm / 2;
    if (!stroke->hidden &&
        drawing_stroke_mm(drawing, stroke) < half_pen + more &&
        !add_judged_stroke(to, stroke, drawing->point.item + stroke->point,
                           JUDGE_DROPPED))
      return false;
  }
  return true;
}

/* Collects the lines that were not drawn because they are too short.  Where the
 * output's unit is large they may have been long before: rounding makes near
 * lines one, and divides a line of which a part is near another. */
static recto_status add_dropped(struct judge_drawing *to,
                                const struct verify *verify,
                                recto_error *error) {
  recto_options fine = *verify->options;
  double unit = fine.output.unit_mm;
  recto_status status =
      add_short(to, verify->drawing, 0) ? RECTO_OK : error_memory(error);
  if (status != RECTO_OK || unit <= FINE_UNIT_MM)
    return status;
  fine.output.unit_mm = FINE_UNIT_MM;
  fine.ink.ids = false;
  fine.ink.fill = RECTO_FILL_NONE;
  fine.ink.order = RECTO_ORDER_NONE;
  fine.ink.dash_count = 0;
  struct drawing drawing;
  drawing_init(&drawing);
  status = ink_draw(&drawing, verify->sheet, verify->scene, verify->map, &fine,
                    error);
  if (status == RECTO_OK && !add_short(to, &drawing, COLLAPSED_UNITS * unit))
    status = error_memory(error);
  drawing_fini(&drawing);
  return status;
}

/* ---- The verdict --------------------------------------------------------- */

static void say_edge(struct sentence *words, const struct verify *verify,
                     const struct judge_witness *w, struct scene_point origin) {
  sentence_add(words, "point %.9g,%.9g,%.9g of ",
               ldexp(w->position.x + origin.x, verify->exponent),
               ldexp(w->position.y + origin.y, verify->exponent),
               ldexp(w->position.z + origin.z, verify->exponent));
  if (w->point[0] == SCENE_NONE)
    sentence_add(words, "the intersection");
  else
    sentence_add(words, "the edge from %lu to %lu", (unsigned long)w->point[0],
                 (unsigned long)w->point[1]);
  if (w->face[0] != SCENE_NONE)
    sentence_add(words, " of face %lu", (unsigned long)w->face[0]);
  if (w->face[1] != SCENE_NONE)
    sentence_add(words, " and %lu", (unsigned long)w->face[1]);
}

static recto_status verdict_error(const struct verify *verify,
                                  const struct judge_verdict *verdict,
                                  struct scene_point origin,
                                  recto_error *error) {
  bool is_false = verdict->false_ink.samples > 0;
  const struct judge_witness *w =
      is_false ? &verdict->false_at : &verdict->missing_at;
  struct sentence words = {.length = 0};
  if (is_false && !w->on_edge)
    sentence_add(&words, "there is a line and no edge");
  else if (is_false)
    sentence_add(&words, "a line is drawn and ");
  else
    sentence_add(&words, "no line is drawn and ");
  if (w->on_edge)
    say_edge(&words, verify, w, origin);
  if (w->on_edge && is_false && w->is_absent)
    sentence_add(&words, " of two planes of the cut is outside of the model");
  else if (w->on_edge && is_false)
    sentence_add(&words,
                 w->blocker == SCENE_NONE ? " is hidden by a cut face"
                                          : " is hidden by face %lu",
                 (unsigned long)w->blocker);
  else if (w->on_edge)
    sentence_add(&words, " is visible");
  return error_set(error, RECTO_ERROR_VERIFY, NULL, 0,
                   "the drawing is wrong: at %.4f,%.4f mm %s", w->at.x, w->at.y,
                   words.text);
}

static void report_verdict(struct report *report,
                           const struct judge_verdict *v) {
  report_count(report, "verify", "drawn", v->drawn.samples);
  report_count(report, "verify", "drawn_wrong", v->false_ink.samples);
  report_count(report, "verify", "drawn_undecided", v->undecided_ink.samples);
  report_count(report, "verify", "not_drawn_hidden", v->hidden.samples);
  report_count(report, "verify", "not_drawn_wrong", v->missing.samples);
  report_count(report, "verify", "not_drawn_undecided", v->undecided.samples);
}

static recto_status judge_own_drawing(const struct verify *verify,
                                      const struct judge_input *input,
                                      const struct judge_drawing *drawing,
                                      struct judge_verdict *verdict,
                                      recto_error *error) {
  const recto_options *o = verify->options;
  struct judge_camera camera = judge_input_camera(input, verify->camera, o);
  struct judge_options options = judge_input_options(input, verify->camera, o);
  camera.depth_contact = TOLERANCE_CONTACT_GRID_UNITS / verify->sheet->z_scale;
  const struct topology *topology = verify->sheet->topology;
  if (topology != NULL && topology->crease_mark != NULL)
    judge_input_allow_marks(&options, o);
  options.samples = (size_t)o->verify;
  options.ink_distance_mm += ink_deviation_mm(o);
  options.lateral_mm += ink_deviation_mm(o);
  options.moved_mm = o->ink.simplify_mm + o->ink.curves_mm;
  return judge_drawing(verdict, drawing, &input->scene, &camera, &options)
             ? RECTO_OK
             : error_memory(error);
}

void verify_summarise(char summary[VERIFY_SUMMARY_SIZE],
                      const struct verify_counts *counts) {
  snprintf(summary, VERIFY_SUMMARY_SIZE,
           "verified: %zu drawn points visible, %zu others hidden, %zu too "
           "close to call",
           counts->visible, counts->hidden, counts->undecided);
}

recto_status verify_drawing(const struct verify *verify, struct report *report,
                            struct verify_counts *counts, recto_error *error) {
  struct judge_drawing drawing = {0};
  struct judge_verdict verdict;
  struct judge_input input;
  const struct preparation *prepared = verify->prepared;
  if (!judge_input_init(&input, prepared != NULL ? &prepared->welded.scene
                                                 : verify->scene))
    return error_memory(error);
  if (prepared != NULL)
    judge_input_cut(&input, prepared);
  recto_status status = add_drawn(&drawing, verify->drawing)
                            ? add_dropped(&drawing, verify, error)
                            : error_memory(error);
  if (status == RECTO_OK)
    status = judge_own_drawing(verify, &input, &drawing, &verdict, error);
  judge_drawing_fini(&drawing);
  judge_input_fini(&input);
  if (status != RECTO_OK)
    return status;
  report_verdict(report, &verdict);
  if (verdict.false_ink.samples > 0 || verdict.missing.samples > 0)
    return verdict_error(verify, &verdict, input.origin, error);
  *counts = (struct verify_counts){
      verdict.drawn.samples - verdict.undecided_ink.samples,
      verdict.hidden.samples,
      verdict.undecided_ink.samples + verdict.undecided.samples};
  return RECTO_OK;
}
