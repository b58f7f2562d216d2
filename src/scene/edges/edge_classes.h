/* edge_classes.h - which edges are borders, creases and borders of groups. */
#ifndef SCENE_EDGES_EDGE_CLASSES_H
#define SCENE_EDGES_EDGE_CLASSES_H

#include "scene/face_normal.h"
#include "scene/topology/topology.h"

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

/* A filter for edges that bend by more than the crease angle. */
struct crease_filter {
  const struct scene *scene;
  const struct face_direction *direction; /* one a face, borrowed */
  double crease_cosine;
  /* What crease_filter_cosine is of at least, at an edge of two faces that is
   * smooth and no more; INT_MAX where edges have other classes too, or none is
   * certain to be. */
  int smooth_from;
};

struct crease_filter crease_filter_of(const struct scene *scene,
                                      const struct face_direction *direction,
                                      double crease_deg);

/* The cosine at an edge of two faces, times the square of
 * FACE_DIRECTION_ONE. */
static inline int crease_filter_cosine(const struct crease_filter *filter,
                                       const struct topology_edge *edge) {
  struct face_direction a = filter->direction[edge->first];
  struct face_direction b = filter->direction[edge->second];
  int dot = a.x * b.x + a.y * b.y + a.z * b.z;
  return edge->same_way ? -dot : dot;
}

/* Whether an edge is certainly smooth and no more, as most are. */
static inline bool crease_filter_is_smooth(const struct crease_filter *filter,
                                           const struct topology_edge *edge) {
  return edge->uses == 2 &&
         crease_filter_cosine(filter, edge) >= filter->smooth_from;
}

/* topology_class_mask of an edge that files say nothing of. */
unsigned crease_filter_class_mask(const struct crease_filter *filter,
                                  const struct topology_edge *edge);

/* topology_class_mask for every edge at once.
 * class_masks  one an edge
 * Returns false when memory ran out. */
USE_RESULT bool topology_class_masks(const struct topology *topology,
                                     const struct scene *scene,
                                     double crease_deg, uint8_t *class_masks);

/* Whether a surface is not smooth at an edge of these classes. */
static inline bool topology_is_feature(const struct topology_edge *edge,
                                       unsigned class_mask) {
  return edge->uses != 2 || edge->same_way || edge->first == edge->second ||
         (class_mask & (RECTO_EDGE_CREASE | RECTO_EDGE_BORDER)) != 0;
}

/* Hysteresis: of the creases that edges form which are joined at points, makes
 * those no creases of which no edge bends by more than start_deg.
 * class_masks  one an edge, as of topology_class_masks at a smaller angle
 * Returns false when memory ran out. */
USE_RESULT bool topology_drop_weak_creases(const struct topology *topology,
                                           const struct scene *scene,
                                           double start_deg,
                                           uint8_t *class_masks);

/* Stores the result of topology_class_masks at that angle for later calls.
 * with_features  and which edges are features
 * Returns false when memory ran out. */
USE_RESULT bool topology_store_class_masks(struct topology *topology,
                                           const struct scene *scene,
                                           double crease_deg,
                                           bool with_features);

#endif
