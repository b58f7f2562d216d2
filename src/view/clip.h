/* clip.h - clips segments and triangles to the printable area and the near
 * plane.
 *
 * Clipping is done in view coordinates, before the division by depth.  The
 * printable area is enlarged by SHEET_BLEED grid units, and by half of one: a
 * point that rounds to its border counts as inside, so that rounding never cuts
 * a drawing that fits. */
#ifndef VIEW_CLIP_H
#define VIEW_CLIP_H

#include "view/project.h"

/* In the order of clipping.  The near plane comes first, so that the others
 * handle positive depths only. */
enum clip_plane {
  CLIP_NEAR,
  CLIP_LEFT,
  CLIP_RIGHT,
  CLIP_BOTTOM,
  CLIP_TOP,
  CLIP_PLANE_COUNT
};

/* Where this bit of an outcode is set the others have no meaning. */
enum { CLIP_NEAR_BIT = 1 << CLIP_NEAR };

/* Where a point is along an axis of the page, and how far the printable area
 * reaches there on both sides, in units that grow with its depth. */
struct clip_reach {
  double at, half;
};

static inline struct clip_reach
clip_reach_of(const struct projection *projection, struct view_point p,
              int axis) {
  double depth = projection->perspective ? p.d : 1;
  return (struct clip_reach){(axis ? p.y : p.x) * projection->units +
                                 projection->offset[axis] * depth,
                             (projection->half[axis] + 0.5) * depth};
}

/* A linear function of the point that is negative outside the plane. */
static inline double clip_distance(const struct projection *projection,
                                   struct view_point p, int plane) {
  if (plane == CLIP_NEAR)
    return p.d - projection->near_d;
  struct clip_reach reach = clip_reach_of(projection, p, plane >= CLIP_BOTTOM);
  return plane == CLIP_LEFT || plane == CLIP_BOTTOM ? reach.half + reach.at
                                                    : reach.half - reach.at;
}

/* The Cohen-Sutherland outcode: bit k is set where the point is outside plane
 * k.  Written out, as compilers leave a loop over the planes. */
static inline uint8_t clip_outcode(const struct projection *projection,
                                   struct view_point p) {
  struct clip_reach x = clip_reach_of(projection, p, 0),
                    y = clip_reach_of(projection, p, 1);
  return (uint8_t)(!(p.d - projection->near_d >= 0) << CLIP_NEAR |
                   !(x.half + x.at >= 0) << CLIP_LEFT |
                   !(x.half - x.at >= 0) << CLIP_RIGHT |
                   !(y.half + y.at >= 0) << CLIP_BOTTOM |
                   !(y.half - y.at >= 0) << CLIP_TOP);
}

/* Clips a segment.
 * end    in the segment's canonical direction: the same two points in the same
 *        order give the same result, bit for bit
 * moved  set for each end: whether clipping made it a new point
 * Returns false where nothing, or a single point, is left. */
bool clip_segment(const struct projection *projection, struct view_point end[2],
                  bool moved[2]);

enum {
  /* The most corners of a clipped triangle.  A plane adds one corner to a
   * convex polygon, and to one that rounding made slightly non-convex at most
   * half as many as it has: 3, 4, 6, 9, 13, 19. */
  CLIP_CORNERS_MAX = 19,
  CLIP_CUT = 3 /* a corner or side that clipping made */
};

struct clip_corner {
  struct view_point at;
  uint8_t origin; /* 0 to 2: that corner of the triangle; CLIP_CUT */
  uint8_t side;   /* the side that starts here, 0 to 2 as of the triangle;
                     CLIP_CUT */
};

struct clip_polygon {
  struct clip_corner corner[CLIP_CORNERS_MAX];
  int count;
};

/* Clips a triangle.  Its sides are clipped to the very points that clip_segment
 * computes, and removed where it returns false.
 * corner   its corners; side k runs from corner k to k + 1
 * forward  whether side k runs in its canonical direction
 * polygon  what is left: convex, of the same orientation
 * Returns false where nothing with three corners is left. */
bool clip_triangle(const struct projection *projection,
                   const struct view_point corner[3], const bool forward[3],
                   struct clip_polygon *polygon);

#endif
