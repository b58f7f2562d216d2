/* test_solvers_agree.c - every exact solver gives brute force's map, to the
 * bit, and drawing, to the byte. */
#include "exact_fixture/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/degenerate.h"
#include "tests/scenes/pipeline.h"
#include "tests/scenes/solver_named.h"
#include "tests/valgrind.h"

static recto_status divide_by_box(struct sheet *sheet,
                                  const struct solver_request *request,
                                  struct map *map, struct report *report,
                                  recto_error *error) {
  struct solver_request boxed = *request;
  boxed.divide_by_box = true;
  return solver_warnock.solve(sheet, &boxed, map, report, error);
}

static const struct solver warnock_by_box = {RECTO_METHOD_WARNOCK,
                                             divide_by_box};

/* The oracle comes first. */
static const struct solver *const exact[] = {&solver_brute,   &solver_newell,
                                             &solver_warnock, &warnock_by_box,
                                             &solver_tiles,   &solver_watkins};
enum { EXACT_COUNT = sizeof exact / sizeof *exact };

/* ---- Maps of sheets ------------------------------------------------------ */

/* A scene, made anew for each solver: solving adds to the sheet. */
struct recipe {
  const int (*corner)[3][3]; /* `count` triangles; NULL: by seed */
  int count;
  uint64_t seed;
};

static void make(struct sheet *sheet, const struct recipe *recipe) {
  uint64_t r = recipe->seed;
  if (recipe->corner == NULL) {
    exact_random_sheet(sheet, (enum exact_kind)(r % EXACT_KINDS),
                       2 + exact_random_below(&r, 12), &r);
    return;
  }
  exact_sheet_init(sheet);
  for (int f = 0; f < recipe->count; f++)
    exact_add_face(sheet, recipe->corner[f], 3, 1);
}

static void solve(const struct solver *solver, const struct recipe *recipe,
                  struct sheet *sheet, struct map *map) {
  const struct solver_request request = {
      .edges = true, .fragments = true, .intersections = true, .threads = 1};
  make(sheet, recipe);
  assert_int_equal(exact_solve_as(solver, &request, sheet, map, NULL),
                   RECTO_OK);
}

static void assert_maps_agree(const struct recipe *recipe, const char *name) {
  struct sheet sheet[2];
  struct map map[2];
  solve(exact[0], recipe, &sheet[0], &map[0]);
  for (int s = 1; s < EXACT_COUNT; s++) {
    char what[128];
    snprintf(what, sizeof what, "%s by %s", name, solver_name(exact[s]));
    solve(exact[s], recipe, &sheet[1], &map[1]);
    exact_assert_same_map(&map[0], &map[1], what);
    map_fini(&map[1]);
    exact_sheet_fini(&sheet[1]);
  }
  map_fini(&map[0]);
  exact_sheet_fini(&sheet[0]);
}

static void solvers_agree_on_hard_sheets(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 600; seed++) {
    const struct recipe recipe = {.seed = seed};
    char name[64];
    snprintf(name, sizeof name, "seed %u", (unsigned)seed);
    assert_maps_agree(&recipe, name);
  }
}

/* One end of the line between faces 0 and 3 is rounded off face 0, behind
 * face 3's neighbour, which Newell's order had painted before. */
static void
an_intersection_rounded_off_its_face_is_tested_against_all(void **state) {
  static const int corner[7][3][3] = {
      {{0, 0, 2}, {1, 0, 1}, {16, 3, 3}}, {{0, 6, 1}, {16, 3, 3}, {0, 0, 2}},
      {{16, 3, 3}, {1, 0, 0}, {0, 0, 0}}, {{0, 3, 0}, {68, 0, 26}, {1, 0, 0}},
      {{0, 0, 0}, {0, 3, 0}, {0, 6, 1}},  {{16, 3, 3}, {0, 6, 1}, {0, 0, 0}},
      {{68, 0, 26}, {1, 0, 0}, {0, 0, 2}}};
  (void)state;
  assert_maps_agree(&(struct recipe){.corner = corner, .count = 7},
                    "a rounded end");
}

/* Faces 1 and 2 end on face 0 at the limit of contact; what was rounded of
 * their line is beyond it, and only brute tested face 0 against it. */
static void an_intersection_is_not_hidden_by_its_own_faces(void **state) {
  static const int corner[3][3][3] = {{{0, 0, 10}, {0, 6, 10}, {24, 7, 154}},
                                      {{25, 7, 153}, {0, 5, 17}, {0, 0, 0}},
                                      {{25, 7, 153}, {0, 5, 17}, {0, 6, 21}}};
  struct sheet sheet;
  struct map map;
  const struct recipe recipe = {.corner = corner, .count = 3};
  bool found = false;
  (void)state;
  assert_maps_agree(&recipe, "a seam");
  solve(&solver_brute, &recipe, &sheet, &map);
  for (size_t e = 0; e < sheet.edge.count; e++)
    if (sheet.edge.item[e].edge_class == RECTO_EDGE_INTERSECTION) {
      assert_int_equal(map.edge_state[e], MAP_VISIBLE);
      found = true;
    }
  assert_true(found);
  map_fini(&map);
  exact_sheet_fini(&sheet);
}

/* ---- Drawings of scenes -------------------------------------------------- */

static void assert_same_text(const char *text, size_t length, const char *want,
                             size_t want_length, const char *what, int view,
                             const char *who) {
  if (length != want_length || memcmp(text, want, length) != 0)
    fail_msg("%s, view %d: %s disagrees", what, view, who);
}

/* Returns whether that is a drawing, and not the text of an error. */
static bool assert_solvers_agree(const struct scene *scene,
                                 const recto_options *options, const char *name,
                                 int view) {
  size_t first_length, length;
  char *first = pipeline_draw(scene, options, exact[0], &first_length);
  bool is_drawing = strncmp(first, "<?xml", 5) == 0;
  for (int s = 1; s < EXACT_COUNT; s++) {
    char *text = pipeline_draw(scene, options, exact[s], &length);
    assert_same_text(text, length, first, first_length, name, view,
                     solver_name(exact[s]));
    mem_free(text);
  }
  mem_free(first);
  return is_drawing;
}

/* Lines alone, hidden ones on a layer of their own, and painted faces. */
static void assert_styles_agree(const struct scene *scene,
                                const recto_options *options,
                                const char *name) {
  recto_options style = *options;
  style.ink.fill = RECTO_FILL_NONE;
  (void)assert_solvers_agree(scene, &style, name, -1);
  style.ink.hidden = RECTO_HIDDEN_LAYER;
  (void)assert_solvers_agree(scene, &style, name, -2);
  style = *options;
  style.ink.fill = RECTO_FILL_PAINT;
  (void)assert_solvers_agree(scene, &style, name, -3);
}

static void solvers_agree_on_the_whole_stability_list(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    recto_options options;
    pipeline_fill(&scene, &options, entry);
    assert_styles_agree(&scene, &options, entry->name);
    scene_fini(&scene);
  }
}

static void solvers_agree_on_2000_random_small_scenes(void **state) {
  (void)state;
  /* Under valgrind a tenth of them is what patience allows. */
  uint64_t count = is_under_valgrind() ? 200 : 2000;
  for (uint64_t seed = 0; seed < count; seed++) {
    struct scene scene;
    recto_options options;
    char name[32];
    snprintf(name, sizeof name, "seed %lu", (unsigned long)seed);
    recto_options_init(&options);
    scene_init(&scene);
    scenes_small(&scene, &options, seed);
    options.ink.min_stroke_mm = 0;
    options.output.precision = 6;
    options.solver.threads = 1;
    assert_styles_agree(&scene, &options, name);
    scene_fini(&scene);
  }
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
  int step = is_under_valgrind() ? 59 : 5;
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
      assert_true(assert_solvers_agree(&scene, &options, entry->name, view));
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
    for (int s = 1; s < EXACT_COUNT; s++) {
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
                         solver_name(exact[s]));
        mem_free(text);
      }
      mem_free(one);
      scene_fini(&scene);
    }
}

/* Where many layers hide them, faces still pierce each other, and hidden lines
 * show it. */
static void hidden_intersections_are_not_culled(void **state) {
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
  assert_true(assert_solvers_agree(&scene, &options, "layers", 0));
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
      cmocka_unit_test(solvers_agree_on_hard_sheets),
      cmocka_unit_test(
          an_intersection_rounded_off_its_face_is_tested_against_all),
      cmocka_unit_test(an_intersection_is_not_hidden_by_its_own_faces),
      cmocka_unit_test(solvers_agree_on_the_whole_stability_list),
      cmocka_unit_test(solvers_agree_on_2000_random_small_scenes),
      cmocka_unit_test(the_views_are_distinct),
      cmocka_unit_test(solvers_agree_on_degenerate_views),
      cmocka_unit_test(hidden_intersections_are_not_culled),
      cmocka_unit_test(bytes_do_not_depend_on_the_threads),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
