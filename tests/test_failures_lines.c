/* test_failures_lines.c - what walking the page line by line cannot see, and
 * just that: depths that few bits do not distinguish, faces between two lines.
 */
#include "tests/measure/trial.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/scenes/exact.h"
#include "tests/scenes/pipeline.h"
#include "tests/scenes/solver_named.h"

/* mm^2 of the fragments of a face. */
static double area_of(const struct map *map, uint32_t face) {
  double area = 0;
  for (size_t f = 0; f < map->fragment.count; f++)
    if (map->fragment.item[f].face == face)
      area += measure_fragment_area(map, f);
  return area;
}

/* ---- Depths that few bits do not distinguish ----------------------------- */

/* The near sheet covers 2.5 x 1.5 of the far one's 3 x 2. */
enum { FAR = 2, NEAR = 3 };

/* The share of what the sheets have in common that is given to the far one. */
static double fighting_share(const struct solver *solver, int lines, int bits,
                             double gap) {
  struct scene scene;
  recto_options options;
  struct trial trial;
  double share;
  recto_options_init(&options);
  scene_init(&scene);
  scenes_near_sheets(&scene, &options, gap);
  options.solver.depth_bits = bits;
  trial_run(&trial, &scene, &options, solver, lines, TRIAL_FRAGMENTS);
  assert_int_equal(trial.status, RECTO_OK);
  share = (area_of(&trial.map, FAR) / (trial.camera.s * trial.camera.s) -
           (3 * 2 - 2.5 * 1.5)) /
          (2.5 * 1.5);
  trial_fini(&trial);
  scene_fini(&scene);
  return share;
}

static void exact_methods_distinguish_near_sheets(void **state) {
  (void)state;
  for (const struct solver *const *s = solvers(); *s != NULL; s++)
    for (double gap = 1e-3; is_exact(*s) && gap > 0.9e-9; gap /= 10)
      if (!(fabs(fighting_share(*s, 0, 0, gap)) < 1e-6))
        fail_msg("%s at %g: %g", solver_name(*s), gap,
                 fighting_share(*s, 0, 0, gap));
}

/* What is seen of all outlines, in scene units: 2 of each mark, 10 of the near
 * sheet; of the far one's 10, 2.5 and 1.5 are behind the near one. */
static void lines_behind_a_near_sheet_are_hidden(void **state) {
  (void)state;
  for (const struct solver *const *s = solvers(); *s != NULL; s++)
    for (double gap = 1e-3; is_exact(*s) && gap > 0.9e-9; gap /= 10) {
      struct scene scene;
      recto_options options;
      struct trial trial;
      struct measure m;
      recto_options_init(&options);
      scene_init(&scene);
      scenes_near_sheets(&scene, &options, gap);
      trial_run(&trial, &scene, &options, *s, 0, TRIAL_EDGES);
      assert_int_equal(trial.status, RECTO_OK);
      assert_true(
          measure_map(&m, &trial.sheet, &trial.map, &trial.sheet, &trial.map));
      if (!(fabs(m.true_ink / trial.camera.s - 20) < 1e-6))
        fail_msg("%s at %g: %g", solver_name(*s), gap,
                 m.true_ink / trial.camera.s);
      trial_fini(&trial);
      scene_fini(&scene);
    }
}

/* Where the two are on one level the earlier one stays, which is the far one:
 * with levels 2^-B of the depth and the sheets aslant, 1 - gap 2^B of the
 * pixels, and none where the gap is a level or more. */
static void few_depth_bits_cause_z_fighting(void **state) {
  static const struct solver *const both[] = {&solver_zbuffer,
                                              &solver_scanline_zbuffer};
  static const int bits[] = {16, 24, 32};
  (void)state;
  for (int s = 0; s < 2; s++)
    for (double gap = 1e-3; gap > 0.9e-9; gap /= 10) {
      double share = fighting_share(both[s], 300, 0, gap);
      if (!(fabs(share) < 0.02))
        fail_msg("%g apart, float64: %g is wrong", gap, share);
      for (int b = 0; b < 3; b++) {
        double want = fmax(0, 1 - ldexp(gap, bits[b]));
        share = fighting_share(both[s], 300, bits[b], gap);
        if (!(fabs(share - want) < 0.04))
          fail_msg("%g apart, %d bits: %g is wrong, not %g", gap, bits[b],
                   share, want);
      }
    }
}

/* ---- Faces between two lines --------------------------------------------- */

enum { LINES = 100, BARS = 60 };

/* A bar across the page, in mm; the lines are 1 mm apart. */
struct bar {
  double low, high;
};

static struct bar bar_at(int i) {
  /* From a fiftieth of a pitch to a bit above one, anywhere between lines. */
  double low = 3 + 1.5 * i + 0.37 * (i % 7), thick = 0.02 + 0.018 * i;
  return (struct bar){low, low + thick};
}

static int centres_in(struct bar bar) {
  return (int)(ceil(bar.high - 0.5) - ceil(bar.low - 0.5));
}

/* fine  down to 1 / 32768 mm thick, all at their low sides */
static void fill_bars(struct scene *scene, recto_options *options, bool ok) {
  recto_options_init(options);
  scene_init(scene);
  for (int i = 0; i < BARS; i++) {
    struct bar bar = bar_at(i);
    double thick = ok ? ldexp(1, -i % 16) : bar.high - bar.low;
    build_parallelogram(scene, vector_of(20, bar.low, 0), vector_of(50, 0, 0),
                        vector_of(0, thick, 0));
  }
  scenes_view_page(options, 100, LINES);
}

/* Bars between two lines are missed, all others are seen on as many lines as
 * pass through them, and none that is a pitch thick is missed. */
static void
what_is_thinner_than_the_pitch_is_missed_and_only_that(void **state) {
  static const char *const name[] = {"zbuffer", "scanline-zbuffer", "warnock",
                                     "watkins"};
  struct scene scene;
  recto_options options;
  int missed = 0, seen = 0;
  (void)state;
  fill_bars(&scene, &options, false);
  for (size_t m = 0; m < sizeof name / sizeof *name; m++) {
    const struct solver *solver = solver_named(name[m]);
    struct trial trial;
    if (solver == NULL)
      continue;
    trial_run(&trial, &scene, &options, solver, LINES, TRIAL_FRAGMENTS);
    assert_int_equal(trial.status, RECTO_OK);
    for (int i = 0; i < BARS; i++) {
      struct bar bar = bar_at(i);
      int want = centres_in(bar);
      double got = area_of(&trial.map, (uint32_t)i) / 50;
      if (!(fabs(got - want) < 1e-3))
        fail_msg("%s: a bar from %.3f to %.3f is seen on %.3f lines, not %d",
                 name[m], bar.low, bar.high, got, want);
      assert_true(want > 0 || bar.high - bar.low < 1);
      missed += want == 0;
      seen += want > 0;
    }
    trial_fini(&trial);
  }
  scene_fini(&scene);
  assert_true(missed > BARS / 4 && seen > BARS / 4);
}

/* The exact methods miss none of them. */
static void exact_methods_see_the_thinnest(void **state) {
  struct scene scene;
  recto_options options;
  (void)state;
  fill_bars(&scene, &options, true);
  for (const struct solver *const *s = solvers(); *s != NULL; s++) {
    struct trial trial;
    if (!is_exact(*s))
      continue;
    trial_run(&trial, &scene, &options, *s, 0, TRIAL_FRAGMENTS);
    assert_int_equal(trial.status, RECTO_OK);
    for (int i = 0; i < BARS; i++)
      assert_true(area_of(&trial.map, (uint32_t)i) > 0);
    trial_fini(&trial);
  }
  scene_fini(&scene);
}

/* ---- The near plane ------------------------------------------------------ */

/* A plate that rises from z = 0 to 10 across the page, before one at -1; what
 * is above z = 4 is cut away: 40 of its 100 mm stay. */
static void a_near_plane_cuts_away_what_is_nearer(void **state) {
  static const char *const name[] = {"zbuffer", "scanline-zbuffer", "warnock",
                                     "watkins", "tiles"};
  struct scene scene;
  recto_options options;
  (void)state;
  recto_options_init(&options);
  scene_init(&scene);
  build_parallelogram(&scene, vector_of(0, 0, 0), vector_of(100, 0, 10),
                      vector_of(0, 100, 0));
  build_parallelogram(&scene, vector_of(0, 0, -1), vector_of(100, 0, 0),
                      vector_of(0, 100, 0));
  scenes_view_page(&options, 100, 100);
  options.camera.near_distance = 1000 - 4; /* from the eye */
  for (size_t m = 0; m < sizeof name / sizeof *name; m++) {
    const struct solver *solver = solver_named(name[m]);
    struct trial trial;
    trial_run(&trial, &scene, &options, solver, is_exact(solver) ? 0 : 100,
              TRIAL_FRAGMENTS);
    assert_int_equal(trial.status, RECTO_OK);
    if (!(fabs(area_of(&trial.map, 0) - 4000) < 1e-3 &&
          fabs(area_of(&trial.map, 1) - 6000) < 1e-3))
      fail_msg("%s: %g and %g mm2", name[m], area_of(&trial.map, 0),
               area_of(&trial.map, 1));
    trial_fini(&trial);
  }
  scene_fini(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(exact_methods_distinguish_near_sheets),
      cmocka_unit_test(lines_behind_a_near_sheet_are_hidden),
      cmocka_unit_test(few_depth_bits_cause_z_fighting),
      cmocka_unit_test(what_is_thinner_than_the_pitch_is_missed_and_only_that),
      cmocka_unit_test(exact_methods_see_the_thinnest),
      cmocka_unit_test(a_near_plane_cuts_away_what_is_nearer),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
