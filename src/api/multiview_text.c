/* multiview_text.c - the title of a sheet, and the names of its views and
 * details. */
#include "api/multiview_text.h"

#include <math.h>

#include "api/letter_places.h"
#include "api/multiview_labels.h"
#include "drawing/text.h"

double multiview_text_pen_mm(const recto_options *options) {
  double own = options->ink.pen_count > 0 ? options->ink.pen[0].width_mm : 0;
  return own > 0 ? own : options->ink.pen_mm;
}

/* The layer of text, which pen 1 draws. */
static bool add_text_layer(struct drawing *drawing,
                           const recto_options *options) {
  const recto_pen usual = {.width_mm = 0};
  const recto_pen *pen = options->ink.pen_count > 0 ? options->ink.pen : &usual;
  struct drawing_layer layer = {.pen = 1,
                                .label = "1 text",
                                .colour =
                                    pen->has_colour ? pen->colour : 0x000000,
                                .width_mm = multiview_text_pen_mm(options),
                                .view = "text"};
  return ARRAY_PUSH(&drawing->layer, layer);
}

/* Adds a line about an x of the page. */
static bool add_centred(struct drawing *drawing, const struct text_line *line,
                        double middle_mm, double baseline_mm) {
  const struct drawing_point at = {middle_mm - text_width_mm(line) / 2,
                                   baseline_mm};
  return text_add(drawing, (uint32_t)drawing->layer.count - 1, line, at);
}

/* ---- Details ------------------------------------------------------------- */

static bool add_circle(struct drawing *drawing,
                       const struct drawing_circle *circle) {
  struct drawing_stroke stroke = {.point = (uint32_t)drawing->point.count,
                                  .layer = (uint32_t)drawing->layer.count - 1,
                                  .face = DRAWING_NONE,
                                  .edge = DRAWING_NONE,
                                  .group = DRAWING_NONE,
                                  .closed = true,
                                  .text = true};
  if (!drawing_add_arc(drawing, circle, 0, 2 * acos(-1.0)))
    return false;
  drawing->point.count--; /* the first one again */
  stroke.count = (uint32_t)drawing->point.count - stroke.point;
  return ARRAY_PUSH(&drawing->stroke, stroke);
}

/* The circles of a detail, and its label below the second. */
static bool add_detail(struct drawing *drawing, const struct multiview *views,
                       const struct multiview_detail *detail) {
  const recto_detail *request = detail->request;
  const struct drawing_circle mark = {request->x_mm, request->y_mm,
                                      request->radius_mm};
  const struct drawing_circle large = {detail->centre_mm[0],
                                       detail->centre_mm[1], detail->radius_mm};
  const struct text_line below = {detail->label, views->letter_mm};
  return add_circle(drawing, &mark) && add_circle(drawing, &large) &&
         add_centred(drawing, &below, large.x,
                     large.y - large.radius - 2 * views->letter_mm);
}

static bool add_leader(struct drawing *drawing,
                       const struct drawing_point leader[2]) {
  const struct drawing_stroke stroke = {.point = (uint32_t)drawing->point.count,
                                        .count = 2,
                                        .layer =
                                            (uint32_t)drawing->layer.count - 1,
                                        .face = DRAWING_NONE,
                                        .edge = DRAWING_NONE,
                                        .group = DRAWING_NONE,
                                        .text = true};
  return ARRAY_PUSH(&drawing->point, leader[0]) &&
         ARRAY_PUSH(&drawing->point, leader[1]) &&
         ARRAY_PUSH(&drawing->stroke, stroke);
}

/* The letter beside what a detail shows, once all else is drawn. */
static bool add_letter(struct drawing *drawing, const struct multiview *views,
                       size_t detail) {
  struct letter_place place;
  const struct text_line line = {
      multiview_labels_letter(&views->detail[detail]), views->letter_mm};
  return letter_places_find(&place, drawing, views, detail) &&
         (!place.has_leader || add_leader(drawing, place.leader)) &&
         add_centred(drawing, &line, place.middle.x,
                     place.middle.y - views->letter_mm / 2);
}

/* -------------------------------------------------------------------------- */

bool multiview_text_add(struct drawing *drawing, const struct multiview *views,
                        const recto_options *options) {
  bool ok = true;
  size_t first = drawing->stroke.count;
  if (views->title_mm > 0 || views->name_mm > 0 || views->details > 0)
    ok = add_text_layer(drawing, options);
  for (size_t i = 0; ok && views->name_mm > 0 && i < views->count; i++) {
    const struct multiview_view *view = &views->view[i];
    const struct text_line line = {view->label, views->name_mm};
    ok = add_centred(drawing, &line, (view->low_mm[0] + view->high_mm[0]) / 2,
                     view->low_mm[1] - 2 * views->name_mm);
  }
  for (size_t i = 0; ok && i < views->details; i++)
    ok = add_detail(drawing, views, &views->detail[i]);
  if (ok && views->title_mm > 0) {
    const struct text_line line = {views->title, views->title_mm};
    ok = add_centred(drawing, &line, views->page_mm[0] / 2,
                     views->margin_mm + 0.4 * views->title_mm);
  }
  for (size_t i = 0; ok && i < views->details; i++)
    ok = add_letter(drawing, views, i);
  drawing->counts.pen_lifts += drawing->stroke.count - first;
  return ok;
}
