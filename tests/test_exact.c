/* test_exact.c - signs of expressions in doubles, compared with rational
 * arithmetic. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>
#include <gmp.h>

#include "scene/exact.h"
#include "tests/scenes/random.h"

/* The sign by fractions of any length. */
static int judge_turn(const double a[2], const double b[2], const double c[2]) {
  mpq_t v[6], left, right;
  const double from[6] = {a[0], a[1], b[0], b[1], c[0], c[1]};
  mpq_inits(left, right, NULL);
  for (int i = 0; i < 6; i++) {
    mpq_init(v[i]);
    mpq_set_d(v[i], from[i]);
  }
  for (int i = 2; i < 6; i++)
    mpq_sub(v[i], v[i], v[i % 2]);
  mpq_mul(left, v[2], v[5]);
  mpq_mul(right, v[3], v[4]);
  int sign = mpq_cmp(left, right);
  for (int i = 0; i < 6; i++)
    mpq_clear(v[i]);
  mpq_clears(left, right, NULL);
  return (sign > 0) - (sign < 0);
}

static void assert_turn(const double a[2], const double b[2],
                        const double c[2]) {
  int sign = exact_orient2d(a, b, c);
  if (sign != judge_turn(a, b, c))
    fail_msg("(%a %a) (%a %a) (%a %a) give %d", a[0], a[1], b[0], b[1], c[0],
             c[1], sign);
  assert_int_equal(exact_orient2d(b, c, a), sign);
  assert_int_equal(exact_orient2d(c, b, a), -sign);
}

static double random_double(struct random *random) {
  double value;
  do {
    uint64_t bits = random_next(random);
    memcpy(&value, &bits, sizeof value);
  } while (!isfinite(value));
  return value;
}

static void any_doubles_turn_the_right_way(void **state) {
  (void)state;
  struct random random = {1};
  for (int i = 0; i < 20000; i++) {
    double p[3][2];
    for (int k = 0; k < 6; k++)
      p[k / 2][k % 2] =
          i % 2 ? random_double(&random) : random_between(&random, -1, 1);
    assert_turn(p[0], p[1], p[2]);
  }
}

/* Points of a line through small whole numbers, scaled by any power of two,
 * and the doubles next to them. */
static void nearly_collinear_points_turn_the_right_way(void **state) {
  (void)state;
  struct random random = {2};
  int counts[3] = {0};
  for (int i = 0; i < 20000; i++) {
    int from[2] = {random_int(&random, -99, 99), random_int(&random, -99, 99)};
    int step[2] = {random_int(&random, -9, 9), random_int(&random, -9, 9)};
    int scale = random_int(&random, -1000, 1000);
    double p[3][2];
    for (int k = 0; k < 6; k++) {
      int way = random_int(&random, -50, 50);
      p[k / 2][k % 2] = way;
      if (k % 2) {
        double along = p[k / 2][0];
        p[k / 2][0] = ldexp(from[0] + along * step[0], scale);
        p[k / 2][1] = ldexp(from[1] + along * step[1], scale);
      }
    }
    if (i % 2)
      p[2][1] = nextafter(p[2][1], i % 4 == 1 ? INFINITY : -INFINITY);
    assert_turn(p[0], p[1], p[2]);
    counts[exact_orient2d(p[0], p[1], p[2]) + 1]++;
  }
  /* All three answers came up. */
  for (int k = 0; k < 3; k++)
    assert_true(counts[k] > 1000);
}

static void the_ends_of_the_range_turn_the_right_way(void **state) {
  (void)state;
  static const double ends[] = {0,       -0.0,     0x1p-1074,       -0x1p-1074,
                                DBL_MIN, 1,        1 + DBL_EPSILON, -1,
                                DBL_MAX, -DBL_MAX, 0x1.8p1023,      0x1p-1022};
  enum { COUNT = sizeof ends / sizeof *ends };
  struct random random = {3};
  for (int i = 0; i < 30000; i++) {
    double p[3][2];
    for (int k = 0; k < 6; k++)
      p[k / 2][k % 2] = ends[random_below(&random, COUNT)];
    assert_turn(p[0], p[1], p[2]);
  }
}

/* ---- In space ------------------------------------------------------------ */

static bool on_one_line(const double p[3][3]) {
  struct scene_point point[3];
  for (int i = 0; i < 3; i++)
    point[i] = (struct scene_point){p[i][0], p[i][1], p[i][2]};
  bool answer = exact_are_collinear(&point[0], &point[1], &point[2]);
  assert_int_equal(exact_are_collinear(&point[1], &point[2], &point[0]),
                   answer);
  assert_int_equal(exact_are_collinear(&point[2], &point[1], &point[0]),
                   answer);
  return answer;
}

static bool judge_line(const double p[3][3]) {
  for (int k = 0; k < 3; k++) {
    double view[3][2];
    for (int i = 0; i < 3; i++) {
      view[i][0] = p[i][k];
      view[i][1] = p[i][(k + 1) % 3];
    }
    if (judge_turn(view[0], view[1], view[2]) != 0)
      return false;
  }
  return true;
}

static void collinearity_in_space_is_decided_exactly(void **state) {
  (void)state;
  struct random random = {4};
  int yes = 0, no = 0;
  for (int i = 0; i < 20000; i++) {
    double p[3][3];
    int scale = random_int(&random, -1000, 1000);
    int step[3], from[3];
    for (int k = 0; k < 3; k++) {
      step[k] = random_int(&random, -3, 3);
      from[k] = random_int(&random, -99, 99);
    }
    for (int n = 0; n < 3; n++) {
      int way = random_int(&random, -20, 20);
      for (int k = 0; k < 3; k++)
        p[n][k] = ldexp(from[k] + way * step[k], scale);
    }
    if (i % 2) {
      double *moved = &p[2][random_below(&random, 3)];
      *moved = nextafter(*moved, INFINITY);
    }
    bool answer = on_one_line(p);
    assert_int_equal(answer, judge_line(p));
    yes += answer;
    no += !answer;
  }
  assert_true(yes > 1000 && no > 1000);
}

static void points_that_are_equal_are_on_one_line(void **state) {
  (void)state;
  struct random random = {5};
  for (int i = 0; i < 1000; i++) {
    double p[3][3];
    for (int k = 0; k < 9; k++)
      p[k / 3][k % 3] = random_double(&random);
    memcpy(p[1 + i % 2], p[0], sizeof p[0]);
    assert_true(on_one_line(p));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(any_doubles_turn_the_right_way),
      cmocka_unit_test(nearly_collinear_points_turn_the_right_way),
      cmocka_unit_test(the_ends_of_the_range_turn_the_right_way),
      cmocka_unit_test(collinearity_in_space_is_decided_exactly),
      cmocka_unit_test(points_that_are_equal_are_on_one_line),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
