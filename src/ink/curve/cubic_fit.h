/* cubic_fit.h - fits one cubic Bezier curve to a polyline. */
#ifndef INK_CURVE_CUBIC_FIT_H
#define INK_CURVE_CUBIC_FIT_H

#include "drawing/drawing.h"

/* A point of the polyline, and how far the curve may be from the line to the
 * next point: along that line, the distance changes from `from` to `to`, mm. */
struct fit_sample {
  struct drawing_point at;
  struct drawing_point target; /* what the curve is to be near */
  double along;                /* mm from the first point of the stroke */
  double from, to;
};

/* Fits a curve to the targets, from the first to the last one, in the
 * directions of the unit vectors there, by least squares over the lengths of
 * its handles and, alternately, the parameters of the samples.
 * samples    at least 2
 * parameter  memory for as many
 * Returns whether there is one that is nowhere farther from the polyline than
 * the samples allow, nor any sample farther than the tolerance, mm, from it.
 * Source   [Schneider1990], with each sample weighted by its distance */
bool cubic_fit(const struct fit_sample *sample, size_t samples,
               double tolerance, struct drawing_point start,
               struct drawing_point end, double *parameter,
               struct drawing_point curve[4]);

#endif
