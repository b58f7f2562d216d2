/* triangulation.c - cutting a face into triangles by the rule of doc/algorithms.md.
 *
 * Where a face that is not planar folds hangs on how it is cut, so the rule is
 * part of what a drawing shows.  Here it is followed to the letter, without a
 * thought of cost: before each cut all corners that are left are looked
 * through. */
#include "judge/triangulation.h"

#include <math.h>

#include "base/tolerance.h"
#include "scene/exact.h"

/* A face that is being cut. */
struct triangulation_work {
  struct judge_triangulation *cuts;
  const struct scene_point *point;
  const uint32_t *corner; /* indices of points */
  struct judge_triangulation_corner *c;
  uint32_t count, left;
};

static const struct scene_point *
page_point(const struct triangulation_work *work, uint32_t i) {
  return &work->point[work->corner[i]];
}

static int compare_places(const struct triangulation_work *work, uint32_t i,
                          uint32_t k) {
  const struct scene_point *p = page_point(work, i), *q = page_point(work, k);
  if (p->x != q->x)
    return p->x < q->x ? -1 : 1;
  if (p->y != q->y)
    return p->y < q->y ? -1 : 1;
  return p->z < q->z ? -1 : p->z > q->z;
}

/* What is equal but for rounding becomes equal: 24 bits are kept, halves go
 * up. */
static double blunt(double value) {
  int exponent;
  double fraction = frexp(value, &exponent);
  return ldexp(floor(ldexp(fraction, 24) + 0.5), exponent - 24);
}

/* ---- The image ----------------------------------------------------------- */

static double part(const struct scene_point *p, int axis) {
  return axis == 0 ? p->x : axis == 1 ? p->y : p->z;
}

/* Twice the area as it is seen along an axis. */
static double area_along(const struct triangulation_work *work, int axis) {
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const struct scene_point *from = page_point(work, 0);
  double sum = 0;
  for (uint32_t i = 1; i + 1 < work->count; i++) {
    const struct scene_point *p = page_point(work, i),
                             *q = page_point(work, i + 1);
    sum += (part(p, u) - part(from, u)) * (part(q, v) - part(from, v)) -
           (part(p, v) - part(from, v)) * (part(q, u) - part(from, u));
  }
  return sum;
}

static double extent_along(const struct triangulation_work *work, int axis) {
  double low = part(page_point(work, 0), axis), high = low;
  for (uint32_t i = 1; i < work->count; i++) {
    low = fmin(low, part(page_point(work, i), axis));
    high = fmax(high, part(page_point(work, i), axis));
  }
  return high - low;
}

/* Whether the leftmost corner of the image, the lowest of several, turns
 * right. */
static bool leftmost_turns_right(const struct triangulation_work *work) {
  const struct judge_triangulation_corner *c = work->c;
  uint32_t first = 0;
  for (uint32_t i = 1; i < work->count; i++)
    if (c[i].at[0] < c[first].at[0] ||
        (c[i].at[0] == c[first].at[0] && c[i].at[1] < c[first].at[1]))
      first = i;
  return exact_turn(c[(first + work->count - 1) % work->count].at, c[first].at,
                    c[(first + 1) % work->count].at) < 0;
}

/* Looks along the axis that shows most area, or where none shows any along the
 * one where the face is thinnest; z goes before x before y. */
static void make_image(struct triangulation_work *work) {
  static const int order[3] = {2, 0, 1};
  double area[3], thick[3], extent = 0;
  int most = 2, thinnest = 2;
  for (int k = 0; k < 3; k++) {
    int axis = order[k];
    area[axis] = area_along(work, axis);
    thick[axis] = extent_along(work, axis);
    extent = fmax(extent, thick[axis]);
    if (blunt(fabs(area[axis])) > blunt(fabs(area[most])))
      most = axis;
    if (blunt(thick[axis]) < blunt(thick[thinnest]))
      thinnest = axis;
  }
  bool shows =
      blunt(fabs(area[most])) > extent * extent * TOLERANCE_NO_AREA_SHARE;
  int axis = shows ? most : thinnest;
  for (uint32_t i = 0; i < work->count; i++) {
    work->c[i].at[0] = part(page_point(work, i), (axis + 1) % 3);
    work->c[i].at[1] = part(page_point(work, i), (axis + 2) % 3);
  }
  if (shows ? area[axis] > 0 : !leftmost_turns_right(work))
    return;
  for (uint32_t i = 0; i < work->count; i++) {
    double x = work->c[i].at[0];
    work->c[i].at[0] = work->c[i].at[1];
    work->c[i].at[1] = x;
  }
}

/* ---- Corners at one place ------------------------------------------------ */

static void leave_out(struct triangulation_work *work, uint32_t i) {
  struct judge_triangulation_corner *c = work->c;
  c[c[i].before].next = c[i].next;
  c[c[i].next].before = c[i].before;
  c[i].gone = true;
  work->left--;
}

/* Leaves out what repeats or turns back about a corner, till nothing does;
 * returns the corner that is left there. */
static uint32_t tidy(struct triangulation_work *work, uint32_t i) {
  struct judge_triangulation_corner *c = work->c;
  for (int tries = 0; tries < 3 && work->left > 2; tries++) {
    /* The corner before it, itself, the one after it. */
    uint32_t here = tries == 0 ? c[i].before : tries == 1 ? i : c[i].next;
    uint32_t before = c[here].before, next = c[here].next;
    if (compare_places(work, here, next) == 0) {
      leave_out(work, next);
    } else if (compare_places(work, before, next) == 0) {
      leave_out(work, here);
      leave_out(work, next);
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

static void look(struct triangulation_work *work, uint32_t i) {
  struct judge_triangulation_corner *c = work->c;
  const struct scene_point *p = page_point(work, c[i].before),
                           *q = page_point(work, c[i].next);
  double x = q->x - p->x, y = q->y - p->y, z = q->z - p->z;
  c[i].turn = exact_turn(c[c[i].before].at, c[i].at, c[c[i].next].at);
  c[i].length = blunt(x * x + y * y + z * z);
  c[i].refused = false;
}

static bool is_spike(const struct triangulation_work *work, uint32_t i) {
  const struct judge_triangulation_corner *c = work->c;
  const double *at = c[i].at, *p = c[c[i].before].at, *q = c[c[i].next].at;
  if (c[i].turn != 0)
    return false;
  for (int k = 0; k < 2; k++)
    if (p[k] != at[k] && q[k] != at[k])
      return (p[k] < at[k]) == (q[k] < at[k]);
  return true; /* one of them is at its place */
}

static bool is_at(const double *a, const double *b) {
  return a[0] == b[0] && a[1] == b[1];
}

static bool is_ear(const struct triangulation_work *work, uint32_t i) {
  const struct judge_triangulation_corner *c = work->c;
  const double *p = c[c[i].before].at, *q = c[i].at, *r = c[c[i].next].at;
  for (uint32_t k = c[i].next; k != i; k = c[k].next) {
    const double *at = c[k].at;
    if (c[k].turn <= 0 && !is_at(at, p) && !is_at(at, q) && !is_at(at, r) &&
        exact_turn(p, q, at) >= 0 && exact_turn(q, r, at) >= 0 &&
        exact_turn(r, p, at) >= 0)
      return false;
  }
  return true;
}

/* Which corners go first: spikes, then those that may be ears; and where there
 * are none of these, straight, convex and reflex ones. */
static int rank_of(const struct triangulation_work *work, uint32_t i,
                   bool any) {
  int turn = work->c[i].turn;
  if (is_spike(work, i))
    return 0;
  if (!any)
    return turn > 0 && !work->c[i].refused ? 1 : 5;
  return turn == 0 ? 2 : turn > 0 ? 3 : 4;
}

/* Whether the diagonal past i goes before that past k. */
static bool is_shorter(const struct triangulation_work *work, uint32_t i,
                       uint32_t k) {
  const struct judge_triangulation_corner *c = work->c;
  const uint32_t at[2] = {i, k};
  uint32_t low[2], high[2];
  if (c[i].length != c[k].length)
    return c[i].length < c[k].length;
  for (int j = 0; j < 2; j++) {
    uint32_t p = c[at[j]].before, q = c[at[j]].next;
    bool turned = compare_places(work, p, q) > 0;
    low[j] = turned ? q : p;
    high[j] = turned ? p : q;
  }
  int order = compare_places(work, low[0], low[1]);
  order = order != 0 ? order : compare_places(work, high[0], high[1]);
  order = order != 0 ? order : compare_places(work, i, k);
  return order != 0 ? order < 0 : i < k;
}

/* The first corner to go, from any one that is left; its rank to *rank. */
static uint32_t choose(const struct triangulation_work *work, uint32_t from,
                       bool any, int *rank) {
  uint32_t best = from;
  *rank = rank_of(work, from, any);
  for (uint32_t i = work->c[from].next; i != from; i = work->c[i].next) {
    int here = rank_of(work, i, any);
    if (here < *rank || (here == *rank && is_shorter(work, i, best))) {
      best = i;
      *rank = here;
    }
  }
  return best;
}

static void look_at_all(struct triangulation_work *work, uint32_t from) {
  uint32_t i = from;
  do {
    look(work, i);
    i = work->c[i].next;
  } while (i != from);
}

/* Cuts a corner off; returns one that is left. */
static uint32_t cut_off(struct triangulation_work *work, uint32_t i) {
  struct judge_triangulation_corner *c = work->c;
  uint32_t before = c[i].before, next = c[i].next;
  work->cuts->piece.item[work->cuts->piece.count++] =
      (struct judge_piece){{before, i, next}};
  leave_out(work, i);
  uint32_t left = work->left, here = tidy(work, before);
  if (work->left < 3)
    return here;
  look(work, c[here].before);
  look(work, here);
  look(work, c[here].next);
  if (work->left == left)
    look(work, c[next].next);
  return here;
}

static void cut_all(struct triangulation_work *work, uint32_t from) {
  look_at_all(work, from);
  while (work->left > 3) {
    int rank;
    uint32_t i = choose(work, from, false, &rank);
    if (rank == 1 && !is_ear(work, i)) {
      work->c[i].refused = true;
    } else if (rank <= 1) {
      from = cut_off(work, i);
    } else {
      from = cut_off(work, choose(work, from, true, &rank));
      if (work->left > 3)
        look_at_all(work, from);
    }
  }
  if (work->left == 3)
    work->cuts->piece.item[work->cuts->piece.count++] =
        (struct judge_piece){{work->c[from].before, from, work->c[from].next}};
}

bool judge_triangulation_make(struct judge_triangulation *cuts,
                              const struct scene_point *point,
                              const uint32_t *corner, uint32_t count) {
  cuts->piece.count = 0;
  if (!ARRAY_RESERVE(&cuts->piece, count) ||
      !ARRAY_RESERVE(&cuts->corner, count))
    return false;
  struct triangulation_work work = {cuts,  point, corner, cuts->corner.item,
                                    count, count};
  for (uint32_t i = 0; i < count; i++)
    work.c[i] = (struct judge_triangulation_corner){
        .next = (i + 1) % count, .before = (i + count - 1) % count};
  make_image(&work);
  uint32_t from = 0;
  for (uint32_t i = 0; i < count && work.left > 2; i++)
    if (!work.c[i].gone)
      from = tidy(&work, i);
  if (work.left > 2)
    cut_all(&work, from);
  return true;
}

void judge_triangulation_fini(struct judge_triangulation *cuts) {
  ARRAY_FREE(&cuts->piece);
  ARRAY_FREE(&cuts->corner);
}
