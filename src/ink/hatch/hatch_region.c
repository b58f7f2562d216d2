/* hatch_region.c - hatches a region by parallel lines at one pitch.
 *
 * Strip k is the part of the page between hatch lines k - 1 and k
 * (hatch_lines.h).  A move is the part of a stroke that connects a span to one
 * of the next hatch line, so that a stroke is a zigzag.
 *
 * Phases
 *   1 sides     of all fragments, without those that two fragments share
 *   2 spans     of the hatch lines inside the region, shortened by half the pen
 *               width if requested (inset.h)
 *   3 strips    an index: for each strip the sides that reach into it
 *   4 strokes   greedily: from the end of a span to a span of the next line, as
 *               long as the move stays inside the region and on ink of the same
 *               pen, so that it cannot be seen */
#include "ink/hatch/hatch_region.h"

#include <math.h>

#include "base/poll.h"
#include "base/sort.h"
#include "ink/hatch/inset.h"

/* ---- 1 Sides ------------------------------------------------------------- */

/* Collects the sides of the region with fragments [begin, end), except where
 * the pen may cross them to a neighbour.  False when memory ran out. */
static bool collect_sides(struct hatch *h, const struct map *map, size_t begin,
                          size_t end) {
  hatch_lines_clear(&h->lines);
  for (size_t i = begin; i < end; i++)
    if (!hatch_lines_add_fragment(&h->lines, map,
                                  &map->fragment.item[h->regions->fragment[i]],
                                  h->regions->crossable))
      return false;
  return true;
}

/* ---- 3 Strips ------------------------------------------------------------ */

/* Puts the sides into the lists of the strips. */
static void list_strip_sides(struct hatch *h) {
  const struct hatch_lines *lines = &h->lines;
  for (uint32_t i = (uint32_t)lines->side.count; i-- > 0;) {
    int64_t low, high;
    hatch_lines_side_range(lines, &lines->side.item[i], &low, &high);
    for (int64_t k = low; k <= high; k++)
      number_lists_put(&h->strip, (size_t)(k - h->first), i);
  }
}

/* Lists the sides by strip for a region whose hatch lines are [first, last).
 * False when memory ran out. */
static bool list_strips(struct hatch *h, int64_t first, int64_t last) {
  size_t count = (size_t)(last - first) + 1;
  h->first = first;
  h->strips = (int64_t)count;
  number_lists_fini(&h->strip);
  if (!number_lists_init(&h->strip, count))
    return false;
  list_strip_sides(h);
  if (!number_lists_allocate(&h->strip, count))
    return false;
  list_strip_sides(h);
  return true;
}

/* ---- 4 Strokes ----------------------------------------------------------- */

/* Twice the signed area of the triangle a b c. */
static double area2(struct hatch_point a, struct hatch_point b,
                    struct hatch_point c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

/* Whether the segment from a to b meets a side. */
static bool segments_meet(const struct hatch_side *side, struct hatch_point a,
                          struct hatch_point b) {
  return area2(a, b, side->from) * area2(a, b, side->to) <= 0 &&
         area2(side->from, side->to, a) * area2(side->from, side->to, b) <= 0;
}

/* Whether the straight move from one crossing to one on the next line is inside
 * the region: it meets no other side of the strip, and its midpoint is inside
 * by the even-odd rule. */
static bool move_is_inside(const struct hatch *h,
                           const struct hatch_crossing *from,
                           const struct hatch_crossing *to) {
  struct hatch_point a = {from->u, hatch_lines_height(&h->lines, from->line)};
  struct hatch_point b = {to->u, hatch_lines_height(&h->lines, to->line)};
  struct hatch_point middle = {(a.u + b.u) / 2, (a.v + b.v) / 2};
  const uint32_t *start = h->strip.start + (to->line - h->first);
  bool inside = false;
  for (uint32_t i = start[0]; i < start[1]; i++) {
    uint32_t s = h->strip.item[i];
    const struct hatch_side *side = &h->lines.side.item[s];
    if (s != from->side && s != to->side && segments_meet(side, a, b))
      return false;
    if ((side->from.v <= middle.v) != (side->to.v <= middle.v) &&
        hatch_lines_u_at(side, middle.v) < middle.u)
      inside = !inside;
  }
  return inside;
}

/* Whether a move is at least h->inset from the sides of all strips near it. */
static bool move_is_clear(const struct hatch *h,
                          const struct hatch_crossing *from,
                          const struct hatch_crossing *to) {
  struct hatch_point a = {from->u, hatch_lines_height(&h->lines, from->line)};
  struct hatch_point b = {to->u, hatch_lines_height(&h->lines, to->line)};
  int64_t inked_distance = (int64_t)ceil(h->inset / h->lines.pitch);
  int64_t last = h->strips - 1, strip = to->line - h->first;
  int64_t low = strip > inked_distance ? strip - inked_distance : 0;
  int64_t high = strip + inked_distance < last ? strip + inked_distance : last;
  const uint32_t *start = h->strip.start;
  for (uint32_t i = start[low]; i < start[high + 1]; i++)
    if (!inset_is_clear(&h->lines.side.item[h->strip.item[i]], a, b, h->inset))
      return false;
  return true;
}

/* Whether a side is drawn as a line with the pen of the hatching.  A move along
 * a line of another pen would be visible. */
static bool side_is_of_pen(const struct hatch *h, uint32_t side) {
  const struct map_corner *corner = h->lines.side.item[side].corner;
  const struct sheet *sheet = h->sheet;
  if (!hatch_regions_side_is_inked(h->regions, corner))
    return false;
  if (corner->side == MAP_SIDE_INTERSECTION || corner->id >= sheet->edge.count)
    return !h->pens->several && h->pens->of_hatch == PENS_NONE;
  const struct sheet_edge *edge = &sheet->edge.item[corner->id];
  return pens_of_line(h->pens, edge->edge_class,
                      sheet_edge_group(sheet, edge)) == h->pen;
}

/* Whether a point is on the ink of a line of the same pen, among the sides
 * strip.item[begin] to strip.item[end - 1]. */
static bool is_on_ink(const struct hatch *h, uint32_t begin, uint32_t end,
                      struct hatch_point p) {
  for (uint32_t i = begin; i < end; i++) {
    uint32_t s = h->strip.item[i];
    const struct hatch_side *side = &h->lines.side.item[s];
    if (hatch_lines_distance(p, side->from, side->to) <= h->inked_distance &&
        side_is_of_pen(h, s))
      return true;
  }
  return false;
}

/* Whether a move is on ink over its whole length, decided by three sample
 * points at its quarters: a move that cuts off a corner is not. */
static bool move_is_on_ink(const struct hatch *h,
                           const struct hatch_crossing *from,
                           const struct hatch_crossing *to) {
  struct hatch_point a = {from->u, hatch_lines_height(&h->lines, from->line)};
  struct hatch_point b = {to->u, hatch_lines_height(&h->lines, to->line)};
  const uint32_t *start = h->strip.start + (to->line - h->first);
  bool along = true;
  for (int quarter = 1; quarter < 4 && along; quarter++) {
    double t = quarter / 4.0;
    struct hatch_point p = {a.u + t * (b.u - a.u), a.v + t * (b.v - a.v)};
    along = is_on_ink(h, start[0], start[1], p);
  }
  return along;
}

/* Whether the pen may move from one crossing to one on the next line.
 * same_side_only  only tests, at no cost, whether both crossings are on the
 *                 same side */
static bool move_is_allowed(const struct hatch *h,
                            const struct hatch_crossing *from,
                            const struct hatch_crossing *to,
                            bool same_side_only) {
  if (h->inset > 0)
    return !same_side_only && move_is_inside(h, from, to) &&
           move_is_clear(h, from, to) && move_is_on_ink(h, from, to);
  return same_side_only
             ? from->side == to->side
             : move_is_inside(h, from, to) && move_is_on_ink(h, from, to);
}

/* The first span from index `from` on that is of a later line than `line`, or
 * of this line and does not end left of u. */
static size_t find_span(const struct hatch *h, size_t from, int64_t line,
                        double u) {
  const struct hatch_span *span = h->lines.span.item;
  size_t i;
  LOWER_BOUND(i, from, h->lines.span.count,
              span[i].right.line < line ||
                  (span[i].right.line == line && span[i].right.u < u));
  return i;
}

/* The unused span of the next line that the pen can move to, or NULL.
 * The spans tested are those whose u overlap the current span, and one more on
 * either side: first those that are reached along the same side, as this test
 * costs nothing, then all.  A move from or to a side that has no ink of this
 * pen is not allowed, since it would be visible.
 * right  whether the pen is at the right end */
static struct hatch_span *
find_next_span(struct hatch *h, const struct hatch_span *span, bool right) {
  const struct hatch_crossing *from = right ? &span->right : &span->left;
  size_t here = (size_t)(span - h->lines.span.item);
  int64_t line = from->line + 1;
  size_t low = find_span(h, here, line, span->left.u);
  size_t high = find_span(h, low, line, span->right.u);
  low -= low > here + 1;
  if (!side_is_of_pen(h, from->side))
    return NULL;
  for (int tests = 0; tests < 2; tests++) {
    for (size_t i = low; i < h->lines.span.count && i <= high; i++) {
      struct hatch_span *next = &h->lines.span.item[i];
      const struct hatch_crossing *to = right ? &next->right : &next->left;
      if (to->line == line && !next->used && side_is_of_pen(h, to->side) &&
          move_is_allowed(h, from, to, tests == 0))
        return next;
    }
  }
  return NULL;
}

static bool add_crossing_point(struct hatch *h,
                               const struct hatch_crossing *c) {
  struct hatch_point p = {c->u, hatch_lines_height(&h->lines, c->line)};
  return ARRAY_PUSH(&h->line.point, hatch_lines_rotate_back(&h->lines, p));
}

/* Draws a stroke from `span` upwards to where the pen must be lifted.  False
 * when memory ran out. */
static bool add_hatch_stroke(struct hatch *h, struct hatch_span *span) {
  /* The stroke starts at the left end, unless only that end leads on. */
  bool right = find_next_span(h, span, true) == NULL &&
               find_next_span(h, span, false) != NULL;
  h->line.point.count = 0;
  for (; span != NULL; span = find_next_span(h, span, right)) {
    span->used = true;
    if (!add_crossing_point(h, right ? &span->right : &span->left) ||
        !add_crossing_point(h, right ? &span->left : &span->right))
      return false;
    right = !right;
  }
  return stroke_line_length(&h->line) < h->shortest ||
         stroke_add(h->drawing, &h->attributes, h->line.point.item,
                    h->line.point.count, false);
}

/* Hatches a region whose sides have been collected. */
static bool hatch_sides(struct hatch *h) {
  struct hatch_lines *lines = &h->lines;
  if (!hatch_lines_find_spans(lines) ||
      (h->inset > 0 && !inset_spans(lines, h->inset)))
    return false;
  if (lines->span.count == 0) /* the region is between two lines */
    return true;
  int64_t first = INT64_MAX, last = INT64_MIN;
  for (size_t i = 0; i < lines->side.count; i++) {
    int64_t low, high;
    hatch_lines_side_range(lines, &lines->side.item[i], &low, &high);
    first = low < first ? low : first;
    last = high > last ? high : last;
  }
  if (!list_strips(h, first, last))
    return false;
  for (size_t i = 0; i < lines->span.count; i++)
    if (!poll_at(i + 1) || (!lines->span.item[i].used &&
                            !add_hatch_stroke(h, &lines->span.item[i])))
      return false;
  return true;
}

bool hatch_region(struct hatch *h, const struct map *map, size_t begin,
                  size_t end) {
  return collect_sides(h, map, begin, end) && hatch_sides(h);
}

void hatch_init(struct hatch *h, double pitch_mm, double angle_deg) {
  hatch_lines_init(&h->lines, h->sheet, pitch_mm, angle_deg);
}

void hatch_fini(struct hatch *h) {
  hatch_lines_fini(&h->lines);
  number_lists_fini(&h->strip);
  ARRAY_FREE(&h->line.point);
}
