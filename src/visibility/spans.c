/* spans.c - visible spans as the map's fragments. */
#include "visibility/spans.h"

#include <math.h>
#include <string.h>

#include "base/sort.h"

#define CORNER_SCALE 256 /* the map's corners are multiples of 1/256 unit */

bool spans_init(struct spans *spans, const struct sheet *sheet,
                const struct scan_grid *grid, size_t keys) {
  memset(spans, 0, sizeof *spans);
  spans->grid = *grid;
  spans->x_high = sheet->camera.page_mm[0] / 2 * SHEET_UNITS_PER_MM;
  spans->y_high = sheet->camera.page_mm[1] / 2 * SHEET_UNITS_PER_MM;
  spans->x_low = -spans->x_high;
  spans->y_low = -spans->y_high;
  spans->keys = keys;
  spans->at = mem_alloc(keys, sizeof *spans->at);
  if (spans->at == NULL)
    return false;
  memset(spans->at, 0xff, keys * sizeof *spans->at);
  return true;
}

void spans_fini(struct spans *spans) {
  ARRAY_FREE(&spans->row);
  ARRAY_FREE(&spans->border);
  ARRAY_FREE(&spans->side);
  ARRAY_FREE(&spans->trapezoid);
  mem_free(spans->at);
  memset(spans, 0, sizeof *spans);
}

/* ---- Borders ------------------------------------------------------------- */

static bool list_borders(struct spans *spans) {
  struct span *row = spans->row.item;
  size_t count = spans->row.count;
  spans->side.count = 0;
  if (!ARRAY_RESERVE(&spans->side, 4 * count) ||
      !ARRAY_RESERVE(&spans->border, 4 * count))
    return false;
  for (size_t i = 0; i < count; i++) {
    bool meets = i > 0 && row[i - 1].right.x == row[i].left.x;
    struct span_side **side = spans->side.item + spans->side.count;
    side[0] = meets ? &row[i - 1].right : NULL;
    side[1] = &row[i].left;
    spans->side.count += 2;
    if (i + 1 < count && row[i].right.x == row[i + 1].left.x)
      continue;
    side[2] = &row[i].right;
    side[3] = NULL;
    spans->side.count += 2;
  }
  return true;
}

/* Makes values ascend: those that do not are replaced by their mean, as few as
 * will do.  (Adjacent violators are pooled.) */
static void make_ascend(double *value, size_t count) {
  for (size_t i = 1; i < count; i++) {
    size_t first = i;
    double sum = value[i];
    if (value[i] >= value[i - 1])
      continue;
    while (first > 0 && value[first - 1] > sum / (double)(i + 1 - first))
      sum += value[--first];
    for (size_t k = first; k <= i; k++)
      value[k] = sum / (double)(i + 1 - first);
  }
}

/* Settles the upper or the lower x of all borders. */
static void settle_borders(struct spans *spans, bool upper) {
  struct span_side **side = spans->side.item;
  size_t count = spans->side.count / 2;
  double *value = spans->border.item;
  for (size_t i = 0; i < count; i++) {
    double sum = 0, sides = 0;
    for (size_t k = 2 * i; k < 2 * i + 2; k++)
      if (side[k] != NULL) {
        sum += upper ? side[k]->upper : side[k]->lower;
        sides++;
      }
    value[i] = sum / sides;
  }
  make_ascend(value, count);
  for (size_t k = 0; k < 2 * count; k++)
    if (side[k] != NULL) {
      double *x = upper ? &side[k]->upper : &side[k]->lower;
      side[k]->straight &= *x == value[k / 2];
      *x = value[k / 2];
    }
}

/* ---- Lines --------------------------------------------------------------- */

/* The trapezoid of the line above that the span makes longer, or NULL. */
static struct trapezoid *find_above(const struct spans *spans,
                                    const struct span *span) {
  uint32_t at = span->left.straight && span->right.straight
                    ? spans->at[span->left.key]
                    : SPAN_ALONE;
  struct trapezoid *above;
  if (at == SPAN_ALONE)
    return NULL;
  above = &spans->trapezoid.item[at];
  return above->last == spans->line + 1 && above->span.face == span->face &&
                 above->span.right.key == span->right.key &&
                 above->span.left.straight && above->span.right.straight
             ? above
             : NULL;
}

static bool join_span(struct spans *spans, const struct span *span) {
  struct trapezoid *above = find_above(spans, span);
  if (above != NULL) {
    above->last = spans->line;
    above->span.left.lower = span->left.lower;
    above->span.right.lower = span->right.lower;
    return true;
  }
  if (span->left.key != SPAN_ALONE)
    spans->at[span->left.key] = (uint32_t)spans->trapezoid.count;
  struct trapezoid next = {*span, spans->line, spans->line};
  return ARRAY_PUSH(&spans->trapezoid, next);
}

static bool end_line(struct spans *spans) {
  if (spans->row.count == 0)
    return true;
  if (!list_borders(spans))
    return false;
  settle_borders(spans, true);
  settle_borders(spans, false);
  for (size_t i = 0; i < spans->row.count; i++)
    if (!join_span(spans, &spans->row.item[i]))
      return false;
  spans->row.count = 0;
  return true;
}

bool spans_add(struct spans *spans, int32_t line, const struct span *span) {
  if (line != spans->line && !end_line(spans))
    return false;
  spans->line = line;
  spans->count++;
  return ARRAY_PUSH(&spans->row, *span);
}

/* ---- Filing -------------------------------------------------------------- */

static double clamp(double value, double low, double high) {
  return value < low ? low : value > high ? high : value;
}

static double round_corner(double value) {
  return nearbyint(value * CORNER_SCALE) / CORNER_SCALE;
}

/* The trapezoid's corners, counter-clockwise from the lower left. */
static void make_corners(const struct spans *spans,
                         const struct trapezoid *trapezoid,
                         struct map_corner corner[4]) {
  const struct span_side *left = &trapezoid->span.left;
  const struct span_side *right = &trapezoid->span.right;
  double x[4] = {left->lower, right->lower, right->upper, left->upper};
  double low = scan_plane_y(&spans->grid, trapezoid->last);
  double high = scan_plane_y(&spans->grid, trapezoid->first + 1);
  for (int k = 0; k < 4; k++) {
    corner[k] = (struct map_corner){.side = MAP_SIDE_CUT, .id = SHEET_NONE};
    corner[k].x = round_corner(clamp(x[k], spans->x_low, spans->x_high));
    corner[k].y =
        round_corner(clamp(k < 2 ? low : high, spans->y_low, spans->y_high));
  }
  corner[1].side = right->side;
  corner[1].id = right->id;
  corner[3].side = left->side;
  corner[3].id = left->id;
}

/* Files the loop of the corners that differ, from the lowest in (x, y). */
static bool file_loop(const struct map_corner corner[4], uint32_t face,
                      struct map *map) {
  struct map_corner kept[4];
  uint32_t count = 0, first = 0;
  for (int k = 0; k < 4; k++) {
    const struct map_corner *next = &corner[(k + 1) % 4];
    if (corner[k].x != next->x || corner[k].y != next->y)
      kept[count++] = corner[k];
  }
  if (count < 3)
    return true;
  for (uint32_t k = 1; k < count; k++)
    if (kept[k].x < kept[first].x ||
        (kept[k].x == kept[first].x && kept[k].y < kept[first].y))
      first = k;
  struct map_loop loop = {(uint32_t)map->corner.count, count};
  struct map_fragment fragment = {face, (uint32_t)map->loop.count, 1};
  for (uint32_t k = 0; k < count; k++)
    if (!ARRAY_PUSH(&map->corner, kept[(first + k) % count]))
      return false;
  return ARRAY_PUSH(&map->loop, loop) && ARRAY_PUSH(&map->fragment, fragment);
}

bool spans_finish(struct spans *spans, struct map *map) {
  bool ok = end_line(spans);
  size_t count = spans->trapezoid.count;
  struct sort_key *key = mem_alloc(2 * count, sizeof *key);
  ok = ok && key != NULL;
  for (size_t i = 0; ok && i < count; i++)
    key[i] = (struct sort_key){spans->trapezoid.item[i].span.face, (uint32_t)i};
  if (ok)
    sort_keys(key, key + count, count);
  for (size_t i = 0; ok && i < count; i++) {
    const struct trapezoid *trapezoid = &spans->trapezoid.item[key[i].value];
    struct map_corner corner[4];
    make_corners(spans, trapezoid, corner);
    ok = file_loop(corner, trapezoid->span.face, map);
  }
  mem_free(key);
  return ok;
}
