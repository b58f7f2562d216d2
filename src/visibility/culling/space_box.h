/* space_box.h - where a box in space lies on the page, and how near it is.
 *
 * No point of the box is projected outside of its box on the page, and none is
 * nearer than the planes of the sides that the viewer is in front of, or
 * farther than those of the others.
 */
#ifndef VISIBILITY_CULLING_SPACE_BOX_H
#define VISIBILITY_CULLING_SPACE_BOX_H

#include <math.h>

#include "view/project.h"
#include "visibility/predicate/box2.h"

/* A depth that is linear on the page: at + per_x x + per_y y. */
struct depth_bound {
  double at, per_x, per_y;
};

struct space_box {
  struct box2 page;
  double nearest; /* depth units */
  struct depth_bound front[3], back[6];
  int fronts, backs;
};

/* Projects the box from `low` to `high`, in scene units.  Returns false where a
 * part of it is in front of the near plane of a perspective view. */
USE_RESULT bool space_box_project(struct space_box *box,
                                  const struct camera *camera,
                                  const struct projection *projection,
                                  const double low[3], const double high[3]);

/* The range of depths of what is in the box over a window of the page; empty,
 * high < low: nothing is. */
struct box_depths {
  double low, high;
};

static inline struct box_depths space_box_depths(const struct space_box *box,
                                                 double x0, double y0,
                                                 double x1, double y1) {
  struct box_depths range = {-INFINITY, box->nearest};
  for (int i = 0; i < box->fronts; i++) {
    const struct depth_bound *side = &box->front[i];
    double most = side->at + side->per_x * (side->per_x > 0 ? x1 : x0) +
                  side->per_y * (side->per_y > 0 ? y1 : y0);
    range.high = most < range.high ? most : range.high;
  }
  for (int i = 0; i < box->backs; i++) {
    const struct depth_bound *side = &box->back[i];
    double least = side->at + side->per_x * (side->per_x > 0 ? x0 : x1) +
                   side->per_y * (side->per_y > 0 ? y0 : y1);
    range.low = least > range.low ? least : range.low;
  }
  return range;
}

#endif
