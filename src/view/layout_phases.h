/* layout_phases.h - the phases of laying out a sheet, and the state that they
 * share.
 *
 * Phases, in this order
 *   range      computes the depth range of what is inside the printable area,
 *              which is mapped to the sheet's range of z.
 *   points     makes a sheet point of every used scene point inside.
 *   triangles  triangulates the faces, clips them and turns them
 *              counter-clockwise.  Their sides refer to topology edges, or to
 *              folds, numbered from the last of these; for each edge it is
 *              recorded on which of its sides its faces lie.
 *   edges      classifies the edges and makes sheet edges of those needed, then
 *              of the folds; then makes the triangles' sides refer to these.
 *   wires      makes edges of polylines.
 * Invariants
 *   A topology edge is clipped once, when a phase first needs it, from its
 *   lower to its upper point; all phases use the points so made.
 */
#ifndef VIEW_LAYOUT_PHASES_H
#define VIEW_LAYOUT_PHASES_H

#include "view/clip.h"
#include "view/sheet.h"
#include "scene/triangulate.h"

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

struct layout {
  struct sheet *sheet;
  const struct scene *scene;
  const struct topology *topology;
  const recto_options *options;
  bool all_edges;
  struct projection projection;
  uint32_t *point_map; /* scene point -> sheet point; SHEET_NONE: outside,
                          welded to another, or not used */
  uint8_t *outcode;    /* one a scene point: see clip.h */
  uint8_t *sides;      /* one a topology edge: LAYOUT_... */
  /* Topology edge -> clipped; SHEET_NONE: not yet clipped; NULL until the first
   * is. */
  uint32_t *edge_clipped;
  ARRAY(struct layout_clipped) clipped;
  struct layout_clipped_ends clipped_ends;
  ARRAY(uint8_t) flags; /* one a triangle; passed to the sheet at the end */
  struct triangulation triangulation;
  ARRAY(struct layout_diagonal) diagonal;     /* of the current face */
  ARRAY(struct layout_clipped_triangle) part; /* likewise, if it is clipped */
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

static inline struct view_point layout_view(const struct layout *layout,
                                            uint32_t point) {
  return camera_view(&layout->sheet->camera, &layout->scene->point.item[point]);
}

/* All fail with RECTO_ERROR_MEMORY or RECTO_ERROR_LIMIT. */
USE_RESULT recto_status layout_points(struct layout *layout);
USE_RESULT recto_status layout_triangles(struct layout *layout);
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
