/* watkins_exact.c - from the sweep over exact heights to the visible map.
 *
 * Edges      while a drawn edge is active, the sweep reports the triangles that
 *            cover the intervals beside it; what each occludes of the edge is
 *            computed once (occlusion.h).  A triangle that never covers such an
 *            interval cannot occlude any of the edge.  Lines that are not edges
 *            of faces are deferred to pairwise_fallback.h.
 * Fragments  see visible_trapezoids.c: trapezoids, each with the triangle
 *            visible in it, are united by fragments.h.
 */
#include "visibility/watkins/watkins_solver.h"

#include <string.h>

#include "visibility/intersection/intersection.h"
#include "visibility/pairwise/pairwise_fallback.h"
#include "visibility/predicate/edge_intervals.h"
#include "visibility/progress.h"
#include "visibility/watkins/exact/visible_trapezoids.h"

/* Limit of the pairs of an edge and a triangle that may occlude it. */
#define PAIRS_MAX (1 << 24)

/* ---- Pairs --------------------------------------------------------------- */

/* Pairs of a drawn edge and a triangle that covers an interval beside it. */
struct edge_face_pairs {
  ARRAY(struct sort_key) pair; /* edge of the sheet << 32 | triangle */
  size_t limit;  /* at this count they are sorted and duplicates removed */
  bool too_many; /* more than PAIRS_MAX */
};

/* What both sweeps' callbacks get. */
struct exact_watkins {
  struct visible_trapezoids visible;
  struct edge_face_pairs pairs;
  struct progress progress;
  struct pairwise_fallback fallback; /* all 0 before its first use */
};

/* Initialises the fallback at its first use; false when memory ran out. */
static bool init_fallback(struct exact_watkins *exact,
                          const struct sheet *sheet,
                          const struct solver_request *request) {
  if (exact->fallback.sheet != NULL)
    return true;
  exact->progress = progress_of(request, "edges");
  return pairwise_fallback_init(&exact->fallback, sheet, request->fragments,
                                &exact->progress);
}

/* Sorts the pairs and removes duplicates. */
static bool unique_pairs(struct edge_face_pairs *pairs) {
  if (!sort_keys_unique(pairs->pair.item, &pairs->pair.count))
    return false;
  pairs->limit = 2 * pairs->pair.count + 4096;
  pairs->too_many = pairs->pair.count > PAIRS_MAX;
  return true;
}

static bool add_edge_triangle(void *user, const struct sweep *sweep,
                              uint32_t edge, uint32_t triangle) {
  struct edge_face_pairs *pairs = &((struct exact_watkins *)user)->pairs;
  uint32_t side = sweep->edge.item[edge].side;
  struct sort_key pair = {(uint64_t)side << 32 | triangle, 0};
  if (pairs->too_many ||
      occlusion_is_own(sweep->sheet, &sweep->sheet->edge.item[side], triangle))
    return true;
  return (pairs->pair.count < pairs->limit || unique_pairs(pairs)) &&
         ARRAY_PUSH(&pairs->pair, pair);
}

static bool add_trapezoid(void *user, const struct sweep *sweep,
                          const struct sweep_trapezoid *trapezoid) {
  return visible_trapezoids_add(&((struct exact_watkins *)user)->visible, sweep,
                                trapezoid);
}

/* ---- Edges --------------------------------------------------------------- */

static bool store_edge(const struct sheet *sheet, uint32_t e,
                       const struct sort_key *pair, size_t count,
                       struct edge_intervals *intervals,
                       struct occlusion_counts *counts, struct map *map) {
  struct geom_segment s = sheet_ends(sheet, sheet->edge.item[e].point);
  struct box2 box = box2_of_segment(s.p, s.q);
  edge_intervals_start(intervals);
  for (size_t i = 0; i < count && !intervals->occluded; i++) {
    uint32_t triangle = (uint32_t)pair[i].key;
    struct occluded_interval part;
    if (occlusion_is_possible(sheet, triangle, s.p, s.q, box) &&
        occlude_edge_by_triangle(sheet, triangle, s.p, s.q, &part, counts) &&
        !edge_intervals_occlude(intervals, part))
      return false;
  }
  return edge_intervals_store(intervals, e, map);
}

/* The same for a line that is not an edge of a face. */
static bool store_line(struct exact_watkins *exact, const struct sheet *sheet,
                       const struct solver_request *request, uint32_t e,
                       struct map *map) {
  struct edge_intervals *intervals = NULL;
  if (init_fallback(exact, sheet, request))
    intervals = pairwise_fallback_edge(&exact->fallback, e);
  return intervals != NULL && edge_intervals_store(intervals, e, map);
}

static recto_status store_edges(struct exact_watkins *exact,
                                const struct sheet *sheet,
                                const struct solver_request *request,
                                struct map *map, struct report *report,
                                recto_error *error) {
  struct edge_face_pairs *pairs = &exact->pairs;
  const struct sort_key *pair;
  struct edge_intervals intervals = {0};
  struct occlusion_counts counts = {0};
  struct progress progress = progress_of(request, "edges");
  size_t i = 0, count;
  bool ok =
      unique_pairs(pairs) && edge_intervals_open_map(map, sheet->edge.count);
  if (ok && pairs->too_many)
    return error_set(error, RECTO_ERROR_LIMIT, NULL, 0,
                     "too much for watkins without a pitch: more than %d pairs "
                     "of an edge and an adjacent triangle; -m auto has no such "
                     "limit",
                     PAIRS_MAX);
  pair = pairs->pair.item;
  count = pairs->pair.count;
  for (uint32_t e = 0; ok && e < sheet->edge.count; e++) {
    const struct sort_key *own = count > 0 ? pair + i : NULL;
    size_t first = i;
    while (i < count && pair[i].key >> 32 == e)
      i++;
    if (!sheet_edge_is_drawn(sheet, e))
      continue;
    if (!sweep_includes_line(sheet, e))
      ok = store_line(exact, sheet, request, e, map);
    else
      ok = progress_step(&progress, i - first) &&
           store_edge(sheet, e, own, i - first, &intervals, &counts, map);
  }
  occlusion_report(&counts, report);
  report_count(report, "watkins", "faces_beside_lines", count);
  edge_intervals_fini(&intervals);
  return ok ? RECTO_OK : error_memory(error);
}

/* ---- Fragments ----------------------------------------------------------- */

/* Adds the fragments of the deferred triangles, solved by the fallback. */
static recto_status
store_deferred_fragments(struct exact_watkins *exact, const struct sheet *sheet,
                         const struct solver_request *request,
                         struct fragments *fragments, struct report *report,
                         recto_error *error) {
  ARRAY(uint32_t) list = {0};
  bool ok = true;
  for (uint32_t t = 0; ok && t < sheet->triangle.count; t++)
    if (visible_trapezoids_is_deferred(&exact->visible, t))
      ok = ARRAY_PUSH(&list, t);
  report_count(report, "watkins", "deferred", list.count);
  if (list.count > 0)
    ok = ok && init_fallback(exact, sheet, request) &&
         pairwise_fallback_faces(&exact->fallback, list.item, list.count,
                                 fragments);
  ARRAY_FREE(&list);
  return ok ? RECTO_OK : error_memory(error);
}

/* Sweeps the triangles that may be visible a second time. */
static recto_status
solve_fragments_watkins(struct exact_watkins *exact, const struct sheet *sheet,
                        const struct triangle_grid *grid,
                        const struct solver_request *request, struct map *map,
                        struct report *report, recto_error *error) {
  struct visible_trapezoids *visible = &exact->visible;
  struct fragments fragments;
  struct sweep sweep;
  recto_status status = RECTO_OK;
  struct progress progress = progress_of(request, "faces");
  bool ready = fragments_init(&fragments, sheet, grid, true);
  if (!sweep_init(&sweep, sheet, visible->hidden, false) || !ready)
    status = error_memory(error);
  fragments.progress = &progress;
  fragments.report = report;
  sweep.on_trapezoid = add_trapezoid;
  sweep.user = exact;
  visible->keep = true;
  visible->count = visible->filter_failures = 0;
  if (status == RECTO_OK)
    status = sweep_run(&sweep, request, 0.5, 0.7, error);
  if (status == RECTO_OK)
    status = visible_trapezoids_finish(visible, &sweep, &fragments, error);
  exact->progress.stage = "faces";
  if (status == RECTO_OK)
    status = store_deferred_fragments(exact, sheet, request, &fragments, report,
                                      error);
  if (status == RECTO_OK && !fragments_finish(&fragments, map))
    status = error_memory(error);
  report_count(report, "watkins", "visible_trapezoids", visible->count);
  report_count(report, "watkins", "filter_failures", visible->filter_failures);
  sweep_fini(&sweep);
  if (ready)
    fragments_fini(&fragments);
  return status;
}

/* ---- The solver ---------------------------------------------------------- */

/* Sweeps all triangles and drawn edges. */
static recto_status sweep_all(struct exact_watkins *exact,
                              const struct sheet *sheet,
                              const uint8_t *left_out,
                              const struct solver_request *request,
                              struct report *report, recto_error *error) {
  struct sweep sweep;
  recto_status status = RECTO_OK;
  if (!sweep_init(&sweep, sheet, left_out, request->edges))
    status = error_memory(error);
  sweep.on_trapezoid = request->fragments ? add_trapezoid : NULL;
  sweep.on_pair = request->edges ? add_edge_triangle : NULL;
  sweep.user = exact;
  if (status == RECTO_OK)
    status = sweep_run(&sweep, request, 0, 0.5, error);
  report_count(report, "watkins", "edges", sweep.edge.count);
  report_count(report, "watkins", "events", sweep.events);
  report_count(report, "watkins", "event_heights", sweep.height.count);
  report_count(report, "watkins", "crossings_found", sweep.crossings);
  report_count(report, "watkins", "trapezoids", exact->visible.count);
  sweep_fini(&sweep);
  return status;
}

static recto_status
solve_on(struct exact_watkins *exact, const struct sheet *sheet,
         const struct triangle_grid *grid, const struct solver_request *request,
         struct map *map, struct report *report, recto_error *error) {
  if (request->fragments && !visible_trapezoids_init(&exact->visible, sheet))
    return error_memory(error);
  recto_status status =
      sweep_all(exact, sheet, grid->left_out, request, report, error);
  if (status == RECTO_OK && request->edges)
    status = store_edges(exact, sheet, request, map, report, error);
  if (status == RECTO_OK && request->fragments)
    status = solve_fragments_watkins(exact, sheet, grid, request, map, report,
                                     error);
  return status;
}

recto_status watkins_solve_exactly(struct sheet *sheet,
                                   const struct solver_request *request,
                                   struct map *map, struct report *report,
                                   recto_error *error) {
  struct exact_watkins exact;
  struct triangle_grid grid;
  recto_status status = RECTO_OK;
  memset(&exact, 0, sizeof exact);
  if (!triangle_grid_init(&grid, sheet))
    return error_memory(error);
  if (request->intersections)
    status = intersection_find_all(sheet, &grid, NULL, request, report, error);
  if (status == RECTO_OK)
    status = solve_on(&exact, sheet, &grid, request, map, report, error);
  ARRAY_FREE(&exact.pairs.pair);
  visible_trapezoids_fini(&exact.visible);
  pairwise_fallback_fini(&exact.fallback);
  triangle_grid_fini(&grid);
  return status;
}
