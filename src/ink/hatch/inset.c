/* inset.c - shortens hatch spans by half a pen width, so that no ink lies
 * beyond the sides.
 *
 * The points nearer to a side than that form a stadium: a rectangle on both
 * sides of it, with a disc about either end.  A stadium is convex, so that a
 * hatch line meets it in one interval.  The intervals of all sides are
 * subtracted from the spans of their lines. */
#include "ink/hatch/inset.h"

#include <math.h>

#include "base/sort.h"
#include "base/tolerance.h"

/* The part of a hatch line that is too near to a side. */
struct inset_interval {
  int64_t line;
  double u0, u1;
  uint32_t side;
};

typedef ARRAY(struct inset_interval) interval_list;
typedef ARRAY(struct hatch_span) span_list;

/* ---- Intervals near a side ----------------------------------------------- */

/* Extends an interval, empty at first, to contain [u0, u1]. */
static void extend_interval(struct inset_interval *interval, double u0,
                            double u1) {
  interval->u0 = fmin(interval->u0, u0);
  interval->u1 = fmax(interval->u1, u1);
}

/* Extends an interval by the part of the line at v within `distance` of a
 * point. */
static void extend_by_disc(struct inset_interval *interval,
                           struct hatch_point centre, double v,
                           double distance) {
  double across = v - centre.v;
  if (fabs(across) < distance) {
    double half = sqrt(distance * distance - across * across);
    extend_interval(interval, centre.u - half, centre.u + half);
  }
}

/* Clips [*low, *high] to the u with low1 < slope u + offset < high1. */
static void clip_to_slab(double *low, double *high, double slope, double offset,
                         double low1, double high1) {
  if (slope == 0) {
    if (!(offset > low1 && offset < high1))
      *low = INFINITY;
    return;
  }
  double a = (low1 - offset) / slope, b = (high1 - offset) / slope;
  *low = fmax(*low, fmin(a, b));
  *high = fmin(*high, fmax(a, b));
}

/* Extends an interval by the part of the line at v in the rectangle of the
 * points within `distance` of a side and beside it. */
static void extend_by_rectangle(struct inset_interval *interval,
                                const struct hatch_side *side, double v,
                                double distance) {
  struct hatch_point a = side->from, b = side->to;
  double length = hypot(b.u - a.u, b.v - a.v), low = -INFINITY, high = INFINITY;
  if (length == 0)
    return;
  double du = (b.u - a.u) / length, dv = (b.v - a.v) / length;
  /* First along the side, measured from a, then across it. */
  clip_to_slab(&low, &high, du, (v - a.v) * dv - a.u * du, 0, length);
  clip_to_slab(&low, &high, -dv, (v - a.v) * du + a.u * dv, -distance,
               distance);
  if (low < high)
    extend_interval(interval, low, high);
}

/* Adds the intervals of one side on all hatch lines that it is near.  False
 * when memory ran out. */
static bool add_intervals(const struct hatch_lines *lines, uint32_t index,
                          double distance, interval_list *intervals) {
  const struct hatch_side *side = &lines->side.item[index];
  double low = fmin(side->from.v, side->to.v) - distance;
  double high = fmax(side->from.v, side->to.v) + distance;
  int64_t last = (int64_t)ceil(high / lines->pitch);
  for (int64_t k = (int64_t)floor(low / lines->pitch) - 1; k <= last; k++) {
    struct inset_interval interval = {k, INFINITY, -INFINITY, index};
    double v = hatch_lines_height(lines, k);
    extend_by_disc(&interval, side->from, v, distance);
    extend_by_disc(&interval, side->to, v, distance);
    extend_by_rectangle(&interval, side, v, distance);
    if (interval.u0 < interval.u1 && !ARRAY_PUSH(intervals, interval))
      return false;
  }
  return true;
}

/* Orders intervals by line, then by u0. */
static int compare_intervals(const void *first, const void *second,
                             void *user) {
  const struct inset_interval *a = first, *b = second;
  (void)user;
  if (a->line != b->line)
    return a->line < b->line ? -1 : 1;
  return (a->u0 > b->u0) - (a->u0 < b->u0);
}

/* ---- Spans --------------------------------------------------------------- */

/* Adds to `kept` the parts of a span outside all intervals of its line.
 * at  the index of the first interval of this line, or of a later one
 * Returns false when memory ran out. */
static bool subtract_intervals(const struct hatch_span *span,
                               const interval_list *intervals, size_t at,
                               span_list *kept) {
  struct hatch_span rest = *span;
  for (; at < intervals->count && intervals->item[at].line == span->left.line;
       at++) {
    const struct inset_interval *interval = &intervals->item[at];
    struct hatch_span part = rest;
    if (interval->u0 >= rest.right.u)
      break;
    part.right.u = interval->u0;
    part.right.side = interval->side;
    if (part.left.u < part.right.u && !ARRAY_PUSH(kept, part))
      return false;
    if (interval->u1 > rest.left.u) {
      rest.left.u = interval->u1;
      rest.left.side = interval->side;
    }
  }
  return rest.left.u >= rest.right.u || ARRAY_PUSH(kept, rest);
}

bool inset_spans(struct hatch_lines *lines, double distance) {
  interval_list intervals = {0};
  span_list kept = {0};
  size_t at = 0;
  bool ok = true;
  for (uint32_t i = 0; ok && i < lines->side.count; i++)
    ok = add_intervals(lines, i, distance, &intervals);
  ok = ok && sort_stable(intervals.item, intervals.count,
                         sizeof *intervals.item, compare_intervals, NULL);
  for (size_t i = 0; ok && i < lines->span.count; i++) {
    const struct hatch_span *span = &lines->span.item[i];
    while (at < intervals.count && intervals.item[at].line < span->left.line)
      at++;
    ok = subtract_intervals(span, &intervals, at, &kept);
  }
  lines->span.count = 0;
  for (size_t i = 0; ok && i < kept.count; i++)
    ok = ARRAY_PUSH(&lines->span, kept.item[i]);
  ARRAY_FREE(&intervals);
  ARRAY_FREE(&kept);
  return ok;
}

/* ---- Moves --------------------------------------------------------------- */

bool inset_is_clear(const struct hatch_side *side, struct hatch_point a,
                    struct hatch_point b, double distance) {
  /* The distance of two segments that do not cross is that of an end of one
   * from the other, and the ends of the move are far enough from the side. */
  double smallest = distance - TOLERANCE_COINCIDENT_UNITS / SHEET_UNITS_PER_MM;
  return hatch_lines_distance(side->from, a, b) >= smallest &&
         hatch_lines_distance(side->to, a, b) >= smallest;
}
