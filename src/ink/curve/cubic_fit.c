/* cubic_fit.c - least squares over the handles of a cubic Bezier curve.
 *
 * Robustness  A handle that least squares make negative, or longer than the
 *   polyline, is a third of the chord instead.  Whether a curve is accepted is
 *   decided by its distance from the samples alone, however it was found. */
#include "ink/curve/cubic_fit.h"

#include <math.h>

#include "base/tolerance.h"
#include "geom/nearest.h"

/* How often the parameters are improved: more rarely turns a curve that is
 * outside the tolerance into one that is inside. */
enum { ROUNDS = 6 };

/* The sine of the largest angle by which rounding may turn a handle, 0.9
 * degrees, and a number of decimals beyond those that are tried. */
#define TURN_MAX (1 / 64.0)
#define DECIMALS_TRIED 2.5

typedef struct drawing_point point;

static point point_sum(point a, point b) {
  return (point){a.x + b.x, a.y + b.y};
}

static point point_difference(point a, point b) {
  return (point){a.x - b.x, a.y - b.y};
}

static point point_scaled(point a, double by) {
  return (point){a.x * by, a.y * by};
}

static double point_dot(point a, point b) { return a.x * b.x + a.y * b.y; }

/* ---- The curve ----------------------------------------------------------- */

static point cubic_position(const point p[4], double t) {
  double s = 1 - t;
  return point_sum(point_sum(point_scaled(p[0], s * s * s),
                             point_scaled(p[1], 3 * s * s * t)),
                   point_sum(point_scaled(p[2], 3 * s * t * t),
                             point_scaled(p[3], t * t * t)));
}

static point first_derivative(const point p[4], double t) {
  double s = 1 - t;
  return point_scaled(
      point_sum(
          point_sum(point_scaled(point_difference(p[1], p[0]), s * s),
                    point_scaled(point_difference(p[2], p[1]), 2 * s * t)),
          point_scaled(point_difference(p[3], p[2]), t * t)),
      3);
}

static point second_derivative(const point p[4], double t) {
  point a =
      point_sum(point_difference(p[0], p[1]), point_difference(p[2], p[1]));
  point b =
      point_sum(point_difference(p[1], p[2]), point_difference(p[3], p[2]));
  return point_sum(point_scaled(a, 6 * (1 - t)), point_scaled(b, 6 * t));
}

/* ---- Least squares ------------------------------------------------------- */

/* Sets the handles to the lengths that minimise the weighted squares of the
 * distances between the targets and the curve at their parameters. */
static void set_handles(const struct cubic_fit *fit, const double *t,
                        point c[4]) {
  const struct fit_sample *sample = fit->sample;
  size_t samples = fit->samples;
  double a00 = 0, a01 = 0, a11 = 0, b0 = 0, b1 = 0;
  for (size_t i = 1; i + 1 < samples; i++) {
    double s = 1 - t[i], u = t[i];
    double distance =
        fmax(fmin(sample[i].from, sample[i - 1].to), TOLERANCE_FIT_WEIGHT_MM);
    double weight = 1 / (distance * distance);
    double near = s * s * s + 3 * s * s * u, far = 3 * s * u * u + u * u * u;
    point one = point_scaled(fit->start, 3 * s * s * u),
          two = point_scaled(fit->end, -3 * s * u * u);
    point rest =
        point_difference(sample[i].target, point_sum(point_scaled(c[0], near),
                                                     point_scaled(c[3], far)));
    a00 += weight * point_dot(one, one);
    a01 += weight * point_dot(one, two);
    a11 += weight * point_dot(two, two);
    b0 += weight * point_dot(one, rest);
    b1 += weight * point_dot(two, rest);
  }
  double determinant = a00 * a11 - a01 * a01;
  double length = sample[samples - 1].along - sample[0].along;
  double third = sqrt(point_dot(point_difference(c[3], c[0]),
                                point_difference(c[3], c[0]))) /
                 3;
  double first = (b0 * a11 - b1 * a01) / determinant;
  double last = (b1 * a00 - b0 * a01) / determinant;
  if (!(first > 0 && first <= length && last > 0 && last <= length))
    first = last = third;
  c[1] = point_sum(c[0], point_scaled(fit->start, first));
  c[2] = point_sum(c[3], point_scaled(fit->end, -last));
}

/* Moves each parameter towards that of the point of the curve that is nearest
 * to the target, by a step of Newton's method. */
static void improve_parameters(const struct fit_sample *sample, size_t samples,
                               const point c[4], double *t) {
  for (size_t i = 1; i + 1 < samples; i++) {
    point off = point_difference(cubic_position(c, t[i]), sample[i].target);
    point d1 = first_derivative(c, t[i]), d2 = second_derivative(c, t[i]);
    double slope = point_dot(d1, d1) + point_dot(off, d2);
    if (slope > 0)
      t[i] = fmin(fmax(t[i] - point_dot(off, d1) / slope, 0), 1);
  }
}

/* ---- The distance -------------------------------------------------------- */

/* The value at s, t and u of the symmetric function that is linear in each of
 * them and is the curve where all are equal: its blossom. */
static point blossom(const point p[4], double s, double t, double u) {
  point a[3], b[2];
  for (int i = 0; i < 3; i++)
    a[i] = point_sum(point_scaled(p[i], 1 - s), point_scaled(p[i + 1], s));
  for (int i = 0; i < 2; i++)
    b[i] = point_sum(point_scaled(a[i], 1 - t), point_scaled(a[i + 1], t));
  return point_sum(point_scaled(b[0], 1 - u), point_scaled(b[1], u));
}

/* The line from a sample to the next one, and how far from its ends a curve may
 * be, mm. */
struct fit_side {
  point at, run;
  double length2, from, to;
};

static struct fit_side side_after(const struct fit_sample *sample,
                                  double tolerance) {
  struct fit_side side = {.at = sample[0].at,
                          .run = point_difference(sample[1].at, sample->at)};
  double from = sample->from, to = sample->to;
  side.length2 = point_dot(side.run, side.run);
  side.from = from < tolerance ? from : tolerance;
  side.to = to < tolerance ? to : tolerance;
  return side;
}

/* Whether a point is as near to the line as is allowed beside its place along
 * it.  That is so in a convex set, as the distance is a convex function of the
 * point and what is allowed a concave one. */
static bool is_allowed_beside(const struct fit_side *side, point p) {
  point off = point_difference(p, side->at);
  double along = point_dot(side->run, off);
  double place = side->length2 > 0 ? along / side->length2 : 0;
  double t = !(place > 0) ? 0 : place < 1 ? place : 1;
  point rest = point_difference(off, point_scaled(side->run, t));
  double most = side->from > side->to ? side->from : side->to;
  double allowed = side->from + place * (side->to - side->from);
  allowed = (allowed < most ? allowed : most) + TOLERANCE_FIT_ROUNDING_MM;
  return allowed >= 0 && point_dot(rest, rest) <= allowed * allowed;
}

/* Whether the curve keeps within the distances, in the samples' order, and
 * within the tolerance of each sample: between the parameters of two samples it
 * does if the control points of that part do. */
static bool keeps_within(const struct fit_sample *sample, size_t samples,
                         double tolerance, const double *t, const point c[4]) {
  point start = c[0];
  for (size_t i = 0; i + 1 < samples; i++) {
    double p = t[i], q = t[i + 1];
    if (q <= p)
      return false;
    const point part[4] = {start, blossom(c, p, p, q), blossom(c, p, q, q),
                           blossom(c, q, q, q)};
    if (drawing_distance(part[0], sample[i].at) > tolerance)
      return false;
    const struct fit_side side = side_after(&sample[i], tolerance);
    for (int k = 0; k < 4; k++)
      if (!is_allowed_beside(&side, part[k]))
        return false;
    start = part[3];
  }
  return true;
}

/* ---- Rounding ------------------------------------------------------------ */

/* The point with offsets from another one that are multiples of the step. */
static point round_from(point origin, point p, double step) {
  return (point){origin.x + step * round((p.x - origin.x) / step),
                 origin.y + step * round((p.y - origin.y) / step)};
}

/* The same of a point that has been moved from its place, back towards that. */
static point round_back(point origin, point p, point place, double step) {
  point q = {(p.x - origin.x) / step, (p.y - origin.y) / step};
  q.x = p.x > place.x ? floor(q.x) : ceil(q.x);
  q.y = p.y > place.y ? floor(q.y) : ceil(q.y);
  return point_sum(origin, point_scaled(q, step));
}

static bool is_turned_little(point before, point after) {
  double across = before.x * after.y - before.y * after.x;
  return fabs(across) <= TURN_MAX * point_dot(before, after);
}

/* Puts a rounded curve in the place of one if it keeps within the distances,
 * too, and its handles hardly turn.  Returns whether it does. */
static bool accept_rounded(const struct cubic_fit *fit, const double *t,
                           const point rounded[4], point curve[4]) {
  bool ok = is_turned_little(point_difference(curve[1], curve[0]),
                             point_difference(rounded[1], rounded[0])) &&
            is_turned_little(point_difference(curve[3], curve[2]),
                             point_difference(rounded[3], rounded[2])) &&
            keeps_within(fit->sample, fit->samples, fit->tolerance, t, rounded);
  for (int i = 1; ok && i < 4; i++)
    curve[i] = rounded[i];
  return ok;
}

static bool round_handles(const struct cubic_fit *fit, const double *t,
                          double step, point curve[4]) {
  const point rounded[4] = {curve[0], round_from(curve[0], curve[1], step),
                            round_from(curve[0], curve[2], step), curve[3]};
  return accept_rounded(fit, t, rounded, curve);
}

static bool round_end(const struct cubic_fit *fit, const double *t, double step,
                      point curve[4]) {
  point place = fit->sample[fit->samples - 1].at;
  point end = round_from(curve[0], curve[3], step);
  if (drawing_distance(end, place) > fit->end_limit)
    end = round_back(curve[0], curve[3], place, step);
  const point rounded[4] = {curve[0], curve[1], curve[2], end};
  return drawing_distance(end, place) <= fit->end_limit &&
         accept_rounded(fit, t, rounded, curve);
}

/* A curve whose handles are both at one end is a line, as others are. */
static void make_straight(point curve[4]) {
  double start = drawing_distance(curve[1], curve[0]);
  double end = drawing_distance(curve[2], curve[3]);
  if (start == 0 && drawing_distance(curve[2], curve[0]) == 0)
    curve[2] = curve[3];
  else if (end == 0 && drawing_distance(curve[1], curve[3]) == 0)
    curve[1] = curve[0];
}

/* Rounds the handles of a curve, and its end if that may move, to the fewest
 * decimals that are within the distances.  As they are offsets from its start,
 * the output may round that as it likes: what is relative to it stays short. */
static void round_curve(const struct cubic_fit *fit, const double *t,
                        point curve[4]) {
  double most = pow(10, floor(log10(fit->tolerance)));
  double least = most * pow(10, -DECIMALS_TRIED);
  for (double step = most; step > least; step /= 10)
    if (round_handles(fit, t, step, curve))
      break;
  for (double step = most; fit->end_limit > 0 && step > least; step /= 10)
    if (round_end(fit, t, step, curve))
      break;
  make_straight(curve);
}

/* ---- The whole ----------------------------------------------------------- */

bool cubic_fit(const struct cubic_fit *fit, double *t, point curve[4]) {
  const struct fit_sample *sample = fit->sample;
  size_t samples = fit->samples;
  double from = sample[0].along, to = sample[samples - 1].along;
  for (size_t i = 0; i < samples; i++)
    t[i] = (sample[i].along - from) / (to - from);
  curve[0] = sample[0].target;
  curve[3] = sample[samples - 1].target;
  for (int round = 0; round < ROUNDS; round++) {
    set_handles(fit, t, curve);
    if (keeps_within(sample, samples, fit->tolerance, t, curve)) {
      round_curve(fit, t, curve);
      return true;
    }
    improve_parameters(sample, samples, curve, t);
  }
  return false;
}

/* ---- Lines --------------------------------------------------------------- */

/* Sets the parameters of the samples to those of the points of a line that are
 * nearest to them. */
static void set_line_parameters(const struct cubic_fit *fit,
                                const point line[4], double *t) {
  size_t last = fit->samples - 1;
  point run = point_difference(line[3], line[0]);
  for (size_t i = 1; i < last; i++) {
    point off = point_difference(fit->sample[i].at, line[0]);
    t[i] = geom_nearest_parameter(run.x, run.y, off.x, off.y);
  }
  t[0] = 0;
  t[last] = 1;
}

/* Puts a line to that end in the place of the one so far, if it keeps within
 * the distances. */
static bool accept_line(const struct cubic_fit *fit, double *t, point end,
                        point line[4]) {
  point run = point_difference(end, line[0]);
  const point trial[4] = {line[0],
                          point_sum(line[0], point_scaled(run, 1 / 3.0)),
                          point_sum(line[0], point_scaled(run, 2 / 3.0)), end};
  set_line_parameters(fit, trial, t);
  if (!keeps_within(fit->sample, fit->samples, fit->tolerance, t, trial))
    return false;
  line[1] = line[0];
  line[2] = line[3] = end;
  return true;
}

static bool round_line(const struct cubic_fit *fit, double *t, double step,
                       point line[4]) {
  point place = fit->sample[fit->samples - 1].at;
  point end = round_from(line[0], line[3], step);
  if (drawing_distance(end, place) > fit->end_limit)
    end = round_back(line[0], line[3], place, step);
  return drawing_distance(end, place) <= fit->end_limit &&
         is_turned_little(point_difference(line[3], line[0]),
                          point_difference(end, line[0])) &&
         accept_line(fit, t, end, line);
}

bool line_fit(const struct cubic_fit *fit, double *t, point line[4]) {
  const struct fit_sample *last = &fit->sample[fit->samples - 1];
  line[0] = fit->sample[0].target;
  if (!accept_line(fit, t, last->target, line) &&
      !accept_line(fit, t, last->at, line))
    return false;
  double most = pow(10, floor(log10(fit->tolerance)));
  double least = most * pow(10, -DECIMALS_TRIED);
  for (double step = most; fit->end_limit > 0 && step > least; step /= 10)
    if (round_line(fit, t, step, line))
      break;
  return true;
}
