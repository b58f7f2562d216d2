/* edges.h - finds the edges of a scene and decides their classes. */
#ifndef JUDGE_EDGES_H
#define JUDGE_EDGES_H

#include "judge/edge_list.h"
#include "judge/options.h"
#include "judge/triangles.h"

/* Finds the sides of faces, folds, wires and intersections.  A class that
 * doubles cannot decide is left out.  Returns false when memory ran out. */
USE_RESULT bool judge_edges_init(struct judge_edges *edges,
                                 const struct judge_triangles *all,
                                 const struct judge_camera *camera,
                                 const struct judge_options *options);

#endif
