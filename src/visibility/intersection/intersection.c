/* intersection.c - finds the lines in which faces pierce each other. */
#include "visibility/intersection/intersection.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "visibility/intersection/candidate_pairs.h"
#include "visibility/intersection/edge_crossing.h"
#include "visibility/intersection/intersection_estimate.h"
#include "visibility/intersection/intersection_segment.h"
#include "visibility/intersection/swept_triangle.h"
#include "visibility/predicate/occlusion.h"
#include "visibility/progress.h"

enum {
  PAIR_WORK = 16, /* cost of a pair in exact numbers, in units of progress.h */
  SEARCH_CELLS = PARALLEL_RANGE(1 << 8) /* that a thread takes at a time */
};

/* The search of one worker. */
struct intersection_search {
  const struct sheet *sheet;
  const struct hidden_segments *hidden; /* NULL: nothing is */
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
  char apart[PARALLEL_APART];
};

/* Triangle f, prepared; consecutive pairs often have f in common. */
static const struct occluder *
prepare_triangle(struct intersection_search *search, uint32_t f) {
  if (search->prepared != f)
    occluder_init(&search->occluder, search->sheet, f);
  search->prepared = f;
  return &search->occluder;
}

static bool is_segment_hidden(const struct hidden_segments *hidden,
                              const struct intersection_segment *segment) {
  return hidden != NULL &&
         hidden->hides(hidden->user, segment->end[0], segment->end[1], 0, 0);
}

/* Is the segment that two triangles have in common certainly hidden, or is
 * there none? */
static bool is_estimate_hidden(const struct intersection_search *search,
                               const struct geom_point f[3],
                               const struct geom_point g[3],
                               const struct coarse_plane *cf,
                               const struct coarse_plane *cg) {
  const struct hidden_segments *hidden = search->hidden;
  struct intersection_estimate estimate;
  return hidden != NULL &&
         intersection_estimate_of(&estimate, f, g, cf, cg,
                                  &search->sweep.all) &&
         (estimate.empty ||
          hidden->hides(hidden->user, estimate.end[0], estimate.end[1],
                        estimate.xy_error, estimate.z_error));
}

/* Adds the segment of two triangles none of whose corners is in contact with
 * the other's plane: they pierce each other, unless they are apart. */
static bool add_pierced_segment(struct intersection_search *search,
                                const struct swept_triangle *f,
                                const struct swept_triangle *g) {
  const struct sheet *sheet = search->sheet;
  struct intersection_segment segment;
  search->counts.straddle++;
  if (is_estimate_hidden(search, f->corners.p, g->corners.p, &f->coarse_plane,
                         &g->coarse_plane))
    return true;
  const struct triangle_plane pf = triangle_plane_of(sheet, f->triangle),
                              pg = triangle_plane_of(sheet, g->triangle);
  if (!intersection_segment_of_planes(sheet, f->triangle, g->triangle, &pf, &pg,
                                      &segment) ||
      is_segment_hidden(search->hidden, &segment))
    return true;
  if (!triangles_are_off_plane(pf.p, pg.p, &f->coarse_plane,
                               &g->coarse_plane)) {
    const struct occluder *hf = prepare_triangle(search, f->triangle);
    struct occluder hg;
    occluder_init(&hg, sheet, g->triangle);
    if (triangles_coplanar_within_rounding(sheet, f->triangle, g->triangle, hf,
                                           &hg))
      return true;
  }
  return ARRAY_PUSH(&search->segment.list, segment);
}

/* Decides a candidate pair exactly of which that is not certain. */
static bool decide_contact(struct intersection_search *search, uint32_t f,
                           uint32_t g) {
  const struct sheet *sheet = search->sheet;
  const struct occluder *hf = prepare_triangle(search, f);
  const struct geom_triangle pg = sheet_corners(sheet, g);
  struct occluder hg;
  struct corner_counts cf, cg = corner_counts_of(hf, pg.p);
  struct intersection_segment segment;
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
      !is_segment_hidden(search->hidden, &segment) &&
      !ARRAY_PUSH(&search->segment.list, segment))
    return false;
  return edge_crossings_add_slanted(&search->crossings, sheet, f, g, &hg) &&
         edge_crossings_add_slanted(&search->crossings, sheet, g, f, hf);
}

/* Decides a candidate pair exactly; either triangle may be SHEET_EDGE_ON. */
static bool decide_pair(void *user, const struct swept_triangle *f,
                        const struct swept_triangle *g, bool straddle) {
  struct intersection_search *search = user;
  if (sheet_is_one_face(search->sheet, f->triangle, g->triangle))
    return true;
  search->counts.pairs++;
  if (!progress_step(&search->progress, PAIR_WORK))
    return false;
  return straddle ? add_pierced_segment(search, f, g)
                  : decide_contact(search, f->triangle, g->triangle);
}

/* ---- Edges of the sheet -------------------------------------------------- */

/* A key that orders points by x, then by y. */
static uint64_t key_of_point(struct geom_point p) {
  return (uint64_t)((uint32_t)p.x ^ UINT32_C(1) << 31) << 32 |
         ((uint32_t)p.y ^ UINT32_C(1) << 31);
}

/* Sorts by key, and items of equal keys by what compare, of two sort_key, finds
 * to differ in what they stand for.  Returns false when memory ran out. */
static bool sort_keys_further(struct sort_key *key, size_t n,
                              int (*compare)(const void *, const void *,
                                             void *),
                              void *user) {
  if (!sort_keys_alone(key, n))
    return false;
  for (size_t i = 0, end; i < n; i = end) {
    bool in_order = true;
    for (end = i + 1; end < n && key[end].key == key[i].key; end++)
      in_order = in_order && compare(&key[end - 1], &key[end], user) <= 0;
    if (!in_order && !sort_stable(key + i, end - i, sizeof *key, compare, user))
      return false;
  }
  return true;
}

static int compare_segment_ends(const struct intersection_segment *s,
                                const struct intersection_segment *t) {
  bool turn_s = geom_compare_points(s->end[0], s->end[1]) > 0,
       turn_t = geom_compare_points(t->end[0], t->end[1]) > 0;
  int order = geom_compare_points(s->end[turn_s], t->end[turn_t]);
  return order != 0 ? order
                    : geom_compare_points(s->end[!turn_s], t->end[!turn_t]);
}

/* Segments, and their numbers in order, as values. */
struct segment_order {
  const struct intersection_segment *item;
  struct sort_key *key;
};

/* Keys of segments; equal are only segments that do not differ. */
static int compare_by_coordinates(const void *a, const void *b, void *user) {
  const struct segment_order *order_of = user;
  const struct intersection_segment
      *s = &order_of->item[((const struct sort_key *)a)->value],
      *t = &order_of->item[((const struct sort_key *)b)->value];
  int order = compare_segment_ends(s, t);
  for (int k = 0; k < 2 && order == 0; k++)
    order = compare_numbers(s->triangle[k], t->triangle[k]);
  return order != 0 ? order : geom_compare_points(s->end[0], t->end[0]);
}

/* Orders `count` segments by their triangles, without duplicates, each of which
 * is to be one edge, that of its first pair: so the result does not depend on
 * the order in which the grid's lists and cells gave the pairs.
 * count  gets how many are left
 * Returns false when memory ran out. */
static bool unite_segments(struct segment_order *segments, size_t *count) {
  const struct intersection_segment *item = segments->item;
  struct sort_key *order = segments->key;
  size_t n = *count, kept = 0;
  for (size_t i = 0; i < n; i++) {
    const struct geom_point *end = item[i].end;
    bool turn = geom_compare_points(end[0], end[1]) > 0;
    order[i] = (struct sort_key){key_of_point(end[turn]), (uint32_t)i};
  }
  if (!sort_keys_further(order, n, compare_by_coordinates, segments))
    return false;
  for (size_t i = 0; i < n; i++)
    if (kept == 0 || compare_segment_ends(&item[order[kept - 1].value],
                                          &item[order[i].value]) != 0)
      order[kept++] = order[i];
  for (size_t i = 0; i < kept; i++) {
    const uint32_t *triangle = item[order[i].value].triangle;
    order[i].key = (uint64_t)triangle[0] << 32 | triangle[1];
  }
  *count = kept;
  return sort_keys_alone(order, kept);
}

/* The point of an end, whose number is twice that of its segment in the order,
 * plus 0 or 1. */
static struct geom_point point_of_segment_end(const struct segment_order *order,
                                              size_t end) {
  return order->item[order->key[end / 2].value].end[end % 2];
}

/* Keys of ends. */
static int compare_ends(const void *a, const void *b, void *user) {
  const struct sort_key *p = a, *q = b;
  return geom_compare_points(point_of_segment_end(user, p->value),
                             point_of_segment_end(user, q->value));
}

/* Adds the ends of `count` edges to the sheet's points, equal ones once, and
 * sets the edges' point indices.  Returns false when memory ran out. */
static bool add_intersection_points(struct sheet *sheet,
                                    struct segment_order *order, size_t count,
                                    struct sheet_edge *edge) {
  size_t n = 2 * count;
  struct sort_key *end = mem_alloc(n, sizeof *end);
  bool ok = end != NULL;
  for (size_t i = 0; ok && i < n; i++)
    end[i] = (struct sort_key){key_of_point(point_of_segment_end(order, i)),
                               (uint32_t)i};
  ok = ok && sort_keys_further(end, n, compare_ends, order);
  for (size_t i = 0; ok && i < n; i++) {
    if (i == 0 || compare_ends(&end[i - 1], &end[i], order) != 0)
      ok = ARRAY_PUSH(&sheet->point, point_of_segment_end(order, end[i].value));
    edge[end[i].value / 2].point[end[i].value % 2] =
        (uint32_t)(sheet->point.count - 1);
  }
  mem_free(end);
  return ok;
}

/* Returns false when memory ran out. */
static bool add_edges_in_order(struct sheet *sheet, struct segment_order *order,
                               size_t n) {
  if (!unite_segments(order, &n) || !ARRAY_RESERVE(&sheet->edge, n))
    return false;
  struct sheet_edge *edge = sheet->edge.item + sheet->edge.count;
  for (size_t i = 0; i < n; i++) {
    const struct intersection_segment *s = &order->item[order->key[i].value];
    edge[i] = (struct sheet_edge){.triangle = {s->triangle[0], s->triangle[1]},
                                  .source = SHEET_NONE,
                                  .edge_class = RECTO_EDGE_INTERSECTION};
  }
  if (!add_intersection_points(sheet, order, n, edge))
    return false;
  sheet->edge.count += n;
  return true;
}

bool intersection_add_edges(struct sheet *sheet,
                            const struct intersection_segments *segments) {
  size_t n = segments->list.count;
  struct segment_order order = {segments->list.item,
                                mem_alloc(n, sizeof *order.key)};
  bool ok =
      order.key != NULL && (n == 0 || add_edges_in_order(sheet, &order, n));
  mem_free(order.key);
  return ok;
}

/* ---- Several workers ----------------------------------------------------- */

static void search_init(struct intersection_search *search,
                        const struct sheet *sheet,
                        const struct triangle_grid *grid, const uint8_t *cells,
                        const struct hidden_segments *hidden,
                        const struct solver_request *request) {
  *search = (struct intersection_search){
      .sheet = sheet,
      .hidden = hidden,
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
                          uint64_t crossings, size_t segments,
                          struct report *report) {
  report_count(report, "intersections", "pairs_tested", search->sweep.met);
  report_count(report, "intersections", "candidate_pairs",
               search->counts.pairs);
  report_count(report, "intersections", "straddling_pairs",
               search->counts.straddle);
  report_count(report, "intersections", "edge_crossings", crossings);
  report_count(report, "intersections", "segments", segments);
}

recto_status intersection_find_visible(
    struct sheet *sheet, const struct triangle_grid *grid, const uint8_t *cells,
    const struct hidden_segments *hidden, const struct solver_request *request,
    struct report *report, recto_error *error) {
  size_t count = triangle_grid_cell_count(grid);
  int workers = parallel_workers(count, SEARCH_CELLS);
  struct intersection_search *search =
      mem_alloc((size_t)workers, sizeof *search);
  size_t edges = sheet->edge.count;
  uint64_t crossings = 0;
  if (search == NULL)
    return error_memory(error);
  for (int w = 0; w < workers; w++)
    search_init(&search[w], sheet, grid, cells, hidden, request);
  bool ok = parallel_ranges(workers, count, SEARCH_CELLS, search_cells, search);
  for (int w = 1; w < workers; w++) {
    ok = ok && unite_searches(&search[0], &search[w]);
    search_fini(&search[w]);
  }
  ok = ok &&
       edge_crossings_resolve(&search->crossings, sheet, &search->segment,
                              &crossings) &&
       intersection_add_edges(sheet, &search->segment);
  report_search(search, crossings, sheet->edge.count - edges, report);
  search_fini(search);
  mem_free(search);
  return ok ? RECTO_OK : error_memory(error);
}

recto_status intersection_find_all(struct sheet *sheet,
                                   const struct triangle_grid *grid,
                                   const uint8_t *cells,
                                   const struct solver_request *request,
                                   struct report *report, recto_error *error) {
  return intersection_find_visible(sheet, grid, cells, NULL, request, report,
                                   error);
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
