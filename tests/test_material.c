/* test_material.c - material libraries give groups their colours; what is
 * missing or broken in them is reported and never an error. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>
#ifdef HAVE_ZLIB
#include <zlib.h>
#endif

#include "scene/read.h"
#include "tests/memory_faults.h"
#include "tests/reading.h"
#include "tests/temporary.h"

#define POINTS "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
#define FACE "f 1 2 3\n"

static const char *write_text(void **state, const char *name,
                              const char *text) {
  return temporary_file(state, name, text, strlen(text));
}

/* Reads a model of that text as a drawing in colour would. */
static void read_model(struct reading *r, void **state, const char *text) {
  reading_init(r);
  r->scene.needs_colours = true;
  r->status = scene_read(&r->scene, write_text(state, "m.obj", text), NULL,
                         &r->diagnostics, &r->error);
  assert_int_equal(r->status, RECTO_OK);
}

static void assert_colour(const struct reading *r, const char *name,
                          uint32_t colour) {
  for (size_t i = 0; i < r->scene.group.count; i++)
    if (strcmp(r->scene.group.item[i].name, name) == 0) {
      assert_true(r->scene.group.item[i].has_colour);
      assert_int_equal(r->scene.group.item[i].colour, colour);
      return;
    }
  fail_msg("no group %s", name);
}

static void assert_no_colour(const struct reading *r) {
  for (size_t i = 0; i < r->scene.group.count; i++)
    assert_false(r->scene.group.item[i].has_colour);
}

/* ---- Colours ------------------------------------------------------------- */

static void groups_have_the_colour_of_their_material(void **state) {
  struct reading r;
  write_text(state, "a.mtl",
             "# two\r\nnewmtl red\r\nKa 0 0 0\r\nKd 1 0 0\r\n"
             "\tnewmtl\tdark  green \n  Kd 0.0 0.5 0 # half\nnewmtl grey\n"
             "Kd 0.2");
  read_model(&r, state,
             "mtllib a.mtl\n" POINTS "g box\nusemtl red\n" FACE
             "usemtl dark  green\n" FACE "g lid\n" FACE "usemtl grey\n" FACE);
  assert_int_equal(r.warnings, 0);
  assert_int_equal(r.scene.group.count, 4);
  assert_colour(&r, "box/red", 0xff0000);
  assert_colour(&r, "box/dark  green", 0x008000);
  assert_colour(&r, "lid/dark  green", 0x008000);
  assert_colour(&r, "lid/grey", 0x333333);
  reading_fini(&r);
}

static void a_library_may_come_after_its_materials_are_used(void **state) {
  struct reading r;
  write_text(state, "a.mtl", "newmtl red\nKd 1 0 0\n");
  read_model(&r, state, POINTS "usemtl red\n" FACE "mtllib a.mtl\n");
  assert_colour(&r, "red", 0xff0000);
  reading_fini(&r);
}

static void names_of_libraries_may_hold_blanks_or_be_several(void **state) {
  struct reading r;
  write_text(state, "a b.mtl", "newmtl red\nKd 1 0 0\n");
  write_text(state, "a", "newmtl green\nKd 0 1 0\nnewmtl blue\nKd 0 0 1\n");
  write_text(state, "c", "newmtl red\nKd 0 0 0\nnewmtl blue\nKd 1 1 1\n");
  read_model(&r, state,
             "mtllib a b.mtl\nmtllib a  c\n" POINTS "usemtl red\n" FACE
             "usemtl green\n" FACE "usemtl blue\n" FACE);
  assert_int_equal(r.warnings, 0);
  /* The first that has a material holds. */
  assert_colour(&r, "red", 0xff0000);
  assert_colour(&r, "green", 0x00ff00);
  assert_colour(&r, "blue", 0x0000ff);
  reading_fini(&r);
}

static void values_beyond_the_range_are_clamped(void **state) {
  struct reading r;
  write_text(state, "a.mtl", "newmtl m\nKd 7 -3 1e300\n");
  read_model(&r, state, "mtllib a.mtl\n" POINTS "usemtl m\n" FACE);
  assert_colour(&r, "m", 0xff00ff);
  reading_fini(&r);
}

static void only_drawings_in_colour_read_libraries(void **state) {
  struct reading r;
  const char *path =
      write_text(state, "m.obj", "mtllib no.mtl\n" POINTS "usemtl red\n" FACE);
  reading_init(&r);
  assert_int_equal(scene_read(&r.scene, path, NULL, &r.diagnostics, &r.error),
                   RECTO_OK);
  assert_int_equal(r.warnings, 0);
  assert_no_colour(&r);
  reading_fini(&r);
}

static void groups_of_two_files_have_their_own_colours(void **state) {
  struct reading r;
  write_text(state, "a.mtl", "newmtl m\nKd 1 0 0\n");
  read_model(&r, state, "mtllib a.mtl\n" POINTS "usemtl m\n" FACE);
  write_text(state, "a.mtl", "newmtl m\nKd 0 1 0\n");
  assert_int_equal(scene_read(&r.scene, temporary_path(state, "m.obj"), NULL,
                              &r.diagnostics, &r.error),
                   RECTO_OK);
  assert_int_equal(r.scene.group.count, 2);
  assert_colour(&r, "m", 0xff0000);
  assert_colour(&r, "m.2", 0x00ff00);
  reading_fini(&r);
}

/* ---- gzip ---------------------------------------------------------------- */

#ifdef HAVE_ZLIB

static void write_compressed(void **state, const char *name, const char *text,
                             size_t count) {
  gzFile file = gzopen(temporary_path(state, name), "wb");
  assert_non_null(file);
  assert_int_equal(gzwrite(file, text, (unsigned)count), count);
  assert_int_equal(gzclose(file), Z_OK);
}

static void a_compressed_library_is_expanded(void **state) {
  static const char text[] = "newmtl m\nKd 1 0 0\n";
  static const char *const name[] = {"a.mtl", "b.mtl.gz"};
  for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
    struct reading r;
    char model[200];
    write_compressed(state, name[i], text, sizeof text - 1);
    snprintf(model, sizeof model, "mtllib %s\n" POINTS "usemtl m\n" FACE,
             name[i]);
    read_model(&r, state, model);
    assert_int_equal(r.warnings, 0);
    assert_colour(&r, "m", 0xff0000);
    reading_fini(&r);
  }
}

/* As gzip -r leaves a folder of models. */
static void
where_there_is_no_library_its_compressed_form_is_read(void **state) {
  static const char red[] = "newmtl m\nKd 1 0 0\nKd odd\n",
                    blue[] = "newmtl m\nKd 0 0 1\n";
  struct reading r;
  write_compressed(state, "a b.mtl.gz", red, sizeof red - 1);
  read_model(&r, state, "mtllib a b.mtl\n" POINTS "usemtl m\n" FACE);
  assert_int_equal(r.warnings, 1);
  assert_non_null(strstr(r.warning[0], "3: "));
  assert_colour(&r, "m", 0xff0000);
  reading_fini(&r);
  write_text(state, "a b.mtl", blue);
  read_model(&r, state, "mtllib a b.mtl\n" POINTS "usemtl m\n" FACE);
  assert_colour(&r, "m", 0x0000ff);
  reading_fini(&r);
}

static void a_library_that_expands_too_far_is_not_read(void **state) {
  enum { SIZE = (16 << 20) + 1 };
  struct reading r;
  char *blanks = malloc(SIZE);
  assert_non_null(blanks);
  memset(blanks, '\n', SIZE);
  write_compressed(state, "a.mtl.gz", blanks, SIZE);
  free(blanks);
  read_model(&r, state, "mtllib a.mtl\n" POINTS FACE);
  assert_int_equal(r.warnings, 1);
  assert_non_null(strstr(r.warning[0], "expand to more than 16 MB"));
  reading_fini(&r);
}

static void a_broken_compressed_library_is_reported(void **state) {
  struct reading r;
  temporary_file(state, "a.mtl.gz", "\x1f\x8b\x08\0odd", 7);
  read_model(&r, state, "mtllib a.mtl\n" POINTS FACE);
  assert_int_equal(r.warnings, 1);
  assert_non_null(strstr(r.warning[0], "1: material library a.mtl: gzip data"));
  reading_fini(&r);
}

#endif

/* ---- What is wrong ------------------------------------------------------- */

static void missing_values_are_reported_with_their_line(void **state) {
  struct reading r;
  write_text(state, "a.mtl", "newmtl known\nKd 1 1 1\nnewmtl plain\nNs 3\n");
  read_model(&r, state,
             "mtllib no.mtl\nmtllib a.mtl b.mtl\n" POINTS "usemtl lost\n" FACE
             "g x\n" FACE "usemtl known\n" FACE "usemtl plain\n" FACE);
  assert_int_equal(r.warnings, 3);
  assert_non_null(strstr(r.warning[0], "1: material library no.mtl: cannot"));
  assert_non_null(strstr(r.warning[1], "2: material library b.mtl: cannot"));
  assert_string_equal(r.warning[2], "6: material lost is in no library");
  assert_colour(&r, "x/known", 0xffffff);
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_MATERIAL], 3);
  reading_fini(&r);
}

struct heard {
  char file[300];
  unsigned long line;
  int count;
};

static void hear(void *user, const char *file, unsigned long line,
                 const char *text) {
  struct heard *heard = user;
  (void)text;
  if (heard->count++ == 0) {
    snprintf(heard->file, sizeof heard->file, "%s", file);
    heard->line = line;
  }
}

/* Reads a model whose only material is m of a library of these bytes. */
static void read_library(struct reading *r, struct heard *heard, void **state,
                         const char *bytes, size_t count) {
  temporary_file(state, "a.mtl", bytes, count);
  *heard = (struct heard){.count = 0};
  reading_init(r);
  r->scene.needs_colours = true;
  r->diagnostics.warning = hear;
  r->diagnostics.user = heard;
  const char *path =
      write_text(state, "m.obj", "mtllib a.mtl\n" POINTS "usemtl m\n" FACE);
  assert_int_equal(scene_read(&r->scene, path, NULL, &r->diagnostics, NULL),
                   RECTO_OK);
}

static void
a_bad_colour_is_reported_with_the_librarys_name_and_line(void **state) {
  static const char *const bad[] = {
      "nan 0 0", "1 0 inf",  "-infinity", "1e999",          "1 0",
      "1 0 0 0", "1 0 0x",   "red",       "spectral a.rfl", "xyz 1 1 1",
      "0.5,0,0", "1 1 \xff", ""};
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
    struct reading r;
    struct heard heard;
    char text[100];
    snprintf(text, sizeof text, "\nnewmtl m\nKd %s\nKd 0 0 1\n", bad[i]);
    read_library(&r, &heard, state, text, strlen(text));
    if (heard.count != 1)
      fail_msg("Kd %s: %d warnings", bad[i], heard.count);
    assert_string_equal(heard.file, temporary_path(state, "a.mtl"));
    assert_int_equal(heard.line, 3);
    assert_colour(&r, "m", 0x0000ff);
    assert_int_equal(r.diagnostics.count[SCENE_FAULT_MATERIAL], 1);
    reading_fini(&r);
  }
}

static void libraries_with_an_error_are_reported_once(void **state) {
  static const struct {
    const char *text;
    int count;
    unsigned long line;
  } row[] = {
      {"\xef\xbb\xbfnewmtl m\nKd 0 0 1\n", 0, 0},
      {"newmtl m\nKd 0 0 1\nnewmtl n\nnewmtl m\nKd 1 0 0\n", 1, 4},
      {"newmtl m\nKd 0 0 1\nnewmtl\nKd 1 0 0\n", 2, 3},
      {"newmtl m\nKd 0 0 1\nnewmtl \nNs 3\nnewmtl n\n", 1, 3},
      {"Kd 1 0 0\nnewmtl m\nKd 0 0 1\n", 1, 1},
      {"newmtl m\nKd 0 0 1\nnewmtl n\nKd\nKdiffuse 3\n", 1, 4},
  };
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    struct reading r;
    struct heard heard;
    read_library(&r, &heard, state, row[i].text, strlen(row[i].text));
    assert_int_equal(heard.count, row[i].count);
    assert_int_equal(heard.line, row[i].line);
    assert_colour(&r, "m", 0x0000ff);
    reading_fini(&r);
  }
}

/* What came before holds. */
static void a_library_is_read_as_far_as_it_is_text(void **state) {
  static const char bytes[] = "newmtl m\nKd 0 0 1\n\x01\x7f\0q\nnewmtl "
                              "m\nKd x\n\0\n\x02\n\x03\n\x04";
  struct reading r;
  struct heard heard;
  read_library(&r, &heard, state, bytes, sizeof bytes - 1);
  assert_int_equal(heard.count, 1);
  assert_int_equal(heard.line, 3);
  assert_colour(&r, "m", 0x0000ff);
  reading_fini(&r);
}

/* No line of one library is about a material of another. */
static void a_library_begins_without_a_material(void **state) {
  struct reading r;
  write_text(state, "a.mtl", "newmtl m\n");
  write_text(state, "b.mtl", "Kd 1 0 0\nnewmtl m\n");
  read_model(&r, state,
             "mtllib a.mtl\nmtllib b.mtl\n" POINTS "usemtl m\n" FACE);
  assert_no_colour(&r);
  assert_int_equal(r.warnings, 1);
  reading_fini(&r);
}

/* Neither a folder, nor a pipe without a writer, nor a device without an
 * end is read. */
static void only_plain_files_are_libraries(void **state) {
  struct reading r;
  assert_int_equal(mkfifo(temporary_path(state, "pipe"), 0600), 0);
  read_model(&r, state,
             "mtllib pipe\nmtllib .\nmtllib /dev/zero\n" POINTS FACE);
  assert_int_equal(r.warnings, 3);
  reading_fini(&r);
}

static void a_library_too_large_is_not_read(void **state) {
  struct reading r;
  const char *path = write_text(state, "a.mtl", "newmtl m\nKd 1 0 0\n");
  if (truncate(path, (off_t)1 << 40) != 0) {
    print_message("no sparse files here\n");
    skip();
  }
  read_model(&r, state, "mtllib a.mtl\n" POINTS "usemtl m\n" FACE);
  assert_int_equal(r.warnings, 2);
  assert_non_null(strstr(r.warning[0], "too large"));
  assert_no_colour(&r);
  reading_fini(&r);
}

static void no_more_than_a_hundred_libraries_are_read(void **state) {
  static char text[16000];
  struct reading r;
  size_t length = 0;
  for (int i = 0; i < 1000; i++)
    length += (size_t)snprintf(text + length, sizeof text - length,
                               "mtllib %d\n", i % 101);
  snprintf(text + length, sizeof text - length, POINTS "usemtl m\n" FACE);
  write_text(state, "99", "newmtl m\nKd 1 0 0\n");
  write_text(state, "100", "newmtl m\nKd 0 1 0\n");
  read_model(&r, state, text);
  assert_colour(&r, "m", 0xff0000);
  assert_non_null(strstr(r.warning[0], "101: more than 100"));
  assert_int_equal(r.diagnostics.count[SCENE_FAULT_MATERIAL], 100);
  reading_fini(&r);
}

static void running_out_of_memory_leaves_groups_as_they_were(void **state) {
  write_text(state, "a.mtl", "newmtl m\nKd 1 0 0\n");
  const char *path =
      write_text(state, "m.obj", "mtllib a.mtl b\n" POINTS "usemtl m\n" FACE);
  struct memory_faults faults = {.least = 5};
  while (memory_faults_go_on(&faults)) {
    struct reading r;
    reading_init(&r);
    assert_int_equal(scene_use_group(&r.scene, "m", 1, NULL), RECTO_OK);
    r.scene.needs_colours = true;
    memory_faults_begin(&faults);
    recto_status status = scene_read(&r.scene, path, NULL, NULL, &r.error);
    memory_faults_end(&faults, status);
    assert_int_equal(r.scene.group.count, status == RECTO_OK ? 2 : 1);
    assert_false(r.scene.group.item[0].has_colour);
    assert_true(status != RECTO_OK || r.scene.group.item[1].has_colour);
    reading_fini(&r);
  }
}

#define T(name)                                                                \
  cmocka_unit_test_setup_teardown(name, temporary_set_up, temporary_tear_down)

int main(void) {
  const struct CMUnitTest tests[] = {
      T(groups_have_the_colour_of_their_material),
      T(a_library_may_come_after_its_materials_are_used),
      T(names_of_libraries_may_hold_blanks_or_be_several),
      T(values_beyond_the_range_are_clamped),
      T(only_drawings_in_colour_read_libraries),
      T(groups_of_two_files_have_their_own_colours),
#ifdef HAVE_ZLIB
      T(a_compressed_library_is_expanded),
      T(where_there_is_no_library_its_compressed_form_is_read),
      T(a_library_that_expands_too_far_is_not_read),
      T(a_broken_compressed_library_is_reported),
#endif
      T(missing_values_are_reported_with_their_line),
      T(a_bad_colour_is_reported_with_the_librarys_name_and_line),
      T(libraries_with_an_error_are_reported_once),
      T(a_library_is_read_as_far_as_it_is_text),
      T(a_library_begins_without_a_material),
      T(only_plain_files_are_libraries),
      T(a_library_too_large_is_not_read),
      T(no_more_than_a_hundred_libraries_are_read),
      T(running_out_of_memory_leaves_groups_as_they_were),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
