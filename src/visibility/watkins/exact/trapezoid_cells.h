/* trapezoid_cells.h - the triangles visible in the trapezoids of a sweep, and
 * the fragments that they make up. */
#ifndef VISIBILITY_WATKINS_EXACT_TRAPEZOID_CELLS_H
#define VISIBILITY_WATKINS_EXACT_TRAPEZOID_CELLS_H

#include "visibility/fragments/fragments.h"
#include "visibility/predicate/depth_plane.h"
#include "visibility/watkins/exact/sweep.h"

/* Limits: parts stored; triangles stored of parts in which doubles do not
 * decide which one is visible; trapezoids that become pieces of fragments. */
#define CELLS_MAX (1 << 23)
#define CELLS_TIED_MAX (1 << 25)
#define CELLS_PIECES_MAX (1 << 20)

/* A trapezoid in which a triangle is visible: throughout where count is 0, else
 * where none of the tied triangles is nearer. */
struct cell_part {
  uint32_t triangle;
  uint32_t left, right, top, bottom; /* as in struct sweep_cell */
  uint32_t tied, count; /* the triangles that may be visible in it, itself
                           included: a range of `tied` */
};

struct trapezoid_cells {
  const struct sheet *sheet;
  struct depth_plane *plane; /* one a triangle */
  uint8_t *seen;             /* one a triangle: it may be visible somewhere */
  uint8_t *covered;          /* one a triangle: another may be visible in front
                               of some of it */
  bool keep;                 /* store parts, instead of only setting `seen` */
  bool too_many;             /* a limit was exceeded */
  uint8_t *ties;             /* one a triangle: its parts with ties so far */
  size_t pieces_max;         /* CELLS_PIECES_MAX; tests set less */
  ARRAY(struct cell_part) part;
  sweep_list tied;
  sweep_list candidate; /* scratch */
  uint64_t count;       /* trapezoids received */
  uint64_t
      filter_failures; /* of these, doubles did not decide which triangle is
                           visible */
};

USE_RESULT bool trapezoid_cells_init(struct trapezoid_cells *cells,
                                     const struct sheet *sheet);
void trapezoid_cells_fini(struct trapezoid_cells *cells);

/* Adds a trapezoid (`cell` of struct sweep).
 * user  a struct trapezoid_cells */
bool trapezoid_cells_add(void *user, const struct sweep *sweep,
                         const struct sweep_cell *cell);

/* A triangle with ties in more trapezoids, where others intersect or touch it,
 * is deferred to pairwise_fallback.h. */
enum { CELLS_TIES_MAX = 64 };

static inline bool
trapezoid_cells_is_deferred(const struct trapezoid_cells *cells,
                            uint32_t triangle) {
  return cells->ties[triangle] > CELLS_TIES_MAX;
}

/* Adds the stored parts to the fragments, except those of deferred triangles.
 * Errors  RECTO_ERROR_LIMIT, RECTO_ERROR_MEMORY. */
USE_RESULT recto_status trapezoid_cells_finish(struct trapezoid_cells *cells,
                                               const struct sweep *sweep,
                                               struct fragments *fragments,
                                               recto_error *error);

#endif
