/* occluders.c - tests the triangles that a grid lists at a point. */
#include "visibility/contour/occluders.h"

/* Whether the plane of a triangle hides a point, which it lies over. */
static bool is_plane_before(const struct sheet *sheet, uint32_t t,
                            struct geom_point p) {
  struct geom_triangle of = sheet_corners(sheet, t);
  struct geom_plane plane = geom_plane_of(of.p[0], of.p[1], of.p[2]);
  return !sheet_is_edge_on(sheet, t) && geom_plane_value(&plane, p) < 0;
}

/* Inline, as most triangles are told by their first sides. */
static inline bool hides(const struct sheet *sheet, uint32_t t,
                         struct geom_point p) {
  const uint32_t *corner = sheet->triangle.item[t].point;
  const struct geom_point *a = &sheet->point.item[corner[0]];
  const struct geom_point *b = &sheet->point.item[corner[1]];
  const struct geom_point *c = &sheet->point.item[corner[2]];
  return geom_orient2d(*a, *b, p) > 0 && geom_orient2d(*b, *c, p) > 0 &&
         geom_orient2d(*c, *a, p) > 0 && is_plane_before(sheet, t, p);
}

int occluders_count(const struct sheet *sheet, const struct triangle_grid *grid,
                    struct triangle_grid_query *query, struct geom_point p,
                    int most) {
  int count = 0;
  struct triangle_span found;
  /* Points that are asked for one after the other lie near each other. */
  if (most == 1 && query->last != SHEET_NONE && hides(sheet, query->last, p))
    return 1;
  if (!triangle_grid_find_at(grid, p, query, &found))
    return -1;
  for (size_t i = 0; i < found.count && count < most; i++)
    if (hides(sheet, found.item[i], p)) {
      query->last = found.item[i];
      count++;
    }
  return count;
}

int occluders_count_apart(struct occluders *o, struct geom_point p,
                          uint32_t face) {
  int count = 0;
  struct triangle_span found;
  if (!triangle_grid_find_at(o->grid, p, o->query, &found))
    return -1;
  for (size_t i = 0; i < found.count && count < o->most; i++) {
    uint32_t t = found.item[i];
    bool is_near = true;
    if (hides(o->sheet, t, p) &&
        !near_faces_find(&o->near, face, o->sheet->triangle.item[t].face,
                         &is_near))
      return -1;
    count += !is_near;
  }
  return count;
}
