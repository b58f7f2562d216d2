/* partial_grid.c - finds the triangles that may meet wanted cells. */
#include "visibility/index/partial_grid.h"

#include <limits.h>
#include <stdatomic.h>

#include "base/parallel.h"
#include "base/ranked_set.h"

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

/* Words of a set's bits in a range. */
enum { RANGE_WORDS = PARALLEL_RANGE(POLL_ITEMS / 64) };

/* The search for the triangles that may meet wanted cells. */
struct wanted_triangles {
  const struct partial_grid *partial;
  const struct sheet *sheet;
  uint8_t *dilated;      /* of the wanted cells */
  struct ranked_set set; /* of these triangles */
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

struct cell_counts {
  uint64_t looked_at, listed;
};

static inline bool is_more(struct cell_counts a, struct cell_counts b) {
  return a.looked_at > b.looked_at || a.listed > b.listed;
}

/* How many more cells may be looked at and listed. */
static struct cell_counts cells_left(const struct wanted_triangles *all) {
  uint64_t n = all->sheet->triangle.count + 16;
  uint64_t looked_at = all->looked_at, listed = all->listed;
  return (struct cell_counts){
      looked_at < LOOKED_AT_MAX * n ? LOOKED_AT_MAX * n - looked_at : 0,
      listed < LISTED_MAX * n ? LISTED_MAX * n - listed : 0};
}

/* Counts the cells that may list a triangle, and those that do. */
static struct cell_counts count_cells(const struct partial_grid *p, uint32_t t,
                                      struct cell_range r) {
  struct cell_counts counts = {0, 0};
  bool is_wide = triangle_grid_is_wide(r);
  for (int y = r.y0; y <= r.y1; y++) {
    int x0 = r.x0, x1 = r.x1;
    if (is_wide)
      triangle_grid_row_of_triangle(&p->grid, t, r, y, &x0, &x1);
    for (int x = x0; x <= x1; x++)
      counts.listed += p->wanted[triangle_grid_index(&p->grid, x, y)];
    counts.looked_at += (uint64_t)(x1 >= x0 ? x1 - x0 + 1 : 1);
  }
  return counts;
}

/* The cells that the box of a triangle meets: all points of the sheet are in
 * the grid. */
static inline struct cell_range cells_of_box(const struct triangle_grid *grid,
                                             struct box2 b) {
  return (struct cell_range){(int)(((int64_t)b.x0 - grid->x0) >> grid->shift),
                             (int)(((int64_t)b.y0 - grid->y0) >> grid->shift),
                             (int)(((int64_t)b.x1 - grid->x0) >> grid->shift),
                             (int)(((int64_t)b.y1 - grid->y0) >> grid->shift)};
}

/* Adds those of a range's triangles that may meet wanted cells to the set; ends
 * where there is too much. */
static bool add_wanted_of_range(void *user, struct parallel_range range) {
  struct wanted_triangles *all = user;
  const struct triangle_grid grid = all->partial->grid;
  const uint8_t *dilated = all->dilated;
  struct cell_counts left = cells_left(all), sum = {0, 0};
  size_t end = range.end * 64 < all->sheet->triangle.count
                   ? range.end * 64
                   : all->sheet->triangle.count;
  for (size_t t = range.begin * 64; t < end && !is_more(sum, left); t++) {
    struct cell_range r =
        cells_of_box(&grid, box2_of_triangle(all->sheet, (uint32_t)t));
    if (!triangle_grid_is_wide(r) && !is_any_wanted(&grid, dilated, r)) {
      sum.looked_at += (uint64_t)(r.x1 - r.x0 + r.y1 - r.y0 + 1);
      continue;
    }
    struct cell_counts counts = count_cells(all->partial, (uint32_t)t, r);
    sum.looked_at += counts.looked_at;
    sum.listed += counts.listed;
    if (counts.listed > 0)
      ranked_set_add(&all->set, (uint32_t)t);
  }
  all->looked_at += sum.looked_at;
  all->listed += sum.listed;
  return true;
}

/* Finds the triangles that may meet wanted cells.
 * many  gets whether there are too many */
static bool find_wanted_triangles(struct wanted_triangles *all, bool *many) {
  size_t n = all->sheet->triangle.count;
  int workers = parallel_workers(n, PARALLEL_ITEMS);
  all->looked_at = all->listed = 0;
  ranked_set_clear(&all->set);
  bool ok = parallel_ranges(workers, (n + 63) / 64, RANGE_WORDS,
                            add_wanted_of_range, all);
  struct cell_counts left = cells_left(all);
  *many = left.looked_at == 0 || left.listed == 0;
  return ok;
}

/* Enlarges cells until few enough triangles meet wanted ones. */
static bool fit_cells(struct partial_grid *p, struct wanted_triangles *all) {
  bool many = true, ok = true;
  while (ok && many) {
    all->dilated = triangle_grid_dilate(&p->grid, p->wanted);
    ok = all->dilated != NULL && find_wanted_triangles(all, &many) &&
         (!many || double_cells(p));
    mem_free(all->dilated);
  }
  return ok;
}

/* Makes the lists of the triangles of a set. */
static bool list_wanted_triangles(struct partial_grid *p,
                                  const struct sheet *sheet,
                                  struct ranked_set *set) {
  ranked_set_index(set);
  size_t n = set->count, i = 0;
  uint32_t *subset = mem_alloc(n, sizeof *subset);
  struct footprint *footprint = mem_alloc(n, sizeof *footprint);
  bool ok = subset != NULL && footprint != NULL;
  for (size_t w = 0; ok && w < set->words; w++) {
    for (uint64_t left = set->word[w]; left != 0; left &= left - 1) {
      subset[i] = (uint32_t)(w * 64) + (uint32_t)__builtin_ctzll(left);
      struct box2 box = box2_of_triangle(sheet, subset[i]);
      footprint[i++] = footprint_of(cells_of_box(&p->grid, box), 0, 0);
    }
  }
  ok = ok && triangle_grid_fill_some(&p->grid, sheet, subset, n, footprint,
                                     p->wanted);
  mem_free(subset);
  mem_free(footprint);
  return ok;
}

bool partial_grid_fill(struct partial_grid *p, const struct sheet *sheet) {
  struct wanted_triangles all = {.partial = p, .sheet = sheet};
  bool ok = ranked_set_init(&all.set, sheet->triangle.count) &&
            fit_cells(p, &all) && list_wanted_triangles(p, sheet, &all.set) &&
            triangle_grid_split(&p->grid, false);
  ranked_set_fini(&all.set);
  return ok;
}

void partial_grid_fini(struct partial_grid *p) {
  triangle_grid_fini(&p->grid);
  mem_free(p->wanted);
  p->wanted = NULL;
}
