/* part_fit.h - curves and lines in place of a part of a stroke. */
#ifndef INK_CURVE_PART_FIT_H
#define INK_CURVE_PART_FIT_H

#include "ink/curve/curve_samples.h"

struct part_fit {
  struct drawing *drawing; /* whose control points they are added to */
  double tolerance;        /* mm, of the current stroke */
  struct curve_samples of; /* the current stroke */
  bool has_curves;         /* of the current stroke, so far */
  ARRAY(double) along; /* one a piece added, mm: where it ends on the current
                              stroke */
  ARRAY(double) parameter; /* memory for one a sample */
};

/* A part of the samples of a stroke, without corners, and the directions, unit
 * vectors, in which it begins and ends; (0, 0) where nothing prescribes one. */
struct stroke_part {
  size_t from, to; /* the first and the last sample */
  struct drawing_point start, end;
  bool straight; /* its sides stay lines */
};

/* The direction of a part at a sample of it, a unit vector, from the samples
 * within `before` mm before it and `after` mm after it: that of the parabola
 * through it that is nearest to their targets by least squares. */
struct drawing_point part_fit_direction(const struct curve_samples *samples,
                                        const struct stroke_part *part,
                                        size_t at, double before, double after);

/* Appends the pieces of a part to the control points, from its first target
 * on.
 * Returns false when memory ran out. */
USE_RESULT bool part_fit_add(struct part_fit *pieces,
                             const struct stroke_part *part);

#endif
