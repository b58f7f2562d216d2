/* layout_clipping.c - clips a triangle of a face and adds what is left. */
#include "view/layout_clipping.h"

#include <math.h>
#include <stdlib.h>

#include "base/tolerance.h"

/* What is left of a side of a triangle, in the side's canonical direction. */
static recto_status find_clipped_side(struct layout *layout,
                                      const struct layout_triangle *triangle,
                                      int k, struct layout_clipped *clipped) {
  if (triangle->side[k] != SHEET_NONE)
    return layout_clip_edge(layout, triangle->side[k], clipped);
  struct layout_diagonal *d = &layout->diagonal.item[triangle->diagonal[k]];
  return layout_clip_known(layout, &d->clipped, d->from, d->to, clipped);
}

/* Finds the sheet point of corner i of a clipped triangle.  It is
 *   the triangle's own corner,
 *   the end of what is left of the side that starts or ends there, or
 *   a new point, where two clipping planes cross inside the triangle. */
static recto_status find_clipped_corner(struct layout *layout,
                                        const struct layout_triangle *triangle,
                                        const struct clip_polygon *polygon,
                                        int i, uint32_t *point) {
  const struct clip_corner *corner = &polygon->corner[i];
  *point = SHEET_NONE;
  if (corner->origin != CLIP_CUT) {
    *point = layout_sheet_point(layout, triangle->point[corner->origin]);
    return RECTO_OK;
  }
  int reached = polygon->corner[i > 0 ? i - 1 : polygon->count - 1].side;
  bool leaves = corner->side != CLIP_CUT;
  int side = leaves ? corner->side : reached;
  if (side != CLIP_CUT) {
    struct layout_clipped clipped;
    recto_status status = find_clipped_side(layout, triangle, side, &clipped);
    if (status != RECTO_OK)
      return status;
    *point = clipped.point[leaves != triangle->forward[side]];
  }
  /* A side of which a single point is left is not stored: a new point. */
  return *point == SHEET_NONE ? layout_new_point(layout, corner->at, point)
                              : RECTO_OK;
}

static uint32_t edge_of(const struct layout *layout,
                        const struct layout_triangle *triangle,
                        const struct clip_polygon *polygon, int i) {
  int side = polygon->corner[i].side;
  return side == CLIP_CUT ? SHEET_NONE : layout_side_id(layout, triangle, side);
}

/* What clipping left of a triangle, while ears are cut off it. */
struct clipped_ring {
  uint32_t point[CLIP_CORNERS_MAX]; /* of the sheet */
  uint32_t side[CLIP_CORNERS_MAX];  /* that starts there, as of edge_of */
  int count;
  bool narrow; /* as of is_narrow */
};

/* Whether rounding may decide on which side of a diagonal a corner is: the face
 * is seen edge-on. */
static bool is_narrow(const struct layout *layout,
                      const struct clipped_ring *ring) {
  const struct geom_point *at = layout->sheet->point.item;
  struct geom_point first = at[ring->point[0]];
  int128 twice = 0, longest = 0; /* the area, the diagonal's square */
  for (int i = 1; i < ring->count; i++) {
    struct geom_point p = at[ring->point[i]];
    int64_t x = (int64_t)p.x - first.x, y = (int64_t)p.y - first.y;
    int128 square = (int128)x * x + (int128)y * y;
    longest = square > longest ? square : longest;
    if (i + 1 < ring->count)
      twice += geom_orient2d(first, p, at[ring->point[i + 1]]);
  }
  double height = sqrt((double)longest) * TOLERANCE_CONTACT_GRID_UNITS;
  return fabs((double)twice) <= height;
}

/* The corner that is cut off by the shortest diagonal on the page, the first of
 * equal ones.  So a side that is a few grid units long shares its triangle with
 * a short diagonal, and the long sides' triangles are no slivers, whose planes
 * would be decided by rounding.  Of a face that is seen edge-on all are
 * slivers: then a fan is cut about the farthest corner.  The depths of each of
 * its triangles differ much, so that rounding explains what seems to be
 * behind. */
static int find_ear(const struct layout *layout,
                    const struct clipped_ring *ring) {
  const struct geom_point *at = layout->sheet->point.item;
  int n = ring->count, ear = 1, farthest = 0;
  int64_t least = INT64_MAX;
  for (int i = 0; n > 3 && i < n; i++) {
    struct geom_point a = at[ring->point[(i + n - 1) % n]],
                      b = at[ring->point[(i + 1) % n]];
    int64_t x = (int64_t)b.x - a.x, y = (int64_t)b.y - a.y;
    if (x * x + y * y < least) {
      least = x * x + y * y;
      ear = i;
    }
    if (at[ring->point[i]].z < at[ring->point[farthest]].z)
      farthest = i;
  }
  return ring->narrow ? (farthest + 1) % n : ear;
}

/* Adds the triangle of a corner and its neighbours, and removes the corner.
 * corner  gets the triangle's
 * Returns its area on the page. */
static int64_t cut_ear(struct layout *layout, uint32_t face, int ear,
                       struct clipped_ring *ring, uint32_t corner[3]) {
  int n = ring->count, before = (ear + n - 1) % n, after = (ear + 1) % n;
  const uint32_t side[3] = {ring->side[before], ring->side[ear],
                            n > 3 ? SHEET_NONE : ring->side[after]};
  corner[0] = ring->point[before];
  corner[1] = ring->point[ear];
  corner[2] = ring->point[after];
  ring->side[before] = SHEET_NONE;
  ring->count--;
  for (int i = ear; i < ring->count; i++) {
    ring->point[i] = ring->point[i + 1];
    ring->side[i] = ring->side[i + 1];
  }
  return layout_add_triangle(layout, face, corner, side);
}

/* Adds a clipped triangle in triangles.  Where rounding to the grid turned a
 * sliver of it over or made it edge-on, that triangle's sides are contours.
 * sign  set to the sign of the whole area on the page, in the face's winding */
static recto_status add_clipped_ears(struct layout *layout,
                                     const struct layout_triangle *triangle,
                                     const struct clip_polygon *polygon,
                                     const uint32_t *point, int *sign) {
  struct clipped_ring ring = {.count = polygon->count};
  uint32_t corner[CLIP_CORNERS_MAX][3];
  int64_t area[CLIP_CORNERS_MAX];
  int128 whole = 0;
  int ears = polygon->count - 2;
  size_t first = layout->flags.count;
  if (!layout_reserve(layout, CLIP_CORNERS_MAX))
    return error_memory(layout->error);
  for (int i = 0; i < ring.count; i++) {
    ring.point[i] = point[i];
    ring.side[i] = edge_of(layout, triangle, polygon, i);
  }
  ring.narrow = is_narrow(layout, &ring);
  for (int i = 0; i < ears; i++) {
    area[i] = cut_ear(layout, triangle->face, find_ear(layout, &ring), &ring,
                      corner[i]);
    whole += area[i];
    if (ears > 1)
      layout->flags.item[first + (size_t)i] |=
          i == 0 ? SHEET_PIECE | SHEET_FIRST_PIECE : SHEET_PIECE;
  }
  *sign = geom_sign128(whole);
  recto_status status = RECTO_OK;
  for (int i = 0; status == RECTO_OK && i < ears; i++) {
    bool odd = area[i] == 0 || geom_sign64(area[i]) != *sign;
    for (int k = 0; odd && status == RECTO_OK && k < 3; k++)
      status =
          layout_contour(layout, corner[i][k], corner[i][geom_next_corner(k)]);
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

/* Leaves out corners that came to the point of the next one, or the one after
 * that: then the corner between them is the end of a spike. */
static void drop_repeats(struct clip_polygon *polygon, uint32_t *point) {
  for (int i = 0; i < polygon->count && polygon->count >= 3;) {
    int n = polygon->count, drop = 0;
    if (point[i] == point[(i + 1) % n])
      drop = 1;
    else if (point[i] == point[(i + 2) % n])
      drop = 2;
    for (int k = 0; k < drop; k++, n--) {
      for (int j = i % n; j + 1 < n; j++) {
        point[j] = point[j + 1];
        polygon->corner[j] = polygon->corner[j + 1];
      }
    }
    polygon->count = n;
    i = drop > 0 ? 0 : i + 1;
  }
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

/* Adds what is left of a triangle.  Sides that the near plane made are
 * contours. */
static recto_status add_polygon(struct layout *layout,
                                const struct layout_triangle *triangle,
                                struct clip_polygon *polygon,
                                struct layout_clipped_triangle *left) {
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
  recto_status status =
      add_clipped_ears(layout, triangle, polygon, point, &left->sign);
  /* Where a strip is left so thin that rounding made it edge-on, as at the near
   * plane, the triangle still lies on its side of the edge. */
  if (left->sign == 0)
    left->sign = left->view_sign;
  for (int i = 0; status == RECTO_OK && i < polygon->count; i++) {
    const uint32_t end[2] = {point[i],
                             point[i + 1 < polygon->count ? i + 1 : 0]};
    if (polygon->corner[i].side != CLIP_CUT)
      left->sides |= 1u << polygon->corner[i].side;
    else if (!is_all_on_border(layout, end, 2))
      status = layout_contour(layout, end[0], end[1]);
  }
  return status;
}

recto_status layout_add_clipped(struct layout *layout,
                                const struct layout_triangle *triangle,
                                struct layout_clipped_triangle *left) {
  *left = (struct layout_clipped_triangle){.first = layout->flags.count};
  struct view_point corner[3];
  unsigned any = 0, all = ~0u;
  for (int k = 0; k < 3; k++) {
    corner[k] = layout_view(layout, triangle->point[k]);
    any |= layout->outcode[triangle->point[k]];
    all &= layout->outcode[triangle->point[k]];
  }
  if (all)
    return RECTO_OK;
  left->view_sign = view_sign(layout, corner);
  if (!any) {
    if (!layout_reserve(layout, 1))
      return error_memory(layout->error);
    left->sign = layout_add_whole(layout, triangle);
    left->sides = 7;
    return RECTO_OK;
  }
  struct clip_polygon polygon;
  if (!clip_triangle(&layout->projection, corner, triangle->forward, &polygon))
    return RECTO_OK;
  return add_polygon(layout, triangle, &polygon, left);
}
