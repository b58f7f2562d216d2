/* triangle_grid.h - which triangles may lie where on the page: a flat grid. */
#ifndef VISIBILITY_INDEX_TRIANGLE_GRID_H
#define VISIBILITY_INDEX_TRIANGLE_GRID_H

#include "view/sheet.h"
#include "visibility/predicate/box2.h"

/* Cells are squares of 2^shift units; the triangles of cell c are
 * item[start[c] .. start[c + 1]), ascending.  In a pile of copies those that
 * others stand for are not listed (duplicate_triangles.h). */
struct triangle_grid {
  int shift, columns, rows;
  int32_t x0, y0; /* lower left corner */
  uint32_t *start, *item;
  uint8_t *left_out; /* one a triangle: not listed; NULL: all are */
  size_t triangle_count;
  const struct sheet *sheet; /* lent */
  struct bsp *bsp;           /* the long lists, parted; NULL: none is */
  uint32_t *bsp_root;        /* one a cell; SHEET_NONE: not parted */
  const double *horizon;     /* what the lists were made with; lent */
};

/* Indexes the boxes of all triangles of the sheet. */
USE_RESULT bool triangle_grid_init(struct triangle_grid *grid,
                                   const struct sheet *sheet);
void triangle_grid_fini(struct triangle_grid *grid);

/* The same in two steps.  The first chooses the cells: as small as they may
 * be with a triangle in `spread` of them on average, so that memory is linear
 * in the triangles whatever their shape, and at most `cells` cells a
 * triangle.  The second makes the lists.
 * print   the triangles' footprints
 * wanted  the cells that get a list, the others' stay empty
 * horizon one a cell: triangles wholly behind it are left out; NULL: none */
void triangle_grid_shape(struct triangle_grid *grid, const struct sheet *sheet,
                         unsigned spread, unsigned cells);
struct footprint;
USE_RESULT bool triangle_grid_fill(struct triangle_grid *grid,
                                   const struct sheet *sheet,
                                   const struct footprint *print,
                                   const uint8_t *wanted,
                                   const double *horizon);

/* What a list costs those who look at all pairs in it, in pairs: it is worth a
 * few to be in a list at all. */
static inline double triangle_grid_cost_of_list(uint32_t count) {
  return (0.5 * count + 4) * count;
}

/* Takes larger cells where these cost less, for lists of some triangles: large
 * ones are in many cells, and any two of them meet in each.
 * grid  a shape without lists
 * cost  of the lists there would be else; becomes what larger cells cost
 * Returns false when memory ran out. */
USE_RESULT bool triangle_grid_enlarge(struct triangle_grid *grid,
                                      const struct sheet *sheet,
                                      const uint32_t *some, size_t n,
                                      double *cost);

/* Makes such lists, ascending. */
USE_RESULT bool triangle_grid_fill_some(struct triangle_grid *grid,
                                        const struct sheet *sheet,
                                        const uint32_t *some, size_t count);

/* Parts the long lists of such a grid.
 * planes  by planes too: questions are then about what may hide something
 * Returns false when memory ran out. */
USE_RESULT bool triangle_grid_split(struct triangle_grid *grid, bool planes);

static inline size_t
triangle_grid_cell_count(const struct triangle_grid *grid) {
  return (size_t)grid->columns * (size_t)grid->rows;
}

static inline int triangle_grid_cell(int32_t v, int32_t v0, int shift,
                                     int count) {
  int64_t cell = ((int64_t)v - v0) >> shift;
  return cell < 0 ? 0 : cell >= count ? count - 1 : (int)cell;
}

enum {
  TRIANGLE_GRID_SPLIT = 1024,    /* lists from here on are parted */
  TRIANGLE_GRID_DUPLICATES = 256 /* and from here on searched for copies */
};

/* Do others stand for the triangle? */
static inline bool triangle_grid_leaves_out(const struct triangle_grid *grid,
                                            uint32_t triangle) {
  return grid->left_out != NULL && grid->left_out[triangle] != 0;
}

/* The root of a cell's list in grid->crowd; SHEET_NONE: it was not parted. */
static inline uint32_t triangle_grid_bsp(const struct triangle_grid *grid,
                                         size_t cell) {
  return grid->bsp_root != NULL ? grid->bsp_root[cell] : SHEET_NONE;
}

/* Ranges of cells, closed. */
struct cell_range {
  int x0, y0, x1, y1;
};

/* The cells that a box meets; what is off the grid counts to its rim. */
static inline struct cell_range
triangle_grid_cells(const struct triangle_grid *grid, struct box2 box) {
  return (struct cell_range){
      triangle_grid_cell(box.x0, grid->x0, grid->shift, grid->columns),
      triangle_grid_cell(box.y0, grid->y0, grid->shift, grid->rows),
      triangle_grid_cell(box.x1, grid->x0, grid->shift, grid->columns),
      triangle_grid_cell(box.y1, grid->y0, grid->shift, grid->rows)};
}

/* Of row y, within `range`, the cells that the segment p-q meets. */
void triangle_grid_row(const struct triangle_grid *grid, struct geom_point p,
                       struct geom_point q, struct cell_range range, int y,
                       int *x0, int *x1);

/* The cells of a triangle, kept small so that the triangles can be streamed
 * again without their points; and two numbers of whoever made it. */
struct footprint {
  uint16_t x, y;         /* the lower left */
  uint8_t width, height; /* cells less one; FOOTPRINT_LARGE: ask the box */
  uint8_t low, high;
};
enum { FOOTPRINT_LARGE = 255 };

static inline struct footprint footprint_of(struct cell_range r, int low,
                                            int high) {
  int width = r.x1 - r.x0, height = r.y1 - r.y0;
  bool large = width >= FOOTPRINT_LARGE || height >= FOOTPRINT_LARGE ||
               r.x0 > UINT16_MAX || r.y0 > UINT16_MAX;
  return (struct footprint){(uint16_t)(r.x0 & UINT16_MAX),
                            (uint16_t)(r.y0 & UINT16_MAX),
                            (uint8_t)(large ? FOOTPRINT_LARGE : width),
                            (uint8_t)(large ? FOOTPRINT_LARGE : height),
                            (uint8_t)low,
                            (uint8_t)high};
}

static inline struct cell_range
footprint_cells(const struct triangle_grid *grid, const struct sheet *sheet,
                size_t triangle, struct footprint print) {
  if (print.width == FOOTPRINT_LARGE)
    return triangle_grid_cells(grid,
                               box2_of_triangle(sheet, (uint32_t)triangle));
  return (struct cell_range){print.x, print.y, print.x + print.width,
                             print.y + print.height};
}

/* A place for answers, one a thread. */
struct triangle_grid_query {
  uint32_t *stamp, now;
  ARRAY(uint32_t) found;
};

USE_RESULT bool triangle_grid_query_init(struct triangle_grid_query *query,
                                         const struct triangle_grid *grid);
void triangle_grid_query_fini(struct triangle_grid_query *query);

/* Forgets the last answer. */
void triangle_grid_query_start(const struct triangle_grid *grid,
                               struct triangle_grid_query *query);

/* Is the triangle not in the answer yet?  From now on it is. */
static inline bool triangle_grid_query_first(struct triangle_grid_query *query,
                                             uint32_t triangle) {
  bool first = query->stamp[triangle] != query->now;
  query->stamp[triangle] = query->now;
  return first;
}

/* Finds every triangle whose box meets `box` (and some more), each once, in
 * an order that depends on the grid alone.  False when memory ran out. */
USE_RESULT bool triangle_grid_find(const struct triangle_grid *grid,
                                   struct box2 box,
                                   struct triangle_grid_query *query);

/* The same along the segment from p to q: triangles of the cells it meets.
 * In long lists, those that share no stretch of the page with it may be left
 * out. */
USE_RESULT bool triangle_grid_find_along(const struct triangle_grid *grid,
                                         struct geom_point p,
                                         struct geom_point q,
                                         struct triangle_grid_query *query);

/* The same about a triangle of the sheet: those that may share an area of the
 * page with it. */
USE_RESULT bool
triangle_grid_find_overlapping(const struct triangle_grid *grid,
                               uint32_t triangle,
                               struct triangle_grid_query *query);

#endif
