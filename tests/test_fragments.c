/* test_fragments.c - visible fragments tile the page, and their sides have the
 * right provenance. */
#include "exact_fixture/oracle.h"
#include "exact_fixture/scene.h"
#include "tests/scenes/solver_named.h"
#include "visibility/fragments/fragments.h"
#include "visibility/fragments/occluder_subtraction.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

enum { SCALE = 1024 };

static const struct solver *const exact[] = {&solver_brute, &solver_newell};
enum { EXACT_COUNT = sizeof exact / sizeof *exact };

/* ---- Areas against the oracle -------------------------------------------- */

static mpq_t *new_areas(size_t count) {
  mpq_t *area2 = malloc((count + 1) * sizeof *area2);
  assert_non_null(area2);
  for (size_t k = 0; k < count; k++)
    mpq_init(area2[k]);
  return area2;
}

static void free_areas(mpq_t *area2, size_t count) {
  for (size_t k = 0; k < count; k++)
    mpq_clear(area2[k]);
  free(area2);
}

static void check_areas(struct sheet *sheet, const char *what) {
  size_t faces = sheet->triangle.count; /* at most */
  mpq_t *want = new_areas(faces), covered;
  mpq_init(covered);
  oracle_areas(sheet, true, want, covered);
  for (int s = 0; s < EXACT_COUNT; s++) {
    struct exact_area *got = calloc(faces + 1, sizeof *got), sum = {0};
    struct map map;
    assert_non_null(got);
    exact_solve(exact[s], sheet, &map, NULL);
    for (size_t f = 0; f < map.fragment.count; f++) {
      exact_add_area(&got[map.fragment.item[f].face], &map, f);
      exact_add_area(&sum, &map, f);
    }
    for (size_t f = 0; f < faces; f++)
      if (!exact_is_area(got[f], want[f]))
        fail_msg("%s, %s: face %zu has area %g, not %g", what,
                 solver_name(exact[s]), f, got[f].twice / 2,
                 mpq_get_d(want[f]) / 2);
    if (!exact_is_area(sum, covered))
      fail_msg("%s, %s: the areas do not add up", what, solver_name(exact[s]));
    map_fini(&map);
    free(got);
  }
  mpq_clear(covered);
  free_areas(want, faces);
}

static void areas_are_those_of_the_oracle(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 30; seed++)
    for (int kind = 0; kind < EXACT_KINDS; kind++) {
      uint64_t r = seed * EXACT_KINDS + (uint64_t)kind;
      struct sheet sheet;
      char what[64];
      int faces = 2 + exact_random_below(&r, 3);
      snprintf(what, sizeof what, "kind %d, seed %u", kind, (unsigned)seed);
      exact_random_sheet(&sheet, (enum exact_kind)kind, faces, &r);
      check_areas(&sheet, what);
      exact_sheet_fini(&sheet);
    }
}

/* ---- The form ------------------------------------------------------------ */

/* Twice the area of a loop as its rounded corners have it, and how much
 * rounding them by 1/512 may have changed it. */
static double loop_area2(const struct map *map, const struct map_loop *loop,
                         double *error) {
  const struct map_corner *c = &map->corner.item[loop->corner];
  double sum = 0;
  for (uint32_t k = 0; k < loop->count; k++) {
    const struct map_corner *p = &c[k], *q = &c[(k + 1) % loop->count];
    sum += (p->x - c->x) * (q->y - c->y) - (q->x - c->x) * (p->y - c->y);
    *error += (fabs(q->x - p->x) + fabs(q->y - p->y) + 1) / 128;
  }
  return sum;
}

static void check_form(const struct map *map) {
  uint32_t loop = 0, corner = 0;
  for (size_t f = 0; f < map->fragment.count; f++) {
    const struct map_fragment *fragment = &map->fragment.item[f];
    double sum = 0, error = 0;
    assert_true(f == 0 || fragment[-1].face <= fragment->face);
    assert_int_equal(fragment->loop, loop);
    assert_true(fragment->loops >= 1);
    for (uint32_t l = 0; l < fragment->loops; l++) {
      const struct map_loop *at = &map->loop.item[loop++];
      const struct map_corner *c = &map->corner.item[at->corner];
      double area2 = loop_area2(map, at, &error);
      assert_int_equal(at->corner, corner);
      corner += at->count;
      assert_true(at->count >= 3);
      assert_true(l == 0 ? area2 > -error : area2 < error);
      /* The lowest before it was rounded: in y, another may come below. */
      for (uint32_t k = 1; k < at->count; k++)
        assert_true(c->x <= c[k].x);
      sum += area2;
    }
    assert_true(sum > -error);
  }
  assert_int_equal(loop, map->loop.count);
  assert_int_equal(corner, map->corner.count);
}

static void loops_are_in_their_one_form(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 300; seed++) {
    uint64_t r = seed;
    enum exact_kind kind = (enum exact_kind)(seed % EXACT_EXTREME);
    struct sheet sheet;
    struct map map;
    exact_random_sheet(&sheet, kind, 3 + exact_random_below(&r, 8), &r);
    exact_solve(&solver_brute, &sheet, &map, NULL);
    check_form(&map);
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

/* ---- Any division into pieces -------------------------------------------- */

/* Hands in what is visible of each triangle, split by `cuts` random lines. */
static void solve_in_pieces(const struct sheet *sheet, int cuts, uint64_t *r,
                            struct map *map) {
  struct fragments fragments;
  struct triangle_grid grid;
  struct occluder_subtraction subtraction;
  uint32_t n = (uint32_t)sheet->triangle.count;
  int points = (int)sheet->point.count;
  map_init(map);
  assert_true(triangle_grid_init(&grid, sheet));
  assert_true(fragments_init(&fragments, sheet, &grid, true));
  occluder_subtraction_init(&subtraction, sheet);
  for (uint32_t f = n; f-- > 0;) {
    if (sheet_is_edge_on(sheet, f))
      continue;
    assert_true(occluder_subtraction_start(&subtraction, f, NULL));
    for (uint32_t g = 0; g < n; g++)
      if (g != f && !sheet_is_edge_on(sheet, g))
        assert_true(occluder_subtraction_subtract_nearer(&subtraction, g));
    for (int k = 0; k < cuts; k++) {
      struct geom_point p = sheet->point.item[exact_random_below(r, points)],
                        q = sheet->point.item[exact_random_below(r, points)];
      struct geom_line *line = arena_alloc(&subtraction.arena, 2, sizeof *line);
      size_t count = subtraction.left.count;
      assert_non_null(line);
      if (p.x == q.x && p.y == q.y)
        continue;
      geom_line_through(&line[0], p, q);
      geom_line_through(&line[1], q, p);
      for (size_t i = 0; i < count; i++) {
        struct geom_convex left, right;
        assert_true(geom_convex_split(&subtraction.left.item[i], &line[0],
                                      &line[1], &left, &right,
                                      &subtraction.arena));
        subtraction.left.item[i] = left.count > 0 ? left : right;
        if (left.count > 0 && right.count > 0)
          assert_true(ARRAY_PUSH(&subtraction.left, right));
      }
    }
    assert_true(fragments_add(&fragments, f, subtraction.left.item,
                              subtraction.left.count));
  }
  assert_true(fragments_finish(&fragments, map));
  occluder_subtraction_fini(&subtraction);
  fragments_fini(&fragments);
  triangle_grid_fini(&grid);
}

static void assert_same_fragments(const struct map *a, const struct map *b) {
  assert_int_equal(a->fragment.count, b->fragment.count);
  assert_int_equal(a->loop.count, b->loop.count);
  assert_int_equal(a->corner.count, b->corner.count);
  for (size_t c = 0; c < a->corner.count; c++) {
    const struct map_corner *p = &a->corner.item[c], *q = &b->corner.item[c];
    assert_true(p->x == q->x && p->y == q->y);
    assert_int_equal(p->side, q->side);
    assert_int_equal(p->id, q->id);
  }
}

static void how_pieces_were_cut_does_not_show(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 150; seed++) {
    uint64_t r = seed;
    enum exact_kind kind = (enum exact_kind)(seed % EXACT_KINDS);
    struct sheet sheet;
    struct map map, again;
    exact_random_sheet(&sheet, kind, 2 + exact_random_below(&r, 5), &r);
    if (sheet.triangle.count > 0) {
      solve_in_pieces(&sheet, 0, &r, &map);
      solve_in_pieces(&sheet, 1 + exact_random_below(&r, 4), &r, &again);
      assert_same_fragments(&map, &again);
      map_fini(&map);
      map_fini(&again);
    }
    exact_sheet_fini(&sheet);
  }
}

/* ---- Contact ------------------------------------------------------------- */

static const int table[][3] = {{0, 0, 8}, {16, 0, 8}, {16, 16, 8}, {0, 16, 8}};
static const int decal[][3] = {{4, 4, 8}, {12, 4, 8}, {12, 12, 8}, {4, 12, 8}};

/* The table and the decal, whose corners are `off` depth units nearer; all
 * tilted, so that the plane's normal is no axis. */
static void table_and_decal(struct sheet *sheet, bool table_first, int off,
                            double contact) {
  exact_sheet_init(sheet);
  sheet->camera.contact = sheet->camera.contact_most = contact;
  exact_add_face(sheet, table_first ? table : decal, 4, SCALE);
  exact_add_face(sheet, table_first ? decal : table, 4, SCALE);
  for (size_t k = 0; k < 4; k++)
    sheet->point.item[(table_first ? 4 : 0) + k].z += off;
  for (size_t k = 0; k < sheet->point.count; k++)
    sheet->point.item[k].z += sheet->point.item[k].x / 2;
}

static void a_decal_off_by_rounding_goes_to_the_earlier_face(void **state) {
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++)
    for (int off = -1; off <= 1; off++) {
      struct sheet sheet;
      struct map map;
      table_and_decal(&sheet, true, off, 0);
      exact_solve(exact[s], &sheet, &map, NULL);
      exact_assert_area(&map, 0, SCALE, 256, 1);
      assert_int_equal(map.fragment.count, 1);
      assert_int_equal(map.corner.count, 4);
      map_fini(&map);
      exact_sheet_fini(&sheet);
      table_and_decal(&sheet, false, off, 0);
      exact_solve(exact[s], &sheet, &map, NULL);
      exact_assert_area(&map, 0, SCALE, 64, 1);
      exact_assert_area(&map, 1, SCALE, 192, 1);
      assert_int_equal(map.fragment.count, 2);
      assert_int_equal(map.fragment.item[1].loops, 2);
      for (uint32_t k = 8; k < 12; k++) { /* the hole is the decal's outline */
        assert_int_equal(map.corner.item[k].side, MAP_SIDE_OCCLUDER);
        assert_in_range(map.corner.item[k].id, 0, 3);
      }
      map_fini(&map);
      exact_sheet_fini(&sheet);
    }
}

/* What the tolerance is, to the unit: for the table's plane, z = x/2 + 8, a
 * depth of 1 unit is explained by z and half of one by x; contact moves the
 * plane along its normal (1/2, 0, 1), of length sqrt(5)/2. */
static void contact_ends_where_its_definition_says(void **state) {
  static const struct {
    double contact;
    int off;
    bool touches;
  } row[] = {{0, 1, true},      {0, 2, false},      {100, 113, true},
             {100, 114, false}, {1000, 1119, true}, {1000, 1120, false}};
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++)
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
      struct sheet sheet;
      struct map map;
      table_and_decal(&sheet, true, row[k].off, row[k].contact);
      exact_solve(exact[s], &sheet, &map, NULL);
      exact_assert_area(&map, 1, SCALE, row[k].touches ? 0 : 64, 1);
      map_fini(&map);
      exact_sheet_fini(&sheet);
      table_and_decal(&sheet, false, -row[k].off, row[k].contact);
      exact_solve(exact[s], &sheet, &map, NULL);
      exact_assert_area(&map, 0, SCALE, row[k].touches ? 64 : 0, 1);
      map_fini(&map);
      exact_sheet_fini(&sheet);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(areas_are_those_of_the_oracle),
      cmocka_unit_test(loops_are_in_their_one_form),
      cmocka_unit_test(how_pieces_were_cut_does_not_show),
      cmocka_unit_test(a_decal_off_by_rounding_goes_to_the_earlier_face),
      cmocka_unit_test(contact_ends_where_its_definition_says),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
