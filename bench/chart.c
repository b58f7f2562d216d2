/* chart.c - time against error, as SVG.
 *
 * Both axes are logarithmic, with the same range in all panels, so that curves
 * can be compared from scene to scene.  Below the axis there is a band for
 * those that made no error. */
#include "bench/chart.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
  panel_w = 400,
  panel_h = 250,
  gap_x = 90,
  gap_y = 62,
  left = 80,
  top = 84,
  band = 34 /* for the exact methods */
};

/* Told apart in print and by the colour-blind. */
static const char *const colour[CHART_METHODS] = {
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
    "#000000", "#7f7f7f", "#8c564b", "#bcbd22", "#17becf", "#9467bd"};

/* A range of powers of ten. */
struct axis {
  int low, high;
};

struct frame {
  struct axis x, y;
};

void chart_init(struct chart *chart) { memset(chart, 0, sizeof *chart); }

void chart_fini(struct chart *chart) { memset(chart, 0, sizeof *chart); }

void chart_open(struct chart *chart, const char *scene) {
  if (chart->scenes < CHART_SCENES)
    snprintf(chart->scene[chart->scenes++], sizeof *chart->scene, "%s", scene);
}

static int find_method(struct chart *chart, const char *method) {
  for (int i = 0; i < chart->methods; i++)
    if (strcmp(chart->method[i], method) == 0)
      return i;
  if (chart->methods == CHART_METHODS)
    return -1;
  snprintf(chart->method[chart->methods], sizeof *chart->method, "%s", method);
  return chart->methods++;
}

void chart_add(struct chart *chart, enum chart_kind kind, const char *method,
               double seconds, double share) {
  int index = find_method(chart, method);
  if (index >= 0 && chart->points < CHART_POINTS && chart->scenes > 0)
    chart->point[chart->points++] = (struct chart_point){
        chart->scenes - 1, (int)kind, index, fmax(seconds, 1e-5), share};
}

/* ---- Axes ---------------------------------------------------------------- */

static void widen(struct axis *axis, double value) {
  int low = (int)floor(log10(value)), high = (int)ceil(log10(value));
  if (low < axis->low)
    axis->low = low;
  if (high > axis->high)
    axis->high = high;
}

static struct frame frame_of(const struct chart *chart) {
  struct frame frame = {{99, -99}, {99, -99}};
  for (size_t i = 0; i < chart->points; i++) {
    widen(&frame.x, chart->point[i].seconds);
    if (chart->point[i].share > 0)
      widen(&frame.y, chart->point[i].share);
  }
  if (frame.y.low > frame.y.high)
    frame.y = (struct axis){-6, 0};
  return frame;
}

static double place(const struct axis *axis, double value, double length) {
  return (log10(value) - axis->low) / (axis->high - axis->low) * length;
}

/* ---- Drawing ------------------------------------------------------------- */

static void put_text(FILE *file, double x, double y, const char *anchor,
                     int size, const char *text) {
  fprintf(file,
          "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%d\" "
          "text-anchor=\"%s\">%s</text>\n",
          x, y, size, anchor, text);
}

static void put_line(FILE *file, double x0, double y0, double x1, double y1,
                     const char *stroke) {
  fprintf(file,
          "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" "
          "stroke=\"%s\"/>\n",
          x0, y0, x1, y1, stroke);
}

static void put_grid(FILE *file, const struct frame *frame, double x0,
                     double y0) {
  char label[32];
  double bottom = y0 + panel_h;
  for (int e = frame->x.low; e <= frame->x.high; e++) {
    double x = x0 + place(&frame->x, pow(10, e), panel_w);
    put_line(file, x, y0, x, bottom + band, "#dddddd");
    snprintf(label, sizeof label, "%g s", pow(10, e));
    put_text(file, x, bottom + band + 16, "middle", 12, label);
  }
  for (int e = frame->y.low; e <= frame->y.high; e++) {
    double y = bottom - place(&frame->y, pow(10, e), panel_h);
    put_line(file, x0, y, x0 + panel_w, y, "#dddddd");
    snprintf(label, sizeof label, "%g %%", 100 * pow(10, e));
    put_text(file, x0 - 6, y + 4, "end", 12, label);
  }
  fprintf(file,
          "<rect x=\"%.1f\" y=\"%.1f\" width=\"%d\" height=\"%d\" "
          "fill=\"none\" stroke=\"#888888\"/>\n",
          x0, y0, panel_w, panel_h + band);
  put_line(file, x0, bottom, x0 + panel_w, bottom, "#888888");
  put_text(file, x0 - 6, bottom + band / 2 + 4, "end", 12, "none");
}

static void put_mark(FILE *file, double x, double y, int method, bool exact) {
  if (exact)
    fprintf(file,
            "<rect x=\"%.1f\" y=\"%.1f\" width=\"9\" height=\"9\" "
            "fill=\"%s\"/>\n",
            x - 4.5, y - 4.5, colour[method]);
  else
    fprintf(file, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"%s\"/>\n", x,
            y, colour[method]);
}

/* One method's marks, and the line through them. */
static void put_curve(FILE *file, const struct chart *chart,
                      const struct frame *frame, double x0, double y0,
                      int scene, int kind, int method) {
  bool open = false;
  double last_x = 0, last_y = 0;
  for (size_t i = 0; i < chart->points; i++) {
    const struct chart_point *p = &chart->point[i];
    if (p->scene != scene || p->kind != kind || p->method != method)
      continue;
    bool exact = !(p->share > 0);
    double x = x0 + place(&frame->x, p->seconds, panel_w);
    double y = y0 + panel_h;
    y += exact ? band / 2.0 : -place(&frame->y, p->share, panel_h);
    if (open && !exact)
      fprintf(file,
              "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" "
              "stroke=\"%s\" stroke-width=\"2\"/>\n",
              last_x, last_y, x, y, colour[method]);
    put_mark(file, x, y, method, exact);
    open = !exact;
    last_x = x;
    last_y = y;
  }
}

static void put_legend(FILE *file, const struct chart *chart) {
  double x = left;
  for (int m = 0; m < chart->methods; m++) {
    put_mark(file, x, 46, m, false);
    put_text(file, x + 10, 50, "start", 14, chart->method[m]);
    x += 34 + 8.2 * (double)strlen(chart->method[m]);
  }
}

static void put_panels(FILE *file, const struct chart *chart) {
  static const char *const what[CHART_KINDS] = {"wrong area of the faces",
                                                "wrong ink of the lines"};
  struct frame frame = frame_of(chart);
  for (int s = 0; s < chart->scenes; s++)
    for (int k = 0; k < CHART_KINDS; k++) {
      char title[96];
      double x0 = left + k * (panel_w + gap_x);
      double y0 = top + s * (panel_h + band + gap_y);
      put_grid(file, &frame, x0, y0);
      snprintf(title, sizeof title, "%s: %s", chart->scene[s], what[k]);
      put_text(file, x0, y0 - 8, "start", 15, title);
      for (int m = 0; m < chart->methods; m++)
        put_curve(file, chart, &frame, x0, y0, s, k, m);
    }
}

bool chart_write(const struct chart *chart, const char *path) {
  FILE *file = fopen(path, "w");
  int width = left + CHART_KINDS * panel_w + gap_x + 30;
  int height = top + chart->scenes * (panel_h + band + gap_y);
  if (file == NULL)
    return false;
  fprintf(file,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" "
          "height=\"%d\" viewBox=\"0 0 %d %d\" font-family=\"sans-serif\">\n"
          "<rect width=\"%d\" height=\"%d\" fill=\"#ffffff\"/>\n",
          width, height, width, height, width, height);
  put_text(file, left, 24, "start", 17,
           "Error against CPU time of the solver.  Circles: 128 to 4096 lines; "
           "squares: no error");
  put_legend(file, chart);
  put_panels(file, chart);
  fputs("</svg>\n", file);
  bool ok = !ferror(file);
  return fclose(file) == 0 && ok;
}
