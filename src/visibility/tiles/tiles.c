/* tiles.c - exact visibility of dense meshes: decides most edges and faces by
 * page tiles (tile_classification.h), the others by pairs.
 *
 * Phases
 *   0 if hidden lines are requested, find the intersections, everywhere; cull
 *     hidden triangles; if that pays, go on with what is left alone
 *   1 classify the tiles
 *   2 classify edges and, if fragments are requested, faces: as visible or as
 *     hidden if all tiles that they overlap agree, otherwise as deferred
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
#include "visibility/pairwise/edge_query.h"
#include "visibility/pairwise/deferred_triangles.h"
#include "visibility/intersection/intersection.h"
#include "visibility/solver.h"
#include "visibility/predicate/surrounder.h"
#include "visibility/pairwise/tile_candidates.h"

struct tiles_work {
  struct sheet *sheet; /* what is left after culling */
  const struct solver_request *request;
  const struct occlusion_culling *culling;
  struct tile_classification tiles;
  struct tile_candidates lists;
  uint8_t *wanted;      /* one per tile: its faces are to be listed */
  uint8_t *intersected; /* one per tile: visible intersections are possible;
                           NULL: they are not to be found */
  bool more_wanted;     /* a tile became wanted after the faces were listed */
  ARRAY(uint32_t) edge; /* deferred edges, ascending */
  ARRAY(uint32_t) face; /* deferred triangles, ascending */
  uint8_t *face_state;  /* one per triangle: enum map_state; MAP_MIXED is
                           deferred */
  struct occlusion_counts counts;
  struct report *report;
  double phase_start; /* CPU seconds at the start of the current phase */
};

/* ---- 3, 4. Lists and intersections --------------------------------------- */

/* Marks the tiles in which intersections are searched: visible ones lie in
 * mixed tiles. */
static bool mark_intersected_tiles(struct tiles_work *work) {
  size_t n = triangle_grid_cell_count(&work->tiles.grid);
  work->intersected = mem_alloc(n, 1);
  if (work->intersected == NULL)
    return false;
  for (size_t i = 0; i < n; i++) {
    work->intersected[i] = work->tiles.tile[i].state == TILE_MIXED;
    work->wanted[i] |= work->intersected[i];
  }
  return true;
}

/* Lists the faces of all wanted tiles, in place of the lists made before. */
static bool list_faces(struct tiles_work *work) {
  work->more_wanted = false;
  return tile_candidates_fill(&work->lists, &work->tiles, work->sheet,
                              work->wanted);
}

/* ---- 2. Classifying ------------------------------------------------------ */

/* The state within a tile of an edge or face with depths in these buckets;
 * MAP_MIXED if the tile does not decide it.
 * wire  the edge is not known to lie in a layer of faces: it has no face, or is
 *       an intersection */
static enum map_state state_in_tile(const struct tile *tile, int low, int high,
                                    bool wire) {
  if (tile->state == TILE_MIXED)
    return MAP_MIXED;
  if (tile->state == TILE_EMPTY)
    return MAP_VISIBLE;
  if (wire)
    return high < tile->front - 1 ? MAP_HIDDEN : MAP_MIXED;
  return low >= tile->front ? MAP_VISIBLE : MAP_HIDDEN;
}

/* Visits the tiles that the segment crosses.  Returns the state on which all
 * agree, or MAP_MIXED.
 * mark  marks the tiles as wanted instead */
static enum map_state state_along(struct tiles_work *work, struct geom_point p,
                                  struct geom_point q, bool wire, bool mark) {
  const struct triangle_grid *grid = &work->tiles.grid;
  struct cell_range r = triangle_grid_cells(grid, box2_of_segment(p, q));
  int low = tile_bucket(p.z < q.z ? p.z : q.z),
      high = tile_bucket(p.z > q.z ? p.z : q.z), state = -1;
  for (int y = r.y0; y <= r.y1; y++) {
    int x0, x1;
    triangle_grid_row(grid, p, q, r, y, &x0, &x1);
    for (int x = x0; x <= x1; x++) {
      size_t i = triangle_grid_index(grid, x, y);
      int now = (int)state_in_tile(&work->tiles.tile[i], low, high, wire);
      if (mark) {
        work->more_wanted |= !work->wanted[i];
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

/* The state on which all tiles of a range agree, or MAP_MIXED, from one depth
 * bucket to another. */
static enum map_state state_in_range(const struct tile_classification *tiles,
                                     struct cell_range r, int low, int high,
                                     bool wire) {
  int state = -1;
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t i = (size_t)y * (size_t)tiles->grid.columns + (size_t)x;
      int now = (int)state_in_tile(&tiles->tile[i], low, high, wire);
      if (now == MAP_MIXED || (state >= 0 && state != now))
        return MAP_MIXED;
      state = now;
    }
  return (enum map_state)state;
}

/* The state of an edge.  Usually all tiles of its bounding box agree, so that
 * it need not be traced through them. */
static enum map_state state_of_edge(struct tiles_work *work,
                                    struct geom_point p, struct geom_point q,
                                    bool wire) {
  struct cell_range r =
      triangle_grid_cells(&work->tiles.grid, box2_of_segment(p, q));
  if (r.x1 - r.x0 + r.y1 - r.y0 > 2)
    return state_along(work, p, q, wire, false);
  enum map_state state =
      state_in_range(&work->tiles, r, tile_bucket(p.z < q.z ? p.z : q.z),
                     tile_bucket(p.z > q.z ? p.z : q.z), wire);
  return state == MAP_MIXED && r.x0 < r.x1 && r.y0 < r.y1
             ? state_along(work, p, q, wire, false)
             : state;
}

/* What the ranges of phase 2 have in common. */
struct classification_work {
  struct tiles_work *tiles;
  struct map *map;
  size_t from; /* the first edge */
};

static bool classify_edge_range(void *user, struct parallel_range range) {
  const struct classification_work *work = user;
  const struct sheet *sheet = work->tiles->sheet;
  for (size_t e = work->from + range.begin; e < work->from + range.end; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    if (e + MEM_PREFETCH_AHEAD < sheet->edge.count) {
      MEM_PREFETCH(&sheet->point.item[edge[MEM_PREFETCH_AHEAD].point[0]]);
      MEM_PREFETCH(&sheet->point.item[edge[MEM_PREFETCH_AHEAD].point[1]]);
    }
    struct geom_segment s = sheet_ends(sheet, edge->point);
    bool wire = edge->triangle[0] == SHEET_NONE ||
                edge->edge_class == RECTO_EDGE_INTERSECTION;
    if (!poll_at(e))
      return false;
    if (sheet_edge_is_drawn(sheet, e))
      work->map->edge_state[e] =
          work->from > 0 &&
                  occlusion_culling_hides(work->tiles->culling, s.p, s.q)
              ? MAP_HIDDEN
              : (uint8_t)state_of_edge(work->tiles, s.p, s.q, wire);
  }
  return true;
}

/* Phase 2 for the edges from number `from` on; lists the deferred ones.
 * Returns false when memory ran out. */
static bool classify_edges(struct tiles_work *work, size_t from,
                           struct map *map) {
  const struct sheet *sheet = work->sheet;
  size_t count = sheet->edge.count - from;
  struct classification_work classification = {work, map, from};
  if (!edge_intervals_open_map(map, sheet->edge.count) ||
      !parallel_ranges(parallel_workers(count, PARALLEL_ITEMS), count,
                       PARALLEL_ITEMS, classify_edge_range, &classification))
    return false;
  for (size_t e = from; e < sheet->edge.count; e++) {
    if (map->edge_state[e] != MAP_MIXED)
      continue;
    if (!ARRAY_PUSH(&work->edge, (uint32_t)e))
      return false;
    struct geom_segment s = sheet_ends(sheet, sheet->edge.item[e].point);
    (void)state_along(work, s.p, s.q, false, true);
  }
  return true;
}

/* The state of a triangle: that on which all tiles of its bounding box agree,
 * or MAP_MIXED. */
static enum map_state state_of_face(const struct tiles_work *work, size_t t) {
  struct footprint print = work->tiles.footprint[t];
  return state_in_range(
      &work->tiles, footprint_cells(&work->tiles.grid, work->sheet, t, print),
      print.low, print.high, false);
}

/* Marks the tiles of a triangle's bounding box as wanted, but for those in
 * which it is visible: nothing there occludes it or is in contact with it. */
static void want_face_tiles(struct tiles_work *work, uint32_t t) {
  const struct triangle_grid *grid = &work->tiles.grid;
  struct footprint print = work->tiles.footprint[t];
  struct cell_range r = footprint_cells(grid, work->sheet, t, print);
  for (int y = r.y0; y <= r.y1; y++)
    for (int x = r.x0; x <= r.x1; x++) {
      size_t i = triangle_grid_index(grid, x, y);
      if (state_in_tile(&work->tiles.tile[i], print.low, print.high, false) !=
          MAP_VISIBLE)
        work->wanted[i] = 1;
    }
}

static bool classify_face_range(void *user, struct parallel_range range) {
  struct tiles_work *work = user;
  for (size_t t = range.begin; t < range.end; t++) {
    if (!poll_at(t))
      return false;
    enum map_state state = MAP_MIXED;
    if (sheet_is_edge_on(work->sheet, t))
      state = MAP_HIDDEN;
    else if (sheet_is_filled(work->sheet, t))
      state = state_of_face(work, t);
    work->face_state[t] = (uint8_t)state;
  }
  return true;
}

/* Phase 2 for the faces; lists the deferred ones.  Returns false when memory
 * ran out. */
static bool classify_faces(struct tiles_work *work) {
  size_t n = work->sheet->triangle.count;
  work->face_state = mem_alloc(n, 1);
  if (work->face_state == NULL ||
      !parallel_ranges(parallel_workers(n, PARALLEL_ITEMS), n, PARALLEL_ITEMS,
                       classify_face_range, work))
    return false;
  for (size_t t = 0; t < n; t++) {
    if (work->face_state[t] != MAP_MIXED || !sheet_is_filled(work->sheet, t))
      continue;
    if (!ARRAY_PUSH(&work->face, (uint32_t)t))
      return false;
    want_face_tiles(work, (uint32_t)t);
  }
  return true;
}

/* ---- 5. Pairs ------------------------------------------------------------ */

enum {
  BATCH_SIZE = PARALLEL_RANGE(1024), /* edges */
  POLL_INTERVAL = 16                 /* edges between two polls */
};

/* Batches of consecutive deferred edges, each solved by one thread. */
struct edge_batches {
  const struct tiles_work *work;
  struct edge_query *query; /* one a worker */
  struct map *map;          /* one a batch; all share edge_state */
};

static bool solve_batch(void *user, struct parallel_range range) {
  const struct edge_batches *batches = user;
  const struct tiles_work *work = batches->work;
  struct edge_query *query = &batches->query[range.worker];
  struct map *map = &batches->map[range.begin / BATCH_SIZE];
  struct progress progress = progress_of(work->request, "edges");
  query->recent_count = 0; /* the counts are to be those of any thread */
  for (size_t i = range.begin; i < range.end; i++) {
    progress.share = (double)i / (double)work->edge.count;
    if ((i % POLL_INTERVAL == 0 && !progress_poll(&progress)) ||
        !edge_query_solve(query, work->edge.item[i]) ||
        !edge_intervals_store(&query->intervals, work->edge.item[i], map))
      return false;
  }
  return true;
}

/* Appends the intervals of a batch to the map; batches come in the order of
 * their edges. */
static bool append_batch(struct map *map, const struct map *batch) {
  uint32_t base = (uint32_t)map->interval.count;
  if (!ARRAY_RESERVE(&map->mixed, batch->mixed.count) ||
      !ARRAY_RESERVE(&map->interval, batch->interval.count))
    return false;
  for (size_t i = 0; i < batch->mixed.count; i++) {
    struct map_mixed mixed = batch->mixed.item[i];
    mixed.interval += base;
    map->mixed.item[map->mixed.count++] = mixed;
  }
  for (size_t i = 0; i < batch->interval.count; i++)
    map->interval.item[map->interval.count++] = batch->interval.item[i];
  return true;
}

/* Sorts the deferred edges of a deep scene by the tile of their first end:
 * those that follow one another have occluders in common, which are still in
 * the cache then.  Returns false when memory ran out. */
static bool sort_by_tile(struct tiles_work *work) {
  const struct triangle_grid *grid = &work->tiles.grid;
  const struct sheet *sheet = work->sheet;
  size_t n = work->edge.count;
  struct sort_key *key = mem_alloc(n, 2 * sizeof *key);
  if (key == NULL)
    return false;
  for (size_t i = 0; i < n; i++) {
    const uint32_t *point = sheet->edge.item[work->edge.item[i]].point;
    struct cell_range r =
        triangle_grid_cells(grid, box2_of_segment(sheet->point.item[point[0]],
                                                  sheet->point.item[point[0]]));
    key[i] = (struct sort_key){(uint64_t)r.y0 * (uint64_t)grid->columns +
                                   (uint64_t)r.x0,
                               work->edge.item[i]};
  }
  sort_keys(key, key + n, n);
  for (size_t i = 0; i < n; i++)
    work->edge.item[i] = key[i].value;
  mem_free(key);
  return true;
}

static bool solve_edges_tiles(struct tiles_work *work, struct map *map) {
  bool deep = work->culling->count > 0;
  if (deep && !sort_by_tile(work))
    return false;
  size_t count = parallel_range_count(work->edge.count, BATCH_SIZE);
  int workers = count > 1 ? work->request->threads : 1;
  struct edge_batches batches = {
      work, mem_calloc((size_t)workers, sizeof *batches.query),
      mem_calloc(count, sizeof *batches.map)};
  bool ok = batches.query != NULL && batches.map != NULL;
  for (int k = 0; ok && k < workers; k++)
    ok = edge_query_init(&batches.query[k], work->sheet, &work->lists);
  for (size_t i = 0; ok && i < count; i++)
    batches.map[i].edge_state = map->edge_state;
  ok = ok && parallel_ranges(workers, work->edge.count, BATCH_SIZE, solve_batch,
                             &batches);
  for (size_t i = 0; batches.map != NULL && i < count; i++) {
    ok = ok && append_batch(map, &batches.map[i]);
    batches.map[i].edge_state = NULL;
    map_fini(&batches.map[i]);
  }
  for (int k = 0; batches.query != NULL && k < workers; k++) {
    occlusion_counts_add(&work->counts, &batches.query[k].counts);
    edge_query_fini(&batches.query[k]);
  }
  mem_free(batches.query);
  mem_free(batches.map);
  return ok && (!deep || map_sort_mixed(map));
}

static bool solve_faces(struct tiles_work *work, struct map *map) {
  struct fragments fragments;
  struct deferred_triangles deferred_triangles;
  size_t n = work->sheet->triangle.count;
  struct progress progress = progress_of(work->request, "faces");
  bool ok = fragments_init(&fragments, work->sheet, &work->lists.grid, true);
  ok &= deferred_triangles_init(&deferred_triangles, work->sheet, &work->lists,
                                work->wanted, work->face_state);
  fragments.progress = &progress;
  fragments.report = work->report;
  for (size_t t = 0; ok && t < n; t++)
    if (work->face_state[t] == MAP_VISIBLE)
      ok = poll_at(t) && fragments_add_without_contact(&fragments, (uint32_t)t);
  ok = ok &&
       deferred_triangles_solve(&deferred_triangles, work->face.item,
                                work->face.count, &fragments, &progress) &&
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
  report_count(report, "tiles", "edges_deferred", work->edge.count);
  report_count(report, "tiles", "triangles_deferred", work->face.count);
  occlusion_report(&work->counts, report);
}

/* Reports the CPU time of the phase that ends now. */
static void end_phase(struct tiles_work *work, const char *name) {
  double now = clock_cpu();
  report_double(work->report, "tiles", name, now - work->phase_start);
  work->phase_start = now;
}

/* Phase 4.  Adds the intersections to the edges of the sheet. */
static bool find_intersections(struct tiles_work *work, struct map *map,
                               recto_status *status, recto_error *error) {
  size_t mesh_edges = work->sheet->edge.count;
  *status = intersection_find_all(
      work->sheet, &work->lists.grid,
      work->lists.cells_are_tiles ? work->intersected : NULL, work->request,
      work->report, error);
  if (*status != RECTO_OK ||
      (work->request->edges && !classify_edges(work, mesh_edges, map)))
    return false;
  end_phase(work, "intersections_cpu_s");
  return !work->more_wanted || list_faces(work);
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
  work->wanted = mem_calloc(triangle_grid_cell_count(&work->tiles.grid), 1);
  if (work->wanted == NULL ||
      (request->edges && !classify_edges(work, 0, map)) ||
      (request->fragments && !classify_faces(work)))
    return false;
  end_phase(work, "classes_cpu_s");
  if ((intersections && !mark_intersected_tiles(work)) || !list_faces(work))
    return false;
  end_phase(work, "lists_cpu_s");
  if (intersections && !find_intersections(work, map, status, error))
    return false;
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
  mem_free(work->wanted);
  mem_free(work->intersected);
  mem_free(work->face_state);
  ARRAY_FREE(&work->edge);
  ARRAY_FREE(&work->face);
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
