/* test_text.c - text is drawn as strokes of the given height, and what the font
 * does not have is an error. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "drawing/text.h"
#include "tests/memory_faults.h"

static void draw_text(struct drawing *drawing, const char *text,
                      double height_mm) {
  const struct text_line line = {text, height_mm};
  drawing_init(drawing);
  assert_true(text_add(drawing, 0, &line, (struct drawing_point){100, 50}));
}

static void assert_point(const struct drawing *drawing, size_t index, double x,
                         double y) {
  assert_true(fabs(drawing->point.item[index].x - x) < 1e-12);
  assert_true(fabs(drawing->point.item[index].y - y) < 1e-12);
}

/* Hershey's L, 587: from -8 to 9, a stem at -4 from -12 to 9, and a foot from
 * there to 8. */
static void a_letter_has_its_height(void **state) {
  (void)state;
  struct drawing drawing;
  draw_text(&drawing, "L", 21);
  assert_int_equal(drawing.stroke.count, 2);
  assert_point(&drawing, 0, 104, 71);
  assert_point(&drawing, 1, 104, 50);
  assert_point(&drawing, 2, 104, 50);
  assert_point(&drawing, 3, 116, 50);
  for (size_t i = 0; i < 2; i++) {
    assert_true(drawing.stroke.item[i].text);
    assert_int_equal(drawing.stroke.item[i].edge_class, 0);
    assert_int_equal(drawing.stroke.item[i].face, DRAWING_NONE);
  }
  drawing_fini(&drawing);
}

static void letters_stand_side_by_side(void **state) {
  (void)state;
  struct drawing drawing;
  const struct text_line one = {"L", 7}, two = {"LL", 7}, none = {"", 7};
  assert_true(fabs(text_width_mm(&one) - 17.0 / 3) < 1e-12);
  assert_true(text_width_mm(&two) == 2 * text_width_mm(&one));
  assert_true(text_width_mm(&none) == 0);
  draw_text(&drawing, "LL", 7);
  assert_point(&drawing, 0, 100 + 4 / 3.0, 57);
  assert_point(&drawing, 4, 100 + 17 / 3.0 + 4 / 3.0, 57);
  drawing_fini(&drawing);
}

static size_t count_strokes(const char *text) {
  struct drawing drawing;
  assert_int_equal(text_check(text, "it", NULL), RECTO_OK);
  draw_text(&drawing, text, 5);
  size_t count = drawing.stroke.count;
  drawing_fini(&drawing);
  return count;
}

static void every_character_of_the_font_is_drawn(void **state) {
  (void)state;
  for (char c = '!'; c <= '~'; c++) {
    const char text[] = {c, '\0'};
    assert_in_range(count_strokes(text), 1, 6);
  }
  assert_int_equal(count_strokes(" "), 0);
  assert_int_equal(count_strokes("\302\260"), 1); /* degree */
}

/* a, e, o, u have so many strokes; the marks are one or two more. */
static void letters_have_accents(void **state) {
  (void)state;
  assert_int_equal(count_strokes("\303\244"), count_strokes("a") + 2); /* ä */
  assert_int_equal(count_strokes("\303\251"), count_strokes("e") + 1); /* é */
  assert_int_equal(count_strokes("\303\230"), count_strokes("O") + 1); /* Ø */
  assert_int_equal(count_strokes("\303\257"), 3); /* ï: a stem and two dots */
  assert_in_range(count_strokes("\303\237"), 1, 4);                    /* ß */
  assert_int_equal(count_strokes("\303\277"), count_strokes("y") + 2); /* ÿ */
}

/* No mark touches its letter or reaches below it, but for those that do. */
static void marks_stand_above_letters(void **state) {
  (void)state;
  static const char *const pair[][2] = {{"A", "\303\204"}, {"a", "\303\241"},
                                        {"U", "\303\231"}, {"n", "\303\261"},
                                        {"O", "\303\226"}, {"e", "\303\252"}};
  for (size_t i = 0; i < sizeof pair / sizeof pair[0]; i++) {
    struct drawing plain, marked;
    double top = 0, least = INFINITY;
    draw_text(&plain, pair[i][0], 21);
    draw_text(&marked, pair[i][1], 21);
    for (size_t p = 0; p < plain.point.count; p++)
      top = fmax(top, plain.point.item[p].y);
    for (size_t p = plain.point.count; p < marked.point.count; p++)
      least = fmin(least, marked.point.item[p].y);
    assert_true(least >= top + 2 && least <= top + 6);
    drawing_fini(&plain);
    drawing_fini(&marked);
  }
}

static void assert_refused(const char *text, const char *words) {
  recto_error error;
  assert_int_equal(text_check(text, "the title", &error), RECTO_ERROR_ARGUMENT);
  if (strstr(error.text, words) == NULL)
    fail_msg("\"%s\" is not in: %s", words, error.text);
}

static void what_the_font_lacks_is_refused(void **state) {
  (void)state;
  assert_refused("a\343\201\202", "no \"\343\201\202\" (U+3042)");
  assert_refused("\303\206", "(U+00C6)"); /* Æ */
  assert_refused("\303\227", "(U+00D7)"); /* × */
  assert_refused("two\nlines", "(U+000A)");
  assert_refused("\302\200", "");
  assert_refused("\377", "no text in UTF-8");
  assert_refused("\303", "no text in UTF-8");
  assert_refused("\001", "no text in UTF-8");
}

static void where_memory_runs_out_it_says_so(void **state) {
  (void)state;
  const struct text_line line = {"Gr\303\266\303\237e of all letters", 5};
  struct memory_faults faults = {.least = 2};
  while (memory_faults_go_on(&faults)) {
    struct drawing drawing;
    drawing_init(&drawing);
    memory_faults_begin(&faults);
    memory_faults_end(
        &faults, memory_faults_status(text_add(&drawing, 0, &line,
                                               (struct drawing_point){0, 0})));
    drawing_fini(&drawing);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_letter_has_its_height),
      cmocka_unit_test(letters_stand_side_by_side),
      cmocka_unit_test(every_character_of_the_font_is_drawn),
      cmocka_unit_test(letters_have_accents),
      cmocka_unit_test(marks_stand_above_letters),
      cmocka_unit_test(what_the_font_lacks_is_refused),
      cmocka_unit_test(where_memory_runs_out_it_says_so),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
