/* clip.h - the part of a segment or a triangle that is on the paper and not
 * before the near plane.
 *
 * Everything happens in view coordinates, before the division by depth.  The
 * paper is taken half a grid unit wider than it is: what rounds onto it counts
 * as on it, so that a drawing which fits the page is never cut by rounding. */
#ifndef VIEW_CLIP_H
#define VIEW_CLIP_H

#include "view/project.h"

/* In the order in which they cut: before the near plane comes first, so that
 * the others see positive depths alone. */
enum clip_plane {
  CLIP_NEAR,
  CLIP_LEFT,
  CLIP_RIGHT,
  CLIP_BOTTOM,
  CLIP_TOP,
  CLIP_PLANE_COUNT
};

/* The bit of an outcode without which the others mean nothing. */
enum { CLIP_NEAR_BIT = 1 << CLIP_NEAR };

/* A linear function of the point that is negative outside of the plane. */
static inline double clip_distance(const struct projection *projection,
                                   struct view_point p, int plane) {
  if (plane == CLIP_NEAR)
    return p.d - projection->near_d;
  int axis = plane >= CLIP_BOTTOM;
  double depth = projection->perspective ? p.d : 1;
  double at =
      (axis ? p.y : p.x) * projection->units + projection->offset[axis] * depth;
  double reach = (projection->half[axis] + 0.5) * depth;
  return plane == CLIP_LEFT || plane == CLIP_BOTTOM ? reach + at : reach - at;
}

/* One bit for each plane that the point is outside of. */
static inline uint8_t clip_outcode(const struct projection *projection,
                                   struct view_point p) {
  unsigned code = 0;
  for (int plane = 0; plane < CLIP_PLANE_COUNT; plane++)
    code |= (unsigned)!(clip_distance(projection, p, plane) >= 0) << plane;
  return (uint8_t)code;
}

/* Clips a segment.
 * end    in the direction that its owner holds canonical: the same two points
 *        in the same order give the same result, bit for bit
 * moved  set for each end: it is a new point
 * Returns false where nothing is left, or a point alone. */
bool clip_segment(const struct projection *projection, struct view_point end[2],
                  bool moved[2]);

/* A plane adds one corner to a convex polygon; if rounding made it wavy, half
 * as many as there are at most: 3, 4, 6, 9, 13, 19. */
enum { CLIP_MOST = 19, CLIP_CUT = 3 };

struct clip_corner {
  struct view_point at;
  uint8_t origin; /* 0 to 2: a corner of the triangle; CLIP_CUT: new */
  uint8_t side;   /* what leaves it: 0 to 2, a side of the triangle; CLIP_CUT */
};

struct clip_polygon {
  struct clip_corner corner[CLIP_MOST];
  int count;
};

/* Clips a triangle.  Its sides are cut where clip_segment cuts them, and are
 * wholly gone where it says so.
 * corner   its corners; side k runs from corner k to k + 1
 * forward  whether side k runs in its canonical direction
 * polygon  what is left, in the same direction, convex
 * Returns false where nothing with three corners is left. */
bool clip_triangle(const struct projection *projection,
                   const struct view_point corner[3], const bool forward[3],
                   struct clip_polygon *polygon);

#endif
