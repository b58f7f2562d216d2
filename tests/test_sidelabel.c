/* test_sidelabel.c - each side of a fragment says what it is. */
#include "hand/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { SCALE = 1024 };

static const struct solver *const exact[] = {&solver_brute, &solver_newell};
enum { EXACT_COUNT = sizeof exact / sizeof *exact };

static const int table[][3] = {{0, 0, 8}, {16, 0, 8}, {16, 16, 8}, {0, 16, 8}};

/* Asserts the label of the side that leaves corner (x, y) of a face. */
static void assert_label(const struct map *map, uint32_t face, double x,
                         double y, int side, uint32_t id) {
  bool found = false;
  for (size_t f = 0; f < map->fragment.count; f++) {
    const struct map_fragment *fragment = &map->fragment.item[f];
    for (uint32_t l = 0; l < fragment->loops; l++) {
      const struct map_loop *loop = &map->loop.item[fragment->loop + l];
      for (uint32_t k = 0; k < loop->count && fragment->face == face; k++) {
        const struct map_corner *c = &map->corner.item[loop->corner + k];
        if (c->x != x * SCALE || c->y != y * SCALE)
          continue;
        found = true;
        assert_int_equal(c->side, side);
        assert_int_equal(c->id, id);
      }
    }
  }
  if (!found)
    fail_msg("face %u has no corner %g %g", face, x, y);
}

static void a_face_s_own_sides_are_its_edges(void **state) {
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++) {
    struct sheet sheet;
    struct map map;
    hand_sheet_init(&sheet);
    hand_add_face(&sheet, table, 4, SCALE);
    hand_solve(exact[s], &sheet, &map, NULL);
    assert_int_equal(map.corner.count, 4);
    for (uint32_t k = 0; k < 4; k++) {
      uint32_t id = map.corner.item[k].id;
      assert_int_equal(map.corner.item[k].side, MAP_SIDE_EDGE);
      assert_true(sheet.edge.item[id].point[0] == k ||
                  sheet.edge.item[id].point[1] == k);
      assert_true(sheet.edge.item[id].point[0] == (k + 1) % 4 ||
                  sheet.edge.item[id].point[1] == (k + 1) % 4);
    }
    map_fini(&map);
    hand_sheet_fini(&sheet);
  }
}

/* The edge between two points of the sheet, given times SCALE. */
static uint32_t edge_between(const struct sheet *sheet, int x0, int y0, int x1,
                             int y1) {
  for (size_t e = 0; e < sheet->edge.count; e++) {
    const struct geom_point
        *p = &sheet->point.item[sheet->edge.item[e].point[0]],
        *q = &sheet->point.item[sheet->edge.item[e].point[1]];
    if ((p->x == x0 * SCALE && p->y == y0 * SCALE && q->x == x1 * SCALE &&
         q->y == y1 * SCALE) ||
        (q->x == x0 * SCALE && q->y == y0 * SCALE && p->x == x1 * SCALE &&
         p->y == y1 * SCALE))
      return (uint32_t)e;
  }
  fail();
  return 0;
}

static void a_nearer_face_s_edge_is_an_outline(void **state) {
  static const int over[][3] = {
      {8, 4, 20}, {24, 4, 20}, {24, 12, 20}, {8, 12, 20}};
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++) {
    struct sheet sheet;
    struct map map;
    hand_sheet_init(&sheet);
    hand_add_face(&sheet, table, 4, SCALE);
    hand_add_face(&sheet, over, 4, SCALE);
    hand_solve(exact[s], &sheet, &map, NULL);
    assert_label(&map, 0, 16, 4, MAP_SIDE_OUTLINE,
                 edge_between(&sheet, 8, 4, 24, 4));
    assert_label(&map, 0, 8, 4, MAP_SIDE_OUTLINE,
                 edge_between(&sheet, 8, 4, 8, 12));
    assert_label(&map, 0, 8, 12, MAP_SIDE_OUTLINE,
                 edge_between(&sheet, 8, 12, 24, 12));
    assert_label(&map, 0, 16, 12, MAP_SIDE_EDGE,
                 edge_between(&sheet, 16, 0, 16, 16));
    assert_label(&map, 1, 8, 4, MAP_SIDE_EDGE,
                 edge_between(&sheet, 8, 4, 24, 4));
    map_fini(&map);
    hand_sheet_fini(&sheet);
  }
}

/* A face behind that has an edge along the stretch is no outline of it. */
static void an_edge_behind_is_no_outline(void **state) {
  static const int over[][3] = {
      {8, 0, 20}, {16, 0, 20}, {16, 16, 20}, {8, 16, 20}};
  static const int under[][3] = {{2, 2, 2}, {8, 2, 2}, {8, 14, 2}, {2, 14, 2}};
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++)
    for (int order = 0; order < 2; order++) {
      struct sheet sheet;
      struct map map;
      hand_sheet_init(&sheet);
      if (order == 0)
        hand_add_face(&sheet, under, 4, SCALE);
      hand_add_face(&sheet, table, 4, SCALE);
      hand_add_face(&sheet, over, 4, SCALE);
      if (order == 1)
        hand_add_face(&sheet, under, 4, SCALE);
      hand_solve(exact[s], &sheet, &map, NULL);
      assert_int_equal(map.fragment.count, 2);
      assert_label(&map, order == 0 ? 1 : 0, 8, 0, MAP_SIDE_OUTLINE,
                   edge_between(&sheet, 8, 16, 8, 0));
      map_fini(&map);
      hand_sheet_fini(&sheet);
    }
}

static void of_several_edges_the_lowest_is_named(void **state) {
  static const int one[][3] = {
      {8, 0, 20}, {16, 0, 20}, {16, 16, 20}, {8, 16, 20}};
  static const int two[][3] = {
      {8, 0, 30}, {16, 0, 30}, {16, 16, 30}, {8, 16, 30}};
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++) {
    struct sheet sheet;
    struct map map;
    uint32_t least = SHEET_NONE;
    hand_sheet_init(&sheet);
    hand_add_face(&sheet, table, 4, SCALE);
    hand_add_face(&sheet, two, 4, SCALE);
    hand_add_face(&sheet, one, 4, SCALE);
    least = edge_between(&sheet, 8, 16, 8, 0);
    hand_solve(exact[s], &sheet, &map, NULL);
    assert_label(&map, 0, 8, 0, MAP_SIDE_OUTLINE, least);
    assert_int_equal(sheet.point.item[sheet.edge.item[least].point[0]].z,
                     30 * SCALE);
    map_fini(&map);
    hand_sheet_fini(&sheet);
  }
}

static void where_faces_pierce_is_an_intersection(void **state) {
  static const int roof[][3] = {
      {0, 4, 4}, {16, 4, 12}, {16, 12, 12}, {0, 12, 4}};
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++) {
    struct sheet sheet;
    struct map map;
    hand_sheet_init(&sheet);
    hand_add_face(&sheet, table, 4, SCALE);
    hand_add_face(&sheet, roof, 4, SCALE);
    hand_solve(exact[s], &sheet, &map, NULL);
    hand_assert_area(&map, 0, SCALE, 192, 1);
    hand_assert_area(&map, 1, SCALE, 64, 1);
    assert_label(&map, 0, 8, 4, MAP_SIDE_INTERSECTION, 1);
    assert_label(&map, 1, 8, 12, MAP_SIDE_INTERSECTION, 0);
    assert_label(&map, 0, 8, 12, MAP_SIDE_OUTLINE,
                 edge_between(&sheet, 16, 12, 0, 12));
    map_fini(&map);
    hand_sheet_fini(&sheet);
  }
}

/* A side without an edge is where the paper or the near plane cut. */
static void a_side_without_an_edge_is_a_cut(void **state) {
  static const int over[][3] = {
      {8, 0, 20}, {16, 0, 20}, {16, 16, 20}, {8, 16, 20}};
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++) {
    struct sheet sheet;
    struct map map;
    uint32_t gone;
    hand_sheet_init(&sheet);
    hand_add_face(&sheet, table, 4, SCALE);
    hand_add_face(&sheet, over, 4, SCALE);
    gone = edge_between(&sheet, 8, 16, 8, 0);
    for (size_t t = 0; t < sheet.triangle.count; t++)
      for (int k = 0; k < 3; k++)
        if (sheet.triangle.item[t].side[k] == gone)
          sheet.triangle.item[t].side[k] = SHEET_NONE;
    hand_solve(exact[s], &sheet, &map, NULL);
    assert_label(&map, 0, 8, 0, MAP_SIDE_CUT, SHEET_NONE);
    assert_label(&map, 1, 8, 16, MAP_SIDE_CUT, SHEET_NONE);
    assert_label(&map, 1, 8, 0, MAP_SIDE_EDGE,
                 edge_between(&sheet, 8, 0, 16, 0));
    map_fini(&map);
    hand_sheet_fini(&sheet);
  }
}

/* One corner of the face is off its plane by a unit, as rounding does it: its
 * two triangles cross the other face along two lines. */
static void each_triangle_of_a_face_has_a_plane_of_its_own(void **state) {
  static const int roof[][3] = {
      {0, 4, 4}, {16, 4, 12}, {16, 12, 12}, {0, 12, 4}};
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++)
    for (int first = 0; first < 2; first++)
      for (uint32_t corner = 0; corner < 4; corner++) {
        struct sheet sheet;
        struct map map;
        int intersections = 0;
        hand_sheet_init(&sheet);
        if (first == 0)
          hand_add_face(&sheet, table, 4, SCALE);
        hand_add_face(&sheet, roof, 4, SCALE);
        if (first == 1)
          hand_add_face(&sheet, table, 4, SCALE);
        sheet.point.item[corner + (first == 0 ? 4 : 0)].z++;
        hand_solve(exact[s], &sheet, &map, NULL);
        for (size_t c = 0; c < map.corner.count; c++) {
          assert_int_not_equal(map.corner.item[c].side, MAP_SIDE_CUT);
          intersections += map.corner.item[c].side == MAP_SIDE_INTERSECTION;
        }
        assert_true(intersections >= 2);
        map_fini(&map);
        hand_sheet_fini(&sheet);
      }
}

/* A face folded along its diagonal: the plane of its first triangle, far away
 * from it, is nearer than the post that stands before the second. */
static void a_folded_face_is_asked_where_the_side_is(void **state) {
  static const int folded[][3] = {
      {0, 0, 8}, {16, 0, 0}, {16, 16, 8}, {0, 16, 8}};
  static const int post[][3] = {
      {2, 12, 10}, {4, 12, 10}, {4, 16, 10}, {2, 16, 10}};
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++) {
    struct sheet sheet;
    struct map map;
    hand_sheet_init(&sheet);
    hand_add_face(&sheet, folded, 4, SCALE);
    hand_add_face(&sheet, post, 4, SCALE);
    hand_solve(exact[s], &sheet, &map, NULL);
    assert_label(&map, 0, 4, 16, MAP_SIDE_OUTLINE,
                 edge_between(&sheet, 4, 12, 4, 16));
    assert_label(&map, 0, 4, 12, MAP_SIDE_OUTLINE,
                 edge_between(&sheet, 2, 12, 4, 12));
    assert_label(&map, 0, 2, 12, MAP_SIDE_OUTLINE,
                 edge_between(&sheet, 2, 12, 2, 16));
    map_fini(&map);
    hand_sheet_fini(&sheet);
  }
}

/* A wall that stands on the floor exactly is nearer beyond its foot alone. */
static void the_foot_of_a_wall_is_an_outline(void **state) {
  static const int wall[][3] = {
      {8, 4, 8}, {8, 12, 8}, {12, 12, 16}, {12, 4, 16}};
  (void)state;
  for (int s = 0; s < EXACT_COUNT; s++) {
    struct sheet sheet;
    struct map map;
    hand_sheet_init(&sheet);
    hand_add_face(&sheet, table, 4, SCALE);
    hand_add_face(&sheet, wall, 4, SCALE);
    hand_solve(exact[s], &sheet, &map, NULL);
    assert_label(&map, 0, 8, 4, MAP_SIDE_OUTLINE,
                 edge_between(&sheet, 8, 4, 8, 12));
    map_fini(&map);
    hand_sheet_fini(&sheet);
  }
}

/* Every side of every triangle has an edge, so nothing is a cut: whatever ends
 * a fragment has a name. */
static void nothing_is_a_cut_where_nothing_was_cut(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 1200; seed++) {
    uint64_t r = seed;
    struct sheet sheet;
    struct map map;
    hand_random_sheet(&sheet, (enum hand_kind)(seed % HAND_KINDS),
                      3 + hand_below(&r, 8), &r);
    hand_solve(&solver_brute, &sheet, &map, NULL);
    for (size_t c = 0; c < map.corner.count; c++)
      if (map.corner.item[c].side == MAP_SIDE_CUT)
        fail_msg("seed %u: a cut at %g %g", (unsigned)seed,
                 map.corner.item[c].x, map.corner.item[c].y);
    map_fini(&map);
    hand_sheet_fini(&sheet);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_face_s_own_sides_are_its_edges),
      cmocka_unit_test(a_nearer_face_s_edge_is_an_outline),
      cmocka_unit_test(an_edge_behind_is_no_outline),
      cmocka_unit_test(of_several_edges_the_lowest_is_named),
      cmocka_unit_test(where_faces_pierce_is_an_intersection),
      cmocka_unit_test(a_side_without_an_edge_is_a_cut),
      cmocka_unit_test(each_triangle_of_a_face_has_a_plane_of_its_own),
      cmocka_unit_test(a_folded_face_is_asked_where_the_side_is),
      cmocka_unit_test(the_foot_of_a_wall_is_an_outline),
      cmocka_unit_test(nothing_is_a_cut_where_nothing_was_cut),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
