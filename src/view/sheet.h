/* sheet.h - the sheet: the projected scene on the page grid.
 *
 * x and y are integers on a grid of 2^-20 mm whose origin is the middle of
 * the page, x right and y up.  z is an integer that grows towards the viewer:
 *   orthographic  z = z_scale * (d_max - d)
 *   perspective   z = z_scale * (1 / d - 1 / d_max)
 * so planes stay planes.  The scale maps the range from d_min to d_max, the
 * depths of what is on the page, to the whole range of z, unless it is as small
 * as rounding errors.  Once the sheet is built all decisions are exact.
 *
 * Invariants
 *   |x|, |y| <= SHEET_XY_MAX;  0 <= z <= SHEET_Z_MAX.
 *   A triangle runs counter-clockwise on the page or has no area there.
 *   Triangles are in the order of their faces in the scene.
 *   The corners of a triangle have three different positions in the scene.
 *   An edge and its triangles have their end points in common, by index.
 *   Where clipping cuts a shared edge, both faces get the same new point.
 */
#ifndef VIEW_SHEET_H
#define VIEW_SHEET_H

#include "base/memory.h"
#include "geom/predicate.h"
#include "scene/topology/topology.h"
#include "view/camera.h"

#define SHEET_UNITS_PER_MM 1048576.0 /* 2^20 */
#define SHEET_XY_MAX ((1 << 30) - 1)
#define SHEET_Z_BITS 40
#define SHEET_Z_MAX ((INT64_C(1) << SHEET_Z_BITS) - 1)
#define SHEET_NONE UINT32_MAX

/* The bleed, in grid units (4 nm): faces and edges are clipped so far outside
 * the margins' border.  A side that clipping made hides nothing on its outer
 * side; if it lay on the border itself, a line there behind the clipped face
 * would be visible. */
#define SHEET_BLEED 4

/* Side k of a triangle runs from point[k] to point[(k + 1) % 3]. */
struct sheet_triangle {
  uint32_t point[3];
  uint32_t face; /* scene face */
};

/* The sheet edge of each side of a triangle; SHEET_NONE: one that clipping
 * made, or a diagonal that is no silhouette; neither is ever drawn. */
struct sheet_sides {
  uint32_t edge[3];
};

enum {
  SHEET_EDGE_ON = 1, /* it has no area on the page, and hides nothing */
  SHEET_FLIPPED = 2, /* the face's own winding is clockwise on the page */
  SHEET_INNER = 4,   /* shifted by k: side k is no edge of the mesh: a diagonal,
                        or one that clipping made */
  SHEET_COPLANAR = 32, /* one of several triangles of a planar face */
  SHEET_PIECE = 64, /* one of several that clipping left of one triangle; they
                       follow each other */
  SHEET_FIRST_PIECE = 128
};

struct sheet_edge {
  uint32_t point[2];    /* in the scene edge's direction */
  uint32_t triangle[2]; /* its first two; SHEET_NONE.  Intersections: the two
                           that intersect, the lower index first */
  uint32_t source;      /* topology edge; wires: the wire's index; SHEET_NONE
                           for intersections and diagonals */
  uint16_t edge_class;  /* a recto_edge_class: the first in that enumeration of
                           its classes that were requested; 0: none was, the
                           edge is there as an outline of its faces */
  uint16_t part;        /* wires: the segment's index, low bits */
};

struct sheet_contour {
  uint32_t point[2];
};

/* The coordinates' error of a face of many corners: coordinate_error.h. */
struct sheet_face_error {
  uint32_t face;
  double along[3];
};

struct sheet {
  ARRAY(struct geom_point) point; /* x, y in grid units, z in depth units */
  size_t vertex_count; /* the first points are those of the scene; clipping and
                          intersections add others */
  ARRAY(struct sheet_triangle) triangle;
  ARRAY(struct sheet_sides) sides; /* one a triangle; none where they were left
                                      out: sheet_find_sides */
  bool edges_are_manifold;   /* no edge has more triangles than it refers to;
                                false: some may have */
  uint64_t sides_compared;   /* how often that compared a side with an edge that
                              it is not */
  bool triangles_are_faces;  /* each has the number of its face */
  uint8_t *triangle_flags;   /* one a triangle */
  bool triangles_dropped;    /* the triangles were freed: edge.triangle then has
                              scene faces instead */
  const struct scene *scene; /* borrowed, not owned; for the precision of its
                                coordinates; NULL: exact */
  ARRAY(struct sheet_face_error) face_error; /* by face */
  double (*triangle_error)[3]; /* the coordinates' error of each triangle's
                                  face; NULL: to be found by its face */
  const uint32_t *face_group;  /* the scene's, borrowed; NULL: all of group 0 */
  uint32_t first_filled; /* faces before this one get no visible fragments */
  const struct topology *topology; /* the scene's, borrowed; NULL: unknown */
  /* Mesh edges in topology order, then diagonals that are silhouettes, then
   * wires, then intersections once they were found.  Edges of class 0 are
   * outlines, which are not drawn. */
  ARRAY(struct sheet_edge) edge;
  /* One an edge that was laid out, where the scene has several groups: that of
   * the edge's first face, or of the wire.  Of edges that come later: that of
   * their first triangle (sheet_edge_group). */
  ARRAY(uint32_t) edge_group;
  /* The contours, whether drawn or not:
   *   edges of one face or of more than two,
   *   silhouettes,
   *   sides of a triangle that is SHEET_EDGE_ON,
   *   diagonals along which a face that is not planar folds,
   *   sides that clipping to the near plane made.
   * Away from them, and from the page's border, the projected faces neither
   * fold nor end.  A contour may be listed twice. */
  ARRAY(struct sheet_contour) contour;
  struct camera camera;
  double z_scale;        /* see above */
  double units_per_view; /* grid units per unit of X / d (perspective) or of
                            X (orthographic) */
  /* Numbers of faces: */
  uint64_t clipped_near; /* wholly or partly in front of the near plane */
  uint64_t clipped_page; /* wholly or partly outside the margins */
  uint64_t warped;       /* not planar */
  uint64_t empty;        /* without a triangle left after welding */
  uint64_t cut_near;     /* visible, and clipped by a default near plane */
};

/* Zero-initialised is empty; layout_sheet (layout.h) fills it. */
void sheet_fini(struct sheet *sheet);

/* How many edges are of a requested class. */
size_t sheet_count_requested(const struct sheet *sheet);

/* Frees the triangles to save memory, once only the scene faces of edges are
 * still needed (sheet_edge_face).  Returns false when the caller cancelled; the
 * edges may then not be used any more. */
USE_RESULT bool sheet_drop_triangles(struct sheet *sheet);

/* Finds the sides of the triangles, where they were left out because few
 * drawings need them.  Returns false when memory ran out or the caller
 * cancelled. */
USE_RESULT bool sheet_find_sides(struct sheet *sheet);

/* The edges of a triangle's sides, which are known. */
static inline const uint32_t *sheet_triangle_sides(const struct sheet *sheet,
                                                   size_t triangle) {
  return sheet->sides.item[triangle].edge;
}

/* Whether two triangles are of one face, or of parts of one that a cut left:
 * a face does not pierce itself. */
static inline bool sheet_is_one_face(const struct sheet *sheet, uint32_t f,
                                     uint32_t g) {
  uint32_t one = sheet->triangle.item[f].face;
  uint32_t other = sheet->triangle.item[g].face;
  const struct scene_cut *cut = sheet->scene != NULL ? sheet->scene->cut : NULL;
  return one == other ||
         (cut != NULL && one < cut->first_face && other < cut->first_face &&
          cut->face[one] == cut->face[other]);
}

static inline uint32_t sheet_face_group(const struct sheet *sheet,
                                        uint32_t face) {
  return sheet->face_group != NULL ? sheet->face_group[face] : 0;
}

/* The points of an edge or a contour, from its `point`. */
static inline struct geom_segment sheet_ends(const struct sheet *sheet,
                                             const uint32_t point[2]) {
  return (struct geom_segment){sheet->point.item[point[0]],
                               sheet->point.item[point[1]]};
}

static inline bool sheet_is_edge_on(const struct sheet *sheet,
                                    size_t triangle) {
  return sheet->triangle_flags[triangle] & SHEET_EDGE_ON;
}

/* Whether visible fragments of a triangle are requested. */
static inline bool sheet_is_filled(const struct sheet *sheet, size_t f) {
  return sheet->triangle.item[f].face >= sheet->first_filled;
}

/* Is the edge to be drawn, and longer than a point on the page? */
static inline bool sheet_edge_is_drawn(const struct sheet *sheet, size_t e) {
  const struct sheet_edge *edge = &sheet->edge.item[e];
  struct geom_segment s = sheet_ends(sheet, edge->point);
  return edge->edge_class != 0 && (s.p.x != s.q.x || s.p.y != s.q.y);
}

/* Fetches what sheet_corners reads of a triangle. */
MEM_PREFETCH_INLINE void sheet_prefetch_corners(const struct sheet *sheet,
                                                size_t triangle) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  MEM_PREFETCH(&sheet->point.item[p[0]]);
  MEM_PREFETCH(&sheet->point.item[p[1]]);
  MEM_PREFETCH(&sheet->point.item[p[2]]);
}

/* Fetches one of each `stride` triangles that is looked at later, and the
 * corners of one that is looked at sooner. */
MEM_PREFETCH_INLINE void sheet_prefetch_sampled(const struct sheet *sheet,
                                                size_t triangle,
                                                size_t stride) {
  size_t near = triangle + MEM_PREFETCH_AHEAD / 2 * stride,
         far = triangle + MEM_PREFETCH_AHEAD * stride;
  if (far >= sheet->triangle.count)
    return;
  MEM_PREFETCH(&sheet->triangle.item[far]);
  sheet_prefetch_corners(sheet, near);
}

static inline struct geom_triangle sheet_corners(const struct sheet *sheet,
                                                 size_t triangle) {
  const uint32_t *point = sheet->triangle.item[triangle].point;
  return (struct geom_triangle){{sheet->point.item[point[0]],
                                 sheet->point.item[point[1]],
                                 sheet->point.item[point[2]]}};
}

static inline struct geom_plane sheet_plane(const struct sheet *sheet,
                                            size_t triangle) {
  struct geom_triangle t = sheet_corners(sheet, triangle);
  return geom_plane_of(t.p[0], t.p[1], t.p[2]);
}

/* The depth of a triangle's nearest corner. */
static inline int64_t sheet_nearest_z(const struct sheet *sheet,
                                      size_t triangle) {
  int64_t low, high;
  geom_depth_range(sheet_corners(sheet, triangle).p, &low, &high);
  return high;
}

/* The scene face of an edge's first triangle; SHEET_NONE. */
static inline uint32_t sheet_edge_face(const struct sheet *sheet,
                                       const struct sheet_edge *edge) {
  uint32_t first = edge->triangle[0];
  return first == SHEET_NONE || sheet->triangles_dropped
             ? first
             : sheet->triangle.item[first].face;
}

/* The group of an edge of the sheet. */
static inline uint32_t sheet_edge_group(const struct sheet *sheet,
                                        const struct sheet_edge *edge) {
  if (sheet->edge_group.count == 0 && sheet->face_group == NULL)
    return 0;
  size_t e = (size_t)(edge - sheet->edge.item);
  if (e < sheet->edge_group.count)
    return sheet->edge_group.item[e];
  uint32_t face = sheet_edge_face(sheet, edge);
  return face != SHEET_NONE ? sheet_face_group(sheet, face) : 0;
}

static inline bool sheet_is_inner_side(const struct sheet *sheet,
                                       uint32_t triangle, int k) {
  return (sheet->triangle_flags[triangle] & SHEET_INNER << k) != 0;
}

/* Are both triangles in one plane of the scene, as parts of a planar face or of
 * one triangle that was clipped? */
static inline bool sheet_is_coplanar(const struct sheet *sheet, uint32_t f,
                                     uint32_t g) {
  const uint8_t *flags = sheet->triangle_flags;
  uint32_t first = f < g ? f : g, last = f < g ? g : f;
  if (sheet->triangle.item[f].face != sheet->triangle.item[g].face)
    return false;
  if (flags[f] & SHEET_COPLANAR)
    return true;
  while (last > first &&
         (flags[last] & (SHEET_PIECE | SHEET_FIRST_PIECE)) == SHEET_PIECE)
    last--;
  return last == first;
}

/* Converts grid units from the middle of the page to mm from its lower left
 * corner.  A coordinate in the bleed is moved to the margin's border. */
static inline double sheet_place_mm(const struct sheet *sheet, int axis,
                                    double units) {
  const struct camera *camera = &sheet->camera;
  double low = camera->margin_mm, high = camera->page_mm[axis] - low;
  double mm = camera->page_mm[axis] / 2 + units / SHEET_UNITS_PER_MM;
  return mm < low ? low : mm > high ? high : mm;
}
static inline double sheet_x_mm(const struct sheet *sheet, double x) {
  return sheet_place_mm(sheet, 0, x);
}
static inline double sheet_y_mm(const struct sheet *sheet, double y) {
  return sheet_place_mm(sheet, 1, y);
}

/* Where the view axis meets the page, in grid units. */
struct sheet_axis {
  double x, y;
};
static inline struct sheet_axis sheet_view_axis(const struct sheet *sheet) {
  const struct camera *c = &sheet->camera;
  return (struct sheet_axis){
      (c->middle_mm[0] - c->page_mm[0] / 2) * SHEET_UNITS_PER_MM,
      (c->middle_mm[1] - c->page_mm[1] / 2) * SHEET_UNITS_PER_MM};
}

#endif
