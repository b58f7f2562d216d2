/* multiview_labels.c - chooses and formats the words of a sheet. */
#include "api/multiview_labels.h"

#include <stdio.h>
#include <string.h>

#include "api/captions.h"
#include "drawing/text.h"

static double width_of(const char *text, double height_mm) {
  const struct text_line line = {text, height_mm};
  return text_width_mm(&line);
}

/* Adds a scale in parentheses. */
static void add_scale(char label[MULTIVIEW_LABEL_SIZE], double scale) {
  char text[CAPTIONS_SCALE_SIZE];
  size_t length = strlen(label);
  captions_write_scale(text, scale);
  (void)snprintf(label + length, MULTIVIEW_LABEL_SIZE - length, " (%s)", text);
}

bool multiview_labels_of_views(struct multiview *views) {
  bool grows = false;
  for (size_t i = 0; views->name_mm > 0 && i < views->count; i++) {
    struct multiview_view *view = &views->view[i];
    (void)snprintf(view->label, sizeof view->label, "%s", view->name);
    for (char *at = view->label; *at != '\0'; at++)
      if (*at >= 'a' && *at <= 'z')
        *at = (char)(*at - 'a' + 'A');
    if (views->with_scales && view->scale != views->scale)
      add_scale(view->label, view->scale / views->unit_mm);
    double width_mm = width_of(view->label, views->name_mm);
    if (width_mm > view->label_mm) {
      view->label_mm = width_mm;
      grows = true;
    }
  }
  return grows;
}

const char *multiview_labels_letter(const struct multiview_detail *detail) {
  return detail->name + strlen("detail-");
}

void multiview_labels_of_detail(const struct multiview *views,
                                struct multiview_detail *detail) {
  (void)snprintf(detail->label, sizeof detail->label, "%s",
                 multiview_labels_letter(detail));
  if (views->with_scales)
    add_scale(detail->label, detail->scale / views->unit_mm);
  detail->label_mm = width_of(detail->label, views->letter_mm);
}
