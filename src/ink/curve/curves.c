/* curves.c - fits curves to the smooth parts of strokes.
 *
 * Phases
 *   1 find the corners and straight sides of a stroke (stroke_shape.c)
 *   2 sample each smooth part between them, with the distance at each sample
 *     that keeps a curve clear of other ink (curve_samples.c); where the part
 *     touches or crosses other ink, the curve is to pass
 *   3 replace as much of the part as one cubic fits (cubic_fit.c), and go on
 *     from there in the same direction
 * Cost  near linear in the samples: the number of sides tried at once doubles
 *   until it fits no longer, and then is halved. */
#include "ink/curve/curves.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "base/tolerance.h"
#include "ink/curve/curve_samples.h"

/* Parts of one stroke that are farther apart along it than so many tolerances
 * are to keep clear of each other. */
#define APART_TOLERANCES 8

/* Numbers of sides that are tried in vain before a curve is given up. */
enum { FAILURES_MAX = 3 };

/* The most sides that are tried at once, which bounds the time of a trial. */
enum { KNOTS_MAX = 1 << 11 };

/* Sides between two polls: each takes some microseconds. */
enum { SIDES_A_POLL = 1 << 10 };

/* The points that a curve adds to a file, where a side adds one; and one more,
 * that it is worth while. */
enum { CURVE_POINTS = 4 };

/* The share of a line's width that lies under its ink whichever way it is
 * drawn, on either side: less than a half, for what viewers round. */
#define INK_SHARE 0.4

/* How far about a knot its direction is looked for: after a straight piece, as
 * a multiple of the tolerance; where a ring begins, as a share of it. */
#define LINE_DIRECTION 16
#define RING_SHARE (1 / 16.0)

struct curves {
  struct drawing *drawing;
  double whole_tolerance; /* mm, of all strokes, at most */
  double tolerance;       /* of the current stroke */
  bool has_areas;         /* fills or hatching, which end at lines */
  struct clearance clearance;
  struct stroke_shape shape; /* of the current stroke */
  struct curve_samples of;   /* of its current part */
  size_t sides;              /* since the last poll */
  bool has_curves;           /* in the current stroke, so far */
  ARRAY(double) parameter;   /* memory for one a sample */
};

/* ---- Curves -------------------------------------------------------------- */

static bool add_curve_piece(struct curves *c,
                            const struct drawing_point piece[4]) {
  return ARRAY_PUSH(&c->drawing->control, piece[1]) &&
         ARRAY_PUSH(&c->drawing->control, piece[2]) &&
         ARRAY_PUSH(&c->drawing->control, piece[3]);
}

static bool add_line(struct curves *c, struct drawing_point from,
                     struct drawing_point to) {
  return add_curve_piece(c, (struct drawing_point[4]){from, from, to, to});
}

/* The sample `knots` knots after `from`, but not past one where other ink is
 * met, or the last one. */
static size_t find_knot(const struct curves *c, size_t from, size_t knots) {
  size_t i = from, last = c->of.sample.count - 1;
  while (knots > 0 && i < last) {
    i++;
    knots -= c->of.flags.item[i] != 0;
    if (c->of.flags.item[i] & CURVE_MEETING)
      break;
  }
  return i;
}

/* A piece that was fitted, with its directions. */
struct fitted_piece {
  struct drawing_point control[4];
  struct drawing_point start, end;
};

/* The directions, unit vectors, in which a smooth part begins and ends; (0, 0)
 * where nothing prescribes one. */
struct part_ends {
  struct drawing_point start, end;
};

/* The unit vector from one point towards another one. */
static struct drawing_point unit_towards(struct drawing_point a,
                                         struct drawing_point b) {
  double length = drawing_distance(a, b);
  return length > 0 ? (struct drawing_point){(b.x - a.x) / length,
                                             (b.y - a.y) / length}
                    : (struct drawing_point){1, 0};
}

/* The direction of the part at a sample, from the samples within `before` mm
 * before it and `after` mm after it: that of the parabola through it that is
 * nearest to them by least squares. */
static struct drawing_point find_direction(const struct curves *c, size_t at,
                                           double before, double after) {
  const struct fit_sample *sample = c->of.sample.item, *here = &sample[at];
  double s2 = 0, s3 = 0, s4 = 0, x1 = 0, x2 = 0, y1 = 0, y2 = 0;
  size_t low = at, high = at, last = c->of.sample.count - 1;
  while (low > 0 && here->along - sample[low - 1].along <= before)
    low--;
  while (high < last && sample[high + 1].along - here->along <= after)
    high++;
  if (low == at && before > 0 && low > 0) /* one at least */
    low--;
  if (high == at && after > 0 && high < last)
    high++;
  for (size_t i = low; i <= high; i++) {
    double s = sample[i].along - here->along;
    double x = sample[i].target.x - here->target.x;
    double y = sample[i].target.y - here->target.y;
    s2 += s * s;
    s3 += s * s * s;
    s4 += s * s * s * s;
    x1 += s * x;
    x2 += s * s * x;
    y1 += s * y;
    y2 += s * s * y;
  }
  double determinant = s2 * s4 - s3 * s3;
  struct drawing_point run = {x1, y1};
  if (determinant > TOLERANCE_PARABOLA_SHARE * s2 * s4)
    run = (struct drawing_point){s4 * x1 - s3 * x2, s4 * y1 - s3 * y2};
  return unit_towards((struct drawing_point){0, 0}, run);
}

static bool is_prescribed(struct drawing_point direction) {
  return direction.x != 0 || direction.y != 0;
}

/* Fits a piece.  What is not prescribed follows from its length: the longer
 * it is, the less may its ends follow the noise of single sides.
 * piece  its start is (0, 0) if that is not prescribed */
static bool fit(struct curves *c, const struct part_ends *ends, size_t from,
                size_t to, struct fitted_piece *piece) {
  size_t last = c->of.sample.count - 1;
  double length = c->of.sample.item[to].along - c->of.sample.item[from].along;
  struct drawing_point start = piece->start;
  if (!is_prescribed(start))
    start = find_direction(c, from, 0, length / 2);
  if (to < last)
    piece->end = find_direction(c, to, length / 4, length / 4);
  else if (is_prescribed(ends->end))
    piece->end = ends->end;
  else
    piece->end = find_direction(c, to, length / 2, 0);
  const struct cubic_fit problem = {
      .sample = &c->of.sample.item[from],
      .samples = to - from + 1,
      .tolerance = c->tolerance,
      .start = start,
      .end = piece->end,
      .end_limit = to < last ? fit_targets_limit(&c->of.targets, to) : 0};
  if (!cubic_fit(&problem, c->parameter.item, piece->control))
    return false;
  if (to < last)
    piece->end = unit_towards(piece->control[2], piece->control[3]);
  return true;
}

/* Finds the most knots after `from` that one curve passes.  Returns the last of
 * them; `from` where there is no curve. */
static size_t find_longest(struct curves *c, const struct part_ends *ends,
                           size_t from, struct fitted_piece *piece) {
  struct fitted_piece trial = *piece;
  size_t best = from, good = 0, bad = 0, before = from;
  int failures = 0;
  for (size_t knots = 1; failures < FAILURES_MAX && knots <= KNOTS_MAX;
       knots *= 2) {
    size_t to = find_knot(c, from, knots);
    if (to == before)
      break;
    before = to;
    if (fit(c, ends, from, to, &trial)) {
      *piece = trial;
      best = to;
      good = knots;
      bad = 0;
      failures = 0;
    } else {
      bad = failures++ == 0 ? knots : bad;
    }
  }
  while (good > 0 && bad > good + 1) {
    size_t knots = good + (bad - good) / 2, to = find_knot(c, from, knots);
    if (to > best && fit(c, ends, from, to, &trial)) {
      *piece = trial;
      best = to;
      good = knots;
    } else {
      bad = knots;
    }
  }
  return best;
}

/* How many sides of the stroke end between two samples. */
static size_t count_part_sides(const struct curves *c, size_t from, size_t to) {
  size_t sides = 0;
  for (size_t i = from + 1; i <= to; i++)
    sides += c->of.flags.item[i] & CURVE_VERTEX;
  return sides;
}

/* Adds the line between two samples; from the middle of a side it extends the
 * line before it. */
static bool add_line_on(struct curves *c, size_t from, size_t to,
                        bool after_line) {
  struct drawing_point end = c->of.sample.item[to].target;
  if (!after_line || (c->of.flags.item[from] & CURVE_VERTEX))
    return add_line(c, c->of.sample.item[from].target, end);
  struct drawing_point *past =
      ARRAY_AT(&c->drawing->control, c->drawing->control.count);
  past[-1] = past[-2] = end;
  return true;
}

/* Fits curves as long as the part does not get more points by them. */
static bool fit_part(struct curves *c, const struct part_ends *ends) {
  size_t at = 0, last = c->of.sample.count - 1, saved = 0;
  struct fitted_piece piece = {.start = ends->start};
  bool ok = true, after_line = false;
  while (ok && at < last) {
    size_t to = find_longest(c, ends, at, &piece);
    size_t points = saved + count_part_sides(c, at, to);
    bool is_curve = to > at && points >= CURVE_POINTS;
    if (is_curve) {
      saved = points - CURVE_POINTS;
      c->has_curves = true;
      c->of.sample.item[to].target = piece.control[3];
      ok = add_curve_piece(c, piece.control);
    } else {
      double reach = LINE_DIRECTION * c->tolerance;
      to = find_knot(c, at, 1);
      c->of.sample.item[to].target = c->of.sample.item[to].at;
      ok = add_line_on(c, at, to, after_line);
      piece.end = find_direction(c, to, reach, reach);
    }
    after_line = !is_curve;
    piece.start = piece.end;
    at = to;
  }
  return ok;
}

/* ---- Strokes ------------------------------------------------------------- */

/* Fills and hatching end at the polyline; so that none ends beside the curve's
 * ink the curve keeps that within its own width. */
static double tolerance_of_stroke(const struct curves *c,
                                  const struct drawing_stroke *stroke) {
  double covered = INK_SHARE * drawing_width_mm(c->drawing, stroke);
  return c->has_areas && covered > 0 ? fmin(c->whole_tolerance, covered)
                                     : c->whole_tolerance;
}

static bool has_areas(const struct drawing *drawing) {
  bool any = drawing->fill.count > 0;
  for (size_t i = 0; !any && i < drawing->stroke.count; i++)
    any = drawing->stroke.item[i].edge_class == 0 &&
          !drawing->stroke.item[i].text;
  return any;
}

/* The vertex where the smooth part that begins at a vertex ends. */
static size_t find_part_end(const struct stroke_shape *shape, size_t from) {
  const struct stroke_vertex *v = shape->vertex.item;
  size_t i = from + 1;
  while (i + 1 < shape->vertex.count && !v[i].corner && !v[i].straight)
    i++;
  return i;
}

/* A smooth part that ends at a straight side without a corner ends in its
 * direction.  One that begins at the first vertex has no such side before it;
 * a ring ends as it begins. */
static struct part_ends find_ends(const struct curves *c, size_t from,
                                  size_t to) {
  const struct stroke_shape *shape = &c->shape;
  const struct stroke_vertex *v = shape->vertex.item;
  size_t side = to + 1 == shape->vertex.count && shape->closed ? 0 : to;
  struct part_ends ends = {{0, 0}, {0, 0}};
  if (from > 0 && v[from - 1].straight && !v[from].corner)
    ends.start = stroke_shape_side(shape, from - 1);
  if (side + 1 < shape->vertex.count && v[side].straight && !v[to].corner)
    ends.end = stroke_shape_side(shape, side);
  if (shape->ring) {
    double reach = RING_SHARE * shape->length;
    struct drawing_point a = find_direction(c, 0, 0, reach);
    struct drawing_point b =
        find_direction(c, c->of.sample.count - 1, reach, 0);
    double length = hypot(a.x + b.x, a.y + b.y);
    if (length > 0)
      ends.start = ends.end =
          (struct drawing_point){(a.x + b.x) / length, (a.y + b.y) / length};
  }
  return ends;
}

static bool sample_part(struct curves *c, size_t from, size_t to) {
  return curve_samples_take(&c->of, &c->clearance, &c->shape, from, to,
                            c->tolerance) &&
         ARRAY_RESERVE(&c->parameter, c->of.sample.count);
}

static bool add_lines(struct curves *c, size_t from, size_t to) {
  const struct stroke_vertex *v = c->shape.vertex.item;
  bool ok = true;
  for (size_t i = from; ok && i < to; i++)
    ok = add_line(c, v[i].at, v[i + 1].at);
  return ok;
}

static bool add_part(struct curves *c, size_t from, size_t to) {
  if (to - from < CURVE_POINTS)
    return add_lines(c, from, to);
  if (!sample_part(c, from, to))
    return false;
  struct part_ends ends = find_ends(c, from, to);
  return fit_part(c, &ends);
}

/* Appends the pieces of the shape. */
static bool add_shape_pieces(struct curves *c) {
  const struct stroke_vertex *v = c->shape.vertex.item;
  bool ok = ARRAY_PUSH(&c->drawing->control, v[0].at);
  for (size_t i = 0, to; ok && i + 1 < c->shape.vertex.count; i = to) {
    to = v[i].straight ? i + 1 : find_part_end(&c->shape, i);
    ok = add_part(c, i, to);
  }
  return ok;
}

static bool fit_stroke(struct curves *c, uint32_t index) {
  struct drawing *drawing = c->drawing;
  const struct drawing_stroke *stroke = &drawing->stroke.item[index];
  struct drawing_curve curve = {(uint32_t)drawing->control.count, 0};
  c->has_curves = false;
  c->tolerance = tolerance_of_stroke(c, stroke);
  if (stroke->count > 2) {
    if (!stroke_shape_find(&c->shape, drawing->point.item + stroke->point,
                           stroke->count, stroke->closed, c->tolerance))
      return false;
    c->of.place = (struct clearance_place){
        .stroke = index,
        .start = c->shape.start,
        .whole = stroke->closed ? c->shape.length : INFINITY};
    if (c->shape.vertex.count > 2 && !add_shape_pieces(c))
      return false;
  }
  if (!c->has_curves)
    drawing->control.count = curve.control;
  else if (drawing->control.count > UINT32_MAX)
    return false;
  else
    curve.count = (uint32_t)drawing->control.count - curve.control;
  return ARRAY_PUSH(&drawing->curve, curve);
}

/* Polls if so many sides more make it time. */
static bool poll_sides(struct curves *c, size_t sides) {
  c->sides += sides;
  if (c->sides < SIDES_A_POLL)
    return true;
  c->sides = 0;
  return poll_now();
}

bool curves_fit(struct drawing *drawing, double tolerance) {
  tolerance = fmin(tolerance, fmax(drawing->width_mm, drawing->height_mm));
  struct curves c = {.drawing = drawing,
                     .whole_tolerance = tolerance,
                     .has_areas = has_areas(drawing)};
  bool ok =
      clearance_init(&c.clearance, drawing, tolerance / CURVE_CLEARANCE_SHARE,
                     APART_TOLERANCES * tolerance);
  for (size_t i = 0; ok && i < drawing->stroke.count; i++)
    ok = poll_sides(&c, drawing->stroke.item[i].count) &&
         fit_stroke(&c, (uint32_t)i);
  clearance_fini(&c.clearance);
  stroke_shape_fini(&c.shape);
  curve_samples_fini(&c.of);
  ARRAY_FREE(&c.parameter);
  return ok;
}
