/* sheet_text.c - the title of a sheet, and the names of its views and
 * details. */
#include "api/sheet_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "api/captions.h"
#include "drawing/circle_clip.h"
#include "drawing/text.h"

double sheet_text_pen_mm(const recto_options *options) {
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
                                .width_mm = sheet_text_pen_mm(options),
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

/* "FRONT", or "ISO (2:1)". */
static void write_name(char text[], size_t size,
                       const struct multiview_view *view, bool with_scale,
                       double unit_mm) {
  char scale[CAPTIONS_SCALE_SIZE];
  captions_write_scale(scale, view->scale / unit_mm);
  (void)snprintf(text, size, "%s", view->name);
  for (char *at = text; *at != '\0'; at++)
    if (*at >= 'a' && *at <= 'z')
      *at = (char)(*at - 'a' + 'A');
  size_t length = strlen(text);
  if (with_scale)
    (void)snprintf(text + length, size - length, " (%s)", scale);
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

/* The circles of a detail, its letter beside the first, and below the second
 * also its scale. */
static bool add_detail(struct drawing *drawing, const struct multiview *views,
                       const struct multiview_detail *detail, bool with_scale,
                       double unit_mm) {
  const recto_detail *asked = detail->asked;
  const struct drawing_circle mark = {asked->x_mm, asked->y_mm,
                                      asked->radius_mm};
  const struct drawing_circle large = {detail->centre_mm[0],
                                       detail->centre_mm[1], detail->radius_mm};
  const char *letter = detail->name + strlen("detail-");
  char text[CAPTIONS_SCALE_SIZE + 8], scale[CAPTIONS_SCALE_SIZE];
  captions_write_scale(scale, detail->scale / unit_mm);
  if (with_scale)
    (void)snprintf(text, sizeof text, "%s (%s)", letter, scale);
  else
    (void)snprintf(text, sizeof text, "%s", letter);
  const struct text_line beside = {letter, views->letter_mm};
  const struct text_line below = {text, views->letter_mm};
  double corner = mark.radius * sqrt(0.5);
  const struct drawing_point at = {mark.x + corner, mark.y + corner};
  return add_circle(drawing, &mark) && add_circle(drawing, &large) &&
         text_add(drawing, (uint32_t)drawing->layer.count - 1, &beside, at) &&
         add_centred(drawing, &below, large.x,
                     large.y - large.radius - 2 * views->letter_mm);
}

/* -------------------------------------------------------------------------- */

bool sheet_text_add(struct drawing *drawing, const struct multiview *views,
                    const recto_options *options, double unit_mm) {
  bool ok = true;
  size_t first = drawing->stroke.count;
  bool is_true = options->camera.fit != RECTO_FIT_PAGE;
  if (views->title_mm > 0 || views->name_mm > 0 || views->details > 0)
    ok = add_text_layer(drawing, options);
  for (size_t i = 0; ok && views->name_mm > 0 && i < views->count; i++) {
    const struct multiview_view *view = &views->view[i];
    char text[128];
    write_name(text, sizeof text, view, is_true && view->scale != views->scale,
               unit_mm);
    const struct text_line line = {text, views->name_mm};
    ok = add_centred(drawing, &line, (view->low_mm[0] + view->high_mm[0]) / 2,
                     view->low_mm[1] - 2 * views->name_mm);
  }
  for (size_t i = 0; ok && i < views->details; i++)
    ok = add_detail(drawing, views, &views->detail[i], is_true, unit_mm);
  if (ok && views->title_mm > 0) {
    const struct text_line line = {views->title, views->title_mm};
    ok = add_centred(drawing, &line, views->page_mm[0] / 2,
                     views->margin_mm + 0.4 * views->title_mm);
  }
  drawing->counts.pen_lifts += drawing->stroke.count - first;
  return ok;
}
