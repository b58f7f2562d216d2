/* tilemap.c - page tiles over which a layer of many small faces hides all that
 * is behind it.
 *
 * Phases: gather depths by streaming the faces; find each tile's front layer;
 * refuse tiles with contours in the layer; stream the faces once more to count
 * who covers the samples, refusing steep ones.
 */
#include "visibility/tilemap.h"

#include <string.h>

#include "visibility/hide.h"
#include "visibility/surround.h"

enum {
  SPREAD = 4, /* cells a triangle is in, on average: a tile is about an edge */
  MANY = 2,
  SOUP = 32,            /* faces over a point, on average, that make a soup */
  SOUP_CELLS = 1 << 22, /* cells of all triangles of a soup together */
  SOUP_SPREAD = 256,    /* but no more of each: pairs are met cell by cell */
  SAMPLE = 1 << 12
};

static uint64_t bucket_mask(int low, int high) {
  return (~UINT64_C(0) >> (TILE_BUCKETS - 1 - high)) & (~UINT64_C(0) << low);
}

static struct tile *tile_at(const struct tilemap *map, int x, int y) {
  return &map->tile[(size_t)y * (size_t)map->grid.columns + (size_t)x];
}

/* Which cells and buckets each triangle is in, and the cells' depths. */
static void gather_depths(struct tilemap *map, const struct sheet *sheet) {
  const struct geom_point *point = sheet->point.item;
  for (size_t t = 0; t < sheet->triangle.count; t++) {
    const uint32_t *p = sheet->triangle.item[t].point;
    struct cell_range r = pagegrid_cells(
        &map->grid, page_box_of_triangle(sheet, (uint32_t)t));
    int64_t z0 = point[p[0]].z, z1 = point[p[1]].z, z2 = point[p[2]].z;
    int64_t low = z0 < z1 ? z0 : z1, high = z0 > z1 ? z0 : z1;
    uint64_t mask;
    if (z2 < low) low = z2;
    if (z2 > high) high = z2;
    map->print[t] = footprint_of(r, tile_bucket(low), tile_bucket(high));
    mask = bucket_mask(tile_bucket(low), tile_bucket(high));
    for (int y = r.y0; y <= r.y1; y++)
      for (int x = r.x0; x <= r.x1; x++) tile_at(map, x, y)->depths |= mask;
  }
}

/* The lowest bit of the topmost run of ones; depths != 0. */
static int bottom_of_front(uint64_t depths) {
  int bottom = TILE_BUCKETS - 1;
  while (!(depths >> bottom & 1)) bottom--;
  while (bottom > 0 && (depths >> (bottom - 1) & 1)) bottom--;
  return bottom;
}

static void find_fronts(struct tilemap *map) {
  size_t n = pagegrid_cell_count(&map->grid);
  for (size_t i = 0; i < n; i++) {
    struct tile *tile = &map->tile[i];
    if (tile->depths == 0) continue;
    tile->front = (uint8_t)bottom_of_front(tile->depths);
    tile->state = TILE_SIMPLE;
  }
}

static void refuse_contours(struct tilemap *map, const struct sheet *sheet) {
  for (size_t i = 0; i < sheet->contour.count; i++) {
    struct geom_point p = sheet->point.item[sheet->contour.item[i].point[0]],
                      q = sheet->point.item[sheet->contour.item[i].point[1]];
    struct cell_range r =
        pagegrid_cells(&map->grid, page_box_of_segment(p, q));
    int high = tile_bucket(p.z > q.z ? p.z : q.z);
    for (int y = r.y0; y <= r.y1; y++) {
      int x0, x1;
      pagegrid_row(&map->grid, p, q, r, y, &x0, &x1);
      for (int x = x0; x <= x1; x++) {
        struct tile *tile = tile_at(map, x, y);
        if (high >= tile->front) tile->state = TILE_MIXED;
      }
    }
  }
}

static struct window tile_window(const struct pagegrid *grid, int x, int y) {
  int64_t side = INT64_C(1) << grid->shift, x0 = grid->x0 + x * side,
          y0 = grid->y0 + y * side;
  return (struct window){(int32_t)x0, (int32_t)y0, (int32_t)(x0 + side),
                         (int32_t)(y0 + side)};
}

/* Where a tile is sampled: off the middle, so that regular meshes whose edges
 * run along the grid are not met on an edge again and again. */
static struct geom_point sample_of(const struct pagegrid *grid, int x, int y) {
  int64_t side = INT64_C(1) << grid->shift;
  int64_t px = grid->x0 + x * side + side * 37 / 64,
          py = grid->y0 + y * side + side * 29 / 64;
  struct geom_point p = {(int32_t)(px > SHEET_XY_MAX ? SHEET_XY_MAX : px),
                         (int32_t)(py > SHEET_XY_MAX ? SHEET_XY_MAX : py), 0};
  return p;
}

/* How many triangles' boxes are over a point of the page, on average. */
static double mean_layers(const struct sheet *sheet,
                          const struct pagegrid *grid) {
  size_t n = sheet->triangle.count, stride = n / SAMPLE + 1;
  double side = (double)(INT64_C(1) << grid->shift), sum = 0;
  for (size_t t = 0; t < n; t += stride) {
    struct page_box b = page_box_of_triangle(sheet, (uint32_t)t);
    sum += ((double)b.x1 - b.x0) * ((double)b.y1 - b.y0) * (double)stride;
  }
  return sum / (side * side * grid->columns * grid->rows);
}

/* The horizons of the tiles that the triangle surrounds. */
static void raise_horizons(struct tilemap *map, const struct sheet *sheet,
                           size_t t) {
  struct cell_range r = footprint_cells(&map->grid, sheet, t, map->print[t]);
  struct geom_point p[3];
  if (r.x1 - r.x0 < 2 || r.y1 - r.y0 < 2) return;
  for (int k = 0; k < 3; k++)
    p[k] = sheet->point.item[sheet->triangle.item[t].point[k]];
  for (int y = r.y0 + 1; y < r.y1; y++)
    for (int x = r.x0 + 1; x < r.x1; x++) {
      struct window window = tile_window(&map->grid, x, y);
      struct window_counts counts;
      struct surround_depths depth;
      double *horizon = &map->horizon[(size_t)y * (size_t)map->grid.columns +
                                      (size_t)x];
      if (window_classify(&window, p, 3, &counts) != WINDOW_SURROUNDING)
        continue;
      surround_depths_of(sheet, (uint32_t)t, &window, &depth);
      if (depth.low > *horizon) *horizon = depth.low;
    }
}

struct corners {
  struct geom_point p[3];
};

static struct corners corners_of(const struct sheet *sheet, size_t t) {
  const uint32_t *p = sheet->triangle.item[t].point;
  return (struct corners){{sheet->point.item[p[0]], sheet->point.item[p[1]],
                           sheet->point.item[p[2]]}};
}

/* Counts the triangle where it covers the tile's sample. */
static void count_sample(struct tile *tile, const struct corners *corners,
                         struct geom_point sample) {
  const struct geom_point *p = corners->p;
  int inside = 0;
  for (int k = 0; k < 3; k++) {
    int64_t o = geom_orient2d(p[k], p[k == 2 ? 0 : k + 1], sample);
    if (o < 0) return;
    inside += o > 0;
  }
  if (inside < 3)
    tile->state = TILE_MIXED; /* met on an edge: not to be told */
  else if (tile->covered < MANY)
    tile->covered++;
}

/* May the triangle hide, or touch, across an empty bucket?  Its contact
 * tolerance (hide.h), bounded from above, against a bucket's depth: half of
 * it is room enough for the roundings. */
static bool is_steep(const struct sheet *sheet, const struct corners *corners) {
  const struct geom_point *p = corners->p;
  double ux = (double)p[1].x - p[0].x, uy = (double)p[1].y - p[0].y,
         uz = (double)(p[1].z - p[0].z), vx = (double)p[2].x - p[0].x,
         vy = (double)p[2].y - p[0].y, vz = (double)(p[2].z - p[0].z);
  double nz = ux * vy - uy * vx;
  double bound = hide_tolerance_bound(sheet, p[0], uy * vz - uz * vy,
                                      uz * vx - ux * vz, nz);
  return !(bound < nz * (double)(INT64_C(1) << (TILE_BUCKET_SHIFT - 1)));
}

/* Fragments ask which faces touch, and a steep one may touch across a
 * horizon: it takes the horizons of its tiles away. */
static void drop_horizons(struct tilemap *map, const struct sheet *sheet,
                          size_t t) {
  struct corners corners = corners_of(sheet, t);
  struct cell_range r;
  if (!is_steep(sheet, &corners)) return;
  r = footprint_cells(&map->grid, sheet, t, map->print[t]);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++)
      map->horizon[(size_t)y * (size_t)map->grid.columns + (size_t)x] = -1;
}

static bool find_horizons(struct tilemap *map, const struct sheet *sheet,
                          bool fragments) {
  size_t n = pagegrid_cell_count(&map->grid);
  map->horizon = mem_alloc(n, sizeof *map->horizon);
  if (map->horizon == NULL) return false;
  for (size_t i = 0; i < n; i++) map->horizon[i] = -1;
  for (size_t t = 0; t < sheet->triangle.count; t++)
    if (!(sheet->triangle_flags[t] & SHEET_FLAT))
      raise_horizons(map, sheet, t);
  if (!fragments) return true;
  for (size_t i = 0; i < n; i++)
    map->horizon[i] -= (double)(INT64_C(1) << TILE_BUCKET_SHIFT);
  for (size_t t = 0; t < sheet->triangle.count; t++)
    if (!(sheet->triangle_flags[t] & SHEET_FLAT))
      drop_horizons(map, sheet, t);
  return true;
}

/* Counts the triangle in the simple tiles it may belong to the front of, or
 * refuses them where it is too steep. */
static void count_triangle(struct tilemap *map, const struct sheet *sheet,
                           size_t t, bool fragments) {
  struct footprint print = map->print[t];
  struct cell_range r = footprint_cells(&map->grid, sheet, t, print);
  struct corners corners;
  bool known = false, steep = false;
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      struct tile *tile = tile_at(map, x, y);
      bool front = print.low >= tile->front;
      if (tile->state != TILE_SIMPLE || !(front || fragments)) continue;
      if (!known) {
        corners = corners_of(sheet, t);
        steep = is_steep(sheet, &corners);
        known = true;
      }
      if (steep)
        tile->state = TILE_MIXED;
      else if (front)
        count_sample(tile, &corners, sample_of(&map->grid, x, y));
    }
}

static void count_samples(struct tilemap *map, const struct sheet *sheet,
                          bool fragments) {
  for (size_t t = 0; t < sheet->triangle.count; t++)
    if (!(sheet->triangle_flags[t] & SHEET_FLAT))
      count_triangle(map, sheet, t, fragments);
}

bool tilemap_init(struct tilemap *map, const struct sheet *sheet,
                  bool fragments) {
  size_t n;
  bool soup;
  memset(map, 0, sizeof *map);
  pagegrid_shape(&map->grid, sheet, SPREAD, SPREAD / 2);
  soup = mean_layers(sheet, &map->grid) > SOUP;
  if (soup) {
    unsigned spread = (unsigned)(SOUP_CELLS / sheet->triangle.count + SPREAD);
    if (spread > SOUP_SPREAD) spread = SOUP_SPREAD;
    pagegrid_shape(&map->grid, sheet, spread, spread);
  }
  n = pagegrid_cell_count(&map->grid);
  map->tile = mem_calloc(n, sizeof *map->tile);
  map->print = mem_alloc(sheet->triangle.count, sizeof *map->print);
  if (map->tile == NULL || map->print == NULL) return false;
  gather_depths(map, sheet);
  if (soup && !find_horizons(map, sheet, fragments)) return false;
  find_fronts(map);
  refuse_contours(map, sheet);
  count_samples(map, sheet, fragments);
  for (size_t i = 0; i < n; i++) {
    struct tile *tile = &map->tile[i];
    if (tile->state == TILE_SIMPLE && tile->covered != 1)
      tile->state = TILE_MIXED;
    map->simple += tile->state == TILE_SIMPLE;
    map->mixed += tile->state == TILE_MIXED;
    map->empty += tile->state == TILE_EMPTY;
  }
  return true;
}

void tilemap_fini(struct tilemap *map) {
  pagegrid_fini(&map->grid);
  mem_free(map->tile);
  mem_free(map->print);
  mem_free(map->horizon);
  map->tile = NULL;
  map->print = NULL;
  map->horizon = NULL;
}

bool tilemap_list(struct tilemap *map, const struct sheet *sheet,
                  const uint8_t *wanted) {
  pagegrid_fini(&map->grid);
  return pagegrid_fill(&map->grid, sheet, map->print, wanted, map->horizon);
}
