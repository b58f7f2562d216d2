/* cut_edges.h - the lines along which planes cut surfaces, and where the planes
 * of a cut meet within solids. */
#ifndef JUDGE_CUT_EDGES_H
#define JUDGE_CUT_EDGES_H

#include "judge/edge_list.h"
#include "judge/ray.h"

/* Adds these edges, if anything is removed: also such as lie within solids, and
 * lines where planes meet outside of them.  Returns false when memory ran
 * out. */
USE_RESULT bool judge_edges_add_cuts(struct judge_edges *edges,
                                     const struct judge_triangles *all,
                                     const struct judge_camera *camera);

/* Whether a point of such an edge is on the outline of a cut face: clear where
 * it is, blocked where it is not; clear for all other edges.
 * beside  a distance, scene units, at which it is tested what is beside it */
enum judge_visibility judge_cut_exists(const struct judge_triangles *all,
                                       const struct judge_edge *edge,
                                       struct judge_point3 at, double beside);

/* Whether a cut face hides a point from the eye.
 * ray  from that point */
enum judge_visibility judge_cut_hides(const struct judge_triangles *all,
                                      const struct judge_ray *ray);

#endif
