/* triangulation.c - the judge's own implementation of the rule by which faces
 * are triangulated (doc/algorithms.md).
 *
 * Where a face that is not planar folds depends on its triangulation, so the
 * rule is part of what a drawing shows.  This implementation is a literal one
 * that does not care for speed: before each cut it goes through all corners
 * that are left. */
#include "judge/triangulation.h"

#include <math.h>

#include "base/tolerance.h"
#include "scene/exact.h"

/* The face that is being triangulated. */
struct triangulation_work {
  struct judge_triangulation *triangulation;
  const struct scene_point *point;
  const uint32_t *corner; /* indices of points */
  struct judge_triangulation_corner *c;
  uint32_t count, left;
};

static const struct scene_point *
position_of_corner(const struct triangulation_work *work, uint32_t i) {
  return &work->point[work->corner[i]];
}

static int compare_positions(const struct triangulation_work *work, uint32_t i,
                             uint32_t k) {
  const struct scene_point *p = position_of_corner(work, i),
                           *q = position_of_corner(work, k);
  if (p->x != q->x)
    return p->x < q->x ? -1 : 1;
  if (p->y != q->y)
    return p->y < q->y ? -1 : 1;
  return p->z < q->z ? -1 : p->z > q->z;
}

/* Rounds to 24 significant bits, halves up, so that values that differ by
 * rounding only become equal. */
static double round_to_24_bits(double value) {
  int exponent;
  double fraction = frexp(value, &exponent);
  return ldexp(floor(ldexp(fraction, 24) + 0.5), exponent - 24);
}

/* ---- Projection ---------------------------------------------------------- */

static double point_coordinate(const struct scene_point *p, int axis) {
  return axis == 0 ? p->x : axis == 1 ? p->y : p->z;
}

/* Twice the signed area of the projection along an axis. */
static double area_along(const struct triangulation_work *work, int axis) {
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const struct scene_point *from = position_of_corner(work, 0);
  double sum = 0;
  for (uint32_t i = 1; i + 1 < work->count; i++) {
    const struct scene_point *p = position_of_corner(work, i),
                             *q = position_of_corner(work, i + 1);
    sum += (point_coordinate(p, u) - point_coordinate(from, u)) *
               (point_coordinate(q, v) - point_coordinate(from, v)) -
           (point_coordinate(p, v) - point_coordinate(from, v)) *
               (point_coordinate(q, u) - point_coordinate(from, u));
  }
  return sum;
}

static double extent_along(const struct triangulation_work *work, int axis) {
  double low = point_coordinate(position_of_corner(work, 0), axis), high = low;
  for (uint32_t i = 1; i < work->count; i++) {
    low = fmin(low, point_coordinate(position_of_corner(work, i), axis));
    high = fmax(high, point_coordinate(position_of_corner(work, i), axis));
  }
  return high - low;
}

/* Whether the leftmost corner of the projection, the lowest of several, turns
 * right. */
static bool leftmost_turns_right(const struct triangulation_work *work) {
  const struct judge_triangulation_corner *c = work->c;
  uint32_t first = 0;
  for (uint32_t i = 1; i < work->count; i++)
    if (c[i].at[0] < c[first].at[0] ||
        (c[i].at[0] == c[first].at[0] && c[i].at[1] < c[first].at[1]))
      first = i;
  return exact_orient2d(c[(first + work->count - 1) % work->count].at,
                        c[first].at, c[(first + 1) % work->count].at) < 0;
}

/* Projects along the axis of largest projected area, or where no projection has
 * an area, along the axis of least extent; of equal ones z before x before y.
 */
static void project_polygon(struct triangulation_work *work) {
  static const int order[3] = {2, 0, 1};
  double area[3], thick[3], extent = 0;
  int most = 2, thinnest = 2;
  for (int k = 0; k < 3; k++) {
    int axis = order[k];
    area[axis] = area_along(work, axis);
    thick[axis] = extent_along(work, axis);
    extent = fmax(extent, thick[axis]);
    if (round_to_24_bits(fabs(area[axis])) > round_to_24_bits(fabs(area[most])))
      most = axis;
    if (round_to_24_bits(thick[axis]) < round_to_24_bits(thick[thinnest]))
      thinnest = axis;
  }
  bool shows = round_to_24_bits(fabs(area[most])) >
               extent * extent * TOLERANCE_NO_AREA_SHARE;
  int axis = shows ? most : thinnest;
  for (uint32_t i = 0; i < work->count; i++) {
    work->c[i].at[0] =
        point_coordinate(position_of_corner(work, i), (axis + 1) % 3);
    work->c[i].at[1] =
        point_coordinate(position_of_corner(work, i), (axis + 2) % 3);
  }
  if (shows ? area[axis] > 0 : !leftmost_turns_right(work))
    return;
  for (uint32_t i = 0; i < work->count; i++) {
    double x = work->c[i].at[0];
    work->c[i].at[0] = work->c[i].at[1];
    work->c[i].at[1] = x;
  }
}

/* ---- Corners at one position --------------------------------------------- */

static void remove_polygon_corner(struct triangulation_work *work, uint32_t i) {
  struct judge_triangulation_corner *c = work->c;
  c[c[i].before].next = c[i].next;
  c[c[i].next].before = c[i].before;
  c[i].gone = true;
  work->left--;
}

/* Removes duplicates and spikes at a corner and its neighbours until there are
 * none; returns a corner that is left there. */
static uint32_t remove_degenerate_corners(struct triangulation_work *work,
                                          uint32_t i) {
  struct judge_triangulation_corner *c = work->c;
  for (int tries = 0; tries < 3 && work->left > 2; tries++) {
    /* The corner before it, itself, the one after it. */
    uint32_t here = tries == 0 ? c[i].before : tries == 1 ? i : c[i].next;
    uint32_t before = c[here].before, next = c[here].next;
    if (compare_positions(work, here, next) == 0) {
      remove_polygon_corner(work, next);
    } else if (compare_positions(work, before, next) == 0) {
      remove_polygon_corner(work, here);
      remove_polygon_corner(work, next);
      here = before;
    } else {
      continue;
    }
    i = here;
    tries = -1;
  }
  return i;
}

/* ---- Ears ---------------------------------------------------------------- */

static void update_cut(struct triangulation_work *work, uint32_t i) {
  struct judge_triangulation_corner *c = work->c;
  const struct scene_point *p = position_of_corner(work, c[i].before),
                           *q = position_of_corner(work, c[i].next);
  double x = q->x - p->x, y = q->y - p->y, z = q->z - p->z;
  c[i].turn = exact_orient2d(c[c[i].before].at, c[i].at, c[c[i].next].at);
  c[i].length = round_to_24_bits(x * x + y * y + z * z);
  c[i].refused = false;
}

static bool is_spike_corner(const struct triangulation_work *work, uint32_t i) {
  const struct judge_triangulation_corner *c = work->c;
  const double *at = c[i].at, *p = c[c[i].before].at, *q = c[c[i].next].at;
  if (c[i].turn != 0)
    return false;
  for (int k = 0; k < 2; k++)
    if (p[k] != at[k] && q[k] != at[k])
      return (p[k] < at[k]) == (q[k] < at[k]);
  return true; /* a neighbour is at the same position */
}

static bool is_same_projection(const double *a, const double *b) {
  return a[0] == b[0] && a[1] == b[1];
}

static bool is_rule_ear(const struct triangulation_work *work, uint32_t i) {
  const struct judge_triangulation_corner *c = work->c;
  const double *p = c[c[i].before].at, *q = c[i].at, *r = c[c[i].next].at;
  for (uint32_t k = c[i].next; k != i; k = c[k].next) {
    const double *at = c[k].at;
    if (c[k].turn <= 0 && !is_same_projection(at, p) &&
        !is_same_projection(at, q) && !is_same_projection(at, r) &&
        exact_orient2d(p, q, at) >= 0 && exact_orient2d(q, r, at) >= 0 &&
        exact_orient2d(r, p, at) >= 0)
      return false;
  }
  return true;
}

/* The order of cutting: 0 spikes, 1 candidate ears; if there are none of these
 * (any), 2 straight, 3 convex, 4 reflex corners. */
static int cutting_priority(const struct triangulation_work *work, uint32_t i,
                            bool any) {
  int turn = work->c[i].turn;
  if (is_spike_corner(work, i))
    return 0;
  if (!any)
    return turn > 0 && !work->c[i].refused ? 1 : 5;
  return turn == 0 ? 2 : turn > 0 ? 3 : 4;
}

/* Whether the diagonal that cuts off i comes before that of k. */
static bool is_shorter(const struct triangulation_work *work, uint32_t i,
                       uint32_t k) {
  const struct judge_triangulation_corner *c = work->c;
  const uint32_t at[2] = {i, k};
  uint32_t low[2], high[2];
  if (c[i].length != c[k].length)
    return c[i].length < c[k].length;
  for (int j = 0; j < 2; j++) {
    uint32_t p = c[at[j]].before, q = c[at[j]].next;
    bool turned = compare_positions(work, p, q) > 0;
    low[j] = turned ? q : p;
    high[j] = turned ? p : q;
  }
  int order = compare_positions(work, low[0], low[1]);
  order = order != 0 ? order : compare_positions(work, high[0], high[1]);
  order = order != 0 ? order : compare_positions(work, i, k);
  return order != 0 ? order < 0 : i < k;
}

/* The first corner in the order of cutting.
 * from  any corner that is left
 * priority  set to its priority */
static uint32_t choose_next_cut(const struct triangulation_work *work,
                                uint32_t from, bool any, int *priority) {
  uint32_t best = from;
  *priority = cutting_priority(work, from, any);
  for (uint32_t i = work->c[from].next; i != from; i = work->c[i].next) {
    int here = cutting_priority(work, i, any);
    if (here < *priority || (here == *priority && is_shorter(work, i, best))) {
      best = i;
      *priority = here;
    }
  }
  return best;
}

static void update_all_corners(struct triangulation_work *work, uint32_t from) {
  uint32_t i = from;
  do {
    update_cut(work, i);
    i = work->c[i].next;
  } while (i != from);
}

/* Cuts a corner off; returns one that is left. */
static uint32_t cut_off(struct triangulation_work *work, uint32_t i) {
  struct judge_triangulation_corner *c = work->c;
  uint32_t before = c[i].before, next = c[i].next;
  work->triangulation->triangle.item[work->triangulation->triangle.count++] =
      (struct judge_triangulation_triangle){{before, i, next}};
  remove_polygon_corner(work, i);
  uint32_t left = work->left, here = remove_degenerate_corners(work, before);
  if (work->left < 3)
    return here;
  update_cut(work, c[here].before);
  update_cut(work, here);
  update_cut(work, c[here].next);
  if (work->left == left)
    update_cut(work, c[next].next);
  return here;
}

static void cut_all(struct triangulation_work *work, uint32_t from) {
  update_all_corners(work, from);
  while (work->left > 3) {
    int priority;
    uint32_t i = choose_next_cut(work, from, false, &priority);
    if (priority == 1 && !is_rule_ear(work, i)) {
      work->c[i].refused = true;
    } else if (priority <= 1) {
      from = cut_off(work, i);
    } else {
      from = cut_off(work, choose_next_cut(work, from, true, &priority));
      if (work->left > 3)
        update_all_corners(work, from);
    }
  }
  if (work->left == 3)
    work->triangulation->triangle.item[work->triangulation->triangle.count++] =
        (struct judge_triangulation_triangle){
            {work->c[from].before, from, work->c[from].next}};
}

bool judge_triangulation_make(struct judge_triangulation *triangulation,
                              const struct scene_point *point,
                              const uint32_t *corner, uint32_t count) {
  triangulation->triangle.count = 0;
  if (!ARRAY_RESERVE(&triangulation->triangle, count) ||
      !ARRAY_RESERVE(&triangulation->corner, count))
    return false;
  struct triangulation_work work = {
      triangulation, point, corner, triangulation->corner.item, count, count};
  for (uint32_t i = 0; i < count; i++)
    work.c[i] = (struct judge_triangulation_corner){
        .next = (i + 1) % count, .before = (i + count - 1) % count};
  project_polygon(&work);
  uint32_t from = 0;
  for (uint32_t i = 0; i < count && work.left > 2; i++)
    if (!work.c[i].gone)
      from = remove_degenerate_corners(&work, i);
  if (work.left > 2)
    cut_all(&work, from);
  return true;
}

void judge_triangulation_fini(struct judge_triangulation *triangulation) {
  ARRAY_FREE(&triangulation->triangle);
  ARRAY_FREE(&triangulation->corner);
}
