/* test_camera_turns.c - a small move of the camera changes a drawing as little;
 * where it changes by more, edges or faces are there to name whose topology
 * changed. */
#include "tests/measure/turns.h"
#include "tests/valgrind.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Of each kind and decade; `make turns` makes 200. */
enum { EACH = 50, EACH_SLOW = 2, SMALLEST = -12, LARGEST = -3 };

/* A move by a share changes lengths and areas by so many of it at most; below,
 * the grid's step moves the ends of lines. */
static const double RATE = 8, GRID_SHARE = 4e-6;

/* What one move did. */
static void take_move(const struct scene *scene, const recto_options *options,
                      enum turn_kind kind, double by, uint64_t seed,
                      const struct trial *before, struct turn_change *change) {
  struct random random = {seed};
  recto_options moved;
  struct trial after;
  turn_camera(&moved, options, kind, by, &random);
  trial_run(&after, scene, &moved, &solver_tiles, 0, TRIAL_BOTH);
  assert_int_equal(after.status, RECTO_OK);
  assert_true(turn_compare(change, before, &after));
  trial_fini(&after);
}

static unsigned count_names(const char *names) {
  unsigned count = *names != '\0';
  for (; (names = strstr(names, "; ")) != NULL; names++)
    count++;
  return count;
}

/* Returns how many jumps there were. */
static int check_scene(int index) {
  struct scene scene;
  recto_options options;
  struct trial before;
  int jumps = 0, each = is_under_valgrind() ? EACH_SLOW : EACH;
  turn_scene(&scene, &options, index);
  trial_run(&before, &scene, &options, &solver_tiles, 0, TRIAL_BOTH);
  assert_int_equal(before.status, RECTO_OK);
  for (int decade = SMALLEST; decade <= LARGEST; decade++)
    for (int i = 0; i < each * TURN_KINDS; i++) {
      double by = pow(10, decade), most = RATE * by + GRID_SHARE;
      struct turn_change change;
      take_move(&scene, &options, (enum turn_kind)(i % TURN_KINDS), by,
                (uint64_t)(i + 1), &before, &change);
      if (change.same_length > most || change.same_area > most)
        fail_msg("%s, moved by 1e%d: a change of %g of the length and %g of "
                 "the area without one of topology",
                 turn_scenes[index].name, decade, change.same_length,
                 change.same_area);
      if (change.length <= most && change.area <= most)
        continue;
      jumps++;
      if (change.edges + change.faces == 0 ||
          count_names(change.named) != change.edges + change.faces)
        fail_msg("%s, moved by 1e%d: a jump that nothing explains",
                 turn_scenes[index].name, decade);
      print_message("%s, moved by 1e%d: %g of the length, %g of the area: %s\n",
                    turn_scenes[index].name, decade, change.length, change.area,
                    change.named);
    }
  trial_fini(&before);
  scene_fini(&scene);
  return jumps;
}

/* But for the last one, whose eye is in the plane of a face. */
static void a_small_move_changes_little(void **state) {
  (void)state;
  for (int i = 0; i + 1 < TURN_SCENES; i++)
    assert_int_equal(check_scene(i), 0);
}

static void jumps_out_of_a_plane_are_named(void **state) {
  (void)state;
  assert_true(check_scene(TURN_SCENES - 1) > 0);
}

/* ---- The comparison itself ----------------------------------------------- */

/* A wall, and a plate before it that covers part of its upper edge; then all
 * of it. */
static void see_wall(struct trial *trial, double width) {
  struct scene scene;
  recto_options options;
  recto_options_init(&options);
  scene_init(&scene);
  build_parallelogram(&scene, vector_of(10, 10, 0), vector_of(20, 0, 0),
                      vector_of(0, 20, 0));
  build_parallelogram(&scene, vector_of(15, 25, 5), vector_of(width, 0, 0),
                      vector_of(0, 10, 0));
  scenes_view_page(&options, 60, 60);
  trial_run(trial, &scene, &options, &solver_tiles, 0, TRIAL_BOTH);
  assert_int_equal(trial->status, RECTO_OK);
  scene_fini(&scene);
}

static void changes_are_measured_and_named(void **state) {
  struct trial narrow, wider, across;
  struct turn_change change;
  (void)state;
  see_wall(&narrow, 5);
  see_wall(&wider, 6);
  see_wall(&across, 30);
  assert_true(turn_compare(&change, &narrow, &narrow));
  assert_true(change.length == 0 && change.area == 0);
  assert_int_equal(change.edges + change.faces, 0);
  /* 1 mm more of the wall's upper edge is hidden, and two edges of the plate
   * are 1 mm longer, of 105 mm; 5 mm^2 more of the wall are, and the plate is
   * 10 mm^2 larger, of 425. */
  assert_true(turn_compare(&change, &narrow, &wider));
  assert_true(fabs(change.length - 3 / 105.0) < 1e-6);
  assert_true(fabs(change.area - 15 / 425.0) < 1e-6);
  assert_true(change.same_length == change.length);
  assert_int_equal(change.edges + change.faces, 0);
  /* Now the wall's right edge is partly hidden too, and its upper one ends
   * there. */
  assert_true(turn_compare(&change, &narrow, &across));
  assert_int_equal(change.edges, 2);
  assert_int_equal(change.faces, 1);
  assert_true(change.same_length < change.length);
  assert_string_equal(change.named, "edge 1-2 is seen in other parts; "
                                    "edge 2-3 is seen in other parts; "
                                    "face 0 is seen in other parts");
  trial_fini(&narrow);
  trial_fini(&wider);
  trial_fini(&across);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(changes_are_measured_and_named),
      cmocka_unit_test(a_small_move_changes_little),
      cmocka_unit_test(jumps_out_of_a_plane_are_named),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
