/* test_quantitative_invisibility.c - the number of faces that hide an edge,
 * compared with brute force and with the visible map. */
#include "exact_fixture/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/memory_faults.h"
#include "tests/polled.h"
#include "tests/scenes/pipeline.h"
#include "visibility/predicate/occlusion.h"
#include "visibility/quantitative_invisibility.h"

static void find(struct map *map, const struct sheet *sheet, int most) {
  map->over_limit.count = map->over_limit_interval.count = 0;
  assert_int_equal(
      quantitative_invisibility_find(map, sheet, most, false, NULL, NULL),
      RECTO_OK);
}

/* Whether t lies inside one of the deep intervals of the edge. */
static bool is_deep(const struct map *map, uint32_t edge, struct ratio t) {
  for (size_t m = 0; m < map->over_limit.count; m++) {
    const struct map_mixed *deep = &map->over_limit.item[m];
    for (uint32_t i = 0; deep->edge == edge && i < deep->count; i++) {
      const struct map_interval *interval =
          &map->over_limit_interval.item[deep->interval + i];
      if (ratio_compare(interval->t0, t) < 0 &&
          ratio_compare(t, interval->t1) < 0)
        return true;
    }
  }
  return false;
}

/* ---- By hand ------------------------------------------------------------- */

/* Plates one before the other, each reaching further to the right over a line
 * behind them all: 0 to 100 at height 5. */
static void build_stairs(struct sheet *sheet, int plates) {
  const int line[][3] = {{0, 5, 0}, {100, 5, 0}, {100, 6, 0}};
  exact_sheet_init(sheet);
  exact_add_face(sheet, line, 3, 1000);
  for (int i = 1; i <= plates; i++) {
    const int plate[][3] = {{-10, -10, 10 * i},
                            {10 * i, -10, 10 * i},
                            {10 * i, 20, 10 * i},
                            {-10, 20, 10 * i}};
    exact_add_face(sheet, plate, 4, 1000);
  }
}

static void plates_are_counted_one_by_one(void **state) {
  struct sheet sheet;
  struct map map;
  (void)state;
  build_stairs(&sheet, 8);
  exact_solve(&solver_brute, &sheet, &map, NULL);
  for (int most = 0; most < 10; most++) {
    find(&map, &sheet, most);
    /* Up to 10 (8 - most) of 100 there are more than `most` plates. */
    for (int percent = 1; percent < 100; percent += 2)
      assert_int_equal(is_deep(&map, 0, ratio_of(percent, 100)),
                       percent < 10 * (8 - most));
  }
  map_fini(&map);
  exact_sheet_fini(&sheet);
}

static void nothing_exceeds_a_limit_that_is_large_enough(void **state) {
  struct sheet sheet;
  struct map map;
  (void)state;
  build_stairs(&sheet, 8);
  exact_solve(&solver_brute, &sheet, &map, NULL);
  find(&map, &sheet, 8);
  assert_int_equal(map.over_limit.count, 0);
  assert_int_equal(map.over_limit_interval.count, 0);
  map_fini(&map);
  exact_sheet_fini(&sheet);
}

/* ---- Against brute force ------------------------------------------------- */

/* How many triangles hide the edge at t, on its less covered side. */
static int count_at(const struct sheet *sheet, uint32_t e, struct ratio t) {
  const struct sheet_edge *edge = &sheet->edge.item[e];
  int left = 0, right = 0;
  for (uint32_t i = 0; i < sheet->triangle.count; i++) {
    struct occluder occluder;
    struct occluded_interval part;
    struct occlusion_counts counts = {0};
    if (sheet_is_edge_on(sheet, i) || i == edge->triangle[0] ||
        i == edge->triangle[1])
      continue;
    occluder_init(&occluder, sheet, i);
    if (!occlude_edge(&occluder, sheet->point.item[edge->point[0]],
                      sheet->point.item[edge->point[1]], &part, &counts) ||
        ratio_compare(t, part.from) <= 0 || ratio_compare(part.to, t) <= 0)
      continue;
    left += (part.sides & OCCLUDED_LEFT) != 0;
    right += (part.sides & OCCLUDED_RIGHT) != 0;
  }
  return left < right ? left : right;
}

static void counts_are_brute_force_ones_on_hard_sheets(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 200; seed++) {
    struct sheet sheet;
    struct map map;
    uint64_t r = seed;
    exact_random_sheet(&sheet, (enum exact_kind)(seed % EXACT_KINDS), 12, &r);
    exact_solve(&solver_brute, &sheet, &map, NULL);
    int most = exact_random_below(&r, 4);
    find(&map, &sheet, most);
    for (uint32_t e = 0; e < map.edge_count; e++) {
      const struct sheet_edge *edge = &sheet.edge.item[e];
      const struct geom_point *p = &sheet.point.item[edge->point[0]];
      const struct geom_point *q = &sheet.point.item[edge->point[1]];
      /* Odd parts of a large prime: no triangle ends there. */
      struct ratio t = ratio_of(1 + exact_random_below(&r, 1000000), 1000003);
      if (edge->edge_class == 0 || (p->x == q->x && p->y == q->y))
        continue;
      assert_int_equal(is_deep(&map, e, t), count_at(&sheet, e, t) > most);
    }
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

/* ---- Against the map ----------------------------------------------------- */

/* What more than no face hides is what is not visible, to the last bit. */
static void assert_complement(const struct map *map, const char *name) {
  const struct map_mixed *mixed = map->mixed.item, *deep = map->over_limit.item;
  for (uint32_t e = 0; e < map->edge_count; e++) {
    struct ratio at = ratio_of(0, 1);
    uint32_t v = 0, d = 0;
    bool has_deep = map->over_limit.count > 0 &&
                    deep < map->over_limit.item + map->over_limit.count &&
                    deep->edge == e;
    bool has_mixed = map->edge_state[e] == MAP_MIXED;
    uint32_t deeps = has_deep ? deep->count : 0;
    uint32_t visibles = has_mixed ? mixed->count : 0;
    if (!has_mixed && !has_deep)
      continue; /* visible, without length, or not to be drawn */
    while (v < visibles || d < deeps) {
      const struct map_interval *next = NULL;
      const struct map_interval *see =
          v < visibles ? &map->interval.item[mixed->interval + v] : NULL;
      const struct map_interval *not_see =
          d < deeps ? &map->over_limit_interval.item[deep->interval + d] : NULL;
      if (see != NULL && ratio_compare(see->t0, at) == 0) {
        next = see;
        v++;
      } else if (not_see != NULL && ratio_compare(not_see->t0, at) == 0) {
        next = not_see;
        d++;
      } else {
        fail_msg("%s: edge %u has a gap", name, e);
        return;
      }
      at = next->t1;
    }
    if (ratio_compare(at, ratio_of(1, 1)) != 0)
      fail_msg("%s: edge %u ends too soon", name, e);
    if (has_deep)
      deep++;
    if (has_mixed)
      mixed++;
  }
}

static void what_any_face_hides_is_what_is_not_visible(void **state) {
  (void)state;
  for (const struct scenes_entry *entry = scene_list; entry->name; entry++) {
    struct scene scene;
    struct pipeline p;
    recto_options options;
    scene_init(&scene);
    pipeline_fill(&scene, &options, entry);
    options.ink.hidden = RECTO_HIDDEN_LAYER;
    pipeline_run(&p, &scene, &options, &solver_tiles);
    if (p.status == RECTO_OK) {
      find(&p.map, &p.sheet, 0);
      assert_complement(&p.map, entry->name);
    }
    pipeline_fini(&p);
    scene_fini(&scene);
  }
}

/* ---- In ink -------------------------------------------------------------- */

/* How long the hidden lines of three boxes in one another are on paper. */
static double hidden_length(int layers, recto_method method) {
  recto_scene *scene = NULL;
  recto_drawing *drawing = NULL;
  recto_options options;
  double length = 0;
  recto_options_init(&options);
  options.ink.hidden = RECTO_HIDDEN_LAYER;
  options.ink.hidden_by_max = layers;
  options.solver.method = method;
  assert_int_equal(recto_scene_create(&scene, NULL), RECTO_OK);
  for (int box = 0; box < 3; box++) {
    uint32_t index[8];
    for (int i = 0; i < 8; i++) {
      double size = 3 - box;
      const double xyz[] = {i & 1 ? size : -size, i & 2 ? size : -size,
                            i & 4 ? size : -size};
      assert_int_equal(recto_scene_add_point(scene, xyz, &index[i], NULL),
                       RECTO_OK);
    }
    static const int side[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                   {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    for (int s = 0; s < 6; s++) {
      uint32_t corner[4];
      for (int k = 0; k < 4; k++)
        corner[k] = index[side[s][k]];
      assert_int_equal(recto_scene_add_face(scene, corner, 4, NULL), RECTO_OK);
    }
  }
  assert_int_equal(recto_scene_render(scene, &options, &drawing, NULL),
                   RECTO_OK);
  for (size_t i = 0; i < recto_drawing_stroke_count(drawing); i++) {
    recto_stroke s;
    assert_true(recto_drawing_stroke(drawing, i, &s));
    for (size_t k = 1; s.hidden && k < s.count; k++)
      length += (s.points[2 * k] - s.points[2 * k - 2]) *
                    (s.points[2 * k] - s.points[2 * k - 2]) +
                (s.points[2 * k + 1] - s.points[2 * k - 1]) *
                    (s.points[2 * k + 1] - s.points[2 * k - 1]);
  }
  recto_drawing_destroy(drawing);
  recto_scene_destroy(scene);
  return length;
}

/* The near edges of a box are behind the boxes around it, the far ones behind
 * the box itself too. */
static void each_layer_more_shows_more(void **state) {
  (void)state;
  double all = hidden_length(0, RECTO_METHOD_BRUTE), before = 0;
  for (int layers = 1; layers <= 3; layers++) {
    double length = hidden_length(layers, RECTO_METHOD_BRUTE);
    assert_true(length > before + 1);
    before = length;
  }
  assert_true(before == all);
}

static void all_methods_draw_the_same_layers(void **state) {
  static const recto_method method[] = {
      RECTO_METHOD_NEWELL, RECTO_METHOD_WARNOCK, RECTO_METHOD_TILES};
  (void)state;
  for (int layers = 0; layers < 4; layers++)
    for (size_t i = 0; i < sizeof method / sizeof *method; i++)
      assert_true(hidden_length(layers, method[i]) ==
                  hidden_length(layers, RECTO_METHOD_BRUTE));
}

/* ---- Failing ------------------------------------------------------------- */

static bool refuse(void *user, double share, const char *stage) {
  (void)user, (void)share, (void)stage;
  return false;
}

static void counting_can_be_cancelled_and_fails_cleanly(void **state) {
  struct sheet sheet;
  struct map map;
  struct polled polled;
  recto_error error;
  (void)state;
  build_stairs(&sheet, 8);
  exact_solve(&solver_brute, &sheet, &map, NULL);
  polled_begin(&polled, refuse, NULL);
  assert_int_equal(
      quantitative_invisibility_find(&map, &sheet, 1, false, NULL, &error),
      RECTO_ERROR_CANCELLED);
  polled_end(&polled);
  struct memory_faults faults = {.least = 1};
  while (memory_faults_go_on(&faults)) {
    map.over_limit.count = map.over_limit_interval.count = 0;
    memory_faults_begin(&faults);
    memory_faults_end(&faults, quantitative_invisibility_find(
                                   &map, &sheet, 1, true, NULL, NULL));
  }
  map_fini(&map);
  exact_sheet_fini(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(plates_are_counted_one_by_one),
      cmocka_unit_test(nothing_exceeds_a_limit_that_is_large_enough),
      cmocka_unit_test(counts_are_brute_force_ones_on_hard_sheets),
      cmocka_unit_test(what_any_face_hides_is_what_is_not_visible),
      cmocka_unit_test(each_layer_more_shows_more),
      cmocka_unit_test(all_methods_draw_the_same_layers),
      cmocka_unit_test(counting_can_be_cancelled_and_fails_cleanly),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
