/* triangle_grid.h - a uniform grid over the page: the triangles whose boxes
 * meet each cell, with a BSP for overfull cells. */
#ifndef VISIBILITY_INDEX_TRIANGLE_GRID_H
#define VISIBILITY_INDEX_TRIANGLE_GRID_H

#include "base/number_lists.h"
#include "view/sheet.h"
#include "visibility/predicate/box2.h"

/* Cells are squares of 2^shift units, row by row from the lower left; the
 * triangles of a cell are its list, ascending.  Where there are many
 * duplicates, only their representatives are listed
 * (duplicate_triangles.h). */
struct triangle_grid {
  int shift, columns, rows;
  int32_t x0, y0; /* lower left corner */
  struct number_lists lists;
  uint8_t *left_out; /* per triangle, not 0: not listed; NULL: all are listed */
  size_t triangle_count;
  const struct sheet *sheet; /* borrowed, not owned */
  struct bsp *bsp;           /* the trees of overfull cells; NULL: none */
  uint32_t *bsp_root;        /* per cell; SHEET_NONE: no tree */
};

/* Indexes the boxes of all triangles of the sheet.  False when memory ran
 * out, or the caller cancelled. */
USE_RESULT bool triangle_grid_init(struct triangle_grid *grid,
                                   const struct sheet *sheet);
void triangle_grid_fini(struct triangle_grid *grid);

/* The first of two steps: chooses the cells, the smallest that have a triangle
 * in at most `spread` cells on average, so that memory is linear in the
 * triangles whatever their shape, and at most `cells` cells per triangle. */
void triangle_grid_shape(struct triangle_grid *grid, const struct sheet *sheet,
                         unsigned spread, unsigned cells);
struct footprint;
/* The second step: makes the lists.
 * footprint  one a triangle
 * wanted     per cell, not 0: it gets a list; those of the others stay empty
 * Returns false when memory ran out, or the caller cancelled. */
USE_RESULT bool triangle_grid_fill(struct triangle_grid *grid,
                                   const struct sheet *sheet,
                                   const struct footprint *footprint,
                                   const uint8_t *wanted);

/* Per cell: is it wanted, or the next one in x, in y or in both?  Then one
 * lookup decides for two by two cells.  NULL when memory ran out. */
uint8_t *triangle_grid_dilate(const struct triangle_grid *grid,
                              const uint8_t *wanted);

/* The number of a cell. */
static inline size_t triangle_grid_index(const struct triangle_grid *grid,
                                         int x, int y) {
  return (size_t)y * (size_t)grid->columns + (size_t)x;
}

/* The cost of testing all pairs of a list, in pairs; each entry adds a constant
 * cost of four. */
static inline double triangle_grid_cost_of_list(uint32_t count) {
  return (0.5 * count + 4) * count;
}

/* Enlarges the cells where that reduces the cost of the lists of a subset of
 * the triangles: large triangles lie in many cells, and every pair of them
 * would be found in each.
 * grid    a shape without lists
 * subset  `n` triangles
 * cost    the cost of the lists at the present size; gets that at the size
 *         chosen
 * Returns false when memory ran out. */
USE_RESULT bool triangle_grid_enlarge(struct triangle_grid *grid,
                                      const struct sheet *sheet,
                                      const uint32_t *subset, size_t n,
                                      double *cost);

/* Makes the lists of a subset of the triangles, ascending.
 * footprint  one an item of the subset; NULL: they are computed
 * wanted     as of triangle_grid_fill, and wide triangles are listed only in
 *            those of these cells that they may meet themselves; NULL: all
 *            cells get lists of all triangles whose boxes meet them
 * False when memory ran out, or the caller cancelled. */
USE_RESULT bool triangle_grid_fill_some(struct triangle_grid *grid,
                                        const struct sheet *sheet,
                                        const uint32_t *subset, size_t count,
                                        const struct footprint *footprint,
                                        const uint8_t *wanted);

/* Leaves out duplicates where the longest list has many of them.  Returns false
 * when memory ran out. */
USE_RESULT bool triangle_grid_leave_out_duplicates(struct triangle_grid *grid);

/* Makes a BSP of each list of TRIANGLE_GRID_SPLIT triangles or more.
 * planes  split by planes too: a query then finds what may hide its shape, not
 *         what the shape may hide (bsp.h)
 * Returns false when memory ran out. */
USE_RESULT bool triangle_grid_split(struct triangle_grid *grid, bool planes);

static inline size_t
triangle_grid_cell_count(const struct triangle_grid *grid) {
  return (size_t)grid->columns * (size_t)grid->rows;
}

/* The column or row of a coordinate, clamped to the grid's `count`.
 * v0  the grid's first coordinate */
static inline int triangle_grid_cell(int32_t v, int32_t v0, int shift,
                                     int count) {
  int64_t cell = ((int64_t)v - v0) >> shift;
  return cell < 0 ? 0 : cell >= count ? count - 1 : (int)cell;
}

enum {
  TRIANGLE_GRID_SPREAD = 8,      /* cells per triangle, for lists of all */
  TRIANGLE_GRID_SPLIT = 1024,    /* least list that gets a BSP */
  TRIANGLE_GRID_DUPLICATES = 256 /* least list searched for duplicates */
};

/* Is the triangle not listed, because representatives of its duplicates are? */
static inline bool triangle_grid_leaves_out(const struct triangle_grid *grid,
                                            uint32_t triangle) {
  return grid->left_out != NULL && grid->left_out[triangle] != 0;
}

/* The root of a cell's tree in grid->bsp; SHEET_NONE: it has none. */
static inline uint32_t triangle_grid_bsp(const struct triangle_grid *grid,
                                         size_t cell) {
  return grid->bsp_root != NULL ? grid->bsp_root[cell] : SHEET_NONE;
}

/* A closed range of cells, by columns and rows. */
struct cell_range {
  int x0, y0, x1, y1;
};

/* The cells that a box meets; what lies outside of the grid is clamped to its
 * outermost cells. */
static inline struct cell_range
triangle_grid_cells(const struct triangle_grid *grid, struct box2 box) {
  return (struct cell_range){
      triangle_grid_cell(box.x0, grid->x0, grid->shift, grid->columns),
      triangle_grid_cell(box.y0, grid->y0, grid->shift, grid->rows),
      triangle_grid_cell(box.x1, grid->x0, grid->shift, grid->columns),
      triangle_grid_cell(box.y1, grid->y0, grid->shift, grid->rows)};
}

/* The columns x0 to x1 of row y, within `range`, whose cells the segment p-q
 * may meet; none where x0 > x1. */
void triangle_grid_row(const struct triangle_grid *grid, struct geom_point p,
                       struct geom_point q, struct cell_range range, int y,
                       int *x0, int *x1);

/* Does a box meet so many cells that few of them may meet the triangle? */
static inline bool triangle_grid_is_wide(struct cell_range r) {
  return r.x1 - r.x0 >= 4 && r.y1 - r.y0 >= 4;
}

/* The columns for a triangle of the grid's sheet, whose box meets the cells of
 * `range`, which are wide. */
void triangle_grid_row_of_triangle(const struct triangle_grid *grid,
                                   uint32_t triangle, struct cell_range range,
                                   int y, int *x0, int *x1);

/* The cells that a triangle's box meets, in few bytes, so that passes over all
 * triangles need not load their points; and two numbers for the caller's
 * use. */
struct footprint {
  uint16_t x, y;         /* the lower left cell */
  uint8_t width, height; /* cells less one; FOOTPRINT_LARGE: not stored,
                            computed from the box */
  uint8_t low, high;
};
enum { FOOTPRINT_LARGE = 255 };

static inline struct footprint footprint_of(struct cell_range r, int low,
                                            int high) {
  int width = r.x1 - r.x0, height = r.y1 - r.y0;
  bool large = (width >= FOOTPRINT_LARGE) | (height >= FOOTPRINT_LARGE) |
               ((r.x0 | r.y0) > UINT16_MAX);
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

/* The result of a query, and the set of triangles that are in it; one per
 * thread.  Queries are numbered in 16 bits, to save memory: after 65,535 of
 * them the stamps are cleared. */
struct triangle_grid_query {
  uint16_t *stamp; /* per triangle; == now: it was found */
  uint16_t now;    /* the number of the query */
  uint32_t last;   /* the triangle that hid the last point asked for
                      (occluders.h); SHEET_NONE: none did */
  ARRAY(uint32_t) found;
};

USE_RESULT bool triangle_grid_query_init(struct triangle_grid_query *query,
                                         const struct triangle_grid *grid);
void triangle_grid_query_fini(struct triangle_grid_query *query);

/* Starts a new query: the result is empty. */
void triangle_grid_query_start(const struct triangle_grid *grid,
                               struct triangle_grid_query *query);

/* Marks the triangle as found; returns whether it had not been. */
static inline bool triangle_grid_query_first(struct triangle_grid_query *query,
                                             uint32_t triangle) {
  bool first = query->stamp[triangle] != query->now;
  query->stamp[triangle] = query->now;
  return first;
}

/* Finds every triangle that meets `box`, and maybe others, each once, in an
 * order that depends on the grid alone; of a grid that is not partial, every
 * triangle whose own box does.  False when memory ran out. */
USE_RESULT bool triangle_grid_find(const struct triangle_grid *grid,
                                   struct box2 box,
                                   struct triangle_grid_query *query);

/* Some of the sheet's triangles. */
struct triangle_span {
  const uint32_t *item;
  size_t count;
};

/* Finds every triangle that holds the point p, and maybe others, each once; of
 * a grid that is not partial, every triangle whose box does.
 * found  gets a list of the grid or of the query, until the next query
 * Returns false when memory ran out. */
USE_RESULT static inline bool
triangle_grid_find_at(const struct triangle_grid *grid, struct geom_point p,
                      struct triangle_grid_query *query,
                      struct triangle_span *found) {
  int x = triangle_grid_cell(p.x, grid->x0, grid->shift, grid->columns);
  int y = triangle_grid_cell(p.y, grid->y0, grid->shift, grid->rows);
  size_t cell = triangle_grid_index(grid, x, y);
  const uint32_t *start = grid->lists.start;
  *found = (struct triangle_span){grid->lists.item + start[cell],
                                  start[cell + 1] - start[cell]};
  if (triangle_grid_bsp(grid, cell) == SHEET_NONE)
    return true;
  bool ok = triangle_grid_find(grid, (struct box2){p.x, p.y, p.x, p.y}, query);
  *found = (struct triangle_span){query->found.item, query->found.count};
  return ok;
}

/* As triangle_grid_find, for the segment p-q: the triangles of the cells that
 * it meets.  Triangles of overfull cells that overlap it in no more than a
 * point of the page may be missing. */
USE_RESULT bool triangle_grid_find_along(const struct triangle_grid *grid,
                                         struct geom_point p,
                                         struct geom_point q,
                                         struct triangle_grid_query *query);

/* The same for a triangle of the sheet: those that may overlap it in an area of
 * the page. */
USE_RESULT bool
triangle_grid_find_overlapping(const struct triangle_grid *grid,
                               uint32_t triangle,
                               struct triangle_grid_query *query);

#endif
