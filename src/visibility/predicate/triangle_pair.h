/* triangle_pair.h - how two triangles lie to each other: disjoint on the page,
 * in contact, or one nearer than the other. */
#ifndef VISIBILITY_PREDICATE_TRIANGLE_PAIR_H
#define VISIBILITY_PREDICATE_TRIANGLE_PAIR_H

#include "geom/convex.h"
#include "view/sheet.h"

/* Where triangle g is nearer than triangle f, within the part of the page that
 * both cover. */
enum depth_order {
  NEARER_NEVER,  /* nowhere: f is seen wherever they overlap */
  NEARER_ALWAYS, /* everywhere: g is seen */
  NEARER_ON_LEFT /* on the left of the line where the planes intersect */
};

struct triangle_plane {
  struct geom_point p[3];
  struct geom_plane plane;
};

struct triangle_plane triangle_plane_of(const struct sheet *sheet,
                                        uint32_t triangle);

/* Do the interiors of two triangles, counter-clockwise and not edge-on, have no
 * point of the page in common?  Those of neighbours have none, and most
 * triangles near a face are its neighbours.  Exact. */
bool triangles_disjoint(const struct sheet *sheet, uint32_t f, uint32_t g);

/* The same of triangles whose corners are at hand. */
bool triangle_corners_disjoint(const struct geom_point f[3],
                               const struct geom_point g[3]);

/* Returns false only if segment pq has no point inside triangle f: a
 * conservative test. */
bool triangle_may_meet_segment(const struct geom_point f[3],
                               struct geom_point p, struct geom_point q);

/* The lines through the sides of a triangle, which lies on their left, and the
 * same lines reversed. */
void triangle_lines(const struct sheet *sheet, uint32_t triangle,
                    struct geom_line line[3], struct geom_line reversed[3]);

/* The triangle as a piece of itself.  Returns false when memory ran out. */
USE_RESULT bool triangle_as_convex(const struct sheet *sheet, uint32_t triangle,
                                   struct geom_convex *piece,
                                   struct arena *arena);

/* On which sides of a plane the corners p lie.  Exact.
 * Returns a mask; 0 where all corners are on the plane. */
enum { PLANE_BEHIND = 1, PLANE_IN_FRONT = 2 };
int plane_sides(const struct geom_plane *plane, const struct geom_point p[3]);

/* Compares two triangles by exact depth; of coplanar ones that with the lower
 * index is the nearer.
 * line, reversed  set for NEARER_ON_LEFT: g is nearer on the left of `line` */
enum depth_order triangle_depth_order(const struct triangle_plane *f,
                                      uint32_t f_id,
                                      const struct triangle_plane *g,
                                      uint32_t g_id, struct geom_line *line,
                                      struct geom_line *reversed);

/* Are all corners of one triangle in contact with the other's plane?  Exact. */
bool triangles_touch(const struct sheet *sheet, uint32_t f, uint32_t g);

#endif
