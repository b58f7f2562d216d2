/* test_obj.c - OBJ files are read into the scene that they describe. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/read.h"
#include "tests/comma_locale.h"
#include "tests/memory_faults.h"
#include "tests/reading.h"
#include "tests/scenes/scenes.h"

static int tear_down(void **state) {
  (void)state;
  mem_fail_after(0);
  return 0;
}

static void read_text(struct reading *r, const char *text) {
  reading_of(r, &reader_obj, text);
  if (r->status != RECTO_OK)
    fail_msg("line %lu: %s", r->error.line, r->error.text);
  const char *fault = reading_fault(&r->scene);
  if (fault != NULL)
    fail_msg("%s", fault);
}

/* Reads a text that must give the same scene as another, without faults. */
static void assert_same(const char *text, const char *plain) {
  struct reading a, b;
  read_text(&a, text);
  read_text(&b, plain);
  assert_int_equal(a.warnings, 0);
  if (!reading_same(&a.scene, &b.scene))
    fail_msg("'%s' is not read as '%s'", text, plain);
  reading_fini(&a);
  reading_fini(&b);
}

static void assert_broken(const char *bytes, size_t count, unsigned long line,
                          const char *text) {
  struct reading r;
  reading_init(&r);
  assert_int_equal(reading_bytes(&r, &reader_obj, bytes, count),
                   RECTO_ERROR_FORMAT);
  assert_int_equal(r.error.code, RECTO_ERROR_FORMAT);
  assert_string_equal(r.error.file, "file");
  assert_int_equal(r.error.line, line);
  assert_string_equal(r.error.text, text);
  reading_fini(&r);
}

#define ASSERT_BROKEN(text, line, message)                                     \
  assert_broken((text), sizeof(text) - 1, (line), (message))

#define POINTS "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

/* ---- Statements ---------------------------------------------------------- */

static void points_are_read_in_every_form(void **state) {
  (void)state;
  struct reading r;
  read_text(&r, "v 1 2 3\nv -1.5 +2e3 .25\nv 1 2 3 0.5\nv 4 5 6 1 0 0.5\n"
                "v\t7\t 8   9 \t\nv 1. 2. -0\n");
  static const double expected[6][3] = {{1, 2, 3}, {-1.5, 2000, 0.25},
                                        {1, 2, 3}, {4, 5, 6},
                                        {7, 8, 9}, {1, 2, 0}};
  assert_int_equal(r.scene.point.count, 6);
  for (int i = 0; i < 6; i++) {
    const struct scene_point *p = &r.scene.point.item[i];
    assert_true(p->x == expected[i][0] && p->y == expected[i][1] &&
                p->z == expected[i][2]);
  }
  assert_int_equal(r.warnings, 0);
  reading_fini(&r);
}

static void faces_are_read_in_every_index_form(void **state) {
  (void)state;
  static const char plain[] = POINTS "f 1 2 3\n";
  assert_same(POINTS "f 1/1 2/2 3/3\n", plain);
  assert_same(POINTS "f 1//1 2//2 3//3\n", plain);
  assert_same(POINTS "f 1/7/1 2/8/2 3/9/3\n", plain);
  assert_same(POINTS "f 1/ 2/ 3/\n", plain);
  assert_same(POINTS "f 1/-1/-1 2/-2/-2 3/-3/-3\n", plain);
  assert_same(POINTS "f -4 -3 -2\n", plain);
  assert_same(POINTS "f -4/-1 -3//-2 3\n", plain);
  assert_same(POINTS "f +1 002 3\n", plain);
  assert_same(POINTS "f\t1  2\t\t3   \n", plain);
}

static void negative_indices_count_from_the_statement(void **state) {
  (void)state;
  struct reading r;
  read_text(&r, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n"
                "v 0 0 1\nv 1 0 1\nv 0 1 1\nf -3 -2 -1\nf 1 -2 -1\n");
  static const uint32_t corner[9] = {0, 1, 2, 3, 4, 5, 0, 4, 5};
  assert_int_equal(r.scene.corner.count, 9);
  assert_memory_equal(r.scene.corner.item, corner, sizeof corner);
  reading_fini(&r);
}

static void faces_may_come_before_their_points(void **state) {
  (void)state;
  assert_same("f 1 2 3\n" POINTS, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                  "f 1 2 3\n");
  struct reading r;
  read_text(&r, "v 0 0 0\nf 1 2 3\nv 1 0 0 # after\nf 2 3 -1\nv 1 \\\n 1 0\n"
                "f -1 -2 -3\nf 4 1 2\nl 1 3\n");
  static const uint32_t corner[6] = {0, 1, 2, 2, 1, 0};
  assert_int_equal(r.scene.point.count, 3);
  assert_int_equal(r.scene.corner.count, 6);
  assert_memory_equal(r.scene.corner.item, corner, sizeof corner);
  assert_int_equal(r.warnings, 2);
  assert_string_equal(r.warning[0],
                      "4: face with fewer than three distinct corners, "
                      "skipped");
  assert_string_equal(r.warning[1], "8: face with index 4 where there are 3 "
                                    "points, skipped");
  assert_int_equal(scene_wire_count(&r.scene), 1);
  reading_fini(&r);
}

static void a_missing_index_is_reported_as_the_file_has_it(void **state) {
  (void)state;
  struct reading r;
  read_text(&r, POINTS "f 1 2 9999999999999999999\nf 1 2 -00000000000000005/1\n"
                       "l 1 123456789012345678901234567\n");
  static const char *const index[] = {"9999999999999999999",
                                      "-00000000000000005",
                                      "123456789012345678901234..."};
  assert_int_equal(r.warnings, 3);
  for (int i = 0; i < 3; i++) {
    char reported[100];
    snprintf(reported, sizeof reported,
             "%d: %s with index %s where there are 4 points, skipped", i + 5,
             i < 2 ? "face" : "polyline", index[i]);
    assert_string_equal(r.warning[i], reported);
  }
  reading_fini(&r);
}

static void polygons_may_have_any_number_of_corners(void **state) {
  (void)state;
  enum { COUNT = 20000 };
  char *text = malloc(COUNT * 64), *to = text;
  assert_non_null(text);
  for (int i = 0; i < COUNT; i++)
    to += sprintf(to, "v %.9f %.9f 0\n", cos(i * 2 * 3.14159265 / COUNT),
                  sin(i * 2 * 3.14159265 / COUNT));
  to += sprintf(to, "f");
  for (int i = 1; i <= COUNT; i++)
    to += sprintf(to, " %d", i);
  sprintf(to, "\n");
  struct reading r;
  read_text(&r, text);
  assert_int_equal(scene_face_count(&r.scene), 1);
  assert_int_equal(r.scene.corner.count, COUNT);
  assert_int_equal(r.warnings, 0);
  reading_fini(&r);
  free(text);
}

static void polylines_are_read(void **state) {
  (void)state;
  struct reading r;
  read_text(&r, POINTS "l 1 2 3\nl -1/1 -2/2\n");
  static const uint32_t start[3] = {0, 3, 5}, corner[5] = {0, 1, 2, 3, 2};
  assert_int_equal(scene_wire_count(&r.scene), 2);
  assert_memory_equal(r.scene.wire_start.item, start, sizeof start);
  assert_memory_equal(r.scene.wire_corner.item, corner, sizeof corner);
  assert_int_equal(scene_face_count(&r.scene), 0);
  reading_fini(&r);
}

static void what_else_there_is_is_passed_over(void **state) {
  (void)state;
  assert_same("# made by hand\n\n  \t\nmtllib x.mtl\nvt 0 0\nvn 0 0 1\nvp 1\n"
              "s off\n" POINTS "s 1\ncstype bezier\nvertex 1 2\nfo 1 2\n"
              "  f 1 2 3 # a face\n#f 1 2 4\np 1\nend",
              POINTS "f 1 2 3\n");
}

static void lines_may_be_continued(void **state) {
  (void)state;
  assert_same("v 0 \\\n 0 0\nv 1 0\\\n 0\nv \\\r\n 1 1 0\nv 0 1 0\n"
              "f \\\n1 \\\n\\\n2 3\\\n\n",
              POINTS "f 1 2 3\n");
  /* Faults are reported by the line where their statement starts. */
  struct reading r;
  read_text(&r, POINTS "f 1 \\\n 2 \\\n 9\nf 1 1 1\n");
  assert_string_equal(r.warning[0], "5: face with index 9 where there are 4 "
                                    "points, skipped");
  assert_memory_equal(r.warning[1], "8: ", 3);
  reading_fini(&r);
}

/* Comments are not: they end in paths of one system. */
static void comments_are_not_continued(void **state) {
  (void)state;
  assert_same("# C:\\models\\\n" POINTS "f 1 2 3 # C:\\\nf 1 3 4\n",
              POINTS "f 1 2 3\nf 1 3 4\n");
  assert_same("v 0 0 0 # C:\\\nv 1 0 0 1 # C:\\\nv 1 1 0\nv 0 1 0\nf 1 2 3\n",
              POINTS "f 1 2 3\n");
}

static void a_comment_may_begin_anywhere(void **state) {
  (void)state;
  assert_same("v 0 0 0#a\nv 1 0 0#\nv 1 1 0.#1\nv 0 1 0 #\nf 1 2 3#4\n"
              "f 1/1 2//2 3/3/3#4\nl 1 2#3\n",
              POINTS "f 1 2 3\nf 1 2 3\nl 1 2\n");
}

static void carriage_returns_alone_are_refused_by_name(void **state) {
  (void)state;
  ASSERT_BROKEN("v 0 0 0\rv 1 0 0\rv 1 1 0\rf 1 2 3\r", 1,
                "its lines end in a carriage return alone; a line feed must "
                "end them");
}

static void ends_of_lines_may_have_a_carriage_return(void **state) {
  (void)state;
  assert_same("# text\r\nv 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\n\r\n"
              "g a b\r\nf 1 2 3\r\nl 1 2",
              POINTS "g a b\nf 1 2 3\nl 1 2\n");
}

/* Appends a statement with each space of it replaced. */
static char *put_statement(char *at, const char *statement, const char *blank) {
  for (; *statement; statement++) {
    size_t length = *statement == ' ' ? strlen(blank) : 1;
    memcpy(at, *statement == ' ' ? blank : statement, length);
    at += length;
  }
  *at = '\0';
  return at;
}

/* Writes points and faces, most of them plain, some odd and some faulty, with
 * `blank` for each space. */
static char *write_mixture(const char *blank) {
  enum { HOW_MANY_POINTS = 5000, HOW_MANY_FACES = 9000, LONGEST = 80 };
  static const char *const odd[] = {"f 1 2 2\n",
                                    "f 1 2 99999\n",
                                    "f -1 -2 -3\n",
                                    "f 1//3 2//4 3//5\n",
                                    "f 1/2/3 4/5/6 7\n",
                                    "f 1 2 x\n",
                                    "f 7 8 12 \r\n",
                                    "v 1e1 -0 .5\n",
                                    "v 0.123456789 1 1234567890\n"};
  enum { ODD = sizeof odd / sizeof *odd };
  char *text = malloc((HOW_MANY_POINTS + HOW_MANY_FACES) * LONGEST), *at = text;
  char statement[LONGEST];
  assert_non_null(text);
  for (int i = 0; i < HOW_MANY_POINTS; i++) {
    snprintf(statement, sizeof statement, "v %d.%d -%d.%04d %d\n", i % 7, i, i,
             i * 7 % 10000, i % 11);
    at = put_statement(at, statement, blank);
  }
  for (int i = 0; i < HOW_MANY_FACES; i++) {
    int a = i * 31 % HOW_MANY_POINTS;
    snprintf(statement, sizeof statement, "f %d %d %d\n", a + 1,
             (a + 17) % HOW_MANY_POINTS + 1, (a + 1234) % HOW_MANY_POINTS + 1);
    at = put_statement(at, i % 97 == 0 ? odd[i / 97 % ODD] : statement, blank);
  }
  put_statement(at, "f 1 2 3\n", blank);
  return text;
}

static void plain_statements_are_read_as_all_others(void **state) {
  struct reading a, b;
  char *plain = write_mixture(" "), *other = write_mixture("\t");
  (void)state;
  reading_of(&a, &reader_obj, plain);
  reading_of(&b, &reader_obj, other);
  assert_int_equal(a.status, RECTO_OK);
  assert_true(scene_face_count(&a.scene) > 8900);
  assert_true(reading_same(&a.scene, &b.scene));
  assert_true(a.warnings > 3);
  assert_int_equal(a.warnings, b.warnings);
  for (int i = 0; i < a.warnings && i < 16; i++)
    assert_string_equal(a.warning[i], b.warning[i]);
  reading_fini(&a);
  reading_fini(&b);
  free(plain);
  free(other);
}

static void the_last_line_needs_no_end(void **state) {
  (void)state;
  assert_same(POINTS "f 1 2 3", POINTS "f 1 2 3\n");
  assert_same("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 1 1 0",
              "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  assert_same("\xef\xbb\xbf" POINTS "f 1 2 3\n", POINTS "f 1 2 3\n");
}

/* ---- Groups -------------------------------------------------------------- */

static void assert_group(const struct reading *r, uint32_t face,
                         const char *name) {
  uint32_t group = scene_face_group(&r->scene, face);
  assert_string_equal(r->scene.group.item[group].name, name);
}

static void objects_groups_and_materials_are_groups(void **state) {
  (void)state;
  struct reading r;
  read_text(&r, POINTS "f 1 2 3\n"
                       "g left\nf 1 2 3\n"
                       "g right side \t\nf 1 2 3\n"
                       "usemtl red\nf 1 2 3\n"
                       "o Box\nf 1 2 3\n"
                       "g\nf 1 2 3\n"
                       "usemtl\no\nf 1 2 3\n"
                       "g left\nf 1 2 3\nl 1 2\n"
                       "usemtlx blue\ngroup x\nf 1 2 3\n");
  static const char *const names[] = {"default",
                                      "left",
                                      "right side",
                                      "right side/red",
                                      "Box/right side/red",
                                      "Box/red",
                                      "default",
                                      "left",
                                      "left"};
  for (uint32_t i = 0; i < 9; i++)
    assert_group(&r, i, names[i]);
  assert_int_equal(r.scene.group.count, 6);
  assert_int_equal(r.scene.wire_group.item[0], scene_face_group(&r.scene, 7));
  reading_fini(&r);
}

static void groups_without_elements_are_none(void **state) {
  (void)state;
  struct reading r;
  read_text(&r, "g a\ng b\no c\n" POINTS "usemtl d\ng e\nf 1 2 3\ng f\n");
  assert_int_equal(r.scene.group.count, 1);
  assert_group(&r, 0, "c/e/d");
  reading_fini(&r);
}

static void the_next_file_starts_anew(void **state) {
  (void)state;
  struct reading r;
  static const char text[] = POINTS "f 1 2 3\nf -4 -3 -2\ng left\nf 1 2 3\n"
                                    "f 5 1 2\n";
  reading_init(&r);
  for (int i = 0; i < 2; i++)
    assert_int_equal(reading_bytes(&r, &reader_obj, text, sizeof text - 1),
                     RECTO_OK);
  static const uint32_t corner[18] = {0, 1, 2, 0, 1, 2, 0, 1, 2,
                                      4, 5, 6, 4, 5, 6, 4, 5, 6};
  assert_memory_equal(r.scene.corner.item, corner, sizeof corner);
  assert_group(&r, 3, "default");
  assert_int_equal(r.scene.group.count, 2);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_INDEX], 2);
  reading_fini(&r);
}

/* ---- Bad elements -------------------------------------------------------- */

static void assert_faulty(const struct scenes_faulty *faulty) {
  struct reading r;
  read_text(&r, faulty->text);
  if (scene_face_count(&r.scene) != faulty->faces)
    fail_msg("%s: %u faces", faulty->name, scene_face_count(&r.scene));
  /* Planarity is judged later. */
  if (faulty->fault != SCENE_FAULT_COUNT &&
      faulty->fault != SCENE_FAULT_WARPED) {
    char line[32];
    snprintf(line, sizeof line, "%lu: ", faulty->line);
    if (strncmp(r.warning[0], line, strlen(line)) != 0)
      fail_msg("%s: '%s'", faulty->name, r.warning[0]);
    assert_true(r.diagnostics.count[faulty->fault] > 0);
  }
  reading_fini(&r);
}

static void a_bad_element_spoils_nothing_else(void **state) {
  (void)state;
  assert_non_null(scenes_faulty_list[10].name);
  for (const struct scenes_faulty *f = scenes_faulty_list; f->name; f++)
    assert_faulty(f);
}

static void a_point_that_is_not_finite_keeps_its_index(void **state) {
  (void)state;
  struct reading r;
  read_text(&r, "v 0 0 0\nv nan 0 0\nv 1 0 0\nv 0 -inf 0\nv 1 1 0\n"
                "v 1 1e999 1\nv x y z\nv 1 2\nv 0 1 0\n"
                "f 1 3 5 9\nf 1 2 3\nf 9 8 5\nf -1 -5 -7\nl 1 4\nl 1 3\n");
  assert_int_equal(r.scene.point.count, 9);
  static const uint32_t corner[7] = {0, 2, 4, 8, 8, 4, 2};
  assert_int_equal(r.scene.corner.count, 7);
  assert_memory_equal(r.scene.corner.item, corner, sizeof corner);
  assert_int_equal(scene_wire_count(&r.scene), 1);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_NOT_FINITE], 6);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_SYNTAX], 2);
  assert_string_equal(r.warning[0],
                      "2: point that is not finite; its faces are skipped");
  assert_string_equal(r.warning[3], "7: point that cannot be parsed, skipped");
  reading_fini(&r);
}

/* So that it does not count for the scene's size. */
static void a_bad_point_stands_at_a_good_one(void **state) {
  (void)state;
  struct reading r;
  read_text(&r, "v nan 0 0\nv inf 0 0\nv 7 8 9\nv x 0 0\nv 6 6 6\n");
  assert_int_equal(r.scene.point.count, 5);
  for (int i = 0; i < 4; i++)
    assert_true(r.scene.point.item[i].x == 7 && r.scene.point.item[i].z == 9);
  assert_true(r.scene.point.item[4].x == 6);
  reading_fini(&r);
  read_text(&r, "v nan 0 0\nv inf 0 0\n");
  assert_int_equal(r.scene.point.count, 2);
  reading_fini(&r);
}

static void what_cannot_be_parsed_is_skipped(void **state) {
  (void)state;
  static const char *const odd[] = {
      "f 1 x 3",     "f 1 2 3x",  "f 1/2/3/4 2 3", "f 1,2,3",
      "f 1.5 2 3",   "f - 2 3",   "f / 2 3",       "f //1 //2 //3",
      "f 1 2 3 abc", "f 1/a 2 3", "l 1 two",       "f 1 2 --3",
      "v 1,5 2 3",   "v 1 2",     "v 1.#IND 0 0",  "v 0x10 0 0",
      "v 1 2 3e",    "v"};
  for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
    char text[200];
    struct reading r;
    snprintf(text, sizeof text, POINTS "%s\nf 1 2 3\n", odd[i]);
    read_text(&r, text);
    if (r.diagnostics.count[SCENE_FAULT_SYNTAX] != 1 || r.warnings != 1 ||
        strncmp(r.warning[0], "5: ", 3) != 0 || scene_face_count(&r.scene) != 1)
      fail_msg("'%s' gives %s", odd[i], r.warning[0]);
    reading_fini(&r);
  }
}

static void huge_indices_are_out_of_range(void **state) {
  (void)state;
  static const char *const huge[] = {"4294967297",
                                     "-4294967297",
                                     "18446744073709551617",
                                     "-18446744073709551615",
                                     "340282366920938463463374607431768211457",
                                     "5",
                                     "0",
                                     "-5",
                                     "-0"};
  for (size_t i = 0; i < sizeof huge / sizeof *huge; i++) {
    char text[200];
    struct reading r;
    snprintf(text, sizeof text, POINTS "f 1 2 %s\nf 1 2 3\n", huge[i]);
    read_text(&r, text);
    assert_int_equal(scene_face_count(&r.scene), 1);
    assert_int_equal(r.diagnostics.count[SCENE_FAULT_INDEX], 1);
    reading_fini(&r);
  }
}

/* ---- Broken files -------------------------------------------------------- */

static void bytes_that_no_text_holds_are_an_error(void **state) {
  (void)state;
  ASSERT_BROKEN("\x7f"
                "ELF\x02\x01\x01\0\0",
                1, "not text: a byte 0x02");
  ASSERT_BROKEN("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 2, "not text: a byte 0x1a");
  ASSERT_BROKEN(POINTS "\0\0\0\0\0", 5, "not text: a byte 0x00");
  ASSERT_BROKEN(POINTS "v 1 \x01 3\n", 5, "not text: a byte 0x01");
  ASSERT_BROKEN(POINTS "f 1 2 3\0\nf 1 2 3\n", 5, "not text: a byte 0x00");
  ASSERT_BROKEN(POINTS "g a\0b\nf 1 2 3\n", 5, "not text: a byte 0x00");
}

static void text_of_another_kind_is_an_error(void **state) {
  (void)state;
  ASSERT_BROKEN("# so far so good\n\n<html>\n<body>\n</body>\n", 3,
                "no statement of an OBJ file");
  ASSERT_BROKEN("solid x\nendsolid x\n", 1, "no statement of an OBJ file");
}

static void a_file_that_stops_in_a_statement_is_an_error(void **state) {
  (void)state;
  ASSERT_BROKEN("v 0 0 0\nv 1 0", 2, "the file ends in the middle of a point");
  ASSERT_BROKEN("v 0 0 0\nv 1 -", 2, "the file ends in the middle of a point");
  ASSERT_BROKEN("v 0 0 0\nv", 2, "the file ends in the middle of a point");
  ASSERT_BROKEN(POINTS "f 1 2", 5, "the file ends in the middle of a face");
  ASSERT_BROKEN(POINTS "f 1 2 -", 5, "the file ends in the middle of a face");
  ASSERT_BROKEN(POINTS "f", 5, "the file ends in the middle of a face");
  ASSERT_BROKEN(POINTS "f 1 2 3\\", 5, "the file ends in the middle of a face");
  ASSERT_BROKEN(POINTS "l 1", 5, "the file ends in the middle of a polyline");
  ASSERT_BROKEN("f 1 2 3\nv 0 0 0\nv 0", 3,
                "the file ends in the middle of a point");
}

/* ---- Numbers, memory, models --------------------------------------------- */

static void a_decimal_comma_changes_nothing(void **state) {
  (void)state;
  if (!comma_locale_on()) {
    print_message("no locale with a decimal comma\n");
    skip();
  }
  struct reading r;
  reading_of(&r, &reader_obj,
             "v 0.5 1.25 -3.0000000000000000000001\nv 1 0 0\nv 0 1 0\n"
             "f 1 2 3\n");
  comma_locale_off();
  assert_int_equal(r.status, RECTO_OK);
  assert_true(r.scene.point.item[0].x == 0.5);
  assert_true(r.scene.point.item[0].y == 1.25);
  assert_true(r.scene.point.item[0].z == -3);
  assert_int_equal(scene_face_count(&r.scene), 1);
  reading_fini(&r);
}

/* A model times a power of two, from the smallest to the largest numbers, has
 * the same faces. */
static void scale_decides_nothing(void **state) {
  (void)state;
  static const double shape[7][3] = {
      {0, 0, 0},       {1, 0, 0},   {1, 1, 0},        {0, 1, 0},
      {0.5, 0.5, 0.5}, {0.5, 0, 0}, {0.5, 0x1p-30, 0}};
  struct reading first;
  for (int scale = -1000; scale <= 1000; scale += 250) {
    char text[2000], *to = text;
    for (int i = 0; i < 7; i++)
      to += sprintf(to, "v %.17g %.17g %.17g\n", ldexp(shape[i][0], scale),
                    ldexp(shape[i][1], scale), ldexp(shape[i][2], scale));
    sprintf(to, "f 1 2 3 4\nf 1 2 5\nf 1 6 2\nf 1 7 2\nf 1 3 2 4\n");
    struct reading r;
    read_text(&r, text);
    assert_int_equal(scene_face_count(&r.scene), 4);
    assert_int_equal(r.diagnostics.count[SCENE_FAULT_ZERO_AREA], 1);
    assert_int_equal(r.diagnostics.count[SCENE_FAULT_BOW_TIE], 1);
    if (scale == -1000) {
      first = r;
      continue;
    }
    assert_int_equal(r.scene.corner.count, first.scene.corner.count);
    assert_memory_equal(r.scene.corner.item, first.scene.corner.item,
                        first.scene.corner.count * sizeof(uint32_t));
    reading_fini(&r);
  }
  reading_fini(&first);
}

static void running_out_of_memory_is_an_error(void **state) {
  (void)state;
  static const char text[] = "v nan 0 0\n" POINTS "g a\nf 2 3 4\ng b\n"
                             "f 2 3 4 5\nl 2 3\nf 2 3 6\nv 5 5 5\n";
  struct memory_faults faults = {.least = 10};
  while (memory_faults_go_on(&faults)) {
    struct reading r;
    reading_init(&r);
    memory_faults_begin(&faults);
    recto_status status = reading_bytes(&r, &reader_obj, text, sizeof text - 1);
    memory_faults_end(&faults, status);
    assert_int_equal(r.error.code, status);
    assert_null(reading_fault(&r.scene));
    reading_fini(&r);
  }
}

struct model {
  const char *name;
  uint32_t points, faces;
};

static void real_models_are_read_whole(void **state) {
  (void)state;
  static const struct model models[] = {
      {"teapot", 3644, 6320}, {"spot", 2930, 5856},
      {"suzanne", 507, 500},  {"fandisk", 6475, 12946},
      {"cow", 2903, 5804},    {"stanford-bunny", 35947, 69451}};
  const char *folder = getenv("RECTO_MODELS");
  if (folder == NULL) {
    print_message("no models\n");
    skip();
  }
  for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
    char path[1000];
    struct reading r;
    snprintf(path, sizeof path, "%.900s/%s.obj", folder, models[i].name);
    reading_init(&r);
    if (scene_read(&r.scene, path, NULL, &r.diagnostics, &r.error) != RECTO_OK)
      fail_msg("%s:%lu: %s", r.error.file, r.error.line, r.error.text);
    assert_int_equal(r.scene.point.count, models[i].points);
    assert_int_equal(scene_face_count(&r.scene), models[i].faces);
    assert_int_equal(r.warnings, 0);
    assert_null(reading_fault(&r.scene));
    reading_fini(&r);
  }
}

int main(void) {
  reading_takes_marks = false; /* test_crease_marks.c has them */
#define T(name) cmocka_unit_test_teardown(name, tear_down)
  const struct CMUnitTest tests[] = {
      T(points_are_read_in_every_form),
      T(faces_are_read_in_every_index_form),
      T(negative_indices_count_from_the_statement),
      T(faces_may_come_before_their_points),
      T(a_missing_index_is_reported_as_the_file_has_it),
      T(polygons_may_have_any_number_of_corners),
      T(polylines_are_read),
      T(what_else_there_is_is_passed_over),
      T(lines_may_be_continued),
      T(comments_are_not_continued),
      T(a_comment_may_begin_anywhere),
      T(carriage_returns_alone_are_refused_by_name),
      T(ends_of_lines_may_have_a_carriage_return),
      T(plain_statements_are_read_as_all_others),
      T(the_last_line_needs_no_end),
      T(objects_groups_and_materials_are_groups),
      T(groups_without_elements_are_none),
      T(the_next_file_starts_anew),
      T(a_bad_element_spoils_nothing_else),
      T(a_point_that_is_not_finite_keeps_its_index),
      T(a_bad_point_stands_at_a_good_one),
      T(what_cannot_be_parsed_is_skipped),
      T(huge_indices_are_out_of_range),
      T(bytes_that_no_text_holds_are_an_error),
      T(text_of_another_kind_is_an_error),
      T(a_file_that_stops_in_a_statement_is_an_error),
      T(a_decimal_comma_changes_nothing),
      T(scale_decides_nothing),
      T(running_out_of_memory_is_an_error),
      T(real_models_are_read_whole),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
