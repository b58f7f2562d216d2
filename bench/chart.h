/* chart.h - time against error, as SVG: a row of panels a scene, one for areas
 * and one for lines, a curve a method. */
#ifndef BENCH_CHART_H
#define BENCH_CHART_H

#include <stdbool.h>
#include <stddef.h>

enum chart_kind { CHART_AREA, CHART_INK, CHART_KINDS };
enum { CHART_SCENES = 4, CHART_METHODS = 12, CHART_POINTS = 400 };

struct chart_point {
  int scene, kind, method;
  double seconds, share; /* share 0: exact */
};

struct chart {
  char scene[CHART_SCENES][32], method[CHART_METHODS][32];
  int scenes, methods;
  struct chart_point point[CHART_POINTS];
  size_t points;
};

void chart_init(struct chart *chart);
void chart_fini(struct chart *chart);

/* The points added from now on are of that scene. */
void chart_open(struct chart *chart, const char *scene);

/* A measurement of a method; the next one of the same method is joined to it by
 * a line.  Beyond the chart's room it is left out. */
void chart_add(struct chart *chart, enum chart_kind kind, const char *method,
               double seconds, double share);

/* Writes the chart; false where the file cannot be written. */
bool chart_write(const struct chart *chart, const char *path);

#endif
