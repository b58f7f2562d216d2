/* test_intersections.c - lines of intersection where a surface's edge is in
 * contact with the face that the surface goes through. */
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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_does_not_meet_has_no_line_at_any_contact),
      cmocka_unit_test(what_meets_beside_an_edge_has_its_line_there),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
