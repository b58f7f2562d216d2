/* test_report.c - the report's JSON, with any text and any failing allocation.
 * */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "base/clock.h"
#include "base/memory.h"
#include "base/report.h"
#include "tests/comma_locale.h"

static int set_up(void **state) {
  *state = report_create();
  return *state ? 0 : -1;
}

static int tear_down(void **state) {
  report_destroy(*state);
  return 0;
}

static void an_empty_report_is_an_empty_object(void **state) {
  assert_string_equal(report_json(*state), "{}\n");
}

static void entries_are_in_order_of_first_mention(void **state) {
  struct report *report = *state;
  report_int(report, "scene", "points", 8);
  report_double(report, "time", "parse", 0.25);
  report_int(report, "scene", "faces", -6);
  report_text(report, "choice", "method", "newell");
  report_doubles(report, "choice", "matrix", (double[]){1, -0.5, 1e300}, 3);
  report_int(report, "scene", "points", 9);
  assert_string_equal(report_json(report), "{\n"
                                           "  \"scene\": {\n"
                                           "    \"points\": 9,\n"
                                           "    \"faces\": -6\n"
                                           "  },\n"
                                           "  \"time\": {\n"
                                           "    \"parse\": 0.25\n"
                                           "  },\n"
                                           "  \"choice\": {\n"
                                           "    \"method\": \"newell\",\n"
                                           "    \"matrix\": [1, -0.5, 1e300]\n"
                                           "  }\n"
                                           "}\n");
}

static void a_later_value_replaces_one_of_any_kind(void **state) {
  struct report *report = *state;
  report_text(report, "a", "b", "text");
  report_doubles(report, "a", "b", (double[]){1, 2}, 2);
  report_text(report, "a", "b", "other");
  report_double(report, "a", "b", 1.5);
  report_int(report, "a", "b", 3);
  report_doubles(report, "a", "b", NULL, 0);
  assert_string_equal(report_json(report), "{\n  \"a\": {\n    \"b\": []\n"
                                           "  }\n}\n");
}

static void adding_starts_from_zero(void **state) {
  struct report *report = *state;
  report_add(report, "newell", "tests", 3);
  report_add(report, "newell", "tests", 4);
  assert_int_equal(report_get(report, "newell", "tests", -1), 7);
  assert_int_equal(report_get(report, "newell", "splits", -1), -1);
  assert_int_equal(report_get(report, "tests", "newell", -1), -1);
  report_double(report, "newell", "share", 0.5);
  assert_int_equal(report_get(report, "newell", "share", 8), 8);
}

static void text_of_any_bytes_is_quoted(void **state) {
  struct report *report = *state;
  report_text(report, "a", "b", "say \"hi\" \\ \n\t\x01 \x7f \xc3\xa4");
  assert_string_equal(report_json(report),
                      "{\n  \"a\": {\n    \"b\": \"say \\\"hi\\\" \\\\ "
                      "\\u000a\\u0009\\u0001 \\u007f \xc3\xa4\"\n  }\n}\n");
}

static void what_is_not_finite_is_null(void **state) {
  struct report *report = *state;
  report_double(report, "a", "b", NAN);
  report_doubles(report, "a", "c", (double[]){INFINITY, -INFINITY, 0}, 3);
  assert_string_equal(report_json(report),
                      "{\n  \"a\": {\n    \"b\": null,\n"
                      "    \"c\": [null, null, 0]\n  }\n}\n");
}

static void a_decimal_comma_changes_nothing(void **state) {
  struct report *report = *state;
  if (!comma_locale_on()) {
    print_message("no locale with a decimal comma\n");
    skip();
  }
  report_double(report, "a", "b", 0.5);
  const char *json = report_json(report);
  comma_locale_off();
  assert_non_null(strstr(json, "0.5"));
}

static void no_report_is_accepted_everywhere(void **state) {
  (void)state;
  report_int(NULL, "a", "b", 1);
  report_add(NULL, "a", "b", 1);
  report_double(NULL, "a", "b", 1);
  report_doubles(NULL, "a", "b", (double[]){1}, 1);
  report_text(NULL, "a", "b", "c");
  assert_int_equal(report_get(NULL, "a", "b", 17), 17);
  assert_null(report_json(NULL));
  report_destroy(NULL);
}

static void fill(struct report *report) {
  report_int(report, "a", "b", 1);
  report_text(report, "a", "c", "text");
  report_doubles(report, "a", "d", (double[]){1, 2}, 2);
  for (int i = 0; i < 100; i++)
    report_add(report, "a", "b", 1);
}

/* Entries may be missing then, but nothing breaks, and nothing is wrong. */
static void running_out_of_memory_loses_entries_only(void **state) {
  (void)state;
  for (unsigned long n = 1; n < 12; n++) {
    mem_fail_after(n);
    struct report *report = report_create();
    fill(report);
    const char *json = report_json(report);
    mem_fail_after(0);
    if (n == 1)
      assert_null(report);
    else if (json != NULL)
      assert_true(json[0] == '{' && json[strlen(json) - 1] == '\n');
    fill(report);
    if (report != NULL)
      assert_true(report_get(report, "a", "b", 0) >= 101);
    report_destroy(report);
  }
}

static void clocks_run_forward(void **state) {
  (void)state;
  double cpu = clock_cpu(), wall = clock_wall();
  volatile double sum = 0;
  while (clock_cpu() < cpu + 0.01)
    sum = sum + 1;
  assert_true(clock_wall() > wall);
  assert_true(clock_cpu() < cpu + 60);
}

int main(void) {
#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      T(an_empty_report_is_an_empty_object),
      T(entries_are_in_order_of_first_mention),
      T(a_later_value_replaces_one_of_any_kind),
      T(adding_starts_from_zero),
      T(text_of_any_bytes_is_quoted),
      T(what_is_not_finite_is_null),
      T(a_decimal_comma_changes_nothing),
      T(no_report_is_accepted_everywhere),
      T(running_out_of_memory_loses_entries_only),
      T(clocks_run_forward),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
