/* border_sides.c - finds whether an edge is a face's, also where more than two
 * have it. */
#include "visibility/fit/border_sides.h"

#include <math.h>

#include "geom/vector.h"
#include "visibility/zero_set/zero_segments.h"

bool has_more_faces(const struct sheet_edge *edge) {
  return edge->edge_class == RECTO_EDGE_BORDER &&
         edge->triangle[1] != SHEET_NONE;
}

static bool has_point(const struct sheet_triangle *t, uint32_t point) {
  return t->point[0] == point || t->point[1] == point || t->point[2] == point;
}

bool is_side_of_face(const struct sheet *sheet, const struct sheet_edge *edge,
                     uint32_t face) {
  const struct sheet_triangle *all = sheet->triangle.item;
  for (int k = 0; k < 2; k++)
    if (edge->triangle[k] != SHEET_NONE && all[edge->triangle[k]].face == face)
      return true;
  if (!has_more_faces(edge))
    return false;
  for (size_t t = first_triangle_of_face(sheet, face);
       t < sheet->triangle.count && all[t].face == face; t++)
    if (has_point(&all[t], edge->point[0]) &&
        has_point(&all[t], edge->point[1]))
      return true;
  return false;
}

double diameter_of_triangle(const struct sheet *sheet, uint32_t triangle) {
  struct geom_triangle t = sheet_corners(sheet, triangle);
  double most = 0;
  for (int k = 0; k < 3; k++) {
    struct geom_point p = t.p[k], q = t.p[geom_next_corner(k)];
    most = fmax(most, vector2_length((double)q.x - p.x, (double)q.y - p.y));
  }
  return most;
}
