/* test_cubic_fit.c - a fitted curve keeps within the distances that are
 * allowed, and one whose handles vanish is a line. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "ink/curve/cubic_fit.h"
#include "tests/scenes/random.h"

#define TOLERANCE_MM 0.1

enum { SAMPLES = 6 };

typedef struct drawing_point point;

/* Samples on the x-axis, of which the curve may be farther off the farther they
 * are from the first one. */
static void set_samples(struct fit_sample sample[SAMPLES],
                        struct random *random, double slope) {
  for (int i = 0; i < SAMPLES; i++) {
    double x = i * random_between(random, 0.1, 1);
    x = i > 0 ? fmax(x, sample[i - 1].along + 0.01) : 0;
    sample[i] = (struct fit_sample){.along = x, .from = slope * x};
    sample[i].at.x = sample[i].target.x = x;
    if (i > 0)
      sample[i - 1].to = sample[i].from;
  }
}

static point point_at(const point p[4], double t) {
  double s = 1 - t;
  double a = s * s * s, b = 3 * s * s * t, c = 3 * s * t * t, d = t * t * t;
  return (point){a * p[0].x + b * p[1].x + c * p[2].x + d * p[3].x,
                 a * p[0].y + b * p[1].y + c * p[2].y + d * p[3].y};
}

/* From where two strokes cross they part by a slope.  A curve is within it also
 * where its parameter runs ahead of its place, as behind a short handle. */
static void curves_leave_a_crossing_within_the_slope(void **state) {
  (void)state;
  enum { TRIALS = 2000, PLACES = 4000 };
  struct random random = {5};
  int fitted = 0;
  for (int trial = 0; trial < TRIALS; trial++) {
    struct fit_sample sample[SAMPLES];
    double parameter[SAMPLES];
    double slope = random_between(&random, 0.02, 0.2);
    double turn = random_between(&random, -1, 1);
    set_samples(sample, &random, slope);
    const struct cubic_fit problem = {.sample = sample,
                                      .samples = SAMPLES,
                                      .tolerance = TOLERANCE_MM,
                                      .start = {cos(turn), sin(turn)},
                                      .end = {1, 0}};
    point curve[4];
    if (!cubic_fit(&problem, parameter, curve))
      continue;
    fitted++;
    for (int i = 0; i <= PLACES; i++) {
      point at = point_at(curve, i / (double)PLACES);
      assert_true(fabs(at.y) <= slope * at.x + 1e-9);
    }
  }
  assert_true(fitted > 100);
}

/* A curve much shorter than its tolerance has handles that are rounded to
 * nothing. */
static void a_curve_without_handles_is_a_line(void **state) {
  (void)state;
  const point run = {2 / sqrt(5), 1 / sqrt(5)};
  const struct fit_sample sample[] = {
      {.from = TOLERANCE_MM, .to = TOLERANCE_MM},
      {.at = {0.02, 0.01}, .target = {0.02, 0.01}, .along = 0.0224}};
  const struct cubic_fit problem = {.sample = sample,
                                    .samples = 2,
                                    .tolerance = TOLERANCE_MM,
                                    .start = run,
                                    .end = run};
  double parameter[2];
  point curve[4];
  assert_true(cubic_fit(&problem, parameter, curve));
  assert_true(drawing_piece_is_straight(curve));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(curves_leave_a_crossing_within_the_slope),
      cmocka_unit_test(a_curve_without_handles_is_a_line),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
