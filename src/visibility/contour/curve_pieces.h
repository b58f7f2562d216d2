/* curve_pieces.h - the pieces of a contour curve, each of which is visible or
 * hidden as a whole. */
#ifndef VISIBILITY_CONTOUR_CURVE_PIECES_H
#define VISIBILITY_CONTOUR_CURVE_PIECES_H

#include "visibility/contour/contour_curves.h"

/* A part of a curve between two places. */
struct contour_piece {
  struct contour_cut from, to;
  uint32_t curve;         /* that it is of */
  uint32_t first;         /* of the points of it that are tested */
  uint32_t samples;       /* so many are */
  double weight, visible; /* of all of them, and of those seen */
  uint32_t occluders;     /* the sum of those that hide them */
  bool is_visible;
  int side; /* of the surface on which the line of sight passes: 1: the outer
               one, as normals have it; -1: the other one */
};

/* All pieces of a curve, in order. */
struct curve_pieces {
  const struct contour_curves *curves; /* borrowed, not owned */
  const struct contour_curve *curve;   /* borrowed, not owned */
  struct contour_piece *piece;         /* borrowed, not owned */
  size_t count;
};

static inline double contour_position(struct contour_cut cut) {
  return cut.step + cut.t;
}

/* Makes short pieces like the two beside them, if these are alike; not where
 * both ends are crossings or creases, which are known to be some. */
void curve_pieces_absorb_short(struct curve_pieces *pieces);

/* Hides visible pieces of less than a height that lead from a crossing behind
 * the surface of the contour in front to where the curve is hidden: visibility
 * is asked as far in front of the curve. */
void curve_pieces_hide_covered(struct curve_pieces *pieces,
                               const struct camera *camera);

/* Hides pieces along concave creases of an object beside visible ones at which
 * the outer side of the surface is seen: the surface hides them. */
void curve_pieces_hide_concave(struct curve_pieces *pieces);

/* Makes what is hidden over less than half a height of the triangles, and then
 * what is visible over less than two, or over less than one from or to a
 * crossing, like what is beside it; not between two crossings. */
void curve_pieces_absorb_runs(struct curve_pieces *pieces,
                              const struct camera *camera);

/* Hides the last segments of visible pieces that end at cusps, where these turn
 * from the rest within half a height: a cusp is found to about a segment. */
void curve_pieces_trim_hooks(struct curve_pieces *pieces,
                             const struct camera *camera);

#endif
