/* test_parallel_hatching.c - the number of threads changes no byte of a hatched
 * drawing: of many small regions, and of a surface that is one. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/parallel.h"
#include "tests/obj_drawing.h"

enum { SIDE = 120 }; /* squares along a side of the model */

static double height_at(int i, int k) {
  return 3 * sin(0.1 * i) * cos(0.08 * k);
}

/* Writes squares of a wavy surface.
 * apart  each with corners of its own, and between them gaps */
static void write_squares(FILE *to, bool apart) {
  for (int i = 0; i < SIDE; i++)
    for (int k = 0; k < SIDE; k++) {
      static const int at[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      for (int c = 0; c < 4; c++)
        fprintf(to, "v %.2f %.2f %.4f\n", i + (apart ? 0.9 : 1.0) * at[c][0],
                k + (apart ? 0.9 : 1.0) * at[c][1],
                height_at(i + at[c][0], k + at[c][1]));
      int first = 4 * (i * SIDE + k) + 1;
      fprintf(to, "f %d %d %d %d\n", first, first + 1, first + 2, first + 3);
    }
}

static void assert_hatched_alike(bool apart, const char *name,
                                 recto_options *options) {
  char *text;
  size_t length;
  FILE *to = open_memstream(&text, &length);
  assert_non_null(to);
  write_squares(to, apart);
  assert_int_equal(fclose(to), 0);
  options->solver.threads = 1;
  char *one = obj_drawing_svg(text, length, options, NULL, NULL);
  options->solver.threads = 2;
  char *two = obj_drawing_svg(text, length, options, NULL, NULL);
  options->ink.fill = RECTO_FILL_NONE;
  char *lines = obj_drawing_svg(text, length, options, NULL, NULL);
  assert_true(strlen(one) > strlen(lines) + 10000);
  if (strcmp(one, two) != 0)
    fail_msg("%s: two threads hatch differently", name);
  free(one);
  free(two);
  free(lines);
  free(text);
}

static void threads_change_no_hatching(void **state) {
  (void)state;
  if (parallel_processors() < 2)
    skip();
  for (int kind = 0; kind < 6; kind++) {
    recto_options options;
    recto_options_init(&options);
    options.ink.fill = RECTO_FILL_HATCH;
    options.ink.hatch_pitch_mm = 0.4;
    options.ink.hatch_inset = kind / 2 == 1;
    if (kind / 2 == 2)
      memcpy(options.ink.light, (const double[]){1, 2, 3},
             sizeof options.ink.light);
    assert_hatched_alike(kind % 2 == 0,
                         (const char *[]){"at one pitch", "kept from sides",
                                          "by tone"}[kind / 2],
                         &options);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(threads_change_no_hatching),
  };
  return cmocka_run_group_tests_name("parallel hatching", tests, NULL, NULL);
}
