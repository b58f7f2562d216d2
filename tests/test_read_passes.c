/* test_read_passes.c - a model that is read block by block, in one pass or in
 * several, is the one that is read at once. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/obj/obj_blocks.h"
#include "scene/read_passes.h"
#include "tests/reading.h"
#include "tests/temporary.h"

/* ---- Both ways of reading ------------------------------------------------ */

/* What all blocks of a pass had. */
struct gathered {
  struct scene scene; /* faces and polylines alone */
};

#define APPEND(to, from, add)                                                  \
  for (size_t i_ = 0; i_ < (from)->count; i_++)                                \
  assert_true(ARRAY_PUSH(to, (from)->item[i_] + (add)))

static recto_status gather(void *user, const struct scene *scene,
                           recto_error *error) {
  struct scene *all = &((struct gathered *)user)->scene;
  uint32_t faces = scene_face_count(all);
  uint32_t wire_corners = (uint32_t)all->wire_corner.count;
  (void)error;
  for (uint32_t f = 0; f < scene_face_count(scene); f++) {
    for (uint32_t c = scene_face_start(scene, f);
         c < scene_face_start(scene, f + 1); c++)
      assert_true(ARRAY_PUSH(&all->corner, scene->corner.item[c]));
    assert_true(scene_end_face(all, scene_face_group(scene, f)));
  }
  if (scene->wire_start.count > 0) {
    all->wire_start.count -= all->wire_start.count > 0;
    APPEND(&all->wire_start, &scene->wire_start, wire_corners);
  }
  APPEND(&all->face_skipped, &scene->face_skipped, faces);
  APPEND(&all->wire_corner, &scene->wire_corner, 0);
  APPEND(&all->wire_group, &scene->wire_group, 0);
  return RECTO_OK;
}

#define MOVE(to, from)                                                         \
  do {                                                                         \
    ARRAY_FREE(to);                                                            \
    memcpy(to, from, sizeof *(to));                                            \
    memset(from, 0, sizeof *(from));                                           \
  } while (0)

/* Moves faces and polylines to a scene that has none. */
static void move_elements(struct scene *to, struct scene *from) {
  to->face_count = from->face_count;
  from->face_count = 0;
  MOVE(&to->corner, &from->corner);
  MOVE(&to->face_start, &from->face_start);
  MOVE(&to->face_group, &from->face_group);
  MOVE(&to->face_skipped, &from->face_skipped);
  MOVE(&to->wire_start, &from->wire_start);
  MOVE(&to->wire_corner, &from->wire_corner);
  MOVE(&to->wire_group, &from->wire_group);
}

/* Reads a file in blocks of at least so many bytes, its faces in the last of so
 * many passes. */
static void read_in_passes(struct reading *reading, const char *path,
                           size_t least, int passes) {
  struct read_passes *file;
  reading_init(reading);
  assert_int_equal(read_passes_open(&file, path, "obj", least, NULL), RECTO_OK);
  assert_non_null(file);
  struct gathered gathered = {.scene = {.cut = NULL}};
  reading->status = read_passes_points(file, &reading->scene,
                                       &reading->diagnostics, &reading->error);
  for (int i = 0; i < passes && reading->status == RECTO_OK; i++) {
    scene_fini(&gathered.scene);
    reading->status =
        read_passes_faces(file, gather, &gathered, &reading->error);
  }
  move_elements(&reading->scene, &gathered.scene);
  scene_fini(&gathered.scene);
  read_passes_close(file);
}

static void read_at_once(struct reading *reading, const char *path,
                         const char *text) {
  reading_init(reading);
  reading->status =
      scene_read_memory(&reading->scene, text, strlen(text), path, "obj",
                        &reading->diagnostics, &reading->error);
}

/* Reads a file in one pass. */
static void read_in_blocks(struct reading *reading, const char *path,
                           size_t least) {
  struct obj_blocks blocks = {.lines = {.bytes = NULL}};
  reading_init(reading);
  assert_true(line_blocks_open(&blocks.lines, path, least));
  reading->status = scene_read_blocks(&reading->scene, &blocks, path,
                                      &reading->diagnostics, &reading->error);
}

/* Compares a reading in blocks of so many bytes with the one at once. */
static void compare_readings(const struct reading *whole,
                             const struct reading *parts, size_t least,
                             int passes, const char *text, bool same_words) {
  if ((whole->status == RECTO_OK) != (parts->status == RECTO_OK) ||
      (whole->status == RECTO_OK &&
       (!reading_same(&whole->scene, &parts->scene) ||
        whole->scene.face_skipped.count != parts->scene.face_skipped.count ||
        whole->warnings != parts->warnings)))
    fail_msg("blocks of %zu, %d passes: status %d and %d, %d and %d "
             "warnings: %s\n%s",
             least, passes, (int)whole->status, (int)parts->status,
             whole->warnings, parts->warnings, parts->error.text, text);
  for (size_t s = 0;
       whole->status == RECTO_OK && s < whole->scene.face_skipped.count; s++)
    assert_int_equal(whole->scene.face_skipped.item[s],
                     parts->scene.face_skipped.item[s]);
  if (same_words && whole->status != RECTO_OK) {
    assert_string_equal(whole->error.text, parts->error.text);
    assert_int_equal(whole->error.line, parts->error.line);
  }
}

/* In one pass warnings come in the same order, too. */
static void compare_warnings(const struct reading *whole,
                             const struct reading *parts) {
  for (int i = 0; i < whole->warnings && i < READING_WARNINGS; i++)
    assert_string_equal(whole->warning[i], parts->warning[i]);
}

/* Compares all ways for a text. */
static void compare_ways(void *const *state, const char *text,
                         bool same_words) {
  static const size_t least[] = {1, 7, 30, 100, 1 << 20};
  const char *path = temporary_file(state, "model.obj", text, strlen(text));
  struct reading whole, parts;
  read_at_once(&whole, path, text);
  for (size_t i = 0; i < sizeof least / sizeof least[0]; i++) {
    read_in_blocks(&parts, path, least[i]);
    compare_readings(&whole, &parts, least[i], 0, text, true);
    compare_warnings(&whole, &parts);
    reading_fini(&parts);
    for (int passes = 1; passes <= 2; passes++) {
      read_in_passes(&parts, path, least[i], passes);
      compare_readings(&whole, &parts, least[i], passes, text, same_words);
      reading_fini(&parts);
    }
  }
  reading_fini(&whole);
}

/* ---- Files --------------------------------------------------------------- */

#define POINTS "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1.25\n"

static void what_a_file_may_have_is_read(void **state) {
  static const char *const text[] = {
      POINTS "f 1 2 3\nf 1 2 4\nf 2 3 4\n",
      "\xef\xbb\xbf" POINTS "f 1 2 3\n",
      "# comment v\n" POINTS "f 1 2 3", /* no line feed at the end */
      POINTS "f 1 2 \\\n3\nf 1 \\\r\n 2 4\n",
      POINTS "f -4 -3 -2\nv 2 2 2\nf -1 -2 -3\nv 3 3 9\nf -1 1 2\n",
      "f 1 2 3\nf 2 3 4\n" POINTS
      "f 1 2 9\nf 4 3 2 1\n", /* before its points */
      "g a\nusemtl v\nmtllib none.mtl\n" POINTS
      "f 1 2 3\ng b\nf 1 2 4\ng a\nf 2 3 4\nv 5 5 5\nf 1 2 5\n",
      POINTS "l 1 2 3\nf 1 2 3\nl 3 4\nl 1 1\n",
      POINTS "v nan 0 0\nf 1 2 5\nf 1 2 2\nf 1 2 3\nf 1 2 2\nf 1 3 4\n",
      "vt 0 0\nvn 0 0 1\n" POINTS
      "f 1/1/1 2/1/1 3/1/1\nvp 1\nf 1//1 2//1 4//1\n",
      "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",
      "g over\\\nv 1 2 3\n" POINTS "g v\\\nv 1 2 3\nf 1 2 3\n",
      "  v 0 0 0\n\tv 1 0 0\n v 0 1 0\n f 1 2 3\n",
      POINTS "vague v\nvvv\nf 1 2 3\ns off\no thing v\nf 2 3 4\n",
      "v 1 2 3\n",
      /* points after a face that names one of them, then more of both */
      POINTS
      "f 1 2 3\no a\nf 1 2 5\nv 5 5 5\nf 2 3 6\nv nan 0 0\ng b\nf 1 2 7\n"
      "v 6 6 6\nf 1 2 3 \\\n4\nf 1 2 9\n",
  };
  for (size_t i = 0; i < sizeof text / sizeof text[0]; i++)
    compare_ways(state, text[i], true);
}

static void broken_files_are_refused_alike(void **state) {
  static const char *const text[] = {
      "",
      "v 0 0 0\rv 1 0 0\r",
      POINTS "f 1 2 3\nf 1 2",
      POINTS "v 1 2",
      POINTS "f 1 2 3\nf 1 \x01 3\n",
      "no model\nat all\n",
      POINTS "usemtl \x01\nf 1 2 3\n",
  };
  for (size_t i = 0; i < sizeof text / sizeof text[0]; i++)
    compare_ways(state, text[i], true);
}

static void files_of_any_statements_are_read_alike(void **state) {
  static const char *const line[] = {"v 0 0 0\n",
                                     "v 1.5 0 0\n",
                                     "v 0 1 0\n",
                                     "v 3 1 2\n",
                                     "v 1 7 2\n",
                                     "f 1 2 3\n",
                                     "f 1 2 3 4\n",
                                     "f -1 -2 -3\n",
                                     "f 2 9 4\n",
                                     "f 1 1 2\n",
                                     "l 1 2\n",
                                     "l 3 2 \\\n4\n",
                                     "g a\n",
                                     "g b v\\\n",
                                     "usemtl m\n",
                                     "# v\n",
                                     "\n",
                                     "vt 0 0\n",
                                     "f 1 2 \\\r\n3\n",
                                     "  f 1 3 2\r\n",
                                     "v 1 x 2\n",
                                     "f 1 one 2\n",
                                     "o v\n",
                                     "v 2 2 \\\n2\n",
                                     "mtllib no.mtl\n",
                                     "verily\n"};
  enum { TRIALS = 400, LINES = 40, KINDS = sizeof line / sizeof line[0] };
  uint32_t seed = 1;
  for (int trial = 0; trial < TRIALS; trial++) {
    char text[LINES * 24] = "";
    for (int i = 0; i < LINES; i++) {
      seed = seed * 1664525 + 1013904223;
      strcat(text, line[(seed >> 16) % KINDS]);
    }
    compare_ways(state, text, false);
  }
}

static void only_plain_files_are_read_in_passes(void **state) {
  static const unsigned char gzip[] = {0x1f, 0x8b, 8, 0};
  struct read_passes *passes;
  const char *path = temporary_file(state, "a.obj", gzip, sizeof gzip);
  assert_int_equal(read_passes_open(&passes, path, NULL, 0, NULL), RECTO_OK);
  assert_null(passes);
  path = temporary_file(state, "a.stl", "solid", 5);
  assert_int_equal(read_passes_open(&passes, path, NULL, 0, NULL), RECTO_OK);
  assert_null(passes);
  assert_int_equal(read_passes_open(&passes, "-", "obj", 0, NULL), RECTO_OK);
  assert_null(passes);
  path = temporary_path(state, "missing.obj");
  assert_int_equal(read_passes_open(&passes, path, NULL, 0, NULL), RECTO_OK);
  assert_null(passes);
}

/* Changes the file once, while it is read. */
static recto_status change_file(void *user, const struct scene *scene,
                                recto_error *error) {
  (void)scene;
  (void)error;
  FILE *file = fopen(user, "a");
  assert_non_null(file);
  fputs("f 1 2 3\n", file);
  fclose(file);
  return RECTO_OK;
}

static void a_file_that_changes_is_refused(void **state) {
  char text[] = POINTS "f 1 2 3\nf 1 2 4\nf 2 3 4\n";
  char path[400];
  struct read_passes *passes;
  struct scene scene;
  recto_error error = {0};
  snprintf(path, sizeof path, "%s",
           temporary_file(state, "model.obj", text, strlen(text)));
  scene_init(&scene);
  assert_int_equal(read_passes_open(&passes, path, NULL, 8, NULL), RECTO_OK);
  assert_int_equal(read_passes_points(passes, &scene, NULL, &error), RECTO_OK);
  assert_int_equal(read_passes_faces(passes, change_file, path, &error),
                   RECTO_ERROR_IO);
  assert_string_equal(error.text, "was changed while it was read");
  read_passes_close(passes);
  scene_fini(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(what_a_file_may_have_is_read,
                                      temporary_set_up, temporary_tear_down),
      cmocka_unit_test_setup_teardown(broken_files_are_refused_alike,
                                      temporary_set_up, temporary_tear_down),
      cmocka_unit_test_setup_teardown(files_of_any_statements_are_read_alike,
                                      temporary_set_up, temporary_tear_down),
      cmocka_unit_test_setup_teardown(only_plain_files_are_read_in_passes,
                                      temporary_set_up, temporary_tear_down),
      cmocka_unit_test_setup_teardown(a_file_that_changes_is_refused,
                                      temporary_set_up, temporary_tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
