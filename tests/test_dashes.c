/* test_dashes.c - patterns of dashes: how they are read, which lines they are
 * for, and how they are fitted to these. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/ink_fixture.h"

#define CREASE RECTO_EDGE_CREASE
#define SILHOUETTE RECTO_EDGE_SILHOUETTE

static recto_dash dash_of(const char *text, recto_edge_class edge_class) {
  recto_dash dash = {.lines = edge_class == 0 ? RECTO_LINES_HIDDEN
                                              : RECTO_LINES_OF_CLASS,
                     .edge_class = edge_class};
  if (!recto_dash_parse(text, &dash))
    fail_msg("\"%s\" is no pattern", text);
  return dash;
}

/* Draws a line of that length along y = 10, in a pen of 0.3 mm. */
static void draw_line(struct ink_fixture *k, double length,
                      recto_edge_class edge_class, const recto_dash *dash,
                      size_t count) {
  ink_fixture_start(k);
  k->options.ink.dash = dash;
  k->options.ink.dash_count = count;
  k->options.ink.has_weights = true; /* all of one pen */
  ink_fixture_line(k, 2, 10, 2 + length, 10, edge_class);
  ink_fixture_draw(k);
}

static double start_of(const struct ink_fixture *k, size_t i) {
  return k->drawing.point.item[k->drawing.stroke.item[i].point].x;
}

static double gap_after(const struct ink_fixture *k, size_t i) {
  return start_of(k, i + 1) - start_of(k, i) - ink_fixture_stroke_length(k, i);
}

#define assert_near(a, b) assert_true(fabs((a) - (b)) < 1e-5)

/* ---- The names and lengths ----------------------------------------------- */

static void line_types_have_the_lengths_of_the_standard(void **state) {
  static const struct {
    const char *name;
    int count;
    double length[6];
  } type[] = {{"solid", 0, {0}},
              {"hidden", 2, {12, 3}},
              {"chain", 4, {24, 3, 0.5, 3}},
              {"phantom", 6, {24, 3, 0.5, 3, 0.5, 3}}};
  (void)state;
  for (size_t i = 0; i < 4; i++) {
    recto_dash dash = dash_of(type[i].name, CREASE);
    assert_string_equal(recto_dash_name(i), type[i].name);
    assert_int_equal(dash.count, type[i].count);
    assert_true(dash.in_pens);
    for (int n = 0; n < dash.count; n++)
      assert_true(dash.length[n] == type[i].length[n]);
  }
  assert_null(recto_dash_name(4));
}

static void lengths_are_read_with_their_units(void **state) {
  (void)state;
  recto_dash dash = dash_of("4:1.5mm:0.1cm:1in", 0);
  const double mm[] = {4, 1.5, 1, 25.4};
  assert_int_equal(dash.count, 4);
  assert_false(dash.in_pens);
  for (int i = 0; i < 4; i++)
    assert_true(dash.length[i] == mm[i]);
  dash = dash_of("10pen:1pen:3pens", 0);
  const double pens[] = {10, 1, 3, 10, 1, 3};
  assert_int_equal(dash.count, 6);
  assert_true(dash.in_pens);
  for (int i = 0; i < 6; i++)
    assert_true(dash.length[i] == pens[i]);
}

static void what_is_no_pattern_is_refused(void **state) {
  static const char *const text[] = {"",
                                     ":",
                                     "4:",
                                     ":4",
                                     "4:-1",
                                     "4:0",
                                     "nan",
                                     "4:inf",
                                     "1e9",
                                     "4 1",
                                     "4;1",
                                     "4m",
                                     "4pen:1",
                                     "Chain",
                                     "4:1penx",
                                     "chain:4",
                                     "dotted",
                                     "1:2:3:4:5:6:7:8:9:10:11:12:13",
                                     "1:2:3:4:5:6:7"};
  const recto_dash before = dash_of("4:1", CREASE);
  (void)state;
  for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
    recto_dash dash = before;
    if (recto_dash_parse(text[i], &dash))
      fail_msg("\"%s\" was read", text[i]);
    assert_memory_equal(&dash, &before, sizeof dash);
  }
  assert_false(recto_dash_parse(NULL, NULL));
}

/* ---- Fitting ------------------------------------------------------------- */

static void only_the_longest_dashes_are_fitted(void **state) {
  const recto_dash chain = dash_of("chain", CREASE);
  (void)state;
  for (double length = 5; length < 95; length += 0.9) {
    struct ink_fixture k;
    draw_line(&k, length, CREASE, &chain, 1);
    size_t count = k.drawing.stroke.count;
    assert_true(count % 2 == 1);
    double rest = 0.15 + 2 * 0.9, n = (double)(count - 1) / 2;
    double drawn = (length - n * rest) / (n + 1);
    for (size_t i = 0; i < count; i++) {
      assert_near(ink_fixture_stroke_length(&k, i), i % 2 == 0 ? drawn : 0.15);
      if (i + 1 < count)
        assert_near(gap_after(&k, i), 0.9);
    }
    assert_true(start_of(&k, 0) == 2 && count > 2);
    assert_near(start_of(&k, count - 1) + drawn, 2 + length);
    assert_true(count < 5 || (drawn > 0.75 * 7.2 && drawn < 1.26 * 7.2));
    ink_fixture_end(&k);
  }
}

static void gaps_wider_than_dashes_are_fitted_with_them(void **state) {
  const recto_dash dotted = dash_of("0.5:2", CREASE);
  (void)state;
  for (double length = 2; length < 30; length += 0.17) {
    struct ink_fixture k;
    draw_line(&k, length, CREASE, &dotted, 1);
    size_t count = k.drawing.stroke.count;
    double scale = length / (0.5 + 2.5 * (double)(count - 1));
    assert_in_range(count, 2, 14);
    assert_true(scale > 0.65 && scale < 1.45);
    for (size_t i = 0; i + 1 < count; i++) {
      assert_near(ink_fixture_stroke_length(&k, i), 0.5 * scale);
      assert_near(gap_after(&k, i), 2 * scale);
    }
    ink_fixture_end(&k);
  }
}

static void too_short_a_line_is_drawn_whole(void **state) {
  const recto_dash dash[] = {dash_of("4:1", CREASE), dash_of("chain", CREASE),
                             dash_of("0.5:2", CREASE)};
  const double longest[] = {2.9, 3.6, 1.4};
  (void)state;
  for (int i = 0; i < 3; i++) {
    struct ink_fixture k;
    draw_line(&k, longest[i], CREASE, &dash[i], 1);
    assert_int_equal(k.drawing.stroke.count, 1);
    assert_near(ink_fixture_stroke_length(&k, 0), longest[i]);
    ink_fixture_end(&k);
  }
}

static void round_loop_has_whole_patterns(void **state) {
  enum { SIDES = 40 };
  const recto_dash chain = dash_of("6:1:0.5:1", CREASE);
  struct ink_fixture k;
  uint32_t first = 0, last = 0;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.dash = &chain;
  k.options.ink.dash_count = 1;
  for (uint32_t i = 0; i < SIDES; i++) {
    double angle = acos(-1) * 2 * i / SIDES;
    uint32_t p =
        ink_fixture_point(&k, 50 + 35 * cos(angle), 50 + 35 * sin(angle));
    first = i == 0 ? p : first;
    if (i > 0)
      ink_fixture_edge(&k, last, p, CREASE);
    last = p;
  }
  ink_fixture_edge(&k, last, first, CREASE);
  ink_fixture_draw(&k);
  double around = SIDES * 70 * sin(acos(-1) / SIDES);
  double n = round(around / 8.5);
  assert_int_equal(k.drawing.stroke.count, 2 * (size_t)n);
  for (size_t i = 0; i < k.drawing.stroke.count; i++)
    assert_near(ink_fixture_stroke_length(&k, i),
                i % 2 == 0 ? around / n - 2.5 : 0.5);
  ink_fixture_end(&k);
}

static void lengths_in_pens_are_widths_of_the_line(void **state) {
  const recto_dash chain = dash_of("chain", SILHOUETTE);
  const recto_weight two = {.edge_class = SILHOUETTE, .weight = 2};
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.dash = &chain;
  k.options.ink.dash_count = 1;
  k.options.ink.has_weights = true;
  k.options.ink.weight = &two;
  k.options.ink.weight_count = 1;
  ink_fixture_line(&k, 2, 10, 92, 10, SILHOUETTE);
  ink_fixture_draw(&k);
  assert_near(ink_fixture_stroke_length(&k, 1), 0.3);
  assert_near(gap_after(&k, 0), 1.8);
  ink_fixture_end(&k);
}

/* ---- Which lines --------------------------------------------------------- */

static size_t count_strokes(recto_edge_class edge_class, bool hidden,
                            recto_hidden how, const recto_dash *dash,
                            size_t count) {
  struct ink_fixture k;
  ink_fixture_start(&k);
  k.options.ink.dash = dash;
  k.options.ink.dash_count = count;
  k.options.ink.hidden = how;
  uint32_t edge = ink_fixture_line(&k, 2, 10, 52, 10, edge_class);
  if (hidden)
    ink_fixture_hide(&k, edge);
  ink_fixture_draw(&k);
  size_t strokes = k.drawing.stroke.count;
  ink_fixture_end(&k);
  return strokes;
}

static void pattern_is_for_its_class_or_for_hidden_lines(void **state) {
  const recto_dash dash[] = {dash_of("4:1", CREASE), dash_of("9:1", 0)};
  const recto_hidden dashed = RECTO_HIDDEN_DASHED, layer = RECTO_HIDDEN_LAYER;
  (void)state;
  assert_int_equal(count_strokes(CREASE, false, dashed, dash, 2), 10);
  assert_int_equal(count_strokes(SILHOUETTE, false, dashed, dash, 2), 1);
  assert_int_equal(count_strokes(CREASE, true, dashed, dash, 2), 5);
  assert_int_equal(count_strokes(CREASE, true, layer, dash, 2), 5);
  assert_int_equal(count_strokes(CREASE, true, layer, dash, 1), 1);
  /* The hidden line type of 12 and 3 pens. */
  assert_int_equal(count_strokes(CREASE, true, dashed, dash, 1), 11);
}

static void last_pattern_for_a_line_counts(void **state) {
  const recto_dash dash[] = {dash_of("4:1", CREASE), dash_of("9:1", CREASE),
                             dash_of("solid", 0)};
  (void)state;
  assert_int_equal(count_strokes(CREASE, false, RECTO_HIDDEN_NONE, dash, 2), 5);
  assert_int_equal(count_strokes(CREASE, true, RECTO_HIDDEN_DASHED, dash, 3),
                   1);
}

/* Two lines that would be one without dashes, on either side of x = 42. */
static void lines_of_another_class_do_not_continue_dashes(void **state) {
  const recto_dash dash = dash_of("4:1", CREASE);
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.dash = &dash;
  k.options.ink.dash_count = 1;
  uint32_t p = ink_fixture_point(&k, 2, 10), q = ink_fixture_point(&k, 42, 10);
  ink_fixture_edge(&k, p, q, CREASE);
  ink_fixture_edge(&k, q, ink_fixture_point(&k, 82, 10), RECTO_EDGE_GROUP);
  ink_fixture_draw(&k);
  assert_int_equal(k.drawing.stroke.count, 9);
  for (size_t i = 0; i < 9; i++)
    if (k.drawing.stroke.item[i].edge_class == RECTO_EDGE_GROUP)
      assert_near(ink_fixture_stroke_length(&k, i), 40);
    else
      assert_near(ink_fixture_stroke_length(&k, i), 4.125);
  ink_fixture_end(&k);
}

/* What is between the dashes of a visible line is kept for the judge. */
static void gaps_of_visible_lines_are_known(void **state) {
  const recto_dash dash = dash_of("4:1:0.5:1", CREASE);
  struct ink_fixture k;
  (void)state;
  draw_line(&k, 60, CREASE, &dash, 1);
  assert_int_equal(k.drawing.dropped.count + 1, k.drawing.stroke.count);
  for (size_t i = 0; i < k.drawing.dropped.count; i++) {
    const struct drawing_point *p =
        k.drawing.dropped_point.item + k.drawing.dropped.item[i].point;
    assert_near(p[0].x, start_of(&k, i) + ink_fixture_stroke_length(&k, i));
    assert_near(p[1].x, start_of(&k, i + 1));
  }
  ink_fixture_end(&k);
}

/* ---- Hidden lines that continue visible ones ----------------------------- */

/* Draws a line from x = 2 to 62 along y = 10 whose part of `from` to `to` 60ths
 * is hidden, with another visible line from 62 on in that direction, by dashes
 * of 4 mm and gaps of 1 mm. */
static void draw_continued(struct ink_fixture *k, int from, int to,
                           double angle_deg) {
  static recto_dash dash;
  double angle = angle_deg * acos(-1) / 180;
  dash = dash_of("4:1", 0);
  ink_fixture_start(k);
  k->options.ink.dash = &dash;
  k->options.ink.dash_count = 1;
  k->options.ink.hidden = RECTO_HIDDEN_DASHED;
  uint32_t q = ink_fixture_point(k, 62, 10);
  uint32_t edge =
      ink_fixture_edge(k, ink_fixture_point(k, 2, 10), q, SILHOUETTE);
  ink_fixture_hide(k, edge);
  if (from > 0)
    ink_fixture_show(k, edge, 0, from, 60);
  if (to < 60)
    ink_fixture_show(k, edge, to, 60, 60);
  if (angle_deg < 360)
    ink_fixture_edge(
        k, q, ink_fixture_point(k, 62 + 20 * cos(angle), 10 + 20 * sin(angle)),
        CREASE);
  ink_fixture_draw(k);
}

/* The hidden strokes lie from x to x, with gaps of 1 mm between them. */
static void assert_hidden_from(const struct ink_fixture *k, double from,
                               double to) {
  double low = 100, high = 0, length = 0, hidden = 0;
  for (size_t i = 0; i < k->drawing.stroke.count; i++) {
    if (!k->drawing.stroke.item[i].hidden)
      continue;
    low = fmin(low, start_of(k, i));
    high = fmax(high, start_of(k, i) + ink_fixture_stroke_length(k, i));
    length += ink_fixture_stroke_length(k, i);
    hidden++;
  }
  assert_near(low, from);
  assert_near(high, to);
  assert_near(length + hidden - 1, to - from);
}

static void hidden_line_begins_with_a_gap_after_a_visible_one(void **state) {
  struct ink_fixture k;
  (void)state;
  draw_continued(&k, 0, 60, 360); /* there is no other line */
  assert_hidden_from(&k, 2, 62);
  ink_fixture_end(&k);
  draw_continued(&k, 20, 60, 360); /* the line goes behind something */
  assert_hidden_from(&k, 23, 62);
  ink_fixture_end(&k);
  draw_continued(&k, 20, 40, 360); /* and comes out again */
  assert_hidden_from(&k, 23, 41);
  ink_fixture_end(&k);
  draw_continued(&k, 0, 60, 25); /* another line continues it */
  assert_hidden_from(&k, 2, 61);
  ink_fixture_end(&k);
  draw_continued(&k, 0, 60, 35); /* or makes a corner with it */
  assert_hidden_from(&k, 2, 62);
  ink_fixture_end(&k);
}

static void gap_before_a_short_hidden_line_is_as_long_as_it(void **state) {
  struct ink_fixture k;
  (void)state;
  for (int sixtieths = 1; sixtieths <= 3; sixtieths++) {
    double third = sixtieths / 3.0;
    draw_continued(&k, 20, 20 + sixtieths, 360);
    assert_hidden_from(&k, 22 + third, 22 + 2 * third);
    ink_fixture_end(&k);
  }
}

static void gaps_come_at_ends_and_not_at_corners(void **state) {
  const recto_dash dash = dash_of("4:1", 0);
  struct ink_fixture k;
  (void)state;
  ink_fixture_start(&k);
  k.options.ink.dash = &dash;
  k.options.ink.dash_count = 1;
  k.options.ink.hidden = RECTO_HIDDEN_DASHED;
  uint32_t p = ink_fixture_point(&k, 10, 10), q = ink_fixture_point(&k, 30, 10);
  ink_fixture_edge(&k, ink_fixture_point(&k, 2, 10), p, CREASE);
  uint32_t first = ink_fixture_edge(&k, p, q, CREASE);
  ink_fixture_hide(&k, first);
  uint32_t r = ink_fixture_point(&k, 30, 40);
  ink_fixture_hide(&k, ink_fixture_edge(&k, q, r, CREASE));
  ink_fixture_edge(&k, r, ink_fixture_point(&k, 30, 60), CREASE);
  ink_fixture_draw(&k);
  double length = 0;
  for (size_t i = 0; i < k.drawing.stroke.count; i++)
    length +=
        k.drawing.stroke.item[i].hidden ? ink_fixture_stroke_length(&k, i) : 0;
  assert_near(ink_fixture_distance(&k, 10.5, 10), 0.5);
  assert_near(ink_fixture_distance(&k, 11, 10), 0);
  assert_near(ink_fixture_distance(&k, 30, 10), 0);
  assert_near(ink_fixture_distance(&k, 30, 39), 0);
  assert_near(ink_fixture_distance(&k, 30, 39.5), 0.5);
  /* 4 dashes on 19 mm, 6 on 29 mm. */
  assert_near(length, 19 - 3 + 29 - 5);
  ink_fixture_end(&k);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(line_types_have_the_lengths_of_the_standard),
      cmocka_unit_test(lengths_are_read_with_their_units),
      cmocka_unit_test(what_is_no_pattern_is_refused),
      cmocka_unit_test(only_the_longest_dashes_are_fitted),
      cmocka_unit_test(gaps_wider_than_dashes_are_fitted_with_them),
      cmocka_unit_test(too_short_a_line_is_drawn_whole),
      cmocka_unit_test(round_loop_has_whole_patterns),
      cmocka_unit_test(lengths_in_pens_are_widths_of_the_line),
      cmocka_unit_test(pattern_is_for_its_class_or_for_hidden_lines),
      cmocka_unit_test(last_pattern_for_a_line_counts),
      cmocka_unit_test(lines_of_another_class_do_not_continue_dashes),
      cmocka_unit_test(gaps_of_visible_lines_are_known),
      cmocka_unit_test(hidden_line_begins_with_a_gap_after_a_visible_one),
      cmocka_unit_test(gap_before_a_short_hidden_line_is_as_long_as_it),
      cmocka_unit_test(gaps_come_at_ends_and_not_at_corners),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
