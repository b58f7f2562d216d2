/* captions.c - the title and the description of a drawing. */
#include "api/captions.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/sentence.h"
#include "base/tolerance.h"

/* The name of a file without its folder and extension. */
static char *title_of(const char *path) {
  const char *slash = strrchr(path, '/');
  char *title = mem_copy_text(slash != NULL ? slash + 1 : path);
  if (title == NULL)
    return NULL;
  char *point = strrchr(title, '.');
  if (point != NULL && strcmp(point, ".gz") == 0) {
    *point = '\0';
    point = strrchr(title, '.');
  }
  if (point != NULL && point != title)
    *point = '\0';
  return title;
}

/* Adds numbers with at most three decimals. */
static void add_numbers(struct sentence *words, const double *number,
                        int count) {
  for (int i = 0; i < count; i++) {
    char text[NUMBER_TEXT_SIZE];
    size_t length = fabs(number[i]) < 1e6
                        ? number_format(text, number[i], 3)
                        : number_format_exact(text, number[i]);
    sentence_add(words, "%s%.*s", i > 0 ? "," : "", (int)length, text);
  }
}

static void say_contents(struct sentence *words, const recto_options *o,
                         bool has_hidden) {
  static const char *const fill[] = {"", "painted faces", "shaded faces",
                                     "hatched faces"};
  bool lines = o->ink.edges != RECTO_EDGES_NONE;
  bool hidden = lines && has_hidden;
  bool faces = o->ink.fill != RECTO_FILL_NONE;
  if (lines)
    sentence_add(words, "visible %slines", hidden ? "and hidden " : "");
  sentence_add(words, "%s%s", lines && faces ? " and " : "", fill[o->ink.fill]);
  if (words->length > 0 && words->text[0] >= 'a' && words->text[0] <= 'z')
    words->text[0] = (char)(words->text[0] - 'a' + 'A');
}

/* "Visible lines and shaded faces, seen from azimuth 45, elevation 35.264
 * degrees." */
static void describe_view(struct sentence *words, const recto_options *o) {
  say_contents(words, o, o->ink.hidden != RECTO_HIDDEN_NONE);
  if (words->length == 0)
    sentence_add(words, "Nothing");
  if (o->camera.kind == RECTO_CAMERA_EYE) {
    sentence_add(words, ", seen from ");
    add_numbers(words, o->camera.eye, 3);
  } else {
    sentence_add(words, ", seen from azimuth ");
    add_numbers(words, &o->camera.azimuth_deg, 1);
    sentence_add(words, ", elevation ");
    add_numbers(words, &o->camera.elevation_deg, 1);
    sentence_add(words, " degrees");
  }
  sentence_add(words, "%s.", o->camera.fov_deg > 0 ? ", in perspective" : "");
}

/* A number as it is written: with three decimals, or all where it is large. */
static double round_to_text(double number) {
  return number < 1e6 ? nearbyint(number * 1000) / 1000 : number;
}

/* Whether the text of a number is all of it, but for rounding. */
static bool is_exact(double number) {
  double off = fabs(round_to_text(number) - number);
  return off <= number * TOLERANCE_EXTENT_SHARE;
}

/* By which number below 100 a ratio that is no decimal fraction becomes one of
 * whole numbers: 4:3.  1: it is one, or there is none. */
static int find_denominator(double side) {
  for (int i = 1; i < 100; i++)
    if (is_exact(side * i) &&
        (i == 1 || nearbyint(side * i) == round_to_text(side * i)))
      return i;
  return 1;
}

void captions_write_scale(char text[CAPTIONS_SCALE_SIZE], double scale) {
  char number[NUMBER_TEXT_SIZE];
  bool is_less = scale < 1;
  double side = fmin(is_less ? 1 / scale : scale, DBL_MAX);
  int other = find_denominator(side), length;
  double written = round_to_text(side * other);
  if (written < 1e6)
    length = (int)number_format(number, written, 3);
  else if (written < 1e15)
    length = (int)number_format_exact(number, written);
  else /* too many digits: 2e+99; there is no decimal point */
    length = snprintf(number, sizeof number, "%.0e", written);
  if (is_less)
    (void)snprintf(text, CAPTIONS_SCALE_SIZE, "%d:%.*s", other, length, number);
  else
    (void)snprintf(text, CAPTIONS_SCALE_SIZE, "%.*s:%d", length, number, other);
}

/* "Visible lines: front, top and left in first-angle projection, 1:2."  One
 * view by the camera is described as without a sheet. */
static void describe_sheet(struct sentence *words, const recto_options *o,
                           const struct multiview *views) {
  if (views->count == 1 && views->view[0].request->name == NULL) {
    describe_view(words, o);
    return;
  }
  say_contents(words, o, multiview_has_hidden(views, o));
  if (words->length == 0)
    sentence_add(words, "Nothing");
  for (size_t i = 0; i < views->count; i++)
    sentence_add(words, "%s%s",
                 i == 0                  ? ": "
                 : i + 1 == views->count ? " and "
                                         : ", ",
                 views->view[i].name);
  sentence_add(words, " in %s-angle projection",
               o->sheet.arrangement == RECTO_ARRANGEMENT_FIRST ? "first"
                                                               : "third");
  if (o->camera.fit != RECTO_FIT_PAGE) {
    char scale[CAPTIONS_SCALE_SIZE];
    captions_write_scale(scale, views->scale / views->unit_mm);
    sentence_add(words, ", %s", scale);
  }
  sentence_add(words, ".");
}

static bool store_captions(struct drawing *drawing, const char *path,
                           const struct sentence *words) {
  drawing->description = mem_copy_text(words->text);
  if (drawing->description == NULL || path == NULL || strcmp(path, "-") == 0)
    return drawing->description != NULL;
  drawing->title = title_of(path);
  return drawing->title != NULL;
}

bool captions_set(struct drawing *drawing, const char *path,
                  const recto_options *options) {
  struct sentence words = {.length = 0};
  describe_view(&words, options);
  return store_captions(drawing, path, &words);
}

bool captions_set_sheet(struct drawing *drawing, const recto_scene *scene,
                        const recto_options *options,
                        const struct multiview *views) {
  struct sentence words = {.length = 0};
  describe_sheet(&words, options, views);
  return store_captions(drawing, scene->path, &words);
}
