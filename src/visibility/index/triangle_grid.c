/* triangle_grid.c - a uniform grid over the page, with the triangles of each
 * cell. */
#include "visibility/index/triangle_grid.h"

#include <string.h>

#include "base/number_filter.h"
#include "base/parallel.h"
#include "base/poll.h"
#include "visibility/index/bsp.h"
#include "visibility/index/duplicate_triangles.h"

enum {
  MAX_SHIFT = 31,
  SAMPLE = 1 << 12 /* triangles sampled to choose the cells */
};

/* Do the boxes meet at most `spread` cells of 2^shift units on average?
 * Estimated from every stride-th triangle. */
static bool is_spread(const struct sheet *sheet, int shift, unsigned spread) {
  size_t n = sheet->triangle.count, stride = n / SAMPLE + 1;
  uint64_t cells = 0, limit = (uint64_t)spread * (n / stride) + 64;
  for (size_t t = 0; t < n && cells <= limit; t += stride) {
    sheet_prefetch_sampled(sheet, t, stride);
    struct box2 b = box2_of_triangle(sheet, (uint32_t)t);
    cells += ((uint64_t)(((int64_t)b.x1 - b.x0) >> shift) + 1) *
             ((uint64_t)(((int64_t)b.y1 - b.y0) >> shift) + 1);
  }
  return cells <= limit;
}

/* How many cells of 2^shift units cover the range from..to. */
static uint64_t cells_across(int32_t from, int32_t to, int shift) {
  return (((uint64_t)((int64_t)to - from) + 1) >> shift) + 1;
}

static void shape(struct triangle_grid *grid, const struct sheet *sheet,
                  struct box2 all, int shift) {
  memset(grid, 0, sizeof *grid);
  grid->triangle_count = sheet->triangle.count;
  grid->x0 = all.x0;
  grid->y0 = all.y0;
  grid->shift = shift;
  grid->columns = (int)cells_across(all.x0, all.x1, shift);
  grid->rows = (int)cells_across(all.y0, all.y1, shift);
}

void triangle_grid_shape(struct triangle_grid *grid, const struct sheet *sheet,
                         unsigned spread, unsigned most) {
  struct box2 all = box2_of_sheet(sheet);
  uint64_t capacity = (uint64_t)most * sheet->triangle.count + 16;
  int shift = 0;
  while (shift < MAX_SHIFT && (cells_across(all.x0, all.x1, shift) *
                                       cells_across(all.y0, all.y1, shift) >
                                   capacity ||
                               !is_spread(sheet, shift, spread)))
    shift++;
  shape(grid, sheet, all, shift);
}

/* The cost of the grid's lists, were they made of this subset of the triangles
 * (triangle_grid_cost_of_list).
 * count  per cell: scratch */
static double cost_of_pairs(const struct triangle_grid *grid,
                            const struct sheet *sheet, const uint32_t *subset,
                            size_t n, uint32_t *count) {
  size_t cells = triangle_grid_cell_count(grid);
  double cost = 0;
  memset(count, 0, cells * sizeof *count);
  for (size_t i = 0; i < n; i++) {
    struct cell_range r =
        triangle_grid_cells(grid, box2_of_triangle(sheet, subset[i]));
    for (int y = r.y0; y <= r.y1; y++)
      for (int x = r.x0; x <= r.x1; x++)
        count[triangle_grid_index(grid, x, y)]++;
  }
  for (size_t c = 0; c < cells; c++)
    cost += triangle_grid_cost_of_list(count[c]);
  return cost;
}

bool triangle_grid_enlarge(struct triangle_grid *grid,
                           const struct sheet *sheet, const uint32_t *subset,
                           size_t n, double *cost) {
  struct box2 all = box2_of_sheet(sheet);
  struct triangle_grid next;
  int shift = grid->shift;
  uint32_t *count = mem_alloc(triangle_grid_cell_count(grid), sizeof *count);
  double now = *cost;
  if (count == NULL)
    return false;
  /* Starting with one cell for all, cells are halved as long as the cost is
   * below twice the least cost so far. */
  while (shift < MAX_SHIFT && cells_across(all.x0, all.x1, shift) *
                                      cells_across(all.y0, all.y1, shift) >
                                  1)
    shift++;
  for (; shift > grid->shift && now < 2 * *cost; shift--) {
    shape(&next, sheet, all, shift);
    now = cost_of_pairs(&next, sheet, subset, n, count);
    if (now >= *cost)
      continue;
    *cost = now;
    *grid = next;
  }
  mem_free(count);
  return true;
}

/* Input of the lists. */
struct filling {
  struct triangle_grid *grid;
  const struct sheet *sheet;
  const struct footprint *footprint; /* NULL: computed */
  bool by_subset;         /* footprints are one an item of the subset; else one
                             a triangle */
  const uint8_t *wanted;  /* per cell: it gets a list; NULL: all do */
  const uint32_t *subset; /* the triangles that may be listed; NULL: all */
  size_t count;
};

/* Puts a triangle, by its index in the subset, into its cells' lists. */
static void fill_triangle(const struct filling *filling,
                          struct number_lists *lists, size_t index) {
  uint32_t t =
      filling->subset != NULL ? filling->subset[index] : (uint32_t)index;
  const struct triangle_grid *grid = filling->grid;
  const struct sheet *sheet = filling->sheet;
  const uint8_t *wanted = filling->wanted;
  struct cell_range r =
      filling->footprint != NULL
          ? footprint_cells(grid, sheet, t,
                            filling->footprint[filling->by_subset ? index : t])
          : triangle_grid_cells(grid, box2_of_triangle(sheet, t));
  bool tight = triangle_grid_is_wide(r) && filling->by_subset && wanted != NULL;
  for (int y = r.y0; y <= r.y1; y++) {
    int x0 = r.x0, x1 = r.x1;
    if (tight)
      triangle_grid_row_of_triangle(grid, t, r, y, &x0, &x1);
    size_t cell = triangle_grid_index(grid, x0, y);
    for (int x = x0; x <= x1; x++, cell++)
      if (wanted == NULL || wanted[cell])
        number_lists_put(lists, cell, t);
  }
}

/* A pass over a range of the triangles, from the last to the first. */
static void fill_cells(void *user, struct number_lists *lists,
                       struct parallel_range range) {
  const struct filling *filling = user;
  for (size_t i = range.end; i-- > range.begin;) {
    (void)poll_at(i);
    fill_triangle(filling, lists, i);
  }
}

/* Removes the triangles that are left out from the lists. */
static void shorten_lists(struct triangle_grid *grid) {
  size_t cells = triangle_grid_cell_count(grid);
  uint32_t kept = 0, i = 0;
  for (size_t c = 0; c < cells; c++) {
    uint32_t end = grid->lists.start[c + 1];
    grid->lists.start[c] = kept;
    for (; i < end; i++)
      if (!grid->left_out[grid->lists.item[i]])
        grid->lists.item[kept++] = grid->lists.item[i];
  }
  grid->lists.start[cells] = kept;
}

bool triangle_grid_leave_out_duplicates(struct triangle_grid *grid) {
  size_t cells = triangle_grid_cell_count(grid), longest = 0;
  const uint32_t *start = grid->lists.start;
  bool many;
  for (size_t c = 1; c < cells; c++)
    if (start[c + 1] - start[c] > start[longest + 1] - start[longest])
      longest = c;
  size_t count = start[longest + 1] - start[longest];
  if (count < TRIANGLE_GRID_DUPLICATES)
    return true;
  if (!duplicate_triangles_are_many(
          grid->sheet, grid->lists.item + start[longest], count, &many))
    return false;
  if (!many)
    return true;
  if (!duplicate_triangles_find(grid->sheet, &grid->left_out))
    return false;
  shorten_lists(grid);
  return true;
}

bool triangle_grid_split(struct triangle_grid *grid, bool planes) {
  size_t cells = triangle_grid_cell_count(grid);
  for (size_t c = 0; c < cells; c++) {
    size_t count = grid->lists.start[c + 1] - grid->lists.start[c];
    if (count < TRIANGLE_GRID_SPLIT)
      continue;
    if (grid->bsp == NULL) {
      grid->bsp = mem_calloc(1, sizeof *grid->bsp);
      grid->bsp_root = mem_alloc(cells, sizeof *grid->bsp_root);
      if (grid->bsp == NULL || grid->bsp_root == NULL)
        return false;
      memset(grid->bsp_root, 0xff, cells * sizeof *grid->bsp_root);
    }
    if (!bsp_add(grid->bsp, grid->sheet,
                 grid->lists.item + grid->lists.start[c], count, planes,
                 &grid->bsp_root[c]))
      return false;
  }
  return true;
}

/* How many threads fill the lists: one where there are more cells than
 * triangles, so that starts of their own are little for each. */
static int filling_workers(const struct filling *filling, size_t cells) {
  return cells <= filling->count
             ? parallel_workers(filling->count, PARALLEL_ITEMS)
             : 1;
}

static bool fill(struct filling *filling) {
  struct triangle_grid *grid = filling->grid;
  size_t cells = triangle_grid_cell_count(grid);
  grid->sheet = filling->sheet;
  bool ok =
      number_lists_make(&grid->lists, cells, filling_workers(filling, cells),
                        filling->count, fill_cells, filling);
  ok = ok && triangle_grid_leave_out_duplicates(grid);
  if (!ok)
    triangle_grid_fini(grid);
  return ok;
}

uint8_t *triangle_grid_dilate(const struct triangle_grid *grid,
                              const uint8_t *wanted) {
  size_t n = triangle_grid_cell_count(grid), columns = (size_t)grid->columns;
  uint8_t *dilated = mem_alloc(n, 1);
  if (dilated == NULL)
    return NULL;
  for (size_t i = 0; i + 1 < n; i++)
    dilated[i] = wanted[i] | wanted[i + 1];
  dilated[n - 1] = wanted[n - 1];
  for (size_t i = 0; i + columns < n; i++)
    dilated[i] |= dilated[i + columns];
  return dilated;
}

/* The triangles among which those of wanted cells are. */
struct choice {
  const struct triangle_grid *grid;
  const struct footprint *footprint;
  const uint8_t *dilated; /* triangle_grid_dilate */
};

/* Keeps those that meet wanted cells, and maybe a few more. */
static size_t choose_of_range(const void *user, struct parallel_range range,
                              uint32_t *kept) {
  const struct choice *choice = user;
  size_t columns = (size_t)choice->grid->columns, count = 0;
  for (size_t t = range.begin; t < range.end; t++) {
    struct footprint f = choice->footprint[t];
    bool small = f.width <= 1 && f.height <= 1;
    if (!small || choice->dilated[(size_t)f.y * columns + f.x])
      kept[count++] = (uint32_t)t;
  }
  return count;
}

bool triangle_grid_fill(struct triangle_grid *grid, const struct sheet *sheet,
                        const struct footprint *footprint,
                        const uint8_t *wanted) {
  size_t count;
  uint32_t *subset = NULL;
  struct choice choice = {grid, footprint, triangle_grid_dilate(grid, wanted)};
  if (choice.dilated != NULL)
    subset =
        number_filter(grid->triangle_count, choose_of_range, &choice, &count);
  mem_free((void *)(uintptr_t)choice.dilated);
  bool ok = subset != NULL && fill(&(struct filling){.grid = grid,
                                                     .sheet = sheet,
                                                     .footprint = footprint,
                                                     .wanted = wanted,
                                                     .subset = subset,
                                                     .count = count});
  mem_free(subset);
  return ok;
}

bool triangle_grid_init(struct triangle_grid *grid, const struct sheet *sheet) {
  triangle_grid_shape(grid, sheet, TRIANGLE_GRID_SPREAD, 2);
  if (fill(&(struct filling){
          .grid = grid, .sheet = sheet, .count = sheet->triangle.count}) &&
      triangle_grid_split(grid, false))
    return true;
  triangle_grid_fini(grid);
  return false;
}

bool triangle_grid_fill_some(struct triangle_grid *grid,
                             const struct sheet *sheet, const uint32_t *subset,
                             size_t count, const struct footprint *footprint,
                             const uint8_t *wanted) {
  return fill(&(struct filling){.grid = grid,
                                .sheet = sheet,
                                .footprint = footprint,
                                .by_subset = true,
                                .wanted = wanted,
                                .subset = subset,
                                .count = count});
}

void triangle_grid_fini(struct triangle_grid *grid) {
  number_lists_fini(&grid->lists);
  if (grid->bsp != NULL)
    bsp_fini(grid->bsp);
  mem_free(grid->bsp);
  mem_free(grid->bsp_root);
  mem_free(grid->left_out);
  grid->bsp_root = NULL;
  grid->left_out = NULL;
  grid->bsp = NULL;
}

bool triangle_grid_query_init(struct triangle_grid_query *query,
                              const struct triangle_grid *grid) {
  size_t count = grid->triangle_count + 1;
  memset(query, 0, sizeof *query);
  query->last = SHEET_NONE;
  query->stamp = mem_alloc(count, sizeof *query->stamp);
  /* A page that is read before it is written faults twice, and interrupts the
   * other threads: so all is written by the thread that reads it. */
  if (query->stamp != NULL)
    memset(query->stamp, 0, count * sizeof *query->stamp);
  return query->stamp != NULL;
}

void triangle_grid_query_fini(struct triangle_grid_query *query) {
  mem_free(query->stamp);
  query->stamp = NULL;
  ARRAY_FREE(&query->found);
}

void triangle_grid_query_start(const struct triangle_grid *grid,
                               struct triangle_grid_query *query) {
  query->found.count = 0;
  if (++query->now == 0) {
    memset(query->stamp, 0, grid->triangle_count * sizeof *query->stamp);
    query->now = 1;
  }
}

/* Adds a triangle to the result, unless it is there already. */
static bool visit(struct triangle_grid_query *query, uint32_t t) {
  return !triangle_grid_query_first(query, t) || ARRAY_PUSH(&query->found, t);
}

static bool visit_bsp(const struct triangle_grid *grid, uint32_t root,
                      const struct bsp_query *shape,
                      struct triangle_grid_query *query) {
  struct bsp_traversal traversal = bsp_traversal_from(root);
  const struct bsp_node *node;
  while ((node = bsp_next(grid->bsp, &traversal, shape)) != NULL)
    for (uint32_t i = node->from; i < node->from + node->count; i++)
      if (!visit(query, grid->bsp->member.item[i].triangle))
        return false;
  return true;
}

static bool visit_cell(const struct triangle_grid *grid, int x, int y,
                       const struct bsp_query *shape,
                       struct triangle_grid_query *query) {
  size_t cell = triangle_grid_index(grid, x, y);
  uint32_t root = triangle_grid_bsp(grid, cell);
  if (root != SHEET_NONE)
    return visit_bsp(grid, root, shape, query);
  for (uint32_t i = grid->lists.start[cell]; i < grid->lists.start[cell + 1];
       i++)
    if (!visit(query, grid->lists.item[i]))
      return false;
  return true;
}

static bool find_in_box(const struct triangle_grid *grid,
                        const struct bsp_query *shape,
                        struct triangle_grid_query *query) {
  struct cell_range r = triangle_grid_cells(grid, shape->box);
  triangle_grid_query_start(grid, query);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++)
      if (!visit_cell(grid, x, y, shape, query))
        return false;
  return true;
}

bool triangle_grid_find(const struct triangle_grid *grid, struct box2 box,
                        struct triangle_grid_query *query) {
  const struct bsp_query shape = {.kind = BSP_BOX, .box = box};
  return find_in_box(grid, &shape, query);
}

bool triangle_grid_find_overlapping(const struct triangle_grid *grid,
                                    uint32_t triangle,
                                    struct triangle_grid_query *query) {
  const struct bsp_query shape = {.kind = BSP_TRIANGLE,
                                  .triangle = triangle,
                                  .sheet = grid->sheet,
                                  .box =
                                      box2_of_triangle(grid->sheet, triangle)};
  return find_in_box(grid, &shape, query);
}

bool triangle_grid_find_along(const struct triangle_grid *grid,
                              struct geom_point p, struct geom_point q,
                              struct triangle_grid_query *query) {
  const struct bsp_query shape = {.kind = BSP_SEGMENT, .p = {p, q}};
  struct cell_range r = triangle_grid_cells(grid, box2_of_segment(p, q));
  triangle_grid_query_start(grid, query);
  for (int y = r.y0; y <= r.y1; y++) {
    int x0, x1;
    triangle_grid_row(grid, p, q, r, y, &x0, &x1);
    for (int x = x0; x <= x1; x++)
      if (!visit_cell(grid, x, y, &shape, query))
        return false;
  }
  return true;
}
