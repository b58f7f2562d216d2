/* sheet.h - the scene as seen through the camera, on the page's grid.
 *
 * x and y are integers on a grid of 2^-20 mm whose origin is the middle of
 * the page, x right and y up.  z is an integer that grows towards the viewer:
 *   orthographic  z = z_scale * (d_max - d)
 *   perspective   z = z_scale * (1 / d - 1 / d_max)
 * so planes stay planes.  The scale lets the range from d_min to d_max, the
 * depths of what is on the page, fill all of z, but for ranges that are no more
 * than rounding noise.  After the sheet
 * is built no decision is rounded.
 *
 * Invariants
 *   |x|, |y| <= SHEET_XY_MAX;  0 <= z <= SHEET_Z_MAX.
 *   A triangle runs counter-clockwise on the page or has no area there.
 *   Triangles stand in the order of their faces in the scene.
 *   The corners of a triangle were at three places in the scene.
 *   An edge's end points are the very points its triangles use.
 *   Where clipping cuts a shared edge, both faces get the same new point.
 */
#ifndef VIEW_SHEET_H
#define VIEW_SHEET_H

#include "geom/predicate.h"
#include "scene/topology.h"
#include "view/camera.h"

#define SHEET_UNITS_PER_MM 1048576.0 /* 2^20 */
#define SHEET_XY_MAX ((1 << 30) - 1)
#define SHEET_Z_BITS 40
#define SHEET_Z_MAX ((INT64_C(1) << SHEET_Z_BITS) - 1)
#define SHEET_NONE UINT32_MAX

/* What leaves the page inside its margins is cut so many units beyond their
 * border: 4 nm.  The side
 * of a cut hides nothing on its outer side; on the very border it would let a
 * line there be seen that is behind a face which goes on. */
#define SHEET_RIM 4

/* A side k of a triangle runs from point[k] to point[(k + 1) % 3]. */
struct sheet_triangle {
  uint32_t point[3];
  uint32_t side[3]; /* sheet edge of that side; SHEET_NONE: a cut, or a
                       diagonal that is no silhouette: never drawn */
  uint32_t face;    /* scene face */
};

enum {
  SHEET_FLAT = 1,    /* no area on the page: seen edge-on, hides nothing */
  SHEET_FLIPPED = 2, /* the face's own winding is clockwise on the page */
};

struct sheet_edge {
  uint32_t point[2];    /* in the scene edge's direction */
  uint32_t triangle[2]; /* its first two; SHEET_NONE.  Intersections: the two
                           that pierce each other, the lower first */
  uint32_t source;      /* topology edge; wires: the wire's index; SHEET_NONE
                           for intersections and diagonals */
  uint32_t group;       /* of its first face, or of the wire */
  uint16_t edge_class;  /* one recto_edge_class: of its natures that were
                           asked for, the first in that enumeration; 0: an
                           outline */
  uint16_t part;        /* wires: segment's index, low bits */
};

struct sheet_contour {
  uint32_t point[2];
};

struct sheet {
  ARRAY(struct geom_point) point; /* x, y in grid units, z in depth units */
  ARRAY(struct sheet_triangle) triangle;
  uint8_t *triangle_flags; /* one a triangle */
  bool edges_of_faces;     /* the triangles were given up: where edges name one
                          they name its scene face */
  const struct scene *scene;       /* lent, for how precise its coordinates are;
                                 NULL: exact */
  const uint32_t *face_group;      /* the scene's, lent */
  const struct topology *topology; /* the scene's, lent; NULL: unknown */
  /* Mesh edges in topology order, then diagonals that are silhouettes, then
   * wires, then intersections once they were found.  Edges of class 0 are there
   * as outlines, not to be drawn. */
  ARRAY(struct sheet_edge) edge;
  /* The contours, whether drawn or not: edges of one face or more than two,
   * silhouettes, sides of a triangle that is SHEET_FLAT, diagonals at which a
   * warped face folds, and cuts at the near plane.  Away from them, and from
   * the page's border, the projected faces neither fold nor end.  One may be
   * there twice. */
  ARRAY(struct sheet_contour) contour;
  struct camera camera;
  double z_scale;        /* see above */
  double units_per_view; /* grid units of x for one of X/d (perspective) or
                            X (orthographic) */
  /* Faces that reach before the near plane, or into the page's margins, wholly
   * or in part; faces that are not planar; faces of which welding left
   * nothing. */
  uint64_t clipped_near, clipped_page, warped, empty;
  /* Faces of which a near plane that nobody asked for cuts what could be
   * seen. */
  uint64_t cut_near;
};

/* Zero-initialised is empty; layout_sheet (layout.h) fills it. */
void sheet_fini(struct sheet *sheet);

/* Gives up the triangles, where of all that is asked of them only the faces of
 * edges are left to be asked. */
void sheet_drop_triangles(struct sheet *sheet);

/* The scene face of an edge's first triangle; SHEET_NONE. */
static inline uint32_t sheet_edge_face(const struct sheet *sheet,
                                       const struct sheet_edge *edge) {
  uint32_t first = edge->triangle[0];
  return first == SHEET_NONE || sheet->edges_of_faces
             ? first
             : sheet->triangle.item[first].face;
}

/* Grid units from the middle of the page to mm from its lower left corner;
 * what is on the rim comes to lie on the border that it surrounds. */
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
