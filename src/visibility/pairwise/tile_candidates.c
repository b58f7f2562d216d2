/* tile_candidates.c - the triangles of the tiles that something was left over in. */
#include "visibility/pairwise/tile_candidates.h"

#include <string.h>

#include "base/sort.h"

/* Lists this long on average are worth thinking of larger cells. */
enum { LONG_LIST = 32 };

/* And so are triangles of which two are in so many tiles, on average. */
enum { TILES_OF_TWO = 5 };

/* Of a sheet of more triangles none is prepared: memory. */
enum { PREPARED_MOST = 1 << 16 };

void tile_candidates_fini(struct tile_candidates *list) {
  triangle_grid_fini(&list->grid);
  mem_free(list->word);
  mem_free(list->occluder);
  list->word = NULL;
  list->occluder = NULL;
}

/* ---- Cells --------------------------------------------------------------- */

static double cost_of_lists(const struct triangle_grid *grid) {
  size_t cells = triangle_grid_cell_count(grid);
  double cost = 0;
  for (size_t c = 0; c < cells; c++)
    cost += triangle_grid_cost_of_list(grid->start[c + 1] - grid->start[c]);
  return cost;
}

/* The triangles that are in some list, ascending; NULL when memory ran out. */
static uint32_t *list_all(const struct triangle_grid *grid, size_t *count) {
  size_t n = grid->triangle_count,
         entries = grid->start[triangle_grid_cell_count(grid)];
  uint32_t *all = mem_alloc(n, sizeof *all);
  uint8_t *listed = mem_calloc(n, 1);
  *count = 0;
  for (size_t i = 0; all != NULL && listed != NULL && i < entries; i++)
    listed[grid->item[i]] = 1;
  for (size_t t = 0; all != NULL && listed != NULL && t < n; t++)
    if (listed[t])
      all[(*count)++] = (uint32_t)t;
  if (listed == NULL) {
    mem_free(all);
    all = NULL;
  }
  mem_free(listed);
  return all;
}

/* Prepares the triangles that are listed and may hide something. */
static bool prepare(struct tile_candidates *list, const struct sheet *sheet,
                    const uint32_t *all, size_t count) {
  if (sheet->triangle.count > PREPARED_MOST)
    return true;
  list->occluder = mem_alloc(sheet->triangle.count, sizeof *list->occluder);
  if (list->occluder == NULL)
    return false;
  for (size_t i = 0; i < count; i++)
    if (!(sheet->triangle_flags[all[i]] & SHEET_FLAT))
      occluder_init(&list->occluder[all[i]], sheet, all[i]);
  return true;
}

/* Takes larger cells where they make fewer pairs. */
static bool enlarge(struct tile_candidates *list, const struct sheet *sheet) {
  struct triangle_grid large = list->map->grid, *tiles = &list->grid;
  double cost = cost_of_lists(tiles);
  size_t count, entries = tiles->start[triangle_grid_cell_count(tiles)];
  uint32_t *all;
  bool ok;
  if (cost < LONG_LIST / 2 * (double)entries)
    return true;
  all = list_all(tiles, &count);
  ok = all != NULL;
  if (ok && 2 * entries >= TILES_OF_TWO * count)
    ok = triangle_grid_enlarge(&large, sheet, all, count, &cost);
  if (ok && large.shift > tiles->shift) {
    triangle_grid_fini(tiles);
    list->grid = large;
    list->of_tiles = false;
    ok = triangle_grid_fill_some(&list->grid, sheet, all, count) &&
         prepare(list, sheet, all, count);
  }
  mem_free(all);
  return ok;
}

/* ---- Words --------------------------------------------------------------- */

/* Depths of a tile, or for larger cells all of the sheet's, in 64 steps. */
struct kdop8_frame tile_candidates_frame(const struct tile_candidates *list,
                                         int x, int y) {
  const struct triangle_grid *grid = &list->grid;
  const struct tile_classification *map = list->map;
  uint64_t depths =
      list->of_tiles
          ? map->tile[(size_t)y * (size_t)grid->columns + (size_t)x].depths
          : map->depths;
  int low = __builtin_ctzll(depths),
      buckets = 64 - __builtin_clzll(depths) - low;
  int bits = buckets > 1 ? 32 - __builtin_clz((unsigned)buckets - 1) : 0;
  return (struct kdop8_frame){(int32_t)(grid->x0 + ((int64_t)x << grid->shift)),
                              (int32_t)(grid->y0 + ((int64_t)y << grid->shift)),
                              grid->shift, (int64_t)low << TILE_BUCKET_SHIFT,
                              TILE_BUCKET_SHIFT + bits - 6};
}

/* Writes the words of a cell's list: none for what is seen edge-on and hides
 * nothing, so that next to no question meets it. */
static void write_words(struct tile_candidates *list, const struct sheet *sheet,
                        int x, int y, size_t from, size_t to) {
  struct kdop8_frame frame = tile_candidates_frame(list, x, y);
  for (size_t i = from; i < to; i++) {
    uint32_t t = list->grid.item[i];
    const uint32_t *p = sheet->triangle.item[t].point;
    struct kdop8 kdop = kdop8_of_point(sheet->point.item[p[0]]);
    kdop8_add(&kdop, sheet->point.item[p[1]]);
    kdop8_add(&kdop, sheet->point.item[p[2]]);
    list->word[i] =
        sheet->triangle_flags[t] & SHEET_FLAT ? 0 : kdop8_key(&frame, &kdop);
  }
}

/* Puts the nearest triangles of a cell's list first: what is hidden is found
 * to be so by few of them.
 * scratch  room for the list */
static void sort_list(struct tile_candidates *list, size_t from, size_t to,
                      struct sort_key scratch[TRIANGLE_GRID_SPLIT]) {
  uint32_t start[KDOP8_MOST + 1] = {0}, sum = 0;
  uint32_t *item = list->grid.item + from;
  uint64_t *word = list->word + from;
  size_t n = to - from;
  for (size_t i = 0; i < n; i++) {
    scratch[i] = (struct sort_key){word[i], item[i]};
    start[kdop8_nearest(word[i])]++;
  }
  for (int depth = KDOP8_MOST; depth >= 0; depth--) {
    uint32_t here = start[depth];
    start[depth] = sum;
    sum += here;
  }
  for (size_t i = 0; i < n; i++) {
    uint32_t to_place = start[kdop8_nearest(scratch[i].key)]++;
    word[to_place] = scratch[i].key;
    item[to_place] = scratch[i].value;
  }
}

static bool add_words(struct tile_candidates *list, const struct sheet *sheet) {
  const struct triangle_grid *grid = &list->grid;
  struct sort_key scratch[TRIANGLE_GRID_SPLIT];
  size_t cell = 0;
  list->word = mem_alloc(grid->start[triangle_grid_cell_count(grid)],
                         sizeof *list->word);
  if (list->word == NULL)
    return false;
  for (int y = 0; y < grid->rows; y++)
    for (int x = 0; x < grid->columns; x++, cell++)
      if (grid->start[cell] < grid->start[cell + 1]) {
        size_t from = grid->start[cell], to = grid->start[cell + 1];
        write_words(list, sheet, x, y, from, to);
        if (to - from < TRIANGLE_GRID_SPLIT)
          sort_list(list, from, to, scratch);
      }
  return true;
}

bool tile_candidates_fill(struct tile_candidates *list,
                          const struct tile_classification *map,
                          const struct sheet *sheet, const uint8_t *wanted) {
  tile_candidates_fini(list);
  *list =
      (struct tile_candidates){.grid = map->grid, .of_tiles = true, .map = map};
  return triangle_grid_fill(&list->grid, sheet, map->print, wanted,
                            map->horizon) &&
         enlarge(list, sheet) && triangle_grid_split(&list->grid, true) &&
         add_words(list, sheet);
}
