/* tile_classification.c - page tiles over which a layer of many small faces hides all that
 * is behind it.
 *
 * Phases: stream the faces once, and gather of each tile the depths that its
 * faces are in, the two nearest faces over its sample, and the nearest one that
 * forbids telling; find each tile's front layer, which is simple where just one
 * of its faces is over the sample; refuse tiles with contours in the layer.
 */
#include "visibility/pairwise/tile_classification.h"

#include <math.h>
#include <string.h>

#include "visibility/predicate/occlusion.h"
#include "visibility/predicate/surrounder.h"

enum {
  SPREAD = 2, /* cells a triangle is in, on average: a tile is about an edge */
  SOUP = 32,  /* faces over a point, on average, that make a soup */
  SOUP_CELLS = 1 << 22, /* cells of all triangles of a soup together */
  SOUP_SPREAD = 256,    /* but no more of each */
  SOUP_QUESTIONS = 8,   /* cells cost a tenth of asking so many edges */
  SOUP_FACE = 16,       /* edges that a face counts for */
  BOX_PER_AREA = 4,     /* a common triangle's box has so many times its area */
  SAMPLE = 1 << 12
};

static uint64_t bucket_mask(int low, int high) {
  return (~UINT64_C(0) >> (TILE_BUCKETS - 1 - high)) & (~UINT64_C(0) << low);
}

static struct tile *tile_at(const struct tile_classification *map, int x,
                            int y) {
  return &map->tile[(size_t)y * (size_t)map->grid.columns + (size_t)x];
}

/* ---- Gathering ----------------------------------------------------------- */

struct corners {
  struct geom_point p[3];
};

static inline struct corners corners_of(const struct sheet *sheet, size_t t) {
  const uint32_t *p = sheet->triangle.item[t].point;
  return (struct corners){{sheet->point.item[p[0]], sheet->point.item[p[1]],
                           sheet->point.item[p[2]]}};
}

/* The line functions of a triangle's sides, positive within it, at places a
 * tile's side apart.  Within the triangle's box they are below 2^62; one step
 * beyond they may wrap, unread. */
struct contour_walk {
  uint64_t at[3], right[3], up[3];
};

/* Starts at (x, y); or, with `least`, has the least values over the tile whose
 * lower left corner that is. */
static inline struct contour_walk walk_of(const struct corners *corners,
                                          int64_t x, int64_t y, int shift,
                                          bool least) {
  struct contour_walk walk;
  for (int k = 0; k < 3; k++) {
    struct geom_point a = corners->p[k], b = corners->p[k == 2 ? 0 : k + 1];
    int64_t dx = (int64_t)b.x - a.x, dy = (int64_t)b.y - a.y;
    int64_t side = least ? INT64_C(1) << shift : 0;
    walk.at[k] = (uint64_t)(dx * (y + (dx < 0 ? side : 0) - a.y) -
                            dy * (x + (dy > 0 ? side : 0) - a.x));
    walk.right[k] = (uint64_t)-dy << shift;
    walk.up[k] = (uint64_t)dx << shift;
  }
  return walk;
}

static inline void walk_right(struct contour_walk *walk) {
  for (int k = 0; k < 3; k++)
    walk->at[k] += walk->right[k];
}

static inline void walk_up(struct contour_walk *walk) {
  for (int k = 0; k < 3; k++)
    walk->at[k] += walk->up[k];
}

/* Are all three values positive? */
static inline bool walk_is_inside(const struct contour_walk *walk) {
  return (((walk->at[0] - 1) | (walk->at[1] - 1) | (walk->at[2] - 1)) >> 63) ==
         0;
}

/* May the triangle hide, or touch, across an empty bucket?  Its contact
 * tolerance (occlusion.h), bounded from above, against a bucket's depth: half of
 * it is room enough for the roundings.
 * all  what bounds the tolerances of all triangles: asked first */
static bool is_steep(const struct sheet *sheet,
                     const struct occlusion_bound *all, uint32_t triangle,
                     const struct corners *corners) {
  const struct geom_point *p = corners->p;
  double ux = (double)p[1].x - p[0].x, uy = (double)p[1].y - p[0].y,
         uz = (double)(p[1].z - p[0].z), vx = (double)p[2].x - p[0].x,
         vy = (double)p[2].y - p[0].y, vz = (double)(p[2].z - p[0].z);
  double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
  double room = nz * (double)(INT64_C(1) << (TILE_BUCKET_SHIFT - 1));
  if (1 + all->level * nz + all->slope * (fabs(nx) + fabs(ny)) < room)
    return false;
  return !(occlusion_tolerance_bound(sheet, triangle, p[0], nx, ny, nz) < room);
}

/* What is asked for every triangle, held by value: what is written to the
 * tiles does not change it. */
struct tile_gathering {
  struct triangle_grid grid;
  struct tile *tile;
  /* Where the first tile is sampled: off the middle, so that regular meshes
   * whose edges run along the grid are not met on an edge again and again. */
  int64_t sample_x, sample_y;
};

static inline struct tile *gathering_tile(const struct tile_gathering *g, int x,
                                          int y) {
  return &g->tile[(size_t)y * (size_t)g->grid.columns + (size_t)x];
}

static struct tile_gathering
gathering_of(const struct tile_classification *map) {
  const struct triangle_grid *grid = &map->grid;
  int64_t side = INT64_C(1) << grid->shift;
  return (struct tile_gathering){*grid, map->tile, grid->x0 + side * 37 / 64,
                                 grid->y0 + side * 29 / 64};
}

/* The columns, or rows, whose samples are in [low, high]; *past <= *first:
 * none.
 * origin  where the first one is sampled */
static inline void find_samples(int32_t low, int32_t high, int64_t origin,
                                int shift, int count, int *first, int *past) {
  int64_t from = (low - origin + (INT64_C(1) << shift) - 1) >> shift;
  int64_t to = (high - origin) >> shift;
  *first = from < 0 ? 0 : (int)from;
  *past = to < count ? (int)to + 1 : count;
}

static inline void note_bar(struct tile *tile, uint8_t note) {
  if (tile->bar < note)
    tile->bar = note;
}

/* Notes the triangle where it is over the tile's sample; where the sample is
 * on one of its sides that cannot be told. */
static inline void query_sample(struct tile *tile,
                                const struct corners *corners,
                                struct geom_point sample, uint8_t note) {
  const struct geom_point *p = corners->p;
  int64_t a = geom_orient2d(p[0], p[1], sample),
          b = geom_orient2d(p[1], p[2], sample),
          c = geom_orient2d(p[2], p[0], sample);
  if ((a | b | c) < 0)
    return;
  if (a == 0 || b == 0 || c == 0) {
    note_bar(tile, note);
  } else if (note > tile->over[0]) {
    tile->over[1] = tile->over[0];
    tile->over[0] = note;
  } else if (note > tile->over[1]) {
    tile->over[1] = note;
  }
}

static inline void query_samples(const struct tile_gathering *g,
                                 const struct corners *corners, struct box2 box,
                                 uint8_t note) {
  const struct triangle_grid *grid = &g->grid;
  int x0, x1, y0, y1;
  find_samples(box.x0, box.x1, g->sample_x, grid->shift, grid->columns, &x0,
               &x1);
  find_samples(box.y0, box.y1, g->sample_y, grid->shift, grid->rows, &y0, &y1);
  for (int y = y0; y < y1; y++)
    for (int x = x0; x < x1; x++) {
      struct geom_point sample = {
          (int32_t)(g->sample_x + ((int64_t)x << grid->shift)),
          (int32_t)(g->sample_y + ((int64_t)y << grid->shift)), 0};
      query_sample(gathering_tile(g, x, y), corners, sample, note);
    }
}

static inline struct box2 box_of(const struct corners *corners) {
  const struct geom_point *p = corners->p;
  return (struct box2){box2_min(p[0].x, box2_min(p[1].x, p[2].x)),
                       box2_min(p[0].y, box2_min(p[1].y, p[2].y)),
                       box2_max(p[0].x, box2_max(p[1].x, p[2].x)),
                       box2_max(p[0].y, box2_max(p[1].y, p[2].y))};
}

/* The depths that a triangle is in, for all its tiles. */
static inline void add_depths(const struct tile_gathering *g,
                              struct cell_range r, uint64_t mask) {
  for (int y = r.y0; y <= r.y1; y++) {
    struct tile *tile = gathering_tile(g, r.x0, y), *end = tile + r.x1 - r.x0;
    for (; tile <= end; tile++)
      tile->depths |= mask;
  }
}

static void add_bar(const struct tile_gathering *g, struct cell_range r,
                    uint8_t note) {
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++)
      note_bar(gathering_tile(g, x, y), note);
}

/* Streams the triangles: their cells and buckets, and what tiles note. */
static void gather(struct tile_classification *map, const struct sheet *sheet,
                   bool fragments) {
  const struct occlusion_bound all = occlusion_tolerance_bound_all(sheet);
  const struct tile_gathering g = gathering_of(map);
  const struct sheet_triangle *triangle = sheet->triangle.item;
  const struct geom_point *point = sheet->point.item;
  const uint8_t *flags = sheet->triangle_flags;
  struct footprint *print = map->print;
  for (size_t t = 0, n = sheet->triangle.count; t < n; t++) {
    const uint32_t *p = triangle[t].point;
    const struct corners corners = {{point[p[0]], point[p[1]], point[p[2]]}};
    struct box2 box = box_of(&corners);
    struct cell_range r = triangle_grid_cells(&g.grid, box);
    int64_t z0 = corners.p[0].z, z1 = corners.p[1].z, z2 = corners.p[2].z;
    int64_t least = z0 < z1 ? z0 : z1, most = z0 > z1 ? z0 : z1;
    int low = tile_bucket(z2 < least ? z2 : least),
        high = tile_bucket(z2 > most ? z2 : most);
    print[t] = footprint_of(r, low, high);
    add_depths(&g, r, bucket_mask(low, high));
    if (flags[t] & SHEET_FLAT)
      continue;
    if (is_steep(sheet, &all, (uint32_t)t, &corners))
      add_bar(&g, r, fragments ? UINT8_MAX : (uint8_t)(low + 1));
    else
      query_samples(&g, &corners, box, (uint8_t)(low + 1));
  }
}

/* ---- Judging ------------------------------------------------------------- */

/* The lowest bit of the topmost run of ones; depths != 0. */
static int bottom_of_front(uint64_t depths) {
  int above = __builtin_clzll(depths);
  uint64_t gaps = ~(depths << above);
  int run = gaps == 0 ? TILE_BUCKETS : __builtin_clzll(gaps);
  return TILE_BUCKETS - above - run;
}

/* Where just one face of the front layer is over the sample, and none forbids
 * telling, the layer is there once. */
static void judge(struct tile_classification *map) {
  size_t n = triangle_grid_cell_count(&map->grid);
  for (size_t i = 0; i < n; i++) {
    struct tile *tile = &map->tile[i];
    if (tile->depths == 0)
      continue;
    map->depths |= tile->depths;
    int front = bottom_of_front(tile->depths);
    bool simple =
        tile->over[0] > front && tile->over[1] <= front && tile->bar <= front;
    tile->front = (uint8_t)front;
    tile->state = simple ? TILE_SIMPLE : TILE_MIXED;
  }
}

static void refuse_contours(struct tile_classification *map,
                            const struct sheet *sheet) {
  for (size_t i = 0; i < sheet->contour.count; i++) {
    struct geom_point p = sheet->point.item[sheet->contour.item[i].point[0]],
                      q = sheet->point.item[sheet->contour.item[i].point[1]];
    struct cell_range r =
        triangle_grid_cells(&map->grid, box2_of_segment(p, q));
    int high = tile_bucket(p.z > q.z ? p.z : q.z);
    for (int y = r.y0; y <= r.y1; y++) {
      int x0, x1;
      triangle_grid_row(&map->grid, p, q, r, y, &x0, &x1);
      for (int x = x0; x <= x1; x++) {
        struct tile *tile = tile_at(map, x, y);
        if (high >= tile->front)
          tile->state = TILE_MIXED;
      }
    }
  }
}

static struct box2 tile_window(const struct triangle_grid *grid, int x, int y) {
  int64_t side = INT64_C(1) << grid->shift, x0 = grid->x0 + x * side,
          y0 = grid->y0 + y * side;
  return (struct box2){(int32_t)x0, (int32_t)y0, (int32_t)(x0 + side),
                       (int32_t)(y0 + side)};
}

/* How many triangles are over a point of the page, on average; about, and no
 * more than their boxes.  Needles are not what soups are made of. */
static double mean_layers(const struct sheet *sheet,
                          const struct triangle_grid *grid) {
  size_t n = sheet->triangle.count, stride = n / SAMPLE + 1;
  double side = (double)(INT64_C(1) << grid->shift), sum = 0;
  for (size_t t = 0; t < n; t += stride) {
    const uint32_t *p = sheet->triangle.item[t].point;
    struct box2 b = box2_of_triangle(sheet, (uint32_t)t);
    double box = ((double)b.x1 - b.x0) * ((double)b.y1 - b.y0);
    double area = 0.5 * fabs((double)geom_orient2d(sheet->point.item[p[0]],
                                                   sheet->point.item[p[1]],
                                                   sheet->point.item[p[2]]));
    sum += fmin(box, BOX_PER_AREA * area) * (double)stride;
  }
  return sum / (side * side * grid->columns * grid->rows);
}

/* The horizons of the tiles that the triangle surrounds: of a row, those in one
 * stretch. */
static void raise_horizons(struct tile_classification *map,
                           const struct sheet *sheet, size_t t) {
  const struct triangle_grid *grid = &map->grid;
  struct cell_range r = footprint_cells(grid, sheet, t, map->print[t]);
  if (r.x1 - r.x0 < 2 || r.y1 - r.y0 < 2)
    return;
  struct corners corners = corners_of(sheet, t);
  struct box2 first = tile_window(grid, r.x0 + 1, r.y0 + 1);
  struct contour_walk walk =
      walk_of(&corners, first.x0, first.y0, grid->shift, true);
  struct surrounder_plane plane = surrounder_plane_of(sheet, (uint32_t)t);
  for (int y = r.y0 + 1; y < r.y1; y++, walk_up(&walk)) {
    struct contour_walk row = walk;
    double *horizon = &map->horizon[(size_t)y * (size_t)grid->columns];
    bool inside = false;
    for (int x = r.x0 + 1; x < r.x1; x++, walk_right(&row)) {
      if (!walk_is_inside(&row)) {
        if (inside)
          break;
        continue;
      }
      inside = true;
      struct box2 window = tile_window(grid, x, y);
      double low = surrounder_farthest_z(&plane, &window);
      if (low > horizon[x])
        horizon[x] = low;
    }
  }
}

/* Fragments ask which faces touch, and a steep one may touch across a
 * horizon: it takes the horizons of its tiles away. */
static void drop_horizons(struct tile_classification *map,
                          const struct sheet *sheet,
                          const struct occlusion_bound *all, size_t t) {
  struct corners corners = corners_of(sheet, t);
  struct cell_range r;
  if (!is_steep(sheet, all, (uint32_t)t, &corners))
    return;
  r = footprint_cells(&map->grid, sheet, t, map->print[t]);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++)
      map->horizon[(size_t)y * (size_t)map->grid.columns + (size_t)x] = -1;
}

static bool find_horizons(struct tile_classification *map,
                          const struct sheet *sheet, bool fragments) {
  struct occlusion_bound all = occlusion_tolerance_bound_all(sheet);
  size_t n = triangle_grid_cell_count(&map->grid);
  map->horizon = mem_alloc(n, sizeof *map->horizon);
  if (map->horizon == NULL)
    return false;
  for (size_t i = 0; i < n; i++)
    map->horizon[i] = -1;
  for (size_t t = 0; t < sheet->triangle.count; t++)
    if (!(sheet->triangle_flags[t] & SHEET_FLAT))
      raise_horizons(map, sheet, t);
  if (!fragments)
    return true;
  for (size_t i = 0; i < n; i++)
    map->horizon[i] -= (double)(INT64_C(1) << TILE_BUCKET_SHIFT);
  for (size_t t = 0; t < sheet->triangle.count; t++)
    if (!(sheet->triangle_flags[t] & SHEET_FLAT))
      drop_horizons(map, sheet, &all, t);
  return true;
}

/* Edges and faces that are asked about; a face takes a good deal longer. */
static uint64_t count_questions(const struct sheet *sheet, bool strokes,
                                bool fragments) {
  uint64_t count = fragments ? SOUP_FACE * sheet->triangle.count : 0;
  for (size_t e = 0; strokes && e < sheet->edge.count; e++)
    count += sheet->edge.item[e].edge_class != 0;
  return count;
}

/* The cells of a soup: so many that horizons are found well, so few that
 * they cost little beside asking everything. */
static void shape_soup(struct tile_classification *map,
                       const struct sheet *sheet, bool strokes,
                       bool fragments) {
  uint64_t spread = SOUP_CELLS / sheet->triangle.count + SPREAD;
  uint64_t most =
      count_questions(sheet, strokes, fragments) / SOUP_QUESTIONS + SPREAD;
  if (spread > most)
    spread = most;
  if (spread > SOUP_SPREAD)
    spread = SOUP_SPREAD;
  triangle_grid_shape(&map->grid, sheet, (unsigned)spread, (unsigned)spread);
}

bool tile_classification_init(struct tile_classification *map,
                              const struct sheet *sheet, bool strokes,
                              bool fragments) {
  size_t n;
  bool soup;
  memset(map, 0, sizeof *map);
  triangle_grid_shape(&map->grid, sheet, SPREAD, 2);
  soup = mean_layers(sheet, &map->grid) > SOUP;
  if (soup)
    shape_soup(map, sheet, strokes, fragments);
  n = triangle_grid_cell_count(&map->grid);
  map->tile = mem_calloc(n, sizeof *map->tile);
  map->print = mem_alloc(sheet->triangle.count, sizeof *map->print);
  if (map->tile == NULL || map->print == NULL)
    return false;
  gather(map, sheet, fragments);
  if (soup && !find_horizons(map, sheet, fragments))
    return false;
  judge(map);
  refuse_contours(map, sheet);
  for (size_t i = 0; i < n; i++) {
    struct tile *tile = &map->tile[i];
    map->simple += tile->state == TILE_SIMPLE;
    map->mixed += tile->state == TILE_MIXED;
    map->empty += tile->state == TILE_EMPTY;
  }
  return true;
}

void tile_classification_fini(struct tile_classification *map) {
  mem_free(map->tile);
  mem_free(map->print);
  mem_free(map->horizon);
  map->tile = NULL;
  map->print = NULL;
  map->horizon = NULL;
}
