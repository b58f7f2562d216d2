/* tile_classification.c - finds the page tiles over which a front layer of
 * faces hides everything behind it.
 *
 * Phases
 *   1 visit the faces once; collect for each tile the depth buckets of its
 *     faces, the two nearest faces over its sample point, and the nearest face
 *     that makes the sample unusable
 *   2 find each tile's front layer; the tile is simple if exactly one face of
 *     the layer is over the sample point
 *   3 reject the tiles that a contour enters at the depths of the layer */
#include "visibility/pairwise/tile_classification.h"

#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "visibility/predicate/occlusion.h"
#include "visibility/predicate/plane_filter.h"

/* A scene is called deep if its depth complexity is above DEEP. */
enum {
  TILES_PER_TRIANGLE = 2,        /* on average: a tile is about an edge long */
  DEEP = 32,                     /* faces over a point, on average */
  DEEP_TILES_TOTAL = 1 << 22,    /* of all triangles of a deep scene together */
  DEEP_TILES_PER_TRIANGLE = 256, /* at most, on average */
  DEEP_QUERIES_PER_TILE = 8, /* a tile costs a tenth of so many edge queries */
  QUERIES_PER_FACE = 16,     /* a face takes as long as so many edges */
  CONTOURS_IN_RANGE = PARALLEL_RANGE(512) /* that a thread takes at once */
};

static uint64_t bucket_mask(int low, int high) {
  return (~UINT64_C(0) >> (TILE_BUCKETS - 1 - high)) & (~UINT64_C(0) << low);
}

/* ---- Collecting the faces of each tile ----------------------------------- */

/* Returns whether the triangle may hide or touch something across an empty
 * bucket: whether an upper bound of its contact tolerance (occlusion.h) exceeds
 * half a bucket's depth; the other half exceeds all rounding errors.
 * all  a coarser bound for the tolerances of all triangles, which is tried
 *      first */
static bool is_steep(const struct sheet *sheet,
                     const struct occlusion_bound *all, uint32_t triangle,
                     const struct geom_triangle *corners) {
  const double thickness_max = (double)(INT64_C(1) << (TILE_BUCKET_SHIFT - 1));
  double nz, bound = occlusion_bound_of(all, corners, &nz);
  if (bound < thickness_max * nz)
    return false;
  struct plane_filter plane = plane_filter_of(sheet, triangle);
  return !(plane_filter_thickness(&plane) < thickness_max);
}

/* What is read for every triangle, as a copy, so that the compiler knows that
 * writing to the tiles does not change it. */
struct tile_collection {
  struct tile *tile;
  size_t columns;
  int shift;
  point_lanes first; /* the grid's lower left corner */
  /* The sample point of the first tile, from there.  It is off the middle,
   * because in regular meshes whose edges are aligned with the grid the middle
   * would often be on an edge. */
  point_lanes sample;
};

static inline struct tile *collection_tile(const struct tile_collection *g,
                                           int x, int y) {
  return &g->tile[(size_t)y * g->columns + (size_t)x];
}

static struct tile_collection
collection_of(const struct tile_classification *tiles, struct tile *tile) {
  const struct triangle_grid *grid = &tiles->grid;
  int64_t side = INT64_C(1) << grid->shift;
  return (struct tile_collection){
      .tile = tile,
      .columns = (size_t)grid->columns,
      .shift = grid->shift,
      .first = {grid->x0, grid->y0},
      .sample = {(int32_t)(side * 37 / 64), (int32_t)(side * 29 / 64)}};
}

/* Records a face that makes the tile's sample unusable. */
static inline void add_unsafe_to(struct tile *tile, uint8_t farthest) {
  if (tile->unsafe < farthest)
    tile->unsafe = farthest;
}

/* Records the triangle if it is over the tile's sample point.  If the sample is
 * on one of its sides, it is unusable.
 * farthest  the triangle's farthest bucket + 1 */
static inline void add_to_sample(struct tile *tile,
                                 const struct geom_triangle *corners,
                                 struct geom_point sample, uint8_t farthest) {
  const struct geom_point *p = corners->p;
  int64_t a = geom_orient2d(p[0], p[1], sample),
          b = geom_orient2d(p[1], p[2], sample),
          c = geom_orient2d(p[2], p[0], sample);
  if ((a | b | c) < 0)
    return;
  if (a == 0 || b == 0 || c == 0) {
    add_unsafe_to(tile, farthest);
  } else if (farthest > tile->nearest[0]) {
    tile->nearest[1] = tile->nearest[0];
    tile->nearest[0] = farthest;
  } else if (farthest > tile->nearest[1]) {
    tile->nearest[1] = farthest;
  }
}

/* A triangle with all that its tiles need of it. */
struct collected {
  struct geom_triangle corners;
  point_lanes low, high; /* the ends of its box, from the grid's corner on */
  struct cell_range cells;
  int farthest, nearest; /* its depth buckets */
  /* The first of its tiles, and of those in its last row. */
  struct tile *first, *last;
};

/* The same for all sample points within the triangle's box.  None of it lies
 * outside of the grid, nor do the samples. */
static inline void add_to_samples(const struct tile_collection *g,
                                  const struct collected *c) {
  point_lanes before = (c->low - g->sample - 1) >> g->shift,
              last = (c->high - g->sample) >> g->shift, within = before < last;
  if ((within[0] & within[1]) == 0) /* one jump for each */
    return;
  int y = before[1];
  do {
    int x = before[0];
    y++;
    do {
      x++;
      struct geom_point sample = {
          (int32_t)(g->first[0] + g->sample[0] + ((int64_t)x << g->shift)),
          (int32_t)(g->first[1] + g->sample[1] + ((int64_t)y << g->shift)), 0};
      add_to_sample(collection_tile(g, x, y), &c->corners, sample,
                    (uint8_t)(c->farthest + 1));
    } while (x < last[0]);
  } while (y < last[1]);
}

/* Adds a triangle's depth buckets to all its tiles.  Most have two by two at
 * most: those in the corners of the range, whichever are the same. */
static inline void add_buckets(const struct tile_collection *g,
                               const struct collected *c) {
  uint64_t mask = bucket_mask(c->farthest, c->nearest);
  int width = c->cells.x1 - c->cells.x0, height = c->cells.y1 - c->cells.y0;
  if ((width <= 1) & (height <= 1)) {
    c->first[0].z_buckets |= mask;
    c->first[width].z_buckets |= mask;
    c->last[0].z_buckets |= mask;
    c->last[width].z_buckets |= mask;
    return;
  }
  for (struct tile *row = c->first; row <= c->last; row += g->columns)
    for (int x = 0; x <= width; x++)
      row[x].z_buckets |= mask;
}

/* Makes the samples of all tiles of a triangle unusable. */
static void add_unsafe(const struct tile_collection *g, struct cell_range r,
                       uint8_t farthest) {
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++)
      add_unsafe_to(collection_tile(g, x, y), farthest);
}

/* What the workers of phase 1 know. */
struct collection_work {
  struct tile_classification *tiles;
  const struct sheet *sheet;
  struct occlusion_bound all;
  bool fragments;
  int workers;
  struct tile **own; /* one a worker: its tiles; NULL: it has none yet */
};

/* The tiles of a worker; NULL when memory ran out. */
static struct tile *tiles_of_worker(const struct collection_work *work,
                                    int worker) {
  if (work->own[worker] == NULL)
    work->own[worker] = mem_calloc(triangle_grid_cell_count(&work->tiles->grid),
                                   sizeof *work->own[worker]);
  return work->own[worker];
}

/* Reads a triangle, and has the first of its tiles, and of those in the last
 * row, fetched. */
static inline struct collected collected_of(const struct collection_work *work,
                                            const struct tile_collection *g,
                                            size_t t) {
  const uint32_t *p = work->sheet->triangle.item[t].point;
  const struct geom_point *point = work->sheet->point.item;
  struct collected c = {.corners = {{point[p[0]], point[p[1]], point[p[2]]}}};
  point_lanes a = point_lanes_of(&c.corners.p[0]),
              b = point_lanes_of(&c.corners.p[1]), ab = point_lanes_min(a, b),
              last = point_lanes_of(&c.corners.p[2]);
  c.low = point_lanes_min(ab, last) - g->first;
  c.high = point_lanes_max(point_lanes_max(a, b), last) - g->first;
  point_lanes from = c.low >> g->shift, to = c.high >> g->shift;
  c.cells = (struct cell_range){from[0], from[1], to[0], to[1]};
  c.farthest = tile_bucket_of_lanes(c.low);
  c.nearest = tile_bucket_of_lanes(c.high);
  c.first = collection_tile(g, c.cells.x0, c.cells.y0);
  c.last = collection_tile(g, c.cells.x0, c.cells.y1);
  MEM_PREFETCH(c.first);
  MEM_PREFETCH(c.last);
  return c;
}

static inline void add_collected(const struct collection_work *work,
                                 const struct tile_collection *g,
                                 const struct collected *c, size_t t) {
  work->tiles->footprint[t] = footprint_of(c->cells, c->farthest, c->nearest);
  add_buckets(g, c);
  if (work->sheet->triangle_flags[t] & SHEET_EDGE_ON)
    return;
  if (is_steep(work->sheet, &work->all, (uint32_t)t, &c->corners))
    add_unsafe(g, c->cells,
               work->fragments ? UINT8_MAX : (uint8_t)(c->farthest + 1));
  else
    add_to_samples(g, c);
}

/* Phase 1: visits the triangles of a range, block by block: all of a block are
 * read before the first changes a tile, so that the memory accesses of many
 * overlap, which where their points and tiles lie far apart is most of the
 * time. */
static bool collect_range(void *user, struct parallel_range range) {
  enum { BLOCK = 64 };
  const struct collection_work *work = user;
  struct tile *own = tiles_of_worker(work, range.worker);
  const struct tile_collection g = collection_of(work->tiles, own);
  struct collected block[BLOCK];
  if (own == NULL)
    return false;
  for (size_t begin = range.begin; begin < range.end; begin += BLOCK) {
    size_t end = begin + BLOCK < range.end ? begin + BLOCK : range.end;
    (void)poll_at(begin);
    for (size_t t = begin; t < end; t++) {
      if (t + MEM_PREFETCH_AHEAD < range.end)
        sheet_prefetch_corners(work->sheet, t + MEM_PREFETCH_AHEAD);
      block[t - begin] = collected_of(work, &g, t);
    }
    for (size_t t = begin; t < end; t++)
      add_collected(work, &g, &block[t - begin], t);
  }
  return true;
}

/* Adds what another worker collected in a tile. */
static inline void unite_tiles(struct tile *tile, const struct tile *other) {
  uint8_t a = tile->nearest[0], b = other->nearest[0],
          next = a < b ? other->nearest[1] : tile->nearest[1];
  tile->z_buckets |= other->z_buckets;
  add_unsafe_to(tile, other->unsafe);
  tile->nearest[0] = a < b ? b : a;
  tile->nearest[1] = a < b ? (a < next ? next : a) : (b < next ? next : b);
}

/* Unites a range of the tiles of all workers. */
static bool unite_range(void *user, struct parallel_range range) {
  const struct collection_work *work = user;
  for (int w = 1; w < work->workers; w++)
    for (size_t i = range.begin; work->own[w] != NULL && i < range.end; i++)
      unite_tiles(&work->tiles->tile[i], &work->own[w][i]);
  return true;
}

/* Phase 1: each worker collects in tiles of its own, which are then united;
 * where the tiles are more than the triangles there is one worker. */
static bool collect_all(struct collection_work *work) {
  size_t triangles = work->sheet->triangle.count,
         tiles = triangle_grid_cell_count(&work->tiles->grid);
  work->workers =
      tiles <= triangles ? parallel_workers(triangles, PARALLEL_ITEMS) : 1;
  work->own = mem_calloc((size_t)work->workers, sizeof *work->own);
  if (work->own == NULL)
    return false;
  work->own[0] = work->tiles->tile;
  bool ok = work->workers == 1
                ? collect_range(work, (struct parallel_range){0, triangles, 0})
                : parallel_ranges(work->workers, triangles, PARALLEL_ITEMS,
                                  collect_range, work) &&
                      parallel_ranges(work->workers, tiles, PARALLEL_ITEMS,
                                      unite_range, work);
  for (int w = 1; w < work->workers; w++)
    mem_free(work->own[w]);
  mem_free(work->own);
  return ok;
}

/* ---- Classifying --------------------------------------------------------- */

/* The lowest bit of the highest run of ones: the farthest bucket of the front
 * layer.  z_buckets is not 0. */
static int front_layer_bottom(uint64_t z_buckets) {
  int above = __builtin_clzll(z_buckets);
  uint64_t gaps = ~(z_buckets << above);
  int run = gaps == 0 ? TILE_BUCKETS : __builtin_clzll(gaps);
  return TILE_BUCKETS - above - run;
}

/* What the ranges of tiles and contours have in common. */
struct classifying {
  struct tile_classification *tiles;
  const struct sheet *sheet;
  _Atomic uint64_t z_buckets, simple, mixed, empty; /* as of the tiles */
};

/* Phase 2: if exactly one face of the front layer is over the sample point, and
 * none makes the sample unusable, the layer covers the tile exactly once. */
static bool find_simple_range(void *user, struct parallel_range range) {
  struct classifying *work = user;
  uint64_t z_buckets = 0;
  for (size_t i = range.begin; i < range.end; i++) {
    struct tile *tile = &work->tiles->tile[i];
    if (tile->z_buckets == 0)
      continue;
    z_buckets |= tile->z_buckets;
    int front = front_layer_bottom(tile->z_buckets);
    bool simple = tile->nearest[0] > front && tile->nearest[1] <= front &&
                  tile->unsafe <= front;
    tile->front = (uint8_t)front;
    tile->state = simple ? TILE_SIMPLE : TILE_MIXED;
  }
  work->z_buckets |= z_buckets;
  return true;
}

static void reject_contour(const struct tile_classification *tiles,
                           struct geom_segment s) {
  struct cell_range r =
      triangle_grid_cells(&tiles->grid, box2_of_segment(s.p, s.q));
  int high = tile_bucket(s.p.z > s.q.z ? s.p.z : s.q.z);
  for (int y = r.y0; y <= r.y1; y++) {
    int x0, x1;
    triangle_grid_row(&tiles->grid, s.p, s.q, r, y, &x0, &x1);
    for (int x = x0; x <= x1; x++) {
      struct tile *tile = &tiles->tile[triangle_grid_index(&tiles->grid, x, y)];
      if (high >= tile->front) /* other threads may do the same */
        __atomic_store_n(&tile->state, TILE_MIXED, __ATOMIC_RELAXED);
    }
  }
}

/* Phase 3. */
static bool reject_contour_range(void *user, struct parallel_range range) {
  const struct classifying *work = user;
  const struct sheet *sheet = work->sheet;
  for (size_t i = range.begin; i < range.end; i++)
    reject_contour(work->tiles,
                   sheet_ends(sheet, sheet->contour.item[i].point));
  return true;
}

static bool count_tile_states(void *user, struct parallel_range range) {
  struct classifying *work = user;
  uint64_t count[TILE_STATES] = {0};
  for (size_t i = range.begin; i < range.end; i++)
    count[work->tiles->tile[i].state]++;
  work->empty += count[TILE_EMPTY];
  work->mixed += count[TILE_MIXED];
  work->simple += count[TILE_SIMPLE];
  return true;
}

/* Phases 2 and 3.  Returns false when the caller cancelled. */
static bool classify_tiles(struct tile_classification *tiles,
                           const struct sheet *sheet) {
  struct classifying work = {.tiles = tiles, .sheet = sheet};
  size_t n = triangle_grid_cell_count(&tiles->grid),
         contours = sheet->contour.count;
  int workers = parallel_workers(n, PARALLEL_ITEMS);
  bool ok =
      parallel_ranges(workers, n, PARALLEL_ITEMS, find_simple_range, &work) &&
      parallel_ranges(parallel_workers(contours, CONTOURS_IN_RANGE), contours,
                      CONTOURS_IN_RANGE, reject_contour_range, &work) &&
      parallel_ranges(workers, n, PARALLEL_ITEMS, count_tile_states, &work);
  tiles->z_buckets = work.z_buckets;
  tiles->simple = work.simple;
  tiles->mixed = work.mixed;
  tiles->empty = work.empty;
  return ok;
}

/* The number of edges to solve, plus that of the faces times
 * QUERIES_PER_FACE. */
static uint64_t count_queries(const struct sheet *sheet, bool edges,
                              bool fragments) {
  uint64_t count = fragments ? QUERIES_PER_FACE * sheet->triangle.count : 0;
  for (size_t e = 0; edges && e < sheet->edge.count; e++)
    count += sheet->edge.item[e].edge_class != 0;
  return count;
}

/* Chooses the tiles of a deep scene: small, so that lists are short,
 * but large enough that the work per tile is little compared with the
 * queries. */
static void shape_deep_tiles(struct tile_classification *tiles,
                             const struct sheet *sheet, bool edges,
                             bool fragments) {
  uint64_t spread =
      DEEP_TILES_TOTAL / sheet->triangle.count + TILES_PER_TRIANGLE;
  uint64_t spread_max =
      count_queries(sheet, edges, fragments) / DEEP_QUERIES_PER_TILE +
      TILES_PER_TRIANGLE;
  if (spread > spread_max)
    spread = spread_max;
  if (spread > DEEP_TILES_PER_TRIANGLE)
    spread = DEEP_TILES_PER_TRIANGLE;
  triangle_grid_shape(&tiles->grid, sheet, (unsigned)spread, (unsigned)spread);
}

bool tile_classification_init(struct tile_classification *tiles,
                              const struct sheet *sheet, bool edges,
                              bool fragments) {
  size_t n;
  memset(tiles, 0, sizeof *tiles);
  triangle_grid_shape(&tiles->grid, sheet, TILES_PER_TRIANGLE, 2);
  n = triangle_grid_cell_count(&tiles->grid);
  if (occlusion_culling_complexity(
          sheet, ldexp((double)n, 2 * tiles->grid.shift)) > DEEP)
    shape_deep_tiles(tiles, sheet, edges, fragments);
  n = triangle_grid_cell_count(&tiles->grid);
  tiles->tile = mem_calloc(n, sizeof *tiles->tile);
  tiles->footprint = mem_alloc(sheet->triangle.count, sizeof *tiles->footprint);
  if (tiles->tile == NULL || tiles->footprint == NULL)
    return false;
  struct collection_work work = {
      .tiles = tiles,
      .sheet = sheet,
      .all = occlusion_tolerance_bound_all(sheet),
      .fragments = fragments,
  };
  return collect_all(&work) && classify_tiles(tiles, sheet);
}

void tile_classification_drop_footprints(struct tile_classification *tiles) {
  mem_free(tiles->footprint);
  tiles->footprint = NULL;
}

void tile_classification_fini(struct tile_classification *tiles) {
  tile_classification_drop_footprints(tiles);
  mem_free(tiles->tile);
  tiles->tile = NULL;
}
