/* newell_tests.c - Newell's tests, which decide whether piece P may be painted
 * before piece Q.
 *
 * Source  [Newell1972]; tests A to D as [FoleyVanDam1990] 15.5.2 lists them.
 * Test D compares depths over the intersection of P and Q on the page: it is
 * convex, so the difference of their planes is extreme at its corners.
 */
#include "visibility/newell/newell_tests.h"

int newell_crossing(const struct newell_order *order, uint32_t p, uint32_t q,
                    struct geom_line *line, struct geom_line *reversed) {
  struct triangle_plane tp = triangle_plane_of(order->sheet,
                                               order->piece.item[p].triangle),
                        tq = triangle_plane_of(order->sheet,
                                               order->piece.item[q].triangle);
  int parallel = geom_line_between(line, &tp.plane, &tq.plane);
  *reversed = geom_line_reversed(line);
  return parallel;
}

/* The intersection of both pieces on the page. */
static bool find_common(struct newell_order *order, uint32_t p, uint32_t q,
                        struct geom_convex *common) {
  int count;
  struct geom_line *line =
      newell_piece_lines(order, q, &count, &order->scratch);
  if (line == NULL || !newell_piece_shape(order, p, common))
    return false;
  for (int k = 0; k < count && common->count > 0; k++) {
    struct geom_convex inside;
    if (!geom_convex_split(common, &line[k], &line[count + k], &inside, NULL,
                           &order->scratch))
      return false;
    *common = inside;
  }
  return true;
}

/* Test D, the full test on the page.
 * q_nearer  the line where the planes intersect, Q being in front on its left;
 *           NULL: P is in front wherever the two overlap */
static enum newell_result test_full(struct newell_order *order, uint32_t p,
                                    uint32_t q,
                                    const struct geom_line *q_nearer) {
  struct geom_convex common;
  bool p_in_front = false, q_in_front = false;
  order->counts.full++;
  if (!find_common(order, p, q, &common))
    return NEWELL_FAILED;
  if (common.count == 0)
    return NEWELL_P_FIRST;
  if (q_nearer == NULL)
    return NEWELL_Q_FIRST;
  for (uint32_t k = 0; k < common.count; k++) {
    int side = geom_line_side(q_nearer, &common.corner[k]);
    q_in_front |= side > 0;
    p_in_front |= side < 0;
  }
  if (!p_in_front)
    return NEWELL_P_FIRST;
  return q_in_front ? NEWELL_PIERCE : NEWELL_Q_FIRST;
}

/* Computes the plane of the candidate and its floating-point filter. */
static void set_candidate_plane(struct newell_order *order, uint32_t triangle) {
  if (order->prepared == triangle)
    return;
  order->prepared = triangle;
  order->plane = triangle_plane_of(order->sheet, triangle);
  order->filter = plane_filter_of(order->sheet, triangle);
}

/* Returns true only if the candidate hides nothing of the edges of triangle t:
 * a conservative test by the floating-point filter. */
static bool hides_nothing(const struct newell_order *order, uint32_t t) {
  struct geom_triangle corner = sheet_corners(order->sheet, t);
  for (int k = 0; k < 3; k++)
    if (plane_filter_contact_sign(&order->filter, corner.p[k]) <= 0)
      return false;
  return true;
}

enum newell_result newell_test(struct newell_order *order, uint32_t p,
                               uint32_t q) {
  const struct newell_piece *pp = &order->piece.item[p],
                            *pq = &order->piece.item[q];
  struct newell_counts *counts = &order->counts;
  if (pq->z_low > pp->z_high) {
    counts->depth++;
    return NEWELL_P_FIRST;
  }
  if (box2_disjoint(pp->box, pq->box)) {
    counts->minimax++;
    return NEWELL_P_FIRST;
  }
  set_candidate_plane(order, pp->triangle);
  if (order->lines_only && hides_nothing(order, pq->triangle)) {
    counts->before++;
    return NEWELL_P_FIRST;
  }
  struct triangle_plane tq = triangle_plane_of(order->sheet, pq->triangle);
  int p_sides = plane_sides(&tq.plane, order->plane.p);
  if (p_sides == PLANE_BEHIND ||
      (p_sides == 0 && pq->triangle < pp->triangle)) {
    counts->behind++;
    return NEWELL_P_FIRST;
  }
  int q_sides = plane_sides(&order->plane.plane, tq.p);
  if (q_sides == PLANE_IN_FRONT) {
    counts->before++;
    return NEWELL_P_FIRST;
  }
  if (p_sides == PLANE_IN_FRONT || q_sides == PLANE_BEHIND || q_sides == 0)
    return test_full(order, p, q, NULL);
  struct geom_line line;
  (void)geom_line_between(&line, &tq.plane, &order->plane.plane);
  return test_full(order, p, q, &line);
}

/* The order of list S: by the farthest corner, then as in the file. */
static enum newell_result compare_depth(const struct newell_order *order,
                                        uint32_t p, uint32_t q) {
  int64_t zp = order->piece.item[p].z_low, zq = order->piece.item[q].z_low;
  return zp < zq || (zp == zq && p < q) ? NEWELL_P_FIRST : NEWELL_Q_FIRST;
}

enum newell_result newell_test_some(struct newell_order *order, uint32_t p,
                                    uint32_t q) {
  enum { TEST_A = 1, TEST_B, TEST_C };
  const struct newell_piece *pp = &order->piece.item[p],
                            *pq = &order->piece.item[q];
  if (order->tests > TEST_C) {
    enum newell_result result = newell_test(order, p, q);
    return result == NEWELL_PIERCE ? compare_depth(order, p, q) : result;
  }
  if (pq->z_low > pp->z_high || box2_disjoint(pp->box, pq->box))
    return NEWELL_P_FIRST;
  if (order->tests == TEST_A)
    return compare_depth(order, p, q);
  set_candidate_plane(order, pp->triangle);
  struct triangle_plane tq = triangle_plane_of(order->sheet, pq->triangle);
  int p_sides = plane_sides(&tq.plane, order->plane.p);
  if (p_sides == PLANE_BEHIND || (p_sides == 0 && pq->triangle < pp->triangle))
    return NEWELL_P_FIRST;
  int q_sides = plane_sides(&order->plane.plane, tq.p);
  if (q_sides == PLANE_BEHIND || q_sides == 0)
    return NEWELL_Q_FIRST;
  if (order->tests == TEST_C && q_sides == PLANE_IN_FRONT)
    return NEWELL_P_FIRST;
  if (order->tests == TEST_C && p_sides == PLANE_IN_FRONT)
    return NEWELL_Q_FIRST;
  return compare_depth(order, p, q);
}
