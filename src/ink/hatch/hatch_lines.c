/* hatch_lines.c - the hatch lines of a page and the spans of them that lie
 * inside fragments.
 *
 * Fragments are rotated so that the hatch lines are horizontal, their corners
 * are rounded to 2^-28 mm, and the scan-line fill (geom/scanfill.h) finds the
 * spans by the even-odd rule.
 *
 * Robustness  A corner that several fragments share is rounded to the same
 *             point for each of them.  Where a side lies within the rounding
 *             error of a line, either result is correct.
 * Source      [FoleyVanDam1990] ch. 3 */
#include "ink/hatch/hatch_lines.h"

#include <math.h>

#include "base/tolerance.h"
#include "geom/nearest.h"
#include "scene/angle.h"

#define UNITS_PER_MM 0x1p28
#define STEP_DEN (1 << 10) /* lines are at multiples of 1 / (2 STEP_DEN) unit */
#define EXTENT_MM 4096.0   /* above every |v| of a page, however rotated */

void hatch_lines_init(struct hatch_lines *lines, const struct sheet *sheet,
                      double pitch, double angle_deg) {
  struct angle angle = angle_of_degrees(angle_deg);
  *lines = (struct hatch_lines){.sheet = sheet,
                                .pitch = pitch,
                                .cosine = angle.cosine,
                                .sine = angle.sine};
}

void hatch_lines_fini(struct hatch_lines *lines) {
  ARRAY_FREE(&lines->side);
  ARRAY_FREE(&lines->found);
  ARRAY_FREE(&lines->span);
}

double hatch_lines_height(const struct hatch_lines *lines, int64_t line) {
  return ((double)line + 0.5) * lines->pitch;
}

struct hatch_point hatch_lines_rotate(const struct hatch_lines *lines,
                                      struct drawing_point p) {
  return (struct hatch_point){p.x * lines->cosine + p.y * lines->sine,
                              p.y * lines->cosine - p.x * lines->sine};
}

struct drawing_point hatch_lines_rotate_back(const struct hatch_lines *lines,
                                             struct hatch_point p) {
  return (struct drawing_point){p.u * lines->cosine - p.v * lines->sine,
                                p.u * lines->sine + p.v * lines->cosine};
}

/* ---- Sides --------------------------------------------------------------- */

/* The point where a half-edge starts. */
static struct hatch_point rotated_origin(const struct hatch_lines *lines,
                                         const struct map *map, uint32_t half) {
  const struct map_corner *c =
      &map->corner.item[map->half_edge.item[half].origin];
  return hatch_lines_rotate(
      lines, (struct drawing_point){sheet_x_mm(lines->sheet, c->x),
                                    sheet_y_mm(lines->sheet, c->y)});
}

double hatch_lines_distance(struct hatch_point p, struct hatch_point a,
                            struct hatch_point b) {
  double du = b.u - a.u, dv = b.v - a.v;
  double t = geom_nearest_parameter(du, dv, p.u - a.u, p.v - a.v);
  return hypot(p.u - a.u - t * du, p.v - a.v - t * dv);
}

void hatch_lines_clear(struct hatch_lines *lines) { lines->side.count = 0; }

bool hatch_lines_add_fragment(struct hatch_lines *lines, const struct map *map,
                              const struct map_fragment *fragment,
                              const uint8_t *skip) {
  const struct map_half_edge *half = map->half_edge.item;
  for (uint32_t l = 0; l < fragment->loops; l++) {
    uint32_t first = map->loop.item[fragment->loop + l].half_edge, h = first;
    uint32_t last = SHEET_NONE; /* the side that was added last, in part */
    do {
      uint32_t next = half[h].next;
      struct hatch_side side = {.corner = &map->corner.item[half[h].side]};
      if (skip != NULL && skip[h]) {
        last = SHEET_NONE;
      } else if (half[h].side == last) {
        lines->side.item[lines->side.count - 1].to =
            rotated_origin(lines, map, next);
      } else {
        side.from = rotated_origin(lines, map, h);
        side.to = rotated_origin(lines, map, next);
        last = half[h].side;
        if (!ARRAY_PUSH(&lines->side, side))
          return false;
      }
      h = next;
    } while (h != first);
  }
  return true;
}

/* ---- Spans --------------------------------------------------------------- */

/* Sets the scan grid: the hatch lines of the whole page, in units of
 * 2^-28 mm. */
static void set_grid(struct hatch_lines *lines) {
  double pitch = lines->pitch < EXTENT_MM ? lines->pitch : EXTENT_MM;
  double half = ceil(EXTENT_MM / pitch);
  struct scan_grid *grid = &lines->grid;
  lines->first = -(int64_t)half;
  grid->den = grid->x_step = STEP_DEN;
  grid->x_first = 0;
  grid->y_step = 2 * llround(pitch * UNITS_PER_MM * STEP_DEN / 2);
  grid->y_first = lines->first * grid->y_step;
  grid->columns = 1; /* columns are not used */
  grid->lines = (int32_t)(2 * half);
  grid->down = false;
}

/* A point rounded to units of the scan grid. */
static struct scan_point scan_point_at(const struct hatch_lines *lines,
                                       struct hatch_point p) {
  return scan_point_of(&lines->grid, llround(p.u * UNITS_PER_MM),
                       llround(p.v * UNITS_PER_MM));
}

void hatch_lines_side_range(const struct hatch_lines *lines,
                            const struct hatch_side *side, int64_t *low,
                            int64_t *high) {
  int64_t a = scan_point_at(lines, side->from).line + lines->first;
  int64_t b = scan_point_at(lines, side->to).line + lines->first;
  *low = a < b ? a : b;
  *high = a < b ? b : a;
}

double hatch_lines_u_at(const struct hatch_side *side, double v) {
  struct hatch_point a = side->from, b = side->to;
  return a.u + (b.u - a.u) * ((v - a.v) / (b.v - a.v));
}

/* Adds a span of the current line.  One that begins where the last span ended
 * extends it instead. */
static bool add_hatch_span(struct hatch_lines *lines,
                           const struct scan_table *table,
                           const struct scan_span *found) {
  const double gap = TOLERANCE_COINCIDENT_UNITS / SHEET_UNITS_PER_MM;
  const struct scan_edge *edge = table->edge.item;
  int64_t line = table->line + lines->first;
  struct hatch_span span = {
      {line, found->x0 / UNITS_PER_MM, edge[found->left].owner},
      {line, found->x1 / UNITS_PER_MM, edge[found->right].owner},
      false};
  if (lines->span.count > 0) {
    struct hatch_span *last = &lines->span.item[lines->span.count - 1];
    if (last->left.line == line && span.left.u <= last->right.u + gap) {
      last->right = span.right;
      return true;
    }
  }
  return span.left.u >= span.right.u || ARRAY_PUSH(&lines->span, span);
}

/* Adds the spans inside the sides, line by line.  False when memory ran out. */
static bool scan_sides(struct hatch_lines *lines, struct scan_table *table) {
  for (uint32_t i = 0; i < lines->side.count; i++) {
    struct scan_point p = scan_point_at(lines, lines->side.item[i].from);
    struct scan_point q = scan_point_at(lines, lines->side.item[i].to);
    if (!scan_table_add(table, &p, &q, i))
      return false;
  }
  if (!scan_table_start(table))
    return false;
  while (scan_table_next(table)) {
    lines->found.count = 0;
    if (!ARRAY_RESERVE(&lines->found, table->active_count))
      return false;
    size_t count = scan_table_spans(table, SCAN_EVEN_ODD, lines->found.item);
    for (size_t i = 0; i < count; i++)
      if (!add_hatch_span(lines, table, &lines->found.item[i]))
        return false;
  }
  return true;
}

bool hatch_lines_find_spans(struct hatch_lines *lines) {
  struct scan_table table;
  lines->span.count = 0;
  set_grid(lines);
  scan_table_init(&table, &lines->grid);
  bool ok = scan_sides(lines, &table);
  scan_table_fini(&table);
  return ok;
}
