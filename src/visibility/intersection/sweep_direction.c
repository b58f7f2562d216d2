/* sweep_direction.c - ranges of triangles along the normal of one of them.
 *
 * Correctness.  Let n be the direction's normal, n' = s m that of a triangle f,
 * where its coarse plane has the normal m, and a its corner in that plane.  At
 * a corner p of another triangle of the list,
 *     s value(p) = n (p - a) + (n' - n) (p - a),
 * the last part of which is at most the sum of |n' - n| times the list's
 * extent, by axes.  Let w be the sum of that, of s times what a value must
 * exceed (coarse_plane.h), and of far more than all roundings, which with u =
 * 2^-53 are less than 16u times the sum of (|n| + |n'|) times the extent.  A
 * corner that is farther than w from all of f along n has a value of certain
 * sign.  Each range is widened by half of its w: those of two that do not
 * overlap are farther from each other than the lesser of both.
 *   Steps are rounded down at both ends of a range: the order of ends stays. */
#include "visibility/intersection/sweep_direction.h"

#include <math.h>
#include <string.h>

#include "visibility/intersection/swept_triangle.h"

/* The shortest list for which another direction than depth is tried, where so
 * many pairs for each triangle overlap in depth; and which share of these it
 * must leave at most, as a divisor. */
enum { DIRECTION_LIST_MIN = 256, DIRECTION_PAIRS_MIN = 64, DIRECTION_GAIN = 2 };

/* The number of steps from the least value to the greatest. */
#define RANGE_STEPS 0x1p60

/* Bounds all roundings, as a share of the greatest value. */
#define RANGE_ERROR 0x1p-46

struct sweep_direction {
  double origin[3];         /* a corner of the triangle whose normal it is */
  double normal[3];         /* as in its coarse plane */
  double extent[3];         /* of the list, along the axes */
  double from, steps_per_1; /* the least value, and the scale of ranges */
};

/* Where a triangle is along the direction, in whole steps. */
struct sweep_range {
  uint64_t low;
  int64_t high;
};

static double coordinate_of(struct geom_point p, int axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : (double)p.z;
}

/* n (p - origin) */
static double value_along(const struct sweep_direction *direction,
                          struct geom_point p) {
  double value = 0;
  for (int k = 0; k < 3; k++)
    value +=
        direction->normal[k] * (coordinate_of(p, k) - direction->origin[k]);
  return value;
}

/* The direction of the list's triangle `of`. */
static struct sweep_direction
sweep_direction_of(const struct swept_triangle *swept, size_t count,
                   size_t of) {
  const struct coarse_plane *plane = &swept[of].coarse_plane;
  struct sweep_direction direction = {{plane->x, plane->y, plane->z},
                                      {plane->nx, plane->ny, plane->nz},
                                      {0, 0, 0},
                                      0,
                                      0};
  double low[3], high[3], to = 0;
  for (int k = 0; k < 3; k++)
    low[k] = high[k] = direction.origin[k];
  for (size_t i = 0; i < count; i++)
    for (int c = 0; c < 3; c++) {
      struct geom_point p = swept[i].corners.p[c];
      double value = value_along(&direction, p);
      direction.from = fmin(direction.from, value);
      to = fmax(to, value);
      for (int k = 0; k < 3; k++) {
        low[k] = fmin(low[k], coordinate_of(p, k));
        high[k] = fmax(high[k], coordinate_of(p, k));
      }
    }
  for (int k = 0; k < 3; k++)
    direction.extent[k] = high[k] - low[k];
  direction.steps_per_1 =
      to > direction.from ? RANGE_STEPS / (to - direction.from) : 0;
  return direction;
}

/* Half of w, by which a triangle's range is widened; INFINITY or no number
 * where that has no bound. */
static double widening(const struct sweep_direction *direction,
                       const struct coarse_plane *plane) {
  const double *n = direction->normal;
  const double m[3] = {plane->nx, plane->ny, plane->nz};
  double scale = (n[0] * m[0] + n[1] * m[1] + n[2] * m[2]) /
                 (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
  double sum = fabs(scale) * plane->most * (1 + RANGE_ERROR);
  for (int k = 0; k < 3; k++)
    sum += (fabs(scale * m[k] - n[k]) +
            RANGE_ERROR * (fabs(scale * m[k]) + fabs(n[k]))) *
           direction->extent[k];
  return sum / 2;
}

/* The step of a value, within those of the list. */
static uint64_t step_of(const struct sweep_direction *direction, double value) {
  double step = (value - direction->from) * direction->steps_per_1;
  return step < RANGE_STEPS ? step > 0 ? (uint64_t)step : 0
                            : (uint64_t)RANGE_STEPS;
}

static struct sweep_range
sweep_range_of(const struct sweep_direction *direction,
               const struct swept_triangle *f) {
  double low = INFINITY, high = -INFINITY;
  double wider = widening(direction, &f->coarse_plane);
  for (int c = 0; c < 3; c++) {
    double value = value_along(direction, f->corners.p[c]);
    low = fmin(low, value);
    high = fmax(high, value);
  }
  return wider < INFINITY
             ? (struct sweep_range){step_of(direction, low - wider),
                                    (int64_t)step_of(direction, high + wider)}
             : (struct sweep_range){0, INT64_MAX};
}

/* ---- Choosing ------------------------------------------------------------ */

/* The number of pairs whose ranges overlap.
 * key   the ranges' low ends, sorted, and their numbers
 * high  their high ends, by number */
static uint64_t count_overlaps(const struct sort_key *key, const int64_t *high,
                               size_t n) {
  uint64_t pairs = 0;
  for (size_t i = 0; i < n; i++) {
    uint64_t last = (uint64_t)high[key[i].value];
    size_t past;
    LOWER_BOUND(past, i + 1, n, key[past].key <= last);
    pairs += past - i - 1;
  }
  return pairs;
}

/* Finds the ranges along the normal of the list's middle triangle. */
static void find_ranges(struct pair_sweep *sweep) {
  struct swept_triangle *swept = sweep->swept.item;
  size_t n = sweep->swept.count;
  for (size_t i = 0; i < n; i++) {
    swept[i].coarse_plane = coarse_plane_of(&sweep->all, swept[i].corners.p);
    swept[i].has_coarse_plane = true;
  }
  const struct sort_key *key = sweep->key.item;
  struct sweep_direction direction =
      sweep_direction_of(swept, n, key[n / 2].value);
  for (size_t i = 0; i < n; i++) {
    uint32_t f = key[i].value;
    struct sweep_range range = sweep_range_of(&direction, &swept[f]);
    sweep->along.item[i] = (struct sort_key){range.low, f};
    sweep->high.item[f] = range.high;
  }
  sort_keys(sweep->along.item, sweep->along.item + n, n);
}

bool sweep_direction_choose(struct pair_sweep *sweep) {
  size_t n = sweep->swept.count;
  sweep->is_along_normal = false;
  if (n < DIRECTION_LIST_MIN)
    return true;
  if (!ARRAY_RESERVE(&sweep->high, n) || !ARRAY_RESERVE(&sweep->along, 2 * n))
    return false;
  for (size_t i = 0; i < n; i++)
    sweep->high.item[i] = sweep->swept.item[i].high;
  uint64_t pairs = count_overlaps(sweep->key.item, sweep->high.item, n);
  if (pairs / DIRECTION_PAIRS_MIN < n)
    return true;
  find_ranges(sweep);
  if (count_overlaps(sweep->along.item, sweep->high.item, n) >
      pairs / DIRECTION_GAIN)
    return true;
  sweep->is_along_normal = true;
  memcpy(sweep->key.item, sweep->along.item, n * sizeof *sweep->key.item);
  for (size_t i = 0; i < n; i++)
    sweep->swept.item[i].high = sweep->high.item[i];
  return true;
}
