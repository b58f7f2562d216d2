/* triangle_pair.c - how two triangles lie to each other: disjoint on the page,
 * in contact, or one nearer than the other. */
#include "visibility/predicate/triangle_pair.h"

#include "visibility/predicate/occlusion.h"

struct triangle_plane triangle_plane_of(const struct sheet *sheet,
                                        uint32_t triangle) {
  struct triangle_plane t;
  for (int k = 0; k < 3; k++)
    t.p[k] = sheet->point.item[sheet->triangle.item[triangle].point[k]];
  t.plane = geom_plane_of(t.p[0], t.p[1], t.p[2]);
  return t;
}

/* Does a side of f separate the two: is all of g on its right, or on it? */
static bool is_separated_by_side(const struct geom_point f[3],
                                 const struct geom_point g[3]) {
  for (int k = 0; k < 3; k++) {
    struct geom_point a = f[k], b = f[geom_next_corner(k)];
    if (geom_orient2d(a, b, g[0]) <= 0 && geom_orient2d(a, b, g[1]) <= 0 &&
        geom_orient2d(a, b, g[2]) <= 0)
      return true;
  }
  return false;
}

/* The separating axis theorem: two convex polygons with disjoint interiors are
 * separated by a side of one of them. */
bool triangle_corners_disjoint(const struct geom_point f[3],
                               const struct geom_point g[3]) {
  return is_separated_by_side(f, g) || is_separated_by_side(g, f);
}

bool triangle_may_meet_segment(const struct geom_point f[3],
                               struct geom_point p, struct geom_point q) {
  int64_t a = geom_orient2d(p, q, f[0]), b = geom_orient2d(p, q, f[1]),
          c = geom_orient2d(p, q, f[2]);
  if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0))
    return false;
  for (int k = 0; k < 3; k++) {
    struct geom_point from = f[k], to = f[geom_next_corner(k)];
    if (geom_orient2d(from, to, p) <= 0 && geom_orient2d(from, to, q) <= 0)
      return false;
  }
  return true;
}

bool triangles_disjoint(const struct sheet *sheet, uint32_t f, uint32_t g) {
  struct geom_triangle p = sheet_corners(sheet, f), q = sheet_corners(sheet, g);
  return triangle_corners_disjoint(p.p, q.p);
}

void triangle_lines(const struct sheet *sheet, uint32_t triangle,
                    struct geom_line line[3], struct geom_line reversed[3]) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  for (int k = 0; k < 3; k++) {
    geom_line_through(&line[k], sheet->point.item[p[k]],
                      sheet->point.item[p[geom_next_corner(k)]]);
    reversed[k] = geom_line_reversed(&line[k]);
  }
}

bool triangle_as_convex(const struct sheet *sheet, uint32_t triangle,
                        struct geom_convex *piece, struct arena *arena) {
  struct geom_line *line = arena_alloc(arena, 6, sizeof *line);
  if (line == NULL)
    return false;
  triangle_lines(sheet, triangle, line, line + 3);
  return geom_convex_triangle(piece, sheet_corners(sheet, triangle).p, line,
                              arena);
}

int plane_sides(const struct geom_plane *plane, const struct geom_point p[3]) {
  int sides = 0;
  for (int k = 0; k < 3; k++) {
    int sign = geom_sign128(geom_plane_value(plane, p[k]));
    if (sign != 0)
      sides |= sign < 0 ? PLANE_BEHIND : PLANE_IN_FRONT;
  }
  return sides;
}

enum depth_order triangle_depth_order(const struct triangle_plane *f,
                                      uint32_t f_id,
                                      const struct triangle_plane *g,
                                      uint32_t g_id, struct geom_line *line,
                                      struct geom_line *reversed) {
  int sides = plane_sides(&f->plane, g->p);
  if (sides == 0)
    return g_id < f_id ? NEARER_ALWAYS : NEARER_NEVER;
  if (sides == PLANE_BEHIND)
    return NEARER_NEVER;
  if (sides == PLANE_IN_FRONT)
    return NEARER_ALWAYS;
  sides = plane_sides(&g->plane, f->p);
  if (sides == PLANE_BEHIND)
    return NEARER_ALWAYS;
  if (sides == PLANE_IN_FRONT)
    return NEARER_NEVER;
  /* Each has corners on both sides of the other's plane: the planes
   * intersect. */
  (void)geom_line_between(line, &g->plane, &f->plane);
  *reversed = geom_line_reversed(line);
  return NEARER_ON_LEFT;
}

/* Are all three corners in contact with the plane? */
static bool touches(const struct occluder *plane,
                    const struct geom_point p[3]) {
  for (int k = 0; k < 3; k++)
    if (occluder_side(plane, p[k]) != 0)
      return false;
  return true;
}

bool triangles_touch(const struct sheet *sheet, uint32_t f, uint32_t g) {
  struct occluder hf, hg;
  occluder_init(&hf, sheet, f);
  occluder_init(&hg, sheet, g);
  return touches(&hf, hg.p) || touches(&hg, hf.p);
}
