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
 * A hair is divided into pieces of a quarter of a pen, and each must have both
 * ends within half a pen of one side of a longer path that is drawn, or within
 * what the side covers beside a seam; then all of it is, as what is within a
 * distance of a straight side is convex.
 * Cost  n log n in the sides; of a cell with many sides those of the longest
 *   paths alone are tried. */
#include "ink/lines/paths.h"

#include <math.h>
#include <string.h>

#include "base/poll.h"
#include "base/sort.h"
#include "geom/vector.h"
#include "ink/lines/cover_side.h"
#include "ink/pens.h"

enum {
  SIDES_TRIED_MAX = 256,
  GRID_MAX = 1 << 10, /* cells along each side of the page */
  PENS_IN_CELL = 4
};

enum verdict { NOT_COVERED, COVERED, UNDECIDED }; /* the first of no hair */

struct measured_path {
  double length, near; /* grid units; near: what covers it is, at most */
  uint32_t rank;       /* 0: the longest */
  uint32_t layer;
  float weight;
  bool is_hair, is_drawn;
};

struct covering {
  struct ink_paths *paths;
  const struct sheet *sheet;
  const struct pens *pens;
  struct measured_path *measured; /* one a path */
  uint32_t *by_rank;
  uint8_t *verdict;      /* one a path */
  struct sort_key *hair; /* the cells in which hairs begin, and their paths */
  size_t hairs;
  uint8_t *marked; /* one a cell */
  double cell, low[2], widest;
  int64_t count[2];              /* of cells, in x and in y */
  struct cover_lists *lists;     /* one a range of paths */
  ARRAY(struct cover_side) side; /* the shortest path's first */
  struct number_lists sides;     /* of each cell, the longest path's first */
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
      .layer = pens_of_line(c->pens, edge->edge_class,
                            sheet_edge_group(c->sheet, edge)),
      .weight = (float)pens_weight(c->pens, edge->edge_class)};
  const struct ink_point *p = c->paths->point.item + path->point;
  for (uint32_t i = 0; i + 1 < path->count; i++)
    m.length += distance(p[i], p[i + 1]);
  if (path->closed)
    m.length += distance(p[path->count - 1], p[0]);
  double mm = m.length / SHEET_UNITS_PER_MM;
  double shortest = pens_shortest_crease_mm(c->pens, m.layer);
  m.near = pens_ink_reach_mm(c->pens, m.layer, edge->edge_class) *
           SHEET_UNITS_PER_MM;
  m.is_drawn = mm >= pens_shortest_line_mm(c->pens, m.layer) &&
               !path->is_weak && !(path->is_free && mm < shortest);
  m.is_hair = m.is_drawn && mm < shortest && !path->closed;
  return m;
}

/* Returns false when memory ran out. */
static bool measure_paths(struct covering *c) {
  size_t count = c->paths->path.count;
  struct sort_key *key = mem_alloc(count, sizeof *key);
  struct sort_key *scratch = mem_alloc(count, sizeof *scratch);
  bool ok = key != NULL && scratch != NULL;
  for (size_t i = 0; ok && i < count; i++) {
    struct measured_path *m = &c->measured[i];
    (void)poll_at(i);
    *m = measure_path(c, &c->paths->path.item[i]);
    c->hairs += m->is_hair;
    c->widest = fmax(c->widest, m->near);
    key[i] = (struct sort_key){UINT64_MAX - (uint64_t)m->length, (uint32_t)i};
  }
  if (ok && c->hairs > 0) {
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
  double i = (at - c->low[axis]) / c->cell;
  return !(i >= 0)                    ? 0
         : i < (double)c->count[axis] ? (int64_t)i
                                      : c->count[axis] - 1;
}

static int64_t cell_of_place(const struct covering *c, double x, double y) {
  return cell_along(c, 1, y) * c->count[0] + cell_along(c, 0, x);
}

/* The side that covered the piece of a hair before this one; NULL: none did. */
struct last_cover {
  const struct cover_side *side;
};

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
          (struct sort_key){(uint64_t)cell_of_place(c, p->x, p->y), i};
  }
  return c->hair != NULL && sort_keys_alone(c->hair, n);
}

/* What a piece of a hair, from at[0], at[1] to at[2], at[3], gives. */
typedef enum verdict piece_fn(const struct covering *c,
                              const struct measured_path *hair,
                              const double at[4], struct last_cover *last);

/* Calls do_piece for the pieces of a path, until one is NOT_COVERED; returns
 * that, or UNDECIDED where one is, or COVERED. */
static enum verdict for_all_pieces(const struct covering *c, uint32_t number,
                                   piece_fn *do_piece) {
  const struct ink_path *path = &c->paths->path.item[number];
  const struct measured_path *hair = &c->measured[number];
  enum verdict all = COVERED;
  struct last_cover last = {NULL};
  for (uint32_t i = 0; i + 1 < path->count; i++) {
    const struct ink_point *p = &c->paths->point.item[path->point + i];
    double pieces = ceil(distance(p[0], p[1]) / hair->near * 2);
    double dx = ((double)p[1].x - p[0].x) / pieces;
    double dy = ((double)p[1].y - p[0].y) / pieces;
    for (double k = 0; k < pieces; k++) {
      const double at[4] = {p->x + k * dx, p->y + k * dy, p->x + (k + 1) * dx,
                            p->y + (k + 1) * dy};
      enum verdict verdict = do_piece(c, hair, at, &last);
      if (verdict == NOT_COVERED)
        return verdict;
      if (verdict == UNDECIDED)
        all = verdict;
    }
  }
  return all;
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
      x[k] = cell_along(c, 0, p[i + (uint32_t)k].x);
      y[k] = cell_along(c, 1, p[i + (uint32_t)k].y);
    }
    int left = x[0] > x[1], low = y[0] > y[1];
    for (int64_t row = y[low]; row <= y[!low]; row++)
      memset(c->marked + row * c->count[0] + x[left], 1,
             (size_t)(x[!left] - x[left] + 1));
  }
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
  for (int64_t row = cell_along(c, 1, y0 - reach);
       row <= cell_along(c, 1, y1 + reach); row++) {
    /* The part of the side beside the row. */
    double low = c->low[1] + (double)row * c->cell - reach;
    double high = low + c->cell + 2 * reach, x[2] = {a.x, b.x};
    for (int k = 0; k < 2 && y1 > y0; k++) {
      double y = min_number(high, max_number(low, k ? b.y : a.y));
      x[k] = a.x + ((double)b.x - a.x) * (y - a.y) / ((double)b.y - a.y);
    }
    int64_t end = cell_along(c, 0, max_number(x[0], x[1]) + reach);
    for (int64_t i = cell_along(c, 0, min_number(x[0], x[1]) - reach); i <= end;
         i++) {
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
  for (size_t n = range.begin; n < range.end; n++) {
    uint32_t i = c->by_rank[c->paths->path.count - 1 - n];
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

/* ---- 4 Judge, 5 Decide --------------------------------------------------- */

/* The sides that are tried for a piece of a hair. */
struct cover_trial {
  const uint32_t *side, *end;
  int tried;
};

static struct cover_trial trial_at(const struct covering *c,
                                   const double at[4]) {
  int64_t cell = cell_of_place(c, (at[0] + at[2]) / 2, (at[1] + at[3]) / 2);
  return (struct cover_trial){c->sides.item + c->sides.start[cell],
                              c->sides.item + c->sides.start[cell + 1], 0};
}

/* The next side that is near the piece, of a path that is longer than the hair
 * and could take its place; NULL: there is none.
 * decided  hairs are as decided; else all are taken for drawn */
static const struct cover_side *next_cover(const struct covering *c,
                                           struct cover_trial *trial,
                                           const struct measured_path *hair,
                                           const double at[4], bool decided) {
  while (trial->side < trial->end && trial->tried < SIDES_TRIED_MAX) {
    const struct cover_side *side = &c->side.item[*trial->side++];
    if (side->rank >= hair->rank)
      trial->side = trial->end;
    else if (side->layer == hair->layer && side->weight >= hair->weight &&
             !(decided && side->is_hair &&
               !c->measured[c->by_rank[side->rank]].is_drawn)) {
      trial->tried++;
      if (cover_side_is_near(side, at, hair->near))
        return side;
    }
  }
  return NULL;
}

/* Does the side that covered the last piece cover this one?  It would be found
 * in this cell, too, as it is listed in all that it is near; only where so many
 * are that not all are tried it might not. */
static bool covers_again(const struct last_cover *last,
                         const struct cover_trial *trial,
                         const struct measured_path *hair, const double at[4]) {
  return last->side != NULL && trial->end - trial->side <= SIDES_TRIED_MAX &&
         cover_side_is_near(last->side, at, hair->near);
}

/* Of a piece, as if all hairs were drawn.  A path that is none is drawn in any
 * case, and would be tried at this place or before. */
static enum verdict judge_piece(const struct covering *c,
                                const struct measured_path *hair,
                                const double at[4], struct last_cover *last) {
  struct cover_trial trial = trial_at(c, at);
  const struct cover_side *side;
  bool found = false;
  if (covers_again(last, &trial, hair, at))
    return COVERED;
  while ((side = next_cover(c, &trial, hair, at, false)) != NULL) {
    if (!side->is_hair) {
      last->side = side;
      return COVERED;
    }
    found = true;
  }
  return found || trial.tried == SIDES_TRIED_MAX ? UNDECIDED : NOT_COVERED;
}

static enum verdict decide_piece(const struct covering *c,
                                 const struct measured_path *hair,
                                 const double at[4], struct last_cover *last) {
  struct cover_trial trial = trial_at(c, at);
  if (covers_again(last, &trial, hair, at))
    return COVERED;
  last->side = next_cover(c, &trial, hair, at, true);
  return last->side != NULL ? COVERED : NOT_COVERED;
}

static bool judge_range(void *user, struct parallel_range range) {
  const struct covering *c = user;
  for (size_t i = range.begin; i < range.end; i++) {
    uint32_t path = c->hair[i].value;
    c->verdict[path] = (uint8_t)for_all_pieces(c, path, judge_piece);
  }
  return true;
}

/* Returns false when the caller cancelled. */
static bool decide(struct covering *c) {
  size_t count = c->paths->path.count;
  if (!parallel_ranges(parallel_workers(c->hairs, PATHS_IN_RANGE), c->hairs,
                       PATHS_IN_RANGE, judge_range, c))
    return false;
  for (size_t r = 0; r < count; r++) {
    uint32_t i = c->by_rank[r];
    enum verdict verdict = c->verdict[i];
    (void)poll_at(r);
    if (verdict == UNDECIDED)
      verdict = for_all_pieces(c, i, decide_piece);
    c->paths->path.item[i].is_covered = verdict == COVERED;
    c->measured[i].is_drawn &= verdict != COVERED;
  }
  return true;
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
    ok = make_cells(&c) && list_hairs(&c);
    for (size_t i = 0; ok && i < c.hairs; i++)
      mark_hair(&c, c.hair[i].value);
    ok = ok && list_sides(&c) && decide(&c);
  }
  mem_free(c.measured);
  mem_free(c.by_rank);
  mem_free(c.verdict);
  mem_free(c.hair);
  mem_free(c.marked);
  ARRAY_FREE(&c.side);
  number_lists_fini(&c.sides);
  return ok;
}
