/* occluders.c - tests the triangles that a grid lists at a point. */
#include "visibility/contour/occluders.h"

int occluders_count(const struct sheet *sheet, const struct triangle_grid *grid,
                    struct triangle_grid_query *query, struct geom_point p) {
  int count = 0;
  struct triangle_span found;
  if (!triangle_grid_find_at(grid, p, query, &found))
    return -1;
  for (size_t i = 0; i < found.count; i++) {
    uint32_t t = found.item[i];
    struct geom_triangle of = sheet_corners(sheet, t);
    bool inside = !sheet_is_edge_on(sheet, t);
    for (int k = 0; inside && k < 3; k++)
      inside = geom_orient2d(of.p[k], of.p[geom_next_corner(k)], p) > 0;
    if (!inside)
      continue;
    struct geom_plane plane = geom_plane_of(of.p[0], of.p[1], of.p[2]);
    count += geom_plane_value(&plane, p) < 0;
  }
  return count;
}
