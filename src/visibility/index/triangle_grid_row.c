/* triangle_grid_row.c - finds which cells of a row segments and triangles may
 * meet. */
#include "visibility/index/triangle_grid.h"

void triangle_grid_row(const struct triangle_grid *grid, struct geom_point p,
                       struct geom_point q, struct cell_range range, int y,
                       int *x0, int *x1) {
  int64_t dx = (int64_t)q.x - p.x, dy = (int64_t)q.y - p.y, low, high;
  double a, b, from, to;
  *x0 = range.x0;
  *x1 = range.x1;
  if (range.y0 == range.y1 || range.x0 == range.x1)
    return;
  /* The x at which the segment enters and leaves the row, rounded outwards. */
  low = grid->y0 + ((int64_t)y << grid->shift) - p.y;
  high = low + (INT64_C(1) << grid->shift);
  a = (double)p.x + (double)dx * ((double)low / (double)dy);
  b = (double)p.x + (double)dx * ((double)high / (double)dy);
  from = (a < b ? a : b) - 1;
  to = (a < b ? b : a) + 1;
  if (from > -0x1p30) {
    int x = triangle_grid_cell((int32_t)from - 1, grid->x0, grid->shift,
                               grid->columns);
    if (x > *x0)
      *x0 = x;
  }
  if (to < 0x1p30) {
    int x = triangle_grid_cell((int32_t)to + 1, grid->x0, grid->shift,
                               grid->columns);
    if (x < *x1)
      *x1 = x;
  }
}

/* Adds the columns of a row that a segment's cells have there. */
static void add_row_of_segment(const struct triangle_grid *grid,
                               struct geom_point p, struct geom_point q, int y,
                               int *x0, int *x1) {
  int from, to;
  struct cell_range r = triangle_grid_cells(grid, box2_of_segment(p, q));
  if (y < r.y0 || y > r.y1)
    return;
  triangle_grid_row(grid, p, q, r, y, &from, &to);
  *x0 = from < *x0 ? from : *x0;
  *x1 = to > *x1 ? to : *x1;
}

void triangle_grid_row_of_triangle(const struct triangle_grid *grid,
                                   uint32_t triangle, struct cell_range range,
                                   int y, int *x0, int *x1) {
  struct geom_triangle t = sheet_corners(grid->sheet, triangle);
  *x0 = range.x1;
  *x1 = range.x0;
  for (int k = 0; k < 3; k++)
    add_row_of_segment(grid, t.p[k], t.p[geom_next_corner(k)], y, x0, x1);
}
