/* triangulate.c - cuts a polygon into triangles without adding points.
 *
 * Phases
 *   flatten  two of the three coordinates are kept, those in which the polygon
 *            has the most area, in the order in which it is counter-clockwise.
 *   cut      a quadrilateral by the shorter of the diagonals that are inside;
 *            all others ear by ear, in rounds.
 * Invariants  An ear is a corner that turns left, with no other corner in its
 *   closed triangle (corners at the places of its own three do not count:
 *   bridges to holes visit places twice).  If any corner is inside, the one
 *   farthest from the diagonal is not convex, so only the others are looked
 *   at, those near the triangle alone (blockers.h).  A corner on the diagonal
 *   blocks the ear: so a point in the middle of a side is never left over as a
 *   triangle without area.  Where the polygon doubles back, as it does where
 *   loops that touch were parted, that spike goes first: all of its neighbours
 *   might else look like ears.
 * Rounds      In one round no corner beside a cut is cut: a convex polygon
 *   loses every other corner, then every other of those left.  So its
 *   triangles are compact, and a line meets few of them; a fan would be needles
 *   that all meet at one corner.  A cut makes ears of its two neighbours alone,
 *   so each cut asks two corners.
 * Robustness  All turns are exact_turn.  Where no ear is left the polygon is
 *   not simple: then a corner without area goes first, then a convex one, then
 *   any, and all are asked again; when many were, any corner will do.  So the
 *   loop always ends with count - 2 triangles.
 * Source      ear clipping: [Meisters1975], the two-ears theorem.
 */
#include "view/triangulate.h"

#include <float.h>
#include <math.h>

#include "base/tolerance.h"
#include "scene/exact.h"
#include "view/vector.h"

enum {
  TURN_GONE = 2, /* of a corner that was cut off */
  /* So many corners are asked again where a polygon is not simple. */
  PATIENCE_CORNERS = 1 << 20,
  PATIENCE_EACH = 32
};

void triangulation_fini(struct triangulation *triangulation) {
  ARRAY_FREE(&triangulation->triangle);
  ARRAY_FREE(&triangulation->corner);
  ARRAY_FREE(&triangulation->queue);
  blockers_fini(&triangulation->blockers);
}

/* A polygon of the scene. */
struct polygon {
  const struct scene_point *point;
  const uint32_t *corner;
  uint32_t count;
};

static void coordinates(const struct polygon *polygon, uint32_t c,
                        double to[3]) {
  const struct scene_point *p = &polygon->point[polygon->corner[c]];
  to[0] = p->x;
  to[1] = p->y;
  to[2] = p->z;
}

static void offset(const struct polygon *polygon, uint32_t c,
                   const double origin[3], double to[3]) {
  coordinates(polygon, c, to);
  for (int k = 0; k < 3; k++)
    to[k] -= origin[k];
}

/* ---- Flatten ------------------------------------------------------------- */

/* Twice the area seen along each axis. */
struct areas {
  double value[3];
  double bound[3]; /* no more than this of it is rounding */
  double extent;   /* the largest difference to the first corner */
};

static void add_triangle(struct areas *areas, const double a[3],
                         const double b[3]) {
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3, j = (k + 2) % 3;
    double left = a[i] * b[j], right = a[j] * b[i];
    areas->value[k] += left - right;
    areas->bound[k] += fabs(left) + fabs(right);
    areas->extent = fmax(areas->extent, fmax(fabs(a[k]), fabs(b[k])));
  }
}

static struct areas measure_areas(const struct polygon *polygon) {
  struct areas areas = {{0, 0, 0}, {0, 0, 0}, 0};
  double origin[3], a[3], b[3];
  coordinates(polygon, 0, origin);
  offset(polygon, 1, origin, a);
  for (uint32_t c = 2; c < polygon->count; c++) {
    offset(polygon, c, origin, b);
    add_triangle(&areas, a, b);
    for (int k = 0; k < 3; k++)
      a[k] = b[k];
  }
  /* With u = 2^-53, each difference is off by u of itself, so a product by
   * less than 4u, and each of the sums by u of all that was added. */
  for (int k = 0; k < 3; k++)
    areas.bound[k] =
        areas.bound[k] * ((polygon->count + 4) * DBL_EPSILON) + DBL_MIN;
  return areas;
}

/* The axis along which to look: it shows the most area, or where none shows
 * any, it is the one along which the polygon is thinnest. */
static int choose_axis(const struct polygon *polygon,
                       const struct areas *areas) {
  const double *value = areas->value;
  if (value[0] != 0 || value[1] != 0 || value[2] != 0) {
    int axis = fabs(value[0]) > fabs(value[2]) ? 0 : 2;
    return fabs(value[1]) > fabs(value[axis]) ? 1 : axis;
  }
  double low[3], high[3], at[3];
  coordinates(polygon, 0, low);
  coordinates(polygon, 0, high);
  for (uint32_t c = 1; c < polygon->count; c++) {
    coordinates(polygon, c, at);
    for (int k = 0; k < 3; k++) {
      low[k] = fmin(low[k], at[k]);
      high[k] = fmax(high[k], at[k]);
    }
  }
  int axis = high[0] - low[0] < high[2] - low[2] ? 0 : 2;
  return high[1] - low[1] < high[axis] - low[axis] ? 1 : axis;
}

static int turn_at(const struct triangulation_corner *corner, uint32_t a,
                   uint32_t b, uint32_t c) {
  return exact_turn(corner[a].at, corner[b].at, corner[c].at);
}

static bool is_before(const double a[2], const double b[2]) {
  return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
}

static bool is_at(const double a[2], const double b[2]) {
  return a[0] == b[0] && a[1] == b[1];
}

/* Whether a simple polygon runs clockwise: its lowest corner is convex. */
static bool is_clockwise(const struct triangulation_corner *corner,
                         uint32_t count) {
  uint32_t low = 0;
  for (uint32_t c = 1; c < count; c++)
    if (is_before(corner[c].at, corner[low].at))
      low = c;
  return turn_at(corner, (low + count - 1) % count, low, (low + 1) % count) < 0;
}

static void flatten(const struct polygon *polygon, const struct areas *areas,
                    struct triangulation_corner *corner) {
  int axis = choose_axis(polygon, areas);
  double at[3];
  for (uint32_t c = 0; c < polygon->count; c++) {
    coordinates(polygon, c, at);
    corner[c].at[0] = at[(axis + 1) % 3];
    corner[c].at[1] = at[(axis + 2) % 3];
  }
  bool flip = areas->value[axis] < 0;
  if (!(fabs(areas->value[axis]) > areas->bound[axis]))
    flip = is_clockwise(corner, polygon->count);
  for (uint32_t c = 0; flip && c < polygon->count; c++) {
    double swap = corner[c].at[0];
    corner[c].at[0] = corner[c].at[1];
    corner[c].at[1] = swap;
  }
}

/* Whether a corner lies off the plane through the first one, for a count. */
static bool is_warped(const struct polygon *polygon,
                      const struct areas *areas) {
  double length = vector_length(areas->value), origin[3], to[3];
  double most = length * areas->extent * TOLERANCE_WARP_SHARE;
  coordinates(polygon, 0, origin);
  for (uint32_t c = 1; polygon->count > 3 && c < polygon->count; c++) {
    offset(polygon, c, origin, to);
    if (fabs(vector_dot(areas->value, to)) > most)
      return true;
  }
  return false;
}

/* ---- Cut ----------------------------------------------------------------- */

static void add(struct triangulation *triangulation, uint32_t a, uint32_t b,
                uint32_t c, uint32_t ab, uint32_t bc, uint32_t ca) {
  triangulation->triangle.item[triangulation->triangle.count++] =
      (struct triangulation_triangle){{a, b, c}, {ab, bc, ca}};
}

static double square_distance(const struct polygon *polygon, uint32_t a,
                              uint32_t b) {
  double origin[3], to[3];
  coordinates(polygon, a, origin);
  offset(polygon, b, origin, to);
  return vector_dot(to, to);
}

/* Whether corner 0 or 2 of a quadrilateral is the first of all in x, y, z. */
static bool is_first_even(const struct polygon *polygon) {
  uint32_t first = 0;
  double low[3], at[3];
  coordinates(polygon, 0, low);
  for (uint32_t c = 1; c < 4; c++) {
    coordinates(polygon, c, at);
    int k = 0;
    while (k < 2 && at[k] == low[k])
      k++;
    if (at[k] >= low[k])
      continue;
    first = c;
    coordinates(polygon, c, low);
  }
  return first % 2 == 0;
}

/* Whether the diagonal from corner 0 is the shorter one, or of two that are as
 * long the one from the first corner in space: where the face starts and which
 * way it winds must not matter. */
static bool is_shorter_from_0(const struct polygon *polygon) {
  double from_0 = square_distance(polygon, 0, 2);
  double from_1 = square_distance(polygon, 1, 3);
  return from_0 < from_1 || (from_0 == from_1 && is_first_even(polygon));
}

/* Cuts a quadrilateral by a diagonal that leaves area on both its sides; false
 * where there is none. */
static bool cut_quadrilateral(struct triangulation *triangulation,
                              const struct polygon *polygon) {
  const struct triangulation_corner *corner = triangulation->corner.item;
  bool from_0 = turn_at(corner, 0, 1, 2) > 0 && turn_at(corner, 2, 3, 0) > 0;
  bool from_1 = turn_at(corner, 3, 0, 1) > 0 && turn_at(corner, 1, 2, 3) > 0;
  if (!from_0 && !from_1)
    return false;
  if (from_0 && from_1)
    from_0 = is_shorter_from_0(polygon);
  if (from_0) {
    add(triangulation, 0, 1, 2, 0, 1, 4);
    add(triangulation, 0, 2, 3, 4, 2, 3);
  } else {
    add(triangulation, 0, 1, 3, 0, 4, 3);
    add(triangulation, 1, 2, 3, 1, 2, 4);
  }
  return true;
}

/* ---- Ears ---------------------------------------------------------------- */

struct ears {
  struct triangulation *triangulation;
  struct triangulation_corner *corner;
  uint32_t count, left; /* corners at first, and now */
  uint32_t round;
  uint32_t next, queued; /* of the ring of corners to be asked: the first, and
                            how many */
  uint64_t patience;     /* corners that may be asked again for want of ears */
};

static void set_turn(struct ears *ears, uint32_t c, int turn) {
  struct triangulation_corner *corner = &ears->corner[c];
  bool was_bent = corner->turn <= 0, is_bent = turn <= 0;
  if (was_bent != is_bent)
    blockers_change(&ears->triangulation->blockers, c, is_bent);
  corner->turn = (int8_t)turn;
}

static void turn_again(struct ears *ears, uint32_t c) {
  struct triangulation_corner *corner = ears->corner;
  set_turn(ears, c, turn_at(corner, corner[c].prev, c, corner[c].next));
}

static void ask_later(struct ears *ears, uint32_t c) {
  uint32_t end = ears->next + ears->queued;
  if (ears->corner[c].waits)
    return;
  ears->corner[c].waits = true;
  ears->triangulation->queue.item[end < ears->count ? end : end - ears->count] =
      c;
  ears->queued++;
}

static uint32_t next_in_queue(struct ears *ears) {
  uint32_t c = ears->triangulation->queue.item[ears->next++];
  if (ears->next == ears->count)
    ears->next = 0;
  ears->queued--;
  ears->corner[c].waits = false;
  return c;
}

static void link_corners(struct ears *ears) {
  struct triangulation_corner *corner = ears->corner;
  for (uint32_t c = 0; c < ears->count; c++) {
    corner[c].prev = c == 0 ? ears->count - 1 : c - 1;
    corner[c].next = c + 1 == ears->count ? 0 : c + 1;
    corner[c].side = c;
    corner[c].turn = 1;
    corner[c].waits = false;
    corner[c].changed = 0;
  }
  for (uint32_t c = 0; c < ears->count; c++)
    turn_again(ears, c);
}

/* What may be an ear. */
struct ear {
  const struct triangulation_corner *corner;
  uint32_t a, b, c;
};

/* Whether p is bent, in the closed triangle a, b, c, and at none of its
 * corners. */
static bool blocks(const void *user, uint32_t p) {
  const struct ear *ear = user;
  const struct triangulation_corner *corner = ear->corner;
  const double *at = corner[p].at, *a = corner[ear->a].at,
               *b = corner[ear->b].at, *c = corner[ear->c].at;
  if (corner[p].turn > 0 || is_at(at, a) || is_at(at, b) || is_at(at, c))
    return false;
  return exact_turn(c, a, at) >= 0 && exact_turn(a, b, at) >= 0 &&
         exact_turn(b, c, at) >= 0;
}

static bool is_ear(const struct ears *ears, uint32_t b) {
  const struct triangulation_corner *corner = ears->corner;
  struct ear ear = {corner, corner[b].prev, b, corner[b].next};
  const double *triangle[3] = {corner[ear.a].at, corner[b].at,
                               corner[ear.c].at};
  return corner[b].turn > 0 &&
         !blockers_ask(&ears->triangulation->blockers, triangle, blocks, &ear);
}

/* The corner to cut off where there is no ear: one without area, or a convex
 * one, or whichever comes next. */
static uint32_t choose_corner(const struct triangulation_corner *corner,
                              uint32_t start) {
  uint32_t convex = start;
  uint32_t c = start;
  do {
    if (corner[c].turn == 0)
      return c;
    if (corner[convex].turn < 0)
      convex = c;
    c = corner[c].next;
  } while (c != start);
  return convex;
}

/* Whether the polygon doubles back at a corner, or stands still. */
static bool is_spike(const struct triangulation_corner *corner, uint32_t b) {
  const double *at = corner[b].at;
  const double *from = corner[corner[b].prev].at;
  const double *to = corner[corner[b].next].at;
  return corner[b].turn == 0 && (is_at(from, at) || is_at(at, to) ||
                                 is_before(from, at) == is_before(to, at));
}

/* Cuts off corner b; returns the corner before it. */
static uint32_t cut_corner(struct ears *ears, uint32_t b) {
  struct triangulation_corner *corner = ears->corner;
  uint32_t a = corner[b].prev, c = corner[b].next;
  uint32_t side = ears->count + (ears->count - ears->left--);
  add(ears->triangulation, a, b, c, corner[a].side, corner[b].side, side);
  set_turn(ears, b, TURN_GONE);
  corner[a].next = c;
  corner[c].prev = a;
  corner[a].side = side;
  corner[a].changed = corner[c].changed = ears->round;
  turn_again(ears, a);
  turn_again(ears, c);
  ask_later(ears, a);
  ask_later(ears, c);
  return a;
}

/* Cuts off a spike and those that come to light by it; returns a corner that
 * is left. */
static uint32_t cut_spikes(struct ears *ears, uint32_t b) {
  while (ears->left > 3 && is_spike(ears->corner, b)) {
    uint32_t a = cut_corner(ears, b);
    b = is_spike(ears->corner, a) ? a : ears->corner[a].next;
  }
  return b;
}

/* Cuts off an ear, and what spikes that brings; returns a corner that is
 * left. */
static uint32_t cut_ear(struct ears *ears, uint32_t b) {
  uint32_t a = cut_spikes(ears, cut_corner(ears, b));
  return cut_spikes(ears, ears->corner[a].next);
}

/* One round: asks each corner that waits, but not those beside a cut of this
 * round; these, and what becomes new, are for the next.  Returns a corner that
 * is left. */
static uint32_t cut_round(struct ears *ears, uint32_t b, bool any) {
  ears->round++;
  for (uint32_t asked = ears->queued; asked > 0 && ears->left > 3; asked--) {
    uint32_t c = next_in_queue(ears);
    if (ears->corner[c].turn == TURN_GONE)
      continue;
    if (ears->corner[c].changed == ears->round)
      ask_later(ears, c);
    else if (any || is_ear(ears, c))
      b = cut_ear(ears, c);
  }
  return b;
}

static void ask_all_again(struct ears *ears, uint32_t b) {
  for (uint32_t c = ears->corner[b].next; c != b; c = ears->corner[c].next)
    ask_later(ears, c);
  ask_later(ears, b);
}

static void cut_ears(struct triangulation *triangulation, uint32_t count) {
  struct triangulation_corner *corner = triangulation->corner.item;
  struct ears ears = {.triangulation = triangulation,
                      .corner = corner,
                      .count = count,
                      .left = count,
                      .patience =
                          PATIENCE_CORNERS + PATIENCE_EACH * (uint64_t)count};
  uint32_t b = 0;
  link_corners(&ears);
  for (uint32_t c = 0; c < count; c++)
    if (corner[c].turn != TURN_GONE)
      b = cut_spikes(&ears, c);
  ask_all_again(&ears, b);
  for (uint32_t asked = ears.left; ears.left > 3;) {
    bool patient = ears.patience >= ears.left;
    b = cut_round(&ears, b, !patient);
    if (ears.queued > 0 || ears.left == 3)
      continue;
    /* Not simple: in one that is, a corner becomes an ear by a cut beside it
     * alone. */
    ears.patience -= ears.left;
    if (asked == ears.left)
      b = cut_ear(&ears, choose_corner(corner, b));
    asked = ears.left;
    ask_all_again(&ears, b);
  }
  uint32_t a = corner[b].prev, c = corner[b].next;
  add(triangulation, a, b, c, corner[a].side, corner[b].side, corner[c].side);
}

/* -------------------------------------------------------------------------- */

bool triangulate(struct triangulation *triangulation,
                 const struct scene_point *point, const uint32_t *corner,
                 size_t count) {
  struct polygon polygon = {point, corner, (uint32_t)count};
  triangulation->triangle.count = 0;
  triangulation->corner.count = 0;
  triangulation->warped = false;
  if (!ARRAY_RESERVE(&triangulation->triangle, count - 2) ||
      !ARRAY_RESERVE(&triangulation->corner, count) ||
      !ARRAY_RESERVE(&triangulation->queue, count))
    return false;
  if (count == 3) {
    add(triangulation, 0, 1, 2, 0, 1, 2);
    return true;
  }
  struct areas areas = measure_areas(&polygon);
  triangulation->warped = is_warped(&polygon, &areas);
  flatten(&polygon, &areas, triangulation->corner.item);
  if (count == 4 && cut_quadrilateral(triangulation, &polygon))
    return true;
  if (!blockers_init(&triangulation->blockers, triangulation->corner.item,
                     sizeof *triangulation->corner.item, polygon.count))
    return false;
  cut_ears(triangulation, polygon.count);
  return true;
}
