/* test_curves.c - curves keep to their strokes: near them, with their ends and
 * corners, through the places where strokes meet, and without new crossings. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "ink/curve/curves.h"
#include "tests/drawing_fixture.h"
#include "tests/memory_faults.h"
#include "tests/scenes/random.h"

#define PAGE_MM 200.0
#define TOLERANCE_MM 0.1
/* The most by which smooth strokes turn between pieces: a line, and what is
 * rounded, by as much. */
#define KINK_MAX (1 / 64.0 + 1e-9)
#define FINE_MM 0.0005 /* of chords that stand for a curve */

enum { POINTS_MAX = 1024 };

typedef struct drawing_point point;

/* ---- Strokes ------------------------------------------------------------- */

static void start(struct drawing *drawing) {
  drawing_fixture_page(drawing, PAGE_MM, PAGE_MM);
  (void)drawing_fixture_layer(drawing, 1, 0.3, 0);
}

static void fit(struct drawing *drawing) {
  assert_true(curves_fit(drawing, TOLERANCE_MM));
  assert_int_equal(drawing->curve.count, drawing->stroke.count);
}

/* An arc of an ellipse about the middle of the page, by `count` points. */
static void add_arc(struct drawing *drawing, double a, double b, double from,
                    double to, uint32_t count, bool closed) {
  double xy[2 * POINTS_MAX];
  for (uint32_t i = 0; i < count; i++) {
    double t = from + (to - from) * i / (closed ? count : count - 1);
    xy[2 * i] = PAGE_MM / 2 + a * cos(t);
    xy[2 * i + 1] = PAGE_MM / 2 + b * sin(t);
  }
  drawing_fixture_stroke(drawing, 0, xy, count, closed);
}

/* How many pieces of a stroke's curve are straight, or are not. */
static uint32_t count_pieces(const struct drawing *drawing, size_t stroke,
                             bool straight) {
  const struct drawing_curve *curve = drawing_curve_of(drawing, stroke);
  uint32_t pieces = 0;
  assert_non_null(curve);
  for (uint32_t i = 0; i + 3 < curve->count; i += 3)
    pieces += drawing_piece_is_straight(drawing->control.item + curve->control +
                                        i) == straight;
  return pieces;
}

/* A polyline; its user frees `at`. */
struct polyline {
  point *at;
  size_t count; /* a closed one repeats its first point */
};

static struct polyline close_line(const point *at, size_t count, bool closed) {
  struct polyline line = {malloc((count + 1) * sizeof *at), count + closed};
  assert_non_null(line.at);
  for (size_t i = 0; i < line.count; i++)
    line.at[i] = at[i % count];
  return line;
}

static struct polyline stroke_line(const struct drawing *drawing, size_t i) {
  const struct drawing_stroke *stroke = &drawing->stroke.item[i];
  return close_line(drawing->point.item + stroke->point, stroke->count,
                    stroke->closed);
}

/* The curve of a stroke by fine chords; the stroke, where it has none. */
static struct polyline curve_line(const struct drawing *drawing, size_t i) {
  const struct drawing_stroke *stroke = &drawing->stroke.item[i];
  const struct drawing_curve *curve = drawing_curve_of(drawing, i);
  struct drawing_polyline fine = {{NULL, 0, 0}};
  if (curve == NULL)
    return stroke_line(drawing, i);
  assert_true(drawing_flatten(drawing, stroke, curve, FINE_MM, &fine));
  struct polyline line =
      close_line(fine.point.item, fine.point.count, stroke->closed);
  ARRAY_FREE(&fine.point);
  return line;
}

/* ---- Distances and crossings --------------------------------------------- */

static double distance_to_side(point p, point a, point b) {
  double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
  double t = length2 > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length2 : 0;
  t = fmin(fmax(t, 0), 1);
  return hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

static double distance_to_line(point p, const struct polyline *line) {
  double nearest = INFINITY;
  for (size_t i = 1; i < line->count; i++)
    nearest = fmin(nearest, distance_to_side(p, line->at[i - 1], line->at[i]));
  return nearest;
}

/* The largest distance of a point of one line from the other line. */
static double largest_distance(const struct polyline *from,
                               const struct polyline *to) {
  double largest = 0;
  for (size_t i = 0; i < from->count; i++)
    largest = fmax(largest, distance_to_line(from->at[i], to));
  return largest;
}

static double largest_deviation(const struct drawing *drawing, size_t i) {
  struct polyline stroke = stroke_line(drawing, i);
  struct polyline curve = curve_line(drawing, i);
  double deviation = fmax(largest_distance(&stroke, &curve),
                          largest_distance(&curve, &stroke));
  free(stroke.at);
  free(curve.at);
  return deviation;
}

static double cross(point o, point a, point b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/* How often the lines cross.  One of them is moved a little, so that no point
 * of the one is on the other. */
static size_t count_crossings(const struct polyline *a,
                              const struct polyline *b) {
  size_t crossings = 0;
  for (size_t i = 1; i < a->count; i++)
    for (size_t k = 1; k < b->count; k++) {
      point p = a->at[i - 1], q = a->at[i];
      point r = {b->at[k - 1].x + 1e-7, b->at[k - 1].y + 1.7e-7};
      point s = {b->at[k].x + 1e-7, b->at[k].y + 1.7e-7};
      crossings += (cross(p, q, r) > 0) != (cross(p, q, s) > 0) &&
                   (cross(r, s, p) > 0) != (cross(r, s, q) > 0);
    }
  return crossings;
}

/* How often a line crosses itself. */
static size_t count_own_crossings(const struct polyline *a) {
  size_t crossings = 0;
  for (size_t i = 1; i < a->count; i++)
    for (size_t k = i + 2; k < a->count; k++) {
      point p = a->at[i - 1], q = a->at[i];
      point r = {a->at[k - 1].x + 1e-7, a->at[k - 1].y + 1.7e-7};
      point s = {a->at[k].x + 1e-7, a->at[k].y + 1.7e-7};
      crossings += (cross(p, q, r) > 0) != (cross(p, q, s) > 0) &&
                   (cross(r, s, p) > 0) != (cross(r, s, q) > 0);
    }
  return crossings;
}

/* The angle, radians, by which a curve turns between two pieces. */
static double kink_between(const point first[4], const point second[4]) {
  const point *from = drawing_piece_is_straight(first) ? first : first + 2;
  const point *to = second + (drawing_piece_is_straight(second) ? 3 : 1);
  double x = first[3].x - from->x, y = first[3].y - from->y;
  double u = to->x - second[0].x, v = to->y - second[0].y;
  return fabs(atan2(x * v - y * u, x * u + y * v));
}

/* The largest angle between two pieces of a stroke's curve. */
static double largest_kink(const struct drawing *drawing, size_t stroke) {
  const struct drawing_curve *curve = drawing_curve_of(drawing, stroke);
  const point *control = drawing->control.item + curve->control;
  double largest = 0;
  for (uint32_t i = 3; i + 3 < curve->count; i += 3)
    largest = fmax(largest, kink_between(control + i - 3, control + i));
  return largest;
}

/* ---- Claims -------------------------------------------------------------- */

static void ellipse_becomes_a_few_curves(void **state) {
  (void)state;
  for (uint32_t points = 128; points <= POINTS_MAX; points *= 2) {
    struct drawing drawing;
    start(&drawing);
    add_arc(&drawing, 80, 50, 0.1, 2 * M_PI + 0.1, points, true);
    fit(&drawing);
    assert_int_equal(count_pieces(&drawing, 0, true), 0);
    assert_in_range(count_pieces(&drawing, 0, false), 4, 8);
    assert_true(largest_kink(&drawing, 0) < KINK_MAX);
    assert_true(largest_deviation(&drawing, 0) < TOLERANCE_MM);
    drawing_fini(&drawing);
  }
}

/* As the contour of a mesh zigzags about that of the surface. */
static void zigzag_becomes_a_few_curves(void **state) {
  (void)state;
  enum { POINTS = 150 };
  double xy[2 * POINTS];
  struct drawing drawing;
  start(&drawing);
  for (int i = 0; i < POINTS; i++) {
    double t = M_PI * i / (POINTS - 1.0);
    double r = 80 + (i % 3 - 1) * 0.6 * TOLERANCE_MM;
    xy[2 * i] = PAGE_MM / 2 + r * cos(t);
    xy[2 * i + 1] = 40 + r * sin(t);
  }
  drawing_fixture_stroke(&drawing, 0, xy, POINTS, false);
  fit(&drawing);
  assert_int_equal(count_pieces(&drawing, 0, true), 0);
  assert_in_range(count_pieces(&drawing, 0, false), 2, 4);
  assert_true(largest_deviation(&drawing, 0) < TOLERANCE_MM + FINE_MM);
  drawing_fini(&drawing);
}

/* By how much a ring of few points is left by its curve. */
static double deviation_of_ring(bool has_fill) {
  struct drawing drawing;
  start(&drawing);
  add_arc(&drawing, 60, 60, 0, 2 * M_PI, 30, true);
  if (has_fill)
    assert_true(ARRAY_PUSH(&drawing.fill, ((struct drawing_fill){.face = 0})));
  assert_true(curves_fit(&drawing, 1));
  double deviation = largest_deviation(&drawing, 0);
  drawing_fini(&drawing);
  return deviation;
}

/* Two fifths of a line of 0.3 mm. */
static void curve_covers_the_border_of_a_fill(void **state) {
  (void)state;
  assert_true(deviation_of_ring(false) > 0.2);
  assert_true(deviation_of_ring(true) <= 0.12);
}

/* Handles are rounded, by which each turns by no more than 1/64. */
static void ring_has_no_corner_where_it_begins(void **state) {
  (void)state;
  struct drawing drawing;
  start(&drawing);
  add_arc(&drawing, 60, 60, 1, 2 * M_PI + 1, 256, true);
  fit(&drawing);
  const struct drawing_curve *curve = drawing_curve_of(&drawing, 0);
  const point *first = drawing.control.item + curve->control;
  const point *last = first + curve->count - 1;
  assert_true(first->x == last->x && first->y == last->y);
  assert_true(kink_between(last - 3, first) < 2 / 64.0 + 1e-9);
  drawing_fini(&drawing);
}

static bool is_decimal(double at, double step) {
  return fabs(at / step - round(at / step)) < 1e-6;
}

/* A tenth of the tolerance is decimals enough, as in a file most relative
 * numbers are: of all but the last point of an open stroke. */
static void points_of_curves_have_few_decimals(void **state) {
  (void)state;
  struct drawing drawing;
  uint32_t rounded = 0, offsets = 0;
  start(&drawing);
  add_arc(&drawing, 70, 40, 0.5, 3.5, 200, false);
  fit(&drawing);
  const struct drawing_curve *curve = drawing_curve_of(&drawing, 0);
  const point *control = drawing.control.item + curve->control;
  for (uint32_t i = 0; i + 3 < curve->count; i += 3) {
    for (uint32_t k = 1; k < (i + 4 < curve->count ? 4 : 3); k++) {
      offsets += 2;
      rounded += is_decimal(control[i + k].x - control[i].x, 0.01);
      rounded += is_decimal(control[i + k].y - control[i].y, 0.01);
    }
  }
  assert_true(offsets > 8 && 4 * rounded >= 3 * offsets);
  assert_true(largest_kink(&drawing, 0) < KINK_MAX);
  assert_true(largest_deviation(&drawing, 0) < TOLERANCE_MM);
  drawing_fini(&drawing);
}

static void open_arc_keeps_its_ends(void **state) {
  (void)state;
  struct drawing drawing;
  start(&drawing);
  add_arc(&drawing, 70, 40, 0.5, 3.5, 200, false);
  fit(&drawing);
  const struct drawing_curve *curve = drawing_curve_of(&drawing, 0);
  const point *control = drawing.control.item + curve->control;
  const point *own = drawing.point.item;
  assert_true(control[0].x == own[0].x && control[0].y == own[0].y);
  assert_true(control[curve->count - 1].x == own[199].x &&
              control[curve->count - 1].y == own[199].y);
  assert_in_range(count_pieces(&drawing, 0, false), 1, 4);
  drawing_fini(&drawing);
}

static void polygon_stays_a_polygon(void **state) {
  (void)state;
  struct drawing drawing;
  start(&drawing);
  drawing_fixture_box(&drawing, 0, 20, 20, 80, 60);
  drawing_fixture_line(&drawing, 0, 5, 5, 190, 7);
  add_arc(&drawing, 60, 60, 0, 2 * M_PI, 16, true); /* sides of 23 mm */
  fit(&drawing);
  for (size_t i = 0; i < drawing.stroke.count; i++)
    assert_null(drawing_curve_of(&drawing, i));
  assert_int_equal(drawing.control.count, 0);
  drawing_fini(&drawing);
}

/* Two half circles of 32 sides each, and the two sides between them. */
static void rounded_slot_keeps_its_straight_sides(void **state) {
  (void)state;
  struct drawing drawing;
  double xy[2 * 66];
  for (int half = 0; half < 2; half++)
    for (int i = 0; i <= 32; i++) {
      double t = M_PI * (half + i / 32.0) - M_PI / 2;
      xy[2 * (33 * half + i)] = (half == 0 ? 140 : 60) + 20 * cos(t);
      xy[2 * (33 * half + i) + 1] = 100 + 20 * sin(t);
    }
  start(&drawing);
  drawing_fixture_stroke(&drawing, 0, xy, 66, true);
  fit(&drawing);
  assert_int_equal(count_pieces(&drawing, 0, true), 2);
  assert_in_range(count_pieces(&drawing, 0, false), 2, 6);
  assert_true(largest_deviation(&drawing, 0) < TOLERANCE_MM);
  drawing_fini(&drawing);
}

/* Sides in a row become one line, also where other strokes end on them; an arc
 * of few points beside them does not become lines that turn. */
static void sides_in_a_row_become_one_line(void **state) {
  (void)state;
  enum { ROW = 21, ARC = 11 };
  double xy[2 * (ROW + ARC)];
  struct drawing drawing;
  start(&drawing);
  for (int i = 0; i < ROW; i++) {
    xy[2 * i] = 20 + 4 * i + i % 3;
    xy[2 * i + 1] = 40;
  }
  for (int i = 0; i < ARC; i++) {
    double t = 1.2 * (i + 1.0) / ARC;
    xy[2 * (ROW + i)] = xy[2 * (ROW - 1)] + 12 * sin(t);
    xy[2 * (ROW + i) + 1] = 40 + 12 - 12 * cos(t);
  }
  drawing_fixture_stroke(&drawing, 0, xy, ROW + ARC, false);
  drawing_fixture_line(&drawing, 0, xy[10], 40, 60, 90);
  fit(&drawing);
  assert_int_equal(count_pieces(&drawing, 0, true), 1);
  assert_in_range(count_pieces(&drawing, 0, false), 1, 2);
  assert_true(largest_kink(&drawing, 0) < KINK_MAX);
  assert_true(largest_deviation(&drawing, 0) < TOLERANCE_MM);
  drawing_fini(&drawing);
}

/* The sides of a coarse arc stay lines.  Their vertices have few decimals, but
 * not corners, ends, or where another stroke ends. */
static void vertices_of_lines_have_few_decimals(void **state) {
  (void)state;
  enum { ROW = 2, SIDES = 9, MET = ROW + 4, CORNER = ROW + SIDES };
  enum { COUNT = CORNER + 2 };
  double xy[2 * COUNT] = {160, 60.4321, 160, 71};
  struct drawing drawing;
  start(&drawing);
  for (int i = 0; i <= SIDES; i++) {
    double t = 2.0 * i / SIDES;
    xy[2 * (ROW + i)] = 100 + 60 * cos(t);
    xy[2 * (ROW + i) + 1] = 80 + 60 * sin(t);
  }
  xy[2 * COUNT - 2] = 50.12345;
  xy[2 * COUNT - 1] = 30.54321;
  drawing_fixture_stroke(&drawing, 0, xy, COUNT, false);
  drawing_fixture_line(&drawing, 0, xy[2 * MET], xy[2 * MET + 1], 10, 10);
  fit(&drawing);
  const struct drawing_curve *curve = drawing_curve_of(&drawing, 0);
  assert_non_null(curve);
  assert_int_equal(curve->count, 1 + 3 * (COUNT - 2)); /* one side less */
  const point *at = drawing.control.item + curve->control;
  for (int i = 2, k = 3; i < COUNT; i++, k += 3) {
    bool stays = i == MET || i == CORNER || i + 1 == COUNT || i + 1 == MET ||
                 i + 1 == CORNER;
    bool same = at[k].x == xy[2 * i] && at[k].y == xy[2 * i + 1];
    assert_true(stays == same);
    assert_true(stays || (is_decimal(at[k].x - at[k - 3].x, 0.01) &&
                          is_decimal(at[k].y - at[k - 3].y, 0.01)));
  }
  assert_true(largest_deviation(&drawing, 0) <= TOLERANCE_MM / 2);
  drawing_fini(&drawing);
}

static void corner_between_arcs_stays(void **state) {
  (void)state;
  struct drawing drawing;
  double xy[2 * 121];
  for (int i = 0; i <= 120; i++) { /* a lens' tip at i = 60 */
    double t = (i - 60) / 60.0;
    xy[2 * i] = 100 + 50 * t;
    xy[2 * i + 1] = 50 + 60 * fabs(t) - 15 * t * t;
  }
  start(&drawing);
  drawing_fixture_stroke(&drawing, 0, xy, 121, false);
  fit(&drawing);
  struct polyline curve = curve_line(&drawing, 0);
  double nearest = INFINITY;
  for (size_t i = 0; i < curve.count; i++)
    nearest = fmin(nearest, hypot(curve.at[i].x - 100, curve.at[i].y - 50));
  assert_true(nearest == 0);
  assert_in_range(count_pieces(&drawing, 0, false), 2, 4);
  free(curve.at);
  drawing_fini(&drawing);
}

/* Of strokes that end on an arc the ends stay on its curve. */
static void curve_passes_where_strokes_meet(void **state) {
  (void)state;
  struct drawing drawing;
  double ends[3] = {0.7, 1.3, 2.2};
  start(&drawing);
  add_arc(&drawing, 80, 50, 0.2, 2.9, 150, false);
  for (int i = 0; i < 3; i++) {
    const struct polyline arc = {drawing.point.item, 150};
    point p = {100 + 80 * cos(ends[i]), 100 + 50 * sin(ends[i])};
    size_t best = 1;
    for (size_t k = 1; k < arc.count; k++)
      if (distance_to_side(p, arc.at[k - 1], arc.at[k]) <
          distance_to_side(p, arc.at[best - 1], arc.at[best]))
        best = k;
    point on = {(arc.at[best - 1].x + 2 * arc.at[best].x) / 3,
                (arc.at[best - 1].y + 2 * arc.at[best].y) / 3};
    drawing_fixture_line(&drawing, 0, 100, 90, on.x, on.y);
  }
  fit(&drawing);
  struct polyline curve = curve_line(&drawing, 0);
  for (size_t i = 1; i <= 3; i++) {
    point end = drawing.point.item[drawing.stroke.item[i].point + 1];
    assert_true(distance_to_line(end, &curve) < 1e-9);
  }
  assert_in_range(count_pieces(&drawing, 0, false), 4, 8);
  free(curve.at);
  drawing_fini(&drawing);
}

/* A wave across the page, with a little noise. */
static void add_wave(struct drawing *drawing, struct random *random,
                     double height) {
  double xy[2 * POINTS_MAX];
  uint32_t count = 100 + random_below(random, 200);
  double noise = random_below(random, 2) ? 0 : random_between(random, 0, 0.05);
  double wave = random_between(random, 1, 5);
  double size = random_between(random, 1, 12);
  for (uint32_t i = 0; i < count; i++) {
    double t = i / (count - 1.0);
    xy[2 * i] = 20 + 160 * t;
    xy[2 * i + 1] = height + size * sin(wave * 2 * M_PI * t) +
                    random_between(random, -noise, noise);
  }
  drawing_fixture_stroke(drawing, 0, xy, count, false);
}

/* Waves, some of which cross, and copies a fraction of the tolerance, or a few
 * tolerances, above them. */
static void add_close_waves(struct drawing *drawing, struct random *random) {
  for (int i = 0; i < 3; i++) {
    struct random again = *random;
    double height = random_between(random, 80, 120);
    again = *random;
    add_wave(drawing, random, height);
    add_wave(drawing, &again,
             height + TOLERANCE_MM * random_between(random, 0.02, 4));
  }
}

static void curves_cross_where_strokes_do(void **state) {
  (void)state;
  struct random random = {7};
  size_t crossings = 0, curves = 0;
  for (int scene = 0; scene < 12; scene++) {
    struct drawing drawing;
    start(&drawing);
    add_close_waves(&drawing, &random);
    fit(&drawing);
    for (size_t i = 0; i < drawing.stroke.count; i++) {
      struct polyline own = stroke_line(&drawing, i);
      struct polyline curve = curve_line(&drawing, i);
      assert_true(largest_deviation(&drawing, i) <= TOLERANCE_MM);
      curves += drawing_curve_of(&drawing, i) != NULL;
      for (size_t k = 0; k < i; k++) {
        struct polyline other = stroke_line(&drawing, k);
        struct polyline other_curve = curve_line(&drawing, k);
        size_t count = count_crossings(&own, &other);
        assert_int_equal(count_crossings(&curve, &other_curve), count);
        crossings += count;
        free(other.at);
        free(other_curve.at);
      }
      free(own.at);
      free(curve.at);
    }
    drawing_fini(&drawing);
  }
  assert_true(crossings > 50);
  assert_true(curves > 40);
}

/* A stroke that runs to a cusp and back: beside the cusp its two sides are
 * nearer than the tolerance.  They turn to either side, by many points or few,
 * which zigzag or do not. */
static void add_cusp(struct drawing *drawing, struct random *random) {
  double xy[2 * POINTS_MAX];
  uint32_t half = 4 + random_below(random, 60);
  double angle = random_between(random, 0.002, 0.2);
  double bend = random_between(random, -0.01, 0.01);
  double noise = random_below(random, 2) ? 0 : angle * 0.05;
  double length = random_below(random, 2) ? random_between(random, 0.2, 2) : 40;
  for (uint32_t i = 0; i <= 2 * half; i++) {
    double t = fabs(i - (double)half) / half * length;
    double away = i < half ? 0 : angle * t;
    xy[2 * i] = 20 + t;
    xy[2 * i + 1] =
        100 + bend * t * t + away + random_between(random, -noise, noise) * t;
  }
  drawing_fixture_stroke(drawing, 0, xy, 2 * half + 1, false);
}

static void sides_of_a_cusp_do_not_cross(void **state) {
  (void)state;
  struct random random = {11};
  size_t curves = 0;
  for (int scene = 0; scene < 200; scene++) {
    struct drawing drawing;
    start(&drawing);
    add_cusp(&drawing, &random);
    fit(&drawing);
    struct polyline own = stroke_line(&drawing, 0);
    struct polyline curve = curve_line(&drawing, 0);
    assert_int_equal(count_own_crossings(&curve), count_own_crossings(&own));
    curves += drawing_curve_of(&drawing, 0) != NULL;
    free(own.at);
    free(curve.at);
    drawing_fini(&drawing);
  }
  assert_true(curves > 50);
}

/* A line to the right that falls, with loops of a tolerance or less on its way,
 * some of which do not close. */
static void add_small_loops(struct drawing *drawing, struct random *random) {
  double xy[2 * POINTS_MAX], x = 20, y = 100;
  uint32_t count = 0;
  for (int loop = 0; loop < 8; loop++) {
    double side = TOLERANCE_MM * (0.1 + random_between(random, 0, 1));
    double back = side * random_between(random, 0, 2);
    const double step[][2] = {{4, -0.2},
                              {4, -0.3},
                              {side, side},
                              {-back, 0.3 * side},
                              {side, -2 * side}};
    for (size_t i = 0; i < sizeof step / sizeof *step; i++) {
      xy[2 * count] = x += step[i][0];
      xy[2 * count + 1] = y += step[i][1];
      count++;
    }
  }
  drawing_fixture_stroke(drawing, 0, xy, count, false);
}

static void small_loops_stay(void **state) {
  (void)state;
  struct random random = {12};
  size_t curves = 0, crossings = 0;
  for (int scene = 0; scene < 200; scene++) {
    struct drawing drawing;
    start(&drawing);
    add_small_loops(&drawing, &random);
    fit(&drawing);
    struct polyline own = stroke_line(&drawing, 0);
    struct polyline curve = curve_line(&drawing, 0);
    size_t count = count_own_crossings(&own);
    assert_int_equal(count_own_crossings(&curve), count);
    crossings += count;
    curves += drawing_curve_of(&drawing, 0) != NULL;
    free(own.at);
    free(curve.at);
    drawing_fini(&drawing);
  }
  assert_true(curves > 50);
  assert_true(crossings > 200);
}

static void chords_are_as_near_as_asked(void **state) {
  (void)state;
  struct drawing drawing;
  start(&drawing);
  add_arc(&drawing, 80, 50, 0, 2 * M_PI, 512, true);
  fit(&drawing);
  struct polyline fine = curve_line(&drawing, 0);
  size_t before = SIZE_MAX;
  for (double distance = 0.01; distance < 1; distance *= 4) {
    struct drawing_polyline line = {{NULL, 0, 0}};
    assert_true(drawing_flatten(&drawing, &drawing.stroke.item[0],
                                drawing_curve_of(&drawing, 0), distance,
                                &line));
    struct polyline chords =
        close_line(line.point.item, line.point.count, true);
    assert_true(largest_distance(&fine, &chords) <= distance + FINE_MM);
    assert_true(line.point.count < before);
    before = line.point.count;
    free(chords.at);
    ARRAY_FREE(&line.point);
  }
  free(fine.at);
  drawing_fini(&drawing);
}

/* The box of a Bezier curve's points at so many parameters, widened by half the
 * pen, is nearly that of the curve. */
static void include_samples(struct drawing_window *box, const point p[4],
                            double half_width) {
  enum { SAMPLES = 4096 };
  for (int i = 0; i <= SAMPLES; i++) {
    double t = i / (double)SAMPLES, s = 1 - t;
    const double share[] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    point at = {0, 0};
    for (int k = 0; k < 4; k++) {
      at.x += share[k] * p[k].x;
      at.y += share[k] * p[k].y;
    }
    box->x0 = fmin(box->x0, at.x - half_width);
    box->y0 = fmin(box->y0, at.y - half_width);
    box->x1 = fmax(box->x1, at.x + half_width);
    box->y1 = fmax(box->y1, at.y + half_width);
  }
}

/* Of random pieces, some of which are parabolas or straight along an axis. */
static void a_tight_page_is_the_box_of_the_curve(void **state) {
  (void)state;
  struct random random = {16};
  size_t smaller = 0;
  for (int trial = 0; trial < 300; trial++) {
    struct drawing drawing;
    struct drawing_window box = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    bool outside = false;
    start(&drawing);
    drawing_fixture_line(&drawing, 0, 0, 0, 1, 1);
    for (uint32_t k = 0; k < 7; k++) {
      point at = {random_int(&random, 90, 99), random_int(&random, 50, 53)};
      assert_true(ARRAY_PUSH(&drawing.control, at));
    }
    struct drawing_curve curve = {0, 7};
    assert_true(ARRAY_PUSH(&drawing.curve, curve));
    const point *control = drawing.control.item;
    include_samples(&box, control, 0.15);
    include_samples(&box, control + 3, 0.15);
    struct drawing_window tight = drawing_window(&drawing, true);
    const double slack = 1e-5, least[] = {tight.x0 - box.x0, tight.y0 - box.y0,
                                          box.x1 - tight.x1, box.y1 - tight.y1};
    for (int k = 0; k < 4; k++)
      assert_true(least[k] < 1e-9 && least[k] > -slack);
    for (uint32_t k = 0; k < 7; k++)
      outside = outside || control[k].x < tight.x0 || control[k].x > tight.x1 ||
                control[k].y < tight.y0 || control[k].y > tight.y1;
    smaller += outside;
    drawing_fini(&drawing);
  }
  assert_true(smaller > 100);
}

/* Any length is a tolerance, and any strokes are strokes. */
static void odd_strokes_are_survived(void **state) {
  (void)state;
  static const double lengths[] = {1e-300, 1e-9, 1e-3, 10, 1e300};
  struct random random = {3};
  for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
    struct drawing drawing;
    start(&drawing);
    for (int k = 0; k < 40; k++) {
      double xy[2 * 12];
      uint32_t count = 1 + random_below(&random, 12);
      for (uint32_t j = 0; j < 2 * count; j++)
        xy[j] = random_int(&random, -3, 8) * (k % 2 ? 1e-4 : 30);
      drawing_fixture_stroke(&drawing, 0, xy, count, k % 3 == 0 && count > 2);
    }
    add_arc(&drawing, 70, 40, 0.5, 3.5, 50, false);
    assert_true(curves_fit(&drawing, lengths[i]));
    for (size_t k = 0; k < drawing.control.count; k++)
      assert_true(isfinite(drawing.control.item[k].x) &&
                  isfinite(drawing.control.item[k].y));
    drawing_fini(&drawing);
  }
}

static void running_out_of_memory_is_reported(void **state) {
  (void)state;
  struct memory_faults faults = {.least = 5};
  while (memory_faults_go_on(&faults)) {
    struct drawing drawing;
    start(&drawing);
    add_arc(&drawing, 80, 50, 0, 2 * M_PI, 256, true);
    memory_faults_begin(&faults);
    bool ok = curves_fit(&drawing, TOLERANCE_MM);
    memory_faults_end(&faults, memory_faults_status(ok));
    assert_int_equal(drawing.curve.count, ok);
    drawing_fini(&drawing);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(ellipse_becomes_a_few_curves),
      cmocka_unit_test(zigzag_becomes_a_few_curves),
      cmocka_unit_test(curve_covers_the_border_of_a_fill),
      cmocka_unit_test(ring_has_no_corner_where_it_begins),
      cmocka_unit_test(points_of_curves_have_few_decimals),
      cmocka_unit_test(open_arc_keeps_its_ends),
      cmocka_unit_test(polygon_stays_a_polygon),
      cmocka_unit_test(rounded_slot_keeps_its_straight_sides),
      cmocka_unit_test(sides_in_a_row_become_one_line),
      cmocka_unit_test(vertices_of_lines_have_few_decimals),
      cmocka_unit_test(corner_between_arcs_stays),
      cmocka_unit_test(curve_passes_where_strokes_meet),
      cmocka_unit_test(curves_cross_where_strokes_do),
      cmocka_unit_test(sides_of_a_cusp_do_not_cross),
      cmocka_unit_test(small_loops_stay),
      cmocka_unit_test(chords_are_as_near_as_asked),
      cmocka_unit_test(a_tight_page_is_the_box_of_the_curve),
      cmocka_unit_test(odd_strokes_are_survived),
      cmocka_unit_test(running_out_of_memory_is_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
