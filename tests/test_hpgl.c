/* test_hpgl.c - the guarantees of the HPGL writer: dialect, pens, complete
 * files. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "backends/device.h"
#include "tests/plotting.h"

static void assert_refused(struct plotting *f, const char *text) {
  recto_error error;
  struct stream *stream;
  assert_int_equal(stream_open_memory(&stream, &error), RECTO_OK);
  assert_int_equal(writer_hpgl.write(&f->drawing, &f->options, stream, &error),
                   RECTO_ERROR_ARGUMENT);
  assert_non_null(strstr(error.text, text));
  stream_discard(stream);
}

/* ---- The dialect --------------------------------------------------------- */

static void a_plot_is_written_in_the_common_dialect(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 100, 100);
  uint32_t first = drawing_fixture_layer(&f.drawing, 1, 0.3, 0);
  uint32_t second = drawing_fixture_layer(&f.drawing, 2, 0.3, 0);
  drawing_fixture_line(&f.drawing, first, 1, 2, 3, 4);
  drawing_fixture_box(&f.drawing, second, 10, 10, 20, 20);
  f.options.velocity = 12;
  plotting_run(&f);
  assert_string_equal(f.text, "IN;\nDF;\nVS12;\nSP1;\nPU40,80;\nPD120,160;\n"
                              "PU;\nSP2;\nPU400,400;\n"
                              "PD800,400,800,800,400,800,400,400;\n"
                              "PU;\nSP0;\nIN;\n");
  assert_int_equal(f.warnings, 0);
  plotting_end(&f);
}

static void an_empty_drawing_takes_no_pen(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 100, 100);
  drawing_fixture_layer(&f.drawing, 1, 0.3, 0);
  plotting_run(&f);
  assert_string_equal(f.text, "IN;\nDF;\nPU;\nSP0;\nIN;\n");
  plotting_end(&f);
}

static void long_strokes_are_cut_into_commands_of_100_points(void **state) {
  (void)state;
  struct plotting f;
  double xy[2 * 1001];
  plotting_begin(&f, 100, 100);
  for (size_t i = 0; i <= 1000; i++) {
    xy[2 * i] = (double)i * 0.1;
    xy[2 * i + 1] = i % 2 ? 11 : 10;
  }
  drawing_fixture_stroke(&f.drawing,
                         drawing_fixture_layer(&f.drawing, 1, 0.3, 0), xy, 1001,
                         false);
  plotting_run(&f);
  assert_int_equal(f.back.longest, 100);
  assert_int_equal(f.back.stroke.count, 1);
  assert_int_equal(f.back.stroke.item[0].count, 1001);
  plotting_end(&f);
}

static void points_that_repeat_and_strokes_that_vanish_go(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 100, 100);
  uint32_t layer = drawing_fixture_layer(&f.drawing, 1, 0.3, 0);
  drawing_fixture_line(&f.drawing, layer, 5, 5, 5.001, 5.001);
  drawing_fixture_stroke(&f.drawing, layer, (double[]){7, 7, 7, 7}, 2, true);
  drawing_fixture_stroke(&f.drawing, layer, (double[]){7, 7}, 1, false);
  drawing_fixture_stroke(&f.drawing, layer,
                         (double[]){1, 1, 1.001, 1, 2, 2, 2, 2, 2.002, 2.003},
                         5, false);
  plotting_run(&f);
  assert_int_equal(f.back.stroke.count, 1);
  assert_int_equal(f.back.stroke.item[0].count, 2);
  plotting_assert_point(&f, 0, 0, 40, 40);
  plotting_assert_point(&f, 0, 1, 80, 80);
  assert_int_equal(f.warnings, 0);
  plotting_end(&f);
}

/* ---- Pens ---------------------------------------------------------------- */

/* Each pen is taken once; on one pen layers keep their order. */
static void pens_change_only_where_they_must(void **state) {
  (void)state;
  struct plotting f;
  static const unsigned pens[] = {1, 1, 3, 2, 2, 1};
  plotting_begin(&f, 100, 100);
  for (size_t i = 0; i < 6; i++) {
    uint32_t layer = drawing_fixture_layer(&f.drawing, pens[i], 0.3, 0);
    if (pens[i] != 3)
      drawing_fixture_line(&f.drawing, layer, 10 + (double)i, 10, 20, 20);
  }
  plotting_run(&f);
  assert_int_equal(f.back.pen.count, 2);
  assert_int_equal(f.back.pen.item[0], 1);
  assert_int_equal(f.back.pen.item[1], 2);
  assert_int_equal(f.back.stroke.count, 5);
  static const int x[] = {0, 1, 5, 3, 4};
  for (size_t i = 0; i < 5; i++)
    plotting_assert_point(&f, i, 0, 400 + 40 * x[i], 400);
  plotting_end(&f);
}

static void layers_come_in_their_order_whatever_the_strokes(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 100, 100);
  uint32_t first = drawing_fixture_layer(&f.drawing, 1, 0.3, 0);
  uint32_t second = drawing_fixture_layer(&f.drawing, 2, 0.3, 0);
  drawing_fixture_line(&f.drawing, second, 1, 1, 2, 2);
  drawing_fixture_line(&f.drawing, first, 3, 3, 4, 4);
  drawing_fixture_line(&f.drawing, second, 5, 5, 6, 6);
  plotting_run(&f);
  assert_int_equal(f.back.stroke.count, 3);
  assert_int_equal(f.back.stroke.item[0].pen, 1);
  assert_int_equal(f.back.stroke.item[1].pen, 2);
  plotting_assert_point(&f, 1, 0, 40, 40);
  plotting_assert_point(&f, 2, 0, 200, 200);
  plotting_end(&f);
}

static void pens_past_the_carousel_are_reused_with_a_warning(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 297, 210);
  f.options.device = "hp7475a";
  for (unsigned pen = 6; pen <= 8; pen++)
    drawing_fixture_line(&f.drawing,
                         drawing_fixture_layer(&f.drawing, pen, 0.3, 0), 50, 50,
                         60, 60);
  plotting_run(&f);
  assert_int_equal(f.back.pen.item[0], 6);
  assert_int_equal(f.back.pen.item[1], 1);
  assert_int_equal(f.back.pen.item[2], 2);
  assert_int_equal(f.warnings, 1);
  assert_non_null(strstr(f.warning, "2 layers"));
  plotting_end(&f);
}

/* Pen 7 of 6 is pen 1, and comes with it. */
static void a_pen_that_is_reused_is_not_fetched_twice(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 297, 210);
  f.options.device = "hp7475a";
  static const unsigned pens[] = {1, 3, 7};
  for (size_t i = 0; i < 3; i++)
    drawing_fixture_line(&f.drawing,
                         drawing_fixture_layer(&f.drawing, pens[i], 0.3, 0), 50,
                         50, 60, 60);
  plotting_run(&f);
  assert_int_equal(f.back.pen.count, 2);
  assert_int_equal(f.back.pen.item[0], 1);
  assert_int_equal(f.back.pen.item[1], 3);
  assert_int_equal(f.back.stroke.count, 3);
  assert_int_equal(f.back.stroke.item[1].pen, 1);
  assert_non_null(strstr(f.warning, "1 layer on"));
  plotting_end(&f);
}

static void fills_are_left_out_with_a_warning(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 100, 100);
  uint32_t layer = drawing_fixture_layer(&f.drawing, 1, 0.3, 0);
  drawing_fixture_fill(&f.drawing, layer, 0xff0000,
                       (double[]){1, 1, 9, 1, 9, 9}, 3);
  plotting_run(&f);
  assert_int_equal(f.back.stroke.count, 0);
  assert_int_equal(f.warnings, 1);
  assert_non_null(strstr(f.warning, "1 fill "));
  plotting_end(&f);
}

/* ---- Options ------------------------------------------------------------- */

static void an_unknown_device_is_refused_with_the_known_ones(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 100, 100);
  f.options.device = "hp9999";
  assert_refused(&f, "hp9999");
  for (size_t i = 0; device_name(i); i++)
    assert_refused(&f, device_name(i));
  plotting_end(&f);
}

static void a_speed_that_makes_no_sense_is_refused(void **state) {
  (void)state;
  static const double speed[] = {-1, 0.5, 128, NAN, INFINITY};
  struct plotting f;
  plotting_begin(&f, 100, 100);
  for (size_t i = 0; i < 5; i++) {
    f.options.velocity = speed[i];
    assert_refused(&f, "cm/s");
  }
  plotting_end(&f);
}

static void a_plotter_gets_at_most_its_highest_speed(void **state) {
  (void)state;
  static const struct {
    const char *device;
    double requested;
    int written, warnings;
  } speed[] = {{"hp7475a", 60, 38, 1},
               {"hp7475a", 20, 20, 0},
               {"hp7550a", 127, 80, 1},
               {"dxy", 42, 42, 0},
               {"generic", 127, 127, 0}};
  for (size_t i = 0; i < sizeof speed / sizeof speed[0]; i++) {
    struct plotting f;
    plotting_begin(&f, 297, 210);
    f.options.device = speed[i].device;
    f.options.velocity = speed[i].requested;
    drawing_fixture_line(&f.drawing,
                         drawing_fixture_layer(&f.drawing, 1, 0.3, 0), 50, 50,
                         60, 60);
    plotting_run(&f);
    assert_int_equal(f.back.velocity, speed[i].written);
    assert_int_equal(f.warnings, speed[i].warnings);
    assert_true(f.warnings == 0 || strstr(f.warning, "cm/s"));
    plotting_end(&f);
  }
}

static void a_warning_callback_is_optional(void **state) {
  (void)state;
  struct plotting f;
  plotting_begin(&f, 100, 100);
  f.options.warning = NULL;
  drawing_fixture_line(&f.drawing, drawing_fixture_layer(&f.drawing, 1, 0.3, 0),
                       50, 50, 200, 50);
  plotting_run(&f);
  plotting_assert_point(&f, 0, 1, 4000, 2000);
  plotting_end(&f);
}

/* ---- A full disk --------------------------------------------------------- */

static void a_full_disk_leaves_no_plot(void **state) {
  (void)state;
  static const char path[] = "test_hpgl.tmp.hpgl";
  struct plotting f;
  double xy[2 * 20000];
  plotting_begin(&f, 297, 210);
  for (size_t i = 0; i < 20000; i++) {
    xy[2 * i] = 10 + 0.013 * (double)i;
    xy[2 * i + 1] = 100 + (double)(i % 7);
  }
  drawing_fixture_stroke(&f.drawing,
                         drawing_fixture_layer(&f.drawing, 1, 0.3, 0), xy,
                         20000, false);
  recto_status status = RECTO_ERROR_IO;
  unsigned long n = 0;
  while (status != RECTO_OK && ++n < 100) {
    recto_error error;
    struct stream *stream;
    assert_int_equal(stream_open(&stream, path, &error), RECTO_OK);
    stream_fail_after(n);
    assert_int_equal(writer_hpgl.write(&f.drawing, &f.options, stream, &error),
                     RECTO_OK);
    status = stream_finish(stream, &error);
    stream_fail_after(0);
    if (status != RECTO_OK) {
      assert_int_equal(status, RECTO_ERROR_IO);
      assert_int_not_equal(access(path, F_OK), 0);
    }
  }
  /* The drawing takes more than one write, and one that does not fail. */
  assert_in_range(n, 3, 99);
  assert_int_equal(access(path, F_OK), 0);
  unlink(path);
  plotting_end(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_plot_is_written_in_the_common_dialect),
      cmocka_unit_test(an_empty_drawing_takes_no_pen),
      cmocka_unit_test(long_strokes_are_cut_into_commands_of_100_points),
      cmocka_unit_test(points_that_repeat_and_strokes_that_vanish_go),
      cmocka_unit_test(pens_change_only_where_they_must),
      cmocka_unit_test(layers_come_in_their_order_whatever_the_strokes),
      cmocka_unit_test(pens_past_the_carousel_are_reused_with_a_warning),
      cmocka_unit_test(a_pen_that_is_reused_is_not_fetched_twice),
      cmocka_unit_test(fills_are_left_out_with_a_warning),
      cmocka_unit_test(an_unknown_device_is_refused_with_the_known_ones),
      cmocka_unit_test(a_speed_that_makes_no_sense_is_refused),
      cmocka_unit_test(a_plotter_gets_at_most_its_highest_speed),
      cmocka_unit_test(a_warning_callback_is_optional),
      cmocka_unit_test(a_full_disk_leaves_no_plot),
  };
  return cmocka_run_group_tests_name("hpgl", tests, NULL, NULL);
}
