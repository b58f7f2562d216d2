/* sampler.h - what the judge makes of a point of an edge. */
#ifndef JUDGE_SAMPLER_H
#define JUDGE_SAMPLER_H

#include "judge/edge_list.h"
#include "judge/ray.h"

struct judge_sampler {
  const struct judge_triangles *all;
  const struct judge_camera *camera;
  double hair_mm; /* as in judge_options */
};

/* What the hair by which rays are moved aside, and the rounding of depths, are
 * at a spot, in scene units. */
double judge_rounding_at(const struct judge_camera *camera, double hair_mm,
                         struct judge_point3 at);

/* Cuts a segment to the page inside its margins, from *t0 to *t1 of its way; false where nothing
 * is left. */
bool judge_clip_to_page(const struct judge_camera *camera,
                        struct judge_point2 a, struct judge_point2 b,
                        double *t0, double *t1);

/* The spot of an edge whose image is at t of the way along its image. */
struct judge_point3 judge_point3_of_image(const struct judge_edge *edge,
                                          double t);

/* What a point of an edge sees, by itself alone. */
enum judge_visibility judge_sample_point(const struct judge_sampler *sampler,
                                         const struct judge_edge *edge,
                                         struct judge_point3 from);

/* What it sees by itself and a hair to either side, as long as the answers are
 * `expected`; the first other one is the answer. */
enum judge_visibility judge_sample_around(const struct judge_sampler *sampler,
                                          const struct judge_edge *edge,
                                          struct judge_point3 from,
                                          enum judge_visibility expected,
                                          uint32_t *blocker);

#endif
