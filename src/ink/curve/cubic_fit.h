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

/* What a curve is fitted to. */
struct cubic_fit {
  const struct fit_sample *sample;
  size_t samples;                  /* at least 2 */
  double tolerance;                /* mm, from each sample */
  struct drawing_point start, end; /* the directions there, unit vectors */
  double end_limit; /* mm: how far its end may be from the last sample, rather
                       than at its target; 0: it may not move */
};

/* Fits a curve to the targets, from the first to the last one, by least squares
 * over the lengths of its handles and, alternately, the parameters of the
 * samples.  The offsets of its handles from its start, and of its end if that
 * may move, have as few decimals, in mm, as the distances leave.
 * parameter  memory for one a sample
 * Returns whether there is one that is nowhere farther from the polyline than
 * the samples allow, nor any sample farther than the tolerance from it.
 * Source   [Schneider1990], with each sample weighted by its distance */
bool cubic_fit(const struct cubic_fit *fit, double *parameter,
               struct drawing_point curve[4]);

/* The same for a line, which needs no directions. */
bool line_fit(const struct cubic_fit *fit, double *parameter,
              struct drawing_point line[4]);

#endif
