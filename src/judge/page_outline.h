/* page_outline.h - the part of a triangle that is drawn. */
#ifndef JUDGE_PAGE_OUTLINE_H
#define JUDGE_PAGE_OUTLINE_H

#include "judge/triangles.h"

struct judge_camera;

/* A triangle clipped by five planes has at most eight corners. */
struct judge_outline {
  struct judge_point3 p[8];
  unsigned count;
};

/* The part of a triangle within the page's margins and in front of the near
 * plane. */
struct judge_outline judge_outline_on_page(const struct judge_camera *camera,
                                           const struct judge_triangle *t);

#endif
