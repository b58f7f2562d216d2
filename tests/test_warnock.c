/* test_warnock.c - subdivision in lines: the exact map however windows are
 * divided, each kind of window, and no test made twice. */
#include "exact_fixture/sheet.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

enum { SCALE = 1024 };

/* What is requested, and how windows are divided. */
static struct solver_request request_of(bool fragments, bool by_box) {
  return (struct solver_request){.edges = true,
                                 .fragments = fragments,
                                 .intersections = true,
                                 .threads = 1,
                                 .divide_by_box = by_box};
}

/* ---- Scenes -------------------------------------------------------------- */

/* Triangles all over a lattice of which about `size` steps each are covered. */
static void random_scene(struct sheet *sheet, uint64_t seed, int faces,
                         int lattice, int size) {
  uint64_t r = seed;
  exact_sheet_init(sheet);
  for (int f = 0; f < faces; f++) {
    int corner[3][3], x = exact_random_below(&r, lattice),
                      y = exact_random_below(&r, lattice);
    for (int k = 0; k < 3; k++) {
      corner[k][0] = x + exact_random_below(&r, size);
      corner[k][1] = y + exact_random_below(&r, size);
      corner[k][2] = exact_random_below(&r, lattice);
    }
    if ((corner[0][0] != corner[1][0] || corner[0][1] != corner[1][1]) &&
        (corner[1][0] != corner[2][0] || corner[1][1] != corner[2][1]) &&
        (corner[2][0] != corner[0][0] || corner[2][1] != corner[0][1]))
      exact_add_face(sheet, (const int(*)[3])corner, 3, SCALE);
  }
}

/* A wall and n x n small tents, all sloping alike. */
static void tents_and_a_wall(struct sheet *sheet, int n, int wall_z,
                             int slope) {
  int far = 8 * n + 8, right = wall_z + slope * far, left = wall_z - slope * 8;
  const int wall[][3] = {
      {-8, -8, left}, {far, -8, right}, {far, far, right}, {-8, far, left}};
  exact_sheet_init(sheet);
  exact_add_face(sheet, wall, 4, SCALE);
  for (int y = 0; y < n; y++)
    for (int x = 0; x < n; x++) {
      int z = slope * 8 * x;
      const int tent[][3] = {{8 * x, 8 * y, z + 10 + x},
                             {8 * x + 6, 8 * y + 1, z + 6 * slope + 12 + y},
                             {8 * x + 3, 8 * y + 7, z + 3 * slope + 20}};
      exact_add_face(sheet, tent, 3, SCALE);
    }
}

/* ---- The exact map ------------------------------------------------------- */

static void assert_brute_says_the_same(void (*fill)(struct sheet *, uint64_t),
                                       uint64_t seed, bool fragments) {
  struct solver_request request = request_of(fragments, false);
  struct sheet first;
  struct map want;
  fill(&first, seed);
  assert_int_equal(exact_solve_as(&solver_brute, &request, &first, &want, NULL),
                   RECTO_OK);
  for (int by_box = 0; by_box < 2; by_box++) {
    struct sheet sheet;
    struct map map;
    char what[64];
    request = request_of(fragments, by_box == 1);
    snprintf(what, sizeof what, "seed %u, %s", (unsigned)seed,
             by_box ? "box" : "four");
    fill(&sheet, seed);
    assert_int_equal(
        exact_solve_as(&solver_warnock, &request, &sheet, &map, NULL),
        RECTO_OK);
    exact_assert_same_map(&want, &map, what);
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
  map_fini(&want);
  exact_sheet_fini(&first);
}

/* Few faces on a small lattice: all kinds of contact, one or two windows. */
static void dense(struct sheet *sheet, uint64_t seed) {
  random_scene(sheet, seed, 14 + (int)(seed % 20), 3 + (int)(seed % 6), 4);
}

/* More faces than a window may hold, some large: many divisions. */
static void spread(struct sheet *sheet, uint64_t seed) {
  random_scene(sheet, seed, 60, 64, seed % 3 == 0 ? 48 : 12);
}

static void dense_scenes_have_the_map_of_brute(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 250; seed++)
    assert_brute_says_the_same(dense, seed, seed % 4 != 0);
}

static void sparse_scenes_have_the_map_of_brute(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 40; seed++)
    assert_brute_says_the_same(spread, seed, seed % 4 != 0);
}

static void tents(struct sheet *sheet, uint64_t seed) {
  tents_and_a_wall(sheet, 4 + (int)(seed % 3), 8 + (int)seed, (int)seed % 5);
}

/* The wall behind, among, and before the tents. */
static void walls_at_any_depth_have_the_map_of_brute(void **state) {
  (void)state;
  for (uint64_t seed = 0; seed < 24; seed++)
    assert_brute_says_the_same(tents, seed, seed % 2 == 0);
}

/* ---- Windows ------------------------------------------------------------- */

static int64_t count_of(const struct report *report, const char *name) {
  int64_t count = report_get(report, "warnock", name, -1);
  assert_true(count >= 0);
  return count;
}

static struct report *solve_and_report(struct sheet *sheet, bool fragments,
                                       bool by_box) {
  const struct solver_request request = request_of(fragments, by_box);
  struct report *report = report_create();
  struct map map;
  assert_int_equal(
      exact_solve_as(&solver_warnock, &request, sheet, &map, report), RECTO_OK);
  map_fini(&map);
  return report;
}

static void windows_of_all_kinds_add_up(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 20; seed++) {
    bool by_box = seed % 2 == 0;
    struct sheet sheet;
    struct report *report;
    int64_t finished;
    spread(&sheet, seed);
    report = solve_and_report(&sheet, seed % 4 < 2, by_box);
    finished =
        count_of(report, "without_edge") + count_of(report, "without_face") +
        count_of(report, "one_surrounder") + count_of(report, "few_faces") +
        count_of(report, "of_least_size");
    assert_true(count_of(report, "divided") > 0);
    assert_int_equal(count_of(report, "windows"),
                     finished + count_of(report, "divided"));
    assert_int_equal(count_of(report, "windows"),
                     1 + 4 * count_of(report, "divided"));
    report_destroy(report);
    exact_sheet_fini(&sheet);
  }
}

/* One triangle amid all tents, which surrounds the window that holds them all
 * and pierces them: it is classified before that, and in none of the
 * windows below, of which each would count one more angle. */
static void a_surrounder_is_not_classified_again(void **state) {
  static const int wall[][3] = {
      {-200, -100, 14}, {900, -100, 14}, {-200, 900, 14}};
  struct sheet sheet;
  struct report *report;
  (void)state;
  exact_sheet_init(&sheet);
  for (int y = 0; y < 16; y++)
    for (int x = 0; x < 16; x++) {
      const int tent[][3] = {{8 * x, 8 * y, 10},
                             {8 * x + 6, 8 * y + 1, 12},
                             {8 * x + 1, 8 * y + 6, 20}};
      exact_add_face(&sheet, tent, 3, SCALE);
    }
  exact_add_face(&sheet, wall, 3, SCALE);
  report = solve_and_report(&sheet, true, false);
  assert_true(count_of(report, "windows") > 100);
  assert_true(3 * count_of(report, "classified_by_angle") <
              count_of(report, "windows"));
  report_destroy(report);
  exact_sheet_fini(&sheet);
}

/* With the wall before the tents windows end where it surrounds them: by the
 * order of the depths where all is level, by the corners where all slopes. */
static void a_front_that_surrounds_drops_what_is_behind(void **state) {
  (void)state;
  for (int slope = 0; slope < 16; slope += 15)
    for (int before = 0; before < 2; before++) {
      struct report *report;
      struct sheet sheet;
      tents_and_a_wall(&sheet, 12, before ? 50 : 0, slope);
      report = solve_and_report(&sheet, true, false);
      assert_int_equal(count_of(report, "one_surrounder") > 0, before);
      if (slope == 0)
        assert_int_equal(count_of(report, "stopped_by_depth_order") > 0,
                         before);
      else
        assert_int_equal(count_of(report, "dropped_by_corner_depths") > 0,
                         before);
      report_destroy(report);
      exact_sheet_fini(&sheet);
    }
}

/* Lines alone: a window without a drawable edge is finished at once, be it the
 * whole page. */
static void a_window_without_a_drawable_edge_is_finished_at_once(void **state) {
  struct solver_request request = request_of(false, false);
  (void)state;
  request.intersections = false;
  for (int drawn = 0; drawn < 2; drawn++) {
    struct report *report = report_create();
    struct sheet sheet;
    struct map map;
    tents_and_a_wall(&sheet, 12, 0, 0);
    for (size_t e = 0; e < sheet.edge.count - (drawn ? 1 : 0); e++)
      sheet.edge.item[e].edge_class = 0;
    assert_int_equal(
        exact_solve_as(&solver_warnock, &request, &sheet, &map, report),
        RECTO_OK);
    if (drawn == 0) {
      assert_int_equal(count_of(report, "windows"), 1);
      assert_int_equal(count_of(report, "without_edge"), 1);
    } else {
      assert_int_equal(map.edge_state[sheet.edge.count - 1], MAP_VISIBLE);
      assert_true(2 * count_of(report, "without_edge") >
                  count_of(report, "divided"));
    }
    report_destroy(report);
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

/* Many faces at one point are more than a window may hold, at every size of
 * window. */
static void a_fan_ends_in_fewer_windows_than_faces(void **state) {
  (void)state;
  for (int k = 0; k < 2; k++) {
    int count = k == 0 ? 200 : 800;
    int64_t windows;
    struct report *report;
    struct sheet sheet;
    exact_sheet_init(&sheet);
    for (int f = 0; f < count; f++) {
      const int blade[][3] = {{0, 0, 2000},
                              {2000 - 4 * f, 1600 - f, f % 7},
                              {2000 - 4 * f - 4, 1600 - f - 1, 5}};
      exact_add_face(&sheet, blade, 3, 16);
    }
    report = solve_and_report(&sheet, false, false);
    windows = count_of(report, "windows");
    assert_in_range(windows, 2, count - 1);
    report_destroy(report);
    exact_sheet_fini(&sheet);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(dense_scenes_have_the_map_of_brute),
      cmocka_unit_test(sparse_scenes_have_the_map_of_brute),
      cmocka_unit_test(walls_at_any_depth_have_the_map_of_brute),
      cmocka_unit_test(windows_of_all_kinds_add_up),
      cmocka_unit_test(a_surrounder_is_not_classified_again),
      cmocka_unit_test(a_front_that_surrounds_drops_what_is_behind),
      cmocka_unit_test(a_window_without_a_drawable_edge_is_finished_at_once),
      cmocka_unit_test(a_fan_ends_in_fewer_windows_than_faces),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
