/* fit_targets.c - smooths samples of a stroke by a moving average.
 *
 * A contour of a mesh zigzags about that of the surface, and a polyline with
 * few vertices lies inside of its curve.  A curve that passes all its ends
 * through vertices leaves the line on one side only, by all that is allowed;
 * one that is near to the average of the line leaves it on both.
 *
 * A moving average m(p) draws a bend inwards; 2 m(p) - m(m(p)), where it is
 * applied twice, does not to second order.  The window is the longest of which
 * next to all samples stay within their limits; what does not is brought back
 * to the limit. */
#include "ink/curve/fit_targets.h"

#include <math.h>

#include "base/poll.h"
#include "base/sort.h"

/* The longest window, as a multiple of the tolerance, and how many times
 * shorter each next one is. */
#define WINDOW_TOLERANCES 100
#define WINDOW_RATIO 1.25

/* A sample counts where nearly all of the tolerance is allowed, and so many of
 * those may be beyond their limits. */
#define COUNTED_SHARE 0.8
#define BEYOND_SHARE 0.02

/* Samples of fewer are not smoothed. */
enum { SAMPLES_MIN = 5 };

/* A part of a stroke, smoothed. */
struct smoothing {
  struct fit_targets *memory;
  struct fit_sample *sample;
  size_t samples;
  const double *limit;      /* mm, one a sample */
  double length, tolerance; /* mm */
};

/* ---- The moving average -------------------------------------------------- */

/* Sets the integrals of a polyline at the samples, from the first one. */
static void integrate(const struct smoothing *s,
                      const struct drawing_point *line) {
  struct drawing_point *sum = s->memory->integral.item;
  sum[0] = (struct drawing_point){0, 0};
  for (size_t i = 1; i < s->samples; i++) {
    double half = (s->sample[i].along - s->sample[i - 1].along) / 2;
    sum[i].x = sum[i - 1].x + half * (line[i - 1].x + line[i].x);
    sum[i].y = sum[i - 1].y + half * (line[i - 1].y + line[i].y);
  }
}

/* The integral of the polyline up to `at` mm from its first sample, on it. */
static struct drawing_point integral_on(const struct smoothing *s,
                                        const struct drawing_point *line,
                                        double at) {
  const struct fit_sample *sample = s->sample;
  struct drawing_point sum;
  size_t i = 1, last = s->samples - 1;
  LOWER_BOUND(i, 1, last, sample[i].along - sample[0].along < at);
  double from = sample[i - 1].along - sample[0].along;
  double side = sample[i].along - sample[i - 1].along;
  double t = side > 0 ? fmin(fmax((at - from) / side, 0), 1) : 0;
  struct drawing_point end = drawing_point_between(line[i - 1], line[i], t);
  sum = s->memory->integral.item[i - 1];
  sum.x += t * side / 2 * (line[i - 1].x + end.x);
  sum.y += t * side / 2 * (line[i - 1].y + end.y);
  return sum;
}

/* The same at any place; beyond an end the polyline goes on as its image by a
 * half turn about that end, which so keeps its place. */
static struct drawing_point integral_at(const struct smoothing *s,
                                        const struct drawing_point *line,
                                        double at) {
  if (at >= 0 && at <= s->length)
    return integral_on(s, line, at);
  struct drawing_point end = line[at < 0 ? 0 : s->samples - 1];
  double past = at < 0 ? at : at - s->length;
  double mirrored = fmin(fmax(at < 0 ? -at : s->length - past, 0), s->length);
  struct drawing_point sum = integral_on(s, line, mirrored);
  return (struct drawing_point){sum.x + 2 * past * end.x,
                                sum.y + 2 * past * end.y};
}

/* Sets `mean` to the average of the polyline over a window about each sample,
 * at most twice as long as the part. */
static void average(const struct smoothing *s, const struct drawing_point *line,
                    double window, struct drawing_point *mean) {
  integrate(s, line);
  for (size_t i = 0; i < s->samples; i++) {
    double at = s->sample[i].along - s->sample[0].along;
    struct drawing_point low = integral_at(s, line, at - window / 2);
    struct drawing_point high = integral_at(s, line, at + window / 2);
    mean[i] = (struct drawing_point){(high.x - low.x) / window,
                                     (high.y - low.y) / window};
  }
}

/* ---- Limits -------------------------------------------------------------- */

/* Whether a sample counts: nearly all of the tolerance is allowed there. */
static bool is_counted(const struct smoothing *s, size_t i) {
  return s->limit[i] >= COUNTED_SHARE * FIT_TARGET_SHARE * s->tolerance;
}

static size_t count_samples(const struct smoothing *s) {
  size_t counted = 0;
  for (size_t i = 1; i + 1 < s->samples; i++)
    counted += is_counted(s, i);
  return counted;
}

/* Sets the targets by a window.  Returns how many samples of those that count
 * are beyond their limits. */
static size_t smooth_by(const struct smoothing *s, double window) {
  const struct drawing_point *line = s->memory->line.item;
  struct drawing_point *mean = s->memory->mean.item;
  struct drawing_point *twice = s->memory->twice.item;
  const double *limit = s->limit;
  size_t beyond = 0;
  average(s, line, window, mean);
  average(s, mean, window, twice);
  for (size_t i = 1; i + 1 < s->samples; i++) {
    const struct drawing_point smooth = {2 * mean[i].x - twice[i].x,
                                         2 * mean[i].y - twice[i].y};
    double off = drawing_distance(line[i], smooth);
    beyond += off > limit[i] && is_counted(s, i);
    double share = off > limit[i] ? limit[i] / off : 1;
    s->sample[i].target = drawing_point_between(line[i], smooth, share);
  }
  return beyond;
}

/* ---- The whole ----------------------------------------------------------- */

static bool reserve(struct fit_targets *t, size_t samples) {
  t->line.count = t->integral.count = t->mean.count = 0;
  t->twice.count = 0;
  return ARRAY_RESERVE(&t->line, samples) &&
         ARRAY_RESERVE(&t->integral, samples) &&
         ARRAY_RESERVE(&t->mean, samples) && ARRAY_RESERVE(&t->twice, samples);
}

bool fit_targets_set(struct fit_targets *targets, struct fit_sample *sample,
                     size_t samples, const double *limit, double tolerance) {
  if (samples < SAMPLES_MIN)
    return true;
  if (!reserve(targets, samples))
    return false;
  const struct smoothing s = {targets,
                              sample,
                              samples,
                              limit,
                              sample[samples - 1].along - sample[0].along,
                              tolerance};
  for (size_t i = 0; i < samples; i++)
    targets->line.item[i] = sample[i].at;
  size_t counted = count_samples(&s);
  double window = fmin(WINDOW_TOLERANCES * tolerance, s.length / 2);
  for (; counted > 0 && window > tolerance; window /= WINDOW_RATIO) {
    if (!poll_now())
      return false;
    if ((double)smooth_by(&s, window) <= BEYOND_SHARE * (double)counted)
      return true;
  }
  for (size_t i = 1; i + 1 < samples; i++)
    sample[i].target = sample[i].at;
  return true;
}

void fit_targets_fini(struct fit_targets *targets) {
  ARRAY_FREE(&targets->line);
  ARRAY_FREE(&targets->integral);
  ARRAY_FREE(&targets->mean);
  ARRAY_FREE(&targets->twice);
}
