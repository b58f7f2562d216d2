/* topology.h - which faces meet at which edge.
 *
 * An edge is an unordered pair of points.  Points of border edges that lie at
 * exactly the same position count as one (files with seams are stitched;
 * closed shells that only touch stay apart).
 */
#ifndef SCENE_TOPOLOGY_H
#define SCENE_TOPOLOGY_H

#include "scene/scene.h"

struct topology_edge {
  uint32_t point[2]; /* scene points, welded, point[0] < point[1] */
  /* The first two faces in file order; they fit, as each has three corners at
   * least (limit.h). */
  uint32_t first : 30;
  uint32_t uses : 2;     /* how many faces, capped at 3 */
  uint32_t second : 31;  /* TOPOLOGY_NONE: there is but one */
  uint32_t same_way : 1; /* of two faces: both run along it in one direction,
                            so their windings disagree */
};

enum { TOPOLOGY_NONE = 0x7fffffff, TOPOLOGY_FACE_BITS = (1 << 30) - 1 };

/* Adds a face to an edge that has one.
 * forward  it runs along it from its lower point to its upper one */
static inline void topology_use_edge(struct topology_edge *edge, uint32_t face,
                                     bool forward) {
  if (edge->uses == 1) {
    edge->second = face & TOPOLOGY_FACE_BITS;
    edge->same_way = edge->same_way == forward;
  }
  if (edge->uses < 3)
    edge->uses++;
}

struct topology {
  ARRAY(struct topology_edge) edge; /* in order of first use by a face */
  uint32_t *corner_edge; /* for corner c of a face, the edge from it to the
                            face's next corner; one per scene corner */
  uint8_t *class_masks;  /* of all edges at the angle crease_deg, as of
                            topology_class_masks; NULL: not kept */
  double crease_deg;
  bool drop_after_sheet; /* corner_edge may be freed once the sheet has its
                            triangles: it is not used later */
  uint32_t *weld;        /* point -> the point it is welded to; NULL where
                            nothing was welded */
};

/* Builds the edges of the scene.  Cost: linear in the corners. */
USE_RESULT recto_status topology_init(struct topology *topology,
                                      const struct scene *scene,
                                      recto_error *error);
void topology_fini(struct topology *topology);

/* Gives up corner_edge. */
void topology_drop_corners(struct topology *topology);

#endif
