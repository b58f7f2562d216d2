/* zero_finder.h - what the sources that find a zero set share. */
#ifndef VISIBILITY_ZERO_SET_ZERO_FINDER_H
#define VISIBILITY_ZERO_SET_ZERO_FINDER_H

#include "scene/triangulation/triangulate.h"
#include "view/clip.h"
#include "visibility/zero_set/folded_faces.h"
#include "visibility/zero_set/zero_segments.h"

struct zero_finder {
  struct zero_set *set;
  const struct facing *facing;
  struct folded_faces folded;
  struct curvature_noise curvature;
  struct projection projection;
  bool mesh_is_inside;         /* no face is clipped by the page's margins */
  struct ranked_set near_edge; /* the edges of near faces */
  uint32_t (*edge_node)[2]; /* one of these edges: its nodes, from 1 on, those
                               of the halves at its first and second point; at
                               features the first alone, or where normals are
                               split those of its first and its second face;
                               0: none */
  uint32_t *point_node;     /* one a scene point; NULL: none yet */
  struct {
    uint32_t (*item)[2];
    size_t count, capacity;
  } diagonal_node;        /* of the current face: likewise */
  ARRAY(uint32_t) corner; /* of the current face, welded */
  struct triangulation triangulation;
};

/* All return false when memory ran out. */

/* Adds a node between two slots; SHEET_NONE: at a vertex, or where clipping
 * cut.
 * at, flat  as of a contour_node */
USE_RESULT bool zero_finder_add_node(struct zero_finder *finder,
                                     const double at[3], const double flat[3],
                                     uint32_t front, uint32_t back,
                                     uint32_t *node);

/* The segments across a triangle of a face, if there are any.
 * corner  its corners; side[k] runs from corner[k] to the next */
USE_RESULT bool zero_finder_cross_triangle(struct zero_finder *finder,
                                           uint32_t face,
                                           const uint32_t corner[3],
                                           const uint32_t side[3]);

/* Adds a segment, clipped to the page unless the mesh is inside.  A node that
 * is outside gives way to a new one on the border. */
USE_RESULT bool zero_finder_add_segment(struct zero_finder *finder,
                                        struct contour_segment segment);

/* Adds the segments along a crease: where its two faces have different signs.
 * The nodes on the sides of its faces are known. */
USE_RESULT bool zero_finder_cross_crease(struct zero_finder *finder,
                                         uint32_t edge);

/* Adds the image of an edge at which the surface ends, or folds over where it
 * has no smooth contours; of no other. */
USE_RESULT bool zero_finder_add_border(struct zero_finder *finder,
                                       uint32_t edge);

/* Adds the image of an edge at which the faces of a smooth part fold over. */
USE_RESULT bool zero_finder_add_outline(struct zero_finder *finder,
                                        uint32_t edge);

/* The node of an edge, from 1 on, on the side of its first or second face; 0:
 * none. */
static inline uint32_t zero_finder_edge_node(const struct zero_finder *z,
                                             uint32_t edge, int k) {
  return ranked_set_has(&z->near_edge, edge)
             ? z->edge_node[ranked_set_rank(&z->near_edge, edge)][k]
             : 0;
}

/* Whether the two faces at an edge fold over there. */
bool zero_finder_folds_over(const struct facing *facing,
                            const struct topology_edge *edge);

static inline struct view_point zero_finder_view(const struct zero_finder *z,
                                                 const double at[3]) {
  return camera_view(z->facing->camera,
                     &(struct scene_point){at[0], at[1], at[2]});
}

#endif
