/* topology.h - which faces meet at which edge, and which edges are features.
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

enum { TOPOLOGY_NONE = 0x7fffffff };

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

/* The classes of an edge that do not depend on the camera, a mask of
 * RECTO_EDGE_BORDER (one face or more than two), RECTO_EDGE_CREASE (angle
 * between the two faces' normals beyond crease_deg; where the winding of the
 * two disagrees one is turned) and RECTO_EDGE_GROUP (two groups meet);
 * RECTO_EDGE_SMOOTH alone where it has none of them. */
unsigned topology_class_mask(const struct topology *topology,
                             const struct scene *scene, uint32_t edge,
                             double crease_deg);

/* The same for every edge at once.
 * class_masks  one an edge
 * Returns false when memory ran out. */
USE_RESULT bool topology_class_masks(const struct topology *topology,
                                     const struct scene *scene,
                                     double crease_deg, uint8_t *class_masks);

/* Hysteresis: of the creases that edges form which are joined at points, makes
 * those no creases of which no edge bends by more than start_deg.
 * class_masks  one an edge, as of topology_class_masks at a smaller angle
 * Returns false when memory ran out. */
USE_RESULT bool topology_drop_weak_creases(const struct topology *topology,
                                           const struct scene *scene,
                                           double start_deg,
                                           uint8_t *class_masks);

/* Finds the connected parts of the mesh of whose edges more than a quarter are
 * creases: such a part samples no smooth surface.
 * class_masks  one an edge
 * coarse       gets 1 for each point of such a part, 0 for the others
 * Returns false when memory ran out. */
USE_RESULT bool topology_coarse_parts(const struct topology *topology,
                                      const struct scene *scene,
                                      const uint8_t *class_masks,
                                      uint8_t *coarse);

/* Keeps the result of topology_class_masks at that angle for later calls.
 * Returns false when memory ran out. */
USE_RESULT bool topology_keep_class_masks(struct topology *topology,
                                          const struct scene *scene,
                                          double crease_deg);

#endif
