/* test_short_spurs.c - short silhouettes that lead nowhere are not drawn, and
 * what may be part of an outline is. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/ink_fixture.h"

static void start(struct ink_fixture *k) {
  ink_fixture_start(k);
  k->options.ink.min_stroke_mm = -1;
}

/* How many strokes there are; of those left out the segments are kept. */
static size_t draw(struct ink_fixture *k) {
  ink_fixture_draw(k);
  size_t strokes = k->drawing.stroke.count;
  assert_int_equal(k->drawing.dropped.count, k->drawing.counts.too_short);
  ink_fixture_end(k);
  return strokes;
}

static void line(struct ink_fixture *k, double x0, double y0, double x1,
                 double y1) {
  ink_fixture_line(k, x0, y0, x1, y1, RECTO_EDGE_SILHOUETTE);
}

/* A line of `length` mm alone. */
static size_t draw_alone(double length, double min_stroke_mm, bool exact) {
  struct ink_fixture k;
  start(&k);
  k.options.ink.min_stroke_mm = min_stroke_mm;
  k.options.ink.exact = exact;
  line(&k, 10, 10, 10 + length, 10);
  return draw(&k);
}

static void what_touches_nothing_is_twenty_pens_long(void **state) {
  (void)state;
  assert_int_equal(draw_alone(5.9, -1, false), 0);
  assert_int_equal(draw_alone(6.1, -1, false), 1);
  assert_int_equal(draw_alone(1.9, 1, false), 0);
  assert_int_equal(draw_alone(2.1, 1, false), 1);
  assert_int_equal(draw_alone(0.2, 0, false), 1);
  assert_int_equal(draw_alone(5.9, -1, true), 1);
}

/* A long line of two sides, and a short one of `length` mm from where they
 * meet to `gap` mm beside another long line, or far from any. */
static size_t draw_spur(double length, double gap, unsigned of) {
  struct ink_fixture k;
  start(&k);
  uint32_t at = ink_fixture_point(&k, 50, 50);
  ink_fixture_edge(&k, at, ink_fixture_point(&k, 10, 50), of);
  ink_fixture_edge(&k, at, ink_fixture_point(&k, 90, 50), of);
  ink_fixture_edge(&k, at, ink_fixture_point(&k, 50, 50 + length),
                   RECTO_EDGE_SILHOUETTE);
  if (gap > 0)
    line(&k, 10, 50 + length + gap, 90, 50 + length + gap);
  return draw(&k) - (gap > 0);
}

static void a_spur_is_ten_pens_long(void **state) {
  (void)state;
  assert_int_equal(draw_spur(2.9, 0, RECTO_EDGE_SILHOUETTE), 1);
  assert_int_equal(draw_spur(3.1, 0, RECTO_EDGE_SILHOUETTE), 2);
  assert_int_equal(draw_spur(2.9, 0, RECTO_EDGE_CREASE), 1);
}

/* Half a pen is 0.15 mm. */
static void a_link_between_lines_is_drawn(void **state) {
  (void)state;
  assert_int_equal(draw_spur(2, 0.14, RECTO_EDGE_SILHOUETTE), 2);
  assert_int_equal(draw_spur(2, 0.16, RECTO_EDGE_SILHOUETTE), 1);
}

/* A nearer outline ends within the picture; a farther one passes behind it, so
 * that up to there both are one outline. */
static void a_spur_on_which_a_line_ends_is_drawn(void **state) {
  (void)state;
  for (int ends = 0; ends < 2; ends++) {
    struct ink_fixture k;
    start(&k);
    uint32_t at = ink_fixture_point(&k, 50, 50);
    ink_fixture_edge(&k, at, ink_fixture_point(&k, 10, 50),
                     RECTO_EDGE_SILHOUETTE);
    ink_fixture_edge(&k, at, ink_fixture_point(&k, 90, 50),
                     RECTO_EDGE_SILHOUETTE);
    ink_fixture_edge(&k, at, ink_fixture_point(&k, 50, 52),
                     RECTO_EDGE_SILHOUETTE);
    line(&k, 90, 51, ends ? 50 : 51, 51);
    assert_int_equal(draw(&k), ends ? 3 : 2);
  }
}

/* What hides a part of a line leaves two spurs of it. */
static void pieces_of_one_edge_are_judged_apart(void **state) {
  (void)state;
  struct ink_fixture k;
  start(&k);
  uint32_t edge = ink_fixture_line(&k, 10, 10, 90, 10, RECTO_EDGE_SILHOUETTE);
  ink_fixture_show(&k, edge, 0, 2, 80);
  ink_fixture_show(&k, edge, 40, 80, 80);
  assert_int_equal(draw(&k), 1);
}

/* The middle of a crease, `length` mm of it, alone or with one end on another
 * line. */
static size_t draw_middle(double length, bool touches, bool smooth) {
  struct ink_fixture k;
  start(&k);
  if (smooth)
    k.options.ink.contours = RECTO_CONTOURS_SMOOTH;
  uint32_t edge = ink_fixture_line(&k, 10, 10, 90, 10, RECTO_EDGE_CREASE);
  ink_fixture_show(&k, edge, 40 * 8, (int64_t)((40 + length) * 8), 80 * 8);
  if (touches)
    line(&k, 50, 5, 50, 90);
  return draw(&k) - touches;
}

/* What hides the rest of it is drawn elsewhere, if it is a smooth contour. */
static void a_short_part_of_a_crease_touches_something(void **state) {
  (void)state;
  assert_int_equal(draw_middle(2.5, false, true), 0);
  assert_int_equal(draw_middle(3.5, false, true), 1);
  assert_int_equal(draw_middle(2.5, true, true), 1);
  assert_int_equal(draw_middle(2.5, false, false), 1);
}

/* A contour of a smooth surface of `length` mm, which ends in cusps, alone or
 * with one end on another line. */
static size_t draw_contour(double length, bool touches) {
  struct ink_fixture k;
  start(&k);
  k.options.ink.contours = RECTO_CONTOURS_SMOOTH;
  uint32_t edge =
      ink_fixture_line(&k, 50 - length, 10, 50, 10, RECTO_EDGE_SILHOUETTE);
  k.sheet.edge.item[edge].source = SHEET_NONE;
  k.sheet.vertex_count = 0;
  if (touches)
    line(&k, 50, 5, 50, 90);
  return draw(&k) - touches;
}

static void a_smooth_contour_alone_is_five_pens_long(void **state) {
  (void)state;
  assert_int_equal(draw_contour(1.4, false), 0);
  assert_int_equal(draw_contour(1.6, false), 1);
  assert_int_equal(draw_contour(1.4, true), 1);
}

/* Without creases what a silhouette leads to may not be drawn. */
static void of_some_classes_all_silhouettes_are_drawn(void **state) {
  (void)state;
  struct ink_fixture k;
  start(&k);
  k.options.ink.edges = RECTO_EDGE_SILHOUETTE | RECTO_EDGE_BORDER;
  line(&k, 10, 10, 12, 10);
  assert_int_equal(draw(&k), 1);
}

/* As the page, a cut, or the near plane make them. */
static void a_line_that_is_cut_off_is_drawn(void **state) {
  (void)state;
  struct ink_fixture k;
  start(&k);
  uint32_t edge = ink_fixture_line(&k, 10, 10, 12, 10, RECTO_EDGE_SILHOUETTE);
  k.sheet.vertex_count = k.sheet.edge.item[edge].point[1];
  assert_int_equal(draw(&k), 1);
}

/* A line with a tick of 2.2 mm at its end, from where another line that comes
 * from above turns back along it, by `beside` mm above. */
static size_t draw_beside(double unit_mm, double beside) {
  struct ink_fixture k;
  start(&k);
  k.options.output.unit_mm = unit_mm;
  uint32_t at = ink_fixture_point(&k, 50, 50);
  uint32_t before = ink_fixture_point(&k, 49, 50);
  uint32_t turn = ink_fixture_point(&k, 50, 50 + beside);
  ink_fixture_edge(&k, ink_fixture_point(&k, 10, 50), before,
                   RECTO_EDGE_SILHOUETTE);
  ink_fixture_edge(&k, before, at, RECTO_EDGE_SILHOUETTE);
  ink_fixture_edge(&k, at, ink_fixture_point(&k, 52, 51),
                   RECTO_EDGE_SILHOUETTE);
  ink_fixture_edge(&k, ink_fixture_point(&k, 50, 90), turn,
                   RECTO_EDGE_SILHOUETTE);
  ink_fixture_edge(&k, turn, ink_fixture_point(&k, 49, 50 + beside),
                   RECTO_EDGE_SILHOUETTE);
  return draw(&k);
}

/* Where what coincides is one line, the two lines meet and the tick is a spur;
 * where they are two lines, the tick is the end of one of them. */
static void spurs_are_the_same_for_all_outputs(void **state) {
  (void)state;
  const double unit_mm[] = {0, 0.0001, 0.001, 0.025, 0.1};
  for (size_t i = 0; i < sizeof unit_mm / sizeof *unit_mm; i++) {
    assert_int_equal(draw_beside(unit_mm[i], 0.0005), 1);
    assert_int_equal(draw_beside(unit_mm[i], 0.002), 2);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_touches_nothing_is_twenty_pens_long),
      cmocka_unit_test(a_spur_is_ten_pens_long),
      cmocka_unit_test(a_link_between_lines_is_drawn),
      cmocka_unit_test(a_spur_on_which_a_line_ends_is_drawn),
      cmocka_unit_test(pieces_of_one_edge_are_judged_apart),
      cmocka_unit_test(a_short_part_of_a_crease_touches_something),
      cmocka_unit_test(a_smooth_contour_alone_is_five_pens_long),
      cmocka_unit_test(of_some_classes_all_silhouettes_are_drawn),
      cmocka_unit_test(a_line_that_is_cut_off_is_drawn),
      cmocka_unit_test(spurs_are_the_same_for_all_outputs),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
