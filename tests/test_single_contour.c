/* test_single_contour.c - if single_contour.h decides that nothing is hidden,
 * that is so, to the last bit; where more is needed, it does not decide. */
#include "exact_fixture/sheet.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/scenes/pipeline.h"
#include "view/layout.h"
#include "tests/scenes/random.h"
#include "visibility/single_contour/single_contour.h"

static struct solver_request everything(void) {
  return (struct solver_request){.strokes = true,
                                 .fragments = true,
                                 .exact_corners = true,
                                 .hidden = true,
                                 .intersections = true,
                                 .threads = 1};
}

static struct solver_request lines_alone(void) {
  return (struct solver_request){.strokes = true, .threads = 1};
}

/* A scene up to its sheet, as pipeline_run makes it. */
struct drawn {
  struct scene scene;
  recto_options options;
  struct topology topology;
  struct camera camera;
  struct sheet sheet;
};

static void drawn_init(struct drawn *drawn) {
  memset(drawn, 0, sizeof *drawn);
  recto_options_init(&drawn->options);
  scene_init(&drawn->scene);
}

/* outlines  every edge is on the sheet, as fragments need it */
static void project(struct drawn *drawn, bool outlines) {
  recto_error *none = NULL;
  assert_int_equal(topology_init(&drawn->topology, &drawn->scene, none),
                   RECTO_OK);
  assert_int_equal(
      camera_aim(&drawn->camera, &drawn->scene, &drawn->options, none),
      RECTO_OK);
  assert_int_equal(layout_sheet(&drawn->sheet, &drawn->scene, &drawn->topology,
                                &drawn->camera, &drawn->options, outlines,
                                none),
                   RECTO_OK);
}

static void drawn_fini(struct drawn *drawn) {
  sheet_fini(&drawn->sheet);
  topology_fini(&drawn->topology);
  scene_fini(&drawn->scene);
}

/* n x n quads over a square, bent up and down and to the side at random. */
static void add_sheet(struct drawn *drawn, unsigned n, double bend,
                      uint64_t seed) {
  struct random random = {seed};
  uint32_t first = (uint32_t)drawn->scene.point.count;
  for (unsigned y = 0; y <= n; y++)
    for (unsigned x = 0; x <= n; x++) {
      bool incidence = x == 0 || y == 0 || x == n || y == n;
      double aside = incidence ? 0 : bend;
      build_point(&drawn->scene, x + random_between(&random, -aside, aside),
                  y + random_between(&random, -aside, aside),
                  random_between(&random, 0, 3));
    }
  build_grid(&drawn->scene, first, n, n, seed % 2 == 0);
  scenes_view_above(&drawn->options);
  drawn->options.edges = RECTO_EDGES_ALL;
}

static void assert_as_by_brute(struct drawn *drawn,
                               const struct solver_request *request) {
  struct map map, want;
  struct report *report = report_create();
  map_init(&map);
  map_init(&want);
  assert_int_equal(exact_solve_as(&solver_single_contour, request,
                                  &drawn->sheet, &map, report),
                   RECTO_OK);
  assert_int_equal(
      exact_solve_as(&solver_brute, request, &drawn->sheet, &want, report),
      RECTO_OK);
  exact_assert_same_map(&map, &want, "outline");
  map_fini(&map);
  map_fini(&want);
  report_destroy(report);
}

/* ---- One layer ----------------------------------------------------------- */

static void one_layer_is_all_visible(void **state) {
  const struct solver_request request = everything();
  int decided = 0;
  (void)state;
  for (uint64_t seed = 0; seed < 60; seed++) {
    struct drawn drawn;
    drawn_init(&drawn);
    /* From a third of a cell on some cells fold. */
    add_sheet(&drawn, 1 + (unsigned)(seed % 7), 0.012 * (double)seed, seed);
    project(&drawn, true);
    if (single_contour_suffices(&drawn.sheet, &request)) {
      decided++;
      assert_as_by_brute(&drawn, &request);
    } else {
      assert_true(seed > 20);
    }
    drawn_fini(&drawn);
  }
  assert_true(decided > 20 && decided < 60);
}

static void auto_selects_it(void **state) {
  const struct solver_request request = everything();
  struct drawn drawn;
  const char *why = NULL;
  (void)state;
  drawn_init(&drawn);
  add_sheet(&drawn, 12, 0.2, 3);
  project(&drawn, true);
  assert_ptr_equal(solver_choose(&drawn.sheet, &request, &why),
                   &solver_single_contour);
  assert_non_null(strstr(why, "outline"));
  drawn_fini(&drawn);
}

typedef void spoil_fn(struct drawn *drawn);

/* Does it decide a sheet of 4 x 4 quads after a change by `spoil`? */
static bool decides_spoilt(spoil_fn *spoil) {
  const struct solver_request request = everything();
  struct drawn drawn;
  bool decided;
  drawn_init(&drawn);
  add_sheet(&drawn, 4, 0, 1);
  spoil(&drawn);
  project(&drawn, true);
  decided = single_contour_suffices(&drawn.sheet, &request);
  drawn_fini(&drawn);
  return decided;
}

static void leave(struct drawn *drawn) { (void)drawn; }

static void add_lid(struct drawn *drawn) {
  build_parallelogram(&drawn->scene, vector_of(1, 1, 9), vector_of(1, 0, 0),
                      vector_of(0, 1, 0));
}

static void add_beside(struct drawn *drawn) {
  build_parallelogram(&drawn->scene, vector_of(5, 1, 0), vector_of(1, 0, 0),
                      vector_of(0, 1, 0));
}

static void add_wire(struct drawn *drawn) {
  uint32_t p = build_point(&drawn->scene, 1, 1, -1),
           q = build_point(&drawn->scene, 3, 2, -1);
  build_segment(&drawn->scene, p, q);
}

static void add_wall(struct drawn *drawn) {
  uint32_t p = build_point(&drawn->scene, 0, 0, 9);
  build_triangle(&drawn->scene, 0, 1, p); /* seen edge-on */
}

static void add_fin(struct drawn *drawn) {
  uint32_t p = build_point(&drawn->scene, 2.2, 2.3, 9);
  build_triangle(&drawn->scene, 6, 7, p);
}

static void fold(struct drawn *drawn) {
  drawn->scene.point.item[6].x = 2.7; /* past its neighbours */
}

static void fold_the_rim(struct drawn *drawn) {
  drawn->scene.point.item[2].y = -2; /* a dent seen from the middle */
  drawn->scene.point.item[1].x = 2.5;
}

static void cut(struct drawn *drawn) {
  drawn->options.has_section = true;
  drawn->options.section = 998;
}

static void other_sheets_are_not_single_contours(void **state) {
  static spoil_fn *const spoil[] = {add_lid, add_beside, add_wire,    add_wall,
                                    add_fin, fold,       fold_the_rim};
  (void)state;
  assert_true(decides_spoilt(leave));
  for (size_t i = 0; i < sizeof spoil / sizeof *spoil; i++)
    if (decides_spoilt(spoil[i]))
      fail_msg("spoilt in way %d", (int)i);
}

static void clipped_sheets_are_not_single_contours(void **state) {
  (void)state;
  assert_false(decides_spoilt(cut));
}

/* ---- Two layers ---------------------------------------------------------- */

static void a_convex_body_has_its_outline(void **state) {
  struct solver_request request = lines_alone();
  struct drawn drawn;
  (void)state;
  drawn_init(&drawn);
  scenes_globe(&drawn.scene, &drawn.options, 12);
  drawn.options.edges = RECTO_EDGE_SILHOUETTE | RECTO_EDGE_CREASE;
  project(&drawn, false);
  assert_true(single_contour_suffices(&drawn.sheet, &request));
  assert_as_by_brute(&drawn, &request);
  request.fragments = true;
  assert_false(single_contour_suffices(&drawn.sheet, &request));
  request = lines_alone();
  request.intersections = true;
  assert_false(single_contour_suffices(&drawn.sheet, &request));
  drawn_fini(&drawn);
}

static void what_is_drawn_within_the_limit_is_not_reported(void **state) {
  const struct solver_request request = lines_alone();
  struct drawn drawn;
  (void)state;
  drawn_init(&drawn);
  scenes_globe(&drawn.scene, &drawn.options, 12);
  drawn.options.edges = RECTO_EDGES_ALL & ~(unsigned)RECTO_EDGE_INTERSECTION;
  project(&drawn, false);
  assert_false(single_contour_suffices(&drawn.sheet, &request));
  drawn_fini(&drawn);
}

/* A double pyramid whose near tip is pushed through its far sides: the page
 * does not see it, and its outline is the same. */
static void add_pyramids(struct drawn *drawn, double tip) {
  static const double incidence[][2] = {{-2, -1}, {3, -1}, {2, 2}, {-1, 3}};
  uint32_t near, far;
  for (int k = 0; k < 4; k++)
    build_point(&drawn->scene, incidence[k][0], incidence[k][1], 0);
  near = build_point(&drawn->scene, 0.3, 0.4, tip);
  far = build_point(&drawn->scene, 1, 1, -1);
  for (uint32_t k = 0; k < 4; k++) {
    build_triangle(&drawn->scene, k, (k + 1) % 4, near);
    build_triangle(&drawn->scene, (k + 1) % 4, k, far);
  }
  scenes_view_above(&drawn->options);
  drawn->options.edges = RECTO_EDGES_ALL;
}

static void the_page_alone_does_not_separate_front_from_back(void **state) {
  const struct solver_request request = everything(), lines = lines_alone();
  size_t contours[2];
  (void)state;
  for (int through = 0; through < 2; through++) {
    struct drawn drawn;
    drawn_init(&drawn);
    add_pyramids(&drawn, through ? -0.95 : 1);
    project(&drawn, true);
    contours[through] = drawn.sheet.contour.count;
    assert_false(single_contour_suffices(&drawn.sheet, &request));
    assert_false(single_contour_suffices(&drawn.sheet, &lines));
    drawn_fini(&drawn);
  }
  assert_int_equal(contours[0], 4);
  assert_int_equal(contours[1], 4);
}

/* ---- Memory -------------------------------------------------------------- */

static void without_memory_nothing_is_classified(void **state) {
  const struct solver_request request = everything();
  struct drawn drawn;
  unsigned long n = 0;
  bool decided = false;
  (void)state;
  drawn_init(&drawn);
  add_sheet(&drawn, 4, 0, 1);
  project(&drawn, true);
  while (!decided) {
    assert_true(++n < 10);
    mem_fail_after(n);
    decided = single_contour_suffices(&drawn.sheet, &request);
    mem_fail_after(0);
  }
  assert_true(n > 3);
  drawn_fini(&drawn);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_layer_is_all_visible),
      cmocka_unit_test(auto_selects_it),
      cmocka_unit_test(other_sheets_are_not_single_contours),
      cmocka_unit_test(clipped_sheets_are_not_single_contours),
      cmocka_unit_test(a_convex_body_has_its_outline),
      cmocka_unit_test(what_is_drawn_within_the_limit_is_not_reported),
      cmocka_unit_test(the_page_alone_does_not_separate_front_from_back),
      cmocka_unit_test(without_memory_nothing_is_classified),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
