/* triangulate.h - cuts a polygon into triangles without adding points. */
#ifndef VIEW_TRIANGULATE_H
#define VIEW_TRIANGULATE_H

#include "scene/scene.h"
#include "view/blockers.h"

/* Corners are counted from 0 within the polygon.  Side k runs from corner[k]
 * to corner[(k + 1) % 3]; below the polygon's number of corners it is the
 * polygon's side that leaves that corner, or one at the same two places; else
 * that number plus the diagonal's own, from 0. */
struct triangulation_triangle {
  uint32_t corner[3];
  uint32_t side[3];
};

/* A corner on its way through the ear clipping. */
struct triangulation_corner {
  double at[2];        /* in the plane that shows most of the polygon, which
                          runs counter-clockwise there */
  double length;       /* of the diagonal past it, squared and rounded */
  uint32_t next, prev; /* of the corners that are left */
  uint32_t side;       /* what leaves it: see above */
  uint32_t slot;       /* in the queue, from 1; 0: not in it */
  int8_t turn;  /* 1 convex, 0 straight on or back, -1 reflex, 2 cut off */
  uint8_t rank; /* in the queue: see triangulate.c */
};

struct triangulation {
  ARRAY(struct triangulation_triangle) triangle;
  bool warped; /* a corner is off the polygon's plane */
  /* Kept from call to call. */
  ARRAY(struct triangulation_corner) corner;
  ARRAY(uint32_t) queue; /* a heap of corners that may be cut off */
  ARRAY(uint32_t) same;  /* of each side, one that runs where it does */
  struct blockers blockers;
};

/* Zero-initialised is empty; one object serves any number of polygons. */
void triangulation_fini(struct triangulation *triangulation);

/* Sets the triangles of a polygon: two fewer than it has corners, or fewer
 * still where corners repeat or the polygon turns back on itself.
 * corner  indices of points, `count` >= 3
 * Returns false when memory ran out.
 * Guarantees: the corners of a triangle are at three places; triangles run as
 *   the polygon does, and each of its sides belongs to one of them, but for
 *   sides that go there and back.  A simple polygon, corners on straight sides
 *   and holes on double bridges included, is covered exactly once by triangles
 *   that have an area; of others something is made that ends and is always the
 *   same.  Where the polygon starts and which way it winds do not matter, nor
 *   that it is mirrored, but where two diagonals are equally long.
 * Exact: decided on the coordinates themselves, in a plane along two axes.
 * Cost: n log n but for many long needles side by side: each corner asks a few
 *   times which reflex corners are near it. */
USE_RESULT bool triangulate(struct triangulation *triangulation,
                            const struct scene_point *point,
                            const uint32_t *corner, size_t count);

#endif
