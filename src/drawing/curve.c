/* curve.c - the curves of strokes, polylines near them, and where they turn. */
#include <math.h>

#include "base/tolerance.h"
#include "drawing/drawing.h"

const struct drawing_curve *drawing_curve_of(const struct drawing *drawing,
                                             size_t index) {
  if (index >= drawing->curve.count || drawing->curve.item[index].count == 0)
    return NULL;
  return &drawing->curve.item[index];
}

static bool coincide(struct drawing_point a, struct drawing_point b) {
  return a.x == b.x && a.y == b.y;
}

bool drawing_piece_is_straight(const struct drawing_point control[4]) {
  return coincide(control[0], control[1]) && coincide(control[2], control[3]);
}

/* How many chords of equal parameter lie within `distance` of the piece: the
 * square of their number times 4/3 of the distance is the longest second
 * difference of the control points. */
static uint32_t count_chords(const struct drawing_point p[4], double distance) {
  enum { CHORDS_MAX = 1 << 12 };
  double a = hypot(p[0].x - 2 * p[1].x + p[2].x, p[0].y - 2 * p[1].y + p[2].y);
  double b = hypot(p[1].x - 2 * p[2].x + p[3].x, p[1].y - 2 * p[2].y + p[3].y);
  if (drawing_piece_is_straight(p))
    return 1;
  double chords = ceil(sqrt(0.75 * fmax(a, b) / distance));
  return chords < 1 ? 1 : chords < CHORDS_MAX ? (uint32_t)chords : CHORDS_MAX;
}

static double bezier(double a, double b, double c, double d, double t) {
  double s = 1 - t;
  return s * s * (s * a + 3 * t * b) + t * t * (3 * s * c + t * d);
}

static struct drawing_point point_of_piece(const struct drawing_point p[4],
                                           double t) {
  return (struct drawing_point){bezier(p[0].x, p[1].x, p[2].x, p[3].x, t),
                                bezier(p[0].y, p[1].y, p[2].y, p[3].y, t)};
}

static double coordinate(const struct drawing_point *point, int axis) {
  return axis == 0 ? point->x : point->y;
}

/* The parameters at which a t^2 + 2 b t + c is 0, which may be infinite or no
 * numbers.  Neither root is a difference of nearly equal numbers. */
static void solve_quadratic(double a, double b, double c, double root[2]) {
  double q = -b - copysign(sqrt(b * b - a * c), b);
  root[0] = a != 0 ? q / a : INFINITY;
  root[1] = q != 0 ? c / q : INFINITY;
}

int drawing_piece_extrema(const struct drawing_point p[4],
                          struct drawing_point extremum[4]) {
  int count = 0;
  for (int axis = 0; axis < 2; axis++) {
    double step[3], root[2];
    for (int k = 0; k < 3; k++)
      step[k] = coordinate(&p[k + 1], axis) - coordinate(&p[k], axis);
    solve_quadratic(step[0] - 2 * step[1] + step[2], step[1] - step[0], step[0],
                    root);
    for (int k = 0; k < 2; k++)
      if (root[k] > 0 && root[k] < 1)
        extremum[count++] = point_of_piece(p, root[k]);
  }
  return count;
}

static bool add_chords(const struct drawing_point p[4], double distance,
                       struct drawing_polyline *line) {
  uint32_t chords = count_chords(p, distance);
  for (uint32_t i = 1; i < chords; i++) {
    struct drawing_point at = point_of_piece(p, i / (double)chords);
    if (!ARRAY_PUSH(&line->point, at))
      return false;
  }
  return ARRAY_PUSH(&line->point, p[3]);
}

bool drawing_flatten(const struct drawing *drawing,
                     const struct drawing_stroke *stroke,
                     const struct drawing_curve *curve, double distance,
                     struct drawing_polyline *line) {
  const struct drawing_point *control = drawing->control.item + curve->control;
  line->point.count = 0;
  bool ok = ARRAY_PUSH(&line->point, control[0]);
  for (uint32_t i = 0; ok && i + 3 < curve->count; i += 3)
    ok = add_chords(control + i, distance, line);
  if (ok && stroke->closed)
    line->point.count--;
  return ok;
}

bool drawing_add_arc(struct drawing *drawing,
                     const struct drawing_circle *circle, double from,
                     double to) {
  double share = fmin(TOLERANCE_ARC_MM / circle->radius, 1);
  int chords = (int)ceil((to - from) / (2 * acos(1 - share)));
  chords = chords > 1 ? chords : 1;
  bool ok = true;
  for (int i = 0; ok && i <= chords; i++) {
    double angle = from + (to - from) * i / chords;
    const struct drawing_point p = {circle->x + circle->radius * cos(angle),
                                    circle->y + circle->radius * sin(angle)};
    ok = ARRAY_PUSH(&drawing->point, p);
  }
  return ok;
}
