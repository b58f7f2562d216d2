/* loose_ends.h - loose ends of spurs in a uniform grid, and which of them
 * segments pass by. */
#ifndef INK_LINES_LOOSE_ENDS_H
#define INK_LINES_LOOSE_ENDS_H

#include <math.h>

#include "ink/lines/segment_graph.h"
#include "ink/pens.h"

struct loose_end {
  struct ink_point at;
  uint32_t spur;
  bool is_passed; /* a segment of another spur, or of none, is near it */
};

/* One in the list of a cell.
 * next  the one after it in the list, plus one; 0: none */
struct listed_end {
  uint32_t end, next;
};

struct loose_ends {
  const struct segment_graph *graph;
  ARRAY(struct loose_end) end;
  double near;         /* half of the widest pen, grid units */
  double cell, low[2]; /* of the uniform grid, grid units */
  double per_unit;     /* cells */
  int count[2];        /* of cells, in x and in y */
  uint32_t *first;     /* one a cell: the first listed of the loose ends in it
                           and in those about it, as in listed_end */
  ARRAY(struct listed_end) listed;
  uint8_t *is_near; /* one a cell: it or one beside it has a list */
  bool is_shared;   /* several threads test segments */
};

/* False when memory ran out; loose_ends_fini is called in any case. */
USE_RESULT bool loose_ends_init(struct loose_ends *ends,
                                const struct segment_graph *graph,
                                const struct pens *pens,
                                const double page_mm[2]);
void loose_ends_fini(struct loose_ends *ends);

/* Adds an end; one that is not listed is passed by nothing.  False when memory
 * ran out. */
USE_RESULT bool loose_ends_add(struct loose_ends *ends, struct loose_end end,
                               bool is_listed);

/* The column or row of a coordinate. */
static inline int loose_ends_cell(const struct loose_ends *ends, int axis,
                                  double at) {
  double cell = (at - ends->low[axis]) * ends->per_unit;
  int last = ends->count[axis] - 1;
  return cell < 0 ? 0 : cell < last ? (int)cell : last;
}

/* Whether a loose end may be listed in the cell of a place or beside it. */
static inline bool loose_ends_are_near(const struct loose_ends *ends,
                                       struct ink_point at) {
  int x = loose_ends_cell(ends, 0, at.x), y = loose_ends_cell(ends, 1, at.y);
  return ends->is_near[y * ends->count[0] + x] != 0;
}

/* Whether a segment between two places may be in cells that are not beside that
 * of one of them: by less than a cell, for rounding. */
static inline bool loose_ends_is_long(const struct loose_ends *ends,
                                      struct ink_point from,
                                      struct ink_point to) {
  double most = 0.99 * ends->cell;
  return (fabs((double)to.x - from.x) > most) |
         (fabs((double)to.y - from.y) > most);
}

/* Marks the ends that a segment passes by, but those of its own spur.
 * Threads  may be called by several at once while `is_shared` is set */
void loose_ends_test(struct loose_ends *ends, uint32_t segment, uint32_t own);

/* What several threads find: each may set it, and none clears it. */
static inline bool loose_ends_is_found(const bool *found) {
  return __atomic_load_n(found, __ATOMIC_RELAXED);
}

static inline void loose_ends_set_found(bool *found) {
  __atomic_store_n(found, true, __ATOMIC_RELAXED);
}

#endif
