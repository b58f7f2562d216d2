/* watkins_interval.c - the facets visible in an interval between two edges.
 *
 * Rules    The visible facet is
 *            - the only one in the interval;
 *            - the one whose corners are all nearer than those of the others;
 *            - else the nearest at the interval's middle (at the ends facets
 *              may touch), unless it intersects another inside the interval.
 * Intersections
 *          If the signs of the difference of two depths differ at the two ends,
 *          the facets intersect inside.  The interval is split there, the right
 *          part is pushed onto a stack, and the left part is decided again,
 *          until it has no intersection.  A sign of zero means that they
 *          intersect at that end; then the other end decides.  Only the facet
 *          in front is tested against the others: intersections behind it are
 *          not visible.
 * Coherence
 *          Edges, and the depths of facets along them, are linear from line to
 *          line, so the signs that decided an interval hold for a number of
 *          lines that is known when they are computed.  While the next lines
 *          have an interval between the same edges with the same facets in, its
 *          order is reused and no depth is computed.  ([Romney1969] requires
 *          all edges of the line to be the same, and has no intersections: one
 *          may begin without any change among the edges, which is why the
 *          number of lines is computed here.)
 * Ties     Depths that differ by less than a tolerance are equal, and the facet
 *          of lower index is in front.  With b the error bound of one depth,
 *          the tolerance of two facets that are not steep is 16 b.  A
 *          decision is reused only while each difference stays 8 b away from
 *          the tolerance: the difference when the decision was made, the one
 *          extrapolated, and the one that would be computed are off by 2 b
 *          each.  So the output is the same with and without coherence: a tie
 *          with the facet nearest at the middle remains one whichever of the
 *          tied facets is the nearest.
 */
#include <math.h>

#include "visibility/watkins/pitch/watkins.h"

/* The least width of a part of an interval, so that splitting ends whatever the
 * rounding errors of steep facets' depths: the map's corners are multiples of
 * it. */
#define PART_WIDTH_MIN 0x1p-8

/* ---- Depth --------------------------------------------------------------- */

double watkins_depth(const struct watkins *watkins, uint32_t facet, double x) {
  const struct watkins_facet *f = &watkins->facet.item[facet];
  double z = f->z + f->per_x * (x - f->x);
  return z < f->z_low ? f->z_low : z > f->z_high ? f->z_high : z;
}

static double tolerance_of(const struct watkins *watkins, uint32_t f,
                           uint32_t g) {
  return watkins->facet.item[f].z_error + watkins->facet.item[g].z_error;
}

static double depth_difference(const struct watkins *watkins, uint32_t f,
                               uint32_t g, double x) {
  return watkins_depth(watkins, f, x) - watkins_depth(watkins, g, x);
}

int watkins_compare(struct watkins *watkins, uint32_t f, uint32_t g, double x) {
  double apart = depth_difference(watkins, f, g, x);
  double tolerance = tolerance_of(watkins, f, g);
  watkins->counts.comparisons++;
  return (apart > tolerance) - (apart < -tolerance);
}

/* Is all of f nearer than all of g, by more than any rounding error? */
static bool is_clearly_nearer(const struct watkins *watkins, uint32_t f,
                              uint32_t g) {
  return watkins->facet.item[f].z_low - watkins->facet.item[g].z_high >
         2 * tolerance_of(watkins, f, g);
}

/* ---- Order --------------------------------------------------------------- */

/* Sorts H by depth at x, nearest first, equal depths by index, by insertion;
 * the result does not depend on the order before. */
static void sort_in(struct watkins *watkins, double x) {
  uint32_t *covering = watkins->covering.item;
  double *depth = watkins->depth.item;
  for (size_t i = 0; i < watkins->covering.count; i++) {
    uint32_t f = covering[i];
    double z = watkins_depth(watkins, f, x);
    size_t hole = i;
    for (; hole > 0; hole--) {
      watkins->counts.comparisons++;
      if (depth[hole - 1] > z ||
          (depth[hole - 1] == z && covering[hole - 1] < f))
        break;
      covering[hole] = covering[hole - 1];
      depth[hole] = depth[hole - 1];
    }
    covering[hole] = f;
    depth[hole] = z;
  }
}

/* Moves to the front the facet of lowest index among those tied with the
 * nearest. */
static void break_ties(struct watkins *watkins) {
  uint32_t *covering = watkins->covering.item;
  const double *depth = watkins->depth.item;
  size_t front = 0;
  uint32_t first;
  for (size_t i = 1; i < watkins->covering.count; i++)
    if (covering[i] < covering[front] &&
        depth[0] - depth[i] <= tolerance_of(watkins, covering[0], covering[i]))
      front = i;
  first = covering[front];
  for (; front > 0; front--)
    covering[front] = covering[front - 1];
  covering[0] = first;
}

/* Finds where the facet in front intersects another between x0 and x1, at least
 * PART_WIDTH_MIN away from both: the first one in the order of depth. */
static bool find_depth_crossing(struct watkins *watkins, double x0, double x1,
                                double *at) {
  const uint32_t *covering = watkins->covering.item;
  for (size_t i = 1; i < watkins->covering.count; i++) {
    int left, right;
    if (is_clearly_nearer(watkins, covering[0], covering[i]))
      continue;
    left = watkins_compare(watkins, covering[0], covering[i], x0);
    right = watkins_compare(watkins, covering[0], covering[i], x1);
    if (left * right < 0) {
      double d0 = depth_difference(watkins, covering[0], covering[i], x0);
      double d1 = depth_difference(watkins, covering[0], covering[i], x1);
      *at = x0 + (x1 - x0) * d0 / (d0 - d1);
      if (*at - x0 > PART_WIDTH_MIN && x1 - *at > PART_WIDTH_MIN)
        return true;
    }
  }
  return false;
}

/* Splits the interval at its visible intersections.
 * nearest  gets the facet nearest at the middle; WATKINS_NONE where it was
 *          split
 * Returns false when memory ran out or the caller cancelled. */
static bool split_interval(struct watkins *watkins, uint32_t left,
                           uint32_t right, uint32_t *nearest) {
  const struct scan_edge *edge = watkins->table.edge.item;
  struct watkins_span span = {.x0 = edge[left].x, .left = left};
  bool whole = true;
  watkins->stack.count = 0;
  if (!ARRAY_PUSH(&watkins->stack, edge[right].x))
    return false;
  while (watkins->stack.count > 0) {
    int64_t before = watkins->counts.comparisons;
    double at;
    span.x1 = watkins->stack.item[watkins->stack.count - 1];
    sort_in(watkins, span.x0 + (span.x1 - span.x0) / 2);
    *nearest = watkins->covering.item[0];
    if (!progress_step(watkins->progress,
                       (size_t)(watkins->counts.comparisons - before)))
      return false;
    break_ties(watkins);
    if (find_depth_crossing(watkins, span.x0, span.x1, &at)) {
      whole = false;
      watkins->counts.splits++;
      if (!ARRAY_PUSH(&watkins->stack, at))
        return false;
      continue;
    }
    watkins->stack.count--;
    span.facet = watkins->covering.item[0];
    span.right = watkins->stack.count == 0 ? right : WATKINS_NONE;
    if (!ARRAY_PUSH(&watkins->span, span))
      return false;
    span.x0 = span.x1;
    span.left = WATKINS_NONE;
  }
  if (!whole)
    *nearest = WATKINS_NONE;
  return true;
}

/* ---- Coherence ----------------------------------------------------------- */

/* The number of lines for which a difference that is `apart` on this line and
 * changes by `change` per line keeps its sign, with a margin: below half of the
 * tolerance it remains a tie, beyond one and a half times it remains none. */
static double lines_sign_holds(double apart, double change, double tolerance) {
  double size = fabs(apart);
  if (apart < 0)
    change = -change;
  if (size < tolerance / 2)
    return (tolerance / 2 - size) / fabs(change);
  if (size <= tolerance * 3 / 2)
    return 0;
  return change < 0 ? (size - tolerance * 3 / 2) / -change : INFINITY;
}

/* The change per line down of the difference of two depths along a path that
 * moves by dx per line. */
static double change_along(const struct watkins *watkins, uint32_t f,
                           uint32_t g, double dx) {
  const struct watkins_facet *p = &watkins->facet.item[f];
  const struct watkins_facet *q = &watkins->facet.item[g];
  return p->per_line - q->per_line + (p->per_x - q->per_x) * dx;
}

/* The number of lines for which the depth order holds: at the middle relative
 * to the nearest facet there, at both ends relative to the one in front.  It is
 * 0 for steep facets whose depth ranges overlap, because their depths are
 * clamped to those of their corners and so are not linear, and where an
 * intersection is too close to an end. */
static double lines_order_holds(const struct watkins *watkins, uint32_t left,
                                uint32_t right, uint32_t nearest) {
  const struct scan_edge *l = &watkins->table.edge.item[left];
  const struct scan_edge *r = &watkins->table.edge.item[right];
  const struct {
    double x, dx;
  } at[3] = {{l->x, l->dx},
             {r->x, r->dx},
             {l->x + (r->x - l->x) / 2, l->dx + (r->dx - l->dx) / 2}};
  const struct watkins_facet *facet = watkins->facet.item;
  double kept = INFINITY;
  for (size_t i = 0; i < watkins->covering.count; i++) {
    uint32_t g = watkins->covering.item[i];
    for (int k = 0; k < 3; k++) {
      uint32_t f = k == 2 ? nearest : watkins->covering.item[0];
      double apart;
      if (f == g || is_clearly_nearer(watkins, f, g))
        continue;
      apart = depth_difference(watkins, f, g, at[k].x);
      if (facet[f].steep || facet[g].steep ||
          (k < 2 && apart < -tolerance_of(watkins, f, g)))
        return 0;
      kept = fmin(kept,
                  lines_sign_holds(apart, change_along(watkins, f, g, at[k].dx),
                                   tolerance_of(watkins, f, g)));
    }
  }
  return kept;
}

static int parity_of(int32_t line) { return line & 1; }

static bool is_last_line(const struct watkins *watkins, uint32_t left,
                         uint32_t right) {
  const struct scan_edge *edge = watkins->table.edge.item;
  return edge[left].dy == 0 || edge[right].dy == 0;
}

/* Stores the order of H for the next line, if both edges continue to it. */
static bool store_record(struct watkins *watkins, uint32_t left, uint32_t right,
                         int32_t until) {
  int here = parity_of(watkins->table.line);
  watkins_list *order = &watkins->order[here];
  struct watkins_record record = {until, left, right, (uint32_t)order->count,
                                  (uint32_t)watkins->covering.count};
  if (is_last_line(watkins, left, right))
    return true;
  watkins->edge.item[left].record = (uint32_t)watkins->record[here].count;
  if (!ARRAY_RESERVE(order, watkins->covering.count))
    return false;
  for (size_t i = 0; i < watkins->covering.count; i++)
    order->item[order->count++] = watkins->covering.item[i];
  return ARRAY_PUSH(&watkins->record[here], record);
}

/* The record of the same interval on the line above, if its order still holds;
 * else NULL. */
static const struct watkins_record *find_record(const struct watkins *watkins,
                                                uint32_t left, uint32_t right) {
  int above = parity_of(watkins->table.line + 1);
  uint32_t index = watkins->edge.item[left].record;
  const struct watkins_record *record;
  const uint32_t *order;
  if (index >= watkins->record[above].count)
    return NULL;
  record = &watkins->record[above].item[index];
  if (record->left != left || record->right != right ||
      record->until > watkins->table.line ||
      record->count != watkins->covering.count)
    return NULL;
  order = watkins->order[above].item + record->order;
  for (uint32_t i = 0; i < record->count; i++)
    if (!watkins->facet.item[order[i]].covers)
      return NULL;
  return record;
}

/* ---- The interval -------------------------------------------------------- */

static bool decide_by_depth(struct watkins *watkins, uint32_t left,
                            uint32_t right) {
  int32_t line = watkins->table.line;
  uint32_t nearest = WATKINS_NONE;
  double kept;
  if (!ARRAY_RESERVE(&watkins->depth, watkins->covering.count) ||
      !split_interval(watkins, left, right, &nearest))
    return false;
  if (nearest == WATKINS_NONE || is_last_line(watkins, left, right))
    return true;
  kept = lines_order_holds(watkins, left, right, nearest);
  return !(kept >= 1) || store_record(watkins, left, right,
                                      kept < line ? line - (int32_t)kept : 0);
}

/* Moves a facet that is nearer than all others by its corners' depths to the
 * front of H; false where there is none.  No depth is computed. */
static bool find_clearly_nearest(struct watkins *watkins) {
  const struct watkins_facet *facet = watkins->facet.item;
  uint32_t *covering = watkins->covering.item, front;
  size_t best = 0;
  for (size_t i = 1; i < watkins->covering.count; i++)
    if (facet[covering[i]].z_low > facet[covering[best]].z_low)
      best = i;
  front = covering[best];
  for (size_t i = 0; i < watkins->covering.count; i++)
    if (i != best && !is_clearly_nearer(watkins, front, covering[i]))
      return false;
  covering[best] = covering[0];
  covering[0] = front;
  return true;
}

bool watkins_decide(struct watkins *watkins, uint32_t left, uint32_t right) {
  const struct scan_edge *edge = watkins->table.edge.item;
  struct watkins_span span = {edge[left].x, edge[right].x, 0, left, right};
  const struct watkins_record *record;
  watkins->counts.intervals++;
  if (!progress_step(watkins->progress, 1 + watkins->covering.count))
    return false;
  if (watkins->covering.count > 1 && !find_clearly_nearest(watkins)) {
    record = find_record(watkins, left, right);
    if (record == NULL)
      return decide_by_depth(watkins, left, right);
    watkins->counts.coherent++;
    for (uint32_t i = 0; i < record->count; i++)
      watkins->covering.item[i] =
          watkins->order[parity_of(watkins->table.line + 1)]
              .item[record->order + i];
    if (!store_record(watkins, left, right, record->until))
      return false;
  }
  span.facet = watkins->covering.item[0];
  return ARRAY_PUSH(&watkins->span, span);
}
