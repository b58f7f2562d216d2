/* coarse_parts.h - which parts of a mesh sample no smooth surface. */
#ifndef SCENE_EDGES_COARSE_PARTS_H
#define SCENE_EDGES_COARSE_PARTS_H

#include "scene/topology/topology.h"

/* Finds the connected parts of the mesh of whose edges more than a quarter are
 * creases: such a part samples no smooth surface.
 * class_masks  one an edge
 * coarse       gets 1 for each point of such a part, 0 for the others
 * Returns false when memory ran out. */
USE_RESULT bool topology_coarse_parts(const struct topology *topology,
                                      const struct scene *scene,
                                      const uint8_t *class_masks,
                                      uint8_t *coarse);

/* Stores the result of topology_coarse_parts with these classes for later
 * calls.  Returns false when memory ran out. */
USE_RESULT bool topology_store_coarse_parts(struct topology *topology,
                                            const struct scene *scene);

#endif
