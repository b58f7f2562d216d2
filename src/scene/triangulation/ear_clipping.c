/* ear_clipping.c - triangulates a polygon by ear clipping.
 *
 * Rule  It decides where a polygon that is not planar folds, and so is part of
 * what is drawn; src/judge/triangulation.c implements it independently.
 *   1 A corner at the position of the previous one is removed, and so is a
 *     corner whose neighbours have one position: the sides run back over each
 *     other there.
 *   2 The polygon is projected along the axis of largest projected area
 *     (polygon.h), mirrored where needed to run counter-clockwise.
 *   3 An ear is a corner that turns left and whose closed triangle contains no
 *     other corner that does not turn left; corners at the positions of its own
 *     three do not count.  While there are more than three corners, the ear
 *     with the shortest diagonal in space is cut off.  Of equally long ones it
 *     is the one whose lower end is first in the order of x, y, z, then the one
 *     whose other end is.
 *     A spike, a corner where the projection runs back over itself, is cut off
 *     before any ear.
 *     Where a cut brings two corners to one position, step 1 is repeated.
 *   4 A corner that was found to be no ear is tested again when a cut ends at
 *     it or beside it, or corners were removed there.  Where no corner is left
 *     to be tested the polygon is not simple.  Then the first corner in the
 *     order of step 3 is cut off, those without area before convex and these
 *     before reflex ones, and all are tested again.
 *
 * Why the shortest diagonal
 *   It does not depend on the first corner, the winding or mirroring.  A
 *   polygon with equal sides loses every other corner, then every other of
 *   those left, so that its triangles are compact and a line meets few of them.
 * Invariants
 *   If any corner is inside an ear's triangle of a simple polygon, the one
 *   farthest from the diagonal is not convex; so only corners that are not
 *   convex are tested, and only those near the triangle (reflex_tree.h).
 *   A corner on the diagonal blocks the ear, so that a point in the middle of a
 *   side never remains as a triangle without area.
 *   Spikes, which occur where loops that touch were split, are cut off first:
 *   otherwise all of their neighbours might look like ears.
 *   A cut can make ears of its two neighbours only, so two corners are tested
 *   after each.
 * Robustness
 *   All turns are decided by exact_orient2d.  After too many repeated tests
 *   corners are cut off untested, so the loop always ends.
 * Source  ear clipping: [Meisters1975], the two-ears theorem.
 */
#include "scene/triangulation/ear_clipping.h"

#include "base/union_find.h"
#include "geom/vector.h"

enum {
  TURN_GONE = 2, /* of a corner that was cut off */
  /* The number of corners of a polygon that is not simple that are tested
   * again: a constant, and so many for each corner. */
  RECHECK_CORNERS = 1 << 20,
  RECHECK_PER_CORNER = 32
};

/* The priority of a corner in the queue; among equal ones diagonals decide. */
enum {
  PRIORITY_SPIKE,
  PRIORITY_EAR,
  PRIORITY_STRAIGHT,
  PRIORITY_CONVEX,
  PRIORITY_REFLEX
};

static bool is_at(const double a[2], const double b[2]) {
  return a[0] == b[0] && a[1] == b[1];
}

/* ---- The order of corners ------------------------------------------------ */

struct ear_clipper {
  struct triangulation *triangulation;
  const struct polygon *polygon;
  struct triangulation_corner *corner;
  uint32_t count, left;    /* corners at first, and now */
  uint32_t diagonals;      /* made so far */
  uint32_t queued;         /* length of the queue */
  bool unchecked;          /* corners are cut off untested */
  uint64_t recheck_budget; /* corners that may still be tested again */
};

/* The ends of a diagonal, in the order of polygon_compare. */
struct polygon_ends {
  uint32_t low, high;
};

static struct polygon_ends ends_past(const struct ear_clipper *clipper,
                                     uint32_t b) {
  uint32_t a = clipper->corner[b].prev, c = clipper->corner[b].next;
  return polygon_compare(clipper->polygon, a, c) < 0
             ? (struct polygon_ends){a, c}
             : (struct polygon_ends){c, a};
}

/* Compares the diagonals that cut off two corners by length, then by their
 * ends, then the corners by position and number: a quadrilateral has two ears
 * with one diagonal. */
static int compare_diagonals(const struct ear_clipper *clipper, uint32_t b,
                             uint32_t d) {
  double one = clipper->corner[b].length, two = clipper->corner[d].length;
  if (one != two)
    return one < two ? -1 : 1;
  struct polygon_ends e = ends_past(clipper, b), f = ends_past(clipper, d);
  int order = polygon_compare(clipper->polygon, e.low, f.low);
  if (order == 0)
    order = polygon_compare(clipper->polygon, e.high, f.high);
  if (order == 0)
    order = polygon_compare(clipper->polygon, b, d);
  return order != 0 ? order : (b > d) - (b < d);
}

static bool precedes_in_queue(const struct ear_clipper *clipper, uint32_t b,
                              uint32_t d) {
  const struct triangulation_corner *corner = clipper->corner;
  return corner[b].priority != corner[d].priority
             ? corner[b].priority < corner[d].priority
             : compare_diagonals(clipper, b, d) < 0;
}

/* ---- The queue ----------------------------------------------------------- */

static void set_slot(struct ear_clipper *clipper, uint32_t slot, uint32_t b) {
  clipper->triangulation->queue.item[slot - 1] = b;
  clipper->corner[b].slot = slot;
}

/* Restores the heap order by sifting b up or down from an empty slot. */
static void sift(struct ear_clipper *clipper, uint32_t slot, uint32_t b) {
  const uint32_t *queue = clipper->triangulation->queue.item;
  while (slot > 1 && precedes_in_queue(clipper, b, queue[slot / 2 - 1])) {
    set_slot(clipper, slot, queue[slot / 2 - 1]);
    slot /= 2;
  }
  while (2 * slot <= clipper->queued) {
    uint32_t child = 2 * slot;
    if (child < clipper->queued &&
        precedes_in_queue(clipper, queue[child], queue[child - 1]))
      child++;
    if (!precedes_in_queue(clipper, queue[child - 1], b))
      break;
    set_slot(clipper, slot, queue[child - 1]);
    slot = child;
  }
  set_slot(clipper, slot, b);
}

static void queue_remove(struct ear_clipper *clipper, uint32_t b) {
  uint32_t slot = clipper->corner[b].slot;
  if (slot == 0)
    return;
  uint32_t last = clipper->triangulation->queue.item[--clipper->queued];
  clipper->corner[b].slot = 0;
  if (last != b)
    sift(clipper, slot, last);
}

/* ---- The state of a corner ----------------------------------------------- */

static void set_turn(struct ear_clipper *clipper, uint32_t c, int turn) {
  struct triangulation_corner *corner = &clipper->corner[c];
  bool was_reflex = corner->turn <= 0, is_reflex = turn <= 0;
  if (was_reflex != is_reflex)
    reflex_tree_set(&clipper->triangulation->tree, c, is_reflex);
  corner->turn = (int8_t)turn;
}

/* Whether the projection runs back over itself at a corner, or one of the two
 * sides there has no length. */
static bool is_spike(const struct triangulation_corner *corner, uint32_t b) {
  const double *at = corner[b].at;
  const double *from = corner[corner[b].prev].at;
  const double *to = corner[corner[b].next].at;
  return corner[b].turn == 0 &&
         (is_at(from, at) || is_at(at, to) ||
          vector2_is_before(from, at) == vector2_is_before(to, at));
}

/* The priority of a corner that is cut off untested. */
static uint8_t priority_by_turn(int turn) {
  return turn == 0  ? PRIORITY_STRAIGHT
         : turn > 0 ? PRIORITY_CONVEX
                    : PRIORITY_REFLEX;
}

/* Updates a corner that has a new neighbour, and queues it. */
static void update_corner(struct ear_clipper *clipper, uint32_t b) {
  struct triangulation_corner *corner = &clipper->corner[b];
  queue_remove(clipper, b);
  set_turn(clipper, b,
           triangulation_turn(clipper->corner, corner->prev, b, corner->next));
  corner->length =
      polygon_distance(clipper->polygon, corner->prev, corner->next);
  bool spike = is_spike(clipper->corner, b);
  corner->priority = spike                ? PRIORITY_SPIKE
                     : clipper->unchecked ? priority_by_turn(corner->turn)
                                          : PRIORITY_EAR;
  if (spike || clipper->unchecked || corner->turn > 0)
    sift(clipper, ++clipper->queued, b);
}

/* A candidate ear a, b, c. */
struct ear {
  const struct triangulation_corner *corner;
  uint32_t a, b, c;
  uint32_t *blocker; /* gets the corner that was found in it */
};

/* Whether p is not convex, in the closed triangle a, b, c, and at none of its
 * corners. */
static bool is_reflex_in_ear(const void *user, uint32_t p) {
  const struct ear *ear = user;
  const struct triangulation_corner *corner = ear->corner;
  const double *at = corner[p].at, *a = corner[ear->a].at,
               *b = corner[ear->b].at, *c = corner[ear->c].at;
  if (corner[p].turn > 0 || is_at(at, a) || is_at(at, b) || is_at(at, c) ||
      exact_orient2d(c, a, at) < 0 || exact_orient2d(a, b, at) < 0 ||
      exact_orient2d(b, c, at) < 0)
    return false;
  *ear->blocker = p;
  return true;
}

/* The corner that blocked b when it was last tested is tried first: of a
 * polygon that is not simple, corners are tested again and again. */
static bool is_ear(const struct ear_clipper *clipper, uint32_t b) {
  struct triangulation_corner *corner = clipper->corner;
  struct ear ear = {corner, corner[b].prev, b, corner[b].next,
                    &corner[b].blocker};
  const double *triangle[3] = {corner[ear.a].at, corner[b].at,
                               corner[ear.c].at};
  return corner[b].turn > 0 && !is_reflex_in_ear(&ear, corner[b].blocker) &&
         !reflex_tree_query(&clipper->triangulation->tree, triangle,
                            is_reflex_in_ear, &ear);
}

/* ---- Corners at one position --------------------------------------------- */

static bool have_same_position(const struct ear_clipper *clipper, uint32_t a,
                               uint32_t b) {
  return polygon_compare(clipper->polygon, a, b) == 0;
}

/* Records that two sides run between the same two positions: a diagonal is
 * replaced by the polygon's side, or by the earlier diagonal. */
static void merge_sides(struct ear_clipper *clipper, uint32_t one,
                        uint32_t two) {
  uint32_t *same = clipper->triangulation->same.item;
  one = union_find_root(same, one);
  two = union_find_root(same, two);
  if (one >= clipper->count || two >= clipper->count)
    union_find_join(same, one, two);
}

/* Removes a corner; the previous one's side now ends at the next one. */
static void remove_corner(struct ear_clipper *clipper, uint32_t b) {
  struct triangulation_corner *corner = clipper->corner;
  queue_remove(clipper, b);
  set_turn(clipper, b, TURN_GONE);
  corner[corner[b].prev].next = corner[b].next;
  corner[corner[b].next].prev = corner[b].prev;
  clipper->left--;
}

/* Removes a corner at the position of the next one; returns one that is
 * left. */
static uint32_t remove_duplicate(struct ear_clipper *clipper, uint32_t b) {
  remove_corner(clipper, b);
  return clipper->corner[b].prev;
}

/* Removes a corner whose neighbours have one position; returns one that is
 * left. */
static uint32_t remove_spike(struct ear_clipper *clipper, uint32_t b) {
  uint32_t a = clipper->corner[b].prev;
  merge_sides(clipper, clipper->corner[a].side, clipper->corner[b].side);
  remove_corner(clipper, b);
  /* The next corner is at the position of this one: remove it, too, and take
   * over its side. */
  clipper->corner[a].side = clipper->corner[clipper->corner[a].next].side;
  remove_corner(clipper, clipper->corner[a].next);
  return a;
}

/* Removes duplicates and spikes at b and its neighbours until there are none,
 * or two corners are left; returns a corner that is left there. */
static uint32_t remove_degenerate(struct ear_clipper *clipper, uint32_t b) {
  struct triangulation_corner *corner = clipper->corner;
  while (clipper->left > 2) {
    uint32_t a = corner[b].prev, c = corner[b].next;
    if (have_same_position(clipper, b, c))
      b = remove_duplicate(clipper, b);
    else if (have_same_position(clipper, a, b))
      b = remove_duplicate(clipper, a);
    else if (have_same_position(clipper, a, c))
      b = remove_spike(clipper, b);
    else if (have_same_position(clipper, corner[a].prev, b))
      b = remove_spike(clipper, a);
    else if (have_same_position(clipper, corner[c].next, b))
      b = remove_spike(clipper, c);
    else
      break;
  }
  if (clipper->left == 2)
    merge_sides(clipper, corner[b].side, corner[corner[b].next].side);
  return b;
}

/* ---- Cutting ------------------------------------------------------------- */

/* Cuts off corner b; returns one that is left. */
static uint32_t cut_off_corner(struct ear_clipper *clipper, uint32_t b) {
  struct triangulation_corner *corner = clipper->corner;
  uint32_t a = corner[b].prev, c = corner[b].next;
  uint32_t side = clipper->count + clipper->diagonals++;
  triangulation_add(clipper->triangulation, a, b, c, corner[a].side,
                    corner[b].side, side);
  remove_corner(clipper, b);
  corner[a].side = side;
  uint32_t left = clipper->left;
  a = remove_degenerate(clipper, a);
  if (clipper->left > 2) {
    update_corner(clipper, corner[a].prev);
    update_corner(clipper, a);
    update_corner(clipper, corner[a].next);
  }
  if (clipper->left > 3 && clipper->left == left)
    update_corner(clipper, corner[c].next);
  return a;
}

/* The first corner in the order of the queue where there is no ear. */
static uint32_t choose_without_ear(struct ear_clipper *clipper,
                                   uint32_t start) {
  struct triangulation_corner *corner = clipper->corner;
  uint32_t best = start, c = start;
  do {
    corner[c].priority = priority_by_turn(corner[c].turn);
    if (precedes_in_queue(clipper, c, best))
      best = c;
    c = corner[c].next;
  } while (c != start);
  return best;
}

static void update_all(struct ear_clipper *clipper, uint32_t start) {
  uint32_t c = start;
  do {
    update_corner(clipper, c);
    c = clipper->corner[c].next;
  } while (c != start);
}

/* Cuts off a corner of a polygon that is not simple and so has no ear. */
static uint32_t cut_without_ear(struct ear_clipper *clipper, uint32_t b) {
  b = cut_off_corner(clipper, choose_without_ear(clipper, b));
  clipper->unchecked = clipper->recheck_budget < clipper->left;
  clipper->recheck_budget -= clipper->unchecked ? 0 : clipper->left;
  if (clipper->left > 3)
    update_all(clipper, b);
  return b;
}

static uint32_t cut_ears(struct ear_clipper *clipper, uint32_t b) {
  while (clipper->left > 3) {
    if (clipper->queued == 0) {
      b = cut_without_ear(clipper, b);
      continue;
    }
    uint32_t next = clipper->triangulation->queue.item[0];
    queue_remove(clipper, next);
    if (clipper->corner[next].priority != PRIORITY_EAR || is_ear(clipper, next))
      b = cut_off_corner(clipper, next);
  }
  return b;
}

/* ---- The whole polygon --------------------------------------------------- */

static void link_corners(struct ear_clipper *clipper) {
  struct triangulation_corner *corner = clipper->corner;
  for (uint32_t c = 0; c < clipper->count; c++) {
    corner[c].prev = c == 0 ? clipper->count - 1 : c - 1;
    corner[c].next = c + 1 == clipper->count ? 0 : c + 1;
    corner[c].side = c;
    corner[c].turn = 1;
    corner[c].slot = 0;
    corner[c].blocker = c;
  }
  for (uint32_t side = 0; side < 2 * clipper->count; side++)
    clipper->triangulation->same.item[side] = side;
}

/* Goes around once and removes duplicates and spikes. */
static uint32_t remove_all_degenerate(struct ear_clipper *clipper) {
  uint32_t b = 0;
  for (uint32_t c = 0; c < clipper->count && clipper->left > 2; c++)
    if (clipper->corner[c].turn != TURN_GONE)
      b = remove_degenerate(clipper, c);
  return b;
}

static void number_sides(struct triangulation *t) {
  for (size_t i = 0; i < t->triangle.count; i++)
    for (int k = 0; k < 3; k++)
      t->triangle.item[i].side[k] =
          union_find_root(t->same.item, t->triangle.item[i].side[k]);
}

bool ear_clipping(struct triangulation *triangulation,
                  const struct polygon *polygon) {
  uint32_t count = polygon->count;
  struct ear_clipper clipper = {
      .triangulation = triangulation,
      .polygon = polygon,
      .corner = triangulation->corner.item,
      .count = count,
      .left = count,
      .recheck_budget = RECHECK_CORNERS + RECHECK_PER_CORNER * (uint64_t)count};
  if (!ARRAY_RESERVE(&triangulation->queue, count) ||
      !ARRAY_RESERVE(&triangulation->same, 2 * (size_t)count) ||
      !reflex_tree_init(&triangulation->tree, clipper.corner,
                        sizeof *clipper.corner, count))
    return false;
  link_corners(&clipper);
  uint32_t b = remove_all_degenerate(&clipper);
  if (clipper.left > 3) {
    update_all(&clipper, b);
    b = cut_ears(&clipper, b);
  }
  if (clipper.left == 3) {
    uint32_t a = clipper.corner[b].prev, c = clipper.corner[b].next;
    triangulation_add(triangulation, a, b, c, clipper.corner[a].side,
                      clipper.corner[b].side, clipper.corner[c].side);
  }
  number_sides(triangulation);
  return true;
}
