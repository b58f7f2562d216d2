/* paper_tool.c - writes the drawings of drawing_fixture.h, and judges pictures
 * of them, for shell tests.
 *
 *   paper_tool names
 *   paper_tool write NAME FORMAT OUTPUT [device=NAME] [dpi=N] [tight]
 *   paper_tool measure PICTURE.png DPI LIMIT_MM head|foot
 *       Is this the calibration drawing, every line within the limit?  Its
 *       page and the picture, which may be a millimetre off in size, share
 *       the upper or the lower edge.
 *   paper_tool same ONE.png OTHER.png PIXELS
 *       Does all ink of each lie within so many pixels of the other's?
 *   paper_tool coverage PICTURE.png MARGIN
 *       Prints the share of ink in per cent, but for so many pixels around.
 *   paper_tool seams PICTURE.png
 *       Prints how many of a million inked pixels are lighter than both
 *       neighbours in their row or their column.
 *
 * Exits 0 for yes, 1 for no with the reason on standard output, 77 where it
 * was built without cairo and cannot look at pictures. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "backends/writer.h"
#include "base/number.h"
#include "tests/drawing_fixture.h"

#ifdef HAVE_CAIRO
#include <cairo.h>
#endif

enum { YES = 0, NO = 1, CANNOT = 77 };

static int list_names(void) {
  for (size_t i = 0; drawing_fixture_name(i); i++)
    puts(drawing_fixture_name(i));
  return YES;
}

/* ---- Writing ------------------------------------------------------------- */

/* Parses a whole string as a number; false if anything is left over. */
static bool number_from_string(const char *text, double *value) {
  const char *end = text + strlen(text);
  double parsed;
  if (end == text || number_parse_double(text, end, &parsed) != end)
    return false;
  *value = parsed;
  return true;
}

static bool read_options(struct writer_options *options, char **word,
                         int count) {
  *options = (struct writer_options){.precision = 3};
  for (int i = 0; i < count; i++) {
    if (strcmp(word[i], "tight") == 0)
      options->tight = true;
    else if (strncmp(word[i], "device=", 7) == 0)
      options->device = word[i] + 7;
    else if (strncmp(word[i], "dpi=", 4) != 0 ||
             !number_from_string(word[i] + 4, &options->dpi))
      return false;
  }
  return true;
}

static int write_drawing(const char *name, const char *format, const char *path,
                         const struct writer_options *options) {
  const struct writer *writer = writer_by_name(format);
  struct drawing drawing;
  struct stream *stream;
  recto_error error = {.code = RECTO_OK};
  if (writer == NULL)
    return CANNOT;
  if (!drawing_fixture_named(&drawing, name)) {
    printf("no drawing is called %s\n", name);
    return NO;
  }
  recto_status status = stream_open(&stream, path, &error);
  if (status == RECTO_OK) {
    status = writer->write(&drawing, options, stream, &error);
    if (status == RECTO_OK)
      status = stream_finish(stream, &error);
    else
      stream_discard(stream);
  }
  if (status != RECTO_OK)
    printf("%s: %s\n", path, error.text);
  drawing_fini(&drawing);
  return status == RECTO_OK ? YES : NO;
}

#ifdef HAVE_CAIRO

/* ---- Pictures ------------------------------------------------------------ */

struct picture {
  int width, height;
  float *ink; /* rows from the top; 0: white, 1: black */
};

/* Ends the program where there is no such picture. */
static struct picture load(const char *path) {
  cairo_surface_t *file = cairo_image_surface_create_from_png(path);
  if (cairo_surface_status(file) != CAIRO_STATUS_SUCCESS) {
    printf("%s: %s\n", path,
           cairo_status_to_string(cairo_surface_status(file)));
    exit(NO);
  }
  /* Onto white, whatever the file's own kind of pixel. */
  struct picture picture = {cairo_image_surface_get_width(file),
                            cairo_image_surface_get_height(file), NULL};
  cairo_surface_t *paper = cairo_image_surface_create(
      CAIRO_FORMAT_RGB24, picture.width, picture.height);
  cairo_t *cr = cairo_create(paper);
  cairo_set_source_rgb(cr, 1, 1, 1);
  cairo_paint(cr);
  cairo_set_source_surface(cr, file, 0, 0);
  cairo_paint(cr);
  cairo_destroy(cr);
  cairo_surface_destroy(file);
  cairo_surface_flush(paper);
  const unsigned char *row = cairo_image_surface_get_data(paper);
  size_t pixels = (size_t)picture.width * (size_t)picture.height;
  picture.ink = malloc(pixels * sizeof *picture.ink);
  if (row == NULL || picture.ink == NULL)
    abort();
  for (int y = 0; y < picture.height; y++) {
    for (int x = 0; x < picture.width; x++) {
      const unsigned char *p = row + 4 * (size_t)x;
      picture.ink[(size_t)y * (size_t)picture.width + (size_t)x] =
          1 - (float)(p[0] + p[1] + p[2]) / (3 * 255);
    }
    row += cairo_image_surface_get_stride(paper);
  }
  cairo_surface_destroy(paper);
  return picture;
}

static float ink_at(const struct picture *picture, int x, int y) {
  if (x < 0 || y < 0 || x >= picture->width || y >= picture->height)
    return 0;
  return picture->ink[(size_t)y * (size_t)picture->width + (size_t)x];
}

/* ---- Measuring the calibration drawing ----------------------------------- */

/* A line across the picture: a row, or a column from the foot of the page. */
struct probe {
  const struct picture *picture;
  bool column;
  int at, length;
};

static float probe_ink(const struct probe *probe, int i) {
  return probe->column
             ? ink_at(probe->picture, probe->at, probe->length - 1 - i)
             : ink_at(probe->picture, i, probe->at);
}

/* Where along the probe the next line of ink has its middle, in pixels, from
 * *from on, which is moved past it; negative where there is none. */
static double find_line(const struct probe *probe, int *from) {
  double weight = 0, moment = 0;
  int i = *from;
  while (i < probe->length && probe_ink(probe, i) < 0.02f)
    i++;
  for (; i < probe->length && probe_ink(probe, i) >= 0.02f; i++) {
    weight += probe_ink(probe, i);
    moment += probe_ink(probe, i) * (i + 0.5);
  }
  *from = i;
  return weight > 0 ? moment / weight : -1;
}

/* Compares the lines with those expected, every 10 mm to `last` and two of
 * the square's. */
static bool measure(struct probe probe, double mm_per_pixel, double shift_mm,
                    int last_mm, int side_mm, double limit_mm,
                    double *worst_mm) {
  int from = 0;
  for (int mm = 1; mm <= last_mm; mm++) {
    if (mm % 10 != 0 && mm != side_mm && mm != side_mm + 100)
      continue;
    double pixel = find_line(&probe, &from);
    double found = pixel * mm_per_pixel + shift_mm;
    if (pixel < 0 || fabs(found - mm) > limit_mm) {
      printf("%s line at %d mm: found at %.3f\n",
             probe.column ? "horizontal" : "vertical", mm,
             pixel < 0 ? -1 : found);
      return false;
    }
    *worst_mm = fmax(*worst_mm, fabs(found - mm));
  }
  if (find_line(&probe, &from) >= 0) {
    printf("a %s line too many\n", probe.column ? "horizontal" : "vertical");
    return false;
  }
  return true;
}

static int measure_picture(const char *path, double dpi, double limit_mm,
                           bool from_foot) {
  enum { WIDTH_MM = 210, HEIGHT_MM = 297 };
  struct picture picture = load(path);
  double mm = 25.4 / dpi, worst = 0;
  bool size_is_right = fabs(picture.width * mm - WIDTH_MM) < 1 &&
                       fabs(picture.height * mm - HEIGHT_MM) < 1;
  if (!size_is_right)
    printf("%d x %d pixels are not A4\n", picture.width, picture.height);
  /* Neither probe is on a line. */
  struct probe row = {&picture, false, (int)((HEIGHT_MM - 85) / mm),
                      picture.width};
  struct probe column = {&picture, true, (int)(105 / mm), picture.height};
  double shift = from_foot ? 0 : HEIGHT_MM - picture.height * mm;
  bool ok = size_is_right && measure(row, mm, 0, 200, 23, limit_mm, &worst) &&
            measure(column, mm, shift, 280, 33, limit_mm, &worst);
  if (ok)
    printf("52 lines, worst %.4f mm off\n", worst);
  free(picture.ink);
  return ok ? YES : NO;
}

/* ---- Comparing ----------------------------------------------------------- */

/* How many pixels of `one` that are well inked have next to no ink of `other`
 * within `reach` pixels. */
static long count_strangers(const struct picture *one,
                            const struct picture *other, int reach,
                            long *fixture) {
  long strangers = 0;
  *fixture = 0;
  for (int y = 0; y < one->height; y++) {
    for (int x = 0; x < one->width; x++) {
      float found = 0;
      if (ink_at(one, x, y) < 0.6f)
        continue;
      ++*fixture;
      for (int dy = -reach; dy <= reach; dy++)
        for (int dx = -reach; dx <= reach; dx++)
          found = fmaxf(found, ink_at(other, x + dx, y + dy));
      strangers += found < 0.3f;
    }
  }
  return strangers;
}

static int compare(const char *one_path, const char *other_path, int reach) {
  struct picture one = load(one_path), other = load(other_path);
  long one_inked, other_inked;
  long only_one = count_strangers(&one, &other, reach, &one_inked);
  long only_other = count_strangers(&other, &one, reach, &other_inked);
  bool same_size =
      abs(one.width - other.width) <= 1 && abs(one.height - other.height) <= 1;
  printf("%d x %d and %d x %d pixels, %ld and %ld inked, %ld and %ld alone\n",
         one.width, one.height, other.width, other.height, one_inked,
         other_inked, only_one, only_other);
  free(one.ink);
  free(other.ink);
  return same_size && one_inked > 1000 && only_one == 0 && only_other == 0 ? YES
                                                                           : NO;
}

/* ---- Coverage ------------------------------------------------------------ */

static int print_coverage(const char *path, int margin) {
  struct picture picture = load(path);
  double ink = 0;
  long pixels = 0;
  for (int y = margin; y < picture.height - margin; y++)
    for (int x = margin; x < picture.width - margin; x++) {
      ink += (double)ink_at(&picture, x, y);
      pixels++;
    }
  free(picture.ink);
  if (pixels == 0)
    return NO;
  printf("%.4f\n", 100 * ink / (double)pixels);
  return YES;
}

/* ---- Seams --------------------------------------------------------------- */

static int print_seams(const char *path) {
  const double step = 0.008; /* two levels of 255 */
  struct picture picture = load(path);
  long lighter = 0, inked = 0;
  for (int y = 1; y < picture.height - 1; y++)
    for (int x = 1; x < picture.width - 1; x++) {
      double ink = ink_at(&picture, x, y) + step;
      bool in_row =
          ink < ink_at(&picture, x - 1, y) && ink < ink_at(&picture, x + 1, y);
      bool in_column =
          ink < ink_at(&picture, x, y - 1) && ink < ink_at(&picture, x, y + 1);
      inked += ink > 2 * step;
      lighter += ink > 2 * step && (in_row || in_column);
    }
  free(picture.ink);
  if (inked == 0)
    return NO;
  printf("%.0f\n", 1e6 * (double)lighter / (double)inked);
  return YES;
}

#else

static int measure_picture(const char *path, double dpi, double limit_mm,
                           bool from_foot) {
  (void)path, (void)dpi, (void)limit_mm, (void)from_foot;
  return CANNOT;
}

static int compare(const char *one_path, const char *other_path, int reach) {
  (void)one_path, (void)other_path, (void)reach;
  return CANNOT;
}

static int print_coverage(const char *path, int margin) {
  (void)path, (void)margin;
  return CANNOT;
}

static int print_seams(const char *path) {
  (void)path;
  return CANNOT;
}

#endif

int main(int argc, char **argv) {
  const char *verb = argc > 1 ? argv[1] : "";
  struct writer_options options;
  double dpi, limit;
  if (strcmp(verb, "names") == 0 && argc == 2)
    return list_names();
  if (strcmp(verb, "write") == 0 && argc >= 5 &&
      read_options(&options, argv + 5, argc - 5))
    return write_drawing(argv[2], argv[3], argv[4], &options);
  if (strcmp(verb, "measure") == 0 && argc == 6 &&
      number_from_string(argv[3], &dpi) && number_from_string(argv[4], &limit))
    return measure_picture(argv[2], dpi, limit, strcmp(argv[5], "foot") == 0);
  if (strcmp(verb, "same") == 0 && argc == 5 &&
      number_from_string(argv[4], &limit))
    return compare(argv[2], argv[3], (int)limit);
  if (strcmp(verb, "coverage") == 0 && argc == 4 &&
      number_from_string(argv[3], &limit))
    return print_coverage(argv[2], (int)limit);
  if (strcmp(verb, "seams") == 0 && argc == 3)
    return print_seams(argv[2]);
  fputs("paper_tool: see the top of tests/paper_tool.c\n", stderr);
  return 2;
}
