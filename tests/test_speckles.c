/* test_speckles.c - short creases that lead nowhere are not drawn, and nothing
 * else is left out with them. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <math.h>
#include <cmocka.h>

#include "tests/ink_fixture.h"

enum {
  SILHOUETTE = RECTO_EDGE_SILHOUETTE,
  BORDER = RECTO_EDGE_BORDER,
  CREASE = RECTO_EDGE_CREASE,
  GROUP = RECTO_EDGE_GROUP,
  INTERSECTION = RECTO_EDGE_INTERSECTION,
  WIRE = RECTO_EDGE_WIRE,
  SMOOTH = RECTO_EDGE_SMOOTH
};

static void start(struct ink_fixture *k) {
  ink_fixture_start(k);
  k->options.ink.min_stroke_mm = -1;
}

/* How many strokes a drawing of one line has. */
static size_t draw_line(double length, double min_stroke_mm, unsigned of,
                        bool exact) {
  struct ink_fixture k;
  start(&k);
  k.options.ink.min_stroke_mm = min_stroke_mm;
  k.options.ink.exact = exact;
  ink_fixture_line(&k, 10, 10, 10 + length, 10, of);
  ink_fixture_draw(&k);
  size_t strokes = k.drawing.stroke.count;
  assert_int_equal(k.drawing.counts.too_short, 1 - strokes);
  assert_int_equal(k.drawing.dropped.count, 1 - strokes);
  ink_fixture_end(&k);
  return strokes;
}

static void creases_shorter_than_ten_pens_are_dropped(void **state) {
  (void)state;
  assert_int_equal(draw_line(2.9, -1, CREASE, false), 0);
  assert_int_equal(draw_line(3.1, -1, CREASE, false), 1);
  assert_int_equal(draw_line(1.9, 2, CREASE, false), 0);
  assert_int_equal(draw_line(2.1, 2, CREASE, false), 1);
  assert_int_equal(draw_line(0.001, 0, CREASE, false), 1);
  assert_int_equal(draw_line(2.9, -1, GROUP, false), 0);
}

static void exact_drawings_drop_none(void **state) {
  (void)state;
  assert_int_equal(draw_line(0.2, -1, CREASE, true), 1);
  assert_int_equal(draw_line(0.1, -1, CREASE, true), 0);
  assert_int_equal(draw_line(2.9, 20, CREASE, true), 1);
}

/* Whatever the least length, of other lines only dots are dropped. */
static void other_lines_are_drawn(void **state) {
  static const unsigned other[] = {SILHOUETTE, BORDER, INTERSECTION, WIRE,
                                   SMOOTH};
  (void)state;
  for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
    assert_int_equal(draw_line(0.16, -1, other[i], false), 1);
    assert_int_equal(draw_line(0.16, 20, other[i], false), 1);
    assert_int_equal(draw_line(0.14, 20, other[i], false), 0);
    assert_int_equal(draw_line(0.14, 0.1, other[i], false), 1);
  }
}

/* A line from a to b of 2 mm, and at each of them, or not, a long one. */
static size_t draw_between(unsigned ends, unsigned of) {
  struct ink_fixture k;
  start(&k);
  uint32_t end[2] = {ink_fixture_point(&k, 50, 50),
                     ink_fixture_point(&k, 52, 50)};
  ink_fixture_edge(&k, end[0], end[1], CREASE);
  size_t longer = 0;
  for (int i = 0; i < 2; i++)
    for (int up = 0; up < 2 && (ends >> i & 1); up++) {
      uint32_t far = ink_fixture_point(&k, 50 + 2 * i, up ? 90 : 10);
      ink_fixture_edge(&k, far, end[i], of);
      longer = longer + 1;
    }
  ink_fixture_draw(&k);
  size_t dropped = k.drawing.dropped.count;
  double length = 0;
  for (size_t s = 0; s < k.drawing.stroke.count; s++)
    length += ink_fixture_stroke_length(&k, s);
  assert_true(fabs(length - 40.0 * (double)longer - (dropped ? 0 : 2)) < 1e-5);
  ink_fixture_end(&k);
  return dropped;
}

static void a_spur_is_dropped_and_a_bridge_is_not(void **state) {
  (void)state;
  static const unsigned of[] = {CREASE, SILHOUETTE, BORDER, WIRE};
  for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
    assert_int_equal(draw_between(0, of[i]), 1);
    assert_int_equal(draw_between(1, of[i]), 1);
    assert_int_equal(draw_between(2, of[i]), 1);
    assert_int_equal(draw_between(3, of[i]), 0);
  }
}

static void a_small_closed_line_is_drawn(void **state) {
  struct ink_fixture k;
  (void)state;
  start(&k);
  uint32_t p = ink_fixture_point(&k, 50, 50);
  uint32_t q = ink_fixture_point(&k, 50.3, 50);
  uint32_t r = ink_fixture_point(&k, 50, 50.3);
  ink_fixture_edge(&k, p, q, CREASE);
  ink_fixture_edge(&k, q, r, CREASE);
  ink_fixture_edge(&k, r, p, CREASE);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 1);
  assert_true(k.drawing.stroke.item[0].closed);
  ink_fixture_end(&k);
}

/* The length of a line is that of all its edges. */
static void a_long_line_of_short_edges_is_drawn(void **state) {
  (void)state;
  for (int edges = 20; edges <= 40; edges += 20) {
    struct ink_fixture k;
    start(&k);
    uint32_t p = ink_fixture_point(&k, 10, 10);
    for (int i = 1; i <= edges; i++) {
      uint32_t q = ink_fixture_point(&k, 10 + 0.1 * i, 10 + i % 2 * 0.01);
      ink_fixture_edge(&k, p, q, CREASE);
      p = q;
    }
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, edges == 40);
    ink_fixture_end(&k);
  }
}

/* What is seen of a line that is partly hidden ends where it is hidden, not
 * free; nor where a hidden edge continues it, nor at a point that clipping
 * made. */
static void a_line_that_goes_on_in_the_model_is_drawn(void **state) {
  (void)state;
  for (int kind = 0; kind < 4; kind++) {
    struct ink_fixture k;
    start(&k);
    uint32_t p = ink_fixture_point(&k, 20, 50);
    uint32_t q = ink_fixture_point(&k, 22, 50);
    uint32_t r = ink_fixture_point(&k, 30, 50);
    uint32_t o = ink_fixture_point(&k, 10, 50);
    if (kind == 0) {
      ink_fixture_show(&k, ink_fixture_edge(&k, o, r, CREASE), 1, 2, 10);
    } else if (kind == 1) {
      ink_fixture_edge(&k, p, q, CREASE);
      ink_fixture_hide(&k, ink_fixture_edge(&k, q, r, CREASE));
      ink_fixture_hide(&k, ink_fixture_edge(&k, o, p, CREASE));
    } else {
      ink_fixture_edge(&k, p, q, CREASE);
      k.sheet.vertex_count = kind == 2 ? p : r;
    }
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, kind < 3);
    ink_fixture_end(&k);
  }
}

/* One end hidden, the other one free: a speckle. */
static void a_free_end_of_a_half_hidden_line_counts(void **state) {
  struct ink_fixture k;
  (void)state;
  start(&k);
  ink_fixture_show(&k, ink_fixture_line(&k, 10, 10, 20, 10, CREASE), 0, 2, 10);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 0);
  ink_fixture_end(&k);
}

/* With ids a stroke is a piece of one edge; the line decides all the same. */
static void with_ids_the_line_decides(void **state) {
  (void)state;
  for (int edges = 1; edges <= 4; edges += 3) {
    struct ink_fixture k;
    start(&k);
    k.options.ink.ids = true;
    uint32_t p = ink_fixture_point(&k, 10, 10);
    for (int i = 1; i <= edges; i++) {
      uint32_t q = ink_fixture_point(&k, 10 + i, 10 + i % 2);
      ink_fixture_edge(&k, p, q, CREASE);
      p = q;
    }
    ink_fixture_draw(&k);
    assert_int_equal(k.drawing.stroke.count, edges == 1 ? 0 : 4);
    ink_fixture_end(&k);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(creases_shorter_than_ten_pens_are_dropped),
      cmocka_unit_test(exact_drawings_drop_none),
      cmocka_unit_test(other_lines_are_drawn),
      cmocka_unit_test(a_spur_is_dropped_and_a_bridge_is_not),
      cmocka_unit_test(a_small_closed_line_is_drawn),
      cmocka_unit_test(a_long_line_of_short_edges_is_drawn),
      cmocka_unit_test(a_line_that_goes_on_in_the_model_is_drawn),
      cmocka_unit_test(a_free_end_of_a_half_hidden_line_counts),
      cmocka_unit_test(with_ids_the_line_decides),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
