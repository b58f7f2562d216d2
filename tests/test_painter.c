/* test_painter.c - the painter's algorithms without tests: right where their
 * order is right, wrong where it must be wrong. */
#include "exact_fixture/oracle.h"
#include "exact_fixture/scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { SCALE = 1024, STEPS = 8 };

/* Level steps that overlap, the k-th at depth depth[k]. */
static void staircase(struct sheet *sheet, const int depth[STEPS]) {
  exact_sheet_init(sheet);
  for (int k = 0; k < STEPS; k++) {
    int x = 3 * k, y = k % 3, z = depth[k];
    const int step[][3] = {
        {x, y, z}, {x + 8, y, z}, {x + 8, y + 5, z}, {x, y + 5, z}};
    exact_add_face(sheet, step, 4, SCALE);
  }
}

/* Solves a staircase by both. */
static void solve_both(const struct solver *solver, const int depth[STEPS],
                       struct map *map, struct map *brute) {
  struct sheet sheet;
  staircase(&sheet, depth);
  exact_solve(solver, &sheet, map, NULL);
  exact_sheet_fini(&sheet);
  staircase(&sheet, depth);
  exact_solve(&solver_brute, &sheet, brute, NULL);
  exact_sheet_fini(&sheet);
}

static void depth_sort_is_right_on_a_staircase(void **state) {
  static const int depth[][STEPS] = {{1, 2, 3, 4, 5, 6, 7, 8},
                                     {8, 7, 6, 5, 4, 3, 2, 1},
                                     {3, 8, 1, 6, 2, 7, 5, 4}};
  (void)state;
  for (size_t k = 0; k < sizeof depth / sizeof *depth; k++) {
    struct map map, brute;
    solve_both(&solver_painter, depth[k], &map, &brute);
    exact_assert_same_map(&map, &brute, "staircase");
    map_fini(&map);
    map_fini(&brute);
  }
}

static void the_given_order_is_right_from_back_to_front(void **state) {
  static const int depth[STEPS] = {1, 2, 3, 4, 5, 6, 7, 8};
  struct map map, brute;
  (void)state;
  solve_both(&solver_painter_given, depth, &map, &brute);
  exact_assert_same_map(&map, &brute, "given order");
  map_fini(&map);
  map_fini(&brute);
}

static void the_given_order_is_wrong_from_front_to_back(void **state) {
  static const int depth[STEPS] = {8, 7, 6, 5, 4, 3, 2, 1};
  struct map map, brute;
  (void)state;
  solve_both(&solver_painter_given, depth, &map, &brute);
  /* What should be wholly visible is painted over, and vice versa. */
  exact_assert_area(&brute, 0, SCALE, 40, 1);
  exact_assert_area(&map, 0, SCALE, 40 - 5 * 4, 1);
  exact_assert_area(&map, STEPS - 1, SCALE, 40, 1);
  map_fini(&map);
  map_fini(&brute);
}

static const int bars[3][3][3] = {{{0, 0, 10}, {2, 0, 10}, {12, 20, 30}},
                                  {{24, 4, 10}, {24, 6, 10}, {-2, 5, 30}},
                                  {{8, 20, 10}, {10, 22, 10}, {22, 1, 30}}};

/* How many of the bars have another area in the one map than in the other. */
static int count_wrong(const struct map *map, const struct map *brute) {
  const struct map *both[2] = {map, brute};
  int wrong = 0;
  for (uint32_t f = 0; f < 3; f++) {
    struct exact_area area[2] = {0};
    for (int i = 0; i < 2; i++)
      for (size_t k = 0; k < both[i]->fragment.count; k++)
        if (both[i]->fragment.item[k].face == f)
          exact_add_area(&area[i], both[i], k);
    wrong +=
        fabs(area[0].twice - area[1].twice) > area[0].error + area[1].error;
  }
  return wrong;
}

static void a_cycle_cannot_be_painted(void **state) {
  static const struct solver *const painter[] = {
      &solver_painter, &solver_painter_given, &solver_newell};
  const struct solver_request request = {
      .edges = true, .fragments = true, .threads = 1, .newell_tests = 4};
  (void)state;
  for (int s = 0; s < 3; s++) {
    struct sheet sheet;
    struct map map, brute;
    exact_sheet_init(&sheet);
    for (int k = 0; k < 3; k++)
      exact_add_face(&sheet, bars[k], 3, SCALE);
    assert_int_equal(exact_solve_as(painter[s], &request, &sheet, &map, NULL),
                     RECTO_OK);
    exact_solve(&solver_brute, &sheet, &brute, NULL);
    assert_true(count_wrong(&map, &brute) >= 2); /* one too large, one small */
    map_fini(&map);
    map_fini(&brute);
    exact_sheet_fini(&sheet);
  }
}

/* The table's middle is nearer than the cup on its far end. */
static void
depth_sort_is_wrong_for_a_small_object_on_a_long_table(void **state) {
  static const int table[][3] = {
      {0, 0, 0}, {100, 0, 100}, {100, 20, 100}, {0, 20, 0}};
  static const int cup[][3] = {
      {5, 5, 20}, {10, 5, 20}, {10, 10, 20}, {5, 10, 20}};
  struct sheet sheet;
  struct map map, brute;
  (void)state;
  exact_sheet_init(&sheet);
  exact_add_face(&sheet, table, 4, SCALE);
  exact_add_face(&sheet, cup, 4, SCALE);
  exact_solve(&solver_painter, &sheet, &map, NULL);
  exact_solve(&solver_brute, &sheet, &brute, NULL);
  exact_assert_area(&brute, 1, SCALE, 25, 1);
  exact_assert_area(&map, 1, SCALE, 0, 1);
  exact_assert_area(&map, 0, SCALE, 2000, 1);
  map_fini(&map);
  map_fini(&brute);
  exact_sheet_fini(&sheet);
}

/* Where an order exists, Newell's tests find it without splitting. */
static void newell_without_splitting_is_right_where_an_order_is(void **state) {
  static const int depth[STEPS] = {3, 8, 1, 6, 2, 7, 5, 4};
  const struct solver_request request = {
      .edges = true, .fragments = true, .threads = 1, .newell_tests = 4};
  struct sheet sheet[2];
  struct map map, brute;
  (void)state;
  for (int i = 0; i < 2; i++)
    staircase(&sheet[i], depth);
  assert_int_equal(
      exact_solve_as(&solver_newell, &request, &sheet[0], &map, NULL),
      RECTO_OK);
  exact_solve(&solver_brute, &sheet[1], &brute, NULL);
  exact_assert_same_map(&map, &brute, "staircase");
  map_fini(&map);
  map_fini(&brute);
  for (int i = 0; i < 2; i++)
    exact_sheet_fini(&sheet[i]);
}

/* Wrong or not, every point of the page is painted by one face. */
static void what_is_painted_covers_all_there_is(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 60; seed++) {
    uint64_t r = seed;
    struct sheet sheet;
    mpq_t *area2, covered;
    exact_random_sheet(&sheet, (enum exact_kind)(seed % EXACT_KINDS),
                       2 + exact_random_below(&r, 3), &r);
    area2 = malloc((sheet.triangle.count + 1) * sizeof *area2);
    assert_non_null(area2);
    for (size_t t = 0; t < sheet.triangle.count; t++)
      mpq_init(area2[t]);
    mpq_init(covered);
    oracle_areas(&sheet, false, area2, covered);
    for (int s = 0; s < 2; s++) {
      struct exact_area sum = {0};
      struct map map;
      exact_solve(s == 0 ? &solver_painter : &solver_painter_given, &sheet,
                  &map, NULL);
      for (size_t f = 0; f < map.fragment.count; f++)
        exact_add_area(&sum, &map, f);
      assert_true(exact_is_area(sum, covered));
      map_fini(&map);
    }
    mpq_clear(covered);
    for (size_t t = 0; t < sheet.triangle.count; t++)
      mpq_clear(area2[t]);
    free(area2);
    exact_sheet_fini(&sheet);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(depth_sort_is_right_on_a_staircase),
      cmocka_unit_test(the_given_order_is_right_from_back_to_front),
      cmocka_unit_test(the_given_order_is_wrong_from_front_to_back),
      cmocka_unit_test(a_cycle_cannot_be_painted),
      cmocka_unit_test(depth_sort_is_wrong_for_a_small_object_on_a_long_table),
      cmocka_unit_test(newell_without_splitting_is_right_where_an_order_is),
      cmocka_unit_test(what_is_painted_covers_all_there_is),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
