/* newell_order.h - the painter's order of Newell, Newell and Sancha: which
 * faces may be painted before which, with splits where no order exists. */
#ifndef VISIBILITY_NEWELL_NEWELL_ORDER_H
#define VISIBILITY_NEWELL_NEWELL_ORDER_H

#include "geom/convex.h"
#include "visibility/predicate/triangle_pair.h"
#include "visibility/index/triangle_grid.h"
#include "visibility/progress.h"
#include "visibility/predicate/plane_filter.h"

#define NEWELL_NONE UINT32_MAX

enum newell_state {
  NEWELL_WAITING, /* not painted yet */
  NEWELL_MARKED,  /* moved ahead of another and not painted yet */
  NEWELL_PAINTED, /* has its rank */
  NEWELL_SPLIT,   /* gone: others stand for it */
  NEWELL_UNSEEN   /* flat, a copy, behind one other piece entirely, or of a
                      face without an order */
};

/* Piece t < triangle count is the whole triangle t; later ones are parts. */
struct newell_piece {
  uint32_t triangle;
  uint32_t next;                 /* the triangle's next piece, NEWELL_NONE */
  uint32_t next_open, last_open; /* the same among those not painted yet */
  struct geom_convex *shape;     /* NULL: the whole triangle */
  struct box2 box;
  int64_t z_low, z_high; /* of the triangle */
  uint32_t rank;         /* 0 is rearmost */
  uint8_t state;         /* enum newell_state */
};

/* How many pairs each test settled, and what became of the rest. */
struct newell_counts {
  uint64_t depth, minimax, behind, before, full; /* z, tests A, B, C, D */
  uint64_t moved, cycles, split_cycle, split_pierce, unseen;
  uint64_t tests;     /* pairs of a candidate and another */
  uint64_t unordered; /* triangles without an order */
};

struct newell_order {
  const struct sheet *sheet;
  const struct triangle_grid *grid;
  struct triangle_grid_query query;
  ARRAY(struct newell_piece) piece;
  uint32_t *open;  /* a triangle's first piece not painted yet */
  uint8_t *splits; /* of a triangle so far; NEWELL_UNORDERED: it has no order,
                      and its pieces are of no account */
  ARRAY(uint32_t) painted; /* pieces, back to front */
  ARRAY(uint32_t) stack;   /* candidates: each is to be painted before those
                              under it */
  struct arena arena, scratch;
  struct newell_counts counts;
  struct progress progress;
  bool lines_only; /* what touches needs no order: contact never hides lines */
  struct triangle_plane plane; /* of triangle `prepared`, the candidate's */
  struct plane_filter stance;
  uint32_t prepared;
};

enum { NEWELL_UNORDERED = UINT8_MAX };

/* Was the triangle taken out of the order? */
static inline bool newell_is_unordered(const struct newell_order *order,
                                       uint32_t triangle) {
  return order->splits[triangle] == NEWELL_UNORDERED;
}

/* Orders all triangles of the sheet but those that would be split too often.
 * Errors  RECTO_ERROR_MEMORY, RECTO_ERROR_CANCELLED. */
USE_RESULT recto_status newell_order_init(struct newell_order *order,
                                          const struct sheet *sheet,
                                          const struct triangle_grid *grid,
                                          const struct solver_request *request,
                                          recto_error *error);
void newell_order_fini(struct newell_order *order);

/* The sides of a piece as lines with the piece on their left, and turned
 * round; `count` of them, in the arena.  NULL when memory ran out. */
struct geom_line *newell_piece_lines(const struct newell_order *order,
                                     uint32_t piece, int *count,
                                     struct arena *arena);

#endif
