/* edge_query.c - finds the occluded intervals of an edge from the candidate
 * lists of page tiles. */
#include "visibility/pairwise/edge_query.h"

#include <string.h>

bool edge_query_init(struct edge_query *query, const struct sheet *sheet,
                     const struct tile_candidates *lists,
                     const struct occlusion_culling *culling) {
  memset(query, 0, sizeof *query);
  query->sheet = sheet;
  query->lists = lists;
  query->culling = culling != NULL && culling->culled != NULL ? culling : NULL;
  return triangle_grid_query_init(&query->found, &lists->grid) &&
         (lists->occluder != NULL || plane_cache_init(&query->planes, sheet));
}

void edge_query_fini(struct edge_query *query) {
  plane_cache_fini(&query->planes);
  edge_intervals_fini(&query->intervals);
  triangle_grid_query_fini(&query->found);
}

/* The number at parameter t of an edge, rounded: off by less than one, as its
 * magnitude is at most 2^40.  Exact at 0. */
static inline int64_t number_of_edge(double t, int64_t p, int64_t q) {
  double more = t * (double)(q - p);
  return p + (int64_t)(more < 0 ? more - 0.5 : more + 0.5);
}

/* The point of the edge at parameter t, each coordinate rounded. */
static inline struct geom_point point_of_edge(const struct edge_query *query,
                                              double t) {
  return (struct geom_point){(int32_t)number_of_edge(t, query->p.x, query->q.x),
                             (int32_t)number_of_edge(t, query->p.y, query->q.y),
                             number_of_edge(t, query->p.z, query->q.z)};
}

/* Shrinks the remaining part of the edge to what is not known to be hidden, if
 * that makes it shorter by a quarter at least.  The 8-DOP is enlarged, because
 * the new ends are rounded by less than a unit. */
static void shrink_rest(struct edge_query *query) {
  struct occluded_interval rest = edge_intervals_remaining(&query->intervals);
  if (rest.from.num == query->rest.from.num &&
      rest.to.num == query->rest.to.num)
    return; /* the same interval, or practically the same */
  query->rest = rest;
  double from = ratio_to_double(rest.from), to = ratio_to_double(rest.to);
  if (!(to - from < 0.75 * query->share))
    return;
  query->share = to - from;
  query->from = from;
  query->to = to;
  query->end[0] = point_of_edge(query, from);
  query->end[1] = point_of_edge(query, to);
  query->kdop = kdop8_of_point(query->end[0]);
  kdop8_add(&query->kdop, query->end[1]);
  for (int k = 0; k < 4; k++) {
    query->kdop.least[k] -= 2;
    query->kdop.most[k] += 2;
  }
  query->kdop.low--;
}

/* Computes the interval of the edge that triangle t occludes; returns whether
 * there is one. */
static bool occlude_by_triangle(struct edge_query *query, uint32_t t,
                                struct occluded_interval *part) {
  const struct occluder *occluder = query->lists->occluder;
  if (occluder == NULL)
    return occlude_edge_by_cached(&query->planes, t, query->p, query->q, part,
                                  &query->counts);
  return !sheet_is_edge_on(query->sheet, t) &&
         occlude_edge(&occluder[t], query->p, query->q, part, &query->counts);
}

/* Puts triangle t before the other recent ones. */
static void remember(struct edge_query *query, uint32_t t) {
  size_t k = 0;
  while (k < query->recent_count && query->recent[k] != t)
    k++;
  if (k == EDGE_QUERY_RECENT)
    k--;
  else if (k == query->recent_count)
    query->recent_count++;
  memmove(query->recent + 1, query->recent, k * sizeof *query->recent);
  query->recent[0] = t;
}

/* Tests triangle t, which may overlap the edge, and adds what it occludes. */
static bool add_triangle_occlusion(struct edge_query *query, uint32_t t) {
  struct occluded_interval part;
  if (occlusion_is_own(query->sheet, query->edge, t) ||
      (query->several_cells && !triangle_grid_query_first(&query->found, t)) ||
      !occlude_by_triangle(query, t, &part))
    return true;
  if (!edge_intervals_occlude(&query->intervals, part))
    return false;
  double before = query->share;
  if (part.sides == OCCLUDED_BOTH && !query->intervals.occluded)
    shrink_rest(query);
  if (query->tried_recent &&
      (query->intervals.occluded || query->share < before))
    remember(query, t);
  return true;
}

/* Tests the recent triangles, once for an edge. */
static bool test_recent(struct edge_query *query) {
  uint32_t recent[EDGE_QUERY_RECENT];
  size_t n = query->recent_count;
  if (query->tried_recent)
    return true;
  query->tried_recent = true;
  memcpy(recent, query->recent, n * sizeof *recent);
  for (size_t k = 0; k < n && !query->intervals.occluded; k++)
    if (!add_triangle_occlusion(query, recent[k]))
      return false;
  return true;
}

/* The current cell, and the 8-DOP query of the edge relative to it. */
struct cell_query {
  size_t cell;
  struct kdop8_range range;
  uint64_t kdop_query;
  double share; /* that of the edge when the query was computed */
};

/* Computes the 8-DOP query anew if the edge was shortened. */
static inline void update_kdop_query(struct cell_query *at,
                                     const struct edge_query *query) {
  if (at->share == query->share)
    return;
  at->share = query->share;
  at->kdop_query = kdop8_query(&at->range, &query->kdop);
}

/* Sets the query of a tree to what is left of the edge. */
static void update_bvh_query(struct bvh_query *at, const struct bvh *bvh,
                             const struct edge_query *query) {
  bvh_query_set(at, bvh, (struct geom_segment){query->p, query->q}, query->end,
                query->from, query->to);
}

/* Tests the triangles of a cell whose list has a BVH. */
static bool test_bvh(struct edge_query *query, const struct bvh *bvh,
                     struct cell_query *at) {
  const struct triangle_grid *grid = &query->lists->grid;
  uint32_t start = grid->lists.start[at->cell];
  struct bvh_traversal traversal = bvh_traversal_start();
  struct bvh_query shape;
  size_t i, end;
  if (!test_recent(query))
    return false;
  update_kdop_query(at, query);
  update_bvh_query(&shape, bvh, query);
  while (!query->intervals.occluded &&
         bvh_next(bvh, &traversal, &shape, &i, &end)) {
    double before = query->share;
    for (; i < end && !query->intervals.occluded; i++) {
      if (!kdop8_overlaps(query->lists->key[start + i], at->kdop_query))
        continue;
      if (!add_triangle_occlusion(query, grid->lists.item[start + i]))
        return false;
      update_kdop_query(at, query);
    }
    if (query->share != before)
      update_bvh_query(&shape, bvh, query);
  }
  return true;
}

/* How many entries of a list are compared before one is tested: few at first,
 * as those are the nearest and may hide all of the edge, then twice as many
 * each time. */
enum { ENTRIES_AT_FIRST = 4, ENTRIES_AT_ONCE = 32 };

/* Gathers the entries from `from` to before `end` whose 8-DOPs overlap that of
 * the edge, without a jump for each, as no processor predicts which do.
 * end     gets where entries begin that are behind the edge, if any do
 * Returns how many there are. */
static inline size_t gather_overlapping(const uint64_t *key,
                                        uint64_t kdop_query, uint32_t from,
                                        uint32_t *end,
                                        uint32_t found[ENTRIES_AT_ONCE]) {
  size_t count = 0;
  for (uint32_t i = from; i < *end; i++) {
    uint64_t lanes = kdop8_compare(key[i], kdop_query);
    if (kdop8_is_behind(lanes)) {
      *end = i;
      break;
    }
    found[count] = i;
    count += lanes == KDOP8_GUARDS;
  }
  return count;
}

/* Drops the entries whose projections certainly do not overlap the edge, and
 * its own triangles, without a jump for each: most triangles that are near an
 * edge have a corner in common with it, and nothing more.
 * item  the triangles of the list
 * Returns how many are left. */
static inline size_t drop_beside(struct edge_query *query, const uint32_t *item,
                                 uint32_t found[ENTRIES_AT_ONCE], size_t n) {
  const struct sheet_triangle *triangle = query->sheet->triangle.item;
  const struct geom_point *point = query->sheet->point.item, p = query->p,
                          q = query->q;
  uint32_t first = query->edge->triangle[0], second = query->edge->triangle[1];
  size_t count = 0;
  for (size_t k = 0; k < n; k++) {
    uint32_t i = found[k], t = item[i];
    const uint32_t *corner = triangle[t].point;
    bool is_beside = occlusion_is_beside(&point[corner[0]], &point[corner[1]],
                                         &point[corner[2]], p, q);
    found[count] = i;
    count += !is_beside & (t != first) & (t != second);
    query->counts.pairs += is_beside;
  }
  return count;
}

/* Tests the triangles listed in a cell whose 8-DOPs overlap that of the
 * edge. */
static bool test_cell(struct edge_query *query, int x, int y) {
  const struct tile_candidates *list = query->lists;
  size_t cell = (size_t)y * (size_t)list->grid.columns + (size_t)x;
  uint32_t i = list->grid.lists.start[cell],
           end = list->grid.lists.start[cell + 1];
  struct cell_query at = {.cell = cell, .share = -1};
  if (i == end)
    return true;
  at.range = tile_candidates_range(list, x, y);
  update_kdop_query(&at, query);
  const struct bvh *bvh = tile_candidates_bvh(list, cell);
  if (bvh != NULL)
    return test_bvh(query, bvh, &at);
  for (uint32_t entries = ENTRIES_AT_FIRST;
       i < end && !query->intervals.occluded;
       entries = entries < ENTRIES_AT_ONCE ? 2 * entries : ENTRIES_AT_ONCE) {
    uint32_t found[ENTRIES_AT_ONCE],
        last = end - i > entries ? i + entries : end, past = last;
    size_t n = gather_overlapping(list->key, at.kdop_query, i, &past, found);
    if (list->occluder == NULL)
      n = drop_beside(query, list->grid.lists.item, found, n);
    for (size_t k = 0; k < n && !query->intervals.occluded; k++) {
      if (!kdop8_overlaps(list->key[found[k]], at.kdop_query))
        continue; /* the edge was shortened */
      if (!add_triangle_occlusion(query, list->grid.lists.item[found[k]]))
        return false;
      update_kdop_query(&at, query);
    }
    if (past < last)
      return true; /* all that follow are behind the edge */
    i = last;
  }
  return true;
}

/* Adds the intervals at either end of the edge that the occlusion buffer
 * hides. */
static bool occlude_by_buffer(struct edge_query *query) {
  struct segment_part rest =
      occlusion_culling_rest(query->culling, query->p, query->q);
  if (rest.from >= rest.to)
    rest.to = rest.from = OCCLUSION_PARTS;
  const struct occluded_interval first = {ratio_of(0, 1),
                                          ratio_of(rest.from, OCCLUSION_PARTS),
                                          OCCLUDED_BOTH},
                                 last = {ratio_of(rest.to, OCCLUSION_PARTS),
                                         ratio_of(1, 1), OCCLUDED_BOTH};
  if ((rest.from > 0 && !edge_intervals_occlude(&query->intervals, first)) ||
      (rest.to < OCCLUSION_PARTS &&
       !edge_intervals_occlude(&query->intervals, last)))
    return false;
  if (!query->intervals.occluded)
    shrink_rest(query);
  return true;
}

/* Begins with edge e, all of which remains. */
static bool begin_edge(struct edge_query *query, uint32_t e) {
  const struct sheet_edge *edge = &query->sheet->edge.item[e];
  query->edge = edge;
  query->p = query->sheet->point.item[edge->point[0]];
  query->q = query->sheet->point.item[edge->point[1]];
  query->kdop = kdop8_of_point(query->p);
  kdop8_add(&query->kdop, query->q);
  edge_intervals_start(&query->intervals);
  query->rest = edge_intervals_remaining(&query->intervals);
  query->share = 1;
  query->from = 0;
  query->to = 1;
  query->tried_recent = false;
  query->end[0] = query->p;
  query->end[1] = query->q;
  return query->culling == NULL || occlude_by_buffer(query);
}

/* The cells in which the remaining part of the edge is, whose ends are
 * rounded. */
static struct cell_range cells_of_rest(const struct edge_query *query) {
  struct box2 box = box2_of_segment(query->end[0], query->end[1]);
  int rounding = query->share < 1 ? 1 : 0;
  return triangle_grid_cells(
      &query->lists->grid, (struct box2){box.x0 - rounding, box.y0 - rounding,
                                         box.x1 + rounding, box.y1 + rounding});
}

bool edge_query_solve(struct edge_query *query, uint32_t e) {
  const struct triangle_grid *grid = &query->lists->grid;
  if (!begin_edge(query, e))
    return false;
  struct cell_range r = cells_of_rest(query);
  query->several_cells = r.x0 < r.x1 || r.y0 < r.y1;
  if (query->several_cells)
    triangle_grid_query_start(grid, &query->found);
  for (int y = r.y0; y <= r.y1 && !query->intervals.occluded; y++) {
    int x0, x1;
    triangle_grid_row(grid, query->p, query->q, r, y, &x0, &x1);
    for (int x = x0; x <= x1 && !query->intervals.occluded; x++)
      if (!test_cell(query, x, y))
        return false;
  }
  return true;
}
