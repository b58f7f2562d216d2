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
 * Hidden triangles.  They are not tested as occluders.  Where one of them
 * occludes T, so does the nearest triangle there, which is not hidden and
 * overlaps T.
 */
#include "visibility/pairwise/deferred_triangles.h"

#include <string.h>

#include "base/sort.h"
#include "visibility/index/bsp.h"
#include "visibility/predicate/surrounder.h"

/* ---- Contours by tile ---------------------------------------------------- */

/* Counts the contours of each wanted tile or, if `filling`, lists them. */
static void visit_contours(struct deferred_triangles *deferred_triangles,
                           const uint8_t *wanted, bool filling) {
  const struct sheet *sheet = deferred_triangles->sheet;
  const struct triangle_grid *grid = &deferred_triangles->lists->tiles->grid;
  for (size_t i = sheet->contour.count; i-- > 0;) {
    const uint32_t *point = sheet->contour.item[i].point;
    struct geom_point p = sheet->point.item[point[0]],
                      q = sheet->point.item[point[1]];
    struct cell_range r = triangle_grid_cells(grid, box2_of_segment(p, q));
    for (int y = r.y0; y <= r.y1; y++) {
      int x0, x1;
      triangle_grid_row(grid, p, q, r, y, &x0, &x1);
      for (int x = x0; x <= x1; x++) {
        size_t cell = (size_t)y * (size_t)grid->columns + (size_t)x;
        if (!wanted[cell])
          continue;
        if (filling)
          deferred_triangles->contour[--deferred_triangles->start[cell]] =
              (uint32_t)i;
        else
          deferred_triangles->start[cell]++;
      }
    }
  }
}

bool deferred_triangles_init(struct deferred_triangles *deferred_triangles,
                             const struct sheet *sheet,
                             const struct tile_candidates *lists,
                             const uint8_t *wanted, uint8_t *state) {
  size_t cells = triangle_grid_cell_count(&lists->tiles->grid);
  memset(deferred_triangles, 0, sizeof *deferred_triangles);
  deferred_triangles->sheet = sheet;
  deferred_triangles->lists = lists;
  deferred_triangles->state = state;
  occluder_subtraction_init(&deferred_triangles->subtraction, sheet);
  deferred_triangles->start =
      mem_calloc(cells + 1, sizeof *deferred_triangles->start);
  if (deferred_triangles->start == NULL ||
      !triangle_grid_query_init(&deferred_triangles->query, &lists->grid))
    return false;
  visit_contours(deferred_triangles, wanted, false);
  for (size_t i = 0; i < cells; i++)
    deferred_triangles->start[i + 1] += deferred_triangles->start[i];
  deferred_triangles->contour = mem_alloc(deferred_triangles->start[cells],
                                          sizeof *deferred_triangles->contour);
  if (deferred_triangles->contour == NULL)
    return false;
  visit_contours(deferred_triangles, wanted, true);
  return true;
}

void deferred_triangles_fini(struct deferred_triangles *deferred_triangles) {
  mem_free(deferred_triangles->start);
  mem_free(deferred_triangles->contour);
  triangle_grid_query_fini(&deferred_triangles->query);
  occluder_subtraction_fini(&deferred_triangles->subtraction);
}

/* The tile of the lower left corner of a triangle's box. */
static uint32_t first_tile(const struct deferred_triangles *deferred_triangles,
                           uint32_t triangle) {
  const struct triangle_grid *grid = &deferred_triangles->lists->tiles->grid;
  struct cell_range r = triangle_grid_cells(
      grid, box2_of_triangle(deferred_triangles->sheet, triangle));
  return (uint32_t)r.y0 * (uint32_t)grid->columns + (uint32_t)r.x0;
}

/* How many depth buckets nearer than a triangle's there are. */
static uint32_t
count_nearer_buckets(const struct deferred_triangles *deferred_triangles,
                     uint32_t triangle) {
  return (uint32_t)(TILE_BUCKETS - 1 -
                    tile_bucket(
                        sheet_nearest_z(deferred_triangles->sheet, triangle)));
}

/* Sorts by depth bucket, and within a bucket by tile: triangles that follow one
 * another have occluders in common, which are still in the cache then. */
bool deferred_triangles_sort(
    const struct deferred_triangles *deferred_triangles, uint32_t *triangle,
    size_t count) {
  uint64_t tiles =
      triangle_grid_cell_count(&deferred_triangles->lists->tiles->grid);
  struct sort_key *key = mem_alloc(count, 2 * sizeof *key);
  if (key == NULL)
    return false;
  for (size_t i = 0; i < count; i++)
    key[i] = (struct sort_key){
        count_nearer_buckets(deferred_triangles, triangle[i]) * tiles +
            first_tile(deferred_triangles, triangle[i]),
        triangle[i]};
  sort_keys(key, key + count, count);
  for (size_t i = 0; i < count; i++)
    triangle[i] = key[i].value;
  mem_free(key);
  return true;
}

/* Returns false only if segment pq has no point inside triangle f: a
 * conservative test. */
static bool may_intersect_segment(const struct geom_point f[3],
                                  struct geom_point p, struct geom_point q) {
  int64_t a = geom_orient2d(p, q, f[0]), b = geom_orient2d(p, q, f[1]),
          c = geom_orient2d(p, q, f[2]);
  if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0))
    return false;
  for (int k = 0; k < 3; k++) {
    struct geom_point from = f[k], to = f[geom_next_corner(k)];
    if (geom_orient2d(from, to, p) <= 0 && geom_orient2d(from, to, q) <= 0)
      return false;
  }
  return true;
}

/* Returns whether a contour that is not behind the current triangle may cross
 * it. */
static bool is_crossed(const struct deferred_triangles *deferred_triangles) {
  const struct sheet *sheet = deferred_triangles->sheet;
  const struct triangle_grid *grid = &deferred_triangles->lists->tiles->grid;
  const struct occluder_subtraction *subtraction =
      &deferred_triangles->subtraction;
  struct cell_range r = triangle_grid_cells(grid, subtraction->box);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t cell = (size_t)y * (size_t)grid->columns + (size_t)x;
      for (uint32_t i = deferred_triangles->start[cell];
           i < deferred_triangles->start[cell + 1]; i++) {
        const uint32_t *point =
            sheet->contour.item[deferred_triangles->contour[i]].point;
        struct geom_point p = sheet->point.item[point[0]],
                          q = sheet->point.item[point[1]];
        if ((p.z >= subtraction->low || q.z >= subtraction->low) &&
            may_intersect_segment(subtraction->plane.p, p, q))
          return true;
      }
    }
  return false;
}

/* ---- Candidates ---------------------------------------------------------- */

/* Adds triangle g to the candidates unless it was added before.  A hidden
 * triangle is no occluder and is added only if it is earlier than the current
 * one: visible pieces may be passed on to it if the two are in contact. */
static bool add_candidate(struct deferred_triangles *deferred_triangles,
                          uint32_t g) {
  return g == deferred_triangles->subtraction.triangle ||
         (g > deferred_triangles->subtraction.triangle &&
          deferred_triangles->state[g] == MAP_HIDDEN) ||
         (deferred_triangles->sheet->triangle_flags[g] & SHEET_FLAT) ||
         !triangle_grid_query_first(&deferred_triangles->query, g) ||
         ARRAY_PUSH(&deferred_triangles->query.found, g);
}

static bool find_in_bsp(struct deferred_triangles *deferred_triangles,
                        uint32_t root) {
  const struct bsp *bsp = deferred_triangles->lists->grid.bsp;
  const struct bsp_query shape = {.kind = BSP_TRIANGLE,
                                  .triangle =
                                      deferred_triangles->subtraction.triangle,
                                  .sheet = deferred_triangles->sheet,
                                  .box = deferred_triangles->subtraction.box};
  struct bsp_traversal traversal = bsp_traversal_from(root);
  const struct bsp_node *node;
  while ((node = bsp_next(bsp, &traversal, &shape)) != NULL)
    for (uint32_t i = node->from; i < node->from + node->count; i++)
      if (!add_candidate(deferred_triangles, bsp->member.item[i].triangle))
        return false;
  return true;
}

/* Finds the triangles that may overlap the current one on the page, at any
 * depth, since a triangle behind it may be in contact with it. */
static bool find_near_triangles(struct deferred_triangles *deferred_triangles) {
  const struct tile_candidates *lists = deferred_triangles->lists;
  const struct triangle_grid *grid = &lists->grid;
  const struct occluder_subtraction *subtraction =
      &deferred_triangles->subtraction;
  struct cell_range r = triangle_grid_cells(grid, subtraction->box);
  struct kdop8 kdop = kdop8_of_point(subtraction->plane.p[0]);
  kdop8_add(&kdop, subtraction->plane.p[1]);
  kdop8_add(&kdop, subtraction->plane.p[2]);
  triangle_grid_query_start(grid, &deferred_triangles->query);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t cell = (size_t)y * (size_t)grid->columns + (size_t)x;
      uint32_t i = grid->start[cell], end = grid->start[cell + 1];
      if (i == end)
        continue;
      if (triangle_grid_bsp(grid, cell) != SHEET_NONE) {
        if (!find_in_bsp(deferred_triangles, triangle_grid_bsp(grid, cell)))
          return false;
        continue;
      }
      struct kdop8_range range = tile_candidates_range(lists, x, y);
      kdop.low = range.z0;
      uint64_t kdop_query = kdop8_query(&range, &kdop);
      for (; i < end; i++)
        if (kdop8_overlaps(lists->key[i], kdop_query) &&
            !add_candidate(deferred_triangles, grid->item[i]))
          return false;
    }
  return true;
}

/* ---- Solving ------------------------------------------------------------- */

/* Tests the candidates as occluders, until one hides the current triangle
 * completely. */
static bool test_candidates(struct deferred_triangles *deferred_triangles) {
  struct occluder_subtraction *subtraction = &deferred_triangles->subtraction;
  const uint32_t *candidate = deferred_triangles->query.found.item;
  if (!progress_step(subtraction->progress,
                     deferred_triangles->query.found.count))
    return false;
  for (size_t i = 0;
       i < deferred_triangles->query.found.count && !subtraction->covered; i++)
    if (deferred_triangles->state[candidate[i]] != MAP_HIDDEN &&
        !occluder_subtraction_collect(subtraction, candidate[i]))
      return false;
  return true;
}

static bool mark_hidden(struct deferred_triangles *deferred_triangles,
                        uint32_t triangle) {
  deferred_triangles->state[triangle] = MAP_HIDDEN;
  deferred_triangles->counts.hidden++;
  return true;
}

bool deferred_triangles_solve(struct deferred_triangles *deferred_triangles,
                              uint32_t triangle, struct fragments *fragments) {
  struct occluder_subtraction *subtraction = &deferred_triangles->subtraction;
  struct deferred_triangles_counts *counts = &deferred_triangles->counts;
  if (!occluder_subtraction_start(subtraction, triangle, NULL) ||
      !find_near_triangles(deferred_triangles) ||
      !test_candidates(deferred_triangles))
    return false;
  const uint32_t *candidate = deferred_triangles->query.found.item;
  size_t count = deferred_triangles->query.found.count;
  if (subtraction->covered)
    return mark_hidden(deferred_triangles, triangle);
  if (subtraction->occluder.count == 0) {
    counts->whole++;
    return fragments_add_with_candidates(fragments, triangle, NULL, 0,
                                         candidate, count);
  }
  if (!subtraction->interpenetrating && !is_crossed(deferred_triangles)) {
    counts->uncrossed++;
    return mark_hidden(deferred_triangles, triangle);
  }
  if (!occluder_subtraction_subtract_all(subtraction))
    return false;
  if (subtraction->left.count == 0)
    return mark_hidden(deferred_triangles, triangle);
  if (subtraction->whole) {
    counts->whole++;
    return fragments_add_with_candidates(fragments, triangle, NULL, 0,
                                         candidate, count);
  }
  counts->mixed++;
  return fragments_add_with_candidates(
      fragments, triangle, subtraction->left.item, subtraction->left.count,
      candidate, count);
}

void deferred_triangles_report(
    const struct deferred_triangles *deferred_triangles,
    struct report *report) {
  const struct deferred_triangles_counts *counts = &deferred_triangles->counts;
  report_int(report, "faces", "hidden", (int64_t)counts->hidden);
  report_int(report, "faces", "hidden_by_contours", (int64_t)counts->uncrossed);
  report_int(report, "faces", "whole", (int64_t)counts->whole);
  report_int(report, "faces", "mixed", (int64_t)counts->mixed);
  occluder_subtraction_report(&deferred_triangles->subtraction, report);
}
