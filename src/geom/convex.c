/* convex.c - convex pieces of the page, cut by exact lines. */
#include "geom/convex.h"

#include <math.h>
#include <string.h>

/* Corners' doubles are within 1/4 of the truth (line.c). */
#define BOX_MARGIN 0.25

static bool allocate_corners(struct geom_convex *piece, uint32_t count,
                             struct arena *arena) {
  piece->count = 0;
  piece->corner = arena_alloc(arena, count, sizeof *piece->corner);
  piece->side = arena_alloc(arena, count, sizeof *piece->side);
  return piece->corner != NULL && piece->side != NULL;
}

static void append_corner(struct geom_convex *piece, struct geom_corner corner,
                          const struct geom_line *side) {
  piece->corner[piece->count] = corner;
  piece->side[piece->count++] = side;
}

static void set_box(struct geom_convex *piece) {
  piece->x0 = piece->y0 = INFINITY;
  piece->x1 = piece->y1 = -INFINITY;
  for (uint32_t k = 0; k < piece->count; k++) {
    const struct geom_corner *c = &piece->corner[k];
    if (c->x < piece->x0)
      piece->x0 = c->x;
    if (c->x > piece->x1)
      piece->x1 = c->x;
    if (c->y < piece->y0)
      piece->y0 = c->y;
    if (c->y > piece->y1)
      piece->y1 = c->y;
  }
  piece->x0 -= BOX_MARGIN;
  piece->y0 -= BOX_MARGIN;
  piece->x1 += BOX_MARGIN;
  piece->y1 += BOX_MARGIN;
}

bool geom_convex_triangle(struct geom_convex *piece,
                          const struct geom_point p[3],
                          const struct geom_line line[3], struct arena *arena) {
  if (!allocate_corners(piece, 3, arena))
    return false;
  for (int k = 0; k < 3; k++)
    append_corner(piece, geom_corner_at(p[k]), &line[k]);
  set_box(piece);
  return true;
}

/* Builds the part of `piece` whose corners have sign `keep` or lie on the
 * line; `cut` is the line with that part on its left. */
static bool clip_to_side(const struct geom_convex *piece,
                         const signed char *sign, int keep,
                         const struct geom_line *cut, struct geom_convex *part,
                         struct arena *arena) {
  uint32_t n = piece->count;
  if (!allocate_corners(part, n + 1, arena))
    return false;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t next = k + 1 == n ? 0 : k + 1;
    int s = sign[k] * keep, t = sign[next] * keep;
    if (s > 0) {
      append_corner(part, piece->corner[k], piece->side[k]);
      if (t < 0)
        append_corner(part, geom_corner_of(piece->side[k], cut), cut);
    } else if (s == 0) {
      /* On the line: the boundary either enters, leaves or touches here. */
      if (t > 0)
        append_corner(part, piece->corner[k], piece->side[k]);
      else if (sign[k == 0 ? n - 1 : k - 1] * keep > 0)
        append_corner(part, piece->corner[k], cut);
    } else if (t > 0) {
      append_corner(part, geom_corner_of(piece->side[k], cut), piece->side[k]);
    }
  }
  set_box(part);
  return true;
}

bool geom_convex_split(const struct geom_convex *piece,
                       const struct geom_line *line,
                       const struct geom_line *reversed,
                       struct geom_convex *inside, struct geom_convex *outside,
                       struct arena *arena) {
  static const struct geom_convex none;
  signed char few[32], *sign = few;
  bool left = false, right = false;
  if (piece->count > sizeof few) {
    sign = arena_alloc(arena, piece->count, 1);
    if (sign == NULL)
      return false;
  }
  for (uint32_t k = 0; k < piece->count; k++) {
    sign[k] = (signed char)geom_line_side(line, &piece->corner[k]);
    left |= sign[k] > 0;
    right |= sign[k] < 0;
  }
  if (inside != NULL)
    *inside = left ? *piece : none;
  if (outside != NULL)
    *outside = left ? none : *piece;
  if (!left || !right)
    return true;
  if (inside != NULL && !clip_to_side(piece, sign, 1, line, inside, arena))
    return false;
  return outside == NULL ||
         clip_to_side(piece, sign, -1, reversed, outside, arena);
}

bool geom_convex_subtract(const struct geom_convex *piece,
                          const struct geom_line *line,
                          const struct geom_line *reversed, int count,
                          geom_pieces *rest, struct geom_convex *inside,
                          struct arena *arena) {
  struct geom_convex part = *piece, few[4], *cut = few;
  if (count > (int)(sizeof few / sizeof *few)) {
    cut = arena_alloc(arena, (size_t)count, sizeof *cut);
    if (cut == NULL)
      return false;
  }
  for (int k = 0; k < count; k++) {
    struct geom_convex left;
    if (!geom_convex_split(&part, &line[k], &reversed[k], &left, &cut[k],
                           arena))
      return false;
    part = left;
    if (part.count == 0)
      break;
  }
  if (inside != NULL)
    *inside = part;
  if (part.count == 0)
    return ARRAY_PUSH(rest, *piece);
  for (int k = 0; k < count; k++)
    if (cut[k].count > 0 && !ARRAY_PUSH(rest, cut[k]))
      return false;
  return true;
}

/* ---- Copying ------------------------------------------------------------- */

/* Where a line's copy is: lines of one piece are few. */
struct line_map {
  const struct geom_line **from;
  struct geom_line *to;
  uint32_t count;
};

static uint32_t number_of_line(struct line_map *map,
                               const struct geom_line *line) {
  uint32_t k = 0;
  while (k < map->count && map->from[k] != line)
    k++;
  if (k == map->count)
    map->from[map->count++] = line;
  return k;
}

/* Numbers the lines of a piece. */
static void number_lines(struct line_map *map,
                         const struct geom_convex *piece) {
  for (uint32_t k = 0; k < piece->count; k++) {
    if (piece->corner[k].l1 != NULL) {
      (void)number_of_line(map, piece->corner[k].l1);
      (void)number_of_line(map, piece->corner[k].l2);
    }
    (void)number_of_line(map, piece->side[k]);
  }
}

static const struct geom_line *map_line(struct line_map *map,
                                        const struct geom_line *line) {
  return &map->to[number_of_line(map, line)];
}

/* An upper bound for how many lines a piece names. */
static uint32_t line_bound(const struct geom_convex *piece) {
  uint32_t bound = piece->count;
  for (uint32_t k = 0; k < piece->count; k++)
    if (piece->corner[k].l1 != NULL)
      bound += 2;
  return bound;
}

bool geom_convex_copy(struct geom_convex *to, const struct geom_convex *from,
                      struct arena *arena) {
  uint32_t n = from->count, bound = line_bound(from);
  struct line_map map = {mem_alloc(bound, sizeof *map.from), NULL, 0};
  bool ok = false;
  if (map.from == NULL)
    goto end;
  number_lines(&map, from); /* before there are copies: half the bound */
  map.to = arena_alloc(arena, map.count, sizeof *map.to);
  if (map.to == NULL || !allocate_corners(to, n, arena))
    goto end;
  for (uint32_t k = 0; k < map.count; k++)
    map.to[k] = *map.from[k];
  for (uint32_t k = 0; k < n; k++) {
    struct geom_corner corner = from->corner[k];
    if (corner.l1 != NULL) {
      corner.l1 = map_line(&map, corner.l1);
      corner.l2 = map_line(&map, corner.l2);
    }
    append_corner(to, corner, map_line(&map, from->side[k]));
  }
  to->x0 = from->x0;
  to->y0 = from->y0;
  to->x1 = from->x1;
  to->y1 = from->y1;
  ok = true;
end:
  mem_free(map.from);
  return ok;
}
