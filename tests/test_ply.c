/* test_ply.c - PLY files, text and binary: known elements are read, others are
 * skipped, and the counts of headers are not trusted. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/corner_normals.h"
#include "scene/ply/ply_colour.h"
#include "scene/read.h"
#include "tests/memory_faults.h"
#include "tests/reading.h"
#include "tests/temporary.h"

#define XYZ "property float x\nproperty float y\nproperty float z\n"
#define CORNERS "property list uchar int vertex_indices\n"

static void assert_read(const struct reading *r) {
  if (r->status != RECTO_OK)
    fail_msg("line %lu: %s", r->error.line, r->error.text);
  assert_null(reading_fault(&r->scene));
}

static void read_text(struct reading *r, const char *text) {
  reading_of(r, &reader_ply, text);
  assert_read(r);
}

static void assert_refused(const char *text, unsigned long line,
                           const char *why) {
  struct reading r;
  reading_of(&r, &reader_ply, text);
  assert_int_equal(r.status, RECTO_ERROR_FORMAT);
  if (r.error.line != line || !strstr(r.error.text, why))
    fail_msg("line %lu: '%s', not line %lu: '%s'", r.error.line, r.error.text,
             line, why);
  reading_fini(&r);
}

static const struct scene_point *corner(const struct reading *r, uint32_t face,
                                        uint32_t k) {
  uint32_t at = scene_face_start(&r->scene, face) + k;
  return &r->scene.point.item[r->scene.corner.item[at]];
}

/* ---- Files as text
 * -------------------------------------------------------- */

struct file {
  char bytes[4096];
  size_t count;
  bool big_endian;
};

static void put_text(struct file *file, const char *text) {
  memcpy(file->bytes + file->count, text, strlen(text));
  file->count += strlen(text);
}

/* Puts the bytes of a number of this machine in the file's order. */
static void put_bytes(struct file *file, const void *bytes, size_t count) {
  static const uint16_t one = 1;
  bool here_big = *(const unsigned char *)&one == 0;
  for (size_t i = 0; i < count; i++) {
    size_t from = here_big == file->big_endian ? i : count - 1 - i;
    file->bytes[file->count++] = ((const char *)bytes)[from];
  }
}

static void put_number(struct file *file, const char *type, double value) {
#define AS(name, c_type)                                                       \
  if (strcmp(type, name) == 0) {                                               \
    c_type number = (c_type)value;                                             \
    put_bytes(file, &number, sizeof number);                                   \
    return;                                                                    \
  }
  AS("char", int8_t)
  AS("int8", int8_t)
  AS("uchar", uint8_t)
  AS("uint8", uint8_t)
  AS("short", int16_t)
  AS("int16", int16_t)
  AS("ushort", uint16_t)
  AS("uint16", uint16_t)
  AS("int", int32_t)
  AS("int32", int32_t)
  AS("uint", uint32_t)
  AS("uint32", uint32_t)
  AS("float", float)
  AS("float32", float)
  AS("double", double)
  AS("float64", double)
#undef AS
  fail_msg("type %s", type);
}

/* A square and a triangle above it, of any types. */
static void make_file(struct file *file, bool big_endian, const char *position,
                      const char *count, const char *index) {
  static const int at[5][3] = {
      {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}};
  static const int face[2][5] = {{4, 0, 1, 2, 3}, {3, 0, 1, 4, 0}};
  memset(file, 0, sizeof *file);
  file->big_endian = big_endian;
  file->count = (size_t)sprintf(
      file->bytes,
      "ply\nformat binary_%s_endian 1.0\ncomment by hand\nelement vertex 5\n"
      "property %s x\nproperty %s y\nproperty short other\nproperty %s z\n"
      "obj_info none\nelement odd 2\nproperty list uchar short values\n"
      "property double more\nelement face 2\nproperty uchar flags\n"
      "property list %s %s vertex_indices\n"
      "property list uchar float texcoord\nend_header\n",
      big_endian ? "big" : "little", position, position, position, count,
      index);
  for (int i = 0; i < 5; i++) {
    put_number(file, position, at[i][0]);
    put_number(file, position, at[i][1]);
    put_number(file, "short", 77);
    put_number(file, position, at[i][2]);
  }
  for (int i = 0; i < 2; i++) {
    put_number(file, "uchar", 2 * i);
    for (int k = 0; k < 2 * i; k++)
      put_number(file, "short", k);
    put_number(file, "double", 1);
  }
  for (int i = 0; i < 2; i++) {
    put_number(file, "uchar", 9);
    put_number(file, count, face[i][0]);
    for (int k = 0; k < face[i][0]; k++)
      put_number(file, index, face[i][k + 1]);
    put_number(file, "uchar", 2);
    put_number(file, "float", 0.5);
    put_number(file, "float", 0.25);
  }
}

static void assert_square_and_triangle(const struct reading *r) {
  assert_read(r);
  assert_int_equal(r->warnings, 0);
  assert_int_equal(r->scene.point.count, 5);
  assert_int_equal(scene_face_count(&r->scene), 2);
  assert_int_equal(scene_face_start(&r->scene, 1), 4);
  assert_int_equal(scene_face_start(&r->scene, 2), 7);
  assert_true(corner(r, 0, 2)->x == 2 && corner(r, 0, 2)->y == 2);
  assert_true(corner(r, 1, 2)->x == 1 && corner(r, 1, 2)->z == 3);
}

static void binary_files_of_all_types_are_read(void **state) {
  static const char *const type[] = {"char",  "uchar",  "short",   "ushort",
                                     "int",   "uint",   "float",   "double",
                                     "int8",  "uint8",  "int16",   "uint16",
                                     "int32", "uint32", "float32", "float64"};
  enum { TYPES = sizeof type / sizeof *type };
  (void)state;
  for (int i = 0; i < 2 * TYPES; i++) {
    struct file file;
    struct reading r;
    make_file(&file, i >= TYPES, type[i % TYPES], type[(i + 3) % TYPES],
              type[(i + 5) % TYPES]);
    reading_init(&r);
    (void)reading_bytes(&r, &reader_ply, file.bytes, file.count);
    assert_square_and_triangle(&r);
    reading_fini(&r);
  }
}

/* The number is that of the element that is not whole. */
static void a_binary_file_cut_short_is_an_error(void **state) {
  struct file file;
  (void)state;
  make_file(&file, false, "float", "uchar", "int");
  size_t body = (size_t)(strstr(file.bytes, "end_header\n") - file.bytes) + 11;
  for (size_t count = body; count < file.count; count++) {
    struct reading r;
    reading_init(&r);
    assert_int_equal(reading_bytes(&r, &reader_ply, file.bytes, count),
                     RECTO_ERROR_FORMAT);
    assert_non_null(strstr(r.error.text, "PLY file cut short: it says"));
    if (count - body < 5 * 14)
      assert_int_equal(r.error.line, (count - body) / 14 + 1);
    reading_fini(&r);
  }
}

static void text_files_are_read(void **state) {
  struct reading r;
  (void)state;
  read_text(&r,
            "ply\nformat ascii 1.0\ncomment a\nelement vertex 5\n" XYZ
            "property uchar other\nelement face 2\nproperty int flags\n" CORNERS
            "end_header\n0 0 0 1\n2.0 0 0 1\n\n 2 2e0 0 1 \n0 2 -0 1\n"
            "1 1 +3 1 more values\n9 4 0 1 2 3\n-9 3 0 1 4.0\n");
  assert_square_and_triangle(&r);
  reading_fini(&r);
}

static void lines_may_end_as_on_any_system(void **state) {
  static const char text[] =
      "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ "element face 1\n" CORNERS
      "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2";
  char other[2 * sizeof text];
  struct reading r;
  (void)state;
  for (int way = 0; way < 3; way++) {
    char *to = other;
    for (const char *from = text; *from; from++) {
      if (*from == '\n' && way > 0)
        *to++ = '\r';
      if (*from != '\n' || way < 2)
        *to++ = *from;
    }
    *to = '\0';
    read_text(&r, other);
    assert_int_equal(r.warnings, 0);
    assert_int_equal(scene_face_count(&r.scene), 1);
    reading_fini(&r);
  }
}

/* A carriage return is one of the line's end, a line feed then a number. */
static void binary_data_may_begin_as_a_line_ends(void **state) {
  for (int way = 0; way < 2; way++) {
    struct file file = {.count = 0};
    const char *end = way ? "\r" : "\r\n";
    const char *line[] = {"ply",
                          "format binary_little_endian 1.0",
                          "element vertex 3",
                          "property char x",
                          "property char y",
                          "property char z",
                          "element face 1",
                          "property list char char vertex_index",
                          "end_header"};
    (void)state;
    for (size_t i = 0; i < sizeof line / sizeof *line; i++) {
      put_text(&file, line[i]);
      put_text(&file, end);
    }
    memcpy(file.bytes + file.count, "\n\0\0\r\0\0\n\n\0\3\0\1\2", 13);
    struct reading r;
    reading_init(&r);
    (void)reading_bytes(&r, &reader_ply, file.bytes, file.count + 13);
    assert_read(&r);
    assert_int_equal(scene_face_count(&r.scene), 1);
    assert_true(corner(&r, 0, 0)->x == 10 && corner(&r, 0, 1)->x == 13);
    reading_fini(&r);
  }
}

static void faces_may_stand_before_their_vertices(void **state) {
  struct reading r;
  (void)state;
  read_text(&r, "ply\nformat ascii 1.0\nelement face 1\n" CORNERS
                "element vertex 3\n" XYZ
                "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
                "end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n0 2\n");
  assert_int_equal(scene_face_count(&r.scene), 1);
  assert_int_equal(scene_wire_count(&r.scene), 1);
  assert_int_equal(r.warnings, 0);
  reading_fini(&r);
}

static void edges_are_polylines(void **state) {
  struct reading r;
  (void)state;
  read_text(&r, "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ
                "element edge 3\nproperty uchar red\nproperty uint vertex1\n"
                "property uint vertex2\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
                "5 0 1\n5 1 2\n5 1 3\n");
  assert_int_equal(scene_wire_count(&r.scene), 2);
  assert_int_equal(r.scene.wire_corner.item[3], 2);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_INDEX], 1);
  assert_string_equal(r.warning[0], "17: edge with index 3 where there are 3 "
                                    "points, skipped");
  reading_fini(&r);
}

/* Two strips in one list, the second of a triangle; all have the same
 * winding. */
static void strips_become_triangles(void **state) {
  struct reading r;
  (void)state;
  read_text(&r, "ply\nformat ascii 1.0\nelement vertex 5\n" XYZ
                "element tristrips 1\nproperty list int int vertex_indices\n"
                "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n"
                "11 0 1 2 3 3 -1 1 3 2 -1 4\n");
  assert_int_equal(scene_face_count(&r.scene), 3);
  assert_int_equal(r.warnings, 0);
  for (uint32_t f = 0; f < 3; f++) {
    const struct scene_point *a = corner(&r, f, 0), *b = corner(&r, f, 1),
                             *c = corner(&r, f, 2);
    assert_true((b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x) >
                0);
  }
  reading_fini(&r);
}

/* ---- Normals ------------------------------------------------------------- */

#define NORMAL "property float nx\nproperty float ny\nproperty float nz\n"

static void read_with_normals(struct reading *r, const char *text) {
  reading_init(r);
  r->scene.needs_crease_marks = true;
  (void)reading_bytes(r, &reader_ply, text, strlen(text));
  assert_read(r);
}

static const char face_with_normals[] =
    "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ NORMAL
    "element face 1\n" CORNERS "end_header\n0 0 0 0 0 3\n1 0 0 nan 0 1\n"
    "1 1 0 -2 0 0\n3 0 1 2\n";

static void vertices_give_corners_their_normals(void **state) {
  struct reading r;
  (void)state;
  read_with_normals(&r, face_with_normals);
  assert_int_equal(corner_normal_of(&r.scene, 0),
                   corner_normal_encode(0, 0, 1));
  assert_int_equal(corner_normal_of(&r.scene, 1), 0);
  assert_int_equal(corner_normal_of(&r.scene, 2),
                   corner_normal_encode(-1, 0, 0));
  reading_fini(&r);
}

static void normals_that_are_not_wanted_take_no_memory(void **state) {
  struct reading r;
  (void)state;
  reading_init(&r);
  r.scene.needs_crease_marks = false;
  (void)reading_bytes(&r, &reader_ply, face_with_normals,
                      strlen(face_with_normals));
  assert_read(&r);
  assert_int_equal(r.scene.point_normal.count, 0);
  reading_fini(&r);
}

/* Two of three coordinates, or a list for one of them, are no normal. */
static void normals_that_make_no_sense_are_none(void **state) {
  static const char *const text[] = {
      "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ
      "property float nx\nproperty float ny\nelement face 1\n" CORNERS
      "end_header\n0 0 0 0 3\n1 0 0 0 1\n1 1 0 -2 0\n3 0 1 2\n",
      "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ
      "property float nx\nproperty float ny\n"
      "property list uchar float nz\nelement face 1\n" CORNERS
      "end_header\n0 0 0 0 3 0\n1 0 0 0 1 1 2\n1 1 0 -2 0 0\n3 0 1 2\n"};
  (void)state;
  for (int i = 0; i < 2; i++) {
    struct reading r;
    read_with_normals(&r, text[i]);
    assert_int_equal(scene_face_count(&r.scene), 1);
    assert_int_equal(r.scene.point_normal.count, 0);
    reading_fini(&r);
  }
}

/* ---- Colours ------------------------------------------------------------- */

static void read_coloured(struct reading *r, const char *text) {
  reading_init(r);
  r->scene.needs_colours = true;
  (void)reading_bytes(r, &reader_ply, text, strlen(text));
  assert_read(r);
}

static uint32_t colour_of(const struct reading *r, uint32_t face) {
  const struct scene_group *group =
      &r->scene.group.item[scene_face_group(&r->scene, face)];
  return group->has_colour ? group->colour : PLY_NO_COLOUR;
}

static const char faces_in_colour[] =
    "ply\nformat ascii 1.0\nelement vertex 4\n" XYZ "element face 3\n" CORNERS
    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 16\n"
    "3 0 2 3 1 2 3\n3 0 1 3 255 0 16\n";

static void faces_of_one_colour_are_a_group(void **state) {
  struct reading r;
  (void)state;
  read_coloured(&r, faces_in_colour);
  assert_int_equal(colour_of(&r, 0), 0xff0010);
  assert_int_equal(colour_of(&r, 1), 0x010203);
  assert_int_equal(scene_face_group(&r.scene, 0),
                   scene_face_group(&r.scene, 2));
  const struct scene_group *group =
      &r.scene.group.item[scene_face_group(&r.scene, 0)];
  assert_string_equal(group->name, "colour #ff0010");
  reading_fini(&r);
}

static void colours_that_are_not_wanted_make_no_groups(void **state) {
  struct reading r;
  (void)state;
  read_text(&r, faces_in_colour);
  assert_int_equal(r.scene.group.count, 1);
  reading_fini(&r);
}

static void a_face_has_the_mean_colour_of_its_corners(void **state) {
  struct reading r;
  (void)state;
  read_coloured(&r, "ply\nformat ascii 1.0\nelement vertex 4\n" XYZ
                    "property float red\nproperty ushort green\n"
                    "property uchar blue\nelement face 2\n" CORNERS
                    "end_header\n0 0 0 1 65535 10\n1 0 0 1 65535 10\n"
                    "1 1 0 1 65535 10\n0 1 0 0 0 70\n3 0 1 2\n3 0 2 3\n");
  assert_int_equal(colour_of(&r, 0), 0xffff0a);
  assert_int_equal(colour_of(&r, 1), 0xaaaa1e); /* two thirds; a third of 90 */
  reading_fini(&r);
}

static void colours_that_make_no_sense_are_within_bounds(void **state) {
  struct reading r;
  (void)state;
  read_coloured(&r, "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ
                    "property float red\nproperty double green\n"
                    "property int blue\nelement face 1\n" CORNERS
                    "end_header\n0 0 0 nan -7 999\n1 0 0 nan -inf 999\n"
                    "1 1 0 nan -1 256\n3 0 1 2\n");
  assert_int_equal(colour_of(&r, 0), 0x0000ff);
  reading_fini(&r);
}

/* A scan: each vertex has a colour of its own. */
static void many_colours_make_few_groups(void **state) {
  enum { SIDE = 120, ROOM = SIDE * SIDE * 100 };
  char *text = malloc(ROOM), *to = text;
  (void)state;
  assert_non_null(text);
  to += sprintf(to,
                "ply\nformat ascii 1.0\nelement vertex %d\n" XYZ
                "property uchar red\nproperty uchar green\n"
                "property uchar blue\nelement face %d\n" CORNERS "end_header\n",
                SIDE * SIDE, (SIDE - 1) * (SIDE - 1));
  for (int i = 0; i < SIDE; i++)
    for (int k = 0; k < SIDE; k++)
      to += sprintf(to, "%d %d 0 %d %d %d\n", k, i, 2 * i, 2 * k, i + k);
  for (int i = 1; i < SIDE; i++)
    for (int k = 1; k < SIDE; k++)
      to += sprintf(to, "4 %d %d %d %d\n", (i - 1) * SIDE + k - 1,
                    (i - 1) * SIDE + k, i * SIDE + k, i * SIDE + k - 1);
  struct reading r;
  read_coloured(&r, text);
  assert_in_range(r.scene.group.count, 500, PLY_COLOUR_MAX + 1);
  /* No face is far from its own colour. */
  for (uint32_t f = 0; f < scene_face_count(&r.scene); f++) {
    int i = (int)f / (SIDE - 1), red = (int)(colour_of(&r, f) >> 16);
    assert_in_range(red - 2 * i + 100, 92, 108);
  }
  reading_fini(&r);
  free(text);
}

/* The colours that are distinguished make no lines on the surface. */
static void colours_make_no_lines(void **state) {
  struct reading r;
  (void)state;
  read_coloured(&r, faces_in_colour);
  uint32_t a = scene_face_group(&r.scene, 0), b = scene_face_group(&r.scene, 1);
  assert_int_not_equal(a, b);
  assert_false(scene_groups_differ(&r.scene, a, b));
  assert_true(scene_groups_differ(&r.scene, a, 0));
  reading_fini(&r);
}

/* ---- Precision ----------------------------------------------------------- */

static struct precision precision_of(const struct reading *r) {
  static const struct precision unstated = {7, 7};
  return scene_point_precision(&r->scene, 0, unstated);
}

static void the_type_of_positions_says_their_precision(void **state) {
  static const struct {
    const char *type;
    double relative;
  } row[] = {{"float", 0x1p-24}, {"double", 0x1p-53}, {"short", 0}};
  (void)state;
  for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
    struct file file;
    struct reading r;
    make_file(&file, i == 1, row[i].type, "uchar", "int");
    reading_init(&r);
    (void)reading_bytes(&r, &reader_ply, file.bytes, file.count);
    assert_read(&r);
    assert_true(precision_of(&r).relative == row[i].relative);
    assert_true(precision_of(&r).absolute == 0);
    reading_fini(&r);
  }
}

static void the_decimals_of_a_text_say_its_precision(void **state) {
  struct reading r;
  (void)state;
  read_text(&r,
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float w\n" XYZ
            "end_header\n0.5 10.123456 20.654321 0.987654\n"
            "1 11.345678 19.123789 0.333777\n1 0.111222 9.222333 "
            "7.555666\n");
  assert_true(precision_of(&r).absolute > 0.4e-6 &&
              precision_of(&r).absolute < 0.6e-6);
  reading_fini(&r);
}

/* ---- What is wrong ------------------------------------------------------- */

static void broken_headers_are_reported_by_their_line(void **state) {
  (void)state;
  assert_refused("", 1, "first line is not 'ply'");
  assert_refused("plyx\n", 1, "first line is not 'ply'");
  assert_refused("ply", 1, "first line is not 'ply'");
  assert_refused("ply\n", 2, "no line says end_header");
  assert_refused("ply\nend_header\n", 2, "no line says the format");
  assert_refused("ply\nformat ascii 2.0\n", 2, "'2.0' where 1.0 should stand");
  assert_refused("ply\nformat text 1.0\n", 2, "'text' where ascii");
  assert_refused("ply\nformat ascii 1.0\nend1 0 0\n", 3,
                 "'end1' where a line of a header should stand");
  assert_refused("ply\nproperty float x\n", 2, "a property of no element");
  assert_refused("ply\nelement vertex\n", 2,
                 "the line ends where a number of elements should stand");
  assert_refused("ply\nelement vertex -1\n", 2, "'-1' where a number");
  assert_refused("ply\nelement vertex 99999999999999999999\n", 2,
                 "where a number of elements should stand");
  assert_refused("ply\nelement vertex 1\nproperty real x\n", 3,
                 "'real' where the type of a number should stand");
  assert_refused("ply\nelement vertex 1\nproperty float x\nproperty int x\n", 4,
                 "property x is there twice");
  assert_refused("ply\nelement vertex 1\nproperty list int float x\n", 3,
                 "property x is a list, not a single value");
  assert_refused("ply\nelement face 1\nproperty int vertex_indices\n", 3,
                 "property vertex_indices is a single value, not a list");
  assert_refused("ply\nelement vertex 1\nelement vertex 1\n", 3,
                 "a second element vertex");
  assert_refused("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                 "end_header\n",
                 5, "a vertex has not all of x, y and z");
  assert_refused("ply\nformat ascii 1.0\nelement vertex 1\n" XYZ
                 "element face 1\nend_header\n",
                 8, "a face has no list of vertex_indices");
  assert_refused("ply\nformat ascii 1.0\nend_header\n", 3, "no element vertex");
}

static void counts_that_the_file_cannot_hold_take_no_memory(void **state) {
  (void)state;
  assert_refused(
      "ply\nformat ascii 1.0\nelement vertex 9000000000000000000\n" XYZ
      "end_header\n1 2 3\n",
      9, "it says 9000000000000000000 of element vertex and has 1");
  assert_refused("ply\nformat binary_big_endian 1.0\n"
                 "element vertex 4000000000\n" XYZ "end_header\n0123456789ab",
                 2, "it says 4000000000 of element vertex and has 1");
  assert_refused("ply\nformat binary_little_endian 1.0\nelement vertex 0\n" XYZ
                 "element face 3000000000\n"
                 "property list int int vertex_indices\nend_header\n~~~~1234",
                 1, "it says 3000000000 of element face and has 0");
  /* A count below zero. */
  assert_refused("ply\nformat binary_little_endian 1.0\nelement vertex 0\n" XYZ
                 "element face 1\nproperty list char int vertex_indices\n"
                 "end_header\n\xff\xff\xff\xff\xff",
                 1, "it says 1 of element face and has 0");
  /* Elements of nothing are none, however many. */
  struct reading r;
  read_text(&r, "ply\nformat binary_little_endian 1.0\n"
                "element nothing 4000000000000\nelement vertex 0\n" XYZ
                "end_header\n");
  reading_fini(&r);
}

static void elements_that_make_no_sense_are_skipped(void **state) {
  struct reading r;
  (void)state;
  read_text(&r, "ply\nformat ascii 1.0\nelement vertex 6\n" XYZ
                "element face 9\n" CORNERS "end_header\n"
                "0 0 0\n1 0 0\n0 1 0\nnan 0 0\n0 0\n0 0 x\n"
                "3 0 1 2\n3 0 1 3\n3 0 1 4\n3 0 1 6\n3 0 1 -1\n-3 0 1 2\n"
                "3 0 1\n2 0 1\n99999999999 0 1 2\n");
  assert_int_equal(scene_face_count(&r.scene), 1);
  assert_int_equal(r.scene.point.count, 6);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_NOT_FINITE], 3);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_INDEX], 2);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_SYNTAX], 2 + 3);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_FEW_CORNERS], 1);
  assert_string_equal(r.warning[0],
                      "13: vertex that is not finite; its faces are skipped");
  assert_string_equal(r.warning[1], "14: vertex that cannot be parsed, "
                                    "skipped");
  reading_fini(&r);
}

static void a_face_of_no_corners_is_skipped(void **state) {
  struct reading r;
  (void)state;
  read_text(&r, "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ
                "element face 1\n" CORNERS
                "element edge 1\nproperty list uchar int vertex_index\n"
                "end_header\n0 0 0\n0\n0\n");
  assert_int_equal(scene_face_count(&r.scene), 0);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_FEW_CORNERS], 2);
  reading_fini(&r);
}

static void a_text_cut_short_is_an_error(void **state) {
  static const char text[] =
      "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ "element face 2\n" CORNERS
      "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n";
  size_t body = (size_t)(strstr(text, "end_header\n") - text) + 11;
  (void)state;
  for (size_t count = 0; count < sizeof text - 2; count++) {
    struct reading r;
    reading_init(&r);
    recto_status status = reading_bytes(&r, &reader_ply, text, count);
    /* A file without its last line end is whole. */
    if (status == RECTO_OK || r.error.line == 0)
      fail_msg("%zu bytes", count);
    if (count >= body)
      assert_non_null(strstr(r.error.text, "PLY file cut short"));
    reading_fini(&r);
  }
}

static void binary_data_in_a_text_are_an_error(void **state) {
  (void)state;
  assert_refused("ply\nformat ascii 1.0\nelement vertex 2\n" XYZ "end_header\n"
                 "0 0 0\n\x01\x02\x03\n",
                 9, "the header says ascii, but the data are not text");
}

/* What crashed an importer, and what it never came back from: headers that
 * lost their end. */
static void headers_without_their_end_are_refused(void **state) {
  (void)state;
  assert_refused("ply\nformat binary_little_endian 1.0\nelement vertex 8\n" XYZ
                 "element face 6\nproperty list uchar int vertex_indicend_"
                 "header\nxxxxxxxx\n",
                 9, "where a line of a header should stand");
  assert_refused("ply\nformat ascii 1.0\nelement vertex 8\n" XYZ
                 "element face 6\n" CORNERS "end1 0 0\n0 1 0\n1 1 0\n0 0 1\n"
                 "40 0 2 3 1\n4 4 5 7 6\n",
                 9, "'end1' where a line of a header should stand");
}

static void running_out_of_memory_is_an_error(void **state) {
  struct reading r;
  (void)state;
  struct memory_faults faults = {.least = 10};
  while (memory_faults_go_on(&faults)) {
    reading_init(&r);
    r.scene.needs_colours = true;
    memory_faults_begin(&faults);
    recto_status status = reading_bytes(&r, &reader_ply, faces_in_colour,
                                        sizeof faces_in_colour - 1);
    memory_faults_end(&faults, status);
    reading_fini(&r);
  }
}

/* Vertices of a second file follow those of the first. */
static void a_second_file_is_added(void **state) {
  const char *path = temporary_file(state, "a.PLY", faces_in_colour,
                                    sizeof faces_in_colour - 1);
  struct reading r;
  reading_init(&r);
  for (uint32_t i = 1; i <= 2; i++) {
    assert_int_equal(scene_read(&r.scene, path, NULL, NULL, &r.error),
                     RECTO_OK);
    assert_int_equal(scene_face_count(&r.scene), 3 * i);
    assert_int_equal(r.scene.corner.item[9 * (i - 1)], 4 * (i - 1));
    assert_true(r.scene.up[1] == 1);
  }
  assert_null(reading_fault(&r.scene));
  reading_fini(&r);
}

int main(void) {
#define T(name)                                                                \
  cmocka_unit_test_setup_teardown(name, temporary_set_up, temporary_tear_down)
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(binary_files_of_all_types_are_read),
      cmocka_unit_test(a_binary_file_cut_short_is_an_error),
      cmocka_unit_test(text_files_are_read),
      cmocka_unit_test(lines_may_end_as_on_any_system),
      cmocka_unit_test(binary_data_may_begin_as_a_line_ends),
      cmocka_unit_test(faces_may_stand_before_their_vertices),
      cmocka_unit_test(edges_are_polylines),
      cmocka_unit_test(strips_become_triangles),
      cmocka_unit_test(vertices_give_corners_their_normals),
      cmocka_unit_test(normals_that_are_not_wanted_take_no_memory),
      cmocka_unit_test(normals_that_make_no_sense_are_none),
      cmocka_unit_test(faces_of_one_colour_are_a_group),
      cmocka_unit_test(colours_that_are_not_wanted_make_no_groups),
      cmocka_unit_test(a_face_has_the_mean_colour_of_its_corners),
      cmocka_unit_test(colours_that_make_no_sense_are_within_bounds),
      cmocka_unit_test(many_colours_make_few_groups),
      cmocka_unit_test(colours_make_no_lines),
      cmocka_unit_test(the_type_of_positions_says_their_precision),
      cmocka_unit_test(the_decimals_of_a_text_say_its_precision),
      cmocka_unit_test(broken_headers_are_reported_by_their_line),
      cmocka_unit_test(counts_that_the_file_cannot_hold_take_no_memory),
      cmocka_unit_test(elements_that_make_no_sense_are_skipped),
      cmocka_unit_test(a_face_of_no_corners_is_skipped),
      cmocka_unit_test(a_text_cut_short_is_an_error),
      cmocka_unit_test(binary_data_in_a_text_are_an_error),
      cmocka_unit_test(headers_without_their_end_are_refused),
      cmocka_unit_test(running_out_of_memory_is_an_error),
      T(a_second_file_is_added),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
