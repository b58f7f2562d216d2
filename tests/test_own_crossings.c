/* test_own_crossings.c - the crossings of a line with itself are those that a
 * search of all pairs of its sides finds, with few comparisons however often
 * the line runs to and fro. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "ink/curve/own_crossings.h"
#include "tests/scenes/random.h"

static void add_point(struct own_crossings *own, double x, double y) {
  struct own_point p = {{x, y}, (double)own->line.count};
  assert_true(ARRAY_PUSH(&own->line, p));
}

/* A line of steps of several lengths, which turns at random. */
static void add_random_walk(struct own_crossings *own, struct random *random,
                            int points) {
  double x = 0, y = 0;
  own->line.count = 0;
  for (int i = 0; i < points; i++) {
    double step = exp(random_between(random, -3, 1));
    double angle = random_between(random, 0, 2 * M_PI);
    add_point(own, x += step * cos(angle), y += step * sin(angle));
  }
}

/* A line that runs to and fro, 100 mm each time, and on across by 0.01 mm.
 * angle  radians: that of the direction in which it runs on */
static void add_zigzag(struct own_crossings *own, double angle, int points) {
  own->line.count = 0;
  for (int i = 0; i < points; i++) {
    double u = 0.01 * i, v = i % 2 == 0 ? 0 : 100 + 0.01 * (i % 7);
    add_point(own, u * cos(angle) - v * sin(angle),
              u * sin(angle) + v * cos(angle));
  }
}

static double area(struct drawing_point a, struct drawing_point b,
                   struct drawing_point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static bool do_cross(const struct own_point *a, const struct own_point *b) {
  return (area(a[0].at, a[1].at, b[0].at) > 0) !=
             (area(a[0].at, a[1].at, b[1].at) > 0) &&
         (area(b[0].at, b[1].at, a[0].at) > 0) !=
             (area(b[0].at, b[1].at, a[1].at) > 0);
}

static void all_crossings_are_found_in_order(void **state) {
  (void)state;
  struct random random = {3};
  struct own_crossings own = {.compared = 0};
  size_t all = 0;
  for (int points = 4; points < 300; points++) {
    size_t found = 0;
    add_random_walk(&own, &random, points);
    assert_true(own_crossings_find(&own));
    for (size_t i = 0; i + 1 < own.line.count; i++)
      for (size_t k = i + 2; k + 1 < own.line.count; k++) {
        if (!do_cross(&own.line.item[i], &own.line.item[k]))
          continue;
        assert_true(found < own.crossing.count);
        const double *along = own.crossing.item[found++].along;
        assert_true(along[0] >= (double)i && along[0] <= (double)i + 1);
        assert_true(along[1] >= (double)k && along[1] <= (double)k + 1);
      }
    assert_int_equal(found, own.crossing.count);
    all += found;
  }
  assert_true(all > 10000);
  own_crossings_fini(&own);
}

static void sides_to_and_fro_are_compared_with_few(void **state) {
  (void)state;
  enum { POINTS = 60000 };
  struct own_crossings own = {.compared = 0};
  for (int eighth = 0; eighth < 8; eighth++) {
    add_zigzag(&own, M_PI / 4 * eighth, POINTS);
    assert_true(own_crossings_find(&own));
    assert_int_equal(own.crossing.count, 0);
    assert_in_range(own.compared, POINTS, 64 * POINTS);
  }
  own_crossings_fini(&own);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_crossings_are_found_in_order),
      cmocka_unit_test(sides_to_and_fro_are_compared_with_few),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
