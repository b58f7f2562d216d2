/* stroke_shape.c - where a stroke bends, seen at the scale of a tolerance.
 *
 * A polyline within the tolerance of a smooth curve may zigzag.  So directions
 * are those of chords longer than the tolerance. */
#include "ink/curve/stroke_shape.h"

#include <math.h>

#include "base/sort.h"

/* A vertex is a corner where the chords to either side turn by more: 30
 * degrees.  The same as for dashes. */
#define CORNER_RADIANS (3.141592653589793 / 6)

/* How high the arc of a side may be, as a multiple of the tolerance: the curve
 * runs on both sides of the line, at its ends by half of the tolerance, as the
 * targets do (fit_targets.c). */
#define ARC_HEIGHT 1.5

/* The length of these chords as a multiple of the tolerance. */
#define CORNER_CHORD 4

static struct drawing_point run_from(struct drawing_point a,
                                     struct drawing_point b) {
  return (struct drawing_point){a.x - b.x, a.y - b.y};
}

/* The angle from direction a to direction b, radians, 0 to pi. */
static double turning_angle(struct drawing_point a, struct drawing_point b) {
  return fabs(atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y));
}

/* The point of the shape at `along` mm; of a closed one at any multiple of its
 * length as well. */
static struct drawing_point shape_point_at(const struct stroke_shape *shape,
                                           double along) {
  const struct stroke_vertex *v = shape->vertex.item;
  size_t i, last = shape->vertex.count - 1;
  if (shape->closed)
    along -= floor(along / shape->length) * shape->length;
  LOWER_BOUND(i, 1, last, v[i].along < along);
  double side = v[i].along - v[i - 1].along;
  double t = side > 0 ? (along - v[i - 1].along) / side : 0;
  t = fmin(fmax(t, 0), 1);
  return (struct drawing_point){v[i - 1].at.x + t * (v[i].at.x - v[i - 1].at.x),
                                v[i - 1].at.y +
                                    t * (v[i].at.y - v[i - 1].at.y)};
}

/* ---- Corners ------------------------------------------------------------- */

static double chord_turn(const struct stroke_shape *shape, double along,
                         double chord) {
  struct drawing_point at = shape_point_at(shape, along);
  struct drawing_point before = shape_point_at(shape, along - chord);
  struct drawing_point after = shape_point_at(shape, along + chord);
  return turning_angle(run_from(at, before), run_from(after, at));
}

/* Marks the vertices at which the chords turn by more than at any other within
 * their length. */
static void find_corners(struct stroke_shape *shape, double chord) {
  struct stroke_vertex *v = shape->vertex.item;
  size_t last = shape->vertex.count - 1, kept = SIZE_MAX;
  double kept_turn = 0;
  for (size_t i = shape->closed ? 0 : 1; i < last; i++) {
    double angle = chord_turn(shape, v[i].along, chord);
    if (angle <= CORNER_RADIANS)
      continue;
    if (kept != SIZE_MAX && v[i].along - v[kept].along < chord) {
      if (angle <= kept_turn)
        continue;
      v[kept].corner = false;
    }
    v[i].corner = true;
    kept = i;
    kept_turn = angle;
  }
  v[last].corner = shape->closed && v[0].corner;
}

/* ---- Straight sides ------------------------------------------------------ */

/* The part of a shape, in mm along it, over which it has no corners. */
struct smooth_part {
  double from, to;
};

/* A side of the part stays a line if an arc that turns by as much as the stroke
 * does about the side's ends is too high for the tolerance. */
static bool is_straight(const struct stroke_shape *shape,
                        struct smooth_part part, const struct stroke_vertex *v,
                        double tolerance) {
  double side = v[1].along - v[0].along, angle = 0;
  for (int end = 0; end < 2; end++) {
    double along = v[end].along, chord = fmax(side, CORNER_CHORD * tolerance);
    chord = fmin(chord, fmin(along - part.from, part.to - along));
    if (chord > 0)
      angle = fmax(angle, chord_turn(shape, along, chord));
  }
  return angle == 0 || side / 2 * tan(angle / 4) > ARC_HEIGHT * tolerance;
}

static void find_straight_sides(struct stroke_shape *shape, double tolerance) {
  struct stroke_vertex *v = shape->vertex.item;
  size_t from = 0, last = shape->vertex.count - 1;
  for (size_t i = 1; i <= last; i++) {
    if (i < last && !v[i].corner)
      continue;
    struct smooth_part part = {v[from].along, v[i].along};
    if (shape->closed && from == 0 && !v[0].corner)
      part.from = -shape->length;
    if (shape->closed && i == last && !v[last].corner)
      part.to = 2 * shape->length;
    for (; from < i; from++)
      v[from].straight = is_straight(shape, part, &v[from], tolerance);
  }
}

/* ---- The shape ----------------------------------------------------------- */

static bool add_vertices(struct stroke_shape *shape,
                         const struct drawing_point *point, size_t count,
                         size_t first) {
  size_t vertices = count + (shape->closed ? 1 : 0);
  shape->vertex.count = 0;
  shape->length = 0;
  if (!ARRAY_RESERVE(&shape->vertex, vertices))
    return false;
  for (size_t i = 0; i < vertices; i++) {
    struct drawing_point at = point[(first + i) % count];
    size_t n = shape->vertex.count;
    struct drawing_point last = n > 0 ? shape->vertex.item[n - 1].at : at;
    double side = hypot(at.x - last.x, at.y - last.y);
    if (n > 0 && side == 0)
      continue;
    shape->length += side;
    shape->vertex.item[shape->vertex.count++] = (struct stroke_vertex){
        .at = at, .along = shape->length, .point = (first + i) % count};
  }
  return true;
}

static void find_features(struct stroke_shape *shape, double tolerance) {
  if (shape->vertex.count < 2)
    return;
  find_corners(shape, CORNER_CHORD * tolerance);
  find_straight_sides(shape, tolerance);
}

/* The first vertex at which no smooth part goes on; SIZE_MAX: none. */
static size_t find_break(const struct stroke_shape *shape) {
  for (size_t i = 0; i < shape->vertex.count; i++)
    if (shape->vertex.item[i].corner || shape->vertex.item[i].straight)
      return i;
  return SIZE_MAX;
}

bool stroke_shape_find(struct stroke_shape *shape,
                       const struct drawing_point *point, size_t count,
                       bool closed, double tolerance) {
  shape->closed = closed;
  shape->start = 0;
  if (!add_vertices(shape, point, count, 0))
    return false;
  find_features(shape, tolerance);
  size_t first = closed ? find_break(shape) : 0;
  shape->ring = first == SIZE_MAX;
  if (first == 0 || shape->ring)
    return true;
  shape->start = shape->vertex.item[first].along;
  if (!add_vertices(shape, point, count, shape->vertex.item[first].point))
    return false;
  find_features(shape, tolerance);
  return true;
}

void stroke_shape_fini(struct stroke_shape *shape) {
  ARRAY_FREE(&shape->vertex);
}

struct drawing_point stroke_shape_side(const struct stroke_shape *shape,
                                       size_t vertex) {
  const struct stroke_vertex *v = &shape->vertex.item[vertex];
  double side = v[1].along - v[0].along;
  struct drawing_point run = run_from(v[1].at, v[0].at);
  return (struct drawing_point){run.x / side, run.y / side};
}
