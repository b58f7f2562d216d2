/* sidelabel.c - what a fragment's side is: a question of the sheet alone. */
#include "visibility/sidelabel.h"

#include <math.h>

/* A stretch of the boundary, low before high in (x, y). */
struct stretch {
  const struct geom_line *line;
  const struct geom_corner *low, *high;
};

static struct page_box box_of(const struct stretch *s) {
  return (struct page_box){(int32_t)floor(fmin(s->low->x, s->high->x)) - 1,
                           (int32_t)floor(fmin(s->low->y, s->high->y)) - 1,
                           (int32_t)ceil(fmax(s->low->x, s->high->x)) + 1,
                           (int32_t)ceil(fmax(s->low->y, s->high->y)) + 1};
}

/* Do side a-b of a triangle and the stretch share more than a point?  Then
 * from and to are the ends of what they share. */
static bool runs_along(struct geom_point a, struct geom_point b,
                       const struct stretch *s, struct geom_corner *from,
                       struct geom_corner *to) {
  struct geom_corner ca = geom_corner_at(a), cb = geom_corner_at(b);
  if (a.x == b.x && a.y == b.y) return false;
  if (geom_line_side(s->line, &ca) != 0 || geom_line_side(s->line, &cb) != 0)
    return false;
  if (geom_corner_compare(&ca, &cb) > 0) {
    struct geom_corner swap = ca;
    ca = cb;
    cb = swap;
  }
  *from = geom_corner_compare(&ca, s->low) > 0 ? ca : *s->low;
  *to = geom_corner_compare(&cb, s->high) < 0 ? cb : *s->high;
  return geom_corner_compare(from, to) < 0;
}

/* The lowest edge of a triangle along the stretch, if below `best`. */
static uint32_t edge_along(const struct sheet *sheet, uint32_t triangle,
                           const struct stretch *s, uint32_t best,
                           struct geom_corner *from, struct geom_corner *to) {
  const struct sheet_triangle *t = &sheet->triangle.item[triangle];
  for (int k = 0; k < 3; k++)
    if (t->side[k] < best &&
        runs_along(sheet->point.item[t->point[k]],
                   sheet->point.item[t->point[k == 2 ? 0 : k + 1]], s, from,
                   to))
      best = t->side[k];
  return best;
}

/* Is g nearer than f somewhere from `from` to `to`? */
static bool is_nearer(const struct sheet *sheet, uint32_t f, uint32_t g,
                      const struct geom_corner *from,
                      const struct geom_corner *to) {
  struct triangle_plane tf = triangle_plane_of(sheet, f),
                        tg = triangle_plane_of(sheet, g);
  struct geom_line line;
  int parallel;
  if (triangles_touch(sheet, f, g)) return g < f;
  parallel = geom_line_between(&line, &tg.plane, &tf.plane);
  if (parallel == GEOM_SAME_PLANE) return g < f;
  if (parallel != 0) return parallel > 0;
  return geom_line_side(&line, from) > 0 || geom_line_side(&line, to) > 0;
}

/* Do the planes of f and g cross along the stretch? */
static bool crosses_along(const struct sheet *sheet, uint32_t f, uint32_t g,
                          const struct stretch *s) {
  struct triangle_plane tf = triangle_plane_of(sheet, f),
                        tg = triangle_plane_of(sheet, g);
  struct geom_line line, back;
  if (triangle_nearness(&tf, f, &tg, g, &line, &back) != NEARER_BEYOND)
    return false;
  return geom_line_side(&line, s->low) == 0 &&
         geom_line_side(&line, s->high) == 0;
}

static bool is_candidate(const struct sheet *sheet, uint32_t g, uint32_t face,
                         struct page_box box) {
  return sheet->triangle.item[g].face != face &&
         !(sheet->triangle_flags[g] & SHEET_FLAT) &&
         !page_boxes_apart(box, page_box_of_triangle(sheet, g));
}

bool side_label(const struct sheet *sheet, const struct pagegrid *grid,
                struct pagegrid_query *query, const uint32_t *own,
                size_t count, const struct geom_line *line,
                const struct geom_corner *p, const struct geom_corner *q,
                uint8_t *side, uint32_t *id) {
  bool forward = geom_corner_compare(p, q) < 0;
  struct stretch s = {line, forward ? p : q, forward ? q : p};
  struct page_box box = box_of(&s);
  uint32_t face = sheet->triangle.item[own[0]].face;
  struct geom_corner from, to;
  *side = MAP_SIDE_EDGE;
  *id = SHEET_NONE;
  for (size_t i = 0; i < count; i++)
    *id = edge_along(sheet, own[i], &s, *id, &from, &to);
  if (*id != SHEET_NONE) return true;
  if (!pagegrid_find(grid, box, query)) return false;
  *side = MAP_SIDE_OUTLINE;
  for (size_t i = 0; i < query->found.count; i++) {
    uint32_t g = query->found.item[i], edge;
    if (!is_candidate(sheet, g, face, box)) continue;
    edge = edge_along(sheet, g, &s, *id, &from, &to);
    if (edge < *id && is_nearer(sheet, own[0], g, &from, &to)) *id = edge;
  }
  if (*id != SHEET_NONE) return true;
  *side = MAP_SIDE_INTERSECTION;
  for (size_t i = 0; i < query->found.count; i++) {
    uint32_t g = query->found.item[i];
    if (is_candidate(sheet, g, face, box) &&
        sheet->triangle.item[g].face < *id &&
        crosses_along(sheet, own[0], g, &s))
      *id = sheet->triangle.item[g].face;
  }
  if (*id == SHEET_NONE) *side = MAP_SIDE_CUT;
  return true;
}
