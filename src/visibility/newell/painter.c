/* painter.c - the painter's algorithm without depth tests, as a baseline for
 * measurements.
 *
 * Faces are painted as a whole: in the order of the input, by the depth of
 * their centroids, or as the caller says, whatever their overlaps.  A face
 * keeps what no later face covers, and so do its edges; both are wrong where
 * the order is wrong.
 *
 * Source  [Newell1972] names the family; [FoleyVanDam1990] 15.5.
 */
#include "visibility/newell/painter.h"

#include "base/sort.h"
#include "visibility/fragments/occluder_subtraction.h"
#include "visibility/predicate/edge_intervals.h"
#include "visibility/progress.h"
#include "visibility/solver.h"

struct painting {
  const struct sheet *sheet;
  const struct triangle_grid *grid;
  struct triangle_grid_query query;
  const uint32_t *rank; /* one per triangle; 0 is painted first */
  struct progress progress;
};

/* The sort key of each triangle: three times the mean depth of its face. */
static void centroid_keys(const struct sheet *sheet, struct sort_key *key) {
  size_t n = sheet->triangle.count;
  for (size_t first = 0, end; first < n; first = end) {
    int128 sum = 0;
    for (end = first; end < n && sheet->triangle.item[end].face ==
                                     sheet->triangle.item[first].face;
         end++) {
      struct geom_triangle corner = sheet_corners(sheet, end);
      sum += (int128)corner.p[0].z + corner.p[1].z + corner.p[2].z;
    }
    for (size_t t = first; t < end; t++)
      key[t] = (struct sort_key){
          sort_key_of_int64((int64_t)(sum / (int128)(end - first))),
          (uint32_t)t};
  }
}

static bool rank_by_centroid(const struct sheet *sheet, uint32_t *rank) {
  size_t n = sheet->triangle.count;
  struct sort_key *key = mem_alloc(2 * n, sizeof *key);
  if (key == NULL)
    return false;
  centroid_keys(sheet, key);
  sort_keys(key, key + n, n);
  for (size_t i = 0; i < n; i++)
    rank[key[i].value] = (uint32_t)i;
  mem_free(key);
  return true;
}

static void rank_as_given(const struct sheet *sheet, uint32_t *rank) {
  for (size_t t = 0; t < sheet->triangle.count; t++)
    rank[t] = (uint32_t)t;
}

/* Computes the occluded intervals of an edge.  It is painted together with the
 * later of its faces; an edge without a face is painted before all faces. */
static bool occlude_painted_edge(struct painting *painting,
                                 const struct sheet_edge *edge,
                                 struct edge_intervals *intervals) {
  const struct sheet *sheet = painting->sheet;
  struct geom_segment s = sheet_ends(sheet, edge->point);
  bool own = edge->triangle[0] != SHEET_NONE;
  uint32_t rank = own ? painting->rank[edge->triangle[0]] : 0;
  if (edge->triangle[1] != SHEET_NONE &&
      painting->rank[edge->triangle[1]] > rank)
    rank = painting->rank[edge->triangle[1]];
  edge_intervals_start(intervals);
  if (!triangle_grid_find_along(painting->grid, s.p, s.q, &painting->query))
    return false;
  for (size_t i = 0; i < painting->query.found.count; i++) {
    uint32_t t = painting->query.found.item[i];
    struct occluded_interval part;
    if ((own && painting->rank[t] <= rank) || sheet_is_edge_on(sheet, t))
      continue;
    if (occlude_by_projection(sheet_corners(sheet, t).p, s.p, s.q, &part) &&
        !edge_intervals_occlude(intervals, part))
      return false;
  }
  return true;
}

static bool solve_edges_painter(struct painting *painting, struct map *map) {
  const struct sheet *sheet = painting->sheet;
  struct edge_intervals intervals = {0};
  bool ok = edge_intervals_open_map(map, sheet->edge.count);
  for (size_t e = 0; ok && e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    if (!sheet_edge_is_drawn(sheet, e))
      continue;
    ok = occlude_painted_edge(painting, edge, &intervals) &&
         progress_step_at(&painting->progress, painting->query.found.count, e,
                          sheet->edge.count) &&
         edge_intervals_store(&intervals, (uint32_t)e, map);
  }
  edge_intervals_fini(&intervals);
  return ok;
}

/* Subtracts from triangle f all triangles that are painted after it. */
static bool subtract_later_triangles(struct painting *painting, uint32_t f,
                                     struct occluder_subtraction *subtraction) {
  if (!triangle_grid_find_overlapping(painting->grid, f, &painting->query))
    return false;
  for (size_t i = 0; i < painting->query.found.count &&
                     !occluder_subtraction_is_empty(subtraction);
       i++) {
    uint32_t g = painting->query.found.item[i];
    struct box2 box = box2_of_triangle(painting->sheet, g);
    if (painting->rank[g] <= painting->rank[f] ||
        sheet_is_edge_on(painting->sheet, g) ||
        box2_disjoint(subtraction->box, box))
      continue;
    struct triangle_occluder occluder = {.triangle = g, .sides = 3, .box = box};
    if (!progress_step(&painting->progress, 1 + subtraction->left.count) ||
        !occluder_subtraction_subtract(subtraction, &occluder))
      return false;
  }
  return true;
}

static bool solve_fragments_painter(struct painting *painting,
                                    struct map *map) {
  struct fragments fragments;
  struct occluder_subtraction subtraction;
  bool ok = fragments_init(&fragments, painting->sheet, painting->grid, false);
  fragments.progress = &painting->progress;
  occluder_subtraction_init(&subtraction, painting->sheet);
  for (size_t f = 0; ok && f < painting->sheet->triangle.count; f++)
    if (!sheet_is_edge_on(painting->sheet, f))
      ok = occluder_subtraction_start(&subtraction, (uint32_t)f, NULL) &&
           subtract_later_triangles(painting, (uint32_t)f, &subtraction) &&
           occluder_subtraction_store(&subtraction, &fragments);
  ok = ok && fragments_finish(&fragments, map);
  occluder_subtraction_fini(&subtraction);
  fragments_fini(&fragments);
  return ok;
}

recto_status painter_solve(const struct sheet *sheet,
                           const struct triangle_grid *grid,
                           const uint32_t *rank,
                           const struct solver_request *request,
                           struct map *map, recto_error *error) {
  struct painting painting = {.sheet = sheet,
                              .grid = grid,
                              .rank = rank,
                              .progress = progress_of(request, "painting")};
  bool ok = triangle_grid_query_init(&painting.query, grid) &&
            (!request->edges || solve_edges_painter(&painting, map)) &&
            (!request->fragments || solve_fragments_painter(&painting, map));
  triangle_grid_query_fini(&painting.query);
  return ok ? RECTO_OK : error_memory(error);
}

static recto_status solve_painter(struct sheet *sheet,
                                  const struct solver_request *request,
                                  bool given, struct map *map,
                                  recto_error *error) {
  struct triangle_grid grid;
  recto_status status = RECTO_OK;
  if (!triangle_grid_init(&grid, sheet))
    return error_memory(error);
  uint32_t *rank = mem_alloc(sheet->triangle.count, sizeof *rank);
  if (rank == NULL || (!given && !rank_by_centroid(sheet, rank)))
    status = error_memory(error);
  else if (given)
    rank_as_given(sheet, rank);
  if (status == RECTO_OK)
    status = painter_solve(sheet, &grid, rank, request, map, error);
  mem_free(rank);
  triangle_grid_fini(&grid);
  return status;
}

static recto_status solve_by_centroid(struct sheet *sheet,
                                      const struct solver_request *request,
                                      struct map *map, struct report *report,
                                      recto_error *error) {
  (void)report;
  return solve_painter(sheet, request, false, map, error);
}

static recto_status solve_as_given(struct sheet *sheet,
                                   const struct solver_request *request,
                                   struct map *map, struct report *report,
                                   recto_error *error) {
  (void)report;
  return solve_painter(sheet, request, true, map, error);
}

const struct solver solver_painter = {RECTO_METHOD_PAINTER, solve_by_centroid};
const struct solver solver_painter_given = {RECTO_METHOD_PAINTER_GIVEN,
                                            solve_as_given};
