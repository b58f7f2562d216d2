/* tiles.c - exact visibility of dense meshes: decides most edges and faces by
 * page tiles (tile_classification.h), the others by pairs.
 *
 * Phases
 *   0 if hidden lines are requested, find the intersections, everywhere; cull
 *     hidden triangles; if that pays, go on with what is left alone
 *   1 classify the tiles
 *   2 classify edges and, if fragments are requested, faces (tile_states.h)
 *   3 list the faces of the tiles that deferred edges and faces overlap
 *   4 otherwise find the intersections, in mixed tiles alone, and classify
 *     their edges
 *   5 solve the deferred edges and faces by pairs, as other exact solvers do
 *
 * Invariant: phase 2 decides as a comparison of all pairs would.
 */
#include <string.h>

#include "base/clock.h"
#include "base/parallel.h"
#include "base/poll.h"
#include "base/sort.h"
#include "visibility/culling/potentially_visible.h"
#include "visibility/dense_edges.h"
#include "visibility/intersection/intersection.h"
#include "visibility/pairwise/deferred_triangles.h"
#include "visibility/pairwise/edge_query.h"
#include "visibility/pairwise/tile_candidates.h"
#include "visibility/predicate/surrounder.h"
#include "visibility/solver.h"
#include "visibility/tiles/tile_states.h"

struct tiles_work {
  struct sheet *sheet; /* what is left after culling */
  const struct solver_request *request;
  const struct occlusion_culling *culling;
  struct tile_classification tiles;
  struct tile_states states;
  struct tile_candidates lists;
  uint8_t *intersected; /* one per tile: visible intersections are possible;
                           NULL: they are not to be found */
  struct occlusion_counts counts;
  struct report *report;
  double phase_start; /* CPU seconds at the start of the current phase */
};

/* ---- 3, 4. Lists and intersections --------------------------------------- */

static bool mark_intersected_range(void *user, struct parallel_range range) {
  const struct tiles_work *work = user;
  for (size_t i = range.begin; i < range.end; i++) {
    work->intersected[i] = work->tiles.tile[i].state == TILE_MIXED;
    work->states.wanted[i] |= work->intersected[i];
  }
  return true;
}

/* Marks the tiles in which intersections are searched: visible ones lie in
 * mixed tiles. */
static bool mark_intersected_tiles(struct tiles_work *work) {
  size_t n = triangle_grid_cell_count(&work->tiles.grid);
  work->intersected = mem_alloc(n, 1);
  return work->intersected != NULL &&
         parallel_ranges(parallel_workers(n, PARALLEL_ITEMS), n, PARALLEL_ITEMS,
                         mark_intersected_range, work);
}

/* Lists the faces of all wanted tiles, in place of the lists made before. */
static bool list_faces(struct tiles_work *work) {
  work->states.more_wanted = false;
  return tile_candidates_fill(&work->lists, &work->tiles, work->sheet,
                              work->states.wanted, work->request->edges,
                              work->request->fragments);
}

/* ---- 5. Pairs ------------------------------------------------------------ */

enum {
  BATCH_SIZE = PARALLEL_RANGE(128),     /* edges */
  BATCHES_OF_COPY = PARALLEL_RANGE(64), /* copied by one thread */
  POLL_INTERVAL = 16                    /* edges between two polls */
};

/* Batches of consecutive deferred edges, each solved by one thread. */
struct edge_batches {
  const struct tiles_work *work;
  struct edge_query *query; /* one a worker */
  struct map *map;          /* one a batch; all share edge_state */
  struct map *whole;        /* that of all */
  struct batch_place {
    size_t mixed, interval;
  } * place; /* one a batch: where it begins in that */
};

/* Closes short gaps of the edge that was stored last, and frees the places of
 * its intervals. */
static void close_last_edge(struct map *map, const struct tiles_work *work) {
  if (map->mixed.count == 0)
    return;
  struct map_mixed *last = &map->mixed.item[map->mixed.count - 1];
  dense_edges_close(map, last, work->sheet, work->request->short_gap);
  map->interval.count = (size_t)last->interval + last->count;
}

/* Fetches a deferred edge that comes later in a batch, and the ends of one that
 * comes sooner: in the order of the tiles they are anywhere in memory.
 * end  of the batch */
MEM_PREFETCH_INLINE void prefetch_edge(const struct tiles_work *work, size_t i,
                                       size_t end) {
  const struct sheet *sheet = work->sheet;
  const uint32_t *edge = work->states.edge.item;
  if (i + MEM_PREFETCH_AHEAD >= end)
    return;
  MEM_PREFETCH(&sheet->edge.item[edge[i + MEM_PREFETCH_AHEAD]]);
  const uint32_t *point =
      sheet->edge.item[edge[i + MEM_PREFETCH_AHEAD / 2]].point;
  MEM_PREFETCH(&sheet->point.item[point[0]]);
  MEM_PREFETCH(&sheet->point.item[point[1]]);
}

static bool solve_edges_of_batch(const struct edge_batches *batches,
                                 struct parallel_range range, struct map *map) {
  const struct tiles_work *work = batches->work;
  struct edge_query *query = &batches->query[range.worker];
  struct progress progress = progress_of(work->request, "edges");
  query->recent_count = 0; /* the counts are to be those of any thread */
  for (size_t i = range.begin; i < range.end; i++) {
    progress.share = (double)i / (double)work->states.edge.count;
    prefetch_edge(work, i, range.end);
    if ((i % POLL_INTERVAL == 0 && !progress_poll(&progress)) ||
        !edge_query_solve(query, work->states.edge.item[i]) ||
        !edge_intervals_store(&query->intervals, work->states.edge.item[i],
                              map))
      return false;
    close_last_edge(map, work);
  }
  return true;
}

/* In a map of its own until the end, as other threads write the maps beside
 * it.  Each worker makes its query, all of whose memory it touches. */
static bool solve_batch(void *user, struct parallel_range range) {
  const struct edge_batches *batches = user;
  struct edge_query *query = &batches->query[range.worker];
  const struct tiles_work *work = batches->work;
  if (query->sheet == NULL &&
      !edge_query_init(query, work->sheet, &work->lists, work->culling))
    return false;
  struct map *stored = &batches->map[range.begin / BATCH_SIZE], map = *stored;
  bool ok = solve_edges_of_batch(batches, range, &map);
  *stored = map;
  return ok;
}

/* Makes room in a map for what the batches have, in the order of their edges;
 * false when memory ran out. */
static bool place_batches(struct edge_batches *batches, size_t count,
                          struct map *map) {
  struct batch_place end = {map->mixed.count, map->interval.count};
  for (size_t i = 0; i < count; i++) {
    batches->place[i] = end;
    end.mixed += batches->map[i].mixed.count;
    end.interval += batches->map[i].interval.count;
  }
  if (!ARRAY_RESERVE(&map->mixed, end.mixed - map->mixed.count) ||
      !ARRAY_RESERVE(&map->interval, end.interval - map->interval.count))
    return false;
  map->mixed.count = end.mixed;
  map->interval.count = end.interval;
  batches->whole = map;
  return true;
}

/* Copies the intervals of batches to their places, and frees their own. */
static bool copy_batches(void *user, struct parallel_range range) {
  const struct edge_batches *batches = user;
  for (size_t b = range.begin; b < range.end; b++) {
    struct map *batch = &batches->map[b];
    struct map_mixed *mixed =
        batches->whole->mixed.item + batches->place[b].mixed;
    struct map_interval *interval =
        batches->whole->interval.item + batches->place[b].interval;
    for (size_t i = 0; i < batch->mixed.count; i++) {
      mixed[i] = batch->mixed.item[i];
      mixed[i].interval += (uint32_t)batches->place[b].interval;
    }
    for (size_t i = 0; i < batch->interval.count; i++)
      interval[i] = batch->interval.item[i];
    ARRAY_FREE(&batch->mixed);
    ARRAY_FREE(&batch->interval);
  }
  return true;
}

/* Sorts the deferred edges by the tile of their first end: those that follow
 * one another have occluders in common, which are still in the cache then.
 * Returns false when memory ran out. */
static bool sort_by_tile(struct tiles_work *work) {
  const struct triangle_grid *grid = &work->tiles.grid;
  const struct sheet *sheet = work->sheet;
  size_t n = work->states.edge.count;
  struct sort_key *key = mem_alloc(n, 2 * sizeof *key);
  if (key == NULL)
    return false;
  for (size_t i = 0; i < n; i++) {
    prefetch_edge(work, i, n);
    const uint32_t *point = sheet->edge.item[work->states.edge.item[i]].point;
    struct cell_range r =
        triangle_grid_cells(grid, box2_of_segment(sheet->point.item[point[0]],
                                                  sheet->point.item[point[0]]));
    key[i] = (struct sort_key){(uint64_t)r.y0 * (uint64_t)grid->columns +
                                   (uint64_t)r.x0,
                               work->states.edge.item[i]};
  }
  sort_keys(key, key + n, n);
  for (size_t i = 0; i < n; i++)
    work->states.edge.item[i] = key[i].value;
  mem_free(key);
  return true;
}

static bool solve_edges_tiles(struct tiles_work *work, struct map *map) {
  if (!sort_by_tile(work))
    return false;
  size_t count = parallel_range_count(work->states.edge.count, BATCH_SIZE);
  int workers = count > 1 ? work->request->threads : 1;
  struct edge_batches batches = {
      .work = work,
      .query = mem_calloc((size_t)workers, sizeof *batches.query),
      .map = mem_calloc(count, sizeof *batches.map),
      .place = mem_alloc(count, sizeof *batches.place)};
  bool ok =
      batches.query != NULL && batches.map != NULL && batches.place != NULL;
  for (size_t i = 0; ok && i < count; i++)
    batches.map[i].edge_state = map->edge_state;
  ok = ok &&
       parallel_ranges(workers, work->states.edge.count, BATCH_SIZE,
                       solve_batch, &batches) &&
       place_batches(&batches, count, map) &&
       parallel_ranges(workers, count, BATCHES_OF_COPY, copy_batches, &batches);
  for (size_t i = 0; batches.map != NULL && i < count; i++) {
    batches.map[i].edge_state = NULL;
    map_fini(&batches.map[i]);
  }
  for (int k = 0; batches.query != NULL && k < workers; k++) {
    occlusion_counts_add(&work->counts, &batches.query[k].counts);
    edge_query_fini(&batches.query[k]);
  }
  mem_free(batches.query);
  mem_free(batches.map);
  mem_free(batches.place);
  return ok && map_sort_mixed(map);
}

static bool solve_faces(struct tiles_work *work, struct map *map) {
  struct fragments fragments;
  struct deferred_triangles deferred_triangles;
  size_t n = work->sheet->triangle.count;
  struct progress progress = progress_of(work->request, "faces");
  bool ok = fragments_init(&fragments, work->sheet, &work->lists.grid, true);
  ok &= deferred_triangles_init(&deferred_triangles, work->sheet, &work->lists,
                                work->states.wanted, work->states.face_state);
  fragments.progress = &progress;
  fragments.report = work->report;
  for (size_t t = 0; ok && t < n; t++)
    if (work->states.face_state[t] == MAP_VISIBLE)
      ok = poll_at(t) && fragments_add_without_contact(&fragments, (uint32_t)t);
  ok = ok &&
       deferred_triangles_solve(&deferred_triangles, work->states.face.item,
                                work->states.face.count, &fragments,
                                &progress) &&
       fragments_finish(&fragments, map);
  deferred_triangles_report(&deferred_triangles, work->report);
  deferred_triangles_fini(&deferred_triangles);
  fragments_fini(&fragments);
  return ok;
}

/* ---- The solver ---------------------------------------------------------- */

static void report_tiles(const struct tiles_work *work, struct report *report) {
  report_count(report, "tiles", "simple", work->tiles.simple);
  report_count(report, "tiles", "mixed", work->tiles.mixed);
  report_count(report, "tiles", "empty", work->tiles.empty);
  report_count(report, "tiles", "triangles_culled", work->culling->count);
  report_count(report, "tiles", "edges_deferred", work->states.edge.count);
  report_count(report, "tiles", "triangles_deferred", work->states.face.count);
  occlusion_report(&work->counts, report);
}

/* Reports the CPU time of the phase that ends now. */
static void end_phase(struct tiles_work *work, const char *name) {
  double now = clock_cpu();
  report_double(work->report, "tiles", name, now - work->phase_start);
  work->phase_start = now;
}

static bool hides_segment(const void *user, struct geom_point p,
                          struct geom_point q, double xy, double z) {
  return occlusion_culling_hides_near(user, p, q, xy, z);
}

/* Phase 4.  Adds the intersections to the edges of the sheet. */
static bool find_intersections(struct tiles_work *work, struct map *map,
                               recto_status *status, recto_error *error) {
  size_t mesh_edges = work->sheet->edge.count;
  const struct hidden_segments hidden = {hides_segment, work->culling};
  *status = intersection_find_visible(
      work->sheet, &work->lists.grid,
      work->lists.cells_are_tiles ? work->intersected : NULL,
      work->culling->culled != NULL ? &hidden : NULL, work->request,
      work->report, error);
  if (*status != RECTO_OK ||
      (work->request->edges &&
       !tile_states_add_edges(&work->states, mesh_edges, map)))
    return false;
  end_phase(work, "intersections_cpu_s");
  return !work->states.more_wanted || list_faces(work);
}

/* Phases 1 to 5. */
static bool solve_all(struct tiles_work *work, struct map *map,
                      recto_status *status, recto_error *error) {
  const struct solver_request *request = work->request;
  bool intersections = request->intersections && !request->hidden;
  if (!tile_classification_init(&work->tiles, work->sheet, request->edges,
                                request->fragments))
    return false;
  end_phase(work, "tiles_cpu_s");
  if (!tile_states_init(&work->states, work->sheet, &work->tiles,
                        work->culling) ||
      (request->edges && !tile_states_add_edges(&work->states, 0, map)) ||
      (request->fragments && !tile_states_find_faces(&work->states)))
    return false;
  end_phase(work, "classes_cpu_s");
  if ((intersections && !mark_intersected_tiles(work)) || !list_faces(work))
    return false;
  end_phase(work, "lists_cpu_s");
  if (intersections && !find_intersections(work, map, status, error))
    return false;
  if (!request->fragments)
    tile_classification_drop_footprints(&work->tiles);
  if (request->edges && !solve_edges_tiles(work, map))
    return false;
  end_phase(work, "edges_cpu_s");
  if (request->fragments && !solve_faces(work, map))
    return false;
  end_phase(work, "faces_cpu_s");
  return true;
}

static void tiles_work_fini(struct tiles_work *work) {
  report_tiles(work, work->report);
  tile_candidates_fini(&work->lists);
  tile_classification_fini(&work->tiles);
  tile_states_fini(&work->states);
  mem_free(work->intersected);
}

/* Solves what culling left, as a sheet of its own. */
static bool solve_part(struct tiles_work *work, struct map *map,
                       recto_status *status, recto_error *error) {
  struct potentially_visible part;
  struct sheet *whole = work->sheet;
  bool ok = potentially_visible_init(&part, whole, work->culling);
  end_phase(work, "culling_cpu_s");
  work->sheet = &part.sheet;
  ok = ok && solve_all(work, map, status, error);
  tiles_work_fini(work);
  ok = ok && potentially_visible_restore(&part, whole, map);
  potentially_visible_fini(&part);
  return ok;
}

static recto_status solve_tiles(struct sheet *sheet,
                                const struct solver_request *request,
                                struct map *map, struct report *report,
                                recto_error *error) {
  struct occlusion_culling culling = {.culled = NULL};
  struct tiles_work work = {.sheet = sheet,
                            .request = request,
                            .culling = &culling,
                            .report = report,
                            .phase_start = clock_cpu()};
  recto_status status = RECTO_OK;
  if (request->intersections && request->hidden) { /* phase 0 */
    status = intersection_find_everywhere(sheet, request, report, error);
    end_phase(&work, "intersections_cpu_s");
  }
  bool ok = status == RECTO_OK &&
            occlusion_culling_init(&culling, sheet, request->fragments);
  if (culling.count > 0) {
    ok = ok && solve_part(&work, map, &status, error);
  } else {
    ok = ok && solve_all(&work, map, &status, error);
    tiles_work_fini(&work);
  }
  occlusion_culling_fini(&culling);
  return ok || status != RECTO_OK ? status : error_memory(error);
}

const struct solver solver_tiles = {RECTO_METHOD_TILES, solve_tiles};
