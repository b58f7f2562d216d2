/* triangulate.c - cuts a polygon into triangles without adding points.
 *
 * The rule, which decides where a polygon that is not planar folds, and so is
 * part of what is drawn; src/judge/ear_clipping.c follows it independently
 *   1 A corner at the place of the one before it is left out, and so is one
 *     whose neighbours are at one place: the polygon turns back there.
 *   2 The polygon is seen along the axis that shows most of it (polygon.h),
 *     turned so that it runs counter-clockwise.
 *   3 An ear is a corner that turns left with no other corner in its closed
 *     triangle that does not turn left; corners at the places of its own three
 *     do not count.  While there are more than three corners, the ear with the
 *     shortest diagonal in space is cut off; of equally long ones that whose
 *     lower end comes first in x, y, z, then that whose other end does.
 *     A spike, where the image doubles back, goes before any ear.
 *     A cut may bring two corners to one place: then step 1 is repeated there.
 *   4 A corner that turned out to be no ear is asked again when a cut ends at
 *     it or beside it, or corners were left out there.  Where none is left to
 *     be asked the polygon is not simple: then the first of all goes in the
 *     same order, those without area before convex and these before reflex
 *     ones, and all are asked again.
 *
 * Quadrilaterals  By this rule one is cut by the shorter of the diagonals that
 *   are inside.
 * Why the shortest  Where the face starts, which way it winds, and that it is
 *   mirrored do not change it; a polygon with equal sides loses every other
 *   corner, then every other of those left, so its triangles are compact and a
 *   line meets few of them.
 * Invariants  If any corner is inside an ear of a simple polygon, the one
 *   farthest from the diagonal is not convex, so only the others are looked
 *   at, those near the triangle alone (blockers.h).  A corner on the diagonal
 *   blocks the ear: so a point in the middle of a side is never left over as a
 *   triangle without area.  Where the polygon doubles back, as it does where
 *   loops that touch were parted, that spike goes first: all of its neighbours
 *   might else look like ears.  A cut makes ears of its two neighbours alone,
 *   so each cut asks two corners.
 * Robustness  All turns are exact_turn.  Where all were asked again too often,
 *   corners go without being asked.  So the loop always ends.
 * Source      ear clipping: [Meisters1975], the two-ears theorem.
 */
#include "view/triangulate.h"

#include "scene/exact.h"
#include "view/polygon.h"

enum {
  TURN_GONE = 2, /* of a corner that was cut off */
  /* So many corners are asked again where a polygon is not simple. */
  PATIENCE_CORNERS = 1 << 20,
  PATIENCE_EACH = 32
};

/* In which order corners are cut off, before their diagonals are compared. */
enum { RANK_SPIKE, RANK_EAR, RANK_STRAIGHT, RANK_CONVEX, RANK_REFLEX };

void triangulation_fini(struct triangulation *triangulation) {
  ARRAY_FREE(&triangulation->triangle);
  ARRAY_FREE(&triangulation->corner);
  ARRAY_FREE(&triangulation->queue);
  ARRAY_FREE(&triangulation->same);
  blockers_fini(&triangulation->blockers);
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

static void add(struct triangulation *triangulation, uint32_t a, uint32_t b,
                uint32_t c, uint32_t ab, uint32_t bc, uint32_t ca) {
  triangulation->triangle.item[triangulation->triangle.count++] =
      (struct triangulation_triangle){{a, b, c}, {ab, bc, ca}};
}

/* ---- Which corner is next ------------------------------------------------ */

struct ears {
  struct triangulation *triangulation;
  const struct polygon *polygon;
  struct triangulation_corner *corner;
  uint32_t count, left; /* corners at first, and now */
  uint32_t diagonals;   /* how many were made */
  uint32_t queued;
  bool hasty;        /* corners go without being asked */
  uint64_t patience; /* corners that may be asked again for want of ears */
};

/* The ends of a diagonal, the first in space first. */
struct polygon_ends {
  uint32_t low, high;
};

static struct polygon_ends ends_past(const struct ears *ears, uint32_t b) {
  uint32_t a = ears->corner[b].prev, c = ears->corner[b].next;
  return polygon_compare(ears->polygon, a, c) < 0 ? (struct polygon_ends){a, c}
                                                  : (struct polygon_ends){c, a};
}

/* Compares the diagonals past two corners, at last by number: a quadrilateral
 * has two ears with one diagonal. */
static int compare_diagonals(const struct ears *ears, uint32_t b, uint32_t d) {
  double one = ears->corner[b].length, two = ears->corner[d].length;
  if (one != two)
    return one < two ? -1 : 1;
  struct polygon_ends e = ends_past(ears, b), f = ends_past(ears, d);
  int order = polygon_compare(ears->polygon, e.low, f.low);
  if (order == 0)
    order = polygon_compare(ears->polygon, e.high, f.high);
  if (order == 0)
    order = polygon_compare(ears->polygon, b, d);
  return order != 0 ? order : (b > d) - (b < d);
}

static bool goes_before(const struct ears *ears, uint32_t b, uint32_t d) {
  const struct triangulation_corner *corner = ears->corner;
  return corner[b].rank != corner[d].rank ? corner[b].rank < corner[d].rank
                                          : compare_diagonals(ears, b, d) < 0;
}

/* ---- The queue ----------------------------------------------------------- */

static void put(struct ears *ears, uint32_t slot, uint32_t b) {
  ears->triangulation->queue.item[slot - 1] = b;
  ears->corner[b].slot = slot;
}

/* Lets b rise or sink from a slot that is free to where it belongs. */
static void settle(struct ears *ears, uint32_t slot, uint32_t b) {
  const uint32_t *queue = ears->triangulation->queue.item;
  while (slot > 1 && goes_before(ears, b, queue[slot / 2 - 1])) {
    put(ears, slot, queue[slot / 2 - 1]);
    slot /= 2;
  }
  while (2 * slot <= ears->queued) {
    uint32_t child = 2 * slot;
    if (child < ears->queued &&
        goes_before(ears, queue[child], queue[child - 1]))
      child++;
    if (!goes_before(ears, queue[child - 1], b))
      break;
    put(ears, slot, queue[child - 1]);
    slot = child;
  }
  put(ears, slot, b);
}

static void leave_queue(struct ears *ears, uint32_t b) {
  uint32_t slot = ears->corner[b].slot;
  if (slot == 0)
    return;
  uint32_t last = ears->triangulation->queue.item[--ears->queued];
  ears->corner[b].slot = 0;
  if (last != b)
    settle(ears, slot, last);
}

static void enter_queue(struct ears *ears, uint32_t b) {
  settle(ears, ++ears->queued, b);
}

/* ---- The state of a corner ----------------------------------------------- */

static void set_turn(struct ears *ears, uint32_t c, int turn) {
  struct triangulation_corner *corner = &ears->corner[c];
  bool was_bent = corner->turn <= 0, is_bent = turn <= 0;
  if (was_bent != is_bent)
    blockers_change(&ears->triangulation->blockers, c, is_bent);
  corner->turn = (int8_t)turn;
}

/* Whether the image doubles back at a corner, or stands still. */
static bool is_spike(const struct triangulation_corner *corner, uint32_t b) {
  const double *at = corner[b].at;
  const double *from = corner[corner[b].prev].at;
  const double *to = corner[corner[b].next].at;
  return corner[b].turn == 0 && (is_at(from, at) || is_at(at, to) ||
                                 is_before(from, at) == is_before(to, at));
}

/* Where a corner stands that is not asked whether it is an ear. */
static uint8_t plain_rank(int turn) {
  return turn == 0 ? RANK_STRAIGHT : turn > 0 ? RANK_CONVEX : RANK_REFLEX;
}

/* A corner one of whose neighbours is new is looked at anew. */
static void look_again(struct ears *ears, uint32_t b) {
  struct triangulation_corner *corner = &ears->corner[b];
  leave_queue(ears, b);
  set_turn(ears, b, turn_at(ears->corner, corner->prev, b, corner->next));
  corner->length = polygon_distance(ears->polygon, corner->prev, corner->next);
  bool spike = is_spike(ears->corner, b);
  corner->rank = spike         ? RANK_SPIKE
                 : ears->hasty ? plain_rank(corner->turn)
                               : RANK_EAR;
  if (spike || ears->hasty || corner->turn > 0)
    enter_queue(ears, b);
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

/* ---- Corners at one place ------------------------------------------------ */

static bool are_at_one_place(const struct ears *ears, uint32_t a, uint32_t b) {
  return polygon_compare(ears->polygon, a, b) == 0;
}

static uint32_t side_that_stands_for(const struct ears *ears, uint32_t side) {
  const uint32_t *same = ears->triangulation->same.item;
  while (same[side] != side)
    side = same[side];
  return side;
}

/* Two sides run between the same two places: a diagonal of them gives way to
 * the polygon's side, or to the earlier diagonal. */
static void join_sides(struct ears *ears, uint32_t one, uint32_t two) {
  one = side_that_stands_for(ears, one);
  two = side_that_stands_for(ears, two);
  if (one >= ears->count || two >= ears->count)
    ears->triangulation->same.item[one > two ? one : two] =
        one > two ? two : one;
}

/* Takes a corner out; what left the one before it now ends at the one after. */
static void take_out(struct ears *ears, uint32_t b) {
  struct triangulation_corner *corner = ears->corner;
  leave_queue(ears, b);
  set_turn(ears, b, TURN_GONE);
  corner[corner[b].prev].next = corner[b].next;
  corner[corner[b].next].prev = corner[b].prev;
  ears->left--;
}

/* A corner at the place of the next one goes; returns one that is left. */
static uint32_t drop_repeat(struct ears *ears, uint32_t b) {
  take_out(ears, b);
  return ears->corner[b].prev;
}

/* The tip of a way there and back goes; returns one that is left. */
static uint32_t drop_tip(struct ears *ears, uint32_t b) {
  uint32_t a = ears->corner[b].prev;
  join_sides(ears, ears->corner[a].side, ears->corner[b].side);
  take_out(ears, b);
  /* Now the next one is at its place, and what leaves that leaves here. */
  ears->corner[a].side = ears->corner[ears->corner[a].next].side;
  take_out(ears, ears->corner[a].next);
  return a;
}

/* Leaves out corners about b that repeat or turn back; returns one about which
 * none does, or which is alone with one more or none. */
static uint32_t tidy(struct ears *ears, uint32_t b) {
  struct triangulation_corner *corner = ears->corner;
  while (ears->left > 2) {
    uint32_t a = corner[b].prev, c = corner[b].next;
    if (are_at_one_place(ears, b, c))
      b = drop_repeat(ears, b);
    else if (are_at_one_place(ears, a, b))
      b = drop_repeat(ears, a);
    else if (are_at_one_place(ears, a, c))
      b = drop_tip(ears, b);
    else if (are_at_one_place(ears, corner[a].prev, b))
      b = drop_tip(ears, a);
    else if (are_at_one_place(ears, corner[c].next, b))
      b = drop_tip(ears, c);
    else
      break;
  }
  if (ears->left == 2)
    join_sides(ears, corner[b].side, corner[corner[b].next].side);
  return b;
}

/* ---- Cutting ------------------------------------------------------------- */

/* Cuts off corner b; returns one that is left. */
static uint32_t cut_corner(struct ears *ears, uint32_t b) {
  struct triangulation_corner *corner = ears->corner;
  uint32_t a = corner[b].prev, c = corner[b].next;
  uint32_t side = ears->count + ears->diagonals++;
  add(ears->triangulation, a, b, c, corner[a].side, corner[b].side, side);
  take_out(ears, b);
  corner[a].side = side;
  uint32_t left = ears->left;
  a = tidy(ears, a);
  if (ears->left > 2) {
    look_again(ears, corner[a].prev);
    look_again(ears, a);
    look_again(ears, corner[a].next);
  }
  if (ears->left > 3 && ears->left == left)
    look_again(ears, corner[c].next);
  return a;
}

/* The one to cut off where there is no ear. */
static uint32_t choose_corner(struct ears *ears, uint32_t start) {
  struct triangulation_corner *corner = ears->corner;
  uint32_t best = start, c = start;
  do {
    corner[c].rank = plain_rank(corner[c].turn);
    if (goes_before(ears, c, best))
      best = c;
    c = corner[c].next;
  } while (c != start);
  return best;
}

static void look_at_all(struct ears *ears, uint32_t start) {
  uint32_t c = start;
  do {
    look_again(ears, c);
    c = ears->corner[c].next;
  } while (c != start);
}

/* Cuts off what there is no ear for. */
static uint32_t cut_tangle(struct ears *ears, uint32_t b) {
  b = cut_corner(ears, choose_corner(ears, b));
  ears->hasty = ears->patience < ears->left;
  ears->patience -= ears->hasty ? 0 : ears->left;
  if (ears->left > 3)
    look_at_all(ears, b);
  return b;
}

static uint32_t cut_ears(struct ears *ears, uint32_t b) {
  while (ears->left > 3) {
    if (ears->queued == 0) {
      b = cut_tangle(ears, b);
      continue;
    }
    uint32_t next = ears->triangulation->queue.item[0];
    leave_queue(ears, next);
    if (ears->corner[next].rank != RANK_EAR || is_ear(ears, next))
      b = cut_corner(ears, next);
  }
  return b;
}

/* ---- All ----------------------------------------------------------------- */

static void link_corners(struct ears *ears) {
  struct triangulation_corner *corner = ears->corner;
  for (uint32_t c = 0; c < ears->count; c++) {
    corner[c].prev = c == 0 ? ears->count - 1 : c - 1;
    corner[c].next = c + 1 == ears->count ? 0 : c + 1;
    corner[c].side = c;
    corner[c].turn = 1;
    corner[c].slot = 0;
  }
  for (uint32_t side = 0; side < 2 * ears->count; side++)
    ears->triangulation->same.item[side] = side;
}

/* Goes around once, leaving out what repeats or turns back. */
static uint32_t tidy_all(struct ears *ears) {
  uint32_t b = 0;
  for (uint32_t c = 0; c < ears->count && ears->left > 2; c++)
    if (ears->corner[c].turn != TURN_GONE)
      b = tidy(ears, c);
  return b;
}

static void name_sides(struct ears *ears) {
  struct triangulation *t = ears->triangulation;
  for (size_t i = 0; i < t->triangle.count; i++)
    for (int k = 0; k < 3; k++)
      t->triangle.item[i].side[k] =
          side_that_stands_for(ears, t->triangle.item[i].side[k]);
}

static bool cut_polygon(struct triangulation *triangulation,
                        const struct polygon *polygon) {
  uint32_t count = polygon->count;
  struct ears ears = {.triangulation = triangulation,
                      .polygon = polygon,
                      .corner = triangulation->corner.item,
                      .count = count,
                      .left = count,
                      .patience =
                          PATIENCE_CORNERS + PATIENCE_EACH * (uint64_t)count};
  if (!ARRAY_RESERVE(&triangulation->queue, count) ||
      !ARRAY_RESERVE(&triangulation->same, 2 * (size_t)count) ||
      !blockers_init(&triangulation->blockers, ears.corner, sizeof *ears.corner,
                     count))
    return false;
  link_corners(&ears);
  uint32_t b = tidy_all(&ears);
  if (ears.left > 3) {
    look_at_all(&ears, b);
    b = cut_ears(&ears, b);
  }
  if (ears.left == 3) {
    uint32_t a = ears.corner[b].prev, c = ears.corner[b].next;
    add(triangulation, a, b, c, ears.corner[a].side, ears.corner[b].side,
        ears.corner[c].side);
  }
  name_sides(&ears);
  return true;
}

/* ---- Few corners --------------------------------------------------------- */

static bool has_repeats(const struct polygon *polygon) {
  for (uint32_t c = 0; c < polygon->count; c++)
    for (uint32_t d = 0; d < c; d++)
      if (polygon_compare(polygon, c, d) == 0)
        return true;
  return false;
}

/* Whether the diagonal from corner 0 is the shorter one, or of two that are as
 * long the one that starts at the first corner in space. */
static bool is_shorter_from_0(const struct polygon *polygon) {
  double from_0 = polygon_distance(polygon, 0, 2);
  double from_1 = polygon_distance(polygon, 1, 3);
  if (from_0 != from_1)
    return from_0 < from_1;
  uint32_t first = 0;
  for (uint32_t c = 1; c < 4; c++)
    if (polygon_compare(polygon, c, first) < 0)
      first = c;
  return first % 2 == 0;
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

bool triangulate(struct triangulation *triangulation,
                 const struct scene_point *point, const uint32_t *corner,
                 size_t count) {
  const struct polygon polygon = {point, corner, (uint32_t)count};
  triangulation->triangle.count = 0;
  triangulation->warped = false;
  if (!ARRAY_RESERVE(&triangulation->triangle, count - 2) ||
      !ARRAY_RESERVE(&triangulation->corner, count))
    return false;
  if (count == 3) {
    if (!has_repeats(&polygon))
      add(triangulation, 0, 1, 2, 0, 1, 2);
    return true;
  }
  struct polygon_areas areas = polygon_measure(&polygon);
  triangulation->warped = polygon_is_warped(&polygon, &areas);
  polygon_flatten(&polygon, &areas, triangulation->corner.item,
                  sizeof *triangulation->corner.item);
  return (count == 4 && !has_repeats(&polygon) &&
          cut_quadrilateral(triangulation, &polygon)) ||
         cut_polygon(triangulation, &polygon);
}
