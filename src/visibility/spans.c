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
  ARRAY_FREE(&spans->trapezoid);
  mem_free(spans->at);
  memset(spans, 0, sizeof *spans);
}

/* The trapezoid of the line above that the span makes longer, or NULL. */
static struct trapezoid *find_above(const struct spans *spans, int32_t line,
                                    const struct span *span) {
  uint32_t at =
      span->left.key == SPAN_ALONE ? SPAN_ALONE : spans->at[span->left.key];
  struct trapezoid *above;
  if (at == SPAN_ALONE || span->right.key == SPAN_ALONE)
    return NULL;
  above = &spans->trapezoid.item[at];
  return above->last == line + 1 && above->span.face == span->face &&
                 above->span.right.key == span->right.key
             ? above
             : NULL;
}

bool spans_add(struct spans *spans, int32_t line, const struct span *span) {
  struct trapezoid *above = find_above(spans, line, span);
  spans->count++;
  if (above != NULL) {
    above->last = line;
    above->span.left.lower = span->left.lower;
    above->span.right.lower = span->right.lower;
    return true;
  }
  if (span->left.key != SPAN_ALONE)
    spans->at[span->left.key] = (uint32_t)spans->trapezoid.count;
  struct trapezoid next = {*span, line, line};
  return ARRAY_PUSH(&spans->trapezoid, next);
}

/* ---- Filing ------------------------------------------------------------- */

static double clamp(double value, double low, double high) {
  return value < low ? low : value > high ? high : value;
}

static double round_corner(double value) {
  return nearbyint(value * CORNER_SCALE) / CORNER_SCALE;
}

/* The trapezoid's corners, counter-clockwise from the lower left.  Sides that
 * cross within the half line beyond their last centre meet in the middle. */
static void make_corners(const struct spans *spans,
                         const struct trapezoid *trapezoid,
                         struct map_corner corner[4]) {
  const struct span_side *left = &trapezoid->span.left;
  const struct span_side *right = &trapezoid->span.right;
  double x[4] = {left->lower, right->lower, right->upper, left->upper};
  double low = scan_plane_y(&spans->grid, trapezoid->last);
  double high = scan_plane_y(&spans->grid, trapezoid->first + 1);
  if (x[0] > x[1])
    x[0] = x[1] = (x[0] + x[1]) / 2;
  if (x[3] > x[2])
    x[3] = x[2] = (x[3] + x[2]) / 2;
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
  size_t count = spans->trapezoid.count;
  struct sort_key *key = mem_alloc(2 * count, sizeof *key);
  bool good = key != NULL;
  for (size_t i = 0; good && i < count; i++)
    key[i] = (struct sort_key){spans->trapezoid.item[i].span.face, (uint32_t)i};
  if (good)
    sort_keys(key, key + count, count);
  for (size_t i = 0; good && i < count; i++) {
    const struct trapezoid *trapezoid = &spans->trapezoid.item[key[i].value];
    struct map_corner corner[4];
    make_corners(spans, trapezoid, corner);
    good = file_loop(corner, trapezoid->span.face, map);
  }
  mem_free(key);
  return good;
}
