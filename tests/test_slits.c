/* test_slits.c - where faces without width were, and where points lie on sides
 * of faces, there is no border; and no line within a flat side of a body. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "recto.h"
#include "scene/diagnostics.h"
#include "scene/edges/edge_classes.h"
#include "scene/weld/face_rewrite.h"
#include "scene/weld/weld_near.h"
#include "tests/memory_faults.h"
#include "tests/scenes/build.h"

static const struct precision exact = {0, 0};
static const struct precision single = {0, PRECISION_SINGLE};

struct fixture {
  struct scene scene;
  struct welded welded;
  struct topology topology;
};

/* ---- A slab whose top is divided ----------------------------------------- */

/* The top of the slab, 60 by 40, is divided along y = 20, where there are
 * points at these x: the lower part has the first and the last alone, the upper
 * part all.  Triangles without width may lie between them. */
static const double middle[] = {0, 7, 13, 22, 31, 44, 60};
enum { POINTS = sizeof middle / sizeof *middle, LAST = POINTS - 1 };

enum gap { GAP_NONE, GAP_TRIANGLES, GAP_POLYGONS, GAP_NOT_DIVIDED };

/* Turned about z and x, and moved; rounded to single precision if so asked. */
static struct scene_point placed(double x, double y, double z, double turn,
                                 bool rounded) {
  double c = cos(turn), s = sin(turn);
  struct scene_point p = {c * x - s * y, s * x + c * y, z};
  p = (struct scene_point){p.x, c * p.y - s * p.z, s * p.y + c * p.z};
  if (rounded)
    p = (struct scene_point){(float)p.x, (float)p.y, (float)p.z};
  return p;
}

static void add_face(struct scene *scene, const uint32_t *corner,
                     size_t count) {
  struct diagnostics diagnostics = {0};
  recto_error error;
  assert_int_equal(
      scene_add_face(scene, corner, count, 1, &diagnostics, &error), RECTO_OK);
}

/* The points of the middle have the numbers from 0 on, the corners of the top
 * those from POINTS on, and those of the bottom the next four. */
static void add_slab(struct scene *scene, double turn, bool rounded,
                     enum gap gap) {
  const double side[4][2] = {{0, 0}, {60, 0}, {60, 40}, {0, 40}};
  const uint32_t a = POINTS, b = a + 1, c = a + 2, d = a + 3, e = a + 4;
  for (int i = 0; i < POINTS + 8; i++) {
    const double *at = side[(i + 8 - POINTS) % 4];
    struct scene_point p =
        i < POINTS
            ? placed(middle[i], 20, 10, turn, rounded)
            : placed(at[0], at[1], i < POINTS + 4 ? 10 : 0, turn, rounded);
    assert_true(ARRAY_PUSH(&scene->point, p));
  }
  if (gap == GAP_NOT_DIVIDED) {
    add_face(scene, (const uint32_t[]){a, b, c, d}, 4);
  } else if (gap == GAP_POLYGONS) {
    const uint32_t low[] = {a, b, 6, 5, 4, 3, 2, 1, 0};
    const uint32_t high[] = {0, 1, 2, 3, 4, 5, 6, c, d};
    add_face(scene, low, 9);
    add_face(scene, high, 9);
  } else {
    add_face(scene, (const uint32_t[]){a, b, LAST, 0}, 4);
    for (uint32_t i = 0; i < LAST; i++)
      add_face(scene, (const uint32_t[]){d, i, i + 1}, 3);
    add_face(scene, (const uint32_t[]){d, LAST, c}, 3);
  }
  for (uint32_t i = 1; gap == GAP_TRIANGLES && i < LAST; i++)
    add_face(scene, (const uint32_t[]){0, i + 1, i}, 3);
  add_face(scene, (const uint32_t[]){e, e + 3, e + 2, e + 1}, 4);
  add_face(scene, (const uint32_t[]){e, e + 1, b, a}, 4);
  add_face(scene, (const uint32_t[]){e + 2, e + 3, d, c}, 4);
  add_face(scene, (const uint32_t[]){e + 1, e + 2, c, LAST, b}, 5);
  add_face(scene, (const uint32_t[]){e + 3, e, a, 0, d}, 5);
}

static void begin(struct fixture *f, double length,
                  struct precision precision) {
  const struct weld_request request = {.length = length, .unstated = precision};
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

static size_t count_edges(const struct fixture *f, unsigned edge_class) {
  size_t count = 0;
  for (uint32_t e = 0; e < f->topology.edge.count; e++)
    count += (topology_class_mask(&f->topology, &f->welded.scene, e, 30) &
              edge_class) != 0;
  return count;
}

/* Of the slab 14 edges are creases, as two of a cube's are divided. */
static void assert_is_slab(const struct fixture *f) {
  assert_int_equal(count_edges(f, RECTO_EDGE_BORDER), 0);
  assert_int_equal(count_edges(f, RECTO_EDGE_CREASE), 14);
}

/* ---- Slits --------------------------------------------------------------- */

static void points_on_a_side_leave_no_border(void **state) {
  (void)state;
  for (int gap = GAP_NONE; gap <= GAP_TRIANGLES; gap++) {
    struct fixture f;
    scene_init(&f.scene);
    add_slab(&f.scene, 0, false, (enum gap)gap);
    begin(&f, -1, exact);
    assert_is_slab(&f);
    assert_int_equal(f.welded.thin, 0);
    assert_int_equal(scene_face_number(&f.welded.scene, 12),
                     gap == GAP_TRIANGLES ? 17 : 12);
    end(&f);
  }
}

static void rounded_faces_without_width_leave_no_line(void **state) {
  (void)state;
  for (int k = 1; k < 20; k++) {
    struct fixture f;
    scene_init(&f.scene);
    add_slab(&f.scene, 0.17 * k, true, GAP_TRIANGLES);
    begin(&f, -1, single);
    assert_is_slab(&f);
    assert_int_equal(scene_face_count(&f.welded.scene), 13);
    assert_int_equal(scene_face_number(&f.welded.scene, 12), 17);
    end(&f);
  }
}

static void exact_coordinates_keep_narrow_faces(void **state) {
  (void)state;
  struct fixture f;
  scene_init(&f.scene);
  add_slab(&f.scene, 0.17, true, GAP_TRIANGLES);
  begin(&f, -1, exact);
  assert_int_equal(f.welded.thin, 0);
  assert_false(f.welded.owns_faces);
  end(&f);
}

static void a_length_of_0_closes_none(void **state) {
  (void)state;
  struct fixture f;
  scene_init(&f.scene);
  add_slab(&f.scene, 0.17, true, GAP_TRIANGLES);
  begin(&f, 0, single);
  assert_int_equal(f.welded.thin, 0);
  assert_false(f.welded.owns_faces);
  end(&f);
}

/* A cone, whose base is a fan about a point of its rim: the first triangles of
 * that are thin. */
static void thin_faces_along_a_curve_stay(void **state) {
  (void)state;
  enum { SIDES = 4000 };
  struct fixture f;
  scene_init(&f.scene);
  for (int i = 0; i <= SIDES; i++) {
    double turn = 8 * atan(1) * i / SIDES, r = i < SIDES ? 10 : 0;
    struct scene_point p = placed(r * cos(turn) + 500, r * sin(turn) + 300,
                                  i < SIDES ? 0 : -4, 0.7, true);
    assert_true(ARRAY_PUSH(&f.scene.point, p));
  }
  for (uint32_t i = 1; i + 1 < SIDES; i++)
    add_face(&f.scene, (const uint32_t[]){0, i, i + 1}, 3);
  for (uint32_t i = 0; i < SIDES; i++)
    add_face(&f.scene, (const uint32_t[]){SIDES, (i + 1) % SIDES, i}, 3);
  begin(&f, -1, single);
  assert_int_equal(f.welded.borders, 0);
  end(&f);
}

/* A thin face alone is a line that someone wants to see. */
static void thin_faces_alone_stay(void **state) {
  (void)state;
  struct fixture f;
  const double hair[] = {0, 0, 0, 100, 0, 0, 50, 1e-6, 0};
  scene_init(&f.scene);
  build_polygon(&f.scene, hair, 3);
  begin(&f, -1, single);
  assert_int_equal(scene_face_count(&f.welded.scene), 1);
  assert_int_equal(count_edges(&f, RECTO_EDGE_BORDER), 3);
  end(&f);
}

/* Sides that only begin together, and those that a third one begins too, stay
 * borders. */
static void borders_that_do_not_meet_again_stay(void **state) {
  (void)state;
  struct fixture f;
  const double large[] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0};
  const double small[] = {0, 0, 0, 2, 0, 0, 2, -2, 0, 0, -2, 0};
  const double other[] = {2, 0, 0, 4, 0, 0, 3, -2, 2};
  scene_init(&f.scene);
  build_polygon(&f.scene, large, 4);
  build_polygon(&f.scene, small, 4);
  begin(&f, -1, exact);
  assert_int_equal(count_edges(&f, RECTO_EDGE_BORDER), 8);
  topology_fini(&f.topology);
  welded_fini(&f.welded);
  build_polygon(&f.scene, other, 3);
  begin(&f, -1, exact);
  assert_int_equal(count_edges(&f, RECTO_EDGE_BORDER), 8);
  assert_int_equal(count_edges(&f, RECTO_EDGE_CREASE), 1);
  topology_fini(&f.topology);
  welded_fini(&f.welded);
  build_polygon(&f.scene, other, 3);
  f.scene.point.item[f.scene.point.count - 1].z = 3;
  begin(&f, -1, exact);
  assert_false(f.welded.owns_faces);
  end(&f);
}

static void normals_and_groups_stay_with_their_faces(void **state) {
  (void)state;
  struct fixture f;
  scene_init(&f.scene);
  add_slab(&f.scene, 0, false, GAP_NONE);
  assert_true(scene_list_groups(&f.scene));
  for (uint32_t i = 0; i < f.scene.face_count; i++)
    f.scene.face_group.item[i] = 0;
  assert_true(smoothing_set(&f.scene.smoothing, 0, SMOOTHING_GROUPS));
  assert_true(smoothing_set(&f.scene.smoothing, 9, SMOOTHING_OFF));
  begin(&f, -1, exact);
  assert_int_equal(smoothing_of_face(&f.welded.scene.smoothing, 0),
                   SMOOTHING_GROUPS);
  assert_int_equal(smoothing_of_face(&f.welded.scene.smoothing, 9),
                   SMOOTHING_OFF);
  end(&f);
}

static void memory_may_run_out(void **state) {
  (void)state;
  struct memory_faults faults = {.least = 10};
  while (memory_faults_go_on(&faults)) {
    struct fixture f;
    const struct weld_request request = {.length = -1, .unstated = single};
    recto_error error;
    scene_init(&f.scene);
    add_slab(&f.scene, 0.17, true, GAP_TRIANGLES);
    memory_faults_begin(&faults);
    recto_status status =
        weld_near(&f.welded, &f.topology, &f.scene, &request, &error);
    memory_faults_end(&faults, status);
    if (status == RECTO_OK)
      assert_is_slab(&f);
    end(&f);
  }
}

/* ---- Drawings ------------------------------------------------------------ */

/* Adds the slab to a scene of the library, with coordinates in single
 * precision. */
static recto_scene *slab_of_library(double turn, enum gap gap) {
  struct scene scene;
  recto_scene *made = NULL;
  recto_error error;
  scene_init(&scene);
  add_slab(&scene, turn, true, gap);
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

/* The length of what is drawn of a class, mm. */
static double drawn_length(const recto_scene *scene, unsigned edge_class) {
  recto_drawing *drawing = NULL;
  recto_options options;
  recto_error error;
  recto_stroke stroke;
  double length = 0;
  recto_options_init(&options);
  options.mesh.coordinate_bits = 24;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, &error),
                   RECTO_OK);
  for (size_t i = 0; recto_drawing_stroke(drawing, i, &stroke); i++)
    for (size_t k = 1; k < stroke.count + stroke.closed; k++) {
      const double *p = stroke.points + 2 * (k - 1);
      const double *q = stroke.points + 2 * (k % stroke.count);
      if (stroke.edge_class == edge_class)
        length += hypot(q[0] - p[0], q[1] - p[1]);
    }
  recto_drawing_destroy(drawing);
  return length;
}

static void flat_sides_have_no_line_within(void **state) {
  (void)state;
  static const unsigned edge_class[] = {RECTO_EDGE_SILHOUETTE,
                                        RECTO_EDGE_CREASE, RECTO_EDGE_BORDER};
  for (int k = 1; k < 60; k++) {
    recto_scene *box = slab_of_library(0.1 * k, GAP_NOT_DIVIDED);
    recto_scene *slab =
        slab_of_library(0.1 * k, k % 2 ? GAP_TRIANGLES : GAP_POLYGONS);
    for (int c = 0; c < 3; c++)
      assert_true(fabs(drawn_length(slab, edge_class[c]) -
                       drawn_length(box, edge_class[c])) < 1e-3);
    recto_scene_destroy(slab);
    recto_scene_destroy(box);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(points_on_a_side_leave_no_border),
      cmocka_unit_test(rounded_faces_without_width_leave_no_line),
      cmocka_unit_test(exact_coordinates_keep_narrow_faces),
      cmocka_unit_test(a_length_of_0_closes_none),
      cmocka_unit_test(thin_faces_along_a_curve_stay),
      cmocka_unit_test(thin_faces_alone_stay),
      cmocka_unit_test(borders_that_do_not_meet_again_stay),
      cmocka_unit_test(normals_and_groups_stay_with_their_faces),
      cmocka_unit_test(memory_may_run_out),
      cmocka_unit_test(flat_sides_have_no_line_within),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
