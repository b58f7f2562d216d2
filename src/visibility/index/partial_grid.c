/* partial_grid.c - finds the triangles that may meet wanted cells. */
#include "visibility/index/partial_grid.h"

#include <limits.h>
#include <stdatomic.h>

#include "base/parallel.h"

enum {
  /* Cells a triangle, on average: those that are looked at, and those among
   * them that list it.  Cells are enlarged until there are no more, so that
   * time and memory are linear in the triangles. */
  LOOKED_AT_MAX = 64,
  LISTED_MAX = 32,
  CELLS_MAX = 2
};

/* A triangle in one of its cells. */
struct triangle_in_cell {
  uint32_t cell, triangle;
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

/* What a range of the triangles has in wanted cells. */
struct wanted_range {
  ARRAY(struct triangle_in_cell) in;
  char apart[PARALLEL_APART];
};

/* The search for the triangles that may meet wanted cells. */
struct wanted_triangles {
  const struct partial_grid *partial;
  const struct sheet *sheet;
  uint8_t *dilated; /* of the wanted cells */
  struct wanted_range *range;
  size_t ranges;
  /* Cells, of all triangles; once one of them is too much, of some. */
  _Atomic uint64_t looked_at, listed;
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

/* How many more cells may be looked at and listed. */
struct cell_counts {
  uint64_t looked_at, listed;
};

static struct cell_counts cells_left(const struct wanted_triangles *all) {
  uint64_t n = all->sheet->triangle.count + 16;
  uint64_t looked_at = all->looked_at, listed = all->listed;
  return (struct cell_counts){
      looked_at < LOOKED_AT_MAX * n ? LOOKED_AT_MAX * n - looked_at : 0,
      listed < LISTED_MAX * n ? LISTED_MAX * n - listed : 0};
}

/* Lists a triangle in those of its cells that are wanted.
 * looked_at  adds the cells that may list it
 * Returns false when memory ran out. */
static bool list_in_wanted_cells(const struct partial_grid *p, uint32_t t,
                                 struct cell_range r, struct wanted_range *own,
                                 uint64_t *looked_at) {
  bool is_wide = triangle_grid_is_wide(r);
  for (int y = r.y0; y <= r.y1; y++) {
    int x0 = r.x0, x1 = r.x1;
    if (is_wide)
      triangle_grid_row_of_triangle(&p->grid, t, r, y, &x0, &x1);
    size_t width = x1 >= x0 ? (size_t)(x1 - x0) + 1 : 0;
    if (!ARRAY_RESERVE(&own->in, width))
      return false;
    struct triangle_in_cell *to = own->in.item + own->in.count;
    size_t cell = triangle_grid_index(&p->grid, x0, y);
    for (size_t end = cell + width; cell < end; cell++)
      if (p->wanted[cell])
        *to++ = (struct triangle_in_cell){(uint32_t)cell, t};
    own->in.count = (size_t)(to - own->in.item);
    *looked_at += width > 0 ? width : 1;
  }
  return true;
}

/* The cells that the box of a triangle meets: all points of the sheet are in
 * the grid. */
static inline struct cell_range cells_of_box(const struct triangle_grid *grid,
                                             struct box2 b) {
  uint32_t x = (uint32_t)grid->x0, y = (uint32_t)grid->y0;
  return (struct cell_range){(int)(((uint32_t)b.x0 - x) >> grid->shift),
                             (int)(((uint32_t)b.y0 - y) >> grid->shift),
                             (int)(((uint32_t)b.x1 - x) >> grid->shift),
                             (int)(((uint32_t)b.y1 - y) >> grid->shift)};
}

/* Lists those of a range's triangles that may meet wanted cells; ends where
 * there is too much. */
static bool list_wanted_of_range(void *user, struct parallel_range range) {
  struct wanted_triangles *all = user;
  struct wanted_range *own = &all->range[range.begin / PARALLEL_ITEMS];
  const struct triangle_grid grid = all->partial->grid;
  const struct sheet sheet = *all->sheet;
  const uint8_t *dilated = all->dilated;
  struct cell_counts left = cells_left(all);
  uint64_t looked_at = 0;
  own->in.count = 0;
  bool ok = ARRAY_RESERVE(&own->in, range.end - range.begin);
  for (size_t t = range.begin; ok && t < range.end; t++) {
    struct cell_range r =
        cells_of_box(&grid, box2_of_triangle(&sheet, (uint32_t)t));
    if (triangle_grid_is_wide(r) || is_any_wanted(&grid, dilated, r))
      ok = list_in_wanted_cells(all->partial, (uint32_t)t, r, own, &looked_at);
    else
      looked_at += (uint64_t)(r.x1 - r.x0 + r.y1 - r.y0 + 1);
    if (looked_at > left.looked_at || own->in.count > left.listed)
      break;
  }
  all->looked_at += looked_at;
  all->listed += own->in.count;
  return ok;
}

/* Lists the triangles that may meet wanted cells.
 * many  gets whether there are too many */
static bool list_wanted_triangles(struct wanted_triangles *all, bool *many) {
  size_t n = all->sheet->triangle.count;
  int workers = parallel_workers(n, PARALLEL_ITEMS);
  all->looked_at = all->listed = 0;
  bool ok =
      parallel_ranges(workers, n, PARALLEL_ITEMS, list_wanted_of_range, all);
  struct cell_counts left = cells_left(all);
  *many = left.looked_at == 0 || left.listed == 0;
  return ok;
}

/* Enlarges cells until few enough triangles meet wanted ones. */
static bool fit_cells(struct partial_grid *p, struct wanted_triangles *all) {
  bool many = true, ok = true;
  while (ok && many) {
    all->dilated = triangle_grid_dilate(&p->grid, p->wanted);
    ok = all->dilated != NULL && list_wanted_triangles(all, &many) &&
         (!many || double_cells(p));
    mem_free(all->dilated);
  }
  return ok;
}

/* Puts what ranges listed into the lists of cells, from the last one on. */
static void put_into_lists(const struct wanted_triangles *all,
                           struct number_lists *lists) {
  for (size_t r = all->ranges; r-- > 0;) {
    const struct wanted_range *range = &all->range[r];
    for (size_t i = range->in.count; i-- > 0;)
      number_lists_put(lists, range->in.item[i].cell,
                       range->in.item[i].triangle);
  }
}

static bool make_wanted_lists(struct triangle_grid *grid,
                              const struct wanted_triangles *all) {
  size_t cells = triangle_grid_cell_count(grid);
  if (!number_lists_init(&grid->lists, cells))
    return false;
  put_into_lists(all, &grid->lists);
  if (!number_lists_allocate(&grid->lists, cells))
    return false;
  put_into_lists(all, &grid->lists);
  return triangle_grid_leave_out_duplicates(grid);
}

bool partial_grid_fill(struct partial_grid *p, const struct sheet *sheet) {
  size_t ranges = parallel_range_count(sheet->triangle.count, PARALLEL_ITEMS);
  struct wanted_triangles all = {.partial = p,
                                 .sheet = sheet,
                                 .ranges = ranges,
                                 .range =
                                     mem_calloc(ranges, sizeof *all.range)};
  bool ok = all.range != NULL && fit_cells(p, &all) &&
            make_wanted_lists(&p->grid, &all) &&
            triangle_grid_split(&p->grid, false);
  for (size_t r = 0; all.range != NULL && r < ranges; r++)
    ARRAY_FREE(&all.range[r].in);
  mem_free(all.range);
  return ok;
}

void partial_grid_fini(struct partial_grid *p) {
  triangle_grid_fini(&p->grid);
  mem_free(p->wanted);
  p->wanted = NULL;
}
