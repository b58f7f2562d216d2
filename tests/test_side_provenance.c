/* test_side_provenance.c - each side of a fragment has the right provenance. */
#include "exact_fixture/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { SCALE = 1024 };

static const struct solver *const exact[] = {&solver_brute, &solver_newell};
enum { EXACT_COUNT = sizeof exact / sizeof *exact };

typedef int quad[4][3]; /* a face, times SCALE */

static const quad table = {{0, 0, 8}, {16, 0, 8}, {16, 16, 8}, {0, 16, 8}};
static const quad half = {{8, 0, 20}, {16, 0, 20}, {16, 16, 20}, {8, 16, 20}};
static const quad roof = {{0, 4, 4}, {16, 4, 12}, {16, 12, 12}, {0, 12, 4}};

struct solved {
  struct sheet sheet;
  struct map map;
};

/* A sheet of one or two faces or three, in that order. */
static void add(struct solved *s, const quad *one, const quad *two,
                const quad *three) {
  const quad *const face[] = {one, two, three};
  exact_sheet_init(&s->sheet);
  for (int i = 0; i < 3; i++)
    if (face[i] != NULL)
      exact_add_face(&s->sheet, *face[i], 4, SCALE);
}

static void fini(struct solved *s) {
  map_fini(&s->map);
  exact_sheet_fini(&s->sheet);
}

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

/* What the side of a face is that leaves a corner: that edge. */
struct label {
  uint32_t face;
  double x, y;
  int side;
  int edge[4]; /* x, y of its ends */
};

/* Asserts that an exact method gives two faces these labels. */
static void assert_labels(const quad *one, const quad *two,
                          const struct label *label, size_t count) {
  for (int m = 0; m < EXACT_COUNT; m++) {
    struct solved s;
    add(&s, one, two, NULL);
    exact_solve(exact[m], &s.sheet, &s.map, NULL);
    for (size_t i = 0; i < count; i++) {
      const int *e = label[i].edge;
      assert_label(&s.map, label[i].face, label[i].x, label[i].y, label[i].side,
                   edge_between(&s.sheet, e[0], e[1], e[2], e[3]));
    }
    fini(&s);
  }
}

#define ASSERT_LABELS(one, two, label)                                         \
  assert_labels(&(one), &(two), label, sizeof(label) / sizeof *(label))

/* ---- Edges and outlines -------------------------------------------------- */

static void a_face_s_own_sides_are_its_edges(void **state) {
  (void)state;
  for (int m = 0; m < EXACT_COUNT; m++) {
    struct solved s;
    add(&s, &table, NULL, NULL);
    exact_solve(exact[m], &s.sheet, &s.map, NULL);
    assert_int_equal(s.map.corner.count, 4);
    for (uint32_t k = 0; k < 4; k++) {
      const struct map_corner *corner = &s.map.corner.item[k];
      const uint32_t *end = s.sheet.edge.item[corner->id].point;
      assert_int_equal(corner->side, MAP_SIDE_EDGE);
      assert_true(end[0] == k || end[1] == k);
      assert_true(end[0] == (k + 1) % 4 || end[1] == (k + 1) % 4);
    }
    fini(&s);
  }
}

static void a_nearer_face_s_edge_is_an_outline(void **state) {
  static const quad over = {{8, 4, 20}, {24, 4, 20}, {24, 12, 20}, {8, 12, 20}};
  static const struct label label[] = {
      {0, 16, 4, MAP_SIDE_OCCLUDER, {8, 4, 24, 4}},
      {0, 8, 4, MAP_SIDE_OCCLUDER, {8, 4, 8, 12}},
      {0, 8, 12, MAP_SIDE_OCCLUDER, {8, 12, 24, 12}},
      {0, 16, 12, MAP_SIDE_EDGE, {16, 0, 16, 16}},
      {1, 8, 4, MAP_SIDE_EDGE, {8, 4, 24, 4}}};
  (void)state;
  ASSERT_LABELS(table, over, label);
}

/* A face folded along its diagonal: the plane of its first triangle, far away
 * from it, is nearer than the post that stands before the second. */
static void a_folded_face_is_tested_at_the_side(void **state) {
  static const quad folded = {{0, 0, 8}, {16, 0, 0}, {16, 16, 8}, {0, 16, 8}};
  static const quad post = {{2, 12, 10}, {4, 12, 10}, {4, 16, 10}, {2, 16, 10}};
  static const struct label label[] = {
      {0, 4, 16, MAP_SIDE_OCCLUDER, {4, 12, 4, 16}},
      {0, 4, 12, MAP_SIDE_OCCLUDER, {2, 12, 4, 12}},
      {0, 2, 12, MAP_SIDE_OCCLUDER, {2, 12, 2, 16}}};
  (void)state;
  ASSERT_LABELS(folded, post, label);
}

/* A wall that stands on the floor exactly is nearer beyond its foot alone. */
static void the_foot_of_a_wall_is_an_outline(void **state) {
  static const quad wall = {{8, 4, 8}, {8, 12, 8}, {12, 12, 16}, {12, 4, 16}};
  static const struct label label[] = {
      {0, 8, 4, MAP_SIDE_OCCLUDER, {8, 4, 8, 12}}};
  (void)state;
  ASSERT_LABELS(table, wall, label);
}

/* A face behind that has an edge along the stretch is no outline of it. */
static void an_edge_behind_is_no_outline(void **state) {
  static const quad under = {{2, 2, 2}, {8, 2, 2}, {8, 14, 2}, {2, 14, 2}};
  (void)state;
  for (int m = 0; m < EXACT_COUNT; m++)
    for (int first = 0; first < 2; first++) {
      struct solved s;
      if (first)
        add(&s, &under, &table, &half);
      else
        add(&s, &table, &half, &under);
      exact_solve(exact[m], &s.sheet, &s.map, NULL);
      assert_int_equal(s.map.fragment.count, 2);
      assert_label(&s.map, first ? 1 : 0, 8, 0, MAP_SIDE_OCCLUDER,
                   edge_between(&s.sheet, 8, 16, 8, 0));
      fini(&s);
    }
}

static void of_several_edges_the_lowest_is_named(void **state) {
  static const quad higher = {
      {8, 0, 30}, {16, 0, 30}, {16, 16, 30}, {8, 16, 30}};
  (void)state;
  for (int m = 0; m < EXACT_COUNT; m++) {
    struct solved s;
    add(&s, &table, &higher, &half);
    uint32_t least = edge_between(&s.sheet, 8, 16, 8, 0);
    exact_solve(exact[m], &s.sheet, &s.map, NULL);
    assert_label(&s.map, 0, 8, 0, MAP_SIDE_OCCLUDER, least);
    assert_int_equal(s.sheet.point.item[s.sheet.edge.item[least].point[0]].z,
                     30 * SCALE);
    fini(&s);
  }
}

/* ---- Other sides --------------------------------------------------------- */

static void where_faces_pierce_is_an_intersection(void **state) {
  (void)state;
  for (int m = 0; m < EXACT_COUNT; m++) {
    struct solved s;
    add(&s, &table, &roof, NULL);
    exact_solve(exact[m], &s.sheet, &s.map, NULL);
    exact_assert_area(&s.map, 0, SCALE, 192, 1);
    exact_assert_area(&s.map, 1, SCALE, 64, 1);
    assert_label(&s.map, 0, 8, 4, MAP_SIDE_INTERSECTION, 1);
    assert_label(&s.map, 1, 8, 12, MAP_SIDE_INTERSECTION, 0);
    assert_label(&s.map, 0, 8, 12, MAP_SIDE_OCCLUDER,
                 edge_between(&s.sheet, 16, 12, 0, 12));
    fini(&s);
  }
}

/* A side without an edge is where the paper or the near plane cut. */
static void a_side_without_an_edge_is_a_cut(void **state) {
  (void)state;
  for (int m = 0; m < EXACT_COUNT; m++) {
    struct solved s;
    add(&s, &table, &half, NULL);
    uint32_t gone = edge_between(&s.sheet, 8, 16, 8, 0);
    for (size_t t = 0; t < s.sheet.triangle.count; t++)
      for (int k = 0; k < 3; k++)
        if (s.sheet.sides.item[t].edge[k] == gone)
          s.sheet.sides.item[t].edge[k] = SHEET_NONE;
    exact_solve(exact[m], &s.sheet, &s.map, NULL);
    assert_label(&s.map, 0, 8, 0, MAP_SIDE_CLIP, SHEET_NONE);
    assert_label(&s.map, 1, 8, 16, MAP_SIDE_CLIP, SHEET_NONE);
    assert_label(&s.map, 1, 8, 0, MAP_SIDE_EDGE,
                 edge_between(&s.sheet, 8, 0, 16, 0));
    fini(&s);
  }
}

/* One corner of the roof is off its plane by a unit, as rounding does it: its
 * two triangles cross the table along two lines. */
static void assert_two_planes(const struct solver *solver, bool is_first,
                              uint32_t corner) {
  struct solved s;
  int intersections = 0;
  add(&s, is_first ? &roof : &table, is_first ? &table : &roof, NULL);
  s.sheet.point.item[corner + (is_first ? 0 : 4)].z++;
  exact_solve(solver, &s.sheet, &s.map, NULL);
  for (size_t c = 0; c < s.map.corner.count; c++) {
    assert_int_not_equal(s.map.corner.item[c].side, MAP_SIDE_CLIP);
    intersections += s.map.corner.item[c].side == MAP_SIDE_INTERSECTION;
  }
  assert_true(intersections >= 2);
  fini(&s);
}

static void each_triangle_of_a_face_has_a_plane_of_its_own(void **state) {
  (void)state;
  for (int m = 0; m < EXACT_COUNT; m++)
    for (uint32_t corner = 0; corner < 4; corner++) {
      assert_two_planes(exact[m], false, corner);
      assert_two_planes(exact[m], true, corner);
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
    exact_random_sheet(&sheet, (enum exact_kind)(seed % EXACT_KINDS),
                       3 + exact_random_below(&r, 8), &r);
    exact_solve(&solver_brute, &sheet, &map, NULL);
    for (size_t c = 0; c < map.corner.count; c++)
      if (map.corner.item[c].side == MAP_SIDE_CLIP)
        fail_msg("seed %u: a cut at %g %g", (unsigned)seed,
                 map.corner.item[c].x, map.corner.item[c].y);
    map_fini(&map);
    exact_sheet_fini(&sheet);
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
      cmocka_unit_test(a_folded_face_is_tested_at_the_side),
      cmocka_unit_test(the_foot_of_a_wall_is_an_outline),
      cmocka_unit_test(nothing_is_a_cut_where_nothing_was_cut),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
