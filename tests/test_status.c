/* test_status.c - the error record is filled, never overrun, and clean. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "base/status.h"

static void every_status_has_a_name_of_its_own(void **state) {
  (void)state;
  for (int i = 0; i < RECTO_STATUS_COUNT; i++) {
    const char *name = recto_status_name((recto_status)i);
    assert_true(*name != '\0');
    assert_string_not_equal(name, "unknown");
    for (int k = 0; k < i; k++)
      assert_string_not_equal(name, recto_status_name((recto_status)k));
  }
  assert_string_equal(recto_status_name(RECTO_STATUS_COUNT), "unknown");
  assert_string_equal(recto_status_name((recto_status)-1), "unknown");
}

static void the_record_holds_what_it_was_given(void **state) {
  (void)state;
  recto_error error;
  assert_int_equal(error_set(&error, RECTO_ERROR_FORMAT, "a/b.obj", 17,
                             "%s with %d", "face", 3),
                   RECTO_ERROR_FORMAT);
  assert_int_equal(error.code, RECTO_ERROR_FORMAT);
  assert_string_equal(error.file, "a/b.obj");
  assert_int_equal(error.line, 17);
  assert_string_equal(error.text, "face with 3");
  error_set(&error, RECTO_ERROR_LIMIT, NULL, 0, "too many");
  assert_string_equal(error.file, "");
  assert_int_equal(error_memory(&error), RECTO_ERROR_MEMORY);
  assert_int_equal(error.code, RECTO_ERROR_MEMORY);
}

static void a_missing_record_is_accepted(void **state) {
  (void)state;
  assert_int_equal(error_set(NULL, RECTO_ERROR_IO, "f", 1, "text"),
                   RECTO_ERROR_IO);
  assert_int_equal(error_memory(NULL), RECTO_ERROR_MEMORY);
}

static void a_long_path_keeps_its_tail(void **state) {
  (void)state;
  char path[1000];
  recto_error error;
  memset(path, 'x', sizeof path);
  strcpy(path + 900, "/the-file.obj");
  error_set(&error, RECTO_ERROR_IO, path, 0, "text");
  assert_int_equal(strlen(error.file), sizeof error.file - 1);
  assert_memory_equal(error.file, "...x", 4);
  assert_string_equal(strrchr(error.file, '/'), "/the-file.obj");
  /* One that just fits is whole. */
  path[sizeof error.file - 1] = '\0';
  error_set(&error, RECTO_ERROR_IO, path, 0, "text");
  assert_string_equal(error.file, path);
}

static void a_long_text_is_cut_between_characters(void **state) {
  (void)state;
  char text[600];
  recto_error error;
  for (size_t shift = 0; shift < 4; shift++) {
    memset(text, 'x', shift);
    for (size_t i = shift; i + 3 < sizeof text; i += 3)
      strcpy(text + i, "\xe2\x82\xac");
    error_set(&error, RECTO_ERROR_IO, "f", 0, "%s", text);
    size_t length = strlen(error.text);
    assert_true(length < sizeof error.text);
    assert_true(length >= sizeof error.text - 4);
    assert_int_equal((length - shift) % 3, 0);
    assert_memory_equal(error.text, text, length);
  }
}

static void a_text_has_no_control_characters(void **state) {
  (void)state;
  recto_error error;
  error_set(&error, RECTO_ERROR_FORMAT, "f", 1, "'%s'", "a\nb\x1b[2J\x7f");
  assert_string_equal(error.text, "'a?b?[2J?'");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_status_has_a_name_of_its_own),
      cmocka_unit_test(the_record_holds_what_it_was_given),
      cmocka_unit_test(a_missing_record_is_accepted),
      cmocka_unit_test(a_long_path_keeps_its_tail),
      cmocka_unit_test(a_long_text_is_cut_between_characters),
      cmocka_unit_test(a_text_has_no_control_characters),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
