/* covering.h - the hairs of a drawing, and what may cover them. */
#ifndef INK_LINES_COVERING_H
#define INK_LINES_COVERING_H

#include <math.h>
#include <stdatomic.h>

#include "base/sort.h"
#include "ink/lines/cover_side.h"
#include "ink/lines/paths.h"
#include "ink/pens.h"

/* The first is also that of a path that is no hair. */
enum cover_verdict { COVER_NONE, COVER_FOUND, COVER_UNDECIDED };

struct measured_path {
  double length, near; /* grid units; near: what covers it is, at most */
  uint32_t rank;       /* 0: the longest */
  uint32_t layer;
  float weight;
  bool is_hair, is_drawn;
};

struct covering {
  struct ink_paths *paths;
  const struct sheet *sheet;
  const struct pens *pens;
  struct measured_path *measured; /* one a path */
  uint32_t *by_rank;
  atomic_uchar *verdict; /* one a path: enum cover_verdict */
  struct sort_key *hair; /* the cells in which hairs begin, and their paths */
  size_t hairs;
  ARRAY(uint32_t) undecided; /* paths, the longest first */
  uint8_t *marked;           /* one a cell */
  double cell, low[2], widest;
  int64_t count[2];              /* of cells, in x and in y */
  struct cover_lists *lists;     /* one a range of paths */
  ARRAY(struct cover_side) side; /* the shortest path's first */
  struct number_lists sides;     /* of each cell, the longest path's first */
};

/* Fetches what is read of a path that comes later, and the points of one that
 * comes sooner: in the order of ranks, or of cells, they are anywhere in
 * memory. */
MEM_PREFETCH_INLINE void covering_prefetch(const struct covering *c,
                                           uint32_t later, uint32_t sooner) {
  MEM_PREFETCH(&c->paths->path.item[later]);
  MEM_PREFETCH(&c->measured[later]);
  MEM_PREFETCH(&c->paths->point.item[c->paths->path.item[sooner].point]);
}

static inline double covering_distance(struct ink_point a, struct ink_point b) {
  double dx = (double)b.x - a.x, dy = (double)b.y - a.y;
  return sqrt(dx * dx + dy * dy);
}

/* The cell's index along an axis, moved into the page. */
static inline int64_t covering_cell_along(const struct covering *c, int axis,
                                          double at) {
  double i = (at - c->low[axis]) / c->cell;
  return !(i >= 0)                    ? 0
         : i < (double)c->count[axis] ? (int64_t)i
                                      : c->count[axis] - 1;
}

static inline int64_t covering_cell(const struct covering *c, double x,
                                    double y) {
  return covering_cell_along(c, 1, y) * c->count[0] +
         covering_cell_along(c, 0, x);
}

/* Finds out which hairs are covered, and sets is_covered of their paths.
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool covering_decide(struct covering *covering);

#endif
