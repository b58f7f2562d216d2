/* draw_order.c - the facets that a z-buffer draws, sorted by tiles: a counting
 * sort. */
#include "visibility/zbuffer/draw_order.h"

#include <string.h>

#define TILE_COLUMNS 64
#define NO_TILE UINT32_MAX /* of 2^27 at most */

struct tile_sort {
  const struct raster *raster;
  const struct facets *facets;
  int left_out;  /* flags of triangles that are not drawn */
  size_t across; /* tiles of a band */
  int32_t tallest;
};

/* The tile of the facet that a triangle identifies; NO_TILE where it identifies
 * none, or one that is not drawn. */
static uint32_t find_tile(struct tile_sort *sort, uint32_t triangle) {
  const struct raster *raster = sort->raster;
  const struct sheet *sheet = raster->sheet;
  const uint32_t *corner, *side;
  int32_t low = INT32_MAX, high = 0;
  uint32_t count;
  int32_t column;
  if ((sheet->triangle_flags[triangle] & sort->left_out) ||
      facet_of(sort->facets, triangle) != triangle)
    return NO_TILE;
  count = facet_outline(sort->facets, sheet, triangle, &corner, &side);
  for (uint32_t k = 0; k < count; k++) {
    int32_t line = raster->pixel_of[corner[k]].line;
    low = line < low ? line : low;
    high = line > high ? line : high;
  }
  if (low == high)
    return NO_TILE;
  if (high - low > sort->tallest)
    sort->tallest = high - low;
  column = raster->pixel_of[corner[0]].column;
  return (uint32_t)((size_t)(raster->grid.lines - high) / DRAW_ORDER_BAND *
                        sort->across +
                    (size_t)column / TILE_COLUMNS);
}

/* Finds each triangle's tile, and the index at which each tile's facets start.
 * start  one a tile, all 0 before */
static void find_tiles(struct tile_sort *sort, uint32_t *tile_of, size_t *start,
                       size_t tiles) {
  size_t sum = 0;
  for (uint32_t t = 0; t < sort->raster->sheet->triangle.count; t++) {
    tile_of[t] = find_tile(sort, t);
    if (tile_of[t] != NO_TILE)
      start[tile_of[t]]++;
  }
  for (size_t tile = 0; tile < tiles; tile++) {
    size_t here = start[tile];
    start[tile] = sum;
    sum += here;
  }
}

/* Sorts the facets by tile.
 * start  the index of each tile's first facet; afterwards that of the next
 *        tile's */
static void sort_facets(const struct sheet *sheet, const uint32_t *tile_of,
                        size_t *start, struct ordered_facet *item) {
  for (uint32_t t = 0; t < sheet->triangle.count; t++) {
    const uint32_t *p = sheet->triangle.item[t].point;
    if (tile_of[t] != NO_TILE)
      item[start[tile_of[t]]++] = (struct ordered_facet){t, {p[0], p[1], p[2]}};
  }
}

bool draw_order_init(struct draw_order *order, const struct raster *raster,
                     const struct facets *facets,
                     const struct solver_request *request) {
  const struct scan_grid *grid = &raster->grid;
  size_t count = raster->sheet->triangle.count, tiles;
  struct tile_sort sort = {raster, facets,
                           SHEET_EDGE_ON |
                               (request->remove_backs ? SHEET_FLIPPED : 0),
                           (size_t)grid->columns / TILE_COLUMNS + 1, 0};
  size_t *start;
  uint32_t *tile_of = mem_alloc(count, sizeof *tile_of);
  order->bands = ((size_t)grid->lines + DRAW_ORDER_BAND - 1) / DRAW_ORDER_BAND;
  tiles = order->bands * sort.across;
  start = mem_calloc(tiles, sizeof *start);
  order->item = mem_alloc(count, sizeof *order->item);
  order->past = mem_alloc(order->bands, sizeof *order->past);
  if (tile_of == NULL || start == NULL || order->item == NULL ||
      order->past == NULL) {
    mem_free(tile_of);
    mem_free(start);
    draw_order_fini(order);
    return false;
  }
  find_tiles(&sort, tile_of, start, tiles);
  sort_facets(raster->sheet, tile_of, start, order->item);
  for (size_t band = 0; band < order->bands; band++)
    order->past[band] = start[(band + 1) * sort.across - 1];
  order->tallest = sort.tallest;
  mem_free(tile_of);
  mem_free(start);
  return true;
}

void draw_order_fini(struct draw_order *order) {
  mem_free(order->item);
  mem_free(order->past);
  memset(order, 0, sizeof *order);
}
