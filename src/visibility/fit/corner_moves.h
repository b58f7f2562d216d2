/* corner_moves.h - where the corners of visible fragments go, for the fragments
 * to end at smooth contours. */
#ifndef VISIBILITY_FIT_CORNER_MOVES_H
#define VISIBILITY_FIT_CORNER_MOVES_H

#include "base/number_lists.h"
#include "visibility/fit/drawn_outlines.h"
#include "visibility/zero_set/zero_segments.h"

/* From a point of the page to the nearest one of a contour. */
struct corner_move {
  double from[2], to[2]; /* grid units */
  double distance;       /* squared */
  uint32_t edge;         /* the contour's, of the sheet */
  uint32_t farther;      /* another contour's that ends there; SHEET_NONE */
  bool occluder;         /* it is the contour of a nearer face */
};

struct corner_moves {
  const struct map *map;              /* borrowed, not owned */
  const struct sheet *sheet;          /* borrowed, not owned */
  const struct topology *topology;    /* borrowed, not owned */
  const struct drawn_outlines *drawn; /* borrowed, not owned */
  uint32_t first, first_point;        /* the sheet's of contours */
  uint32_t (
      *at_point)[2]; /* one a point of the contours: the visible edges that
                              meet there; SHEET_NONE */
  struct number_lists of_point; /* the edges at each scene point */
  ARRAY(struct corner_move) move;
  uint32_t *table; /* open addressing: a point -> 1 + its move; 0: free */
  size_t mask;
  struct large_face_size last[2]; /* of the first and second faces of edges */
  uint32_t *of_corner; /* one a corner: 1 + the move of its point; 0: none */
};

/* Finds the moves; corners at one point of the page have one move.
 * moves   zero-initialised but for what is borrowed, and `first`: the sheet's
 *         first edge of a contour; the caller frees it
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool corner_moves_find(struct corner_moves *moves);
void corner_moves_fini(struct corner_moves *moves);

/* The move of the point at which a corner is; NULL: it stays. */
static inline const struct corner_move *
corner_moves_at(const struct corner_moves *moves, uint32_t corner) {
  uint32_t move = moves->of_corner[corner];
  return move == 0 ? NULL : &moves->move.item[move - 1];
}

/* Whether the side that starts at a corner runs along an outline of the mesh
 * that is not drawn. */
bool corner_moves_is_along(const struct corner_moves *moves,
                           const struct map_corner *corner);

#endif
