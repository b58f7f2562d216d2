/* test_ink_merge.c - fragments of one style become one fill, and no point
 * changes its colour. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/read.h"
#include "scene/scene.h"
#include "tests/ink_faults.h"
#include "tests/scenes/pipeline.h"
#include "tests/scenes/random.h"
#include "tests/scenes/solver_named.h"

/* ---- Merged against not merged ------------------------------------------- */

struct both {
  struct pipeline merged, apart; /* the latter with ids: a fill a fragment */
};

/* False where the scene has nothing to draw. */
static bool draw_both(struct both *both, const struct scene *scene,
                      const recto_options *given, const char *method) {
  recto_options options = *given;
  const struct solver *solver = solver_named(method);
  pipeline_run(&both->merged, scene, &options, solver);
  options.ink.ids = true;
  pipeline_run(&both->apart, scene, &options, solver);
  assert_int_equal(both->merged.status, both->apart.status);
  if (both->merged.status != RECTO_ERROR_EMPTY)
    assert_int_equal(both->merged.status, RECTO_OK);
  return both->merged.status == RECTO_OK;
}

static void end_both(struct both *both) {
  pipeline_fini(&both->merged);
  pipeline_fini(&both->apart);
}

/* Signed, so that holes count negative. */
static double area_of(const struct drawing *drawing,
                      const struct drawing_fill *fill) {
  double sum = 0;
  for (uint32_t l = 0; l < fill->loops; l++) {
    const struct drawing_loop *loop = &drawing->loop.item[fill->loop + l];
    const struct drawing_point *p = drawing->point.item + loop->point;
    for (uint32_t i = 0; i < loop->count; i++) {
      struct drawing_point q = p[(i + 1) % loop->count];
      sum += p[i].x * q.y - p[i].y * q.x;
    }
  }
  return sum / 2;
}

/* The total area of a colour. */
static double area_in(const struct drawing *drawing, uint32_t colour) {
  double sum = 0;
  for (size_t i = 0; i < drawing->fill.count; i++)
    if (drawing->fill.item[i].colour == colour)
      sum += area_of(drawing, &drawing->fill.item[i]);
  return sum;
}

static bool is_inside(const struct drawing *drawing,
                      const struct drawing_fill *fill, double x, double y) {
  bool inside = false;
  for (uint32_t l = 0; l < fill->loops; l++) {
    const struct drawing_loop *loop = &drawing->loop.item[fill->loop + l];
    const struct drawing_point *p = drawing->point.item + loop->point;
    for (uint32_t i = 0; i < loop->count; i++) {
      struct drawing_point a = p[i], b = p[(i + 1) % loop->count];
      if ((a.y <= y) != (b.y <= y) &&
          a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x) < x)
        inside = !inside;
    }
  }
  return inside;
}

/* The colour at a place, DRAWING_NONE for paper; it must be painted once. */
static uint32_t colour_at(const struct drawing *drawing, double x, double y) {
  uint32_t colour = DRAWING_NONE;
  for (size_t i = 0; i < drawing->fill.count; i++)
    if (is_inside(drawing, &drawing->fill.item[i], x, y)) {
      assert_int_equal(colour, DRAWING_NONE);
      colour = drawing->fill.item[i].colour;
    }
  return colour;
}

/* The same colours cover the same areas, and random places. */
static void assert_same_paint(const struct both *both, int places) {
  const struct drawing *merged = &both->merged.drawing;
  const struct drawing *apart = &both->apart.drawing;
  struct random random = {.state = 1};
  assert_in_range(merged->fill.count, apart->fill.count > 0, apart->fill.count);
  for (size_t i = 0; i < merged->fill.count; i++) {
    uint32_t colour = merged->fill.item[i].colour;
    assert_true(fabs(area_in(merged, colour) - area_in(apart, colour)) < 1e-2);
    assert_int_not_equal(merged->fill.item[i].loops, 0);
  }
  for (int i = 0; i < places; i++) {
    double x = random_between(&random, 0, merged->width_mm);
    double y = random_between(&random, 0, merged->height_mm);
    assert_int_equal(colour_at(merged, x, y), colour_at(apart, x, y));
  }
}

static void check_paint(const struct scene *scene, recto_options *options,
                        recto_fill fill, int places) {
  struct both both;
  options->ink.fill = fill;
  if (draw_both(&both, scene, options, "tiles") &&
      both.apart.drawing.fill.count > 0)
    assert_same_paint(&both, places);
  end_both(&both);
}

static void scenes_are_painted_as_their_fragments_are(void **state) {
  (void)state;
  for (const struct scenes_entry *e = scene_list; e->name; e++) {
    struct scene scene;
    recto_options options;
    pipeline_fill(&scene, &options, e);
    check_paint(&scene, &options, RECTO_FILL_PAINT, 200);
    check_paint(&scene, &options, RECTO_FILL_SHADE, 200);
    scene_fini(&scene);
  }
}

static void random_scenes_are_painted_as_their_fragments_are(void **state) {
  (void)state;
  for (uint64_t seed = 0; seed < 200; seed++) {
    struct scene scene;
    recto_options options;
    scene_init(&scene);
    recto_options_init(&options);
    scenes_small(&scene, &options, seed);
    options.mesh.crease_deg = seed % 2 == 0 ? 30 : 180;
    check_paint(&scene, &options, RECTO_FILL_PAINT, 50);
    scene_fini(&scene);
  }
}

/* Spans at a pitch overlap a little, their sides leave their edges' lines, and
 * end where no side of a neighbour does. */
static void spans_at_a_pitch_keep_their_area(void **state) {
  (void)state;
  for (unsigned rings = 20; rings <= 60; rings += 20) {
    struct scene scene;
    recto_options options;
    struct both both;
    scene_init(&scene);
    recto_options_init(&options);
    scenes_globe(&scene, &options, rings);
    options.ink.fill = RECTO_FILL_PAINT;
    options.solver.pitch_mm = 0.37;
    assert_true(draw_both(&both, &scene, &options, "watkins"));
    for (size_t i = 0; i < both.merged.drawing.fill.count; i++) {
      uint32_t colour = both.merged.drawing.fill.item[i].colour;
      assert_true(fabs(area_in(&both.merged.drawing, colour) -
                       area_in(&both.apart.drawing, colour)) < 1e-2);
    }
    assert_true(both.merged.drawing.fill.count < both.apart.drawing.fill.count);
    end_both(&both);
    scene_fini(&scene);
  }
}

/* ---- How many ------------------------------------------------------------ */

static void start(struct scene *scene, recto_options *options) {
  scene_init(scene);
  recto_options_init(options);
  options->ink.fill = RECTO_FILL_PAINT;
}

static void draw(struct pipeline *p, struct scene *scene,
                 const recto_options *options) {
  pipeline_run(p, scene, options, solver_named("tiles"));
  assert_int_equal(p->status, RECTO_OK);
  scene_fini(scene);
}

/* The scene is so many fills, of one loop of so many points each. */
static void assert_fills(struct scene *scene, const recto_options *options,
                         size_t fills, uint32_t points) {
  struct pipeline p;
  draw(&p, scene, options);
  assert_int_equal(p.drawing.fill.count, fills);
  for (size_t i = 0; i < fills; i++) {
    const struct drawing_fill *fill = &p.drawing.fill.item[i];
    assert_int_equal(fill->loops, 1);
    assert_int_equal(p.drawing.loop.item[fill->loop].count, points);
  }
  pipeline_fini(&p);
}

static void a_cube_is_three_polygons(void **state) {
  struct scene scene;
  recto_options options;
  (void)state;
  start(&scene, &options);
  scenes_cube(&scene, &options, 0);
  assert_fills(&scene, &options, 3, 4);
}

static void a_box_with_divided_sides_is_one_rectangle_too(void **state) {
  struct scene scene;
  recto_options options;
  (void)state;
  start(&scene, &options);
  scenes_collinear_edges(&scene, &options, 5);
  assert_fills(&scene, &options, 3, 4);
}

static void a_ball_is_one_polygon_whatever_lines_are_drawn(void **state) {
  static const unsigned edges[] = {0, RECTO_EDGE_SILHOUETTE, RECTO_EDGES_ALL};
  (void)state;
  for (size_t i = 0; i < sizeof edges / sizeof *edges; i++) {
    struct scene scene;
    recto_options options;
    struct pipeline p;
    start(&scene, &options);
    scenes_globe(&scene, &options, 20);
    options.ink.edges = edges[i];
    draw(&p, &scene, &options);
    assert_int_equal(p.drawing.fill.count, 1);
    assert_int_equal(p.drawing.fill.item[0].loops, 1);
    pipeline_fini(&p);
  }
}

static void the_crease_angle_separates_fills(void **state) {
  struct scene scene;
  recto_options options;
  (void)state;
  start(&scene, &options);
  scenes_cube(&scene, &options, 0);
  options.mesh.crease_deg = 100;
  assert_fills(&scene, &options, 1, 6);
}

static void groups_are_not_merged(void **state) {
  struct scene scene;
  recto_options options;
  struct pipeline p;
  (void)state;
  start(&scene, &options);
  scenes_two_colours(&scene, &options);
  for (size_t g = 0; g < scene.group.count; g++) {
    scene.group.item[g].has_colour = true; /* the groups alone differ */
    scene.group.item[g].colour = 0xc00000;
  }
  draw(&p, &scene, &options);
  for (size_t i = 0; i < p.drawing.fill.count; i++)
    for (size_t j = 0; j < i; j++)
      if (p.drawing.fill.item[i].group != p.drawing.fill.item[j].group)
        return pipeline_fini(&p);
  fail_msg("one group");
}

static void fandisk_has_fewer_than_60_polygons(void **state) {
  const char *folder = getenv("RECTO_MODELS");
  struct scene scene;
  recto_options options;
  struct pipeline p;
  char path[1000];
  (void)state;
  snprintf(path, sizeof path, "%.900s/fandisk.obj", folder ? folder : "");
  struct diagnostics silent = {.file = path};
  start(&scene, &options);
  if (scene_read(&scene, path, NULL, &silent, NULL) != RECTO_OK) {
    scene_fini(&scene);
    print_message("no fandisk.obj\n");
    skip();
  }
  for (int view = 0; view < 3; view++) {
    options.camera.azimuth_deg = 40 + 100 * view;
    pipeline_run(&p, &scene, &options, solver_named("tiles"));
    assert_int_equal(p.status, RECTO_OK);
    assert_in_range(p.drawing.fill.count, 1, 59);
    pipeline_fini(&p);
  }
  scene_fini(&scene);
}

/* ---- Memory -------------------------------------------------------------- */

static void merging_fails_cleanly_when_memory_runs_out(void **state) {
  struct scene scene;
  recto_options options;
  struct pipeline p;
  (void)state;
  start(&scene, &options);
  scenes_box_on_table(&scene, &options, SCENES_CONTACT_EXACT, 0.1);
  options.mesh.crease_deg = 100;
  pipeline_run(&p, &scene, &options, solver_named("tiles"));
  assert_int_equal(p.status, RECTO_OK);
  ink_fail_each_allocation(&p, &scene, &options);
  scene_fini(&scene);
  pipeline_fini(&p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(scenes_are_painted_as_their_fragments_are),
      cmocka_unit_test(random_scenes_are_painted_as_their_fragments_are),
      cmocka_unit_test(spans_at_a_pitch_keep_their_area),
      cmocka_unit_test(a_cube_is_three_polygons),
      cmocka_unit_test(a_box_with_divided_sides_is_one_rectangle_too),
      cmocka_unit_test(a_ball_is_one_polygon_whatever_lines_are_drawn),
      cmocka_unit_test(the_crease_angle_separates_fills),
      cmocka_unit_test(groups_are_not_merged),
      cmocka_unit_test(fandisk_has_fewer_than_60_polygons),
      cmocka_unit_test(merging_fails_cleanly_when_memory_runs_out),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
