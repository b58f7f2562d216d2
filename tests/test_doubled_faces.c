/* test_doubled_faces.c - a surface of which each face is listed twice is drawn
 * as one of which each is listed once. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "recto.h"
#include "scene/edges/edge_classes.h"
#include "scene/weld/weld_near.h"
#include "tests/memory_faults.h"
#include "tests/scenes/build.h"

/* ---- A gutter of quadrilaterals ------------------------------------------ */

enum { ROWS = 6, COLUMNS = 9, FACES = ROWS * COLUMNS };

enum copy { COPY_NONE, COPY_REVERSED, COPY_SAME_WAY };

/* How faces are listed. */
struct listing {
  enum copy copy;
  bool is_inverse; /* all of them face the other way */
  bool has_groups; /* the copies have one of their own */
};

/* Half a cylinder, open at all four sides. */
static void add_points(struct scene *scene) {
  for (int r = 0; r <= ROWS; r++)
    for (int c = 0; c <= COLUMNS; c++) {
      double angle = 4 * atan(1) * c / COLUMNS;
      build_point(scene, cos(angle), sin(angle), r);
    }
}

static void add_quads(struct scene *scene, bool reversed) {
  for (uint32_t r = 0; r < ROWS; r++)
    for (uint32_t c = 0; c < COLUMNS; c++) {
      uint32_t a = r * (COLUMNS + 1) + c, b = a + 1, d = a + COLUMNS + 1;
      if (reversed)
        build_quad(scene, d + 1, b, a, d); /* from another corner */
      else
        build_quad(scene, a, b, d + 1, d);
    }
}

static void add_gutter(struct scene *scene, struct listing listing) {
  scene_init(scene);
  add_points(scene);
  if (listing.has_groups)
    build_group(scene, "outside");
  add_quads(scene, listing.is_inverse);
  if (listing.has_groups)
    build_group(scene, "inside");
  if (listing.copy != COPY_NONE)
    add_quads(scene, listing.is_inverse != (listing.copy == COPY_REVERSED));
}

/* ---- Edges --------------------------------------------------------------- */

struct fixture {
  struct scene scene;
  struct welded welded;
  struct topology topology;
};

static void begin(struct fixture *f, struct weld_request request) {
  recto_error error;
  assert_int_equal(
      weld_near(&f->welded, &f->topology, &f->scene, &request, &error),
      RECTO_OK);
}

static void end(struct fixture *f) {
  topology_fini(&f->topology);
  welded_fini(&f->welded);
  scene_fini(&f->scene);
}

/* The number of edges of so many faces. */
static size_t edges_of_uses(const struct fixture *f, unsigned uses) {
  size_t count = 0;
  for (size_t e = 0; e < f->topology.edge.count; e++)
    count += f->topology.edge.item[e].uses == uses;
  return count;
}

static void assert_is_gutter(const struct fixture *f) {
  assert_int_equal(scene_face_count(&f->welded.scene), FACES);
  assert_int_equal(edges_of_uses(f, 1), 2 * (ROWS + COLUMNS));
  assert_int_equal(edges_of_uses(f, 2), 2 * FACES - ROWS - COLUMNS);
  assert_int_equal(edges_of_uses(f, 3), 0);
}

static const struct weld_request by_rounding = {.length = -1};

static void edges_are_those_of_the_surface(void **state) {
  (void)state;
  static const struct listing listing[] = {{COPY_NONE, false, false},
                                           {COPY_REVERSED, false, false},
                                           {COPY_REVERSED, true, false},
                                           {COPY_SAME_WAY, false, false}};
  for (size_t i = 0; i < sizeof listing / sizeof *listing; i++) {
    struct fixture f;
    add_gutter(&f.scene, listing[i]);
    begin(&f, by_rounding);
    assert_is_gutter(&f);
    assert_int_equal(f.welded.doubled,
                     listing[i].copy == COPY_NONE ? 0 : FACES);
    end(&f);
  }
}

/* Faces keep their numbers in the file. */
static void left_out_faces_are_counted_as_skipped(void **state) {
  (void)state;
  struct fixture f;
  add_gutter(&f.scene, (struct listing){.copy = COPY_REVERSED});
  begin(&f, by_rounding);
  assert_int_equal(f.welded.scene.face_skipped.count, FACES);
  for (int i = 0; i < FACES; i++)
    assert_int_equal(f.welded.scene.face_skipped.item[i], FACES);
  end(&f);
}

static void what_differs_or_is_to_stay_stays(void **state) {
  (void)state;
  static const struct weld_request request[] = {
      {.length = 0}, {.length = -1, .keeps_doubled = true}, {.length = -1}};
  for (int i = 0; i < 3; i++) {
    struct fixture f;
    add_gutter(&f.scene,
               (struct listing){.copy = COPY_REVERSED, .has_groups = i == 2});
    begin(&f, request[i]);
    assert_int_equal(scene_face_count(&f.welded.scene), 2 * FACES);
    assert_int_equal(edges_of_uses(&f, 3), 2 * FACES - ROWS - COLUMNS);
    end(&f);
  }
}

/* Three faces at an edge, and a face alone with its reverse: each edge has the
 * faces that there are. */
static void faces_of_other_points_stay(void **state) {
  (void)state;
  struct fixture f;
  scene_init(&f.scene);
  for (int i = 0; i < 5; i++)
    build_point(&f.scene, i / 2, i % 2, i * i);
  for (uint32_t i = 2; i < 5; i++)
    build_triangle(&f.scene, 0, 1, i);
  add_points(&f.scene);
  build_triangle(&f.scene, 5, 6, 15);
  build_triangle(&f.scene, 6, 5, 15);
  begin(&f, by_rounding);
  assert_int_equal(f.welded.doubled, 0);
  assert_int_equal(edges_of_uses(&f, 3), 1);
  end(&f);
}

/* Quadrilaterals on the same four points, of which one crosses over. */
static void the_order_of_points_counts(void **state) {
  (void)state;
  struct fixture f;
  scene_init(&f.scene);
  const double at[5][3] = {
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  for (int i = 0; i < 5; i++)
    build_point(&f.scene, at[i][0], at[i][1], at[i][2]);
  build_quad(&f.scene, 0, 1, 2, 3);
  build_quad(&f.scene, 0, 2, 1, 3);
  build_triangle(&f.scene, 1, 2, 4);
  build_triangle(&f.scene, 0, 3, 4);
  begin(&f, by_rounding);
  assert_int_equal(edges_of_uses(&f, 3), 2);
  assert_int_equal(f.welded.doubled, 0);
  end(&f);
}

static void memory_may_run_out(void **state) {
  (void)state;
  struct memory_faults faults = {.least = 5};
  while (memory_faults_go_on(&faults)) {
    struct fixture f;
    recto_error error;
    add_gutter(&f.scene, (struct listing){.copy = COPY_REVERSED});
    memory_faults_begin(&faults);
    recto_status status =
        weld_near(&f.welded, &f.topology, &f.scene, &by_rounding, &error);
    memory_faults_end(&faults, status);
    if (status == RECTO_OK)
      assert_is_gutter(&f);
    end(&f);
  }
}

/* ---- Drawings ------------------------------------------------------------ */

static recto_scene *gutter_of_library(struct listing listing) {
  struct scene scene;
  recto_scene *made = NULL;
  recto_error error;
  add_gutter(&scene, listing);
  assert_true(scene_list_starts(&scene));
  recto_mesh mesh = {.points = &scene.point.item[0].x,
                     .point_count = scene.point.count,
                     .corners = scene.corner.item,
                     .corner_count = scene.corner.count,
                     .face_offsets = scene.face_start.item,
                     .face_count = scene.face_count};
  assert_int_equal(recto_scene_create(&made, &error), RECTO_OK);
  assert_int_equal(recto_scene_add_mesh(made, &mesh, &error), RECTO_OK);
  scene_fini(&scene);
  return made;
}

static recto_options options_of_view(void) {
  recto_options options;
  recto_options_init(&options);
  options.camera.azimuth_deg = 20;
  options.camera.elevation_deg = 35;
  return options;
}

static recto_drawing *draw(const recto_scene *scene,
                           const recto_options *options) {
  recto_error error;
  recto_drawing *drawing = NULL;
  assert_int_equal(recto_scene_render(scene, options, &drawing, &error),
                   RECTO_OK);
  return drawing;
}

static void drawings_are_the_same(void **state) {
  (void)state;
  for (int smooth = 0; smooth < 2; smooth++) {
    recto_options options = options_of_view();
    if (smooth)
      options.ink.contours = RECTO_CONTOURS_SMOOTH;
    recto_scene *once = gutter_of_library((struct listing){.copy = COPY_NONE});
    recto_scene *twice =
        gutter_of_library((struct listing){.copy = COPY_REVERSED});
    recto_drawing *right = draw(once, &options);
    recto_drawing *drawing = draw(twice, &options);
    recto_stroke a, b;
    size_t i = 0;
    for (; recto_drawing_stroke(right, i, &a); i++) {
      assert_true(recto_drawing_stroke(drawing, i, &b));
      assert_int_equal(a.edge_class, b.edge_class);
      assert_int_equal(a.count, b.count);
      assert_memory_equal(a.points, b.points, 2 * a.count * sizeof *a.points);
    }
    assert_true(i > 0);
    assert_false(recto_drawing_stroke(drawing, i, &b));
    recto_drawing_destroy(drawing);
    recto_drawing_destroy(right);
    recto_scene_destroy(twice);
    recto_scene_destroy(once);
  }
}

/* The length of what is drawn, mm. */
static double drawn_length(const recto_scene *scene,
                           const recto_options *options) {
  recto_drawing *drawing = draw(scene, options);
  recto_stroke stroke;
  double length = 0;
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++)
    for (size_t k = 1; k < stroke.count; k++)
      length += hypot(stroke.points[2 * k] - stroke.points[2 * k - 2],
                      stroke.points[2 * k + 1] - stroke.points[2 * k - 1]);
  recto_drawing_destroy(drawing);
  return length;
}

/* Where faces that are seen from behind are left out, all stay, also in a scene
 * that was prepared for a drawing with them. */
static void both_sides_stay_where_backs_go(void **state) {
  (void)state;
  for (int inverse = 0; inverse < 2; inverse++) {
    recto_scene *scene = gutter_of_library(
        (struct listing){.copy = COPY_REVERSED, .is_inverse = inverse});
    recto_options with = options_of_view(), without = with, all;
    recto_error error;
    without.solver.method = RECTO_METHOD_ZBUFFER;
    without.solver.remove_backs = true;
    all = without;
    all.mesh.weld = 0;
    double wanted = drawn_length(scene, &all);
    assert_true(wanted > 500);
    assert_true(drawn_length(scene, &without) == wanted);
    assert_int_equal(recto_scene_prepare(scene, &with, &error), RECTO_OK);
    assert_true(drawn_length(scene, &without) == wanted);
    recto_scene_destroy(scene);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(edges_are_those_of_the_surface),
      cmocka_unit_test(left_out_faces_are_counted_as_skipped),
      cmocka_unit_test(what_differs_or_is_to_stay_stays),
      cmocka_unit_test(faces_of_other_points_stay),
      cmocka_unit_test(the_order_of_points_counts),
      cmocka_unit_test(memory_may_run_out),
      cmocka_unit_test(drawings_are_the_same),
      cmocka_unit_test(both_sides_stay_where_backs_go),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
