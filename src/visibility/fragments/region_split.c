/* region_split.c - a triangle is parted until few rivals are about any part.
 *
 * It is parted by a side of a rival as long as that leaves clearly fewer pairs
 * of part and rival.
 * Invariants
 *   A part lists every rival that overlaps it; of others it may list some.
 *   What is left is a union of convex parts.  It is the same set whatever the
 *   parts were: what is decided here only chooses.
 */
#include "visibility/fragments/face_occluders.h"

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
static const struct region_axis no_axis = {.age = AXIS_AGE};

/* Reaches are in doubles of corners that are off by 1/4 unit or less (line.c):
 * this is room enough. */
#define REACH_MARGIN 2.0

/* The library's are calls, for the sake of what is no number. */
static inline double least(double a, double b) { return a < b ? a : b; }
static inline double most_of(double a, double b) { return a > b ? a : b; }

static double along(const struct region_axis *axis, double x, double y) {
  return (x - axis->x) * axis->dx + (y - axis->y) * axis->dy;
}

static double across(const struct region_axis *axis, double x, double y) {
  return (y - axis->y) * axis->dx - (x - axis->x) * axis->dy;
}

static struct region_axis axis_of(const struct geom_convex *piece) {
  const struct geom_corner *c = piece->corner;
  struct region_axis axis = {.x = c[0].x, .y = c[0].y, .dx = 1};
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
static void reach_crossing(struct face_occluder_extent *reach,
                           const double p[2], const double q[2], double at) {
  double u;
  if ((p[1] < at) == (q[1] < at))
    return;
  u = p[0] + (q[0] - p[0]) * ((at - p[1]) / (q[1] - p[1]));
  reach->from = least(reach->from, u);
  reach->to = most_of(reach->to, u);
}

/* Where a rival may be along the axis, within the part's breadth; false:
 * nowhere. */
static bool find_reach(const struct face_occluders *occluders,
                       const struct region_axis *axis,
                       struct face_occluder_extent *reach) {
  const struct sheet *sheet = occluders->sheet;
  const uint32_t *point =
      sheet->triangle.item[occluders->occluder.item[reach->occluder].triangle]
          .point;
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
static size_t sift(struct face_occluders *occluders,
                   const struct region_axis *axis, size_t count) {
  size_t from = occluders->reach.count - count, kept = from;
  for (size_t i = from; i < occluders->reach.count; i++) {
    struct face_occluder_extent reach = occluders->reach.item[i];
    if (find_reach(occluders, axis, &reach))
      occluders->reach.item[kept++] = reach;
  }
  occluders->reach.count = kept;
  return kept - from;
}

/* A stretch of the axis. */
struct axis_stretch {
  double from, to;
};

static const struct axis_stretch no_stretch = {INFINITY, -INFINITY};

static void widen(struct axis_stretch *stretch, double u) {
  stretch->from = least(stretch->from, u);
  stretch->to = most_of(stretch->to, u);
}

static bool is_along(const struct axis_stretch *stretch,
                     const struct face_occluder_extent *reach) {
  return reach->from <= stretch->to && reach->to >= stretch->from;
}

/* A side of a rival, and about where its line leaves halves of a part along
 * its axis. */
struct split_line {
  uint32_t occluder;
  int side;
  struct axis_stretch half[2]; /* left of the line, right of it */
};

/* Does the line of that side cross the part, and how? */
static bool find_crossing(const struct face_occluders *occluders,
                          const struct geom_convex *piece,
                          const struct region_axis *axis,
                          struct split_line *parting) {
  const struct sheet *sheet = occluders->sheet;
  const uint32_t *point =
      sheet->triangle.item[occluders->occluder.item[parting->occluder].triangle]
          .point;
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
static double pairs_left(const struct face_occluder_extent *reach, size_t count,
                         size_t step, const struct axis_stretch half[2]) {
  double left = 0, right = 0, all = 0;
  for (size_t i = 0; i < count; i += step, all++) {
    left += is_along(&half[0], &reach[i]);
    right += is_along(&half[1], &reach[i]);
  }
  return (left * left + right * right) / (all * all);
}

static bool choose_parting(const struct face_occluders *occluders,
                           const struct geom_convex *piece,
                           const struct region_axis *axis, size_t count,
                           struct split_line *best) {
  const struct face_occluder_extent *reach =
      occluders->reach.item + (occluders->reach.count - count);
  double least = MOST_LEFT;
  *best = (struct split_line){0};
  for (size_t i = 0; i < LINES && least > GOOD; i++) {
    struct split_line now = {
        .occluder = reach[(2 * i + 1) * count / (2 * LINES)].occluder};
    for (now.side = 0; now.side < 3; now.side++) {
      double left;
      if (!find_crossing(occluders, piece, axis, &now))
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
static struct axis_stretch stretch_of(const struct region_axis *axis,
                                      const struct geom_convex *piece) {
  struct axis_stretch stretch = no_stretch;
  for (uint32_t k = 0; k < piece->count; k++)
    widen(&stretch, along(axis, piece->corner[k].x, piece->corner[k].y));
  stretch.from -= REACH_MARGIN;
  stretch.to += REACH_MARGIN;
  return stretch;
}

/* Puts a part on the stack, without its reaches.
 * axis  what these are along */
static bool push_part(struct face_occluders *occluders,
                      const struct geom_convex *piece,
                      const struct region_axis *axis) {
  struct region part = {*piece, occluders->reach.count, *axis};
  return ARRAY_PUSH(&occluders->part, part);
}

/* Puts two halves on the stack, with the reaches along each; the part's own are
 * the last `count` ones, and make room.
 * divided  false: the parting was no good, for the sample was wrong; nothing
 *          was done */
static bool divide(struct face_occluders *occluders,
                   const struct geom_convex *piece,
                   const struct region_axis *axis, size_t count,
                   const struct split_line *parting, bool *divided) {
  struct face_occluder *occluder = &occluders->occluder.item[parting->occluder];
  struct geom_convex half[2];
  struct axis_stretch stretch[2];
  size_t own = occluders->reach.count - count;
  *divided = false;
  if (!face_occluder_make_lines(occluders, occluder) ||
      !geom_convex_split(piece, &occluder->line[parting->side],
                         &occluder->line[occluder->lines + parting->side],
                         &half[0], &half[1], &occluders->arena))
    return false;
  for (int h = 0; h < 2; h++)
    stretch[h] = stretch_of(axis, &half[h]);
  if (half[0].count == 0 || half[1].count == 0 ||
      pairs_left(occluders->reach.item + own, count, 1, stretch) > MOST_DIVIDED)
    return true;
  occluders->scratch.count = 0;
  if (!ARRAY_RESERVE(&occluders->scratch, count) ||
      !ARRAY_RESERVE(&occluders->reach, count))
    return false;
  memcpy(occluders->scratch.item, occluders->reach.item + own,
         count * sizeof *occluders->scratch.item);
  occluders->reach.count = own;
  for (int h = 0; h < 2; h++) {
    struct region_axis own_axis = *axis;
    own_axis.age++;
    own_axis.u0 = stretch[h].from;
    own_axis.u1 = stretch[h].to;
    if (!push_part(occluders, &half[h], &own_axis))
      return false;
    for (size_t i = 0; i < count; i++)
      if (is_along(&stretch[h], &occluders->scratch.item[i]))
        occluders->reach.item[occluders->reach.count++] =
            occluders->scratch.item[i];
  }
  occluders->counts.splits++;
  *divided = true;
  return true;
}

/* Is some corner of the part outside a side of the rival, for certain? */
static bool reaches_out(const struct face_occluders *occluders,
                        const struct face_occluder *occluder,
                        const struct geom_convex *piece) {
  const struct sheet *sheet = occluders->sheet;
  const uint32_t *point = sheet->triangle.item[occluder->triangle].point;
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
static bool find_cover(struct face_occluders *occluders, size_t count,
                       const struct geom_convex *piece, bool *covered) {
  const struct face_occluder_extent *reach =
      occluders->reach.item + (occluders->reach.count - count);
  *covered = false;
  for (size_t i = 0; i < count && !*covered; i++) {
    struct face_occluder *occluder =
        &occluders->occluder.item[reach[i].occluder];
    if (reaches_out(occluders, occluder, piece))
      continue;
    if (!face_occluder_make_lines(occluders, occluder))
      return false;
    *covered = face_occluder_covers(occluders, occluder, piece);
  }
  return true;
}

/* The one of the last `count` reaches that is longest along the part, where it
 * is long; else `count`. */
static size_t find_long(const struct face_occluders *occluders,
                        const struct region_axis *axis, size_t count) {
  const struct face_occluder_extent *reach =
      occluders->reach.item + (occluders->reach.count - count);
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
static bool take_one(struct face_occluders *occluders,
                     const struct geom_convex *piece, size_t count,
                     size_t which) {
  size_t own = occluders->reach.count - count, others = count - 1;
  struct face_occluder *occluder =
      &occluders->occluder.item[occluders->reach.item[own + which].occluder];
  occluders->next.count = 0;
  if (!face_occluder_subtract(occluders, piece, occluder))
    return false;
  occluders->reach.item[own + which] = occluders->reach.item[own + others];
  occluders->reach.count = own + others;
  if (occluders->next.count == 0)
    occluders->reach.count = own;
  for (size_t i = 0; i < occluders->next.count; i++) {
    struct region part = {occluders->next.item[i],
                          occluders->reach.count - others, no_axis};
    if (!ARRAY_PUSH(&occluders->part, part))
      return false;
    if (i + 1 == occluders->next.count)
      break;
    if (!ARRAY_RESERVE(&occluders->reach, others))
      return false;
    memcpy(occluders->reach.item + occluders->reach.count,
           occluders->reach.item + (occluders->reach.count - others),
           others * sizeof *occluders->reach.item);
    occluders->reach.count += others;
  }
  return true;
}

/* Divides the part on top of the stack, which has been taken off it, or drops
 * it where it is hidden, or leaves the last *count reaches to be taken. */
static bool part_further(struct face_occluders *occluders, struct region *part,
                         size_t *count, bool *done) {
  const struct geom_convex *piece = &part->piece;
  struct split_line parting;
  size_t longest;
  if (part->axis.age >= AXIS_AGE) {
    part->axis = axis_of(piece);
    *count = sift(occluders, &part->axis, *count);
  }
  if (!find_cover(occluders, *count, piece, done))
    return false;
  if (*done) {
    occluders->whole = false;
    occluders->reach.count -= *count;
    return true;
  }
  if (*count <= FEW)
    return true;
  longest = find_long(occluders, &part->axis, *count);
  if (longest < *count) {
    *done = true;
    return take_one(occluders, piece, *count, longest);
  }
  if (!choose_parting(occluders, piece, &part->axis, *count, &parting)) {
    if (part->axis.age == 0)
      return true;
    part->axis = no_axis; /* once more, along its own */
    *done = true;
    return ARRAY_PUSH(&occluders->part, *part);
  }
  return divide(occluders, piece, &part->axis, *count, &parting, done);
}

static bool solve_part(struct face_occluders *occluders) {
  struct region part = occluders->part.item[--occluders->part.count];
  size_t count = occluders->reach.count - part.from;
  bool ok = false;
  if (count > FEW && !part_further(occluders, &part, &count, &ok))
    return false;
  if (ok)
    return true;
  if (!face_occluders_subtract_few(occluders, &part.piece, count))
    return false;
  occluders->reach.count = part.from;
  return true;
}

/* Of a part that may be parted again, in units of a pulse. */
enum { PART_WORK = 256 };

/* Lists all rivals.  What may cover most comes first: what it takes is not cut
 * again. */
static bool list_all(struct face_occluders *occluders) {
  size_t n = occluders->occluder.count;
  occluders->reach.count = occluders->key.count = 0;
  if (!ARRAY_RESERVE(&occluders->reach, n) ||
      !ARRAY_RESERVE(&occluders->key, 2 * n))
    return false;
  for (size_t i = 0; i < n; i++) {
    uint64_t bits; /* order as the numbers do, which are not negative */
    memcpy(&bits, &occluders->occluder.item[i].share, sizeof bits);
    occluders->key.item[i] =
        (struct sort_key){UINT32_MAX - (bits >> 32), (uint32_t)i};
  }
  sort_keys(occluders->key.item, occluders->key.item + n, n);
  for (size_t i = 0; i < n; i++)
    occluders->reach.item[i] = (struct face_occluder_extent){
        -INFINITY, INFINITY, occluders->key.item[i].value};
  occluders->reach.count = n;
  return true;
}

bool face_occluders_subtract_all(struct face_occluders *occluders) {
  struct geom_convex piece;
  struct geom_line *line = arena_alloc(&occluders->arena, 6, sizeof *line);
  if (line == NULL)
    return false;
  triangle_lines(occluders->sheet, occluders->triangle, line, line + 3);
  occluders->left.count = occluders->part.count = occluders->reach.count = 0;
  occluders->whole = true;
  if (!geom_convex_triangle(&piece, occluders->plane.p, line,
                            &occluders->arena) ||
      !push_part(occluders, &piece, &no_axis) || !list_all(occluders))
    return false;
  while (occluders->part.count > 0)
    if (!progress_step(occluders->progress, PART_WORK) ||
        !solve_part(occluders))
      return false;
  return true;
}
