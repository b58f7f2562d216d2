/* intersections.h - the lines along which faces intersect. */
#ifndef JUDGE_INTERSECTIONS_H
#define JUDGE_INTERSECTIONS_H

#include "judge/edge_list.h"
#include "judge/triangles.h"

/* Adds the intersection of every two triangles of different faces that pierce
 * each other.  Returns false when memory ran out. */
USE_RESULT bool judge_edges_add_intersections(struct judge_edges *edges,
                                              const struct judge_triangles *all,
                                              const struct judge_camera *camera,
                                              double ray_offset_mm);

#endif
