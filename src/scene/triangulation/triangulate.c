/* triangulate.c - triangulates a polygon in space: triangles and quadrilaterals
 * at once, others by ear clipping. */
#include "scene/triangulation/triangulate.h"

#include "base/tolerance.h"
#include "scene/triangulation/ear_clipping.h"
#include "scene/triangulation/polygon.h"

void triangulation_fini(struct triangulation *triangulation) {
  ARRAY_FREE(&triangulation->triangle);
  ARRAY_FREE(&triangulation->corner);
  ARRAY_FREE(&triangulation->queue);
  ARRAY_FREE(&triangulation->same);
  reflex_tree_fini(&triangulation->tree);
}

static bool has_repeats(const struct polygon *polygon) {
  for (uint32_t c = 0; c < polygon->count; c++)
    for (uint32_t d = 0; d < c; d++)
      if (polygon_compare(polygon, c, d) == 0)
        return true;
  return false;
}

/* Whether the diagonal from corner 0 is the shorter one; of two equally long
 * ones, the one that starts at the first corner in the order of x, y, z. */
static bool is_shorter_from_0(const struct polygon *polygon) {
  double from_0 = polygon_distance(polygon, 0, 2);
  double from_1 = polygon_distance(polygon, 1, 3);
  if (from_0 != from_1)
    return from_0 < from_1;
  uint32_t first = 0;
  for (uint32_t c = 1; c < 4; c++)
    if (polygon_compare(polygon, c, first) < 0)
      first = c;
  return first % 2 == 0;
}

/* By the rule of ear_clipping.c a quadrilateral is cut along the shorter of the
 * diagonals inside.  Cuts it by a diagonal that leaves area on both its sides;
 * false where there is none. */
static bool cut_quadrilateral(struct triangulation *triangulation,
                              const struct polygon *polygon) {
  const struct triangulation_corner *corner = triangulation->corner.item;
  bool from_0 = triangulation_turn(corner, 0, 1, 2) > 0 &&
                triangulation_turn(corner, 2, 3, 0) > 0;
  bool from_1 = triangulation_turn(corner, 3, 0, 1) > 0 &&
                triangulation_turn(corner, 1, 2, 3) > 0;
  if (!from_0 && !from_1)
    return false;
  if (from_0 && from_1)
    from_0 = is_shorter_from_0(polygon);
  if (from_0) {
    triangulation_add(triangulation, 0, 1, 2, 0, 1, 4);
    triangulation_add(triangulation, 0, 2, 3, 4, 2, 3);
  } else {
    triangulation_add(triangulation, 0, 1, 3, 0, 4, 3);
    triangulation_add(triangulation, 1, 2, 3, 1, 2, 4);
  }
  return true;
}

bool triangulate(struct triangulation *triangulation,
                 const struct scene_point *point, const uint32_t *corner,
                 size_t count) {
  const struct polygon polygon = {point, corner, (uint32_t)count};
  triangulation->triangle.count = 0;
  triangulation->off_plane = 0;
  triangulation->warped = false;
  if (!ARRAY_RESERVE(&triangulation->triangle, count - 2) ||
      !ARRAY_RESERVE(&triangulation->corner, count))
    return false;
  if (count == 3) {
    if (!has_repeats(&polygon))
      triangulation_add(triangulation, 0, 1, 2, 0, 1, 2);
    return true;
  }
  struct polygon_areas areas = polygon_measure(&polygon);
  triangulation->off_plane = polygon_off_plane(&polygon, &areas);
  triangulation->warped =
      triangulation->off_plane > areas.extent * TOLERANCE_WARP_SHARE;
  polygon_project(&polygon, &areas, triangulation->corner.item,
                  sizeof *triangulation->corner.item);
  return (count == 4 && !has_repeats(&polygon) &&
          cut_quadrilateral(triangulation, &polygon)) ||
         ear_clipping(triangulation, &polygon);
}
