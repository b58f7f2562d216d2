/* test_solvers_agree.c - exact solvers give the same bytes on views in which
 * coincidences are frequent, and with any number of threads. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/degenerate.h"
#include "tests/scenes/pipeline.h"

static recto_status divide_by_box(struct sheet *sheet,
                                  const struct solver_request *request,
                                  struct map *map, struct report *report,
                                  recto_error *error) {
  struct solver_request boxed = *request;
  boxed.divide_by_box = true;
  return solver_warnock.solve(sheet, &boxed, map, report, error);
}

static const struct solver warnock_by_box = {RECTO_METHOD_WARNOCK,
                                             "warnock by box", divide_by_box};

/* The oracle comes first. */
static const struct solver *const exact[] = {&solver_brute,   &solver_newell,
                                             &solver_warnock, &warnock_by_box,
                                             &solver_tiles,   &solver_watkins};

static void assert_same_text(const char *text, size_t length, const char *want,
                             size_t want_length, const char *what, int view,
                             const char *who) {
  if (length != want_length || memcmp(text, want, length) != 0)
    fail_msg("%s, view %d: %s disagrees", what, view, who);
}

static void assert_solvers_agree(const struct scene *scene,
                                 const recto_options *options, const char *name,
                                 int view) {
  size_t first_length, length;
  char *first = pipeline_draw(scene, options, exact[0], &first_length);
  assert_int_equal(strncmp(first, "<?xml", 5), 0);
  for (size_t s = 1; s < sizeof exact / sizeof *exact; s++) {
    char *text = pipeline_draw(scene, options, exact[s], &length);
    assert_same_text(text, length, first, first_length, name, view,
                     exact[s]->name);
    mem_free(text);
  }
  mem_free(first);
}

/* All edges and painted faces of a scene of the list from a degenerate view. */
static void look(const struct scene *scene, recto_options *options, int view) {
  degenerate_view(options, scene, view);
  options->ink.edges = RECTO_EDGES_ALL;
  options->ink.fill = RECTO_FILL_PAINT;
}

/* Each scene from a part of the views, each view of a part of the scenes;
 * every other time lines alone. */
static void solvers_agree_on_degenerate_views(void **state) {
  int number = 0;
  /* Under valgrind a part of that part is what patience allows. */
  int step = getenv("RECTO_VALGRIND") != NULL ? 59 : 5;
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name;
       entry++, number++) {
    struct scene scene;
    recto_options options;
    pipeline_fill(&scene, &options, entry);
    for (int view = number % step; view < DEGENERATE_VIEWS; view += step) {
      look(&scene, &options, view);
      if ((view + number / step) % 2 == 0)
        options.ink.fill = RECTO_FILL_NONE;
      assert_solvers_agree(&scene, &options, entry->name, view);
    }
    scene_fini(&scene);
  }
}

static void bytes_do_not_depend_on_the_threads(void **state) {
  static const int threads[] = {2, 5};
  static const char *const names[] = {"sticks", "globe", "self-intersecting",
                                      "lattice"};
  (void)state;
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    for (size_t s = 1; s < sizeof exact / sizeof *exact; s++) {
      struct scene scene;
      recto_options options;
      size_t length, one_length;
      int view = 37 + (int)i;
      char *one;
      pipeline_fill(&scene, &options, scenes_find(names[i]));
      look(&scene, &options, view);
      one = pipeline_draw(&scene, &options, exact[s], &one_length);
      for (size_t t = 0; t < sizeof threads / sizeof *threads; t++) {
        char *text;
        options.solver.threads = threads[t];
        text = pipeline_draw(&scene, &options, exact[s], &length);
        assert_same_text(text, length, one, one_length, names[i], view,
                         exact[s]->name);
        mem_free(text);
      }
      mem_free(one);
      scene_fini(&scene);
    }
}

/* Where many layers hide them, faces still pierce each other, and hidden lines
 * show it. */
static void hidden_piercings_are_not_behind_a_horizon(void **state) {
  struct scene scene;
  recto_options options;
  (void)state;
  recto_options_init(&options);
  scene_init(&scene);
  scenes_plates(&scene, &options, 200, true);
  build_group(&scene, "hidden");
  for (int i = 0; i < 9; i++) {
    double x = 3 + 2 * (i % 3), y = 2.5 + 1.7 * (i / 3);
    build_parallelogram(&scene, vector_of(x, y, -4), vector_of(0.2, 0, 0),
                        vector_of(0, 0.2, 0));
    build_parallelogram(&scene, vector_of(x + 0.05, y, -5),
                        vector_of(0.1, 0, 0), vector_of(0, 0.2, 2));
  }
  options.ink.hidden = RECTO_HIDDEN_DASHED;
  options.ink.edges = RECTO_EDGE_INTERSECTION;
  assert_solvers_agree(&scene, &options, "layers", 0);
  scene_fini(&scene);
}

/* No two pictures are the same, so the views are what they say. */
static void the_views_are_distinct(void **state) {
  char *text[DEGENERATE_VIEWS];
  size_t length[DEGENERATE_VIEWS];
  struct scene scene;
  recto_options options;
  int same = 0;
  (void)state;
  pipeline_fill(&scene, &options, scenes_find("flaws mixed"));
  for (int view = 0; view < DEGENERATE_VIEWS; view++) {
    look(&scene, &options, view);
    text[view] = pipeline_draw(&scene, &options, &solver_tiles, &length[view]);
    for (int other = 0; other < view; other++)
      same += length[view] == length[other] &&
              memcmp(text[view], text[other], length[view]) == 0;
  }
  assert_int_equal(same, 0);
  for (int view = 0; view < DEGENERATE_VIEWS; view++)
    mem_free(text[view]);
  scene_fini(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_views_are_distinct),
      cmocka_unit_test(solvers_agree_on_degenerate_views),
      cmocka_unit_test(hidden_piercings_are_not_behind_a_horizon),
      cmocka_unit_test(bytes_do_not_depend_on_the_threads),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
