/* test_judge_svg.c - for any SVG file, what is read of it is on its page and
 * takes memory in proportion to the file. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "judge/grid.h"
#include "judge/svg/svg.h"
#include "tests/near.h"

/* The page, and how far beyond it ink is kept. */
enum { WIDTH = 200, HEIGHT = 100, MARGIN = 25 };

#define ROOT "<svg width=\"200mm\" height=\"100mm\" viewBox=\"0 0 200 100\">"

#define PATH "<path stroke=\"#000\" d=\""

static const char *read_text(struct judge_drawing *drawing, const char *text) {
  return judge_read_svg(drawing, text, strlen(text));
}

static double drawn_mm(const struct judge_drawing *drawing) {
  double sum = 0;
  for (size_t i = 0; i < drawing->stroke.count; i++) {
    const struct judge_stroke *stroke = &drawing->stroke.item[i];
    const struct judge_point2 *at = &drawing->point.item[stroke->point];
    assert_true(stroke->count >= 2);
    assert_true(stroke->point + stroke->count <= drawing->point.count);
    for (uint32_t k = 1; k < stroke->count; k++)
      sum += hypot(at[k].x - at[k - 1].x, at[k].y - at[k - 1].y);
  }
  return sum;
}

static void assert_on_page(const struct judge_drawing *drawing) {
  for (size_t i = 0; i < drawing->point.count; i++) {
    struct judge_point2 at = drawing->point.item[i];
    assert_true(at.x >= -MARGIN && at.x <= WIDTH + MARGIN);
    assert_true(at.y >= -MARGIN && at.y <= HEIGHT + MARGIN);
  }
}

/* What is drawn of a path's data. */
static double drawn_of(const char *data) {
  struct judge_drawing drawing;
  char text[400];
  snprintf(text, sizeof text, ROOT PATH "%s\"/></svg>", data);
  const char *fault = read_text(&drawing, text);
  if (fault != NULL)
    fail_msg("%s: %s", data, fault);
  assert_on_page(&drawing);
  double mm = drawn_mm(&drawing);
  judge_drawing_fini(&drawing);
  return mm;
}

/* ---- Places far away ----------------------------------------------------- */

static void lines_are_cut_to_the_page(void **state) {
  (void)state;
  /* One coordinate does not undo the rest. */
  assert_within(drawn_of("M0 0L90 0M5 5L1e300 1e300"), 90 + 120 * sqrt(2),
                1e-9);
  assert_within(drawn_of("M5 5L1e300 1e300L6 6"), 120 * sqrt(2) + 119 * sqrt(2),
                1e-9);
  assert_within(drawn_of("M-1e300 50L1e300 50"), WIDTH + 2 * MARGIN, 1e-9);
  assert_within(drawn_of("M10-1e9V1e9"), HEIGHT + 2 * MARGIN, 1e-9);
  assert_within(drawn_of("M-1e300-1e300L-1e300 1e300"), 0, 0);
  assert_within(drawn_of("M-1000 50L50-1000"), 0, 0);
  assert_within(drawn_of("M300 50L50 300"), 0, 0);
  assert_within(drawn_of("M0 0L1e-300 1e-300"), 0, 1e-9);
  /* Out and back in: two strokes. */
  assert_within(drawn_of("M0 10H300V20H0"), 2 * (WIDTH + MARGIN), 1e-9);
  /* Nothing is cut that is on the page. */
  assert_within(drawn_of("M0 0H200V100H0Z"), 2 * (WIDTH + HEIGHT), 0);
}

static void curves_are_cut_to_the_page(void **state) {
  (void)state;
  /* A quarter of a circle round a corner: as by many pieces. */
  assert_within(drawn_of("M90 0A90 90 0 0 1 0 90"), 45 * acos(-1), 0.1);
  /* From far away, straight through. */
  assert_within(drawn_of("M-1e9 50C-1e8 50 1e8 50 1e9 50"), WIDTH + 2 * MARGIN,
                1e-6);
  assert_within(drawn_of("M-1e30 50C0 1e30 0 1e30 1e30 50"), 0, 0);
  for (int k = 3; k <= 300; k += 27) {
    char data[100];
    snprintf(data, sizeof data, "M0 0c1e%d 0 0 1e%d 9 9", k, k);
    assert_true(drawn_of(data) < 1000);
    snprintf(data, sizeof data, "M0 0a1e%d 1e%d 0 0 0 9 9", k, k);
    assert_within(drawn_of(data), 9 * sqrt(2), k == 3 ? 1e-3 : 1e-9);
    snprintf(data, sizeof data, "M0 0a1e%d 1e-%d 0 1 1 9 9", k / 2, k / 2);
    assert_true(drawn_of(data) < 1000);
    snprintf(data, sizeof data, "M0 0a1e-%d 1e-%d 0 1 1 9 9", k, k);
    assert_within(drawn_of(data), 9 * sqrt(2) / 2 * acos(-1), 0.01);
  }
}

static void what_no_double_holds_is_refused(void **state) {
  (void)state;
  static const char *const wrong[] = {
      PATH "M0 0L1e999 0\"/>",
      PATH "M0 0L1e300 0l1e308 0l1e308 0\"/>",
      PATH "M0 0C1 1 1 1e400 2 2\"/>",
      "<g transform=\"scale(1e200)\"><g transform=\"scale(1e200)\">" PATH
      "M0 0L1 1\"/></g></g>",
      "<g transform=\"translate(1e308)translate(1e308)\">" PATH
      "M0 0L1 1\"/></g>",
      "<polyline stroke=\"#000\" points=\"0 0 1e309 0\"/>"};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    struct judge_drawing drawing;
    char text[400];
    snprintf(text, sizeof text, ROOT "%s</svg>", wrong[i]);
    if (read_text(&drawing, text) == NULL)
      fail_msg("was read: %s", wrong[i]);
    judge_drawing_fini(&drawing);
  }
}

/* ---- Memory -------------------------------------------------------------- */

/* A drawing of `count` times the same piece of data; its length is in *size. */
static char *repeat(const char *piece, size_t count, size_t *size) {
  static const char head[] = ROOT PATH "M0 0", tail[] = "\"/></svg>";
  size_t length = strlen(piece);
  char *text = malloc(sizeof head + sizeof tail + count * length);
  assert_non_null(text);
  memcpy(text, head, sizeof head - 1);
  *size = sizeof head - 1;
  for (size_t i = 0; i < count; i++, *size += length)
    memcpy(text + *size, piece, length);
  memcpy(text + *size, tail, sizeof tail);
  *size += sizeof tail - 1;
  return text;
}

static size_t points_of(const char *piece, size_t count, const char **fault) {
  struct judge_drawing drawing;
  size_t size, points;
  char *text = repeat(piece, count, &size);
  *fault = judge_read_svg(&drawing, text, size);
  assert_on_page(&drawing);
  points = drawing.point.count;
  judge_drawing_fini(&drawing);
  free(text);
  return points;
}

static void a_curve_from_far_away_takes_few_points(void **state) {
  (void)state;
  static const char *const piece[] = {"c9e9 0 0 9e9 0 0", "c9e99 0 0-9e99 0 0",
                                      "c1e300 1e300-1e300 0 0 0"};
  for (size_t i = 0; i < sizeof piece / sizeof *piece; i++) {
    const char *fault;
    size_t points = points_of(piece[i], 1000, &fault);
    assert_null(fault);
    assert_true(points < 100 * 1000);
  }
}

static void more_pieces_than_a_file_may_have_are_refused(void **state) {
  (void)state;
  const char *fault;
  size_t count = 20000, bytes = count * strlen("c900 0 0 900 0 0");
  size_t points = points_of("c900 0 0 900 0 0", count, &fault);
  assert_non_null(fault);
  assert_non_null(strstr(fault, "pieces"));
  assert_true(points < 8 * bytes + (2u << 20));
  points = points_of("c900 0 0 900 0 0", count / 20, &fault);
  assert_null(fault); /* a few of them are a drawing */
  assert_true(points > 5 * count);
}

/* Segments across the page are in many cells each; the same are found with
 * wider ones. */
static void a_grid_grows_with_the_segments_alone(void **state) {
  (void)state;
  enum { COUNT = 20000, CELLS = 400 };
  struct judge_segment *segment = malloc(COUNT * sizeof *segment);
  struct judge_grid grid;
  assert_non_null(segment);
  for (int i = 0; i < COUNT; i++)
    segment[i] =
        (struct judge_segment){{0, i * 0.005}, {WIDTH, 100 - i * 0.005}};
  assert_true(judge_grid_init(&grid, segment, COUNT, WIDTH, HEIGHT,
                              (double)WIDTH / CELLS, 0.1));
  size_t cells = (size_t)grid.columns * grid.rows;
  assert_true(grid.start[cells] < 260u * COUNT + 4 * cells);
  for (int k = 0; k < 50; k++) {
    struct judge_point2 at = {k * 4.0, k * 2.0};
    uint32_t count, found = 0, there = 0;
    const uint32_t *near = judge_grid_near(&grid, at, &count);
    for (uint32_t i = 0; i < count; i++)
      found += judge_is_within(&segment[near[i]], at, 0.1);
    for (uint32_t i = 0; i < COUNT; i++) {
      double t;
      bool within = judge_distance(&segment[i], at, &t) <= 0.1;
      assert_int_equal(judge_is_within(&segment[i], at, 0.1), within);
      there += within;
    }
    assert_int_equal(found, there);
  }
  judge_grid_fini(&grid);
  free(segment);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lines_are_cut_to_the_page),
      cmocka_unit_test(curves_are_cut_to_the_page),
      cmocka_unit_test(what_no_double_holds_is_refused),
      cmocka_unit_test(a_curve_from_far_away_takes_few_points),
      cmocka_unit_test(more_pieces_than_a_file_may_have_are_refused),
      cmocka_unit_test(a_grid_grows_with_the_segments_alone),
  };
  return cmocka_run_group_tests_name("judge_svg", tests, NULL, NULL);
}
