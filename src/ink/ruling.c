/* ruling.c - the page ruled with parallel lines, and what of them lies in
 * fragments.
 *
 * A fragment is turned so that the lines are level.  Its spans lie between
 * the first and second, third and fourth, ... crossing of a line with the
 * sides (even-odd).
 * Robustness  A side crosses the lines with low <= height < high, its ends'
 *   heights being the same doubles as its neighbours', so that every line has
 *   an even number of crossings.  Where a side lies within rounding of a line
 *   either outcome is right.
 * Source  [Foley] ch. 3 */
#include "ink/ruling.h"

#include <math.h>

#include "base/sort.h"
#include "base/tolerance.h"

void ruling_init(struct ruling *ruling, const struct sheet *sheet, double pitch,
                 double angle_deg) {
  double angle = angle_deg * (acos(-1.0) / 180);
  *ruling = (struct ruling){
      .sheet = sheet, .pitch = pitch, .cosine = cos(angle), .sine = sin(angle)};
}

void ruling_fini(struct ruling *ruling) {
  ARRAY_FREE(&ruling->side);
  ARRAY_FREE(&ruling->crossing);
  ARRAY_FREE(&ruling->span);
}

double ruling_height(const struct ruling *ruling, int64_t line) {
  return ((double)line + 0.5) * ruling->pitch;
}

struct ruling_place ruling_turn(const struct ruling *ruling,
                                struct drawing_point p) {
  return (struct ruling_place){p.x * ruling->cosine + p.y * ruling->sine,
                               p.y * ruling->cosine - p.x * ruling->sine};
}

struct drawing_point ruling_turn_back(const struct ruling *ruling,
                                      struct ruling_place p) {
  return (struct drawing_point){p.u * ruling->cosine - p.v * ruling->sine,
                                p.u * ruling->sine + p.v * ruling->cosine};
}

/* ---- Sides ----------------------------------------------------------------
 */

static struct ruling_place turn_corner(const struct ruling *ruling,
                                       const struct map_corner *c) {
  return ruling_turn(ruling,
                     (struct drawing_point){sheet_x_mm(ruling->sheet, c->x),
                                            sheet_y_mm(ruling->sheet, c->y)});
}

void ruling_clear(struct ruling *ruling) { ruling->side.count = 0; }

bool ruling_take(struct ruling *ruling, const struct map *map,
                 const struct map_fragment *fragment) {
  for (uint32_t l = 0; l < fragment->loops; l++) {
    const struct map_loop *loop = &map->loop.item[fragment->loop + l];
    const struct map_corner *corner = map->corner.item + loop->corner;
    for (uint32_t i = 0; i < loop->count; i++) {
      uint32_t next = i + 1 < loop->count ? i + 1 : 0;
      struct ruling_side side = {turn_corner(ruling, &corner[i]),
                                 turn_corner(ruling, &corner[next]),
                                 &corner[i]};
      if (!ARRAY_PUSH(&ruling->side, side))
        return false;
    }
  }
  return true;
}

/* The first line not below v. */
static int64_t line_above(const struct ruling *ruling, double v) {
  int64_t line = (int64_t)ceil(v / ruling->pitch - 0.5);
  /* The quotient may have been rounded across. */
  while (ruling_height(ruling, line) < v)
    line++;
  while (ruling_height(ruling, line - 1) >= v)
    line--;
  return line;
}

void ruling_find_lines(const struct ruling *ruling,
                       const struct ruling_side *side, int64_t *low,
                       int64_t *high) {
  int64_t a = line_above(ruling, side->from.v);
  int64_t b = line_above(ruling, side->to.v);
  *low = a < b ? a : b;
  *high = a < b ? b : a;
}

/* ---- Spans ----------------------------------------------------------------
 */

double ruling_u_at(const struct ruling_side *side, double v) {
  struct ruling_place a = side->from, b = side->to;
  return a.u + (b.u - a.u) * ((v - a.v) / (b.v - a.v));
}

static int compare_crossings(const void *first, const void *second,
                             void *user) {
  const struct ruling_crossing *a = first, *b = second;
  (void)user;
  if (a->line != b->line)
    return (a->line > b->line) - (a->line < b->line);
  return (a->u > b->u) - (a->u < b->u);
}

static bool find_crossings(struct ruling *ruling) {
  ruling->crossing.count = 0;
  for (uint32_t i = 0; i < ruling->side.count; i++) {
    const struct ruling_side *side = &ruling->side.item[i];
    int64_t low, high;
    ruling_find_lines(ruling, side, &low, &high);
    for (int64_t k = low; k < high; k++) {
      double u = ruling_u_at(side, ruling_height(ruling, k));
      if (!ARRAY_PUSH(&ruling->crossing, ((struct ruling_crossing){k, u, i})))
        return false;
    }
  }
  return sort_stable(ruling->crossing.item, ruling->crossing.count,
                     sizeof *ruling->crossing.item, compare_crossings, NULL);
}

bool ruling_find_spans(struct ruling *ruling) {
  /* Spans that meet where two fragments do are one. */
  const double gap = TOLERANCE_COINCIDENT_UNITS / SHEET_UNITS_PER_MM;
  ruling->span.count = 0;
  if (!find_crossings(ruling))
    return false;
  for (size_t i = 0; i + 1 < ruling->crossing.count; i += 2) {
    const struct ruling_crossing *c = &ruling->crossing.item[i];
    struct ruling_span *last = NULL;
    if (ruling->span.count > 0)
      last = &ruling->span.item[ruling->span.count - 1];
    if (last && last->left.line == c[0].line && c[0].u <= last->right.u + gap)
      last->right = c[1];
    else if (c[0].u < c[1].u &&
             !ARRAY_PUSH(&ruling->span,
                         ((struct ruling_span){c[0], c[1], false})))
      return false;
  }
  return true;
}
