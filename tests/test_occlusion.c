/* test_occlusion.c - what a triangle hides of an edge. */
#include "exact_fixture/oracle.h"
#include "exact_fixture/scene.h"
#include "visibility/predicate/occlusion.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

#define XY_MAX ((1 << 30) - 1)
#define Z_MAX ((INT64_C(1) << 40) - 1)

/* A sheet of one triangle, and it prepared. */
static struct occluder one_triangle(struct sheet *sheet,
                                    const int corner[3][3]) {
  struct occluder occluder;
  exact_sheet_init(sheet);
  exact_add_face(sheet, corner, 3, 1);
  occluder_init(&occluder, sheet, 0);
  return occluder;
}

static const int right_angle[3][3] = {
    {0, 0, 1000}, {1000, 0, 1000}, {0, 1000, 1000}};

static bool is_ratio(struct ratio t, int64_t num, int64_t den) {
  return ratio_compare(t, ratio_of(num, den)) == 0;
}

/* ---- The outline --------------------------------------------------------- */

static void an_edge_is_hidden_between_the_sides_it_crosses(void **state) {
  struct occlusion_counts counts = {0};
  struct occluded_interval part;
  struct sheet sheet;
  struct occluder occluder = one_triangle(&sheet, right_angle);
  (void)state;
  assert_true(occlude_edge(&occluder, (struct geom_point){-500, 250, 0},
                           (struct geom_point){1500, 250, 0}, &part, &counts));
  assert_true(is_ratio(part.from, 500, 2000));
  assert_true(is_ratio(part.to, 1250, 2000));
  assert_int_equal(part.sides, OCCLUDED_BOTH);
  assert_true(occlude_edge(&occluder, (struct geom_point){200, 200, 0},
                           (struct geom_point){300, 300, 0}, &part, &counts));
  assert_true(is_ratio(part.from, 0, 1) && is_ratio(part.to, 1, 1));
  assert_int_equal(counts.pairs, 2);
  assert_int_equal(counts.depth_tests, 2);
  exact_sheet_fini(&sheet);
}

/* What meets the outline in points alone is not hidden, however near. */
static void touching_the_outline_hides_nothing(void **state) {
  static const struct geom_point edge[][2] = {
      {{-5, 5, 0}, {5, -5, 0}},       /* through a corner, outside */
      {{-5, 500, 0}, {0, 500, 0}},    /* ends on a side */
      {{0, 500, 0}, {-5, 700, 0}},    /* begins on it */
      {{1000, 0, 0}, {2000, 0, 0}},   /* on a side's line, beyond it */
      {{0, 1000, 0}, {-5, 1005, 0}},  /* begins on a corner */
      {{600, 600, 0}, {900, 900, 0}}, /* beside it */
      {{500, 500, 0}, {900, 900, 0}}};
  struct occlusion_counts counts = {0};
  struct occluded_interval part;
  struct sheet sheet;
  struct occluder occluder = one_triangle(&sheet, right_angle);
  (void)state;
  for (size_t k = 0; k < sizeof edge / sizeof *edge; k++) {
    assert_false(
        occlude_edge(&occluder, edge[k][0], edge[k][1], &part, &counts));
    assert_false(
        occlude_edge(&occluder, edge[k][1], edge[k][0], &part, &counts));
    assert_false(
        occlude_by_projection(occluder.p, edge[k][0], edge[k][1], &part));
  }
  exact_sheet_fini(&sheet);
}

static void an_edge_through_a_vertex_is_hidden_behind_it(void **state) {
  struct occlusion_counts counts = {0};
  struct occluded_interval part;
  struct sheet sheet;
  struct occluder occluder = one_triangle(&sheet, right_angle);
  (void)state;
  /* Through the right angle and the middle of the long side. */
  assert_true(occlude_edge(&occluder, (struct geom_point){-1000, -1000, 0},
                           (struct geom_point){1000, 1000, 0}, &part, &counts));
  assert_true(is_ratio(part.from, 1, 2) && is_ratio(part.to, 3, 4));
  assert_int_equal(part.sides, OCCLUDED_BOTH);
  exact_sheet_fini(&sheet);
}

static void along_a_side_only_one_side_is_covered(void **state) {
  struct occlusion_counts counts = {0};
  struct occluded_interval part;
  struct sheet sheet;
  struct occluder occluder = one_triangle(&sheet, right_angle);
  const struct geom_point p = {-1000, 0, 0}, q = {3000, 0, 0};
  (void)state;
  assert_true(occlude_edge(&occluder, p, q, &part, &counts));
  assert_true(is_ratio(part.from, 1, 4) && is_ratio(part.to, 1, 2));
  assert_int_equal(part.sides, OCCLUDED_LEFT);
  assert_true(occlude_edge(&occluder, q, p, &part, &counts));
  assert_true(is_ratio(part.from, 1, 2) && is_ratio(part.to, 3, 4));
  assert_int_equal(part.sides, OCCLUDED_RIGHT);
  exact_sheet_fini(&sheet);
}

/* The products of clip_to_outline at their largest. */
static void outlines_at_the_ends_of_the_range_do_not_overflow(void **state) {
  static const int corner[3][3] = {
      {-XY_MAX, -XY_MAX, 9}, {XY_MAX, XY_MAX, 9}, {-XY_MAX, XY_MAX, 9}};
  const struct geom_point p = {XY_MAX, -XY_MAX, 0}, q = {-XY_MAX, XY_MAX, 0};
  const struct geom_point a = {-XY_MAX, -XY_MAX, 0}, b = {XY_MAX, XY_MAX, 0};
  struct occlusion_counts counts = {0};
  struct occluded_interval part;
  struct sheet sheet;
  struct occluder occluder = one_triangle(&sheet, corner);
  (void)state;
  assert_true(occlude_edge(&occluder, p, q, &part, &counts));
  assert_true(is_ratio(part.from, 1, 2) && is_ratio(part.to, 1, 1));
  assert_true(occlude_edge(&occluder, a, b, &part, &counts));
  assert_true(is_ratio(part.from, 0, 1) && is_ratio(part.to, 1, 1));
  assert_int_equal(part.sides, OCCLUDED_LEFT);
  exact_sheet_fini(&sheet);
}

/* ---- Contact ------------------------------------------------------------- */

/* A flat triangle's T is nz alone: one unit of depth. */
static void one_unit_of_depth_is_contact_and_two_are_not(void **state) {
  struct occlusion_counts counts = {0};
  struct occluded_interval part;
  struct sheet sheet;
  struct occluder occluder = one_triangle(&sheet, right_angle);
  (void)state;
  for (int64_t z = 997; z <= 1003; z++) {
    const struct geom_point p = {100, 100, z}, q = {300, 200, z};
    assert_int_equal(occlude_edge(&occluder, p, q, &part, &counts), z < 999);
    assert_int_equal(occluder_side(&occluder, p), z < 999 ? -1 : z > 1001);
    assert_true((occluder_value(&occluder, p) < 0) == (z < 999));
  }
  exact_sheet_fini(&sheet);
}

/* A tilted one's also has a unit of x and of y: z = 1000 + 2 x - 3 y. */
static void a_unit_of_x_and_y_is_contact_too(void **state) {
  static const int corner[3][3] = {
      {0, 0, 10000}, {1000, 0, 12000}, {0, 1000, 7000}};
  struct sheet sheet;
  struct occluder occluder = one_triangle(&sheet, corner);
  (void)state;
  for (int off = -9; off <= 9; off++) {
    const struct geom_point p = {100, 200, 10000 + 200 - 600 + off};
    assert_int_equal(occluder_side(&occluder, p), off < -6 ? -1 : off > 6);
  }
  exact_sheet_fini(&sheet);
}

static void an_edge_that_dives_is_hidden_beyond_the_tolerance(void **state) {
  struct occlusion_counts counts = {0};
  struct occluded_interval part;
  struct sheet sheet;
  struct occluder occluder = one_triangle(&sheet, right_angle);
  const struct geom_point p = {100, 100, 1099}, q = {300, 100, 899};
  (void)state;
  assert_true(occlude_edge(&occluder, p, q, &part, &counts));
  assert_true(is_ratio(part.from, 1, 2) && is_ratio(part.to, 1, 1));
  assert_true(occlude_edge(&occluder, q, p, &part, &counts));
  assert_true(is_ratio(part.from, 0, 1) && is_ratio(part.to, 1, 2));
  assert_int_equal(counts.crossings, 2);
  exact_sheet_fini(&sheet);
}

/* From a corner shared, hidden from its very start or not at all: as it is
 * where it ends, or leaves the triangle at a quarter of its length. */
static void an_edge_from_a_shared_corner_is_tested_once(void **state) {
  struct occlusion_counts counts = {0};
  struct occluded_interval part;
  struct sheet sheet;
  struct occluder occluder = one_triangle(&sheet, right_angle);
  const struct geom_point corner = {0, 0, 1000};
  (void)state;
  for (int far = 0; far < 2; far++) {
    int size = far ? 2000 : 200, steps = far ? 4 : 1;
    for (int64_t z = 985; z <= 1005; z++) {
      const struct geom_point q = {size, size, z};
      bool hidden = occlude_edge(&occluder, corner, q, &part, &counts);
      assert_int_equal(hidden, 1000 - z > steps);
      if (hidden)
        assert_true(is_ratio(part.from, 0, 1) &&
                    is_ratio(part.to, 1, (uint64_t)steps));
      assert_int_equal(occlude_edge(&occluder, q, corner, &part, &counts),
                       hidden);
      if (hidden)
        assert_true(
            is_ratio(part.from, (uint64_t)(steps - 1), (uint64_t)steps) &&
            is_ratio(part.to, 1, 1));
    }
  }
  /* The same place at another depth is not the corner. */
  assert_true(occlude_edge(&occluder, (struct geom_point){0, 0, 1001},
                           (struct geom_point){200, 200, 901}, &part, &counts));
  assert_true(is_ratio(part.from, 2, 100));
  assert_int_equal(counts.crossings, 1);
  exact_sheet_fini(&sheet);
}

static void a_triangle_does_not_hide_its_own_sides(void **state) {
  uint64_t r = 1;
  (void)state;
  for (int i = 0; i < 2000; i++) {
    struct occlusion_counts counts = {0};
    struct sheet sheet;
    enum exact_kind kind = (enum exact_kind)(i % EXACT_KINDS);
    exact_random_sheet(&sheet, kind, 1, &r);
    if (sheet.triangle.count == 1 && !sheet_is_edge_on(&sheet, 0)) {
      struct occluder occluder;
      occluder_init(&occluder, &sheet, 0);
      for (int k = 0; k < 3; k++) {
        struct occluded_interval part;
        assert_false(occlude_edge(&occluder, occluder.p[k],
                                  occluder.p[(k + 1) % 3], &part, &counts));
        assert_int_equal(occluder_side(&occluder, occluder.p[k]), 0);
      }
    }
    exact_sheet_fini(&sheet);
  }
}

/* The second triangle of the face lies over an edge of the first: as it does
 * where rounding turned a sliver.  It hides the edge unless the face is planar,
 * or both are what clipping left of one triangle. */
static void a_planar_part_does_not_hide_its_own_edges(void **state) {
  enum { FIRST = SHEET_PIECE | SHEET_FIRST_PIECE };
  static const struct {
    uint8_t flags[2];
    int state;
  } cases[] = {{{0, 0}, MAP_HIDDEN},
               {{SHEET_COPLANAR, SHEET_COPLANAR}, MAP_VISIBLE},
               {{FIRST, SHEET_PIECE}, MAP_VISIBLE},
               {{FIRST, FIRST}, MAP_HIDDEN},
               {{0, FIRST}, MAP_HIDDEN},
               {{SHEET_PIECE, 0}, MAP_HIDDEN}};
  static const int corner[][3] = {
      {0, 0, 0}, {1000, 0, 0}, {1000, 1000, 0}, {1000, -500, 1000000}};
  (void)state;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    struct sheet sheet;
    struct map map;
    exact_sheet_init(&sheet);
    exact_add_face(&sheet, corner, 4, 1);
    assert_int_equal(sheet.triangle.count, 2);
    for (int t = 0; t < 2; t++)
      sheet.triangle_flags[t] |= cases[i].flags[t];
    exact_solve(&solver_brute, &sheet, &map, NULL);
    assert_int_equal(map.edge_state[0], cases[i].state);
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

/* ---- Contact in scene units ---------------------------------------------- */

/* A camera of our own: what it does to a point of view space. */
struct view {
  bool perspective;
  double s, z_scale, d_max, ax, ay; /* grid units */
};

static struct geom_point project(const struct view *v, const double p[3]) {
  double d = p[2], m = v->perspective ? 1 / d : 1;
  double z = v->perspective ? 1 / d - 1 / v->d_max : v->d_max - d;
  return (struct geom_point){(int32_t)llround(v->ax + v->s * p[0] * m),
                             (int32_t)llround(v->ay + v->s * p[1] * m),
                             llround(v->z_scale * z)};
}

static double uniform(uint64_t *r, double least, double most) {
  return least + (most - least) * ((double)(exact_random(r) >> 11) * 0x1p-53);
}

/* The unit normal of a triangle in view space (x right, y up, d away), towards
 * the eye at the origin or, in parallel, to smaller d. */
static void normal_of(const struct view *v, double p[3][3], double n[3]) {
  double u[3], w[3], length, facing;
  for (int i = 0; i < 3; i++) {
    u[i] = p[1][i] - p[0][i];
    w[i] = p[2][i] - p[0][i];
  }
  for (int i = 0; i < 3; i++)
    n[i] = u[(i + 1) % 3] * w[(i + 2) % 3] - u[(i + 2) % 3] * w[(i + 1) % 3];
  facing = v->perspective ? -(n[0] * p[0][0] + n[1] * p[0][1] + n[2] * p[0][2])
                          : -n[2];
  length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (int i = 0; i < 3; i++)
    n[i] /= facing < 0 ? -length : length;
}

/* A triangle in view space that is not seen nearly edge-on. */
static bool draw_triangle(const struct view *v, double p[3][3],
                          struct sheet *sheet, uint64_t *r) {
  int64_t area;
  exact_sheet_fini(sheet);
  exact_sheet_init(sheet);
  for (int k = 0; k < 3; k++) {
    int corner[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (int i = 0; i < 2; i++)
      p[k][i] = uniform(r, -2, 2);
    p[k][2] = uniform(r, 4, 9);
    if (k == 0)
      exact_add_face(sheet, (const int(*)[3])corner, 3, 1);
  }
  for (int k = 0; k < 3; k++)
    sheet->point.item[k] = project(v, p[k]);
  area = geom_orient2d(sheet->point.item[0], sheet->point.item[1],
                       sheet->point.item[2]);
  if (area < 0) {
    sheet->triangle.item[0].point[1] = 2;
    sheet->triangle.item[0].point[2] = 1;
  }
  return (double)(area < 0 ? -area : area) > 0.05 * v->s * v->s / 25;
}

/* The plane moved back by `contact` in view space hides what the predicate
 * says, but for a fiftieth of contact: the grid is far finer than that. */
static void check_contact(const struct view *v, double contact, uint64_t *r) {
  struct sheet sheet;
  double p[3][3], n[3], share[3], at[3];
  struct occluder occluder;
  exact_sheet_init(&sheet);
  while (!draw_triangle(v, p, &sheet, r)) {
  }
  sheet.camera.perspective = v->perspective;
  sheet.camera.d_max = v->d_max;
  sheet.camera.contact = sheet.camera.contact_most = contact;
  sheet.camera.middle_mm[0] =
      sheet.camera.page_mm[0] / 2 + v->ax / SHEET_UNITS_PER_MM;
  sheet.camera.middle_mm[1] =
      sheet.camera.page_mm[1] / 2 + v->ay / SHEET_UNITS_PER_MM;
  sheet.z_scale = v->z_scale;
  sheet.units_per_view = v->s;
  occluder_init(&occluder, &sheet, 0);
  normal_of(v, p, n);
  for (int i = 0; i < 20; i++) {
    double behind = uniform(r, -1.2, 2.2), sum;
    if (fabs(fabs(behind) - 1) < 0.02)
      continue;
    for (int k = 0; k < 3; k++)
      share[k] = uniform(r, 0, 1);
    sum = share[0] + share[1] + share[2];
    for (int k = 0; k < 3; k++)
      at[k] =
          (share[0] * p[0][k] + share[1] * p[1][k] + share[2] * p[2][k]) / sum -
          n[k] * behind * contact;
    assert_int_equal(occluder_side(&occluder, project(v, at)),
                     behind > 1 ? -1 : behind < -1);
  }
  exact_sheet_fini(&sheet);
}

static void contact_is_a_length_of_the_scene(void **state) {
  uint64_t r = 2;
  (void)state;
  for (int i = 0; i < 4000; i++) {
    struct view v = {i % 2,
                     i % 2 ? 0x1p29 : 0x1p27,
                     i % 2 ? 0x1p41 : 0x1p36,
                     uniform(&r, 9.1, 12),
                     uniform(&r, -0x1p26, 0x1p26),
                     uniform(&r, -0x1p26, 0x1p26)};
    check_contact(&v, uniform(&r, 1e-4, 1e-2), &r);
  }
}

/* ---- Against the oracle -------------------------------------------------- */

static void check_edge(const struct sheet *sheet, const struct map *map,
                       uint32_t e, const mpq_t t, const char *what) {
  bool hidden = oracle_is_hidden(sheet, e, t);
  if (hidden == oracle_is_drawn(map, e, t))
    fail_msg("%s: edge %u is %s at %g", what, e, hidden ? "hidden" : "visible",
             mpq_get_d(t));
}

/* About the middle, where nothing changes by chance. */
static void set_between(mpq_t to, struct ratio a, struct ratio b) {
  mpq_t end;
  mpq_init(end);
  rational_set_ratio(to, a);
  rational_set_ratio(end, b);
  mpq_sub(end, end, to);
  mpz_mul_ui(mpq_numref(end), mpq_numref(end), 49999);
  mpz_mul_ui(mpq_denref(end), mpq_denref(end), 99991);
  mpq_canonicalize(end);
  mpq_add(to, to, end);
  mpq_clear(end);
}

/* Samples in and between all of the edge's intervals, and at random. */
static void check_samples(const struct sheet *sheet, const struct map *map,
                          uint64_t *r, const char *what) {
  mpq_t t;
  mpq_init(t);
  for (size_t m = 0; m < map->mixed.count; m++) {
    const struct map_mixed *mixed = &map->mixed.item[m];
    const struct map_interval *v = &map->interval.item[mixed->interval];
    for (uint32_t k = 0; k < mixed->count; k++) {
      set_between(t, v[k].t0, v[k].t1);
      check_edge(sheet, map, mixed->edge, t, what);
      if (k + 1 == mixed->count)
        continue;
      set_between(t, v[k].t1, v[k + 1].t0);
      check_edge(sheet, map, mixed->edge, t, what);
    }
  }
  for (uint32_t e = 0; e < sheet->edge.count; e++) {
    const struct geom_point
        *p = &sheet->point.item[sheet->edge.item[e].point[0]],
        *q = &sheet->point.item[sheet->edge.item[e].point[1]];
    if (p->x == q->x && p->y == q->y)
      continue;
    for (int k = 0; k < 4; k++) {
      mpq_set_si(t, 1 + exact_random_below(r, 99990), 99991);
      check_edge(sheet, map, e, t, what);
    }
  }
  mpq_clear(t);
}

static void intervals_are_those_of_the_oracle(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 600; seed++) {
    uint64_t r = seed;
    struct sheet sheet;
    struct map map;
    char what[64];
    snprintf(what, sizeof what, "seed %u", (unsigned)seed);
    exact_random_sheet(&sheet, (enum exact_kind)(seed % EXACT_KINDS),
                       2 + exact_random_below(&r, 8), &r);
    exact_solve(&solver_brute, &sheet, &map, NULL);
    check_samples(&sheet, &map, &r, what);
    map_fini(&map);
    exact_sheet_fini(&sheet);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(an_edge_is_hidden_between_the_sides_it_crosses),
      cmocka_unit_test(touching_the_outline_hides_nothing),
      cmocka_unit_test(an_edge_through_a_vertex_is_hidden_behind_it),
      cmocka_unit_test(along_a_side_only_one_side_is_covered),
      cmocka_unit_test(outlines_at_the_ends_of_the_range_do_not_overflow),
      cmocka_unit_test(one_unit_of_depth_is_contact_and_two_are_not),
      cmocka_unit_test(a_unit_of_x_and_y_is_contact_too),
      cmocka_unit_test(an_edge_that_dives_is_hidden_beyond_the_tolerance),
      cmocka_unit_test(an_edge_from_a_shared_corner_is_tested_once),
      cmocka_unit_test(a_triangle_does_not_hide_its_own_sides),
      cmocka_unit_test(a_planar_part_does_not_hide_its_own_edges),
      cmocka_unit_test(contact_is_a_length_of_the_scene),
      cmocka_unit_test(intervals_are_those_of_the_oracle),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
