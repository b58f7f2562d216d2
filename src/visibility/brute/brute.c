/* brute.c - the brute-force solver, the oracle of the tests: every edge against
 * every triangle, every triangle against every other.
 *
 * Short, obvious, and kept so: the other exact solvers are compared with it.
 *
 * Source  [Appel1967] decides visibility edge by edge as well.
 */
#include "visibility/fragments/occluder_subtraction.h"
#include "visibility/intersection/intersection.h"
#include "visibility/predicate/edge_intervals.h"
#include "visibility/progress.h"
#include "visibility/solver.h"

static bool is_flat(const struct sheet *sheet, size_t triangle) {
  return sheet->triangle_flags[triangle] & SHEET_FLAT;
}

static bool solve_strokes(const struct sheet *sheet, struct map *map,
                          struct occlusion_counts *counts,
                          struct progress *progress) {
  size_t n = sheet->triangle.count;
  struct occluder *occluder = mem_alloc(n, sizeof *occluder);
  struct edge_intervals intervals = {0};
  bool ok = false;
  if (occluder == NULL || !edge_intervals_open_map(map, sheet->edge.count))
    goto end;
  for (size_t t = 0; t < n; t++)
    occluder_init(&occluder[t], sheet, (uint32_t)t);
  for (size_t e = 0; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    struct geom_segment s = sheet_ends(sheet, edge->point);
    if (!sheet_edge_is_drawn(sheet, e))
      continue;
    if (!progress_step_at(progress, n, e, sheet->edge.count))
      goto end;
    edge_intervals_start(&intervals);
    for (size_t t = 0; t < n; t++) {
      struct occluded_interval interval;
      bool own = t == edge->triangle[0] || t == edge->triangle[1];
      if (!own && !is_flat(sheet, t) &&
          occlude_edge(&occluder[t], s.p, s.q, &interval, counts) &&
          !edge_intervals_occlude(&intervals, interval))
        goto end;
    }
    if (!edge_intervals_store(&intervals, (uint32_t)e, map))
      goto end;
  }
  ok = true;
end:
  mem_free(occluder);
  edge_intervals_fini(&intervals);
  return ok;
}

static bool solve_fragments(const struct sheet *sheet,
                            const struct triangle_grid *grid,
                            bool exact_corners, struct map *map,
                            struct report *report, struct progress *progress) {
  size_t n = sheet->triangle.count;
  struct fragments fragments;
  struct occluder_subtraction subtraction;
  bool ok = false;
  occluder_subtraction_init(&subtraction, sheet);
  if (!fragments_init(&fragments, sheet, grid, true))
    return false;
  fragments.progress = progress;
  fragments.report = report;
  for (size_t f = 0; f < n; f++) {
    if (is_flat(sheet, f))
      continue;
    if (!occluder_subtraction_start(&subtraction, (uint32_t)f, NULL))
      goto end;
    for (size_t g = 0; g < n; g++)
      if (g != f && !is_flat(sheet, g) &&
          (!progress_step_at(progress, 1 + subtraction.left.count, f, n) ||
           !occluder_subtraction_take_nearer(&subtraction, (uint32_t)g)))
        goto end;
    if (!occluder_subtraction_store(&subtraction, &fragments))
      goto end;
  }
  ok = fragments_finish(&fragments, exact_corners, map);
end:
  occluder_subtraction_report(&subtraction, report);
  occluder_subtraction_fini(&subtraction);
  fragments_fini(&fragments);
  return ok;
}

static recto_status solve(struct sheet *sheet,
                          const struct solver_request *request, struct map *map,
                          struct report *report, recto_error *error) {
  struct occlusion_counts counts = {0};
  struct progress progress = progress_of(request, "edges");
  struct triangle_grid grid;
  recto_status status = RECTO_OK;
  if (!triangle_grid_init(&grid, sheet))
    return error_memory(error);
  if (request->intersections)
    status = intersection_find_all(sheet, &grid, NULL, request, report, error);
  if (status == RECTO_OK && request->strokes &&
      !solve_strokes(sheet, map, &counts, &progress))
    status = progress_error(&progress, error);
  progress.stage = "faces";
  if (status == RECTO_OK && request->fragments &&
      !solve_fragments(sheet, &grid, request->exact_corners, map, report,
                       &progress))
    status = progress_error(&progress, error);
  occlusion_report(&counts, report);
  triangle_grid_fini(&grid);
  return status;
}

const struct solver solver_brute = {RECTO_METHOD_BRUTE, "brute", true, solve};
