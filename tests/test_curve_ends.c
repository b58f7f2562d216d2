/* test_curve_ends.c - following a contour back from its end ends where the
 * contour does. */
#include "visibility/contour/curve_ends.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <unistd.h>

#include <cmocka.h>

#include "exact_fixture/scene.h"

/* A test that runs for longer hangs. */
enum { SECONDS_MAX = 20 };

static void add_edge(struct sheet *sheet, uint32_t p, uint32_t q) {
  struct sheet_edge made = {.point = {p, q}};
  assert_true(ARRAY_PUSH(&sheet->edge, made));
}

/* Points a unit apart on the x-axis. */
static void make_points(struct sheet *sheet, int32_t points) {
  exact_sheet_init(sheet);
  for (int32_t x = 0; x < points; x++)
    assert_true(ARRAY_PUSH(&sheet->point, ((struct geom_point){x, 0, 0})));
}

static void a_curve_is_followed_as_far_as_asked(void **state) {
  (void)state;
  struct sheet sheet;
  make_points(&sheet, 9);
  for (uint32_t i = 0; i + 1 < 9; i++)
    add_edge(&sheet, i, i + 1);
  assert_int_equal(curve_before_end(&sheet, 0, 7, 1, 3).x, 5);
  assert_int_equal(curve_before_end(&sheet, 0, 7, 1, 99).x, 0);
  assert_int_equal(curve_before_end(&sheet, 0, 0, 0, 3).x, 3);
  assert_int_equal(curve_before_end(&sheet, 0, 0, 0, 99).x, 8);
  assert_int_equal(curve_before_end(&sheet, 4, 7, 1, 99).x, 4);
  exact_sheet_fini(&sheet);
}

/* It returns to where it begins after two edges, which follow each other both
 * ways, or after one without length. */
static void a_short_closed_curve_has_an_end(void **state) {
  (void)state;
  struct sheet sheet;
  make_points(&sheet, 3);
  add_edge(&sheet, 0, 1);
  add_edge(&sheet, 1, 0);
  add_edge(&sheet, 2, 2);
  (void)alarm(SECONDS_MAX);
  for (uint32_t edge = 0; edge < 3; edge++)
    for (int k = 0; k < 2; k++)
      assert_in_range(curve_before_end(&sheet, 0, edge, k, 99).x, 0, 2);
  (void)alarm(0);
  exact_sheet_fini(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_curve_is_followed_as_far_as_asked),
      cmocka_unit_test(a_short_closed_curve_has_an_end),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
