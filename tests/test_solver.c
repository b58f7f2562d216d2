/* test_solver.c - properties of every solver: the table of solvers, and failing
 * allocations. */
#include "exact_fixture/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/polled.h"
#include "tests/scenes/exact.h"
#include "tests/scenes/solver_named.h"

static const struct solver *const raster[] = {
    &solver_zbuffer, &solver_scanline_zbuffer, &solver_warnock};
enum { RASTERS = sizeof raster / sizeof *raster };

/* ---- The table ----------------------------------------------------------- */

static void a_solver_is_found_by_its_method(void **state) {
  int count = 0;
  (void)state;
  for (const struct solver *const *s = solvers(); *s != NULL; s++, count++) {
    assert_ptr_equal(solver_by_method((*s)->method), *s);
    assert_true(recto_method_is_available((*s)->method));
    for (const struct solver *const *t = solvers(); t != s; t++)
      assert_true((*t)->method != (*s)->method);
  }
  assert_true(count >= 4);
  assert_null(solver_by_method(RECTO_METHOD_COUNT));
}

static void a_request_is_what_the_options_say(void **state) {
  recto_options options;
  (void)state;
  recto_options_init(&options);
  struct solver_request request = solver_request_of(&options);
  assert_true(request.edges && !request.fragments && !request.divide_by_box);
  options.ink.edges = RECTO_EDGES_NONE;
  options.ink.fill = RECTO_FILL_PAINT;
  options.solver.divide = RECTO_DIVIDE_BOX;
  request = solver_request_of(&options);
  assert_true(!request.edges && request.fragments && request.divide_by_box);
}

/* ---- Each allocation failing --------------------------------------------- */

/* Bars in a cycle, a sheet that pierces them, a decal on that and a needle
 * edge-on: all that solvers have room to fail at. */
static void all_kinds(struct sheet *sheet) {
  static const int face[][3][3] = {{{0, 0, 10}, {2, 0, 10}, {12, 20, 30}},
                                   {{24, 4, 10}, {24, 6, 10}, {-2, 5, 30}},
                                   {{8, 20, 10}, {10, 22, 10}, {22, 1, 30}},
                                   {{0, 0, 5}, {20, 0, 15}, {0, 20, 25}},
                                   {{2, 2, 7}, {6, 2, 9}, {2, 6, 11}},
                                   {{3, 3, 0}, {9, 9, 20}, {6, 6, 40}}};
  static const int back[][3] = {
      {-9, -9, 1}, {30, -9, 1}, {30, 30, 1}, {-9, 30, 1}};
  exact_sheet_init(sheet);
  for (size_t f = 0; f < sizeof face / sizeof *face; f++)
    exact_add_face(sheet, face[f], 3, 1 << 20);
  exact_add_face(sheet, back, 4, 1 << 20);
}

static void one_in_front(struct sheet *sheet) {
  static const int low[][3] = {{0, 0, 1}, {9, 0, 1}, {0, 9, 1}};
  static const int high[][3] = {{2, 2, 5}, {4, 2, 5}, {2, 4, 5}};
  exact_sheet_init(sheet);
  exact_add_face(sheet, low, 3, 1 << 20);
  exact_add_face(sheet, high, 3, 1 << 20);
}

static void empty(struct sheet *sheet) { exact_sheet_init(sheet); }

static void random_mesh(struct sheet *sheet) {
  uint64_t r = 7;
  exact_random_sheet(sheet, EXACT_MESH, 12, &r);
}

typedef void make_fn(struct sheet *sheet);

/* Solves a new sheet with the n-th allocation failing; 0: none. */
static recto_status solve(const struct solver *solver,
                          const struct solver_request *request, make_fn *make,
                          unsigned long n, struct map *map) {
  struct sheet sheet;
  recto_error error = {0};
  recto_status status;
  make(&sheet);
  map_init(map);
  mem_fail_after(n);
  status = solver->solve(&sheet, request, map, NULL, &error);
  mem_fail_after(0);
  if (status != RECTO_OK)
    assert_int_equal(error.code, status);
  exact_sheet_fini(&sheet);
  return status;
}

/* Whatever allocation fails, the run says so or was not harmed.  Past the last
 * allocation all runs succeed. */
static void fail_in_turn(const struct solver *solver,
                         const struct solver_request *request, make_fn *make) {
  enum { MOST = 20000, AFTER = 64 };
  struct map map, again;
  int succeeded = 0;
  recto_status status = solve(solver, request, make, 0, &map);
  if (status == RECTO_ERROR_UNSUPPORTED) { /* requests more than it does */
    map_fini(&map);
    return;
  }
  assert_int_equal(status, RECTO_OK);
  for (unsigned long n = 1; succeeded < AFTER; n++) {
    assert_true(n < MOST);
    status = solve(solver, request, make, n, &again);
    if (status == RECTO_OK) {
      if (request->resolution == 0)
        exact_assert_same_map(&map, &again, solver_name(solver));
      succeeded++;
    } else {
      assert_int_equal(status, RECTO_ERROR_MEMORY);
      succeeded = 0;
    }
    map_fini(&again);
  }
  map_fini(&map);
}

#define EVERYTHING                                                             \
  .edges = true, .fragments = true, .intersections = true, .threads = 1

static void running_out_of_memory_is_a_status_and_leaks_nothing(void **state) {
  static make_fn *const make[] = {all_kinds, one_in_front, empty, random_mesh};
  static const struct solver_request request[] = {
      {EVERYTHING},
      {EVERYTHING, .divide_by_box = true},
      {EVERYTHING, .resolution = 16, .pitch_mm = 100},
      {EVERYTHING, .resolution = 48, .pitch_mm = 100, .subpixels = 2},
      {EVERYTHING, .resolution = 20, .pitch_mm = 100, .remove_backs = true}};
  (void)state;
  for (const struct solver *const *s = solvers(); *s != NULL; s++)
    for (size_t k = 0; k < sizeof make / sizeof *make; k++)
      for (size_t r = 0; r < sizeof request / sizeof *request; r++)
        if (is_exact(*s) || request[r].resolution > 0)
          fail_in_turn(*s, &request[r], make[k]);
}

/* ---- Cancelling, and what is out of range -------------------------------- */

static bool stop_in_a_while(void *user, double share, const char *stage) {
  int *polls_left = user;
  assert_true(share >= 0 && share <= 1);
  assert_non_null(stage);
  return --*polls_left > 0;
}

/* test_cancelling does the same for all methods, on scenes that take longer. */
static void a_cancelled_raster_is_not_polled_again(void **state) {
  (void)state;
  for (int s = 0; s < RASTERS; s++)
    for (int polls = 1; polls < 6; polls++) {
      int left = polls;
      const struct solver_request request = {EVERYTHING, .resolution = 512};
      struct polled polled;
      struct map map;
      polled_begin(&polled, stop_in_a_while, &left);
      assert_int_equal(solve(raster[s], &request, all_kinds, 0, &map),
                       RECTO_ERROR_CANCELLED);
      polled_end(&polled);
      assert_int_equal(left, 0);
      map_fini(&map);
    }
}

static void numbers_of_pixels_out_of_range_are_refused(void **state) {
  static const struct solver_request bad[] = {
      {.resolution = 65537},
      {.resolution = 64, .subpixels = -1},
      {.resolution = 64, .subpixels = 17},
      {.resolution = 40000, .subpixels = 2},
      {.resolution = 65537, .subpixels = 2},
      /* of the z-buffers */
      {.resolution = -5},
      {.resolution = 64, .depth_bits = -1},
      {.resolution = 64, .depth_bits = 33}};
  (void)state;
  for (int s = 0; s < RASTERS; s++)
    for (int i = 0; i < (raster[s] == &solver_warnock ? 5 : 8); i++) {
      struct map map;
      assert_int_equal(solve(raster[s], &bad[i], all_kinds, 0, &map),
                       RECTO_ERROR_ARGUMENT);
      map_fini(&map);
    }
}

/* ---- No more than was requested ------------------------------------------ */

static void check_parts(const struct solver *solver, bool strokes,
                        bool fragments) {
  const struct solver_request request = {
      .edges = strokes, .fragments = fragments, .threads = 1, .resolution = 0};
  struct sheet sheet;
  struct map map;
  recto_error error;
  size_t edges;
  all_kinds(&sheet);
  edges = sheet.edge.count;
  map_init(&map);
  assert_int_equal(solver->solve(&sheet, &request, &map, NULL, &error),
                   RECTO_OK);
  assert_int_equal(map.edge_state != NULL, strokes);
  assert_int_equal(map.fragment.count > 0, fragments);
  assert_int_equal(sheet.edge.count, edges); /* no intersections */
  map_fini(&map);
  exact_sheet_fini(&sheet);
}

static void a_solver_does_no_more_than_was_requested(void **state) {
  (void)state;
  for (const struct solver *const *s = solvers(); *s != NULL; s++)
    if (is_exact(*s) || *s == &solver_painter || *s == &solver_painter_given)
      for (int parts = 0; parts < 4; parts++)
        check_parts(*s, parts & 1, parts & 2);
}

/* ---- The limits of brute force ------------------------------------------- */

/* A drawn line behind a face, one of `copies` such lines, and `count` copies of
 * that face. */
static void covered_lines(struct sheet *sheet, size_t copies, size_t count) {
  static const int line[][3] = {{4, 4, 9}, {6, 4, 9}, {4, 6, 9}};
  const struct geom_point cover[3] = {
      {0, 0, 1 << 24}, {20 << 20, 0, 1 << 24}, {0, 20 << 20, 1 << 24}};
  exact_sheet_init(sheet);
  exact_add_face(sheet, line, 3, 1 << 20);
  for (size_t i = sheet->edge.count; i < copies; i++)
    assert_true(ARRAY_PUSH(&sheet->edge, sheet->edge.item[0]));
  for (size_t t = 1; t < count; t++)
    exact_add_triangle(sheet, cover, 1);
}

static void brute_tests_a_hidden_edge_no_further(void **state) {
  enum { LINES = 3, FACES = 1000 };
  const struct solver_request request = {.edges = true, .threads = 1};
  struct report *report = report_create();
  struct sheet sheet;
  struct map map;
  (void)state;
  covered_lines(&sheet, LINES, FACES);
  assert_int_equal(
      exact_solve_as(&solver_brute, &request, &sheet, &map, report), RECTO_OK);
  for (size_t e = 0; e < LINES; e++)
    assert_int_equal(map.edge_state[e], MAP_HIDDEN);
  /* The face itself and one in front of it. */
  assert_true(report_get(report, "occlusion", "pairs", 0) <= 2 * LINES);
  report_destroy(report);
  map_fini(&map);
  exact_sheet_fini(&sheet);
}

static void brute_refuses_what_would_take_hours(void **state) {
  enum { MANY = 224000 };
  static const struct {
    size_t lines;
    bool fragments;
    const char *says;
  } many[] = {{3, true, "224000 triangles against 224000 triangles"},
              {MANY, false, "224000 lines against 224000 triangles"}};
  (void)state;
  for (size_t i = 0; i < sizeof many / sizeof *many; i++) {
    const struct solver_request request = {.edges = !many[i].fragments,
                                           .fragments = many[i].fragments,
                                           .threads = 1};
    recto_error error = {0};
    struct sheet sheet;
    struct map map;
    covered_lines(&sheet, many[i].lines, MANY);
    map_init(&map);
    assert_int_equal(solver_brute.solve(&sheet, &request, &map, NULL, &error),
                     RECTO_ERROR_LIMIT);
    assert_non_null(strstr(error.text, many[i].says));
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_solver_is_found_by_its_method),
      cmocka_unit_test(a_request_is_what_the_options_say),
      cmocka_unit_test(running_out_of_memory_is_a_status_and_leaks_nothing),
      cmocka_unit_test(a_cancelled_raster_is_not_polled_again),
      cmocka_unit_test(numbers_of_pixels_out_of_range_are_refused),
      cmocka_unit_test(a_solver_does_no_more_than_was_requested),
      cmocka_unit_test(brute_tests_a_hidden_edge_no_further),
      cmocka_unit_test(brute_refuses_what_would_take_hours),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
