/* test_stream.c - output appears whole or not at all. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/input.h"
#include "base/memory.h"
#include "base/stream.h"
#include "tests/memory_faults.h"
#include "tests/temporary.h"

static struct stream *open_stream(const char *path) {
  struct stream *stream;
  recto_error error;
  if (stream_open(&stream, path, &error) != RECTO_OK)
    fail_msg("%s: %s", error.file, error.text);
  return stream;
}

static void assert_file(const char *path, const char *text) {
  size_t count = 0;
  char *bytes = temporary_read(path, &count);
  assert_non_null(bytes);
  assert_int_equal(count, strlen(text));
  assert_string_equal(bytes, text);
  free(bytes);
}

static bool exists(const char *path) {
  struct stat about;
  return stat(path, &about) == 0;
}

/* ---- Files --------------------------------------------------------------- */

static void a_file_appears_when_it_is_finished(void **state) {
  const char *path = temporary_path(state, "out.txt");
  struct stream *stream = open_stream(path);
  stream_text(stream, "one ");
  stream_write(stream, "two\0", 4);
  stream_number(stream, -1.25, 1);
  stream_text(stream, " ");
  stream_int(stream, -42);
  assert_false(exists(path));
  assert_int_equal(stream_status(stream), RECTO_OK);
  recto_error error;
  assert_int_equal(stream_finish(stream, &error), RECTO_OK);
  size_t count;
  char *bytes = temporary_read(path, &count);
  assert_non_null(bytes);
  assert_int_equal(count, 16);
  assert_memory_equal(bytes, "one two\0-1.3 -42", 16);
  free(bytes);
  assert_int_equal(temporary_count(state), 1);
}

static void a_file_larger_than_the_buffer_is_whole(void **state) {
  const char *path = temporary_path(state, "out.txt");
  enum { LINES = 60000, BLOCK = 300000 };
  char *block = malloc(BLOCK);
  assert_non_null(block);
  memset(block, 'b', BLOCK);
  struct stream *stream = open_stream(path);
  for (int i = 0; i < LINES; i++)
    stream_text(stream, "0123456789\n");
  stream_write(stream, block, BLOCK);
  stream_write(stream, NULL, 0);
  stream_text(stream, "end");
  assert_int_equal(stream_finish(stream, NULL), RECTO_OK);
  size_t count;
  char *bytes = temporary_read(path, &count);
  assert_non_null(bytes);
  assert_int_equal(count, 11 * LINES + BLOCK + 3);
  assert_memory_equal(bytes + 11 * (LINES - 1), "0123456789\n", 11);
  assert_memory_equal(bytes + 11 * LINES, block, BLOCK);
  assert_string_equal(bytes + 11 * LINES + BLOCK, "end");
  free(bytes);
  free(block);
}

static void a_discarded_file_was_never_there(void **state) {
  const char *path = temporary_path(state, "out.txt");
  struct stream *stream = open_stream(path);
  for (int i = 0; i < 100000; i++)
    stream_text(stream, "much text");
  stream_discard(stream);
  assert_int_equal(temporary_count(state), 0);
  temporary_file(state, "out.txt", "old", 3);
  stream = open_stream(path);
  stream_text(stream, "new");
  stream_discard(stream);
  assert_file(path, "old");
  assert_int_equal(temporary_count(state), 1);
  stream_discard(NULL);
}

/* Writes `blocks` of 64 KiB; the n-th physical write fails. */
static recto_status write_failing(const char *path, int blocks, unsigned long n,
                                  recto_error *error) {
  static char block[1 << 16];
  memset(block, 'x', sizeof block);
  struct stream *stream = open_stream(path);
  stream_fail_after(n);
  for (int i = 0; i < blocks; i++)
    stream_write(stream, block, sizeof block - 1);
  recto_status sticky = stream_status(stream);
  recto_status status = stream_finish(stream, error);
  stream_fail_after(0);
  if (sticky != RECTO_OK)
    assert_int_equal(status, sticky);
  return status;
}

static void a_write_that_fails_leaves_the_old_file(void **state) {
  const char *path = temporary_file(state, "out.txt", "old", 3);
  for (unsigned long n = 1; n <= 5; n++) {
    recto_error error;
    assert_int_equal(write_failing(path, 5, n, &error), RECTO_ERROR_IO);
    assert_int_equal(error.code, RECTO_ERROR_IO);
    assert_string_equal(error.file, path);
    assert_string_equal(error.text, "cannot write: No space left on device");
    assert_file(path, "old");
    assert_int_equal(temporary_count(state), 1);
  }
  assert_int_equal(write_failing(path, 5, 6, NULL), RECTO_OK);
  struct stat about;
  assert_int_equal(stat(path, &about), 0);
  assert_int_equal(about.st_size, 5 * ((1 << 16) - 1));
}

static void a_full_device_is_an_error(void **state) {
  (void)state;
  if (!exists("/dev/full"))
    skip();
  struct stream *stream = open_stream("/dev/full");
  stream_text(stream, "text");
  assert_int_equal(stream_status(stream), RECTO_OK); /* held back */
  recto_error error;
  assert_int_equal(stream_finish(stream, &error), RECTO_ERROR_IO);
  assert_string_equal(error.file, "/dev/full");
}

static void a_replaced_file_keeps_its_mode(void **state) {
  const char *path = temporary_file(state, "out.txt", "old", 3);
  assert_int_equal(chmod(path, 0640), 0);
  struct stream *stream = open_stream(path);
  stream_text(stream, "new");
  assert_int_equal(stream_finish(stream, NULL), RECTO_OK);
  struct stat about;
  assert_int_equal(stat(path, &about), 0);
  assert_int_equal(about.st_mode & 07777, 0640);
  assert_file(path, "new");
}

static void a_new_file_has_the_mode_that_umask_leaves(void **state) {
  const char *path = temporary_path(state, "out.txt");
  mode_t old = umask(027);
  struct stream *stream = open_stream(path);
  assert_int_equal(stream_finish(stream, NULL), RECTO_OK);
  umask(old);
  struct stat about;
  assert_int_equal(stat(path, &about), 0);
  assert_int_equal(about.st_mode & 07777, 0640);
  assert_int_equal(about.st_size, 0);
}

static void a_link_stays_and_its_file_is_replaced(void **state) {
  const char *path = temporary_file(state, "real.txt", "old", 3);
  const char *link = temporary_path(state, "link.txt");
  assert_int_equal(symlink("real.txt", link), 0);
  struct stream *stream = open_stream(link);
  stream_text(stream, "new");
  assert_int_equal(stream_finish(stream, NULL), RECTO_OK);
  struct stat about;
  assert_int_equal(lstat(link, &about), 0);
  assert_true(S_ISLNK(about.st_mode));
  assert_file(path, "new");
}

static void the_file_behind_a_link_is_made(void **state) {
  const char *path = temporary_path(state, "new.txt");
  const char *link = temporary_path(state, "link.txt");
  const char *other = temporary_path(state, "other.txt");
  assert_int_equal(symlink("link.txt", other), 0);
  assert_int_equal(symlink(path, link), 0);
  struct stream *stream = open_stream(other);
  stream_text(stream, "new");
  assert_int_equal(stream_finish(stream, NULL), RECTO_OK);
  struct stat about;
  assert_int_equal(lstat(other, &about), 0);
  assert_true(S_ISLNK(about.st_mode));
  assert_int_equal(lstat(link, &about), 0);
  assert_true(S_ISLNK(about.st_mode));
  assert_file(path, "new");
}

static void a_ring_of_links_is_an_error(void **state) {
  const char *a = temporary_path(state, "a"), *b = temporary_path(state, "b");
  assert_int_equal(symlink("b", a), 0);
  assert_int_equal(symlink("a", b), 0);
  struct stream *stream;
  recto_error error = {0};
  recto_status status = stream_open(&stream, a, &error);
  if (status == RECTO_OK) {
    stream_discard(stream);
    fail_msg("opened");
  }
  assert_int_equal(status, RECTO_ERROR_IO);
}

static void two_streams_in_one_folder_do_not_mix(void **state) {
  const char *a = temporary_path(state, "a"), *b = temporary_path(state, "b");
  struct stream *first = open_stream(a), *second = open_stream(b);
  stream_text(first, "first");
  stream_text(second, "second");
  assert_int_equal(stream_finish(first, NULL), RECTO_OK);
  assert_int_equal(stream_finish(second, NULL), RECTO_OK);
  assert_file(a, "first");
  assert_file(b, "second");
}

static void paths_that_cannot_be_written_are_reported(void **state) {
  struct stream *stream;
  recto_error error;
  const char *missing = temporary_path(state, "no/such/folder");
  assert_int_equal(stream_open(&stream, missing, &error), RECTO_ERROR_IO);
  assert_null(stream);
  assert_string_equal(error.file, missing);
  assert_string_equal(error.text, "cannot create: No such file or directory");
  assert_int_equal(stream_open(&stream, *state, &error), RECTO_ERROR_IO);
  assert_null(stream);
  assert_string_equal(error.text, "is a directory");
  assert_int_equal(stream_open(&stream, missing, NULL), RECTO_ERROR_IO);
  if (geteuid() == 0)
    return; /* root may write everywhere */
  const char *path = temporary_file(state, "kept.txt", "old", 3);
  assert_int_equal(chmod(path, 0444), 0);
  assert_int_equal(stream_open(&stream, path, &error), RECTO_ERROR_IO);
}

/* ---- Several streams ----------------------------------------------------- */

static void several_appear_together(void **state) {
  const char *a = temporary_path(state, "a"), *b = temporary_path(state, "b");
  struct stream *both[] = {open_stream(a), NULL, open_stream(b)};
  stream_text(both[0], "first");
  stream_text(both[2], "second");
  assert_int_equal(stream_finish_all(both, 3, NULL), RECTO_OK);
  assert_file(a, "first");
  assert_file(b, "second");
}

static void if_one_of_several_fails_none_is_written(void **state) {
  const char *a = temporary_path(state, "a");
  for (unsigned long n = 1; n <= 2; n++) {
    const char *b = temporary_file(state, "b", "old", 3);
    recto_error error;
    struct stream *both[] = {open_stream(a), open_stream(b)};
    stream_text(both[0], "first");
    stream_text(both[1], "second");
    stream_fail_after(n);
    assert_int_equal(stream_finish_all(both, 2, &error), RECTO_ERROR_IO);
    stream_fail_after(0);
    assert_string_equal(error.file, n == 1 ? a : b);
    assert_false(exists(a));
    assert_file(b, "old");
    assert_int_equal(temporary_count(state), 1);
  }
}

/* The folder of the second is gone when it is to appear. */
static void a_file_that_was_replaced_is_put_back(void **state) {
  const char *a = temporary_file(state, "a", "old", 3);
  const char *folder = temporary_path(state, "folder"),
             *moved = temporary_path(state, "moved"),
             *b = temporary_path(state, "folder/b");
  assert_int_equal(mkdir(folder, 0777), 0);
  struct stream *both[] = {open_stream(a), open_stream(b)};
  stream_text(both[0], "first");
  stream_text(both[1], "second");
  assert_int_equal(rename(folder, moved), 0);
  recto_error error;
  assert_int_equal(stream_finish_all(both, 2, &error), RECTO_ERROR_IO);
  assert_string_equal(error.file, b);
  assert_file(a, "old");
  assert_int_equal(rmdir(moved), 0);
  assert_int_equal(temporary_count(state), 1);
}

/* As names may be that differ in nothing that the file system knows. */
static void a_path_used_twice_is_refused_for_both(void **state) {
  const char *a = temporary_path(state, "a");
  recto_error error;
  struct stream *both[] = {open_stream(a), open_stream(a)};
  assert_true(stream_is_same(both[0], both[1]));
  stream_text(both[0], "first");
  stream_text(both[1], "second");
  assert_int_equal(stream_finish_all(both, 2, &error), RECTO_ERROR_ARGUMENT);
  assert_int_equal(temporary_count(state), 0);
}

static void a_file_of_two_names_is_written_in_place(void **state) {
  const char *a = temporary_file(state, "a", "old and long", 12);
  const char *b = temporary_path(state, "b");
  assert_int_equal(link(a, b), 0);
  struct stream *stream = open_stream(a);
  for (int i = 0; i < 100000; i++)
    stream_text(stream, "much text");
  assert_file(b, "old and long");
  stream_discard(stream);
  assert_file(b, "old and long");
  stream = open_stream(a);
  stream_text(stream, "new");
  assert_int_equal(stream_finish(stream, NULL), RECTO_OK);
  assert_file(a, "new");
  assert_file(b, "new");
}

/* ---- Descriptors --------------------------------------------------------- */

/* What a host writes to a standard stream that it has closed must not land in a
 * file of ours. */
static void a_closed_standard_descriptor_stays_closed(void **state) {
  const char *path = temporary_path(state, "out.txt");
  const char *old = temporary_file(state, "old.txt", "old", 3);
  for (int number = 0; number <= 2; number++) {
    int kept = dup(number);
    assert_true(kept > 2);
    close(number);
    struct stream *fresh = NULL, *replacing = NULL;
    struct input input;
    recto_status opened = stream_open(&fresh, path, NULL);
    recto_status reopened = stream_open(&replacing, old, NULL);
    recto_status loaded = input_load(&input, old, NULL);
    bool closed = write(number, "host", 4) < 0;
    recto_status status = opened;
    if (opened == RECTO_OK) {
      stream_text(fresh, "ours");
      status = stream_finish(fresh, NULL);
    }
    stream_discard(replacing);
    dup2(kept, number);
    close(kept);
    assert_int_equal(opened, RECTO_OK);
    assert_int_equal(reopened, RECTO_OK);
    assert_int_equal(loaded, RECTO_OK);
    assert_string_equal(input.bytes, "old");
    input_unload(&input);
    assert_true(closed);
    assert_int_equal(status, RECTO_OK);
    assert_file(path, "ours");
  }
}

/* ---- Compressed ---------------------------------------------------------- */

static void what_is_compressed_is_read_again(void **state) {
  const char *path = temporary_path(state, "out.gz");
  struct stream *stream = open_stream(path);
  recto_error error;
  recto_status status = stream_compress(stream, &error);
  if (status == RECTO_ERROR_UNSUPPORTED) {
    stream_discard(stream);
    skip();
  }
  assert_int_equal(status, RECTO_OK);
  for (int i = 0; i < 300000; i++)
    stream_int(stream, (int64_t)i * i);
  assert_int_equal(stream_finish(stream, NULL), RECTO_OK);
  struct input input;
  assert_int_equal(input_load(&input, path, NULL), RECTO_OK);
  const char *at = input.bytes;
  for (int i = 0; i < 300000; i++) {
    char expected[32];
    int length = snprintf(expected, sizeof expected, "%lld", (long long)i * i);
    assert_memory_equal(at, expected, (size_t)length);
    at += length;
  }
  assert_ptr_equal(at, input.bytes + input.count);
  input_unload(&input);
}

/* ---- Standard output ----------------------------------------------------- */

static void standard_output_is_held_back_until_the_end(void **state) {
  const char *path = temporary_file(state, "stdout.txt", "", 0);
  fflush(stdout);
  int old = dup(STDOUT_FILENO);
  assert_true(old >= 0);
  assert_non_null(freopen(path, "w", stdout));
  struct stat about;
  struct stream *stream = open_stream("-");
  for (int i = 0; i < 100000; i++)
    stream_text(stream, "text\n");
  int held = fstat(STDOUT_FILENO, &about) == 0 && about.st_size == 0;
  recto_status status = stream_finish(stream, NULL);
  struct stream *dropped = open_stream("-");
  stream_text(dropped, "dropped");
  stream_discard(dropped);
  int size = fstat(STDOUT_FILENO, &about) == 0 ? (int)about.st_size : -1;
  fflush(stdout);
  dup2(old, STDOUT_FILENO);
  close(old);
  clearerr(stdout);
  assert_true(held);
  assert_int_equal(status, RECTO_OK);
  assert_int_equal(size, 500000);
}

/* ---- Memory -------------------------------------------------------------- */

static void a_memory_stream_lends_what_was_written(void **state) {
  (void)state;
  struct stream *stream;
  size_t count;
  assert_int_equal(stream_open_memory(&stream, NULL), RECTO_OK);
  assert_string_equal(stream_memory(stream, &count), "");
  assert_int_equal(count, 0);
  for (int i = 0; i < 100000; i++)
    stream_text(stream, "12345678");
  const char *bytes = stream_memory(stream, &count);
  assert_int_equal(count, 800000);
  assert_int_equal(strlen(bytes), 800000);
  assert_int_equal(stream_finish(stream, NULL), RECTO_OK);
}

static void the_first_fault_sticks(void **state) {
  (void)state;
  struct stream *stream;
  size_t count;
  recto_error error;
  char large[1000] = {0};
  assert_int_equal(stream_open_memory(&stream, NULL), RECTO_OK);
  stream_text(stream, "before");
  mem_fail_after(1);
  for (int i = 0; i < 100; i++)
    stream_write(stream, large, sizeof large);
  mem_fail_after(0);
  assert_int_equal(stream_status(stream), RECTO_ERROR_MEMORY);
  stream_memory(stream, &count);
  size_t at_fault = count;
  stream_text(stream, "after");
  stream_memory(stream, &count);
  assert_int_equal(count, at_fault);
  assert_int_equal(stream_finish(stream, &error), RECTO_ERROR_MEMORY);
  assert_int_equal(error.code, RECTO_ERROR_MEMORY);
}

static void running_out_of_memory_leaves_no_file(void **state) {
  const char *path = temporary_path(state, "out.txt");
  struct memory_faults faults = {.least = 3};
  while (memory_faults_go_on(&faults)) {
    assert_int_equal(temporary_count(state), 0);
    struct stream *stream;
    memory_faults_begin(&faults);
    recto_status status = stream_open(&stream, path, NULL);
    if (status == RECTO_OK) {
      stream_text(stream, "text");
      status = stream_finish(stream, NULL);
    }
    memory_faults_end(&faults, status);
  }
  assert_file(path, "text");
}

int main(void) {
#define T(name)                                                                \
  cmocka_unit_test_setup_teardown(name, temporary_set_up, temporary_tear_down)
  const struct CMUnitTest tests[] = {
      T(a_file_appears_when_it_is_finished),
      T(a_file_larger_than_the_buffer_is_whole),
      T(a_discarded_file_was_never_there),
      T(a_write_that_fails_leaves_the_old_file),
      T(a_full_device_is_an_error),
      T(a_replaced_file_keeps_its_mode),
      T(a_new_file_has_the_mode_that_umask_leaves),
      T(a_link_stays_and_its_file_is_replaced),
      T(the_file_behind_a_link_is_made),
      T(a_ring_of_links_is_an_error),
      T(two_streams_in_one_folder_do_not_mix),
      T(paths_that_cannot_be_written_are_reported),
      T(several_appear_together),
      T(if_one_of_several_fails_none_is_written),
      T(a_file_that_was_replaced_is_put_back),
      T(a_path_used_twice_is_refused_for_both),
      T(a_file_of_two_names_is_written_in_place),
      T(a_closed_standard_descriptor_stays_closed),
      T(what_is_compressed_is_read_again),
      T(standard_output_is_held_back_until_the_end),
      T(a_memory_stream_lends_what_was_written),
      T(the_first_fault_sticks),
      T(running_out_of_memory_leaves_no_file),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
