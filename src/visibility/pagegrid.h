/* pagegrid.h - which triangles may lie where on the page: a flat grid. */
#ifndef VISIBILITY_PAGEGRID_H
#define VISIBILITY_PAGEGRID_H

#include "view/sheet.h"

struct page_box {
  int32_t x0, y0, x1, y1; /* grid units, closed */
};

static inline int32_t page_least(int32_t a, int32_t b) { return a < b ? a : b; }
static inline int32_t page_most(int32_t a, int32_t b) { return a > b ? a : b; }

static inline struct page_box page_box_of_segment(struct geom_point p,
                                                  struct geom_point q) {
  return (struct page_box){page_least(p.x, q.x), page_least(p.y, q.y),
                           page_most(p.x, q.x), page_most(p.y, q.y)};
}

static inline struct page_box page_box_of_triangle(const struct sheet *sheet,
                                                   uint32_t triangle) {
  const uint32_t *p = sheet->triangle.item[triangle].point;
  const struct geom_point *a = &sheet->point.item[p[0]],
                          *b = &sheet->point.item[p[1]],
                          *c = &sheet->point.item[p[2]];
  return (struct page_box){page_least(a->x, page_least(b->x, c->x)),
                           page_least(a->y, page_least(b->y, c->y)),
                           page_most(a->x, page_most(b->x, c->x)),
                           page_most(a->y, page_most(b->y, c->y))};
}

static inline bool page_boxes_apart(struct page_box a, struct page_box b) {
  return a.x1 < b.x0 || b.x1 < a.x0 || a.y1 < b.y0 || b.y1 < a.y0;
}

/* Cells are squares of 2^shift units; the triangles of cell c are
 * item[start[c] .. start[c + 1]), ascending.  In a pile of copies those that
 * others stand for are not listed (copies.h). */
struct pagegrid {
  int shift, columns, rows;
  int32_t x0, y0; /* lower left corner */
  uint32_t *start, *item;
  uint8_t *left_out; /* one a triangle: not listed; NULL: all are */
  size_t triangle_count;
  const struct sheet *sheet; /* lent */
  struct crowd *crowd;       /* the long lists, parted; NULL: none is */
  uint32_t *crowd_root;      /* one a cell; SHEET_NONE: not parted */
  const double *horizon;     /* what the lists were made with; lent */
};

/* Indexes the boxes of all triangles of the sheet. */
USE_RESULT bool pagegrid_init(struct pagegrid *grid, const struct sheet *sheet);
void pagegrid_fini(struct pagegrid *grid);

/* The same in two steps.  The first chooses the cells: as small as they may
 * be with a triangle in `spread` of them on average, so that memory is linear
 * in the triangles whatever their shape, and at most `cells` cells a
 * triangle.  The second makes the lists.
 * print   the triangles' footprints
 * wanted  the cells that get a list, the others' stay empty
 * horizon one a cell: triangles wholly behind it are left out; NULL: none */
void pagegrid_shape(struct pagegrid *grid, const struct sheet *sheet,
                    unsigned spread, unsigned cells);
struct footprint;
USE_RESULT bool pagegrid_fill(struct pagegrid *grid, const struct sheet *sheet,
                              const struct footprint *print,
                              const uint8_t *wanted, const double *horizon);

/* What a list costs those who look at all pairs in it, in pairs: it is worth a
 * few to be in a list at all. */
static inline double pagegrid_cost_of_list(uint32_t count) {
  return (0.5 * count + 4) * count;
}

/* Takes larger cells where these cost less, for lists of some triangles: large
 * ones are in many cells, and any two of them meet in each.
 * grid  a shape without lists
 * cost  of the lists there would be else; becomes what larger cells cost
 * Returns false when memory ran out. */
USE_RESULT bool pagegrid_enlarge(struct pagegrid *grid,
                                 const struct sheet *sheet,
                                 const uint32_t *some, size_t n, double *cost);

/* Makes such lists, ascending. */
USE_RESULT bool pagegrid_fill_some(struct pagegrid *grid,
                                   const struct sheet *sheet,
                                   const uint32_t *some, size_t count);

/* Parts the long lists of such a grid.
 * planes  by planes too: questions are then about what may hide something
 * Returns false when memory ran out. */
USE_RESULT bool pagegrid_part(struct pagegrid *grid, bool planes);

static inline size_t pagegrid_cell_count(const struct pagegrid *grid) {
  return (size_t)grid->columns * (size_t)grid->rows;
}

static inline int pagegrid_cell(int32_t v, int32_t v0, int shift, int count) {
  int64_t cell = ((int64_t)v - v0) >> shift;
  return cell < 0 ? 0 : cell >= count ? count - 1 : (int)cell;
}

enum {
  PAGEGRID_CROWD = 1024, /* lists from here on are parted */
  PAGEGRID_PILE = 256    /* and from here on searched for copies */
};

/* Do others stand for the triangle? */
static inline bool pagegrid_leaves_out(const struct pagegrid *grid,
                                       uint32_t triangle) {
  return grid->left_out != NULL && grid->left_out[triangle] != 0;
}

/* The root of a cell's list in grid->crowd; SHEET_NONE: it was not parted. */
static inline uint32_t pagegrid_crowd(const struct pagegrid *grid,
                                      size_t cell) {
  return grid->crowd_root != NULL ? grid->crowd_root[cell] : SHEET_NONE;
}

/* Ranges of cells, closed. */
struct cell_range {
  int x0, y0, x1, y1;
};

/* The cells that a box meets; what is off the grid counts to its rim. */
static inline struct cell_range pagegrid_cells(const struct pagegrid *grid,
                                               struct page_box box) {
  return (struct cell_range){
      pagegrid_cell(box.x0, grid->x0, grid->shift, grid->columns),
      pagegrid_cell(box.y0, grid->y0, grid->shift, grid->rows),
      pagegrid_cell(box.x1, grid->x0, grid->shift, grid->columns),
      pagegrid_cell(box.y1, grid->y0, grid->shift, grid->rows)};
}

/* Of row y, within `range`, the cells that the segment p-q meets. */
void pagegrid_row(const struct pagegrid *grid, struct geom_point p,
                  struct geom_point q, struct cell_range range, int y, int *x0,
                  int *x1);

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

static inline struct cell_range footprint_cells(const struct pagegrid *grid,
                                                const struct sheet *sheet,
                                                size_t triangle,
                                                struct footprint print) {
  if (print.width == FOOTPRINT_LARGE)
    return pagegrid_cells(grid,
                          page_box_of_triangle(sheet, (uint32_t)triangle));
  return (struct cell_range){print.x, print.y, print.x + print.width,
                             print.y + print.height};
}

/* A place for answers, one a thread. */
struct pagegrid_query {
  uint32_t *stamp, now;
  ARRAY(uint32_t) found;
};

USE_RESULT bool pagegrid_query_init(struct pagegrid_query *query,
                                    const struct pagegrid *grid);
void pagegrid_query_fini(struct pagegrid_query *query);

/* Forgets the last answer. */
void pagegrid_query_start(const struct pagegrid *grid,
                          struct pagegrid_query *query);

/* Is the triangle not in the answer yet?  From now on it is. */
static inline bool pagegrid_query_first(struct pagegrid_query *query,
                                        uint32_t triangle) {
  bool first = query->stamp[triangle] != query->now;
  query->stamp[triangle] = query->now;
  return first;
}

/* Finds every triangle whose box meets `box` (and some more), each once, in
 * an order that depends on the grid alone.  False when memory ran out. */
USE_RESULT bool pagegrid_find(const struct pagegrid *grid, struct page_box box,
                              struct pagegrid_query *query);

/* The same along the segment from p to q: triangles of the cells it meets.
 * In long lists, those that share no stretch of the page with it may be left
 * out. */
USE_RESULT bool pagegrid_find_along(const struct pagegrid *grid,
                                    struct geom_point p, struct geom_point q,
                                    struct pagegrid_query *query);

/* The same about a triangle of the sheet: those that may share an area of the
 * page with it. */
USE_RESULT bool pagegrid_find_about(const struct pagegrid *grid,
                                    uint32_t triangle,
                                    struct pagegrid_query *query);

#endif
