/* trapezoids.c - trapezoids from visible spans, as fragments of the map. */
#include "visibility/scan/trapezoids.h"

#include <math.h>
#include <string.h>

#include "base/sort.h"

bool trapezoids_init(struct trapezoids *trapezoids, const struct sheet *sheet,
                     const struct scan_grid *grid, size_t keys) {
  memset(trapezoids, 0, sizeof *trapezoids);
  trapezoids->sheet = sheet;
  trapezoids->grid = *grid;
  trapezoids->x_high = sheet->camera.page_mm[0] / 2 * SHEET_UNITS_PER_MM;
  trapezoids->y_high = sheet->camera.page_mm[1] / 2 * SHEET_UNITS_PER_MM;
  trapezoids->x_low = -trapezoids->x_high;
  trapezoids->y_low = -trapezoids->y_high;
  trapezoids->at = mem_alloc(keys, sizeof *trapezoids->at);
  if (trapezoids->at == NULL)
    return false;
  memset(trapezoids->at, 0xff, keys * sizeof *trapezoids->at);
  return true;
}

void trapezoids_fini(struct trapezoids *trapezoids) {
  ARRAY_FREE(&trapezoids->row);
  ARRAY_FREE(&trapezoids->border);
  ARRAY_FREE(&trapezoids->side);
  ARRAY_FREE(&trapezoids->trapezoid);
  mem_free(trapezoids->at);
  ARRAY_FREE(&trapezoids->lines);
  memset(trapezoids, 0, sizeof *trapezoids);
}

/* ---- Borders ------------------------------------------------------------- */

static bool list_borders(struct trapezoids *trapezoids) {
  struct span *row = trapezoids->row.item;
  size_t count = trapezoids->row.count;
  trapezoids->side.count = 0;
  if (!ARRAY_RESERVE(&trapezoids->side, 4 * count) ||
      !ARRAY_RESERVE(&trapezoids->border, 4 * count))
    return false;
  for (size_t i = 0; i < count; i++) {
    bool meets = i > 0 && row[i - 1].right.x == row[i].left.x;
    struct span_side **side = trapezoids->side.item + trapezoids->side.count;
    side[0] = meets ? &row[i - 1].right : NULL;
    side[1] = &row[i].left;
    trapezoids->side.count += 2;
    if (i + 1 < count && row[i].right.x == row[i + 1].left.x)
      continue;
    side[2] = &row[i].right;
    side[3] = NULL;
    trapezoids->side.count += 2;
  }
  return true;
}

/* Isotonic regression: replaces runs of values that do not ascend by their mean
 * (the pool-adjacent-violators algorithm). */
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

/* Decides the upper or the lower x of all borders of the line. */
static void compute_borders(struct trapezoids *trapezoids, bool upper) {
  struct span_side **side = trapezoids->side.item;
  size_t count = trapezoids->side.count / 2;
  double *value = trapezoids->border.item;
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

/* The trapezoid of the line above that the span extends, or NULL. */
static struct trapezoid *find_above(const struct trapezoids *trapezoids,
                                    const struct span *span) {
  uint32_t at = span->left.straight && span->right.straight
                    ? trapezoids->at[span->left.key]
                    : SPAN_ALONE;
  struct trapezoid *above;
  if (at == SPAN_ALONE)
    return NULL;
  above = &trapezoids->trapezoid.item[at];
  return above->last == trapezoids->line + 1 &&
                 above->span.face == span->face &&
                 above->span.right.key == span->right.key &&
                 above->span.left.straight && above->span.right.straight
             ? above
             : NULL;
}

static bool join_span(struct trapezoids *trapezoids, const struct span *span) {
  struct trapezoid *above = find_above(trapezoids, span);
  if (above != NULL) {
    above->last = trapezoids->line;
    above->span.left.lower = span->left.lower;
    above->span.right.lower = span->right.lower;
    return true;
  }
  if (span->left.key != SPAN_ALONE)
    trapezoids->at[span->left.key] = (uint32_t)trapezoids->trapezoid.count;
  struct trapezoid next = {*span, trapezoids->line, trapezoids->line};
  return ARRAY_PUSH(&trapezoids->trapezoid, next);
}

static bool end_line(struct trapezoids *trapezoids) {
  if (trapezoids->row.count == 0)
    return true;
  if (!list_borders(trapezoids))
    return false;
  compute_borders(trapezoids, true);
  compute_borders(trapezoids, false);
  for (size_t i = 0; i < trapezoids->row.count; i++)
    if (!join_span(trapezoids, &trapezoids->row.item[i]))
      return false;
  trapezoids->row.count = 0;
  return true;
}

bool trapezoids_add(struct trapezoids *trapezoids, int32_t line,
                    const struct span *span) {
  if (line != trapezoids->line && !end_line(trapezoids))
    return false;
  trapezoids->line = line;
  trapezoids->count++;
  return ARRAY_PUSH(&trapezoids->row, *span);
}

/* ---- Fragments ----------------------------------------------------------- */

static double round_corner(double value) {
  return nearbyint(value * MAP_CORNER_SCALE) / MAP_CORNER_SCALE;
}

/* The trapezoid's corners, counter-clockwise from the lower left. */
static void make_corners(const struct trapezoids *trapezoids,
                         const struct trapezoid *trapezoid,
                         struct map_corner corner[4]) {
  const struct span_side *left = &trapezoid->span.left;
  const struct span_side *right = &trapezoid->span.right;
  double x[4] = {left->lower, right->lower, right->upper, left->upper};
  double low = scan_plane_y(&trapezoids->grid, trapezoid->last);
  double high = scan_plane_y(&trapezoids->grid, trapezoid->first + 1);
  for (int k = 0; k < 4; k++) {
    corner[k] = (struct map_corner){.side = MAP_SIDE_CLIP, .id = SHEET_NONE};
    corner[k].x =
        round_corner(fmin(fmax(x[k], trapezoids->x_low), trapezoids->x_high));
    corner[k].y = round_corner(
        fmin(fmax(k < 2 ? low : high, trapezoids->y_low), trapezoids->y_high));
  }
  corner[1].side = right->side;
  corner[1].id = right->id;
  corner[3].side = left->side;
  corner[3].id = left->id;
}

/* Adds the line of side k of a trapezoid.  Cuts share their height;
 * straight sides their edge, which need not be one of the sheet; other sides
 * are one line high and share their x there. */
static bool add_trapezoid_side(struct trapezoids *trapezoids,
                               const struct trapezoid *trapezoid, int k,
                               const struct map_corner *corner) {
  const struct span_side *side =
      k == 1 ? &trapezoid->span.right : &trapezoid->span.left;
  uint64_t key;
  if (k % 2 == 0) {
    key = sort_key_of_int64((int64_t)(corner->y * MAP_CORNER_SCALE));
  } else if (side->straight && side->side != MAP_SIDE_CLIP) {
    return side_lines_add(&trapezoids->lines, corner, NULL);
  } else if (side->straight) {
    key = 1 + (uint64_t)side->key;
  } else {
    memcpy(&key, &side->x, sizeof key);
    key += (uint64_t)trapezoid->first << 32;
  }
  return side_lines_add_key(&trapezoids->lines, key);
}

/* Stores the loop of the distinct corners, from the lowest in (x, y). */
static bool store_trapezoid_loop(struct trapezoids *trapezoids,
                                 const struct trapezoid *trapezoid,
                                 const struct map_corner corner[4],
                                 struct map *map) {
  int kept[4], count = 0, first = 0;
  for (int k = 0; k < 4; k++) {
    const struct map_corner *next = &corner[(k + 1) % 4];
    if (corner[k].x != next->x || corner[k].y != next->y)
      kept[count++] = k;
  }
  if (count < 3)
    return true;
  for (int k = 1; k < count; k++) {
    const struct map_corner *a = &corner[kept[k]], *b = &corner[kept[first]];
    if (a->x < b->x || (a->x == b->x && a->y < b->y))
      first = k;
  }
  struct map_loop loop = {(uint32_t)map->corner.count, (uint32_t)count, 0};
  struct map_fragment fragment = {trapezoid->span.face,
                                  (uint32_t)map->loop.count, 1};
  for (int i = 0; i < count; i++) {
    int k = kept[(first + i) % count];
    if (!ARRAY_PUSH(&map->corner, corner[k]) ||
        !add_trapezoid_side(trapezoids, trapezoid, k, &corner[k]))
      return false;
  }
  return ARRAY_PUSH(&map->loop, loop) && ARRAY_PUSH(&map->fragment, fragment);
}

bool trapezoids_finish(struct trapezoids *trapezoids, struct map *map) {
  bool ok = end_line(trapezoids);
  size_t count = trapezoids->trapezoid.count;
  struct sort_key *key = mem_alloc(2 * count, sizeof *key);
  ok = ok && key != NULL;
  for (size_t i = 0; ok && i < count; i++)
    key[i] =
        (struct sort_key){trapezoids->trapezoid.item[i].span.face, (uint32_t)i};
  if (ok)
    sort_keys(key, key + count, count);
  for (size_t i = 0; ok && i < count; i++) {
    const struct trapezoid *trapezoid =
        &trapezoids->trapezoid.item[key[i].value];
    struct map_corner corner[4];
    make_corners(trapezoids, trapezoid, corner);
    ok = store_trapezoid_loop(trapezoids, trapezoid, corner, map);
  }
  ok = ok &&
       planar_subdivision_store(&trapezoids->lines, trapezoids->sheet, map);
  mem_free(key);
  return ok;
}
