/* edge_classes.h - which edges are borders, creases and borders of groups. */
#ifndef SCENE_EDGE_CLASSES_H
#define SCENE_EDGE_CLASSES_H

#include "scene/topology.h"

/* Whether an edge lies in a plane by which the scene was cut. */
bool topology_is_in_cut(const struct scene *scene,
                        const struct topology_edge *edge);

/* The class that an edge is drawn as, of those that it is. */
static inline unsigned topology_class_of_mask(unsigned class_mask) {
  return class_mask & RECTO_EDGE_SECTION ? RECTO_EDGE_SECTION
                                         : class_mask & (~class_mask + 1);
}

/* The classes of an edge that do not depend on the camera, a mask of
 * RECTO_EDGE_BORDER (one face or more than two), RECTO_EDGE_CREASE (angle
 * between the two faces' normals beyond crease_deg; where the winding of the
 * two disagrees one is turned) and RECTO_EDGE_GROUP (two groups meet);
 * RECTO_EDGE_SMOOTH alone where it has none of them.  In a scene that was cut
 * RECTO_EDGE_SECTION too, where a surface was; and none at all of an edge
 * within a cut face, or within a face of the scene that was cut. */
unsigned topology_class_mask(const struct topology *topology,
                             const struct scene *scene, uint32_t edge,
                             double crease_deg);

/* The same for several edges: two normals bend by more than the crease angle
 * where their cosine is below this one. */
double topology_crease_cosine(double crease_deg);
unsigned topology_class_mask_by_cosine(const struct topology *topology,
                                       const struct scene *scene, uint32_t edge,
                                       double crease_cosine);

/* topology_class_mask for every edge at once.
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

/* Stores the result of topology_class_masks at that angle for later calls.
 * Returns false when memory ran out. */
USE_RESULT bool topology_store_class_masks(struct topology *topology,
                                           const struct scene *scene,
                                           double crease_deg);

#endif
