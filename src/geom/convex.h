/* convex.h - convex pieces of the page, cut by exact lines. */
#ifndef GEOM_CONVEX_H
#define GEOM_CONVEX_H

#include "base/memory.h"
#include "geom/line.h"

/* Side k runs on side[k] from corner[k] to corner[(k + 1) % count], the piece
 * on its left.  count 0: empty.  Corners and lines belong to an arena. */
struct geom_convex {
  uint32_t count;
  struct geom_corner *corner;
  const struct geom_line **side;
  double x0, y0, x1, y1; /* a box around it, a little wider than needed */
};

/* The triangle of three counter-clockwise corners on its three lines. */
USE_RESULT bool geom_convex_triangle(struct geom_convex *piece,
                                     const struct geom_point p[3],
                                     const struct geom_line line[3],
                                     struct arena *arena);

/* Cuts a piece by a line: `inside` is what is left of it, `outside` the rest;
 * either may be empty, and each may be NULL where it is not wanted.
 * reversed  the same line in the opposite direction
 * Exact.  Returns false when memory ran out. */
USE_RESULT bool
geom_convex_split(const struct geom_convex *piece, const struct geom_line *line,
                  const struct geom_line *reversed, struct geom_convex *inside,
                  struct geom_convex *outside, struct arena *arena);

typedef ARRAY(struct geom_convex) geom_pieces;

/* Appends to `rest` what is left of `piece` outside the convex region that is
 * left of all `count` lines; the piece itself where the two do not overlap.
 * inside  where not NULL, gets the common part (count 0: none). */
USE_RESULT bool geom_convex_subtract(const struct geom_convex *piece,
                                     const struct geom_line *line,
                                     const struct geom_line *reversed,
                                     int count, geom_pieces *rest,
                                     struct geom_convex *inside,
                                     struct arena *arena);

/* A copy of a piece, its lines too, into another arena. */
USE_RESULT bool geom_convex_copy(struct geom_convex *to,
                                 const struct geom_convex *from,
                                 struct arena *arena);

#endif
