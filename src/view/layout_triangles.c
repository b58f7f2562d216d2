/* layout_triangles.c - makes the sheet's triangles: triangulates the faces,
 * clips them and turns them counter-clockwise on the page.
 *
 * Until layout_edges has run, the sides of the triangles refer to topology
 * edges.
 */
#include "base/poll.h"
#include "view/coordinate_error.h"
#include "view/layout_clipping.h"
#include "view/layout_face_ranges.h"
#include "view/layout_face_sign.h"
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
  layout->whole.count = 0;
  if (!ARRAY_RESERVE(&layout->whole, triangles))
    return error_memory(layout->error);
  for (size_t t = 0; t < triangles; t++) {
    layout->whole.item[t] = nth_triangle(layout, face, start, count, t);
    layout_add_whole(layout, &layout->whole.item[t]);
  }
  int common;
  bool is_common = layout_face_sign(layout, face, first, &common);
  recto_status status = RECTO_OK;
  for (size_t t = 0; t < triangles; t++) {
    uint8_t flags = layout->flags.item[first + t];
    int own = flags & SHEET_EDGE_ON ? 0 : flags & SHEET_FLIPPED ? -1 : 1;
    int sign = is_common ? common : own;
    layout_record_triangle_sides(layout, &layout->whole.item[t], sign);
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
  int common = layout_sure_sign(layout, first);
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

/* Adds a quadrilateral that needs no clipping, whose two triangles have one
 * orientation on the page: nothing is in doubt, and its diagonal is no fold.
 * Returns false, having added nothing, where it is none; capacity must have
 * been reserved. */
static bool add_quadrilateral(struct layout *layout, uint32_t face,
                              uint32_t start, const uint32_t *corner) {
  const struct triangulation_triangle *t = layout->triangulation.triangle.item;
  const uint32_t *edge = layout->topology->corner_edge + start;
  struct layout_triangle_sink sink = layout_sink_of(layout);
  uint32_t point[2][3], side[2][3];
  int sign[2];
  for (int i = 0; i < 2; i++) {
    for (int k = 0; k < 3; k++) {
      point[i][k] = layout_sheet_point(layout, corner[t[i].corner[k]]);
      side[i][k] = t[i].side[k] < 4 ? edge[t[i].side[k]] : SHEET_NONE;
    }
    sign[i] = geom_sign64(geom_orient2d(sink.point[point[i][0]],
                                        sink.point[point[i][1]],
                                        sink.point[point[i][2]]));
  }
  if (sign[0] != sign[1] || sign[0] == 0)
    return false;
  for (int i = 0; i < 2; i++)
    (void)layout_sink_triangle(&sink, face, point[i], side[i]);
  layout_sink_close(layout, &sink);
  for (int k = 0; k < 4; k++)
    layout_record_edge(layout, edge[k], corner[k] < corner[(k + 1) % 4],
                       sign[0]);
  return true;
}

static recto_status add_triangulated_face(struct layout *layout, uint32_t face,
                                          uint32_t start, uint32_t count,
                                          bool clipped) {
  size_t first = layout->sheet->triangle.count;
  uint32_t folds = (uint32_t)layout->fold.count;
  if (!start_diagonals(layout, count - 3))
    return error_memory(layout->error);
  recto_status status = clipped ? add_clipped_face(layout, face, start, count)
                                : add_whole_face(layout, face, start, count);
  return status == RECTO_OK ? add_folds(layout, face, first, folds) : status;
}

static recto_status add_polygon_face(struct layout *layout, uint32_t face,
                                     uint32_t start, uint32_t count,
                                     bool clipped) {
  struct triangulation *triangulation = &layout->triangulation;
  const uint32_t *corner = welded_corners(layout, start, count);
  size_t first = layout->sheet->triangle.count;
  if (corner == NULL ||
      !triangulate(triangulation, layout->scene->point.item, corner, count) ||
      !layout_reserve(layout, triangulation->triangle.count) ||
      !coordinate_error_store(layout->sheet, face))
    return error_memory(layout->error);
  layout->sheet->warped += triangulation->warped;
  layout->sheet->empty += triangulation->triangle.count == 0;
  recto_status status = RECTO_OK;
  if (clipped || count != 4 || triangulation->triangle.count != 2 ||
      !add_quadrilateral(layout, face, start, corner))
    status = add_triangulated_face(layout, face, start, count, clipped);
  if (triangulation->off_plane == 0 ||
      triangulation->off_plane <= coordinate_error_contact(layout->sheet, face))
    mark_coplanar(layout, first);
  return status;
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
  if (!layout->leaves_out_sides &&
      !topology_find_corners(layout->topology, layout->scene))
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
