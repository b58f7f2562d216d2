/* brute.c - the brute-force solver, the oracle of the tests: every edge against
 * every triangle, every triangle against every other.
 *
 * Short, obvious, and kept so: the other exact solvers are compared with it.
 *
 * Source  [Appel1967] decides visibility edge by edge as well.
 */
#include "visibility/brute/brute.h"

#include <inttypes.h>

#include "visibility/fragments/fragments.h"
#include "visibility/intersection/intersection.h"
#include "visibility/predicate/edge_intervals.h"
#include "visibility/predicate/triangle_pair.h"
#include "visibility/progress.h"
#include "visibility/solver.h"

/* The most pairs of lines and triangles, and of triangles.  Those that overlap
 * take about 100 ns each, so that all of them take about an hour at most. */
static const uint64_t PAIRS_MAX = UINT64_C(50000000000);

static recto_status check_pairs(size_t count, const char *what, size_t faces,
                                recto_error *error) {
  if (count == 0 || faces <= PAIRS_MAX / count)
    return RECTO_OK;
  return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                   "too much for brute: %zu %s against %zu triangles are more "
                   "than %" PRIu64 " pairs; -m auto has no such limit",
                   count, what, faces, PAIRS_MAX);
}

static bool solve_edges_brute(const struct sheet *sheet, struct map *map,
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
    for (size_t t = 0; t < n && !intervals.occluded; t++) {
      struct occluded_interval interval;
      if (!sheet_is_edge_on(sheet, t) &&
          occlude_edge(&occluder[t], s.p, s.q, &interval, counts) &&
          !occlusion_is_own(sheet, edge, (uint32_t)t) &&
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

void brute_pieces_fini(struct brute_pieces *pieces) {
  ARRAY_FREE(&pieces->left);
  ARRAY_FREE(&pieces->scratch);
  arena_fini(&pieces->arena);
}

/* Subtracts triangle g from the pieces of f where it is nearer. */
static bool subtract_triangle(struct brute_pieces *pieces,
                              const struct sheet *sheet,
                              const struct triangle_plane *plane, uint32_t f,
                              uint32_t g) {
  struct triangle_plane other = triangle_plane_of(sheet, g);
  struct geom_line *line = arena_alloc(&pieces->arena, 8, sizeof *line);
  if (line == NULL)
    return false;
  enum depth_order order =
      triangle_depth_order(plane, f, &other, g, &line[3], &line[7]);
  if (order == NEARER_NEVER)
    return true;
  triangle_lines(sheet, g, line, line + 4);
  pieces->scratch.count = 0;
  for (size_t i = 0; i < pieces->left.count; i++) {
    struct geom_convex inside;
    if (!geom_convex_subtract(&pieces->left.item[i], line, line + 4,
                              order == NEARER_ALWAYS ? 3 : 4, &pieces->scratch,
                              &inside, &pieces->arena))
      return false;
    pieces->whole &= inside.count == 0;
  }
  geom_pieces swap = pieces->left;
  pieces->left = pieces->scratch;
  pieces->scratch = swap;
  return true;
}

bool brute_subtract_all(struct brute_pieces *pieces, const struct sheet *sheet,
                        uint32_t f, struct progress *progress) {
  size_t n = sheet->triangle.count;
  struct triangle_plane plane = triangle_plane_of(sheet, f);
  struct geom_convex piece;
  arena_reset(&pieces->arena);
  pieces->left.count = 0;
  pieces->whole = true;
  if (!triangle_as_convex(sheet, f, &piece, &pieces->arena) ||
      !ARRAY_PUSH(&pieces->left, piece))
    return false;
  for (uint32_t g = 0; g < n; g++)
    if (!progress_step(progress, 1 + pieces->left.count) ||
        (g != f && !sheet_is_edge_on(sheet, g) &&
         !triangles_disjoint(sheet, f, g) &&
         !subtract_triangle(pieces, sheet, &plane, f, g)))
      return false;
  return true;
}

static bool solve_fragments_brute(const struct sheet *sheet,
                                  const struct triangle_grid *grid,
                                  struct map *map, struct report *report,
                                  struct progress *progress) {
  struct fragments fragments;
  struct brute_pieces pieces = {0};
  bool ok = fragments_init(&fragments, sheet, grid, true);
  fragments.progress = progress;
  fragments.report = report;
  for (uint32_t f = 0; ok && f < sheet->triangle.count; f++) {
    progress->share = (double)f / (double)sheet->triangle.count;
    if (!sheet_is_edge_on(sheet, f))
      ok = brute_subtract_all(&pieces, sheet, f, progress) &&
           (pieces.whole ? fragments_add_whole(&fragments, f)
                         : fragments_add(&fragments, f, pieces.left.item,
                                         pieces.left.count));
  }
  ok = ok && fragments_finish(&fragments, map);
  brute_pieces_fini(&pieces);
  fragments_fini(&fragments);
  return ok;
}

static recto_status solve_brute(struct sheet *sheet,
                                const struct solver_request *request,
                                struct map *map, struct report *report,
                                recto_error *error) {
  struct occlusion_counts counts = {0};
  struct progress progress = progress_of(request, "edges");
  struct triangle_grid grid;
  size_t triangles = sheet->triangle.count;
  recto_status status =
      request->fragments ? check_pairs(triangles, "triangles", triangles, error)
                         : RECTO_OK;
  if (status != RECTO_OK)
    return status;
  if (!triangle_grid_init(&grid, sheet))
    return error_memory(error);
  if (request->intersections)
    status = intersection_find_all(sheet, &grid, NULL, request, report, error);
  if (status == RECTO_OK && request->edges)
    status =
        check_pairs(sheet_count_requested(sheet), "lines", triangles, error);
  if (status == RECTO_OK && request->edges &&
      !solve_edges_brute(sheet, map, &counts, &progress))
    status = error_memory(error);
  progress.stage = "faces";
  if (status == RECTO_OK && request->fragments &&
      !solve_fragments_brute(sheet, &grid, map, report, &progress))
    status = error_memory(error);
  occlusion_report(&counts, report);
  triangle_grid_fini(&grid);
  return status;
}

const struct solver solver_brute = {RECTO_METHOD_BRUTE, solve_brute};
