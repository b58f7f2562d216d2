/* triangulate.h - triangulates a polygon in space by ear clipping. */
#ifndef VIEW_TRIANGULATE_H
#define VIEW_TRIANGULATE_H

#include "scene/scene.h"
#include "view/reflex_tree.h"

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
  double at[2];        /* in the projection, see polygon_flatten */
  double length;       /* squared length, rounded, of the diagonal that cuts it
                          off */
  uint32_t next, prev; /* among the corners that are left */
  uint32_t side;       /* the side that starts here: see above */
  uint32_t slot;       /* in the queue, from 1; 0: not in it */
  int8_t turn;  /* 1 convex, 0 straight or a spike, -1 reflex, 2 cut off */
  uint8_t rank; /* in the queue: see ear_clipping.c */
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

/* Zero-initialised is empty; one object serves any number of polygons. */
void triangulation_fini(struct triangulation *triangulation);

/* Sets the triangles of a polygon: two fewer than it has corners, or fewer
 * where corners are repeated or sides run back over each other.
 * corner  indices of points, `count` >= 3
 * Returns false when memory ran out.
 * Guarantees
 *   The corners of a triangle have three different positions.
 *   Triangles have the polygon's orientation, and each side of the polygon
 *   belongs to one of them, except sides that run back over each other.
 *   A simple polygon is covered exactly once by triangles that have an area;
 *   it may have corners on straight sides, and holes joined by double bridges.
 *   Other polygons get some triangulation, always the same one.
 *   The result does not depend on the first corner, the winding or mirroring,
 *   except where two diagonals have equal lengths.
 * Exact  all decisions are exact on the input coordinates, projected along an
 *   axis.
 * Cost   n log n, except where many long thin parts lie side by side: each
 *   corner queries a few times which reflex corners are near it. */
USE_RESULT bool triangulate(struct triangulation *triangulation,
                            const struct scene_point *point,
                            const uint32_t *corner, size_t count);

#endif
