/* inset.c - the spans of a ruling, as far from all sides as half a pen is
 * wide.
 *
 * What is nearer to a side than that is a stadium: the side widened to both
 * hands, with round ends.  It is convex, so a line meets it in one interval,
 * its cut; a span keeps what none of its line's cuts takes. */
#include "ink/hatch/inset.h"

#include <math.h>

#include "base/sort.h"
#include "base/tolerance.h"

struct inset_cut {
  int64_t line;
  double u0, u1;
  uint32_t side;
};

typedef ARRAY(struct inset_cut) cut_list;
typedef ARRAY(struct hatch_span) span_list;

/* ---- Cuts ---------------------------------------------------------------- */

static void widen(struct inset_cut *cut, double u0, double u1) {
  cut->u0 = fmin(cut->u0, u0);
  cut->u1 = fmax(cut->u1, u1);
}

/* The part of a line at height v within `distance` of a place. */
static void cut_disc(struct inset_cut *cut, struct hatch_point at, double v,
                     double distance) {
  double across = v - at.v;
  if (fabs(across) < distance) {
    double half = sqrt(distance * distance - across * across);
    widen(cut, at.u - half, at.u + half);
  }
}

/* Makes low..high what of it has low1 < slope u + offset < high1. */
static void narrow(double *low, double *high, double slope, double offset,
                   double low1, double high1) {
  if (slope == 0) {
    if (!(offset > low1 && offset < high1))
      *low = INFINITY;
    return;
  }
  double a = (low1 - offset) / slope, b = (high1 - offset) / slope;
  *low = fmax(*low, fmin(a, b));
  *high = fmin(*high, fmax(a, b));
}

/* The part of it beside a side. */
static void cut_beside(struct inset_cut *cut, const struct hatch_side *side,
                       double v, double distance) {
  struct hatch_point a = side->from, b = side->to;
  double length = hypot(b.u - a.u, b.v - a.v), low = -INFINITY, high = INFINITY;
  if (length == 0)
    return;
  double du = (b.u - a.u) / length, dv = (b.v - a.v) / length;
  /* Along the side from a, and across it. */
  narrow(&low, &high, du, (v - a.v) * dv - a.u * du, 0, length);
  narrow(&low, &high, -dv, (v - a.v) * du + a.u * dv, -distance, distance);
  if (low < high)
    widen(cut, low, high);
}

static bool cut_by_side(const struct hatch_lines *lines, uint32_t index,
                        double distance, cut_list *cuts) {
  const struct hatch_side *side = &lines->side.item[index];
  double low = fmin(side->from.v, side->to.v) - distance;
  double high = fmax(side->from.v, side->to.v) + distance;
  int64_t last = (int64_t)ceil(high / lines->pitch);
  for (int64_t k = (int64_t)floor(low / lines->pitch) - 1; k <= last; k++) {
    struct inset_cut cut = {k, INFINITY, -INFINITY, index};
    double v = hatch_lines_height(lines, k);
    cut_disc(&cut, side->from, v, distance);
    cut_disc(&cut, side->to, v, distance);
    cut_beside(&cut, side, v, distance);
    if (cut.u0 < cut.u1 && !ARRAY_PUSH(cuts, cut))
      return false;
  }
  return true;
}

static int compare_cuts(const void *first, const void *second, void *user) {
  const struct inset_cut *a = first, *b = second;
  (void)user;
  if (a->line != b->line)
    return a->line < b->line ? -1 : 1;
  return (a->u0 > b->u0) - (a->u0 < b->u0);
}

/* ---- Spans --------------------------------------------------------------- */

/* Keeps what is left of a span; *at is the first cut of its line or of a later
 * one. */
static bool keep(const struct hatch_span *span, const cut_list *cuts, size_t at,
                 span_list *kept) {
  struct hatch_span rest = *span;
  for (; at < cuts->count && cuts->item[at].line == span->left.line; at++) {
    const struct inset_cut *cut = &cuts->item[at];
    struct hatch_span part = rest;
    if (cut->u0 >= rest.right.u)
      break;
    part.right.u = cut->u0;
    part.right.side = cut->side;
    if (part.left.u < part.right.u && !ARRAY_PUSH(kept, part))
      return false;
    if (cut->u1 > rest.left.u) {
      rest.left.u = cut->u1;
      rest.left.side = cut->side;
    }
  }
  return rest.left.u >= rest.right.u || ARRAY_PUSH(kept, rest);
}

bool inset_spans(struct hatch_lines *lines, double distance) {
  cut_list cuts = {0};
  span_list kept = {0};
  size_t at = 0;
  bool ok = true;
  for (uint32_t i = 0; ok && i < lines->side.count; i++)
    ok = cut_by_side(lines, i, distance, &cuts);
  ok = ok && sort_stable(cuts.item, cuts.count, sizeof *cuts.item, compare_cuts,
                         NULL);
  for (size_t i = 0; ok && i < lines->span.count; i++) {
    const struct hatch_span *span = &lines->span.item[i];
    while (at < cuts.count && cuts.item[at].line < span->left.line)
      at++;
    ok = keep(span, &cuts, at, &kept);
  }
  lines->span.count = 0;
  for (size_t i = 0; ok && i < kept.count; i++)
    ok = ARRAY_PUSH(&lines->span, kept.item[i]);
  ARRAY_FREE(&cuts);
  ARRAY_FREE(&kept);
  return ok;
}

/* ---- Moves --------------------------------------------------------------- */

bool inset_is_clear(const struct hatch_side *side, struct hatch_point a,
                    struct hatch_point b, double distance) {
  /* Its ends are clear, so that where it does not cross the side it is
   * nearest at one of the side's. */
  double least = distance - TOLERANCE_COINCIDENT_UNITS / SHEET_UNITS_PER_MM;
  return hatch_lines_distance(side->from, a, b) >= least &&
         hatch_lines_distance(side->to, a, b) >= least;
}
