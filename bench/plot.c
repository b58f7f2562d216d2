/* plot.c - see plot.h. */
#include "bench/plot.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bench/label_places.h"
#include "bench/table.h"

enum {
  panel_w = 560,
  panel_h = 300,
  row_h = 15,
  row_gap = 8, /* between the axis and the rows */
  gap_x = 150,
  gap_y = 92,
  left = 150,
  margin = 30,
  legend_h = 22,
  size = 13 /* of text */
};

/* A range of powers of ten. */
struct axis {
  int low, high;
};

/* The panel that is being drawn: its lower left corner, and where labels can
 * stand. */
struct panel {
  FILE *file;
  const struct plot *plot;
  struct axis x, y;
  int index;
  double left, bottom;
  struct label_places places;
};

void plot_add(struct plot *plot, int panel, int series, double x, double y,
              const char *label) {
  if (plot->points == PLOT_POINTS)
    return;
  struct plot_point *point = &plot->point[plot->points++];
  *point = (struct plot_point){panel, series, x, y, ""};
  snprintf(point->label, sizeof point->label, "%s", label);
}

/* ---- Axes ---------------------------------------------------------------- */

static void widen(struct axis *axis, double value) {
  int low = (int)floor(log10(value)), high = (int)ceil(log10(value));
  axis->low = low < axis->low ? low : axis->low;
  axis->high = high > axis->high ? high : axis->high;
}

static double bounded(const struct plot *plot, double share) {
  return fmin(fmax(share, plot->y_least), 1);
}

static void find_range(const struct plot *plot, struct axis *x,
                       struct axis *y) {
  *x = *y = (struct axis){99, -99};
  for (size_t i = 0; i < plot->points; i++) {
    const struct plot_point *p = &plot->point[i];
    if (isfinite(p->x))
      widen(x, p->x);
    if (isfinite(p->x) && p->y > 0)
      widen(y, bounded(plot, p->y));
  }
  if (x->low > x->high)
    *x = (struct axis){-3, 0};
  if (y->low > y->high)
    *y = (struct axis){-6, 0};
}

static double place_of(const struct axis *axis, double value, double length) {
  return (log10(value) - axis->low) / (axis->high - axis->low) * length;
}

static bool is_beyond(const struct plot *plot, double y) {
  return y > 1 || (y > 0 && y < plot->y_least);
}

static bool has_row(const struct plot_series *series) {
  return series->row || series->none != NULL;
}

/* Own rows, and one for all series that have none. */
static int count_rows(const struct plot *plot) {
  int rows = 0;
  for (int s = 0; s < plot->series_count; s++)
    rows += has_row(&plot->series[s]);
  return rows + (rows < plot->series_count);
}

static int count_curves(const struct plot *plot) {
  int curves = 0;
  for (int s = 0; s < plot->series_count; s++)
    curves += !plot->series[s].row;
  return curves;
}

static int rows_height(const struct plot *plot) {
  return row_gap + count_rows(plot) * row_h;
}

/* ---- Marks --------------------------------------------------------------- */

static void put_text(FILE *file, double x, double y, const char *anchor,
                     const char *colour, int height, const char *text) {
  fprintf(file,
          "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%d\" text-anchor=\"%s\" "
          "fill=\"%s\">%s</text>\n",
          x, y, height, anchor, colour, text);
}

static void put_line(FILE *file, double x0, double y0, double x1, double y1,
                     const char *style) {
  fprintf(file, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/>\n",
          x0, y0, x1, y1, style);
}

static void put_mark(FILE *file, double x, double y, const char *colour,
                     bool square) {
  if (square)
    fprintf(file,
            "<rect x=\"%.1f\" y=\"%.1f\" width=\"9\" height=\"9\" "
            "fill=\"%s\"/>\n",
            x - 4.5, y - 4.5, colour);
  else
    fprintf(file, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\" fill=\"%s\"/>\n",
            x, y, colour);
}

/* Points up or down. */
static void put_triangle(FILE *file, double x, double y, const char *colour,
                         bool up) {
  double tip = up ? -6 : 6;
  fprintf(file, "<path d=\"M%.1f %.1fL%.1f %.1fL%.1f %.1fZ\" fill=\"%s\"/>\n",
          x, y + tip, x - 6, y - tip * 0.7, x + 6, y - tip * 0.7, colour);
}

/* About as wide as text is in usual fonts. */
static double width_of(const char *text) {
  double width = 0;
  for (; *text != '\0'; text++)
    width += *text >= 'A' && *text <= 'Z'   ? 0.7
             : *text == ' ' || *text == '.' ? 0.33
             : *text == '%'                 ? 0.96
                                            : 0.63;
  return width * (size - 1);
}

/* Puts a label beside a mark, or farther away with a line to it. */
static void put_label(struct panel *panel, double x, double y,
                      const char *colour, const char *text) {
  struct label_box at;
  double distance, h = size - 2;
  if (!label_place(&panel->places, x, y, width_of(text), h, &at, &distance))
    return;
  double cx = (at.x0 + at.x1) / 2, cy = (at.y0 + at.y1) / 2;
  if (distance > LABEL_BESIDE) {
    char style[64];
    double to_x = fmin(fmax(x, at.x0), at.x1),
           to_y = fmin(fmax(y, at.y0), at.y1);
    snprintf(style, sizeof style, "stroke=\"%s\" stroke-width=\"0.6\"", colour);
    put_line(panel->file, x, y, to_x, to_y, style);
  }
  fputs("<g paint-order=\"stroke\" stroke=\"#ffffff\" stroke-width=\"3\">",
        panel->file);
  put_text(panel->file, cx, cy + 0.36 * size, "middle", colour, size - 1, text);
  fputs("</g>\n", panel->file);
}

/* ---- A panel ------------------------------------------------------------- */

static void put_grid(const struct panel *panel) {
  static const char grid[] = "stroke=\"#dddddd\"";
  FILE *file = panel->file;
  double bottom = panel->bottom, foot = bottom + rows_height(panel->plot);
  for (int e = panel->x.low; e <= panel->x.high; e++) {
    double x = panel->left + place_of(&panel->x, pow(10, e), panel_w);
    put_line(file, x, bottom - panel_h, x, foot, grid);
    put_text(file, x, foot + 16, "middle", "#000000", size,
             panel->plot->x_tick(e));
  }
  for (int e = panel->y.low; e <= panel->y.high; e++) {
    double y = bottom - place_of(&panel->y, pow(10, e), panel_h);
    put_line(file, panel->left, y, panel->left + panel_w, y, grid);
    put_text(file, panel->left - 6, y + 4, "end", "#000000", size,
             panel->plot->y_tick(e));
  }
  fprintf(file,
          "<rect x=\"%.1f\" y=\"%.1f\" width=\"%d\" height=\"%.1f\" "
          "fill=\"none\" stroke=\"#666666\"/>\n",
          panel->left, bottom - panel_h, panel_w, foot - bottom + panel_h);
  put_line(file, panel->left, bottom, panel->left + panel_w, bottom,
           "stroke=\"#666666\"");
  put_text(file, panel->left + panel_w / 2.0, foot + 33, "middle", "#000000",
           size, panel->plot->x_title);
  fprintf(file,
          "<text transform=\"translate(%.1f %.1f) rotate(-90)\" "
          "font-size=\"%d\" text-anchor=\"middle\">%s</text>\n",
          panel->left - 72, bottom - panel_h / 2.0, size, panel->plot->y_title);
}

/* The row of a series; of those without one of their own, the last. */
static double row_of(const struct panel *panel, int series) {
  int row = 0;
  if (!has_row(&panel->plot->series[series]))
    row = count_rows(panel->plot) - 1;
  else
    for (int s = 0; s < series; s++)
      row += has_row(&panel->plot->series[s]);
  return panel->bottom + row_gap + (row + 0.5) * row_h;
}

static void put_row_names(const struct panel *panel) {
  bool shared = false;
  for (int s = 0; s < panel->plot->series_count; s++) {
    const struct plot_series *series = &panel->plot->series[s];
    char text[PLOT_TEXT];
    snprintf(text, sizeof text, "%s%s", series->row ? "no error: " : "",
             series->row ? series->name : series->none);
    if (has_row(series))
      put_text(panel->file, panel->left - 6, row_of(panel, s) + 4.5, "end",
               series->colour, size, text);
    shared = shared || !has_row(series);
  }
  if (shared)
    put_text(panel->file, panel->left - 6,
             panel->bottom + rows_height(panel->plot) - 0.5 * row_h + 4.5,
             "end", "#000000", size, panel->plot->none);
}

/* What is beyond the axis is drawn within its end. */
static void find_position(const struct panel *panel,
                          const struct plot_point *point, double *x,
                          double *y) {
  double inwards = point->y > 1 ? 8 : is_beyond(panel->plot, point->y) ? -8 : 0;
  *x = panel->left + place_of(&panel->x, point->x, panel_w);
  *y = point->y > 0
           ? panel->bottom + inwards -
                 place_of(&panel->y, bounded(panel->plot, point->y), panel_h)
           : row_of(panel, point->series);
}

static bool is_drawn(const struct panel *panel, const struct plot_point *p) {
  return p->panel == panel->index && isfinite(p->x);
}

static void put_point(struct panel *panel, const struct plot_point *p, double x,
                      double y) {
  const struct plot_series *series = &panel->plot->series[p->series];
  if (is_beyond(panel->plot, p->y))
    put_triangle(panel->file, x, y, series->colour, p->y > 1);
  else
    put_mark(panel->file, x, y, series->colour, series->row);
  label_take_box(&panel->places,
                 (struct label_box){x - 5, y - 5, x + 5, y + 5});
}

/* Lines, then marks, both of which labels avoid. */
static void put_curves(struct panel *panel) {
  const struct plot *plot = panel->plot;
  for (int s = 0; s < plot->series_count; s++) {
    const struct plot_series *series = &plot->series[s];
    const struct plot_point *last = NULL;
    double x0 = 0, y0 = 0, x, y;
    char style[128];
    snprintf(style, sizeof style,
             "stroke=\"%s\" stroke-width=\"1.6\" stroke-dasharray=\"%s\"",
             series->colour, series->dashes);
    for (size_t i = 0; i < plot->points; i++) {
      const struct plot_point *p = &plot->point[i];
      if (p->series != s || !is_drawn(panel, p))
        continue;
      find_position(panel, p, &x, &y);
      if (last != NULL && last->y > 0 && p->y > 0) {
        put_line(panel->file, x0, y0, x, y, style);
        label_take_curve(&panel->places, (struct label_box){x0, y0, x, y});
      }
      put_point(panel, p, x, y);
      last = p;
      x0 = x;
      y0 = y;
    }
  }
}

/* Whether it is the first or the last point of its series in the panel. */
static bool is_end(const struct panel *panel, size_t index) {
  const struct plot_point *point = panel->plot->point;
  bool before = false, after = false;
  for (size_t i = 0; i < panel->plot->points; i++)
    if (point[i].series == point[index].series && is_drawn(panel, &point[i])) {
      before |= i < index;
      after |= i > index;
    }
  return !before || !after;
}

/* Whether a point of a series of the same colour that has the same label, and
 * comes first, is as good as at the same place. */
static bool is_labelled(const struct panel *panel, size_t index) {
  const struct plot *plot = panel->plot;
  const struct plot_point *p = &plot->point[index];
  double x, y, x0, y0;
  find_position(panel, p, &x, &y);
  for (size_t i = 0; i < index; i++) {
    const struct plot_point *q = &plot->point[i];
    if (!is_drawn(panel, q) || strcmp(p->label, q->label) != 0 ||
        strcmp(plot->series[p->series].colour,
               plot->series[q->series].colour) != 0)
      continue;
    find_position(panel, q, &x0, &y0);
    if (hypot(x - x0, y - y0) < size)
      return true;
  }
  return false;
}

static void put_labels(struct panel *panel) {
  const struct plot *plot = panel->plot;
  for (size_t i = 0; i < plot->points; i++) {
    const struct plot_point *p = &plot->point[i];
    const struct plot_series *series = &plot->series[p->series];
    bool beyond = is_beyond(plot, p->y);
    double x, y;
    char text[48];
    if (!is_drawn(panel, p) || series->row || is_labelled(panel, i) ||
        (!series->label_all && !beyond && !is_end(panel, i)))
      continue;
    find_position(panel, p, &x, &y);
    snprintf(text, sizeof text, "%s%s%s", p->label,
             beyond && *p->label != '\0' ? ": " : "",
             beyond ? plot->y_value(p->y) : "");
    if (*text != '\0')
      put_label(panel, x, y, series->colour, text);
  }
}

/* The settings that did not end in time. */
static void put_unfinished(const struct panel *panel) {
  const struct plot *plot = panel->plot;
  char text[400] = "not in 15 s: ";
  size_t used = strlen(text), none = used;
  for (size_t i = 0; i < plot->points; i++) {
    const struct plot_point *p = &plot->point[i];
    if (p->panel != panel->index || isfinite(p->x) || used > 300)
      continue;
    const char *name = plot->series[p->series].name;
    int n = snprintf(text + used, sizeof text - used, "%s%.*s%s%s",
                     used > none ? ", " : "", (int)strcspn(name, ","), name,
                     *p->label != '\0' ? " " : "", p->label);
    used += n > 0 ? (size_t)n : 0;
  }
  if (used > none)
    put_text(panel->file, panel->left + panel_w - 6,
             panel->bottom - panel_h - 8, "end", "#000000", size - 1, text);
}

static void put_panel(FILE *file, const struct plot *plot, int index,
                      struct axis x, struct axis y, double x0, double y0) {
  static struct panel panel;
  panel = (struct panel){
      .file = file, .plot = plot, .x = x, .y = y, .index = index};
  panel.left = x0;
  panel.bottom = y0 + panel_h;
  panel.places.within = (struct label_box){
      x0 + 2, y0, x0 + panel_w - 2, panel.bottom + rows_height(plot) + 1};
  label_take_curve(
      &panel.places,
      (struct label_box){x0, panel.bottom, x0 + panel_w, panel.bottom});
  put_grid(&panel);
  put_row_names(&panel);
  put_text(file, x0, y0 - 8, "start", "#000000", size + 2, plot->panel[index]);
  put_unfinished(&panel);
  put_curves(&panel);
  put_labels(&panel);
}

/* ---- The whole ----------------------------------------------------------- */

static bool has_beyond(const struct plot *plot) {
  for (size_t i = 0; i < plot->points; i++)
    if (isfinite(plot->point[i].x) && is_beyond(plot, plot->point[i].y))
      return true;
  return false;
}

static int legend_height(const struct plot *plot) {
  return ((count_curves(plot) + 1) / 2 + has_beyond(plot)) * legend_h;
}

/* The names of the curves, two columns of them, and what triangles are. */
static void put_legend(FILE *file, const struct plot *plot, double y) {
  int n = 0;
  for (int s = 0; s < plot->series_count; s++) {
    const struct plot_series *series = &plot->series[s];
    char style[128];
    double x = left + n % 2 * (panel_w + gap_x), at = y + n / 2 * legend_h;
    if (series->row)
      continue;
    snprintf(style, sizeof style,
             "stroke=\"%s\" stroke-width=\"1.6\" stroke-dasharray=\"%s\"",
             series->colour, series->dashes);
    put_line(file, x, at, x + 34, at, style);
    put_mark(file, x + 17, at, series->colour, false);
    put_text(file, x + 44, at + 5, "start", series->colour, size + 1,
             series->name);
    n++;
  }
  if (has_beyond(plot)) {
    double at = y + (n + 1) / 2 * legend_h;
    put_triangle(file, left + 8, at, "#000000", true);
    put_triangle(file, left + 26, at, "#000000", false);
    put_text(file, left + 44, at + 5, "start", "#000000", size + 1,
             "beyond the axis, above or below: the number stands beside it");
  }
}

bool plot_write(const struct plot *plot, const char *path) {
  struct whole_file whole;
  struct axis x, y;
  if (!whole_open(&whole, path))
    return false;
  FILE *file = whole.file;
  int head = 58 + legend_height(plot) + 28;
  int high = panel_h + rows_height(plot) + gap_y;
  int width = left + plot->columns * (panel_w + gap_x) - gap_x + margin;
  int rows = (plot->panels + plot->columns - 1) / plot->columns;
  int height = head + rows * high - gap_y + 60;
  find_range(plot, &x, &y);
  fprintf(file,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" "
          "height=\"%d\" viewBox=\"0 0 %d %d\" font-family=\"sans-serif\">\n"
          "<rect width=\"%d\" height=\"%d\" fill=\"#ffffff\"/>\n",
          width, height, width, height, width, height);
  put_text(file, left, 30, "start", "#000000", size + 5, plot->title);
  put_legend(file, plot, 58);
  for (int i = 0; i < plot->panels; i++)
    put_panel(file, plot, i, x, y, left + i % plot->columns * (panel_w + gap_x),
              head + i / plot->columns * high);
  fputs("</svg>\n", file);
  return whole_close(&whole, true);
}
