/* test_cancelling.c - long work can be ended in each of its phases. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/clock.h"
#include "tests/polled.h"
#include "tests/scenes/solver_named.h"
#include "tests/sheet_fixture.h"
#include "tests/temporary.h"
#include "tests/valgrind.h"
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

/* Cancels in a stage.  Of several threads others may do all that is left of it,
 * so that the poll does not come. */
static void stop_tiles(const char *stage, int after, int threads, unsigned n) {
  struct sheet_fixture fixture;
  struct map map;
  struct listener listener = {stage, after};
  const struct solver_request request = {.edges = true,
                                         .fragments = true,
                                         .intersections = true,
                                         .threads = threads};
  struct polled polled;
  struct report *report = report_create();
  recto_error error;
  sheet_fixture_start(&fixture);
  scenes_soup(&fixture.scene, &fixture.options, n, 3);
  sheet_fixture_out(&fixture, true);
  map_init(&map);
  polled_begin(&polled, listen, &listener);
  recto_status status =
      solver_tiles.solve(&fixture.sheet, &request, &map, report, &error);
  polled_end(&polled);
  if (threads == 1 || status != RECTO_OK) {
    assert_int_equal(status, RECTO_ERROR_CANCELLED);
    assert_int_equal(error.code, RECTO_ERROR_CANCELLED);
    /* It is not polled again after it cancelled. */
    assert_int_equal(listener.after, -1);
  } else
    assert_true(listener.after >= 0);
  map_fini(&map);
  report_destroy(report);
  sheet_fixture_fini(&fixture);
}

static void tiles_end_while_they_look_for_intersections(void **state) {
  (void)state;
  stop_tiles("intersections", 0, 1, 6000);
}

static void tiles_end_among_edges(void **state) {
  (void)state;
  stop_tiles("edges", 0, 1, 1500);
  stop_tiles("edges", 5, 1, 1500);
  stop_tiles("edges", 1, 3, 1500);
}

static void tiles_end_among_faces(void **state) {
  (void)state;
  stop_tiles("faces", 0, 1, 1500);
  stop_tiles("faces", 3, 2, 1500);
}

/* ---- How soon it is heard ------------------------------------------------ */

/* Stops after a share of a second of the process's time. */
struct patience {
  double start, last, longest;
  bool stopped;
};

static void note_time(struct patience *patience) {
  double now = clock_cpu();
  if (now - patience->last > patience->longest)
    patience->longest = now - patience->last;
  patience->last = now;
}

static bool wait_a_little(void *user, double share, const char *stage) {
  struct patience *patience = user;
  (void)share;
  (void)stage;
  assert_false(patience->stopped);
  note_time(patience);
  patience->stopped = patience->last - patience->start > 0.1;
  return !patience->stopped;
}

/* What is silent for so long, of the process's own time, would not be heard at
 * all in a scene ten times as large.  The most that was seen is 0.9 s, where
 * watkins sorts its pairs: no slow machine comes near the limit. */
enum { SILENCE_S = 20 };

/* Is progress polled often, and does cancelling end the work? */
static bool is_heard(const struct solver *solver, struct sheet_fixture *fixture,
                     const struct solver_request *what) {
  struct patience patience = {.start = clock_cpu(), .last = clock_cpu()};
  struct polled polled;
  struct report *report = report_create();
  recto_status status;
  struct map map;
  recto_error error;
  size_t edges = fixture->sheet.edge.count;
  map_init(&map);
  polled_begin(&polled, wait_a_little, &patience);
  status = solver->solve(&fixture->sheet, what, &map, report, &error);
  polled_end(&polled);
  note_time(&patience);
  map_fini(&map);
  report_destroy(report);
  fixture->sheet.edge.count = edges;
  assert_int_equal(status, patience.stopped ? RECTO_ERROR_CANCELLED : RECTO_OK);
  if (patience.longest >= 1)
    print_message("%s: %.2f s\n", solver_name(solver), patience.longest);
  return patience.longest < (is_under_valgrind() ? 20 : 1) * SILENCE_S;
}

static void hear_all(struct sheet_fixture *fixture) {
  const struct solver_request lines = {.edges = true, .threads = 1},
                              faces = {.fragments = true, .threads = 1},
                              all = {.edges = true,
                                     .fragments = true,
                                     .intersections = true,
                                     .threads = 1},
                              pixels = {.edges = true,
                                        .fragments = true,
                                        .threads = 1,
                                        .resolution = 1000,
                                        .pitch_mm = 0.1};
  sheet_fixture_out(fixture, true);
  for (const struct solver *const *s = solvers(); *s != NULL; s++) {
    assert_true(is_heard(*s, fixture, &lines));
    assert_true(is_heard(*s, fixture, &faces));
    assert_true(is_heard(*s, fixture, &all));
    assert_true(is_heard(*s, fixture, &pixels));
  }
  sheet_fixture_fini(fixture);
}

static void every_method_is_cancelled_among_duplicates(void **state) {
  struct sheet_fixture fixture;
  (void)state;
  sheet_fixture_start(&fixture);
  scenes_duplicates(&fixture.scene, &fixture.options, 10000, false, 1e-8);
  hear_all(&fixture);
}

static void every_method_is_cancelled_in_a_triangle_soup(void **state) {
  struct sheet_fixture fixture;
  (void)state;
  sheet_fixture_start(&fixture);
  scenes_soup(&fixture.scene, &fixture.options, 4000, 9);
  hear_all(&fixture);
}

/* ---- Writing ------------------------------------------------------------- */

static recto_scene *make_square(void) {
  static const double xyz[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  uint32_t corner[4];
  recto_scene *scene;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  for (int i = 0; i < 4; i++)
    assert_int_equal(recto_scene_add_point(scene, xyz[i], &corner[i], NULL),
                     RECTO_OK);
  assert_int_equal(recto_scene_add_face(scene, corner, 4, NULL), RECTO_OK);
  return scene;
}

/* Stops after so many calls. */
static bool stop_after(void *user, double share, const char *stage) {
  int *calls = user;
  (void)share;
  (void)stage;
  return --*calls > 0;
}

/* Stops after so many calls of the stage "write". */
static bool stop_writing(void *user, double share, const char *stage) {
  int *calls = user;
  assert_true(share >= 0 && share <= 1);
  return strcmp(stage, "write") != 0 || --*calls > 0;
}

static void writing_may_be_cancelled_and_leaves_what_was(void **state) {
  (void)state;
  static const char before[] = "as it was";
  recto_scene *scene = make_square();
  recto_options options;
  recto_options_init(&options);
  int calls = 1000;
  options.progress = stop_writing;
  options.user = &calls;
  options.ink.fill = RECTO_FILL_HATCH; /* more than one buffer of SVG */
  options.ink.hatch_pitch_mm = 0.02;
  recto_drawing *drawing;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  const char *path = temporary_file(state, "kept.svg", before, strlen(before));
  size_t files = temporary_count(state);
  for (size_t k = 0; recto_output_format_name(k) != NULL; k++)
    for (int i = 1; i <= 2; i++) {
      const char *format = recto_output_format_name(k);
      recto_error error = {0};
      size_t count;
      calls = i;
      if (i == 2 && strcmp(format, "svg") != 0)
        continue;
      assert_int_equal(
          recto_drawing_write(drawing, path, format, &options, &error),
          RECTO_ERROR_CANCELLED);
      assert_int_equal(calls, 0);
      assert_string_equal(error.text, "cancelled");
      char *kept = temporary_read(path, &count);
      assert_string_equal(kept, before);
      free(kept);
      assert_int_equal(temporary_count(state), files);
    }
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
}

/* Whatever else is wrong, a call that was cancelled says so: this scene is
 * empty, as its points are welded to one. */
static void a_cancelled_call_says_so_before_all_else(void **state) {
  (void)state;
  recto_scene *scene = make_square();
  recto_options options;
  recto_options_init(&options);
  options.mesh.weld = 1e6;
  recto_drawing *drawing;
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_ERROR_EMPTY);
  int calls, refused = 0;
  options.progress = stop_after;
  options.user = &calls;
  for (int n = 1; n < 20; n++) {
    calls = n;
    recto_status status = recto_scene_render(scene, &options, &drawing, NULL);
    assert_int_equal(status,
                     calls <= 0 ? RECTO_ERROR_CANCELLED : RECTO_ERROR_EMPTY);
    refused += calls <= 0;
  }
  assert_true(refused > 0 && refused < 19);
  recto_scene_destroy(scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(tiles_end_while_they_look_for_intersections),
      cmocka_unit_test(tiles_end_among_edges),
      cmocka_unit_test(tiles_end_among_faces),
      cmocka_unit_test(every_method_is_cancelled_among_duplicates),
      cmocka_unit_test(every_method_is_cancelled_in_a_triangle_soup),
      cmocka_unit_test_setup_teardown(
          writing_may_be_cancelled_and_leaves_what_was, temporary_set_up,
          temporary_tear_down),
      cmocka_unit_test(a_cancelled_call_says_so_before_all_else),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
