/* chart.c - charts of speed against accuracy, from what the program accuracy
 * measured.
 *
 *   chart FOLDER
 *
 * Reads FOLDER/cubes.csv and the like and writes FOLDER/lines.svg and
 * faces.svg, a panel a scene; lines-zbuffer.svg and faces-zbuffer.svg, the
 * other knobs of the z-buffers; and summary.svg, all scenes in one. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/plot.h"
#include "bench/table.h"

enum { SCENES = 8, ROWS = 900, FIELD = 96 };

static const char *const scene_id[SCENES] = {
    "cubes", "cycles", "table", "soup", "fandisk", "bunny", "surface", "dense"};

/* A line of a file. */
struct row {
  int scene;
  char name[FIELD], part[FIELD], method[FIELD], knob[FIELD], value[FIELD];
  double seconds, wrong; /* NAN: it did not end */
};

struct rows {
  struct row row[ROWS];
  size_t count;
};

/* ---- Reading ------------------------------------------------------------- */

/* Copies the field at *at and moves to the next one. */
static void take_field(const char **at, char field[FIELD]) {
  bool quoted = **at == '"';
  const char *from = *at + quoted;
  size_t length = strcspn(from, quoted ? "\"" : ",\n");
  snprintf(field, FIELD, "%.*s", (int)length, from);
  *at = from + length + quoted;
  *at += **at == ',';
}

static void take_row(struct rows *rows, int scene, const char *line) {
  char number[FIELD];
  if (rows->count == ROWS || strncmp(line, "scene,", 6) == 0 || *line == '\0')
    return;
  struct row *row = &rows->row[rows->count++];
  row->scene = scene;
  take_field(&line, row->name);
  take_field(&line, row->part);
  take_field(&line, row->method);
  take_field(&line, row->knob);
  take_field(&line, row->value);
  take_field(&line, number);
  row->seconds = *number != '\0' ? strtod(number, NULL) : NAN;
  take_field(&line, number);
  row->wrong = *number != '\0' ? strtod(number, NULL) : NAN;
}

static void read_rows(struct rows *rows, const char *folder) {
  rows->count = 0;
  for (int s = 0; s < SCENES; s++) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s.csv", folder, scene_id[s]);
    char *text = read_file(path, NULL);
    for (const char *line = text; line != NULL && *line != '\0';) {
      const char *end = strchr(line, '\n');
      take_row(rows, s, line);
      line = end != NULL ? end + 1 : NULL;
    }
    free(text);
  }
}

/* ---- What is charted ----------------------------------------------------- */

/* A series of a chart, and the rows that belong to it. */
struct chosen {
  const char *method, *knob;
  struct plot_series series;
};

#define ROW(method, colour)                                                    \
  {                                                                            \
    method, "exact", { method, colour, "", true, false, NULL }                 \
  }

static const struct chosen methods[] = {
    ROW("newell", "#b07000"),
    ROW("watkins", "#007a58"),
    ROW("warnock", "#b04a86"),
    ROW("tiles", "#000000"),
    ROW("brute", "#666666"),
    ROW("auto", "#c00000"),
    {"painter",
     "order",
     {"painter, faces in the order given or of their centroids", "#666666",
      "2 3", false, true, NULL}},
    {"newell",
     "tests",
     {"newell, tests A, AB, ABC, ABCD alone, nothing split", "#b07000", "",
      false, true, NULL}},
    {"watkins",
     "lines",
     {"watkins, 128 to 4096 scan lines", "#007a58", "", false, false, NULL}},
    {"warnock",
     "lines",
     {"warnock in pixels, 128 to 4096 lines of them", "#b04a86", "", false,
      false, NULL}},
    {"zbuffer",
     "lines",
     {"zbuffer, 128 to 4096 lines", "#0060a0", "", false, false, NULL}},
    {"scanline-zbuffer",
     "lines",
     {"scanline-zbuffer, 128 to 4096 lines", "#3aa0e0", "", false, false,
      NULL}},
};

static const struct chosen zbuffers[] = {
    ROW("auto", "#c00000"),
    {"zbuffer",
     "lines",
     {"zbuffer, 128 to 4096 lines, depths in doubles", "#0060a0", "", false,
      false, NULL}},
    {"zbuffer",
     "depth bits",
     {"zbuffer, 1024 lines, 8 to 24 bits of depth", "#b07000", "", false, false,
      NULL}},
    {"zbuffer",
     "subpixels",
     {"zbuffer, 256 lines, 1 to 8 sub-pixels a side", "#007a58", "", false,
      false, NULL}},
    {"scanline-zbuffer",
     "lines",
     {"scanline-zbuffer, 128 to 4096 lines", "#0060a0", "5 3", false, false,
      NULL}},
    {"scanline-zbuffer",
     "depth bits",
     {"scanline-zbuffer, 1024 lines, 8 to 24 bits", "#b07000", "5 3", false,
      false, NULL}},
    {"scanline-zbuffer",
     "subpixels",
     {"scanline-zbuffer, 256 lines, 1 to 8 sub-pixels a side", "#007a58", "5 3",
      false, false, NULL}},
};

static bool is_of(const struct row *row, const struct chosen *chosen,
                  const char *part) {
  return strcmp(row->part, part) == 0 &&
         strcmp(row->method, chosen->method) == 0 &&
         strcmp(row->knob, chosen->knob) == 0;
}

static const char *tick_seconds(int exponent) {
  static const char *const text[] = {"1 µs", "10 µs", "0.1 ms",
                                     "1 ms", "10 ms", "0.1 s",
                                     "1 s",  "10 s",  "100 s"};
  return exponent >= -6 && exponent <= 2 ? text[exponent + 6] : "";
}

static const char *tick_times(int exponent) {
  static const char *const text[] = {"1/1000", "1/100", "1/10", "1",
                                     "10",     "100",   "1000"};
  return exponent >= -3 && exponent <= 3 ? text[exponent + 3] : "";
}

static const char *tick_share(int exponent) {
  static char text[32];
  snprintf(text, sizeof text, "%g %%", 100 * pow(10, exponent));
  return text;
}

static const char *write_share(double share) {
  static char text[32];
  snprintf(text, sizeof text, "%.3g %%", 100 * share);
  return text;
}

/* Smaller errors are drawn at the lower end of the axis. */
static const double SHARE_LEAST = 1e-6;

static const char *wrong_of(const char *part) {
  return strcmp(part, "lines") == 0 ? "false and missing length"
                                    : "wrong, missing and false area";
}

/* ---- A panel a scene ----------------------------------------------------- */

static bool chart_scenes(const struct rows *rows, const char *folder,
                         const char *file, const char *part, const char *title,
                         const struct chosen *chosen, int count) {
  static struct plot plot;
  struct plot_series series[PLOT_SERIES];
  char path[4096];
  plot = (struct plot){.title = title,
                       .columns = 2,
                       .x_title = "CPU time of the solver",
                       .y_title = wrong_of(part),
                       .x_tick = tick_seconds,
                       .y_tick = tick_share,
                       .y_value = write_share,
                       .y_least = SHARE_LEAST,
                       .none = "no error here",
                       .series = series,
                       .series_count = count};
  for (int s = 0; s < SCENES; s++) {
    bool there = false;
    for (size_t i = 0; i < rows->count; i++)
      if (rows->row[i].scene == s) {
        snprintf(plot.panel[plot.panels], PLOT_TEXT, "%s", rows->row[i].name);
        there = true;
        for (int k = 0; k < count; k++)
          if (is_of(&rows->row[i], &chosen[k], part))
            plot_add(&plot, plot.panels, k, rows->row[i].seconds,
                     rows->row[i].wrong, rows->row[i].value);
      }
    plot.panels += there;
  }
  for (int k = 0; k < count; k++)
    series[k] = chosen[k].series;
  snprintf(path, sizeof path, "%s/%s.svg", folder, file);
  return plot_write(&plot, path);
}

/* ---- All scenes in one --------------------------------------------------- */

static const struct row *find_row(const struct rows *rows, int scene,
                                  const char *part, const char *method,
                                  const char *knob, const char *value) {
  for (size_t i = 0; i < rows->count; i++) {
    const struct row *row = &rows->row[i];
    if (row->scene == scene && strcmp(row->part, part) == 0 &&
        strcmp(row->method, method) == 0 && strcmp(row->knob, knob) == 0 &&
        strcmp(row->value, value) == 0)
      return row;
  }
  return NULL;
}

/* Adds a setting: the median over the scenes of its time over that of auto,
 * and of its error; none where it did not end on one of them. */
static void add_summary(struct plot *plot, int panel, int series,
                        const struct rows *rows, const struct row *setting) {
  double times[SCENES], wrong[SCENES];
  size_t n = 0;
  for (int s = 0; s < SCENES; s++) {
    const struct row *best =
        find_row(rows, s, setting->part, "auto", "exact", "");
    const struct row *row = find_row(rows, s, setting->part, setting->method,
                                     setting->knob, setting->value);
    if (best == NULL || row == NULL)
      continue;
    times[n] = isfinite(row->seconds) ? row->seconds / best->seconds : INFINITY;
    wrong[n++] = isfinite(row->wrong) ? row->wrong : INFINITY;
  }
  double middle = n > 0 ? median_of(times, n) : NAN;
  plot_add(plot, panel, series, isfinite(middle) ? middle : NAN,
           n > 0 ? median_of(wrong, n) : 0, setting->value);
}

static bool chart_summary(const struct rows *rows, const char *folder) {
  enum { COUNT = sizeof methods / sizeof *methods };
  static const char *const part[2] = {"lines", "faces"};
  static struct plot plot;
  struct plot_series series[COUNT];
  char path[4096];
  plot =
      (struct plot){.title = "Speed against accuracy: medians of eight scenes",
                    .columns = 2,
                    .panels = 2,
                    .x_title = "CPU time over that of auto, which is exact",
                    .y_title = "error",
                    .x_tick = tick_times,
                    .y_tick = tick_share,
                    .y_value = write_share,
                    .y_least = SHARE_LEAST,
                    .none = "no error here",
                    .series = series,
                    .series_count = COUNT};
  for (int p = 0; p < 2; p++) {
    snprintf(plot.panel[p], PLOT_TEXT, "%s: %s", part[p], wrong_of(part[p]));
    for (int k = 0; k < COUNT; k++)
      for (size_t i = 0; i < rows->count; i++)
        if (rows->row[i].scene == 0 &&
            is_of(&rows->row[i], &methods[k], part[p]))
          add_summary(&plot, p, k, rows, &rows->row[i]);
  }
  for (int k = 0; k < COUNT; k++)
    series[k] = methods[k].series;
  snprintf(path, sizeof path, "%s/summary.svg", folder);
  return plot_write(&plot, path);
}

int main(int argc, char **argv) {
  enum {
    METHODS = sizeof methods / sizeof *methods,
    ZBUFFERS = sizeof zbuffers / sizeof *zbuffers
  };
  static struct rows rows;
  if (argc != 2) {
    fputs("usage: chart FOLDER\n", stderr);
    return 2;
  }
  read_rows(&rows, argv[1]);
  bool ok =
      rows.count > 0 &&
      chart_scenes(&rows, argv[1], "lines", "lines",
                   "Visible lines: speed against accuracy", methods, METHODS) &&
      chart_scenes(&rows, argv[1], "faces", "faces",
                   "Visible faces: speed against accuracy", methods, METHODS) &&
      chart_scenes(&rows, argv[1], "lines-zbuffer", "lines",
                   "Visible lines by z-buffers: resolution, bits of depth, "
                   "sub-pixels",
                   zbuffers, ZBUFFERS) &&
      chart_scenes(&rows, argv[1], "faces-zbuffer", "faces",
                   "Visible faces by z-buffers: resolution, bits of depth, "
                   "sub-pixels",
                   zbuffers, ZBUFFERS) &&
      chart_summary(&rows, argv[1]);
  if (!ok)
    fprintf(stderr, "chart: cannot chart %s\n", argv[1]);
  return !ok;
}
