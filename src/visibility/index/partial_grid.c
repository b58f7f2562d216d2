/* partial_grid.c - finds the triangles that may meet wanted cells by blocks of
 * two by two cells.
 *
 * Most triangles meet two by two blocks at most.  So a block counts as wanted
 * where one of its cells is, or one of the next blocks in x, in y or in both:
 * then one look decides for such a triangle. */
#include "visibility/index/partial_grid.h"

#include "base/poll.h"

struct cell_blocks {
  int shift, columns, rows; /* as of a grid */
  uint8_t *wanted;          /* one a block */
};

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

/* Marks the wanted blocks.  Returns false when memory ran out. */
static bool mark_blocks(const struct partial_grid *p,
                        struct cell_blocks *blocks) {
  const struct triangle_grid *grid = &p->grid;
  blocks->shift = grid->shift + 1;
  blocks->columns = (grid->columns + 1) / 2;
  blocks->rows = (grid->rows + 1) / 2;
  size_t count = (size_t)blocks->columns * (size_t)blocks->rows;
  size_t columns = (size_t)blocks->columns;
  uint8_t *wanted = blocks->wanted = mem_calloc(count, 1);
  if (wanted == NULL)
    return false;
  for (int y = 0; y < grid->rows; y++)
    for (int x = 0; x < grid->columns; x++)
      wanted[(size_t)(y / 2) * columns + (size_t)(x / 2)] |=
          p->wanted[triangle_grid_index(grid, x, y)];
  for (size_t i = 0; i + 1 < count; i++)
    wanted[i] |= wanted[i + 1];
  for (size_t i = 0; i + columns < count; i++)
    wanted[i] |= wanted[i + columns];
  return true;
}

/* Lists the triangles that may meet wanted cells. */
static bool list_wanted_triangles(const struct partial_grid *p,
                                  const struct cell_blocks *blocks,
                                  const struct sheet *sheet, uint32_t *subset,
                                  size_t *count) {
  int32_t x0 = p->grid.x0, y0 = p->grid.y0;
  for (size_t t = 0; t < sheet->triangle.count; t++) {
    struct box2 b = box2_of_triangle(sheet, (uint32_t)t);
    /* All points of the sheet are in the grid. */
    uint32_t x = (uint32_t)(b.x0 - x0) >> blocks->shift,
             y = (uint32_t)(b.y0 - y0) >> blocks->shift,
             right = (uint32_t)(b.x1 - x0) >> blocks->shift,
             top = (uint32_t)(b.y1 - y0) >> blocks->shift;
    bool is_small = right - x <= 1 && top - y <= 1;
    if (!poll_at(t))
      return false;
    subset[*count] = (uint32_t)t;
    *count += !is_small ||
              blocks->wanted[(size_t)y * (size_t)blocks->columns + x] != 0;
  }
  return true;
}

bool partial_grid_fill(struct partial_grid *p, const struct sheet *sheet) {
  struct cell_blocks blocks;
  size_t count = 0;
  uint32_t *subset = mem_alloc(sheet->triangle.count + 1, sizeof *subset);
  bool ok =
      mark_blocks(p, &blocks) && subset != NULL &&
      list_wanted_triangles(p, &blocks, sheet, subset, &count) &&
      triangle_grid_fill_some(&p->grid, sheet, subset, count, p->wanted) &&
      triangle_grid_split(&p->grid, false);
  mem_free(blocks.wanted);
  mem_free(subset);
  return ok;
}

void partial_grid_fini(struct partial_grid *p) {
  triangle_grid_fini(&p->grid);
  mem_free(p->wanted);
  p->wanted = NULL;
}
