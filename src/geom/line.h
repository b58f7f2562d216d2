/* line.h - exact lines of the page and the corners where they meet.
 *
 * A line is the oriented half plane a x + b y + c > 0, its left side.  It is
 * either a grid line, through two integer points (a mesh edge, a window's
 * border), or a plane intersection, where two planes are equally deep.
 *
 * A corner is either an integer point or the crossing of two lines; it is
 * never rounded before the last predicate on it is evaluated.
 *
 * Ranges: of grid lines |a|, |b| < 2^31, |c| < 2^62; of plane intersections
 * |a|, |b| < 2^137, |c| < 2^170, as normals are below 2^72 and 2^63 and plane
 * constants below 2^105 (predicate.h), and
 *     a = nFx nGz - nGx nFz,  c = KG nFz - KF nGz.
 *
 * Robustness: signs of 3 x 3 determinants, doubles first, wide.h where they
 * cannot decide.  That costs about a microsecond.
 */
#ifndef GEOM_LINE_H
#define GEOM_LINE_H

#include <stddef.h>

#include "geom/predicate.h"
#include "geom/wide.h"

#define GEOM_LINE_LIMBS 3

struct geom_line {
  double a, b, c; /* the nearest doubles */
  bool is_grid_line;
  int32_t x0, y0, x1, y1; /* grid line: from, to; the left side is positive */
  int8_t sign[3];         /* plane intersection: of a, b, c */
  uint64_t limb[3][GEOM_LINE_LIMBS];
};

/* The line from p to q, p != q on the page. */
void geom_line_through(struct geom_line *line, struct geom_point p,
                       struct geom_point q);

/* The line where two planes are equally deep; positive where `front` is the
 * nearer one, of greater z.  Both nz > 0.
 * Returns 0, or where the planes are parallel the sign of front - back (2:
 * they are the same plane): the line is then not set. */
int geom_line_between(struct geom_line *line, const struct geom_plane *front,
                      const struct geom_plane *back);
#define GEOM_SAME_PLANE 2

/* The horizontal line at y = height, from left to right.
 * height  |num| < 2^94, den < 2^64 */
void geom_line_level(struct geom_line *line, struct ratio height);

/* The same line in the opposite direction. */
struct geom_line geom_line_reversed(const struct geom_line *line);

/* The integers a, b, c of a line: of grid lines a, b < 2^31, c < 2^62. */
struct geom_line_integers {
  int64_t a, b, c;
};

static inline struct geom_line_integers
geom_line_integers_of(const struct geom_line *grid_line) {
  int64_t a = (int64_t)grid_line->y0 - grid_line->y1;
  int64_t b = (int64_t)grid_line->x1 - grid_line->x0;
  return (struct geom_line_integers){a, b,
                                     -(a * grid_line->x0 + b * grid_line->y0)};
}

/* The exact coefficients a, b, c of any line. */
void geom_line_exact(struct wide l[3], const struct geom_line *line);

struct geom_corner {
  double x, y; /* grid units, nearest or so: for boxes and filters */
  const struct geom_line *l1, *l2; /* NULL: the integer point ix, iy */
  int32_t ix, iy;
};

struct geom_corner geom_corner_at(struct geom_point p);

/* Where two lines that are not parallel meet. */
struct geom_corner geom_corner_of(const struct geom_line *l1,
                                  const struct geom_line *l2);

/* geom_line_side where not both are of the grid. */
int geom_line_side_of_any(const struct geom_line *line,
                          const struct geom_corner *corner);

/* +1 where the corner lies left of the line, 0 on it, -1 right.  Exact. */
static inline int geom_line_side(const struct geom_line *line,
                                 const struct geom_corner *corner) {
  if (corner->l1 != NULL || !line->is_grid_line)
    return geom_line_side_of_any(line, corner);
  int64_t dx = (int64_t)line->x1 - line->x0, dy = (int64_t)line->y1 - line->y0;
  int64_t ex = (int64_t)corner->ix - line->x0,
          ey = (int64_t)corner->iy - line->y0;
  return geom_sign64(dx * ey - dy * ex);
}

/* The sign of the cross product of the two lines' directions: +1 where l2
 * turns left from l1.  Exact. */
int geom_line_turn(const struct geom_line *l1, const struct geom_line *l2);

/* The sign of the dot product of the two lines' directions.  Exact. */
int geom_line_along(const struct geom_line *l1, const struct geom_line *l2);

/* Orders corners by x, then y: <0, 0, >0.  Exact. */
int geom_corner_compare(const struct geom_corner *p,
                        const struct geom_corner *q);

/* The corner as homogeneous integers x, y, w; w > 0. */
void geom_corner_exact(const struct geom_corner *corner, struct wide h[3]);

/* The coordinates times 2^bits rounded to the nearest integer, halves up;
 * depends only on the corner's place. */
void geom_corner_round(const struct geom_corner *corner, int bits, int64_t *x,
                       int64_t *y);

#endif
