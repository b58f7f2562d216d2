/* strokes.c - from what triangles hide of an edge to its visible intervals. */
#include "visibility/strokes.h"

#include <string.h>

#include "base/sort.h"

static const struct ratio ZERO = {0, 1}, ONE = {1, 1};

void strokes_fini(struct strokes *strokes) {
  ARRAY_FREE(&strokes->part);
  ARRAY_FREE(&strokes->left);
  ARRAY_FREE(&strokes->right);
}

bool strokes_hide(struct strokes *strokes, struct hidden_part part) {
  if (part.sides == HIDE_BOTH && part.from.num == 0 &&
      part.to.num == part.to.den)
    strokes->whole = true;
  return ARRAY_PUSH(&strokes->part, part);
}

bool strokes_open_map(struct map *map, size_t edge_count) {
  uint8_t *state = mem_resize(map->edge_state, edge_count, 1);
  if (state == NULL) return false;
  memset(state + map->edge_count, MAP_HIDDEN, edge_count - map->edge_count);
  map->edge_state = state;
  map->edge_count = edge_count;
  return true;
}

static int compare_from(const void *a, const void *b, void *user) {
  const struct hidden_part *p = a, *q = b;
  (void)user;
  return ratio_compare(p->from, q->from);
}

/* The union of the parts that cover `side`, in order and apart. */
static bool unite(const stroke_parts *part, int side, stroke_parts *united) {
  united->count = 0;
  for (size_t i = 0; i < part->count; i++)
    if ((part->item[i].sides & side) && !ARRAY_PUSH(united, part->item[i]))
      return false;
  if (united->count > 1) {
    size_t last = 0;
    if (!sort_stable(united->item, united->count, sizeof *united->item,
                     compare_from, NULL))
      return false;
    for (size_t i = 1; i < united->count; i++) {
      struct hidden_part *p = &united->item[last], q = united->item[i];
      if (ratio_compare(q.from, p->to) > 0)
        united->item[++last] = q;
      else if (ratio_compare(p->to, q.to) < 0)
        p->to = q.to;
    }
    united->count = last + 1;
  }
  return true;
}

/* common = left and right, all three in order and apart. */
static bool intersect(const stroke_parts *left, const stroke_parts *right,
                      stroke_parts *common) {
  size_t i = 0, j = 0;
  common->count = 0;
  while (i < left->count && j < right->count) {
    struct hidden_part p = left->item[i], q = right->item[j];
    struct hidden_part both = {
        ratio_compare(p.from, q.from) > 0 ? p.from : q.from,
        ratio_compare(p.to, q.to) < 0 ? p.to : q.to, HIDE_BOTH};
    if (ratio_compare(both.from, both.to) < 0 && !ARRAY_PUSH(common, both))
      return false;
    if (ratio_compare(p.to, q.to) < 0)
      i++;
    else
      j++;
  }
  return true;
}

/* The complement of the hidden parts in [0, 1] goes to the map. */
static bool file_visible(const stroke_parts *hidden, uint32_t edge,
                         struct map *map) {
  struct map_mixed mixed = {edge, (uint32_t)map->interval.count, 0};
  struct ratio from = ZERO;
  for (size_t i = 0; i <= hidden->count; i++) {
    struct ratio to = i < hidden->count ? hidden->item[i].from : ONE;
    if (ratio_compare(from, to) < 0) {
      struct map_interval visible = {from, to};
      if (!ARRAY_PUSH(&map->interval, visible)) return false;
      mixed.count++;
    }
    if (i < hidden->count) from = hidden->item[i].to;
  }
  map->edge_state[edge] = mixed.count > 0 ? MAP_MIXED : MAP_HIDDEN;
  return mixed.count == 0 || ARRAY_PUSH(&map->mixed, mixed);
}

bool strokes_file(struct strokes *strokes, uint32_t edge, struct map *map) {
  const stroke_parts *part = &strokes->part;
  bool one_sided = false;
  map->edge_state[edge] = MAP_HIDDEN;
  if (strokes->whole) return true;
  for (size_t i = 0; i < part->count; i++)
    one_sided |= part->item[i].sides != HIDE_BOTH;
  if (!unite(part, HIDE_LEFT, &strokes->left)) return false;
  if (one_sided) {
    stroke_parts swap;
    if (!unite(part, HIDE_RIGHT, &strokes->right) ||
        !intersect(&strokes->left, &strokes->right, &strokes->part))
      return false;
    swap = strokes->left;
    strokes->left = strokes->part;
    strokes->part = swap;
  }
  if (strokes->left.count == 0) {
    map->edge_state[edge] = MAP_VISIBLE;
    return true;
  }
  return file_visible(&strokes->left, edge, map);
}
