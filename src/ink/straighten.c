/* straighten.c - a straight edge is two points: drops those in its middle.
 *
 * From the last point kept, the anchor, every point passed since leaves a
 * wedge of directions that go by it within the tolerance.  While the next
 * point lies in the intersection of these wedges, and farther off than the
 * one before, a straight line to it passes all of them.  Otherwise the point
 * before it is a corner, and the next anchor.
 * Cost  linear; most points of a curve are found to be corners by one cross
 *   product. */
#include "ink/paths.h"

#include <math.h>

#include "base/tolerance.h"

struct vector {
  double x, y;
};

struct wedge {
  struct vector left, right;
  bool open; /* nothing limits it yet */
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

/* Only directions that pass v within the tolerance stay. */
static void narrow(struct wedge *wedge, struct vector v) {
  double sine = TOLERANCE_COLLINEAR_UNITS / sqrt(dot(v, v));
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
 * root, as |next| is at most the sum. */
static bool is_corner(struct vector passed, struct vector next) {
  return fabs(cross(passed, next)) >
         TOLERANCE_COLLINEAR_UNITS * (fabs(next.x) + fabs(next.y));
}

/* Writes to `to`, which may be where they come from, the points of a line
 * that are needed; `last` follows the others and is not written.
 * Returns how many were written. */
static uint32_t straighten_line(struct ink_point *to,
                                const struct ink_point *point, uint32_t count,
                                struct ink_point last) {
  struct ink_point anchor = point[0];
  struct wedge wedge = {.open = true};
  uint32_t kept = 0;
  to[kept++] = anchor;
  for (uint32_t i = 1; i < count; i++) {
    struct ink_point here = point[i];
    struct ink_point after = i + 1 < count ? point[i + 1] : last;
    struct vector next = from_to(anchor, after);
    struct vector passed = from_to(anchor, here);
    bool straight =
        !is_corner(passed, next) && dot(next, next) > dot(passed, passed);
    if (straight) {
      narrow(&wedge, passed);
      straight = is_in(&wedge, next);
    }
    if (!straight) {
      to[kept++] = anchor = here;
      wedge.open = true;
    }
  }
  return kept;
}

void paths_straighten(struct ink_paths *paths) {
  struct ink_point *point = paths->point.item;
  uint32_t to = 0;
  for (size_t i = 0; i < paths->path.count; i++) {
    struct ink_path *path = &paths->path.item[i];
    const struct ink_point *from = point + path->point;
    struct ink_point end = path->closed ? from[0] : from[path->count - 1];
    uint32_t inner = path->closed ? path->count : path->count - 1;
    uint32_t kept = straighten_line(point + to, from, inner, end);
    if (!path->closed)
      point[to + kept++] = end;
    else if (kept < 3) /* so thin a loop is a line, there and back */
      path->closed = false;
    path->point = to;
    path->count = kept;
    to += kept;
  }
  paths->point.count = to;
}
