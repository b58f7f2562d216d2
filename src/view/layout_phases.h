/* layout_phases.h - the phases of laying out a sheet, and the state that they
 * share.
 *
 * Phases, in this order
 *   classes    finds the classes of edges that do not depend on the camera, or
 *              prepares that each gets its own when it is chosen.
 *   range      computes the depth range of what is inside the printable area,
 *              which is mapped to the sheet's range of z.
 *   points     makes a sheet point of every used scene point inside.
 *   triangles  triangulates the faces, clips them and turns them
 *              counter-clockwise.  Their sides refer to topology edges, or to
 *              folds, numbered from the last of these; for each edge it is
 *              recorded on which of its sides its faces lie.  Where no face
 *              needs triangulation or clipping, the latter is all that is done.
 *   edges      classifies the edges and makes sheet edges of those needed, then
 *              of the folds.
 *   link       makes the triangles' sides refer to sheet edges; or makes the
 *              triangles, where they were left out before, without their sides
 *              where nobody may need these.
 *   wires      makes edges of polylines.
 * Invariants
 *   A topology edge is clipped once, when a phase first needs it, from its
 *   lower to its upper point; all phases use the points so made.
 */
#ifndef VIEW_LAYOUT_PHASES_H
#define VIEW_LAYOUT_PHASES_H

#include "scene/edges/edge_classes.h"
#include "scene/triangulation/triangulate.h"
#include "view/clip.h"
#include "view/sheet.h"

/* What clipping leaves of an edge or a diagonal. */
struct layout_clipped {
  uint32_t point[2]; /* sheet points; SHEET_NONE both: nothing is left */
};

/* Where clipping cut an edge of a scene point that is outside. */
struct layout_clipped_end {
  uint32_t outside; /* the scene point */
  uint32_t point;   /* the sheet point */
  uint32_t hash;    /* of the scene point and the position */
};

/* A hash table of these by linear probing. */
struct layout_clipped_ends {
  ARRAY(struct layout_clipped_end) list;
  uint32_t *slot; /* indices into the list; SHEET_NONE: free */
  size_t slots;   /* a power of two */
};

/* On which sides of an edge or a diagonal its faces lie, seen from its lower to
 * its upper point.  The bits above count the faces, up to three. */
enum {
  LAYOUT_LEFT = 1,
  LAYOUT_RIGHT = 2,
  LAYOUT_EDGE_ON = 4,
  LAYOUT_ONE_FACE = 8,
  LAYOUT_FACES_MAX = 3 * LAYOUT_ONE_FACE,
  /* Two faces, one on each side: the edge is no contour. */
  LAYOUT_TWO_SIDED = LAYOUT_LEFT | LAYOUT_RIGHT | 2 * LAYOUT_ONE_FACE
};

/* Records on which side of an edge a face of this orientation lies.
 * forward  the face runs along the edge from the lower to the upper point
 * sign     of the face's area on the page; 0: edge-on */
static inline void layout_record_side(uint8_t *sides, bool forward, int sign) {
  static const uint8_t bit_of[3][2] = {{LAYOUT_LEFT, LAYOUT_RIGHT},
                                       {LAYOUT_EDGE_ON, LAYOUT_EDGE_ON},
                                       {LAYOUT_RIGHT, LAYOUT_LEFT}};
  *sides |= bit_of[sign + 1][forward];
  if (*sides < LAYOUT_FACES_MAX)
    *sides = (uint8_t)(*sides + LAYOUT_ONE_FACE);
}

/* Records what was recorded of another face, alone. */
static inline void layout_unite_sides(uint8_t *sides, uint8_t of_face) {
  *sides |= of_face & (LAYOUT_ONE_FACE - 1);
  if (*sides < LAYOUT_FACES_MAX)
    *sides = (uint8_t)(*sides + LAYOUT_ONE_FACE);
}

/* Stands for the flags of a face that is left out. */
enum { LAYOUT_NO_TRIANGLE = 128 };

/* The flags of a triangle by its area, in its face's winding. */
static inline uint8_t layout_flags_of_area(int64_t area) {
  return area < 0 ? SHEET_FLIPPED : area == 0 ? SHEET_EDGE_ON : 0;
}

/* Whether an edge of two faces is LAYOUT_TWO_SIDED, by their flags. */
static inline bool layout_flags_are_two_sided(uint8_t first, uint8_t second,
                                              bool same_way) {
  return (first ^ second) == (same_way ? SHEET_FLIPPED : 0) &&
         (first & ~SHEET_FLIPPED) == 0;
}

/* The triangle of three points.
 * flip  whether they run clockwise on the page */
static inline struct sheet_triangle
layout_oriented_triangle(const uint32_t point[3], uint32_t face, bool flip) {
  /* Written so that nothing is looked up in memory. */
  return (struct sheet_triangle){
      {point[0], flip ? point[2] : point[1], flip ? point[1] : point[2]}, face};
}

/* The sides after these points. */
static inline struct sheet_sides layout_oriented_sides(const uint32_t side[3],
                                                       bool flip) {
  return (struct sheet_sides){
      {flip ? side[2] : side[0], side[1], flip ? side[0] : side[2]}};
}

/* The classes that an edge has by its faces. */
#define LAYOUT_FACE_CLASSES                                                    \
  (RECTO_EDGES_ALL & ~(unsigned)(RECTO_EDGE_WIRE | RECTO_EDGE_INTERSECTION))

/* Whether both faces lie on one side of the edge on the page, or one of them is
 * seen edge-on.  An edge that lost a face to clipping is no silhouette. */
static inline bool layout_is_silhouette(uint8_t sides) {
  bool left = sides & LAYOUT_LEFT, right = sides & LAYOUT_RIGHT;
  return sides / LAYOUT_ONE_FACE == 2 && left != right;
}

/* A diagonal of the triangulation of the current face. */
struct layout_diagonal {
  uint32_t from, to; /* welded scene points, the lower first */
  uint32_t clipped;  /* as edge_clipped */
  uint32_t fold;     /* its index in layout.fold; SHEET_NONE: it is none */
  uint8_t sides;     /* LAYOUT_... */
};

/* What clipping left of a triangle of a face. */
struct layout_clipped_triangle {
  size_t first;   /* triangle of the sheet; they end where the next begins */
  int sign;       /* of its area on the page, in the face's winding */
  int view_sign;  /* that before clipping and rounding; 0: not sure */
  unsigned sides; /* 1 << k: something is left of side k */
};

/* A diagonal that is a silhouette: a face that is not planar folds there. */
struct layout_fold {
  struct layout_clipped ends;
  uint32_t face;
};

/* On which side of an edge of an earlier range a face lies. */
struct layout_late_side {
  uint32_t edge; /* of the topology */
  uint8_t sides; /* LAYOUT_..., of one face */
};

/* The map from topology edges to sheet edges, as a bit vector with rank: a bit
 * says whether the edge was made, and as sheet edges are in the same order, the
 * number of bits set before it is its index.  It is queried for every side of
 * every triangle, and is small enough to stay in the cache. */
struct layout_edge_ids {
  uint64_t *bits;
  uint32_t *before;
};

/* The sheet edge of a topology edge; SHEET_NONE: it was not made. */
static inline uint32_t layout_edge_id(const struct layout_edge_ids *ids,
                                      uint32_t edge) {
  uint64_t bits = ids->bits[edge / 64], bit = UINT64_C(1) << edge % 64;
  if (!(bits & bit))
    return SHEET_NONE;
  /* Where all are made, as all edges are, bits need not be counted. */
  uint64_t below = bits & (bit - 1);
  return ids->before[edge / 64] +
         (below == bit - 1 ? edge % 64 : (uint32_t)__builtin_popcountll(below));
}

/* Notes that a triangle has an edge; triangles do in their order. */
static inline void layout_use_edge(struct sheet_edge *edge, uint32_t triangle) {
  uint32_t *of = edge->triangle;
  if (of[0] == SHEET_NONE)
    of[0] = triangle;
  else if (of[1] == SHEET_NONE && of[0] != triangle)
    of[1] = triangle;
}

struct layout {
  struct sheet *sheet;
  const struct scene *scene;
  struct topology *topology;
  const recto_options *options;
  bool all_edges;
  struct projection projection;
  uint32_t *point_map;  /* scene point -> sheet point; SHEET_NONE: outside,
                          welded to another, or not used; NULL: each is that of
                          its own number */
  uint8_t *outcode;     /* one a scene point: see clip.h */
  uint8_t *sides;       /* one a topology edge: LAYOUT_...; NULL: the flags of
                          faces say it (layout_face_ranges.h) */
  uint8_t *class_masks; /* likewise; once they are chosen, the class of each.
                           NULL where no class of them was requested */
  struct crease_filter filter; /* with directions: class_masks are 0 until edges
                                  are chosen, by this */
  bool is_clipped;             /* a point that is used is outside */
  uint8_t *coarse;             /* of topology_coarse_parts; or NULL */
  struct layout_edge_ids ids;
  struct face_range *face_range; /* of layout_face_ranges.h; NULL: triangles are
                                    there before the edges */
  /* Of a range of faces that is laid out for itself (layout_polygon_ranges.h):
   * the topology edges before this one belong to earlier ranges, and what is
   * recorded of them is listed, for which there is room.  Else 0. */
  uint32_t first_edge;
  ARRAY(struct layout_late_side) late;
  bool leaves_out_sides; /* triangles are numbered as faces, and their sides are
                            not made: edges refer to the faces at once */
  /* Topology edge -> clipped; SHEET_NONE: not yet clipped; NULL until the first
   * is. */
  uint32_t *edge_clipped;
  ARRAY(struct layout_clipped) clipped;
  struct layout_clipped_ends clipped_ends;
  ARRAY(uint8_t) flags; /* one a triangle; passed to the sheet at the end */
  struct triangulation triangulation;
  ARRAY(struct layout_diagonal) diagonal;     /* of the current face */
  ARRAY(struct layout_clipped_triangle) part; /* likewise, if it is clipped */
  ARRAY(struct layout_triangle) whole;        /* its triangles, if it is not */
  ARRAY(struct layout_fold) fold;
  ARRAY(uint32_t) corner; /* of the current face, welded */
  recto_error *error;
};

/* The point to which a scene point is welded. */
static inline uint32_t layout_weld(const struct layout *layout,
                                   uint32_t point) {
  const uint32_t *weld = layout->topology->weld;
  return weld != NULL ? weld[point] : point;
}

/* The sheet point of a scene point, or SHEET_NONE. */
static inline uint32_t layout_sheet_point(const struct layout *layout,
                                          uint32_t point) {
  return layout->point_map != NULL ? layout->point_map[point] : point;
}

static inline struct view_point layout_view(const struct layout *layout,
                                            uint32_t point) {
  return camera_view(&layout->sheet->camera, &layout->scene->point.item[point]);
}

/* Records on which side of a topology edge a face of this orientation lies, as
 * layout_record_side. */
static inline void layout_record_edge(struct layout *layout, uint32_t edge,
                                      bool forward, int sign) {
  if (edge >= layout->first_edge) {
    layout_record_side(&layout->sides[edge], forward, sign);
    return;
  }
  struct layout_late_side late = {.edge = edge};
  layout_record_side(&late.sides, forward, sign);
  layout->late.item[layout->late.count++] = late;
}

/* All fail with RECTO_ERROR_MEMORY or RECTO_ERROR_LIMIT. */
USE_RESULT recto_status layout_classes(struct layout *layout);
USE_RESULT recto_status layout_points(struct layout *layout);
USE_RESULT recto_status layout_triangles(struct layout *layout);

/* Adds the triangles of a face, for which phase triangles is. */
USE_RESULT recto_status layout_face(struct layout *layout, uint32_t face);

/* Frees what that keeps from face to face. */
void layout_free_face(struct layout *layout);
USE_RESULT recto_status layout_edges(struct layout *layout);
USE_RESULT recto_status layout_wires(struct layout *layout);

/* Narrows the camera's depth range to what is inside the printable area; called
 * by layout_points.
 * used  one a point */
USE_RESULT recto_status layout_range(struct layout *layout,
                                     const uint8_t *used);

/* Adds a sheet point for a point that clipping made. */
USE_RESULT recto_status layout_new_point(struct layout *layout,
                                         struct view_point at, uint32_t *point);

/* Clips the segment between two scene points; of an edge, the lower first.
 * clipped  its sheet points; SHEET_NONE where nothing is left */
USE_RESULT recto_status layout_segment(struct layout *layout, uint32_t from,
                                       uint32_t to,
                                       struct layout_clipped *clipped);

/* The same, clipped once: *known is the number in layout.clipped, or SHEET_NONE
 * where it is clipped now. */
USE_RESULT recto_status layout_clip_known(struct layout *layout,
                                          uint32_t *known, uint32_t from,
                                          uint32_t to,
                                          struct layout_clipped *clipped);

/* Adds a contour. */
USE_RESULT recto_status layout_contour(struct layout *layout, uint32_t from,
                                       uint32_t to);

/* What is left of a topology edge, computed at the first call and then looked
 * up. */
USE_RESULT recto_status layout_clip_edge(struct layout *layout, uint32_t edge,
                                         struct layout_clipped *clipped);

#endif
