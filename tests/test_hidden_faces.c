/* test_hidden_faces.c - faces that are hidden are left out before they are
 * projected, with all that is connected to them, and no drawing changes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "api/handle.h"
#include "base/memory.h"
#include "tests/obj_drawing.h"
#include "tests/scenes/random.h"
#include "tests/sheet_fixture.h"
#include "visibility/culling/face_runs.h"
#include "visibility/culling/space_box.h"
#include "visibility/hidden_faces.h"

enum {
  A_SIDE = 6, /* parts along each axis of a housing */
  PARTS = A_SIDE * A_SIDE * A_SIDE,
  HOUSING = 6, /* faces, the first ones */
  FINS = 4
};

/* ---- A housing with parts inside ----------------------------------------- */

/* A unit cube, and small cubes in a lattice, each a group.
 * top  the height of the uppermost ones */
static void add_assembly(struct scene *scene, double top) {
  const double gap[3] = {0.1, 0.1, 1 - top};
  build_box(scene, vector_of(0, 0, 0), vector_of(1, 1, 1));
  for (int i = 0; i < PARTS; i++) {
    int at[3] = {i % A_SIDE, i / A_SIDE % A_SIDE, i / A_SIDE / A_SIDE};
    double low[3], high[3];
    char name[16];
    snprintf(name, sizeof name, "part %d", i);
    build_group(scene, name);
    for (int k = 0; k < 3; k++) {
      double step = (1 - 2 * gap[k]) / (A_SIDE - 0.1);
      low[k] = gap[k] + at[k] * step;
      high[k] = at[k] + 1 == A_SIDE ? 1 - gap[k] : low[k] + 0.9 * step;
    }
    build_box(scene, vector_of(low[0], low[1], low[2]),
              vector_of(high[0], high[1], high[2]));
  }
}

/* Finds what is left out of a fixture's scene. */
static struct hidden_faces find_hidden(struct sheet_fixture *fixture,
                                       bool fragments) {
  struct hidden_faces hidden;
  sheet_fixture_out(fixture, false);
  assert_int_equal(hidden_faces_init(&hidden, &fixture->scene,
                                     &fixture->topology, &fixture->camera,
                                     &fixture->options, fragments, NULL),
                   RECTO_OK);
  return hidden;
}

static size_t count_hidden(struct sheet_fixture *fixture) {
  struct hidden_faces hidden = find_hidden(fixture, false);
  size_t count = hidden.count;
  hidden_faces_fini(&hidden);
  sheet_fixture_fini(fixture);
  return count;
}

static void what_is_in_a_housing_is_left_out(void **state) {
  (void)state;
  for (int how = 0; how < 4; how++) { /* perspective or not, filled or not */
    struct sheet_fixture fixture;
    sheet_fixture_start(&fixture);
    fixture.options.camera.fov_deg = how & 1 ? 50 : 0;
    add_assembly(&fixture.scene, 0.9);
    struct hidden_faces hidden = find_hidden(&fixture, (how & 2) != 0);
    assert_int_equal(hidden.count, 6 * PARTS);
    for (uint32_t f = 0; f < scene_face_count(&fixture.scene); f++)
      assert_int_equal(hidden.left_out[f] != 0, f >= HOUSING);
    hidden_faces_fini(&hidden);
    sheet_fixture_fini(&fixture);
  }
}

/* Parts that touch the wall between them and the viewer may be visible. */
static void contact_is_not_left_out(void **state) {
  struct sheet_fixture fixture;
  (void)state;
  sheet_fixture_start(&fixture);
  scenes_view_above(&fixture.options);
  add_assembly(&fixture.scene, 1);
  struct hidden_faces hidden = find_hidden(&fixture, false);
  assert_int_equal(hidden.count, 6 * (PARTS - A_SIDE * A_SIDE));
  for (uint32_t f = HOUSING; f < scene_face_count(&fixture.scene); f++) {
    bool touches = (f - HOUSING) / 6 / (A_SIDE * A_SIDE) == A_SIDE - 1;
    assert_int_equal(hidden.left_out[f] != 0, !touches);
  }
  hidden_faces_fini(&hidden);
  sheet_fixture_fini(&fixture);
}

/* Each part is joined to the next one by a triangle, and the last one to the
 * housing. */
static void what_is_connected_to_something_visible_stays(void **state) {
  (void)state;
  for (int joined = 0; joined <= 1; joined++) {
    struct sheet_fixture fixture;
    sheet_fixture_start(&fixture);
    add_assembly(&fixture.scene, 0.9);
    for (uint32_t part = 1; part < PARTS; part++)
      build_triangle(&fixture.scene, 8 * part, 8 * part + 6, 8 * part + 8);
    if (joined)
      build_triangle(&fixture.scene, 8 * PARTS, 8 * PARTS + 1, 0);
    size_t count = count_hidden(&fixture);
    assert_int_equal(count, joined ? 0 : 7 * PARTS - 1);
  }
}

/* Few faces over each other are not looked at. */
static void a_shallow_scene_is_whole(void **state) {
  struct sheet_fixture fixture;
  (void)state;
  sheet_fixture_start(&fixture);
  build_box(&fixture.scene, vector_of(0, 0, 0), vector_of(1, 1, 1));
  assert_int_equal(count_hidden(&fixture), 0);
}

/* Nor are faces of about one size: they are culled as triangles.  A square
 * hides a stack of smaller ones. */
static void faces_of_one_size_are_whole(void **state) {
  (void)state;
  for (int small = 0; small <= 1; small++) {
    struct sheet_fixture fixture;
    const int count = 400;
    sheet_fixture_start(&fixture);
    scenes_view_above(&fixture.options);
    for (int i = 0; i < count; i++) {
      double size = i == 0 ? 1 : small ? 0.2 : 0.9, low = 0.5 - size / 2;
      build_parallelogram(&fixture.scene, vector_of(low, low, -0.001 * i),
                          vector_of(size, 0, 0), vector_of(0, size, 0));
    }
    assert_int_equal(count_hidden(&fixture), small ? count - 1 : 0);
  }
}

/* ---- Runs ---------------------------------------------------------------- */

/* Checks that the runs are all faces in order, that the points of each are
 * within its box and its range, and that the large faces are listed. */
static void check_runs(const struct scene *scene, double large) {
  struct face_runs runs;
  assert_true(face_runs_init(&runs, scene, large));
  size_t listed = 0;
  uint32_t next = 0;
  for (size_t r = 0; r < runs.run.count; r++) {
    const struct face_run *run = &runs.run.item[r];
    assert_int_equal(run->first, next);
    next = face_runs_end(&runs, scene, r);
    assert_true(next > run->first);
    for (uint32_t f = run->first; f < next; f++) {
      double low[3] = {INFINITY, INFINITY, INFINITY},
             high[3] = {-INFINITY, -INFINITY, -INFINITY};
      assert_int_equal(scene_face_group(scene, f),
                       scene_face_group(scene, run->first));
      for (uint32_t c = scene_face_start(scene, f);
           c < scene_face_start(scene, f + 1); c++) {
        uint32_t p = scene->corner.item[c];
        const struct scene_point *at = &scene->point.item[p];
        const double xyz[3] = {at->x, at->y, at->z};
        assert_in_range(p, run->first_point, run->end_point - 1);
        for (int k = 0; k < 3; k++) {
          assert_true(run->low[k] <= xyz[k] && xyz[k] <= run->high[k]);
          low[k] = fmin(low[k], xyz[k]);
          high[k] = fmax(high[k], xyz[k]);
        }
      }
      double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
      bool is_large = fmax(x * y, fmax(y * z, z * x)) >= large;
      bool is_listed =
          listed < runs.large.count && runs.large.item[listed].face == f;
      assert_int_equal(is_listed, is_large);
      listed += is_listed;
    }
  }
  assert_int_equal(next, scene_face_count(scene));
  assert_int_equal(listed, runs.large.count);
  face_runs_fini(&runs);
}

/* Boxes whose faces are near each other in the file, then triangles whose
 * points are not, some of them large, and points that no face uses. */
static void runs_hold_their_faces(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 20; seed++) {
    struct random random = {seed};
    struct scene scene;
    scene_init(&scene);
    build_group(&scene, "all");
    for (int i = 0; i < 60; i++) {
      double x = i % 10, y = i / 10, size = i % 9 == 0 ? 3 : 0.5;
      build_box(&scene, vector_of(x, y, 0), vector_of(x + size, y + size, 1));
      if (i % 7 == 0)
        build_point(&scene, i % 2 ? 1e6 : INFINITY, 0, 0);
      if (i % 20 == 0)
        build_group(&scene, i == 20 ? "some" : "others");
    }
    uint32_t points = (uint32_t)scene.point.count;
    for (int i = 0; i < 500; i++) {
      uint32_t p[3];
      for (int k = 0; k < 3; k++)
        do
          p[k] = i < 100 ? random_below(&random, points)
                         : random_below(&random, 8) + 9 * ((uint32_t)i / 40);
        while (!isfinite(scene.point.item[p[k]].x));
      build_triangle(&scene, p[0], p[1], p[2]);
    }
    check_runs(&scene, 2);
    check_runs(&scene, 0.1);
    check_runs(&scene, 1e9);
    scene_fini(&scene);
  }
}

/* ---- Drawings ------------------------------------------------------------ */

/* A number in a drawing's stats. */
/* A quad from (x, y, z), which is as long in y, and its face. */
static void write_quad(FILE *to, double x, double y, double z, double width,
                       double length, double height) {
  for (int p = 0; p < 4; p++)
    fprintf(to, "v %.5g %.5g %.5g\n", x + (p == 1 || p == 2 ? width : 0),
            y + (p / 2 ? length : 0), z + (p == 1 || p == 2 ? height : 0));
  fprintf(to, "f -4 -3 -2 -1\n");
}

/* Fins that rise from the top of a housing, and under the top what may be in
 * contact with one, as that is steep: first what is hidden. */
static void write_fins(FILE *to, struct random random, bool hidden) {
  for (int i = 0; i < FINS; i++) {
    double x = random_between(&random, 1, 8), y = random_between(&random, 1, 8),
           width = random_between(&random, 0.02, 0.3),
           height = random_between(&random, 1, 3),
           depth = random_between(&random, 0.15, 0.3);
    fprintf(to, "g fin%d\n", 2 * i + hidden);
    if (hidden)
      write_quad(to, x, y, 10 - depth, 0.02, 1, 0);
    else
      write_quad(to, x, y, 10.01, width, 1, height);
  }
}

/* A housing, seldom without a wall, with parts at random: most of them inside,
 * some at its walls, through them, or joined to it.  It comes first or last. */
static void write_assembly(FILE *to, struct random *random) {
  static const int quad[6][4] = {{4, 3, 2, 1}, {5, 6, 7, 8}, {1, 2, 6, 5},
                                 {2, 3, 7, 6}, {3, 4, 8, 7}, {4, 1, 5, 8}};
  int parts = random_int(random, 150, 300),
      housing = random_below(random, 2) ? parts : 0;
  bool is_open = random_below(random, 5) == 0, joins = random_below(random, 3);
  struct random fins = {random_next(random)};
  write_fins(to, fins, true);
  for (int i = 0; i <= parts; i++) {
    double low[3] = {0, 0, 0}, high[3] = {10, 10, 10};
    int first = 4 * FINS + 8 * i;
    for (int k = 0; i != housing && k < 3; k++) {
      double side = random_between(random, 0.5, 2);
      uint32_t place = random_below(random, 40);
      low[k] = place == 0   ? 0
               : place == 1 ? 10 - side
               : place == 2 ? 9.5
                            : random_between(random, 0.01, 9.99 - side);
      high[k] = low[k] + side;
    }
    for (int p = 0; p < 8; p++)
      fprintf(to, "v %.5g %.5g %.5g\n", (p + 1) / 2 % 2 ? high[0] : low[0],
              p / 2 % 2 ? high[1] : low[1], p / 4 ? high[2] : low[2]);
    if (random_below(random, 2) == 0)
      fprintf(to, "g part%d\n", i);
    for (int q = i == housing && is_open ? 1 : 0; q < 6; q++)
      fprintf(to, "f %d %d %d %d\n", first + quad[q][0], first + quad[q][1],
              first + quad[q][2], first + quad[q][3]);
    if (i > 0 && joins && random_below(random, 60) == 0)
      fprintf(to, "f %d %d %d\n", first + 1, first + 2,
              4 * FINS + 1 + (int)random_below(random, 8));
  }
  write_fins(to, fins, false);
}

static char *draw(const char *text, size_t length, const recto_options *options,
                  long *left_out) {
  return obj_drawing_svg(text, length, options, "faces_left_out", left_out);
}

/* Another method solves all faces. */
static void drawings_do_not_change(void **state) {
  static const recto_fill fills[] = {RECTO_FILL_NONE, RECTO_FILL_PAINT,
                                     RECTO_FILL_SHADE, RECTO_FILL_HATCH};
  static const double contacts[] = {-1, 0, 0.05};
  struct random random = {14};
  long left_out = 0;
  (void)state;
  for (int scene = 0; scene < 40; scene++) {
    recto_options options;
    char *text;
    size_t length;
    long count[2];
    FILE *to = open_memstream(&text, &length);
    assert_non_null(to);
    write_assembly(to, &random);
    assert_int_equal(fclose(to), 0);
    recto_options_init(&options);
    options.camera.azimuth_deg = random_between(&random, 0, 360);
    options.camera.up[2] = 1;
    options.camera.elevation_deg =
        random_below(&random, 2) ? 90 : random_between(&random, -90, 90);
    options.camera.fov_deg = random_below(&random, 2) ? 60 : 0;
    options.ink.exact = random_below(&random, 2);
    if (random_below(&random, 2))
      options.ink.edges = RECTO_EDGES_ALL;
    options.ink.fill = fills[random_below(&random, 4)];
    options.solver.contact = contacts[random_below(&random, 3)];
    char *part = draw(text, length, &options, &count[0]);
    options.solver.method = RECTO_METHOD_BRUTE;
    char *whole = draw(text, length, &options, &count[1]);
    if (strcmp(part, whole) != 0)
      fail_msg("scene %d is drawn differently", scene);
    assert_int_equal(count[1], 0);
    left_out += count[0];
    free(part);
    free(whole);
    free(text);
  }
  assert_true(left_out > 10000);
}

/* Draws while allocation `fails` fails; none for 0. */
static recto_status draw_with_fault(const recto_scene *scene,
                                    const recto_options *options,
                                    unsigned long fails, long *left_out) {
  recto_drawing *drawing;
  mem_fail_after(fails);
  recto_status status = recto_scene_render(scene, options, &drawing, NULL);
  mem_fail_after(0);
  if (status == RECTO_OK && fails == 0)
    *left_out = obj_drawing_number(drawing, "faces_left_out");
  recto_drawing_destroy(drawing);
  return status;
}

/* Each of the first allocations fails once. */
static void memory_may_run_out(void **state) {
  struct random random = {16};
  recto_options options;
  recto_scene *scene;
  char *text;
  size_t length;
  long left_out = 0, failures = 0;
  FILE *to = open_memstream(&text, &length);
  (void)state;
  assert_non_null(to);
  write_assembly(to, &random);
  assert_int_equal(fclose(to), 0);
  recto_options_init(&options);
  options.ink.fill = RECTO_FILL_PAINT;
  scene = obj_drawing_scene(text, length, &options);
  for (unsigned long n = 1; n <= 300; n++) {
    recto_status status = draw_with_fault(scene, &options, n, NULL);
    assert_true(status == RECTO_OK || status == RECTO_ERROR_MEMORY);
    failures += status == RECTO_ERROR_MEMORY;
  }
  assert_int_equal(draw_with_fault(scene, &options, 0, &left_out), RECTO_OK);
  assert_true(left_out > 0 && failures > 100);
  recto_scene_destroy(scene);
  free(text);
}

/* ---- Boxes in space ------------------------------------------------------ */

/* No point of a box is projected outside of its box on the page, or in front of
 * its bounds of depth there. */
static void points_of_a_box_are_within_its_bounds(void **state) {
  struct random random = {15};
  size_t near = 0, far = 0;
  (void)state;
  for (int round = 0; round < 300; round++) {
    struct sheet_fixture fixture;
    double low[3], high[3], offset = round % 3 ? 0 : 1e6;
    sheet_fixture_start(&fixture);
    fixture.options.camera.azimuth_deg = random_int(&random, 0, 8) * 45;
    fixture.options.camera.elevation_deg = random_between(&random, -90, 90);
    fixture.options.camera.fov_deg = round % 2 ? 70 : 0;
    build_box(&fixture.scene, vector_of(offset, 0, 0),
              vector_of(offset + 1, 1, 1));
    sheet_fixture_out(&fixture, false);
    struct projection projection = projection_of(&fixture.camera);
    for (int k = 0; k < 3; k++) {
      low[k] = random_between(&random, 0, 0.8) + (k == 0 ? offset : 0);
      high[k] = low[k] + random_between(&random, 0, 0.2);
    }
    struct space_box box;
    assert_true(
        space_box_project(&box, &fixture.camera, &projection, low, high));
    for (int i = 0; i < 200; i++) {
      double at[3];
      for (int k = 0; k < 3; k++) {
        uint32_t place = random_below(&random, 4);
        at[k] = place == 0   ? low[k]
                : place == 1 ? high[k]
                             : random_between(&random, low[k], high[k]);
      }
      const struct scene_point point = {at[0], at[1], at[2]};
      struct geom_point p =
          project_point(&projection, camera_view(&fixture.camera, &point));
      assert_in_range(p.x - box.page.x0, 0, box.page.x1 - box.page.x0);
      assert_in_range(p.y - box.page.y0, 0, box.page.y1 - box.page.y0);
      struct box_depths depths =
          space_box_depths(&box, p.x - 1, p.y - 1, p.x + 1, p.y + 1);
      assert_true((double)p.z <= depths.high + 1);
      assert_true((double)p.z >= depths.low - 1);
      near += (double)p.z > depths.high - 0x1p-12 * (double)SHEET_Z_MAX;
      far += (double)p.z < depths.low + 0x1p-12 * (double)SHEET_Z_MAX;
    }
    sheet_fixture_fini(&fixture);
  }
  assert_true(near > 5000 &&
              far > 5000); /* the bounds are those of the sides */
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_in_a_housing_is_left_out),
      cmocka_unit_test(contact_is_not_left_out),
      cmocka_unit_test(what_is_connected_to_something_visible_stays),
      cmocka_unit_test(a_shallow_scene_is_whole),
      cmocka_unit_test(faces_of_one_size_are_whole),
      cmocka_unit_test(runs_hold_their_faces),
      cmocka_unit_test(drawings_do_not_change),
      cmocka_unit_test(memory_may_run_out),
      cmocka_unit_test(points_of_a_box_are_within_its_bounds),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
