/* triangulation.h - a polygon's triangles, and the state of ear clipping. */
#ifndef SCENE_TRIANGULATION_TRIANGULATION_H
#define SCENE_TRIANGULATION_TRIANGULATION_H

#include "scene/exact.h"
#include "scene/triangulation/reflex_tree.h"

/* Corners are numbered from 0 within the polygon.  Side k runs from corner[k]
 * to corner[(k + 1) % 3].  A number below the polygon's number of corners, n,
 * is the polygon's side that starts at that corner, or one between the same two
 * positions; n + d is diagonal d. */
struct triangulation_triangle {
  uint32_t corner[3];
  uint32_t side[3];
};

/* A corner's state during ear clipping. */
struct triangulation_corner {
  double at[2];        /* in the projection, see polygon_project */
  double length;       /* squared length, rounded, of the diagonal that cuts it
                          off */
  uint32_t next, prev; /* among the corners that are left */
  uint32_t side;       /* the side that starts here: see above */
  uint32_t slot;       /* in the queue, from 1; 0: not in it */
  uint32_t blocker;    /* a corner found in its ear before; itself: none */
  int8_t turn;      /* 1 convex, 0 straight or a spike, -1 reflex, 2 cut off */
  uint8_t priority; /* in the queue: see ear_clipping.c */
};

struct triangulation {
  ARRAY(struct triangulation_triangle) triangle;
  bool warped;      /* the polygon is not planar */
  double off_plane; /* polygon_off_plane */
  /* Work space, kept from call to call. */
  ARRAY(struct triangulation_corner) corner;
  ARRAY(uint32_t) queue; /* a heap of corners that may be ears */
  ARRAY(uint32_t) same;  /* for each side, another between the same two
                            positions, or itself (union-find) */
  struct reflex_tree tree;
};

static inline int triangulation_turn(const struct triangulation_corner *corner,
                                     uint32_t a, uint32_t b, uint32_t c) {
  return exact_orient2d(corner[a].at, corner[b].at, corner[c].at);
}

static inline void triangulation_add(struct triangulation *triangulation,
                                     uint32_t a, uint32_t b, uint32_t c,
                                     uint32_t ab, uint32_t bc, uint32_t ca) {
  triangulation->triangle.item[triangulation->triangle.count++] =
      (struct triangulation_triangle){{a, b, c}, {ab, bc, ca}};
}

#endif
