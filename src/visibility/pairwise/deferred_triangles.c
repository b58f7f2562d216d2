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
static void visit_contours(struct deferred_triangles *d, const uint8_t *wanted,
                           bool filling) {
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
        if (!wanted[cell])
          continue;
        if (filling)
          d->contour[--d->start[cell]] = (uint32_t)i;
        else
          d->start[cell]++;
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
  occluder_subtraction_init(&d->subtraction, sheet);
  d->start = mem_calloc(cells + 1, sizeof *d->start);
  if (d->start == NULL || !triangle_grid_query_init(&d->query, &lists->grid))
    return false;
  visit_contours(d, wanted, false);
  for (size_t i = 0; i < cells; i++)
    d->start[i + 1] += d->start[i];
  d->contour = mem_alloc(d->start[cells], sizeof *d->contour);
  if (d->contour == NULL)
    return false;
  visit_contours(d, wanted, true);
  return true;
}

void deferred_triangles_fini(struct deferred_triangles *d) {
  mem_free(d->start);
  mem_free(d->contour);
  triangle_grid_query_fini(&d->query);
  occluder_subtraction_fini(&d->subtraction);
}

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
bool deferred_triangles_sort(const struct deferred_triangles *d,
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
static bool is_crossed(const struct deferred_triangles *d) {
  const struct sheet *sheet = d->sheet;
  const struct triangle_grid *grid = &d->lists->tiles->grid;
  const struct occluder_subtraction *subtraction = &d->subtraction;
  struct cell_range r = triangle_grid_cells(grid, subtraction->box);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t cell = triangle_grid_index(grid, x, y);
      for (uint32_t i = d->start[cell]; i < d->start[cell + 1]; i++) {
        struct geom_segment s =
            sheet_ends(sheet, sheet->contour.item[d->contour[i]].point);
        if ((s.p.z >= subtraction->low || s.q.z >= subtraction->low) &&
            may_intersect_segment(subtraction->plane.p, s.p, s.q))
          return true;
      }
    }
  return false;
}

/* ---- Candidates ---------------------------------------------------------- */

/* Adds triangle g to the candidates unless it was added before.  A hidden
 * triangle is no occluder and is added only if it is earlier than the current
 * one: visible pieces may be passed on to it if the two are in contact. */
static bool add_candidate(struct deferred_triangles *d, uint32_t g) {
  return g == d->subtraction.triangle ||
         (g > d->subtraction.triangle && d->state[g] == MAP_HIDDEN) ||
         sheet_is_edge_on(d->sheet, g) ||
         !triangle_grid_query_first(&d->query, g) ||
         ARRAY_PUSH(&d->query.found, g);
}

static bool find_in_bsp(struct deferred_triangles *d, uint32_t root) {
  const struct bsp *bsp = d->lists->grid.bsp;
  const struct bsp_query shape = {.kind = BSP_TRIANGLE,
                                  .triangle = d->subtraction.triangle,
                                  .sheet = d->sheet,
                                  .box = d->subtraction.box};
  struct bsp_traversal traversal = bsp_traversal_from(root);
  const struct bsp_node *node;
  while ((node = bsp_next(bsp, &traversal, &shape)) != NULL)
    for (uint32_t i = node->from; i < node->from + node->count; i++)
      if (!add_candidate(d, bsp->member.item[i].triangle))
        return false;
  return true;
}

/* Finds the triangles that may overlap the current one on the page, at any
 * depth, since a triangle behind it may be in contact with it. */
static bool find_near_triangles(struct deferred_triangles *d) {
  const struct tile_candidates *lists = d->lists;
  const struct triangle_grid *grid = &lists->grid;
  const struct occluder_subtraction *subtraction = &d->subtraction;
  struct cell_range r = triangle_grid_cells(grid, subtraction->box);
  struct kdop8 kdop = kdop8_of_point(subtraction->plane.p[0]);
  kdop8_add(&kdop, subtraction->plane.p[1]);
  kdop8_add(&kdop, subtraction->plane.p[2]);
  triangle_grid_query_start(grid, &d->query);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t cell = triangle_grid_index(grid, x, y);
      uint32_t i = grid->start[cell], end = grid->start[cell + 1];
      if (i == end)
        continue;
      if (triangle_grid_bsp(grid, cell) != SHEET_NONE) {
        if (!find_in_bsp(d, triangle_grid_bsp(grid, cell)))
          return false;
        continue;
      }
      struct kdop8_range range = tile_candidates_range(lists, x, y);
      kdop.low = range.z0;
      uint64_t kdop_query = kdop8_query(&range, &kdop);
      for (; i < end; i++)
        if (kdop8_overlaps(lists->key[i], kdop_query) &&
            !add_candidate(d, grid->item[i]))
          return false;
    }
  return true;
}

/* ---- Solving ------------------------------------------------------------- */

/* Tests the candidates as occluders, until one hides the current triangle
 * completely. */
static bool test_candidates(struct deferred_triangles *d) {
  struct occluder_subtraction *subtraction = &d->subtraction;
  const uint32_t *candidate = d->query.found.item;
  if (!progress_step(subtraction->progress, d->query.found.count))
    return false;
  for (size_t i = 0; i < d->query.found.count && !subtraction->covered; i++)
    if (d->state[candidate[i]] != MAP_HIDDEN &&
        !occluder_subtraction_collect(subtraction, candidate[i]))
      return false;
  return true;
}

static bool mark_hidden(struct deferred_triangles *d, uint32_t triangle) {
  d->state[triangle] = MAP_HIDDEN;
  d->counts.hidden++;
  return true;
}

bool deferred_triangles_solve(struct deferred_triangles *d, uint32_t triangle,
                              struct fragments *fragments) {
  struct occluder_subtraction *subtraction = &d->subtraction;
  struct deferred_triangles_counts *counts = &d->counts;
  if (!occluder_subtraction_start(subtraction, triangle, NULL) ||
      !find_near_triangles(d) || !test_candidates(d))
    return false;
  const uint32_t *candidate = d->query.found.item;
  size_t count = d->query.found.count;
  if (subtraction->covered)
    return mark_hidden(d, triangle);
  if (subtraction->occluder.count > 0) {
    if (!subtraction->interpenetrating && !is_crossed(d)) {
      counts->uncrossed++;
      return mark_hidden(d, triangle);
    }
    if (!occluder_subtraction_subtract_all(subtraction))
      return false;
    if (subtraction->left.count == 0)
      return mark_hidden(d, triangle);
    if (!subtraction->whole) {
      counts->mixed++;
      return fragments_add_with_candidates(
          fragments, triangle, subtraction->left.item, subtraction->left.count,
          candidate, count);
    }
  }
  counts->whole++;
  return fragments_add_with_candidates(fragments, triangle, NULL, 0, candidate,
                                       count);
}

void deferred_triangles_report(const struct deferred_triangles *d,
                               struct report *report) {
  const struct deferred_triangles_counts *counts = &d->counts;
  report_count(report, "faces", "hidden", counts->hidden);
  report_count(report, "faces", "hidden_by_contours", counts->uncrossed);
  report_count(report, "faces", "whole", counts->whole);
  report_count(report, "faces", "mixed", counts->mixed);
  occluder_subtraction_report(&d->subtraction, report);
}
