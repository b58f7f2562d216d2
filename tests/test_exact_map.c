/* test_exact_map.c - the exact solvers on scenes whose answer is known, and
 * against each other on random ones. */
#include "exact_fixture/sheet.h"
#include "tests/scenes/solver_named.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* Scenes of small integers are blown up so that the grid's own contact, a
 * unit, is small beside them. */
enum { SCALE = 1024 };

static const struct solver *const exact[] = {&solver_brute, &solver_newell,
                                             &solver_tiles, &solver_warnock};
enum { EXACT_COUNT = sizeof exact / sizeof *exact };

static void pierced_rectangle(struct sheet *sheet) {
  static const int one[][3] = {
      {10, 5, 10}, {10, 25, 10}, {25, 25, 10}, {25, 5, 10}};
  static const int two[][3] = {{15, 15, 15}, {25, 25, 5}, {30, 10, 5}};
  exact_sheet_init(sheet);
  exact_add_face(sheet, one, 4, SCALE);
  exact_add_face(sheet, two, 3, SCALE);
}

static void pierced_rectangle_has_its_exact_areas(void **state) {
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++) {
    struct sheet sheet;
    struct map map;
    pierced_rectangle(&sheet);
    exact_solve(exact[s], &sheet, &map, NULL);
    exact_assert_area(&map, 0, SCALE, 275, 1);
    exact_assert_area(&map, 1, SCALE, 175, 3);
    assert_int_equal(map.fragment.count, 3);
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

static void pierced_rectangle_has_its_corners_and_sides(void **state) {
  /* The triangle's first fragment: (15,15) (22.5,12.5) (20,20). */
  static const double corner[3][2] = {{15, 15}, {22.5, 12.5}, {20, 20}};
  static const int side[3] = {MAP_SIDE_EDGE, MAP_SIDE_INTERSECTION,
                              MAP_SIDE_EDGE};
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++) {
    struct sheet sheet;
    struct map map;
    const struct map_fragment *fragment;
    const struct map_loop *loop;
    pierced_rectangle(&sheet);
    exact_solve(exact[s], &sheet, &map, NULL);
    fragment = &map.fragment.item[1];
    assert_int_equal(fragment->face, 1);
    assert_int_equal(fragment->loops, 1);
    loop = &map.loop.item[fragment->loop];
    assert_int_equal(loop->count, 3);
    for (int k = 0; k < 3; k++) {
      const struct map_corner *c = &map.corner.item[loop->corner + (unsigned)k];
      assert_true(c->x == corner[k][0] * SCALE && c->y == corner[k][1] * SCALE);
      assert_int_equal(c->side, side[k]);
    }
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

static void two_rectangles_and_triangle_have_their_exact_areas(void **state) {
  static const int one[][3] = {
      {10, 3, 20}, {10, 28, 20}, {22, 28, 20}, {22, 3, 20}};
  static const int two[][3] = {
      {5, 12, 10}, {5, 20, 10}, {27, 20, 10}, {27, 12, 10}};
  static const int three[][3] = {{15, 15, 25}, {25, 25, 5}, {30, 10, 5}};
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++) {
    struct sheet sheet;
    struct map map;
    exact_sheet_init(&sheet);
    exact_add_face(&sheet, one, 4, SCALE);
    exact_add_face(&sheet, two, 4, SCALE);
    exact_add_face(&sheet, three, 3, SCALE);
    exact_solve(exact[s], &sheet, &map, NULL);
    exact_assert_area(&map, 0, SCALE, 1175, 4);
    exact_assert_area(&map, 1, SCALE, 178, 3);
    exact_assert_area(&map, 2, SCALE, 661, 12);
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

/* A wall goes through a floor just where the floor's diagonal runs: neither
 * of the floor's triangles straddles the wall's plane, but the floor does. */
static void a_crossing_along_a_diagonal_is_drawn(void **state) {
  static const int floor[][3] = {
      {0, 0, 10}, {20, 0, 10}, {20, 20, 10}, {0, 20, 10}};
  static const int wall[][3] = {
      {10, 2, 18}, {18, 10, 18}, {10, 18, 2}, {2, 10, 2}};
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++) {
    struct sheet sheet;
    struct map map;
    int low = 99, high = 0, found = 0;
    exact_sheet_init(&sheet);
    exact_add_face(&sheet, floor, 4, SCALE);
    exact_add_face(&sheet, wall, 4, SCALE);
    exact_solve(exact[s], &sheet, &map, NULL);
    for (size_t e = 0; e < sheet.edge.count; e++) {
      if (sheet.edge.item[e].edge_class != RECTO_EDGE_INTERSECTION)
        continue;
      found++;
      assert_int_equal(map.edge_state[e], MAP_VISIBLE);
      for (int k = 0; k < 2; k++) {
        struct geom_point p = sheet.point.item[sheet.edge.item[e].point[k]];
        assert_int_equal(p.x, p.y);
        assert_int_equal(p.z, 10 * SCALE);
        if (p.x / SCALE < low)
          low = p.x / SCALE;
        if (p.x / SCALE > high)
          high = p.x / SCALE;
      }
    }
    assert_int_equal(found, 2); /* the wall has a diagonal of its own */
    assert_int_equal(low, 6);
    assert_int_equal(high, 14);
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

/* Where the wall only stands on the floor's diagonal, nothing is crossed. */
static void standing_on_a_diagonal_is_no_crossing(void **state) {
  static const int floor[][3] = {
      {0, 0, 10}, {20, 0, 10}, {20, 20, 10}, {0, 20, 10}};
  static const int wall[][3] = {
      {10, 2, 18}, {18, 10, 18}, {14, 14, 10}, {6, 6, 10}};
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++) {
    struct sheet sheet;
    struct map map;
    exact_sheet_init(&sheet);
    exact_add_face(&sheet, floor, 4, SCALE);
    exact_add_face(&sheet, wall, 4, SCALE);
    exact_solve(exact[s], &sheet, &map, NULL);
    for (size_t e = 0; e < sheet.edge.count; e++)
      assert_int_not_equal(sheet.edge.item[e].edge_class,
                           RECTO_EDGE_INTERSECTION);
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

/* Three bars, each over the next: (x, y) boxes with tilted depth. */
static void add_cycle(struct sheet *sheet, int x, int y) {
  const int a[][3] = {{x + 0, y + 0, 10},
                      {x + 2, y + 0, 10},
                      {x + 12, y + 20, 30},
                      {x + 10, y + 20, 30}};
  const int b[][3] = {{x + 8, y + 20, 10},
                      {x + 10, y + 22, 10},
                      {x + 22, y + 2, 30},
                      {x + 20, y + 0, 30}};
  const int c[][3] = {{x + 24, y + 4, 10},
                      {x + 24, y + 6, 10},
                      {x - 2, y + 6, 30},
                      {x - 2, y + 4, 30}};
  exact_add_face(sheet, a, 4, SCALE);
  exact_add_face(sheet, b, 4, SCALE);
  exact_add_face(sheet, c, 4, SCALE);
}

static struct exact_area sum_areas(const struct map *map) {
  struct exact_area sum = {0};
  for (size_t f = 0; f < map->fragment.count; f++)
    exact_add_area(&sum, map, f);
  return sum;
}

static void a_field_of_cycles_is_right(void **state) {
  struct sheet sheet;
  struct map one[EXACT_COUNT], field[EXACT_COUNT];
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++) {
    struct report *report = report_create();
    exact_sheet_init(&sheet);
    add_cycle(&sheet, 0, 0);
    exact_solve(exact[s], &sheet, &one[s], report);
    if (exact[s] == &solver_newell)
      assert_true(report_get(report, "newell", "splits_by_cycle", 0) > 0);
    report_destroy(report);
    exact_sheet_fini(&sheet);
    exact_sheet_init(&sheet);
    for (int y = 0; y < 10; y++)
      for (int x = 0; x < 10; x++)
        add_cycle(&sheet, 30 * x, 30 * y);
    exact_solve(exact[s], &sheet, &field[s], NULL);
    exact_sheet_fini(&sheet);
    struct exact_area a = sum_areas(&one[s]), b = sum_areas(&field[s]);
    assert_true(fabs(100 * a.twice - b.twice) <= 100 * a.error + b.error);
  }
  for (int s = 1; s < EXACT_COUNT; s++) {
    exact_assert_same_map(&one[0], &one[s], "a cycle");
    exact_assert_same_map(&field[0], &field[s], "a field of cycles");
  }
  for (int s = 0; s < EXACT_COUNT; s++) {
    map_fini(&one[s]);
    map_fini(&field[s]);
  }
}

/* A random scene on a small lattice, so that touching, coplanar, edge-on and
 * coinciding parts are common. */
static void random_scene(struct sheet *sheet, uint64_t seed) {
  uint64_t r = seed;
  int faces = 2 + exact_random_below(&r, 9),
      lattice = 2 + exact_random_below(&r, 8);
  int scale = 1 << (4 + exact_random_below(&r, 10));
  exact_sheet_init(sheet);
  if (exact_random_below(&r, 3) == 0)
    sheet->camera.contact = sheet->camera.contact_most = scale / 4;
  for (int f = 0; f < faces; f++) {
    int corner[4][3], count = 3;
    for (int k = 0; k < 3; k++)
      for (int i = 0; i < 3; i++)
        corner[k][i] = exact_random_below(&r, lattice);
    if (exact_random_below(&r, 3) == 0) { /* a parallelogram */
      count = 4;
      for (int i = 0; i < 3; i++) {
        corner[3][i] = corner[2][i];
        corner[2][i] += corner[1][i] - corner[0][i];
        if (i == 2 && (corner[2][i] < 0))
          count = 3;
      }
      if (count == 3)
        for (int i = 0; i < 3; i++)
          corner[2][i] = corner[3][i];
    }
    if (memcmp(corner[0], corner[1], sizeof corner[0]) != 0 &&
        memcmp(corner[1], corner[2], sizeof corner[0]) != 0 &&
        memcmp(corner[0], corner[2], sizeof corner[0]) != 0)
      exact_add_face(sheet, (const int(*)[3])corner, count, scale);
  }
}

static void solvers_agree_on_random_scenes(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 2000; seed++) {
    struct sheet first, other;
    struct map map, again;
    char what[64];
    random_scene(&first, seed);
    exact_solve(exact[0], &first, &map, NULL);
    for (int s = 1; s < EXACT_COUNT; s++) {
      random_scene(&other, seed);
      snprintf(what, sizeof what, "seed %u, %s", (unsigned)seed,
               solver_name(exact[s]));
      exact_solve(exact[s], &other, &again, NULL);
      exact_assert_same_map(&map, &again, what);
      map_fini(&again);
      exact_sheet_fini(&other);
    }
    map_fini(&map);
    exact_sheet_fini(&first);
  }
}

/* Many large triangles over each other, so that single ones surround tiles and
 * windows, most of them nearly level; a tenth of the corners at a
 * lattice's coarse points. */
static void deep_soup(struct sheet *sheet, uint64_t seed, int faces) {
  uint64_t r = seed;
  exact_sheet_init(sheet);
  sheet->camera.contact = sheet->camera.contact_most = seed % 2 == 0 ? 0 : 500;
  for (int f = 0; f < faces; f++) {
    int corner[3][3], level = exact_random_below(&r, 2900);
    bool steep = exact_random_below(&r, 20) == 0;
    for (int k = 0; k < 3; k++)
      for (int i = 0; i < 3; i++) {
        corner[k][i] = exact_random_below(&r, 3000);
        if (i == 2 && !steep)
          corner[k][i] = level + corner[k][i] / 100;
        if (exact_random_below(&r, 20) == 0)
          corner[k][i] = exact_random_below(&r, 4) * 1000;
        if (i == 2)
          corner[k][i] *= 10;
      }
    exact_add_face(sheet, (const int(*)[3])corner, 3, SCALE / 4);
  }
}

/* Newell's splits go with a high power of the faces: he gets a thinner soup
 * than culling needs to pay. */
static void check_soup(uint64_t seed, int faces, bool thin) {
  struct sheet first, other;
  struct map map, again;
  deep_soup(&first, seed, faces);
  exact_solve(exact[0], &first, &map, NULL);
  for (int s = 1; s < EXACT_COUNT; s++) {
    struct report *report;
    if (exact[s] == &solver_newell && !thin)
      continue;
    report = report_create();
    deep_soup(&other, seed, faces);
    exact_solve(exact[s], &other, &again, report);
    if (exact[s] == &solver_tiles && !thin)
      assert_true(report_get(report, "tiles", "triangles_culled", 0) > 0);
    exact_assert_visible_same(&map, &first, &again, &other,
                              solver_name(exact[s]));
    report_destroy(report);
    map_fini(&again);
    exact_sheet_fini(&other);
  }
  map_fini(&map);
  exact_sheet_fini(&first);
}

static void solvers_agree_on_deep_soups(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 2; seed++) {
    check_soup(seed, 700, false);
    check_soup(seed, 60, true);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(pierced_rectangle_has_its_exact_areas),
      cmocka_unit_test(pierced_rectangle_has_its_corners_and_sides),
      cmocka_unit_test(two_rectangles_and_triangle_have_their_exact_areas),
      cmocka_unit_test(a_crossing_along_a_diagonal_is_drawn),
      cmocka_unit_test(standing_on_a_diagonal_is_no_crossing),
      cmocka_unit_test(a_field_of_cycles_is_right),
      cmocka_unit_test(solvers_agree_on_random_scenes),
      cmocka_unit_test(solvers_agree_on_deep_soups),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
