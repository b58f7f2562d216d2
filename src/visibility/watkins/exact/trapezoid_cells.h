/* trapezoid_cells.h - which triangles are seen in the trapezoids of a sweep, and
 * the fragments they make. */
#ifndef VISIBILITY_WATKINS_EXACT_TRAPEZOID_CELLS_H
#define VISIBILITY_WATKINS_EXACT_TRAPEZOID_CELLS_H

#include "visibility/fragments/fragments.h"
#include "visibility/watkins/exact/sweep.h"

/* At most: trapezoids kept; triangles that doubles cannot tell apart in them;
 * trapezoids that become pieces of fragments. */
#define CELLS_MAX (1 << 23)
#define CELLS_TIED_MAX (1 << 25)
#define CELLS_PIECES_MAX (1 << 20)

/* The depth of a triangle's plane in doubles. */
struct cell_plane {
  double x, y, z; /* of its first corner */
  double per_x, per_y;
};

/* A trapezoid in which a triangle is seen, in all of it where it is the only
 * one listed. */
struct cell_part {
  uint32_t triangle;
  uint32_t left, right, top, bottom; /* as in struct sweep_cell */
  uint32_t tied, count; /* others that may be seen in a part of it */
};

struct trapezoid_cells {
  const struct sheet *sheet;
  struct cell_plane *plane; /* one a triangle */
  uint8_t *seen;            /* one a triangle: it may be seen somewhere */
  uint8_t *covered;         /* another may be seen somewhere before it */
  bool keep;                /* parts are kept, not only noted as seen */
  bool too_many;            /* a limit was met */
  uint8_t *ties;      /* one a triangle: parts it shares with others, so far */
  size_t most_pieces; /* CELLS_PIECES_MAX */
  ARRAY(struct cell_part) part;
  sweep_list tied;
  sweep_list candidate; /* scratch */
  uint64_t count;       /* trapezoids taken */
  uint64_t asked;       /* of these, doubles could not tell who is seen */
};

USE_RESULT bool trapezoid_cells_init(struct trapezoid_cells *cells,
                                     const struct sheet *sheet);
void trapezoid_cells_fini(struct trapezoid_cells *cells);

/* Takes a trapezoid (struct sweep's `cell`; user: struct trapezoid_cells). */
bool trapezoid_cells_take(void *user, const struct sweep *sweep,
                          const struct sweep_cell *cell);

/* Trapezoids that a triangle may share with others that pierce or touch it
 * there: what is seen of it in so many, and more, is left to pairwise_fallback.h. */
enum { CELLS_TIES_MOST = 64 };

static inline bool trapezoid_cells_leave(const struct trapezoid_cells *cells,
                                         uint32_t triangle) {
  return cells->ties[triangle] > CELLS_TIES_MOST;
}

/* Hands what was kept to the fragments, but for triangles that are left over.
 * Errors  RECTO_ERROR_LIMIT, RECTO_ERROR_MEMORY. */
USE_RESULT recto_status trapezoid_cells_finish(struct trapezoid_cells *cells,
                                               const struct sweep *sweep,
                                               struct fragments *fragments,
                                               recto_error *error);

#endif
