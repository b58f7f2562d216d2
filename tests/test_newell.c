/* test_newell.c - the painter's order of Newell, Newell and Sancha. */
#include "exact_fixture/rational.h"
#include "exact_fixture/scene.h"
#include "tests/polled.h"
#include "visibility/newell/newell_order.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

enum { SCALE = 1024 };

/* A sheet put in order. */
struct ordered {
  struct sheet sheet;
  struct triangle_grid grid;
  struct newell_order order;
};

/* In the order in which faces can be painted, which are in the grid.
 * tests  how many of them; 0: all, with splitting */
static recto_status order_grid(struct ordered *o, int tests) {
  const struct solver_request request = {
      .fragments = true, .threads = 1, .newell_tests = tests};
  recto_error error;
  return newell_order_init(&o->order, &o->sheet, &o->grid, &request, &error);
}

static recto_status put_in_order(struct ordered *o, int tests) {
  assert_true(triangle_grid_init(&o->grid, &o->sheet));
  return order_grid(o, tests);
}

static void ordered_fini(struct ordered *o) {
  newell_order_fini(&o->order);
  triangle_grid_fini(&o->grid);
  exact_sheet_fini(&o->sheet);
}

/* Orders `count` triangles; times SCALE. */
static void order_by_tests(struct ordered *o, const int corner[][3][3],
                           int count, int tests) {
  exact_sheet_init(&o->sheet);
  for (int f = 0; f < count; f++)
    exact_add_face(&o->sheet, corner[f], 3, SCALE);
  assert_int_equal(put_in_order(o, tests), RECTO_OK);
}

static void order_triangles(struct ordered *o, const int corner[][3][3],
                            int count) {
  order_by_tests(o, corner, count, 0);
}

/* The triangles of the pieces painted, back to front. */
static void assert_painted(const struct ordered *o, const uint32_t *triangle,
                           size_t count) {
  assert_int_equal(o->order.painted.count, count);
  for (size_t k = 0; k < count; k++) {
    const struct newell_piece *piece =
        &o->order.piece.item[o->order.painted.item[k]];
    assert_int_equal(piece->triangle, triangle[k]);
    assert_int_equal(piece->rank, k);
    assert_int_equal(piece->state, NEWELL_PAINTED);
  }
}

#define ASSERT_PAINTED(o, ...)                                                 \
  do {                                                                         \
    static const uint32_t want[] = {__VA_ARGS__};                              \
    assert_painted(o, want, sizeof want / sizeof *want);                       \
  } while (0)

/* ---- Worked orders ------------------------------------------------------- */

/* Bars as needles, B over A, C over B and the other end of A over C. */
static const int bars[3][3][3] = {{{0, 0, 10}, {2, 0, 10}, {12, 20, 30}},
                                  {{24, 4, 10}, {24, 6, 10}, {-2, 5, 30}},
                                  {{8, 20, 10}, {10, 22, 10}, {22, 1, 30}}};

static void three_bars_come_out_as_a1_b_c_a2(void **state) {
  struct ordered o;
  (void)state;
  order_triangles(&o, bars, 3);
  ASSERT_PAINTED(&o, 0, 1, 2, 0);
  assert_int_equal(o.order.counts.cycles, 1);
  assert_int_equal(o.order.counts.split_cycle, 1);
  assert_int_equal(o.order.counts.split_intersection, 0);
  assert_int_equal(o.order.piece.count, 5);
  assert_int_equal(o.order.piece.item[0].state, NEWELL_SPLIT);
  ordered_fini(&o);
}

/* Whatever bar comes first in the file, one is split and two are whole. */
static void a_cycle_costs_one_split(void **state) {
  (void)state;
  for (int first = 0; first < 6; first++) {
    int turned[3][3][3];
    struct ordered o;
    for (int k = 0; k < 9; k++)
      for (int f = 0; f < 3; f++)
        turned[f][k / 3][k % 3] =
            bars[first < 3 ? (f + first) % 3 : (first - f) % 3][k / 3][k % 3];
    order_triangles(&o, (const int(*)[3][3])turned, 3);
    assert_int_equal(o.order.painted.count, 4);
    assert_int_equal(o.order.counts.split_cycle, 1);
    ordered_fini(&o);
  }
}

static void a_pierced_face_is_split_where_the_planes_cross(void **state) {
  static const int face[2][3][3] = {{{0, 0, 4}, {16, 0, 4}, {8, 16, 20}},
                                    {{0, 2, 12}, {16, 2, 12}, {8, 14, 12}}};
  struct ordered o;
  (void)state;
  order_triangles(&o, face, 2);
  ASSERT_PAINTED(&o, 0, 1, 0);
  assert_int_equal(o.order.counts.split_intersection, 1);
  assert_int_equal(o.order.counts.cycles, 0);
  ordered_fini(&o);
}

/* What is not in front of the later one need not be split to be painted. */
static void planes_that_cross_beside_the_faces_split_nothing(void **state) {
  static const int face[2][3][3] = {{{0, 0, 4}, {16, 0, 4}, {8, 16, 20}},
                                    {{0, 2, 30}, {16, 2, 30}, {8, 14, 40}}};
  struct ordered o;
  (void)state;
  order_triangles(&o, face, 2);
  ASSERT_PAINTED(&o, 0, 1);
  assert_int_equal(o.order.counts.split_intersection, 0);
  ordered_fini(&o);
}

/* ---- The tests, one by one ----------------------------------------------- */

struct tally {
  uint64_t depth, minimax, behind, before, full, moved;
};

static void assert_tally(const int face[2][3][3], struct tally want,
                         uint32_t first, uint32_t second) {
  struct ordered o;
  const struct newell_counts *c = &o.order.counts;
  order_triangles(&o, face, 2);
  assert_int_equal(c->depth, want.depth);
  assert_int_equal(c->minimax, want.minimax);
  assert_int_equal(c->behind, want.behind);
  assert_int_equal(c->before, want.before);
  assert_int_equal(c->full, want.full);
  assert_int_equal(c->moved, want.moved);
  assert_painted(&o, (const uint32_t[]){first, second}, 2);
  ordered_fini(&o);
}

static void disjoint_depths_decide_the_pair(void **state) {
  static const int face[2][3][3] = {{{0, 0, 0}, {9, 0, 1}, {0, 9, 2}},
                                    {{0, 0, 3}, {9, 0, 4}, {0, 9, 5}}};
  (void)state;
  assert_tally(face, (struct tally){.depth = 1}, 0, 1);
}

static void test_a_decides_pairs_disjoint_on_the_page(void **state) {
  static const int face[2][3][3] = {{{0, 0, 0}, {4, 0, 9}, {0, 4, 9}},
                                    {{5, 0, 3}, {9, 0, 4}, {5, 4, 5}}};
  (void)state;
  assert_tally(face, (struct tally){.minimax = 1}, 0, 1);
}

static void test_b_decides_p_behind_the_plane_of_q(void **state) {
  static const int face[2][3][3] = {{{0, 0, 0}, {9, 0, 1}, {0, 9, 2}},
                                    {{0, 0, 2}, {9, 0, 3}, {0, 9, 9}}};
  (void)state;
  assert_tally(face, (struct tally){.behind = 1}, 0, 1);
}

/* P reaches through Q's plane beside Q. */
static void test_c_decides_q_in_front_of_the_plane_of_p(void **state) {
  static const int face[2][3][3] = {{{0, 0, 0}, {20, 0, 20}, {0, 20, 0}},
                                    {{1, 1, 5}, {3, 1, 5}, {1, 3, 5}}};
  (void)state;
  assert_tally(face, (struct tally){.before = 1}, 0, 1);
}

/* Their boxes meet and P is on both sides of Q's plane, but they do not
 * overlap. */
static void
test_d_decides_disjoint_outlines_with_overlapping_boxes(void **state) {
  static const int face[2][3][3] = {{{0, 0, 0}, {20, 0, 20}, {0, 20, 20}},
                                    {{20, 20, 10}, {9, 20, 10}, {20, 5, 10}}};
  (void)state;
  assert_tally(face, (struct tally){.full = 1}, 0, 1);
}

/* P has the farthest point of all and still is in front of Q. */
static void a_face_behind_is_moved_ahead(void **state) {
  static const int face[2][3][3] = {{{0, 0, 20}, {20, 0, 0}, {0, 20, 20}},
                                    {{1, 1, 5}, {3, 1, 5}, {1, 3, 5}}};
  (void)state;
  /* First D for P against Q, then B for Q against P. */
  assert_tally(face, (struct tally){.full = 1, .moved = 1, .behind = 1}, 1, 0);
}

/* Of two in one plane the earlier is in front: painted later. */
static void equal_planes_are_painted_latest_first(void **state) {
  static const int face[2][3][3] = {{{0, 0, 0}, {20, 0, 20}, {0, 20, 0}},
                                    {{1, 1, 1}, {9, 1, 9}, {1, 9, 1}}};
  (void)state;
  assert_tally(face, (struct tally){.full = 1, .moved = 1, .behind = 1}, 1, 0);
}

/* Contact hides no line: two that pierce each other by less are left whole,
 * where only lines are requested. */
static void lines_alone_need_no_order_of_what_touches(void **state) {
  static const int face[2][3][3] = {{{0, 0, 0}, {20, 0, 20}, {0, 20, 0}},
                                    {{1, 1, 2}, {15, 1, 14}, {1, 15, 1}}};
  (void)state;
  for (int fragments = 0; fragments < 2; fragments++) {
    const struct solver_request request = {.fragments = fragments != 0,
                                           .threads = 1};
    struct ordered o;
    recto_error error;
    exact_sheet_init(&o.sheet);
    for (int f = 0; f < 2; f++)
      exact_add_face(&o.sheet, face[f], 3, 1);
    assert_true(triangle_grid_init(&o.grid, &o.sheet));
    assert_int_equal(
        newell_order_init(&o.order, &o.sheet, &o.grid, &request, &error),
        RECTO_OK);
    assert_int_equal(o.order.counts.split_intersection, fragments);
    ordered_fini(&o);
  }
}

/* ---- Some of the tests --------------------------------------------------- */

/* By A alone, by A and B, ...: which of two is painted first. */
static void assert_first(const int face[2][3][3], const uint32_t first[4]) {
  for (int tests = 1; tests <= 4; tests++) {
    struct ordered o;
    order_by_tests(&o, face, 2, tests);
    assert_painted(
        &o, (const uint32_t[]){first[tests - 1], 1 - first[tests - 1]}, 2);
    ordered_fini(&o);
  }
}

static void test_a_alone_leaves_the_order_of_depth(void **state) {
  static const int face[2][3][3] = {{{0, 0, 20}, {20, 0, 0}, {0, 20, 20}},
                                    {{1, 1, 5}, {3, 1, 5}, {1, 3, 5}}};
  (void)state;
  assert_first(face, (const uint32_t[]){0, 1, 1, 1});
}

/* P is in front of Q's plane, Q on both sides of P's. */
static void test_c_decides_what_a_and_b_leave_open(void **state) {
  static const int face[2][3][3] = {{{-10, 0, 0}, {2, 0, 15}, {-10, 10, 0}},
                                    {{1, 1, 2}, {3, 1, 22}, {1, 3, 2}}};
  (void)state;
  assert_first(face, (const uint32_t[]){0, 0, 1, 0});
}

static void without_splitting_a_cycle_is_painted_whole(void **state) {
  (void)state;
  for (int tests = 1; tests <= 4; tests++) {
    struct ordered o;
    order_by_tests(&o, bars, 3, tests);
    assert_int_equal(o.order.painted.count, 3);
    assert_int_equal(o.order.counts.cycles, 0);
    assert_int_equal(o.order.piece.count, 3);
    ordered_fini(&o);
  }
}

/* ---- Any order is a painter's order -------------------------------------- */

static void lines_to(const struct newell_order *order, uint32_t piece,
                     struct geom_convex *shape, struct arena *arena) {
  const struct newell_piece *p = &order->piece.item[piece];
  struct geom_point corner[3];
  struct geom_line *line;
  int count;
  if (p->shape != NULL) {
    *shape = *p->shape;
    return;
  }
  line = newell_piece_lines(order, piece, &count, arena);
  assert_non_null(line);
  for (int k = 0; k < 3; k++)
    corner[k] = order->sheet->point
                    .item[order->sheet->triangle.item[p->triangle].point[k]];
  assert_true(geom_convex_triangle(shape, corner, line, arena));
}

/* Cuts `common` to what piece q covers as well. */
static void cut_to(const struct newell_order *order, uint32_t q,
                   struct geom_convex *common, struct arena *arena) {
  int count;
  struct geom_line *line = newell_piece_lines(order, q, &count, arena);
  assert_non_null(line);
  for (int k = 0; k < count && common->count > 0; k++) {
    struct geom_convex inside;
    assert_true(geom_convex_split(common, &line[k], &line[count + k], &inside,
                                  NULL, arena));
    *common = inside;
  }
}

static void corners_of(const struct sheet *sheet, uint32_t t,
                       struct geom_point p[3]) {
  for (int k = 0; k < 3; k++)
    p[k] = sheet->point.item[sheet->triangle.item[t].point[k]];
}

/* Piece q, painted later, is nowhere behind p; where they are equally deep it
 * is the earlier in the file. */
static void check_pair(const struct newell_order *order, uint32_t p, uint32_t q,
                       struct arena *arena, const char *what) {
  uint32_t tp = order->piece.item[p].triangle,
           tq = order->piece.item[q].triangle;
  struct geom_point fp[3], fq[3];
  struct geom_convex common;
  struct rational_point at;
  mpq_t zp, zq;
  bool equal = true;
  lines_to(order, p, &common, arena);
  cut_to(order, q, &common, arena);
  if (common.count == 0)
    return;
  if (tp == tq)
    fail_msg("%s: pieces of one face overlap", what);
  corners_of(order->sheet, tp, fp);
  corners_of(order->sheet, tq, fq);
  rational_point_init(&at);
  mpq_inits(zp, zq, NULL);
  for (uint32_t k = 0; k < common.count; k++) {
    rational_point_at_corner(&at, &common.corner[k]);
    rational_depth(zp, fp, &at);
    rational_depth(zq, fq, &at);
    if (mpq_cmp(zp, zq) > 0)
      fail_msg("%s: face %u was painted over %u, which is nearer", what, tq,
               tp);
    equal = equal && mpq_equal(zp, zq);
  }
  if (equal && tq > tp)
    fail_msg("%s: face %u was painted over %u in one plane", what, tq, tp);
  rational_point_clear(&at);
  mpq_clears(zp, zq, NULL);
}

/* The pieces of each triangle tile it, those unseen included. */
static void check_tiling(const struct newell_order *order, const char *what) {
  size_t n = order->sheet->triangle.count;
  struct arena arena = {0};
  mpq_t sum;
  mpq_init(sum);
  for (uint32_t t = 0; t < n; t++) {
    struct geom_point p[3];
    if (sheet_is_edge_on(order->sheet, t))
      continue;
    corners_of(order->sheet, t, p);
    mpq_set_si(sum, -geom_orient2d(p[0], p[1], p[2]), 1);
    for (uint32_t k = 0; k < order->piece.count; k++) {
      struct geom_convex shape;
      if (order->piece.item[k].triangle != t ||
          order->piece.item[k].state == NEWELL_SPLIT)
        continue;
      lines_to(order, k, &shape, &arena);
      rational_add_area2(sum, &shape);
    }
    if (mpq_sgn(sum) != 0)
      fail_msg("%s: pieces of %u do not tile it", what, t);
    arena_reset(&arena);
  }
  mpq_clear(sum);
  arena_fini(&arena);
}

static void check_order(const struct newell_order *order, const char *what) {
  struct arena arena = {0};
  for (size_t j = 0; j < order->painted.count; j++)
    for (size_t i = 0; i < j; i++) {
      check_pair(order, order->painted.item[i], order->painted.item[j], &arena,
                 what);
      arena_reset(&arena);
    }
  for (size_t k = 0; k < order->piece.count; k++)
    assert_in_range(order->piece.item[k].state, NEWELL_PAINTED, NEWELL_UNSEEN);
  check_tiling(order, what);
  arena_fini(&arena);
}

static void nothing_painted_later_is_behind(void **state) {
  uint64_t cycles = 0, splits = 0, unseen = 0;
  (void)state;
  for (uint64_t seed = 1; seed <= 1500; seed++) {
    uint64_t r = seed;
    struct ordered o;
    char what[64];
    snprintf(what, sizeof what, "seed %u", (unsigned)seed);
    exact_random_sheet(&o.sheet, (enum exact_kind)(seed % EXACT_KINDS),
                       2 + exact_random_below(&r, 9), &r);
    assert_int_equal(put_in_order(&o, 0), RECTO_OK);
    check_order(&o.order, what);
    cycles += o.order.counts.cycles;
    splits += o.order.counts.split_intersection;
    unseen += o.order.counts.unseen;
    ordered_fini(&o);
  }
  assert_true(cycles > 20 && splits > 100 && unseen > 0);
}

/* Rings of bars, each over the next, of every length. */
static void long_cycles_are_broken(void **state) {
  static const int star[12][2] = {{1000, 0},  {866, 500},   {500, 866},
                                  {0, 1000},  {-500, 866},  {-866, 500},
                                  {-1000, 0}, {-866, -500}, {-500, -866},
                                  {0, -1000}, {500, -866},  {866, -500}};
  (void)state;
  for (int step = 1; step <= 4; step++) {
    int n = 12 / step;
    struct ordered o;
    char what[64];
    exact_sheet_init(&o.sheet);
    for (int k = 0; k < n; k++) {
      const int *p = star[k * step], *q = star[(k + 1) % n * step];
      int dx = q[0] - p[0], dy = q[1] - p[1];
      const int bar[3][3] = {
          {p[0] - dx / 4 - dy / 16, p[1] - dy / 4 + dx / 16, 100},
          {p[0] - dx / 4 + dy / 16, p[1] - dy / 4 - dx / 16, 100},
          {q[0] + dx / 4, q[1] + dy / 4, 300}};
      exact_add_face(&o.sheet, bar, 3, SCALE);
    }
    assert_int_equal(put_in_order(&o, 0), RECTO_OK);
    snprintf(what, sizeof what, "ring of %d", n);
    assert_in_range(o.order.counts.split_cycle, 1, n);
    assert_int_equal(o.order.painted.count,
                     n + (int)o.order.counts.split_cycle);
    check_order(&o.order, what);
    ordered_fini(&o);
  }
}

/* ---- Stopping ------------------------------------------------------------ */

static bool say_stop(void *user, double share, const char *stage) {
  (void)user;
  assert_true(share >= 0 && share <= 1 && stage != NULL);
  return false;
}

static void progress_may_say_stop(void **state) {
  struct ordered o;
  struct polled polled;
  (void)state;
  exact_sheet_init(&o.sheet);
  exact_add_face(&o.sheet, bars[0], 3, SCALE);
  assert_true(triangle_grid_init(&o.grid, &o.sheet));
  polled_begin(&polled, say_stop, NULL);
  assert_int_equal(order_grid(&o, 0), RECTO_ERROR_CANCELLED);
  polled_end(&polled);
  ordered_fini(&o);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(three_bars_come_out_as_a1_b_c_a2),
      cmocka_unit_test(a_cycle_costs_one_split),
      cmocka_unit_test(a_pierced_face_is_split_where_the_planes_cross),
      cmocka_unit_test(planes_that_cross_beside_the_faces_split_nothing),
      cmocka_unit_test(disjoint_depths_decide_the_pair),
      cmocka_unit_test(test_a_decides_pairs_disjoint_on_the_page),
      cmocka_unit_test(test_b_decides_p_behind_the_plane_of_q),
      cmocka_unit_test(test_c_decides_q_in_front_of_the_plane_of_p),
      cmocka_unit_test(test_d_decides_disjoint_outlines_with_overlapping_boxes),
      cmocka_unit_test(a_face_behind_is_moved_ahead),
      cmocka_unit_test(equal_planes_are_painted_latest_first),
      cmocka_unit_test(lines_alone_need_no_order_of_what_touches),
      cmocka_unit_test(test_a_alone_leaves_the_order_of_depth),
      cmocka_unit_test(test_c_decides_what_a_and_b_leave_open),
      cmocka_unit_test(without_splitting_a_cycle_is_painted_whole),
      cmocka_unit_test(nothing_painted_later_is_behind),
      cmocka_unit_test(long_cycles_are_broken),
      cmocka_unit_test(progress_may_say_stop),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
