/* partial_grid.c - finds the triangles that may meet wanted cells. */
#include "visibility/index/partial_grid.h"

#include <limits.h>

#include "base/poll.h"

enum {
  /* Cells a triangle, on average: those that are looked at, and those among
   * them that list it.  Cells are enlarged until there are no more, so that
   * time and memory are linear in the triangles. */
  LOOKED_AT_MAX = 64,
  LISTED_MAX = 32,
  CELLS_MAX = 2
};

bool partial_grid_shape(struct partial_grid *p, const struct sheet *sheet) {
  triangle_grid_shape(&p->grid, sheet, UINT_MAX, CELLS_MAX);
  p->grid.sheet = sheet;
  p->wanted = mem_calloc(triangle_grid_cell_count(&p->grid), 1);
  return p->wanted != NULL;
}

void partial_grid_want(struct partial_grid *p, struct box2 box) {
  struct cell_range r = triangle_grid_cells(&p->grid, box);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++)
      p->wanted[triangle_grid_index(&p->grid, x, y)] = 1;
}

/* Doubles the side of the cells.  Returns false when memory ran out. */
static bool double_cells(struct partial_grid *p) {
  struct triangle_grid old = p->grid;
  p->grid.shift++;
  p->grid.columns = (old.columns + 1) / 2;
  p->grid.rows = (old.rows + 1) / 2;
  uint8_t *wanted = mem_calloc(triangle_grid_cell_count(&p->grid), 1);
  if (wanted == NULL)
    return false;
  for (int y = 0; y < old.rows; y++)
    for (int x = 0; x < old.columns; x++)
      wanted[triangle_grid_index(&p->grid, x / 2, y / 2)] |=
          p->wanted[triangle_grid_index(&old, x, y)];
  mem_free(p->wanted);
  p->wanted = wanted;
  return true;
}

/* ---- Triangles ----------------------------------------------------------- */

/* The triangles that may meet wanted cells. */
struct wanted_triangles {
  uint32_t *subset;
  struct footprint *footprint;
  size_t count;
  uint64_t looked_at, listed; /* cells, of all triangles */
  uint8_t *dilated;           /* of the wanted cells */
};

/* Whether one of a range of cells is wanted, or of those after it. */
static inline bool is_any_wanted(const struct triangle_grid *grid,
                                 const uint8_t *dilated, struct cell_range r) {
  for (int y = r.y0; y <= r.y1; y += 2)
    for (int x = r.x0; x <= r.x1; x += 2)
      if (dilated[triangle_grid_index(grid, x, y)])
        return true;
  return false;
}

/* Counts the cells that may list a triangle, and those that do. */
static uint64_t count_cells(const struct partial_grid *p, uint32_t t,
                            struct cell_range r, struct wanted_triangles *all) {
  uint64_t listed = 0;
  bool is_wide = triangle_grid_is_wide(r);
  for (int y = r.y0; y <= r.y1; y++) {
    int x0 = r.x0, x1 = r.x1;
    if (is_wide)
      triangle_grid_row_of_triangle(&p->grid, t, r, y, &x0, &x1);
    for (int x = x0; x <= x1; x++)
      listed += p->wanted[triangle_grid_index(&p->grid, x, y)];
    all->looked_at += (uint64_t)(x1 >= x0 ? x1 - x0 + 1 : 1);
  }
  all->listed += listed;
  return listed;
}

/* Lists the triangles that may meet wanted cells, and their cells.
 * many  gets whether there are too many */
static bool list_wanted_triangles(const struct partial_grid *p,
                                  const struct sheet *sheet,
                                  struct wanted_triangles *all, bool *many) {
  const struct triangle_grid grid = p->grid;
  uint64_t n = sheet->triangle.count + 16;
  *many = false;
  all->looked_at = all->listed = all->count = 0;
  for (size_t t = 0; t < sheet->triangle.count && !*many; t++) {
    struct box2 b = box2_of_triangle(sheet, (uint32_t)t);
    /* All points of the sheet are in the grid. */
    struct cell_range r = {(int)(((int64_t)b.x0 - grid.x0) >> grid.shift),
                           (int)(((int64_t)b.y0 - grid.y0) >> grid.shift),
                           (int)(((int64_t)b.x1 - grid.x0) >> grid.shift),
                           (int)(((int64_t)b.y1 - grid.y0) >> grid.shift)};
    if (!poll_at(t))
      return false;
    if (!triangle_grid_is_wide(r) && !is_any_wanted(&grid, all->dilated, r)) {
      all->looked_at += (uint64_t)(r.x1 - r.x0 + r.y1 - r.y0 + 1);
    } else if (count_cells(p, (uint32_t)t, r, all) > 0) {
      all->footprint[all->count] = footprint_of(r, 0, 0);
      all->subset[all->count++] = (uint32_t)t;
    }
    *many = all->looked_at > LOOKED_AT_MAX * n || all->listed > LISTED_MAX * n;
  }
  return true;
}

/* Enlarges cells until few enough triangles meet wanted ones. */
static bool fit_cells(struct partial_grid *p, const struct sheet *sheet,
                      struct wanted_triangles *all) {
  bool many = true, ok = true;
  while (ok && many) {
    all->dilated = triangle_grid_dilate(&p->grid, p->wanted);
    ok = all->dilated != NULL && list_wanted_triangles(p, sheet, all, &many) &&
         (!many || double_cells(p));
    mem_free(all->dilated);
  }
  return ok;
}

bool partial_grid_fill(struct partial_grid *p, const struct sheet *sheet) {
  size_t n = sheet->triangle.count;
  struct wanted_triangles all = {.subset = mem_alloc(n, sizeof *all.subset),
                                 .footprint =
                                     mem_alloc(n, sizeof *all.footprint)};
  bool ok = all.subset != NULL && all.footprint != NULL &&
            fit_cells(p, sheet, &all) &&
            triangle_grid_fill_some(&p->grid, sheet, all.subset, all.count,
                                    all.footprint, p->wanted) &&
            triangle_grid_split(&p->grid, false);
  mem_free(all.subset);
  mem_free(all.footprint);
  return ok;
}

void partial_grid_fini(struct partial_grid *p) {
  triangle_grid_fini(&p->grid);
  mem_free(p->wanted);
  p->wanted = NULL;
}
