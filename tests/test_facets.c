/* test_facets.c - triangles joined to planar convex facets. */
#include "exact_fixture/sheet.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/memory_faults.h"
#include "visibility/scan/facets.h"

enum { SCALE = 1000 };

static struct geom_point point_at(const struct sheet *sheet, uint32_t point) {
  return sheet->point.item[point];
}

/* Twice the area of a loop of points on the page. */
static int64_t area2(const struct sheet *sheet, const uint32_t *corner,
                     uint32_t count) {
  int64_t sum = 0;
  for (uint32_t k = 2; k < count; k++)
    sum += geom_orient2d(point_at(sheet, corner[0]),
                         point_at(sheet, corner[k - 1]),
                         point_at(sheet, corner[k]));
  return sum;
}

/* Facets are convex, in the plane of the triangle they are known by, have its
 * triangles' sides, and tile the triangles.  Returns how many there are. */
static int check_facets(const struct facets *facets,
                        const struct sheet *sheet) {
  int64_t all = 0, joined = 0;
  int count = 0;
  for (uint32_t t = 0; t < sheet->triangle.count; t++) {
    const struct sheet_triangle *triangle = &sheet->triangle.item[t];
    const uint32_t *corner, *side;
    uint32_t n;
    struct geom_plane plane =
        geom_plane_of(point_at(sheet, triangle->point[0]),
                      point_at(sheet, triangle->point[1]),
                      point_at(sheet, triangle->point[2]));
    all += area2(sheet, triangle->point, 3);
    assert_true(facet_of(facets, t) <= t);
    if (facet_of(facets, t) != t)
      continue;
    count++;
    n = facet_outline(facets, sheet, t, &corner, &side);
    assert_in_range(n, 3, FACET_CORNERS_MAX);
    joined += area2(sheet, corner, n);
    for (uint32_t k = 0; k < n; k++) {
      struct geom_point a = point_at(sheet, corner[k]);
      struct geom_point b = point_at(sheet, corner[(k + 1) % n]);
      struct geom_point c = point_at(sheet, corner[(k + 2) % n]);
      assert_true(geom_orient2d(a, b, c) >= 0);
      assert_true(geom_plane_value(&plane, a) == 0);
      if (side[k] != SHEET_NONE) {
        const struct sheet_edge *edge = &sheet->edge.item[side[k]];
        assert_true((edge->point[0] == corner[k] &&
                     edge->point[1] == corner[(k + 1) % n]) ||
                    (edge->point[1] == corner[k] &&
                     edge->point[0] == corner[(k + 1) % n]));
      }
    }
  }
  assert_int_equal(all, joined);
  return count;
}

static int count_facets(const int corner[][3], int count) {
  struct sheet sheet;
  struct facets facets;
  int facet_count;
  exact_sheet_init(&sheet);
  exact_add_face(&sheet, corner, count, SCALE);
  assert_true(facets_init(&facets, &sheet));
  facet_count = check_facets(&facets, &sheet);
  facets_fini(&facets);
  exact_sheet_fini(&sheet);
  return facet_count;
}

static void quad_is_one_facet_either_way_round(void **state) {
  static const int front[][3] = {{0, 0, 5}, {8, 1, 6}, {9, 9, 8}, {1, 8, 7}};
  static const int back[][3] = {{1, 8, 7}, {9, 9, 8}, {8, 1, 6}, {0, 0, 5}};
  (void)state;
  assert_int_equal(count_facets(front, 4), 1);
  assert_int_equal(count_facets(back, 4), 1);
}

static void regular_octagon_is_one_facet(void **state) {
  static const int octagon[][3] = {{3, 0, 4},  {7, 0, 4},  {10, 3, 4},
                                   {10, 7, 4}, {7, 10, 4}, {3, 10, 4},
                                   {0, 7, 4},  {0, 3, 4}};
  (void)state;
  assert_int_equal(count_facets(octagon, 8), 1);
}

static void concave_face_is_several_convex_facets(void **state) {
  /* A chevron, a fan from its notch. */
  static const int chevron[][3] = {
      {5, 4, 1}, {10, 0, 1}, {5, 10, 1}, {0, 0, 1}};
  (void)state;
  assert_int_equal(count_facets(chevron, 4), 2);
}

static void warped_face_keeps_its_triangles(void **state) {
  static const int warped[][3] = {
      {0, 0, 100}, {9, 0, 100}, {9, 9, 101}, {0, 9, 100}};
  (void)state;
  assert_int_equal(count_facets(warped, 4), 2);
}

static void faces_are_never_joined_with_each_other(void **state) {
  static const int left[][3] = {{0, 0, 3}, {5, 0, 3}, {5, 5, 3}, {0, 5, 3}};
  static const int right[][3] = {{5, 0, 3}, {9, 0, 3}, {9, 5, 3}, {5, 5, 3}};
  struct sheet sheet;
  struct facets facets;
  (void)state;
  exact_sheet_init(&sheet);
  exact_add_face(&sheet, left, 4, SCALE);
  exact_add_face(&sheet, right, 4, SCALE);
  assert_true(facets_init(&facets, &sheet));
  assert_int_equal(check_facets(&facets, &sheet), 2);
  assert_int_equal(facet_of(&facets, 1), 0);
  assert_int_equal(facet_of(&facets, 3), 2);
  facets_fini(&facets);
  exact_sheet_fini(&sheet);
}

static void triangles_alone_need_no_memory(void **state) {
  static const int one[][3] = {{0, 0, 3}, {5, 0, 3}, {5, 5, 3}};
  struct sheet sheet;
  struct facets facets;
  (void)state;
  exact_sheet_init(&sheet);
  for (int i = 0; i < 3; i++)
    exact_add_face(&sheet, one, 3, SCALE);
  assert_true(facets_init(&facets, &sheet));
  assert_null(facets.part);
  assert_int_equal(check_facets(&facets, &sheet), 3);
  facets_fini(&facets);
  exact_sheet_fini(&sheet);
}

/* Adds a flat grid as one face of 2 n^2 triangles, only its rim drawn. */
static void add_grid(struct sheet *sheet, int n) {
  exact_sheet_init(sheet);
  for (int i = 0; i <= n; i++)
    for (int j = 0; j <= n; j++) {
      struct geom_point p = {j * 10, i * 10, i * 7 + j * 3 + 50};
      assert_true(ARRAY_PUSH(&sheet->point, p));
    }
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      uint32_t a = (uint32_t)(i * (n + 1) + j), b = a + 1;
      uint32_t c = b + (uint32_t)n + 1, d = a + (uint32_t)n + 1;
      struct sheet_triangle t = {{a, b, c}, 0}, u = {{a, c, d}, 0};
      assert_true(ARRAY_PUSH(&sheet->triangle, t));
      assert_true(ARRAY_PUSH(&sheet->triangle, u));
    }
  assert_true(sheet_find_sides(sheet));
  sheet->triangle_flags = mem_calloc(sheet->triangle.count, 1);
}

static void large_face_is_tiled_by_bounded_facets(void **state) {
  struct sheet sheet;
  struct facets facets;
  (void)state;
  add_grid(&sheet, 40);
  assert_true(facets_init(&facets, &sheet));
  assert_true(check_facets(&facets, &sheet) < 3200 / 2);
  facets_fini(&facets);
  exact_sheet_fini(&sheet);
}

static void flat_triangles_stay_alone(void **state) {
  struct sheet sheet;
  struct facets facets;
  const uint32_t *corner, *side;
  (void)state;
  add_grid(&sheet, 1);
  sheet.point.item[2].x = 10;
  sheet.point.item[2].y = 20;
  sheet.triangle_flags[1] = SHEET_EDGE_ON;
  assert_true(facets_init(&facets, &sheet));
  assert_int_equal(facet_outline(&facets, &sheet, 0, &corner, &side), 3);
  assert_int_equal(facet_of(&facets, 1), 1);
  facets_fini(&facets);
  exact_sheet_fini(&sheet);
}

static void running_out_of_memory_is_reported(void **state) {
  struct sheet sheet;
  struct facets facets;
  struct memory_faults faults = {.least = 4};
  (void)state;
  add_grid(&sheet, 4);
  while (memory_faults_go_on(&faults)) {
    memory_faults_begin(&faults);
    bool ok = facets_init(&facets, &sheet);
    memory_faults_end(&faults, memory_faults_status(ok));
    assert_true(ok || facets.part == NULL);
  }
  facets_fini(&facets);
  exact_sheet_fini(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(quad_is_one_facet_either_way_round),
      cmocka_unit_test(regular_octagon_is_one_facet),
      cmocka_unit_test(concave_face_is_several_convex_facets),
      cmocka_unit_test(warped_face_keeps_its_triangles),
      cmocka_unit_test(faces_are_never_joined_with_each_other),
      cmocka_unit_test(triangles_alone_need_no_memory),
      cmocka_unit_test(large_face_is_tiled_by_bounded_facets),
      cmocka_unit_test(flat_triangles_stay_alone),
      cmocka_unit_test(running_out_of_memory_is_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
