/* test_api.c - the guarantees of recto.h: options, handles, errors, cancelling,
 * and outputs that are NULL or complete. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "api/handle.h"
#include "api/output_format.h"
#include "base/stream.h"
#include "tests/box_mesh.h"
#include "tests/memory_faults.h"

/* ---- A cube -------------------------------------------------------------- */

static recto_status add_cube(recto_scene *scene, recto_error *error) {
  recto_status status = recto_scene_add_group(scene, "cube", error);
  for (int i = 0; i < 8 && status == RECTO_OK; i++)
    status = recto_scene_add_point(scene, box_cube[i], NULL, error);
  for (int i = 0; i < 6 && status == RECTO_OK; i++)
    status = recto_scene_add_face(scene, box_faces[i], 4, error);
  return status;
}

static recto_scene *make_cube(void) {
  recto_scene *scene = box_scene(NULL);
  assert_int_equal(add_cube(scene, NULL), RECTO_OK);
  return scene;
}

static recto_drawing *draw(const recto_scene *scene,
                           const recto_options *options) {
  recto_drawing *drawing;
  recto_error error = {0};
  if (recto_scene_render(scene, options, &drawing, &error) != RECTO_OK)
    fail_msg("%s", error.text);
  return drawing;
}

static double length_of(const recto_stroke *stroke) {
  double length = 0;
  for (size_t i = 0; i + 1 < stroke->count + stroke->closed; i++) {
    const double *a = stroke->points + 2 * i;
    const double *b = stroke->points + 2 * ((i + 1) % stroke->count);
    length += hypot(b[0] - a[0], b[1] - a[1]);
  }
  return length;
}

static double drawn_length(const recto_drawing *drawing) {
  double length = 0;
  for (size_t i = 0; i < recto_drawing_stroke_count(drawing); i++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, i, &stroke));
    length += length_of(&stroke);
  }
  return length;
}

/* A path for a file of this test that ends in `name`; good for two calls. */
static const char *path_of(const char *name) {
  static char path[2][64];
  static int which;
  which = !which;
  snprintf(path[which], sizeof path[which], "test_api.%ld.%s", (long)getpid(),
           name);
  return path[which];
}

/* ---- Words --------------------------------------------------------------- */

static void every_enumerator_has_its_own_name(void **state) {
  (void)state;
  for (int i = 0; i < RECTO_METHOD_COUNT; i++)
    for (int k = 0; k < i; k++)
      assert_string_not_equal(recto_method_name((recto_method)i),
                              recto_method_name((recto_method)k));
  for (int i = 0; i < RECTO_STATUS_COUNT; i++)
    for (int k = 0; k < i; k++)
      assert_string_not_equal(recto_status_name((recto_status)i),
                              recto_status_name((recto_status)k));
  for (int i = 0; i < RECTO_EDGE_CLASS_COUNT; i++)
    for (int k = 0; k < i; k++)
      assert_string_not_equal(
          recto_edge_class_name((recto_edge_class)(1 << i)),
          recto_edge_class_name((recto_edge_class)(1 << k)));
}

static void invalid_enumerators_have_a_name_too(void **state) {
  (void)state;
  assert_string_equal(recto_method_name(RECTO_METHOD_COUNT), "unknown");
  assert_string_equal(recto_method_name((recto_method)-1), "unknown");
  assert_string_equal(recto_status_name(RECTO_STATUS_COUNT), "unknown");
  assert_string_equal(recto_edge_class_name((recto_edge_class)3), "unknown");
}

static void the_version_is_three_numbers(void **state) {
  (void)state;
  int a, b, c, end = 0;
  assert_int_equal(sscanf(recto_version(), "%d.%d.%d%n", &a, &b, &c, &end), 3);
  assert_int_equal(recto_version()[end], '\0');
}

/* ---- Options ------------------------------------------------------------- */

static void no_options_are_the_defaults(void **state) {
  (void)state;
  recto_scene *scene = make_cube();
  recto_options options;
  recto_options_init(&options);
  recto_drawing *a = draw(scene, &options), *b = draw(scene, NULL);
  assert_true(recto_drawing_stroke_count(a) > 0);
  assert_int_equal(recto_drawing_stroke_count(a),
                   recto_drawing_stroke_count(b));
  assert_true(drawn_length(a) == drawn_length(b));
  recto_drawing_destroy(a);
  recto_drawing_destroy(b);
  recto_scene_destroy(scene);
}

static void assert_refused(const recto_scene *scene,
                           const recto_options *options, const char *what) {
  recto_error error = {0};
  recto_drawing *drawing = (recto_drawing *)&error;
  recto_status status = recto_scene_render(scene, options, &drawing, &error);
  if (status != RECTO_ERROR_ARGUMENT)
    fail_msg("%s gives %s", what, recto_status_name(status));
  assert_int_equal(error.code, status);
  assert_true(error.text[0] != '\0');
  assert_null(drawing);
}

static void numbers_that_make_no_sense_are_refused(void **state) {
  (void)state;
  recto_scene *scene = make_cube();
  recto_options options;
#define REFUSED(field, bad)                                                    \
  do {                                                                         \
    recto_options_init(&options);                                              \
    options.field = bad;                                                       \
    assert_refused(scene, &options, #field " = " #bad);                        \
  } while (0)
  REFUSED(solver.method, RECTO_METHOD_COUNT);
  REFUSED(solver.method, (recto_method)-1);
  REFUSED(solver.threads, -1);
  REFUSED(solver.contact, (double)NAN);
  REFUSED(camera.azimuth_deg, (double)INFINITY);
  REFUSED(camera.elevation_deg, (double)NAN);
  REFUSED(camera.eye[1], (double)NAN);
  REFUSED(camera.target[2], (double)-INFINITY);
  REFUSED(camera.up[0], (double)NAN);
  REFUSED(camera.fov_deg, -1);
  REFUSED(camera.fov_deg, 180);
  REFUSED(camera.scale, 0);
  REFUSED(camera.near_distance, -1);
  REFUSED(camera.section, (double)NAN);
  REFUSED(page.width_mm, 0);
  REFUSED(page.height_mm, -297);
  REFUSED(page.height_mm, 0.0099);
  REFUSED(page.width_mm, 2001);
  REFUSED(page.margin_mm, (double)NAN);
  REFUSED(page.margin_mm, 105);
  REFUSED(ink.edges, 0x100);
  REFUSED(mesh.crease_deg, 181);
  REFUSED(mesh.crease_start_deg, 181);
  REFUSED(ink.hidden, (recto_hidden)3);
  REFUSED(ink.hidden_by_max, -1);
  REFUSED(ink.fill, (recto_fill)4);
  REFUSED(ink.hatch_pitch_mm, 0);
  REFUSED(ink.pen_mm, 0);
  REFUSED(ink.pen_mm, (double)NAN);
  REFUSED(ink.pens, 0);
  REFUSED(ink.order, (recto_order)3);
  REFUSED(ink.simplify_mm, -1);
  REFUSED(ink.curves_mm, -1);
  REFUSED(ink.min_stroke_mm, (double)NAN);
  REFUSED(ink.seam_mm, NAN);
  REFUSED(ink.seam_mm, 11);
  REFUSED(output.precision, 10);
  REFUSED(output.precision, -1);
  REFUSED(output.dpi, -1);
  REFUSED(output.velocity_cm_s, (double)NAN);
  REFUSED(output.velocity_up_cm_s, -1);
  recto_scene_destroy(scene);
}

static void errors_say_what_a_number_must_be(void **state) {
  (void)state;
  recto_options options[5];
  static const char *const text[5] = {
      "the contact length must be finite",
      "the scale must be above 0 and finite",
      "the pitch of scan lines must be finite, at least 0.01",
      "the resolution must be from 0 to 1048576",
      "the margins leave no room on the page"};
  recto_scene *scene = make_cube();
  for (int i = 0; i < 5; i++)
    recto_options_init(&options[i]);
  options[0].solver.contact = INFINITY;
  options[1].camera.scale = 0;
  options[2].solver.pitch_mm = 1e-3;
  options[3].solver.resolution = -1;
  options[4].page.margin_mm = 105;
  for (int i = 0; i < 5; i++) {
    recto_drawing *drawing;
    recto_error error;
    assert_int_equal(recto_scene_render(scene, &options[i], &drawing, &error),
                     RECTO_ERROR_ARGUMENT);
    assert_string_equal(error.text, text[i]);
  }
  recto_scene_destroy(scene);
}

static void lists_that_make_no_sense_are_refused(void **state) {
  static const recto_pen_use use[] = {
      {.lines = RECTO_LINES_HIDDEN, .edge_class = 0, .group = NULL, .pen = 0},
      {.lines = RECTO_LINES_HATCH,
       .edge_class = 0,
       .group = NULL,
       .pen = RECTO_PEN_MAX + 1},
      {.lines = RECTO_LINES_OF_CLASS, .edge_class = 0, .group = "a", .pen = 1},
      {.lines = RECTO_LINES_OF_CLASS,
       .edge_class = (recto_edge_class)0x100,
       .group = NULL,
       .pen = 1},
      {.lines = RECTO_LINES_OF_GROUP,
       .edge_class = RECTO_EDGE_CREASE,
       .group = NULL,
       .pen = 1},
      {.lines = RECTO_LINES_OF_GROUP,
       .edge_class = RECTO_EDGE_CREASE,
       .group = "no such group",
       .pen = 1},
      {.lines = (recto_lines)4,
       .edge_class = RECTO_EDGE_CREASE,
       .group = "a",
       .pen = 1},
  };
  static const recto_pen pen[] = {
      {.width_mm = -1, .has_colour = false, .colour = 0},
      {.width_mm = 101, .has_colour = false, .colour = 0},
      {.width_mm = (double)NAN, .has_colour = false, .colour = 0},
      {.width_mm = 0, .has_colour = true, .colour = 0x1000000}};
  static const recto_weight weight[] = {
      {.edge_class = RECTO_EDGE_CREASE, .weight = 0},
      {.edge_class = RECTO_EDGE_CREASE, .weight = (double)NAN},
      {.edge_class = (recto_edge_class)(RECTO_EDGE_CREASE | RECTO_EDGE_GROUP),
       .weight = 1},
  };
  (void)state;
  recto_scene *scene = make_cube();
  recto_options options;
  for (size_t i = 0; i < sizeof use / sizeof use[0]; i++) {
    REFUSED(ink.pen_use_count, 1);
    options.ink.pen_use = &use[i];
    assert_refused(scene, &options, "the use of a pen");
  }
  for (size_t i = 0; i < sizeof pen / sizeof pen[0]; i++) {
    REFUSED(ink.pen_count, 1);
    options.ink.pen = &pen[i];
    assert_refused(scene, &options, "a pen");
  }
  for (size_t i = 0; i < sizeof weight / sizeof weight[0]; i++) {
    REFUSED(ink.weight_count, 1);
    options.ink.weight = &weight[i];
    assert_refused(scene, &options, "a weight");
  }
  REFUSED(ink.pen_count, RECTO_PEN_MAX + 1);
  recto_scene_destroy(scene);
}

/* A later version may give them a meaning. */
static void reserved_fields_of_lists_are_unsupported(void **state) {
  static const recto_pen_use use = {
      .lines = RECTO_LINES_HIDDEN, .pen = 1, .reserved = {1}};
  static const recto_pen pen = {.reserved = {0, 1}};
  static const recto_weight weight = {
      .edge_class = RECTO_EDGE_CREASE, .weight = 1, .reserved = {1}};
  (void)state;
  recto_scene *scene = make_cube();
  for (int list = 0; list < 3; list++) {
    recto_options options;
    recto_drawing *drawing;
    recto_options_init(&options);
    options.ink.pen_use = &use;
    options.ink.pen_use_count = list == 0;
    options.ink.pen = &pen;
    options.ink.pen_count = list == 1;
    options.ink.weight = &weight;
    options.ink.weight_count = list == 2;
    assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                     RECTO_ERROR_UNSUPPORTED);
  }
  recto_scene_destroy(scene);
}

static void an_eye_on_its_target_is_refused(void **state) {
  (void)state;
  recto_scene *scene = make_cube();
  recto_options options;
  recto_options_init(&options);
  options.camera.kind = RECTO_CAMERA_EYE;
  options.camera.has_target = true;
  assert_refused(scene, &options, "eye = target");
  recto_scene_destroy(scene);
}

static void methods_not_built_are_unsupported(void **state) {
  (void)state;
  recto_scene *scene = make_cube();
  recto_options options;
  recto_options_init(&options);
  for (int i = 0; i < RECTO_METHOD_COUNT; i++) {
    options.solver.method = (recto_method)i;
    recto_drawing *drawing;
    recto_status status = recto_scene_render(scene, &options, &drawing, NULL);
    assert_int_equal(status, recto_method_is_available(options.solver.method)
                                 ? RECTO_OK
                                 : RECTO_ERROR_UNSUPPORTED);
    recto_drawing_destroy(drawing);
  }
  recto_scene_destroy(scene);
}

/* ---- Scenes -------------------------------------------------------------- */

static void destroying_nothing_is_fine(void **state) {
  (void)state;
  recto_scene_destroy(NULL);
  recto_drawing_destroy(NULL);
}

static void wrong_elements_are_refused_and_leave_no_trace(void **state) {
  (void)state;
  recto_scene *scene = make_cube();
  recto_error error = {0};
  const uint32_t bad[4] = {0, 1, 8, 2};
  const double nowhere[3] = {0, (double)NAN, 0};
  uint32_t index = 77;
  assert_int_equal(recto_scene_add_face(scene, box_faces[0], 2, &error),
                   RECTO_ERROR_ARGUMENT);
  assert_int_equal(recto_scene_add_face(scene, bad, 4, &error),
                   RECTO_ERROR_ARGUMENT);
  assert_non_null(strstr(error.text, "8"));
  assert_int_equal(recto_scene_add_polyline(scene, bad, 1, &error),
                   RECTO_ERROR_ARGUMENT);
  assert_int_equal(recto_scene_add_polyline(scene, bad, 3, &error),
                   RECTO_ERROR_ARGUMENT);
  assert_int_equal(recto_scene_add_point(scene, nowhere, &index, &error),
                   RECTO_ERROR_ARGUMENT);
  assert_int_equal(index, 77);
  recto_drawing *drawing = draw(scene, NULL);
  const char *stats = recto_drawing_stats(drawing);
  assert_non_null(strstr(stats, "\"points\": 8,"));
  assert_non_null(strstr(stats, "\"faces\": 6,"));
  assert_non_null(strstr(stats, "\"polylines\": 0,"));
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

static void faces_without_area_are_skipped_and_counted(void **state) {
  (void)state;
  recto_scene *scene = make_cube();
  const uint32_t flat[3] = {0, 1, 0}, few[4] = {2, 2, 3, 3};
  assert_int_equal(recto_scene_add_face(scene, flat, 3, NULL), RECTO_OK);
  assert_int_equal(recto_scene_add_face(scene, few, 4, NULL), RECTO_OK);
  recto_drawing *drawing = draw(scene, NULL);
  const char *stats = recto_drawing_stats(drawing);
  assert_non_null(strstr(stats, "\"faces\": 6,"));
  assert_non_null(strstr(stats, "\"few_corners\": 2,"));
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

static void points_are_numbered_as_they_come(void **state) {
  (void)state;
  recto_scene *scene = make_cube();
  uint32_t index;
  const double point[3] = {5, 5, 5};
  assert_int_equal(recto_scene_add_point(scene, point, &index, NULL), RECTO_OK);
  assert_int_equal(index, 8);
  recto_scene_destroy(scene);
}

static void an_empty_drawing_is_reported(void **state) {
  (void)state;
  recto_scene *scene;
  recto_drawing *drawing;
  recto_error error = {0};
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  assert_int_equal(recto_scene_render(scene, NULL, &drawing, &error),
                   RECTO_ERROR_EMPTY);
  assert_null(drawing);
  assert_int_equal(error.code, RECTO_ERROR_EMPTY);
  recto_scene_destroy(scene);
}

static void a_scene_may_be_drawn_again(void **state) {
  (void)state;
  recto_scene *scene = make_cube();
  recto_options options;
  recto_options_init(&options);
  recto_drawing *first = draw(scene, &options);
  options.camera.azimuth_deg = options.camera.elevation_deg = 0;
  recto_drawing *front = draw(scene, &options);
  recto_options_init(&options);
  recto_drawing *again = draw(scene, &options);
  assert_true(drawn_length(first) == drawn_length(again));
  assert_true(drawn_length(first) != drawn_length(front));
  recto_drawing_destroy(first);
  recto_drawing_destroy(front);
  recto_drawing_destroy(again);
  recto_scene_destroy(scene);
}

/* ---- Drawings ------------------------------------------------------------ */

/* Isometric, 100 units to the mm: nine edges of 100 sqrt(2/3) mm. */
static void a_cube_at_true_scale_shows_nine_edges(void **state) {
  (void)state;
  recto_scene *scene = make_cube();
  recto_options options;
  recto_options_init(&options);
  options.camera.fit = RECTO_FIT_SCALE;
  options.camera.scale = 100;
  recto_drawing *drawing = draw(scene, &options);
  double length = drawn_length(drawing), expected = 9 * 100 * sqrt(2.0 / 3);
  /* A few grid units of 1e-6 mm for each of the edges' ends. */
  assert_true(fabs(length - expected) < 1e-4);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

static recto_scene *make_scaled_cube(double scale, double middle) {
  recto_scene *scene = box_scene(NULL);
  for (int i = 0; i < 8; i++) {
    double point[3];
    for (int k = 0; k < 3; k++)
      point[k] = scale * (2 * (box_cube[i][k] - middle));
    assert_int_equal(recto_scene_add_point(scene, point, NULL, NULL), RECTO_OK);
  }
  for (int i = 0; i < 6; i++)
    assert_int_equal(recto_scene_add_face(scene, box_faces[i], 4, NULL),
                     RECTO_OK);
  return scene;
}

static void assert_same_drawing(const recto_drawing *a,
                                const recto_drawing *b) {
  assert_int_equal(recto_drawing_stroke_count(a),
                   recto_drawing_stroke_count(b));
  for (size_t i = 0; i < recto_drawing_stroke_count(a); i++) {
    recto_stroke p, q;
    assert_true(recto_drawing_stroke(a, i, &p));
    assert_true(recto_drawing_stroke(b, i, &q));
    assert_int_equal(p.count, q.count);
    assert_memory_equal(p.points, q.points, p.count * 2 * sizeof *p.points);
  }
}

/* From the least double to the largest.  The eye, the contact and the near
 * distance scale with the model. */
static void every_size_of_doubles_draws_the_same(void **state) {
  (void)state;
  recto_options options;
  recto_options_init(&options);
  recto_scene *scene = make_scaled_cube(1, 0.5);
  recto_drawing *iso = draw(scene, NULL);
  options.camera.kind = RECTO_CAMERA_EYE;
  options.camera.fov_deg = 30;
  const double eye[3] = {3, 4, 5};
  memcpy(options.camera.eye, eye, sizeof eye);
  options.solver.contact = 0x1p-10;
  recto_drawing *perspective = draw(scene, &options);
  recto_scene_destroy(scene);
  for (int e = -1074; e <= 1021; e += e < 1008 ? 13 : 1) {
    double scale = ldexp(1, e);
    scene = make_scaled_cube(scale, 0.5);
    recto_drawing *same = draw(scene, NULL);
    assert_same_drawing(iso, same);
    recto_drawing_destroy(same);
    for (int k = 0; k < 3; k++)
      options.camera.eye[k] = eye[k] * scale;
    options.solver.contact = ldexp(0x1p-10, e);
    same = draw(scene, &options);
    assert_same_drawing(perspective, same);
    recto_drawing_destroy(same);
    recto_scene_destroy(scene);
  }
  recto_drawing_destroy(iso);
  recto_drawing_destroy(perspective);
}

/* Numbers around the scene that its scale takes out of their range. */
static void an_eye_beyond_numbers_is_refused(void **state) {
  (void)state;
  recto_scene *scene = make_scaled_cube(0x1p-1070, 0.5);
  recto_options options;
  recto_drawing *drawing;
  recto_options_init(&options);
  options.camera.kind = RECTO_CAMERA_EYE;
  options.camera.eye[2] = 1;
  recto_drawing *near = draw(scene, &options);
  recto_drawing_destroy(near);
  options.camera.eye[2] = 1e300;
  recto_error error;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, &error),
                   RECTO_ERROR_LIMIT);
  assert_null(drawing);
  recto_scene_destroy(scene);
}

/* A drawing of a scene of any size is right, and one from elsewhere wrong. */
static void a_foreign_drawing_is_judged(void **state) {
  (void)state;
  recto_options options;
  recto_options_init(&options);
  options.page.width_mm = 100;
  const char *path = path_of("own.svg");
  recto_scene *scene = make_scaled_cube(1, 0.5);
  recto_drawing *drawing = draw(scene, &options);
  assert_int_equal(recto_drawing_write(drawing, path, NULL, NULL, NULL),
                   RECTO_OK);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  recto_options_init(&options); /* of another page: the file's counts */
  for (int e = -1040; e <= 1000; e += 510) {
    recto_verdict verdict;
    scene = make_scaled_cube(ldexp(1, e), 0.5);
    options.camera.azimuth_deg = 45;
    assert_int_equal(recto_scene_check(scene, path, &options, &verdict, NULL),
                     RECTO_OK);
    assert_true(verdict.drawn_mm > 300 && verdict.visible_mm > 300);
    assert_true(verdict.false_mm == 0 && verdict.missing_mm == 0);
    options.camera.azimuth_deg = 44;
    assert_int_equal(recto_scene_check(scene, path, &options, &verdict, NULL),
                     RECTO_OK);
    assert_true(verdict.false_mm > 100 && verdict.missing_mm > 100);
    assert_true(verdict.false_at_mm[0] > 0 && verdict.missing_at_mm[1] > 0);
    recto_scene_destroy(scene);
  }
  scene = make_cube();
  recto_verdict verdict;
  struct memory_faults faults = {.least = 10};
  while (memory_faults_go_on(&faults)) {
    memory_faults_begin(&faults);
    memory_faults_end(&faults,
                      recto_scene_check(scene, path, NULL, &verdict, NULL));
  }
  recto_scene_destroy(scene);
  remove(path);
}

static void strokes_know_where_they_come_from(void **state) {
  (void)state;
  recto_scene *scene = make_cube();
  recto_options options;
  recto_options_init(&options);
  options.ink.edges = RECTO_EDGE_CREASE;
  recto_drawing *drawing = draw(scene, &options);
  assert_true(recto_drawing_stroke_count(drawing) > 0);
  for (size_t i = 0; i < recto_drawing_stroke_count(drawing); i++) {
    recto_stroke stroke;
    assert_true(recto_drawing_stroke(drawing, i, &stroke));
    assert_int_equal(stroke.edge_class, RECTO_EDGE_CREASE);
    assert_int_equal(stroke.group, 0);
    assert_true(stroke.face < 6);
    assert_true(stroke.edge < 12);
    assert_true(stroke.count >= 2);
    assert_int_equal(stroke.layer, 0);
  }
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

static char *read_all(const char *path) {
  FILE *file = fopen(path, "rb");
  assert_non_null(file);
  char *text = calloc(1, 1 << 16);
  assert_non_null(text);
  assert_true(fread(text, 1, (1 << 16) - 1, file) > 0);
  assert_int_equal(fclose(file), 0);
  return text;
}

static void a_drawing_is_written_by_name_and_by_extension(void **state) {
  (void)state;
  recto_scene *scene = make_cube();
  recto_drawing *drawing = draw(scene, NULL);
  assert_int_equal(
      recto_drawing_write(drawing, path_of("svg"), NULL, NULL, NULL), RECTO_OK);
  char *by_extension = read_all(path_of("svg"));
  assert_int_equal(
      recto_drawing_write(drawing, path_of("x"), "svg", NULL, NULL), RECTO_OK);
  char *by_name = read_all(path_of("x"));
  assert_string_equal(by_extension, by_name);
  assert_non_null(strstr(by_name, "<path"));
  assert_int_equal(unlink(path_of("svg")), 0);
  assert_int_equal(unlink(path_of("x")), 0);
  free(by_extension);
  free(by_name);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

static void formats_that_are_not_there_are_refused(void **state) {
  (void)state;
  recto_scene *scene = make_cube();
  recto_drawing *drawing = draw(scene, NULL);
  recto_error error = {0};
  assert_int_equal(
      recto_drawing_write(drawing, path_of("svg"), "xyz", NULL, &error),
      RECTO_ERROR_UNSUPPORTED);
  assert_int_equal(
      recto_drawing_write(drawing, path_of("xyz"), NULL, NULL, &error),
      RECTO_ERROR_UNSUPPORTED);
  assert_string_equal(error.file, path_of("xyz"));
  assert_int_not_equal(access(path_of("svg"), F_OK), 0);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

static void formats_are_recognised(void **state) {
  (void)state;
  assert_string_equal(recto_output_format_name(0), "svg");
  assert_string_equal(recto_output_format("a.SVG", NULL), "svg");
  assert_string_equal(recto_output_format("a.svg", "hpgl"), "hpgl");
  assert_string_equal(recto_output_format("-", NULL), "svg");
  assert_string_equal(recto_output_format("/dev/fd/3", NULL), "svg");
  assert_string_equal(recto_output_format("/dev/stdout", "hpgl"), "hpgl");
  assert_null(recto_output_format("a.xyz", NULL));
  size_t count = 0;
  while (recto_output_format_name(count) != NULL)
    count++;
  assert_true(count >= 2 && count < 20);
}

static void views_and_pages_have_names(void **state) {
  (void)state;
  double a, b;
  size_t views = 0, pages = 0;
  assert_string_equal(recto_view_name(0, &a, &b), "iso");
  assert_true(a == 45);
  assert_true(fabs(tan(b * acos(-1) / 180) - 1 / sqrt(2)) < 1e-15);
  for (; recto_view_name(views, NULL, &b) != NULL; views++)
    assert_true(-90 <= b && b <= 90);
  for (const char *name; (name = recto_page_name(pages, &a, &b)) != NULL;
       pages++) {
    assert_true(a < b);
    if (name[0] == 'A') /* ISO 216 rounds to millimetres */
      assert_true(fabs(a * b - 1e6 / (1 << (name[1] - '0'))) < 2100);
  }
  assert_int_equal(views, 9);
  assert_int_equal(pages, 9);
}

/* ---- The whole job ------------------------------------------------------- */

static void write_model(const char *path) {
  FILE *file = fopen(path, "wb");
  assert_non_null(file);
  for (int i = 0; i < 8; i++)
    fprintf(file, "v %d %d %d\n", (int)box_cube[i][0], (int)box_cube[i][1],
            (int)box_cube[i][2]);
  for (int i = 0; i < 6; i++)
    fprintf(file, "f %u %u %u %u\n", box_faces[i][0] + 1, box_faces[i][1] + 1,
            box_faces[i][2] + 1, box_faces[i][3] + 1);
  fprintf(file, "f 1 2 9\n");
  assert_int_equal(fclose(file), 0);
}

static void outputs_are_tried_together(void **state) {
  (void)state;
  recto_error error = {0};
  recto_scene *scene = NULL;
  char model[300];
  snprintf(model, sizeof model, "%s", path_of("obj"));
  write_model(model);
  assert_int_equal(recto_scene_create(&scene, &error), RECTO_OK);
  assert_int_equal(recto_scene_read(scene, model, NULL, NULL, &error),
                   RECTO_OK);
  const struct {
    const char *path, *stats, *text;
  } refused[] = {
      {model, NULL, "the drawing would replace the model"},
      {"-", model, "the stats would replace the model"},
      {"new.svg", "./new.svg", "the stats would replace the drawing"},
  };
  for (int i = 0; i < 3; i++) {
    assert_int_equal(recto_scene_try_output(scene, refused[i].path,
                                            refused[i].stats, &error),
                     RECTO_ERROR_ARGUMENT);
    assert_string_equal(error.text, refused[i].text);
  }
  assert_int_equal(
      recto_scene_try_output(scene, "no folder/a.svg", NULL, &error),
      RECTO_ERROR_IO);
  assert_int_equal(recto_scene_try_output(scene, "", NULL, &error),
                   RECTO_ERROR_IO);
  assert_int_equal(recto_scene_try_output(scene, "new.svg", "new.json", &error),
                   RECTO_OK);
  assert_int_not_equal(access("new.svg", F_OK), 0);
  assert_int_equal(remove(model), 0);
  recto_scene_destroy(scene);
}

struct warnings {
  int count;
  unsigned long line;
};

static void count_warning(void *user, const char *file, unsigned long line,
                          const char *text) {
  struct warnings *warnings = user;
  (void)text;
  assert_true(strlen(file) > 0);
  warnings->count++;
  warnings->line = line;
}

static void one_call_does_it_and_warns_by_line(void **state) {
  (void)state;
  char model[64];
  snprintf(model, sizeof model, "%s", path_of("obj"));
  write_model(model);
  struct warnings warnings = {0, 0};
  recto_options options;
  recto_options_init(&options);
  options.warning = count_warning;
  options.user = &warnings;
  assert_int_equal(
      recto_draw_file(model, NULL, path_of("svg"), NULL, &options, NULL),
      RECTO_OK);
  assert_int_equal(warnings.count, 1);
  assert_int_equal(warnings.line, 15);
  assert_int_equal(unlink(path_of("svg")), 0);
  assert_int_equal(unlink(model), 0);
}

static void keep_warning(void *user, const char *file, unsigned long line,
                         const char *text) {
  (void)file;
  (void)line;
  snprintf(user, 128, "%s", text);
}

static void assert_warns(const recto_scene *scene, recto_options options,
                         const char *wanted) {
  char text[128] = "";
  options.warning = keep_warning;
  options.user = text;
  recto_drawing_destroy(draw(scene, &options));
  assert_string_equal(text, wanted);
}

static void an_empty_page_says_why(void **state) {
  (void)state;
  recto_scene *scene = make_cube();
  recto_options options;
  recto_options_init(&options);
  assert_warns(scene, options, "");
  options.ink.edges = RECTO_EDGES_NONE;
  assert_warns(scene, options,
               "the drawing is empty: neither lines nor fills are requested");
  options.ink.edges = RECTO_EDGE_INTERSECTION;
  assert_warns(scene, options,
               "the drawing is empty: nothing that was requested is visible "
               "and long enough");
  options.ink.edges = RECTO_EDGES_DEFAULT;
  options.camera.fit = RECTO_FIT_SCALE;
  for (options.camera.scale = 0.01; options.camera.scale > 1e-300;
       options.camera.scale *= 1e-99)
    assert_warns(scene, options,
                 "the drawing is empty: nothing that was requested is visible "
                 "and long enough");
  options.camera.scale = 100;
  options.camera.has_target = true;
  options.camera.target[0] = 50;
  assert_warns(
      scene, options,
      "the drawing is empty: all of the scene is outside of the page's "
      "margins");
  options.ink.fill = RECTO_FILL_PAINT;
  assert_warns(
      scene, options,
      "the drawing is empty: all of the scene is outside of the page's "
      "margins");
  recto_scene_destroy(scene);
}

static void a_failed_run_leaves_nothing(void **state) {
  (void)state;
  recto_error error = {0};
  assert_int_equal(recto_draw_file(path_of("none.obj"), NULL, path_of("svg"),
                                   NULL, NULL, &error),
                   RECTO_ERROR_IO);
  assert_string_not_equal(error.file, "");
  assert_int_not_equal(access(path_of("svg"), F_OK), 0);
  assert_int_equal(
      recto_draw_file("none.obj", NULL, path_of("xyz"), NULL, NULL, &error),
      RECTO_ERROR_UNSUPPORTED);
}

/* ---- Progress ------------------------------------------------------------ */

struct talk {
  int calls, stop_at;
  double last;
};

static bool listen(void *user, double share, const char *stage) {
  struct talk *talk = user;
  assert_true(share >= 0 && share <= 1);
  assert_true(share >= talk->last);
  assert_true(strlen(stage) > 0);
  talk->last = share;
  return ++talk->calls != talk->stop_at;
}

static void progress_rises_and_may_cancel_at_every_step(void **state) {
  (void)state;
  recto_scene *scene = make_cube();
  recto_options options;
  recto_options_init(&options);
  options.progress = listen;
  struct talk talk = {0, 0, 0};
  options.user = &talk;
  recto_drawing_destroy(draw(scene, &options));
  int calls = talk.calls;
  assert_true(calls >= 4);
  for (int i = 1; i <= calls; i++) {
    recto_error error = {0};
    recto_drawing *drawing = (recto_drawing *)&error;
    talk = (struct talk){0, i, 0};
    assert_int_equal(recto_scene_render(scene, &options, &drawing, &error),
                     RECTO_ERROR_CANCELLED);
    assert_int_equal(error.code, RECTO_ERROR_CANCELLED);
    assert_null(drawing);
    assert_int_equal(talk.calls, i);
  }
  recto_scene_destroy(scene);
}

/* ---- Faults -------------------------------------------------------------- */

/* The whole job; what was made is freed in any case. */
static recto_status whole_job(const char *path) {
  recto_scene *scene = NULL;
  recto_drawing *drawing = NULL;
  recto_options options;
  recto_options_init(&options);
  options.solver.threads = 1;
  options.solver.method = RECTO_METHOD_BRUTE;
  options.ink.ids = true;
  recto_status status = recto_scene_create(&scene, NULL);
  if (status == RECTO_OK)
    status = add_cube(scene, NULL);
  if (status == RECTO_OK)
    status = recto_scene_render(scene, &options, &drawing, NULL);
  if (status == RECTO_OK)
    status = recto_drawing_write(drawing, path, NULL, &options, NULL);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return status;
}

/* Losing a report's entry is no failure, so that some of the runs succeed:
 * the drawing is then whole. */
static void every_allocation_may_fail(void **state) {
  (void)state;
  assert_int_equal(whole_job(path_of("svg")), RECTO_OK);
  char *whole = read_all(path_of("svg"));
  struct memory_faults faults = {.least = 10, .in_a_row = 100};
  while (memory_faults_go_on(&faults)) {
    unlink(path_of("svg"));
    memory_faults_begin(&faults);
    recto_status status = whole_job(path_of("svg"));
    memory_faults_end(&faults, status);
    if (status == RECTO_OK) {
      char *text = read_all(path_of("svg"));
      assert_string_equal(text, whole);
      free(text);
    } else {
      assert_int_not_equal(access(path_of("svg"), F_OK), 0);
    }
  }
  free(whole);
  unlink(path_of("svg"));
}

/* SVG that has hatching, or several pens, is for a plotter. */
static void svg_for_a_plotter_has_short_travel_too(void **state) {
  (void)state;
  static const recto_pen_use use = {
      .lines = RECTO_LINES_OF_CLASS, .edge_class = RECTO_EDGE_CREASE, .pen = 2};
  for (int what = 0; what < 8; what++) {
    recto_options o;
    recto_options_init(&o);
    o.output.format = what == 7 ? "pdf" : "svg";
    o.ink.fill = what == 0 || what == 7 ? RECTO_FILL_HATCH : RECTO_FILL_NONE;
    o.mesh.cut_count = what == 1 || what == 6;
    o.mesh.cut_fill = what == 6 ? RECTO_CUT_FILL_NONE : RECTO_CUT_FILL_HATCH;
    o.camera.has_section = what == 2;
    o.ink.pens = what == 3 ? 2 : 1;
    o.ink.pen_use = &use;
    o.ink.pen_use_count = what == 4;
    o.ink.hidden = what == 5 ? RECTO_HIDDEN_LAYER : RECTO_HIDDEN_DASHED;
    assert_int_equal(options_adapt(&o, NULL), RECTO_OK);
    assert_int_equal(o.ink.order,
                     what < 6 ? RECTO_ORDER_NEAR : RECTO_ORDER_AUTO);
  }
}

static void plotter_travel_is_short_by_default(void **state) {
  (void)state;
  static const struct {
    const char *format;
    recto_order asked, found;
  } row[] = {{"hpgl", RECTO_ORDER_AUTO, RECTO_ORDER_NEAR},
             {"hpgl", RECTO_ORDER_NONE, RECTO_ORDER_NONE},
             {"svg", RECTO_ORDER_AUTO, RECTO_ORDER_AUTO},
             {"svg", RECTO_ORDER_NEAR, RECTO_ORDER_NEAR}};
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    recto_options o;
    recto_options_init(&o);
    assert_int_equal(o.ink.order, RECTO_ORDER_AUTO);
    o.ink.order = row[i].asked;
    o.output.format = row[i].format;
    assert_int_equal(options_adapt(&o, NULL), RECTO_OK);
    assert_int_equal(o.ink.order, row[i].found);
  }
}

/* A margin that is left open suits the plotter; one that is named is kept. */
static void a_plotter_gets_the_margin_that_it_needs(void **state) {
  (void)state;
  static const struct {
    const char *format, *device;
    double named, found;
  } row[] = {{"hpgl", "hp7475a", -1, 16}, {"hpgl", "hp7475a", 2, 2},
             {"hpgl", "dxy", -1, -1},     {"hpgl", NULL, -1, -1},
             {"svg", "hp7475a", -1, -1},  {"svg", "hp7475a", 3, 3}};
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    recto_options o;
    recto_options_init(&o);
    o.output.device = row[i].device;
    o.page.margin_mm = row[i].named;
    o.output.format = row[i].format;
    assert_int_equal(options_adapt(&o, NULL), RECTO_OK);
    assert_true(o.page.margin_mm == row[i].found);
  }
}

static void every_write_may_fail(void **state) {
  (void)state;
  stream_fail_after(1);
  assert_int_equal(whole_job(path_of("svg")), RECTO_ERROR_IO);
  stream_fail_after(0);
  assert_int_not_equal(access(path_of("svg"), F_OK), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_enumerator_has_its_own_name),
      cmocka_unit_test(invalid_enumerators_have_a_name_too),
      cmocka_unit_test(the_version_is_three_numbers),
      cmocka_unit_test(no_options_are_the_defaults),
      cmocka_unit_test(numbers_that_make_no_sense_are_refused),
      cmocka_unit_test(errors_say_what_a_number_must_be),
      cmocka_unit_test(lists_that_make_no_sense_are_refused),
      cmocka_unit_test(reserved_fields_of_lists_are_unsupported),
      cmocka_unit_test(an_eye_on_its_target_is_refused),
      cmocka_unit_test(methods_not_built_are_unsupported),
      cmocka_unit_test(destroying_nothing_is_fine),
      cmocka_unit_test(wrong_elements_are_refused_and_leave_no_trace),
      cmocka_unit_test(faces_without_area_are_skipped_and_counted),
      cmocka_unit_test(points_are_numbered_as_they_come),
      cmocka_unit_test(an_empty_drawing_is_reported),
      cmocka_unit_test(a_scene_may_be_drawn_again),
      cmocka_unit_test(a_cube_at_true_scale_shows_nine_edges),
      cmocka_unit_test(every_size_of_doubles_draws_the_same),
      cmocka_unit_test(an_eye_beyond_numbers_is_refused),
      cmocka_unit_test(a_foreign_drawing_is_judged),
      cmocka_unit_test(strokes_know_where_they_come_from),
      cmocka_unit_test(a_drawing_is_written_by_name_and_by_extension),
      cmocka_unit_test(formats_that_are_not_there_are_refused),
      cmocka_unit_test(formats_are_recognised),
      cmocka_unit_test(views_and_pages_have_names),
      cmocka_unit_test(outputs_are_tried_together),
      cmocka_unit_test(one_call_does_it_and_warns_by_line),
      cmocka_unit_test(an_empty_page_says_why),
      cmocka_unit_test(a_failed_run_leaves_nothing),
      cmocka_unit_test(progress_rises_and_may_cancel_at_every_step),
      cmocka_unit_test(every_allocation_may_fail),
      cmocka_unit_test(plotter_travel_is_short_by_default),
      cmocka_unit_test(svg_for_a_plotter_has_short_travel_too),
      cmocka_unit_test(a_plotter_gets_the_margin_that_it_needs),
      cmocka_unit_test(every_write_may_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
