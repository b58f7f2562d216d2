/* test_failures_hiding.c - which faces hide which edges, and how much of them.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/judge/raster.h"
#include "tests/judged.h"
#include "tests/scenes/random.h"

static void run(struct pipeline *pipeline, const struct scene *scene,
                const recto_options *options) {
  pipeline_run(pipeline, scene, options, &solver_newell);
  if (pipeline->status != RECTO_OK)
    fail_msg("%s", pipeline->error.text);
}

/* ---- Convex bodies ------------------------------------------------------- */

/* The cosine between a triangle's normal and the direction to the viewer. */
static double facing(const struct pipeline *pipeline, const struct scene *scene,
                     uint32_t face) {
  const double *back = pipeline->camera.back;
  const uint32_t *corner = scene->corner.item + scene_face_start(scene, face);
  const struct scene_point *p = scene->point.item;
  struct vector a = {p[corner[0]].x, p[corner[0]].y, p[corner[0]].z};
  struct vector b = {p[corner[1]].x, p[corner[1]].y, p[corner[1]].z};
  struct vector c = {p[corner[2]].x, p[corner[2]].y, p[corner[2]].z};
  struct vector normal = vector_cross(vector_add(b, vector_scale(a, -1)),
                                      vector_add(c, vector_scale(a, -1)));
  return vector_dot(normal, vector_of(back[0], back[1], back[2]));
}

/* Every edge of a convex solid is all seen or all hidden: seen where one of
 * its faces looks at the viewer. */
static void check_convex(const struct scene *scene,
                         const recto_options *options) {
  struct pipeline pipeline;
  run(&pipeline, scene, options);
  for (size_t i = 0; i < pipeline.map.edge_count; i++) {
    const struct sheet_edge *edge = &pipeline.sheet.edge.item[i];
    const struct topology_edge *source =
        &pipeline.topology.edge.item[edge->source];
    bool seen = facing(&pipeline, scene, source->first) > 0 ||
                facing(&pipeline, scene, source->second) > 0;
    assert_int_equal(pipeline.map.edge_state[i],
                     seen ? MAP_VISIBLE : MAP_HIDDEN);
  }
  /* Visible and hidden lines make the whole. */
  double length = 0;
  for (size_t i = 0; i < pipeline.topology.edge.count; i++) {
    struct geom_point a =
        pipeline.sheet.point.item[pipeline.sheet.edge.item[i].point[0]];
    struct geom_point b =
        pipeline.sheet.point.item[pipeline.sheet.edge.item[i].point[1]];
    length += hypot(b.x - a.x, b.y - a.y) / SHEET_UNITS_PER_MM;
  }
  double drawn = pipeline_length(&pipeline, RECTO_EDGES_ALL, false) +
                 pipeline_length(&pipeline, RECTO_EDGES_ALL, true);
  judged_assert_near(drawn, length, 1e-4, "visible and hidden");
  pipeline_fini(&pipeline);
}

static void no_face_hides_its_own_edge(void **state) {
  static const char *const solid[] = {"cube", "icosahedron"};
  struct random random = {1};
  (void)state;
  for (unsigned i = 0; i < 1000; i++) {
    struct scene scene;
    recto_options options;
    pipeline_fill(&scene, &options, scenes_find(solid[i % 2]));
    options.camera.azimuth_deg = random_between(&random, 0, 360);
    options.camera.elevation_deg =
        asin(random_between(&random, -1, 1)) * 180 / acos(-1);
    options.ink.edges = RECTO_EDGES_ALL;
    options.ink.hidden = RECTO_HIDDEN_LAYER;
    check_convex(&scene, &options);
    scene_fini(&scene);
  }
}

/* ---- Nearly square-on ---------------------------------------------------- */

static void a_corner_view_of_a_cube_has_nine_edges(void **state) {
  (void)state;
  for (double turn = 1e-12; turn < 2e-3; turn *= 10) {
    struct scene scene;
    recto_options options;
    struct pipeline pipeline;
    unsigned count[3];
    recto_options_init(&options);
    scene_init(&scene);
    scenes_cube(&scene, &options, turn < 5e-12 ? 0 : turn / 10);
    run(&pipeline, &scene, &options);
    judged_count_states(&pipeline, count);
    assert_int_equal(count[MAP_VISIBLE], 9);
    assert_int_equal(count[MAP_HIDDEN], 3);
    assert_int_equal(count[MAP_MIXED], 0);
    pipeline_fini(&pipeline);
    scene_fini(&scene);
  }
}

static void a_cube_seen_square_on_keeps_its_outline(void **state) {
  (void)state;
  for (double turn = 1e-13; turn < 2e-3; turn *= 10) {
    struct scene scene;
    recto_options options;
    struct pipeline pipeline;
    recto_options_init(&options);
    scene_init(&scene);
    scenes_cube(&scene, &options, turn < 5e-13 ? 0 : turn);
    scenes_view_direction(&options, 0, 0);
    options.ink.min_stroke_mm = 0;
    run(&pipeline, &scene, &options);
    /* Four sides of 90 mm; a fifth line once the turned side opens. */
    double drawn = pipeline_length(&pipeline, RECTO_EDGES_ALL, false);
    assert_true(drawn > 360 - 0.2);
    assert_true(drawn < 450 + 0.4);
    if (turn < 5e-10)
      judged_assert_near(drawn, 360, 1e-5, "outline");
    pipeline_fini(&pipeline);
    scene_fini(&scene);
  }
}

/* ---- Piercing ------------------------------------------------------------ */

static void pierced_scenes_have_their_exact_areas(void **state) {
  (void)state;
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  pipeline_fill(&scene, &options, scenes_find("pierced rectangle"));
  options.ink.fill = RECTO_FILL_PAINT;
  run(&pipeline, &scene, &options);
  judged_assert_near(judged_area(&pipeline, 0), 275, 1e-7, "1");
  judged_assert_near(judged_area(&pipeline, 1), 25 + 100 / 3.0, 1e-7, "2");
  pipeline_fini(&pipeline);
  scene_fini(&scene);
  pipeline_fill(&scene, &options, scenes_find("two rectangles"));
  options.ink.fill = RECTO_FILL_PAINT;
  run(&pipeline, &scene, &options);
  judged_assert_near(judged_area(&pipeline, 0), 1175 / 4.0, 1e-7, "1");
  judged_assert_near(judged_area(&pipeline, 1), 178 / 3.0, 1e-7, "2");
  judged_assert_near(judged_area(&pipeline, 2), 661 / 12.0, 1e-7, "3");
  pipeline_fini(&pipeline);
  scene_fini(&scene);
}

static void lines_where_faces_pierce_are_drawn(void **state) {
  (void)state;
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  pipeline_fill(&scene, &options, scenes_find("pierced rectangle"));
  run(&pipeline, &scene, &options);
  /* From (20, 20) to (45/2, 25/2). */
  judged_assert_near(pipeline_length(&pipeline, RECTO_EDGE_INTERSECTION, false),
                     hypot(2.5, 7.5), 1e-5, "intersection");
  pipeline_fini(&pipeline);
  options.ink.edges &= ~(unsigned)RECTO_EDGE_INTERSECTION;
  run(&pipeline, &scene, &options);
  assert_true(pipeline_length(&pipeline, RECTO_EDGE_INTERSECTION, false) == 0);
  pipeline_fini(&pipeline);
  scene_fini(&scene);
}

/* ---- Cycles -------------------------------------------------------------- */

static void count_fragments(const struct pipeline *pipeline,
                            unsigned *fragments, uint32_t faces) {
  memset(fragments, 0, faces * sizeof *fragments);
  for (size_t i = 0; i < pipeline->map.fragment.count; i++)
    fragments[pipeline->map.fragment.item[i].face]++;
}

static void each_bar_of_a_cycle_is_cut_in_two(void **state) {
  (void)state;
  for (unsigned n = 3; n <= 9; n++) {
    struct scene scene;
    recto_options options;
    struct pipeline pipeline;
    unsigned fragments[9];
    recto_options_init(&options);
    scene_init(&scene);
    scenes_cycle(&scene, &options, n);
    options.ink.fill = RECTO_FILL_PAINT;
    run(&pipeline, &scene, &options);
    count_fragments(&pipeline, fragments, n);
    for (unsigned i = 0; i < n; i++)
      assert_int_equal(fragments[i], 2);
    pipeline_fini(&pipeline);
    scene_fini(&scene);
  }
}

static double sum_areas(const struct pipeline *pipeline,
                        const struct scene *scene) {
  double sum = 0;
  for (uint32_t i = 0; i < scene_face_count(scene); i++)
    sum += judged_area(pipeline, i);
  return sum;
}

static void a_field_of_100_cycles_is_100_times_one(void **state) {
  (void)state;
  struct pipeline one, field;
  struct scene scene_one, scene_field;
  recto_options options;
  recto_options_init(&options);
  scene_init(&scene_one);
  scene_init(&scene_field);
  scenes_cycle(&scene_one, &options, 3);
  scenes_cycle_field(&scene_field, &options, 10);
  options.ink.fill = RECTO_FILL_PAINT;
  options.camera.fit = RECTO_FIT_SCALE;
  options.camera.scale = 1.5;
  options.camera.eye[0] = options.camera.target[0] = 24.75;
  options.camera.eye[1] = options.camera.target[1] = 24.75;
  run(&one, &scene_one, &options);
  run(&field, &scene_field, &options);
  assert_int_equal(field.map.fragment.count, 100 * one.map.fragment.count);
  judged_assert_near(sum_areas(&field, &scene_field),
                     100 * sum_areas(&one, &scene_one), 1e-3, "areas");
  pipeline_fini(&one);
  pipeline_fini(&field);
  scene_fini(&scene_one);
  scene_fini(&scene_field);
}

/* ---- Areas against a scan of the page ------------------------------------ */

struct span {
  double from, to;
};

static int compare_spans(const void *a, const void *b) {
  const struct span *s = a, *t = b;
  return s->from < t->from ? -1 : s->from > t->from;
}

/* How much of a row at y is covered by any face. */
static double covered(const struct judge_point2 *at, uint32_t quads, double y,
                      struct span *span) {
  unsigned count = 0;
  for (uint32_t i = 0; i < quads; i++) {
    double x[2];
    unsigned found = 0;
    for (unsigned k = 0; k < 4 && found < 2; k++) {
      struct judge_point2 a = at[4 * i + k], b = at[4 * i + (k + 1) % 4];
      if ((a.y <= y) != (b.y <= y))
        x[found++] = a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y);
    }
    if (found == 2)
      span[count++] = (struct span){fmin(x[0], x[1]), fmax(x[0], x[1])};
  }
  qsort(span, count, sizeof *span, compare_spans);
  double sum = 0, end = -INFINITY;
  for (unsigned i = 0; i < count; i++) {
    double from = fmax(span[i].from, end);
    sum += fmax(0, span[i].to - from);
    end = fmax(end, span[i].to);
  }
  return sum;
}

static void areas_of_1000_sticks_add_up_to_their_union(void **state) {
  enum { sticks = 1000, rows = 20000 };
  (void)state;
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  static struct judge_point2 at[4 * sticks];
  static struct span span[sticks];
  recto_options_init(&options);
  scene_init(&scene);
  scenes_sticks(&scene, &options, sticks, 3);
  options.ink.fill = RECTO_FILL_PAINT;
  run(&pipeline, &scene, &options);
  double matrix[12], area = 0;
  camera_matrix(&pipeline.camera, matrix);
  for (size_t i = 0; i < scene.point.count; i++) {
    const struct scene_point *p = &scene.point.item[i];
    at[i].x =
        matrix[0] * p->x + matrix[1] * p->y + matrix[2] * p->z + matrix[3];
    at[i].y =
        matrix[4] * p->x + matrix[5] * p->y + matrix[6] * p->z + matrix[7];
  }
  for (unsigned row = 0; row < rows; row++)
    area += covered(at, sticks, 100 * (row + 0.5) / rows, span) * 100 / rows;
  judged_assert_near(sum_areas(&pipeline, &scene), area, 1e-4 * area, "union");
  pipeline_fini(&pipeline);
  scene_fini(&scene);
}

/* ---- A large face under small ones --------------------------------------- */

/* Fills the raster with the map's fragments. */
static void raster_fragments(struct judge_raster *raster,
                             const struct pipeline *pipeline) {
  const struct map *map = &pipeline->map;
  ARRAY(struct judge_point2) place = {0};
  ARRAY(uint32_t) count = {0};
  for (size_t i = 0; i < map->fragment.count; i++) {
    const struct map_fragment *fragment = &map->fragment.item[i];
    place.count = count.count = 0;
    for (uint32_t l = 0; l < fragment->loops; l++) {
      const struct map_loop *loop = &map->loop.item[fragment->loop + l];
      build_require(ARRAY_PUSH(&count, loop->count));
      for (uint32_t k = 0; k < loop->count; k++) {
        const struct map_corner *corner = &map->corner.item[loop->corner + k];
        struct judge_point2 at = {sheet_x_mm(&pipeline->sheet, corner->x),
                                  sheet_y_mm(&pipeline->sheet, corner->y)};
        build_require(ARRAY_PUSH(&place, at));
      }
    }
    judge_raster_region(raster, place.item, count.item, fragment->loops,
                        fragment->face);
  }
  ARRAY_FREE(&place);
  ARRAY_FREE(&count);
}

static void check_against_raster(const char *name, unsigned n) {
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  struct judge_camera camera;
  struct judge_raster exact, raster;
  pipeline_fill(&scene, &options, scenes_find(name));
  options.ink.fill = RECTO_FILL_PAINT;
  run(&pipeline, &scene, &options);
  judged_camera(&camera, &pipeline);
  judge_raster_init(&exact, n, 100);
  judge_raster_init(&raster, n, 100);
  raster_fragments(&exact, &pipeline);
  judge_raster_scene(&raster, &scene, &camera);
  size_t differ = judge_raster_differ(&exact, &raster);
  if (differ > 0)
    fail_msg("%s: %lu pixels differ", name, (unsigned long)differ);
  judge_raster_fini(&exact);
  judge_raster_fini(&raster);
  pipeline_fini(&pipeline);
  scene_fini(&scene);
}

static void a_large_table_is_as_a_depth_buffer_sees_it(void **state) {
  (void)state;
  check_against_raster("large table", 4096);
}

static void other_scenes_are_as_a_depth_buffer_sees_them(void **state) {
  static const char *const name[] = {
      "crossed boxes", "three sheets", "self-intersecting", "nested cycles",
      "sticks",        "honeycomb",    "Menger sponge",     "lattice",
      "soup",          "fan",          "thin bars",         "globe"};
  (void)state;
  for (size_t i = 0; i < sizeof name / sizeof *name; i++)
    check_against_raster(name[i], 512);
}

/* ---- Coplanar and doubled faces ------------------------------------------ */

static void a_doubled_mesh_is_drawn_once(void **state) {
  (void)state;
  struct scene twice, once;
  recto_options options;
  struct pipeline pipeline, alone;
  pipeline_fill(&twice, &options, scenes_find("doubled mesh"));
  scene_init(&once);
  scenes_copy(&once, &twice, 0);
  uint32_t half = scene_face_count(&twice) / 2;
  once.corner.count = scene_face_start(&once, half);
  once.face_count = half;
  once.face_group.count = once.face_group.count > 0 ? half : 0;
  once.face_start.count = once.face_start.count > 0 ? half + 1 : 0;
  options.ink.fill = RECTO_FILL_PAINT;
  run(&pipeline, &twice, &options);
  run(&alone, &once, &options);
  for (uint32_t i = 0; i < half; i++) {
    /* What ties in depth is seen of the earlier face alone. */
    assert_true(judged_area(&pipeline, i) == judged_area(&alone, i));
    assert_true(judged_area(&pipeline, half + i) == 0);
  }
  judged_assert_near(pipeline_length(&pipeline, RECTO_EDGES_ALL, false),
                     pipeline_length(&alone, RECTO_EDGES_ALL, false), 1e-5,
                     "lines");
  pipeline_fini(&pipeline);
  pipeline_fini(&alone);
  scene_fini(&twice);
  scene_fini(&once);
}

static void two_colours_in_one_plane_keep_their_areas(void **state) {
  (void)state;
  struct scene scene;
  recto_options options;
  struct pipeline pipeline;
  pipeline_fill(&scene, &options, scenes_find("two colours"));
  options.ink.fill = RECTO_FILL_PAINT;
  run(&pipeline, &scene, &options);
  double field = judged_area(&pipeline, 0);
  assert_true(field > 1);
  for (uint32_t i = 0; i < 16; i++)
    judged_assert_near(judged_area(&pipeline, i), field, 1e-4, "field");
  pipeline_fini(&pipeline);
  scene_fini(&scene);
}

/* The drawn length of contact scenes, turned by a hair, stays. */
static void check_turned(void (*fill)(struct scene *, recto_options *, double),
                         const char *name) {
  double still = 0;
  for (double turn = 0; turn < 2e-9; turn += 1e-9 / 8) {
    struct scene scene;
    recto_options options;
    struct pipeline pipeline;
    recto_options_init(&options);
    scene_init(&scene);
    fill(&scene, &options, turn);
    options.ink.min_stroke_mm = 0;
    run(&pipeline, &scene, &options);
    double length = pipeline_length(&pipeline, RECTO_EDGES_ALL, false);
    if (turn == 0)
      still = length;
    judged_assert_near(length, still, 1e-3, name);
    pipeline_fini(&pipeline);
    scene_fini(&scene);
  }
}

static void fill_stack(struct scene *scene, recto_options *options,
                       double turn) {
  scenes_cube_stack(scene, options, 6, turn);
}
static void fill_on_table(struct scene *scene, recto_options *options,
                          double turn) {
  scenes_box_on_table(scene, options, SCENES_CONTACT_EXACT, turn);
}
static void fill_on_table_float(struct scene *scene, recto_options *options,
                                double turn) {
  scenes_box_on_table(scene, options, SCENES_CONTACT_FLOAT, turn);
}

static void contact_hides_nothing_under_a_tiny_turn(void **state) {
  (void)state;
  check_turned(scenes_touching_boxes, "touching boxes");
  check_turned(fill_stack, "cube stack");
  check_turned(fill_on_table, "box on table");
  check_turned(fill_on_table_float, "box on table in float32");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(no_face_hides_its_own_edge),
      cmocka_unit_test(a_corner_view_of_a_cube_has_nine_edges),
      cmocka_unit_test(a_cube_seen_square_on_keeps_its_outline),
      cmocka_unit_test(pierced_scenes_have_their_exact_areas),
      cmocka_unit_test(lines_where_faces_pierce_are_drawn),
      cmocka_unit_test(each_bar_of_a_cycle_is_cut_in_two),
      cmocka_unit_test(a_field_of_100_cycles_is_100_times_one),
      cmocka_unit_test(areas_of_1000_sticks_add_up_to_their_union),
      cmocka_unit_test(a_large_table_is_as_a_depth_buffer_sees_it),
      cmocka_unit_test(other_scenes_are_as_a_depth_buffer_sees_them),
      cmocka_unit_test(a_doubled_mesh_is_drawn_once),
      cmocka_unit_test(two_colours_in_one_plane_keep_their_areas),
      cmocka_unit_test(contact_hides_nothing_under_a_tiny_turn),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
