/* ray.h - casts a ray from a point of an edge to the eye.
 *
 * A triangle hides the point if the ray meets it and its plane is farther from
 * the point than the contact tolerance.  If an end of the edge is a corner of
 * the triangle, the plane passes through that end, and points near it would
 * count as visible whatever the edge's direction.  Such a triangle hides all of
 * the edge that it covers, or nothing: the distance to its plane is measured at
 * the edge's other end, or where the edge leaves the triangle. */
#ifndef JUDGE_RAY_H
#define JUDGE_RAY_H

#include "judge/camera.h"
#include "judge/triangles.h"

enum judge_visibility { JUDGE_CLEAR, JUDGE_UNSURE, JUDGE_BLOCKED };

/* Error bounds of the distance from a point to a plane, scene units. */
struct judge_error_bound {
  double rounding;    /* of the point, on the page and in depth */
  double plane_error; /* a plane this close to the point may pass on either side
                         of it, or through it */
};

/* An end of an edge. */
struct judge_end {
  struct judge_point3
      position;            /* equal to a corner of the scene in all bits, or to
                              none */
  struct judge_point3 cut; /* the same, or where the page's border cuts the
                              edge */
  bool is_cut;
  double near; /* upper bound of its rounding error */
  struct judge_error_bound margin, cut_margin;
};

struct judge_ray {
  const struct judge_camera *camera;
  struct judge_point3 from, towards;
  double t_max; /* the ray is from + t towards, 0 < t < t_max */
  double sure;  /* for t above it the near plane may have clipped what is met */
  struct judge_error_bound margin;
  uint32_t own[2]; /* faces of the edge */
  struct judge_end end[2];
};

/* Casts a ray.
 * face  set to the face that blocks it, where one does; may be NULL */
enum judge_visibility judge_cast_ray(const struct judge_triangles *all,
                                     const struct judge_ray *ray,
                                     uint32_t *face);

#endif
