/* sampler.h - decides by rays whether a point of an edge is visible. */
#ifndef JUDGE_SAMPLER_H
#define JUDGE_SAMPLER_H

#include "judge/edge_list.h"
#include "judge/ray.h"

struct judge_sampler {
  const struct judge_triangles *all;
  const struct judge_camera *camera;
  double ray_offset_mm; /* as in judge_options */
};

/* The size of ray_offset_mm in the scene plus the rounding of depths, at a
 * point of the scene, in scene units. */
double judge_rounding_at(const struct judge_camera *camera,
                         double ray_offset_mm, struct judge_point3 at);

/* Clips a segment to the page inside its margins: the parameters from *t0 to
 * *t1 are left; false where nothing is. */
bool judge_clip_to_page(const struct judge_camera *camera,
                        struct judge_point2 a, struct judge_point2 b,
                        double *t0, double *t1);

/* Leaves of the parameters from *t0 to *t1 of a segment those in the camera's
 * circle, if there is one; false where nothing is. */
bool judge_clip_to_circle(const struct judge_camera *camera,
                          struct judge_point2 a, struct judge_point2 b,
                          double *t0, double *t1);

/* The point of an edge whose image is at parameter t of the edge's image. */
struct judge_point3 judge_point3_of_image(const struct judge_edge *edge,
                                          double t);

/* The visibility of a point of an edge, by one ray. */
enum judge_visibility judge_sample_point(const struct judge_sampler *sampler,
                                         const struct judge_edge *edge,
                                         struct judge_point3 from);

/* The visibility by three rays: from the point and from ray_offset_mm to either
 * side.
 * Returns `expected` if all three have it, else the first other result.
 * blocker  set to a face that blocks a ray; may be NULL */
enum judge_visibility judge_sample_around(const struct judge_sampler *sampler,
                                          const struct judge_edge *edge,
                                          struct judge_point3 from,
                                          enum judge_visibility expected,
                                          uint32_t *blocker);

#endif
