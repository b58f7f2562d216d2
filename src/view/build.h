/* build.h - what the phases of building a sheet share.
 *
 * Phases, in this order
 *   points     every used scene point on the paper becomes a sheet point.
 *   triangles  faces are triangulated, clipped, turned counter-clockwise; their
 *              sides name topology edges, and each edge learns on which of its
 *              sides its faces lie.
 *   edges      edges are classed, and where they are wanted made; then the
 *              sides of the triangles name sheet edges.
 *   wires      polylines become edges.
 * Invariants  A topology edge is cut once, by whichever phase asks first, from
 *   its lower to its upper point; all others take the points it got.
 */
#ifndef VIEW_BUILD_H
#define VIEW_BUILD_H

#include "view/clip.h"
#include "view/sheet.h"
#include "view/triangulate.h"

/* What is left of an edge or a diagonal that leaves the paper. */
struct build_cut {
  uint32_t point[2]; /* sheet points; SHEET_NONE both: nothing is left */
};

/* Where the faces of an edge or a diagonal lie, seen from its lower point to
 * its upper; the faces are counted above these bits, to three at most. */
enum {
  BUILD_LEFT = 1,
  BUILD_RIGHT = 2,
  BUILD_EDGE_ON = 4,
  BUILD_ONE_FACE = 8,
  BUILD_MOST_FACES = 3 * BUILD_ONE_FACE,
  /* Two faces, one on each side: neither an end of the projected faces nor a
   * fold. */
  BUILD_PLAIN = BUILD_LEFT | BUILD_RIGHT | 2 * BUILD_ONE_FACE
};

/* A line learns where a face with that sign on the page lies, which runs along
 * it from its lower point (forward) or from its upper one. */
static inline void build_learn(uint8_t *sides, bool forward, int sign) {
  static const uint8_t bit_of[3][2] = {{BUILD_LEFT, BUILD_RIGHT},
                                       {BUILD_EDGE_ON, BUILD_EDGE_ON},
                                       {BUILD_RIGHT, BUILD_LEFT}};
  *sides |= bit_of[sign + 1][forward];
  if (*sides < BUILD_MOST_FACES)
    *sides = (uint8_t)(*sides + BUILD_ONE_FACE);
}

/* A diagonal of the face at hand. */
struct build_diagonal {
  uint32_t from, to; /* welded scene points, in the order of its corners */
  uint32_t cut;      /* as edge_cut */
  uint8_t sides;     /* BUILD_... */
};

struct build {
  struct sheet *sheet;
  const struct scene *scene;
  const struct topology *topology;
  const recto_options *options;
  bool outlines;
  struct projection projection;
  uint32_t *point_map; /* scene point -> sheet point; SHEET_NONE: off the
                          paper, or welded away, or not used */
  uint8_t *outcode;    /* one a scene point: see clip.h */
  uint8_t *sides;      /* one a topology edge: BUILD_... */
  uint32_t *edge_cut;  /* topology edge -> cut; SHEET_NONE: not yet cut;
                          NULL while nothing was */
  ARRAY(struct build_cut) cut;
  ARRAY(uint8_t) flags; /* one a triangle, the sheet's in the end */
  struct triangulation triangulation;
  ARRAY(struct build_diagonal) diagonal; /* of one face */
  recto_error *error;
};

/* The point that stands for a scene point. */
static inline uint32_t build_weld(const struct build *build, uint32_t point) {
  const uint32_t *weld = build->topology->weld;
  return weld ? weld[point] : point;
}

static inline struct view_point build_view(const struct build *build,
                                           uint32_t point) {
  const struct scene_point *p = &build->scene->point.item[point];
  return camera_view(&build->sheet->camera, p->x, p->y, p->z);
}

/* All fail with RECTO_ERROR_MEMORY or RECTO_ERROR_LIMIT. */
USE_RESULT recto_status build_points(struct build *build);
USE_RESULT recto_status build_triangles(struct build *build);
USE_RESULT recto_status build_edges(struct build *build);
USE_RESULT recto_status build_wires(struct build *build);

/* Adds the sheet point of a point that clipping made. */
USE_RESULT recto_status build_new_point(struct build *build,
                                        struct view_point at, uint32_t *point);

/* Cuts the segment between two scene points, the lower one of an edge first.
 * cut  its sheet points, or SHEET_NONE where nothing is left */
USE_RESULT recto_status build_segment(struct build *build, uint32_t from,
                                      uint32_t to, struct build_cut *cut);

/* Adds a contour. */
USE_RESULT recto_status build_contour(struct build *build, uint32_t from,
                                      uint32_t to);

/* The cut of a topology edge, made when it is first asked for. */
USE_RESULT recto_status build_edge_cut(struct build *build, uint32_t edge,
                                       struct build_cut *cut);

#endif
