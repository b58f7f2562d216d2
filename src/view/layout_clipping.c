/* layout_clipping.c - clips a triangle of a face and adds what is left. */
#include "view/layout_clipping.h"

#include <math.h>
#include <stdlib.h>

#include "base/tolerance.h"

recto_status layout_diagonal_cut(struct layout *layout,
                                 struct layout_diagonal *diagonal,
                                 struct layout_cut *cut) {
  if (diagonal->cut != SHEET_NONE) {
    *cut = layout->cut.item[diagonal->cut];
    return RECTO_OK;
  }
  recto_status status =
      layout_segment(layout, diagonal->from, diagonal->to, cut);
  if (status != RECTO_OK)
    return status;
  diagonal->cut = (uint32_t)layout->cut.count;
  return ARRAY_PUSH(&layout->cut, *cut) ? RECTO_OK
                                        : error_memory(layout->error);
}

/* The cut of a side of a triangle, in the side's canonical direction. */
static recto_status cut_side(struct layout *layout,
                             const struct layout_triangle *triangle, int k,
                             struct layout_cut *cut) {
  if (triangle->side[k] != SHEET_NONE)
    return layout_edge_cut(layout, triangle->side[k], cut);
  return layout_diagonal_cut(
      layout, &layout->diagonal.item[triangle->diagonal[k]], cut);
}

/* Finds the sheet point of corner i of a clipped triangle.  It is
 *   the triangle's own corner,
 *   the end of the cut of the side that starts or ends there, or
 *   a new point, where two clipping planes cross inside the triangle. */
static recto_status find_clipped_corner(struct layout *layout,
                                        const struct layout_triangle *triangle,
                                        const struct clip_polygon *polygon,
                                        int i, uint32_t *point) {
  const struct clip_corner *corner = &polygon->corner[i];
  *point = SHEET_NONE;
  if (corner->origin != CLIP_CUT) {
    *point = layout->point_map[triangle->point[corner->origin]];
    return RECTO_OK;
  }
  int reached = polygon->corner[i > 0 ? i - 1 : polygon->count - 1].side;
  bool leaves = corner->side != CLIP_CUT;
  int side = leaves ? corner->side : reached;
  if (side != CLIP_CUT) {
    struct layout_cut cut;
    recto_status status = cut_side(layout, triangle, side, &cut);
    if (status != RECTO_OK)
      return status;
    *point = cut.point[leaves != triangle->forward[side]];
  }
  /* A side of which a single point is left has no cut: a new point. */
  return *point == SHEET_NONE ? layout_new_point(layout, corner->at, point)
                              : RECTO_OK;
}

static uint32_t edge_of(const struct layout *layout,
                        const struct layout_triangle *triangle,
                        const struct clip_polygon *polygon, int i) {
  int side = polygon->corner[i].side;
  return side == CLIP_CUT ? SHEET_NONE : layout_side_id(layout, triangle, side);
}

/* Adds a clipped triangle as a fan.  Where rounding to the grid turned a
 * sliver of it over or made it flat, that triangle's sides are contours.
 * sign  set to the sign of the whole area on the page, in the face's winding */
static recto_status add_clipped_fan(struct layout *layout,
                                    const struct layout_triangle *triangle,
                                    const struct clip_polygon *polygon,
                                    const uint32_t *point, int *sign) {
  int64_t area[CLIP_CORNERS_MAX] = {0};
  int128 whole = 0;
  if (!layout_reserve(layout, CLIP_CORNERS_MAX))
    return error_memory(layout->error);
  for (int i = 1; i + 1 < polygon->count; i++) {
    bool last = i + 2 == polygon->count;
    const uint32_t corner[3] = {point[0], point[i], point[i + 1]};
    const uint32_t side[3] = {
        i == 1 ? edge_of(layout, triangle, polygon, 0) : SHEET_NONE,
        edge_of(layout, triangle, polygon, i),
        last ? edge_of(layout, triangle, polygon, i + 1) : SHEET_NONE};
    area[i] = layout_add_triangle(layout, triangle->face, corner, side);
    whole += area[i];
  }
  *sign = geom_sign128(whole);
  recto_status status = RECTO_OK;
  for (int i = 1; status == RECTO_OK && i + 1 < polygon->count; i++) {
    const uint32_t corner[4] = {point[0], point[i], point[i + 1], point[0]};
    bool odd = area[i] == 0 || geom_sign64(area[i]) != *sign;
    for (int k = 0; odd && status == RECTO_OK && k < 3; k++)
      status = layout_contour(layout, corner[k], corner[k + 1]);
  }
  return status;
}

/* Whether all points are on one border line: what is left of the triangle lies
 * in the half unit by which clipping enlarges the printable area. */
static bool is_all_on_border(const struct layout *layout, const uint32_t *point,
                             int count) {
  const struct geom_point *at = layout->sheet->point.item;
  for (int axis = 0; axis < 2; axis++) {
    int32_t first = axis ? at[point[0]].y : at[point[0]].x;
    bool all = abs(first) == layout->projection.half[axis];
    for (int i = 1; i < count; i++)
      all = all && (axis ? at[point[i]].y : at[point[i]].x) == first;
    if (all)
      return true;
  }
  return false;
}

/* Leaves out corners that came to the point of the next one. */
static void drop_repeats(struct clip_polygon *polygon, uint32_t *point) {
  uint32_t first = point[0];
  int kept = 0;
  for (int i = 0; i < polygon->count; i++) {
    if (point[i] == (i + 1 < polygon->count ? point[i + 1] : first))
      continue;
    point[kept] = point[i];
    polygon->corner[kept++] = polygon->corner[i];
  }
  polygon->count = kept;
}

/* The orientation of a triangle on the page, in its own winding, before
 * clipping and rounding; 0: seen edge-on, within the rounding of view
 * coordinates. */
static int view_sign(const struct layout *layout,
                     const struct view_point corner[3]) {
  double volume = 0, most = 0;
  for (int k = 0; k < 3; k++) {
    const struct view_point *a = &corner[k], *b = &corner[geom_next_corner(k)];
    double area = a->x * b->y - a->y * b->x;
    double depth = layout->projection.perspective
                       ? corner[geom_next_corner(geom_next_corner(k))].d
                       : 1;
    volume += area * depth;
    most += (fabs(a->x * b->y) + fabs(a->y * b->x)) * fabs(depth);
  }
  if (fabs(volume) <= most * TOLERANCE_EXTENT_SHARE)
    return 0;
  return volume > 0 ? 1 : -1;
}

/* Adds what is left of a triangle and records on which side of its edges it
 * lies. Sides that the near plane made are contours. */
static recto_status add_polygon(struct layout *layout,
                                const struct layout_triangle *triangle,
                                const struct view_point corner[3],
                                struct clip_polygon *polygon) {
  uint32_t point[CLIP_CORNERS_MAX];
  for (int i = 0; i < polygon->count; i++) {
    recto_status status =
        find_clipped_corner(layout, triangle, polygon, i, &point[i]);
    if (status != RECTO_OK)
      return status;
  }
  drop_repeats(polygon, point);
  if (polygon->count < 3 || is_all_on_border(layout, point, polygon->count))
    return RECTO_OK;
  int sign = 0;
  recto_status status =
      add_clipped_fan(layout, triangle, polygon, point, &sign);
  /* Where a strip is left so thin that rounding made it flat, as at the near
   * plane, the triangle still lies on its side of the edge. */
  if (sign == 0)
    sign = view_sign(layout, corner);
  for (int i = 0; status == RECTO_OK && i < polygon->count; i++) {
    const uint32_t end[2] = {point[i],
                             point[i + 1 < polygon->count ? i + 1 : 0]};
    if (polygon->corner[i].side != CLIP_CUT)
      layout_record_triangle_side(layout, triangle, polygon->corner[i].side,
                                  sign);
    else if (!is_all_on_border(layout, end, 2))
      status = layout_contour(layout, end[0], end[1]);
  }
  return status;
}

recto_status layout_add_clipped(struct layout *layout,
                                const struct layout_triangle *triangle) {
  struct view_point corner[3];
  unsigned any = 0, all = ~0u;
  for (int k = 0; k < 3; k++) {
    corner[k] = layout_view(layout, triangle->point[k]);
    any |= layout->outcode[triangle->point[k]];
    all &= layout->outcode[triangle->point[k]];
  }
  if (all)
    return RECTO_OK;
  if (!any) {
    if (!layout_reserve(layout, 1))
      return error_memory(layout->error);
    layout_record_triangle_sides(layout, triangle,
                                 layout_add_whole(layout, triangle));
    return RECTO_OK;
  }
  struct clip_polygon polygon;
  if (!clip_triangle(&layout->projection, corner, triangle->forward, &polygon))
    return RECTO_OK;
  return add_polygon(layout, triangle, corner, &polygon);
}
