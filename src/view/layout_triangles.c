/* layout_triangles.c - the sheet's triangles: faces triangulated, clipped, and
 * turned counter-clockwise on the page.
 *
 * Until layout_edges is done, the sides of the triangles name topology edges.
 */
#include "view/layout.h"

#include <stdlib.h>

#include "geom/predicate.h"

/* A triangle of a face, before clipping. */
struct facet {
  uint32_t face;
  uint32_t point[3];    /* scene points, welded */
  uint32_t side[3];     /* topology edges; SHEET_NONE: a diagonal */
  bool forward[3];      /* whether the side runs in its canonical direction */
  uint32_t diagonal[3]; /* where the side is one: its number in the face */
};

/* The side of a facet that is a diagonal, or an edge, learns where it lies. */
static inline void learn_side(struct layout *layout, const struct facet *facet,
                              int k, int sign) {
  uint8_t *sides = facet->side[k] != SHEET_NONE
                       ? &layout->sides[facet->side[k]]
                       : &layout->diagonal.item[facet->diagonal[k]].sides;
  layout_learn(sides, facet->forward[k], sign);
}

/* Adds a triangle of three sheet points; there is room for it.
 * Returns twice its signed area on the page, as the face winds. */
static inline int64_t add_triangle(struct layout *layout, uint32_t face,
                                   const uint32_t point[3],
                                   const uint32_t side[3]) {
  struct sheet *sheet = layout->sheet;
  const struct sheet_point *at = sheet->point.item;
  int64_t area = geom_orient2d(at[point[0]], at[point[1]], at[point[2]]);
  struct sheet_triangle *t = &sheet->triangle.item[sheet->triangle.count++];
  uint8_t *flags = &layout->flags.item[layout->flags.count++];
  if (area >= 0) {
    *t = (struct sheet_triangle){
        {point[0], point[1], point[2]}, {side[0], side[1], side[2]}, face};
    *flags = area == 0 ? SHEET_FLAT : 0;
  } else {
    *t = (struct sheet_triangle){
        {point[0], point[2], point[1]}, {side[2], side[1], side[0]}, face};
    *flags = SHEET_FLIPPED;
  }
  return area;
}

static bool reserve(struct layout *layout, size_t extra) {
  return ARRAY_RESERVE(&layout->sheet->triangle, extra) &&
         ARRAY_RESERVE(&layout->flags, extra);
}

/* ---- Whole triangles
 * --------------------------------------------------------- */

static inline void add_facet(struct layout *layout, const struct facet *facet) {
  const uint32_t *map = layout->point_map;
  const uint32_t point[3] = {map[facet->point[0]], map[facet->point[1]],
                             map[facet->point[2]]};
  int sign = geom_sign64(add_triangle(layout, facet->face, point, facet->side));
  for (int k = 0; k < 3; k++)
    learn_side(layout, facet, k, sign);
}

/* ---- Cut triangles
 * ------------------------------------------------------------ */

/* The cut of a diagonal of the face at hand. */
static recto_status cut_diagonal(struct layout *layout,
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

/* The cut of a side of a facet, in the side's canonical direction. */
static recto_status cut_side(struct layout *layout, const struct facet *facet,
                             int k, struct layout_cut *cut) {
  if (facet->side[k] != SHEET_NONE)
    return layout_edge_cut(layout, facet->side[k], cut);
  return cut_diagonal(layout, &layout->diagonal.item[facet->diagonal[k]], cut);
}

/* The sheet point of corner i of what is left of a facet: its own corner's,
 * the one that the side which leaves or reaches it was cut at, or a new one
 * where the paper's corner or its border at the near plane is inside. */
static recto_status find_corner(struct layout *layout,
                                const struct facet *facet,
                                const struct clip_polygon *polygon, int i,
                                uint32_t *point) {
  const struct clip_corner *corner = &polygon->corner[i];
  *point = SHEET_NONE;
  if (corner->origin != CLIP_CUT) {
    *point = layout->point_map[facet->point[corner->origin]];
    return RECTO_OK;
  }
  int reached = polygon->corner[i > 0 ? i - 1 : polygon->count - 1].side;
  bool leaves = corner->side != CLIP_CUT;
  int side = leaves ? corner->side : reached;
  if (side != CLIP_CUT) {
    struct layout_cut cut;
    recto_status status = cut_side(layout, facet, side, &cut);
    if (status != RECTO_OK)
      return status;
    *point = cut.point[leaves != facet->forward[side]];
  }
  /* A side of which a single point is left has no cut either. */
  return *point == SHEET_NONE ? layout_new_point(layout, corner->at, point)
                              : RECTO_OK;
}

static uint32_t edge_of(const struct facet *facet,
                        const struct clip_polygon *polygon, int i) {
  int side = polygon->corner[i].side;
  return side == CLIP_CUT ? SHEET_NONE : facet->side[side];
}

/* Whether both points are on one border of the paper. */
static bool is_on_border(const struct layout *layout, uint32_t a, uint32_t b) {
  struct sheet_point p = layout->sheet->point.item[a];
  struct sheet_point q = layout->sheet->point.item[b];
  const double *half = layout->projection.half;
  return (p.x == q.x && abs(p.x) == half[0]) ||
         (p.y == q.y && abs(p.y) == half[1]);
}

/* Adds what is left of a facet as a fan.  Where the grid folded a sliver of it
 * over or made it flat, that triangle's sides are contours.
 * Returns the sign of the whole's area on the page, as the face winds, in
 * *sign. */
static recto_status add_fan(struct layout *layout, const struct facet *facet,
                            const struct clip_polygon *polygon,
                            const uint32_t *point, int *sign) {
  int64_t area[CLIP_MOST] = {0};
  int128 whole = 0;
  if (!reserve(layout, CLIP_MOST))
    return error_memory(layout->error);
  for (int i = 1; i + 1 < polygon->count; i++) {
    bool last = i + 2 == polygon->count;
    const uint32_t corner[3] = {point[0], point[i], point[i + 1]};
    const uint32_t side[3] = {i == 1 ? edge_of(facet, polygon, 0) : SHEET_NONE,
                              edge_of(facet, polygon, i),
                              last ? edge_of(facet, polygon, i + 1)
                                   : SHEET_NONE};
    area[i] = add_triangle(layout, facet->face, corner, side);
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

/* Adds what is left of a facet; its sides learn where it lies, and its cuts at
 * the near plane are contours. */
static recto_status add_polygon(struct layout *layout,
                                const struct facet *facet,
                                const struct clip_polygon *polygon) {
  uint32_t point[CLIP_MOST];
  for (int i = 0; i < polygon->count; i++) {
    recto_status status = find_corner(layout, facet, polygon, i, &point[i]);
    if (status != RECTO_OK)
      return status;
  }
  int sign = 0;
  recto_status status = add_fan(layout, facet, polygon, point, &sign);
  for (int i = 0; status == RECTO_OK && i < polygon->count; i++) {
    uint32_t next = point[i + 1 < polygon->count ? i + 1 : 0];
    if (polygon->corner[i].side != CLIP_CUT)
      learn_side(layout, facet, polygon->corner[i].side, sign);
    else if (!is_on_border(layout, point[i], next))
      status = layout_contour(layout, point[i], next);
  }
  return status;
}

static recto_status cut_facet(struct layout *layout,
                              const struct facet *facet) {
  struct view_point corner[3];
  unsigned any = 0, all = ~0u;
  for (int k = 0; k < 3; k++) {
    corner[k] = layout_view(layout, facet->point[k]);
    any |= layout->outcode[facet->point[k]];
    all &= layout->outcode[facet->point[k]];
  }
  if (all)
    return RECTO_OK;
  if (!any) {
    if (!reserve(layout, 1))
      return error_memory(layout->error);
    add_facet(layout, facet);
    return RECTO_OK;
  }
  struct clip_polygon polygon;
  if (!clip_triangle(&layout->projection, corner, facet->forward, &polygon))
    return RECTO_OK;
  return add_polygon(layout, facet, &polygon);
}

/* ---- Faces
 * -------------------------------------------------------------------- */

static inline void set_side(const struct layout *layout, struct facet *facet,
                            int k, uint32_t corner) {
  uint32_t from = facet->point[k], to = facet->point[k == 2 ? 0 : k + 1];
  facet->side[k] = layout->topology->corner_edge[corner];
  facet->forward[k] = from < to;
}

/* The facet of a face of three corners. */
static inline struct facet facet_of_face(const struct layout *layout,
                                         uint32_t face, uint32_t start) {
  struct facet facet = {.face = face};
  for (uint32_t k = 0; k < 3; k++)
    facet.point[k] = layout_weld(layout, layout->scene->corner.item[start + k]);
  for (int k = 0; k < 3; k++)
    set_side(layout, &facet, k, start + (uint32_t)k);
  return facet;
}

/* One triangle of a triangulated face of `count` corners. */
static struct facet facet_of_triangle(struct layout *layout, uint32_t face,
                                      uint32_t start, uint32_t count,
                                      const struct triangulation_triangle *t) {
  struct facet facet = {.face = face};
  for (int k = 0; k < 3; k++)
    facet.point[k] =
        layout_weld(layout, layout->scene->corner.item[start + t->corner[k]]);
  for (int k = 0; k < 3; k++) {
    if (t->side[k] < count) {
      set_side(layout, &facet, k, start + t->side[k]);
      continue;
    }
    facet.side[k] = SHEET_NONE;
    struct layout_diagonal *diagonal =
        &layout->diagonal.item[t->side[k] - count];
    int next = k == 2 ? 0 : k + 1;
    facet.diagonal[k] = t->side[k] - count;
    facet.forward[k] = t->corner[k] < t->corner[next];
    diagonal->from = facet.point[facet.forward[k] ? k : next];
    diagonal->to = facet.point[facet.forward[k] ? next : k];
  }
  return facet;
}

/* The diagonals of the face at hand, with nothing known of them. */
static bool start_diagonals(struct layout *layout, uint32_t count) {
  layout->diagonal.count = 0;
  if (!ARRAY_RESERVE(&layout->diagonal, count))
    return false;
  layout->diagonal.count = count;
  for (uint32_t d = 0; d < count; d++)
    layout->diagonal.item[d] =
        (struct layout_diagonal){SHEET_NONE, SHEET_NONE, SHEET_NONE, 0};
  return true;
}

/* A face that is not flat may fold at its diagonals. */
static recto_status add_folds(struct layout *layout) {
  for (size_t d = 0; d < layout->diagonal.count; d++) {
    struct layout_diagonal *diagonal = &layout->diagonal.item[d];
    if (diagonal->sides == LAYOUT_PLAIN)
      continue;
    struct layout_cut cut;
    recto_status status = cut_diagonal(layout, diagonal, &cut);
    if (status == RECTO_OK && cut.point[0] != SHEET_NONE)
      status = layout_contour(layout, cut.point[0], cut.point[1]);
    if (status != RECTO_OK)
      return status;
  }
  return RECTO_OK;
}

static recto_status add_polygon_face(struct layout *layout, uint32_t face,
                                     uint32_t start, uint32_t count,
                                     bool clipped) {
  struct triangulation *triangulation = &layout->triangulation;
  if (!triangulate(triangulation, layout->scene->point.item,
                   layout->scene->corner.item + start, count) ||
      !reserve(layout, triangulation->triangle.count) ||
      !start_diagonals(layout, count - 3))
    return error_memory(layout->error);
  layout->sheet->warped += triangulation->warped;
  for (size_t t = 0; t < triangulation->triangle.count; t++) {
    struct facet facet = facet_of_triangle(layout, face, start, count,
                                           &triangulation->triangle.item[t]);
    recto_status status = RECTO_OK;
    if (clipped)
      status = cut_facet(layout, &facet);
    else
      add_facet(layout, &facet);
    if (status != RECTO_OK)
      return status;
  }
  return add_folds(layout);
}

static recto_status add_face(struct layout *layout, uint32_t face) {
  uint32_t start = layout->scene->face_start.item[face];
  uint32_t count = layout->scene->face_start.item[face + 1] - start;
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
  struct facet facet = facet_of_face(layout, face, start);
  if (any)
    return cut_facet(layout, &facet);
  if (!reserve(layout, 1))
    return error_memory(layout->error);
  add_facet(layout, &facet);
  return RECTO_OK;
}

recto_status layout_triangles(struct layout *layout) {
  uint32_t faces = scene_face_count(layout->scene);
  size_t triangles = layout->scene->corner.count - 2 * (size_t)faces;
  layout->sides =
      mem_calloc(layout->topology->edge.count, sizeof *layout->sides);
  if (!layout->sides || !reserve(layout, triangles))
    return error_memory(layout->error);
  for (uint32_t face = 0; face < faces; face++) {
    recto_status status = add_face(layout, face);
    if (status != RECTO_OK)
      return status;
    if (layout->sheet->triangle.count > SHEET_NONE / 2)
      return error_set(layout->error, RECTO_ERROR_LIMIT, NULL, 0,
                       "the drawing has more than 2^31 triangles");
  }
  return RECTO_OK;
}
