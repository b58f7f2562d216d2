/* layout_phases.h - what the phases of laying out a sheet share.
 *
 * Phases, in this order
 *   range      the depths of what is on the paper, which the sheet's depths are
 *              spread over.
 *   points     every used scene point on the paper becomes a sheet point.
 *   triangles  faces are triangulated, clipped, turned counter-clockwise; their
 *              sides name topology edges, or folds counted on from these, and
 *              each edge learns on which of its sides its faces lie.
 *   edges      edges are classed, and where they are wanted made, then the
 *              folds; then the sides of the triangles name sheet edges.
 *   wires      polylines become edges.
 * Invariants  A topology edge is cut once, by whichever phase asks first, from
 *   its lower to its upper point; all others take the points it got.
 */
#ifndef VIEW_LAYOUT_PHASES_H
#define VIEW_LAYOUT_PHASES_H

#include "view/clip.h"
#include "view/sheet.h"
#include "view/triangulate.h"

/* What is left of an edge or a diagonal that leaves the paper. */
struct layout_cut {
  uint32_t point[2]; /* sheet points; SHEET_NONE both: nothing is left */
};

/* Where the faces of an edge or a diagonal lie, seen from its lower point to
 * its upper; the faces are counted above these bits, to three at most. */
enum {
  LAYOUT_LEFT = 1,
  LAYOUT_RIGHT = 2,
  LAYOUT_EDGE_ON = 4,
  LAYOUT_ONE_FACE = 8,
  LAYOUT_MOST_FACES = 3 * LAYOUT_ONE_FACE,
  /* Two faces, one on each side: neither an end of the projected faces nor a
   * fold. */
  LAYOUT_PLAIN = LAYOUT_LEFT | LAYOUT_RIGHT | 2 * LAYOUT_ONE_FACE
};

/* A line learns where a face with that sign on the page lies, which runs along
 * it from its lower point (forward) or from its upper one. */
static inline void layout_learn(uint8_t *sides, bool forward, int sign) {
  static const uint8_t bit_of[3][2] = {{LAYOUT_LEFT, LAYOUT_RIGHT},
                                       {LAYOUT_EDGE_ON, LAYOUT_EDGE_ON},
                                       {LAYOUT_RIGHT, LAYOUT_LEFT}};
  *sides |= bit_of[sign + 1][forward];
  if (*sides < LAYOUT_MOST_FACES)
    *sides = (uint8_t)(*sides + LAYOUT_ONE_FACE);
}

/* Both faces of a line lie on one side of it on the page, or one of them is
 * seen edge-on.  A line that lost a face to clipping is no silhouette. */
static inline bool layout_is_silhouette(uint8_t sides) {
  bool left = sides & LAYOUT_LEFT, right = sides & LAYOUT_RIGHT;
  return sides / LAYOUT_ONE_FACE == 2 && left != right;
}

/* A diagonal of the face at hand. */
struct layout_diagonal {
  uint32_t from, to; /* welded scene points, the lower first */
  uint32_t cut;      /* as edge_cut */
  uint32_t fold;     /* its number; SHEET_NONE: it is not drawn */
  uint8_t sides;     /* LAYOUT_... */
};

/* A diagonal that is a silhouette. */
struct layout_fold {
  struct layout_cut ends;
  uint32_t face;
};

struct layout {
  struct sheet *sheet;
  const struct scene *scene;
  const struct topology *topology;
  const recto_options *options;
  bool outlines;
  struct projection projection;
  uint32_t *point_map; /* scene point -> sheet point; SHEET_NONE: off the
                          paper, or welded away, or not used */
  uint8_t *outcode;    /* one a scene point: see clip.h */
  uint8_t *sides;      /* one a topology edge: LAYOUT_... */
  uint32_t *edge_cut;  /* topology edge -> cut; SHEET_NONE: not yet cut;
                          NULL while nothing was */
  ARRAY(struct layout_cut) cut;
  ARRAY(uint8_t) flags; /* one a triangle, the sheet's in the end */
  struct triangulation triangulation;
  ARRAY(struct layout_diagonal) diagonal; /* of one face */
  ARRAY(struct layout_fold) fold;
  ARRAY(uint32_t) corner; /* of one face, welded */
  recto_error *error;
};

/* The point that stands for a scene point. */
static inline uint32_t layout_weld(const struct layout *layout,
                                   uint32_t point) {
  const uint32_t *weld = layout->topology->weld;
  return weld ? weld[point] : point;
}

static inline struct view_point layout_view(const struct layout *layout,
                                            uint32_t point) {
  const struct scene_point *p = &layout->scene->point.item[point];
  return camera_view(&layout->sheet->camera, p->x, p->y, p->z);
}

/* All fail with RECTO_ERROR_MEMORY or RECTO_ERROR_LIMIT. */
USE_RESULT recto_status layout_points(struct layout *layout);
USE_RESULT recto_status layout_triangles(struct layout *layout);
USE_RESULT recto_status layout_edges(struct layout *layout);
USE_RESULT recto_status layout_wires(struct layout *layout);

/* Narrows the camera's depths to what is on the paper; a part of layout_points.
 * used  one a point */
USE_RESULT recto_status layout_range(struct layout *layout,
                                     const uint8_t *used);

/* Adds the sheet point of a point that clipping made. */
USE_RESULT recto_status layout_new_point(struct layout *layout,
                                         struct view_point at, uint32_t *point);

/* Cuts the segment between two scene points, the lower one of an edge first.
 * cut  its sheet points, or SHEET_NONE where nothing is left */
USE_RESULT recto_status layout_segment(struct layout *layout, uint32_t from,
                                       uint32_t to, struct layout_cut *cut);

/* Adds a contour. */
USE_RESULT recto_status layout_contour(struct layout *layout, uint32_t from,
                                       uint32_t to);

/* The cut of a topology edge, made when it is first asked for. */
USE_RESULT recto_status layout_edge_cut(struct layout *layout, uint32_t edge,
                                        struct layout_cut *cut);

#endif
