/* plot.h - panels of curves on logarithmic axes, as SVG: time across, error
 * up, and below the axis a row for each method without error.
 *
 * All panels have the same range, so that curves can be compared from panel to
 * panel. */
#ifndef BENCH_PLOT_H
#define BENCH_PLOT_H

#include <stdbool.h>
#include <stddef.h>

enum { PLOT_PANELS = 8, PLOT_SERIES = 16, PLOT_POINTS = 1200, PLOT_TEXT = 96 };

/* A curve, or a row below the axis. */
struct plot_series {
  const char *name; /* of the row, or of the curve in the legend */
  const char *colour;
  const char *dashes; /* of the line, as stroke-dasharray; "": solid */
  bool row;           /* no error: a row of its own */
  bool label_all;     /* all points are labelled, not the first and last one */
  const char *none;   /* the row of its points without error; NULL: plot.none */
};

struct plot_point {
  int panel, series;
  double x, y; /* y 0: no error; x NAN: it did not end */
  char label[16];
};

struct plot {
  const char *title, *x_title, *y_title;
  const char *none; /* the row of points that happen to have no error, of all
                       series without one of their own */
  const char *(*x_tick)(int exponent); /* the label of a power of ten */
  const char *(*y_tick)(int exponent);
  const char *(*y_value)(double y); /* written beside what is beyond the axis */
  double y_least; /* what is less, or more than 1, is beyond the axis: drawn at
                     its end as a triangle */
  const struct plot_series *series;
  int series_count, panels, columns;
  char panel[PLOT_PANELS][PLOT_TEXT];
  struct plot_point point[PLOT_POINTS];
  size_t points;
};

/* Points of a series are added in order, and joined. */
void plot_add(struct plot *plot, int panel, int series, double x, double y,
              const char *label);

/* Writes the plot, whole or not at all; false where it cannot be written. */
bool plot_write(const struct plot *plot, const char *path);

#endif
