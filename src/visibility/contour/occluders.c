/* occluders.c - tests the triangles that a grid lists at a point. */
#include "visibility/contour/occluders.h"

static bool hides(const struct sheet *sheet, uint32_t t, struct geom_point p) {
  struct geom_triangle of = sheet_corners(sheet, t);
  bool inside = !sheet_is_edge_on(sheet, t);
  for (int k = 0; inside && k < 3; k++)
    inside = geom_orient2d(of.p[k], of.p[geom_next_corner(k)], p) > 0;
  if (!inside)
    return false;
  struct geom_plane plane = geom_plane_of(of.p[0], of.p[1], of.p[2]);
  return geom_plane_value(&plane, p) < 0;
}

int occluders_count(const struct sheet *sheet, const struct triangle_grid *grid,
                    struct triangle_grid_query *query, struct geom_point p) {
  int count = 0;
  struct triangle_span found;
  if (!triangle_grid_find_at(grid, p, query, &found))
    return -1;
  for (size_t i = 0; i < found.count; i++)
    count += hides(sheet, found.item[i], p);
  return count;
}

int occluders_count_apart(struct occluders *o, struct geom_point p,
                          uint32_t face) {
  int count = 0;
  struct triangle_span found;
  if (!triangle_grid_find_at(o->grid, p, o->query, &found))
    return -1;
  for (size_t i = 0; i < found.count; i++) {
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
