/* ruling.c - the page ruled with parallel lines, and what of them lies in
 * fragments.
 *
 * A fragment is turned so that the lines are level, its corners are rounded to
 * 2^-28 mm, and the scan-line fill does the rest (even-odd).
 * Robustness  A corner that fragments share is rounded to one place.  Where a
 *   side lies within rounding of a line either outcome is right.
 * Source  [Foley] ch. 3 */
#include "ink/ruling.h"

#include <math.h>

#include "base/tolerance.h"

#define UNITS_PER_MM 0x1p28
#define STEP_DEN (1 << 10) /* lines stand at multiples of 1 / (2 STEP_DEN) */
#define REACH_MM 4096.0    /* no page is so large, wherever it is turned */

void ruling_init(struct ruling *ruling, const struct sheet *sheet, double pitch,
                 double angle_deg) {
  double angle = angle_deg * (acos(-1.0) / 180);
  *ruling = (struct ruling){
      .sheet = sheet, .pitch = pitch, .cosine = cos(angle), .sine = sin(angle)};
}

void ruling_fini(struct ruling *ruling) {
  ARRAY_FREE(&ruling->side);
  ARRAY_FREE(&ruling->found);
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

/* ---- Sides --------------------------------------------------------------- */

struct ruling_place ruling_place_at(const struct ruling *ruling, double x,
                                    double y) {
  return ruling_turn(ruling,
                     (struct drawing_point){sheet_x_mm(ruling->sheet, x),
                                            sheet_y_mm(ruling->sheet, y)});
}

double ruling_distance(struct ruling_place p, struct ruling_place a,
                       struct ruling_place b) {
  double du = b.u - a.u, dv = b.v - a.v, length2 = du * du + dv * dv;
  double t = length2 > 0 ? ((p.u - a.u) * du + (p.v - a.v) * dv) / length2 : 0;
  t = fmin(fmax(t, 0), 1);
  return hypot(p.u - a.u - t * du, p.v - a.v - t * dv);
}

void ruling_clear(struct ruling *ruling) { ruling->side.count = 0; }

bool ruling_take(struct ruling *ruling, const struct map *map,
                 const struct map_fragment *fragment) {
  for (uint32_t l = 0; l < fragment->loops; l++) {
    const struct map_loop *loop = &map->loop.item[fragment->loop + l];
    const struct map_corner *corner = map->corner.item + loop->corner;
    for (uint32_t i = 0; i < loop->count; i++) {
      uint32_t next = i + 1 < loop->count ? i + 1 : 0;
      struct ruling_side side = {
          ruling_place_at(ruling, corner[i].x, corner[i].y),
          ruling_place_at(ruling, corner[next].x, corner[next].y), &corner[i],
          &corner[next]};
      if (!ARRAY_PUSH(&ruling->side, side))
        return false;
    }
  }
  return true;
}

/* ---- Spans --------------------------------------------------------------- */

/* Lines all over the page, in units of 2^-28 mm. */
static void set_grid(struct ruling *ruling) {
  double pitch = ruling->pitch < REACH_MM ? ruling->pitch : REACH_MM;
  double half = ceil(REACH_MM / pitch);
  struct scan_grid *grid = &ruling->grid;
  ruling->first = -(int64_t)half;
  grid->den = grid->x_step = STEP_DEN;
  grid->x_first = 0;
  grid->y_step = 2 * llround(pitch * UNITS_PER_MM * STEP_DEN / 2);
  grid->y_first = ruling->first * grid->y_step;
  grid->columns = 1; /* not asked for */
  grid->lines = (int32_t)(2 * half);
  grid->down = false;
}

static struct scan_point point_of(const struct ruling *ruling,
                                  struct ruling_place place) {
  return scan_point_of(&ruling->grid, llround(place.u * UNITS_PER_MM),
                       llround(place.v * UNITS_PER_MM));
}

void ruling_find_lines(const struct ruling *ruling,
                       const struct ruling_side *side, int64_t *low,
                       int64_t *high) {
  int64_t a = point_of(ruling, side->from).line + ruling->first;
  int64_t b = point_of(ruling, side->to).line + ruling->first;
  *low = a < b ? a : b;
  *high = a < b ? b : a;
}

double ruling_u_at(const struct ruling_side *side, double v) {
  struct ruling_place a = side->from, b = side->to;
  return a.u + (b.u - a.u) * ((v - a.v) / (b.v - a.v));
}

/* Adds a span of the line at hand; one that begins where the last ended makes
 * that one longer. */
static bool add_span(struct ruling *ruling, const struct scan_table *table,
                     const struct scan_span *found) {
  const double gap = TOLERANCE_COINCIDENT_UNITS / SHEET_UNITS_PER_MM;
  const struct scan_edge *edge = table->edge.item;
  int64_t line = table->line + ruling->first;
  struct ruling_span span = {
      {line, found->x0 / UNITS_PER_MM, edge[found->left].owner},
      {line, found->x1 / UNITS_PER_MM, edge[found->right].owner},
      false};
  if (ruling->span.count > 0) {
    struct ruling_span *last = &ruling->span.item[ruling->span.count - 1];
    if (last->left.line == line && span.left.u <= last->right.u + gap) {
      last->right = span.right;
      return true;
    }
  }
  return span.left.u >= span.right.u || ARRAY_PUSH(&ruling->span, span);
}

static bool scan_sides(struct ruling *ruling, struct scan_table *table) {
  for (uint32_t i = 0; i < ruling->side.count; i++) {
    struct scan_point p = point_of(ruling, ruling->side.item[i].from);
    struct scan_point q = point_of(ruling, ruling->side.item[i].to);
    if (!scan_table_add(table, &p, &q, i))
      return false;
  }
  if (!scan_table_start(table))
    return false;
  while (scan_table_next(table)) {
    ruling->found.count = 0;
    if (!ARRAY_RESERVE(&ruling->found, table->active_count))
      return false;
    size_t count = scan_table_spans(table, SCAN_EVEN_ODD, ruling->found.item);
    for (size_t i = 0; i < count; i++)
      if (!add_span(ruling, table, &ruling->found.item[i]))
        return false;
  }
  return true;
}

bool ruling_find_spans(struct ruling *ruling) {
  struct scan_table table;
  ruling->span.count = 0;
  set_grid(ruling);
  scan_table_init(&table, &ruling->grid);
  bool ok = scan_sides(ruling, &table);
  scan_table_fini(&table);
  return ok;
}
