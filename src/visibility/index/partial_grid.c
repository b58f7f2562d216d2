/* partial_grid.c - finds the triangles that may meet wanted cells. */
#include "visibility/index/partial_grid.h"

#include "base/poll.h"

bool partial_grid_shape(struct partial_grid *p, const struct sheet *sheet) {
  triangle_grid_shape(&p->grid, sheet, TRIANGLE_GRID_SPREAD, 2);
  p->wanted = mem_calloc(triangle_grid_cell_count(&p->grid), 1);
  return p->wanted != NULL;
}

void partial_grid_want(struct partial_grid *p, struct box2 box) {
  struct cell_range r = triangle_grid_cells(&p->grid, box);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++)
      p->wanted[triangle_grid_index(&p->grid, x, y)] = 1;
}

/* Whether one of a range of cells is wanted, or of those after it. */
static inline bool is_any_wanted(const struct triangle_grid *grid,
                                 const uint8_t *dilated, struct cell_range r) {
  for (int y = r.y0; y <= r.y1; y += 2)
    for (int x = r.x0; x <= r.x1; x += 2)
      if (dilated[triangle_grid_index(grid, x, y)])
        return true;
  return false;
}

/* Lists the triangles that may meet wanted cells, and their cells. */
static bool list_wanted_triangles(const struct partial_grid *p,
                                  const struct sheet *sheet,
                                  const uint8_t *dilated,
                                  struct footprint *footprint, uint32_t *subset,
                                  size_t *count) {
  const struct triangle_grid grid = p->grid;
  for (size_t t = 0; t < sheet->triangle.count; t++) {
    struct box2 b = box2_of_triangle(sheet, (uint32_t)t);
    /* All points of the sheet are in the grid. */
    struct cell_range r = {(int)(((int64_t)b.x0 - grid.x0) >> grid.shift),
                           (int)(((int64_t)b.y0 - grid.y0) >> grid.shift),
                           (int)(((int64_t)b.x1 - grid.x0) >> grid.shift),
                           (int)(((int64_t)b.y1 - grid.y0) >> grid.shift)};
    if (!poll_at(t))
      return false;
    if (!is_any_wanted(&grid, dilated, r))
      continue;
    footprint[*count] = footprint_of(r, 0, 0);
    subset[(*count)++] = (uint32_t)t;
  }
  return true;
}

bool partial_grid_fill(struct partial_grid *p, const struct sheet *sheet) {
  size_t count = 0, all = sheet->triangle.count;
  uint32_t *subset = mem_alloc(all, sizeof *subset);
  struct footprint *footprint = mem_alloc(all, sizeof *footprint);
  uint8_t *dilated = triangle_grid_dilate(&p->grid, p->wanted);
  bool ok =
      subset != NULL && footprint != NULL && dilated != NULL &&
      list_wanted_triangles(p, sheet, dilated, footprint, subset, &count) &&
      triangle_grid_fill_some(&p->grid, sheet, subset, count, footprint,
                              p->wanted) &&
      triangle_grid_split(&p->grid, false);
  mem_free(subset);
  mem_free(footprint);
  mem_free(dilated);
  return ok;
}

void partial_grid_fini(struct partial_grid *p) {
  triangle_grid_fini(&p->grid);
  mem_free(p->wanted);
  p->wanted = NULL;
}
