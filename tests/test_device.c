/* test_device.c - plotters: where a page lies on the sheet, and that nothing is
 * drawn outside the hard-clip area. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "backends/device.h"
#include "tests/plotting.h"
#include "tests/scenes/random.h"

/* ---- Devices ------------------------------------------------------------- */

static void a_length_is_true_on_every_device(void **state) {
  (void)state;
  for (size_t i = 0; device_name(i); i++) {
    struct plotting f;
    plotting_begin(&f, 297, 210);
    f.options.device = device_name(i);
    uint32_t layer = drawing_fixture_layer(&f.drawing, 1, 0.3, 0);
    drawing_fixture_line(&f.drawing, layer, 60, 60, 160, 60);
    drawing_fixture_line(&f.drawing, layer, 60, 60, 60, 160);
    plotting_run(&f);
    double unit = strncmp(device_name(i), "hp", 2) == 0 ? 0.02488 : 0.025;
    const struct hpgl_point *point = f.back.point.item;
    assert_int_equal(f.back.stroke.count, 2);
    assert_in_range(point[1].x - point[0].x, (uintmax_t)(100 / unit),
                    (uintmax_t)(100 / unit) + 1);
    assert_int_equal(point[1].y, point[0].y);
    assert_in_range(point[3].y - point[2].y, (uintmax_t)(100 / unit),
                    (uintmax_t)(100 / unit) + 1);
    assert_int_equal(point[3].x, point[2].x);
    plotting_end(&f);
  }
}

/* The middle of the page is the middle of HP's frame P1 P2. */
static void the_hp7475a_draws_the_middle_in_the_middle(void **state) {
  (void)state;
  static const struct {
    double width_mm, height_mm;
    int x, y;
  } paper[] = {{297, 210, 5603, 4121},
               {210, 297, 5603, 4121},
               {420, 297, 7770, 5602},
               {8.5 * 25.4, 11 * 25.4, 5250, 4196},
               {17 * 25.4, 11 * 25.4, 8122, 5259}};
  for (size_t i = 0; i < 5; i++) {
    struct plotting f;
    plotting_begin(&f, paper[i].width_mm, paper[i].height_mm);
    f.options.device = "hp7475a";
    drawing_fixture_line(&f.drawing,
                         drawing_fixture_layer(&f.drawing, 1, 0.3, 0),
                         paper[i].width_mm / 2, paper[i].height_mm / 2, 50, 50);
    plotting_run(&f);
    plotting_assert_point(&f, 0, 0, paper[i].x, paper[i].y);
    plotting_end(&f);
  }
}

/* Up on the page is left on the plotter, right is up. */
static void a_portrait_page_is_turned_on_its_left_side(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 210, 297);
  f.options.device = "dxy";
  uint32_t layer = drawing_fixture_layer(&f.drawing, 1, 0.3, 0);
  drawing_fixture_stroke(&f.drawing, layer, (double[]){0, 297, 0, 0, 210, 0}, 3,
                         false);
  plotting_run(&f);
  plotting_assert_point(&f, 0, 0, 0, 0);
  plotting_assert_point(&f, 0, 1, 11880, 0);
  plotting_assert_point(&f, 0, 2, 11880, 8400);
  assert_int_equal(f.warnings, 0);
  plotting_end(&f);
}

static void the_smallest_paper_that_holds_the_page_is_taken(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 300, 200);
  f.options.device = "dxy";
  uint32_t layer = drawing_fixture_layer(&f.drawing, 1, 0.3, 0);
  drawing_fixture_line(&f.drawing, layer, 0, 0, 300, 200);
  plotting_run(&f);
  plotting_assert_point(&f, 0, 0, 0, 0);
  plotting_assert_point(&f, 0, 1, 12000, 8000);
  assert_int_equal(f.warnings, 1);
  assert_non_null(strstr(f.warning, "no sheet of dxy is as large as the page"));
  assert_non_null(strstr(f.warning, " A3"));
  plotting_end(&f);
}

/* Letter paper rounded up to whole millimetres is still letter paper, and its
 * middle the middle. */
static void a_page_a_touch_too_large_keeps_its_paper(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 279.8, 216);
  f.options.device = "hp7475a";
  uint32_t layer = drawing_fixture_layer(&f.drawing, 1, 0.3, 0);
  drawing_fixture_line(&f.drawing, layer, 50, 60, 139.9, 108);
  plotting_run(&f);
  plotting_assert_point(&f, 0, 0, 1637, 2267);
  plotting_assert_point(&f, 0, 1, 5250, 4196);
  plotting_end(&f);
}

/* Its middle is seen, and the sheet and its reach are named. */
static void a_page_that_no_paper_holds_is_clipped_on_the_largest(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 1189, 841);
  f.options.device = "dxy";
  uint32_t layer = drawing_fixture_layer(&f.drawing, 1, 0.3, 0);
  drawing_fixture_line(&f.drawing, layer, 0, 420.5, 1189, 420.5);
  plotting_run(&f);
  plotting_assert_point(&f, 0, 0, 0, 5940);
  plotting_assert_point(&f, 0, 1, 16800, 5940);
  assert_int_equal(f.warnings, 1);
  assert_non_null(strstr(f.warning, "1 stroke clipped: "));
  assert_non_null(strstr(f.warning, "largest sheet of dxy, A3"));
  assert_non_null(strstr(f.warning, "420 x 297 mm"));
  plotting_end(&f);
}

/* Its frame is all there, and begins where the pen's reach does. */
static void a_small_page_lies_where_the_pen_reaches(void **state) {
  (void)state;
  static const double size[][2] = {{20, 30}, {30, 20}, {100, 100}, {148, 105}};
  for (size_t d = 0; device_name(d); d++)
    for (size_t i = 0; device_by_name(device_name(d))->paper && i < 4; i++) {
      struct plotting f;
      plotting_begin(&f, size[i][0], size[i][1]);
      f.options.device = device_name(d);
      drawing_fixture_box(&f.drawing,
                          drawing_fixture_layer(&f.drawing, 1, 0.3, 0), 0, 0,
                          size[i][0], size[i][1]);
      plotting_run(&f);
      assert_int_equal(f.warnings, 0);
      assert_int_equal(f.back.stroke.count, 1);
      assert_int_equal(f.back.stroke.item[0].count, 5);
      int32_t low_x = INT32_MAX, low_y = INT32_MAX;
      for (size_t k = 0; k < 5; k++) {
        low_x = f.back.point.item[k].x < low_x ? f.back.point.item[k].x : low_x;
        low_y = f.back.point.item[k].y < low_y ? f.back.point.item[k].y : low_y;
      }
      assert_int_equal(low_x, 0);
      assert_int_equal(low_y, 0);
      plotting_end(&f);
    }
}

/* A letter page where the table has none is reported, no sheet and no page that
 * the smallest sheet holds. */
static void a_page_between_the_sheets_is_reported(void **state) {
  (void)state;
  static const struct {
    const char *device;
    double width_mm, height_mm;
    bool reported;
  } row[] = {{"hp7550a", 215.9, 279.4, true}, {"hp7475a", 215.9, 279.4, false},
             {"hp7550a", 420, 297, false},    {"hp7550a", 419.7, 296.8, false},
             {"hp7550a", 200, 280, false},    {"hp7475a", 250, 250, true},
             {"hp7475a", 1189, 841, false}};
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    struct device_placement placement;
    device_place(device_by_name(row[i].device), row[i].width_mm,
                 row[i].height_mm, &placement);
    assert_int_equal(placement.between, row[i].reported);
  }
}

/* Half a millimetre less, and something is. */
static void nothing_is_clipped_inside_the_reported_margin(void **state) {
  (void)state;
  struct random random = {5};
  int needed = 0;
  for (int i = 0; i < 400; i++) {
    static const char *const name[] = {"hp7475a", "hp7550a", "dxy"};
    struct device_placement placement;
    double width = random_int(&random, 50, 420);
    double height = random_int(&random, 50, 297);
    const char *device = name[i % 3];
    if (i % 2 == 0) { /* a sheet that all three have */
      width = i % 4 ? 420 : 210;
      height = 297;
    }
    device_place(device_by_name(device), width, height, &placement);
    double margin = device_margin_mm(&placement);
    assert_true(margin >= 0);
    for (int less = 0; less <= (margin > 0.5); less++) {
      struct plotting f;
      double inset = margin - 0.5 * less;
      plotting_begin(&f, width, height);
      f.options.device = device;
      drawing_fixture_box(&f.drawing,
                          drawing_fixture_layer(&f.drawing, 1, 0.3, 0), inset,
                          inset, width - inset, height - inset);
      plotting_run(&f);
      char words[40];
      snprintf(words, sizeof words, "all of the outer %.0f mm", ceil(margin));
      assert_int_equal(f.warnings, placement.between + less);
      assert_int_equal(strstr(f.warning, words) != NULL, less);
      needed += less;
      plotting_end(&f);
    }
  }
  assert_in_range(needed, 100, 399);
}

static void a_writer_s_margin_is_that_of_the_device(void **state) {
  (void)state;
  struct writer_options options = {.device = "hp7475a"};
  assert_true(writer_hpgl.margin_mm(&options, 210, 297) == 16);
  assert_true(writer_hpgl.margin_mm(&options, 100, 100) == 0);
  assert_true(writer_hpgl.margin_mm(&options, 841, 1189) == 0);
  options.device = "generic";
  assert_true(writer_hpgl.margin_mm(&options, 210, 297) == 0);
  options.device = "no such";
  assert_true(writer_hpgl.margin_mm(&options, 210, 297) == 0);
}

static void a_drum_plotter_has_its_origin_in_the_middle(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 600, 400);
  f.options.device = "drum";
  drawing_fixture_line(&f.drawing, drawing_fixture_layer(&f.drawing, 1, 0.3, 0),
                       0, 0, 600, 400);
  plotting_run(&f);
  plotting_assert_point(&f, 0, 0, -12000, -8000);
  plotting_assert_point(&f, 0, 1, 12000, 8000);
  plotting_end(&f);
}

/* ---- Clipping ------------------------------------------------------------ */

static void a_stroke_that_leaves_and_returns_is_two(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 100, 100);
  uint32_t layer = drawing_fixture_layer(&f.drawing, 1, 0.3, 0);
  drawing_fixture_stroke(&f.drawing, layer,
                         (double[]){50, 10, 150, 10, 150, 30, 50, 30}, 4,
                         false);
  drawing_fixture_line(&f.drawing, layer, 110, 0, 110, 100);
  drawing_fixture_line(&f.drawing, layer, 10, 10, 20, 20);
  plotting_run(&f);
  assert_int_equal(f.back.stroke.count, 3);
  plotting_assert_point(&f, 0, 0, 2000, 400);
  plotting_assert_point(&f, 0, 1, 4000, 400);
  plotting_assert_point(&f, 1, 0, 4000, 1200);
  plotting_assert_point(&f, 1, 1, 2000, 1200);
  assert_int_equal(f.warnings, 1);
  assert_non_null(strstr(f.warning, "2 strokes clipped"));
  plotting_end(&f);
}

/* Wherever the loop begins: what is left of a box whose right side is outside
 * is one stroke of three lines. */
static void a_clipped_loop_is_not_cut_where_it_begins(void **state) {
  (void)state;
  static const double box[] = {50, 20, 120, 20, 120, 80, 50, 80};
  for (int turn = 0; turn < 4; turn++) {
    struct plotting f;
    double xy[8];
    plotting_begin(&f, 100, 100);
    for (int i = 0; i < 8; i++)
      xy[i] = box[(i + 2 * turn) % 8];
    drawing_fixture_stroke(
        &f.drawing, drawing_fixture_layer(&f.drawing, 1, 0.3, 0), xy, 4, true);
    plotting_run(&f);
    assert_int_equal(f.back.stroke.count, 1);
    assert_int_equal(f.back.stroke.item[0].count, 4);
    plotting_assert_point(&f, 0, 1, 2000, 3200);
    plotting_assert_point(&f, 0, 2, 2000, 800);
    plotting_end(&f);
  }
}

static void a_line_across_the_whole_area_keeps_its_middle(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 100, 100);
  drawing_fixture_line(&f.drawing, drawing_fixture_layer(&f.drawing, 1, 0.3, 0),
                       -100, -100, 200, 200);
  plotting_run(&f);
  assert_int_equal(f.back.stroke.count, 1);
  plotting_assert_point(&f, 0, 0, 0, 0);
  plotting_assert_point(&f, 0, 1, 4000, 4000);
  plotting_end(&f);
}

/* 100.01 mm are 4000.4 units: the edge rounds into the area. */
static void a_frame_around_the_page_is_all_there(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 100.01, 100.01);
  drawing_fixture_box(&f.drawing, drawing_fixture_layer(&f.drawing, 1, 0.3, 0),
                      0, 0, 100.01, 100.01);
  plotting_run(&f);
  assert_int_equal(f.warnings, 0);
  assert_int_equal(f.back.stroke.count, 1);
  assert_int_equal(f.back.stroke.item[0].count, 5);
  plotting_assert_point(&f, 0, 2, 4000, 4000);
  plotting_end(&f);
}

/* ---- Any drawing --------------------------------------------------------- */

/* Where the page's point ought to be, by the words of device.h. */
static void expect(const struct device_placement *placement, double height_mm,
                   const struct drawing_point *point, double *x, double *y) {
  *x = placement->origin_x +
       (placement->turned ? height_mm - point->y : point->x) /
           placement->unit_mm;
  *y = placement->origin_y +
       (placement->turned ? point->x : point->y) / placement->unit_mm;
}

static double distance_to_line(double x, double y, const struct hpgl_point *a,
                               const struct hpgl_point *b) {
  double run_x = b->x - a->x, run_y = b->y - a->y;
  double square = run_x * run_x + run_y * run_y;
  double share = ((x - a->x) * run_x + (y - a->y) * run_y) / square;
  share = fmin(fmax(share, 0), 1);
  return hypot(a->x + share * run_x - x, a->y + share * run_y - y);
}

/* How far the point is from all ink, in units. */
static double distance_to_ink(const struct hpgl *hpgl, double x, double y) {
  double best = INFINITY;
  for (size_t i = 0; i < hpgl->stroke.count; i++) {
    const struct hpgl_point *p = hpgl->point.item + hpgl->stroke.item[i].point;
    for (uint32_t k = 1; k < hpgl->stroke.item[i].count; k++)
      best = fmin(best, distance_to_line(x, y, &p[k - 1], &p[k]));
  }
  return best;
}

static void make_random(struct plotting *f, struct random *random,
                        double overhang_mm) {
  double width = random_int(random, 40, 600);
  double height = random_int(random, 40, 600);
  plotting_begin(f, width, height);
  for (unsigned pen = 1; pen <= 3; pen++)
    drawing_fixture_layer(&f->drawing, pen, 0.3, 0);
  int strokes = random_int(random, 1, 12);
  for (int i = 0; i < strokes; i++) {
    double xy[2 * 260];
    uint32_t count =
        random_below(random, 10) == 0 ? 260 : 1 + random_below(random, 9);
    for (size_t k = 0; k < count; k++) {
      xy[2 * k] = random_between(random, -overhang_mm, width + overhang_mm);
      xy[2 * k + 1] =
          random_between(random, -overhang_mm, height + overhang_mm);
    }
    drawing_fixture_stroke(&f->drawing, random_below(random, 3), xy, count,
                           random_below(random, 2));
  }
}

static void assert_inside(const struct hpgl *hpgl,
                          const struct device_placement *placement) {
  for (size_t i = 0; i < hpgl->point.count; i++) {
    assert_true(hpgl->point.item[i].x >= placement->x0);
    assert_true(hpgl->point.item[i].x <= placement->x1);
    assert_true(hpgl->point.item[i].y >= placement->y0);
    assert_true(hpgl->point.item[i].y <= placement->y1);
  }
}

/* Places along every stroke, as far as they are in the area: all have ink. */
static void assert_covered(const struct plotting *f,
                           const struct device_placement *placement) {
  for (size_t i = 0; i < f->drawing.stroke.count; i++) {
    const struct drawing_stroke *stroke = &f->drawing.stroke.item[i];
    const struct drawing_point *p = f->drawing.point.item + stroke->point;
    uint32_t lines = stroke->count - (stroke->closed ? 0 : 1);
    for (uint32_t k = 0; stroke->count > 1 && k < lines; k += 7) {
      double ax, ay, bx, by;
      expect(placement, f->drawing.height_mm, &p[k], &ax, &ay);
      expect(placement, f->drawing.height_mm, &p[(k + 1) % stroke->count], &bx,
             &by);
      for (int part = 0; part <= 5; part++) {
        double x = ax + (bx - ax) * part / 5, y = ay + (by - ay) * part / 5;
        if (x >= placement->x0 && x <= placement->x1 && y >= placement->y0 &&
            y <= placement->y1)
          assert_true(distance_to_ink(&f->back, x, y) <= 1);
      }
    }
  }
}

static void no_drawing_leaves_the_area_or_the_cap(void **state) {
  (void)state;
  struct random random = {7};
  size_t clipped = 0, device = 0;
  for (size_t i = 0; i < 400; i++) {
    struct plotting f;
    struct device_placement placement;
    make_random(&f, &random, i % 2 ? 300 : 3);
    f.options.device = device_name(device++);
    if (!device_name(device))
      device = 0;
    device_place(device_by_name(f.options.device), f.drawing.width_mm,
                 f.drawing.height_mm, &placement);
    plotting_run(&f);
    assert_inside(&f.back, &placement);
    assert_in_range(f.back.longest, 0, 100);
    assert_covered(&f, &placement);
    bool cut = strstr(f.warning, " clipped") != NULL;
    assert_int_equal(f.warnings, placement.between + cut);
    clipped += cut;
    plotting_end(&f);
  }
  assert_in_range(clipped, 100, 399);
}

/* Within the page, what comes back is the drawing: the same strokes, in
 * order, every point within half a unit (a unit is required). */
static void every_stroke_comes_back_within_a_unit(void **state) {
  (void)state;
  struct random random = {11};
  for (int i = 0; i < 200; i++) {
    struct plotting f;
    size_t back = 0;
    make_random(&f, &random, 0);
    plotting_run(&f);
    for (uint32_t layer = 0; layer < 3; layer++) {
      for (size_t s = 0; s < f.drawing.stroke.count; s++) {
        const struct drawing_stroke *stroke = &f.drawing.stroke.item[s];
        if (stroke->layer != layer || stroke->count < 2)
          continue;
        assert_true(back < f.back.stroke.count);
        const struct hpgl_stroke *found = &f.back.stroke.item[back++];
        assert_int_equal(found->pen, layer + 1);
        assert_int_equal(found->count, stroke->count + stroke->closed);
        for (uint32_t k = 0; k < found->count; k++) {
          const struct drawing_point *p =
              &f.drawing.point.item[stroke->point + k % stroke->count];
          const struct hpgl_point *q = &f.back.point.item[found->point + k];
          assert_true(fabs(p->x * 40 - q->x) <= 0.51);
          assert_true(fabs(p->y * 40 - q->y) <= 0.51);
        }
      }
    }
    assert_int_equal(back, f.back.stroke.count);
    assert_int_equal(f.warnings, 0);
    plotting_end(&f);
  }
}

static void the_same_drawing_gives_the_same_bytes(void **state) {
  (void)state;
  struct random first = {3}, second = {3};
  struct plotting f, g;
  make_random(&f, &first, 20);
  make_random(&g, &second, 20);
  plotting_run(&f);
  plotting_run(&g);
  assert_string_equal(f.text, g.text);
  plotting_end(&f);
  plotting_end(&g);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_length_is_true_on_every_device),
      cmocka_unit_test(the_hp7475a_draws_the_middle_in_the_middle),
      cmocka_unit_test(a_portrait_page_is_turned_on_its_left_side),
      cmocka_unit_test(the_smallest_paper_that_holds_the_page_is_taken),
      cmocka_unit_test(a_page_a_touch_too_large_keeps_its_paper),
      cmocka_unit_test(a_page_that_no_paper_holds_is_clipped_on_the_largest),
      cmocka_unit_test(a_small_page_lies_where_the_pen_reaches),
      cmocka_unit_test(a_page_between_the_sheets_is_reported),
      cmocka_unit_test(nothing_is_clipped_inside_the_reported_margin),
      cmocka_unit_test(a_writer_s_margin_is_that_of_the_device),
      cmocka_unit_test(a_drum_plotter_has_its_origin_in_the_middle),
      cmocka_unit_test(a_stroke_that_leaves_and_returns_is_two),
      cmocka_unit_test(a_clipped_loop_is_not_cut_where_it_begins),
      cmocka_unit_test(a_line_across_the_whole_area_keeps_its_middle),
      cmocka_unit_test(a_frame_around_the_page_is_all_there),
      cmocka_unit_test(no_drawing_leaves_the_area_or_the_cap),
      cmocka_unit_test(every_stroke_comes_back_within_a_unit),
      cmocka_unit_test(the_same_drawing_gives_the_same_bytes),
  };
  return cmocka_run_group_tests_name("device", tests, NULL, NULL);
}
