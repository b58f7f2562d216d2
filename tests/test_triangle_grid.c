/* test_triangle_grid.c - a query of the grid finds what a search of all
 * triangles finds. */
#include "exact_fixture/scene.h"
#include "visibility/index/triangle_grid.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define XY_MAX ((1 << 30) - 1)

/* ---- Sheets with many triangles ------------------------------------------ */

enum triangle_mix {
  MIX_SMALL, /* small triangles all over the page */
  MIX_LONG,  /* from end to end */
  MIX_MIXED, /* a few large ones, and many in one small place */
  MIX_POINT, /* all without extent, at one point */
  MIX_LEVEL, /* on one level line */
  MIX_KINDS
};

static int32_t draw(uint64_t *r, int32_t middle, int32_t reach) {
  int64_t v = (int64_t)middle - reach +
              (int64_t)(exact_random(r) % (2 * (uint64_t)reach + 1));
  return (int32_t)(v < -XY_MAX ? -XY_MAX : v > XY_MAX ? XY_MAX : v);
}

static void make_triangles(struct sheet *sheet, enum triangle_mix kind,
                           uint32_t count, uint64_t *r) {
  exact_sheet_init(sheet);
  for (uint32_t t = 0; t < count; t++) {
    struct sheet_triangle triangle = {{3 * t, 3 * t + 1, 3 * t + 2}, t};
    int32_t x = draw(r, 0, XY_MAX), y = draw(r, 0, XY_MAX), reach = XY_MAX / 64;
    if (kind == MIX_LONG)
      reach = XY_MAX;
    if (kind == MIX_MIXED && t > 10)
      x = 5, y = 7, reach = 1000;
    if (kind == MIX_MIXED && t <= 10)
      reach = XY_MAX;
    for (int k = 0; k < 3; k++) {
      struct geom_point p = {draw(r, x, reach), draw(r, y, reach), 0};
      if (kind == MIX_POINT)
        p.x = p.y = -77;
      if (kind == MIX_LEVEL)
        p.y = 12345;
      assert_true(ARRAY_PUSH(&sheet->point, p));
    }
    assert_true(ARRAY_PUSH(&sheet->triangle, triangle));
  }
  sheet->triangle_flags = mem_calloc(count, 1);
}

static void check_memory(const struct triangle_grid *grid, size_t triangles) {
  size_t cells = triangle_grid_cell_count(grid);
  assert_true(cells <= 2 * triangles + 64);
  /* A box of w x h cells may stand in (w + 1) x (h + 1): four times at most. */
  assert_true(grid->lists.start[cells] <= 4 * (8 * triangles + 64));
}

/* ---- Queries ------------------------------------------------------------- */

/* Each triangle was found at most once; returns which, one byte each. */
static uint8_t *found_flags(const struct triangle_grid_query *query,
                            size_t count) {
  uint8_t *flag = calloc(count + 1, 1);
  assert_non_null(flag);
  for (size_t i = 0; i < query->found.count; i++) {
    assert_true(query->found.item[i] < count);
    assert_int_equal(flag[query->found.item[i]], 0);
    flag[query->found.item[i]] = 1;
  }
  return flag;
}

static void check_box(const struct sheet *sheet,
                      const struct triangle_grid *grid, struct box2 box,
                      struct triangle_grid_query *query) {
  uint8_t *flag;
  assert_true(triangle_grid_find(grid, box, query));
  flag = found_flags(query, sheet->triangle.count);
  for (uint32_t t = 0; t < sheet->triangle.count; t++)
    if (!triangle_grid_leaves_out(grid, t) &&
        !box2_disjoint(box, box2_of_triangle(sheet, t)))
      assert_int_equal(flag[t], 1);
  free(flag);
}

/* Does the segment from p to q meet the closed box?  By the signs of the box's
 * corners to the segment's line, and their boxes. */
static bool meets(struct geom_point p, struct geom_point q, struct box2 box) {
  bool left = false, right = false;
  if (box2_disjoint(box2_of_segment(p, q), box))
    return false;
  for (int k = 0; k < 4; k++) {
    struct geom_point c = {k % 2 ? box.x1 : box.x0, k / 2 ? box.y1 : box.y0, 0};
    int64_t side = geom_orient2d(p, q, c);
    left |= side >= 0;
    right |= side <= 0;
  }
  return left && right;
}

static void check_along(const struct sheet *sheet,
                        const struct triangle_grid *grid, struct geom_point p,
                        struct geom_point q,
                        struct triangle_grid_query *query) {
  uint8_t *flag;
  assert_true(triangle_grid_find_along(grid, p, q, query));
  flag = found_flags(query, sheet->triangle.count);
  for (uint32_t t = 0; t < sheet->triangle.count; t++)
    if (!triangle_grid_leaves_out(grid, t) &&
        meets(p, q, box2_of_triangle(sheet, t)))
      assert_int_equal(flag[t], 1);
  free(flag);
}

/* A point of the page, on a border of the grid's cells now and then. */
static struct geom_point draw_point(const struct triangle_grid *grid,
                                    uint64_t *r) {
  struct geom_point p = {draw(r, 0, XY_MAX), draw(r, 0, XY_MAX), 0};
  int64_t cell = INT64_C(1) << grid->shift;
  if (exact_random_below(r, 3) == 0)
    p.x = (int32_t)(grid->x0 + (p.x - (int64_t)grid->x0) / cell * cell);
  if (exact_random_below(r, 3) == 0)
    p.y = (int32_t)(grid->y0 + (p.y - (int64_t)grid->y0) / cell * cell);
  if (exact_random_below(r, 8) == 0)
    p.x = exact_random_below(r, 2) ? XY_MAX : -XY_MAX;
  if (exact_random_below(r, 8) == 0)
    p.y = exact_random_below(r, 2) ? XY_MAX : -XY_MAX;
  return p;
}

/* Two that are listed, and first in the file, stand for one that is not. */
static void check_left_out(const struct sheet *sheet,
                           const struct triangle_grid *grid) {
  for (uint32_t t = 0; t < sheet->triangle.count; t++) {
    int standing = 0;
    if (!triangle_grid_leaves_out(grid, t))
      continue;
    for (uint32_t s = 0; s < t && standing < 2; s++) {
      bool same = !triangle_grid_leaves_out(grid, s);
      for (int k = 0; k < 3; k++)
        same &= geom_same_point(
            sheet->point.item[sheet->triangle.item[s].point[k]],
            sheet->point.item[sheet->triangle.item[t].point[k]]);
      standing += same;
    }
    assert_int_equal(standing, 2);
  }
}

static void check_queries(const struct sheet *sheet, int rounds, uint64_t *r) {
  struct triangle_grid grid;
  struct triangle_grid_query query;
  assert_true(triangle_grid_init(&grid, sheet));
  assert_true(triangle_grid_query_init(&query, &grid));
  check_memory(&grid, sheet->triangle.count);
  check_left_out(sheet, &grid);
  for (int i = 0; i < rounds; i++) {
    struct geom_point p = draw_point(&grid, r), q = draw_point(&grid, r);
    switch (exact_random_below(r, 4)) { /* level, upright, nearly level */
    case 0:
      q.y = p.y;
      break;
    case 1:
      q.x = p.x;
      break;
    case 2:
      q.y = p.y < XY_MAX ? p.y + 1 : p.y - 1;
      break;
    default:
      break;
    }
    check_along(sheet, &grid, p, q, &query);
    check_along(sheet, &grid, q, p, &query);
    check_box(sheet, &grid, box2_of_segment(p, q), &query);
    q = p;
    check_box(sheet, &grid, box2_of_segment(p, q), &query);
    check_along(sheet, &grid, p, q, &query);
  }
  triangle_grid_query_fini(&query);
  triangle_grid_fini(&grid);
}

static void queries_find_all_that_is_there(void **state) {
  (void)state;
  for (int kind = 0; kind < MIX_KINDS; kind++)
    for (uint64_t seed = 1; seed <= 4; seed++) {
      uint64_t r = seed;
      struct sheet sheet;
      make_triangles(&sheet, (enum triangle_mix)kind, 700, &r);
      check_queries(&sheet, 150, &r);
      exact_sheet_fini(&sheet);
    }
}

static void queries_find_all_of_small_sheets(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 700; seed++) {
    uint64_t r = seed;
    struct sheet sheet;
    exact_random_sheet(&sheet, (enum exact_kind)(seed % EXACT_KINDS),
                       exact_random_below(&r, 12), &r);
    check_queries(&sheet, 5, &r);
    for (size_t e = 0; e < sheet.edge.count; e++) {
      const struct sheet_edge *edge = &sheet.edge.item[e];
      struct triangle_grid grid;
      struct triangle_grid_query query;
      assert_true(triangle_grid_init(&grid, &sheet));
      assert_true(triangle_grid_query_init(&query, &grid));
      check_along(&sheet, &grid, sheet.point.item[edge->point[0]],
                  sheet.point.item[edge->point[1]], &query);
      triangle_grid_query_fini(&query);
      triangle_grid_fini(&grid);
    }
    exact_sheet_fini(&sheet);
  }
}

/* Finding little is what the grid is for. */
static void a_small_box_finds_few_of_many(void **state) {
  enum { COUNT = 20000 };
  uint64_t r = 9;
  size_t found = 0;
  struct sheet sheet;
  struct triangle_grid grid;
  struct triangle_grid_query query;
  (void)state;
  make_triangles(&sheet, MIX_SMALL, COUNT, &r);
  for (size_t p = 0; p < sheet.point.count; p++) { /* shrink them */
    struct geom_point *at = &sheet.point.item[p],
                      *first = &sheet.point.item[p - p % 3];
    at->x = first->x + (at->x - first->x) / 64;
    at->y = first->y + (at->y - first->y) / 64;
  }
  assert_true(triangle_grid_init(&grid, &sheet));
  assert_true(triangle_grid_query_init(&query, &grid));
  check_memory(&grid, COUNT);
  for (int i = 0; i < 1000; i++) {
    struct geom_point p = {draw(&r, 0, XY_MAX), draw(&r, 0, XY_MAX), 0};
    assert_true(triangle_grid_find(&grid, box2_of_segment(p, p), &query));
    found += query.found.count;
  }
  assert_true(found < 1000 * 20);
  triangle_grid_query_fini(&query);
  triangle_grid_fini(&grid);
  exact_sheet_fini(&sheet);
}

static void lists_are_ascending(void **state) {
  uint64_t r = 3;
  struct sheet sheet;
  struct triangle_grid grid;
  (void)state;
  make_triangles(&sheet, MIX_MIXED, 3000, &r);
  assert_true(triangle_grid_init(&grid, &sheet));
  for (size_t c = 0; c < triangle_grid_cell_count(&grid); c++)
    for (uint32_t i = grid.lists.start[c] + 1; i < grid.lists.start[c + 1]; i++)
      assert_true(grid.lists.item[i - 1] < grid.lists.item[i]);
  triangle_grid_fini(&grid);
  exact_sheet_fini(&sheet);
}

static void an_empty_sheet_has_an_empty_grid(void **state) {
  struct sheet sheet;
  struct triangle_grid grid;
  struct triangle_grid_query query;
  (void)state;
  exact_sheet_init(&sheet);
  assert_true(triangle_grid_init(&grid, &sheet));
  assert_true(triangle_grid_query_init(&query, &grid));
  assert_true(triangle_grid_find(
      &grid, (struct box2){-XY_MAX, -XY_MAX, XY_MAX, XY_MAX}, &query));
  assert_int_equal(query.found.count, 0);
  assert_true(triangle_grid_find_along(&grid, (struct geom_point){-9, -9, 0},
                                       (struct geom_point){9, 9, 0}, &query));
  assert_int_equal(query.found.count, 0);
  triangle_grid_query_fini(&query);
  triangle_grid_fini(&grid);
  exact_sheet_fini(&sheet);
}

/* The stamps that mark what was found already do not overflow. */
static void a_query_survives_an_overflow_of_its_counter(void **state) {
  uint64_t r = 5;
  struct sheet sheet;
  struct triangle_grid grid;
  struct triangle_grid_query query;
  const struct box2 all = {-XY_MAX, -XY_MAX, XY_MAX, XY_MAX};
  (void)state;
  make_triangles(&sheet, MIX_LONG, 100, &r);
  assert_true(triangle_grid_init(&grid, &sheet));
  assert_true(triangle_grid_query_init(&query, &grid));
  assert_true(triangle_grid_find(&grid, all, &query));
  for (uint16_t left = 0; left < 3; left++) {
    /* Before the overflow all have the number of a query after it. */
    query.now = left;
    assert_true(triangle_grid_find(&grid, all, &query));
    query.now = UINT16_MAX - left;
    for (int i = 0; i < 6; i++) {
      assert_true(triangle_grid_find(&grid, all, &query));
      assert_int_equal(query.found.count, 100);
    }
  }
  triangle_grid_query_fini(&query);
  triangle_grid_fini(&grid);
  exact_sheet_fini(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(an_empty_sheet_has_an_empty_grid),
      cmocka_unit_test(lists_are_ascending),
      cmocka_unit_test(queries_find_all_that_is_there),
      cmocka_unit_test(queries_find_all_of_small_sheets),
      cmocka_unit_test(a_small_box_finds_few_of_many),
      cmocka_unit_test(a_query_survives_an_overflow_of_its_counter),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
