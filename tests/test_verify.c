/* test_verify.c - right drawings pass, and one that was changed is rejected
 * with an example. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "api/handle.h"
#include "api/verify.h"
#include "ink/ink.h"
#include "scene/read.h"
#include "tests/memory_faults.h"
#include "tests/scenes/catmull_clark.h"
#include "tests/scenes/pipeline.h"
#include "tests/temporary.h"
#include "tests/valgrind.h"
#include "view/camera_aim.h"

/* ---- Helpers ------------------------------------------------------------- */

/* A scene, the results of the pipeline, and the verdict. */
struct judged_run {
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  recto_error error;
  char summary[VERIFY_SUMMARY_SIZE];
};

static void start(struct judged_run *run) {
  memset(run, 0, sizeof *run);
  scene_init(&run->scene);
  recto_options_init(&run->options);
  run->options.verify = 2000;
}

static void draw(struct judged_run *run) {
  pipeline_run(&run->pipeline, &run->scene, &run->options, &solver_newell);
  if (run->pipeline.status != RECTO_OK)
    fail_msg("%s", run->pipeline.error.text);
}

static recto_status verify_run(struct judged_run *run, int exponent) {
  struct pipeline *p = &run->pipeline;
  const struct verify verify = {&run->scene,   exponent, &p->camera,
                                &p->sheet,     &p->map,  &p->drawing,
                                &run->options, NULL};
  run->summary[0] = '\0';
  struct verify_counts counts;
  recto_status status =
      verify_drawing(&verify, p->report, &counts, &run->error);
  if (status == RECTO_OK)
    verify_summarise(run->summary, &counts);
  return status;
}

static void end(struct judged_run *run) {
  pipeline_fini(&run->pipeline);
  scene_fini(&run->scene);
}

static void assert_right(struct judged_run *run, const char *name) {
  if (verify_run(run, 0) != RECTO_OK)
    fail_msg("%s: %s", name, run->error.text);
  assert_memory_equal(run->summary, "verified: ", 10);
}

static int64_t count_of(const struct judged_run *run, const char *name) {
  return report_get(run->pipeline.report, "verify", name, -1);
}

/* Draws again, after the map was changed. */
static void ink_again(struct judged_run *run) {
  struct pipeline *p = &run->pipeline;
  drawing_fini(&p->drawing);
  drawing_init(&p->drawing);
  assert_int_equal(ink_draw(&p->drawing, &p->sheet, &run->scene, &p->map,
                            &run->options, NULL),
                   RECTO_OK);
}

/* A plate of 10 x 10, face 0 of points 0 to 3, behind one of 30 x 30, face 1;
 * 1 mm a unit, the middle of both in the middle of the page of 100 mm. */
static void start_plates(struct judged_run *run) {
  start(run);
  recto_options *o = &run->options;
  build_parallelogram(&run->scene, vector_of(-5, -5, 0), vector_of(10, 0, 0),
                      vector_of(0, 10, 0));
  build_parallelogram(&run->scene, vector_of(-15, -15, 4), vector_of(30, 0, 0),
                      vector_of(0, 30, 0));
  o->camera.azimuth_deg = o->camera.elevation_deg = 0;
  o->camera.fit = RECTO_FIT_SCALE;
  o->page.width_mm = o->page.height_mm = 100;
}

/* The sheet's edge between two points of the scene. */
static uint32_t edge_between(const struct judged_run *run, uint32_t a,
                             uint32_t b) {
  const struct pipeline *p = &run->pipeline;
  for (uint32_t i = 0; i < p->sheet.edge.count; i++) {
    const uint32_t *end =
        p->topology.edge.item[p->sheet.edge.item[i].source].point;
    if ((end[0] == a && end[1] == b) || (end[0] == b && end[1] == a))
      return i;
  }
  fail_msg("no edge from %u to %u", a, b);
  return 0;
}

/* ---- Right drawings ------------------------------------------------------ */

static void the_stability_list_passes(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct judged_run run;
    memset(&run, 0, sizeof run);
    pipeline_fill(&run.scene, &run.options, entry);
    run.options.verify = 3000;
    draw(&run);
    assert_right(&run, entry->name);
    end(&run);
  }
}

/* With all that ink does: short lines dropped, points left out, hidden lines
 * dashed, hatching, another order. */
static void what_ink_does_is_no_fault(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct judged_run run;
    memset(&run, 0, sizeof run);
    pipeline_fill(&run.scene, &run.options, entry);
    run.options.verify = 1000;
    run.options.ink.min_stroke_mm = 3;
    run.options.ink.simplify_mm = 0.05;
    run.options.ink.hidden = RECTO_HIDDEN_DASHED;
    run.options.ink.fill = RECTO_FILL_HATCH;
    run.options.ink.order = RECTO_ORDER_NEAR;
    draw(&run);
    assert_right(&run, entry->name);
    end(&run);
  }
}

/* Nor what it makes of lines that a coarse output does not distinguish. */
static void coarse_outputs_pass(void **state) {
  static const double unit_mm[] = {0.1, 1};
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++)
    for (int i = 0; i < 2; i++) {
      struct judged_run run;
      memset(&run, 0, sizeof run);
      pipeline_fill(&run.scene, &run.options, entry);
      run.options.verify = 20000;
      run.options.output.unit_mm = unit_mm[i];
      draw(&run);
      assert_right(&run, entry->name);
      end(&run);
    }
}

static void random_small_scenes_pass(void **state) {
  (void)state;
  for (uint64_t seed = 1000; seed < 1200; seed++) {
    struct judged_run run;
    char name[32];
    start(&run);
    scenes_small(&run.scene, &run.options, seed);
    run.options.verify = 500;
    run.options.solver.contact = -1;
    snprintf(name, sizeof name, "seed %lu", (unsigned long)seed);
    pipeline_run(&run.pipeline, &run.scene, &run.options, &solver_newell);
    if (run.pipeline.status == RECTO_OK)
      assert_right(&run, name);
    end(&run);
  }
}

static void cuts_and_far_origins_pass(void **state) {
  (void)state;
  static const double place[] = {0, 1e7};
  for (int perspective = 0; perspective < 2; perspective++)
    for (int near_plane = 0; near_plane < 2; near_plane++)
      for (size_t i = 0; i < 2; i++) {
        struct judged_run run;
        start(&run);
        double x = place[i];
        build_box(&run.scene, vector_of(x, x, -x),
                  vector_of(x + 4, x + 5, 6 - x));
        build_box(&run.scene, vector_of(x + 1, x + 1, 1 - x),
                  vector_of(x + 9, x + 2, 2 - x));
        run.options.camera.fov_deg = perspective * 40;
        run.options.mesh.coordinate_bits = 53;
        struct camera camera;
        assert_int_equal(camera_aim(&camera, &run.scene, &run.options, NULL),
                         RECTO_OK);
        if (near_plane)
          run.options.camera.near_distance = perspective ? camera.d_min + 5 : 5;
        draw(&run);
        assert_right(&run, "boxes");
        assert_true(count_of(&run, "not_drawn_hidden") > 300);
        end(&run);
      }
}

/* What a warped face hides depends on its triangulation: the judge leaves it
 * undecided where its two ways differ, and only there. */
static void a_warped_face_hides_what_both_ways_do(void **state) {
  (void)state;
  struct judged_run run;
  start_plates(&run);
  run.scene.point.item[6].z += 1;
  draw(&run);
  assert_right(&run, "warped");
  assert_int_equal(count_of(&run, "not_drawn_undecided"), 0);
  assert_true(count_of(&run, "not_drawn_hidden") > 400);
  end(&run);
}

/* With no face there is nothing to hide it. */
/* Reported: near a corner that an edge and a face share their distance is
 * within contact, and yet the edge is hidden from its start. */
static const struct fold {
  double eye[3], target[3], fov_deg, contact;
  unsigned edges;
  double point[6][3];
  uint32_t face[3][3]; /* 0, 0, 0: none */
} fold[] = {
    {{-0.441162, 0.248532, 0.0782144},
     {0.577148, 0.173153, 0.1},
     90,
     1e-3,
     RECTO_EDGES_DEFAULT,
     {{.6, -.6, -.0406}, {.6, -.4, .0046}, {.8, -.4, .0051}, {.8, -.2, -.1678}},
     {{0, 2, 1}, {1, 2, 3}}},
    {{-0.412029, 0.122889, 0.385318},
     {0.71675, 0.759295, 0.1},
     20,
     -1,
     RECTO_EDGE_INTERSECTION,
     {{-0.2579787685354503, -0.5, -0.09658882036288081},
      {-0.2579787685354503, -0.33333333333333337, 0.0460088887835439},
      {-0.21258516948190986, -0.5, -0.02993339651469695},
      {-0.21258516948190986, -0.33333333333333337, -0.005476783056814668},
      {-0.21258516948190986, -0.16666666666666663, 0.04002789687530874},
      {-0.5846720048359203, -0.33333333333333337, -0.04840114247540268}},
     {{0, 3, 1}, {1, 3, 4}, {2, 5, 3}}},
};

static void what_shares_a_corner_with_a_face_passes(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof fold / sizeof fold[0]; i++) {
    struct judged_run run;
    start(&run);
    recto_options *o = &run.options;
    for (int k = 0; k < 6; k++)
      build_point(&run.scene, fold[i].point[k][0], fold[i].point[k][1],
                  fold[i].point[k][2]);
    for (int k = 0; k < 3; k++)
      if (fold[i].face[k][0] != fold[i].face[k][1])
        build_face(&run.scene, fold[i].face[k], 3);
    o->camera.kind = RECTO_CAMERA_EYE;
    memcpy(o->camera.eye, fold[i].eye, sizeof o->camera.eye);
    memcpy(o->camera.target, fold[i].target, sizeof o->camera.target);
    o->camera.has_target = true;
    o->camera.fov_deg = fold[i].fov_deg;
    o->solver.contact = fold[i].contact;
    o->ink.edges = fold[i].edges;
    draw(&run);
    assert_right(&run, i == 0 ? "a fold" : "a tip");
    end(&run);
  }
}

static void a_wire_alone_passes(void **state) {
  (void)state;
  struct judged_run run;
  start(&run);
  build_segment(&run.scene, build_point(&run.scene, 0, 0, 0),
                build_point(&run.scene, 1, 2, 4));
  draw(&run);
  assert_right(&run, "wire");
  assert_int_equal(count_of(&run, "drawn"), 2000);
  end(&run);
}

static void an_empty_drawing_of_no_classes_passes(void **state) {
  (void)state;
  struct judged_run run;
  start_plates(&run);
  run.options.ink.edges = RECTO_EDGES_NONE;
  draw(&run);
  assert_right(&run, "nothing");
  assert_string_equal(run.summary, "verified: 0 drawn points visible, 0 "
                                   "others hidden, 0 too close to call");
  end(&run);
}

/* ---- Wrong drawings ------------------------------------------------------ */

/* The place that the message names. */
static void read_place(const struct judged_run *run, double at[2]) {
  assert_int_equal(sscanf(run->error.text,
                          "the drawing is wrong: at %lf,%lf mm", &at[0],
                          &at[1]),
                   2);
}

static void assert_says(const struct judged_run *run, const char *words) {
  if (strstr(run->error.text, words) == NULL)
    fail_msg("no \"%s\" in: %s", words, run->error.text);
}

static void a_hidden_line_that_is_drawn_is_found(void **state) {
  (void)state;
  struct judged_run run;
  double at[2], point[3];
  start_plates(&run);
  draw(&run);
  assert_right(&run, "plates");
  uint32_t edge = edge_between(&run, 1, 2);
  assert_int_equal(run.pipeline.map.edge_state[edge], MAP_HIDDEN);
  run.pipeline.map.edge_state[edge] = MAP_VISIBLE;
  ink_again(&run);
  assert_int_equal(verify_run(&run, 3), RECTO_ERROR_VERIFY);
  assert_int_equal(run.error.code, RECTO_ERROR_VERIFY);
  assert_says(&run, "a line is drawn");
  assert_says(&run, "the edge from 1 to 2 of face 0 is hidden by face 1");
  /* The right side of the plate, in mm, and in units of 8 of the scene's. */
  read_place(&run, at);
  assert_true(fabs(at[0] - 55) < 1e-3 && at[1] > 45 && at[1] < 55);
  assert_int_equal(sscanf(strstr(run.error.text, "point "), "point %lf,%lf,%lf",
                          &point[0], &point[1], &point[2]),
                   3);
  assert_true(fabs(point[0] - 40) < 1e-6 && fabs(point[2]) < 1e-6);
  assert_true(fabs(point[1] / 8 - (at[1] - 50)) < 1e-3);
  end(&run);
}

static void a_visible_line_that_is_missing_is_found(void **state) {
  (void)state;
  struct judged_run run;
  double at[2];
  start_plates(&run);
  draw(&run);
  run.pipeline.map.edge_state[edge_between(&run, 6, 7)] = MAP_HIDDEN;
  ink_again(&run);
  assert_int_equal(verify_run(&run, 0), RECTO_ERROR_VERIFY);
  assert_says(&run, "no line is drawn");
  assert_says(&run, "the edge from 6 to 7 of face 1 is visible");
  read_place(&run, at);
  assert_true(fabs(at[1] - 65) < 1e-3 && at[0] > 35 && at[0] < 65);
  end(&run);
}

static void a_line_where_no_edge_is_is_found(void **state) {
  (void)state;
  struct judged_run run;
  start_plates(&run);
  draw(&run);
  struct drawing *drawing = &run.pipeline.drawing;
  for (size_t i = 0; i < drawing->point.count; i++)
    drawing->point.item[i].x += 0.01;
  assert_int_equal(verify_run(&run, 0), RECTO_ERROR_VERIFY);
  assert_says(&run, "there is a line and no edge");
  end(&run);
}

/* A roof in a plane of 20 x 10, whose ridge of 2 mm alone is a crease. */
static void only_what_is_too_short_may_be_missing(void **state) {
  (void)state;
  struct judged_run run;
  start_plates(&run);
  uint32_t corner[4], ridge[2];
  for (int i = 0; i < 4; i++)
    corner[i] = build_point(&run.scene, i == 1 || i == 2 ? 10 : -10,
                            i / 2 ? 25 : 35, 5);
  for (int i = 0; i < 2; i++)
    ridge[i] = build_point(&run.scene, 2 * i - 1, 30, 6);
  build_quad(&run.scene, corner[0], corner[1], ridge[1], ridge[0]);
  build_triangle(&run.scene, corner[1], corner[2], ridge[1]);
  build_quad(&run.scene, corner[2], corner[3], ridge[0], ridge[1]);
  build_triangle(&run.scene, corner[3], corner[0], ridge[0]);
  run.options.mesh.crease_deg = 20;
  draw(&run);
  assert_int_equal(run.pipeline.drawing.dropped.count, 1);
  assert_right(&run, "a short ridge is dropped");
  run.pipeline.drawing.dropped.count = 0;
  assert_int_equal(verify_run(&run, 0), RECTO_ERROR_VERIFY);
  assert_says(&run, "is visible");
  end(&run);
}

/* Half of a line: the sampling is even. */
static void every_part_of_a_drawing_is_judged(void **state) {
  (void)state;
  for (unsigned part = 0; part < 20; part++) {
    struct judged_run run;
    start_plates(&run);
    run.options.verify = 200;
    draw(&run);
    uint32_t edge = edge_between(&run, 0, 1);
    struct map *map = &run.pipeline.map;
    map->edge_state[edge] = MAP_MIXED;
    struct map_mixed mixed = {edge, (uint32_t)map->interval.count, 1};
    struct map_interval interval = {{part, 20}, {part + 1, 20}};
    assert_int_equal(map->mixed.count, 0);
    assert_true(ARRAY_PUSH(&map->mixed, mixed) &&
                ARRAY_PUSH(&map->interval, interval));
    ink_again(&run);
    assert_int_equal(verify_run(&run, 0), RECTO_ERROR_VERIFY);
    end(&run);
  }
}

/* ---- Faults -------------------------------------------------------------- */

static void every_allocation_may_fail(void **state) {
  (void)state;
  struct judged_run run;
  start_plates(&run);
  build_box(&run.scene, vector_of(-2, -2, -9), vector_of(3, 3, 20));
  run.scene.point.item[0].z += 1; /* a warped face */
  draw(&run);
  struct memory_faults faults = {.least = 20};
  while (memory_faults_go_on(&faults)) {
    memory_faults_begin(&faults);
    memory_faults_end(&faults, verify_run(&run, 0));
  }
  end(&run);
}

/* The near plane passes an edge nearer than doubles resolve. */
static void an_edge_along_the_near_plane_may_be_missing(void **state) {
  struct judged_run run;
  (void)state;
  start(&run);
  build_polygon(&run.scene, (const double[]){2, 0, 0, 0, 0, 0, 0, 0, 1}, 3);
  run.options.camera.up[1] = 1;
  run.options.camera.azimuth_deg = 89.9999999;
  run.options.camera.elevation_deg = 1e-7;
  run.options.camera.near_distance = 2;
  draw(&run);
  assert_right(&run, "an edge along the near plane");
  end(&run);
}

static int tear_down(void **state) {
  (void)state;
  mem_fail_after(0);
  return 0;
}

/* ---- A drawing from a file ----------------------------------------------- */

/* Silhouettes of a smooth mesh consist of many edges shorter than half a pen,
 * which are drawn, as the line that they make is longer. */
static void a_subdivided_mesh_passes_the_check(void **state) {
  const char *folder = getenv("RECTO_MODELS");
  char path[1000];
  struct recto_scene coarse = {.path = NULL}, fine = coarse, finest = coarse;
  struct diagnostics silent = {.file = path};
  if (folder == NULL || is_under_valgrind())
    skip();
  snprintf(path, sizeof path, "%.900s/suzanne.obj", folder);
  scene_init(&coarse.scene);
  if (scene_read(&coarse.scene, path, NULL, &silent, NULL) != RECTO_OK) {
    scene_fini(&coarse.scene);
    print_message("no suzanne\n");
    skip();
  }
  scene_init(&fine.scene);
  scenes_catmull_clark(&fine.scene, &coarse.scene);
  scene_init(&finest.scene);
  scenes_catmull_clark(&finest.scene, &fine.scene);
  recto_options options;
  recto_options_init(&options);
  options.camera.azimuth_deg = 0;
  options.camera.elevation_deg = 90;
  for (int ids = 0; ids < 2; ids++) {
    const char *svg = temporary_path(state, "suzanne.svg");
    recto_drawing *drawing;
    recto_verdict verdict;
    options.ink.ids = ids;
    assert_int_equal(recto_scene_render(&finest, &options, &drawing, NULL),
                     RECTO_OK);
    assert_int_equal(recto_drawing_write(drawing, svg, NULL, NULL, NULL),
                     RECTO_OK);
    assert_int_equal(recto_scene_check(&finest, svg, &options, &verdict, NULL),
                     RECTO_OK);
    if (verdict.false_mm > 0 || verdict.missing_mm > 0)
      fail_msg("%g mm false, %g mm missing", verdict.false_mm,
               verdict.missing_mm);
    recto_drawing_destroy(drawing);
  }
  scene_fini(&coarse.scene);
  scene_fini(&fine.scene);
  scene_fini(&finest.scene);
}

/* Processor seconds for a regular polygon, verified. */
static double time_polygon(unsigned corners) {
  struct judged_run run;
  start(&run);
  double *xyz = calloc(corners, 3 * sizeof *xyz);
  assert_non_null(xyz);
  for (unsigned i = 0; i < corners; i++) {
    double angle = 2 * acos(-1) * i / corners;
    xyz[3 * i] = cos(angle);
    xyz[3 * i + 1] = sin(angle);
  }
  build_polygon(&run.scene, xyz, corners);
  free(xyz);
  run.options.verify = 100;
  run.options.solver.threads = 1;
  clock_t from = clock();
  draw(&run);
  assert_right(&run, "polygon");
  double seconds = (double)(clock() - from) / CLOCKS_PER_SEC;
  end(&run);
  return seconds;
}

/* Eight times the corners take some ten times as long, and not 64 times. */
static void a_face_may_have_very_many_corners(void **state) {
  (void)state;
  double few = time_polygon(8000), many = time_polygon(64000);
  if (many > 32 * few)
    fail_msg("%.2f s, and %.2f s for eight times as many", few, many);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_stability_list_passes),
      cmocka_unit_test(what_ink_does_is_no_fault),
      cmocka_unit_test(coarse_outputs_pass),
      cmocka_unit_test(random_small_scenes_pass),
      cmocka_unit_test(cuts_and_far_origins_pass),
      cmocka_unit_test(a_warped_face_hides_what_both_ways_do),
      cmocka_unit_test(what_shares_a_corner_with_a_face_passes),
      cmocka_unit_test(a_wire_alone_passes),
      cmocka_unit_test(an_empty_drawing_of_no_classes_passes),
      cmocka_unit_test(an_edge_along_the_near_plane_may_be_missing),
      cmocka_unit_test(a_hidden_line_that_is_drawn_is_found),
      cmocka_unit_test(a_visible_line_that_is_missing_is_found),
      cmocka_unit_test(a_line_where_no_edge_is_is_found),
      cmocka_unit_test(only_what_is_too_short_may_be_missing),
      cmocka_unit_test(every_part_of_a_drawing_is_judged),
      cmocka_unit_test(a_face_may_have_very_many_corners),
      cmocka_unit_test_teardown(every_allocation_may_fail, tear_down),
      cmocka_unit_test_setup_teardown(a_subdivided_mesh_passes_the_check,
                                      temporary_set_up, temporary_tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
