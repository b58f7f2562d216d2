/* newell.c - the painter's algorithm of Newell, Newell and Sancha, for pens.
 *
 * Pens cannot overpaint.  Faces are put in painting order (newell_order.h), and
 * each keeps what no later one occludes.
 *
 * Edges.  Of two faces that overlap, the one painted first hides nothing of
 * the other.  An edge is therefore tested only against faces that are painted
 * after its own, with two exceptions that the order does not decide: an edge
 * along the side of a face, as it does not overlap that face; and an
 * intersection, as its rounded ends may lie beside its faces.
 *
 * Triangles without an order.  Their edges, their visible pieces and all
 * intersections are solved by pairwise_fallback.h.  They are subtracted from
 * other triangles where their plane is nearer.
 *
 * Source  [Newell1972].
 */
#include "visibility/fragments/occluder_subtraction.h"
#include "visibility/intersection/intersection.h"
#include "visibility/newell/newell_order.h"
#include "visibility/newell/painter.h"
#include "visibility/pairwise/pairwise_fallback.h"
#include "visibility/predicate/edge_intervals.h"
#include "visibility/solver.h"

/* ---- Edges --------------------------------------------------------------- */

struct edge_work {
  const struct sheet *sheet;
  const struct newell_order *order;
  struct triangle_grid_query query;
  struct edge_intervals intervals;
  struct occlusion_counts counts;
  uint64_t by_order; /* pairs that the order decided */
  struct progress *progress;
  struct pairwise_fallback *fallback; /* NULL: all triangles are ordered */
};

/* The rank of the edge's own triangle if it was painted as a whole; otherwise
 * 0, also for an intersection, whose rounded ends may lie beside its faces. */
static uint32_t rank_of_edge(const struct edge_work *work,
                             const struct sheet_edge *edge) {
  uint32_t t = edge->triangle[0];
  if (t == SHEET_NONE || edge->edge_class == RECTO_EDGE_INTERSECTION ||
      work->order->piece.item[t].state != NEWELL_PAINTED)
    return 0;
  return work->order->piece.item[t].rank;
}

/* Returns whether segment pq is collinear with a side of the triangle. */
static bool is_along_side(const struct sheet *sheet, uint32_t triangle,
                          struct geom_point p, struct geom_point q) {
  struct geom_triangle corner = sheet_corners(sheet, triangle);
  for (int k = 0; k < 3; k++) {
    struct geom_point a = corner.p[k], b = corner.p[geom_next_corner(k)];
    if (geom_orient2d(a, b, p) == 0 && geom_orient2d(a, b, q) == 0)
      return true;
  }
  return false;
}

/* Computes the occluded intervals of an edge. */
static bool occlude_newell_edge(struct edge_work *work,
                                const struct sheet_edge *edge,
                                struct geom_point p, struct geom_point q) {
  const struct sheet *sheet = work->sheet;
  const struct newell_piece *piece = work->order->piece.item;
  uint32_t rank = rank_of_edge(work, edge);
  struct box2 box = box2_of_segment(p, q);
  edge_intervals_start(&work->intervals);
  if (!triangle_grid_find_along(work->order->grid, p, q, &work->query))
    return false;
  for (size_t i = 0; i < work->query.found.count && !work->intervals.occluded;
       i++) {
    uint32_t t = work->query.found.item[i];
    struct occluded_interval part;
    if (occlusion_is_own(sheet, edge, t) ||
        !occlusion_is_possible(sheet, t, p, q, box))
      continue;
    if (piece[t].state == NEWELL_PAINTED && piece[t].rank < rank &&
        !is_along_side(sheet, t, p, q)) {
      work->by_order++;
      continue;
    }
    if (occlude_edge_by_triangle(sheet, t, p, q, &part, &work->counts) &&
        !edge_intervals_occlude(&work->intervals, part))
      return false;
  }
  return true;
}

/* Returns whether the edge is left to the fallback: there are triangles without
 * an order, and it belongs to one of them or is an intersection. */
static bool needs_fallback(const struct edge_work *work,
                           const struct sheet_edge *edge) {
  uint32_t t = edge->triangle[0];
  return work->fallback != NULL &&
         (edge->edge_class == RECTO_EDGE_INTERSECTION ||
          (t != SHEET_NONE && newell_is_deferred(work->order, t)));
}

/* The occluded intervals of edge e; NULL when memory ran out or the caller
 * cancelled. */
static struct edge_intervals *intervals_of(struct edge_work *work, uint32_t e) {
  const struct sheet_edge *edge = &work->sheet->edge.item[e];
  struct geom_segment s = sheet_ends(work->sheet, edge->point);
  if (needs_fallback(work, edge))
    return pairwise_fallback_edge(work->fallback, e);
  return occlude_newell_edge(work, edge, s.p, s.q) &&
                 progress_step(work->progress, work->query.found.count)
             ? &work->intervals
             : NULL;
}

static bool solve_edges_newell(const struct sheet *sheet,
                               struct newell_order *order,
                               struct pairwise_fallback *fallback,
                               struct map *map, struct report *report) {
  struct edge_work work = {.sheet = sheet,
                           .order = order,
                           .progress = &order->progress,
                           .fallback =
                               order->counts.deferred > 0 ? fallback : NULL};
  bool ok = triangle_grid_query_init(&work.query, order->grid) &&
            edge_intervals_open_map(map, sheet->edge.count);
  for (size_t e = 0; ok && e < sheet->edge.count; e++) {
    if (!sheet_edge_is_drawn(sheet, e))
      continue;
    work.progress->share = (double)e / (double)sheet->edge.count;
    struct edge_intervals *intervals = intervals_of(&work, (uint32_t)e);
    ok = intervals != NULL && edge_intervals_store(intervals, (uint32_t)e, map);
  }
  occlusion_report(&work.counts, report);
  report_count(report, "newell", "pairs_decided_by_order", work.by_order);
  edge_intervals_fini(&work.intervals);
  triangle_grid_query_fini(&work.query);
  return ok;
}

/* ---- Fragments ----------------------------------------------------------- */

/* Subtracts from piece p all pieces that are painted after it, and triangles
 * without an order where they are nearer. */
static bool subtract_later_pieces(struct newell_order *order, uint32_t p,
                                  struct triangle_grid_query *query,
                                  struct occluder_subtraction *subtraction) {
  const struct newell_piece *piece = &order->piece.item[p];
  if (!triangle_grid_find_overlapping(order->grid, piece->triangle, query))
    return false;
  for (size_t i = 0;
       i < query->found.count && !occluder_subtraction_is_empty(subtraction);
       i++) {
    uint32_t q = query->found.item[i];
    if (q == piece->triangle)
      continue;
    if (newell_is_deferred(order, q)) {
      if (!progress_step(&order->progress, 1 + subtraction->left.count) ||
          !occluder_subtraction_subtract_nearer(subtraction, q))
        return false;
      continue;
    }
    for (; q != NEWELL_NONE; q = order->piece.item[q].next) {
      const struct newell_piece *other = &order->piece.item[q];
      if (!progress_step(&order->progress, 1 + subtraction->left.count))
        return false;
      if (other->state != NEWELL_PAINTED || other->rank < piece->rank ||
          box2_disjoint(piece->box, other->box))
        continue;
      struct triangle_occluder occluder = {.triangle = other->triangle,
                                           .box = other->box};
      occluder.line =
          newell_piece_lines(order, q, &occluder.sides, &subtraction->arena);
      if (occluder.line == NULL ||
          !occluder_subtraction_subtract(subtraction, &occluder))
        return false;
    }
  }
  return true;
}

/* Adds the visible pieces of the triangles without an order. */
static bool store_unordered(struct newell_order *order,
                            struct pairwise_fallback *fallback,
                            struct fragments *fragments) {
  ARRAY(uint32_t) list = {0};
  bool ok = true;
  for (uint32_t t = 0; ok && t < order->sheet->triangle.count; t++)
    if (newell_is_deferred(order, t))
      ok = ARRAY_PUSH(&list, t);
  ok = ok &&
       (list.count == 0 ||
        pairwise_fallback_faces(fallback, list.item, list.count, fragments));
  ARRAY_FREE(&list);
  return ok;
}

static bool solve_fragments_newell(struct newell_order *order,
                                   struct pairwise_fallback *fallback,
                                   struct map *map, struct report *report) {
  struct fragments fragments;
  struct triangle_grid_query query = {0};
  struct occluder_subtraction subtraction;
  bool ok;
  occluder_subtraction_init(&subtraction, order->sheet);
  ok = fragments_init(&fragments, order->sheet, order->grid, true) &&
       triangle_grid_query_init(&query, order->grid);
  fragments.progress = &order->progress;
  fragments.report = report;
  for (size_t i = order->painted.count; ok && i-- > 0;) {
    uint32_t p = order->painted.item[i];
    const struct newell_piece *piece = &order->piece.item[p];
    if (newell_is_deferred(order, piece->triangle))
      continue;
    ok = occluder_subtraction_start(&subtraction, piece->triangle,
                                    piece->shape) &&
         subtract_later_pieces(order, p, &query, &subtraction) &&
         occluder_subtraction_store(&subtraction, &fragments);
  }
  ok = ok && store_unordered(order, fallback, &fragments) &&
       fragments_finish(&fragments, map);
  occluder_subtraction_fini(&subtraction);
  triangle_grid_query_fini(&query);
  fragments_fini(&fragments);
  return ok;
}

/* ---- The solver ---------------------------------------------------------- */

static void report_order(const struct newell_order *order,
                         struct report *report) {
  const struct newell_counts *c = &order->counts;
  report_count(report, "newell", "decided_by_depth", c->depth);
  report_count(report, "newell", "decided_by_test_a", c->minimax);
  report_count(report, "newell", "decided_by_test_b", c->behind);
  report_count(report, "newell", "decided_by_test_c", c->before);
  report_count(report, "newell", "decided_by_test_d", c->full);
  report_count(report, "newell", "moved", c->moved);
  report_count(report, "newell", "cycles", c->cycles);
  report_count(report, "newell", "splits_by_cycle", c->split_cycle);
  report_count(report, "newell", "splits_by_intersection",
               c->split_intersection);
  report_count(report, "newell", "without_order", c->deferred);
  report_count(report, "newell", "pieces", order->painted.count);
}

/* Fills the map, given the order. */
static bool solve_in_order(struct newell_order *order, struct sheet *sheet,
                           const struct solver_request *request,
                           struct map *map, struct report *report) {
  struct pairwise_fallback fallback = {0};
  bool ok = order->counts.deferred == 0 ||
            pairwise_fallback_init(&fallback, sheet, request->fragments,
                                   &order->progress);
  order->progress.stage = "edges";
  ok = ok && (!request->edges ||
              solve_edges_newell(sheet, order, &fallback, map, report));
  order->progress.stage = "faces";
  ok = ok && (!request->fragments ||
              solve_fragments_newell(order, &fallback, map, report));
  pairwise_fallback_fini(&fallback);
  return ok;
}

/* By some of the tests, without splitting: whole triangles in the order that
 * these give. */
static recto_status solve_without_splitting(
    const struct newell_order *order, const struct sheet *sheet,
    const struct solver_request *request, struct map *map, recto_error *error) {
  size_t n = sheet->triangle.count;
  uint32_t *rank = mem_alloc(n, sizeof *rank);
  if (rank == NULL)
    return error_memory(error);
  for (size_t t = 0; t < n; t++)
    rank[t] = order->piece.item[t].rank;
  recto_status status =
      painter_solve(sheet, order->grid, rank, request, map, error);
  mem_free(rank);
  return status;
}

static recto_status solve_with_splitting(struct newell_order *order,
                                         struct sheet *sheet,
                                         const struct solver_request *request,
                                         struct map *map, struct report *report,
                                         recto_error *error) {
  if (request->intersections) {
    recto_status status =
        intersection_find_all(sheet, order->grid, NULL, request, report, error);
    if (status != RECTO_OK)
      return status;
  }
  return solve_in_order(order, sheet, request, map, report)
             ? RECTO_OK
             : error_memory(error);
}

static recto_status solve_newell(struct sheet *sheet,
                                 const struct solver_request *request,
                                 struct map *map, struct report *report,
                                 recto_error *error) {
  struct newell_order order;
  struct triangle_grid grid;
  recto_status status;
  if (!triangle_grid_init(&grid, sheet))
    return error_memory(error);
  status = newell_order_init(&order, sheet, &grid, request, error);
  if (status == RECTO_OK && request->newell_tests > 0)
    status = solve_without_splitting(&order, sheet, request, map, error);
  else if (status == RECTO_OK)
    status = solve_with_splitting(&order, sheet, request, map, report, error);
  report_order(&order, report);
  newell_order_fini(&order);
  triangle_grid_fini(&grid);
  return status;
}

const struct solver solver_newell = {RECTO_METHOD_NEWELL, solve_newell};
