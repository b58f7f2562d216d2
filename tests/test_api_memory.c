/* test_api_memory.c - models and meshes from memory, and drawings to it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/box_mesh.h"

/* ---- A cube with a group for its lid ------------------------------------- */

static const double *const points = box_cube[0];

static const char cube_obj[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                               "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                               "g box\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\n"
                               "f 2 3 7 6\ng lid\nf 3 4 8 7\ng box\n"
                               "f 4 1 5 8\n";

static recto_mesh cube_mesh(void) { return box_mesh(points, 8); }

/* ---- A drawing as text --------------------------------------------------- */

struct text {
  char bytes[1 << 16];
  size_t count, calls;
};

static bool append(void *user, const void *bytes, size_t count) {
  struct text *text = user;
  text->calls++;
  if (count >= sizeof text->bytes - text->count)
    return false;
  memcpy(text->bytes + text->count, bytes, count);
  text->count += count;
  text->bytes[text->count] = '\0';
  return true;
}

/* Draws the scene with source ids as SVG, and destroys it. */
static struct text *draw(recto_scene *scene) {
  recto_options options;
  recto_drawing *drawing;
  recto_error error = {0};
  recto_options_init(&options);
  options.ink.ids = true;
  options.output.title = ""; /* by default that of the file, if there is one */
  if (recto_scene_render(scene, &options, &drawing, &error) != RECTO_OK)
    fail_msg("%s", error.text);
  struct text *text = calloc(1, sizeof *text);
  assert_non_null(text);
  assert_int_equal(
      recto_drawing_write_to(drawing, "svg", &options, append, text, NULL),
      RECTO_OK);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return text;
}

static struct text *draw_obj(const char *obj) {
  recto_scene *scene = box_scene(NULL);
  assert_int_equal(
      recto_scene_read_memory(scene, obj, strlen(obj), "obj", NULL, NULL, NULL),
      RECTO_OK);
  return draw(scene);
}

static struct text *draw_mesh(const recto_mesh *mesh) {
  recto_scene *scene = box_scene(NULL);
  recto_error error = {0};
  if (recto_scene_add_mesh(scene, mesh, &error) != RECTO_OK)
    fail_msg("%s", error.text);
  return draw(scene);
}

static void assert_same(struct text *a, struct text *b) {
  assert_true(strstr(a->bytes, "<path") != NULL);
  assert_string_equal(a->bytes, b->bytes);
  free(a);
  free(b);
}

/* ---- Models -------------------------------------------------------------- */

static void write_file(const char *path, const char *text) {
  FILE *file = fopen(path, "wb");
  assert_non_null(file);
  assert_int_equal(fputs(text, file) >= 0, 1);
  assert_int_equal(fclose(file), 0);
}

static void a_model_from_memory_draws_as_from_its_file(void **state) {
  (void)state;
  const char *path = "test_api_memory.obj";
  write_file(path, cube_obj);
  recto_scene *scene = box_scene(NULL);
  assert_int_equal(recto_scene_read(scene, path, NULL, NULL, NULL), RECTO_OK);
  remove(path);
  assert_same(draw(scene), draw_obj(cube_obj));
}

static void no_byte_behind_the_given_ones_is_read(void **state) {
  (void)state;
  size_t count = strlen(cube_obj);
  char *exact = malloc(count); /* valgrind and the sanitizers guard its end */
  assert_non_null(exact);
  memcpy(exact, cube_obj, count);
  recto_scene *scene = box_scene(NULL);
  assert_int_equal(
      recto_scene_read_memory(scene, exact, count, "obj", NULL, NULL, NULL),
      RECTO_OK);
  free(exact);
  assert_same(draw(scene), draw_obj(cube_obj));
}

static void errors_of_a_model_in_memory_have_its_name_and_line(void **state) {
  (void)state;
  static const char stl[] = "solid x\nfacet normal 0 0 1\nouter loop\nvortex";
  recto_scene *scene = box_scene(NULL);
  recto_error error = {0};
  assert_int_equal(recto_scene_read_memory(scene, stl, strlen(stl), NULL,
                                           "part.stl", NULL, &error),
                   RECTO_ERROR_FORMAT);
  assert_string_equal(error.file, "part.stl");
  assert_int_equal(error.line, 4);
  assert_int_equal(
      recto_scene_read_memory(scene, "", 0, "obj", NULL, NULL, &error),
      RECTO_ERROR_FORMAT);
  assert_int_equal(
      recto_scene_read_memory(scene, stl, 3, NULL, NULL, NULL, &error),
      RECTO_ERROR_ARGUMENT);
  assert_int_equal(
      recto_scene_read_memory(scene, NULL, 3, "obj", NULL, NULL, &error),
      RECTO_ERROR_ARGUMENT);
  recto_scene_destroy(scene);
}

static void count_libraries(void *user, const char *file, unsigned long line,
                            const char *text) {
  (void)file, (void)line;
  *(int *)user += strstr(text, "material library") != NULL;
}

static void a_model_in_memory_opens_files_only_beside_its_name(void **state) {
  (void)state;
  static const char obj[] = "mtllib test_api_memory.mtl\nv 0 0 0\nv 1 0 0\n"
                            "v 0 1 0\nusemtl red\nf 1 2 3\n";
  int warnings = 0;
  recto_options options;
  recto_options_init(&options);
  options.ink.fill = RECTO_FILL_PAINT;
  options.warning = count_libraries;
  options.user = &warnings;
  recto_scene *scene = box_scene(NULL);
  assert_int_equal(recto_scene_read_memory(scene, obj, strlen(obj), "obj", NULL,
                                           &options, NULL),
                   RECTO_OK);
  assert_int_equal(warnings, 0);
  assert_int_equal(recto_scene_read_memory(scene, obj, strlen(obj), "obj",
                                           "there.obj", &options, NULL),
                   RECTO_OK);
  assert_int_equal(warnings, 1); /* the library was looked for */
  recto_scene_destroy(scene);
}

/* Counts the polls and cancels at number `last`. */
struct polls {
  int count, last;
};

static bool poll(void *user, double share, const char *stage) {
  struct polls *polls = user;
  (void)share;
  assert_string_equal(stage, "read");
  return ++polls->count != polls->last;
}

/* A model of 60,000 points and 20,000 triangles in each format. */
static char *make_large(const char *format, size_t *count) {
  enum { FACES = 20000, ROOM = 140 };
  char *text = malloc((size_t)FACES * ROOM * 2), *at = text;
  assert_non_null(text);
  bool is_ply = strcmp(format, "ply") == 0, is_stl = strcmp(format, "stl") == 0;
  if (is_ply)
    at += sprintf(at,
                  "ply\nformat ascii 1.0\nelement vertex %d\n"
                  "property float x\nproperty float y\nproperty float z\n"
                  "element face %d\n"
                  "property list uchar int vertex_indices\nend_header\n",
                  3 * FACES, FACES);
  if (is_stl)
    at += sprintf(at, "solid large\n");
  for (int i = 0; i < FACES; i++) {
    int x = i % 100, y = i / 100;
    const char *v = is_ply ? "" : is_stl ? "vertex " : "v ";
    if (is_stl)
      at += sprintf(at, "facet normal 0 0 1\nouter loop\n");
    at += sprintf(at, "%s%d %d 0\n%s%d.5 %d 0\n%s%d %d.5 0\n", v, x, y, v, x, y,
                  v, x, y);
    if (is_stl)
      at += sprintf(at, "endloop\nendfacet\n");
  }
  for (int i = 0; i < FACES && !is_stl; i++)
    at += is_ply ? sprintf(at, "3 %d %d %d\n", 3 * i, 3 * i + 1, 3 * i + 2)
                 : sprintf(at, "f %d %d %d\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
  if (is_stl)
    at += sprintf(at, "endsolid large\n");
  *count = (size_t)(at - text);
  return text;
}

/* Reads a text, to cancel at poll number `last`, into a scene of a cube, which
 * is left as it was; returns how often it was polled.  Where other threads do
 * all that is left, that poll may not come. */
static int cancel_reading(const char *text, size_t count, const char *format,
                          int threads, int last) {
  recto_options options;
  recto_mesh mesh = cube_mesh();
  recto_scene *scene = box_scene(&mesh);
  struct polls polls = {0, last};
  recto_options_init(&options);
  options.solver.threads = threads;
  options.progress = poll;
  options.user = &polls;
  recto_status status =
      recto_scene_read_memory(scene, text, count, format, NULL, &options, NULL);
  bool cancelled = polls.count == last;
  assert_int_equal(status, cancelled ? RECTO_ERROR_CANCELLED : RECTO_OK);
  assert_true(cancelled || threads > 1 || last == 0);
  if (cancelled)
    assert_same(draw(scene), draw_obj(cube_obj));
  else
    recto_scene_destroy(scene);
  return polls.count;
}

static void reading_may_be_cancelled_and_leaves_the_scene(void **state) {
  (void)state;
  static const char *const format[] = {"obj", "ply", "stl"};
  for (int i = 0; i < 3; i++) {
    size_t count;
    char *text = make_large(format[i], &count);
    int most = cancel_reading(text, count, format[i], 1, 0);
    assert_in_range(most, count >> 19, 2 + (count >> 17));
    for (int threads = 1; threads <= 2; threads++)
      for (int last = 1; last <= most; last++)
        (void)cancel_reading(text, count, format[i], threads, last);
    free(text);
  }
}

/* ---- Meshes -------------------------------------------------------------- */

static void a_mesh_draws_as_the_same_model(void **state) {
  (void)state;
  recto_mesh mesh = cube_mesh();
  assert_same(draw_mesh(&mesh), draw_obj(cube_obj));
}

static void a_mesh_in_single_precision_draws_as_in_double(void **state) {
  (void)state;
  float single[24];
  for (int i = 0; i < 24; i++)
    single[i] = (float)points[i];
  recto_mesh mesh = cube_mesh();
  mesh.points = NULL;
  mesh.points_single = single;
  assert_same(draw_mesh(&mesh), draw_obj(cube_obj));
}

static void faces_of_several_sizes_are_given_by_offsets(void **state) {
  (void)state;
  /* The first face as two triangles, the others as they are. */
  static const uint32_t corner[] = {3, 2, 1, 3, 1, 0, 4, 5, 6, 7, 0, 1, 5,
                                    4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
  static const uint32_t offset[] = {0, 3, 6, 10, 14, 18, 22};
  recto_mesh mesh = {.points = points,
                     .point_count = 8,
                     .corners = corner,
                     .corner_count = 26,
                     .face_offsets = offset,
                     .face_count = 7};
  assert_same(draw_mesh(&mesh),
              draw_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n"
                       "v 1 0 1\nv 1 1 1\nv 0 1 1\nf 4 3 2\nf 4 2 1\n"
                       "f 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n"
                       "f 4 1 5 8\n"));
}

static void a_second_mesh_has_indices_of_its_own(void **state) {
  (void)state;
  static const double flat[] = {3, 0, 0, 4, 0, 0, 3, 1, 0};
  static const uint32_t corner[] = {0, 1, 2};
  recto_mesh mesh = cube_mesh();
  recto_scene *scene = box_scene(&mesh);
  mesh = (recto_mesh){
      .points = flat, .point_count = 3, .corners = corner, .corner_count = 3};
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_OK);
  char obj[512];
  snprintf(obj, sizeof obj, "%s%s", cube_obj,
           "v 3 0 0\nv 4 0 0\nv 3 1 0\nf 9 10 11\n");
  assert_same(draw(scene), draw_obj(obj));
}

static void a_wrong_mesh_is_refused_with_its_face_and_adds_nothing(void **s) {
  (void)s;
  static const uint32_t beyond[] = {0, 1, 2, 1, 2, 8};
  static const uint32_t two[] = {0, 3, 5}, back[] = {4, 0};
  static const uint32_t group[] = {0, 2};
  double infinite[24];
  memcpy(infinite, points, sizeof infinite);
  infinite[22] = INFINITY;
  const recto_mesh good = {.points = points,
                           .point_count = 8,
                           .corners = box_faces[0],
                           .corner_count = 6};
  recto_mesh wrong[9] = {good, good, good, good, good, good, good, good, good};
  wrong[0].corners = beyond;
  wrong[1].face_offsets = two, wrong[1].face_count = 2,
  wrong[1].corner_count = 5;
  wrong[2].face_offsets = back, wrong[2].face_count = 2;
  wrong[3].face_groups = group, wrong[3].group_names = box_names,
  wrong[3].group_count = 2;
  wrong[4].points = infinite;
  wrong[5].face_size = 4;
  wrong[6].points = NULL;
  wrong[7].corners = NULL;
  wrong[8].face_offsets = back;
  static const char *const text[9] = {
      "face 1 has a corner that is no point",
      "face 1 has fewer than three corners",
      "face 0 has offsets that are out of range or not ascending",
      "face 1 is of a group that is not there",
      "point 7 is not finite",
      "6 corners are not 1 faces of 4",
      NULL,
      NULL,
      "there are offsets of faces but no number of them"};
  recto_mesh cube = cube_mesh();
  recto_scene *scene = box_scene(&cube);
  for (int i = 0; i < 9; i++) {
    recto_error error = {0};
    assert_int_equal(recto_scene_add_mesh(scene, &wrong[i], &error),
                     RECTO_ERROR_ARGUMENT);
    if (text[i] != NULL)
      assert_string_equal(error.text, text[i]);
  }
  assert_same(draw(scene), draw_obj(cube_obj));
}

static void
a_mesh_beyond_the_limits_is_refused_before_it_is_read(void **state) {
  (void)state;
  recto_mesh mesh = cube_mesh(), other = cube_mesh();
  recto_scene *scene = box_scene(NULL);
  mesh.point_count = SIZE_MAX;
  assert_int_equal(recto_scene_add_mesh(scene, &mesh, NULL), RECTO_ERROR_LIMIT);
  other.corner_count = SIZE_MAX;
  other.face_count = SIZE_MAX / 3;
  other.face_size = 3;
  assert_int_equal(recto_scene_add_mesh(scene, &other, NULL),
                   RECTO_ERROR_LIMIT);
  recto_scene_destroy(scene);
}

static void a_caller_of_another_version_may_add_a_mesh(void **state) {
  (void)state;
  struct later {
    recto_mesh mesh;
    double more;
  } later = {cube_mesh(), 0};
  recto_scene *scene = box_scene(NULL);
  recto_error error = {0};
  /* A later one that does not use what is new, and one that does. */
  assert_int_equal(
      recto_scene_add_mesh_sized(scene, &later.mesh, sizeof later, &error),
      RECTO_OK);
  later.more = 1;
  assert_int_equal(
      recto_scene_add_mesh_sized(scene, &later.mesh, sizeof later, &error),
      RECTO_ERROR_UNSUPPORTED);
  assert_same(draw(scene), draw_obj(cube_obj));
  /* None knew no corners. */
  scene = box_scene(NULL);
  for (size_t size = 0; size < offsetof(recto_mesh, face_offsets); size++)
    assert_int_equal(
        recto_scene_add_mesh_sized(scene, &later.mesh, size, &error),
        RECTO_ERROR_ARGUMENT);
  recto_scene_destroy(scene);
  /* An earlier one, which knew no groups. */
  recto_mesh earlier = cube_mesh();
  scene = box_scene(NULL);
  assert_int_equal(recto_scene_add_mesh_sized(scene, &earlier,
                                              offsetof(recto_mesh, face_groups),
                                              NULL),
                   RECTO_OK);
  earlier.face_groups = NULL;
  assert_same(draw(scene), draw_mesh(&earlier));
}

static void skipped_faces_are_counted_where_faces_have_numbers(void **state) {
  (void)state;
  /* Two triangles apart; one without area comes before the second, in the
   * order of each kind of source. */
  static const double point[] = {0, 0, 0, 1, 0, 0, 0, 0, 1,
                                 3, 0, 0, 4, 0, 0, 3, 0, 1};
  static const uint32_t corner[] = {0, 1, 2, 0, 1, 1, 3, 4, 5};
  const recto_mesh mesh = {
      .points = point, .point_count = 6, .corners = corner, .corner_count = 9};
  static const char points_obj[] = "v 0 0 0\nv 1 0 0\nv 0 0 1\n"
                                   "v 3 0 0\nv 4 0 0\nv 3 0 1\n";
  static const char *const skipped[] = {"f 1 2 2", "f 1 2 99", "f 1 2 x"};
  struct text *of_mesh = draw_mesh(&mesh);
  assert_non_null(strstr(of_mesh->bytes, "data-face=\"2\""));
  assert_null(strstr(of_mesh->bytes, "data-face=\"1\""));
  for (int i = 0; i < 3; i++) {
    char obj[256];
    snprintf(obj, sizeof obj, "%sf 1 2 3\n%s\nf 4 5 6\n", points_obj,
             skipped[i]);
    struct text *of_obj = draw_obj(obj);
    assert_string_equal(of_obj->bytes, of_mesh->bytes);
    free(of_obj);
  }
  free(of_mesh);
  /* Welding takes the area from the second: its sliver is 1e-9 wide. */
  char obj[256];
  snprintf(obj, sizeof obj, "%sv 0 0 1e-9\nf 1 2 3\nf 7 2 1\nf 4 5 6\n",
           points_obj);
  struct text *welded = draw_obj(obj);
  assert_non_null(strstr(welded->bytes, "data-face=\"2\""));
  assert_null(strstr(welded->bytes, "data-face=\"1\""));
  free(welded);
}

/* ---- Writing ------------------------------------------------------------- */

static recto_drawing *render_cube(void) {
  recto_mesh mesh = cube_mesh();
  recto_scene *scene = box_scene(&mesh);
  recto_drawing *drawing;
  assert_int_equal(recto_scene_render(scene, NULL, &drawing, NULL), RECTO_OK);
  recto_scene_destroy(scene);
  return drawing;
}

static void a_written_drawing_has_the_bytes_of_its_file(void **state) {
  (void)state;
  recto_drawing *drawing = render_cube();
  for (size_t i = 0; recto_output_format_name(i) != NULL; i++) {
    const char *format = recto_output_format_name(i);
    const char *path = "test_api_memory.out";
    static struct text text;
    static char bytes[sizeof text.bytes];
    text.count = 0;
    assert_int_equal(recto_drawing_write(drawing, path, format, NULL, NULL),
                     RECTO_OK);
    assert_int_equal(
        recto_drawing_write_to(drawing, format, NULL, append, &text, NULL),
        RECTO_OK);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    size_t count = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    remove(path);
    assert_true(count > 0);
    assert_int_equal(count, text.count);
    assert_memory_equal(bytes, text.bytes, count);
  }
  recto_drawing_destroy(drawing);
}

static bool refuse_second(void *user, const void *bytes, size_t count) {
  (void)bytes, (void)count;
  return ++*(int *)user < 2;
}

static bool refuse(void *user, const void *bytes, size_t count) {
  (void)bytes, (void)count;
  ++*(int *)user;
  return false;
}

static void a_write_function_that_fails_ends_the_writing(void **state) {
  (void)state;
  recto_drawing *drawing = render_cube();
  int calls = 0;
  recto_error error = {0};
  assert_int_equal(
      recto_drawing_write_to(drawing, "svg", NULL, refuse, &calls, &error),
      RECTO_ERROR_IO);
  assert_int_equal(calls, 1);
  assert_string_equal(error.text, "the write function has failed");
  /* This drawing is written in one call. */
  calls = 0;
  assert_int_equal(recto_drawing_write_to(drawing, "svg", NULL, refuse_second,
                                          &calls, &error),
                   RECTO_OK);
  assert_int_equal(
      recto_drawing_write_to(drawing, "sbg", NULL, refuse, &calls, &error),
      RECTO_ERROR_UNSUPPORTED);
  recto_drawing_destroy(drawing);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_model_from_memory_draws_as_from_its_file),
      cmocka_unit_test(no_byte_behind_the_given_ones_is_read),
      cmocka_unit_test(errors_of_a_model_in_memory_have_its_name_and_line),
      cmocka_unit_test(a_model_in_memory_opens_files_only_beside_its_name),
      cmocka_unit_test(reading_may_be_cancelled_and_leaves_the_scene),
      cmocka_unit_test(a_mesh_draws_as_the_same_model),
      cmocka_unit_test(a_mesh_in_single_precision_draws_as_in_double),
      cmocka_unit_test(faces_of_several_sizes_are_given_by_offsets),
      cmocka_unit_test(a_second_mesh_has_indices_of_its_own),
      cmocka_unit_test(a_wrong_mesh_is_refused_with_its_face_and_adds_nothing),
      cmocka_unit_test(a_mesh_beyond_the_limits_is_refused_before_it_is_read),
      cmocka_unit_test(a_caller_of_another_version_may_add_a_mesh),
      cmocka_unit_test(skipped_faces_are_counted_where_faces_have_numbers),
      cmocka_unit_test(a_written_drawing_has_the_bytes_of_its_file),
      cmocka_unit_test(a_write_function_that_fails_ends_the_writing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
