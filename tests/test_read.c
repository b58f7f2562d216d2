/* test_read.c - files, pipes and standard input reach the right reader, and a
 * failure leaves the scene unchanged. */
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "scene/read.h"
#include "tests/memory_faults.h"
#include "tests/reading.h"
#include "tests/temporary.h"

static const char triangle[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
static const char solid[] =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 5\nvertex 1 0 5\n"
    "vertex 0 1 5\nendloop\nendfacet\nendsolid s\n";

static recto_status read_path(struct reading *r, const char *path,
                              const char *format) {
  r->diagnostics.file = path;
  r->status = scene_read(&r->scene, path, format, &r->diagnostics, &r->error);
  return r->status;
}

static void assert_reads(const char *path, const char *format, uint32_t faces) {
  struct reading r;
  reading_init(&r);
  if (read_path(&r, path, format) != RECTO_OK)
    fail_msg("%s: %s", r.error.file, r.error.text);
  assert_int_equal(scene_face_count(&r.scene), faces);
  assert_null(reading_fault(&r.scene));
  reading_fini(&r);
}

static void assert_refused(const char *path, const char *format,
                           recto_status status, const char *text) {
  struct reading r;
  reading_init(&r);
  assert_int_equal(read_path(&r, path, format), status);
  assert_int_equal(r.error.code, status);
  assert_string_equal(r.error.file, path);
  assert_non_null(strstr(r.error.text, text));
  assert_int_equal(scene_read(&r.scene, path, format, NULL, NULL), status);
  reading_fini(&r);
}

/* ---- The reader ---------------------------------------------------------- */

static void the_extension_chooses_the_reader(void **state) {
  size_t size = sizeof triangle - 1;
  assert_reads(temporary_file(state, "a.obj", triangle, size), NULL, 1);
  assert_reads(temporary_file(state, "a.b.OBJ", triangle, size), NULL, 1);
  assert_reads(temporary_file(state, "b.stl", solid, sizeof solid - 1), NULL,
               1);
}

static void the_format_wins_over_the_extension(void **state) {
  size_t size = sizeof triangle - 1;
  const char *path = temporary_file(state, "a.stl", triangle, size);
  assert_reads(path, "obj", 1);
  assert_reads(path, "OBJ", 1);
  assert_refused(path, "stl", RECTO_ERROR_FORMAT, "neither a text");
  assert_reads(temporary_file(state, "plain", triangle, size), "obj", 1);
}

static void what_no_reader_knows_is_refused(void **state) {
  size_t size = sizeof triangle - 1;
  assert_refused(temporary_file(state, "a.xyzzy", triangle, size), NULL,
                 RECTO_ERROR_UNSUPPORTED, "no reader for the format 'xyzzy'");
  assert_refused(temporary_file(state, "plain", triangle, size), NULL,
                 RECTO_ERROR_UNSUPPORTED, "no extension");
  assert_refused(temporary_file(state, ".obj", triangle, size), NULL,
                 RECTO_ERROR_UNSUPPORTED, "no extension");
  assert_refused(temporary_file(state, "a.obj.", triangle, size), NULL,
                 RECTO_ERROR_UNSUPPORTED, "no extension");
  assert_refused(temporary_file(state, "a.obj", triangle, size), "xyzzy",
                 RECTO_ERROR_UNSUPPORTED, "no reader for the format 'xyzzy'");
  assert_refused("-", NULL, RECTO_ERROR_UNSUPPORTED, "standard input");
}

static void the_first_file_says_what_up_is(void **state) {
  const char *obj =
      temporary_file(state, "a.obj", triangle, sizeof triangle - 1);
  const char *stl = temporary_file(state, "b.stl", solid, sizeof solid - 1);
  struct reading r;
  reading_init(&r);
  assert_true(r.scene.up[1] == 1 && r.scene.up[2] == 0);
  assert_int_equal(read_path(&r, stl, NULL), RECTO_OK);
  assert_true(r.scene.up[1] == 0 && r.scene.up[2] == 1);
  assert_int_equal(read_path(&r, obj, NULL), RECTO_OK);
  assert_true(r.scene.up[1] == 0 && r.scene.up[2] == 1);
  assert_int_equal(scene_face_count(&r.scene), 2);
  reading_fini(&r);
  reading_init(&r);
  assert_int_equal(read_path(&r, obj, NULL), RECTO_OK);
  assert_int_equal(read_path(&r, stl, NULL), RECTO_OK);
  assert_true(r.scene.up[1] == 1 && r.scene.up[2] == 0);
  reading_fini(&r);
}

/* ---- The bytes ----------------------------------------------------------- */

static void files_that_cannot_be_read_are_reported(void **state) {
  assert_refused(temporary_path(state, "none.obj"), NULL, RECTO_ERROR_IO,
                 "cannot open: No such file or directory");
  assert_refused(*state, "obj", RECTO_ERROR_IO, "cannot read: Is a directory");
  assert_refused(temporary_file(state, "empty.obj", "", 0), NULL,
                 RECTO_ERROR_FORMAT, "the file is empty");
  assert_refused("/dev/null", "stl", RECTO_ERROR_FORMAT, "the file is empty");
}

/* A file as long as pages of memory still has its NUL behind. */
static void a_file_of_whole_pages_is_read(void **state) {
  size_t page = (size_t)sysconf(_SC_PAGESIZE);
  for (size_t pages = 1; pages <= 3; pages++)
    for (int shift = -1; shift <= 1; shift++) {
      size_t size = pages * page + (size_t)shift;
      char *text = malloc(size);
      assert_non_null(text);
      memset(text, ' ', size);
      memcpy(text, triangle, sizeof triangle - 1);
      /* The last byte is the last digit of an index. */
      memcpy(text + size - 7, "f 1 2 3", 7);
      assert_reads(temporary_file(state, "a.obj", text, size), NULL, 2);
      free(text);
    }
}

/* Runs `write` in a process of its own whose output is our standard input, or
 * the pipe of that path, while we read. */
static void read_from_pipe(const char *text, size_t count, const char *format,
                           uint32_t faces) {
  int ends[2], old = dup(STDIN_FILENO);
  assert_int_equal(pipe(ends), 0);
  fflush(NULL);
  pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    for (size_t done = 0; done < count;) {
      size_t part = count - done < 1000 ? count - done : 1000;
      ssize_t written = write(ends[1], text + done, part);
      if (written <= 0)
        _exit(1);
      done += (size_t)written;
    }
    _exit(0);
  }
  close(ends[1]);
  dup2(ends[0], STDIN_FILENO);
  close(ends[0]);
  assert_reads("-", format, faces);
  dup2(old, STDIN_FILENO);
  close(old);
  int status;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_int_equal(status, 0);
}

static void standard_input_may_be_a_pipe(void **state) {
  (void)state;
  read_from_pipe(triangle, sizeof triangle - 1, "obj", 1);
  read_from_pipe(solid, sizeof solid - 1, "stl", 1);
  enum { COUNT = 30000 };
  size_t size = sizeof triangle - 1;
  char *text = malloc(COUNT * 8 + size), *to = text;
  assert_non_null(text);
  to += sprintf(to, "%s", triangle);
  for (int i = 1; i < COUNT; i++)
    to += sprintf(to, "f 1 2 3\n");
  read_from_pipe(text, (size_t)(to - text), "obj", COUNT);
  free(text);
}

static void standard_input_may_be_a_file(void **state) {
  const char *path =
      temporary_file(state, "a.obj", triangle, sizeof triangle - 1);
  int old = dup(STDIN_FILENO), file = open(path, O_RDONLY);
  dup2(file, STDIN_FILENO);
  assert_reads("-", "obj", 1);
  /* What was read of it already is not read again. */
  assert_int_equal(lseek(STDIN_FILENO, 8, SEEK_SET), 8);
  struct reading r;
  reading_init(&r);
  assert_int_equal(read_path(&r, "-", "obj"), RECTO_OK);
  assert_int_equal(r.scene.point.count, 2);
  reading_fini(&r);
  dup2(old, STDIN_FILENO);
  close(old);
  close(file);
}

/* ---- Failures ------------------------------------------------------------ */

static void fill(struct reading *r, void **state) {
  reading_init(r);
  const char *path =
      temporary_file(state, "first.obj", triangle, sizeof triangle - 1);
  assert_int_equal(read_path(r, path, NULL), RECTO_OK);
}

static void a_broken_file_leaves_the_scene_as_it_was(void **state) {
  static const char broken[] =
      "v 0 0 1\nv 1 0 1\nv nan 0 0\nv 0 1 1\ng new\nf 1 2 4\nl 1 2\n"
      "f 1 2 3\nusemtl more\nf 1 2 4\nf 1 2";
  const char *path = temporary_file(state, "b.obj", broken, sizeof broken - 1);
  struct reading r, untouched;
  fill(&r, state);
  fill(&untouched, state);
  for (int i = 0; i < 3; i++) {
    assert_int_equal(read_path(&r, path, NULL), RECTO_ERROR_FORMAT);
    assert_int_equal(r.error.line, 11);
    assert_true(reading_same(&r.scene, &untouched.scene));
    assert_int_equal(r.scene.current_group, untouched.scene.current_group);
    assert_null(reading_fault(&r.scene));
  }
  reading_fini(&r);
  reading_fini(&untouched);
}

static void running_out_of_memory_leaves_the_scene_as_it_was(void **state) {
  static const char text[] = "v 0 0 1\nv 1 0 1\nv nan 0 0\nv 0 1 1\ng new\n"
                             "f 1 2 4\nl 1 2\nf 1 2 3\nf 5 4 2\nv 7 7 7\n";
  const char *path = temporary_file(state, "b.obj", text, sizeof text - 1);
  struct reading untouched;
  fill(&untouched, state);
  struct memory_faults faults = {.least = 2};
  while (memory_faults_go_on(&faults)) {
    struct reading r;
    fill(&r, state);
    memory_faults_begin(&faults);
    recto_status status = read_path(&r, path, NULL);
    memory_faults_end(&faults, status);
    if (status == RECTO_ERROR_MEMORY)
      assert_true(reading_same(&r.scene, &untouched.scene));
    assert_null(reading_fault(&r.scene));
    reading_fini(&r);
  }
  reading_fini(&untouched);
}

/* Address space that is never written to takes no memory. */
static void more_triangles_than_the_limit_are_refused(void **state) {
  (void)state;
  size_t triangles = UINT32_C(0x80000000) / 3 + 1, size = 84 + 50 * triangles;
  char *bytes = mmap(NULL, size, PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (bytes == MAP_FAILED) {
    print_message("not so much address space here\n");
    skip();
  }
  for (int i = 0; i < 4; i++)
    bytes[80 + i] = (char)(triangles >> 8 * i & 255);
  struct reading r;
  reading_init(&r);
  assert_int_equal(reader_stl.read(&r.scene, bytes, size, "file", "stl",
                                   &r.diagnostics, &r.error),
                   RECTO_ERROR_LIMIT);
  assert_non_null(strstr(r.error.text, "triangles are too many"));
  reading_fini(&r);
  munmap(bytes, size);
}

static void faults_are_summed_up_at_the_end(void **state) {
  char text[1000], *to = text;
  to += sprintf(to, "%s", triangle);
  for (int i = 0; i < 9; i++)
    to += sprintf(to, "f 1 1 1\n");
  const char *path = temporary_file(state, "a.obj", text, (size_t)(to - text));
  struct reading r;
  reading_init(&r);
  for (int i = 1; i <= 2; i++) {
    assert_int_equal(read_path(&r, path, NULL), RECTO_OK);
    assert_int_equal(r.warnings, 4 * i);
    assert_string_equal(r.warning[4 * i - 1],
                        "0: ... and 6 more with too few distinct corners");
  }
  reading_fini(&r);
}

int main(void) {
#define T(name)                                                                \
  cmocka_unit_test_setup_teardown(name, temporary_set_up, temporary_tear_down)
  const struct CMUnitTest tests[] = {
      T(the_extension_chooses_the_reader),
      T(the_format_wins_over_the_extension),
      T(what_no_reader_knows_is_refused),
      T(the_first_file_says_what_up_is),
      T(files_that_cannot_be_read_are_reported),
      T(a_file_of_whole_pages_is_read),
      T(standard_input_may_be_a_pipe),
      T(standard_input_may_be_a_file),
      T(a_broken_file_leaves_the_scene_as_it_was),
      T(running_out_of_memory_leaves_the_scene_as_it_was),
      T(more_triangles_than_the_limit_are_refused),
      T(faults_are_summed_up_at_the_end),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
