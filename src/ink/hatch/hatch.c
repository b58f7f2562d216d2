/* hatch.c - visible fragments as pen strokes along parallel lines, one pitch
 * apart.
 *
 * Strip k lies between lines k - 1 and k of the ruling (hatch_lines.h).
 * Phases, for each patch of fragments that no drawn line parts
 *   (hatch_regions.h) 1 sides     of all its fragments; sides that two of them
 *   share go
 *   2 spans     of the ruling's lines within it, inset where asked (inset.h)
 *   3 strips    its sides listed by the strips they reach into
 *   4 strokes   from a span to one of the next line, at the end where the pen
 *               stands, while the move stays inside and on ink of this pen */
#include <math.h>

#include "base/sort.h"
#include "base/tolerance.h"
#include "ink/hatch/shared_sides.h"
#include "ink/fill/fill.h"
#include "ink/hatch/inset.h"
#include "ink/hatch/hatch_regions.h"
#include "ink/hatch/hatch_lines.h"
#include "ink/lines/stroke.h"

struct hatch {
  struct drawing *drawing;
  const struct sheet *sheet;
  struct hatch_lines lines;
  struct hatch_regions regions;
  const struct pens *pens;
  uint32_t pen; /* that hatches the patch at hand */
  double shortest;
  double reach; /* mm from a side within which a move is on its ink */
  double inset; /* mm that the pen keeps from all sides; 0: it does not */
  struct drawing_stroke like;
  /* Sides that reach into strip first + k: strip_side[strip[k] ..
   * strip[k + 1]). */
  int64_t first, strips;
  ARRAY(uint32_t) strip;
  ARRAY(uint32_t) strip_side;
  shared_sides cut; /* sides that may be shared, and these sides */
  ARRAY(struct hatch_side) cut_side;
  bool ok;                 /* memory did not run out */
  struct stroke_line line; /* the stroke at hand */
};

/* ---- 1 Sides ------------------------------------------------------------- */

/* Whether a side is drawn as a line. */
static bool is_inked(const struct hatch *h, uint32_t side) {
  return hatch_regions_side_is_inked(&h->regions,
                                     h->lines.side.item[side].corner);
}

static int compare_places(struct hatch_point a, struct hatch_point b) {
  if (a.u != b.u)
    return a.u < b.u ? -1 : 1;
  return (a.v > b.v) - (a.v < b.v);
}

/* The ends of a side, the lower one first. */
static void order_ends(const struct hatch_side *side,
                       struct hatch_point end[2]) {
  bool turned = compare_places(side->from, side->to) > 0;
  end[turned] = side->from;
  end[!turned] = side->to;
}

static int compare_sides(const void *first, const void *second, void *user) {
  struct hatch_point a[2], b[2];
  (void)user;
  order_ends(first, a);
  order_ends(second, b);
  int low = compare_places(a[0], b[0]);
  return low ? low : compare_places(a[1], b[1]);
}

/* Puts what is left of a side up to a place of it back. */
static bool put_back(struct hatch *h, const struct shared_side *cut,
                     struct shared_side_point past) {
  struct hatch_lines *r = &h->lines;
  struct hatch_side side = h->cut_side.item[cut->item];
  struct hatch_point low = hatch_point_at(r, cut->from.x, cut->from.y);
  struct hatch_point high = hatch_point_at(r, past.x, past.y);
  side.from = cut->turned ? high : low;
  side.to = cut->turned ? low : high;
  return (cut->from.x == past.x && cut->from.y == past.y) ||
         ARRAY_PUSH(&r->side, side);
}

/* Is the place on the side, but for rounding? */
static bool is_on(const struct shared_side *cut, struct shared_side_point at) {
  double dx = cut->to.x - cut->from.x, dy = cut->to.y - cut->from.y;
  double off = (at.x - cut->from.x) * dy - (at.y - cut->from.y) * dx;
  return fabs(off) <= TOLERANCE_COINCIDENT_UNITS * hypot(dx, dy);
}

/* Takes out what two sides have in common.  Where it starts and ends one of
 * them has a corner, which the other gets, too. */
static void take_out(void *user, struct shared_side *ahead,
                     struct shared_side *turned) {
  struct hatch *h = user;
  bool later = ahead->low > turned->low, sooner = ahead->high < turned->high;
  struct shared_side_point low = later ? ahead->from : turned->from;
  struct shared_side_point high = sooner ? ahead->to : turned->to;
  if (!is_on(ahead, low) || !is_on(turned, low) || !is_on(ahead, high) ||
      !is_on(turned, high))
    return;
  h->ok = put_back(h, ahead, low) && put_back(h, turned, low) && h->ok;
  ahead->from = turned->from = high;
  ahead->low = turned->low = sooner ? ahead->high : turned->high;
}

/* Takes out of the sides what those of two fragments have in common, level cuts
 * and pieces of edges that are not drawn: the pen may cross there. */
static bool take_shared_out(struct hatch *h) {
  struct hatch_lines *r = &h->lines;
  size_t kept = 0;
  h->cut.count = h->cut_side.count = 0;
  h->ok = true;
  for (uint32_t i = 0; i < r->side.count; i++) {
    const struct hatch_side side = r->side.item[i];
    uint32_t item = (uint32_t)h->cut.count;
    if (!shared_sides_add_level(&h->cut, side.corner, side.next, item) ||
        (!is_inked(h, i) &&
         !shared_sides_add_edge(&h->cut, side.corner, side.next, item)))
      return false;
    if (h->cut.count == item)
      r->side.item[kept++] = side;
    else if (!ARRAY_PUSH(&h->cut_side, side))
      return false;
  }
  r->side.count = kept;
  if (!shared_sides_match(&h->cut, take_out, h))
    return false;
  for (size_t i = 0; i < h->cut.count && h->ok; i++)
    h->ok = put_back(h, &h->cut.item[i], h->cut.item[i].to);
  return h->ok;
}

/* Takes the sides of fragments [begin, end) of the patches, but for those that
 * two of them share and no line is drawn along: the pen may cross these. */
static bool take_sides(struct hatch *h, const struct map *map, size_t begin,
                       size_t end) {
  struct hatch_lines *r = &h->lines;
  hatch_lines_clear(r);
  for (size_t i = begin; i < end; i++)
    if (!hatch_lines_take(r, map, &map->fragment.item[h->regions.fragment[i]]))
      return false;
  if (end - begin == 1)
    return true;
  if (!sort_stable(r->side.item, r->side.count, sizeof *r->side.item,
                   compare_sides, NULL))
    return false;
  size_t kept = 0;
  for (uint32_t i = 0; i < r->side.count; i++) {
    const struct hatch_side *side = &r->side.item[i];
    if (i + 1 < r->side.count && compare_sides(side, side + 1, NULL) == 0 &&
        !is_inked(h, i) && !is_inked(h, i + 1))
      i++;
    else
      r->side.item[kept++] = *side;
  }
  r->side.count = kept;
  return take_shared_out(h);
}

/* ---- 3 Strips ------------------------------------------------------------ */

/* Lists the sides by strip, the patch's lines being [first, last). */
static bool list_strips(struct hatch *h, int64_t first, int64_t last) {
  const struct hatch_lines *r = &h->lines;
  size_t count = (size_t)(last - first) + 1;
  h->first = first;
  h->strips = (int64_t)count;
  h->strip.count = h->strip_side.count = 0;
  if (!ARRAY_RESERVE(&h->strip, count + 2))
    return false;
  uint32_t *start = h->strip.item, sum = 0;
  for (size_t k = 0; k < count + 2; k++)
    start[k] = 0;
  for (size_t i = 0; i < r->side.count; i++) {
    int64_t low, high;
    hatch_lines_find_lines(r, &r->side.item[i], &low, &high);
    for (int64_t k = low; k <= high; k++)
      start[k - first + 2]++;
  }
  for (size_t k = 0; k < count + 2; k++)
    start[k] = sum += start[k];
  if (!ARRAY_RESERVE(&h->strip_side, sum))
    return false;
  for (uint32_t i = 0; i < r->side.count; i++) {
    int64_t low, high;
    hatch_lines_find_lines(r, &r->side.item[i], &low, &high);
    for (int64_t k = low; k <= high; k++)
      h->strip_side.item[start[k - first + 1]++] = i;
  }
  return true;
}

/* ---- 4 Strokes ----------------------------------------------------------- */

static double cross(struct hatch_point a, struct hatch_point b,
                    struct hatch_point c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

static bool is_crossed(const struct hatch_side *side, struct hatch_point a,
                       struct hatch_point b) {
  return cross(a, b, side->from) * cross(a, b, side->to) <= 0 &&
         cross(side->from, side->to, a) * cross(side->from, side->to, b) <= 0;
}

/* Whether the pen may go straight from one crossing to one on the next line:
 * past the other sides of the strip and with its middle inside. */
static bool is_inside(const struct hatch *h, const struct hatch_crossing *from,
                      const struct hatch_crossing *to) {
  struct hatch_point a = {from->u, hatch_lines_height(&h->lines, from->line)};
  struct hatch_point b = {to->u, hatch_lines_height(&h->lines, to->line)};
  struct hatch_point middle = {(a.u + b.u) / 2, (a.v + b.v) / 2};
  const uint32_t *start = h->strip.item + (to->line - h->first);
  bool inside = false;
  for (uint32_t i = start[0]; i < start[1]; i++) {
    uint32_t s = h->strip_side.item[i];
    const struct hatch_side *side = &h->lines.side.item[s];
    if (s != from->side && s != to->side && is_crossed(side, a, b))
      return false;
    if ((side->from.v <= middle.v) != (side->to.v <= middle.v) &&
        hatch_lines_u_at(side, middle.v) < middle.u)
      inside = !inside;
  }
  return inside;
}

/* Whether the move keeps its distance from the sides about its strip. */
static bool is_clear(const struct hatch *h, const struct hatch_crossing *from,
                     const struct hatch_crossing *to) {
  struct hatch_point a = {from->u, hatch_lines_height(&h->lines, from->line)};
  struct hatch_point b = {to->u, hatch_lines_height(&h->lines, to->line)};
  int64_t reach = (int64_t)ceil(h->inset / h->lines.pitch);
  int64_t last = h->strips - 1, strip = to->line - h->first;
  int64_t low = strip > reach ? strip - reach : 0;
  int64_t high = strip + reach < last ? strip + reach : last;
  const uint32_t *start = h->strip.item;
  for (uint32_t i = start[low]; i < start[high + 1]; i++)
    if (!inset_is_clear(&h->lines.side.item[h->strip_side.item[i]], a, b,
                        h->inset))
      return false;
  return true;
}

/* Whether a side is drawn as a line with the pen that hatches: along another
 * pen's line a move would be seen. */
static bool is_of_pen(const struct hatch *h, uint32_t side) {
  const struct map_corner *corner = h->lines.side.item[side].corner;
  const struct sheet *sheet = h->sheet;
  if (!is_inked(h, side))
    return false;
  if (corner->side == MAP_SIDE_INTERSECTION || corner->id >= sheet->edge.count)
    return !h->pens->several && h->pens->of_hatch == PENS_NONE;
  const struct sheet_edge *edge = &sheet->edge.item[corner->id];
  return pens_of_line(h->pens, edge->edge_class, edge->group) == h->pen;
}

/* Whether lines of this pen, among sides [begin, end) of the strips, cover a
 * place. */
static bool is_covered(const struct hatch *h, uint32_t begin, uint32_t end,
                       struct hatch_point p) {
  for (uint32_t i = begin; i < end; i++) {
    uint32_t s = h->strip_side.item[i];
    const struct hatch_side *side = &h->lines.side.item[s];
    if (hatch_lines_distance(p, side->from, side->to) <= h->reach &&
        is_of_pen(h, s))
      return true;
  }
  return false;
}

/* Whether a move is on ink all the way, as told by three places of it: one that
 * cuts a corner off is not. */
static bool is_along_ink(const struct hatch *h,
                         const struct hatch_crossing *from,
                         const struct hatch_crossing *to) {
  struct hatch_point a = {from->u, hatch_lines_height(&h->lines, from->line)};
  struct hatch_point b = {to->u, hatch_lines_height(&h->lines, to->line)};
  const uint32_t *start = h->strip.item + (to->line - h->first);
  bool along = true;
  for (int quarter = 1; quarter < 4 && along; quarter++) {
    double t = quarter / 4.0;
    struct hatch_point p = {a.u + t * (b.u - a.u), a.v + t * (b.v - a.v)};
    along = is_covered(h, start[0], start[1], p);
  }
  return along;
}

/* Whether the pen may go from one crossing to one on the next line.
 * beside  asks no more than whether both are on one side */
static bool may_go(const struct hatch *h, const struct hatch_crossing *from,
                   const struct hatch_crossing *to, bool beside) {
  if (h->inset > 0)
    return !beside && is_inside(h, from, to) && is_clear(h, from, to) &&
           is_along_ink(h, from, to);
  return beside ? from->side == to->side
                : is_inside(h, from, to) && is_along_ink(h, from, to);
}

/* The first span, from span `i` on, of a later line than that or of that line
 * and not wholly left of u. */
static size_t find_span(const struct hatch *h, size_t i, int64_t line,
                        double u) {
  size_t end = h->lines.span.count;
  while (i < end) {
    size_t middle = i + (end - i) / 2;
    const struct hatch_crossing *c = &h->lines.span.item[middle].right;
    if (c->line < line || (c->line == line && c->u < u))
      i = middle + 1;
    else
      end = middle;
  }
  return i;
}

/* The free span of the next line that the pen can go to; NULL where there is
 * none.  Those above the span are tried, and one more on either side; first
 * those along the same side, as it costs nothing to see that they do.  From
 * sides and to sides that bear no ink of this pen there is no way: the move
 * would be seen as a line that has no business there.
 * right  whether the pen stands at the right end */
static struct hatch_span *find_next(struct hatch *h,
                                    const struct hatch_span *span, bool right) {
  const struct hatch_crossing *from = right ? &span->right : &span->left;
  size_t here = (size_t)(span - h->lines.span.item);
  int64_t line = from->line + 1;
  size_t low = find_span(h, here, line, span->left.u);
  size_t high = find_span(h, low, line, span->right.u);
  low -= low > here + 1;
  if (!is_of_pen(h, from->side))
    return NULL;
  for (int tests = 0; tests < 2; tests++) {
    for (size_t i = low; i < h->lines.span.count && i <= high; i++) {
      struct hatch_span *next = &h->lines.span.item[i];
      const struct hatch_crossing *to = right ? &next->right : &next->left;
      if (to->line == line && !next->used && is_of_pen(h, to->side) &&
          may_go(h, from, to, tests == 0))
        return next;
    }
  }
  return NULL;
}

static bool add_point(struct hatch *h, const struct hatch_crossing *c) {
  struct hatch_point p = {c->u, hatch_lines_height(&h->lines, c->line)};
  return ARRAY_PUSH(&h->line.point, hatch_lines_turn_back(&h->lines, p));
}

/* Draws from `span` upwards as far as the pen need not be lifted. */
static bool add_stroke(struct hatch *h, struct hatch_span *span) {
  /* From the left, unless there is a way on from there alone. */
  bool right = !find_next(h, span, true) && find_next(h, span, false);
  h->line.point.count = 0;
  for (; span; span = find_next(h, span, right)) {
    span->used = true;
    if (!add_point(h, right ? &span->right : &span->left) ||
        !add_point(h, right ? &span->left : &span->right))
      return false;
    right = !right;
  }
  return stroke_line_length(&h->line) < h->shortest ||
         stroke_add(h->drawing, &h->like, h->line.point.item,
                    h->line.point.count, false);
}

static bool hatch_patch(struct hatch *h) {
  struct hatch_lines *r = &h->lines;
  if (!hatch_lines_find_spans(r) || (h->inset > 0 && !inset_spans(r, h->inset)))
    return false;
  if (r->span.count == 0) /* between two lines */
    return true;
  int64_t first = INT64_MAX, last = INT64_MIN;
  for (size_t i = 0; i < r->side.count; i++) {
    int64_t low, high;
    hatch_lines_find_lines(r, &r->side.item[i], &low, &high);
    first = low < first ? low : first;
    last = high > last ? high : last;
  }
  if (!list_strips(h, first, last))
    return false;
  for (size_t i = 0; i < r->span.count; i++)
    if (!r->span.item[i].used && !add_stroke(h, &r->span.item[i]))
      return false;
  return true;
}

bool hatch_add(struct drawing *drawing, const struct sheet *sheet,
               const struct scene *scene, const struct map *map,
               const struct pens *pens, const recto_options *options) {
  struct hatch h = {.drawing = drawing, .sheet = sheet, .pens = pens};
  hatch_lines_init(&h.lines, sheet, options->hatch_pitch_mm,
                   options->hatch_angle_deg);
  bool ok = hatch_regions_init(&h.regions, sheet, scene, map, pens, options);
  for (size_t i = 0, end; ok && i < map->fragment.count; i = end) {
    end = hatch_regions_end(&h.regions, i);
    uint32_t face = map->fragment.item[h.regions.fragment[i]].face;
    uint32_t group = scene->face_group.item[face];
    h.pen = pens_of_hatch(pens, group);
    h.inset = options->hatch_inset ? pens_width_mm(pens, h.pen) / 2 : 0;
    h.reach = h.inset + pens_width_mm(pens, h.pen) / 2;
    h.shortest = pens_shortest_mm(pens, h.pen);
    h.like = (struct drawing_stroke){
        .layer = h.pen, .face = face, .edge = DRAWING_NONE, .group = group};
    ok = take_sides(&h, map, i, end) && hatch_patch(&h);
  }
  hatch_lines_fini(&h.lines);
  hatch_regions_fini(&h.regions);
  ARRAY_FREE(&h.strip);
  ARRAY_FREE(&h.strip_side);
  ARRAY_FREE(&h.cut);
  ARRAY_FREE(&h.cut_side);
  ARRAY_FREE(&h.line.point);
  return ok;
}
