/* test_planar_subdivision.c - the half-edges of every visible map are a planar
 * subdivision. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/union_find.h"
#include "exact_fixture/sheet.h"
#include "tests/scenes/pipeline.h"
#include "tests/scenes/solver_named.h"

static const struct map_corner *origin(const struct map *map, uint32_t half) {
  return &map->corner.item[map->half_edge.item[half].origin];
}

static const struct map_corner *end(const struct map *map, uint32_t half) {
  return origin(map, map->half_edge.item[half].next);
}

/* ---- Structure ----------------------------------------------------------- */

/* The half-edges of a loop come side by side, the first of each side at its
 * corner. */
static void assert_loops(const struct map *map) {
  size_t seen = 0;
  for (uint32_t f = 0; f < map->fragment.count; f++)
    for (uint32_t l = 0; l < map->fragment.item[f].loops; l++) {
      const struct map_loop *loop =
          &map->loop.item[map->fragment.item[f].loop + l];
      uint32_t h = loop->half_edge, corner = 0;
      do {
        const struct map_half_edge *half = &map->half_edge.item[h];
        assert_int_equal(half->fragment, f);
        if (half->side == loop->corner + corner)
          assert_int_equal(half->origin, loop->corner + corner++);
        else
          assert_int_equal(half->side, loop->corner + corner - 1);
        h = half->next;
        seen++;
      } while (h != loop->half_edge);
      assert_int_equal(corner, loop->count);
    }
  assert_int_equal(seen, map->half_edge.count);
}

/* Twins are of each other; of exact maps they have the same ends. */
static void assert_twins(const struct map *map, bool exact) {
  for (uint32_t h = 0; h < map->half_edge.count; h++) {
    uint32_t twin = map->half_edge.item[h].twin;
    if (twin == SHEET_NONE)
      continue;
    assert_int_equal(map->half_edge.item[twin].twin, h);
    assert_int_not_equal(map->half_edge.item[twin].fragment,
                         map->half_edge.item[h].fragment);
    if (exact) {
      assert_true(origin(map, h)->x == end(map, twin)->x);
      assert_true(origin(map, h)->y == end(map, twin)->y);
    }
  }
}

/* How many loops the half-edges without twins form about the fragments. */
static size_t count_borders(const struct map *map) {
  const struct map_half_edge *half = map->half_edge.item;
  size_t count = map->half_edge.count, borders = 0;
  uint8_t *seen = mem_calloc(count, 1);
  for (uint32_t first = 0; first < count; first++) {
    if (half[first].twin != SHEET_NONE || seen[first])
      continue;
    borders++;
    for (uint32_t h = first; !seen[h];) {
      seen[h] = 1;
      for (h = half[h].next; half[h].twin != SHEET_NONE;)
        h = half[half[h].twin].next;
    }
  }
  mem_free(seen);
  return borders;
}

static size_t count_sets(uint32_t *sets, size_t count) {
  size_t roots = 0;
  for (uint32_t i = 0; i < count; i++)
    roots += sets[i] == i;
  mem_free(sets);
  return roots;
}

/* Euler's formula: fragments glued along twins are spheres with as many
 * openings as there are borders: V - E + F = 2 C - borders, where a fragment
 * with n loops counts 2 - n. */
static void assert_euler(const struct map *map) {
  const struct map_half_edge *half = map->half_edge.item;
  size_t count = map->half_edge.count, fragments = map->fragment.count;
  uint32_t *point = union_find_create(count),
           *part = union_find_create(fragments);
  long edges = 0, faces = 2 * (long)fragments - (long)map->loop.count;
  for (uint32_t h = 0; h < count; h++) {
    uint32_t twin = half[h].twin;
    edges += twin == SHEET_NONE || twin > h;
    if (twin == SHEET_NONE)
      continue;
    union_find_join(point, h, half[twin].next);
    union_find_join(part, half[h].fragment, half[twin].fragment);
  }
  long points = (long)count_sets(point, count);
  long parts = (long)count_sets(part, fragments);
  assert_int_equal(points - edges + faces,
                   2 * parts - (long)count_borders(map));
}

/* ---- Against the page ---------------------------------------------------- */

/* The fragment at a point, by the even-odd rule; SHEET_NONE. */
static uint32_t fragment_at(const struct map *map, double x, double y) {
  for (uint32_t f = 0; f < map->fragment.count; f++) {
    bool inside = false;
    for (uint32_t l = 0; l < map->fragment.item[f].loops; l++) {
      const struct map_loop *loop =
          &map->loop.item[map->fragment.item[f].loop + l];
      const struct map_corner *c = map->corner.item + loop->corner;
      for (uint32_t i = 0; i < loop->count; i++) {
        const struct map_corner *p = &c[i], *q = &c[(i + 1) % loop->count];
        if ((p->y <= y) != (q->y <= y) &&
            p->x + (y - p->y) / (q->y - p->y) * (q->x - p->x) < x)
          inside = !inside;
      }
    }
    if (inside)
      return f;
  }
  return SHEET_NONE;
}

/* Whether the fragment of half-edge h has another side less than a unit from a
 * point. */
static bool is_sliver(const struct map *map, uint32_t h, double x, double y) {
  for (uint32_t k = 0; k < map->half_edge.count; k++) {
    const struct map_half_edge *other = &map->half_edge.item[k];
    const struct map_corner *p = origin(map, k), *q = end(map, k);
    double dx = q->x - p->x, dy = q->y - p->y;
    double t = ((x - p->x) * dx + (y - p->y) * dy) / (dx * dx + dy * dy);
    t = fmin(fmax(t, 0), 1);
    if (k != h && other->fragment == map->half_edge.item[h].fragment &&
        hypot(x - p->x - t * dx, y - p->y - t * dy) < 1)
      return true;
  }
  return false;
}

/* Immediately to the right of a half-edge is the fragment of its twin.  Half-
 * edges too short for a point beside them are left out, slivers too thin for
 * one, and `stride` - 1 of `stride` others.  Returns how many were tested. */
static size_t assert_neighbours(const struct map *map, uint32_t stride) {
  size_t tested = 0;
  for (uint32_t h = 0; h < map->half_edge.count; h += stride) {
    const struct map_corner *p = origin(map, h), *q = end(map, h);
    double dx = q->x - p->x, dy = q->y - p->y, length = hypot(dx, dy);
    double x = (p->x + q->x) / 2 + dy / length / 4;
    double y = (p->y + q->y) / 2 - dx / length / 4;
    uint32_t twin = map->half_edge.item[h].twin;
    if (twin == SHEET_NONE || length < 64 || is_sliver(map, twin, x, y))
      continue;
    assert_int_equal(fragment_at(map, x, y),
                     map->half_edge.item[twin].fragment);
    tested++;
  }
  return tested;
}

/* No two half-edges without twins run along each other in opposite directions,
 * to 1/64 unit. */
static void assert_no_missing_twins(const struct map *map) {
  const struct map_half_edge *half = map->half_edge.item;
  for (uint32_t h = 0; h < map->half_edge.count; h++) {
    const struct map_corner *p = origin(map, h), *q = end(map, h);
    double dx = q->x - p->x, dy = q->y - p->y, length = hypot(dx, dy);
    for (uint32_t k = 0; k < h && half[h].twin == SHEET_NONE; k++) {
      double along[2], across[2];
      for (int i = 0; i < 2; i++) {
        const struct map_corner *at = i == 0 ? origin(map, k) : end(map, k);
        along[i] = ((at->x - p->x) * dx + (at->y - p->y) * dy) / length;
        across[i] = ((at->x - p->x) * dy - (at->y - p->y) * dx) / length;
      }
      assert_false(half[k].twin == SHEET_NONE && fabs(across[0]) < 1.0 / 64 &&
                   fabs(across[1]) < 1.0 / 64 &&
                   fmin(along[0], length) - fmax(along[1], 0) > 1);
    }
  }
}

/* ---- Claims -------------------------------------------------------------- */

static const char *const exact_method[] = {"brute",   "newell", "warnock",
                                           "watkins", "tiles",  "painter"};
enum { EXACT_COUNT = sizeof exact_method / sizeof *exact_method };

static size_t check_scene(const struct scene *scene,
                          const recto_options *options, const char *method,
                          bool exact) {
  struct pipeline p;
  size_t tested = 0;
  recto_options painted = *options;
  painted.ink.fill = RECTO_FILL_PAINT;
  pipeline_run(&p, scene, &painted, solver_named(method));
  if (p.status == RECTO_OK) {
    assert_loops(&p.map);
    assert_twins(&p.map, exact);
    assert_euler(&p.map);
    if (exact) {
      assert_no_missing_twins(&p.map);
      tested = assert_neighbours(&p.map,
                                 1 + (uint32_t)(p.map.half_edge.count / 2000));
    }
  }
  pipeline_fini(&p);
  return tested;
}

static void every_exact_map_is_a_planar_subdivision(void **state) {
  size_t tested = 0;
  (void)state;
  for (const struct scenes_entry *e = scene_list; e->name != NULL; e++) {
    struct scene scene;
    recto_options options;
    pipeline_fill(&scene, &options, e);
    for (int m = 1; m < EXACT_COUNT; m++)
      tested += check_scene(&scene, &options, exact_method[m], true);
    scene_fini(&scene);
  }
  assert_in_range(tested, 1000, SIZE_MAX);
}

static void random_maps_are_planar_subdivisions(void **state) {
  (void)state;
  for (uint64_t seed = 0; seed < 100; seed++) {
    struct scene scene;
    recto_options options;
    scene_init(&scene);
    recto_options_init(&options);
    scenes_small(&scene, &options, seed);
    check_scene(&scene, &options, exact_method[seed % EXACT_COUNT], true);
    scene_fini(&scene);
  }
}

static void approximate_maps_have_twins_too(void **state) {
  static const char *const method[] = {"watkins", "zbuffer",
                                       "scanline-zbuffer"};
  (void)state;
  for (const struct scenes_entry *e = scene_list; e->name != NULL; e++) {
    struct scene scene;
    recto_options options;
    pipeline_fill(&scene, &options, e);
    options.solver.pitch_mm = 0.7;
    options.solver.resolution = 150;
    for (size_t m = 0; m < sizeof method / sizeof *method; m++)
      check_scene(&scene, &options, method[m], false);
    scene_fini(&scene);
  }
}

/* A table, and on it two tiles side by side: the hole of the table has four
 * sides, two of which have both tiles beside them. */
static void a_side_is_divided_where_its_neighbours_meet(void **state) {
  static const int table[][3] = {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}};
  static const int left[][3] = {{2, 2, 5}, {3, 2, 5}, {3, 6, 5}, {2, 6, 5}};
  static const int right[][3] = {{3, 2, 5}, {6, 2, 5}, {6, 6, 5}, {3, 6, 5}};
  (void)state;
  for (int m = 0; m < EXACT_COUNT; m++) {
    struct sheet sheet;
    struct map map;
    size_t twins = 0, divided = 0;
    exact_sheet_init(&sheet);
    exact_add_face(&sheet, table, 4, 1024);
    exact_add_face(&sheet, left, 4, 1024);
    exact_add_face(&sheet, right, 4, 1024);
    exact_solve(solver_named(exact_method[m]), &sheet, &map, NULL);
    assert_int_equal(map.fragment.count, 3);
    assert_int_equal(map.corner.count, 16);
    assert_int_equal(map.half_edge.count, 18);
    for (uint32_t h = 0; h < 18; h++) {
      const struct map_half_edge *half = &map.half_edge.item[h];
      twins += half->twin != SHEET_NONE;
      if (half->origin == half->side)
        continue;
      assert_true(origin(&map, h)->x == 3 * 1024);
      assert_int_equal(map.corner.item[half->side].side, MAP_SIDE_OCCLUDER);
      divided++;
    }
    assert_int_equal(divided, 2);
    assert_int_equal(twins, 14);
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_side_is_divided_where_its_neighbours_meet),
      cmocka_unit_test(every_exact_map_is_a_planar_subdivision),
      cmocka_unit_test(random_maps_are_planar_subdivisions),
      cmocka_unit_test(approximate_maps_have_twins_too),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
