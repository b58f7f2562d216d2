/* test_dense_edges.c - of edges that are visible in very many parts short gaps
 * are closed, by whichever method; of no others, and not where lines are drawn
 * as they are. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "api/handle.h"
#include "tests/obj_drawing.h"
#include "tests/scenes/scenes.h"
#include "visibility/dense_edges.h"

enum { WIDE = 10 }; /* each so many strips, one is wider than a pen */

/* A square of 180 mm behind upright strips, seen from above at true scale;
 * strips are 0.05 mm wide, each tenth 0.3. */
static char *write_strips(int strips, size_t *length) {
  char *text;
  FILE *to = open_memstream(&text, length);
  assert_non_null(to);
  fprintf(to, "v 15 20 0\nv 195 20 0\nv 195 40 0\nv 15 40 0\nf 1 2 3 4\n");
  for (int i = 0; i < strips; i++) {
    double left = 15 + 180.0 / strips * (i + 0.5),
           width = i % WIDE ? 0.05 : 0.3;
    fprintf(to, "v %.9g 19 1\nv %.9g 19 1\nv %.9g 41 1\nv %.9g 41 1\n", left,
            left + width, left + width, left);
    fprintf(to, "f %d %d %d %d\n", 4 * i + 5, 4 * i + 6, 4 * i + 7, 4 * i + 8);
  }
  assert_int_equal(fclose(to), 0);
  return text;
}

/* Draws so many strips; *intervals gets how many visible parts edges have.
 * Returns the SVG text. */
static char *draw_strips(int strips, const recto_options *given,
                         long *intervals) {
  recto_options options = *given;
  size_t length;
  char *text = write_strips(strips, &length);
  scenes_view_page(&options, 210, 60);
  options.ink.edges = RECTO_EDGE_BORDER;
  char *output =
      obj_drawing_svg(text, length, &options, "intervals_made", intervals);
  free(text);
  return output;
}

static long count_intervals(int strips, const recto_options *options) {
  long intervals;
  free(draw_strips(strips, options, &intervals));
  return intervals;
}

/* Two edges of the square run along behind the strips. */
static void short_gaps_of_dense_edges_are_closed(void **state) {
  recto_options options;
  (void)state;
  recto_options_init(&options);
  assert_int_equal(count_intervals(300, &options), 2 * (300 / WIDE + 1));
}

static void other_edges_keep_their_gaps(void **state) {
  recto_options options;
  int strips = DENSE_EDGES_PARTS - 1; /* as many parts, and one more */
  (void)state;
  recto_options_init(&options);
  assert_int_equal(count_intervals(strips, &options), 2 * (strips + 1));
  assert_in_range(count_intervals(strips + 1, &options), 2, strips);
}

static void lines_as_they_are_keep_their_gaps(void **state) {
  recto_options options;
  (void)state;
  recto_options_init(&options);
  options.ink.exact = true;
  assert_int_equal(count_intervals(300, &options), 2 * 301);
  recto_options_init(&options);
  options.ink.min_stroke_mm = 0;
  assert_int_equal(count_intervals(300, &options), 2 * 301);
  recto_options_init(&options);
  options.ink.hidden = RECTO_HIDDEN_DASHED;
  assert_int_equal(count_intervals(300, &options), 2 * 301);
  recto_options_init(&options); /* a gap is no longer than half a pen */
  options.ink.pen_mm = 0.05;
  assert_int_equal(count_intervals(300, &options), 2 * 301);
}

static void methods_and_threads_draw_alike(void **state) {
  static const recto_method method[] = {RECTO_METHOD_BRUTE, RECTO_METHOD_NEWELL,
                                        RECTO_METHOD_WARNOCK,
                                        RECTO_METHOD_WATKINS};
  recto_options options;
  long count, own;
  (void)state;
  recto_options_init(&options);
  options.solver.threads = 1;
  char *expected = draw_strips(400, &options, &count);
  options.solver.threads = 3;
  char *drawn = draw_strips(400, &options, &own);
  assert_string_equal(drawn, expected);
  free(drawn);
  for (size_t i = 0; i < sizeof method / sizeof method[0]; i++) {
    options.solver.method = method[i];
    drawn = draw_strips(400, &options, &own);
    assert_string_equal(drawn, expected);
    free(drawn);
  }
  free(expected);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(short_gaps_of_dense_edges_are_closed),
      cmocka_unit_test(other_edges_keep_their_gaps),
      cmocka_unit_test(lines_as_they_are_keep_their_gaps),
      cmocka_unit_test(methods_and_threads_draw_alike),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
