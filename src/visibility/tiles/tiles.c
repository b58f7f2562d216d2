/* tiles.c - exact visibility of dense meshes: most of it is decided by page
 * tiles (tile_classification.h) without asking any pair, the rest by pairs.
 *
 * Phases
 *   1 classify the tiles
 *   2 classify edges, and faces where fragments are asked for: visible or
 *     hidden where all the tiles they meet say so; else they are left over
 *   3 list the faces of the tiles that left-over edges and faces meet
 *   4 find piercing pairs, in mixed tiles alone, and classify their edges
 *   5 solve the left-over ones by pairs, as the other exact solvers do
 *
 * Invariant: a decision in phase 2 is the one that pairs would have made.
 */
#include <stdatomic.h>
#include <string.h>

#include "base/parallel.h"
#include "visibility/pairwise/edge_query.h"
#include "visibility/pairwise/undecided_faces.h"
#include "visibility/intersection/intersection.h"
#include "visibility/solver.h"
#include "visibility/predicate/surrounder.h"
#include "visibility/pairwise/tile_candidates.h"

struct tiles_work {
  struct sheet *sheet;
  const struct solver_request *request;
  struct tile_classification tiles;
  struct tile_candidates lists;
  uint8_t *wanted;      /* tiles whose faces are to be listed */
  uint8_t *pierced;     /* tiles where faces may be seen to pierce */
  bool wants_more;      /* than are listed */
  ARRAY(uint32_t) edge; /* left over, ascending */
  ARRAY(uint32_t) face; /* triangles left over, ascending */
  uint8_t *face_state;  /* one a triangle: enum map_state; MAP_MIXED is
                              left over */
  struct occlusion_counts hide;
  struct report *report;
  double phase_start; /* of the phase at hand */
  atomic_bool *cancelled;
};

enum { ASK_EVERY = 16 }; /* edges or faces between two calls of progress */

/* Asks whether to go on, in the caller's own thread and not too often. */
static bool may_go_on(const struct tiles_work *work, size_t done, size_t all,
                      const char *stage, bool callers) {
  const struct solver_request *request = work->request;
  if (callers && done % ASK_EVERY == 0 && request->progress != NULL &&
      !atomic_load(work->cancelled) &&
      !request->progress(request->user, (double)done / (double)all, stage))
    atomic_store(work->cancelled, true);
  return !atomic_load(work->cancelled);
}

/* ---- 3, 4. Lists and piercing -------------------------------------------- */

/* Faces that pierce each other where they can be seen do so in mixed tiles.
 * Where hidden lines are drawn too, they are looked for everywhere, in a grid
 * of their own: lists of tiles leave out what is behind a horizon. */
static bool want_for_piercing(struct tiles_work *work) {
  size_t n = triangle_grid_cell_count(&work->tiles.grid);
  if (work->request->hidden)
    return true;
  work->pierced = mem_alloc(n, 1);
  if (work->pierced == NULL)
    return false;
  for (size_t i = 0; i < n; i++) {
    work->pierced[i] = work->tiles.tile[i].state == TILE_MIXED;
    work->wanted[i] |= work->pierced[i];
  }
  return true;
}

/* Lists the faces of the wanted tiles, again where more became wanted. */
static bool list_faces(struct tiles_work *work) {
  work->wants_more = false;
  return tile_candidates_fill(&work->lists, &work->tiles, work->sheet,
                              work->wanted);
}

/* ---- 2. Classifying ------------------------------------------------------ */

/* What a tile says of something with depths in these buckets: MAP_MIXED where
 * it does not say.  Of a wire it is not known that it lies in a layer. */
static enum map_state query_tile(const struct tile *tile, int low, int high,
                                 bool wire) {
  if (tile->state == TILE_MIXED)
    return MAP_MIXED;
  if (tile->state == TILE_EMPTY)
    return MAP_VISIBLE;
  if (wire)
    return high < tile->front - 1 ? MAP_HIDDEN : MAP_MIXED;
  return low >= tile->front ? MAP_VISIBLE : MAP_HIDDEN;
}

static int least_bucket(int64_t a, int64_t b) {
  return tile_bucket(a < b ? a : b);
}

static int most_bucket(int64_t a, int64_t b) {
  return tile_bucket(a > b ? a : b);
}

/* Calls for the tiles that the segment meets: the state all of them agree on,
 * or MAP_MIXED; with `mark`, marks them as wanted. */
static enum map_state query_along(struct tiles_work *work, struct geom_point p,
                                  struct geom_point q, bool wire, bool mark) {
  const struct triangle_grid *grid = &work->tiles.grid;
  struct cell_range r = triangle_grid_cells(grid, box2_of_segment(p, q));
  int low = least_bucket(p.z, q.z), high = most_bucket(p.z, q.z);
  int64_t nearest = p.z > q.z ? p.z : q.z;
  int state = -1;
  for (int y = r.y0; y <= r.y1; y++) {
    int x0, x1;
    triangle_grid_row(grid, p, q, r, y, &x0, &x1);
    for (int x = x0; x <= x1; x++) {
      size_t i = (size_t)y * (size_t)grid->columns + (size_t)x;
      int now = tile_classification_is_behind(&work->tiles, i, nearest)
                    ? MAP_HIDDEN
                    : (int)query_tile(&work->tiles.tile[i], low, high, wire);
      if (mark) {
        work->wants_more |= !work->wanted[i];
        work->wanted[i] = 1;
      } else {
        if (now == MAP_MIXED || (state >= 0 && state != now))
          return MAP_MIXED;
        state = now;
      }
    }
  }
  return state < 0 ? MAP_MIXED : (enum map_state)state;
}

/* What all tiles of a small range agree on; MAP_MIXED where they do not. */
static enum map_state query_range(const struct tile_classification *map,
                                  struct cell_range r, int low, int high,
                                  bool wire) {
  const struct tile *row = map->tile + (size_t)r.y0 * (size_t)map->grid.columns;
  enum map_state state = query_tile(&row[r.x0], low, high, wire);
  for (int y = r.y0; y <= r.y1; y++, row += map->grid.columns)
    for (int x = r.x0; x <= r.x1; x++)
      if (query_tile(&row[x], low, high, wire) != state)
        return MAP_MIXED;
  return state;
}

/* The state of an edge: mostly all tiles about it agree, and which of them it
 * meets need not be known. */
static enum map_state query_edge(struct tiles_work *work, struct geom_point p,
                                 struct geom_point q, bool wire) {
  struct cell_range r =
      triangle_grid_cells(&work->tiles.grid, box2_of_segment(p, q));
  enum map_state state;
  if (work->tiles.horizon != NULL || r.x1 - r.x0 + r.y1 - r.y0 > 2)
    return query_along(work, p, q, wire, false);
  state = query_range(&work->tiles, r, least_bucket(p.z, q.z),
                      most_bucket(p.z, q.z), wire);
  return state == MAP_MIXED && r.x0 < r.x1 && r.y0 < r.y1
             ? query_along(work, p, q, wire, false)
             : state;
}

/* Classifies the edges from number `from` on. */
static bool classify_edges(struct tiles_work *work, size_t from,
                           struct map *map) {
  const struct sheet *sheet = work->sheet;
  if (!edge_intervals_open_map(map, sheet->edge.count))
    return false;
  for (size_t e = from; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    struct geom_point p = sheet->point.item[edge->point[0]],
                      q = sheet->point.item[edge->point[1]];
    bool wire = edge->triangle[0] == SHEET_NONE ||
                edge->edge_class == RECTO_EDGE_INTERSECTION;
    if (edge->edge_class == 0 || (p.x == q.x && p.y == q.y))
      continue;
    map->edge_state[e] = (uint8_t)query_edge(work, p, q, wire);
    if (map->edge_state[e] != MAP_MIXED)
      continue;
    if (!ARRAY_PUSH(&work->edge, (uint32_t)e))
      return false;
    (void)query_along(work, p, q, wire, true);
  }
  return true;
}

static enum map_state query_face(const struct tiles_work *work, uint32_t t) {
  const struct sheet *sheet = work->sheet;
  const struct triangle_grid *grid = &work->tiles.grid;
  const uint32_t *point = sheet->triangle.item[t].point;
  struct cell_range r = triangle_grid_cells(grid, box2_of_triangle(sheet, t));
  int low = TILE_BUCKETS, high = -1, state = -1;
  int64_t nearest = triangle_nearest_z(sheet, t);
  for (int k = 0; k < 3; k++) {
    int bucket = tile_bucket(sheet->point.item[point[k]].z);
    if (bucket < low)
      low = bucket;
    if (bucket > high)
      high = bucket;
  }
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t i = (size_t)y * (size_t)grid->columns + (size_t)x;
      int now = tile_classification_is_behind(&work->tiles, i, nearest)
                    ? MAP_HIDDEN
                    : (int)query_tile(&work->tiles.tile[i], low, high, false);
      if (now == MAP_MIXED || (state >= 0 && state != now))
        return MAP_MIXED;
      state = now;
    }
  return (enum map_state)state;
}

static void want_face(struct tiles_work *work, uint32_t t) {
  const struct triangle_grid *grid = &work->tiles.grid;
  struct cell_range r =
      triangle_grid_cells(grid, box2_of_triangle(work->sheet, t));
  for (int y = r.y0; y <= r.y1; y++)
    memset(work->wanted + (size_t)y * (size_t)grid->columns + r.x0, 1,
           (size_t)(r.x1 - r.x0) + 1);
}

static bool classify_faces(struct tiles_work *work) {
  size_t n = work->sheet->triangle.count;
  work->face_state = mem_alloc(n, 1);
  if (work->face_state == NULL)
    return false;
  for (size_t t = 0; t < n; t++) {
    work->face_state[t] = MAP_HIDDEN;
    if (work->sheet->triangle_flags[t] & SHEET_FLAT)
      continue;
    work->face_state[t] = (uint8_t)query_face(work, (uint32_t)t);
    if (work->face_state[t] != MAP_MIXED)
      continue;
    if (!ARRAY_PUSH(&work->face, (uint32_t)t))
      return false;
    want_face(work, (uint32_t)t);
  }
  return true;
}

/* ---- 5. Pairs ------------------------------------------------------------ */

/* A run of left-over edges, solved by one thread. */
struct edge_run {
  struct map map; /* its edge_state is the common one */
  struct occlusion_counts counts;
  bool done;
};

enum { RUN = 1024 };

static void solve_run(const struct tiles_work *work, size_t from,
                      struct edge_query *query, bool callers,
                      struct edge_run *run) {
  size_t to = work->edge.count - from < RUN ? work->edge.count : from + RUN;
  run->done = true;
  for (size_t i = from; run->done && i < to; i++)
    run->done =
        may_go_on(work, i, work->edge.count, "edges", callers) &&
        edge_query_solve(query, work->edge.item[i]) &&
        edge_intervals_store(&query->intervals, work->edge.item[i], &run->map);
  run->counts = query->counts;
  query->counts = (struct occlusion_counts){0};
}

/* The runs, which the threads share. */
struct edge_runs {
  const struct tiles_work *work;
  struct edge_run *run;
  size_t count;
  atomic_size_t next; /* not yet taken by any thread */
};

static void solve_some(void *user, bool callers) {
  struct edge_runs *runs = user;
  const struct tiles_work *work = runs->work;
  struct edge_query query;
  if (edge_query_init(&query, work->sheet, &work->lists)) {
    size_t i;
    while ((i = atomic_fetch_add(&runs->next, 1)) < runs->count)
      solve_run(work, i * RUN, &query, callers, &runs->run[i]);
  }
  edge_query_fini(&query);
}

/* Appends a run's intervals to the map's; runs come in the edges' order. */
static bool join_run(struct map *map, const struct edge_run *run) {
  uint32_t base = (uint32_t)map->interval.count;
  if (!ARRAY_RESERVE(&map->mixed, run->map.mixed.count) ||
      !ARRAY_RESERVE(&map->interval, run->map.interval.count))
    return false;
  for (size_t i = 0; i < run->map.mixed.count; i++) {
    struct map_mixed mixed = run->map.mixed.item[i];
    mixed.interval += base;
    map->mixed.item[map->mixed.count++] = mixed;
  }
  for (size_t i = 0; i < run->map.interval.count; i++)
    map->interval.item[map->interval.count++] = run->map.interval.item[i];
  return true;
}

static bool solve_edges(struct tiles_work *work, struct map *map) {
  size_t n = work->edge.count, runs = (n + RUN - 1) / RUN;
  struct edge_run *run = mem_calloc(runs, sizeof *run);
  bool ok = run != NULL;
  if (!ok)
    return false;
  for (size_t i = 0; i < runs; i++)
    run[i].map.edge_state = map->edge_state;
  parallel_run(runs > 1 ? work->request->threads : 1, solve_some,
               &(struct edge_runs){.work = work, .run = run, .count = runs});
  for (size_t i = 0; i < runs; i++) {
    ok = ok && run[i].done && join_run(map, &run[i]);
    occlusion_counts_add(&work->hide, &run[i].counts);
    run[i].map.edge_state = NULL;
    map_fini(&run[i].map);
  }
  mem_free(run);
  return ok;
}

static bool solve_faces(struct tiles_work *work, struct map *map) {
  struct fragments fragments;
  struct undecided_faces undecided_faces;
  size_t n = work->sheet->triangle.count;
  struct progress progress = progress_of(work->request, "faces");
  bool ok = fragments_init(&fragments, work->sheet, &work->lists.grid, true);
  ok &= undecided_faces_init(&undecided_faces, work->sheet, &work->lists,
                             work->wanted, work->face_state);
  fragments.progress = undecided_faces.occluders.progress = &progress;
  fragments.report = work->report;
  for (size_t t = 0; ok && t < n; t++)
    if (work->face_state[t] == MAP_VISIBLE)
      ok = fragments_add_without_contact(&fragments, (uint32_t)t);
  ok = ok && undecided_faces_sort(&undecided_faces, work->face.item,
                                  work->face.count);
  for (size_t i = 0; ok && i < work->face.count; i++)
    ok =
        progress_step_at(&progress, 1, i, work->face.count) &&
        undecided_faces_solve(&undecided_faces, work->face.item[i], &fragments);
  ok = ok && fragments_finish(&fragments, work->request->exact_corners, map);
  if (progress.cancelled)
    atomic_store(work->cancelled, true);
  undecided_faces_report(&undecided_faces, work->report);
  undecided_faces_fini(&undecided_faces);
  fragments_fini(&fragments);
  return ok;
}

/* ---- The solver ---------------------------------------------------------- */

static void report_tiles(const struct tiles_work *work, struct report *report) {
  report_int(report, "tiles", "simple", (int64_t)work->tiles.simple);
  report_int(report, "tiles", "mixed", (int64_t)work->tiles.mixed);
  report_int(report, "tiles", "empty", (int64_t)work->tiles.empty);
  report_int(report, "tiles", "with_horizons", work->tiles.horizon != NULL);
  report_int(report, "tiles", "edges_left_over", (int64_t)work->edge.count);
  report_int(report, "tiles", "triangles_left_over", (int64_t)work->face.count);
  occlusion_report(&work->hide, report);
}

/* Files how long the phase took that ends now. */
static void end_phase(struct tiles_work *work, const char *name) {
  double now = clock_cpu();
  report_double(work->report, "tiles", name, now - work->phase_start);
  work->phase_start = now;
}

static bool classify(struct tiles_work *work, struct map *map) {
  const struct solver_request *request = work->request;
  work->phase_start = clock_cpu();
  if (!tile_classification_init(&work->tiles, work->sheet, request->strokes,
                                request->fragments))
    return false;
  end_phase(work, "tiles_cpu_s");
  work->wanted = mem_calloc(triangle_grid_cell_count(&work->tiles.grid), 1);
  if (work->wanted == NULL)
    return false;
  if (request->strokes && !classify_edges(work, 0, map))
    return false;
  if (request->fragments && !classify_faces(work))
    return false;
  end_phase(work, "classes_cpu_s");
  return true;
}

static bool pierce_anywhere(struct tiles_work *work, recto_status *status,
                            recto_error *error) {
  struct triangle_grid grid;
  if (!triangle_grid_init(&grid, work->sheet))
    return false;
  *status = intersection_find_all(work->sheet, &grid, NULL, work->request,
                                  work->report, error);
  triangle_grid_fini(&grid);
  return *status == RECTO_OK;
}

static bool pierce_in_lists(struct tiles_work *work, recto_status *status,
                            recto_error *error) {
  *status =
      intersection_find_all(work->sheet, &work->lists.grid,
                            work->lists.cells_are_tiles ? work->pierced : NULL,
                            work->request, work->report, error);
  return *status == RECTO_OK;
}

/* Finds the piercing pairs, and what they add to the edges. */
static bool find_piercing(struct tiles_work *work, struct map *map,
                          recto_status *status, recto_error *error) {
  size_t mesh_edges = work->sheet->edge.count;
  if (!(work->request->hidden ? pierce_anywhere(work, status, error)
                              : pierce_in_lists(work, status, error)))
    return false;
  if (work->request->strokes && !classify_edges(work, mesh_edges, map))
    return false;
  end_phase(work, "piercing_cpu_s");
  return !work->wants_more || list_faces(work);
}

static bool solve_all(struct tiles_work *work, struct map *map,
                      recto_status *status, recto_error *error) {
  const struct solver_request *request = work->request;
  if (!classify(work, map))
    return false;
  if (request->intersections && !want_for_piercing(work))
    return false;
  if (!list_faces(work))
    return false;
  end_phase(work, "lists_cpu_s");
  if (request->intersections && !find_piercing(work, map, status, error))
    return false;
  if (request->strokes && !solve_edges(work, map))
    return false;
  end_phase(work, "edges_cpu_s");
  if (request->fragments && !solve_faces(work, map))
    return false;
  end_phase(work, "faces_cpu_s");
  return true;
}

static recto_status solve(struct sheet *sheet,
                          const struct solver_request *request, struct map *map,
                          struct report *report, recto_error *error) {
  atomic_bool cancelled = false;
  struct tiles_work work = {.sheet = sheet,
                            .request = request,
                            .report = report,
                            .cancelled = &cancelled};
  recto_status status = RECTO_OK;
  if (!solve_all(&work, map, &status, error) && status == RECTO_OK)
    status = cancelled
                 ? error_set(error, RECTO_ERROR_CANCELLED, NULL, 0, "cancelled")
                 : error_memory(error);
  report_tiles(&work, report);
  tile_candidates_fini(&work.lists);
  tile_classification_fini(&work.tiles);
  mem_free(work.wanted);
  mem_free(work.pierced);
  mem_free(work.face_state);
  ARRAY_FREE(&work.edge);
  ARRAY_FREE(&work.face);
  return status;
}

const struct solver solver_tiles = {RECTO_METHOD_TILES, "tiles", true, solve};
