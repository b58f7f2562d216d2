/* deferred_triangles.c - solves the triangles that the tiles defer.
 *
 * Claim.  A triangle T that no contour crosses, and whose plane no triangle
 * over or under it intersects or touches, is entirely visible or entirely
 * hidden.
 *
 * Proof.  Take a point inside T that a nearer triangle occludes, and a path
 * from there to any other point inside that passes through no vertex.
 * Occlusion can end only where the path crosses a side of a nearer triangle.
 * If that side is no contour, the triangle beyond it continues at the same
 * depth, so it overlaps T too.  Every triangle that overlaps T is strictly in
 * front of its plane or strictly behind it; hence that triangle is nearer as
 * well, and occlusion continues.
 *
 * Tiles in which T is visible are not listed, neither their triangles nor their
 * contours: nothing there is in front of T or in contact with it, and a tile
 * that a contour crosses before or at T is mixed.
 *
 * Hidden triangles.  They are not tested as occluders.  Where one of them
 * occludes T, so does the nearest triangle there, which is not hidden and
 * overlaps T.
 */
#include "visibility/pairwise/deferred_triangles.h"

#include <string.h>

#include "base/parallel.h"
#include "base/sort.h"
#include "visibility/pairwise/overlap_query.h"
#include "visibility/predicate/surrounder.h"

/* ---- Contours by tile ---------------------------------------------------- */

/* Puts the contours into the lists of the wanted tiles. */
static void list_tile_contours(struct deferred_triangles *d,
                               const uint8_t *wanted) {
  const struct sheet *sheet = d->sheet;
  const struct triangle_grid *grid = &d->lists->tiles->grid;
  for (size_t i = sheet->contour.count; i-- > 0;) {
    struct geom_segment s = sheet_ends(sheet, sheet->contour.item[i].point);
    struct cell_range r = triangle_grid_cells(grid, box2_of_segment(s.p, s.q));
    for (int y = r.y0; y <= r.y1; y++) {
      int x0, x1;
      triangle_grid_row(grid, s.p, s.q, r, y, &x0, &x1);
      for (int x = x0; x <= x1; x++) {
        size_t cell = triangle_grid_index(grid, x, y);
        if (wanted[cell])
          number_lists_put(&d->contours, cell, (uint32_t)i);
      }
    }
  }
}

bool deferred_triangles_init(struct deferred_triangles *d,
                             const struct sheet *sheet,
                             const struct tile_candidates *lists,
                             const uint8_t *wanted, uint8_t *state) {
  size_t cells = triangle_grid_cell_count(&lists->tiles->grid);
  memset(d, 0, sizeof *d);
  d->sheet = sheet;
  d->lists = lists;
  d->state = state;
  if (!number_lists_init(&d->contours, cells))
    return false;
  list_tile_contours(d, wanted);
  if (!number_lists_allocate(&d->contours, cells))
    return false;
  list_tile_contours(d, wanted);
  return true;
}

void deferred_triangles_fini(struct deferred_triangles *d) {
  number_lists_fini(&d->contours);
}

/* ---- The order ----------------------------------------------------------- */

/* The tile of the lower left corner of a triangle's box. */
static uint32_t first_tile(const struct deferred_triangles *d,
                           uint32_t triangle) {
  const struct triangle_grid *grid = &d->lists->tiles->grid;
  struct cell_range r =
      triangle_grid_cells(grid, box2_of_triangle(d->sheet, triangle));
  return (uint32_t)r.y0 * (uint32_t)grid->columns + (uint32_t)r.x0;
}

/* How many depth buckets nearer than a triangle's there are. */
static uint32_t count_nearer_buckets(const struct deferred_triangles *d,
                                     uint32_t triangle) {
  return (uint32_t)(TILE_BUCKETS - 1 -
                    tile_bucket(sheet_nearest_z(d->sheet, triangle)));
}

/* Sorts by depth bucket, and within a bucket by tile: triangles that follow one
 * another have occluders in common, which are still in the cache then. */
static bool sort_near_to_far(const struct deferred_triangles *d,
                             uint32_t *triangle, size_t count) {
  uint64_t tiles = triangle_grid_cell_count(&d->lists->tiles->grid);
  struct sort_key *key = mem_alloc(count, 2 * sizeof *key);
  if (key == NULL)
    return false;
  for (size_t i = 0; i < count; i++)
    key[i] = (struct sort_key){count_nearer_buckets(d, triangle[i]) * tiles +
                                   first_tile(d, triangle[i]),
                               triangle[i]};
  sort_keys(key, key + count, count);
  for (size_t i = 0; i < count; i++)
    triangle[i] = key[i].value;
  mem_free(key);
  return true;
}

/* ---- The solver of a thread ---------------------------------------------- */

/* Ranges are solved in rounds.  A triangle found to be hidden is marked by its
 * range, which alone knows of it until the round ends: so the candidates that
 * are tested, and the counts, do not depend on the threads. */
enum {
  TRIANGLES_IN_RANGE = PARALLEL_RANGE(128),
  RANGES_IN_ROUND = 32,
  TRIANGLES_IN_ROUND = TRIANGLES_IN_RANGE * RANGES_IN_ROUND,
  HIDDEN_BY_RANGE = MAP_MIXED + 1 /* and its number in the round */
};

struct triangle_solver {
  struct deferred_triangles *d;
  struct overlap_query query; /* of the current triangle */
  struct occluder_subtraction subtraction;
  struct deferred_triangles_counts counts;
  struct progress progress;
  struct fragments part;
  uint8_t mark; /* of what this range found to be hidden */
  char apart[PARALLEL_APART];
};

static bool is_hidden(const struct triangle_solver *solver, uint32_t triangle) {
  uint8_t state =
      __atomic_load_n(&solver->d->state[triangle], __ATOMIC_RELAXED);
  return state == MAP_HIDDEN || state == solver->mark;
}

/* Returns whether a contour that is not behind the current triangle may cross
 * it. */
static bool is_crossed(const struct triangle_solver *solver) {
  const struct sheet *sheet = solver->d->sheet;
  const struct triangle_grid *grid = &solver->d->lists->tiles->grid;
  const struct occluder_subtraction *subtraction = &solver->subtraction;
  struct cell_range r = triangle_grid_cells(grid, subtraction->box);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t cell = triangle_grid_index(grid, x, y);
      for (uint32_t i = solver->d->contours.start[cell];
           i < solver->d->contours.start[cell + 1]; i++) {
        struct geom_segment s = sheet_ends(
            sheet, sheet->contour.item[solver->d->contours.item[i]].point);
        if ((s.p.z >= subtraction->low || s.q.z >= subtraction->low) &&
            triangle_may_meet_segment(subtraction->plane.p, s.p, s.q))
          return true;
      }
    }
  return false;
}

/* ---- Solving ------------------------------------------------------------- */

/* Tests the candidates as occluders, but for those known to be hidden, until
 * one hides the current triangle completely, or one and the one before it. */
static bool test_candidates(struct triangle_solver *solver) {
  struct occluder_subtraction *subtraction = &solver->subtraction;
  enum { AHEAD = 4 }; /* lists are short */
  const uint32_t *candidate = solver->query.found.found.item;
  size_t count = solver->query.found.found.count;
  if (!progress_step(subtraction->progress, count))
    return false;
  for (size_t i = 0; i < count && !subtraction->covered; i++) {
    if (i + AHEAD < count)
      sheet_prefetch_corners(subtraction->sheet, candidate[i + AHEAD]);
    if (!is_hidden(solver, candidate[i]) &&
        !occluder_subtraction_collect(subtraction, candidate[i]))
      return false;
  }
  return true;
}

static bool mark_hidden(struct triangle_solver *solver, uint32_t triangle) {
  __atomic_store_n(&solver->d->state[triangle], solver->mark, __ATOMIC_RELAXED);
  solver->counts.hidden++;
  return true;
}

/* Adds what is visible of a triangle: all of it, or the pieces left.  What is
 * behind it may be in contact with it. */
static bool add_visible(struct triangle_solver *solver, uint32_t triangle) {
  const struct occluder_subtraction *subtraction = &solver->subtraction;
  if (solver->part.contact && !overlap_query_add_behind(&solver->query))
    return false;
  const uint32_t *candidate = solver->query.found.found.item;
  size_t count = solver->query.found.found.count;
  if (subtraction->whole) {
    solver->counts.whole++;
    return fragments_add_with_candidates(&solver->part, triangle, NULL, 0,
                                         candidate, count);
  }
  solver->counts.mixed++;
  return fragments_add_with_candidates(
      &solver->part, triangle, subtraction->left.item, subtraction->left.count,
      candidate, count);
}

/* Solves a triangle, and adds its visible pieces to the solver's part. */
static bool solve_triangle(struct triangle_solver *solver, uint32_t triangle) {
  struct occluder_subtraction *subtraction = &solver->subtraction;
  occluder_subtraction_begin(subtraction, triangle);
  if (!overlap_query_find_nearer(&solver->query, triangle) ||
      !test_candidates(solver))
    return false;
  if (subtraction->covered)
    return mark_hidden(solver, triangle);
  if (subtraction->occluder.count > 0) {
    if (!subtraction->interpenetrating && !is_crossed(solver)) {
      solver->counts.uncrossed++;
      return mark_hidden(solver, triangle);
    }
    if (!occluder_subtraction_take(subtraction, NULL) ||
        !occluder_subtraction_subtract_all(subtraction))
      return false;
    if (subtraction->left.count == 0)
      return mark_hidden(solver, triangle);
  }
  return add_visible(solver, triangle);
}

/* ---- Rounds -------------------------------------------------------------- */

/* The pieces of a range: those from `begin` to before `end` of a solver's
 * part. */
struct range_pieces {
  int solver;
  size_t begin, end;
};

struct triangle_rounds {
  struct triangle_solver *solver; /* one a worker */
  const uint32_t *triangle;       /* of this round */
  size_t done, all;               /* before this round, and in all */
  struct range_pieces pieces[RANGES_IN_ROUND];
};

static bool solve_range(void *user, struct parallel_range range) {
  struct triangle_rounds *rounds = user;
  struct triangle_solver *solver = &rounds->solver[range.worker];
  size_t number = range.begin / TRIANGLES_IN_RANGE;
  struct range_pieces *pieces = &rounds->pieces[number];
  solver->mark = (uint8_t)(HIDDEN_BY_RANGE + number);
  pieces->solver = range.worker;
  pieces->begin = solver->part.piece.count;
  for (size_t i = range.begin; i < range.end; i++)
    if (!progress_step_at(&solver->progress, 1, rounds->done + i,
                          rounds->all) ||
        !solve_triangle(solver, rounds->triangle[i]))
      return false;
  pieces->end = solver->part.piece.count;
  return true;
}

/* Solves the triangles of a round, and appends their pieces in the order of the
 * ranges. */
static bool solve_round(struct deferred_triangles *d,
                        struct triangle_rounds *rounds, int workers,
                        size_t count, struct fragments *fragments) {
  bool ok =
      parallel_ranges(workers, count, TRIANGLES_IN_RANGE, solve_range, rounds);
  for (size_t i = 0; i < count; i++)
    if (d->state[rounds->triangle[i]] >= HIDDEN_BY_RANGE)
      d->state[rounds->triangle[i]] = MAP_HIDDEN;
  for (size_t r = 0; ok && r < parallel_range_count(count, TRIANGLES_IN_RANGE);
       r++) {
    const struct range_pieces *pieces = &rounds->pieces[r];
    ok = fragments_append(fragments, &rounds->solver[pieces->solver].part,
                          pieces->begin, pieces->end);
  }
  return ok;
}

static bool init_solver(struct triangle_solver *solver,
                        struct deferred_triangles *d,
                        const struct fragments *fragments,
                        const struct progress *progress) {
  solver->d = d;
  solver->progress = *progress;
  fragments_init_part(&solver->part, fragments);
  occluder_subtraction_init(&solver->subtraction, d->sheet);
  solver->subtraction.progress = &solver->progress;
  return overlap_query_init(&solver->query, d->sheet, d->lists);
}

/* Adds what a solver counted, and ends it. */
static void end_solver(struct triangle_solver *solver,
                       struct fragments *fragments) {
  struct deferred_triangles_counts *sum = &solver->d->counts;
  sum->hidden += solver->counts.hidden;
  sum->whole += solver->counts.whole;
  sum->mixed += solver->counts.mixed;
  sum->uncrossed += solver->counts.uncrossed;
  occluder_subtraction_counts_add(&sum->subtraction,
                                  &solver->subtraction.counts);
  fragments_adopt(fragments, &solver->part);
  fragments_fini(&solver->part);
  overlap_query_fini(&solver->query);
  occluder_subtraction_fini(&solver->subtraction);
}

bool deferred_triangles_solve(struct deferred_triangles *d, uint32_t *triangle,
                              size_t count, struct fragments *fragments,
                              const struct progress *progress) {
  int workers = parallel_workers(count, TRIANGLES_IN_RANGE), made = 0;
  struct triangle_rounds rounds = {
      .solver = mem_calloc((size_t)workers, sizeof *rounds.solver),
      .all = count};
  bool ok = rounds.solver != NULL && sort_near_to_far(d, triangle, count);
  while (ok && made < workers)
    ok = init_solver(&rounds.solver[made++], d, fragments, progress);
  for (; ok && rounds.done < count; rounds.done += TRIANGLES_IN_ROUND) {
    size_t left = count - rounds.done;
    rounds.triangle = triangle + rounds.done;
    ok = solve_round(d, &rounds, workers,
                     left < TRIANGLES_IN_ROUND ? left : TRIANGLES_IN_ROUND,
                     fragments);
  }
  while (made > 0)
    end_solver(&rounds.solver[--made], fragments);
  mem_free(rounds.solver);
  return ok;
}

void deferred_triangles_report(const struct deferred_triangles *d,
                               struct report *report) {
  const struct deferred_triangles_counts *counts = &d->counts;
  report_count(report, "faces", "hidden", counts->hidden);
  report_count(report, "faces", "hidden_by_contours", counts->uncrossed);
  report_count(report, "faces", "whole", counts->whole);
  report_count(report, "faces", "mixed", counts->mixed);
  occluder_subtraction_report(&counts->subtraction, report);
}
