/* covered.c - finds the hairs: short lines that lie within the ink of others.
 *
 * Phases
 *   1 measure  the paths, and rank them by length
 *   2 mark     the cells of a uniform grid in which hairs may lie
 *   3 list     in these cells the sides of all paths near them, the longest
 *              path's first
 *   4 decide   from the longest hair to the shortest
 * A hair is divided into pieces of a quarter of a pen, and each must have both
 * ends within half a pen
 * of one side of a longer path that is drawn; then all of it is, as what is
 * within a distance of a straight side is convex.
 * Cost  n log n in the sides; of a cell with many sides those of the longest
 *   paths alone are tried. */
#include "ink/lines/paths.h"

#include <math.h>

#include "base/poll.h"
#include "base/sort.h"
#include "geom/nearest.h"
#include "ink/pens.h"

enum {
  SIDES_TRIED_MAX = 256,
  GRID_MAX = 1 << 10, /* cells along each side of the page */
  PENS_IN_CELL = 4
};

struct measured_path {
  double length, near; /* grid units; near: half of its pen */
  uint32_t rank;       /* 0: the longest */
  uint32_t layer;
  float weight;
  bool is_hair, is_drawn;
};

/* A side of a path, which may cover a hair. */
struct cover_side {
  uint32_t path;
  struct ink_point a, b;
};

struct covering {
  struct ink_paths *paths;
  const struct sheet *sheet;
  const struct pens *pens;
  struct measured_path *measured; /* one a path */
  uint32_t *by_rank;
  uint8_t *marked; /* one a cell */
  double cell, low[2], widest;
  int64_t count[2]; /* of cells, in x and in y */
  ARRAY(struct cover_side) side;
  ARRAY(struct sort_key) listed; /* cell << 32 | rank, side */
};

static double distance(struct ink_point a, struct ink_point b) {
  double dx = (double)b.x - a.x, dy = (double)b.y - a.y;
  return sqrt(dx * dx + dy * dy);
}

/* ---- 1 Measure ----------------------------------------------------------- */

static struct measured_path measure_path(const struct covering *c,
                                         const struct ink_path *path) {
  const struct sheet_edge *edge = &c->sheet->edge.item[path->edge];
  if (path->hidden || (path->classes & ~SEGMENT_GRAPH_FEATURES) != 0)
    return (struct measured_path){.is_drawn = false};
  struct measured_path m = {
      .layer = pens_of_line(c->pens, edge->edge_class, edge->group),
      .weight = (float)pens_weight(c->pens, edge->edge_class)};
  const struct ink_point *p = c->paths->point.item + path->point;
  for (uint32_t i = 0; i + 1 < path->count; i++)
    m.length += distance(p[i], p[i + 1]);
  if (path->closed)
    m.length += distance(p[path->count - 1], p[0]);
  double mm = m.length / SHEET_UNITS_PER_MM;
  double shortest = pens_shortest_crease_mm(c->pens, m.layer);
  m.near = pens_width_mm(c->pens, m.layer) / 2 * SHEET_UNITS_PER_MM;
  m.is_drawn = mm >= pens_shortest_line_mm(c->pens, m.layer) &&
               !path->is_weak && !(path->is_free && mm < shortest);
  m.is_hair = m.is_drawn && mm < shortest && !path->closed;
  return m;
}

/* Returns false when memory ran out. */
static bool measure_paths(struct covering *c, size_t *hairs) {
  size_t count = c->paths->path.count;
  struct sort_key *key = mem_alloc(count, sizeof *key);
  struct sort_key *scratch = mem_alloc(count, sizeof *scratch);
  bool ok = key != NULL && scratch != NULL;
  *hairs = 0;
  for (size_t i = 0; ok && i < count; i++) {
    struct measured_path *m = &c->measured[i];
    (void)poll_at(i);
    *m = measure_path(c, &c->paths->path.item[i]);
    *hairs += m->is_hair;
    c->widest = fmax(c->widest, m->near);
    key[i] = (struct sort_key){UINT64_MAX - (uint64_t)m->length, (uint32_t)i};
  }
  if (ok && *hairs > 0) {
    sort_keys(key, scratch, count);
    for (uint32_t r = 0; r < count; r++) {
      c->by_rank[r] = key[r].value;
      c->measured[key[r].value].rank = r;
    }
  }
  mem_free(key);
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

/* The cell's index along an axis, moved into the page. */
static int64_t cell_along(const struct covering *c, int axis, double at) {
  double i = floor((at - c->low[axis]) / c->cell);
  return (int64_t)fmin(fmax(i, 0), (double)c->count[axis] - 1);
}

static int64_t cell_of_place(const struct covering *c, double x, double y) {
  return cell_along(c, 1, y) * c->count[0] + cell_along(c, 0, x);
}

/* Calls do_piece for all pieces of a path, each from at[0], at[1] to at[2],
 * at[3]; returns false where that did. */
static bool for_all_pieces(struct covering *c, uint32_t number,
                           bool (*do_piece)(struct covering *c,
                                            const struct measured_path *hair,
                                            const double at[4])) {
  const struct ink_path *path = &c->paths->path.item[number];
  const struct measured_path *hair = &c->measured[number];
  for (uint32_t i = 0; i + 1 < path->count; i++) {
    const struct ink_point *p = &c->paths->point.item[path->point + i];
    double pieces = ceil(distance(p[0], p[1]) / hair->near * 2);
    double dx = ((double)p[1].x - p[0].x) / pieces;
    double dy = ((double)p[1].y - p[0].y) / pieces;
    for (double k = 0; k < pieces; k++) {
      const double at[4] = {p->x + k * dx, p->y + k * dy, p->x + (k + 1) * dx,
                            p->y + (k + 1) * dy};
      if (!do_piece(c, hair, at))
        return false;
    }
  }
  return true;
}

/* ---- 2 Mark -------------------------------------------------------------- */

static bool mark_piece(struct covering *c, const struct measured_path *hair,
                       const double at[4]) {
  (void)hair;
  c->marked[cell_of_place(c, (at[0] + at[2]) / 2, (at[1] + at[3]) / 2)] = 1;
  return true;
}

/* ---- 3 List -------------------------------------------------------------- */

/* Lists a side in the marked cells within its pen's width of it. */
static bool list_side(struct covering *c, uint32_t path, struct ink_point a,
                      struct ink_point b) {
  const struct measured_path *m = &c->measured[path];
  struct cover_side side = {path, a, b};
  double reach = 2 * m->near, y0 = fmin(a.y, b.y), y1 = fmax(a.y, b.y);
  uint32_t number = (uint32_t)c->side.count;
  bool found = false;
  for (int64_t row = cell_along(c, 1, y0 - reach);
       row <= cell_along(c, 1, y1 + reach); row++) {
    /* The part of the side beside the row. */
    double low = c->low[1] + (double)row * c->cell - reach;
    double high = low + c->cell + 2 * reach, x[2] = {a.x, b.x};
    for (int k = 0; k < 2 && y1 > y0; k++) {
      double y = fmin(fmax(k ? b.y : a.y, low), high);
      x[k] = a.x + ((double)b.x - a.x) * (y - a.y) / ((double)b.y - a.y);
    }
    int64_t end = cell_along(c, 0, fmax(x[0], x[1]) + reach);
    for (int64_t i = cell_along(c, 0, fmin(x[0], x[1]) - reach); i <= end;
         i++) {
      uint64_t cell = (uint64_t)(row * c->count[0] + i);
      struct sort_key listed = {cell << 32 | m->rank, number};
      if (c->marked[cell] && !ARRAY_PUSH(&c->listed, listed))
        return false;
      found = found || c->marked[cell];
    }
  }
  return !found || ARRAY_PUSH(&c->side, side);
}

static bool list_sides(struct covering *c) {
  for (uint32_t i = 0; i < c->paths->path.count; i++) {
    const struct ink_path *path = &c->paths->path.item[i];
    const struct ink_point *p = c->paths->point.item + path->point;
    bool ok = poll_at(i);
    for (uint32_t k = 0; ok && c->measured[i].is_drawn && k < path->count; k++)
      if (k + 1 < path->count || path->closed)
        ok = list_side(c, i, p[k], p[(k + 1) % path->count]);
    if (!ok)
      return false;
  }
  struct sort_key *scratch = mem_alloc(c->listed.count, sizeof *scratch);
  if (scratch != NULL)
    sort_keys(c->listed.item, scratch, c->listed.count);
  mem_free(scratch);
  return scratch != NULL;
}

/* ---- 4 Decide ------------------------------------------------------------ */

static bool is_near_side(const struct cover_side *side, double x, double y,
                         double near) {
  double dx = (double)side->b.x - side->a.x, dy = (double)side->b.y - side->a.y;
  double px = x - side->a.x, py = y - side->a.y;
  double t = geom_nearest_parameter(dx, dy, px, py);
  px -= t * dx;
  py -= t * dy;
  return px * px + py * py <= near * near;
}

/* Whether a side in the cell is near both ends of a piece of a hair: at[0],
 * at[1] and at[2], at[3]. */
static bool is_piece_covered(struct covering *c,
                             const struct measured_path *hair,
                             const double at[4]) {
  uint64_t cell =
      (uint64_t)cell_of_place(c, (at[0] + at[2]) / 2, (at[1] + at[3]) / 2);
  const struct sort_key *listed = c->listed.item;
  size_t i;
  LOWER_BOUND(i, 0, c->listed.count, listed[i].key < cell << 32);
  for (int tried = 0; i < c->listed.count && tried < SIDES_TRIED_MAX; i++) {
    const struct cover_side *side = &c->side.item[listed[i].value];
    const struct measured_path *m = &c->measured[side->path];
    if (listed[i].key >= (cell << 32 | hair->rank))
      return false;
    if (!m->is_drawn || m->layer != hair->layer || m->weight < hair->weight)
      continue;
    tried++;
    if (is_near_side(side, at[0], at[1], hair->near) &&
        is_near_side(side, at[2], at[3], hair->near))
      return true;
  }
  return false;
}

bool paths_find_covered(struct ink_paths *paths, const struct sheet *sheet,
                        const struct pens *pens) {
  struct covering c = {.paths = paths, .sheet = sheet, .pens = pens};
  size_t count = paths->path.count, hairs;
  c.measured = mem_alloc(count, sizeof *c.measured);
  c.by_rank = mem_alloc(count, sizeof *c.by_rank);
  bool ok =
      c.measured != NULL && c.by_rank != NULL && measure_paths(&c, &hairs);
  if (ok && hairs > 0) {
    ok = make_cells(&c);
    for (uint32_t i = 0; ok && i < count; i++)
      if (c.measured[i].is_hair)
        (void)for_all_pieces(&c, i, mark_piece);
    ok = ok && list_sides(&c);
    for (uint32_t r = 0; ok && r < count; r++) {
      uint32_t i = c.by_rank[r];
      paths->path.item[i].is_covered =
          c.measured[i].is_hair && for_all_pieces(&c, i, is_piece_covered);
      c.measured[i].is_drawn &= !paths->path.item[i].is_covered;
    }
  }
  mem_free(c.measured);
  mem_free(c.by_rank);
  mem_free(c.marked);
  ARRAY_FREE(&c.side);
  ARRAY_FREE(&c.listed);
  return ok;
}
