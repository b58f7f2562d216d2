/* curves.c - fits curves to the smooth parts of strokes.
 *
 * Phases
 *   1 find the corners and straight sides of a stroke (stroke_shape.c)
 *   2 sample it, with the distance at each sample that keeps a curve clear of
 *     other ink (curve_samples.c); where the stroke touches or crosses other
 *     ink, the curve is to pass
 *   3 replace each part between corners and straight sides, and each run of
 *     straight sides, by curves and lines (part_fit.c) */
#include "ink/curve/curves.h"

#include <math.h>

#include "base/poll.h"
#include "ink/curve/part_fit.h"
#include "ink/curve/stroke_loops.h"

/* Parts of one stroke that are farther apart along it than so many tolerances
 * are to keep clear of each other. */
#define APART_TOLERANCES 8

/* Sides between two polls: each takes some microseconds. */
enum { SIDES_A_POLL = 1 << 10 };

/* The share of a line's width that lies under its ink whichever way it is
 * drawn, on either side: less than a half, for what viewers round. */
#define INK_SHARE 0.4

/* How far about the point where a ring begins its direction is looked for, as a
 * share of its length. */
#define RING_SHARE (1 / 16.0)

/* How far from a crossing that a curve would change vertices stay, at first, as
 * a multiple of the tolerance; and how often that is doubled before the stroke
 * stays as it is. */
#define STAY_TOLERANCES 2
enum { ROUNDS_MAX = 6 };

struct curves {
  struct drawing *drawing;
  double whole_tolerance; /* mm, of all strokes, at most */
  bool has_areas;         /* fills or hatching, which end at lines */
  struct clearance clearance;
  struct stroke_shape shape; /* of the current stroke */
  struct part_fit pieces;
  struct stroke_loops loops;
  size_t sides; /* since the last poll */
};

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

/* The vertex where the part that begins at a vertex ends: smooth up to a corner
 * or a straight side, or straight sides up to a corner or a smooth part. */
static size_t find_part_end(const struct stroke_shape *shape, size_t from) {
  const struct stroke_vertex *v = shape->vertex.item;
  size_t i = from + 1;
  while (i + 1 < shape->vertex.count && !v[i].corner &&
         v[i].straight == v[from].straight)
    i++;
  return i;
}

/* A smooth part that ends at a straight side without a corner ends in its
 * direction.  One that begins at the first vertex has no such side before it;
 * a ring ends as it begins. */
static void prescribe_ends(const struct curves *c, size_t from, size_t to,
                           struct stroke_part *part) {
  const struct stroke_shape *shape = &c->shape;
  const struct curve_samples *of = &c->pieces.of;
  const struct stroke_vertex *v = shape->vertex.item;
  size_t side = to + 1 == shape->vertex.count && shape->closed ? 0 : to;
  if (from > 0 && v[from - 1].straight && !v[from].corner)
    part->start = stroke_shape_side(shape, from - 1);
  if (side + 1 < shape->vertex.count && v[side].straight && !v[to].corner)
    part->end = stroke_shape_side(shape, side);
  if (shape->ring) {
    double reach = RING_SHARE * shape->length;
    struct drawing_point a = part_fit_direction(of, part, part->from, 0, reach);
    struct drawing_point b = part_fit_direction(of, part, part->to, reach, 0);
    double length = hypot(a.x + b.x, a.y + b.y);
    if (length > 0)
      part->start = part->end =
          (struct drawing_point){(a.x + b.x) / length, (a.y + b.y) / length};
  }
}

static bool add_part(struct curves *c, size_t from, size_t to) {
  struct curve_samples *of = &c->pieces.of;
  struct stroke_part part = {.from = of->of_vertex.item[from],
                             .to = of->of_vertex.item[to],
                             .straight = c->shape.vertex.item[from].straight};
  if (!part.straight) {
    if (!fit_targets_set(&of->targets, &of->sample.item[part.from],
                         part.to - part.from + 1, &of->limit.item[part.from],
                         c->pieces.tolerance))
      return false;
    prescribe_ends(c, from, to, &part);
  }
  return part_fit_add(&c->pieces, &part);
}

/* Appends the pieces of the shape. */
static bool add_shape_pieces(struct curves *c) {
  struct curve_samples *of = &c->pieces.of;
  const struct stroke_vertex *v = c->shape.vertex.item;
  bool ok =
      curve_samples_take(of, &c->clearance, &c->shape, c->pieces.tolerance) &&
      ARRAY_RESERVE(&c->pieces.parameter, of->sample.count) &&
      ARRAY_PUSH(&c->drawing->control, v[0].at);
  for (size_t i = 0, to; ok && i + 1 < c->shape.vertex.count; i = to) {
    to = find_part_end(&c->shape, i);
    ok = add_part(c, i, to);
  }
  return ok;
}

/* Whether all vertices of the shape but its ends are corners, which stay. */
static bool has_only_corners(const struct stroke_shape *shape) {
  size_t i = 1;
  while (i + 1 < shape->vertex.count && shape->vertex.item[i].corner)
    i++;
  return i + 1 >= shape->vertex.count;
}

/* Appends the pieces of the shape, if there are curves among them; more of its
 * vertices stay until they cross themselves where the stroke does. */
static bool fit_shape(struct curves *c) {
  struct drawing *drawing = c->drawing;
  size_t control = drawing->control.count;
  bool ok = true, same = false;
  for (int round = 0; ok && !same && round < ROUNDS_MAX; round++) {
    drawing->control.count = control;
    c->pieces.along.count = 0;
    c->pieces.has_curves = false;
    same = has_only_corners(&c->shape);
    ok = same || add_shape_pieces(c);
    if (ok && !same && c->pieces.has_curves)
      ok = stroke_loops_keep(
          &c->loops, &c->shape, &c->pieces, control,
          STAY_TOLERANCES * ldexp(c->pieces.tolerance, round), &same);
    else
      same = true;
  }
  c->pieces.has_curves = c->pieces.has_curves && same;
  return ok;
}

static bool fit_stroke(struct curves *c, uint32_t index) {
  struct drawing *drawing = c->drawing;
  const struct drawing_stroke *stroke = &drawing->stroke.item[index];
  struct drawing_curve curve = {(uint32_t)drawing->control.count, 0};
  c->pieces.has_curves = false;
  c->pieces.tolerance = tolerance_of_stroke(c, stroke);
  if (stroke->count > 2) {
    if (!stroke_shape_find(&c->shape, drawing->point.item + stroke->point,
                           stroke->count, stroke->closed, c->pieces.tolerance))
      return false;
    c->pieces.of.place = (struct clearance_place){
        .stroke = index,
        .start = c->shape.start,
        .whole = stroke->closed ? c->shape.length : INFINITY};
    if (!fit_shape(c))
      return false;
  }
  if (!c->pieces.has_curves)
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
                     .pieces = {.drawing = drawing},
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
  curve_samples_fini(&c.pieces.of);
  ARRAY_FREE(&c.pieces.along);
  ARRAY_FREE(&c.pieces.parameter);
  stroke_loops_fini(&c.loops);
  return ok;
}
