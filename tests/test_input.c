/* test_input.c - the file behind a path is read to its end or refused: files
 * that change meanwhile, pipes, devices, gzip data. */
#include <fcntl.h>
#include <setjmp.h>
#include <signal.h>
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

#include "base/gunzip.h"
#include "base/input.h"
#include "scene/read.h"
#include "tests/memory_faults.h"
#include "tests/reading.h"
#include "tests/temporary.h"

#ifdef HAVE_ZLIB
#include <zlib.h>
#endif

static const char triangle[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/* Loads the path, which must come to `status`; its text where it fails. */
static void assert_loads(const char *path, recto_status status,
                         const char *text) {
  struct input input;
  recto_error error = {0};
  assert_int_equal(input_load(&input, path, &error), status);
  if (status == RECTO_OK) {
    assert_int_equal(input.count, strlen(text));
    assert_string_equal(input.bytes, text); /* a NUL stands behind */
  } else {
    assert_int_equal(error.code, status);
    assert_string_equal(error.file, path);
    assert_non_null(strstr(error.text, text));
  }
  input_unload(&input);
}

static void assert_reads_one_face(const char *path, const char *format) {
  struct reading r;
  reading_init(&r);
  if (scene_read(&r.scene, path, format, NULL, &r.error) != RECTO_OK)
    fail_msg("%s: %s", r.error.file, r.error.text);
  assert_int_equal(scene_face_count(&r.scene), 1);
  reading_fini(&r);
}

/* ---- What a path may name ------------------------------------------------ */

static void an_endless_device_is_refused(void **state) {
  (void)state;
  assert_loads("/dev/zero", RECTO_ERROR_LIMIT, "larger than 64 MB");
}

/* A sparse file takes no room. */
static void a_file_larger_than_memory_is_refused(void **state) {
  const char *path = temporary_file(state, "a.obj", "v", 1);
  if (truncate(path, (off_t)input_size_max() + 1) != 0) {
    print_message("no sparse files here\n");
    skip();
  }
  assert_loads(path, RECTO_ERROR_LIMIT, "larger than");
}

static void a_file_that_may_not_be_read_is_refused(void **state) {
  const char *path = temporary_file(state, "a.obj", "v", 1);
  if (geteuid() == 0) {
    print_message("root may read all files\n");
    skip();
  }
  assert_int_equal(chmod(path, 0), 0);
  assert_loads(path, RECTO_ERROR_IO, "cannot open: Permission denied");
}

static void a_directory_is_refused(void **state) {
  assert_loads(*state, RECTO_ERROR_IO, "cannot read: Is a directory");
}

/* Runs a process that writes the triangle to the path. */
static pid_t start_writer(const char *path) {
  pid_t child = fork();
  assert_true(child >= 0);
  if (child > 0)
    return child;
  int descriptor = open(path, O_WRONLY);
  ssize_t size = sizeof triangle - 1;
  _exit(write(descriptor, triangle, sizeof triangle - 1) != size);
}

static void assert_ended(pid_t child) {
  int status;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_int_equal(status, 0);
}

static void a_named_pipe_is_read_to_its_end(void **state) {
  const char *path = temporary_path(state, "a.obj");
  assert_int_equal(mkfifo(path, 0600), 0);
  pid_t child = start_writer(path);
  assert_reads_one_face(path, NULL);
  assert_ended(child);
}

static void a_descriptor_has_a_path_too(void **state) {
  const char *path =
      temporary_file(state, "a.obj", triangle, sizeof triangle - 1);
  int descriptor = open(path, O_RDONLY);
  char name[64];
  snprintf(name, sizeof name, "/proc/self/fd/%d", descriptor);
  assert_reads_one_face(name, "obj");
  close(descriptor);
  int old = dup(STDIN_FILENO), ends[2];
  assert_int_equal(pipe(ends), 0);
  assert_int_equal(write(ends[1], triangle, sizeof triangle - 1),
                   sizeof triangle - 1);
  close(ends[1]);
  dup2(ends[0], STDIN_FILENO);
  close(ends[0]);
  assert_reads_one_face("/dev/stdin", "obj");
  dup2(old, STDIN_FILENO);
  close(old);
}

/* ---- Files that change --------------------------------------------------- */

/* Cuts the file short and makes it whole again, for ever. */
static pid_t start_cutting(const char *path, off_t size) {
  pid_t child = fork();
  assert_true(child >= 0);
  if (child > 0)
    return child;
  while (truncate(path, 100) == 0 && truncate(path, size) == 0)
    continue;
  _exit(1);
}

/* A mapped file would end the process with SIGBUS. */
static void a_file_that_is_cut_short_meanwhile_is_survived(void **state) {
  enum { SIZE = 4 << 20, TIMES = 300 };
  char *text = malloc(SIZE);
  assert_non_null(text);
  memset(text, '\n', SIZE);
  memcpy(text, triangle, sizeof triangle - 1);
  const char *path = temporary_file(state, "a.obj", text, SIZE);
  free(text);
  pid_t child = start_cutting(path, SIZE);
  for (int i = 0; i < TIMES; i++) {
    struct reading r;
    reading_init(&r);
    recto_status status = scene_read(&r.scene, path, NULL, NULL, &r.error);
    /* What was cut off comes back as zeros, which are no text. */
    assert_true(status == RECTO_OK || status == RECTO_ERROR_IO ||
                status == RECTO_ERROR_FORMAT);
    if (status == RECTO_OK)
      assert_int_equal(scene_face_count(&r.scene), 1);
    reading_fini(&r);
  }
  kill(child, SIGKILL);
  assert_int_equal(waitpid(child, NULL, 0), child);
}

/* ---- gzip ---------------------------------------------------------------- */

#ifdef HAVE_ZLIB

/* Compresses into `to`, of `room` bytes; returns how many there are then. */
static size_t compress_text(const char *text, size_t count, char *to,
                            size_t room) {
  z_stream stream = {.zalloc = Z_NULL};
  assert_int_equal(deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 8,
                                Z_DEFAULT_STRATEGY),
                   Z_OK);
  stream.next_in = (z_const Bytef *)(uintptr_t)text;
  stream.avail_in = (uInt)count;
  stream.next_out = (Bytef *)to;
  stream.avail_out = (uInt)room;
  assert_int_equal(deflate(&stream, Z_FINISH), Z_STREAM_END);
  size_t length = room - stream.avail_out;
  deflateEnd(&stream);
  return length;
}

static size_t compress_triangle(char to[200]) {
  return compress_text(triangle, sizeof triangle - 1, to, 200);
}

static void compressed_models_are_read(void **state) {
  char bytes[200];
  size_t count = compress_triangle(bytes);
  assert_reads_one_face(temporary_file(state, "a.obj.gz", bytes, count), NULL);
  assert_reads_one_face(temporary_file(state, "b.c.OBJ.GZ", bytes, count),
                        NULL);
  assert_reads_one_face(temporary_file(state, "a.obj", bytes, count), NULL);
  assert_reads_one_face(temporary_file(state, "plain", bytes, count), "obj");
  int old = dup(STDIN_FILENO), ends[2];
  assert_int_equal(pipe(ends), 0);
  assert_int_equal(write(ends[1], bytes, count), count);
  close(ends[1]);
  dup2(ends[0], STDIN_FILENO);
  close(ends[0]);
  assert_reads_one_face("-", "obj");
  dup2(old, STDIN_FILENO);
  close(old);
}

static void a_compressed_file_needs_an_extension_before_gz(void **state) {
  char bytes[200];
  size_t count = compress_triangle(bytes);
  struct reading r;
  reading_init(&r);
  assert_int_equal(scene_read(&r.scene,
                              temporary_file(state, "a.gz", bytes, count), NULL,
                              NULL, &r.error),
                   RECTO_ERROR_UNSUPPORTED);
  assert_non_null(strstr(r.error.text, "no extension"));
  reading_fini(&r);
}

static void members_are_joined_and_padding_is_passed_over(void **state) {
  char bytes[1000];
  size_t half = sizeof triangle / 2;
  size_t count = compress_text(triangle, half, bytes, 200);
  count += compress_text(triangle + half, sizeof triangle - 1 - half,
                         bytes + count, 200);
  assert_loads(temporary_file(state, "a.gz", bytes, count), RECTO_OK, triangle);
  memset(bytes + count, 0, 512);
  assert_loads(temporary_file(state, "a.gz", bytes, count + 512), RECTO_OK,
               triangle);
  bytes[count + 3] = 'x';
  assert_loads(temporary_file(state, "a.gz", bytes, count + 512),
               RECTO_ERROR_FORMAT, "broken gzip data");
}

static void compressed_data_cut_short_are_an_error(void **state) {
  char bytes[200];
  size_t count = compress_triangle(bytes);
  for (size_t cut = 4; cut < count; cut++)
    assert_loads(temporary_file(state, "a.gz", bytes, cut), RECTO_ERROR_FORMAT,
                 "gzip data cut short");
}

/* Each bit of the data and of what checks them, but for those that fill the
 * last byte of the data. */
static void compressed_data_that_were_changed_are_an_error(void **state) {
  enum { HEADER = 10, CHECKS = 8 };
  char bytes[200];
  size_t count = compress_triangle(bytes), harmless = 0;
  for (size_t bit = 8 * HEADER; bit < 8 * count; bit++) {
    bytes[bit / 8] = (char)(bytes[bit / 8] ^ 1 << bit % 8);
    const char *path = temporary_file(state, "a.gz", bytes, count);
    if (bit / 8 == count - CHECKS - 1) {
      struct input input;
      harmless += input_load(&input, path, NULL) == RECTO_OK;
      input_unload(&input);
    } else {
      assert_loads(path, RECTO_ERROR_FORMAT, "gzip data");
    }
    bytes[bit / 8] = (char)(bytes[bit / 8] ^ 1 << bit % 8);
  }
  assert_true(harmless < 8);
}

/* A mebibyte of line feeds, so often that they are more than is allowed. */
static void data_that_expand_too_much_are_an_error(void **state) {
  enum { PART = 1 << 20, PARTS = (int)(GUNZIP_SIZE_ALWAYS_ALLOWED / PART) + 1 };
  char *text = malloc(PART), *bytes = malloc((size_t)PARTS * 2000);
  assert_non_null(text);
  assert_non_null(bytes);
  memset(text, '\n', PART);
  size_t count = compress_text(text, PART, bytes, 2000);
  for (size_t i = 1; i < PARTS; i++)
    memcpy(bytes + i * count, bytes, count);
  assert_loads(temporary_file(state, "a.gz", bytes, PARTS * count),
               RECTO_ERROR_LIMIT, "gzip data that expand to more than 256 MB");
  free(text);
  free(bytes);
}

static void running_out_of_memory_while_expanding_is_an_error(void **state) {
  char bytes[200];
  size_t count = compress_triangle(bytes);
  const char *path = temporary_file(state, "a.gz", bytes, count);
  struct memory_faults faults = {.least = 3};
  while (memory_faults_go_on(&faults)) {
    struct input input;
    memory_faults_begin(&faults);
    recto_status status = input_load(&input, path, NULL);
    memory_faults_end(&faults, status);
    input_unload(&input);
  }
}

#else

static void compressed_models_are_refused_by_name(void **state) {
  static const char bytes[] = "\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x00";
  assert_loads(temporary_file(state, "a.obj.gz", bytes, sizeof bytes - 1),
               RECTO_ERROR_UNSUPPORTED, "this build is without zlib");
}

#endif

int main(void) {
#define T(name)                                                                \
  cmocka_unit_test_setup_teardown(name, temporary_set_up, temporary_tear_down)
  const struct CMUnitTest tests[] = {
      T(an_endless_device_is_refused),
      T(a_file_larger_than_memory_is_refused),
      T(a_file_that_may_not_be_read_is_refused),
      T(a_directory_is_refused),
      T(a_named_pipe_is_read_to_its_end),
      T(a_descriptor_has_a_path_too),
      T(a_file_that_is_cut_short_meanwhile_is_survived),
#ifdef HAVE_ZLIB
      T(compressed_models_are_read),
      T(a_compressed_file_needs_an_extension_before_gz),
      T(members_are_joined_and_padding_is_passed_over),
      T(compressed_data_cut_short_are_an_error),
      T(compressed_data_that_were_changed_are_an_error),
      T(data_that_expand_too_much_are_an_error),
      T(running_out_of_memory_while_expanding_is_an_error),
#else
      T(compressed_models_are_refused_by_name),
#endif
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
