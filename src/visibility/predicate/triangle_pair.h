/* triangle_pair.h - which of two triangles is nearer, and which only touch. */
#ifndef VISIBILITY_PREDICATE_TRIANGLE_PAIR_H
#define VISIBILITY_PREDICATE_TRIANGLE_PAIR_H

#include "geom/convex.h"
#include "visibility/predicate/occlusion.h"

/* How triangle g lies to triangle f over the part of the page they share. */
enum depth_order {
  NEARER_NEVER,  /* f is seen wherever they overlap */
  NEARER_ALWAYS, /* g is */
  NEARER_BEYOND  /* g is on the left of a line */
};

struct triangle_plane {
  struct geom_point p[3];
  struct geom_plane plane;
};

struct triangle_plane triangle_plane_of(const struct sheet *sheet,
                                        uint32_t triangle);

/* Do two triangles, counter-clockwise and not flat, share no inner point of the
 * page?  Neighbours do not, and most of what is about a face are neighbours.
 * Exact. */
bool triangles_disjoint(const struct sheet *sheet, uint32_t f, uint32_t g);

/* The three lines of a triangle's sides, and the same turned round. */
void triangle_lines(const struct sheet *sheet, uint32_t triangle,
                    struct geom_line line[3], struct geom_line back[3]);

/* Where three corners lie to a plane.  Exact. */
enum { PLANE_BEHIND = 1, PLANE_BEFORE = 2 }; /* a mask; 0: all on it */
int plane_sides(const struct geom_plane *plane, const struct geom_point p[3]);

/* Compares by exact depth, equal planes by index (the lower is seen).
 * line, back  set for NEARER_BEYOND: g is the nearer on the line's left;
 *             back is the same line turned round */
enum depth_order triangle_depth_order(const struct triangle_plane *f,
                                      uint32_t f_id,
                                      const struct triangle_plane *g,
                                      uint32_t g_id, struct geom_line *line,
                                      struct geom_line *back);

/* True where all corners of one touch the plane of the other. */
bool triangles_touch(const struct sheet *sheet, uint32_t f, uint32_t g);

#endif
