/* test_precision.c - a file's literals show how far rounding moved its
 * coordinates. */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/number.h"
#include "recto.h"
#include "scene/read.h"
#include "scene/scene.h"
#include "tests/reading.h"
#include "tests/scenes/random.h"
#include "tests/temporary.h"

enum { TEXT_SIZE = 1 << 18, POINTS = 400 };

static const struct precision unstated = {7, 7};

/* The precision that the reader states for this text. */
static struct precision read_text(const struct reader *reader,
                                  const char *text) {
  struct reading reading;
  reading_of(&reading, reader, text);
  assert_int_equal(reading.status, RECTO_OK);
  assert_int_equal(reading.scene.precision.count, 1);
  struct precision first = scene_point_precision(&reading.scene, 0, unstated);
  reading_fini(&reading);
  return first;
}

static void assert_precision(struct precision precision, double absolute,
                             double relative) {
  if (fabs(precision.absolute - absolute) > 0x1p-40 * absolute ||
      fabs(precision.relative - relative) > 0x1p-40 * relative)
    fail_msg("{%g, %g} instead of {%g, %g}", precision.absolute,
             precision.relative, absolute, relative);
}

enum rounding { AS_DOUBLE, AS_SINGLE };

/* Writes the number as %f, %g or %e with so many digits does. */
static size_t put_number(char *text, char style, int digits, double x) {
  enum { ROOM = 64 };
  int length = style == 'f'   ? snprintf(text, ROOM, "%.*f", digits, x)
               : style == 'g' ? snprintf(text, ROOM, "%.*g", digits, x)
                              : snprintf(text, ROOM, "%.*e", digits, x);
  return (size_t)length;
}

/* POINTS points as statements of OBJ, each coordinate printed in that style.
 * Numbers lie within `size` of `middle`. */
static const char *make_obj(char style, int digits, enum rounding rounding,
                            double middle, double size) {
  static char text[TEXT_SIZE];
  struct random random = {5};
  size_t length = 0;
  for (int i = 0; i < POINTS; i++) {
    length += (size_t)snprintf(text + length, 3, "v");
    for (int k = 0; k < 3; k++) {
      double x = random_between(&random, middle - size, middle + size);
      if (rounding == AS_SINGLE)
        x = (double)(float)x;
      text[length++] = ' ';
      length += put_number(text + length, style, digits, x);
    }
    text[length++] = '\n';
  }
  memcpy(text + length, "f 1 2 3\n", sizeof "f 1 2 3\n");
  return text;
}

/* The same with the fewest digits that read back as the same single. */
static const char *make_shortest_obj(double size) {
  static char text[TEXT_SIZE];
  struct random random = {6};
  size_t length = 0;
  for (int i = 0; i < 3 * POINTS; i++) {
    float x = (float)random_between(&random, -size, size);
    char number[64];
    for (int digits = 1; digits < 10; digits++) {
      snprintf(number, sizeof number, "%.*g", digits, (double)x);
      if (strtof(number, NULL) == x)
        break;
    }
    length +=
        (size_t)snprintf(text + length, 80, "%s%s%s", i % 3 == 0 ? "v " : " ",
                         number, i % 3 == 2 ? "\n" : "");
  }
  memcpy(text + length, "f 1 2 3\n", sizeof "f 1 2 3\n");
  return text;
}

/* ---- Texts --------------------------------------------------------------- */

static void six_decimals_round_by_half_of_the_sixth(void **state) {
  (void)state;
  const char *text = make_obj('f', 6, AS_DOUBLE, 0, 100);
  assert_precision(read_text(&reader_obj, text), 0.5e-6, PRECISION_DOUBLE);
}

static void a_small_model_of_six_decimals_is_rounded_too(void **state) {
  (void)state;
  struct precision found =
      read_text(&reader_obj, make_obj('f', 6, AS_DOUBLE, 0, 0.01));
  assert_precision((struct precision){found.absolute, 0}, 0.5e-6, 0);
}

static void three_decimals_round_by_half_of_the_third(void **state) {
  (void)state;
  const char *text = make_obj('f', 3, AS_DOUBLE, 0, 2000);
  struct precision found = read_text(&reader_obj, text);
  assert_precision((struct precision){found.absolute, 0}, 0.5e-3, 0);
}

static void integers_are_exact(void **state) {
  (void)state;
  assert_precision(read_text(&reader_obj, make_obj('f', 0, AS_DOUBLE, 0, 1e7)),
                   0, 0);
}

static void integers_with_a_lone_decimal_take_its_place(void **state) {
  (void)state;
  assert_precision(read_text(&reader_obj, "v 0 0 0\nv 10 0 0\nv 0 10 0\n"
                                          "v 3 4 0.123456\nf 1 2 3\n"),
                   0.5e-6, PRECISION_SINGLE);
}

static void a_lone_zero_decides_nothing(void **state) {
  (void)state;
  assert_precision(read_text(&reader_obj, "v 0 0.0 0.00000000\n"
                                          "v 1.234567 -0.345678 0\n"
                                          "v 0.456789 0 1\nf 1 2 3\n"),
                   0.5e-6, PRECISION_SINGLE);
}

static void authored_numbers_are_exact(void **state) {
  (void)state;
  assert_precision(read_text(&reader_obj, "v 0.5 -12.25 0\nv 1.5 0.05 7\n"
                                          "v 100.5 2.0 0\nf 1 2 3\n"),
                   0, 0);
}

static void a_few_long_numbers_among_authored_ones_do_not_count(void **state) {
  (void)state;
  char text[4096];
  size_t length = 0;
  for (int i = 0; i < 20; i++)
    length += (size_t)snprintf(text + length, 64, "v %d.5 0.25 %s\n", i,
                               i == 7 ? "0.123456" : "1");
  memcpy(text + length, "f 1 2 3\n", sizeof "f 1 2 3\n");
  assert_precision(read_text(&reader_obj, text), 0, 0);
}

static void general_notation_rounds_to_its_digits(void **state) {
  (void)state;
  assert_precision(read_text(&reader_obj, make_obj('g', 6, AS_DOUBLE, 0, 1)), 0,
                   0.5e-5);
  assert_precision(read_text(&reader_obj, make_obj('g', 9, AS_DOUBLE, 0, 1)), 0,
                   0.5e-8);
}

static void exponents_round_to_their_digits(void **state) {
  (void)state;
  assert_precision(read_text(&reader_obj, make_obj('e', 6, AS_DOUBLE, 0, 1)), 0,
                   0.5e-6);
}

static void tiny_residues_do_not_make_fine_places(void **state) {
  (void)state;
  static char text[TEXT_SIZE + 100];
  snprintf(text, sizeof text, "v -4.371139e-08 1.224647e-16 1\n%s",
           make_obj('g', 7, AS_SINGLE, 0, 1));
  struct precision found = read_text(&reader_obj, text);
  assert_precision((struct precision){found.absolute, 0}, 0, 0);
  assert_precision(found, 0, 0.5e-6);
}

static void shortest_singles_are_single_precision(void **state) {
  (void)state;
  struct precision found = read_text(&reader_obj, make_shortest_obj(10));
  assert_precision((struct precision){0, found.relative}, 0, PRECISION_SINGLE);
  assert_true(found.absolute < 1e-7);
}

static void translated_single_precision_is_recognised(void **state) {
  (void)state;
  const char *text = make_obj('f', 6, AS_SINGLE, 1e6, 10);
  struct precision found = read_text(&reader_obj, text);
  assert_precision(found, 0.5e-6, PRECISION_SINGLE);
  double error = precision_error(found, 1e6);
  assert_true(error >= 0.03125 && error < 0.0625);
}

static void doubles_far_away_stay_precise(void **state) {
  (void)state;
  const char *text = make_obj('f', 3, AS_DOUBLE, 500000.123, 100);
  assert_precision(read_text(&reader_obj, text), 0.5e-3, PRECISION_DOUBLE);
}

static void the_end_of_a_file_counts_as_its_beginning(void **state) {
  (void)state;
  static char text[TEXT_SIZE];
  size_t length = 0;
  for (int i = 0; i < 3 * POINTS; i++)
    length += (size_t)snprintf(text + length, 64, "v %d.5 0.5 1.5\n", i % 7);
  snprintf(text + length, sizeof text - length, "%s",
           make_obj('f', 6, AS_DOUBLE, 0, 100));
  assert_precision(read_text(&reader_obj, text), 0.5e-6, PRECISION_DOUBLE);
}

/* The points of an OBJ as the corners of a text STL. */
static const char *make_stl(const char *obj) {
  static char text[2 * TEXT_SIZE];
  size_t length = (size_t)sprintf(text, "solid\n");
  for (int i = 0; i < POINTS / 3; i++) {
    length +=
        (size_t)sprintf(text + length, "facet normal 0 0 1\nouter loop\n");
    for (int k = 0; k < 3; k++) {
      int line = (int)strcspn(obj, "\n");
      length +=
          (size_t)sprintf(text + length, "vertex %.*s\n", line - 2, obj + 2);
      obj += line + 1;
    }
    length += (size_t)sprintf(text + length, "endloop\nendfacet\n");
  }
  sprintf(text + length, "endsolid\n");
  return text;
}

static void a_text_stl_has_the_precision_of_an_obj(void **state) {
  (void)state;
  assert_precision(
      read_text(&reader_stl, make_stl(make_obj('f', 6, AS_DOUBLE, 0, 100))),
      0.5e-6, PRECISION_DOUBLE);
  assert_precision(
      read_text(&reader_stl, make_stl(make_obj('e', 6, AS_DOUBLE, 0, 100))), 0,
      0.5e-6);
  assert_precision(
      read_text(&reader_stl, make_stl(make_obj('f', 0, AS_DOUBLE, 0, 100))), 0,
      0);
}

static void numbers_that_are_not_finite_do_not_count(void **state) {
  (void)state;
  assert_precision(read_text(&reader_obj,
                             "v 0 0 0\nv nan 0 0\nv 1 inf 0\nv 1e400 0 0\n"
                             "v 1 0 0\nv 0 1 0\nf 1 5 6\n"),
                   0, 0);
}

static void unusual_numbers_have_some_precision(void **state) {
  (void)state;
  static const char *const texts[] = {
      "v 1e300 1.23456e308 5e-324\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
      "v 1.234567e-300 1.234567e-310 4.940656e-324\nv 1 0 0\nv 0 1 0\n",
      "v 1e-99999 1.5e-400 1.5e99\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
      "v .5 5. +5.e0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
      "v 0.1234567890123456789012345678901234567890 1 1\nv 1 0 0\nv 0 1 0\n",
  };
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
    struct precision found = read_text(&reader_obj, texts[i]);
    assert_true(found.absolute >= 0 && found.absolute <= DBL_MAX);
    assert_true(found.relative >= 0 && found.relative < 1e-4);
  }
}

/* ---- Ranges -------------------------------------------------------------- */

static void add_file(struct reading *reading, const struct reader *reader,
                     const char *text) {
  assert_int_equal(reading_bytes(reading, reader, text, strlen(text)),
                   RECTO_OK);
}

static void add_binary_stl(struct reading *reading) {
  char bytes[84 + 50] = {0};
  const float corner[9] = {0, 0, 0, 1.1F, 0, 0, 0, 1.1F, 0};
  bytes[80] = 1;
  memcpy(bytes + 84 + 12, corner, sizeof corner);
  assert_int_equal(reading_bytes(reading, &reader_stl, bytes, sizeof bytes),
                   RECTO_OK);
}

static void a_binary_stl_is_single(void **state) {
  (void)state;
  struct reading reading;
  reading_init(&reading);
  add_binary_stl(&reading);
  assert_precision(scene_point_precision(&reading.scene, 2, unstated), 0,
                   PRECISION_SINGLE);
  reading_fini(&reading);
}

static void each_file_has_its_own_range(void **state) {
  (void)state;
  struct reading reading;
  reading_init(&reading);
  add_file(&reading, &reader_obj, "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  add_binary_stl(&reading);
  add_file(&reading, &reader_obj, "v 1.234567 0 0\n");
  assert_int_equal(reading.scene.point.count, 7);
  static const struct precision wanted[7] = {
      {0, 0},
      {0, 0},
      {0, 0},
      {0, PRECISION_SINGLE},
      {0, PRECISION_SINGLE},
      {0, PRECISION_SINGLE},
      {0.5e-6, PRECISION_SINGLE},
  };
  for (uint32_t p = 0; p < 7; p++)
    assert_precision(scene_point_precision(&reading.scene, p, unstated),
                     wanted[p].absolute, wanted[p].relative);
  reading_fini(&reading);
}

static void points_of_no_file_have_the_caller_s_precision(void **state) {
  (void)state;
  struct reading reading;
  struct scene_point point = {1, 2, 3};
  recto_error error;
  reading_init(&reading);
  struct scene *scene = &reading.scene;
  assert_true(ARRAY_PUSH(&scene->point, point));
  add_binary_stl(&reading);
  for (int i = 0; i < 2; i++) {
    assert_int_equal(scene_leave_precision(scene, scene->point.count, &error),
                     RECTO_OK);
    assert_true(ARRAY_PUSH(&scene->point, point));
  }
  assert_int_equal(scene->precision.count, 2);
  assert_precision(scene_point_precision(scene, 0, unstated), 7, 7);
  assert_precision(scene_point_precision(scene, 3, unstated), 0,
                   PRECISION_SINGLE);
  assert_precision(scene_point_precision(scene, 4, unstated), 7, 7);
  assert_precision(scene_point_precision(scene, 5, unstated), 7, 7);
  reading_fini(&reading);
}

static void a_failed_read_leaves_the_ranges(void **state) {
  (void)state;
  struct reading reading;
  struct scene_snapshot mark;
  reading_init(&reading);
  add_binary_stl(&reading);
  scene_snapshot(&reading.scene, &mark);
  add_file(&reading, &reader_obj, "v 1.234567 0 0\nv 2 0 0\n");
  assert_int_equal(reading.scene.precision.count, 2);
  scene_restore(&reading.scene, &mark);
  assert_int_equal(reading.scene.precision.count, 1);
  add_file(&reading, &reader_obj, "v 1 0 0\nv 2 0 0\n");
  assert_precision(scene_point_precision(&reading.scene, 3, unstated), 0, 0);
  reading_fini(&reading);
}

static void bits_make_a_precision(void **state) {
  (void)state;
  assert_precision(precision_of_bits(0), 0, PRECISION_SINGLE);
  assert_precision(precision_of_bits(24), 0, PRECISION_SINGLE);
  assert_precision(precision_of_bits(10), 0, 0x1p-10);
  assert_precision(precision_of_bits(53), 0, 0);
}

static void bits_have_a_range(void **state) {
  (void)state;
  recto_options options;
  recto_options_init(&options);
  options.mesh.coordinate_bits = 54;
  recto_scene *scene;
  recto_drawing *drawing;
  recto_error error;
  assert_int_equal(recto_scene_create(&scene, &error), RECTO_OK);
  assert_int_equal(recto_scene_render(scene, &options, &drawing, &error),
                   RECTO_ERROR_ARGUMENT);
  recto_scene_destroy(scene);
}

/* How many warnings reading a square gives that is so large and so far off,
 * whose numbers are those of single precision. */
static int warnings_of_square(void **state, double size, double from) {
  char text[256];
  struct reading r;
  int length = 0;
  for (int i = 0; i < 4; i++)
    length +=
        snprintf(text + length, sizeof text - (size_t)length, "v %.2f %.2f 0\n",
                 from + (i == 1 || i == 2) * size, (i > 1) * size + 0.25);
  length +=
      snprintf(text + length, sizeof text - (size_t)length, "f 1 2 3 4\n");
  reading_init(&r);
  assert_int_equal(
      scene_read(&r.scene, temporary_file(state, "a.obj", text, (size_t)length),
                 NULL, &r.diagnostics, &r.error),
      RECTO_OK);
  int warnings = r.warnings;
  reading_fini(&r);
  return warnings;
}

/* Numbers of single precision at five millions are rounded by up to 0.3, of
 * other numbers by none. */
static void numbers_too_coarse_for_the_size_are_warned_about(void **state) {
  assert_int_equal(warnings_of_square(state, 40, 5000000.5), 1);
  assert_int_equal(warnings_of_square(state, 4000, 5000000.5), 0);
  assert_int_equal(warnings_of_square(state, 40, 0.5), 0);
  assert_int_equal(warnings_of_square(state, 40, 5000000.13), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(six_decimals_round_by_half_of_the_sixth),
      cmocka_unit_test(a_small_model_of_six_decimals_is_rounded_too),
      cmocka_unit_test(three_decimals_round_by_half_of_the_third),
      cmocka_unit_test(integers_are_exact),
      cmocka_unit_test(integers_with_a_lone_decimal_take_its_place),
      cmocka_unit_test(a_lone_zero_decides_nothing),
      cmocka_unit_test(authored_numbers_are_exact),
      cmocka_unit_test(a_few_long_numbers_among_authored_ones_do_not_count),
      cmocka_unit_test(general_notation_rounds_to_its_digits),
      cmocka_unit_test(exponents_round_to_their_digits),
      cmocka_unit_test(tiny_residues_do_not_make_fine_places),
      cmocka_unit_test(shortest_singles_are_single_precision),
      cmocka_unit_test(translated_single_precision_is_recognised),
      cmocka_unit_test(doubles_far_away_stay_precise),
      cmocka_unit_test(the_end_of_a_file_counts_as_its_beginning),
      cmocka_unit_test(a_text_stl_has_the_precision_of_an_obj),
      cmocka_unit_test(numbers_that_are_not_finite_do_not_count),
      cmocka_unit_test(unusual_numbers_have_some_precision),
      cmocka_unit_test(a_binary_stl_is_single),
      cmocka_unit_test(each_file_has_its_own_range),
      cmocka_unit_test(points_of_no_file_have_the_caller_s_precision),
      cmocka_unit_test(a_failed_read_leaves_the_ranges),
      cmocka_unit_test(bits_make_a_precision),
      cmocka_unit_test(bits_have_a_range),
      cmocka_unit_test_setup_teardown(
          numbers_too_coarse_for_the_size_are_warned_about, temporary_set_up,
          temporary_tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
