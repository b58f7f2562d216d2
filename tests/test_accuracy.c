/* test_accuracy.c - the solvers that process the page line by line, compared
 * with the exact map and with each other, on real meshes: errors fall with the
 * number of lines, the two z-buffers agree, and one of them stores only one
 * line. */
#include "tests/measure/trial.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "exact_fixture/sheet.h"
#include "scene/read.h"
#include "tests/memory_peak.h"
#include "tests/scenes/pipeline.h"
#include "tests/scenes/solver_named.h"

/* Methods with a number of lines or a pitch; those there are are tried. */
static const char *const by_line[] = {"zbuffer", "scanline-zbuffer", "watkins",
                                      NULL};

/* Reads a real mesh and looks at it; false where it is not there. */
static bool open_model(struct scene *scene, recto_options *options,
                       const char *folder, const char *name) {
  char path[1000];
  struct diagnostics silent = {.file = path};
  recto_options_init(options);
  options->camera.azimuth_deg = 30;
  options->camera.elevation_deg = 20;
  options->page.width_mm = options->page.height_mm = 200;
  options->page.margin_mm = 5;
  scene_init(scene);
  if (folder == NULL)
    return false;
  snprintf(path, sizeof path, "%.900s/%s.obj", folder, name);
  return scene_read(scene, path, NULL, &silent, NULL) == RECTO_OK;
}

static bool open_real(struct scene *scene, recto_options *options,
                      const char *name) {
  bool there = open_model(scene, options, getenv("RECTO_MODELS"), name);
  if (!there)
    print_message("no %s\n", name);
  return there;
}

static void open_soup(struct scene *scene, recto_options *options) {
  open_model(scene, options, NULL, "");
  scenes_soup(scene, options, 1000, 1);
  options->page.width_mm = options->page.height_mm = 200;
}

/* ---- Errors -------------------------------------------------------------- */

/* The share that a method gets wrong of the area and of the ink. */
static void measure_errors(const struct scene *scene,
                           const recto_options *options,
                           const struct solver *solver, int lines,
                           const struct trial *truth, double *area,
                           double *ink) {
  struct trial trial;
  struct measure measure;
  trial_run(&trial, scene, options, solver, lines, TRIAL_BOTH);
  assert_int_equal(trial.status, RECTO_OK);
  assert_true(measure_map(&measure, &truth->sheet, &truth->map, &trial.sheet,
                          &trial.map));
  *area = measure_area_share(&measure);
  *ink = measure_ink_share(&measure);
  trial_fini(&trial);
}

/* Four times the lines, a quarter of the wrong area.  The wrong ink falls with
 * every step; it falls as fast once a pixel is smaller than most of what there
 * is: edges that lie less than the bias behind a face. */
static void check_errors(const struct scene *scene,
                         const recto_options *options, const char *name) {
  struct trial truth;
  trial_run(&truth, scene, options, &solver_tiles, 0, TRIAL_BOTH);
  assert_int_equal(truth.status, RECTO_OK);
  for (size_t i = 0; by_line[i] != NULL; i++) {
    const struct solver *solver = solver_named(by_line[i]);
    double area[3], ink[3];
    if (solver == NULL)
      continue;
    for (int k = 0; k < 3; k++)
      measure_errors(scene, options, solver, 128 << (2 * k), &truth, &area[k],
                     &ink[k]);
    for (int k = 1; k < 3; k++)
      if (!(area[k] < 0.32 * area[k - 1] && ink[k] < 0.65 * ink[k - 1]))
        fail_msg("%s by %s at %d lines: %.3g of the area is wrong after %.3g, "
                 "%.3g of the ink after %.3g",
                 name, by_line[i], 128 << (2 * k), area[k], area[k - 1], ink[k],
                 ink[k - 1]);
  }
  trial_fini(&truth);
}

static void errors_fall_with_the_lines_on_a_soup(void **state) {
  struct scene scene;
  recto_options options;
  (void)state;
  open_soup(&scene, &options);
  check_errors(&scene, &options, "a soup of 1,000");
  scene_fini(&scene);
}

static void errors_fall_with_the_lines_on_meshes(void **state) {
  static const char *const name[] = {"spot", "fandisk"};
  (void)state;
  for (size_t i = 0; i < 2; i++) {
    struct scene scene;
    recto_options options;
    if (open_real(&scene, &options, name[i]))
      check_errors(&scene, &options, name[i]);
    scene_fini(&scene);
  }
}

/* From so many lines on, four times as many leave a quarter of the wrong
 * ink. */
static void check_first_order_ink(const struct scene *scene,
                                  const recto_options *options, int lines) {
  struct trial truth;
  struct measure measure[2];
  trial_run(&truth, scene, options, &solver_tiles, 0, TRIAL_EDGES);
  assert_int_equal(truth.status, RECTO_OK);
  for (int k = 0; k < 2; k++) {
    struct trial trial;
    trial_run(&trial, scene, options, &solver_scanline_zbuffer,
              lines << (2 * k), TRIAL_EDGES);
    assert_int_equal(trial.status, RECTO_OK);
    assert_true(measure_map(&measure[k], &truth.sheet, &truth.map, &trial.sheet,
                            &trial.map));
    trial_fini(&trial);
  }
  double ratio =
      measure_ink_share(&measure[1]) / measure_ink_share(&measure[0]);
  if (!(ratio > 0.2 && ratio < 0.32))
    fail_msg("%.3f of the wrong ink is left", ratio);
  trial_fini(&truth);
}

static void wrong_ink_falls_in_first_order_where_pixels_are_fine(void **state) {
  struct scene scene;
  recto_options options;
  (void)state;
  open_soup(&scene, &options);
  check_first_order_ink(&scene, &options, 512);
  scene_fini(&scene);
  if (open_real(&scene, &options, "spot"))
    check_first_order_ink(&scene, &options, 4096);
  scene_fini(&scene);
}

/* No place of the page is given to two fragments, but for corners being
 * rounded. */
static void check_disjoint(const struct scene *scene,
                           const recto_options *options, const char *name) {
  for (int lines = 20; lines <= 500; lines *= 5) {
    struct trial trial;
    struct measure measure;
    trial_run(&trial, scene, options, solver_named("watkins"), lines,
              TRIAL_FRAGMENTS);
    assert_int_equal(trial.status, RECTO_OK);
    assert_true(measure_map(&measure, &trial.sheet, &trial.map, &trial.sheet,
                            &trial.map));
    if (!(measure.twice_area < 1e-6 * measure.true_area))
      fail_msg("%s at %d lines: %g of %g mm2 twice", name, lines,
               measure.twice_area, measure.true_area);
    trial_fini(&trial);
  }
}

static void fragments_between_scan_lines_are_disjoint(void **state) {
  static const char *const name[] = {"spot", "fandisk"};
  struct scene scene;
  recto_options options;
  (void)state;
  open_soup(&scene, &options);
  check_disjoint(&scene, &options, "a soup of 1,000");
  scene_fini(&scene);
  for (size_t i = 0; i < 2; i++) {
    if (open_real(&scene, &options, name[i]))
      check_disjoint(&scene, &options, name[i]);
    scene_fini(&scene);
  }
}

/* ---- Both z-buffers ------------------------------------------------------ */

static void check_agreement(const struct scene *scene,
                            const recto_options *options, int lines) {
  struct trial whole, line;
  trial_run(&whole, scene, options, &solver_zbuffer, lines, TRIAL_BOTH);
  trial_run(&line, scene, options, &solver_scanline_zbuffer, lines, TRIAL_BOTH);
  assert_int_equal(whole.status, RECTO_OK);
  assert_int_equal(line.status, RECTO_OK);
  assert_true(whole.map.fragment.count > 1000);
  exact_assert_same_map(&whole.map, &line.map, "z-buffers");
  trial_fini(&whole);
  trial_fini(&line);
}

static void check_agreement_on(const char *folder, const char *name) {
  static const int bits[] = {0, 16};
  struct scene scene;
  recto_options options;
  if (open_model(&scene, &options, folder, name))
    for (int i = 0; i < 2; i++) {
      options.solver.depth_bits = bits[i];
      check_agreement(&scene, &options, 512);
      check_agreement(&scene, &options, 2048);
    }
  else
    print_message("no %s\n", name);
  scene_fini(&scene);
}

static void z_buffers_agree_on_every_model(void **state) {
  static const char *const own[] = {"castle", "gears", "knot"};
  static const char *const real[] = {"spot",    "fandisk", "cow",
                                     "suzanne", "teapot",  "stanford-bunny"};
  const char *source = getenv("srcdir");
  char folder[600];
  (void)state;
  snprintf(folder, sizeof folder, "%.500s/examples/models",
           source != NULL ? source : ".");
  for (size_t i = 0; i < sizeof own / sizeof *own; i++)
    check_agreement_on(folder, own[i]);
  for (size_t i = 0; i < sizeof real / sizeof *real; i++)
    check_agreement_on(getenv("RECTO_MODELS"), real[i]);
}

/* ---- Memory -------------------------------------------------------------- */

struct page_run {
  const struct solver *solver;
  int lines;
};

/* Puts a face over all of a page that is `lines` high and 512 pixels wide, with
 * nothing to write down. */
static bool cover_page(const void *user) {
  const struct page_run *run = user;
  struct scene scene;
  recto_options options;
  struct trial trial;
  recto_options_init(&options);
  scene_init(&scene);
  build_parallelogram(&scene, vector_of(0, 0, 0), vector_of(51.2, 0, 0),
                      vector_of(0, run->lines / 10.0, 9));
  scenes_view_page(&options, 51.2, run->lines / 10.0);
  trial_run(&trial, &scene, &options, run->solver, run->lines, 0);
  return trial.status == RECTO_OK;
}

static size_t peak_of(const struct solver *solver, int lines) {
  return memory_peak_of(cover_page, &(struct page_run){solver, lines});
}

static void scan_line_memory_does_not_grow_with_the_lines(void **state) {
  enum { FEW = 1024, MANY = 8192 };
  (void)state;
  size_t few = peak_of(&solver_scanline_zbuffer, FEW);
  size_t many = peak_of(&solver_scanline_zbuffer, MANY);
  size_t frame = peak_of(&solver_zbuffer, MANY);
  /* A few pages of the system's are noise; a frame is 12 bytes a pixel. */
  if (many > few + (256 << 10))
    fail_msg("%zu bytes for %d lines, %zu for %d", few, FEW, many, MANY);
  assert_true(frame > many + (size_t)MANY * 512 * 11);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      /* First: a process starts with what its parent had. */
      cmocka_unit_test(scan_line_memory_does_not_grow_with_the_lines),
      cmocka_unit_test(errors_fall_with_the_lines_on_a_soup),
      cmocka_unit_test(errors_fall_with_the_lines_on_meshes),
      cmocka_unit_test(fragments_between_scan_lines_are_disjoint),
      cmocka_unit_test(wrong_ink_falls_in_first_order_where_pixels_are_fine),
      cmocka_unit_test(z_buffers_agree_on_every_model),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
