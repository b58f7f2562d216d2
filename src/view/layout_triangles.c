/* layout_triangles.c - makes the sheet's triangles: triangulates the faces,
 * clips them and turns them counter-clockwise on the page.
 *
 * Until layout_edges has run, the sides of the triangles refer to topology
 * edges.
 */
#include <math.h>
#include <stdlib.h>

#include "base/poll.h"
#include "view/coordinate_error.h"
#include "view/layout_clipping.h"
#include "view/layout_face_ranges.h"
#include "view/layout_polygon_ranges.h"
#include "view/layout_unclipped.h"

static inline void set_side(const struct layout *layout,
                            struct layout_triangle *triangle, int k,
                            uint32_t corner) {
  uint32_t from = triangle->point[k], to = triangle->point[geom_next_corner(k)];
  triangle->side[k] = layout->topology->corner_edge[corner];
  triangle->forward[k] = from < to;
}

/* The triangle of a face of three corners. */
static inline struct layout_triangle
triangle_of_face(const struct layout *layout, uint32_t face, uint32_t start) {
  struct layout_triangle triangle = {.face = face};
  for (uint32_t k = 0; k < 3; k++)
    triangle.point[k] =
        layout_weld(layout, layout->scene->corner.item[start + k]);
  for (int k = 0; k < 3; k++)
    set_side(layout, &triangle, k, start + (uint32_t)k);
  return triangle;
}

/* One triangle of a triangulated face of `count` corners. */
static struct layout_triangle
triangle_of_part(struct layout *layout, uint32_t face, uint32_t start,
                 uint32_t count, const struct triangulation_triangle *t) {
  struct layout_triangle triangle = {.face = face};
  for (int k = 0; k < 3; k++)
    triangle.point[k] =
        layout_weld(layout, layout->scene->corner.item[start + t->corner[k]]);
  for (int k = 0; k < 3; k++) {
    if (t->side[k] < count) {
      set_side(layout, &triangle, k, start + t->side[k]);
      continue;
    }
    triangle.side[k] = SHEET_NONE;
    struct layout_diagonal *diagonal =
        &layout->diagonal.item[t->side[k] - count];
    uint32_t from = triangle.point[k], to = triangle.point[geom_next_corner(k)];
    triangle.diagonal[k] = t->side[k] - count;
    triangle.forward[k] = from < to;
    diagonal->from = triangle.forward[k] ? from : to;
    diagonal->to = triangle.forward[k] ? to : from;
  }
  return triangle;
}

/* Resets the diagonals of the current face. */
static bool start_diagonals(struct layout *layout, uint32_t count) {
  layout->diagonal.count = 0;
  if (!ARRAY_RESERVE(&layout->diagonal, count))
    return false;
  layout->diagonal.count = count;
  for (uint32_t d = 0; d < count; d++)
    layout->diagonal.item[d] = (struct layout_diagonal){
        SHEET_NONE, SHEET_NONE, SHEET_NONE, SHEET_NONE, 0};
  return true;
}

/* Decides whether a diagonal is a fold and stores it if so. */
static recto_status add_fold(struct layout *layout, uint32_t face,
                             struct layout_diagonal *diagonal) {
  bool wanted =
      layout->all_edges || (layout->options->ink.edges & RECTO_EDGE_SILHOUETTE);
  uint32_t fold = SHEET_NONE;
  struct layout_fold made = {.face = face};
  if (diagonal->sides != LAYOUT_TWO_SIDED && diagonal->from != SHEET_NONE) {
    recto_status status = layout_clip_known(
        layout, &diagonal->clipped, diagonal->from, diagonal->to, &made.ends);
    if (status == RECTO_OK && made.ends.point[0] != SHEET_NONE) {
      status = layout_contour(layout, made.ends.point[0], made.ends.point[1]);
      if (wanted && layout_is_silhouette(diagonal->sides))
        fold = (uint32_t)layout->fold.count;
    }
    if (status != RECTO_OK)
      return status;
  }
  diagonal->fold = fold;
  return fold == SHEET_NONE || ARRAY_PUSH(&layout->fold, made)
             ? RECTO_OK
             : error_memory(layout->error);
}

/* Stores the folds of a face that is not planar, and makes the sides of its
 * triangles, from `first` on, refer to them.
 * folds  the number of folds before this face */
static recto_status add_folds(struct layout *layout, uint32_t face,
                              size_t first, uint32_t folds) {
  struct sheet *sheet = layout->sheet;
  uint32_t named = (uint32_t)layout->topology->edge.count + folds;
  for (size_t d = 0; d < layout->diagonal.count; d++) {
    recto_status status = add_fold(layout, face, &layout->diagonal.item[d]);
    if (status != RECTO_OK)
      return status;
  }
  for (size_t t = first; t < sheet->triangle.count; t++)
    for (int k = 0; k < 3; k++) {
      uint32_t *side = &sheet->sides.item[t].edge[k];
      if (*side < named || *side == SHEET_NONE)
        continue;
      uint32_t fold = layout->diagonal.item[*side - named].fold;
      *side = fold == SHEET_NONE ? SHEET_NONE : named - folds + fold;
    }
  return RECTO_OK;
}

static struct layout_triangle nth_triangle(struct layout *layout, uint32_t face,
                                           uint32_t start, uint32_t count,
                                           size_t t) {
  return triangle_of_part(layout, face, start, count,
                          &layout->triangulation.triangle.item[t]);
}

/* How far the contact tolerance moves a point of this depth on the page, in
 * grid units, with one unit for rounding. */
static double contact_units(const struct sheet *sheet, uint32_t face,
                            int64_t z) {
  const struct camera *camera = &sheet->camera;
  double inverse_depth =
      camera->perspective ? (double)z / sheet->z_scale + 1 / camera->d_max : 1;
  return coordinate_error_contact(sheet, face) * sheet->units_per_view *
             inverse_depth +
         1;
}

static const struct geom_point *corner_point(const struct layout *layout,
                                             uint32_t corner) {
  uint32_t point = layout_weld(layout, layout->scene->corner.item[corner]);
  return &layout->sheet->point.item[layout_sheet_point(layout, point)];
}

static uint32_t farthest_corner(const struct layout *layout, uint32_t start,
                                uint32_t count, uint32_t from) {
  const struct geom_point *a = corner_point(layout, from);
  double most = -1;
  for (uint32_t c = start; c < start + count; c++) {
    const struct geom_point *p = corner_point(layout, c);
    double x = (double)p->x - a->x, y = (double)p->y - a->y;
    if (x * x + y * y > most) {
      most = x * x + y * y;
      from = c;
    }
  }
  return from;
}

/* Whether the face is seen edge-on within the contact tolerance: all of its
 * corners are that close to the line through two that are far apart. */
static bool is_face_edge_on(const struct layout *layout, uint32_t face,
                            uint32_t start, uint32_t count) {
  uint32_t from = farthest_corner(layout, start, count, start);
  const struct geom_point *a = corner_point(layout, from),
                          *b = corner_point(
                              layout,
                              farthest_corner(layout, start, count, from));
  double length = hypot((double)b->x - a->x, (double)b->y - a->y);
  for (uint32_t c = start; c < start + count; c++) {
    const struct geom_point *p = corner_point(layout, c);
    double off = fabs((double)geom_orient2d(*a, *b, *p));
    if (off > length * contact_units(layout->sheet, face, p->z))
      return false;
  }
  return true;
}

/* Whether a triangle is so thin that rounding its corners to the page grid, by
 * up to half a unit, may have turned it. */
static bool is_sign_unsure(const struct sheet *sheet, size_t triangle) {
  struct geom_triangle c = sheet_corners(sheet, triangle);
  int64_t area = geom_orient2d(c.p[0], c.p[1], c.p[2]), perimeter = 0;
  for (int k = 0; k < 3; k++) {
    struct geom_point a = c.p[k], b = c.p[geom_next_corner(k)];
    perimeter += llabs((int64_t)b.x - a.x) + llabs((int64_t)b.y - a.y);
  }
  return 2 * area <= perimeter + 4; /* sheet triangles are not clockwise */
}

/* The orientation of a face on the page, whose triangles start at `first`.
 *   All triangles whose sign is sure have one sign: that is the face's.  A
 *     polygon of many corners has triangles that rounding turns, and with two
 *     signs their diagonals would be drawn as silhouettes.
 *   The signs differ: the face folds over, and each triangle has its own sign.
 *   The signs differ, but the face is seen edge-on within the contact
 *     tolerance: only rounding made them differ, and the sign is 0.
 * Returns false where each triangle has its own sign. */
static bool face_sign(const struct layout *layout, uint32_t face, size_t first,
                      uint32_t start, uint32_t count, int *sign) {
  bool plus = false, minus = false;
  for (int unsure = 0; unsure <= 1 && !plus && !minus; unsure++)
    for (size_t t = first; t < layout->flags.count; t++) {
      uint8_t flags = layout->flags.item[t];
      if (unsure || !is_sign_unsure(layout->sheet, t)) {
        plus = plus || flags == 0;
        minus = minus || flags == SHEET_FLIPPED;
      }
    }
  *sign = plus - minus;
  return *sign != 0 || (plus && is_face_edge_on(layout, face, start, count));
}

/* The sign that all triangles from `first` on have whose sign is sure; 0 where
 * there is none, or they differ. */
static int sure_sign(const struct layout *layout, size_t first) {
  bool plus = false, minus = false;
  for (size_t t = first; t < layout->flags.count; t++) {
    bool flipped = layout->flags.item[t] & SHEET_FLIPPED;
    if (!is_sign_unsure(layout->sheet, t)) {
      plus = plus || !flipped;
      minus = minus || flipped;
    }
  }
  return plus - minus;
}

/* Makes the sides of a sheet triangle contours. */
static recto_status add_contours(struct layout *layout, size_t triangle) {
  const uint32_t *p = layout->sheet->triangle.item[triangle].point;
  recto_status status = RECTO_OK;
  for (int k = 0; status == RECTO_OK && k < 3; k++)
    status = layout_contour(layout, p[k], p[geom_next_corner(k)]);
  return status;
}

/* Adds a face that needs no clipping.  Triangles without an area, or turned,
 * because of rounding or a spike, get the orientation of the others, so that
 * silhouettes do not depend on the triangulation.  Their sides are contours all
 * the same. */
static recto_status add_whole_face(struct layout *layout, uint32_t face,
                                   uint32_t start, uint32_t count) {
  size_t triangles = layout->triangulation.triangle.count;
  size_t first = layout->flags.count;
  for (size_t t = 0; t < triangles; t++) {
    struct layout_triangle triangle =
        nth_triangle(layout, face, start, count, t);
    layout_add_whole(layout, &triangle);
  }
  int common;
  bool is_common = face_sign(layout, face, first, start, count, &common);
  recto_status status = RECTO_OK;
  for (size_t t = 0; t < triangles; t++) {
    struct layout_triangle triangle =
        nth_triangle(layout, face, start, count, t);
    uint8_t flags = layout->flags.item[first + t];
    int own = flags & SHEET_EDGE_ON ? 0 : flags & SHEET_FLIPPED ? -1 : 1;
    int sign = is_common ? common : own;
    layout_record_triangle_sides(layout, &triangle, sign);
    if (sign != own && status == RECTO_OK)
      status = add_contours(layout, first + t);
  }
  return status;
}

/* Adds what clipping leaves of the triangles of a face, with the orientation of
 * the others as above.  What is left of a triangle may be thin where the
 * whole one is not, which then says on which side of its edges it lies. */
static recto_status add_clipped_face(struct layout *layout, uint32_t face,
                                     uint32_t start, uint32_t count) {
  size_t triangles = layout->triangulation.triangle.count;
  size_t first = layout->flags.count;
  recto_status status = RECTO_OK;
  layout->part.count = 0;
  if (!ARRAY_RESERVE(&layout->part, triangles))
    return error_memory(layout->error);
  for (size_t t = 0; status == RECTO_OK && t < triangles; t++) {
    struct layout_triangle triangle =
        nth_triangle(layout, face, start, count, t);
    status = layout_add_clipped(layout, &triangle,
                                &layout->part.item[layout->part.count++]);
  }
  int common = sure_sign(layout, first);
  size_t end = layout->flags.count;
  for (size_t t = triangles; status == RECTO_OK && t-- > 0;) {
    struct layout_triangle triangle =
        nth_triangle(layout, face, start, count, t);
    const struct layout_clipped_triangle *left = &layout->part.item[t];
    bool may_turn = common != 0 && left->view_sign != -common;
    int sign = may_turn ? common : left->sign;
    layout_record_clipped(layout, &triangle, left, sign);
    for (size_t i = left->first;
         status == RECTO_OK && sign != left->sign && i < end; i++)
      status = add_contours(layout, i);
    end = left->first;
  }
  return status;
}

/* The welded corners of a face; NULL when memory ran out. */
static const uint32_t *welded_corners(struct layout *layout, uint32_t start,
                                      uint32_t count) {
  const uint32_t *corner = layout->scene->corner.item + start;
  if (layout->topology->weld == NULL)
    return corner;
  layout->corner.count = 0;
  if (!ARRAY_RESERVE(&layout->corner, count))
    return NULL;
  for (uint32_t c = 0; c < count; c++)
    layout->corner.item[c] = layout->topology->weld[corner[c]];
  return layout->corner.item;
}

/* Marks the triangles of a planar face, from `first` on, if there are
 * several. */
static void mark_coplanar(struct layout *layout, size_t first) {
  size_t end = layout->flags.count;
  for (size_t t = first; first + 1 < end && t < end; t++)
    layout->flags.item[t] |= SHEET_COPLANAR;
}

static recto_status add_polygon_face(struct layout *layout, uint32_t face,
                                     uint32_t start, uint32_t count,
                                     bool clipped) {
  struct triangulation *triangulation = &layout->triangulation;
  const uint32_t *corner = welded_corners(layout, start, count);
  size_t first = layout->sheet->triangle.count;
  uint32_t folds = (uint32_t)layout->fold.count;
  if (corner == NULL ||
      !triangulate(triangulation, layout->scene->point.item, corner, count) ||
      !layout_reserve(layout, triangulation->triangle.count) ||
      !start_diagonals(layout, count - 3) ||
      !coordinate_error_store(layout->sheet, face))
    return error_memory(layout->error);
  layout->sheet->warped += triangulation->warped;
  layout->sheet->empty += triangulation->triangle.count == 0;
  recto_status status = clipped ? add_clipped_face(layout, face, start, count)
                                : add_whole_face(layout, face, start, count);
  if (triangulation->off_plane <= coordinate_error_contact(layout->sheet, face))
    mark_coplanar(layout, first);
  return status == RECTO_OK ? add_folds(layout, face, first, folds) : status;
}

recto_status layout_face(struct layout *layout, uint32_t face) {
  uint32_t start = scene_face_start(layout->scene, face);
  uint32_t count = scene_face_start(layout->scene, face + 1) - start;
  unsigned any = 0, all = ~0u, beyond = 0;
  for (uint32_t c = start; c < start + count; c++) {
    uint8_t code =
        layout->outcode[layout_weld(layout, layout->scene->corner.item[c])];
    any |= code;
    all &= code;
    beyond |= code & CLIP_NEAR_BIT ? 0u : code;
  }
  layout->sheet->clipped_near += (any & CLIP_NEAR_BIT) != 0;
  layout->sheet->clipped_page += beyond != 0;
  if (all)
    return RECTO_OK;
  if (count != 3)
    return add_polygon_face(layout, face, start, count, any != 0);
  struct layout_triangle triangle = triangle_of_face(layout, face, start);
  const uint32_t *p = triangle.point;
  if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) {
    layout->sheet->empty++;
    return RECTO_OK;
  }
  if (any) {
    struct layout_clipped_triangle left;
    recto_status status = layout_add_clipped(layout, &triangle, &left);
    layout_record_clipped(layout, &triangle, &left, left.sign);
    mark_coplanar(layout, left.first);
    return status;
  }
  if (!layout_reserve(layout, 1))
    return error_memory(layout->error);
  layout_record_triangle_sides(layout, &triangle,
                               layout_add_whole(layout, &triangle));
  return RECTO_OK;
}

/* The faces one after the other, as clipping adds points. */
static recto_status add_faces_in_order(struct layout *layout) {
  uint32_t faces = scene_face_count(layout->scene);
  recto_status status = RECTO_OK;
  for (uint32_t face = 0; status == RECTO_OK && face < faces; face++) {
    uint32_t next = (face | (POLL_ITEMS - 1)) + 1;
    face = layout_unclipped_faces(layout, face, next < faces ? next : faces);
    if (face < faces)
      status = layout_face(layout, face);
    if (status == RECTO_OK && !poll_at(face))
      status = error_cancelled(layout->error);
    if (layout->sheet->triangle.count > SHEET_NONE / 2)
      break;
  }
  return status;
}

recto_status layout_triangles(struct layout *layout) {
  uint32_t faces = scene_face_count(layout->scene);
  size_t triangles = layout->scene->corner.count - 2 * (size_t)faces;
  if (!layout_orient_all_faces(layout))
    return error_memory(layout->error);
  if (layout->face_range != NULL)
    return RECTO_OK;
  layout->sides =
      mem_calloc(layout->topology->edge.count, sizeof *layout->sides);
  if (layout->sides == NULL || !layout_reserve(layout, triangles))
    return error_memory(layout->error);
  recto_status status = layout->is_clipped ? add_faces_in_order(layout)
                                           : layout_polygon_ranges(layout);
  if (status == RECTO_OK && layout->sheet->triangle.count > SHEET_NONE / 2)
    status = error_set(layout->error, RECTO_ERROR_LIMIT, NULL, 0,
                       "the drawing has more than 2^31 triangles");
  return status;
}
