/* intersection.c - finds the lines in which faces pierce each other. */
#include "visibility/intersection/intersection.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "visibility/intersection/candidate_pairs.h"
#include "visibility/intersection/edge_crossing.h"
#include "visibility/intersection/intersection_segment.h"
#include "visibility/predicate/occlusion.h"
#include "visibility/progress.h"

enum {
  PAIR_WORK = 16, /* cost of a pair in exact numbers, in units of progress.h */
  SEARCH_CELLS = PARALLEL_RANGE(1 << 8) /* that a thread takes at a time */
};

/* The search of one worker. */
struct intersection_search {
  const struct sheet *sheet;
  struct progress progress;
  struct pair_sweep sweep;
  struct intersection_segments segment;
  struct edge_crossings crossings;
  struct occluder occluder; /* that of triangle `prepared` */
  uint32_t prepared;
  struct {
    uint64_t pairs;    /* candidates that no filter rejected */
    uint64_t straddle; /* of these, each reaches the other's plane */
  } counts;
};

/* Triangle f, prepared; consecutive pairs often have f in common. */
static const struct occluder *
prepare_triangle(struct intersection_search *search, uint32_t f) {
  if (search->prepared != f)
    occluder_init(&search->occluder, search->sheet, f);
  search->prepared = f;
  return &search->occluder;
}

/* Decides a candidate pair exactly; either triangle may be SHEET_EDGE_ON. */
static bool decide_pair(void *user, uint32_t f, uint32_t g) {
  struct intersection_search *search = user;
  const struct sheet *sheet = search->sheet;
  const struct occluder *hf;
  struct occluder hg;
  struct corner_counts cf, cg;
  struct intersection_segment segment;
  if (sheet_is_one_face(sheet, f, g))
    return true;
  search->counts.pairs++;
  if (!progress_step(&search->progress, PAIR_WORK))
    return false;
  hf = prepare_triangle(search, f);
  cg = corner_counts_of(hf, sheet_corners(sheet, g).p);
  if (!straddles(cg) && !ends_on_plane(cg))
    return true;
  occluder_init(&hg, sheet, g);
  cf = corner_counts_of(&hg, hf->p);
  if (!straddles(cf) && !ends_on_plane(cf))
    return true;
  if (triangles_coplanar_within_rounding(sheet, f, g, hf, &hg))
    return true;
  search->counts.straddle++;
  if (ends_on_plane(cf))
    return edge_crossings_add(&search->crossings, sheet, f, cf, g, cg);
  if (ends_on_plane(cg))
    return edge_crossings_add(&search->crossings, sheet, g, cg, f, cf);
  if (intersection_segment_find(sheet, f, g, hf, &hg, &segment) &&
      !ARRAY_PUSH(&search->segment.list, segment))
    return false;
  return edge_crossings_add_slanted(&search->crossings, sheet, f, g, &hg) &&
         edge_crossings_add_slanted(&search->crossings, sheet, g, f, hf);
}

/* ---- Edges of the sheet -------------------------------------------------- */

static int compare_segments(const void *a, const void *b, void *user) {
  const struct intersection_segment *s = a, *t = b;
  (void)user;
  for (int k = 0; k < 2; k++)
    if (s->triangle[k] != t->triangle[k])
      return s->triangle[k] < t->triangle[k] ? -1 : 1;
  return 0;
}

static int compare_segment_ends(const struct intersection_segment *s,
                                const struct intersection_segment *t) {
  bool turn_s = geom_compare_points(s->end[0], s->end[1]) > 0,
       turn_t = geom_compare_points(t->end[0], t->end[1]) > 0;
  int order = geom_compare_points(s->end[turn_s], t->end[turn_t]);
  return order != 0 ? order
                    : geom_compare_points(s->end[!turn_s], t->end[!turn_t]);
}

/* Equal are only segments that do not differ. */
static int compare_by_coordinates(const void *a, const void *b, void *user) {
  const struct intersection_segment *s = a, *t = b;
  int order = compare_segment_ends(s, t);
  if (order == 0)
    order = compare_segments(a, b, user);
  return order != 0 ? order : geom_compare_points(s->end[0], t->end[0]);
}

/* Removes duplicate segments, each of which becomes one edge, that of its first
 * pair, and sorts by triangles: so the result does not depend on the order in
 * which the grid's lists and cells gave the pairs. */
static bool unite_segments(struct intersection_segments *segments) {
  struct intersection_segment *item = segments->list.item;
  size_t n = segments->list.count, kept = 0;
  if (!sort_stable(item, n, sizeof *item, compare_by_coordinates, NULL))
    return false;
  for (size_t i = 0; i < n; i++)
    if (kept == 0 || compare_segment_ends(&item[kept - 1], &item[i]) != 0)
      item[kept++] = item[i];
  segments->list.count = kept;
  return sort_stable(item, kept, sizeof *item, compare_segments, NULL);
}

/* An end of a segment. */
struct segment_end {
  struct geom_point point;
  uint32_t segment, end;
};

static int compare_ends(const void *a, const void *b, void *user) {
  (void)user;
  return geom_compare_points(((const struct segment_end *)a)->point,
                             ((const struct segment_end *)b)->point);
}

/* Adds the ends to the sheet's points, equal ones once, and sets the edges'
 * point indices.  Returns false when memory ran out. */
static bool
add_intersection_points(struct sheet *sheet,
                        const struct intersection_segments *segments,
                        struct sheet_edge *edge) {
  size_t n = 2 * segments->list.count;
  struct segment_end *end = mem_alloc(n, sizeof *end);
  bool ok = false;
  if (end == NULL)
    return false;
  for (size_t i = 0; i < n; i++)
    end[i] = (struct segment_end){segments->list.item[i / 2].end[i % 2],
                                  (uint32_t)(i / 2), (uint32_t)(i % 2)};
  if (!sort_stable(end, n, sizeof *end, compare_ends, NULL))
    goto end;
  for (size_t i = 0; i < n; i++) {
    if ((i == 0 || compare_ends(&end[i - 1], &end[i], NULL) != 0) &&
        !ARRAY_PUSH(&sheet->point, end[i].point))
      goto end;
    edge[end[i].segment].point[end[i].end] = (uint32_t)(sheet->point.count - 1);
  }
  ok = true;
end:
  mem_free(end);
  return ok;
}

bool intersection_add_edges(struct sheet *sheet,
                            struct intersection_segments *segments) {
  size_t n;
  struct sheet_edge *edge;
  if (segments->list.count == 0)
    return true;
  if (!unite_segments(segments))
    return false;
  n = segments->list.count;
  if (!ARRAY_RESERVE(&sheet->edge, n))
    return false;
  edge = sheet->edge.item + sheet->edge.count;
  for (size_t i = 0; i < n; i++) {
    const struct intersection_segment *s = &segments->list.item[i];
    edge[i] = (struct sheet_edge){
        .triangle = {s->triangle[0], s->triangle[1]},
        .source = SHEET_NONE,
        .group = sheet->face_group[sheet->triangle.item[s->triangle[0]].face],
        .edge_class = RECTO_EDGE_INTERSECTION};
  }
  if (!add_intersection_points(sheet, segments, edge))
    return false;
  sheet->edge.count += n;
  return true;
}

/* ---- Several workers ----------------------------------------------------- */

static void search_init(struct intersection_search *search,
                        const struct sheet *sheet,
                        const struct triangle_grid *grid, const uint8_t *cells,
                        const struct solver_request *request) {
  *search = (struct intersection_search){
      .sheet = sheet,
      .progress = progress_of(request, "intersections"),
      .prepared = SHEET_NONE};
  search->sweep = (struct pair_sweep){.sheet = sheet,
                                      .grid = grid,
                                      .cells = cells,
                                      .visit = decide_pair,
                                      .user = search,
                                      .progress = &search->progress};
}

static void search_fini(struct intersection_search *search) {
  pair_sweep_fini(&search->sweep);
  ARRAY_FREE(&search->segment.list);
  edge_crossings_fini(&search->crossings);
}

static bool search_cells(void *user, struct parallel_range range) {
  struct intersection_search *search = user;
  return pair_sweep_cells(&search[range.worker].sweep, range.begin, range.end);
}

/* Adds what another worker found.  The order does not matter: segments and
 * crossings are sorted. */
static bool unite_searches(struct intersection_search *search,
                           struct intersection_search *other) {
  search->sweep.met += other->sweep.met;
  search->counts.pairs += other->counts.pairs;
  search->counts.straddle += other->counts.straddle;
  for (size_t i = 0; i < other->segment.list.count; i++)
    if (!ARRAY_PUSH(&search->segment.list, other->segment.list.item[i]))
      return false;
  return edge_crossings_unite(&search->crossings, &other->crossings);
}

static void report_search(const struct intersection_search *search,
                          uint64_t crossings, struct report *report) {
  report_count(report, "intersections", "pairs_tested", search->sweep.met);
  report_count(report, "intersections", "candidate_pairs",
               search->counts.pairs);
  report_count(report, "intersections", "straddling_pairs",
               search->counts.straddle);
  report_count(report, "intersections", "edge_crossings", crossings);
  report_count(report, "intersections", "segments", search->segment.list.count);
}

recto_status intersection_find_all(struct sheet *sheet,
                                   const struct triangle_grid *grid,
                                   const uint8_t *cells,
                                   const struct solver_request *request,
                                   struct report *report, recto_error *error) {
  size_t count = triangle_grid_cell_count(grid);
  int workers = parallel_workers(count, SEARCH_CELLS);
  struct intersection_search *search =
      mem_alloc((size_t)workers, sizeof *search);
  uint64_t crossings = 0;
  if (search == NULL)
    return error_memory(error);
  for (int w = 0; w < workers; w++)
    search_init(&search[w], sheet, grid, cells, request);
  bool ok = parallel_ranges(workers, count, SEARCH_CELLS, search_cells, search);
  for (int w = 1; w < workers; w++) {
    ok = ok && unite_searches(&search[0], &search[w]);
    search_fini(&search[w]);
  }
  ok = ok &&
       edge_crossings_resolve(&search->crossings, sheet, &search->segment,
                              &crossings) &&
       intersection_add_edges(sheet, &search->segment);
  report_search(search, crossings, report);
  search_fini(search);
  mem_free(search);
  return ok ? RECTO_OK : error_memory(error);
}

recto_status intersection_find_everywhere(struct sheet *sheet,
                                          const struct solver_request *request,
                                          struct report *report,
                                          recto_error *error) {
  struct triangle_grid grid;
  if (!request->intersections)
    return RECTO_OK;
  if (!triangle_grid_init(&grid, sheet))
    return error_memory(error);
  recto_status status =
      intersection_find_all(sheet, &grid, NULL, request, report, error);
  triangle_grid_fini(&grid);
  return status;
}
