/* covered.c - finds the hairs: short lines that lie within the ink of others.
 *
 * Phases
 *   1 measure  the paths, and rank them by length
 *   2 mark     the cells of a uniform grid in which hairs may lie
 *   3 list     in these cells the sides of all paths near them, the longest
 *              path's first
 *   4 judge    in parallel, each hair as if all others were drawn
 *   5 decide   from the longest hair to the shortest those of which that says
 *              nothing yet, as they may be covered by hairs that are not drawn
 *              (both in cover_verdict.c)
 * A hair is divided into pieces of a quarter of a pen, and each must have both
 * ends within half a pen of one side of a longer path that is drawn, or within
 * what the side covers beside a seam; then all of it is, as what is within a
 * distance of a straight side is convex.
 * Cost  n log n in the sides; of a cell with many sides those of the longest
 *   paths alone are tried. */
#include <string.h>

#include "base/poll.h"
#include "geom/vector.h"
#include "ink/lines/covering.h"

enum {
  GRID_MAX = 1 << 10, /* cells along each side of the page */
  PENS_IN_CELL = 4
};

/* ---- 1 Measure ----------------------------------------------------------- */

static struct measured_path measure_path(const struct covering *c,
                                         const struct ink_path *path) {
  const struct sheet_edge *edge = &c->sheet->edge.item[path->edge];
  if (path->hidden || (path->classes & ~SEGMENT_GRAPH_FEATURES) != 0)
    return (struct measured_path){.is_drawn = false};
  struct measured_path m = {
      .layer = pens_of_line(c->pens, edge->edge_class,
                            sheet_edge_group(c->sheet, edge)),
      .weight = (float)pens_weight(c->pens, edge->edge_class)};
  const struct ink_point *p = c->paths->point.item + path->point;
  for (uint32_t i = 0; i + 1 < path->count; i++)
    m.length += covering_distance(p[i], p[i + 1]);
  if (path->closed)
    m.length += covering_distance(p[path->count - 1], p[0]);
  double mm = m.length / SHEET_UNITS_PER_MM;
  double shortest = pens_shortest_crease_mm(c->pens, m.layer);
  m.near = pens_ink_reach_mm(c->pens, m.layer, edge->edge_class) *
           SHEET_UNITS_PER_MM;
  m.is_drawn = mm >= pens_shortest_line_mm(c->pens, m.layer) &&
               !path->is_weak && !(path->is_free && mm < shortest);
  m.is_hair = m.is_drawn && mm < shortest && !path->closed;
  return m;
}

/* What measuring a range of paths gives. */
struct measured_range {
  size_t hairs;
  double widest;
};

struct path_measuring {
  struct covering *c;
  struct sort_key *key;         /* one a path: of its length */
  struct measured_range *range; /* one a range */
};

static bool measure_range_of_paths(void *user, struct parallel_range range) {
  const struct path_measuring *of = user;
  const struct covering *c = of->c;
  struct measured_range *own = &of->range[range.begin / PARALLEL_ITEMS];
  for (size_t i = range.begin; i < range.end; i++) {
    struct measured_path *m = &c->measured[i];
    *m = measure_path(c, &c->paths->path.item[i]);
    own->hairs += m->is_hair;
    own->widest = fmax(own->widest, m->near);
    of->key[i] =
        (struct sort_key){UINT64_MAX - (uint64_t)m->length, (uint32_t)i};
  }
  return true;
}

/* Returns false when memory ran out or the caller cancelled. */
static bool measure_all(struct path_measuring *of) {
  struct covering *c = of->c;
  size_t count = c->paths->path.count,
         ranges = parallel_range_count(count, PARALLEL_ITEMS);
  of->range = mem_calloc(ranges, sizeof *of->range);
  bool ok = of->range != NULL &&
            parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                            PARALLEL_ITEMS, measure_range_of_paths, of);
  for (size_t r = 0; ok && r < ranges; r++) {
    c->hairs += of->range[r].hairs;
    c->widest = fmax(c->widest, of->range[r].widest);
  }
  mem_free(of->range);
  return ok;
}

static bool rank_range_of_paths(void *user, struct parallel_range range) {
  const struct path_measuring *of = user;
  for (size_t r = range.begin; r < range.end; r++) {
    uint32_t path = of->key[r].value;
    of->c->by_rank[r] = path;
    of->c->measured[path].rank = (uint32_t)r;
  }
  return true;
}

/* Returns false when memory ran out or the caller cancelled. */
static bool measure_paths(struct covering *c) {
  size_t count = c->paths->path.count;
  struct path_measuring of = {.c = c, .key = mem_alloc(count, sizeof *of.key)};
  struct sort_key *scratch = mem_alloc(count, sizeof *scratch);
  bool ok = of.key != NULL && scratch != NULL && measure_all(&of);
  if (ok && c->hairs > 0) {
    sort_keys(of.key, scratch, count);
    ok = parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                         PARALLEL_ITEMS, rank_range_of_paths, &of);
  }
  mem_free(of.key);
  mem_free(scratch);
  return ok;
}

/* ---- The grid ------------------------------------------------------------ */

static bool make_cells(struct covering *c) {
  double size[2];
  for (int k = 0; k < 2; k++) {
    size[k] = c->sheet->camera.page_mm[k] * SHEET_UNITS_PER_MM;
    c->low[k] = -size[k] / 2;
  }
  c->cell =
      fmax(2 * PENS_IN_CELL * c->widest, fmax(size[0], size[1]) / GRID_MAX);
  for (int k = 0; k < 2; k++)
    c->count[k] = (int64_t)(size[k] / c->cell) + 1;
  c->marked = mem_calloc((size_t)(c->count[0] * c->count[1]), 1);
  return c->marked != NULL;
}

/* Lists the hairs by the cells in which they begin: those of one cell are
 * tested with the same sides, which are in the cache then.  Returns false when
 * memory ran out. */
static bool list_hairs(struct covering *c) {
  size_t n = 0;
  c->hair = mem_alloc(c->hairs, sizeof *c->hair);
  for (uint32_t i = 0; c->hair != NULL && i < c->paths->path.count; i++) {
    const struct ink_point *p =
        c->paths->point.item + c->paths->path.item[i].point;
    if (c->measured[i].is_hair)
      c->hair[n++] =
          (struct sort_key){(uint64_t)covering_cell(c, p->x, p->y), i};
  }
  return c->hair != NULL && sort_keys_alone(c->hair, n);
}

/* ---- 2 Mark -------------------------------------------------------------- */

/* Marks the cells that the box of each side of a hair meets: those in which the
 * middles of its pieces are. */
static void mark_hair(const struct covering *c, uint32_t number) {
  const struct ink_path *path = &c->paths->path.item[number];
  const struct ink_point *p = c->paths->point.item + path->point;
  for (uint32_t i = 0; i + 1 < path->count; i++) {
    int64_t x[2], y[2];
    for (int k = 0; k < 2; k++) {
      x[k] = covering_cell_along(c, 0, p[i + (uint32_t)k].x);
      y[k] = covering_cell_along(c, 1, p[i + (uint32_t)k].y);
    }
    int left = x[0] > x[1], low = y[0] > y[1];
    for (int64_t row = y[low]; row <= y[!low]; row++)
      for (int64_t k = x[left]; k <= x[!left]; k++) /* others mark cells, too */
        __atomic_store_n(&c->marked[row * c->count[0] + k], 1,
                         __ATOMIC_RELAXED);
  }
}

static bool mark_hairs_of_range(void *user, struct parallel_range range) {
  const struct covering *c = user;
  for (size_t i = range.begin; i < range.end; i++) {
    if (i + MEM_PREFETCH_AHEAD < range.end)
      covering_prefetch(c, c->hair[i + MEM_PREFETCH_AHEAD].value,
                        c->hair[i + MEM_PREFETCH_AHEAD / 2].value);
    mark_hair(c, c->hair[i].value);
  }
  return true;
}

/* ---- 3 List -------------------------------------------------------------- */

/* Lists a side in the marked cells within its pen's width of it. */
static bool list_side(const struct covering *c, struct cover_lists *lists,
                      uint32_t path, struct ink_point a, struct ink_point b) {
  const struct measured_path *m = &c->measured[path];
  struct cover_side side = {a, b, m->rank, m->layer, m->weight, m->is_hair};
  double reach = pens_width_mm(c->pens, m->layer) * SHEET_UNITS_PER_MM,
         y0 = min_number(a.y, b.y), y1 = max_number(a.y, b.y);
  uint32_t number = (uint32_t)lists->side.count;
  bool found = false;
  for (int64_t row = covering_cell_along(c, 1, y0 - reach);
       row <= covering_cell_along(c, 1, y1 + reach); row++) {
    /* The part of the side beside the row. */
    double low = c->low[1] + (double)row * c->cell - reach;
    double high = low + c->cell + 2 * reach, x[2] = {a.x, b.x};
    for (int k = 0; k < 2 && y1 > y0; k++) {
      double y = min_number(high, max_number(low, k ? b.y : a.y));
      x[k] = a.x + ((double)b.x - a.x) * (y - a.y) / ((double)b.y - a.y);
    }
    int64_t end = covering_cell_along(c, 0, max_number(x[0], x[1]) + reach);
    for (int64_t i = covering_cell_along(c, 0, min_number(x[0], x[1]) - reach);
         i <= end; i++) {
      struct cover_listed listed = {(uint32_t)(row * c->count[0] + i), number};
      if (c->marked[listed.cell] && !ARRAY_PUSH(&lists->listed, listed))
        return false;
      found = found || c->marked[listed.cell];
    }
  }
  return !found || ARRAY_PUSH(&lists->side, side);
}

/* Lists the sides of a range of paths, from the shortest on. */
static bool list_sides_of_range(void *user, struct parallel_range range) {
  const struct covering *c = user;
  struct cover_lists *lists = &c->lists[range.begin / PARALLEL_ITEMS];
  const uint32_t *shortest = c->by_rank + c->paths->path.count - 1;
  for (size_t n = range.begin; n < range.end; n++) {
    uint32_t i = *(shortest - n);
    if (n + MEM_PREFETCH_AHEAD < range.end)
      covering_prefetch(c, *(shortest - n - MEM_PREFETCH_AHEAD),
                        *(shortest - n - MEM_PREFETCH_AHEAD / 2));
    const struct ink_path *path = &c->paths->path.item[i];
    const struct ink_point *p = c->paths->point.item + path->point;
    for (uint32_t k = path->count; c->measured[i].is_drawn && k-- > 0;)
      if ((k + 1 < path->count || path->closed) &&
          !list_side(c, lists, i, p[k], p[(k + 1) % path->count]))
        return false;
  }
  return true;
}

/* Puts the sides together. */
static bool join_sides(struct covering *c, size_t ranges) {
  size_t sum = 0;
  for (size_t r = 0; r < ranges; r++) {
    c->lists[r].before = (uint32_t)sum;
    sum += c->lists[r].side.count;
  }
  if (!ARRAY_RESERVE(&c->side, sum))
    return false;
  c->side.count = sum;
  for (size_t r = 0; r < ranges; r++) {
    struct cover_lists *lists = &c->lists[r];
    if (lists->side.count > 0)
      memcpy(c->side.item + lists->before, lists->side.item,
             lists->side.count * sizeof *c->side.item);
    ARRAY_FREE(&lists->side);
  }
  return true;
}

static void put_listed(struct covering *c, size_t ranges) {
  for (size_t r = 0; r < ranges; r++) {
    const struct cover_lists *lists = &c->lists[r];
    for (size_t i = 0; i < lists->listed.count; i++) {
      (void)poll_at(i);
      number_lists_put(&c->sides, lists->listed.item[i].cell,
                       lists->before + lists->listed.item[i].side);
    }
  }
}

/* The last side of the shortest path comes first, as number_lists reverses the
 * order. */
static bool list_sides(struct covering *c) {
  size_t cells = (size_t)(c->count[0] * c->count[1]),
         count = c->paths->path.count,
         ranges = parallel_range_count(count, PARALLEL_ITEMS);
  c->lists = mem_calloc(ranges, sizeof *c->lists);
  bool ok = c->lists != NULL &&
            parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                            PARALLEL_ITEMS, list_sides_of_range, c) &&
            join_sides(c, ranges) && number_lists_init(&c->sides, cells);
  if (ok)
    put_listed(c, ranges);
  ok = ok && number_lists_allocate(&c->sides, cells);
  if (ok)
    put_listed(c, ranges);
  for (size_t r = 0; c->lists != NULL && r < ranges; r++) {
    ARRAY_FREE(&c->lists[r].side);
    ARRAY_FREE(&c->lists[r].listed);
  }
  mem_free(c->lists);
  return ok;
}

bool paths_find_covered(struct ink_paths *paths, const struct sheet *sheet,
                        const struct pens *pens) {
  struct covering c = {.paths = paths, .sheet = sheet, .pens = pens};
  size_t count = paths->path.count;
  c.measured = mem_alloc(count, sizeof *c.measured);
  c.by_rank = mem_alloc(count, sizeof *c.by_rank);
  c.verdict = mem_calloc(count, sizeof *c.verdict);
  bool ok = c.measured != NULL && c.by_rank != NULL && c.verdict != NULL &&
            measure_paths(&c);
  if (ok && c.hairs > 0) {
    ok = make_cells(&c) && list_hairs(&c) &&
         parallel_ranges(parallel_workers(c.hairs, PATHS_IN_RANGE), c.hairs,
                         PATHS_IN_RANGE, mark_hairs_of_range, &c) &&
         list_sides(&c) && covering_decide(&c);
  }
  mem_free(c.measured);
  mem_free(c.by_rank);
  mem_free(c.verdict);
  mem_free(c.hair);
  ARRAY_FREE(&c.undecided);
  mem_free(c.marked);
  ARRAY_FREE(&c.side);
  number_lists_fini(&c.sides);
  return ok;
}
