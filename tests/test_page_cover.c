/* test_page_cover.c - by a grid of some cells, the triangles over points of
 * these are found that a search of all triangles finds. */
#include "visibility/contour/page_cover.h"

#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "exact_fixture/scene.h"
#include "visibility/contour/occluders.h"
#include "visibility/index/partial_grid.h"

enum { TRIANGLES = 400, POINTS = 60, SPAN = 1 << 20 };

static struct geom_point random_point(uint64_t *r, int32_t around, int32_t by) {
  int32_t x = around + (int32_t)exact_random_below(r, 2 * (uint64_t)by) - by;
  int32_t y = around + (int32_t)exact_random_below(r, 2 * (uint64_t)by) - by;
  return (struct geom_point){x, y, (int64_t)exact_random_below(r, 1000)};
}

/* Triangles that run counter-clockwise, of several sizes; some are edge-on. */
static void make_triangles(struct sheet *sheet, uint64_t *r) {
  exact_sheet_init(sheet);
  sheet->triangle_flags = mem_calloc(TRIANGLES, 1);
  assert_non_null(sheet->triangle_flags);
  for (uint32_t t = 0; t < TRIANGLES; t++) {
    struct sheet_triangle made = {{3 * t, 3 * t + 1, 3 * t + 2}, t};
    struct geom_point p[3] = {random_point(r, 0, SPAN)};
    int32_t size = SPAN >> exact_random_below(r, 8);
    for (int k = 1; k < 3; k++) {
      struct geom_point by = random_point(r, 0, size);
      p[k] = (struct geom_point){p[0].x + by.x, p[0].y + by.y, by.z};
    }
    int64_t area = geom_orient2d(p[0], p[1], p[2]);
    for (int k = 0; k < 3; k++)
      assert_true(ARRAY_PUSH(&sheet->point, p[area < 0 && k > 0 ? 3 - k : k]));
    assert_true(ARRAY_PUSH(&sheet->triangle, made));
    sheet->triangle_flags[t] = area == 0 || t % 50 == 0 ? SHEET_EDGE_ON : 0;
  }
}

/* Whether a triangle lies over a point; its sides count. */
static bool lies_over(const struct sheet *sheet, uint32_t t,
                      struct geom_point p) {
  struct geom_triangle of = sheet_corners(sheet, t);
  bool inside = !sheet_is_edge_on(sheet, t);
  for (int k = 0; k < 3; k++)
    inside =
        inside && geom_orient2d(of.p[k], of.p[geom_next_corner(k)], p) >= 0;
  return inside;
}

/* As far as it is said to, the last triangle lies over the points from p to q
 * as they are rounded. */
static void check_reach(const struct page_cover *cover, struct geom_point p,
                        struct geom_point q) {
  double reach = page_cover_reach(cover, p, q);
  assert_true(reach >= 0 && reach <= 1);
  for (int i = 0; i <= 20; i++) {
    double t = reach * i / 20;
    const struct geom_point at = {(int32_t)lrint(p.x + t * ((double)q.x - p.x)),
                                  (int32_t)lrint(p.y + t * ((double)q.y - p.y)),
                                  0};
    assert_true(lies_over(cover->sheet, cover->last, at));
  }
}

static void check_points(const struct sheet *sheet, uint64_t *r) {
  struct geom_point at[POINTS];
  struct partial_grid partial = {.wanted = NULL};
  struct triangle_grid all;
  struct triangle_grid_query query, query_of_all;
  assert_true(triangle_grid_init(&all, sheet));
  assert_true(partial_grid_shape(&partial, sheet));
  for (int i = 0; i < POINTS; i++) {
    at[i] = random_point(r, 0, SPAN + SPAN / 4);
    partial_grid_want(&partial,
                      (struct box2){at[i].x, at[i].y, at[i].x, at[i].y});
  }
  assert_true(partial_grid_fill(&partial, sheet));
  assert_true(triangle_grid_query_init(&query, &partial.grid));
  assert_true(triangle_grid_query_init(&query_of_all, &all));
  struct page_cover cover = {sheet, &partial.grid, &query, SHEET_NONE};
  for (int i = 0; i < POINTS; i++) {
    bool expected = false, ok = true;
    for (uint32_t t = 0; t < TRIANGLES; t++)
      expected = expected || lies_over(sheet, t, at[i]);
    assert_int_equal(page_cover_is_over(&cover, at[i], &ok), expected);
    assert_true(ok);
    if (expected)
      check_reach(&cover, at[i], at[(i + 1) % POINTS]);
    int count = occluders_count(sheet, &all, &query_of_all, at[i], INT_MAX);
    assert_int_equal(
        occluders_count(sheet, &partial.grid, &query, at[i], INT_MAX), count);
    assert_int_equal(occluders_count(sheet, &partial.grid, &query, at[i], 1),
                     count > 0);
  }
  triangle_grid_query_fini(&query);
  triangle_grid_query_fini(&query_of_all);
  partial_grid_fini(&partial);
  triangle_grid_fini(&all);
}

static void what_lies_over_points_is_found(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 100; seed++) {
    uint64_t r = seed;
    struct sheet sheet;
    make_triangles(&sheet, &r);
    check_points(&sheet, &r);
    exact_sheet_fini(&sheet);
  }
}

/* Slivers about a point, all around it. */
static void make_fan(struct sheet *sheet, uint32_t slivers) {
  exact_sheet_init(sheet);
  sheet->triangle_flags = mem_calloc(slivers, 1);
  assert_non_null(sheet->triangle_flags);
  assert_true(ARRAY_PUSH(&sheet->point, ((struct geom_point){0, 0, 0})));
  for (uint32_t i = 0; i < slivers; i++) {
    double angle = 2 * M_PI * i / slivers;
    struct geom_point p = {(int32_t)lrint(SPAN * cos(angle)),
                           (int32_t)lrint(SPAN * sin(angle)), 0};
    struct sheet_triangle made = {{0, i + 1, i + 1 < slivers ? i + 2 : 1}, i};
    assert_true(ARRAY_PUSH(&sheet->point, p));
    assert_true(ARRAY_PUSH(&sheet->triangle, made));
  }
}

/* The longest list of the cells at a fan's rim. */
static size_t longest_list_at_rim(uint32_t slivers) {
  struct sheet sheet;
  struct partial_grid partial = {.wanted = NULL};
  size_t longest = 0;
  make_fan(&sheet, slivers);
  assert_true(partial_grid_shape(&partial, &sheet));
  for (size_t i = 1; i < sheet.point.count; i++) {
    struct geom_point p = sheet.point.item[i];
    partial_grid_want(&partial, (struct box2){p.x, p.y, p.x, p.y});
  }
  assert_true(partial_grid_fill(&partial, &sheet));
  const uint32_t *start = partial.grid.lists.start;
  size_t cells = triangle_grid_cell_count(&partial.grid);
  for (size_t c = 0; c < cells; c++)
    if (start[c + 1] - start[c] > longest)
      longest = start[c + 1] - start[c];
  assert_in_range(start[cells], slivers, 33 * slivers);
  partial_grid_fini(&partial);
  exact_sheet_fini(&sheet);
  return longest;
}

static void few_slivers_are_listed_at_a_rim(void **state) {
  (void)state;
  for (uint32_t slivers = 1024; slivers <= 16384; slivers *= 4)
    assert_in_range(longest_list_at_rim(slivers), 1, slivers / 10);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_lies_over_points_is_found),
      cmocka_unit_test(few_slivers_are_listed_at_a_rim),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
