/* straighten.c - removes the inner points of straight runs of polylines.
 *
 * From the last point kept, the anchor, every point passed since then leaves a
 * wedge of directions that pass it within the tolerance.  While the next point
 * lies in the intersection of these wedges, and farther away than the one
 * before, a straight line to it passes all of them.  Otherwise the point before
 * it is a corner, and becomes the next anchor.
 * For approximate points (segment_graph.h) the tolerance is half the output
 * step: two lines that were snapped together were no more than a step apart,
 * and were one line before.  With a whole step the two sides of a slit a few
 * steps long became its diagonal, twice.
 * Cost  linear; most points of a curve are recognised as corners by one cross
 *   product. */
#include "ink/lines/paths.h"

#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "base/tolerance.h"

struct vector {
  double x, y;
};

struct wedge {
  struct vector left, right;
  bool open; /* unlimited so far */
};

static double cross(struct vector a, struct vector b) {
  return a.x * b.y - a.y * b.x;
}

static double dot(struct vector a, struct vector b) {
  return a.x * b.x + a.y * b.y;
}

static struct vector from_to(struct ink_point a, struct ink_point b) {
  return (struct vector){(double)b.x - a.x, (double)b.y - a.y};
}

/* Keeps only the directions that pass v within the tolerance. */
static void narrow(struct wedge *wedge, struct vector v, double tolerance) {
  double sine = tolerance / sqrt(dot(v, v));
  if (sine >= 1)
    return;
  double cosine = sqrt(1 - sine * sine);
  struct vector left = {v.x * cosine - v.y * sine, v.x * sine + v.y * cosine};
  struct vector right = {v.x * cosine + v.y * sine, v.y * cosine - v.x * sine};
  if (wedge->open || cross(wedge->left, left) < 0)
    wedge->left = left;
  if (wedge->open || cross(wedge->right, right) > 0)
    wedge->right = right;
  wedge->open = false;
}

static bool is_in(const struct wedge *wedge, struct vector v) {
  return wedge->open ||
         (cross(wedge->left, v) <= 0 && cross(wedge->right, v) >= 0);
}

/* Whether the line along `next` certainly misses `passed`: a bound without a
 * square root, as |next| is at most the sum of its coordinates' magnitudes. */
static bool certainly_misses(struct vector passed, struct vector next,
                             double tolerance) {
  return fabs(cross(passed, next)) > tolerance * (fabs(next.x) + fabs(next.y));
}

/* Removes the points of a line that are not needed.  `last` follows them and is
 * not one of them.  An approximate point, and a point after an approximate one
 * that is kept, has the wider tolerance.
 * approximate  one a point, compacted with the points; or NULL
 * Returns how many are left. */
static uint32_t straighten_line(struct ink_point *point, uint8_t *approximate,
                                uint32_t count, struct ink_point last,
                                double wide) {
  struct ink_point anchor = point[0];
  struct wedge wedge = {.open = true};
  uint32_t kept = 1;
  for (uint32_t i = 1; i < count; i++) {
    struct ink_point here = point[i];
    struct ink_point after = i + 1 < count ? point[i + 1] : last;
    struct vector next = from_to(anchor, after);
    struct vector passed = from_to(anchor, here);
    bool is_approximate =
        approximate != NULL && (approximate[i] || approximate[kept - 1]);
    double tolerance = is_approximate ? wide : TOLERANCE_COLLINEAR_UNITS;
    bool straight = !certainly_misses(passed, next, tolerance) &&
                    dot(next, next) > dot(passed, passed);
    if (straight) {
      narrow(&wedge, passed, tolerance);
      straight = is_in(&wedge, next);
    }
    if (!straight) {
      if (approximate != NULL)
        approximate[kept] = approximate[i];
      point[kept++] = anchor = here;
      wedge.open = true;
    }
  }
  return kept;
}

static void reverse_line(struct ink_point *point, uint8_t *approximate,
                         uint32_t count) {
  for (uint32_t i = 0; i < count / 2; i++) {
    uint32_t k = count - 1 - i;
    struct ink_point p = point[i];
    uint8_t l = approximate[i];
    point[i] = point[k];
    approximate[i] = approximate[k];
    point[k] = p;
    approximate[k] = l;
  }
}

/* The same for an open line including its last point. */
static uint32_t straighten_open(struct ink_point *point, uint8_t *approximate,
                                uint32_t count, double wide) {
  struct ink_point last = point[count - 1];
  uint8_t last_approximate = approximate != NULL ? approximate[count - 1] : 0;
  uint32_t kept = straighten_line(point, approximate, count - 1, last, wide);
  if (approximate != NULL)
    approximate[kept] = last_approximate;
  point[kept++] = last;
  return kept;
}

/* In both directions, so that an approximate point also widens the tolerance of
 * the points before it. */
static uint32_t straighten_path(struct ink_point *point, uint8_t *approximate,
                                const struct ink_path *path, double wide) {
  if (path->closed)
    return straighten_line(point, approximate, path->count, point[0], wide);
  uint32_t kept = straighten_open(point, approximate, path->count, wide);
  if (approximate != NULL && kept > 2) {
    reverse_line(point, approximate, kept);
    kept = straighten_open(point, approximate, kept, wide);
    reverse_line(point, approximate, kept);
  }
  return kept;
}

struct straightening {
  struct ink_paths *paths;
  double wide;
};

static bool straighten_range(void *user, struct parallel_range range) {
  const struct straightening *work = user;
  struct ink_paths *paths = work->paths;
  for (size_t i = range.begin; i < range.end; i++) {
    struct ink_path *path = &paths->path.item[i];
    uint8_t *approximate =
        paths->approximate != NULL ? paths->approximate + path->point : NULL;
    path->count = straighten_path(paths->point.item + path->point, approximate,
                                  path, work->wide);
    if (path->closed && path->count < 3) /* such a thin loop is a line
                                            traversed twice */
      path->closed = false;
  }
  return true;
}

void paths_straighten(struct ink_paths *paths, double output_step) {
  struct ink_point *point = paths->point.item;
  uint32_t to = 0;
  size_t count = paths->path.count;
  struct straightening work = {
      paths, fmax(output_step / 2, TOLERANCE_COLLINEAR_UNITS)};
  if (count > 1)
    (void)parallel_ranges(parallel_workers(count, PATHS_IN_RANGE), count,
                          PATHS_IN_RANGE, straighten_range, &work);
  else /* without a poll: there are calls for one path */
    (void)straighten_range(&work, (struct parallel_range){0, count, 0});
  for (size_t i = 0; i < count; i++) {
    struct ink_path *path = &paths->path.item[i];
    memmove(point + to, point + path->point, path->count * sizeof *point);
    path->point = to;
    to += path->count;
  }
  paths->point.count = to;
  mem_free(paths->approximate);
  paths->approximate = NULL;
}
