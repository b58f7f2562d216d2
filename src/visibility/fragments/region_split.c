/* region_split.c - splits a triangle recursively until few occluders overlap
 * each region, and subtracts these.
 *
 * Phases, for each region on an explicit stack
 *   1 a region that a single occluder covers is hidden and dropped
 *   2 a region with few occluders is solved by subtracting them
 *   3 an occluder that extends along most of the region is subtracted at once,
 *     and what remains goes back on the stack
 *   4 otherwise the region is split by the line of an occluder's side, as long
 *     as that clearly reduces the number of pairs of region and occluder; if no
 *     line does, all its occluders are subtracted
 *
 * Invariants
 *   A region lists every occluder that overlaps it, and possibly some that do
 *   not.
 *   What remains is a union of convex pieces.  It is the same set of points
 *   whatever the regions were: the heuristics here only choose how to split.
 */
#include "visibility/fragments/occluder_subtraction.h"

#include <math.h>
#include <string.h>

enum {
  SMALL_LIST_MAX = 6,  /* so many occluders are subtracted without a split */
  CANDIDATE_LINES = 6, /* occluders whose sides are tried as split lines */
  SAMPLE = 24          /* occluders that estimate the effect of a line */
};

/* The share of the pairs of region and occluder that a split may leave:
 *   PAIRS_LEFT_MAX   by the estimate, for a line to be chosen
 *   PAIRS_LEFT_GOOD  by the estimate, for the search to stop at this line
 *   PAIRS_LEFT_SPLIT by the true count, for the split to be made; being below
 *                    1, it makes the recursion end */
#define PAIRS_LEFT_MAX 0.8
#define PAIRS_LEFT_GOOD 0.55
#define PAIRS_LEFT_SPLIT 0.9

/* An occluder that extends along at least this share of a region would overlap
 * most of the regions that it is split into: it is subtracted first. */
#define LONG_SHARE 0.6

/* Splits after which a region's axis is computed anew: extents along the axis
 * of a larger region may be too long. */
enum { AXIS_SPLITS_MAX = 3 };
static const struct region_axis no_axis = {.splits = AXIS_SPLITS_MAX};

/* Grid units.  Extents are computed in doubles from corners whose error is at
 * most 1/4 unit (line.c). */
#define EXTENT_MARGIN 2.0

/* fmin and fmax are calls, not instructions, because of NaN; these operands are
 * never NaN. */
static inline double min_of(double a, double b) { return a < b ? a : b; }
static inline double max_of(double a, double b) { return a > b ? a : b; }

static double along(const struct region_axis *axis, double x, double y) {
  return (x - axis->x) * axis->dx + (y - axis->y) * axis->dy;
}

static double across(const struct region_axis *axis, double x, double y) {
  return (y - axis->y) * axis->dx - (x - axis->x) * axis->dy;
}

/* The axis of a region: through its first corner, parallel to the longest of
 * its sides and of its diagonals from that corner. */
static struct region_axis axis_of(const struct geom_convex *piece) {
  const struct geom_corner *c = piece->corner;
  struct region_axis axis = {.x = c[0].x, .y = c[0].y, .dx = 1};
  double most = 0;
  for (uint32_t k = 1; k < piece->count; k++) {
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
    axis.u0 = min_of(axis.u0, u - EXTENT_MARGIN);
    axis.u1 = max_of(axis.u1, u + EXTENT_MARGIN);
    axis.v0 = min_of(axis.v0, v - EXTENT_MARGIN);
    axis.v1 = max_of(axis.v1, v + EXTENT_MARGIN);
  }
  return axis;
}

/* Extends an extent to the point where segment pq crosses the line v = at. */
static void extend_to_crossing(struct face_occluder_extent *extent,
                               const double p[2], const double q[2],
                               double at) {
  if ((p[1] < at) == (q[1] < at))
    return;
  double u = p[0] + (q[0] - p[0]) * ((at - p[1]) / (q[1] - p[1]));
  extent->from = min_of(extent->from, u);
  extent->to = max_of(extent->to, u);
}

/* Finds the interval of the axis over which an occluder may overlap the
 * region's strip v0 <= v <= v1.  Returns whether it meets the region's own
 * interval. */
static bool find_extent(const struct occluder_subtraction *subtraction,
                        const struct region_axis *axis,
                        struct face_occluder_extent *extent) {
  const struct sheet *sheet = subtraction->sheet;
  const uint32_t *point =
      sheet->triangle
          .item[subtraction->occluder.item[extent->occluder].triangle]
          .point;
  double p[3][2];
  extent->from = INFINITY;
  extent->to = -INFINITY;
  for (int k = 0; k < 3; k++) {
    const struct geom_point *at = &sheet->point.item[point[k]];
    p[k][0] = along(axis, at->x, at->y);
    p[k][1] = across(axis, at->x, at->y);
    if (p[k][1] >= axis->v0 && p[k][1] <= axis->v1) {
      extent->from = min_of(extent->from, p[k][0]);
      extent->to = max_of(extent->to, p[k][0]);
    }
  }
  for (int k = 0; k < 3; k++) {
    const double *q = p[k == 2 ? 0 : k + 1];
    extend_to_crossing(extent, p[k], q, axis->v0);
    extend_to_crossing(extent, p[k], q, axis->v1);
  }
  extent->from -= EXTENT_MARGIN;
  extent->to += EXTENT_MARGIN;
  return extent->from <= axis->u1 && extent->to >= axis->u0;
}

/* Recomputes the last `count` extents along a new axis and removes those that
 * do not meet the region.  Returns how many are left, at the end of the
 * list. */
static size_t recompute_extents(struct occluder_subtraction *subtraction,
                                const struct region_axis *axis, size_t count) {
  size_t from = subtraction->extent.count - count, kept = from;
  for (size_t i = from; i < subtraction->extent.count; i++) {
    struct face_occluder_extent extent = subtraction->extent.item[i];
    if (find_extent(subtraction, axis, &extent))
      subtraction->extent.item[kept++] = extent;
  }
  subtraction->extent.count = kept;
  return kept - from;
}

/* An interval of the axis. */
struct axis_interval {
  double from, to;
};

static const struct axis_interval no_interval = {INFINITY, -INFINITY};

static void widen(struct axis_interval *interval, double u) {
  interval->from = min_of(interval->from, u);
  interval->to = max_of(interval->to, u);
}

static bool overlaps(const struct axis_interval *interval,
                     const struct face_occluder_extent *extent) {
  return extent->from <= interval->to && extent->to >= interval->from;
}

/* A side of an occluder, and the approximate intervals along the axis of the
 * two halves into which its line splits a region. */
struct split_line {
  uint32_t occluder;
  int side;
  struct axis_interval half[2]; /* left of the line, right of it */
};

/* Finds the halves into which the line of a side splits a region, in doubles.
 * Returns whether the line crosses the region. */
static bool find_halves(const struct occluder_subtraction *subtraction,
                        const struct geom_convex *piece,
                        const struct region_axis *axis,
                        struct split_line *line) {
  const struct sheet *sheet = subtraction->sheet;
  const uint32_t *point =
      sheet->triangle.item[subtraction->occluder.item[line->occluder].triangle]
          .point;
  const struct geom_point *a = &sheet->point.item[point[line->side]],
                          *b = &sheet->point.item[point[(line->side + 1) % 3]];
  double dx = (double)b->x - a->x, dy = (double)b->y - a->y;
  const struct geom_corner *last = &piece->corner[piece->count - 1];
  double before = dx * (last->y - a->y) - dy * (last->x - a->x);
  bool crosses = false;
  line->half[0] = line->half[1] = no_interval;
  for (uint32_t k = 0; k < piece->count; k++) {
    const struct geom_corner *c = &piece->corner[k];
    double now = dx * (c->y - a->y) - dy * (c->x - a->x);
    widen(&line->half[now < 0], along(axis, c->x, c->y));
    if ((before < 0) != (now < 0)) {
      double t = before / (before - now);
      double u = along(axis, last->x + t * (c->x - last->x),
                       last->y + t * (c->y - last->y));
      widen(&line->half[0], u);
      widen(&line->half[1], u);
      crosses = true;
    }
    before = now;
    last = c;
  }
  return crosses;
}

/* The share of the pairs that a split leaves, estimated from every step-th
 * extent: of n occluders in all, of which l overlap the left half and r the
 * right one, (l^2 + r^2) / n^2. */
static double pairs_left(const struct face_occluder_extent *extent,
                         size_t count, size_t step,
                         const struct axis_interval half[2]) {
  double left = 0, right = 0, all = 0;
  for (size_t i = 0; i < count; i += step, all++) {
    left += overlaps(&half[0], &extent[i]);
    right += overlaps(&half[1], &extent[i]);
  }
  return (left * left + right * right) / (all * all);
}

/* Chooses the line that leaves the smallest share of the pairs.  Returns false
 * if no line is good enough. */
static bool choose_split_line(const struct occluder_subtraction *subtraction,
                              const struct geom_convex *piece,
                              const struct region_axis *axis, size_t count,
                              struct split_line *best) {
  const struct face_occluder_extent *extent =
      subtraction->extent.item + (subtraction->extent.count - count);
  double least = PAIRS_LEFT_MAX;
  *best = (struct split_line){0};
  for (size_t i = 0; i < CANDIDATE_LINES && least > PAIRS_LEFT_GOOD; i++) {
    struct split_line now = {
        .occluder =
            extent[(2 * i + 1) * count / (2 * CANDIDATE_LINES)].occluder};
    for (now.side = 0; now.side < 3; now.side++) {
      double left;
      if (!find_halves(subtraction, piece, axis, &now))
        continue;
      left = pairs_left(extent, count, count / SAMPLE + 1, now.half);
      if (left >= least)
        continue;
      least = left;
      *best = now;
    }
  }
  return least < PAIRS_LEFT_MAX;
}

/* The interval of a piece along the axis, with a margin. */
static struct axis_interval interval_of(const struct region_axis *axis,
                                        const struct geom_convex *piece) {
  struct axis_interval interval = no_interval;
  for (uint32_t k = 0; k < piece->count; k++)
    widen(&interval, along(axis, piece->corner[k].x, piece->corner[k].y));
  interval.from -= EXTENT_MARGIN;
  interval.to += EXTENT_MARGIN;
  return interval;
}

/* Pushes a region on the stack, without its extents.
 * axis  what the extents that follow are measured along */
static bool push_region(struct occluder_subtraction *subtraction,
                        const struct geom_convex *piece,
                        const struct region_axis *axis) {
  struct region region = {*piece, subtraction->extent.count, *axis};
  return ARRAY_PUSH(&subtraction->region, region);
}

/* Splits a region and pushes both halves with their extents, which replace the
 * last `count` ones, those of the region.
 * done  false if the split leaves more pairs than the sample had suggested, and
 *       too many; nothing was changed then */
static bool split_region(struct occluder_subtraction *subtraction,
                         const struct geom_convex *piece,
                         const struct region_axis *axis, size_t count,
                         const struct split_line *line, bool *done) {
  struct face_occluder *occluder = &subtraction->occluder.item[line->occluder];
  struct geom_convex half[2];
  struct axis_interval interval[2];
  size_t own = subtraction->extent.count - count;
  *done = false;
  if (!face_occluder_make_lines(subtraction, occluder) ||
      !geom_convex_split(
          piece, &occluder->line[line->side],
          &occluder->line[occluder->sides + occluder->crosses + line->side],
          &half[0], &half[1], &subtraction->arena))
    return false;
  for (int h = 0; h < 2; h++)
    interval[h] = interval_of(axis, &half[h]);
  if (half[0].count == 0 || half[1].count == 0 ||
      pairs_left(subtraction->extent.item + own, count, 1, interval) >
          PAIRS_LEFT_SPLIT)
    return true;
  subtraction->scratch.count = 0;
  if (!ARRAY_RESERVE(&subtraction->scratch, count) ||
      !ARRAY_RESERVE(&subtraction->extent, count))
    return false;
  memcpy(subtraction->scratch.item, subtraction->extent.item + own,
         count * sizeof *subtraction->scratch.item);
  subtraction->extent.count = own;
  for (int h = 0; h < 2; h++) {
    struct region_axis own_axis = *axis;
    own_axis.splits++;
    own_axis.u0 = interval[h].from;
    own_axis.u1 = interval[h].to;
    if (!push_region(subtraction, &half[h], &own_axis))
      return false;
    for (size_t i = 0; i < count; i++)
      if (overlaps(&interval[h], &subtraction->scratch.item[i]))
        subtraction->extent.item[subtraction->extent.count++] =
            subtraction->scratch.item[i];
  }
  subtraction->counts.splits++;
  *done = true;
  return true;
}

/* Returns true only if some corner of the piece lies outside the occluder: a
 * filter in doubles with an error bound. */
static bool
is_surely_not_contained(const struct occluder_subtraction *subtraction,
                        const struct face_occluder *occluder,
                        const struct geom_convex *piece) {
  const struct sheet *sheet = subtraction->sheet;
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

/* Decides whether a single one of its occluders covers the region. */
static bool find_single_occluder(struct occluder_subtraction *subtraction,
                                 size_t count, const struct geom_convex *piece,
                                 bool *covered) {
  const struct face_occluder_extent *extent =
      subtraction->extent.item + (subtraction->extent.count - count);
  *covered = false;
  for (size_t i = 0; i < count && !*covered; i++) {
    struct face_occluder *occluder =
        &subtraction->occluder.item[extent[i].occluder];
    if (is_surely_not_contained(subtraction, occluder, piece))
      continue;
    if (!face_occluder_make_lines(subtraction, occluder))
      return false;
    *covered = face_occluder_covers(subtraction, occluder, piece);
  }
  return true;
}

/* Returns which of the last `count` extents is the longest within the region,
 * if it is at least LONG_SHARE of it; otherwise `count`. */
static size_t find_long_extent(const struct occluder_subtraction *subtraction,
                               const struct region_axis *axis, size_t count) {
  const struct face_occluder_extent *extent =
      subtraction->extent.item + (subtraction->extent.count - count);
  double most = LONG_SHARE * (axis->u1 - axis->u0);
  size_t longest = count;
  for (size_t i = 0; i < count; i++) {
    double length =
        min_of(extent[i].to, axis->u1) - max_of(extent[i].from, axis->u0);
    if (length <= most)
      continue;
    most = length;
    longest = i;
  }
  return longest;
}

/* Subtracts the occluders of the last `count` extents from a piece, one after
 * another, and appends what remains to subtraction->left. */
static bool subtract_last(struct occluder_subtraction *subtraction,
                          const struct geom_convex *piece, size_t count) {
  const struct face_occluder_extent *extent =
      subtraction->extent.item + (subtraction->extent.count - count);
  geom_pieces *rest = &subtraction->rest;
  rest->count = 0;
  if (!ARRAY_PUSH(rest, *piece))
    return false;
  for (size_t i = 0; i < count && rest->count > 0; i++)
    if (!face_occluder_subtract(
            subtraction, rest, &subtraction->occluder.item[extent[i].occluder]))
      return false;
  for (size_t k = 0; k < rest->count; k++)
    if (!ARRAY_PUSH(&subtraction->left, rest->item[k]))
      return false;
  return true;
}

/* Subtracts the occluder of one of the last `count` extents from the region,
 * and pushes each remaining piece with the other extents. */
static bool subtract_one(struct occluder_subtraction *subtraction,
                         const struct geom_convex *piece, size_t count,
                         size_t which) {
  size_t own = subtraction->extent.count - count, others = count - 1;
  struct face_occluder *occluder =
      &subtraction->occluder
           .item[subtraction->extent.item[own + which].occluder];
  geom_pieces *rest = &subtraction->rest;
  rest->count = 0;
  if (!ARRAY_PUSH(rest, *piece) ||
      !face_occluder_subtract(subtraction, rest, occluder))
    return false;
  subtraction->extent.item[own + which] =
      subtraction->extent.item[own + others];
  subtraction->extent.count = own + others;
  if (rest->count == 0)
    subtraction->extent.count = own;
  for (size_t i = 0; i < rest->count; i++) {
    struct region region = {rest->item[i], subtraction->extent.count - others,
                            no_axis};
    if (!ARRAY_PUSH(&subtraction->region, region))
      return false;
    if (i + 1 == rest->count)
      break;
    if (!ARRAY_RESERVE(&subtraction->extent, others))
      return false;
    memcpy(subtraction->extent.item + subtraction->extent.count,
           subtraction->extent.item + (subtraction->extent.count - others),
           others * sizeof *subtraction->extent.item);
    subtraction->extent.count += others;
  }
  return true;
}

/* Processes a region that was popped from the stack and has a long list.
 * count  how many extents it has; updated
 * done   whether the region was dropped as hidden, or replaced by smaller ones;
 *        false: the occluders of the last *count extents are to be
 *        subtracted */
static bool reduce_region(struct occluder_subtraction *subtraction,
                          struct region *region, size_t *count, bool *done) {
  const struct geom_convex *piece = &region->piece;
  struct split_line line;
  size_t longest;
  if (region->axis.splits >= AXIS_SPLITS_MAX) {
    region->axis = axis_of(piece);
    *count = recompute_extents(subtraction, &region->axis, *count);
  }
  if (!find_single_occluder(subtraction, *count, piece, done))
    return false;
  if (*done) {
    subtraction->whole = false;
    subtraction->extent.count -= *count;
    return true;
  }
  if (*count <= SMALL_LIST_MAX)
    return true;
  longest = find_long_extent(subtraction, &region->axis, *count);
  if (longest < *count) {
    *done = true;
    return subtract_one(subtraction, piece, *count, longest);
  }
  if (!choose_split_line(subtraction, piece, &region->axis, *count, &line)) {
    if (region->axis.splits == 0)
      return true;
    region->axis = no_axis; /* try again along its own axis */
    *done = true;
    return ARRAY_PUSH(&subtraction->region, *region);
  }
  return split_region(subtraction, piece, &region->axis, *count, &line, done);
}

static bool solve_region(struct occluder_subtraction *subtraction) {
  struct region region = subtraction->region.item[--subtraction->region.count];
  size_t count = subtraction->extent.count - region.first_extent;
  bool ok = false;
  if (count > SMALL_LIST_MAX &&
      !reduce_region(subtraction, &region, &count, &ok))
    return false;
  if (ok)
    return true;
  if (!subtract_last(subtraction, &region.piece, count))
    return false;
  subtraction->extent.count = region.first_extent;
  return true;
}

/* Work per region, in the units of progress.h. */
enum { REGION_WORK = 256 };

/* The area that two overlapping boxes share, in square grid units. */
static double shared_area(struct box2 a, struct box2 b) {
  double width = (double)box2_min(a.x1, b.x1) - box2_max(a.x0, b.x0);
  double height = (double)box2_min(a.y1, b.y1) - box2_max(a.y0, b.y0);
  return width * height;
}

/* Lists all occluders, those that may cover the largest area first: what they
 * cover need not be split again. */
static bool list_all_occluders(struct occluder_subtraction *subtraction) {
  size_t n = subtraction->occluder.count;
  subtraction->extent.count = subtraction->key.count = 0;
  if (!ARRAY_RESERVE(&subtraction->extent, n) ||
      !ARRAY_RESERVE(&subtraction->key, 2 * n))
    return false;
  for (size_t i = 0; i < n; i++) {
    uint64_t bits; /* ordered as the areas are, which are not negative */
    double area =
        shared_area(subtraction->box, subtraction->occluder.item[i].box);
    memcpy(&bits, &area, sizeof bits);
    subtraction->key.item[i] =
        (struct sort_key){UINT32_MAX - (bits >> 32), (uint32_t)i};
  }
  sort_keys(subtraction->key.item, subtraction->key.item + n, n);
  for (size_t i = 0; i < n; i++)
    subtraction->extent.item[i] = (struct face_occluder_extent){
        -INFINITY, INFINITY, subtraction->key.item[i].value};
  subtraction->extent.count = n;
  return true;
}

bool occluder_subtraction_take_all(struct occluder_subtraction *subtraction) {
  struct geom_convex piece = subtraction->left.item[0];
  subtraction->left.count = subtraction->region.count = 0;
  subtraction->extent.count = 0;
  if (!push_region(subtraction, &piece, &no_axis) ||
      !list_all_occluders(subtraction))
    return false;
  while (subtraction->region.count > 0)
    if (!progress_step(subtraction->progress, REGION_WORK) ||
        !solve_region(subtraction))
      return false;
  return true;
}
