/* clipped_triangle.h - the part of a triangle that is drawn. */
#ifndef JUDGE_CLIPPED_TRIANGLE_H
#define JUDGE_CLIPPED_TRIANGLE_H

#include "judge/triangles.h"

struct judge_camera;

/* A triangle clipped by five planes has at most eight corners. */
struct judge_clipped_triangle {
  struct judge_point3 p[8];
  unsigned count;
};

/* The part of a triangle within the page's margins and in front of the near
 * plane. */
struct judge_clipped_triangle
judge_clip_triangle(const struct judge_camera *camera,
                    const struct judge_triangle *t);

#endif
