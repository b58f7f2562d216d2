/* clearance.h - the distance from a point of a stroke to other ink. */
#ifndef INK_CURVE_CLEARANCE_H
#define INK_CURVE_CLEARANCE_H

#include "drawing/drawing.h"

/* All strokes of a drawing, cut into short pieces, in a uniform grid.  Other
 * ink than a point's own is every other stroke, and the parts of its own that
 * are farther along it than `apart`, or beyond a corner. */
struct clearance {
  double reach, apart;    /* mm */
  double cell, low[2];    /* mm: the side of the grid's cells, and its corner */
  uint32_t columns, rows; /* of cells */
  uint32_t *start;        /* one a cell and one more: its first piece */
  struct clearance_piece *piece; /* cell by cell */
};

/* A point of a stroke. */
struct clearance_place {
  struct drawing_point at;
  uint32_t stroke;
  double along;     /* mm along the stroke from `start` */
  double start;     /* mm from the stroke's first point */
  double whole;     /* the length of a closed stroke; INFINITY of an open one */
  double low, high; /* mm along the stroke from `start`: the corners before and
                       after it; infinite: there is none */
};

/* reach  mm, > 0: beyond it distances do not matter
 * Cost   linear in the drawn length over the reach, and in the strokes' points;
 *        the grid has at most some millions of cells
 * Returns false when memory ran out; to be freed in either case. */
USE_RESULT bool clearance_init(struct clearance *clearance,
                               const struct drawing *drawing, double reach,
                               double apart);
void clearance_fini(struct clearance *clearance);

/* A side of a stroke, or a part of one; `from` and `to` are at most
 * clearance_step apart. */
struct clearance_part {
  struct clearance_place from, to;
};
double clearance_step(const struct clearance *clearance);

/* The distance between the part and other ink, mm; `reach` where none is as
 * near.
 * nearest  set to where on the part that is, 0 to 1 */
double clearance_of(const struct clearance *clearance,
                    const struct clearance_part *part, double *nearest);

/* For a part that begins within `touch` mm of other ink: the largest s so that
 * the distance between other ink and the point of the part that is x mm from
 * its beginning is at least s x; at most 1. */
double clearance_slope(const struct clearance *clearance,
                       const struct clearance_part *part, double touch);

#endif
