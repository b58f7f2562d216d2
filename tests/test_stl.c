/* test_stl.c - STL of both kinds, recognised and welded. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/read.h"
#include "tests/comma_locale.h"
#include "tests/memory_faults.h"
#include "tests/reading.h"
#include "tests/scenes/random.h"

static int tear_down(void **state) {
  (void)state;
  mem_fail_after(0);
  return 0;
}

static void assert_read(const struct reading *r) {
  if (r->status != RECTO_OK)
    fail_msg("line %lu: %s", r->error.line, r->error.text);
  const char *fault = reading_fault(&r->scene);
  if (fault != NULL)
    fail_msg("%s", fault);
}

static void assert_broken(const char *bytes, size_t count, unsigned long line,
                          const char *text) {
  struct reading r;
  reading_init(&r);
  assert_int_equal(reading_bytes(&r, &reader_stl, bytes, count),
                   RECTO_ERROR_FORMAT);
  assert_string_equal(r.error.file, "file");
  assert_string_equal(r.error.text, text);
  assert_int_equal(r.error.line, line);
  reading_fini(&r);
}

#define ASSERT_BROKEN(text, line, message)                                     \
  assert_broken((text), sizeof(text) - 1, (line), (message))

#define NEITHER                                                                \
  "neither a text STL, which begins with 'solid', nor a binary one"

/* ---- Binary -------------------------------------------------------------- */

enum { TRIANGLES_MAX = 3000 };

struct binary {
  size_t count; /* bytes */
  char bytes[84 + 50 * TRIANGLES_MAX];
};

static void put_uint32(char *to, uint32_t value) {
  for (int i = 0; i < 4; i++)
    to[i] = (char)(value >> 8 * i & 255);
}

static void put_single(char *to, float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  put_uint32(to, bits);
}

/* A binary STL with this header and no triangle. */
static struct binary *start_binary(const char *header) {
  static struct binary binary;
  memset(&binary, 0, sizeof binary);
  strncpy(binary.bytes, header, 80);
  binary.count = 84;
  return &binary;
}

static void add_triangle(struct binary *binary, const float corner[9]) {
  char *to = binary->bytes + binary->count;
  memset(to, 0, 50);
  for (int i = 0; i < 9; i++)
    put_single(to + 12 + 4 * i, corner[i]);
  to[48] = 17; /* attributes, which mean nothing */
  binary->count += 50;
  put_uint32(binary->bytes + 80, (uint32_t)(binary->count - 84) / 50);
}

#define TRIANGLE(binary, ...)                                                  \
  add_triangle((binary), (const float[9]){__VA_ARGS__})

static void read_binary(struct reading *r, const struct binary *binary) {
  reading_init(r);
  (void)reading_bytes(r, &reader_stl, binary->bytes, binary->count);
}

static void add_square(struct binary *binary) {
  TRIANGLE(binary, 0, 0, 0, 1, 0, 0, 1, 1, 0);
  TRIANGLE(binary, 0, 0, 0, 1, 1, 0, 0, 1, 0);
}

static void triangles_are_welded_by_position(void **state) {
  (void)state;
  struct binary *binary = start_binary("made by hand");
  add_square(binary);
  TRIANGLE(binary, 1, 1, 0, 1, 1, 1e-30f, 0, 1, 0);
  struct reading r;
  read_binary(&r, binary);
  assert_read(&r);
  static const uint32_t corner[9] = {0, 1, 2, 0, 2, 3, 2, 4, 3};
  assert_int_equal(r.scene.point.count, 5);
  assert_int_equal(r.scene.corner.count, 9);
  assert_memory_equal(r.scene.corner.item, corner, sizeof corner);
  assert_true(r.scene.point.item[4].z == (double)1e-30f);
  assert_string_equal(r.scene.group.item[0].name, "default");
  reading_fini(&r);
}

static void minus_zero_is_zero(void **state) {
  (void)state;
  struct binary *binary = start_binary("");
  TRIANGLE(binary, 0, -0.0f, 0, 1, 0, 0, 0, 1, -0.0f);
  TRIANGLE(binary, -0.0f, 0, -0.0f, 0, 1, 0, 1, -0.0f, 5);
  struct reading r;
  read_binary(&r, binary);
  assert_read(&r);
  assert_int_equal(r.scene.point.count, 4);
  for (int i = 0; i < 4; i++)
    assert_false(signbit(r.scene.point.item[i].y));
  reading_fini(&r);
}

/* Points are numbered as they first appear, whatever the table's order. */
static void many_triangles_are_welded_as_by_comparison(void **state) {
  (void)state;
  struct random random = {1};
  struct binary *binary = start_binary("");
  static float place[9 * TRIANGLES_MAX];
  for (int i = 0; i < TRIANGLES_MAX; i++) {
    float *p = &place[9 * i];
    for (int k = 0; k < 9; k++)
      p[k] = (float)random_int(&random, -6, 6) * 0.1f;
    add_triangle(binary, p);
  }
  struct reading r;
  read_binary(&r, binary);
  assert_read(&r);
  size_t points = 0;
  for (size_t i = 0; i < 3 * (size_t)TRIANGLES_MAX; i++) {
    size_t k = 0;
    while (memcmp(&place[3 * k], &place[3 * i], 3 * sizeof(float)) != 0)
      k++;
    if (k < i)
      continue;
    const struct scene_point *p = &r.scene.point.item[points++];
    assert_true(p->x == place[3 * i] && p->y == place[3 * i + 1] &&
                p->z == place[3 * i + 2]);
  }
  assert_int_equal(r.scene.point.count, points);
  assert_true(scene_face_count(&r.scene) +
                  r.diagnostics.count[SCENE_FAULT_FEW_CORNERS] +
                  r.diagnostics.count[SCENE_FAULT_ZERO_AREA] ==
              TRIANGLES_MAX);
  assert_true(r.diagnostics.count[SCENE_FAULT_FEW_CORNERS] > 0);
  reading_fini(&r);
}

/* A place of a grid, or now and then one that is not finite. */
static float random_place(struct random *random) {
  float place = (float)random_int(random, -12, 12);
  return random_below(random, 20000) > 0 ? place * 0.1f : NAN;
}

/* Triangles between places of a grid, so that those of all threads have most
 * points in common, and some corners are one. */
static char *make_grid_file(size_t triangles, size_t *count) {
  struct random random = {7};
  *count = 84 + 50 * triangles;
  char *bytes = calloc(*count, 1);
  assert_non_null(bytes);
  put_uint32(bytes + 80, (uint32_t)triangles);
  for (size_t i = 0; i < triangles; i++)
    for (int k = 0; k < 9; k++)
      put_single(bytes + 84 + 50 * i + 12 + (size_t)k * 4,
                 random_place(&random));
  return bytes;
}

static void several_threads_weld_as_one_does(void **state) {
  (void)state;
  enum { TRIANGLES = 100000, TOO_FEW_TO_DIVIDE = 1000 };
  static const size_t triangles[] = {TRIANGLES, TOO_FEW_TO_DIVIDE};
  for (size_t i = 0; i < 2; i++) {
    size_t count;
    char *bytes = make_grid_file(triangles[i], &count);
    const char *fault = reading_parallel_fault(&reader_stl, bytes, count);
    if (fault != NULL)
      fail_msg("%zu triangles: %s", triangles[i], fault);
    free(bytes);
  }
}

static void invalid_triangles_are_skipped(void **state) {
  (void)state;
  struct binary *binary = start_binary("");
  add_square(binary);
  TRIANGLE(binary, 0, 0, 0, NAN, 0, 0, 1, 1, 0);
  TRIANGLE(binary, 0, 0, 0, 1, 0, 0, 1, INFINITY, 0);
  TRIANGLE(binary, 0, 0, 0, 1, 0, 0, 0, 0, 0);
  TRIANGLE(binary, 0, 0, 0, 1, 1, 1, 2, 2, 2);
  TRIANGLE(binary, 0, 0, 1, 1, 0, 1, 1, 1, 1);
  struct reading r;
  read_binary(&r, binary);
  assert_read(&r);
  assert_int_equal(scene_face_count(&r.scene), 3);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_NOT_FINITE], 2);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_FEW_CORNERS], 1);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_ZERO_AREA], 1);
  assert_string_equal(r.warning[0], "3: triangle with a corner that is not "
                                    "finite, skipped");
  assert_memory_equal(r.warning[3], "6: ", 3);
  reading_fini(&r);
}

static void a_file_of_the_right_size_is_binary(void **state) {
  (void)state;
  static const char *const headers[] = {
      "solid cube", "solid\n facet normal 0 0 1\n  outer loop\n", ""};
  for (int i = 0; i < 3; i++) {
    struct binary *binary = start_binary(headers[i]);
    add_square(binary);
    struct reading r;
    read_binary(&r, binary);
    assert_read(&r);
    assert_int_equal(scene_face_count(&r.scene), 2);
    assert_string_equal(r.scene.group.item[0].name, "default");
    reading_fini(&r);
  }
}

static void a_binary_file_without_triangles_is_empty(void **state) {
  (void)state;
  struct reading r;
  read_binary(&r, start_binary("nothing"));
  assert_read(&r);
  assert_int_equal(r.scene.point.count, 0);
  assert_int_equal(scene_face_count(&r.scene), 0);
  reading_fini(&r);
}

static void a_truncated_binary_file_is_an_error(void **state) {
  (void)state;
  struct binary *binary = start_binary("solid, it says");
  add_square(binary);
  assert_broken(binary->bytes, 183, 2,
                "binary STL cut short: it says 2 triangles and has 1");
  assert_broken(binary->bytes, 134, 2,
                "binary STL cut short: it says 2 triangles and has 1");
  assert_broken(binary->bytes, 84, 1,
                "binary STL cut short: it says 2 triangles and has 0");
  assert_broken(binary->bytes, 83, 1, NEITHER);
  assert_broken(binary->bytes, 1, 1, NEITHER);
  binary->bytes[binary->count] = 'x';
  assert_broken(binary->bytes, 185, 3,
                "binary STL with 1 bytes after the 2 triangles that it says "
                "it has");
}

/* Four thousand million triangles in a hundred bytes: reported at once, and
 * without taking any memory for them. */
static void a_size_is_checked_before_memory_is_taken(void **state) {
  (void)state;
  struct binary *binary = start_binary("too many");
  put_uint32(binary->bytes + 80, UINT32_C(4000000000));
  mem_fail_after(1);
  assert_broken(binary->bytes, 100, 1,
                "binary STL cut short: it says 4000000000 triangles and has "
                "0");
}

/* ---- Text ---------------------------------------------------------------- */

#define FACET(a, b, c)                                                         \
  " facet normal 0 0 1\n  outer loop\n   vertex " a "\n   vertex " b           \
  "\n   vertex " c "\n  endloop\n endfacet\n"
#define SQUARE FACET("0 0 0", "1 0 0", "1 1 0") FACET("0 0 0", "1 1 0", "0 1 0")

static void read_text(struct reading *r, const char *text) {
  reading_of(r, &reader_stl, text);
  assert_read(r);
}

static void text_is_welded_by_position(void **state) {
  (void)state;
  struct reading r;
  read_text(&r, "solid cube\n" SQUARE FACET("1 1 -0.0", "1.0 1e0 1e-300",
                                            "-0 1 0") "endsolid cube\n");
  static const uint32_t corner[9] = {0, 1, 2, 0, 2, 3, 2, 4, 3};
  assert_int_equal(r.scene.point.count, 5);
  assert_memory_equal(r.scene.corner.item, corner, sizeof corner);
  assert_int_equal(r.warnings, 0);
  reading_fini(&r);
}

static void each_solid_is_a_group(void **state) {
  (void)state;
  struct reading r;
  read_text(&r, "solid  left part \r\n" SQUARE "endsolid\r\n"
                "\nsolid right\n" SQUARE "endsolid right\n"
                "solid\n" SQUARE "endsolid\nsolid right\n" SQUARE "endsolid");
  static const uint32_t group[8] = {0, 0, 1, 1, 2, 2, 1, 1};
  assert_int_equal(scene_face_count(&r.scene), 8);
  for (uint32_t f = 0; f < 8; f++)
    assert_int_equal(scene_face_group(&r.scene, f), group[f]);
  assert_string_equal(r.scene.group.item[0].name, "left part");
  assert_string_equal(r.scene.group.item[1].name, "right");
  assert_string_equal(r.scene.group.item[2].name, "default");
  assert_int_equal(r.scene.point.count, 4);
  reading_fini(&r);
}

static void names_may_be_anywhere_in_any_case(void **state) {
  (void)state;
  struct reading r;
  read_text(&r, "\n  SOLID A facet\nFacet Normal 0 0 1 OUTER LOOP Vertex 0 0 0 "
                "vertex 1 0 0\tVERTEX 1\n1\n0 endLoop EndFacet\rfacet outer "
                "loop vertex 0 0 1 vertex 1 0 1 vertex 1 1 1 vertex 0 1 1 "
                "endloop endfacet EndSolid");
  assert_int_equal(scene_face_count(&r.scene), 2);
  assert_int_equal(r.scene.corner.count, 7);
  assert_string_equal(r.scene.group.item[0].name, "A facet");
  reading_fini(&r);
}

static void lines_may_end_as_on_any_system(void **state) {
  (void)state;
  static const char *const end_of_line[] = {"\n", "\r\n", "\r"};
  static const char *const lines[] = {
      "solid left part", "facet outer loop", "vertex 0 0 0", "vertex 1 0 0",
      "vertex 1 1 0",    "endloop endfacet", "facet",        "outer loop",
      "vertex 1 x 2",    "endloop endfacet", "endsolid"};
  for (int i = 0; i < 3; i++) {
    struct reading r;
    char text[1000] = "";
    for (size_t k = 0; k < sizeof lines / sizeof lines[0]; k++) {
      strcat(text, lines[k]);
      strcat(text, end_of_line[i]);
    }
    read_text(&r, text);
    assert_int_equal(scene_face_count(&r.scene), 1);
    assert_string_equal(r.scene.group.item[0].name, "left part");
    assert_string_equal(r.warning[0], "7: facet with a coordinate that is no "
                                      "number, skipped");
    reading_fini(&r);
  }
}

static void a_byte_order_mark_may_stand_before_text(void **state) {
  (void)state;
  struct reading r;
  read_text(&r, "\xef\xbb\xbfsolid left\n" SQUARE "endsolid left\n");
  assert_int_equal(scene_face_count(&r.scene), 2);
  assert_string_equal(r.scene.group.item[0].name, "left");
  reading_fini(&r);
}

static void invalid_facets_are_skipped(void **state) {
  (void)state;
  struct reading r;
  read_text(&r, "solid\n" SQUARE FACET("0 0 0", "nan 0 0", "1 1 0")
                    FACET("0 0 0", "1 0 0",
                          "1 1e999 0") FACET("0 0 0", "1 0 zero", "1 1 0")
                        FACET("0 0 0", "1 0 0", "2 0 0")
                            FACET("0 0 0", "1 0 0", "1 0 0")
                                FACET("0 0 2", "1 0 2", "1 1 2") "endsolid\n");
  assert_int_equal(scene_face_count(&r.scene), 3);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_NOT_FINITE], 2);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_SYNTAX], 1);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_ZERO_AREA], 1);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_FEW_CORNERS], 1);
  assert_string_equal(r.warning[0],
                      "16: facet with a corner that is not finite, skipped");
  assert_string_equal(r.warning[2],
                      "30: facet with a coordinate that is no number, skipped");
  assert_memory_equal(r.warning[3], "37: ", 4);
  reading_fini(&r);
}

static void text_that_stops_is_an_error(void **state) {
  (void)state;
  static const char text[] = "solid a\n" SQUARE "endsolid a\n";
  size_t whole = sizeof text - 1 - strlen(" a\n");
  for (size_t count = 0; count <= whole; count++) {
    struct reading r;
    unsigned long line = 1;
    for (size_t i = 0; i < count; i++)
      line += text[i] == '\n';
    reading_init(&r);
    recto_status status = reading_bytes(&r, &reader_stl, text, count);
    assert_int_equal(status, count < whole ? RECTO_ERROR_FORMAT : RECTO_OK);
    if (count > 0 && count < whole)
      assert_int_equal(r.error.line, line);
    reading_fini(&r);
  }
  ASSERT_BROKEN("solid a\n facet normal 0 0 1\n  outer loop\n   vertex 1 2", 4,
                "the file ends where 'a coordinate' should follow");
  ASSERT_BROKEN("solid a\n" SQUARE, 16,
                "the file ends where 'facet' should follow");
}

static void text_out_of_order_is_an_error(void **state) {
  (void)state;
  ASSERT_BROKEN("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                "vertex 1 0\nvertex 1 1 0\nendloop\nendfacet\nendsolid\n",
                6, "'1' where 'vertex' should stand");
  ASSERT_BROKEN("solid a\nfacet normal 0 0 1 2 outer loop\n", 2,
                "'2' where 'outer' should stand");
  ASSERT_BROKEN("solid a\nendfacet\n", 2,
                "'endfacet' where 'facet' should "
                "stand");
  ASSERT_BROKEN("solid a\nendsolid a\nmore\n", 3,
                "'more' where 'solid' should stand");
}

static void other_text_is_an_error(void **state) {
  (void)state;
  ASSERT_BROKEN("v 0 0 0\n", 1, NEITHER);
  ASSERT_BROKEN("solid\0x", 1, NEITHER);
  ASSERT_BROKEN("solidity\n", 1, "'solidity' where 'solid' should stand");
}

/* Long enough to have a count of triangles, if it were binary. */
static void long_text_is_not_taken_for_a_count(void **state) {
  (void)state;
  ASSERT_BROKEN("# a model of another kind, by somebody who gave it this name\n"
                "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n# end\n",
                1, NEITHER);
}

static void a_decimal_comma_changes_nothing(void **state) {
  (void)state;
  if (!comma_locale_on()) {
    print_message("no locale with a decimal comma\n");
    skip();
  }
  struct reading r;
  reading_of(&r, &reader_stl,
             "solid\n" FACET("0.5 0 0", "1.5 0 0", "1 1.25 0") "endsolid\n");
  comma_locale_off();
  assert_read(&r);
  assert_true(r.scene.point.item[0].x == 0.5);
  assert_true(r.scene.point.item[2].y == 1.25);
  reading_fini(&r);
}

/* ---- Memory -------------------------------------------------------------- */

static void run_out_of_memory(const char *bytes, size_t count) {
  struct memory_faults faults = {.least = 6};
  while (memory_faults_go_on(&faults)) {
    struct reading r;
    reading_init(&r);
    memory_faults_begin(&faults);
    recto_status status = reading_bytes(&r, &reader_stl, bytes, count);
    memory_faults_end(&faults, status);
    assert_int_equal(r.error.code, status);
    assert_null(reading_fault(&r.scene));
    reading_fini(&r);
  }
}

static void running_out_of_memory_is_an_error(void **state) {
  (void)state;
  struct random random = {2};
  struct binary *binary = start_binary("");
  for (int i = 0; i < 500; i++) {
    float p[9];
    for (int k = 0; k < 9; k++)
      p[k] = (float)random_unit(&random);
    add_triangle(binary, p);
  }
  run_out_of_memory(binary->bytes, binary->count);
  static const char text[] =
      "solid a\n" SQUARE
      "endsolid\nsolid b\n" FACET("0 0 0", "1 0 5", "1 1 0") "endsolid\n";
  run_out_of_memory(text, sizeof text - 1);
}

int main(void) {
#define T(name) cmocka_unit_test_teardown(name, tear_down)
  const struct CMUnitTest tests[] = {
      T(triangles_are_welded_by_position),
      T(minus_zero_is_zero),
      T(many_triangles_are_welded_as_by_comparison),
      T(several_threads_weld_as_one_does),
      T(invalid_triangles_are_skipped),
      T(a_file_of_the_right_size_is_binary),
      T(a_binary_file_without_triangles_is_empty),
      T(a_truncated_binary_file_is_an_error),
      T(a_size_is_checked_before_memory_is_taken),
      T(text_is_welded_by_position),
      T(each_solid_is_a_group),
      T(names_may_be_anywhere_in_any_case),
      T(lines_may_end_as_on_any_system),
      T(a_byte_order_mark_may_stand_before_text),
      T(invalid_facets_are_skipped),
      T(text_that_stops_is_an_error),
      T(text_out_of_order_is_an_error),
      T(other_text_is_an_error),
      T(long_text_is_not_taken_for_a_count),
      T(a_decimal_comma_changes_nothing),
      T(running_out_of_memory_is_an_error),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
