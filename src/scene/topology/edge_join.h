/* edge_join.h - the edges of a range of faces, found by several workers. */
#ifndef SCENE_TOPOLOGY_EDGE_JOIN_H
#define SCENE_TOPOLOGY_EDGE_JOIN_H

#include "scene/topology/edge_lists.h"

/* Finds the edges as edge_range_find does without hubs, but by so many workers,
 * at least two, each of which takes a range of the faces; sides refer to edges,
 * and nothing is put off.
 * all  all faces of the scene; gets no lists
 * Returns false when memory ran out, the caller cancelled, or a range, and so
 * all, is overfull. */
USE_RESULT bool edge_join_find(struct edge_range *all, int workers);

#endif
