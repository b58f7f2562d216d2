/* ray.h - what a point of an edge sees: the judge's rays.
 *
 * A triangle hides the point where a ray from there to the eye meets it and
 * its plane is far enough from the point.  Where the triangle has an end of
 * the edge for a corner, its plane goes through that end, and points close to
 * it would see past the triangle however the edge runs.  Such a triangle hides
 * as much of the edge as it covers, or nothing: how far its plane is counts at
 * the edge's other end, or where it leaves the triangle. */
#ifndef JUDGE_RAY_H
#define JUDGE_RAY_H

#include "judge/judge.h"

enum judge_visibility { JUDGE_CLEAR, JUDGE_UNSURE, JUDGE_BLOCKED };

/* What may be the matter with how far a plane is from a spot, scene units. */
struct judge_margin {
  double rounding; /* of the spot, on the page and in depth */
  double blur;     /* where the spot should lie on the plane: planes this near
                      may be on either side of it */
};

/* An end of an edge. */
struct judge_end {
  struct judge_point3
      position;            /* a corner of the scene to the last bit, or none */
  struct judge_point3 cut; /* the same, or where the page ends before */
  bool is_cut;
  double near; /* how far rounding may move it */
  struct judge_margin margin, cut_margin;
};

struct judge_ray {
  const struct judge_camera *camera;
  struct judge_point3 from, towards;
  double reach; /* seen is from + t towards, 0 < t < reach */
  double sure;  /* beyond it the near plane may have cut off what is met */
  struct judge_margin margin;
  uint32_t own[2]; /* faces of the edge */
  struct judge_end end[2];
};

/* What is seen.
 * face  of what blocks, set where something does; NULL: not wanted */
enum judge_visibility judge_cast_ray(const struct judge_triangles *all,
                                     const struct judge_ray *ray,
                                     uint32_t *face);

#endif
