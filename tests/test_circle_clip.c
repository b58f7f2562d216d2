/* test_circle_clip.c - of a drawing that is clipped to a circle, all that is
 * inside is left, and nothing sticks out. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "drawing/circle_clip.h"
#include "tests/memory_faults.h"

static const struct drawing_circle circle = {50, 40, 10};

static void begin(struct drawing *drawing, double width_mm) {
  const struct drawing_layer layer = {1, "1 visible", 0, width_mm, NULL, false};
  drawing_init(drawing);
  assert_true(ARRAY_PUSH(&drawing->layer, layer));
}

static void add_points(struct drawing *drawing, const double *xy,
                       size_t count) {
  for (size_t i = 0; i < count; i++)
    assert_true(ARRAY_PUSH(&drawing->point,
                           ((struct drawing_point){xy[2 * i], xy[2 * i + 1]})));
}

static void add_stroke(struct drawing *drawing, const double *xy, size_t count,
                       bool closed) {
  const struct drawing_stroke stroke = {.point = (uint32_t)drawing->point.count,
                                        .count = (uint32_t)count,
                                        .edge_class = RECTO_EDGE_CREASE,
                                        .closed = closed};
  assert_true(ARRAY_PUSH(&drawing->stroke, stroke));
  add_points(drawing, xy, count);
}

static void add_loop(struct drawing *drawing, const double *xy, size_t count) {
  const struct drawing_loop loop = {(uint32_t)drawing->point.count,
                                    (uint32_t)count};
  if (drawing->fill.count == 0)
    assert_true(ARRAY_PUSH(&drawing->fill, ((struct drawing_fill){0})));
  drawing->fill.item[0].loops++;
  assert_true(ARRAY_PUSH(&drawing->loop, loop));
  add_points(drawing, xy, count);
}

/* ---- Strokes ------------------------------------------------------------- */

static double clipped_length(struct drawing *drawing, double width_mm) {
  assert_true(drawing_clip_circle(drawing, &circle, width_mm));
  return drawing_length_mm(drawing);
}

static void a_line_ends_on_the_circle(void **state) {
  (void)state;
  struct drawing drawing;
  begin(&drawing, 0.3);
  add_stroke(&drawing, (double[]){30, 46, 70, 46}, 2, false);
  assert_true(fabs(clipped_length(&drawing, 0.3) - 16) < 1e-9); /* 6, 8, 10 */
  assert_int_equal(drawing.stroke.count, 1);
  assert_true(fabs(drawing.point.item[0].x - 42) < 1e-9);
  assert_true(fabs(drawing.point.item[1].x - 58) < 1e-9);
  drawing_fini(&drawing);
}

/* The circle's line is 0.3 mm wide, so that its outer side is 10.15 mm from the
 * middle: a line of 2.3 mm with round ends stops at 9. */
static void a_wide_line_ends_before_it(void **state) {
  (void)state;
  struct drawing drawing;
  begin(&drawing, 2.3);
  add_stroke(&drawing, (double[]){30, 40, 70, 40}, 2, false);
  assert_true(fabs(clipped_length(&drawing, 0.3) - 18) < 1e-9);
  drawing_fini(&drawing);
  begin(&drawing, 0.1);
  add_stroke(&drawing, (double[]){30, 40, 70, 40}, 2, false);
  assert_true(fabs(clipped_length(&drawing, 0.3) - 20) < 1e-9);
  drawing_fini(&drawing);
}

static void loops_become_what_is_inside(void **state) {
  (void)state;
  struct drawing drawing;
  begin(&drawing, 0.3);
  add_stroke(&drawing, (double[]){48, 38, 52, 38, 52, 42, 48, 42}, 4, true);
  /* From a corner inside, two ends are outside. */
  add_stroke(&drawing, (double[]){50, 40, 70, 40, 70, 60, 50, 60}, 4, true);
  add_stroke(&drawing, (double[]){20, 20, 80, 20, 80, 70, 20, 70}, 4, true);
  add_stroke(&drawing, (double[]){70, 0, 80, 0, 80, 9}, 3, false);
  assert_true(fabs(clipped_length(&drawing, 0.3) - (16 + 20)) < 1e-9);
  assert_int_equal(drawing.stroke.count, 2);
  assert_true(drawing.stroke.item[0].closed);
  assert_int_equal(drawing.stroke.item[0].count, 4);
  assert_false(drawing.stroke.item[1].closed);
  assert_int_equal(drawing.stroke.item[1].count, 3);
  drawing_fini(&drawing);
}

static void a_line_may_enter_several_times(void **state) {
  (void)state;
  struct drawing drawing;
  begin(&drawing, 0.3);
  add_stroke(&drawing,
             (double[]){30, 46, 70, 46, 70, 34, 30, 34, 30, 40, 45, 40}, 6,
             false);
  assert_true(fabs(clipped_length(&drawing, 0.3) - (16 + 16 + 5)) < 1e-9);
  assert_int_equal(drawing.stroke.count, 3);
  drawing_fini(&drawing);
}

/* A curve that is a straight line, so that its polyline is known. */
static void curves_that_leave_become_polylines(void **state) {
  (void)state;
  struct drawing drawing;
  begin(&drawing, 0.3);
  for (int i = 0; i < 2; i++) {
    double from = i == 0 ? 45 : 20;
    const struct drawing_curve curve = {(uint32_t)drawing.control.count, 4};
    add_stroke(&drawing, (double[]){from, 40, 55, 40}, 2, false);
    assert_true(ARRAY_PUSH(&drawing.curve, curve));
    for (int k = 0; k < 4; k++)
      assert_true(
          ARRAY_PUSH(&drawing.control,
                     ((struct drawing_point){from + (55 - from) * k / 3, 40})));
  }
  assert_true(fabs(clipped_length(&drawing, 0.3) - (10 + 15)) < 1e-9);
  assert_non_null(drawing_curve_of(&drawing, 0));
  assert_null(drawing_curve_of(&drawing, 1));
  drawing_fini(&drawing);
}

/* ---- Fills --------------------------------------------------------------- */

/* The area of a fill's loops, each of which may run either way: by the rule of
 * the even and the odd, on scan lines. */
static bool is_inside(const struct drawing *drawing, double x, double y) {
  bool inside = false;
  for (size_t f = 0; f < drawing->fill.count; f++)
    for (uint32_t l = 0; l < drawing->fill.item[f].loops; l++) {
      const struct drawing_loop *loop =
          &drawing->loop.item[drawing->fill.item[f].loop + l];
      const struct drawing_point *p = drawing->point.item + loop->point;
      for (uint32_t i = 0, k = loop->count - 1; i < loop->count; k = i++)
        if ((p[i].y > y) != (p[k].y > y) &&
            x < (p[k].x - p[i].x) * (y - p[i].y) / (p[k].y - p[i].y) + p[i].x)
          inside = !inside;
    }
  return inside;
}

/* Requires each point of a lattice that is farther than a chord from the circle
 * to be in the clipped fill if and only if it was in the fill, and in the
 * circle. */
static void assert_clipped(const struct drawing *before,
                           const struct drawing *after, double radius) {
  for (size_t i = 0; i < after->point.count; i++) {
    const struct drawing_point *p = &after->point.item[i];
    assert_true(hypot(p->x - circle.x, p->y - circle.y) < radius + 1e-9);
  }
  for (double y = 29.013; y < 51; y += 0.23)
    for (double x = 39.017; x < 61; x += 0.23) {
      double far = hypot(x - circle.x, y - circle.y);
      if (fabs(far - radius) < 0.01)
        continue;
      bool wanted = far < radius && is_inside(before, x, y);
      assert_int_equal(is_inside(after, x, y), wanted);
    }
}

static void check_fill(double seam_mm, size_t loops, const double *const xy[],
                       const size_t count[]) {
  struct drawing before, after;
  begin(&before, 0.3);
  begin(&after, 0.3);
  for (size_t i = 0; i < loops; i++) {
    add_loop(&before, xy[i], count[i]);
    add_loop(&after, xy[i], count[i]);
  }
  after.seam_mm = seam_mm;
  assert_true(drawing_clip_circle(&after, &circle, 0.3));
  assert_clipped(&before, &after, circle.radius - seam_mm / 2);
  drawing_fini(&before);
  drawing_fini(&after);
}

static void fills_are_cut_along_the_circle(void **state) {
  (void)state;
  static const double around[] = {20, 20, 80, 20, 80, 70, 20, 70};
  static const double hole[] = {48, 38, 52, 38, 52, 42, 48, 42};
  static const double right[] = {53, 20, 80, 20, 80, 70, 53, 70};
  static const double comb[] = {20, 30, 70, 31, 70, 35, 30, 36,
                                30, 39, 70, 38, 70, 42, 20, 44};
  static const double beside[] = {0, 0, 9, 0, 9, 9};
  const size_t four[] = {4, 4, 4}, eight[] = {8}, three[] = {3};
  check_fill(0, 1, (const double *[]){around}, four);
  check_fill(0.4, 2, (const double *[]){around, hole}, four);
  check_fill(0, 1, (const double *[]){hole}, four);
  check_fill(0.4, 1, (const double *[]){right}, four);
  check_fill(0, 2, (const double *[]){around, right}, four);
  check_fill(0, 1, (const double *[]){comb}, eight);
  check_fill(0, 1, (const double *[]){beside}, three);
}

/* Polygons whose sides cross each other: the rule of even and odd holds. */
static void random_fills_are_cut_along_the_circle(void **state) {
  (void)state;
  enum { TRIALS = 60 };
  srand(7);
  for (int trial = 0; trial < TRIALS; trial++) {
    double first[24], second[24];
    for (int i = 0; i < 24; i++) {
      first[i] = (i % 2 ? 25 : 35) + 30.0 * rand() / RAND_MAX;
      second[i] = (i % 2 ? 30 : 40) + 20.0 * rand() / RAND_MAX;
    }
    const size_t count[] = {3 + (size_t)(rand() % 10),
                            3 + (size_t)(rand() % 10)};
    check_fill(0, 2, (const double *[]){first, second}, count);
  }
}

static void where_memory_runs_out_it_says_so(void **state) {
  (void)state;
  struct memory_faults faults = {.least = 5};
  while (memory_faults_go_on(&faults)) {
    struct drawing drawing;
    begin(&drawing, 0.3);
    add_stroke(&drawing, (double[]){30, 46, 70, 46}, 2, false);
    add_loop(&drawing, (double[]){53, 20, 80, 20, 80, 70, 53, 70}, 4);
    memory_faults_begin(&faults);
    memory_faults_end(&faults, memory_faults_status(drawing_clip_circle(
                                   &drawing, &circle, 0.3)));
    drawing_fini(&drawing);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_line_ends_on_the_circle),
      cmocka_unit_test(a_wide_line_ends_before_it),
      cmocka_unit_test(loops_become_what_is_inside),
      cmocka_unit_test(a_line_may_enter_several_times),
      cmocka_unit_test(curves_that_leave_become_polylines),
      cmocka_unit_test(fills_are_cut_along_the_circle),
      cmocka_unit_test(random_fills_are_cut_along_the_circle),
      cmocka_unit_test(where_memory_runs_out_it_says_so),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
