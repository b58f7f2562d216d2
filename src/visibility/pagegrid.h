/* pagegrid.h - which triangles may lie where on the page: a flat grid. */
#ifndef VISIBILITY_PAGEGRID_H
#define VISIBILITY_PAGEGRID_H

#include "view/sheet.h"

struct page_box {
  int32_t x0, y0, x1, y1; /* grid units, closed */
};

/* Cells are squares of 2^shift units; the triangles of cell c are
 * item[start[c] .. start[c + 1]), ascending. */
struct pagegrid {
  int shift, columns, rows;
  int32_t x0, y0; /* lower left corner */
  uint32_t *start, *item;
  size_t triangle_count;
};

/* Indexes the boxes of all triangles of the sheet. */
USE_RESULT bool pagegrid_init(struct pagegrid *grid, const struct sheet *sheet);
void pagegrid_fini(struct pagegrid *grid);

/* The same in two steps.  The first chooses the cells: as small as they may
 * be with a triangle in `spread` of them on average, so that memory is linear
 * in the triangles whatever their shape.  The second makes the lists of the
 * cells that are `wanted` (NULL: all); the others' stay empty. */
void pagegrid_shape(struct pagegrid *grid, const struct sheet *sheet,
                    unsigned spread);
USE_RESULT bool pagegrid_fill(struct pagegrid *grid, const struct sheet *sheet,
                              const uint8_t *wanted);

static inline size_t pagegrid_cell_count(const struct pagegrid *grid) {
  return (size_t)grid->columns * (size_t)grid->rows;
}

/* Ranges of cells, closed. */
struct cell_range {
  int x0, y0, x1, y1;
};

struct cell_range pagegrid_cells(const struct pagegrid *grid,
                                 struct page_box box);

/* Of row y, within `range`, the cells that the segment p-q meets. */
void pagegrid_row(const struct pagegrid *grid, struct geom_point p,
                  struct geom_point q, struct cell_range range, int y, int *x0,
                  int *x1);

/* A place for answers, one a thread. */
struct pagegrid_query {
  uint32_t *stamp, now;
  ARRAY(uint32_t) found;
};

USE_RESULT bool pagegrid_query_init(struct pagegrid_query *query,
                                    const struct pagegrid *grid);
void pagegrid_query_fini(struct pagegrid_query *query);

/* Finds every triangle whose box meets `box` (and some more), each once, in
 * an order that depends on the grid alone.  False when memory ran out. */
USE_RESULT bool pagegrid_find(const struct pagegrid *grid,
                              struct page_box box,
                              struct pagegrid_query *query);

/* The same along the segment from p to q: triangles of the cells it meets. */
USE_RESULT bool pagegrid_find_along(const struct pagegrid *grid,
                                    struct geom_point p, struct geom_point q,
                                    struct pagegrid_query *query);

struct page_box page_box_of_triangle(const struct sheet *sheet,
                                     uint32_t triangle);
struct page_box page_box_of_segment(struct geom_point p, struct geom_point q);

static inline bool page_boxes_apart(struct page_box a, struct page_box b) {
  return a.x1 < b.x0 || b.x1 < a.x0 || a.y1 < b.y0 || b.y1 < a.y0;
}

#endif
