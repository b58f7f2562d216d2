/* test_parts.c - the parts of a drawing, joined, are the drawing to the byte;
 * and files that are not its parts are refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "api/handle.h"
#include "parts/byte_codec.h"
#include "tests/memory_faults.h"
#include "tests/scenes/scenes.h"
#include "tests/svg_text.h"
#include "tests/temporary.h"

enum { PARTS_MOST = 16 };

/* ---- Parts --------------------------------------------------------------- */

static const char *part_path(void *const *state, unsigned number,
                             unsigned count) {
  char name[40];
  snprintf(name, sizeof name, "part-%u-%u.recto", number, count);
  return temporary_path(state, name);
}

/* Writes all parts; returns the first error. */
static recto_status write_parts(void *const *state, const recto_scene *scene,
                                const recto_options *options, unsigned count,
                                recto_error *error) {
  recto_status status = RECTO_OK;
  for (unsigned i = 1; i <= count && status == RECTO_OK; i++)
    status = recto_scene_write_part(scene, options, i, count,
                                    part_path(state, i, count), error);
  return status;
}

static recto_status join_all(void *const *state, const recto_options *options,
                             unsigned count, recto_drawing **drawing,
                             recto_error *error) {
  char *path[PARTS_MOST];
  for (unsigned i = 0; i < count; i++) /* backwards: any order will do */
    path[i] = mem_copy_text(part_path(state, count - i, count));
  recto_status status = recto_join_parts((const char *const *)path, count,
                                         options, drawing, error);
  for (unsigned i = 0; i < count; i++)
    mem_free(path[i]);
  return status;
}

/* Writes the parts again, by a plan; returns the first error. */
static recto_status write_planned(void *const *state, const recto_scene *scene,
                                  const recto_options *options, unsigned count,
                                  recto_error *error) {
  char *plan = mem_copy_text(temporary_path(state, "drawing.plan"));
  recto_status status =
      recto_scene_write_plan(scene, options, count, plan, error);
  for (unsigned i = 1; i <= count && status == RECTO_OK; i++) {
    char name[40];
    snprintf(name, sizeof name, "planned-%u.recto", i);
    status = recto_plan_write_part(plan, NULL, i, count,
                                   temporary_path(state, name), error);
  }
  mem_free(plan);
  return status;
}

/* Checks that parts by a plan have the bytes of those without one, or are
 * refused as these were.
 * status, why  what became of the parts without one */
static void compare_planned(void *const *state, const recto_scene *scene,
                            const recto_options *options, unsigned count,
                            const char *name, recto_status status,
                            const char *why) {
  recto_error error = {0};
  recto_status planned = write_planned(state, scene, options, count, &error);
  if (planned != status || (status != RECTO_OK && strcmp(error.text, why) != 0))
    fail_msg("%s by a plan: %s", name, error.text);
  for (unsigned i = 1; i <= count && status == RECTO_OK; i++) {
    char file[40];
    size_t sizes[2];
    snprintf(file, sizeof file, "planned-%u.recto", i);
    char *a = temporary_read(part_path(state, i, count), &sizes[0]);
    char *b = temporary_read(temporary_path(state, file), &sizes[1]);
    assert_non_null(a);
    assert_non_null(b);
    if (sizes[0] != sizes[1] || memcmp(a, b, sizes[0]) != 0)
      fail_msg("%s: part %u of %u is another by a plan", name, i, count);
    free(a);
    free(b);
  }
}

/* Draws a scene at once and in parts, and these by a plan too if that is
 * wanted.  Returns false where it cannot be drawn in parts, or not at all. */
static bool compare_parts(void *const *state, const recto_scene *scene,
                          const recto_options *options, unsigned count,
                          const char *name, bool by_plan) {
  recto_drawing *whole = NULL, *joined = NULL;
  recto_error error = {0};
  recto_status status = write_parts(state, scene, options, count, &error);
  if (by_plan)
    compare_planned(state, scene, options, count, name, status, error.text);
  if (status == RECTO_ERROR_UNSUPPORTED || status == RECTO_ERROR_EMPTY)
    return false;
  if (status == RECTO_OK)
    status = join_all(state, options, count, &joined, &error);
  if (status != RECTO_OK)
    fail_msg("%s in %u parts: %s", name, count, error.text);
  assert_int_equal(recto_scene_render(scene, options, &whole, NULL), RECTO_OK);
  char *a = svg_text_of(whole, options), *b = svg_text_of(joined, options);
  if (a == NULL || b == NULL || strcmp(a, b) != 0)
    fail_msg("%s differs in %u parts, edges %x, hidden %d, fill %d", name,
             count, options->ink.edges, (int)options->ink.hidden,
             (int)options->ink.fill);
  free(a);
  free(b);
  recto_drawing_destroy(whole);
  recto_drawing_destroy(joined);
  return true;
}

/* Lines, hidden lines dashed, fills, hatching, lines behind one face, ids,
 * creases with a second angle and all edges, tone hatching, all edges; and with
 * a second angle smooth edges alone, and with creases. */
enum { MODES = 11 };

static void set_mode(recto_options *options, int mode) {
  static const recto_fill fill[MODES] = {
      RECTO_FILL_NONE, RECTO_FILL_NONE,  RECTO_FILL_SHADE, RECTO_FILL_HATCH,
      RECTO_FILL_NONE, RECTO_FILL_SHADE, RECTO_FILL_NONE,  RECTO_FILL_HATCH,
      RECTO_FILL_NONE, RECTO_FILL_NONE,  RECTO_FILL_SHADE};
  options->ink.fill = fill[mode];
  options->ink.hidden = mode == 1   ? RECTO_HIDDEN_DASHED
                        : mode == 4 ? RECTO_HIDDEN_LAYER
                                    : RECTO_HIDDEN_NONE;
  options->ink.hidden_by_max = mode == 4;
  options->ink.ids = mode == 5;
  bool has_two_angles = mode == 6 || mode == 9 || mode == 10;
  options->mesh.crease_deg = has_two_angles ? 10 : 30;
  options->mesh.crease_start_deg = has_two_angles ? 50 : 0;
  options->ink.edges = mode == 6 || mode == 8 ? RECTO_EDGES_ALL
                       : mode == 9            ? RECTO_EDGE_SMOOTH
                       : mode == 10 ? RECTO_EDGE_SMOOTH | RECTO_EDGE_CREASE
                                    : RECTO_EDGES_DEFAULT;
  options->ink.light[0] = mode == 7 ? -1 : 0;
  options->ink.light[1] = mode == 7 ? 2 : 0;
  options->ink.light[2] = mode == 7 ? 1 : 0;
}

/* Scenes of more faces are drawn in one number of parts alone. */
enum { FACES_OF_ALL_COUNTS = 2000 };

static void joined_parts_are_the_drawing(void **state) {
  static const unsigned count[] = {7, 1, 2, 16};
  size_t compared = 0;
  for (const struct scenes_entry *entry = scene_list; entry->name != NULL;
       entry++) {
    recto_scene *scene;
    recto_options options;
    bool in_parts = true;
    size_t counts = sizeof count / sizeof count[0];
    assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
    recto_options_init(&options);
    entry->fill(&scene->scene, &options);
    options.camera.fit = RECTO_FIT_PAGE;
    options.camera.has_section = false;
    options.camera.section = 0;
    if (scene_face_count(&scene->scene) > FACES_OF_ALL_COUNTS)
      counts = 1;
    for (int mode = 0; mode < MODES && in_parts; mode++)
      for (size_t i = 0; i < (mode < 9 ? counts : 1) && in_parts; i++) {
        set_mode(&options, mode);
        in_parts = compare_parts(state, scene, &options, count[i], entry->name,
                                 (mode + (int)i) % 2 == 0);
      }
    if (!in_parts)
      print_message("not in parts: %s\n", entry->name);
    compared += in_parts && counts > 1;
    recto_scene_destroy(scene);
  }
  print_message("%zu scenes in all numbers of parts\n", compared);
  assert_true(compared >= 20);
}

/* Uneven ground in patches, of smoothing groups of their own: creases by marks
 * between the patches, and none within. */
static recto_scene *make_marked(recto_options *options) {
  enum { SIDE = 8, PATCH = 3 };
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  recto_options_init(options);
  struct scene *ground = &scene->scene;
  for (int i = 0; i < SIDE * SIDE; i++)
    build_point(ground, i % SIDE, i / SIDE, 0.1 * (i * i * 7 % 6));
  for (uint32_t i = 0; i < SIDE * (SIDE - 1); i++) {
    uint32_t group = SMOOTHING_GROUPS + i / SIDE / PATCH * SIDE;
    if (i % SIDE == SIDE - 1)
      continue;
    assert_true(smoothing_set(&ground->smoothing, scene_face_count(ground),
                              group + i % SIDE / PATCH));
    build_triangle(ground, i, i + 1, i + SIDE + 1);
    build_triangle(ground, i, i + SIDE + 1, i + SIDE);
  }
  return scene;
}

static void parts_have_the_marks_of_creases(void **state) {
  recto_options options;
  recto_scene *scene = make_marked(&options);
  for (int mode = 0; mode < MODES; mode++) {
    set_mode(&options, mode);
    for (int marks = 0; marks < 3; marks++) {
      options.mesh.crease_marks = (recto_crease_marks)marks;
      assert_true(compare_parts(state, scene, &options, 3, "marked", true));
    }
  }
  recto_scene_destroy(scene);
}

/* ---- Files that are refused ---------------------------------------------- */

/* A scene of crossed boxes in two parts. */
static recto_scene *make_parts(void *const *state, recto_options *options) {
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  recto_options_init(options);
  scenes_crossed_boxes(&scene->scene, options);
  options->camera.fit = RECTO_FIT_PAGE;
  assert_int_equal(write_parts(state, scene, options, 2, NULL), RECTO_OK);
  return scene;
}

static recto_error join_two(const char *a, const char *b) {
  const char *path[2] = {a, b};
  recto_drawing *drawing = NULL;
  recto_error error = {0};
  assert_int_not_equal(
      recto_join_parts(path, b != NULL ? 2 : 1, NULL, &drawing, &error),
      RECTO_OK);
  assert_null(drawing);
  return error;
}

static char *copy_path(const char *path) { return mem_copy_text(path); }

static void parts_of_other_marks_are_named(void **state) {
  recto_options options;
  recto_scene *scene = make_marked(&options);
  assert_int_equal(write_parts(state, scene, &options, 2, NULL), RECTO_OK);
  char *first = copy_path(part_path(state, 1, 2));
  char *other = copy_path(temporary_path(state, "other.recto"));
  /* None, and those of other groups. */
  for (int i = 0; i < 2; i++) {
    struct smoothing_groups *own = &scene->scene.smoothing;
    options.mesh.crease_marks =
        i == 0 ? RECTO_CREASE_MARKS_NONE : RECTO_CREASE_MARKS_AUTO;
    own->range.item[1].first_face += i == 1;
    assert_int_equal(recto_scene_write_part(scene, &options, 2, 2, other, NULL),
                     RECTO_OK);
    recto_error error = join_two(first, other);
    assert_non_null(strstr(error.text, "belongs to another drawing"));
  }
  mem_free(first);
  mem_free(other);
  recto_scene_destroy(scene);
}

static void missing_and_double_parts_are_named(void **state) {
  recto_options options;
  recto_scene *scene = make_parts(state, &options);
  char *first = copy_path(part_path(state, 1, 2));
  recto_error error = join_two(first, NULL);
  assert_int_equal(error.code, RECTO_ERROR_ARGUMENT);
  assert_string_equal(error.text, "part 2 of the 2 parts is missing");
  error = join_two(first, first);
  assert_int_equal(error.code, RECTO_ERROR_ARGUMENT);
  assert_non_null(strstr(error.text, "part 1 of 2 is there twice"));
  assert_non_null(strstr(error.file, "part-1-2.recto"));
  mem_free(first);
  recto_scene_destroy(scene);
}

static void foreign_parts_are_named(void **state) {
  recto_options options;
  recto_scene *scene = make_parts(state, &options);
  char *first = copy_path(part_path(state, 1, 2));
  char *foreign = copy_path(temporary_path(state, "foreign.recto"));
  /* Of another view, of other edges, of a moved model. */
  for (int i = 0; i < 3; i++) {
    recto_options other = options;
    other.camera.azimuth_deg += i == 0;
    other.ink.edges = i == 1 ? RECTO_EDGE_BORDER : other.ink.edges;
    scene->scene.point.item[0].x += i == 2 ? 1e-3 : 0;
    assert_int_equal(recto_scene_write_part(scene, &other, 2, 2, foreign, NULL),
                     RECTO_OK);
    recto_error error = join_two(first, foreign);
    assert_int_equal(error.code, RECTO_ERROR_ARGUMENT);
    assert_non_null(strstr(error.text, "belongs to another drawing"));
    assert_non_null(strstr(error.file, "foreign.recto"));
  }
  mem_free(first);
  mem_free(foreign);
  recto_scene_destroy(scene);
}

static void damaged_parts_are_named(void **state) {
  recto_options options;
  recto_scene *scene = make_parts(state, &options);
  size_t count;
  char *first = copy_path(part_path(state, 1, 2));
  char *bytes = temporary_read(part_path(state, 2, 2), &count);
  assert_non_null(bytes);
  /* Each byte flipped, then each length cut. */
  for (size_t i = 0; i < count; i += 1 + i / 64) {
    bytes[i] ^= (char)(1 << i % 8);
    recto_error error =
        join_two(first, temporary_file(state, "bad.recto", bytes, count));
    bytes[i] ^= (char)(1 << i % 8);
    assert_true(error.code == RECTO_ERROR_FORMAT ||
                error.code == RECTO_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.file, "bad.recto"));
  }
  for (size_t i = 0; i < count; i += 1 + i / 16) {
    recto_error error =
        join_two(first, temporary_file(state, "bad.recto", bytes, i));
    assert_int_equal(error.code, RECTO_ERROR_FORMAT);
    assert_string_equal(error.text, "the part is cut short");
    assert_non_null(strstr(error.file, "bad.recto"));
  }
  free(bytes);
  mem_free(first);
  recto_scene_destroy(scene);
}

/* Joins two parts, of which the second is damaged in one byte after another.
 * Whoever makes a file can make its checksum. */
static void join_damaged(void *const *state, const recto_options *options) {
  size_t count;
  char *first = copy_path(part_path(state, 1, 2));
  char *bytes = temporary_read(part_path(state, 2, 2), &count);
  assert_non_null(bytes);
  for (size_t i = 12; i + 8 < count; i += 1 + i / 512) {
    char before = bytes[i];
    bytes[i] = (char)(before ^ (i % 3 == 0 ? 0xff : 1 << i % 8));
    uint64_t sum = byte_codec_checksum(bytes, count - 8);
    for (int k = 0; k < 8; k++)
      bytes[count - 8 + (size_t)k] = (char)(sum >> 8 * k & 0xff);
    const char *path[2] = {first,
                           temporary_file(state, "bad.recto", bytes, count)};
    recto_drawing *drawing = NULL;
    recto_status status = recto_join_parts(path, 2, options, &drawing, NULL);
    assert_int_equal(status == RECTO_OK, drawing != NULL);
    recto_drawing_destroy(drawing);
    bytes[i] = before;
  }
  free(bytes);
  mem_free(first);
}

static void damage_with_a_right_checksum_does_no_harm(void **state) {
  recto_options options;
  recto_scene *scene = make_parts(state, &options);
  join_damaged(state, &options);
  recto_scene_destroy(scene);
  scene = make_marked(&options);
  options.mesh.crease_start_deg = 60;
  assert_int_equal(write_parts(state, scene, &options, 2, NULL), RECTO_OK);
  join_damaged(state, &options);
  recto_scene_destroy(scene);
}

/* The checksum by its definition: a bit at a time. */
static uint64_t checksum_by_bits(const unsigned char *bytes, size_t count) {
  uint64_t sum = 0;
  for (size_t i = 0; i < count; i++) {
    sum ^= (uint64_t)bytes[i] << 56;
    for (int bit = 0; bit < 8; bit++)
      sum = sum << 1 ^ (sum >> 63 ? UINT64_C(0x42f0e1eba9ea3693) : 0);
  }
  return sum;
}

static void checksums_are_those_of_the_polynomial(void **state) {
  enum { MOST = 400 };
  unsigned char bytes[MOST];
  (void)state;
  assert_true(byte_codec_checksum("123456789", 9) ==
              UINT64_C(0x6c40df5f0b497347)); /* in lists of checksums */
  for (size_t i = 0; i < MOST; i++)
    bytes[i] = (unsigned char)(i * i * 37 >> 3 ^ i);
  for (size_t count = 0; count <= MOST; count++)
    assert_true(byte_codec_checksum(bytes, count) ==
                checksum_by_bits(bytes, count));
}

static void a_whole_part_of_the_drawing_is_there(void **state) {
  recto_options options;
  recto_scene *scene = make_parts(state, &options);
  char *path = copy_path(part_path(state, 1, 2));
  bool is_there = false;
  assert_int_equal(
      recto_scene_has_part(scene, &options, 1, 2, path, &is_there, NULL),
      RECTO_OK);
  assert_true(is_there);
  assert_int_equal(
      recto_scene_has_part(scene, &options, 2, 2, path, &is_there, NULL),
      RECTO_OK);
  assert_false(is_there);
  options.camera.azimuth_deg += 1;
  assert_int_equal(
      recto_scene_has_part(scene, &options, 1, 2, path, &is_there, NULL),
      RECTO_OK);
  assert_false(is_there);
  assert_int_equal(recto_scene_has_part(scene, &options, 1, 2,
                                        temporary_path(state, "none"),
                                        &is_there, NULL),
                   RECTO_OK);
  assert_false(is_there);
  mem_free(path);
  recto_scene_destroy(scene);
}

static void what_parts_do_not_have_is_refused(void **state) {
  recto_options options, other;
  recto_scene *scene = make_parts(state, &options);
  recto_drawing *drawing = NULL;
  recto_error error;
  other = options;
  other.ink.fill = RECTO_FILL_SHADE;
  assert_int_equal(join_all(state, &other, 2, &drawing, &error),
                   RECTO_ERROR_UNSUPPORTED);
  assert_string_equal(error.text, "the parts were made without visible faces: "
                                  "make them with --fill");
  other = options;
  other.ink.hidden = RECTO_HIDDEN_LAYER;
  assert_int_equal(join_all(state, &other, 2, &drawing, &error),
                   RECTO_ERROR_UNSUPPORTED);
  assert_int_equal(write_parts(state, scene, &other, 2, NULL), RECTO_OK);
  other.ink.hidden_by_max = 2;
  assert_int_equal(join_all(state, &other, 2, &drawing, &error),
                   RECTO_ERROR_UNSUPPORTED);
  assert_non_null(strstr(error.text, "--hidden=2"));
  other = options;
  other.ink.ids = true;
  assert_int_equal(join_all(state, &other, 2, &drawing, &error),
                   RECTO_ERROR_UNSUPPORTED);
  other = options;
  other.ink.fill = RECTO_FILL_HATCH;
  assert_int_equal(write_parts(state, scene, &other, 2, &error), RECTO_OK);
  other.ink.light[0] = 1;
  assert_int_equal(join_all(state, &other, 2, &drawing, &error),
                   RECTO_ERROR_UNSUPPORTED);
  assert_non_null(strstr(error.text, "--light"));
  assert_int_equal(write_parts(state, scene, &other, 2, &error), RECTO_OK);
  assert_int_equal(join_all(state, &other, 2, &drawing, &error), RECTO_OK);
  recto_drawing_destroy(drawing);
  other.ink.pen_mm *= 2;
  assert_int_equal(join_all(state, &other, 2, &drawing, &error),
                   RECTO_ERROR_UNSUPPORTED);
  other = options;
  other.ink.contours = RECTO_CONTOURS_SMOOTH;
  assert_int_equal(write_parts(state, scene, &other, 2, &error),
                   RECTO_ERROR_UNSUPPORTED);
  other = options;
  other.solver.method = RECTO_METHOD_ZBUFFER;
  assert_int_equal(write_parts(state, scene, &other, 2, &error),
                   RECTO_ERROR_UNSUPPORTED);
  other = options;
  other.camera.fit = RECTO_FIT_SCALE;
  assert_int_equal(write_parts(state, scene, &other, 2, &error),
                   RECTO_ERROR_UNSUPPORTED);
  double before = scene->scene.point.item[0].x;
  scene->scene.point.item[0].x = 1.3e30; /* more than 2^100 */
  assert_int_equal(write_parts(state, scene, &options, 2, &error),
                   RECTO_ERROR_UNSUPPORTED);
  assert_non_null(strstr(error.text, "of extreme size"));
  scene->scene.point.item[0].x = before;
  assert_int_equal(recto_scene_write_part(scene, &options, 3, 2, "x", &error),
                   RECTO_ERROR_ARGUMENT);
  assert_int_equal(recto_scene_write_part(scene, &options, 1,
                                          RECTO_PARTS_MAX + 1, "x", &error),
                   RECTO_ERROR_ARGUMENT);
  recto_scene_destroy(scene);
}

/* Whether a part of two triangles is refused, the corners of which lie so far
 * apart along an axis, wherever in the cells by which they are sought. */
static bool is_welding_refused(void *const *state, int axis, double at,
                               double gap) {
  recto_scene *scene;
  recto_options options;
  recto_error error = {0};
  double near[3] = {at, at, at}, far[3] = {at, at, at};
  far[axis] += gap;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  recto_options_init(&options);
  options.mesh.weld = 0.001;
  for (int k = 0; k < 2; k++) {
    const double *corner = k == 0 ? near : far, side = k == 0 ? -1 : 1;
    build_triangle(&scene->scene,
                   build_point(&scene->scene, corner[0], corner[1], corner[2]),
                   build_point(&scene->scene, at + side, at - 1, at),
                   build_point(&scene->scene, at + side, at + 1, at + side));
  }
  recto_status status = write_parts(state, scene, &options, 2, &error);
  recto_scene_destroy(scene);
  if (status == RECTO_ERROR_UNSUPPORTED)
    assert_non_null(strstr(error.text, "which parts cannot weld"));
  else
    assert_int_equal(status, RECTO_OK);
  return status != RECTO_OK;
}

static void corners_that_may_be_welded_are_refused(void **state) {
  for (int axis = 0; axis < 3; axis++)
    for (int i = -8; i <= 8; i++) {
      double at = i * 0.0005;
      assert_true(is_welding_refused(state, axis, at, 0.00099));
      assert_true(is_welding_refused(state, axis, at, -0.00099));
      assert_false(is_welding_refused(state, axis, at, 0.00101));
      assert_false(is_welding_refused(state, axis, at, -0.00101));
    }
}

/* A side, and two others along it: parts cannot close the slit between. */
static void slits_are_refused(void **state) {
  const double large[] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0};
  const double left[] = {0, 0, 0, 2, 0, 0, 1, -2, 0};
  const double right[] = {2, 0, 0, 4, 0, 0, 3, -2, 0};
  for (int k = 0; k < 2; k++) {
    recto_scene *scene;
    recto_options options;
    recto_error error = {0};
    assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
    recto_options_init(&options);
    options.mesh.weld = k == 0 ? -1 : 0;
    build_polygon(&scene->scene, large, 4);
    build_polygon(&scene->scene, left, 3);
    build_polygon(&scene->scene, right, 3);
    recto_status status = write_parts(state, scene, &options, 2, &error);
    recto_scene_destroy(scene);
    assert_int_equal(status, k == 0 ? RECTO_ERROR_UNSUPPORTED : RECTO_OK);
    if (k == 0)
      assert_non_null(strstr(error.text, "whose slits parts cannot close"));
  }
}

/* A tent of two sides, each face with its reverse. */
static void faces_listed_twice_are_refused(void **state) {
  for (int k = 0; k < 2; k++) {
    recto_scene *scene;
    recto_options options;
    recto_error error = {0};
    assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
    recto_options_init(&options);
    options.mesh.weld = k == 0 ? -1 : 0;
    for (int i = 0; i < 4; i++)
      build_point(&scene->scene, i % 2, i / 2 * (1 - i % 2), i == 3);
    build_triangle(&scene->scene, 0, 1, 2);
    build_triangle(&scene->scene, 1, 0, 3);
    build_triangle(&scene->scene, 0, 2, 1);
    build_triangle(&scene->scene, 0, 1, 3);
    recto_status status = write_parts(state, scene, &options, 1, &error);
    recto_scene_destroy(scene);
    assert_int_equal(status, k == 0 ? RECTO_ERROR_UNSUPPORTED : RECTO_OK);
    if (k == 0)
      assert_non_null(strstr(error.text, "faces are listed twice"));
  }
}

static void a_limit_of_hiding_faces_may_be_left_out(void **state) {
  recto_options options;
  recto_scene *scene = make_parts(state, &options);
  recto_drawing *whole, *joined;
  options.ink.hidden = RECTO_HIDDEN_LAYER;
  options.ink.hidden_by_max = 1;
  assert_int_equal(write_parts(state, scene, &options, 2, NULL), RECTO_OK);
  options.ink.hidden_by_max = 0;
  assert_int_equal(recto_scene_render(scene, &options, &whole, NULL), RECTO_OK);
  assert_int_equal(join_all(state, &options, 2, &joined, NULL), RECTO_OK);
  char *a = svg_text_of(whole, &options), *b = svg_text_of(joined, &options);
  assert_string_equal(a, b);
  free(a);
  free(b);
  recto_drawing_destroy(whole);
  recto_drawing_destroy(joined);
  recto_scene_destroy(scene);
}

/* Runs with each allocation failing in turn: a run without the reports that
 * memory did not suffice for may succeed, ten in a row met no failure. */
static void fail_allocations(recto_status (*run)(void *user), void *user) {
  struct memory_faults faults = {.least = 101, .in_a_row = 10};
  while (memory_faults_go_on(&faults)) {
    memory_faults_begin(&faults);
    memory_faults_end(&faults, run(user));
  }
}

struct memory_run {
  const recto_scene *scene;
  recto_options options;
  const char *path;
};

static recto_status write_one(void *user) {
  const struct memory_run *run = user;
  return recto_scene_write_part(run->scene, &run->options, 1, 1, run->path,
                                NULL);
}

static recto_status join_one(void *user) {
  const struct memory_run *run = user;
  recto_drawing *drawing = NULL;
  recto_status status =
      recto_join_parts(&run->path, 1, &run->options, &drawing, NULL);
  recto_drawing_destroy(drawing);
  return status;
}

static void what_runs_out_of_memory_says_so(void **state) {
  struct memory_run run;
  recto_scene *scene = make_parts(state, &run.options);
  char *path = copy_path(part_path(state, 1, 1));
  run.scene = scene;
  run.path = path;
  run.options.solver.threads = 1;
  run.options.ink.fill = RECTO_FILL_SHADE;
  fail_allocations(write_one, &run);
  fail_allocations(join_one, &run);
  run.options.ink.fill = RECTO_FILL_HATCH;
  run.options.ink.light[0] = 1;
  run.options.ink.ids = true;
  run.options.mesh.crease_start_deg = 60;
  fail_allocations(write_one, &run);
  fail_allocations(join_one, &run);
  recto_scene_destroy(scene);
  run.scene = scene = make_marked(&run.options);
  run.options.solver.threads = 1;
  fail_allocations(write_one, &run);
  fail_allocations(join_one, &run);
  mem_free(path);
  recto_scene_destroy(scene);
}

#define IN_FOLDER(test)                                                        \
  cmocka_unit_test_setup_teardown(test, temporary_set_up, temporary_tear_down)

int main(void) {
  const struct CMUnitTest tests[] = {
      IN_FOLDER(joined_parts_are_the_drawing),
      IN_FOLDER(parts_have_the_marks_of_creases),
      IN_FOLDER(parts_of_other_marks_are_named),
      IN_FOLDER(missing_and_double_parts_are_named),
      IN_FOLDER(foreign_parts_are_named),
      IN_FOLDER(damaged_parts_are_named),
      IN_FOLDER(damage_with_a_right_checksum_does_no_harm),
      cmocka_unit_test(checksums_are_those_of_the_polynomial),
      IN_FOLDER(a_whole_part_of_the_drawing_is_there),
      IN_FOLDER(what_parts_do_not_have_is_refused),
      IN_FOLDER(corners_that_may_be_welded_are_refused),
      IN_FOLDER(slits_are_refused),
      IN_FOLDER(faces_listed_twice_are_refused),
      IN_FOLDER(a_limit_of_hiding_faces_may_be_left_out),
      IN_FOLDER(what_runs_out_of_memory_says_so)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
