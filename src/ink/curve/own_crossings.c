/* own_crossings.c - finds where a line crosses itself, by a sweep over its
 * sides. */
#include "ink/curve/own_crossings.h"

#include <math.h>

#include "base/poll.h"

/* Sides are sorted by multiples of this, mm. */
#define SWEEP_STEP 0x1p-20

/* ---- Sides --------------------------------------------------------------- */

static double side_low(const struct own_point *side, int axis) {
  return axis == 0 ? fmin(side[0].at.x, side[1].at.x)
                   : fmin(side[0].at.y, side[1].at.y);
}

static double side_high(const struct own_point *side, int axis) {
  return axis == 0 ? fmax(side[0].at.x, side[1].at.x)
                   : fmax(side[0].at.y, side[1].at.y);
}

/* Twice the area of the triangle of a side and a point. */
static double area_on_side(const struct own_point *side,
                           struct drawing_point p) {
  struct drawing_point a = side[0].at, b = side[1].at;
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/* The place of a side at t. */
static double side_along(const struct own_point *side, double t) {
  return side[0].along + t * (side[1].along - side[0].along);
}

/* Whether two sides follow each other, also where the line is closed. */
static bool are_joined(const struct own_point *a, const struct own_point *b) {
  return a == b + 1 || b == a + 1 || drawing_distance(a[1].at, b[0].at) == 0 ||
         drawing_distance(b[1].at, a[0].at) == 0;
}

/* Adds the crossing of two sides, if they cross. */
static bool cross_sides(struct own_crossings *own, const struct own_point *a,
                        const struct own_point *b) {
  double p = area_on_side(b, a[0].at), q = area_on_side(b, a[1].at);
  double r = area_on_side(a, b[0].at), s = area_on_side(a, b[1].at);
  if ((p > 0) == (q > 0) || (r > 0) == (s > 0))
    return true;
  double t = p / (p - q);
  struct own_crossing made = {
      .at = drawing_point_between(a[0].at, a[1].at, t),
      .along = {side_along(a, t), side_along(b, r / (r - s))}};
  return ARRAY_PUSH(&own->crossing, made);
}

/* ---- The sweep ----------------------------------------------------------- */

/* The axis along which the line extends farther. */
static int longer_axis(const struct own_crossings *own) {
  double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
  for (size_t i = 0; i + 1 < own->line.count; i++)
    for (int k = 0; k < 2; k++) {
      low[k] = fmin(low[k], side_low(&own->line.item[i], k));
      high[k] = fmax(high[k], side_high(&own->line.item[i], k));
    }
  return high[1] - low[1] > high[0] - low[0];
}

static bool sort_sides(struct own_crossings *own, int axis) {
  size_t sides = own->line.count - 1;
  own->order.count = 0;
  if (!ARRAY_RESERVE(&own->order, sides))
    return false;
  for (uint32_t i = 0; i < sides; i++) {
    double low = floor(side_low(&own->line.item[i], axis) / SWEEP_STEP);
    own->order.item[own->order.count++] =
        (struct sort_key){sort_key_of_int64((int64_t)low), i};
  }
  return sort_keys_alone(own->order.item, sides);
}

bool own_crossings_find(struct own_crossings *own) {
  own->crossing.count = 0;
  if (own->line.count < 4)
    return true;
  int axis = longer_axis(own);
  if (!sort_sides(own, axis))
    return false;
  const struct sort_key *order = own->order.item;
  for (size_t i = 0; i < own->order.count; i++) {
    const struct own_point *a = &own->line.item[order[i].value];
    double end = side_high(a, axis) + SWEEP_STEP;
    if (!poll_at(i))
      return false;
    for (size_t k = i + 1; k < own->order.count; k++) {
      const struct own_point *b = &own->line.item[order[k].value];
      if (side_low(b, axis) > end)
        break;
      bool apart = side_low(b, 1 - axis) > side_high(a, 1 - axis) ||
                   side_high(b, 1 - axis) < side_low(a, 1 - axis);
      if (!apart && !are_joined(a, b) &&
          !(a < b ? cross_sides(own, a, b) : cross_sides(own, b, a)))
        return false;
    }
  }
  return true;
}

bool own_crossings_remove_common(struct own_crossings *a,
                                 struct own_crossings *b, double within) {
  size_t compared = 0;
  for (size_t i = 0; i < a->crossing.count;) {
    size_t k = 0;
    if (!poll_at(compared++))
      return false;
    while (k < b->crossing.count &&
           drawing_distance(a->crossing.item[i].at, b->crossing.item[k].at) >
               within)
      k++;
    if (k == b->crossing.count) {
      i++;
      continue;
    }
    b->crossing.item[k] = b->crossing.item[--b->crossing.count];
    a->crossing.item[i] = a->crossing.item[--a->crossing.count];
  }
  return true;
}

void own_crossings_fini(struct own_crossings *own) {
  ARRAY_FREE(&own->line);
  ARRAY_FREE(&own->crossing);
  ARRAY_FREE(&own->order);
}
