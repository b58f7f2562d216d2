/* test_subpixels.c - supersampling and back-face removal in the z-buffers. */
#include "exact_fixture/pixels.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/report.h"
#include "tests/scenes/solver_named.h"
#include "visibility/raster/subpixels.h"
#include "visibility/solver.h"

static const struct solver *const both[] = {&solver_zbuffer,
                                            &solver_scanline_zbuffer};

static void solve(const struct solver *solver, const struct pixels_scene *scene,
                  const struct solver_request *request, struct map *map,
                  struct report *report) {
  struct sheet sheet;
  pixels_sheet(&sheet, scene);
  map_init(map);
  assert_int_equal(solver->solve(&sheet, request, map, report, NULL), RECTO_OK);
  exact_sheet_fini(&sheet);
}

/* Warnock computes its sub-pixels by another algorithm. */
static void averaged_pixels_are_those_of_warnock(void **state) {
  (void)state;
  for (uint64_t seed = 800; seed < 830; seed++) {
    const struct solver_request request = {.edges = true,
                                           .fragments = true,
                                           .threads = 1,
                                           .resolution = 11 + (int)seed % 30,
                                           .subpixels = 1 + (int)seed % 5};
    struct pixels_scene scene;
    struct map want, got;
    pixels_random_scene(&scene, seed);
    solve(&solver_warnock, &scene, &request, &want, NULL);
    for (int s = 0; s < 2; s++) {
      solve(both[s], &scene, &request, &got, NULL);
      exact_assert_same_map(&want, &got, solver_name(both[s]));
      map_fini(&got);
    }
    map_fini(&want);
  }
}

static void a_pixel_is_what_most_of_it_see(void **state) {
  static const struct {
    uint32_t seen[4], most, covered;
  } pixel[] = {{{7, 7, 3, 3}, 3, 4},
               {{7, 7, 7, 3}, 7, 4},
               {{0, 9, 0, 4}, 4, 2},
               {{0, 9, 0, 9}, 9, 2},
               {{0, 0, 1, 0}, 0, 1}};
  (void)state;
  for (size_t i = 0; i < sizeof pixel / sizeof *pixel; i++) {
    uint32_t covered;
    assert_int_equal(subpixels_resolve(pixel[i].seen, 4, &covered),
                     pixel[i].most);
    assert_int_equal(covered, pixel[i].covered);
  }
}

/* A page that is not a whole number of pixels wide: the last pixel of a line
 * has sub-pixels beyond the page, which see nothing. */
static void the_last_pixel_may_reach_beyond_the_page(void **state) {
  const uint32_t line[5] = {1, 1, 1, 1, 2};
  struct subpixels subpixels;
  (void)state;
  assert_true(subpixels_init(&subpixels, 2, 5, 3));
  assert_false(subpixels_add_line(&subpixels, 3, line));
  assert_true(subpixels_add_line(&subpixels, 2, line));
  assert_int_equal(subpixels.pixel[1], 1);
  assert_int_equal(subpixels.pixel[2], 2);
  assert_int_equal(subpixels.covered, 10);
  subpixels_fini(&subpixels);
}

static double reported_share(int lines, int subpixels, int s) {
  static const char key[] = "\"covered_share\":";
  const struct solver_request request = {.fragments = true,
                                         .threads = 1,
                                         .resolution = lines,
                                         .subpixels = subpixels};
  struct report *report = report_create();
  struct map map;
  const char *at;
  double share;
  solve(both[s], &pixels_pierced_rectangle, &request, &map, report);
  at = strstr(report_json(report), key);
  assert_non_null(at);
  share = strtod(at + strlen(key), NULL);
  map_fini(&map);
  report_destroy(report);
  return share;
}

/* 300 for the rectangle, 100 / 3 for what of the triangle lies beside it. */
static void averaging_comes_nearer_to_the_area(void **state) {
  const double want = (300 + 100 / 3.) / 1024;
  double coarse = 0, fine = 0;
  (void)state;
  for (int lines = 5; lines < 20; lines++) {
    coarse += fabs(reported_share(lines, 2, 0) - want);
    fine += fabs(reported_share(lines, 16, 0) - want);
    assert_true(fabs(reported_share(lines, 16, 0) - want) < 0.003);
    assert_true(reported_share(lines, 16, 0) == reported_share(lines, 16, 1));
  }
  assert_true(4 * fine < coarse);
}

/* ---- Backs --------------------------------------------------------------- */

/* A back face before a front face, apart: what is removed takes its lines
 * with it, wherever they are. */
static void removed_backs_take_their_lines_with_them(void **state) {
  const struct pixels_scene scene = {
      2,
      {{4, {{4, 4, 9}, {4, 20, 9}, {20, 20, 9}, {20, 4, 9}}},
       {4, {{2, 2, 3}, {30, 2, 3}, {30, 30, 3}, {2, 30, 3}}}}};
  (void)state;
  for (int s = 0; s < 2; s++)
    for (int remove = 0; remove < 2; remove++) {
      const struct solver_request request = {.edges = true,
                                             .threads = 1,
                                             .resolution = 32,
                                             .remove_backs = remove == 1};
      struct map map;
      solve(both[s], &scene, &request, &map, NULL);
      assert_int_equal(map.edge_count, 8);
      for (size_t e = 0; e < 8; e++)
        assert_int_equal(map.edge_state[e],
                         remove == 1 && e < 4 ? MAP_HIDDEN : MAP_VISIBLE);
      map_fini(&map);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(averaged_pixels_are_those_of_warnock),
      cmocka_unit_test(a_pixel_is_what_most_of_it_see),
      cmocka_unit_test(the_last_pixel_may_reach_beyond_the_page),
      cmocka_unit_test(averaging_comes_nearer_to_the_area),
      cmocka_unit_test(removed_backs_take_their_lines_with_them),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
