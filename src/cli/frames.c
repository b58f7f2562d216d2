/* frames.c - the directions and the paths of several drawings in one run. */
#include "cli/frames.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

int frames_count(const struct arguments *a) {
  if (a->turntable > 0)
    return a->turntable;
  return a->view_count > 1 ? a->view_count : 1;
}

int frames_first(const struct arguments *a) {
  return a->turntable > 0 ? a->first_frame : 0;
}

int frames_past(const struct arguments *a) {
  bool some = a->turntable > 0 && a->past_frame > 0;
  return some ? a->past_frame : frames_count(a);
}

/* The frames of a turntable are cropped alike, to the square about the sphere
 * that fills the page, with room for the widest lines. */
static void crop_to_sphere(recto_options *options) {
  recto_page_options *page = &options->page;
  double side = fmin(page->width_mm, page->height_mm);
  double margin = page->margin_mm >= 0 ? page->margin_mm
                                       : fmin(RECTO_USUAL_MARGIN_MM, side / 4);
  double pen = options->ink.pen_mm, weight = 2; /* of silhouettes */
  for (size_t i = 0; i < options->ink.pen_count; i++)
    pen = fmax(pen, options->ink.pen[i].width_mm);
  for (size_t i = 0; i < options->ink.weight_count; i++)
    weight = fmax(weight, options->ink.weight[i].weight);
  if (!(side > 2 * margin))
    return;
  page->margin_mm = pen * weight / 2;
  page->width_mm = page->height_mm = side - 2 * margin + pen * weight;
  options->output.tight = false;
}

void frame_options(const struct arguments *a, int frame,
                   recto_options *options) {
  *options = a->options;
  if (a->turntable > 0) {
    options->camera.azimuth_deg += 360.0 * frame / a->turntable;
    if (options->camera.fit == RECTO_FIT_PAGE)
      options->camera.fit = RECTO_FIT_SPHERE;
    if (options->output.tight && options->camera.fit == RECTO_FIT_SPHERE)
      crop_to_sphere(options);
  } else if (a->view_count > 1) {
    options->camera.azimuth_deg = a->view[frame].azimuth_deg;
    options->camera.elevation_deg = a->view[frame].elevation_deg;
  }
}

/* ---- Patterns ------------------------------------------------------------ */

/* A conversion of a pattern. */
struct conversion {
  char letter; /* d, s or %; 0: it is none */
  bool zeros;
  int width;
  size_t length; /* of its text, from the % on */
};

static struct conversion read_conversion(const char *text) {
  struct conversion c = {.length = 1};
  if (text[c.length] == '0') {
    c.zeros = true;
    c.length++;
  }
  while (text[c.length] >= '0' && text[c.length] <= '9' && c.width < 10)
    c.width = 10 * c.width + (text[c.length++] - '0');
  char letter = text[c.length++];
  if (letter == 'd' || (c.length == 2 && (letter == 's' || letter == '%')))
    c.letter = letter;
  return c;
}

/* Whether the path of a drawing is made of a pattern: that of the only drawing
 * may be one. */
static bool is_pattern(const struct arguments *a) {
  return frames_count(a) > 1 || a->turntable > 0;
}

const char *frame_path(const struct arguments *a, const char *pattern,
                       int frame, char path[FRAME_PATH_SIZE]) {
  if (!is_pattern(a))
    return pattern;
  size_t at = 0;
  while (*pattern != '\0') {
    struct conversion c = {.length = 1};
    if (*pattern == '%')
      c = read_conversion(pattern);
    size_t capacity = FRAME_PATH_SIZE - at;
    int length = c.letter == 'd'
                     ? snprintf(path + at, capacity, c.zeros ? "%0*d" : "%*d",
                                c.width, frame)
                 : c.letter == 's'
                     ? snprintf(path + at, capacity, "%s", a->view[frame].name)
                     : snprintf(path + at, capacity, "%c", *pattern);
    if (length < 0 || (size_t)length >= capacity)
      return NULL;
    at += (size_t)length;
    pattern += c.length;
  }
  path[at] = '\0';
  return path;
}

/* Whether two of the views have one name. */
static bool has_view_twice(const struct arguments *a) {
  for (int i = 0; i < a->view_count; i++)
    for (int k = 0; k < i; k++)
      if (strcmp(a->view[i].name, a->view[k].name) == 0)
        return true;
  return false;
}

const char *frame_fault(const struct arguments *a, const char *pattern) {
  bool has_number = false, has_name = false;
  if (!is_pattern(a))
    return NULL;
  for (const char *at = strchr(pattern, '%'); at != NULL;) {
    struct conversion c = read_conversion(at);
    if (c.letter == 0)
      return "has a % that is neither %d, such as %03d, nor %s nor %%";
    has_number = has_number || c.letter == 'd';
    has_name = has_name || c.letter == 's';
    at = strchr(at + c.length, '%');
  }
  if (has_name && a->turntable > 0)
    return "has %s, the name of a view, but --turntable takes %d";
  if (frames_count(a) > 1 && !has_number && (!has_name || has_view_twice(a)))
    return a->turntable > 0 || has_name
               ? "needs %d or %03d, the number of the drawing"
               : "needs %d, the number of the drawing, or %s, its view's name";
  char path[FRAME_PATH_SIZE];
  for (int i = 0; i < frames_count(a); i++)
    if (frame_path(a, pattern, i, path) == NULL)
      return "makes a path that is too long";
  return NULL;
}
