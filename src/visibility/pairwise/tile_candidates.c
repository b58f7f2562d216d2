/* tile_candidates.c - lists of candidate triangles for the page tiles in which
 * edges or faces are deferred. */
#include "visibility/pairwise/tile_candidates.h"

#include <stdatomic.h>
#include <string.h>

#include "base/number_filter.h"
#include "base/parallel.h"
#include "base/poll.h"
#include "base/sort.h"

/* Larger cells are considered only if
 *   the lists are this long, on average over their entries, and
 *   two triangles together are in this many tiles, on average. */
enum { LONG_LIST = 32, TILES_OF_TWO = 5 };

/* Cells that a thread takes at once: a list has some ten triangles. */
enum { CELLS_IN_RANGE = PARALLEL_RANGE(1024) };

/* The shortest list that has a tree: the shortest of all in a fuzzer's build.
 * Where faces are solved as well, shorter ones than those that have a BSP are
 * better sorted from near to far. */
enum { BVH_LIST_MIN = PARALLEL_RANGE(512) };

/* If the sheet has more triangles, none is prepared as an occluder, to bound
 * the memory. */
enum { PREPARED_MAX = 1 << 16 };

void tile_candidates_fini(struct tile_candidates *list) {
  triangle_grid_fini(&list->grid);
  for (size_t i = 0; i < list->bvh_count; i++)
    bvh_fini(&list->bvh[i]);
  mem_free(list->bvh);
  mem_free(list->bvh_of);
  mem_free(list->key);
  mem_free(list->occluder);
  list->bvh = NULL;
  list->bvh_count = 0;
  list->bvh_of = NULL;
  list->key = NULL;
  list->occluder = NULL;
}

/* ---- Cells --------------------------------------------------------------- */

/* The cost of pairing the entries of every list, in pairs. */
static double cost_of_lists(const struct triangle_grid *grid) {
  size_t cells = triangle_grid_cell_count(grid);
  double cost = 0;
  for (size_t c = 0; c < cells; c++)
    cost += triangle_grid_cost_of_list(grid->lists.start[c + 1] -
                                       grid->lists.start[c]);
  return cost;
}

/* The triangles that are in some list. */
struct listed_triangles {
  const uint32_t *item;    /* of all lists */
  atomic_uchar *is_listed; /* one a triangle; atomic as one may be in the lists
                              of several threads */
};

static bool mark_listed_of_range(void *user, struct parallel_range range) {
  const struct listed_triangles *listed = user;
  for (size_t i = range.begin; i < range.end; i++)
    atomic_store_explicit(&listed->is_listed[listed->item[i]], 1,
                          memory_order_relaxed);
  return true;
}

static size_t listed_of_range(const void *user, struct parallel_range range,
                              uint32_t *kept) {
  const struct listed_triangles *listed = user;
  size_t count = 0;
  for (size_t t = range.begin; t < range.end; t++)
    if (atomic_load_explicit(&listed->is_listed[t], memory_order_relaxed))
      kept[count++] = (uint32_t)t;
  return count;
}

/* The triangles that are in some list, ascending; NULL when memory ran out. */
static uint32_t *list_all(const struct triangle_grid *grid, size_t *count) {
  size_t entries = grid->lists.start[triangle_grid_cell_count(grid)];
  struct listed_triangles listed = {grid->lists.item,
                                    mem_calloc(grid->triangle_count, 1)};
  uint32_t *all = NULL;
  if (listed.is_listed != NULL &&
      parallel_ranges(parallel_workers(entries, PARALLEL_ITEMS), entries,
                      PARALLEL_ITEMS, mark_listed_of_range, &listed))
    all = number_filter(grid->triangle_count, listed_of_range, &listed, count);
  mem_free((void *)listed.is_listed);
  return all;
}

/* Prepares the listed triangles as occluders, except those seen edge-on. */
static bool prepare_occluders(struct tile_candidates *list,
                              const struct sheet *sheet, const uint32_t *all,
                              size_t count) {
  if (sheet->triangle.count > PREPARED_MAX)
    return true;
  list->occluder = mem_alloc(sheet->triangle.count, sizeof *list->occluder);
  if (list->occluder == NULL)
    return false;
  for (size_t i = 0; i < count; i++)
    if (!sheet_is_edge_on(sheet, all[i]))
      occluder_init(&list->occluder[all[i]], sheet, all[i]);
  return true;
}

/* Replaces the lists by those of larger cells if these give fewer pairs. */
static bool enlarge_cells(struct tile_candidates *list,
                          const struct sheet *sheet) {
  struct triangle_grid large = list->tiles->grid, *small = &list->grid;
  double cost = cost_of_lists(small);
  size_t count, entries = small->lists.start[triangle_grid_cell_count(small)];
  if (cost < LONG_LIST / 2 * (double)entries)
    return true;
  uint32_t *all = list_all(small, &count);
  bool ok = all != NULL;
  if (ok && 2 * entries >= TILES_OF_TWO * count)
    ok = triangle_grid_enlarge(&large, sheet, all, count, &cost);
  if (ok && large.shift > small->shift) {
    triangle_grid_fini(small);
    list->grid = large;
    list->cells_are_tiles = false;
    ok = triangle_grid_fill_some(&list->grid, sheet, all, count, NULL, NULL) &&
         prepare_occluders(list, sheet, all, count);
  }
  mem_free(all);
  return ok;
}

/* ---- Trees of long lists ------------------------------------------------- */

static size_t list_length(const struct tile_candidates *list, size_t cell) {
  return list->grid.lists.start[cell + 1] - list->grid.lists.start[cell];
}

/* The lists of a range of cells or, for trees, of trees. */
struct list_work {
  struct tile_candidates *list;
  const struct sheet *sheet;
  const uint32_t *cell; /* of each tree */
};

static bool build_trees_of_range(void *user, struct parallel_range range) {
  const struct list_work *work = user;
  const struct number_lists *lists = &work->list->grid.lists;
  for (size_t i = range.begin; i < range.end; i++) {
    size_t cell = work->cell[i];
    if (!poll_now() || !bvh_init(&work->list->bvh[i], work->sheet,
                                 lists->item + lists->start[cell],
                                 list_length(work->list, cell)))
      return false;
  }
  return true;
}

/* Numbers the cells with long lists; NULL when memory ran out.
 * count  of them */
static uint32_t *number_long_lists(struct tile_candidates *list, size_t count) {
  size_t cells = triangle_grid_cell_count(&list->grid);
  uint32_t *cell_of = mem_alloc(count, sizeof *cell_of), n = 0;
  list->bvh_of = mem_alloc(cells, sizeof *list->bvh_of);
  for (size_t c = 0; cell_of != NULL && list->bvh_of != NULL && c < cells;
       c++) {
    bool is_long = list_length(list, c) >= list->long_list;
    list->bvh_of[c] = is_long ? n : SHEET_NONE;
    if (is_long)
      cell_of[n++] = (uint32_t)c;
  }
  return cell_of;
}

/* Builds the trees of all long lists, and prepares the triangles. */
static bool add_trees(struct tile_candidates *list, const struct sheet *sheet) {
  size_t cells = triangle_grid_cell_count(&list->grid), count = 0, listed;
  for (size_t c = 0; c < cells; c++)
    count += list_length(list, c) >= list->long_list;
  if (count == 0)
    return true;
  struct list_work work = {list, sheet, number_long_lists(list, count)};
  list->bvh = mem_calloc(count, sizeof *list->bvh);
  uint32_t *all =
      list->occluder == NULL ? list_all(&list->grid, &listed) : NULL;
  bool ok = work.cell != NULL && list->bvh_of != NULL && list->bvh != NULL;
  list->bvh_count = list->bvh != NULL ? count : 0;
  ok = ok && (list->occluder != NULL ||
              (all != NULL && prepare_occluders(list, sheet, all, listed)));
  ok = ok && parallel_ranges(parallel_workers(count, 1), count, 1,
                             build_trees_of_range, &work);
  mem_free(all);
  mem_free((void *)(uintptr_t)work.cell);
  return ok;
}

/* ---- Keys ---------------------------------------------------------------- */

/* The depths of the tile, or for larger cells those of the sheet, are divided
 * into 64 steps. */
struct kdop8_range tile_candidates_range(const struct tile_candidates *list,
                                         int x, int y) {
  const struct triangle_grid *grid = &list->grid;
  const struct tile_classification *tiles = list->tiles;
  uint64_t z_buckets =
      list->cells_are_tiles
          ? tiles->tile[triangle_grid_index(grid, x, y)].z_buckets
          : tiles->z_buckets;
  int low = __builtin_ctzll(z_buckets),
      buckets = 64 - __builtin_clzll(z_buckets) - low;
  int bits = buckets > 1 ? 32 - __builtin_clz((unsigned)buckets - 1) : 0;
  int side = grid->columns > grid->rows ? grid->columns : grid->rows;
  return (struct kdop8_range){
      .x0 = (int32_t)(grid->x0 + ((int64_t)x << grid->shift)),
      .y0 = (int32_t)(grid->y0 + ((int64_t)y << grid->shift)),
      .shift = grid->shift,
      .z0 = (int64_t)low << TILE_BUCKET_SHIFT,
      .z_shift = TILE_BUCKET_SHIFT + bits - 6,
      /* No point of the sheet is outside of the grid. */
      .fits_lanes =
          kdop8_fits_lanes(grid->shift, (int64_t)side << grid->shift)};
}

/* Fetches a triangle that comes later in the lists, and the corners of one that
 * comes sooner.
 * end  of the lists that this thread may read, as others sort theirs */
MEM_PREFETCH_INLINE void prefetch_triangles(const struct tile_candidates *list,
                                            const struct sheet *sheet, size_t i,
                                            size_t end) {
  const struct sheet_triangle *triangle = sheet->triangle.item;
  if (i + 2 * MEM_PREFETCH_AHEAD >= end)
    return;
  MEM_PREFETCH(&triangle[list->grid.lists.item[i + 2 * MEM_PREFETCH_AHEAD]]);
  sheet_prefetch_corners(sheet, list->grid.lists.item[i + MEM_PREFETCH_AHEAD]);
}

/* The key of a triangle of any size in a cell of any size. */
static uint64_t key_of_triangle(const struct kdop8_range *range,
                                const struct geom_point *a,
                                const struct geom_point *b,
                                const struct geom_point *c) {
  struct kdop8 kdop = kdop8_of_point(*a);
  kdop8_add(&kdop, *b);
  kdop8_add(&kdop, *c);
  return kdop8_key(range, &kdop);
}

/* Computes the keys of a cell's list.  A triangle that is seen edge-on
 * and occludes nothing, gets the key 0, which overlaps next to no query.
 * end  of the lists of the range of cells */
static void compute_keys(struct tile_candidates *list,
                         const struct sheet *sheet, size_t cell, size_t end) {
  size_t columns = (size_t)list->grid.columns,
         from = list->grid.lists.start[cell],
         to = list->grid.lists.start[cell + 1];
  const struct geom_point *point = sheet->point.item;
  struct kdop8_range range =
      tile_candidates_range(list, (int)(cell % columns), (int)(cell / columns));
  for (size_t i = from; i < to; i++) {
    uint32_t t = list->grid.lists.item[i];
    const uint32_t *p = sheet->triangle.item[t].point;
    prefetch_triangles(list, sheet, i, end);
    const struct geom_point *a = &point[p[0]], *b = &point[p[1]],
                            *c = &point[p[2]];
    list->key[i] = sheet_is_edge_on(sheet, t) ? 0
                   : range.fits_lanes ? kdop8_key_of_triangle(&range, a, b, c)
                                      : key_of_triangle(&range, a, b, c);
  }
}

/* Sorts a cell's list from near to far, by counting sort: the nearest triangles
 * are the most likely to hide an edge completely.
 * scratch  room for the list */
static void sort_list(struct tile_candidates *list, size_t from, size_t to,
                      struct sort_key scratch[TRIANGLE_GRID_SPLIT]) {
  uint32_t start[KDOP8_MAX + 1] = {0}, sum = 0;
  uint32_t *item = list->grid.lists.item + from;
  uint64_t *key = list->key + from;
  size_t n = to - from;
  for (size_t i = 0; i < n; i++) {
    scratch[i] = (struct sort_key){key[i], item[i]};
    start[kdop8_nearest(key[i])]++;
  }
  for (int step = KDOP8_MAX; step >= 0; step--) {
    uint32_t here = start[step];
    start[step] = sum;
    sum += here;
  }
  for (size_t i = 0; i < n; i++) {
    uint32_t slot = start[kdop8_nearest(scratch[i].key)]++;
    key[slot] = scratch[i].key;
    item[slot] = scratch[i].value;
  }
}

static bool add_keys_of_range(void *user, struct parallel_range range) {
  const struct list_work *work = user;
  const struct triangle_grid *grid = &work->list->grid;
  struct sort_key scratch[TRIANGLE_GRID_SPLIT];
  for (size_t cell = range.begin; cell < range.end; cell++) {
    size_t from = grid->lists.start[cell], to = grid->lists.start[cell + 1];
    if (!poll_at(cell))
      return false;
    if (from == to)
      continue;
    compute_keys(work->list, work->sheet, cell, grid->lists.start[range.end]);
    if (tile_candidates_is_sorted(work->list, cell))
      sort_list(work->list, from, to, scratch);
  }
  return true;
}

static bool add_keys(struct tile_candidates *list, const struct sheet *sheet) {
  size_t cells = triangle_grid_cell_count(&list->grid);
  struct list_work work = {.list = list, .sheet = sheet};
  list->key = mem_alloc(list->grid.lists.start[cells], sizeof *list->key);
  return list->key != NULL &&
         parallel_ranges(parallel_workers(cells, CELLS_IN_RANGE), cells,
                         CELLS_IN_RANGE, add_keys_of_range, &work);
}

bool tile_candidates_fill(struct tile_candidates *list,
                          const struct tile_classification *tiles,
                          const struct sheet *sheet, const uint8_t *wanted,
                          bool edges, bool fragments) {
  tile_candidates_fini(list);
  *list = (struct tile_candidates){.grid = tiles->grid,
                                   .cells_are_tiles = true,
                                   .tiles = tiles,
                                   .long_list = fragments ? TRIANGLE_GRID_SPLIT
                                                          : BVH_LIST_MIN};
  return triangle_grid_fill(&list->grid, sheet, tiles->footprint, wanted) &&
         enlarge_cells(list, sheet) && (!edges || add_trees(list, sheet)) &&
         (!fragments || triangle_grid_split(&list->grid, true)) &&
         add_keys(list, sheet);
}
