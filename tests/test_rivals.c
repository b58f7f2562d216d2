/* test_rivals.c - what many nearer triangles leave of one, in whatever order
 * they are taken, is what the oracle leaves. */
#include "visibility/rivals.h"
#include "geom/region.h"
#include "hand/scene.h"
#include "visibility/cover.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static bool is_flat(const struct sheet *sheet, size_t t) {
  return sheet->triangle_flags[t] & SHEET_FLAT;
}

static void take_by_oracle(struct cover *cover, uint32_t t) {
  const struct sheet *sheet = cover->sheet;
  assert_true(cover_start(cover, t, NULL));
  for (uint32_t g = 0; g < sheet->triangle.count; g++)
    if (g != t && !is_flat(sheet, g))
      assert_true(cover_take_nearer(cover, g));
}

static void take_all(struct rivals *rivals, uint32_t t) {
  const struct sheet *sheet = rivals->sheet;
  rivals_start(rivals, t);
  for (uint32_t g = 0; g < sheet->triangle.count; g++)
    if (g != t && !is_flat(sheet, g))
      assert_true(rivals_ask(rivals, g));
  assert_true(rivals_take_all(rivals));
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
static void compare_all(const struct sheet *sheet, struct rivals_counts *sum,
                        int *mixed) {
  struct rivals rivals;
  struct cover cover;
  rivals_init(&rivals, sheet);
  cover_init(&cover, sheet);
  for (uint32_t t = 0; t < sheet->triangle.count; t++) {
    if (is_flat(sheet, t))
      continue;
    take_by_oracle(&cover, t);
    take_all(&rivals, t);
    assert_int_equal(rivals.whole, cover.whole);
    assert_same_union(&rivals.left, &cover.left);
    if (rivals.covered)
      assert_int_equal(cover.left.count, 0);
    if (rivals.rival.count == 0)
      assert_true(cover.whole);
    *mixed += !cover.whole && cover.left.count > 0;
  }
  sum->partings += rivals.counts.partings;
  sum->crossings += rivals.counts.crossings;
  sum->exact += rivals.counts.exact;
  rivals_fini(&rivals);
  cover_fini(&cover);
}

static void what_is_left_is_what_the_oracle_leaves(void **state) {
  struct rivals_counts sum = {0};
  int mixed = 0;
  (void)state;
  for (uint64_t seed = 1; seed <= 6; seed++)
    for (int kind = 0; kind < HAND_KINDS; kind++) {
      uint64_t r = seed * HAND_KINDS + (uint64_t)kind;
      struct sheet sheet;
      hand_random_sheet(&sheet, (enum hand_kind)kind, 60, &r);
      compare_all(&sheet, &sum, &mixed);
      hand_sheet_fini(&sheet);
    }
  /* And there was something to do. */
  assert_true(mixed > 300);
  assert_true(sum.partings > 100);
  assert_true(sum.crossings > 1000);
  assert_true(sum.exact > 1000);
}

/* A long bar, and n short ones across it, in front or behind. */
static void lay_bars(struct sheet *sheet, int n, int depth) {
  const int long_bar[4][3] = {
      {0, 0, 50}, {40 * n, 7 * n, 50}, {40 * n, 7 * n + 60, 50}, {0, 60, 50}};
  hand_sheet_init(sheet);
  hand_add_face(sheet, long_bar, 4, 1024);
  for (int k = 0; k < n; k++) {
    int x = 40 * k + 10, y = 7 * k - 90;
    const int bar[4][3] = {{x, y, depth},
                           {x + 20, y, depth + k % 3},
                           {x + 24, y + 300, depth + k % 3},
                           {x + 4, y + 300, depth}};
    hand_add_face(sheet, bar, 4, 1024);
  }
}

static void bars_across_a_bar_are_met_near_by_alone(void **state) {
  uint64_t cuts[2];
  (void)state;
  for (int i = 0; i < 2; i++) {
    int n = i == 0 ? 100 : 400, mixed = 0;
    struct rivals_counts sum = {0};
    struct rivals rivals;
    struct sheet sheet;
    lay_bars(&sheet, n, 80);
    if (i == 0)
      compare_all(&sheet, &sum, &mixed);
    rivals_init(&rivals, &sheet);
    take_all(&rivals, 0);
    assert_true(rivals.counts.partings > (uint64_t)n / 4);
    assert_true(rivals.left.count >= (size_t)n / 2);
    cuts[i] = rivals.counts.cuts;
    rivals_fini(&rivals);
    hand_sheet_fini(&sheet);
  }
  /* Four times as many take four times as many cuts, not sixteen. */
  assert_true(cuts[1] < 6 * cuts[0]);
}

static void what_is_behind_is_no_rival(void **state) {
  struct rivals rivals;
  struct sheet sheet;
  (void)state;
  lay_bars(&sheet, 20, 20);
  rivals_init(&rivals, &sheet);
  take_all(&rivals, 0);
  assert_int_equal(rivals.rival.count, 0);
  assert_true(rivals.whole);
  assert_false(rivals.mingled);
  rivals_fini(&rivals);
  hand_sheet_fini(&sheet);
}

static void memory_may_run_out_anywhere(void **state) {
  struct sheet sheet;
  bool ok = false;
  (void)state;
  lay_bars(&sheet, 40, 80);
  for (unsigned long n = 1; !ok; n++) {
    struct rivals rivals;
    assert_true(n < 1000);
    rivals_init(&rivals, &sheet);
    rivals_start(&rivals, 0);
    mem_fail_after(n);
    ok = true;
    for (uint32_t g = 2; ok && g < sheet.triangle.count; g++)
      ok = rivals_ask(&rivals, g);
    ok = ok && rivals_take_all(&rivals);
    mem_fail_after(0);
    assert_true(!ok || n > 5);
    rivals_fini(&rivals);
  }
  hand_sheet_fini(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_left_is_what_the_oracle_leaves),
      cmocka_unit_test(bars_across_a_bar_are_met_near_by_alone),
      cmocka_unit_test(what_is_behind_is_no_rival),
      cmocka_unit_test(memory_may_run_out_anywhere),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
