/* test_obj_parallel.c - an OBJ file that several threads read is the scene, the
 * warnings and the error that one thread reads.
 *
 * Runs of plain statements are divided at the ends of lines once half a
 * megabyte of them is to be read at once.  So the files are some megabytes of
 * them, with a few other statements at random places. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/parallel.h"
#include "scene/read.h"
#include "tests/reading.h"
#include "tests/scenes/random.h"
#include "tests/temporary.h"
#include "tests/valgrind.h"

enum { POINTS = 60000, FACES = 70000, LONGEST = 400 };

static const char *const odd_points[] = {
    "v 1 2\n",
    "v 1e1 -0 .5\n",
    "v nan 0 0\n",
    "v 1 2 3 0.5 0.5 0.5\n",
    "v  1 2 3\r\n",
    "v 0.12345678901234567890 1 12345678901234567890\n",
    "v 1 2 3 # text\n",
    "# text\n",
    "\n",
    "vt 0 0\n",
    "v 1 \\\n2 3\n",
    "vn 0 0 -2\n",
    "vn x\n",
    "vn nan 0 0\n",
    "o thing\n"};

static const char *const odd_faces[] = {"f 1 2 2\n",
                                        "f 1 2 3 4\n",
                                        "f -1 -2 -3\n",
                                        "f 1//3 2//4 3//5\n",
                                        "f 5//1 6//2 9\n",
                                        "f 5//1 6 9//2\n",
                                        "f 1/2/3 4/5/6 7\n",
                                        "f 1 2 x\n",
                                        "f 7 8 12 \r\n",
                                        "f 1 2 99999999\n",
                                        "g other\n",
                                        "l 1 2 3\n",
                                        "f 1 2\n",
                                        "f 0 1 2\n",
                                        "s 1\n",
                                        "s off\n",
                                        "s none\n",
                                        "f 3//9 4//99 5//1\n",
                                        "f 6//1 7//2 9//-1\n",
                                        "v 7 7 7\n",
                                        "# text\n"};

struct text {
  char *bytes;
  size_t count;
};

static void put(struct text *text, const char *statement) {
  size_t length = strlen(statement);
  memcpy(text->bytes + text->count, statement, length);
  text->count += length;
}

/* A comment, or an index, that is longer than a part is. */
static void put_long_line(struct text *text, struct random *random) {
  size_t length = 1000 + random_below(random, 200000);
  put(text, random_below(random, 2) ? "# " : "f 1/");
  memset(text->bytes + text->count, '1', length);
  text->count += length;
  put(text, random_below(random, 2) ? " 2 3\n" : "\n");
}

static void put_point(struct text *text, struct random *random) {
  char statement[LONGEST];
  snprintf(statement, sizeof statement, "v %.*g %.*g %d\n",
           random_int(random, 1, 12), random_between(random, -9, 9),
           random_int(random, 1, 12), random_between(random, -9, 9),
           random_int(random, -99, 99));
  put(text, statement);
}

static void put_face(struct text *text, struct random *random) {
  char statement[LONGEST];
  int c[3];
  for (int k = 0; k < 3; k++)
    c[k] = random_int(random, 1, POINTS - 20);
  snprintf(statement, sizeof statement,
           random_below(random, 4) ? "f %d//1 %d//2 %d/5/3\n"
                                   : "f %d/1 %d/2 %d/3\n",
           c[0], c[1], c[2]);
  put(text, statement);
}

/* Points of a grid, with numbers of many lengths, for quadrilaterals. */
enum { COLUMNS = 300 };

static void put_grid_point(struct text *text, struct random *random, int i) {
  char statement[LONGEST];
  snprintf(statement, sizeof statement, "v %d %d.5 %.*g\n", i % COLUMNS,
           i / COLUMNS, random_int(random, 1, 12),
           random_between(random, 0, 0.1));
  put(text, statement);
}

static void put_quadrilateral(struct text *text, struct random *random) {
  char statement[LONGEST];
  int c = random_int(random, 1, POINTS - COLUMNS - 20);
  snprintf(statement, sizeof statement,
           random_below(random, 4) ? "f %d//1 %d//2 %d/5/3 %d\n"
                                   : "f %d/1 %d/2 %d/3 %d/1\n",
           c, c + 1, c + COLUMNS + 1, c + COLUMNS);
  put(text, statement);
}

/* One statement in `rarity` is odd; 0: none is.  Faces are triangles, or by odd
 * seeds quadrilaterals. */
static struct text write_file(uint64_t seed, uint32_t rarity) {
  struct random random = {seed};
  bool is_grid = seed % 2 == 1;
  struct text text = {malloc(((size_t)POINTS + FACES) * 64 + (1 << 22)), 0};
  assert_non_null(text.bytes);
  put(&text, "vn 1 0 0\nvn 0 1 0\nvn 1 1 1\n");
  for (int i = 0; i < POINTS; i++) {
    if (is_grid)
      put_grid_point(&text, &random, i);
    else
      put_point(&text, &random);
    if (rarity > 0 && random_below(&random, rarity) == 0)
      put(&text, odd_points[random_below(&random, sizeof odd_points /
                                                      sizeof *odd_points)]);
  }
  for (int i = 0; i < FACES; i++) {
    if (is_grid)
      put_quadrilateral(&text, &random);
    else
      put_face(&text, &random);
    if (rarity > 0 && random_below(&random, rarity) == 0)
      put(&text, odd_faces[random_below(&random,
                                        sizeof odd_faces / sizeof *odd_faces)]);
  }
  if (rarity > 0)
    put_long_line(&text, &random);
  for (int i = 0; rarity > 0 && i < FACES / 4; i++)
    put_face(&text, &random);
  return text;
}

static void assert_same_in_parallel(uint64_t seed, uint32_t rarity) {
  struct text text = write_file(seed, rarity);
  const char *fault =
      reading_parallel_fault(&reader_obj, text.bytes, text.count);
  free(text.bytes);
  if (fault != NULL)
    fail_msg("seed %d, one of %d odd: %s", (int)seed, (int)rarity, fault);
}

static int rounds(int count) {
  return is_under_valgrind() ? 1 + count / 20 : count;
}

/* Where there is one processor, there is nothing to compare. */
static void skip_without_processors(void) {
  if (parallel_processors() < 2)
    skip();
}

static void plain_files_are_read_alike(void **state) {
  (void)state;
  skip_without_processors();
  assert_same_in_parallel(1, 0);
  assert_same_in_parallel(2, 0);
}

static void other_statements_are_found_where_they_are(void **state) {
  static const uint32_t rarities[] = {300, 5000, 20000, 60000};
  (void)state;
  skip_without_processors();
  for (int seed = 1; seed <= rounds(40); seed++)
    assert_same_in_parallel((uint64_t)seed, rarities[seed % 4]);
}

/* The text with other blanks, colours of points, and mostly carriage returns at
 * the ends of lines, as other programs write it. */
static struct text dress(const struct text *text, struct random *random) {
  enum { SHORTEST = 10 }; /* so that it has three coordinates */
  struct text dressed = {malloc(3 * text->count), 0};
  const char *line = text->bytes;
  assert_non_null(dressed.bytes);
  for (size_t i = 0; i < text->count; i++) {
    char c = text->bytes[i];
    const char *at = &text->bytes[i];
    bool may_have_space = i > 0 && at[-1] != '\\';
    if (c == '\n' && may_have_space && at - line > SHORTEST &&
        memcmp(line, "v ", 2) == 0 && random_below(random, 4) > 0)
      put(&dressed, " 0.25 0 1");
    if (c == '\n')
      line = at + 1;
    if (c == '\n' && may_have_space && random_below(random, 8) == 0)
      put(&dressed, " ");
    if (c == '\n' && random_below(random, 8) > 0)
      put(&dressed, "\r");
    if (c == ' ' && random_below(random, 8) == 0)
      put(&dressed, " ");
    dressed.bytes[dressed.count++] = c;
  }
  return dressed;
}

static struct text dress_instead(struct text text, uint64_t seed) {
  struct random random = {seed};
  struct text dressed = dress(&text, &random);
  free(text.bytes);
  return dressed;
}

static void read_alone(struct reading *reading, const struct text *text) {
  reading_init(reading);
  assert_int_equal(
      reading_bytes(reading, &reader_obj, text->bytes, text->count), RECTO_OK);
}

static void blanks_and_carriage_returns_change_nothing(void **state) {
  static const uint32_t rarities[] = {0, 20000, 300, 5000};
  (void)state;
  skip_without_processors();
  for (int seed = 1; seed <= rounds(12); seed++) {
    struct random random = {(uint64_t)seed};
    struct text text = write_file((uint64_t)seed, rarities[seed % 4]);
    struct text dressed = dress(&text, &random);
    struct reading plain, other;
    read_alone(&plain, &text);
    read_alone(&other, &dressed);
    assert_true(reading_same(&plain.scene, &other.scene));
    const struct precision *p = &plain.scene.precision.item->precision,
                           *q = &other.scene.precision.item->precision;
    assert_true(p->absolute == q->absolute && p->relative == q->relative);
    assert_int_equal(plain.warnings, other.warnings);
    reading_fini(&plain);
    reading_fini(&other);
    assert_null(
        reading_parallel_fault(&reader_obj, dressed.bytes, dressed.count));
    free(text.bytes);
    free(dressed.bytes);
  }
}

/* Of a file each thread reads the parts that it parses. */
static void files_are_read_as_they_are_in_memory(void **state) {
  static const uint32_t rarities[] = {0, 20000, 60000, 5000};
  skip_without_processors();
  for (int seed = 1; seed <= rounds(20); seed++) {
    struct text text = write_file((uint64_t)seed, rarities[seed % 4]);
    const char *path = temporary_file(state, "a.obj", text.bytes, text.count);
    const char *fault = reading_parallel_file_fault(&reader_obj, path);
    free(text.bytes);
    if (fault != NULL)
      fail_msg("file of seed %d: %s", seed, fault);
  }
}

/* A face that names a point after it has all later ones read first, from the
 * middle of a run. */
static void points_may_follow_runs_of_faces(void **state) {
  skip_without_processors();
  struct text text = write_file(5, 0);
  put(&text, "f 1 2 60003\nf 4 5 6\n");
  struct random random = {5};
  for (int i = 0; i < FACES / 8; i++)
    put_face(&text, &random);
  for (int i = 0; i < FACES / 8; i++)
    put_point(&text, &random);
  const char *path = temporary_file(state, "a.obj", text.bytes, text.count);
  const char *fault = reading_parallel_file_fault(&reader_obj, path);
  free(text.bytes);
  assert_null(fault);
}

/* ---- Parts of an assembly ------------------------------------------------ */

static const char *const odd_names[] = {
    "o a b \t\r\n", "g\n",           "usemtl red\n",  "g x\\\ny\n",
    "o \x01\n",     "s 1\n",         "mtllib no.x\n", "o\n",
    "# o x\\\n",    "vt 1\\\n2\n",   "other\n",       " v 1 2 3\n",
    "f 1 2 2 1\n",  "f 1 2 60003\n", "f 3 2 999999\n"};

static void put_odd(struct text *text, struct random *random) {
  enum {
    POINT_KINDS = sizeof odd_points / sizeof *odd_points,
    FACE_KINDS = sizeof odd_faces / sizeof *odd_faces,
    NAME_KINDS = sizeof odd_names / sizeof *odd_names
  };
  switch (random_below(random, 4)) {
  case 0:
    put(text, odd_points[random_below(random, POINT_KINDS)]);
    break;
  case 1:
    put(text, odd_faces[random_below(random, FACE_KINDS)]);
    break;
  default:
    put(text, odd_names[random_below(random, NAME_KINDS)]);
  }
}

/* A prism over a polygon; points are counted from `first`.
 * form  what follows an index */
static void put_prism(struct text *text, struct random *random, int sides,
                      int first, const char *form) {
  char statement[LONGEST];
  double x = random_between(random, 0, 99), y = random_between(random, 0, 99);
  for (int i = 0; i < 2 * sides; i++) {
    snprintf(statement, sizeof statement, "v %.*g %.9g %d\n",
             random_int(random, 6, 12), x + cos(6.2831853 * (i / 2) / sides),
             y + sin(6.2831853 * (i / 2) / sides), i % 2);
    put(text, statement);
  }
  for (int k = 0; k < sides; k++) {
    int a = first + 2 * k, b = first + 2 * ((k + 1) % sides);
    snprintf(statement, sizeof statement,
             sides == 3 ? "f %d%s %d%s %d%s\nf %d%s %d%s %d%s\n"
                        : "f %d%s %d%s %d%s %d%s\n",
             a, form, b, form, b + 1, form, sides == 3 ? a : a + 1, form, b + 1,
             form, a + 1, form);
    put(text, statement);
  }
  for (int top = 0; top < 2; top++) {
    put(text, "f");
    for (int k = 0; k < sides; k++) {
      int at = top ? k : sides - 1 - k;
      snprintf(statement, sizeof statement, " %d%s", first + 2 * at + top,
               form);
      put(text, statement);
    }
    put(text, "\n");
  }
}

/* Smoothing groups and normals before a part; returns what follows its indices:
 * some normal so far, or mostly `form`. */
static const char *put_marks(struct text *text, struct random *random,
                             int *normals, const char *form) {
  static char own[LONGEST];
  char statement[LONGEST];
  if (random_below(random, 2) > 0) {
    snprintf(statement, sizeof statement, "s %d\n", random_int(random, 0, 2));
    put(text, random_below(random, 5) > 0 ? statement : "s off\n");
  }
  for (int n = random_int(random, 0, 3); n > 0; n--, ++*normals) {
    snprintf(statement, sizeof statement, "vn %.3f %.4f 1e-1\n",
             random_between(random, -1, 1), random_between(random, -1, 1));
    put(text, statement);
  }
  if (*normals == 0 || random_below(random, 3) == 0)
    return form;
  snprintf(own, sizeof own, "//%d", random_int(random, 1, *normals));
  return own;
}

/* Prisms after each other, most with names; one in `rarity` has something odd
 * before it; 0: none has. */
static struct text write_assembly(uint64_t seed, uint32_t rarity) {
  enum { BYTES = 2 << 20, ROOM = 1 << 14 };
  static const char *const forms[] = {"", "//1", "/1/1", "/7"};
  struct random random = {seed};
  struct text text = {malloc(BYTES + ROOM), 0};
  assert_non_null(text.bytes);
  put(&text, "vt 0 0\n");
  int first = 1, kinds = random_int(&random, 1, 3), normals = seed % 4 == 1;
  if (normals > 0)
    put(&text, "vn 0 0 1\n");
  for (int i = 0; text.count < BYTES; i++) {
    static const char *const name[] = {"o part", "g of ", "usemtl m", "\n# "};
    char statement[LONGEST];
    int sides = kinds == 1 ? 3 : random_int(&random, 3, 2 + 11 * (kinds - 1));
    snprintf(statement, sizeof statement, "%s%d\n",
             name[random_below(&random, 4)], i / 2);
    if (rarity > 0 && random_below(&random, rarity) == 0)
      put_odd(&text, &random);
    if (seed % 8 == 3 && i == 900)
      put(&text, "vt 1 \\\nv 7 7 7\n");
    put(&text, random_below(&random, 3) ? statement : "vt 0.5 1\n");
    const char *form = forms[random_below(&random, 4)];
    if (seed % 3 == 0)
      form = put_marks(&text, &random, &normals, form);
    put_prism(&text, &random, sides, first, form);
    first += 2 * sides;
  }
  return text;
}

/* Points and faces take turns. */
static void assemblies_are_read_alike(void **state) {
  static const uint32_t rarities[] = {0, 2000, 800, 400, 150};
  skip_without_processors();
  for (int seed = 1; seed <= rounds(80); seed++) {
    struct text text = write_assembly((uint64_t)seed, rarities[(seed / 4) % 5]);
    if (seed % 5 == 0)
      text = dress_instead(text, (uint64_t)seed);
    const char *path = temporary_file(state, "a.obj", text.bytes, text.count);
    reading_takes_marks = seed % 2 == 0;
    const char *fault = reading_parallel_file_fault(&reader_obj, path);
    reading_takes_marks = true;
    free(text.bytes);
    if (fault != NULL)
      fail_msg("assembly of seed %d: %s", seed, fault);
  }
}

/* A polyline took the first group, so the first face has another; all points
 * of the first block have tabs, which are not plain, so nothing before the
 * first face is a run. */
static void first_face_may_be_in_a_second_group(void **state) {
  enum { BLOCK = 1 << 18, BYTES = 1 << 20, ROOM = 1 << 14 };
  struct random random = {5};
  struct text text = {malloc(BLOCK + BYTES + ROOM), 0};
  int points = 0;
  assert_non_null(text.bytes);
  put(&text, "o wire\nv 0 0 0\nv 1 0 0\nl 1 2\n");
  for (; text.count < BLOCK - 60; points++)
    put(&text, "v\t1 2 3 0.5 0.5 0.5\n");
  while (text.count < BLOCK + BYTES) {
    put(&text, "o part\n");
    put_prism(&text, &random, 3, points + 3, "");
    points += 6;
  }
  const char *path = temporary_file(state, "w.obj", text.bytes, text.count);
  const char *fault = reading_parallel_file_fault(&reader_obj, path);
  free(text.bytes);
  assert_null(fault);
}

/* The end of the file may cut a statement of a part anywhere. */
static void files_may_end_anywhere(void **state) {
  struct random random = {3};
  (void)state;
  skip_without_processors();
  struct text text = write_file(3, 0);
  for (int i = 0; i < rounds(20); i++) {
    size_t count = text.count - random_below(&random, 400000);
    const char *fault = reading_parallel_fault(&reader_obj, text.bytes, count);
    if (fault != NULL)
      fail_msg("cut to %zu bytes: %s", count, fault);
  }
  free(text.bytes);
}

/* Room for the rest of a large file is made at once, and what is too much of it
 * given back. */
static void large_files_have_the_room_that_they_need(void **state) {
  enum { LARGE = 17 << 20 };
  (void)state;
  if (is_under_valgrind())
    skip();
  struct text text = {malloc(LARGE + LONGEST), 0};
  struct random random = {7};
  struct reading reading;
  assert_non_null(text.bytes);
  for (int i = 0; i < POINTS; i++)
    put_point(&text, &random);
  while (text.count < LARGE)
    put(&text, "f 10000 10010 10023\n");
  reading_init(&reading);
  assert_int_equal(reading_bytes(&reading, &reader_obj, text.bytes, text.count),
                   RECTO_OK);
  const struct scene *scene = &reading.scene;
  assert_int_equal(scene->point.count, POINTS);
  assert_int_equal(scene->point.capacity, scene->point.count);
  assert_int_equal(scene->corner.capacity, scene->corner.count);
  assert_null(reading_fault(scene));
  reading_fini(&reading);
  free(text.bytes);
}

/* Statements of one length, and so many bytes of them. */
static void put_points(struct text *text, size_t bytes, int digits) {
  char statement[LONGEST];
  double x = 1 + 0.25 / digits;
  snprintf(statement, sizeof statement, "v %.*f %.*f %.*f\n", digits, x, digits,
           x + 1, digits, x + 2);
  for (size_t end = text->count + bytes; text->count < end;)
    put(text, statement);
}

/* Room is made for as many statements as the bytes to come have if they are as
 * long as those before: where they are shorter, there is no room for all. */
static void statements_may_become_shorter(void **state) {
  enum { LONG = 1 << 20, SHORT = 1 << 21 };
  (void)state;
  skip_without_processors();
  struct text text = {malloc(2 * (LONG + SHORT) + 4 * LONGEST), 0};
  assert_non_null(text.bytes);
  for (int turn = 0; turn < 2; turn++) {
    put_points(&text, LONG, 30);
    put_points(&text, SHORT, 0);
  }
  const char *fault =
      reading_parallel_fault(&reader_obj, text.bytes, text.count);
  free(text.bytes);
  assert_null(fault);
}

/* An array that grows is moved, which takes longer than to read it. */
static void threads_make_no_room_for_what_is_not_there(void **state) {
  enum { BYTES = 900 << 10 }; /* of a larger file it would be given back */
  (void)state;
  skip_without_processors();
  struct text text = {malloc(BYTES + LONGEST), 0};
  struct reading reading;
  assert_non_null(text.bytes);
  put_points(&text, BYTES, 18);
  reading_with_threads(&reading, &reader_obj, text.bytes, text.count, NULL, 2);
  assert_int_equal(reading.status, RECTO_OK);
  assert_in_range(reading.scene.point.capacity, reading.scene.point.count,
                  3 * reading.scene.point.count);
  reading_fini(&reading);
  free(text.bytes);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(statements_may_become_shorter),
      cmocka_unit_test(threads_make_no_room_for_what_is_not_there),
      cmocka_unit_test(plain_files_are_read_alike),
      cmocka_unit_test(other_statements_are_found_where_they_are),
      cmocka_unit_test(blanks_and_carriage_returns_change_nothing),
      cmocka_unit_test_setup_teardown(files_are_read_as_they_are_in_memory,
                                      temporary_set_up, temporary_tear_down),
      cmocka_unit_test_setup_teardown(assemblies_are_read_alike,
                                      temporary_set_up, temporary_tear_down),
      cmocka_unit_test_setup_teardown(points_may_follow_runs_of_faces,
                                      temporary_set_up, temporary_tear_down),
      cmocka_unit_test_setup_teardown(first_face_may_be_in_a_second_group,
                                      temporary_set_up, temporary_tear_down),
      cmocka_unit_test(files_may_end_anywhere),
      cmocka_unit_test(large_files_have_the_room_that_they_need)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
