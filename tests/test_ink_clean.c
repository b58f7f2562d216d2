/* test_ink_clean.c - redundant points and short strokes are removed, dashes are
 * spread evenly. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/clock.h"
#include "base/tolerance.h"
#include "ink/lines/paths.h"
#include "tests/ink_fixture.h"
#include "tests/scenes/random.h"

enum { CREASE = RECTO_EDGE_CREASE };

#define NANOMETRE (1.0 / 1048576)

/* ---- Paths on their own -------------------------------------------------- */

static void add_path(struct ink_paths *paths, const struct ink_point *point,
                     uint32_t count, bool closed) {
  struct ink_path path = {
      .point = (uint32_t)paths->point.count, .count = count, .closed = closed};
  for (uint32_t i = 0; i < count; i++)
    assert_true(ARRAY_PUSH(&paths->point, point[i]));
  assert_true(ARRAY_PUSH(&paths->path, path));
}

static double distance_to_segment(struct ink_point p, struct ink_point a,
                                  struct ink_point b) {
  double dx = (double)b.x - a.x, dy = (double)b.y - a.y;
  double px = (double)p.x - a.x, py = (double)p.y - a.y;
  double length2 = dx * dx + dy * dy;
  double t = length2 > 0 ? (px * dx + py * dy) / length2 : 0;
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return hypot(px - t * dx, py - t * dy);
}

static double distance_to_path(struct ink_point p,
                               const struct ink_point *point, uint32_t count,
                               bool closed) {
  double nearest = INFINITY;
  for (uint32_t i = 0; i + !closed < count; i++)
    nearest =
        fmin(nearest, distance_to_segment(p, point[i], point[(i + 1) % count]));
  return nearest;
}

/* The points of a path, a copy. */
struct line {
  struct ink_point point[2000];
  uint32_t count;
  bool closed;
};

static struct line line_of(const struct ink_paths *paths, size_t i) {
  struct line line = {.count = paths->path.item[i].count,
                      .closed = paths->path.item[i].closed};
  assert_in_range(line.count, 1, 2000);
  memcpy(line.point, paths->point.item + paths->path.item[i].point,
         line.count * sizeof *line.point);
  return line;
}

/* Every point that was is near what is; the points that are, were, in their
 * order; ends stayed. */
static void assert_thinned(const struct line *was, const struct line *is,
                           double tolerance) {
  uint32_t at = 0;
  for (uint32_t i = 0; i < is->count; i++, at++) {
    while (at < was->count && (was->point[at].x != is->point[i].x ||
                               was->point[at].y != is->point[i].y))
      at++;
    assert_in_range(at, 0, was->count - 1);
  }
  assert_memory_equal(is->point, was->point, sizeof *is->point);
  if (!was->closed)
    assert_memory_equal(is->point + is->count - 1, was->point + was->count - 1,
                        sizeof *is->point);
  for (uint32_t i = 0; i < was->count; i++)
    assert_true(distance_to_path(was->point[i], is->point, is->count,
                                 is->closed) <= tolerance);
}

static struct line random_line(struct random *random, bool closed) {
  struct line line = {.closed = closed};
  int steps = random_int(random, 3, 60), size = 1 << random_int(random, 2, 26);
  struct ink_point p = {0, 0};
  for (int i = 0; i < steps; i++) {
    /* Runs that are straight but for rounding, and turns. */
    double dx = random_int(random, -size, size);
    double dy = random_int(random, -size, size);
    int run = random_int(random, 1, 8);
    for (int k = 1; k <= run; k++)
      line.point[line.count++] =
          (struct ink_point){(int32_t)lrint(p.x + dx * k / run),
                             (int32_t)lrint(p.y + dy * k / run)};
    p = line.point[line.count - 1];
    if (labs(p.x) > 500000000 || labs(p.y) > 500000000)
      break;
  }
  if (line.count < 3) {
    line.point[2] = (struct ink_point){7, 1000};
    line.count = 3;
  }
  return line;
}

/* ---- Straight lines ------------------------------------------------------ */

static void straight_edge_is_two_points(void **state) {
  struct ink_fixture k;
  const double line[] = {5, 5, 95, 65};
  (void)state;
  ink_fixture_start(&k);
  uint32_t last = ink_fixture_point(&k, 5, 5);
  for (int i = 1; i <= 900; i++) {
    uint32_t here = ink_fixture_point(&k, 5 + i * 0.1, 5 + i * 60.0 / 900);
    ink_fixture_edge(&k, last, here, CREASE);
    last = here;
  }
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  ink_fixture_assert_same_line(&k, 0, false, INK_FIXTURE_XY(line));
  ink_fixture_end(&k);
}

static void subdivided_box_is_four_points(void **state) {
  struct random random = {41};
  (void)state;
  for (int round = 0; round < 100; round++) {
    struct ink_fixture k;
    double angle = random_unit(&random) * 6.3;
    double x[4], y[4], box[8];
    for (int i = 0; i < 4; i++) {
      double side = i == 0 || i == 3 ? -30 : 30, top = i < 2 ? -20 : 20;
      box[2 * i] = x[i] = 50 + side * cos(angle) - top * sin(angle);
      box[2 * i + 1] = y[i] = 50 + side * sin(angle) + top * cos(angle);
    }
    ink_fixture_start(&k);
    for (int i = 0; i < 4; i++) {
      int j = (i + 1) % 4, parts = random_int(&random, 1, 50);
      for (int s = 0; s < parts; s++) {
        double t = (double)s / parts, u = (s + 1.0) / parts;
        ink_fixture_line(&k, x[i] + t * (x[j] - x[i]), y[i] + t * (y[j] - y[i]),
                         x[i] + u * (x[j] - x[i]), y[i] + u * (y[j] - y[i]),
                         CREASE);
      }
    }
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, 1);
    ink_fixture_assert_same_line(&k, 0, true, INK_FIXTURE_XY(box));
    ink_fixture_end(&k);
  }
}

static void straightening_keeps_within_the_tolerance(void **state) {
  struct random random = {43};
  int rounds = is_under_valgrind() ? 50 : 3000;
  (void)state;
  for (int round = 0; round < rounds; round++) {
    struct ink_paths paths = {0};
    struct line was = random_line(&random, round % 3 == 0);
    add_path(&paths, was.point, was.count, was.closed);
    paths_straighten(&paths, 0);
    struct line is = line_of(&paths, 0);
    assert_thinned(&was, &is, TOLERANCE_COLLINEAR_UNITS + 1e-3);
    paths_fini(&paths);
  }
}

static void fine_curve_does_not_drift(void **state) {
  /* A circle whose corners each bend by less than the tolerance: points may
   * go, but never so many that the line leaves the circle. */
  enum { SIDES = 1999 };
  struct ink_paths paths = {0};
  struct line was = {.count = SIDES, .closed = true};
  (void)state;
  for (int i = 0; i < SIDES; i++)
    was.point[i] = (struct ink_point){
        (int32_t)lrint(90000 * cos(i * 2 * acos(-1) / SIDES)),
        (int32_t)lrint(90000 * sin(i * 2 * acos(-1) / SIDES))};
  add_path(&paths, was.point, SIDES, true);
  paths_straighten(&paths, 0);
  struct line is = line_of(&paths, 0);
  assert_true(is.closed);
  assert_in_range(is.count, 3, SIDES - 1);
  assert_thinned(&was, &is, TOLERANCE_COLLINEAR_UNITS + 1e-3);
  paths_fini(&paths);
}

static void
simplifying_keeps_the_turning_point_of_a_line_there_and_back(void **state) {
  struct ink_paths paths = {0};
  const struct ink_point spike[] = {{0, 0}, {100, 0}, {1000, 0}, {400, 0}};
  (void)state;
  add_path(&paths, spike, 4, false);
  paths_straighten(&paths, 0);
  assert_int_equal(paths.path.item[0].count, 3);
  assert_int_equal(paths.point.item[1].x, 1000);
  assert_int_equal(paths.point.item[2].x, 400);
  paths_fini(&paths);
}

static void loop_without_width_becomes_a_line(void **state) {
  struct ink_paths paths = {0};
  const struct ink_point thin[] = {{0, 0}, {1000, 0}, {500, 1}};
  const struct ink_point next[] = {{7, 7}, {9, 90}};
  (void)state;
  add_path(&paths, thin, 3, true);
  add_path(&paths, next, 2, false);
  paths_straighten(&paths, 0);
  assert_false(paths.path.item[0].closed);
  assert_int_equal(paths.path.item[0].count, 2);
  assert_int_equal(paths.path.item[1].point, 2);
  assert_int_equal(paths.point.item[2].x, 7);
  paths_fini(&paths);
}

/* ---- Simplifying --------------------------------------------------------- */

static void simplifying_keeps_within_the_tolerance(void **state) {
  struct random random = {47};
  int rounds = is_under_valgrind() ? 50 : 3000;
  (void)state;
  for (int round = 0; round < rounds; round++) {
    struct ink_paths paths = {0};
    struct line was = random_line(&random, round % 3 == 0);
    double tolerance = ldexp(1, random_int(&random, 0, 27));
    add_path(&paths, was.point, was.count, was.closed);
    assert_int_equal(paths_simplify(&paths, tolerance, NULL), RECTO_OK);
    struct line is = line_of(&paths, 0);
    assert_int_equal(is.closed, was.closed);
    assert_in_range(is.count, was.closed ? 3 : 2, was.count);
    assert_thinned(&was, &is, tolerance * (1 + 1e-9));
    paths_fini(&paths);
  }
}

static void simplifying_drops_what_it_may(void **state) {
  struct ink_paths paths = {0};
  const struct ink_point bumps[] = {{0, 0},    {100, 9},  {200, -9},
                                    {300, 50}, {400, -9}, {500, 0}};
  (void)state;
  add_path(&paths, bumps, 6, false);
  assert_int_equal(paths_simplify(&paths, 60, NULL), RECTO_OK);
  assert_int_equal(paths.path.item[0].count, 2);
  paths_fini(&paths);
  add_path(&paths, bumps, 6, false);
  assert_int_equal(paths_simplify(&paths, 45, NULL), RECTO_OK);
  assert_int_equal(paths.path.item[0].count, 3);
  assert_int_equal(paths.point.item[1].x, 300);
  paths_fini(&paths);
  add_path(&paths, bumps, 6, false);
  assert_int_equal(paths_simplify(&paths, 1, NULL), RECTO_OK);
  assert_int_equal(paths.path.item[0].count, 6);
  paths_fini(&paths);
}

static void long_zigzag_is_simplified_soon(void **state) {
  /* The worst case of the method: every point stays, split off one by one. */
  int count = is_under_valgrind() ? 3000 : 300000;
  struct ink_paths paths = {0};
  struct ink_path path = {.count = (uint32_t)count};
  (void)state;
  for (int i = 0; i < count; i++) {
    struct ink_point p = {i * 1000, (i % 2 ? 1 : -1) * (i + 10) * 1000};
    assert_true(ARRAY_PUSH(&paths.point, p));
  }
  assert_true(ARRAY_PUSH(&paths.path, path));
  double before = clock_cpu();
  assert_int_equal(paths_simplify(&paths, 10, NULL), RECTO_OK);
  assert_true(is_under_valgrind() || clock_cpu() - before < 5);
  assert_int_equal(paths.path.item[0].count, count);
  paths_fini(&paths);
}

static void simplify_option_is_in_mm(void **state) {
  (void)state;
  for (int on = 0; on < 2; on++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    k.options.ink.simplify_mm = on ? 0.5 : 0;
    ink_fixture_line(&k, 10, 10, 50, 10.25, CREASE);
    ink_fixture_line(&k, 50, 10.25, 90, 10, CREASE);
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.item[0].count, on ? 2 : 3);
    ink_fixture_end(&k);
  }
}

/* ---- Short strokes ------------------------------------------------------- */

static void strokes_below_half_a_pen_are_dropped(void **state) {
  (void)state;
  static const struct {
    double minimum, length;
    bool drawn;
  } cases[] = {{-1, 0.14, false},
               {-1, 0.16, true},
               {0, 0.001, true},
               {2, 0.14, false},
               {2, 0.16, true}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    struct ink_fixture k;
    ink_fixture_start(&k);
    k.options.ink.min_stroke_mm = cases[i].minimum;
    ink_fixture_line(&k, 10, 10, 10 + cases[i].length, 10, RECTO_EDGE_BORDER);
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, cases[i].drawn);
    ink_fixture_end(&k);
  }
}

static void short_pieces_of_a_long_chain_stay(void **state) {
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.min_stroke_mm = 5;
  for (int i = 0; i < 100; i++)
    ink_fixture_line(&k, 10 + 2 * cos(0.05 * i), 10 + 2 * sin(0.05 * i),
                     10 + 2 * cos(0.05 * (i + 1)), 10 + 2 * sin(0.05 * (i + 1)),
                     CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  assert_int_equal(k.drawing.stroke.item[0].count, 101);
  ink_fixture_end(&k);
}

/* ---- Dashes -------------------------------------------------------------- */

/* How far along the line through `count` pairs the point is; fails when it is
 * off it. */
static double along(const double *xy, uint32_t count, struct drawing_point p,
                    double from) {
  double start = 0;
  for (uint32_t i = 0; i + 1 < count; i++) {
    const double *a = xy + 2 * i, *b = a + 2;
    double dx = b[0] - a[0], dy = b[1] - a[1], length = hypot(dx, dy);
    double t = ((p.x - a[0]) * dx + (p.y - a[1]) * dy) / length;
    double off = fabs((p.x - a[0]) * dy - (p.y - a[1]) * dx) / length;
    if (off < 10 * NANOMETRE && t > -NANOMETRE && t < length + NANOMETRE &&
        start + t > from - 10 * NANOMETRE)
      return start + t;
    start += length;
  }
  fail_msg("%.9f, %.9f is not on the line after %f", p.x, p.y, from);
  return 0;
}

static double length_of(const double *xy, uint32_t count, bool closed) {
  double length = 0;
  for (uint32_t i = 0; i + !closed < count; i++) {
    const double *a = xy + 2 * i, *b = xy + 2 * ((i + 1) % count);
    length += hypot(b[0] - a[0], b[1] - a[1]);
  }
  return length;
}

static void draw_hidden(struct ink_fixture *k, const double *xy, uint32_t count,
                        bool closed) {
  ink_fixture_start(k);
  k->options.ink.hidden = RECTO_HIDDEN_DASHED;
  for (uint32_t i = 0; i + !closed < count; i++) {
    const double *a = xy + 2 * i, *b = xy + 2 * ((i + 1) % count);
    ink_fixture_hide(k, ink_fixture_line(k, a[0], a[1], b[0], b[1], CREASE));
  }
  ink_fixture_draw(k);
}

/* All dashes of an open line are as long, all gaps three pens wide, dashes near
 * twelve. */
static void assert_dashes(const struct ink_fixture *k, const double *xy,
                          uint32_t count) {
  const double gap = 0.9, dash = 3.6;
  size_t dashes = k->drawing.stroke.count;
  double whole = length_of(xy, count, false), end = 0;
  double each = (whole - gap * (double)(dashes - 1)) / (double)dashes;
  assert_in_range(dashes, 2, 1000);
  if (dashes > 3)
    assert_true(each > 0.7 * dash && each < 1.4 * dash);
  for (size_t i = 0; i < dashes; i++) {
    const struct drawing_stroke *s = &k->drawing.stroke.item[i];
    const struct drawing_point *p = k->drawing.point.item + s->point;
    double from = along(xy, count, p[0], end);
    assert_true(fabs(from - (i ? end + gap : 0)) < 1e-5);
    assert_true(fabs(ink_fixture_stroke_length(k, i) - each) < 1e-5);
    assert_false(s->closed);
    for (uint32_t c = 1; c < s->count; c++)
      end = along(xy, count, p[c], from);
    assert_true(fabs(end - from - each) < 1e-5);
  }
  assert_true(fabs(end - whole) < 1e-5);
}

static void dashes_begin_and_end_with_ink(void **state) {
  (void)state;
  for (double x = 4; x < 90; x += 0.7) {
    struct ink_fixture k;
    const double line[] = {5, 10, 5 + x, 10};
    draw_hidden(&k, INK_FIXTURE_XY(line), false);
    assert_dashes(&k, INK_FIXTURE_XY(line));
    ink_fixture_end(&k);
  }
}

/* A circle of radius 35, or half of it. */
static void make_round(double *xy, uint32_t count, bool closed) {
  for (uint32_t i = 0; i < count; i++) {
    double angle = acos(-1) * i / (closed ? count / 2.0 : count - 1);
    xy[2 * i] = 50 + 35 * cos(angle);
    xy[2 * i + 1] = 50 + 35 * sin(angle);
  }
}

static void dashes_go_round_bends(void **state) {
  size_t bends = 0;
  (void)state;
  for (uint32_t count = 9; count < 40; count++) {
    struct ink_fixture k;
    double line[2 * 40];
    make_round(line, count, false);
    draw_hidden(&k, line, count, false);
    /* Paths begin at their lower end. */
    for (uint32_t i = 0; i < count / 2; i++)
      for (int c = 0; c < 2; c++) {
        double swap = line[2 * i + (uint32_t)c];
        line[2 * i + (uint32_t)c] = line[2 * (count - 1 - i) + (uint32_t)c];
        line[2 * (count - 1 - i) + (uint32_t)c] = swap;
      }
    assert_dashes(&k, line, count);
    for (size_t i = 0; i < k.drawing.stroke.count; i++)
      bends += k.drawing.stroke.item[i].count - 2;
    ink_fixture_end(&k);
  }
  assert_in_range(bends, 400, 700); /* of 682 */
}

/* An end of a stroke is there. */
static size_t count_ends(const struct ink_fixture *k, double x, double y) {
  size_t ends = 0;
  for (size_t i = 0; i < k->drawing.stroke.count; i++) {
    const struct drawing_stroke *s = &k->drawing.stroke.item[i];
    const struct drawing_point *p = k->drawing.point.item + s->point;
    for (uint32_t e = 0; e < 2; e++) {
      struct drawing_point q = p[e ? s->count - 1 : 0];
      ends += hypot(q.x - x, q.y - y) < NANOMETRE;
    }
  }
  return ends;
}

/* Every side begins and ends with ink: two strokes end at each corner. */
static void dashes_begin_anew_at_corners(void **state) {
  const double line[] = {10, 10, 40, 10, 40, 18, 48, 18, 90, 50, 20, 40};
  const double loop[] = {80, 70, 20, 70, 20, 10, 80, 10};
  struct ink_fixture k;
  (void)state;
  draw_hidden(&k, INK_FIXTURE_XY(line), false);
  for (int i = 0; i < 6; i++)
    assert_int_equal(count_ends(&k, line[2 * i], line[2 * i + 1]),
                     i == 0 || i == 5 ? 1 : 2);
  for (size_t i = 0; i < k.drawing.stroke.count; i++)
    assert_int_equal(k.drawing.stroke.item[i].count, 2);
  ink_fixture_end(&k);
  draw_hidden(&k, INK_FIXTURE_XY(loop), true);
  for (int i = 0; i < 4; i++)
    assert_int_equal(count_ends(&k, loop[2 * i], loop[2 * i + 1]), 2);
  assert_int_equal(k.drawing.stroke.count % 4, 0);
  ink_fixture_end(&k);
}

/* A loop with one corner is dashed from that corner round to it. */
static void loop_with_one_corner_begins_at_it(void **state) {
  enum { COUNT = 31 };
  struct ink_fixture k;
  double drop[2 * COUNT];
  (void)state;
  make_round(drop, COUNT - 1, false);
  drop[2 * COUNT - 2] = 50;
  drop[2 * COUNT - 1] = 2;
  draw_hidden(&k, drop, COUNT, true);
  assert_int_equal(count_ends(&k, 50, 2), 2);
  for (size_t i = 0; i < k.drawing.stroke.count; i++)
    assert_false(k.drawing.stroke.item[i].closed);
  ink_fixture_end(&k);
}

static void dashes_go_round_a_loop_evenly(void **state) {
  (void)state;
  for (uint32_t count = 14; count < 40; count += 2) {
    struct ink_fixture k;
    double loop[2 * 40];
    make_round(loop, count, true);
    draw_hidden(&k, loop, count, true);
    const double gap = 0.9, each = ink_fixture_stroke_length(&k, 0);
    double whole = length_of(loop, count, true);
    for (size_t i = 1; i < k.drawing.stroke.count; i++)
      assert_true(fabs(ink_fixture_stroke_length(&k, i) - each) < 1e-5);
    assert_true(fabs((each + gap) * (double)k.drawing.stroke.count - whole) <
                1e-4);
    ink_fixture_end(&k);
  }
}

static void short_hidden_line_is_drawn_whole(void **state) {
  struct ink_fixture k;
  const double line[] = {10, 10, 12.6, 10};
  (void)state;
  draw_hidden(&k, INK_FIXTURE_XY(line), false);
  assert_int_equal(k.drawing.stroke.count, 1);
  ink_fixture_assert_same_line(&k, 0, false, INK_FIXTURE_XY(line));
  ink_fixture_end(&k);
}

static void dashes_stand_on_the_layer_of_the_visible(void **state) {
  struct ink_fixture k;
  const double line[] = {10, 10, 50, 10};
  (void)state;
  draw_hidden(&k, INK_FIXTURE_XY(line), false);
  assert_int_equal(k.drawing.layer.count, 1);
  assert_string_equal(k.drawing.layer.item[0].label, "1 visible");
  ink_fixture_end(&k);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(straight_edge_is_two_points),
      cmocka_unit_test(subdivided_box_is_four_points),
      cmocka_unit_test(straightening_keeps_within_the_tolerance),
      cmocka_unit_test(fine_curve_does_not_drift),
      cmocka_unit_test(
          simplifying_keeps_the_turning_point_of_a_line_there_and_back),
      cmocka_unit_test(loop_without_width_becomes_a_line),
      cmocka_unit_test(simplifying_keeps_within_the_tolerance),
      cmocka_unit_test(simplifying_drops_what_it_may),
      cmocka_unit_test(long_zigzag_is_simplified_soon),
      cmocka_unit_test(simplify_option_is_in_mm),
      cmocka_unit_test(strokes_below_half_a_pen_are_dropped),
      cmocka_unit_test(short_pieces_of_a_long_chain_stay),
      cmocka_unit_test(dashes_begin_and_end_with_ink),
      cmocka_unit_test(dashes_go_round_bends),
      cmocka_unit_test(dashes_begin_anew_at_corners),
      cmocka_unit_test(loop_with_one_corner_begins_at_it),
      cmocka_unit_test(dashes_go_round_a_loop_evenly),
      cmocka_unit_test(short_hidden_line_is_drawn_whole),
      cmocka_unit_test(dashes_stand_on_the_layer_of_the_visible),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
