/* test_cancelling.c - row 16 of the list of failures: long work can be ended
 * in each of its phases. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/laid.h"
#include "visibility/solver.h"

struct listener {
  const char *stop; /* the phase to end in */
  int after;        /* so many calls */
};

static bool listen(void *user, double share, const char *stage) {
  struct listener *listener = user;
  assert_true(share >= 0 && share <= 1);
  return strcmp(stage, listener->stop) != 0 || listener->after-- > 0;
}

static void stop_tiles(const char *stage, int after, int threads, unsigned n) {
  struct laid laid;
  struct map map;
  struct listener listener = {stage, after};
  const struct solver_request request = {.strokes = true,
                                         .fragments = true,
                                         .intersections = true,
                                         .threads = threads,
                                         .progress = listen,
                                         .user = &listener};
  struct report *report = report_create();
  recto_error error;
  laid_start(&laid);
  scenes_soup(&laid.scene, &laid.options, n, 3);
  laid_out(&laid, true);
  map_init(&map);
  assert_int_equal(
      solver_tiles.solve(&laid.sheet, &request, &map, report, &error),
      RECTO_ERROR_CANCELLED);
  assert_int_equal(error.code, RECTO_ERROR_CANCELLED);
  assert_int_equal(listener.after, -1); /* asked no more, once it refused */
  map_fini(&map);
  report_destroy(report);
  laid_fini(&laid);
}

static void row_16_tiles_end_while_they_look_for_piercings(void **state) {
  (void)state;
  stop_tiles("piercing", 0, 1, 6000);
}

static void row_16_tiles_end_among_edges(void **state) {
  (void)state;
  stop_tiles("edges", 0, 1, 1500);
  stop_tiles("edges", 5, 1, 1500);
  stop_tiles("edges", 1, 3, 1500);
}

static void row_16_tiles_end_among_faces(void **state) {
  (void)state;
  stop_tiles("faces", 0, 1, 1500);
  stop_tiles("faces", 3, 2, 1500);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(row_16_tiles_end_while_they_look_for_piercings),
      cmocka_unit_test(row_16_tiles_end_among_edges),
      cmocka_unit_test(row_16_tiles_end_among_faces),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
