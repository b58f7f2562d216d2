/* test_intersections.c - lines of intersection where a surface's edge is in
 * contact with the face that the surface goes through. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/scenes/random.h"
#include "tests/scenes/scenes.h"
#include "tests/sheet_fixture.h"
#include "visibility/solver.h"

/* The ends of the lines of intersection, in order of the edges. */
struct lines {
  size_t count;
  struct geom_point end[16];
};

/* Lays the scene out and finds its lines of intersection; ends the fixture. */
static void solve(struct sheet_fixture *fixture, struct lines *lines) {
  struct map map;
  recto_error error;
  const struct solver_request request = {
      .edges = true, .intersections = true, .threads = 1};
  struct report *report = report_create();
  sheet_fixture_out(fixture, false);
  const struct sheet *sheet = &fixture->sheet;
  size_t edges = sheet->edge.count;
  map_init(&map);
  assert_int_equal(
      solver_brute.solve(&fixture->sheet, &request, &map, report, &error),
      RECTO_OK);
  lines->count = 0;
  for (size_t e = edges; e < sheet->edge.count; e++)
    for (int k = 0; k < 2; k++) {
      assert_in_range(lines->count, 0, 15);
      lines->end[lines->count++] =
          sheet->point.item[sheet->edge.item[e].point[k]];
    }
  map_fini(&map);
  report_destroy(report);
  sheet_fixture_fini(fixture);
}

/* Their length on the page, in grid units. */
static double length_of(const struct lines *lines) {
  double length = 0;
  for (size_t i = 0; i < lines->count; i += 2)
    length += hypot((double)lines->end[i].x - lines->end[i + 1].x,
                    (double)lines->end[i].y - lines->end[i + 1].y);
  return length;
}

/* Finds the lines between a square, two opposite corners of which are nearer to
 * a triangle's plane than 0.4, and the triangle.
 * through  the triangle reaches the square */
static void find_lines(double contact, bool through, double azimuth,
                       struct lines *lines) {
  struct sheet_fixture fixture;
  sheet_fixture_start(&fixture);
  build_triangle(&fixture.scene, build_point(&fixture.scene, 4, 2, 1),
                 build_point(&fixture.scene, 2, 4, 4),
                 through ? build_point(&fixture.scene, 8, 8, 2)
                         : build_point(&fixture.scene, 1, 0, 2));
  build_parallelogram(&fixture.scene, vector_of(3, 3, 2), vector_of(2, 0, 0),
                      vector_of(0, 2, 0));
  fixture.options.solver.contact = contact;
  fixture.options.camera.azimuth_deg = azimuth;
  fixture.options.camera.elevation_deg = 75;
  solve(&fixture, lines);
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
  struct lines lines;
  sheet_fixture_start(&fixture);
  build_polygon(&fixture.scene, far, 3);
  build_polygon(&fixture.scene, polygon, count);
  build_polygon(&fixture.scene, triangle, 3);
  fixture.options.solver.contact = 0;
  fixture.options.camera.azimuth_deg = 3 * view;
  fixture.options.camera.elevation_deg = view % 2 == 0 ? 20 : -35;
  fixture.options.camera.fit = RECTO_FIT_SCALE;
  fixture.options.camera.scale = 1;
  solve(&fixture, &lines);
  return length_of(&lines);
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
    struct lines lines;
    sheet_fixture_start(&fixture);
    scenes_crossed_in_diagonal(&fixture.scene, &fixture.options);
    fixture.options.solver.contact = view % 2 == 0 ? 0 : -1;
    fixture.options.camera.azimuth_deg = 15 * view;
    fixture.options.camera.elevation_deg = view % 3 == 0 ? 50 : 15;
    fixture.options.camera.fit = RECTO_FIT_SCALE;
    fixture.options.camera.scale = 1;
    solve(&fixture, &lines);
    assert_int_equal(lines.count, 4);
    /* Both are 3 mm long and parallel to the x axis. */
    double turn = acos(-1) / 180 * fixture.options.camera.azimuth_deg,
           rise = acos(-1) / 180 * fixture.options.camera.elevation_deg;
    double share = hypot(cos(turn), sin(turn) * sin(rise));
    assert_true(fabs(length_of(&lines) - 6 * share * SHEET_UNITS_PER_MM) < 4);
  }
}

/* Two rhombuses cross in a diagonal of both, and the section plane cuts one of
 * them so close to an end of the diagonal, before it or behind, that a side a
 * few units long is left there, or none.  The line stays whole. */
static void a_clipped_face_has_its_whole_line(void **state) {
  static const double across[] = {-40, 0, 0, 0, -30, 0, 40, 0, 0, 0, 30, 0},
                      towards[] = {0, 0, -40, 0, -30, 0, 0, 0, 40, 0, 30, 0};
  const double degree = acos(-1) / 180, rise = 30 * degree;
  (void)state;
  for (int step = -120; step <= 120; step++) {
    struct sheet_fixture fixture;
    struct lines lines;
    double off = copysign(pow(10, abs(step) / 12.0 - 12), step);
    sheet_fixture_start(&fixture);
    build_polygon(&fixture.scene, across, 4);
    build_polygon(&fixture.scene, towards, 4);
    fixture.options.camera.elevation_deg = 30;
    fixture.options.camera.azimuth_deg = 0.1;
    fixture.options.camera.fit = RECTO_FIT_SCALE;
    fixture.options.camera.scale = 1;
    /* So far the upper end of the diagonal is behind the nearest corner. */
    fixture.options.camera.near_distance =
        40 * cos(rise) * cos(0.1 * degree) - 30 * sin(rise) + off;
    solve(&fixture, &lines);
    assert_int_equal(lines.count, 2);
    assert_true(fabs(length_of(&lines) / SHEET_UNITS_PER_MM - 60 * cos(rise)) <
                1e-4 + 4 * fmax(off, 0));
  }
}

/* The ridge of a roof runs up within a wall that is seen edge-on, or is so many
 * units of the grid thick on the page; the wall is 1 mm high, so that a line of
 * 1 mm on the page is in it. */
static void a_wall_seen_edge_on_has_its_whole_line(void **state) {
  (void)state;
  for (int units = 0; units < 12; units++) {
    struct sheet_fixture fixture;
    struct lines lines;
    double tilt = units / SHEET_UNITS_PER_MM;
    const double wall[] = {5 - tilt / 2, 3, -0.5, 5 - tilt / 2, 7, -0.5,
                           5 + tilt / 2, 7, 0.5,  5 + tilt / 2, 3, 0.5};
    sheet_fixture_start(&fixture);
    build_polygon(&fixture.scene, wall, 4);
    uint32_t low = build_point(&fixture.scene, 5 - tilt, 4, -1),
             high = build_point(&fixture.scene, 5 + tilt, 6, 1);
    build_triangle(&fixture.scene, low, high,
                   build_point(&fixture.scene, 7, 5, -1));
    build_triangle(&fixture.scene, high, low,
                   build_point(&fixture.scene, 3, 5, -1));
    scenes_view_page(&fixture.options, 10, 10);
    solve(&fixture, &lines);
    assert_true(fabs(length_of(&lines) - SHEET_UNITS_PER_MM) < 64);
  }
}

/* A polygon that touches itself shares an edge with another face, and is in
 * contact with it. */
static void a_face_makes_no_line_with_itself(void **state) {
  struct sheet_fixture fixture;
  struct lines lines;
  (void)state;
  sheet_fixture_start(&fixture);
  struct scene *scene = &fixture.scene;
  uint32_t a = build_point(scene, 0, -2, 0), b = build_point(scene, 2, 0, -0.5);
  const uint32_t folded[] = {build_point(scene, 2, -0.5, -2),
                             build_point(scene, 1.5, 0, 1),
                             a,
                             b,
                             build_point(scene, 1, 0, -0.5),
                             a};
  const uint32_t plain[] = {build_point(scene, 2, 0, 0),
                            build_point(scene, 0, 0, 0), b, a};
  build_face(scene, plain, 4);
  build_face(scene, folded, 6);
  fixture.options.solver.contact = 0.1;
  fixture.options.camera.azimuth_deg = 45;
  fixture.options.camera.elevation_deg = 35.264389682754654;
  solve(&fixture, &lines);
  assert_int_equal(lines.count, 0);
}

/* A point of a plane that is inclined to all axes. */
static uint32_t point_in_plane(struct scene *scene, double u, double v) {
  return build_point(scene, 0.6 * u + 0.48 * v, -0.8 * u + 0.36 * v, 0.8 * v);
}

/* Narrow strips that lie across each other in one plane: the plane of each is
 * known to the grid's rounding over its width only. */
static void strips_in_one_plane_make_no_line(void **state) {
  struct random random = {11};
  (void)state;
  for (int i = 0; i < 300; i++) {
    struct sheet_fixture fixture;
    struct lines lines;
    sheet_fixture_start(&fixture);
    for (int strip = 0; strip < 2; strip++) {
      double turn = random_between(&random, 0, 3), dx = cos(turn),
             dy = sin(turn), x = random_between(&random, -5, 5),
             y = random_between(&random, -5, 5),
             width = pow(10, random_between(&random, -4, 0.5));
      uint32_t corner[4];
      for (int k = 0; k < 4; k++) {
        double u = k == 1 || k == 2 ? 30 : -30, v = k < 2 ? -width : width;
        corner[k] = point_in_plane(&fixture.scene, x + u * dx - v * dy,
                                   y + u * dy + v * dx);
      }
      build_face(&fixture.scene, corner, 4);
    }
    fixture.options.camera.azimuth_deg = random_between(&random, 0, 360);
    fixture.options.camera.elevation_deg = random_between(&random, -80, 80);
    fixture.options.camera.fov_deg = i % 2 == 0 ? 0 : 40;
    solve(&fixture, &lines);
    assert_int_equal(lines.count, 0);
  }
}

/* Where a triangle meets a rectangle beside its diagonal, within wide contact,
 * the line is where it is without contact, and not along the diagonal. */
static void the_longer_part_of_a_line_says_where_it_is(void **state) {
  static const double rectangle[] = {-1.5, -2,   -0.5, 2,    -2,   -0.5,
                                     2,    -0.5, -0.5, -1.5, -0.5, -0.5};
  static const double triangle[] = {
      1.5, -2, -1.5, 4, 1, 0.25, 2, 1, 0.6666666666666666};
  (void)state;
  for (int view = 0; view < 72; view++) {
    double length[2];
    for (int wide = 0; wide < 2; wide++) {
      struct sheet_fixture fixture;
      struct lines lines;
      sheet_fixture_start(&fixture);
      build_polygon(&fixture.scene, rectangle, 4);
      build_polygon(&fixture.scene, triangle, 3);
      fixture.options.solver.contact = 0.5 * wide;
      fixture.options.camera.azimuth_deg = 5 * view;
      fixture.options.camera.elevation_deg = 40 + view % 3;
      solve(&fixture, &lines);
      length[wide] = length_of(&lines);
    }
    assert_true(fabs(length[0] - length[1]) < 64);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_does_not_meet_has_no_line_at_any_contact),
      cmocka_unit_test(what_meets_beside_an_edge_has_its_line_there),
      cmocka_unit_test(a_line_along_a_diagonal_is_whole),
      cmocka_unit_test(a_diagonal_that_faces_share_may_be_a_line),
      cmocka_unit_test(a_clipped_face_has_its_whole_line),
      cmocka_unit_test(a_wall_seen_edge_on_has_its_whole_line),
      cmocka_unit_test(a_face_makes_no_line_with_itself),
      cmocka_unit_test(strips_in_one_plane_make_no_line),
      cmocka_unit_test(the_longer_part_of_a_line_says_where_it_is),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
