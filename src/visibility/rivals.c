/* rivals.c - what many nearer triangles leave of one.
 *
 * Phases
 *   1 gather the rivals; most of what is about is sorted out by boxes, by
 *     depths, by sides between the two on the page, and by planes in doubles
 *   2 part the triangle by a side of a rival as long as that leaves clearly
 *     fewer pairs of part and rival
 *   3 take the few rivals of each part from it, one by one
 * Invariants
 *   A part lists every rival that overlaps it; of others it may list some.
 *   What is left is a union of convex parts.  It is the same set whatever the
 *   parts were: all decisions of 1 and 3 are exact, those of 2 only choose.
 */
#include "visibility/rivals.h"

#include <math.h>
#include <string.h>

enum {
  FEW = 6,     /* rivals that need no parting */
  LINES = 6,   /* rivals of a part whose sides it may be parted by */
  SAMPLE = 24, /* rivals by which that is judged */
};

/* A parting must leave no more than this share of the pairs: as the sample has
 * it, and truly, so that there is an end. */
#define MOST_LEFT 0.8
/* One that leaves no more than this needs no better. */
#define GOOD 0.55
#define MOST_DIVIDED 0.9

/* A rival that is along at least this share of a part is in most parts that
 * others would part it into: it is taken first. */
#define LONG 0.6

/* Partings of a part after which its axis is found anew: reaches along one that
 * is not its own may be too long. */
enum { AXIS_AGE = 3 };
static const struct rivals_axis no_axis = {.age = AXIS_AGE};

/* Reaches are in doubles of corners that are off by 1/4 unit or less (line.c):
 * this is room enough. */
#define REACH_MARGIN 2.0

/* The library's are calls, for the sake of what is no number. */
static inline double least(double a, double b) { return a < b ? a : b; }
static inline double most_of(double a, double b) { return a > b ? a : b; }

void rivals_init(struct rivals *rivals, const struct sheet *sheet) {
  memset(rivals, 0, sizeof *rivals);
  rivals->sheet = sheet;
}

void rivals_fini(struct rivals *rivals) {
  ARRAY_FREE(&rivals->rival);
  ARRAY_FREE(&rivals->left);
  ARRAY_FREE(&rivals->rest);
  ARRAY_FREE(&rivals->next);
  ARRAY_FREE(&rivals->part);
  ARRAY_FREE(&rivals->reach);
  ARRAY_FREE(&rivals->scratch);
  ARRAY_FREE(&rivals->key);
  arena_fini(&rivals->arena);
}

static void find_depths(const struct geom_point p[3], int64_t *low,
                        int64_t *high) {
  *low = *high = p[0].z;
  for (int k = 1; k < 3; k++) {
    if (p[k].z < *low)
      *low = p[k].z;
    if (p[k].z > *high)
      *high = p[k].z;
  }
}

void rivals_start(struct rivals *rivals, uint32_t triangle) {
  arena_reset(&rivals->arena);
  rivals->triangle = triangle;
  rivals->plane = triangle_plane_of(rivals->sheet, triangle);
  rivals->stance = stance_plane_of(rivals->sheet, triangle);
  rivals->box = page_box_of_triangle(rivals->sheet, triangle);
  find_depths(rivals->plane.p, &rivals->low, &rivals->high);
  rivals->covered = rivals->mingled = false;
  rivals->rival.count = 0;
}

/* ---- 1. Gathering
 * ------------------------------------------------------------ */

/* A mask as of plane_sides; -1 where doubles cannot tell. */
static int near_sides(const struct stance_plane *plane,
                      const struct geom_point p[3]) {
  int sides = 0;
  for (int k = 0; k < 3; k++) {
    int sign = stance_sign(plane, p[k]);
    if (sign == 0)
      return -1;
    sides |= sign < 0 ? PLANE_BEHIND : PLANE_BEFORE;
  }
  return sides;
}

/* How g lies to the triangle at hand where doubles can tell, strictly; else
 * false. */
static bool tell_nearness(const struct rivals *rivals, uint32_t g,
                          const struct geom_point p[3],
                          enum nearness *nearness) {
  struct stance_plane plane;
  int sides = near_sides(&rivals->stance, p);
  if (sides == PLANE_BEHIND || sides == PLANE_BEFORE) {
    *nearness = sides == PLANE_BEHIND ? NEARER_NEVER : NEARER_ALWAYS;
    return true;
  }
  plane = stance_plane_of(rivals->sheet, g);
  int others = near_sides(&plane, rivals->plane.p);
  if (others == PLANE_BEHIND || others == PLANE_BEFORE) {
    *nearness = others == PLANE_BEHIND ? NEARER_ALWAYS : NEARER_NEVER;
    return true;
  }
  *nearness = NEARER_BEYOND;
  return sides >= 0 && others >= 0;
}

static bool holds_all(const struct geom_point g[3],
                      const struct geom_point f[3]) {
  for (int k = 0; k < 3; k++)
    for (int i = 0; i < 3; i++)
      if (geom_orient2d(g[k], g[k == 2 ? 0 : k + 1], f[i]) < 0)
        return false;
  return true;
}

/* Of two boxes that meet. */
static double shared_area(struct page_box a, struct page_box b) {
  double width = (double)page_least(a.x1, b.x1) - page_most(a.x0, b.x0);
  double height = (double)page_least(a.y1, b.y1) - page_most(a.y0, b.y0);
  return width * height;
}

bool rivals_ask(struct rivals *rivals, uint32_t g) {
  const struct sheet *sheet = rivals->sheet;
  struct triangle_plane plane;
  struct page_box box = page_box_of_triangle(sheet, g);
  struct rival rival = {g, shared_area(rivals->box, box), 3, NULL, false};
  struct geom_line line, back;
  enum nearness nearness = NEARER_ALWAYS;
  int64_t low, high;
  if (page_boxes_apart(rivals->box, box))
    return true;
  rivals->counts.pairs++;
  for (int k = 0; k < 3; k++)
    plane.p[k] = sheet->point.item[sheet->triangle.item[g].point[k]];
  find_depths(plane.p, &low, &high);
  if (high < rivals->low || triangles_part(sheet, rivals->triangle, g))
    return true;
  rivals->counts.overlapping++;
  if (low <= rivals->high && !tell_nearness(rivals, g, plane.p, &nearness)) {
    rivals->counts.exact++;
    rivals->mingled = true;
    plane = triangle_plane_of(sheet, g);
    nearness = triangle_nearness(&rivals->plane, rivals->triangle, &plane, g,
                                 &line, &back);
  }
  if (nearness == NEARER_NEVER)
    return true;
  if (nearness == NEARER_BEYOND) {
    rivals->counts.crossings++;
    rivals->mingled = true;
    rival.lines = 4;
  } else if (holds_all(plane.p, rivals->plane.p)) {
    rivals->covered = true;
  }
  return ARRAY_PUSH(&rivals->rival, rival);
}

/* ---- Rivals and parts, exactly
 * ----------------------------------------------- */

/* Makes a rival's lines, if they were not; but the fourth. */
static bool make_lines(struct rivals *rivals, struct rival *rival) {
  struct geom_line *line;
  if (rival->line != NULL)
    return true;
  line = arena_alloc(&rivals->arena, 2 * (size_t)rival->lines, sizeof *line);
  if (line == NULL)
    return false;
  triangle_lines(rivals->sheet, rival->triangle, line, line + rival->lines);
  rival->line = line;
  return true;
}

/* Makes the fourth line, if it was not. */
static void make_crossing(const struct rivals *rivals, struct rival *rival) {
  struct triangle_plane plane;
  struct geom_line *line = &rival->line[3], *back = &rival->line[7];
  if (rival->crossing)
    return;
  plane = triangle_plane_of(rivals->sheet, rival->triangle);
  (void)geom_line_between(line, &plane.plane, &rivals->plane.plane);
  *back = *line;
  geom_line_reverse(back);
  rival->crossing = true;
}

enum meeting { MEETING_NONE, MEETING_PART, MEETING_ALL };

/* How much of a part is left of a line. */
static enum meeting side_of_line(const struct geom_line *line,
                                 const struct geom_convex *piece) {
  bool left = false, all = true;
  for (uint32_t c = 0; c < piece->count; c++) {
    int side = geom_line_side(line, &piece->corner[c]);
    left |= side > 0;
    all &= side >= 0;
  }
  return !left ? MEETING_NONE : all ? MEETING_ALL : MEETING_PART;
}

/* The same of the fourth line, which need not be made where doubles can tell
 * all corners' sides. */
static enum meeting side_of_crossing(const struct rivals *rivals,
                                     struct rival *rival,
                                     const struct geom_convex *piece) {
  struct stance_plane plane;
  int sum = 0, count = (int)piece->count;
  if (rival->crossing)
    return side_of_line(&rival->line[3], piece);
  plane = stance_plane_of(rivals->sheet, rival->triangle);
  for (uint32_t c = 0; c < piece->count; c++)
    sum += stance_nearer(&rivals->stance, &plane, piece->corner[c].x,
                         piece->corner[c].y);
  if (sum == count || sum == -count)
    return sum > 0 ? MEETING_ALL : MEETING_NONE;
  make_crossing(rivals, rival);
  return side_of_line(&rival->line[3], piece);
}

/* How much of a part a rival may cover: a NONE and an ALL are certain.  With a
 * PART, `lines` of its lines count. */
static enum meeting meeting_of(const struct rivals *rivals, struct rival *rival,
                               const struct geom_convex *piece, int *lines) {
  enum meeting meeting = MEETING_ALL;
  *lines = 3;
  for (int k = 0; k < 3; k++) {
    enum meeting now = side_of_line(&rival->line[k], piece);
    if (now < meeting)
      meeting = now;
    if (now == MEETING_NONE)
      return now;
  }
  if (rival->lines == 4) {
    enum meeting now = side_of_crossing(rivals, rival, piece);
    if (now < meeting)
      meeting = now;
    if (now == MEETING_PART)
      *lines = 4;
  }
  return meeting;
}

/* Appends to rivals->next what a rival leaves of a part. */
static bool subtract(struct rivals *rivals, const struct geom_convex *piece,
                     struct rival *rival) {
  struct geom_convex inside = {0};
  enum meeting meeting;
  int lines;
  if (!make_lines(rivals, rival))
    return false;
  meeting = meeting_of(rivals, rival, piece, &lines);
  if (meeting == MEETING_NONE)
    return ARRAY_PUSH(&rivals->next, *piece);
  if (meeting == MEETING_PART &&
      !geom_convex_subtract(piece, rival->line, rival->line + rival->lines,
                            lines, &rivals->next, &inside, &rivals->arena))
    return false;
  rivals->counts.cuts++;
  if (meeting == MEETING_ALL || inside.count > 0)
    rivals->whole = false;
  return true;
}

/* Takes the last `count` reaches' rivals from a part. */
static bool take_few(struct rivals *rivals, const struct geom_convex *piece,
                     size_t count) {
  const struct rival_reach *reach =
      rivals->reach.item + (rivals->reach.count - count);
  geom_pieces swap;
  rivals->rest.count = 0;
  if (!ARRAY_PUSH(&rivals->rest, *piece))
    return false;
  for (size_t i = 0; i < count && rivals->rest.count > 0; i++) {
    rivals->next.count = 0;
    for (size_t k = 0; k < rivals->rest.count; k++)
      if (!subtract(rivals, &rivals->rest.item[k],
                    &rivals->rival.item[reach[i].rival]))
        return false;
    swap = rivals->rest;
    rivals->rest = rivals->next;
    rivals->next = swap;
  }
  for (size_t k = 0; k < rivals->rest.count; k++)
    if (!ARRAY_PUSH(&rivals->left, rivals->rest.item[k]))
      return false;
  return true;
}

/* ---- 2. Parting
 * ---------------------------------------------------------------- */

static double along(const struct rivals_axis *axis, double x, double y) {
  return (x - axis->x) * axis->dx + (y - axis->y) * axis->dy;
}

static double across(const struct rivals_axis *axis, double x, double y) {
  return (y - axis->y) * axis->dx - (x - axis->x) * axis->dy;
}

static struct rivals_axis axis_of(const struct geom_convex *piece) {
  const struct geom_corner *c = piece->corner;
  struct rivals_axis axis = {.x = c[0].x, .y = c[0].y, .dx = 1};
  double most = 0;
  for (uint32_t k = 1; k < piece->count; k++) {
    /* The longest way from the first corner, or along a side. */
    for (int from = 0; from < 2; from++) {
      const struct geom_corner *a = from == 0 ? &c[0] : &c[k - 1];
      double dx = c[k].x - a->x, dy = c[k].y - a->y, length = hypot(dx, dy);
      if (length > most) {
        most = length;
        axis.dx = dx / length;
        axis.dy = dy / length;
      }
    }
  }
  axis.u0 = axis.v0 = INFINITY;
  axis.u1 = axis.v1 = -INFINITY;
  for (uint32_t k = 0; k < piece->count; k++) {
    double u = along(&axis, c[k].x, c[k].y), v = across(&axis, c[k].x, c[k].y);
    axis.u0 = least(axis.u0, u - REACH_MARGIN);
    axis.u1 = most_of(axis.u1, u + REACH_MARGIN);
    axis.v0 = least(axis.v0, v - REACH_MARGIN);
    axis.v1 = most_of(axis.v1, v + REACH_MARGIN);
  }
  return axis;
}

/* Widens a reach by where the segment crosses v = at. */
static void reach_crossing(struct rival_reach *reach, const double p[2],
                           const double q[2], double at) {
  double u;
  if ((p[1] < at) == (q[1] < at))
    return;
  u = p[0] + (q[0] - p[0]) * ((at - p[1]) / (q[1] - p[1]));
  reach->from = least(reach->from, u);
  reach->to = most_of(reach->to, u);
}

/* Where a rival may be along the axis, within the part's breadth; false:
 * nowhere. */
static bool find_reach(const struct rivals *rivals,
                       const struct rivals_axis *axis,
                       struct rival_reach *reach) {
  const struct sheet *sheet = rivals->sheet;
  const uint32_t *point =
      sheet->triangle.item[rivals->rival.item[reach->rival].triangle].point;
  double p[3][2];
  reach->from = INFINITY;
  reach->to = -INFINITY;
  for (int k = 0; k < 3; k++) {
    const struct geom_point *at = &sheet->point.item[point[k]];
    p[k][0] = along(axis, at->x, at->y);
    p[k][1] = across(axis, at->x, at->y);
    if (p[k][1] >= axis->v0 && p[k][1] <= axis->v1) {
      reach->from = least(reach->from, p[k][0]);
      reach->to = most_of(reach->to, p[k][0]);
    }
  }
  for (int k = 0; k < 3; k++) {
    const double *q = p[k == 2 ? 0 : k + 1];
    reach_crossing(reach, p[k], q, axis->v0);
    reach_crossing(reach, p[k], q, axis->v1);
  }
  reach->from -= REACH_MARGIN;
  reach->to += REACH_MARGIN;
  return reach->from <= axis->u1 && reach->to >= axis->u0;
}

/* Keeps those of the last `count` reaches that meet the part; returns how
 * many.  The list ends with them. */
static size_t sift(struct rivals *rivals, const struct rivals_axis *axis,
                   size_t count) {
  size_t from = rivals->reach.count - count, kept = from;
  for (size_t i = from; i < rivals->reach.count; i++) {
    struct rival_reach reach = rivals->reach.item[i];
    if (find_reach(rivals, axis, &reach))
      rivals->reach.item[kept++] = reach;
  }
  rivals->reach.count = kept;
  return kept - from;
}

/* A stretch of the axis. */
struct stretch {
  double from, to;
};

static const struct stretch no_stretch = {INFINITY, -INFINITY};

static void widen(struct stretch *stretch, double u) {
  stretch->from = least(stretch->from, u);
  stretch->to = most_of(stretch->to, u);
}

static bool is_along(const struct stretch *stretch,
                     const struct rival_reach *reach) {
  return reach->from <= stretch->to && reach->to >= stretch->from;
}

/* A side of a rival, and about where its line leaves halves of a part along
 * its axis. */
struct parting {
  uint32_t rival;
  int side;
  struct stretch half[2]; /* left of the line, right of it */
};

/* Does the line of that side cross the part, and how? */
static bool find_crossing(const struct rivals *rivals,
                          const struct geom_convex *piece,
                          const struct rivals_axis *axis,
                          struct parting *parting) {
  const struct sheet *sheet = rivals->sheet;
  const uint32_t *point =
      sheet->triangle.item[rivals->rival.item[parting->rival].triangle].point;
  const struct geom_point *a = &sheet->point.item[point[parting->side]],
                          *b = &sheet->point
                                    .item[point[(parting->side + 1) % 3]];
  double dx = (double)b->x - a->x, dy = (double)b->y - a->y;
  const struct geom_corner *last = &piece->corner[piece->count - 1];
  double before = dx * (last->y - a->y) - dy * (last->x - a->x);
  bool crosses = false;
  parting->half[0] = parting->half[1] = no_stretch;
  for (uint32_t k = 0; k < piece->count; k++) {
    const struct geom_corner *c = &piece->corner[k];
    double now = dx * (c->y - a->y) - dy * (c->x - a->x);
    widen(&parting->half[now < 0], along(axis, c->x, c->y));
    if ((before < 0) != (now < 0)) {
      double t = before / (before - now);
      double u = along(axis, last->x + t * (c->x - last->x),
                       last->y + t * (c->y - last->y));
      widen(&parting->half[0], u);
      widen(&parting->half[1], u);
      crosses = true;
    }
    before = now;
    last = c;
  }
  return crosses;
}

/* The share of the pairs that a parting leaves, by every step-th reach. */
static double pairs_left(const struct rival_reach *reach, size_t count,
                         size_t step, const struct stretch half[2]) {
  double left = 0, right = 0, all = 0;
  for (size_t i = 0; i < count; i += step, all++) {
    left += is_along(&half[0], &reach[i]);
    right += is_along(&half[1], &reach[i]);
  }
  return (left * left + right * right) / (all * all);
}

static bool choose_parting(const struct rivals *rivals,
                           const struct geom_convex *piece,
                           const struct rivals_axis *axis, size_t count,
                           struct parting *best) {
  const struct rival_reach *reach =
      rivals->reach.item + (rivals->reach.count - count);
  double least = MOST_LEFT;
  *best = (struct parting){0};
  for (size_t i = 0; i < LINES && least > GOOD; i++) {
    struct parting now = {.rival =
                              reach[(2 * i + 1) * count / (2 * LINES)].rival};
    for (now.side = 0; now.side < 3; now.side++) {
      double left;
      if (!find_crossing(rivals, piece, axis, &now))
        continue;
      left = pairs_left(reach, count, count / SAMPLE + 1, now.half);
      if (left >= least)
        continue;
      least = left;
      *best = now;
    }
  }
  return least < MOST_LEFT;
}

/* Where a half is along the axis, with a margin. */
static struct stretch stretch_of(const struct rivals_axis *axis,
                                 const struct geom_convex *piece) {
  struct stretch stretch = no_stretch;
  for (uint32_t k = 0; k < piece->count; k++)
    widen(&stretch, along(axis, piece->corner[k].x, piece->corner[k].y));
  stretch.from -= REACH_MARGIN;
  stretch.to += REACH_MARGIN;
  return stretch;
}

/* Puts a part on the stack, without its reaches.
 * axis  what these are along */
static bool push_part(struct rivals *rivals, const struct geom_convex *piece,
                      const struct rivals_axis *axis) {
  struct rivals_part part = {*piece, rivals->reach.count, *axis};
  return ARRAY_PUSH(&rivals->part, part);
}

/* Puts two halves on the stack, with the reaches along each; the part's own are
 * the last `count` ones, and make room.
 * divided  false: the parting was no good, for the sample was wrong; nothing
 *          was done */
static bool divide(struct rivals *rivals, const struct geom_convex *piece,
                   const struct rivals_axis *axis, size_t count,
                   const struct parting *parting, bool *divided) {
  struct rival *rival = &rivals->rival.item[parting->rival];
  struct geom_convex half[2];
  struct stretch stretch[2];
  size_t own = rivals->reach.count - count;
  *divided = false;
  if (!make_lines(rivals, rival) ||
      !geom_convex_split(piece, &rival->line[parting->side],
                         &rival->line[rival->lines + parting->side], &half[0],
                         &half[1], &rivals->arena))
    return false;
  for (int h = 0; h < 2; h++)
    stretch[h] = stretch_of(axis, &half[h]);
  if (half[0].count == 0 || half[1].count == 0 ||
      pairs_left(rivals->reach.item + own, count, 1, stretch) > MOST_DIVIDED)
    return true;
  rivals->scratch.count = 0;
  if (!ARRAY_RESERVE(&rivals->scratch, count) ||
      !ARRAY_RESERVE(&rivals->reach, count))
    return false;
  memcpy(rivals->scratch.item, rivals->reach.item + own,
         count * sizeof *rivals->scratch.item);
  rivals->reach.count = own;
  for (int h = 0; h < 2; h++) {
    struct rivals_axis own_axis = *axis;
    own_axis.age++;
    own_axis.u0 = stretch[h].from;
    own_axis.u1 = stretch[h].to;
    if (!push_part(rivals, &half[h], &own_axis))
      return false;
    for (size_t i = 0; i < count; i++)
      if (is_along(&stretch[h], &rivals->scratch.item[i]))
        rivals->reach.item[rivals->reach.count++] = rivals->scratch.item[i];
  }
  rivals->counts.partings++;
  *divided = true;
  return true;
}

/* Is some corner of the part outside a side of the rival, for certain? */
static bool reaches_out(const struct rivals *rivals, const struct rival *rival,
                        const struct geom_convex *piece) {
  const struct sheet *sheet = rivals->sheet;
  const uint32_t *point = sheet->triangle.item[rival->triangle].point;
  for (int k = 0; k < 3; k++) {
    const struct geom_point *a = &sheet->point.item[point[k]],
                            *b = &sheet->point.item[point[k == 2 ? 0 : k + 1]];
    double dx = (double)b->x - a->x, dy = (double)b->y - a->y;
    double bound = -(fabs(dx) + fabs(dy));
    for (uint32_t c = 0; c < piece->count; c++)
      if (dx * (piece->corner[c].y - a->y) - dy * (piece->corner[c].x - a->x) <
          bound)
        return true;
  }
  return false;
}

/* Finds whether the part is hidden by one of its rivals alone. */
static bool find_cover(struct rivals *rivals, size_t count,
                       const struct geom_convex *piece, bool *covered) {
  const struct rival_reach *reach =
      rivals->reach.item + (rivals->reach.count - count);
  int lines;
  *covered = false;
  for (size_t i = 0; i < count && !*covered; i++) {
    struct rival *rival = &rivals->rival.item[reach[i].rival];
    if (reaches_out(rivals, rival, piece))
      continue;
    if (!make_lines(rivals, rival))
      return false;
    *covered = meeting_of(rivals, rival, piece, &lines) == MEETING_ALL;
  }
  return true;
}

/* The one of the last `count` reaches that is longest along the part, where it
 * is long; else `count`. */
static size_t find_long(const struct rivals *rivals,
                        const struct rivals_axis *axis, size_t count) {
  const struct rival_reach *reach =
      rivals->reach.item + (rivals->reach.count - count);
  double most = LONG * (axis->u1 - axis->u0);
  size_t longest = count;
  for (size_t i = 0; i < count; i++) {
    double length =
        least(reach[i].to, axis->u1) - most_of(reach[i].from, axis->u0);
    if (length <= most)
      continue;
    most = length;
    longest = i;
  }
  return longest;
}

/* Takes one of the last `count` reaches' rivals from the part, and puts what is
 * left of it on the stack with the others. */
static bool take_one(struct rivals *rivals, const struct geom_convex *piece,
                     size_t count, size_t which) {
  size_t own = rivals->reach.count - count, others = count - 1;
  struct rival *rival =
      &rivals->rival.item[rivals->reach.item[own + which].rival];
  rivals->next.count = 0;
  if (!subtract(rivals, piece, rival))
    return false;
  rivals->reach.item[own + which] = rivals->reach.item[own + others];
  rivals->reach.count = own + others;
  if (rivals->next.count == 0)
    rivals->reach.count = own;
  for (size_t i = 0; i < rivals->next.count; i++) {
    struct rivals_part part = {rivals->next.item[i],
                               rivals->reach.count - others, no_axis};
    if (!ARRAY_PUSH(&rivals->part, part))
      return false;
    if (i + 1 == rivals->next.count)
      break;
    if (!ARRAY_RESERVE(&rivals->reach, others))
      return false;
    memcpy(rivals->reach.item + rivals->reach.count,
           rivals->reach.item + (rivals->reach.count - others),
           others * sizeof *rivals->reach.item);
    rivals->reach.count += others;
  }
  return true;
}

/* Divides the part on top of the stack, which has been taken off it, or drops
 * it where it is hidden, or leaves the last *count reaches to be taken. */
static bool part_further(struct rivals *rivals, struct rivals_part *part,
                         size_t *count, bool *done) {
  const struct geom_convex *piece = &part->piece;
  struct parting parting;
  size_t longest;
  if (part->axis.age >= AXIS_AGE) {
    part->axis = axis_of(piece);
    *count = sift(rivals, &part->axis, *count);
  }
  if (!find_cover(rivals, *count, piece, done))
    return false;
  if (*done) {
    rivals->whole = false;
    rivals->reach.count -= *count;
    return true;
  }
  if (*count <= FEW)
    return true;
  longest = find_long(rivals, &part->axis, *count);
  if (longest < *count) {
    *done = true;
    return take_one(rivals, piece, *count, longest);
  }
  if (!choose_parting(rivals, piece, &part->axis, *count, &parting)) {
    if (part->axis.age == 0)
      return true;
    part->axis = no_axis; /* once more, along its own */
    *done = true;
    return ARRAY_PUSH(&rivals->part, *part);
  }
  return divide(rivals, piece, &part->axis, *count, &parting, done);
}

static bool solve_part(struct rivals *rivals) {
  struct rivals_part part = rivals->part.item[--rivals->part.count];
  size_t count = rivals->reach.count - part.from;
  bool done = false;
  if (count > FEW && !part_further(rivals, &part, &count, &done))
    return false;
  if (done)
    return true;
  if (!take_few(rivals, &part.piece, count))
    return false;
  rivals->reach.count = part.from;
  return true;
}

/* Of a part that may be parted again, in units of a pulse. */
enum { PART_WORK = 256 };

/* Lists all rivals.  What may cover most comes first: what it takes is not cut
 * again. */
static bool list_all(struct rivals *rivals) {
  size_t n = rivals->rival.count;
  rivals->reach.count = rivals->key.count = 0;
  if (!ARRAY_RESERVE(&rivals->reach, n) || !ARRAY_RESERVE(&rivals->key, 2 * n))
    return false;
  for (size_t i = 0; i < n; i++) {
    uint64_t bits; /* order as the numbers do, which are not negative */
    memcpy(&bits, &rivals->rival.item[i].share, sizeof bits);
    rivals->key.item[i] =
        (struct sort_key){UINT32_MAX - (bits >> 32), (uint32_t)i};
  }
  sort_keys(rivals->key.item, rivals->key.item + n, n);
  for (size_t i = 0; i < n; i++)
    rivals->reach.item[i] =
        (struct rival_reach){-INFINITY, INFINITY, rivals->key.item[i].value};
  rivals->reach.count = n;
  return true;
}

bool rivals_take_all(struct rivals *rivals) {
  struct geom_convex piece;
  struct geom_line *line = arena_alloc(&rivals->arena, 6, sizeof *line);
  if (line == NULL)
    return false;
  triangle_lines(rivals->sheet, rivals->triangle, line, line + 3);
  rivals->left.count = rivals->part.count = rivals->reach.count = 0;
  rivals->whole = true;
  if (!geom_convex_triangle(&piece, rivals->plane.p, line, &rivals->arena) ||
      !push_part(rivals, &piece, &no_axis) || !list_all(rivals))
    return false;
  while (rivals->part.count > 0)
    if (!pulse_beat(rivals->pulse, PART_WORK) || !solve_part(rivals))
      return false;
  return true;
}

void rivals_report(const struct rivals_counts *counts, struct report *report) {
  report_add(report, "faces", "pairs", (int64_t)counts->pairs);
  report_add(report, "faces", "overlapping", (int64_t)counts->overlapping);
  report_add(report, "faces", "filter_failures", (int64_t)counts->exact);
  report_add(report, "faces", "depth_crossings", (int64_t)counts->crossings);
  report_add(report, "faces", "partings", (int64_t)counts->partings);
  report_add(report, "faces", "cuts", (int64_t)counts->cuts);
}
