/* curve_samples.h - samples of a stroke, and how far a curve may be from it. */
#ifndef INK_CURVE_CURVE_SAMPLES_H
#define INK_CURVE_CURVE_SAMPLES_H

#include "ink/curve/clearance.h"
#include "ink/curve/cubic_fit.h"
#include "ink/curve/fit_targets.h"
#include "ink/curve/stroke_shape.h"

/* A curve that is everywhere nearer to its stroke than this share of the
 * distance between the stroke and other ink meets no curve that does the same:
 * below a half, as strokes that meet may still be a little apart. */
#define CURVE_CLEARANCE_SHARE 0.45

/* A sample is a vertex of the stroke; or other ink is met there, so that a
 * curve has to end there, which else may end at any vertex. */
enum { CURVE_VERTEX = 1, CURVE_MEETING = 2 };

struct curve_samples {
  ARRAY(struct fit_sample) sample;
  ARRAY(uint8_t) flags;         /* one a sample */
  ARRAY(double) limit;          /* one a sample, mm: how far from it what stands
                                 for it may be; 0: it stays */
  ARRAY(size_t) of_vertex;      /* one a vertex of the shape: its sample */
  struct fit_targets targets;   /* memory */
  struct clearance_place place; /* its stroke is to be set; else of the last
                                   sample */
};

/* Samples a stroke, whose samples are their own targets.  From a place within
 * the limit of a sample the straight line to the next sample at which a curve
 * may end is within what is allowed.  The stroke's ends and corners stay, and
 * where other ink is met.
 * tolerance  mm, > 0: the most that is allowed
 * Returns false when memory ran out. */
USE_RESULT bool curve_samples_take(struct curve_samples *samples,
                                   const struct clearance *clearance,
                                   const struct stroke_shape *shape,
                                   double tolerance);
void curve_samples_fini(struct curve_samples *samples);

#endif
