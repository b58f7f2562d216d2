/* multiview.c - the options of sheets, on which several views are. */
#include "cli/multiview.h"

#include <stdio.h>
#include <string.h>

#include "cli/value.h"

/* ---- Values -------------------------------------------------------------- */

bool multiview_parse(struct arguments *arguments, const char *text) {
  recto_arrangement *how = &arguments->options.sheet.arrangement;
  *how = strcmp(text, "first") == 0   ? RECTO_ARRANGEMENT_FIRST
         : strcmp(text, "third") == 0 ? RECTO_ARRANGEMENT_THIRD
                                      : RECTO_ARRANGEMENT_NONE;
  return *how != RECTO_ARRANGEMENT_NONE;
}

/* The name of a direction with these `length` letters; NULL: there is none. */
static const char *find_view(const char *text, size_t length) {
  const char *name;
  for (size_t i = 0; (name = recto_view_name(i, NULL, NULL)) != NULL; i++)
    if (strlen(name) == length && memcmp(name, text, length) == 0)
      return name;
  return NULL;
}

/* NAME or NAME:SCALE, up to a comma. */
static bool parse_sheet_view(recto_sheet_view *view, const char *text,
                             size_t length) {
  char scale[64];
  size_t name = strcspn(text, ":,");
  *view = (recto_sheet_view){.name = find_view(text, name)};
  if (view->name == NULL || name == length)
    return view->name != NULL;
  size_t rest = length - name - 1;
  if (rest >= sizeof scale)
    return false;
  memcpy(scale, text + name + 1, rest);
  scale[rest] = '\0';
  return value_scale(scale, &view->scale);
}

bool multiview_parse_views(struct arguments *arguments, const char *text) {
  recto_sheet_options *sheet = &arguments->options.sheet;
  sheet->view = arguments->sheet_view;
  sheet->view_count = 0;
  for (bool more = true; more;) {
    size_t length = strcspn(text, ",");
    if (sheet->view_count == SHEET_VIEWS_MAX ||
        !parse_sheet_view(&arguments->sheet_view[sheet->view_count], text,
                          length))
      return false;
    sheet->view_count++;
    more = text[length] == ',';
    text += length + 1;
  }
  return true;
}

/* The item of a list at *text, up to a comma; then *text is behind that. */
static bool next_item(const char **text, char item[64]) {
  size_t length = strcspn(*text, ",");
  if (length >= 64)
    return false;
  memcpy(item, *text, length);
  item[length] = '\0';
  *text += length + ((*text)[length] == ',');
  return true;
}

bool multiview_parse_detail(struct arguments *arguments, const char *text) {
  recto_sheet_options *sheet = &arguments->options.sheet;
  recto_detail detail = {.x_mm = 0};
  double *const length[] = {&detail.x_mm, &detail.y_mm, &detail.radius_mm};
  char item[64];
  for (int i = 0; i < 3; i++)
    if (!next_item(&text, item) || !value_length(item, length[i]))
      return false;
  if (!value_scale(text, &detail.scale) ||
      !(detail.radius_mm >= RECTO_FINEST_MM))
    return false;
  if (sheet->detail_count < RECTO_DETAIL_MAX)
    arguments->detail[sheet->detail_count] = detail;
  sheet->detail_count++; /* multiview_settle refuses too many */
  sheet->detail = arguments->detail;
  return true;
}

recto_status multiview_set_hidden(struct arguments *arguments, const char *name,
                                  const char *value) {
  struct view_hidden hidden = {.view = find_view(name, strlen(name))};
  int how;
  if (hidden.view == NULL || !value_word(value, "none dashed layer", &how) ||
      arguments->view_hidden_count == VIEWS_MAX)
    return RECTO_ERROR_ARGUMENT;
  hidden.hidden = (recto_hidden)how;
  arguments->view_hidden[arguments->view_hidden_count++] = hidden;
  return RECTO_OK;
}

/* ---- Rules for several options ------------------------------------------- */

/* The views where only their arrangement was given. */
static void take_usual_views(struct arguments *a) {
  recto_sheet_options *sheet = &a->options.sheet;
  const char *const side =
      sheet->arrangement == RECTO_ARRANGEMENT_THIRD ? "right" : "left";
  const char *const usual[] = {"front", "top", side};
  for (size_t i = 0; i < 3; i++)
    a->sheet_view[i] = (recto_sheet_view){.name = usual[i]};
  sheet->view = a->sheet_view;
  sheet->view_count = 3;
}

static bool settle_hidden(struct arguments *a, char message[MESSAGE_SIZE]) {
  for (int i = 0; i < a->view_hidden_count; i++) {
    const struct view_hidden *hidden = &a->view_hidden[i];
    bool found = false;
    for (size_t k = 0; k < a->options.sheet.view_count; k++)
      if (a->sheet_view[k].name != NULL &&
          strcmp(a->sheet_view[k].name, hidden->view) == 0) {
        a->sheet_view[k].has_hidden = found = true;
        a->sheet_view[k].hidden = hidden->hidden;
      }
    if (!found) {
      snprintf(message, MESSAGE_SIZE,
               "--hidden-in: the view %s is not on the sheet", hidden->view);
      return false;
    }
  }
  return true;
}

/* The view of a drawing with details, which is a sheet of one. */
static void take_one_view(struct arguments *a) {
  recto_sheet_options *sheet = &a->options.sheet;
  a->sheet_view[0] = (recto_sheet_view){.name = NULL};
  sheet->view = a->sheet_view;
  sheet->view_count = 1;
}

/* Whether options say what is seen from where. */
static bool is_aimed(const struct arguments *a) {
  return a->view_given || a->azimuth_given || a->elevation_given ||
         a->eye_given;
}

bool multiview_settle(struct arguments *a, char message[MESSAGE_SIZE]) {
  recto_sheet_options *sheet = &a->options.sheet;
  const char *wrong = NULL;
  bool is_one = sheet->detail_count > 0 && !arguments_have_sheet(a);
  if (is_one)
    take_one_view(a);
  if (sheet->detail_count > RECTO_DETAIL_MAX) {
    snprintf(message, MESSAGE_SIZE,
             "--detail is given %zu times, and %d are "
             "the most",
             sheet->detail_count, RECTO_DETAIL_MAX);
    return false;
  }
  if (!arguments_have_sheet(a)) {
    if (a->view_hidden_count > 0)
      wrong = "--hidden-in is for --sheet and --views";
    else if (a->options.sheet.names)
      wrong = "--view-names is for --sheet and --views";
  } else if (is_one && (a->eye_given || a->view_count > 1)) {
    wrong = "--detail takes one --view, without --camera";
  } else if (!is_one && is_aimed(a)) {
    wrong = "--sheet and --views say what is seen from where: leave out "
            "--view, --azimuth, --elevation and --camera";
  } else if (a->turntable > 0) {
    wrong = "--turntable is for drawings without --sheet, --views and "
            "--detail";
  } else if (a->fov_given) {
    wrong = "the views of --sheet, --views and --detail are parallel "
            "projections: leave out --fov";
  } else if (a->options.camera.fit == RECTO_FIT_NONE) {
    wrong = "the views of --sheet, --views and --detail fit the page or have "
            "a --scale: leave out --no-fit";
  }
  if (wrong != NULL) {
    snprintf(message, MESSAGE_SIZE, "%s", wrong);
    return false;
  }
  if (!arguments_have_sheet(a))
    return true;
  if (sheet->arrangement == RECTO_ARRANGEMENT_NONE)
    sheet->arrangement = RECTO_ARRANGEMENT_FIRST;
  if (sheet->view_count == 0 && a->view_hidden_count > 0)
    take_usual_views(a);
  return settle_hidden(a, message);
}
