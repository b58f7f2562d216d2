/* doubled_cells.h - the cells of contours' edges, and the nearer contours that
 * cover them. */
#ifndef VISIBILITY_CONTOUR_DOUBLED_CELLS_H
#define VISIBILITY_CONTOUR_DOUBLED_CELLS_H

#include <math.h>

#include "base/tolerance.h"
#include "visibility/contour/segment_grid.h"
#include "visibility/map.h"

/* The length of a cell, grid units. */
#define DOUBLED_CELL_LENGTH TOLERANCE_OUTLINE_UNITS

/* A cell of an edge. */
struct doubled_cell {
  uint32_t edge;
  uint32_t number;   /* from the edge's first point on */
  uint32_t covering; /* the edge that covers it; SHEET_NONE: none does */
  bool is_hidden;
};

struct doubled_contours {
  struct sheet *sheet;
  struct map *map;
  uint32_t first, end; /* of the contours' edges */
  const float *height;
  double beyond;
  double *along; /* one a contour's edge: the length of the contours before it,
                    and of all of them */
  struct segment_grid grid;
  _Atomic uint64_t compared; /* places with contours: the work done */
  uint8_t *is_covered;       /* one a contour edge: some of its cells are */
  uint8_t *is_hidden;        /* the same: some of its cells are hidden */
  uint8_t *is_covering;      /* the same: it covers cells that are hidden */
  ARRAY(struct doubled_cell) cell; /* of visible edges, along the curves */
  size_t points;                   /* before edges are divided */
  uint8_t *degree;                 /* visible contours' ends at each of them,
                                      at most 2 */
};

static inline double doubled_length(const struct doubled_contours *d,
                                    uint32_t edge) {
  return d->along[edge - d->first + 1] - d->along[edge - d->first];
}

static inline uint32_t doubled_cells_of(const struct doubled_contours *d,
                                        uint32_t edge) {
  return (uint32_t)fmax(1, ceil(doubled_length(d, edge) / DOUBLED_CELL_LENGTH));
}

/* Whether an edge begins or ends where another one does. */
static inline bool doubled_share_point(const struct doubled_contours *d,
                                       uint32_t e, uint32_t f) {
  const uint32_t *p = d->sheet->edge.item[e].point;
  const uint32_t *q = d->sheet->edge.item[f].point;
  return p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1];
}

/* Finds what covers each cell, and marks the edges of which cells are covered.
 * Returns false when memory ran out or the caller cancelled. */
USE_RESULT bool doubled_cells_mark(struct doubled_contours *d);

#endif
