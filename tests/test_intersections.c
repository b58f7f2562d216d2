/* test_intersections.c - lines of intersection where a surface's edge is in
 * contact with the face that the surface goes through. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/sheet_fixture.h"
#include "tests/scenes/scenes.h"
#include "visibility/solver.h"

/* The ends of the lines of intersection, in order of the edges. */
struct lines {
  size_t count;
  struct geom_point end[16];
};

/* Finds the lines between a square, two opposite corners of which are nearer to
 * a triangle's plane than 0.4, and the triangle.
 * through  the triangle reaches the square */
static void find_lines(double contact, bool through, double azimuth,
                       struct lines *lines) {
  struct sheet_fixture fixture;
  struct map map;
  recto_error error;
  const struct solver_request request = {
      .strokes = true, .intersections = true, .threads = 1};
  struct report *report = report_create();
  sheet_fixture_start(&fixture);
  build_triangle(&fixture.scene, build_point(&fixture.scene, 4, 2, 1),
                 build_point(&fixture.scene, 2, 4, 4),
                 through ? build_point(&fixture.scene, 8, 8, 2)
                         : build_point(&fixture.scene, 1, 0, 2));
  build_parallelogram(&fixture.scene, vector_of(3, 3, 2), vector_of(2, 0, 0),
                      vector_of(0, 2, 0));
  fixture.options.contact = contact;
  fixture.options.azimuth_deg = azimuth;
  fixture.options.elevation_deg = 75;
  sheet_fixture_out(&fixture, false);
  size_t edges = fixture.sheet.edge.count;
  map_init(&map);
  assert_int_equal(
      solver_brute.solve(&fixture.sheet, &request, &map, report, &error),
      RECTO_OK);
  lines->count = 0;
  for (size_t e = edges; e < fixture.sheet.edge.count; e++)
    for (int k = 0; k < 2; k++) {
      assert_in_range(lines->count, 0, 15);
      lines->end[lines->count++] =
          fixture.sheet.point.item[fixture.sheet.edge.item[e].point[k]];
    }
  map_fini(&map);
  report_destroy(report);
  sheet_fixture_fini(&fixture);
}

/* The square's diagonal touches the plane, and the square goes on behind it and
 * before it; but the triangle ends before it comes to the square. */
static void what_does_not_meet_has_no_line_at_any_contact(void **state) {
  (void)state;
  for (int view = 0; view < 12; view++)
    for (int k = 0; k < 6; k++) {
      struct lines lines;
      find_lines(k / 10.0, false, 30 * view, &lines);
      assert_int_equal(lines.count, 0);
    }
}

/* And where the triangle comes through the square beside its diagonal, the line
 * is there, as it is without contact. */
static void what_meets_beside_an_edge_has_its_line_there(void **state) {
  (void)state;
  for (int view = 0; view < 12; view++) {
    struct lines right, lines;
    find_lines(0, true, 30 * view, &right);
    find_lines(0.4, true, 30 * view, &lines);
    assert_int_equal(right.count, 2);
    assert_int_equal(lines.count, 2);
    assert_memory_equal(lines.end, right.end, 2 * sizeof *lines.end);
  }
}

/* The length on the page, in grid units, of all lines of intersection between
 * a triangle and a polygon in the plane z = 3. */
static double intersection_length(const double *polygon, size_t count,
                                  int view) {
  static const double triangle[] = {1, 2, 2, 0.5, 2, 4, 1, 2, 3.5};
  /* Sets the size of the page for either polygon. */
  static const double far[] = {2, 0, 0, 4, 3, 0, 3, 4, 0};
  struct sheet_fixture fixture;
  struct map map;
  recto_error error;
  const struct solver_request request = {
      .strokes = true, .intersections = true, .threads = 1};
  struct report *report = report_create();
  double length = 0;
  sheet_fixture_start(&fixture);
  build_polygon(&fixture.scene, far, 3);
  build_polygon(&fixture.scene, polygon, count);
  build_polygon(&fixture.scene, triangle, 3);
  fixture.options.contact = 0;
  fixture.options.azimuth_deg = 3 * view;
  fixture.options.elevation_deg = view % 2 == 0 ? 20 : -35;
  fixture.options.fit = RECTO_FIT_SCALE;
  fixture.options.scale = 1;
  sheet_fixture_out(&fixture, false);
  size_t edges = fixture.sheet.edge.count;
  map_init(&map);
  assert_int_equal(
      solver_brute.solve(&fixture.sheet, &request, &map, report, &error),
      RECTO_OK);
  for (size_t e = edges; e < fixture.sheet.edge.count; e++) {
    const uint32_t *point = fixture.sheet.edge.item[e].point;
    struct geom_point a = fixture.sheet.point.item[point[0]],
                      b = fixture.sheet.point.item[point[1]];
    length += hypot((double)a.x - b.x, (double)a.y - b.y);
  }
  map_fini(&map);
  report_destroy(report);
  sheet_fixture_fini(&fixture);
  return length;
}

/* The plane of the triangle contains a diagonal of the hexagon, but for
 * rounding to the page's grid, which tilts the diagonal: a part of the line may
 * lie in a triangle of the hexagon that only touches the plane. */
static void a_line_along_a_diagonal_is_whole(void **state) {
  static const double hexagon[] = {0, 0.5, 3, 0, 0, 3, 2,   2, 3,
                                   4, 3,   3, 2, 4, 3, 0.5, 2, 3};
  static const double simple[] = {0, 0, 3, 4, 0, 3, 0, 4, 3};
  (void)state;
  for (int view = 0; view < 120; view++) {
    double whole = intersection_length(simple, 3, view);
    assert_true(whole > 1000);
    assert_true(fabs(intersection_length(hexagon, 6, view) - whole) < 16);
  }
}

/* Both lines are whole, from any side, with contact and without. */
static void a_diagonal_that_faces_share_may_be_a_line(void **state) {
  (void)state;
  for (int view = 0; view < 24; view++) {
    struct sheet_fixture fixture;
    struct map map;
    recto_error error;
    const struct solver_request request = {
        .strokes = true, .intersections = true, .threads = 1};
    struct report *report = report_create();
    sheet_fixture_start(&fixture);
    scenes_crossed_in_diagonal(&fixture.scene, &fixture.options);
    fixture.options.contact = view % 2 == 0 ? 0 : -1;
    fixture.options.azimuth_deg = 15 * view;
    fixture.options.elevation_deg = view % 3 == 0 ? 50 : 15;
    sheet_fixture_out(&fixture, false);
    size_t edges = fixture.sheet.edge.count;
    map_init(&map);
    assert_int_equal(
        solver_brute.solve(&fixture.sheet, &request, &map, report, &error),
        RECTO_OK);
    assert_int_equal(fixture.sheet.edge.count, edges + 2);
    for (uint32_t copy = 0; copy < 2; copy++) {
      const uint32_t *line = fixture.sheet.edge.item[edges + copy].point;
      const struct geom_point *point = fixture.sheet.point.item;
      uint32_t from = 6 * copy, to = from + 1;
      assert_true((geom_same_point(point[line[0]], point[from]) &&
                   geom_same_point(point[line[1]], point[to])) ||
                  (geom_same_point(point[line[0]], point[to]) &&
                   geom_same_point(point[line[1]], point[from])));
    }
    map_fini(&map);
    report_destroy(report);
    sheet_fixture_fini(&fixture);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_does_not_meet_has_no_line_at_any_contact),
      cmocka_unit_test(what_meets_beside_an_edge_has_its_line_there),
      cmocka_unit_test(a_line_along_a_diagonal_is_whole),
      cmocka_unit_test(a_diagonal_that_faces_share_may_be_a_line),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
