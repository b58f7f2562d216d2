/* hatch.c - visible fragments as pen strokes along parallel lines.
 *
 * A fragment is turned so that the lines are horizontal, at heights
 * (k + 1/2) pitch; strip k lies between lines k - 1 and k.
 * Phases, for each fragment
 *   1 sides     turned, and listed by the strips they reach into
 *   2 spans     between the first and second, third and fourth, ... crossing
 *               of a line with the sides (even-odd)
 *   3 strokes   from a span to one of the next line, at the end where the pen
 *               stands, while the move stays inside and near inked sides
 * Robustness  A side crosses the lines with low <= height < high, its ends'
 *   heights being the same doubles as its neighbours', so that every line has
 *   an even number of crossings.  Where a side lies within rounding of a line
 *   either outcome is right.
 * Source  [Foley] ch. 3 */
#include <math.h>

#include "base/sort.h"
#include "ink/fill.h"
#include "ink/layers.h"
#include "ink/stroke.h"

struct place {
  double u, v; /* mm along the lines, mm across */
};

struct side {
  struct place from, to;
  bool inked; /* a line is drawn along it */
};

struct crossing {
  int64_t line;
  double u;
  uint32_t side;
};

/* Between two crossings of a line. */
struct span {
  struct crossing left, right;
  bool used;
};

struct hatch {
  struct drawing *drawing;
  const struct sheet *sheet;
  const struct map *map;
  double pitch, cosine, sine, shortest;
  bool intersections; /* are drawn */
  struct drawing_stroke like;
  ARRAY(struct side) side;
  ARRAY(struct crossing) crossing;
  ARRAY(struct span) span;
  /* Sides that reach into strip first + k: strip_side[strip[k] ..
   * strip[k + 1]). */
  int64_t first;
  ARRAY(uint32_t) strip;
  ARRAY(uint32_t) strip_side;
  struct stroke_line line; /* the stroke at hand */
};

/* ---- 1 Sides --------------------------------------------------------------
 */

static struct place turn(const struct hatch *h, const struct map_corner *c) {
  double x = sheet_x_mm(h->sheet, c->x), y = sheet_y_mm(h->sheet, c->y);
  return (struct place){x * h->cosine + y * h->sine,
                        y * h->cosine - x * h->sine};
}

static struct drawing_point turn_back(const struct hatch *h, double u,
                                      double v) {
  return (struct drawing_point){u * h->cosine - v * h->sine,
                                u * h->sine + v * h->cosine};
}

static double height_of(const struct hatch *h, int64_t line) {
  return ((double)line + 0.5) * h->pitch;
}

/* The first line not below v. */
static int64_t line_above(const struct hatch *h, double v) {
  int64_t line = (int64_t)ceil(v / h->pitch - 0.5);
  /* The quotient may have been rounded across. */
  while (height_of(h, line) < v)
    line++;
  while (height_of(h, line - 1) >= v)
    line--;
  return line;
}

/* Whether the side that leaves the corner is drawn as a line. */
static bool is_inked(const struct hatch *h, const struct map_corner *corner) {
  switch (corner->side) {
  case MAP_SIDE_EDGE:
  case MAP_SIDE_OUTLINE:
    return corner->id < h->sheet->edge.count &&
           h->sheet->edge.item[corner->id].edge_class != 0;
  case MAP_SIDE_INTERSECTION:
    return h->intersections;
  default:
    return false;
  }
}

static bool add_sides(struct hatch *h, const struct map_fragment *fragment) {
  h->side.count = 0;
  for (uint32_t l = 0; l < fragment->loops; l++) {
    const struct map_loop *loop = &h->map->loop.item[fragment->loop + l];
    const struct map_corner *corner = h->map->corner.item + loop->corner;
    for (uint32_t i = 0; i < loop->count; i++) {
      uint32_t next = i + 1 < loop->count ? i + 1 : 0;
      struct side side = {turn(h, &corner[i]), turn(h, &corner[next]),
                          is_inked(h, &corner[i])};
      if (!ARRAY_PUSH(&h->side, side))
        return false;
    }
  }
  return true;
}

/* The lowest and the highest line at or above an end of the side: it crosses
 * the lines [low, high) and reaches into the strips [low, high]. */
static void find_lines(const struct hatch *h, const struct side *side,
                       int64_t *low, int64_t *high) {
  int64_t a = line_above(h, side->from.v), b = line_above(h, side->to.v);
  *low = a < b ? a : b;
  *high = a < b ? b : a;
}

/* Lists the sides by strip, the fragment's lines being [first, last). */
static bool list_strips(struct hatch *h, int64_t first, int64_t last) {
  size_t count = (size_t)(last - first) + 1;
  h->first = first;
  h->strip.count = h->strip_side.count = 0;
  if (!ARRAY_RESERVE(&h->strip, count + 2))
    return false;
  uint32_t *start = h->strip.item, sum = 0;
  for (size_t k = 0; k < count + 2; k++)
    start[k] = 0;
  for (size_t i = 0; i < h->side.count; i++) {
    int64_t low, high;
    find_lines(h, &h->side.item[i], &low, &high);
    for (int64_t k = low; k <= high; k++)
      start[k - first + 2]++;
  }
  for (size_t k = 0; k < count + 2; k++)
    start[k] = sum += start[k];
  if (!ARRAY_RESERVE(&h->strip_side, sum))
    return false;
  for (uint32_t i = 0; i < h->side.count; i++) {
    int64_t low, high;
    find_lines(h, &h->side.item[i], &low, &high);
    for (int64_t k = low; k <= high; k++)
      h->strip_side.item[start[k - first + 1]++] = i;
  }
  return true;
}

/* ---- 2 Spans --------------------------------------------------------------
 */

static double u_at(const struct side *side, double v) {
  struct place a = side->from, b = side->to;
  return a.u + (b.u - a.u) * ((v - a.v) / (b.v - a.v));
}

static int compare_crossings(const void *first, const void *second,
                             void *user) {
  const struct crossing *a = first, *b = second;
  (void)user;
  if (a->line != b->line)
    return (a->line > b->line) - (a->line < b->line);
  return (a->u > b->u) - (a->u < b->u);
}

static bool find_spans(struct hatch *h) {
  h->crossing.count = h->span.count = 0;
  for (uint32_t i = 0; i < h->side.count; i++) {
    int64_t low, high;
    find_lines(h, &h->side.item[i], &low, &high);
    for (int64_t k = low; k < high; k++) {
      double u = u_at(&h->side.item[i], height_of(h, k));
      if (!ARRAY_PUSH(&h->crossing, ((struct crossing){k, u, i})))
        return false;
    }
  }
  if (!sort_stable(h->crossing.item, h->crossing.count,
                   sizeof *h->crossing.item, compare_crossings, NULL))
    return false;
  for (size_t i = 0; i + 1 < h->crossing.count; i += 2) {
    const struct crossing *c = &h->crossing.item[i];
    if (c[0].u < c[1].u &&
        !ARRAY_PUSH(&h->span, ((struct span){c[0], c[1], false})))
      return false;
  }
  return true;
}

/* ---- 3 Strokes ------------------------------------------------------------
 */

static double cross(struct place a, struct place b, struct place c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

static bool is_crossed(const struct side *side, struct place a,
                       struct place b) {
  return cross(a, b, side->from) * cross(a, b, side->to) <= 0 &&
         cross(side->from, side->to, a) * cross(side->from, side->to, b) <= 0;
}

/* Whether the pen may go straight from one crossing to one on the next line:
 * past the other sides of the strip and with its middle inside. */
static bool is_inside(const struct hatch *h, const struct crossing *from,
                      const struct crossing *to) {
  struct place a = {from->u, height_of(h, from->line)};
  struct place b = {to->u, height_of(h, to->line)};
  struct place middle = {(a.u + b.u) / 2, (a.v + b.v) / 2};
  const uint32_t *start = h->strip.item + (to->line - h->first);
  bool inside = false;
  for (uint32_t i = start[0]; i < start[1]; i++) {
    uint32_t s = h->strip_side.item[i];
    const struct side *side = &h->side.item[s];
    if (s != from->side && s != to->side && is_crossed(side, a, b))
      return false;
    if ((side->from.v <= middle.v) != (side->to.v <= middle.v) &&
        u_at(side, middle.v) < middle.u)
      inside = !inside;
  }
  return inside;
}

/* The first span, from span `i` on, of a later line than that or of that line
 * and not wholly left of u. */
static size_t find_span(const struct hatch *h, size_t i, int64_t line,
                        double u) {
  size_t end = h->span.count;
  while (i < end) {
    size_t middle = i + (end - i) / 2;
    const struct crossing *c = &h->span.item[middle].right;
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
 * sides and to sides that bear no ink there is no way: the move would be seen
 * as a line between two faces that has no business there.
 * right  whether the pen stands at the right end */
static struct span *find_next(struct hatch *h, const struct span *span,
                              bool right) {
  const struct crossing *from = right ? &span->right : &span->left;
  size_t here = (size_t)(span - h->span.item);
  int64_t line = from->line + 1;
  size_t low = find_span(h, here, line, span->left.u);
  size_t high = find_span(h, low, line, span->right.u);
  low -= low > here + 1;
  if (!h->side.item[from->side].inked)
    return NULL;
  for (int tests = 0; tests < 2; tests++) {
    for (size_t i = low; i < h->span.count && i <= high; i++) {
      struct span *next = &h->span.item[i];
      const struct crossing *to = right ? &next->right : &next->left;
      if (to->line == line && !next->used && h->side.item[to->side].inked &&
          (tests ? is_inside(h, from, to) : from->side == to->side))
        return next;
    }
  }
  return NULL;
}

static bool add_point(struct hatch *h, const struct crossing *c) {
  return ARRAY_PUSH(&h->line.point, turn_back(h, c->u, height_of(h, c->line)));
}

/* Draws from `span` upwards as far as the pen need not be lifted. */
static bool add_stroke(struct hatch *h, struct span *span) {
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

static bool hatch_fragment(struct hatch *h,
                           const struct map_fragment *fragment) {
  int64_t first = INT64_MAX, last = INT64_MIN;
  if (!add_sides(h, fragment))
    return false;
  for (size_t i = 0; i < h->side.count; i++) {
    int64_t low, high;
    find_lines(h, &h->side.item[i], &low, &high);
    first = low < first ? low : first;
    last = high > last ? high : last;
  }
  if (first >= last) /* between two lines */
    return true;
  if (!list_strips(h, first, last) || !find_spans(h))
    return false;
  for (size_t i = 0; i < h->span.count; i++)
    if (!h->span.item[i].used && !add_stroke(h, &h->span.item[i]))
      return false;
  return true;
}

bool hatch_add(struct drawing *drawing, const struct sheet *sheet,
               const struct scene *scene, const struct map *map,
               const recto_options *options, double shortest_mm) {
  double angle = options->hatch_angle_deg * (acos(-1.0) / 180);
  struct hatch h = {.drawing = drawing,
                    .sheet = sheet,
                    .map = map,
                    .pitch = options->hatch_pitch_mm,
                    .cosine = cos(angle),
                    .sine = sin(angle),
                    .shortest = shortest_mm,
                    .intersections =
                        (options->edges & RECTO_EDGE_INTERSECTION) != 0};
  bool good = true;
  for (size_t i = 0; good && i < map->fragment.count; i++) {
    const struct map_fragment *fragment = &map->fragment.item[i];
    uint32_t group = scene->face_group.item[fragment->face];
    h.like =
        (struct drawing_stroke){.layer = layers_pen_of_group(options, group),
                                .face = fragment->face,
                                .edge = DRAWING_NONE,
                                .group = group};
    good = hatch_fragment(&h, fragment);
  }
  ARRAY_FREE(&h.side);
  ARRAY_FREE(&h.crossing);
  ARRAY_FREE(&h.span);
  ARRAY_FREE(&h.strip);
  ARRAY_FREE(&h.strip_side);
  ARRAY_FREE(&h.line.point);
  return good;
}
