/* test_occluder_subtraction.c - a triangle less its subtraction, in any order,
 * is what the brute-force solver leaves of it. */
#include "exact_fixture/scene.h"
#include "geom/region.h"
#include "tests/memory_faults.h"
#include "visibility/brute/brute.h"
#include "visibility/fragments/occluder_subtraction.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* Subtracts all other triangles, one after another or all at once. */
static void take_all(struct occluder_subtraction *subtraction, uint32_t t,
                     bool at_once) {
  const struct sheet *sheet = subtraction->sheet;
  assert_true(occluder_subtraction_start(subtraction, t, NULL));
  for (uint32_t g = 0; g < sheet->triangle.count; g++)
    if (g != t && !sheet_is_edge_on(sheet, g))
      assert_true(at_once
                      ? occluder_subtraction_collect(subtraction, g)
                      : occluder_subtraction_subtract_nearer(subtraction, g));
  if (at_once)
    assert_true(occluder_subtraction_subtract_all(subtraction));
}

/* Unions in their one form, corner by corner. */
static void assert_same_union(const geom_pieces *a, const geom_pieces *b) {
  struct geom_region p = {0}, q = {0};
  assert_true(geom_region_unite(&p, a->item, a->count));
  assert_true(geom_region_unite(&q, b->item, b->count));
  assert_int_equal(p.loop.count, q.loop.count);
  assert_int_equal(p.side.count, q.side.count);
  for (size_t i = 0; i < p.loop.count; i++) {
    assert_int_equal(p.loop.item[i].count, q.loop.item[i].count);
    assert_int_equal(p.loop.item[i].hole, q.loop.item[i].hole);
  }
  for (size_t i = 0; i < p.side.count; i++)
    assert_int_equal(
        geom_corner_compare(&p.side.item[i].corner, &q.side.item[i].corner), 0);
  geom_region_fini(&p);
  geom_region_fini(&q);
}

/* Compares all triangles of a sheet; counts those of which a part is left. */
static void compare_all(const struct sheet *sheet,
                        struct occluder_subtraction_counts *sum, int *mixed) {
  struct occluder_subtraction subtraction;
  struct brute_pieces oracle = {0};
  occluder_subtraction_init(&subtraction, sheet);
  for (uint32_t t = 0; t < sheet->triangle.count; t++) {
    if (sheet_is_edge_on(sheet, t))
      continue;
    assert_true(brute_subtract_all(&oracle, sheet, t, NULL));
    for (int at_once = 0; at_once < 2; at_once++) {
      take_all(&subtraction, t, at_once);
      assert_int_equal(subtraction.whole, oracle.whole);
      assert_same_union(&subtraction.left, &oracle.left);
    }
    if (subtraction.covered)
      assert_int_equal(oracle.left.count, 0);
    if (subtraction.occluder.count == 0)
      assert_true(oracle.whole);
    *mixed += !oracle.whole && oracle.left.count > 0;
  }
  sum->splits += subtraction.counts.splits;
  sum->crossings += subtraction.counts.crossings;
  sum->exact += subtraction.counts.exact;
  occluder_subtraction_fini(&subtraction);
  brute_pieces_fini(&oracle);
}

static void what_is_left_is_what_brute_force_leaves(void **state) {
  struct occluder_subtraction_counts sum = {0};
  int mixed = 0;
  (void)state;
  for (uint64_t seed = 1; seed <= 6; seed++)
    for (int kind = 0; kind < EXACT_KINDS; kind++) {
      uint64_t r = seed * EXACT_KINDS + (uint64_t)kind;
      struct sheet sheet;
      exact_random_sheet(&sheet, (enum exact_kind)kind, 60, &r);
      compare_all(&sheet, &sum, &mixed);
      exact_sheet_fini(&sheet);
    }
  /* And there was something to do. */
  assert_true(mixed > 300);
  assert_true(sum.crossings > 1000);
  assert_true(sum.exact > 1000);
}

/* A square face of two triangles in front of a third one, which lies across
 * either diagonal, and whose right corner is at x. */
static bool is_covered_by_square(int x) {
  const int square[4][3] = {
      {0, 0, 80}, {100, 0, 80}, {100, 100, 80}, {0, 100, 80}};
  const int behind[3][3] = {{20, 50, 10}, {x, 30, 10}, {60, 80, 10}};
  struct occluder_subtraction subtraction;
  struct sheet sheet;
  exact_sheet_init(&sheet);
  exact_add_face(&sheet, square, 4, 1024);
  exact_add_face(&sheet, behind, 3, 1024);
  assert_int_equal(sheet.triangle.count, 3);
  occluder_subtraction_init(&subtraction, &sheet);
  take_all(&subtraction, 2, true);
  bool covered = subtraction.covered;
  assert_int_equal(covered, subtraction.left.count == 0);
  occluder_subtraction_fini(&subtraction);
  exact_sheet_fini(&sheet);
  return covered;
}

static void
two_triangles_of_a_face_cover_what_lies_across_their_diagonal(void **state) {
  (void)state;
  assert_true(is_covered_by_square(80));
  assert_true(is_covered_by_square(100));
  assert_false(is_covered_by_square(101));
}

/* A long bar, and n short ones across it, in front or behind. */
static void lay_bars(struct sheet *sheet, int n, int depth) {
  const int long_bar[4][3] = {
      {0, 0, 50}, {40 * n, 7 * n, 50}, {40 * n, 7 * n + 60, 50}, {0, 60, 50}};
  exact_sheet_init(sheet);
  exact_add_face(sheet, long_bar, 4, 1024);
  for (int k = 0; k < n; k++) {
    int x = 40 * k + 10, y = 7 * k - 90;
    const int bar[4][3] = {{x, y, depth},
                           {x + 20, y, depth + k % 3},
                           {x + 24, y + 300, depth + k % 3},
                           {x + 4, y + 300, depth}};
    exact_add_face(sheet, bar, 4, 1024);
  }
}

/* Bars in front of the long one, and such that pierce it. */
static void a_split_leaves_what_brute_force_leaves(void **state) {
  (void)state;
  for (int depth = 49; depth <= 80; depth += 31) {
    int mixed = 0;
    struct occluder_subtraction_counts sum = {0};
    struct sheet sheet;
    lay_bars(&sheet, 300, depth);
    compare_all(&sheet, &sum, &mixed);
    assert_true(mixed > 0);
    assert_true(sum.splits > 0);
    exact_sheet_fini(&sheet);
  }
}

static void bars_across_a_bar_are_tested_only_near_it(void **state) {
  uint64_t cuts[2];
  (void)state;
  for (int i = 0; i < 2; i++) {
    int n = i == 0 ? 200 : 800;
    struct occluder_subtraction subtraction;
    struct sheet sheet;
    lay_bars(&sheet, n, 80);
    occluder_subtraction_init(&subtraction, &sheet);
    take_all(&subtraction, 0, true);
    assert_true(subtraction.counts.splits > (uint64_t)n / 100);
    assert_true(subtraction.left.count >= (size_t)n / 2);
    cuts[i] = subtraction.counts.subtractions;
    occluder_subtraction_fini(&subtraction);
    exact_sheet_fini(&sheet);
  }
  /* Four times as many take four times as many cuts, not sixteen. */
  assert_true(cuts[1] < 6 * cuts[0]);
}

static void what_is_behind_is_no_occluder(void **state) {
  struct occluder_subtraction subtraction;
  struct sheet sheet;
  (void)state;
  lay_bars(&sheet, 20, 20);
  occluder_subtraction_init(&subtraction, &sheet);
  take_all(&subtraction, 0, true);
  assert_int_equal(subtraction.occluder.count, 0);
  assert_true(subtraction.whole);
  assert_false(subtraction.interpenetrating);
  occluder_subtraction_fini(&subtraction);
  exact_sheet_fini(&sheet);
}

static void memory_may_run_out_anywhere(void **state) {
  struct sheet sheet;
  struct memory_faults faults = {.least = 5};
  (void)state;
  lay_bars(&sheet, 120, 80);
  while (memory_faults_go_on(&faults)) {
    struct occluder_subtraction subtraction;
    occluder_subtraction_init(&subtraction, &sheet);
    memory_faults_begin(&faults);
    bool ok = occluder_subtraction_start(&subtraction, 0, NULL);
    for (uint32_t g = 2; ok && g < sheet.triangle.count; g++)
      ok = occluder_subtraction_collect(&subtraction, g);
    ok = ok && occluder_subtraction_subtract_all(&subtraction);
    memory_faults_end(&faults, memory_faults_status(ok));
    occluder_subtraction_fini(&subtraction);
  }
  exact_sheet_fini(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_left_is_what_brute_force_leaves),
      cmocka_unit_test(
          two_triangles_of_a_face_cover_what_lies_across_their_diagonal),
      cmocka_unit_test(a_split_leaves_what_brute_force_leaves),
      cmocka_unit_test(bars_across_a_bar_are_tested_only_near_it),
      cmocka_unit_test(what_is_behind_is_no_occluder),
      cmocka_unit_test(memory_may_run_out_anywhere),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
