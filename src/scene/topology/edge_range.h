/* edge_range.h - the edges of a range of the scene's faces. */
#ifndef SCENE_TOPOLOGY_EDGE_RANGE_H
#define SCENE_TOPOLOGY_EDGE_RANGE_H

#include "scene/topology/edge_lists.h"

/* Finds the edges.  Where lists are overfull, it is to be done again for all
 * faces at once, with hubs.
 * with_hubs  whether points of many sides are looked for first
 * Returns false when memory ran out, or a poll was false. */
USE_RESULT bool edge_range_find(struct edge_range *range, bool with_hubs);

/* The edge between two points; SCENE_NONE: the range has none. */
static inline uint32_t edge_range_look_up(const struct edge_range *range,
                                          const uint32_t point[2]) {
  uint32_t e = range->head[point[0]];
  while (e != SCENE_NONE && range->edge.item[e].point[1] != point[1])
    e = range->next[e];
  return e;
}

/* How many corners its faces have. */
static inline size_t edge_range_corners(const struct edge_range *range) {
  return scene_face_start(range->scene, range->end_face) -
         scene_face_start(range->scene, range->face);
}

/* Frees what edge_range_look_up needs. */
void edge_range_drop_lists(struct edge_range *range);

void edge_range_fini(struct edge_range *range);

#endif
