/* newell_piece.h - the pieces of triangles that Newell, Newell and Sancha's
 * algorithm orders, and the state of the ordering.
 *
 * Shared by newell_order.h, which finds the order, and newell_tests.h, which
 * compares two pieces.
 */
#ifndef VISIBILITY_NEWELL_NEWELL_PIECE_H
#define VISIBILITY_NEWELL_NEWELL_PIECE_H

#include "geom/convex.h"
#include "visibility/index/triangle_grid.h"
#include "visibility/predicate/plane_filter.h"
#include "visibility/predicate/triangle_pair.h"
#include "visibility/progress.h"

#define NEWELL_NONE UINT32_MAX

enum newell_state {
  NEWELL_WAITING, /* not painted yet */
  NEWELL_MARKED,  /* moved ahead of another piece and not painted yet */
  NEWELL_PAINTED, /* has its rank */
  NEWELL_SPLIT,   /* replaced by its parts */
  NEWELL_UNSEEN   /* not to be painted: edge-on, a duplicate, entirely behind
                     one other piece, or of a triangle without an order */
};

/* Piece t < triangle count is the whole triangle t; later ones are parts. */
struct newell_piece {
  uint32_t triangle;
  uint32_t next;                 /* the triangle's next piece, NEWELL_NONE */
  uint32_t next_open, last_open; /* next and previous one not painted yet */
  struct geom_convex *shape;     /* NULL: the whole triangle */
  struct box2 box;
  int64_t z_low, z_high; /* of the triangle */
  uint32_t rank; /* 0 is rearmost; unseen: of the next piece in the order
                            of depth */
  uint8_t state; /* enum newell_state */
};

struct newell_counts {
  /* Pairs by the test that decided them: depth ranges, bounding boxes (test A),
   * P behind the plane of Q (B), Q in front of the plane of P (C), the full
   * test on the page (D). */
  uint64_t depth, minimax, behind, before, full;
  uint64_t moved, cycles, split_cycle, split_intersection, unseen;
  uint64_t tests;    /* pairs of a candidate and another piece */
  uint64_t deferred; /* triangles without an order */
};

struct newell_order {
  const struct sheet *sheet;
  const struct triangle_grid *grid;
  struct triangle_grid_query query;
  ARRAY(struct newell_piece) piece;
  uint32_t *open;  /* one per triangle: its first piece not painted yet */
  uint8_t *splits; /* one per triangle: how often it was split; or
                      NEWELL_UNORDERED: it has no order, and its pieces have no
                      meaning */
  ARRAY(uint32_t) painted; /* pieces, back to front */
  ARRAY(uint32_t) stack;   /* candidates: each is to be painted before those
                              below it */
  struct arena arena, scratch;
  struct newell_counts counts;
  struct progress progress;
  int tests; /* how many of the tests A to D are applied to whole triangles, of
                which none is then split; 0: all, to pieces */
  bool lines_only; /* faces in contact need no order, as contact never hides
                      lines */
  struct triangle_plane plane; /* of triangle `prepared`, the candidate's */
  struct plane_filter filter;
  uint32_t prepared;
};

enum { NEWELL_UNORDERED = UINT8_MAX };

/* Returns whether the triangle was excluded from the order. */
static inline bool newell_is_deferred(const struct newell_order *order,
                                      uint32_t triangle) {
  return order->splits[triangle] == NEWELL_UNORDERED;
}

/* The sides of a piece as `count` lines with the piece on their left, followed
 * by the same lines reversed.  Returns NULL when memory ran out.
 * Owner  the arena */
struct geom_line *newell_piece_lines(const struct newell_order *order,
                                     uint32_t piece, int *count,
                                     struct arena *arena);

/* Makes the shape of a piece; that of a whole triangle is allocated in the
 * order's scratch arena.  Returns false when memory ran out. */
USE_RESULT bool newell_piece_shape(struct newell_order *order, uint32_t piece,
                                   struct geom_convex *shape);

#endif
