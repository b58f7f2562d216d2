/* test_obj_plain.c - which statements of an OBJ file are plain: those are read
 * in runs, and by several threads; and so are parts of nothing else. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/line_blocks.h"
#include "scene/corner_normals.h"
#include "scene/obj/obj_counted_part.h"
#include "tests/temporary.h"

#if DIGITS_CHUNKS

enum { REPEATS = 20 };

/* The statement REPEATS times, and a long line behind them. */
static char *repeat(const char *statement) {
  size_t length = strlen(statement);
  char *text = malloc(REPEATS * length + OBJ_PLAIN_ROOM + 16), *at = text;
  assert_non_null(text);
  for (int i = 0; i < REPEATS; i++, at += length)
    memcpy(at, statement, length);
  memset(at, '#', OBJ_PLAIN_ROOM + 8);
  memset(at + OBJ_PLAIN_ROOM + 8, 0, 8);
  return text;
}

/* A parser that has read four points of a square, and two normals. */
static void set_up(struct obj_parser *p, struct scene *scene) {
  static const struct scene_point point[] = {
      {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  scene_init(scene);
  scene->needs_crease_marks = true;
  obj_parser_begin(p, scene, "a.obj", NULL, NULL);
  for (int i = 0; i < 4; i++)
    assert_true(ARRAY_PUSH(&scene->point, point[i]));
  p->seen = 4;
  assert_true(ARRAY_PUSH(&p->normal, corner_normal_encode(0, 0, 1)));
  assert_true(ARRAY_PUSH(&p->normal, corner_normal_encode(1, 0, 1)));
}

/* Reads the statement many times, and adds what is plain.
 * Returns how many were. */
static size_t read_repeated(struct obj_parser *p,
                            const struct obj_run_kind *kind,
                            const char *statement) {
  char *text = repeat(statement);
  size_t length = REPEATS * strlen(statement);
  struct obj_run run = {.at = text,
                        .end = text + length,
                        .limit = text + length + OBJ_PLAIN_ROOM + 8,
                        .most = REPEATS};
  assert_true(kind->reserve(p, REPEATS));
  assert_true(kind->read(p, &run));
  assert_true(kind->add(p, &run));
  assert_ptr_equal(run.at, text + strlen(statement) * run.count);
  ARRAY_FREE(&run.sampled);
  free(text);
  return run.count;
}

static void tear_down(struct obj_parser *p, struct scene *scene) {
  obj_parser_fini(p);
  scene_fini(scene);
}

static void points_may_have_spaces_and_carriage_returns(void **state) {
  static const char *const plain[] = {"v 1 -2.5 3e2\n",
                                      "v 1 -2.5 3e2\r\n",
                                      "v  1 -2.5 3e2\n",
                                      "v 1 -2.5 3e2 \n",
                                      "v 1  -2.5   3e2 \r\n",
                                      "v 1 -2.5 3e2\t\n",
                                      "v 1 -2.5 3e2 0.5 0.5 1\r\n",
                                      "v 1 -2.5 3e2 # text\n"};
  (void)state;
  for (size_t i = 0; i < sizeof plain / sizeof *plain; i++) {
    struct scene scene;
    struct obj_parser p;
    set_up(&p, &scene);
    assert_int_equal(read_repeated(&p, &obj_plain_points, plain[i]), REPEATS);
    assert_int_equal(scene.point.count, 4 + REPEATS);
    for (int k = 0; k < REPEATS; k++) {
      const struct scene_point *point = &scene.point.item[4 + k];
      assert_true(point->x == 1 && point->y == -2.5 && point->z == 300);
    }
    tear_down(&p, &scene);
  }
}

static void normals_may_have_spaces_and_carriage_returns(void **state) {
  static const char *const plain[] = {"vn 1 -2.5 0.25\n", "vn 1 -2.5 0.25\r\n",
                                      "vn  1 -2.5  0.25 \r\n"};
  (void)state;
  for (size_t i = 0; i < sizeof plain / sizeof *plain; i++) {
    struct scene scene;
    struct obj_parser p;
    set_up(&p, &scene);
    assert_int_equal(read_repeated(&p, &obj_plain_normals, plain[i]), REPEATS);
    assert_int_equal(p.normal.count, 2 + REPEATS);
    assert_int_equal(p.normals_seen, REPEATS);
    for (int k = 0; k < REPEATS; k++)
      assert_int_equal(p.normal.item[2 + k],
                       corner_normal_encode(1, -2.5, 0.25));
    tear_down(&p, &scene);
  }
}

static void faces_may_have_spaces_and_carriage_returns(void **state) {
  static const char *const plain[] = {
      "f 1 2 3\n",          "f 1 2 3\r\n",    "f  1 2 3\n",
      "f 1 2 3 \r\n",       "f 1/1 2/5  3\n", "f 1/8/2 2//2 3//2 \r\n",
      "f 1/8/2 2//1 3//2\n"};
  (void)state;
  for (size_t i = 0; i < sizeof plain / sizeof *plain; i++) {
    struct scene scene;
    struct obj_parser p;
    set_up(&p, &scene);
    assert_int_equal(read_repeated(&p, &obj_plain_triangles, plain[i]),
                     REPEATS);
    assert_int_equal(scene.face_count, REPEATS);
    for (uint32_t k = 0; k < 3 * REPEATS; k++) {
      bool has_normals = i >= 5;
      assert_int_equal(scene.corner.item[k], k % 3);
      assert_int_equal(corner_normal_of(&scene, k),
                       has_normals ? p.normal.item[i == 5 || k % 3 != 1] : 0);
    }
    tear_down(&p, &scene);
  }
}

static void other_statements_are_not_plain(void **state) {
  static const char *const other[] = {
      "f 1 2\n",     "f 1 2 3 4\n",   "f 1 2 x\n",    "f 1 2 3 # text\n",
      "f 1 2 5\n",   "f 1\t2 3\n",    "f 1//3 2 3\n", "f 1 2 3\\\n",
      "f 1// 2 3\n", "f 1/2/x 2 3\n", "f 1 2 2\n",    "f -1 2 3\n"};
  (void)state;
  for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
    struct scene scene;
    struct obj_parser p;
    set_up(&p, &scene);
    assert_int_equal(read_repeated(&p, &obj_plain_triangles, other[i]), 0);
    tear_down(&p, &scene);
  }
}

/* Reads the first part of a file of so many times the text, of triangles and
 * what else there may be; returns whether it is plain. */
static bool is_part_plain(void **state, const char *text, bool wants_marks) {
  enum { BYTES = OBJ_COUNTED_BYTES + 2 * OBJ_COUNTED_ROOM };
  size_t length = strlen(text), count = 0;
  char *bytes = malloc(BYTES + length);
  struct line_blocks lines = {.bytes = NULL};
  struct obj_counted_part part = {.lines = 0};
  struct scene scene;
  struct obj_parser p;
  assert_non_null(bytes);
  for (; count < BYTES; count += length)
    memcpy(bytes + count, text, length);
  const char *path = temporary_file(state, "a.obj", bytes, count);
  set_up(&p, &scene);
  scene.needs_crease_marks = wants_marks;
  assert_true(line_blocks_open(&lines, path, BYTES));
  obj_counted_part_count(&part, &lines, 0, 0);
  assert_true(ARRAY_RESERVE(&scene.point, part.points.most) &&
              ARRAY_RESERVE(&p.normal, part.normals.most) &&
              scene_reserve_faces(&scene, part.faces, part.corners));
  if (part.corners == 3 * part.faces)
    obj_counted_part_parse(&part, &p);
  else
    part.is_plain = false;
  obj_counted_part_check(&part, &p);
  bool is_plain = part.is_plain;
  obj_counted_part_fini(&part);
  line_blocks_close(&lines);
  tear_down(&p, &scene);
  free(bytes);
  return is_plain;
}

static void parts_may_have_normals_and_smoothing_groups(void **state) {
  static const char *const plain[] = {
      "o a\nv 1 2 3\nf 1 2 3\n", "g a\r\ns 1\r\n\r\nv 1 2 3\r\nf 1 2 3\r\n",
      "s off\nf 1 2 3\ns 25\nf 2 3 4\n",
      "v  1 2 3 \nvn 0 0 1\nvt 0 1\nusemtl b\ns 0 \nf 1//1 2/7/3  3 \n"};
  static const char *const other[] = {"f 1 2 3\ns none\n",
                                      "f 1 2 3\nvn 0 x 1\n", "f 1 2 3 # text\n",
                                      "f 1\t2 3 4\n", "f 1 2 3\nf 1 2 x\n"};
  for (int wants_marks = 0; wants_marks < 2; wants_marks++) {
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
      assert_true(is_part_plain(state, plain[i], wants_marks > 0));
    for (size_t i = 0; i < sizeof other / sizeof *other; i++)
      assert_true(!is_part_plain(state, other[i], wants_marks > 0) ||
                  (i == 1 && wants_marks == 0));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(
          parts_may_have_normals_and_smoothing_groups, temporary_set_up,
          temporary_tear_down),
      cmocka_unit_test(points_may_have_spaces_and_carriage_returns),
      cmocka_unit_test(normals_may_have_spaces_and_carriage_returns),
      cmocka_unit_test(faces_may_have_spaces_and_carriage_returns),
      cmocka_unit_test(other_statements_are_not_plain)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

#else

int main(void) { return 77; /* skipped: there are no runs */ }

#endif
