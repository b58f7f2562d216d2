/* sheet_text.c - the title of a sheet, and the names of its views. */
#include "api/sheet_text.h"

#include <stdio.h>
#include <string.h>

#include "api/captions.h"
#include "drawing/text.h"

/* The layer of text, which pen 1 draws. */
static bool add_text_layer(struct drawing *drawing,
                           const recto_options *options) {
  const recto_pen usual = {.width_mm = 0};
  const recto_pen *pen = options->ink.pen_count > 0 ? options->ink.pen : &usual;
  struct drawing_layer layer = {
      .pen = 1,
      .label = "1 text",
      .colour = pen->has_colour ? pen->colour : 0x000000,
      .width_mm = pen->width_mm > 0 ? pen->width_mm : options->ink.pen_mm,
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

bool sheet_text_add(struct drawing *drawing, const struct multiview *views,
                    const recto_options *options, double unit_mm) {
  bool ok = true;
  size_t first = drawing->stroke.count;
  if (views->title_mm > 0 || views->name_mm > 0)
    ok = add_text_layer(drawing, options);
  for (size_t i = 0; ok && views->name_mm > 0 && i < views->count; i++) {
    const struct multiview_view *view = &views->view[i];
    char text[128];
    write_name(text, sizeof text, view,
               options->camera.fit != RECTO_FIT_PAGE &&
                   view->scale != views->scale,
               unit_mm);
    const struct text_line line = {text, views->name_mm};
    ok = add_centred(drawing, &line, (view->low_mm[0] + view->high_mm[0]) / 2,
                     view->low_mm[1] - 2 * views->name_mm);
  }
  if (ok && views->title_mm > 0) {
    const struct text_line line = {views->title, views->title_mm};
    ok = add_centred(drawing, &line, views->page_mm[0] / 2,
                     views->margin_mm + 0.4 * views->title_mm);
  }
  drawing->counts.pen_lifts += drawing->stroke.count - first;
  return ok;
}
