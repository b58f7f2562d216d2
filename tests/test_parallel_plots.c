/* test_parallel_plots.c - the number of threads changes no byte of a hatched
 * drawing, of many small regions and of a surface that is one, nor of one for a
 * plotter. */
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

static char *text_of_squares(bool apart, size_t *length) {
  char *text;
  FILE *to = open_memstream(&text, length);
  assert_non_null(to);
  write_squares(to, apart);
  assert_int_equal(fclose(to), 0);
  return text;
}

static void assert_hatched_alike(bool apart, const char *name,
                                 recto_options *options) {
  size_t length;
  char *text = text_of_squares(apart, &length);
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

/* The HPGL of the squares, all edges; the caller's to free. */
static char *plot_squares(const char *squares, size_t length, int threads) {
  recto_options options;
  recto_drawing *drawing;
  struct svg_text text = {NULL, 0};
  recto_options_init(&options);
  options.ink.edges = RECTO_EDGES_ALL;
  options.solver.threads = threads;
  recto_scene *scene = obj_drawing_scene(squares, length, &options);
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  assert_int_equal(recto_drawing_write_to(drawing, "hpgl", &options, append_svg,
                                          &text, NULL),
                   RECTO_OK);
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return text.bytes;
}

static void threads_change_no_plot(void **state) {
  size_t length;
  (void)state;
  if (parallel_processors() < 2)
    skip();
  char *squares = text_of_squares(true, &length);
  char *one = plot_squares(squares, length, 1);
  char *two = plot_squares(squares, length, 2);
  assert_true(strlen(one) > 100000);
  assert_string_equal(one, two);
  free(one);
  free(two);
  free(squares);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(threads_change_no_hatching),
      cmocka_unit_test(threads_change_no_plot),
  };
  return cmocka_run_group_tests_name("parallel plots", tests, NULL, NULL);
}
