/* test_line_index.c - a query finds every side that runs along a segment, and
 * few others. */
#include "exact_fixture/scene.h"
#include "tests/memory_faults.h"
#include "visibility/fragments/line_index.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

/* The ends of a side, the lower first; false where it is not indexed. */
static bool side_of(const struct sheet *sheet, uint32_t number,
                    struct geom_point end[2]) {
  const struct sheet_triangle *t = &sheet->triangle.item[number / 3];
  uint32_t k = number % 3;
  struct geom_point p = sheet->point.item[t->point[k]],
                    q = sheet->point.item[t->point[(k + 1) % 3]];
  bool forward = p.x < q.x || (p.x == q.x && p.y < q.y);
  end[0] = forward ? p : q;
  end[1] = forward ? q : p;
  return sheet_triangle_sides(sheet, number / 3)[k] != SHEET_NONE &&
         !sheet_is_edge_on(sheet, number / 3);
}

static bool is_lower(struct geom_point p, struct geom_point q) {
  return p.x < q.x || (p.x == q.x && p.y < q.y);
}

/* Do two sides share a stretch of one line? */
static bool share(const struct geom_point a[2], const struct geom_point b[2]) {
  return geom_orient2d(a[0], a[1], b[0]) == 0 &&
         geom_orient2d(a[0], a[1], b[1]) == 0 && is_lower(a[0], b[1]) &&
         is_lower(b[0], a[1]);
}

static bool is_found(const side_list *found, uint32_t number) {
  for (size_t i = 0; i < found->count; i++)
    if (found->item[i] == number)
      return true;
  return false;
}

static bool index_all(struct line_index *grid, const struct sheet *sheet) {
  size_t n = sheet->triangle.count;
  uint32_t *all = malloc((n + 1) * sizeof *all);
  assert_non_null(all);
  for (size_t t = 0; t < n; t++)
    all[t] = (uint32_t)t;
  bool ok = line_index_init(grid, sheet, all, n);
  free(all);
  return ok;
}

/* Asks about one side; counts those found that share a stretch, and others. */
static void query(const struct sheet *sheet, const struct line_index *grid,
                  uint32_t number, size_t count[2]) {
  struct geom_point end[2];
  struct geom_line line;
  struct geom_corner p, q;
  side_list found = {0};
  if (!side_of(sheet, number, end))
    return;
  geom_line_through(&line, end[0], end[1]);
  if (number % 2)
    line = geom_line_reversed(&line);
  p = geom_corner_at(end[0]);
  q = geom_corner_at(end[1]);
  assert_true(line_index_find(grid, &line, &p, &q, &found));
  for (uint32_t other = 0; other < 3 * sheet->triangle.count; other++) {
    struct geom_point at[2];
    if (!side_of(sheet, other, at))
      continue;
    assert_true(is_found(&found, other) || !share(end, at));
    count[share(end, at) ? 0 : 1] += is_found(&found, other);
  }
  ARRAY_FREE(&found);
}

static void what_runs_along_a_side_is_found(void **state) {
  (void)state;
  for (int kind = 0; kind < EXACT_KINDS; kind++) {
    size_t count[2] = {0, 0}, sides = 0;
    for (uint64_t seed = 1; seed <= 20; seed++) {
      uint64_t r = seed * EXACT_KINDS + (uint64_t)kind;
      struct sheet sheet;
      struct line_index grid;
      exact_random_sheet(&sheet, (enum exact_kind)kind, 40, &r);
      assert_true(index_all(&grid, &sheet));
      for (uint32_t side = 0; side < 3 * sheet.triangle.count; side++)
        query(&sheet, &grid, side, count);
      sides += 3 * sheet.triangle.count;
      line_index_fini(&grid);
      exact_sheet_fini(&sheet);
    }
    assert_true(count[0] > sides / 2); /* itself, at least */
    /* Those on the same line but apart, and the same in several cells. */
    assert_true(count[1] < count[0]); /* on the same line, but apart */
  }
}

static void memory_may_run_out(void **state) {
  uint64_t r = 7;
  struct sheet sheet;
  struct memory_faults faults = {.least = 4};
  (void)state;
  exact_random_sheet(&sheet, EXACT_MESH, 40, &r);
  while (memory_faults_go_on(&faults)) {
    struct line_index grid;
    memory_faults_begin(&faults);
    bool ok = index_all(&grid, &sheet);
    memory_faults_end(&faults, memory_faults_status(ok));
    line_index_fini(&grid);
  }
  exact_sheet_fini(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_runs_along_a_side_is_found),
      cmocka_unit_test(memory_may_run_out),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
