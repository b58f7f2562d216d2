/* test_intersection.c - where faces pierce each other, and where they only
 * touch. */
#include "exact_fixture/rational.h"
#include "exact_fixture/scene.h"
#include "visibility/intersection/intersection.h"
#include "visibility/predicate/contact.h"
#include "visibility/predicate/occlusion.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { SCALE = 1024 };

/* Adds the intersections to the sheet; returns how many. */
static size_t pierce(struct sheet *sheet) {
  size_t before = sheet->edge.count;
  struct triangle_grid grid;
  const struct solver_request request = {.intersections = true};
  recto_error error;
  assert_true(triangle_grid_init(&grid, sheet));
  assert_int_equal(
      intersection_find_all(sheet, &grid, NULL, &request, NULL, &error),
      RECTO_OK);
  triangle_grid_fini(&grid);
  for (size_t e = before; e < sheet->edge.count; e++) {
    const struct sheet_edge *edge = &sheet->edge.item[e];
    assert_int_equal(edge->edge_class, RECTO_EDGE_INTERSECTION);
    assert_int_equal(edge->source, SHEET_NONE);
    assert_true(edge->triangle[0] < edge->triangle[1]);
    assert_true(edge->triangle[1] < sheet->triangle.count);
    assert_true(edge->point[0] < sheet->point.count);
    assert_true(edge->point[1] < sheet->point.count);
  }
  return sheet->edge.count - before;
}

static struct geom_point end_of(const struct sheet *sheet, size_t e, int k) {
  return sheet->point.item[sheet->edge.item[e].point[k]];
}

/* Has the sheet an intersection between these places, times SCALE? */
static bool has_line(const struct sheet *sheet, struct geom_point a,
                     struct geom_point b) {
  struct geom_point *both[2] = {&a, &b};
  for (int k = 0; k < 2; k++) {
    both[k]->x *= SCALE;
    both[k]->y *= SCALE;
    both[k]->z *= SCALE;
  }
  for (size_t e = 0; e < sheet->edge.count; e++) {
    struct geom_point p = end_of(sheet, e, 0), q = end_of(sheet, e, 1);
    if (sheet->edge.item[e].edge_class == RECTO_EDGE_INTERSECTION &&
        ((geom_same_point(p, a) && geom_same_point(q, b)) ||
         (geom_same_point(p, b) && geom_same_point(q, a))))
      return true;
  }
  return false;
}

/* ---- Known scenes -------------------------------------------------------- */

static void init_two_triangles(struct sheet *sheet, const int one[][3],
                               const int two[][3]) {
  exact_sheet_init(sheet);
  exact_add_face(sheet, one, 3, SCALE);
  exact_add_face(sheet, two, 3, SCALE);
}

static const int table[][3] = {{0, 0, 8}, {16, 0, 8}, {0, 16, 8}};

static bool is_near(struct geom_point a, struct geom_point b) {
  return abs(a.x - b.x) < SCALE / 8 && abs(a.y - b.y) < SCALE / 8 &&
         llabs(a.z - b.z) < SCALE / 8;
}

/* Whether a segment, which may be estimated, begins or ends about the place
 * that `user` points to. */
static bool is_at(const void *user, struct geom_point p, struct geom_point q,
                  double xy, double z) {
  const struct geom_point *place = user;
  assert_true(xy < SCALE / 8 && z < SCALE / 8);
  return is_near(*place, p) || is_near(*place, q);
}

/* A table that two sheets cross. */
static void what_is_hidden_is_no_edge(void **state) {
  static const int first[][3] = {{2, 4, 4}, {8, 4, 4}, {6, 8, 12}};
  static const int second[][3] = {{2, 5, 4}, {8, 5, 4}, {6, 9, 12}};
  const struct geom_point place = {4 * SCALE, 6 * SCALE, 8 * SCALE};
  const struct hidden_segments hidden = {is_at, &place};
  const struct solver_request request = {.intersections = true};
  recto_error error;
  (void)state;
  for (int some = 0; some <= 1; some++) {
    struct sheet sheet;
    struct triangle_grid grid;
    init_two_triangles(&sheet, table, first);
    exact_add_face(&sheet, second, 3, SCALE);
    assert_true(triangle_grid_init(&grid, &sheet));
    assert_int_equal(intersection_find_visible(&sheet, &grid, NULL,
                                               some ? &hidden : NULL, &request,
                                               NULL, &error),
                     RECTO_OK);
    assert_int_equal(has_line(&sheet, (struct geom_point){4, 6, 8},
                              (struct geom_point){7, 6, 8}),
                     !some);
    assert_true(has_line(&sheet, (struct geom_point){4, 7, 8},
                         (struct geom_point){7, 7, 8}));
    triangle_grid_fini(&grid);
    exact_sheet_fini(&sheet);
  }
}

static void crossed_sheets_have_a_line(void **state) {
  static const int across[][3] = {{2, 2, 4}, {2, 2, 12}, {6, 6, 8}};
  static const int steep[][3] = {{2, 4, 4}, {8, 4, 4}, {6, 8, 12}};
  struct sheet sheet;
  (void)state;
  init_two_triangles(&sheet, table, steep);
  assert_int_equal(pierce(&sheet), 1);
  assert_true(has_line(&sheet, (struct geom_point){4, 6, 8},
                       (struct geom_point){7, 6, 8}));
  exact_sheet_fini(&sheet);
  /* One seen edge-on pierces too. */
  init_two_triangles(&sheet, across, table);
  assert_int_equal(sheet.triangle_flags[0], SHEET_EDGE_ON);
  assert_int_equal(pierce(&sheet), 1);
  assert_true(has_line(&sheet, (struct geom_point){2, 2, 8},
                       (struct geom_point){6, 6, 8}));
  exact_sheet_fini(&sheet);
}

/* A line along the line of sight is a point on the page. */
static void two_faces_seen_edge_on_have_no_line(void **state) {
  static const int one[][3] = {{0, 4, 0}, {8, 4, 0}, {4, 4, 8}};
  static const int two[][3] = {{4, 0, 0}, {4, 8, 0}, {4, 4, 8}};
  static const int three[][3] = {{4, 0, 4}, {4, 8, 1}, {4, 4, 9}};
  struct sheet sheet;
  (void)state;
  init_two_triangles(&sheet, one, two);
  exact_add_face(&sheet, three, 3, SCALE);
  assert_int_equal(pierce(&sheet), 0);
  exact_sheet_fini(&sheet);
}

/* The six faces of a box, with `base` as its lowest depth. */
static void add_box(struct sheet *sheet, int base) {
  enum { L = 4, R = 12, B = 4, T = 12 };
  const int low = base, high = base + 8 * SCALE;
  const int k = SCALE;
  const int face[6][4][3] = {{{L * k, B * k, low},
                              {R * k, B * k, low},
                              {R * k, T * k, low},
                              {L * k, T * k, low}},
                             {{L * k, B * k, high},
                              {R * k, B * k, high},
                              {R * k, T * k, high},
                              {L * k, T * k, high}},
                             {{L * k, B * k, low},
                              {R * k, B * k, low},
                              {R * k, B * k, high},
                              {L * k, B * k, high}},
                             {{L * k, T * k, low},
                              {R * k, T * k, low},
                              {R * k, T * k, high},
                              {L * k, T * k, high}},
                             {{L * k, B * k, low},
                              {L * k, T * k, low},
                              {L * k, T * k, high},
                              {L * k, B * k, high}},
                             {{R * k, B * k, low},
                              {R * k, T * k, low},
                              {R * k, T * k, high},
                              {R * k, B * k, high}}};
  for (int f = 0; f < 6; f++)
    exact_add_face(sheet, face[f], 4, 1);
}

/* Tilts the sheet, so that nothing is edge-on and the table has a slope. */
static void tilt(struct sheet *sheet) {
  for (size_t i = 0; i < sheet->point.count; i++) {
    struct geom_point *p = &sheet->point.item[i];
    int64_t z = p->z;
    p->z += p->x / 4 + p->y / 8;
    p->x -= (int32_t)(z / 4);
    p->y += (int32_t)(z / 2);
  }
  for (size_t t = 0; t < sheet->triangle.count; t++) {
    struct sheet_triangle *at = &sheet->triangle.item[t];
    const struct geom_point *p = sheet->point.item;
    int64_t area =
        geom_orient2d(p[at->point[0]], p[at->point[1]], p[at->point[2]]);
    sheet->triangle_flags[t] = area == 0 ? SHEET_EDGE_ON : 0;
    if (area < 0) {
      uint32_t swap = at->point[1];
      at->point[1] = at->point[2];
      at->point[2] = swap;
      uint32_t *side = sheet->sides.item[t].edge;
      swap = side[0];
      side[0] = side[2];
      side[2] = swap;
    }
  }
}

static void a_box_on_a_table_makes_no_line(void **state) {
  static const int top[][3] = {{0, 0, 8}, {16, 0, 8}, {16, 16, 8}, {0, 16, 8}};
  (void)state;
  for (int tilted = 0; tilted < 2; tilted++)
    for (int off = -1; off <= 1; off++) { /* rounded up, right or down */
      struct sheet sheet;
      exact_sheet_init(&sheet);
      exact_add_face(&sheet, top, 4, SCALE);
      add_box(&sheet, 8 * SCALE + off);
      if (tilted)
        tilt(&sheet);
      assert_int_equal(pierce(&sheet), 0);
      exact_sheet_fini(&sheet);
    }
}

static void a_box_that_sinks_in_makes_a_line_all_round(void **state) {
  static const int top[][3] = {{0, 0, 8}, {16, 0, 8}, {16, 16, 8}, {0, 16, 8}};
  struct sheet sheet;
  double length = 0;
  (void)state;
  exact_sheet_init(&sheet);
  exact_add_face(&sheet, top, 4, SCALE);
  add_box(&sheet, 4 * SCALE);
  assert_true(pierce(&sheet) >= 4);
  for (size_t e = 0; e < sheet.edge.count; e++) {
    struct geom_point p = end_of(&sheet, e, 0), q = end_of(&sheet, e, 1);
    if (sheet.edge.item[e].edge_class != RECTO_EDGE_INTERSECTION)
      continue;
    assert_true(p.z == 8 * SCALE && q.z == 8 * SCALE);
    assert_true(p.x == q.x || p.y == q.y);
    length += abs(p.x - q.x) + abs(p.y - q.y);
  }
  assert_true(length == 4 * 8 * SCALE); /* nothing twice */
  exact_sheet_fini(&sheet);
}

/* The same with contact allowed for: less than that is touching. */
static void contact_says_how_deep_touching_is(void **state) {
  static const int top[][3] = {{0, 0, 8}, {16, 0, 8}, {16, 16, 8}, {0, 16, 8}};
  (void)state;
  for (int depth = 90; depth <= 110; depth++) {
    struct sheet sheet;
    exact_sheet_init(&sheet);
    sheet.camera.contact = sheet.camera.contact_most = 100;
    exact_add_face(&sheet, top, 4, SCALE);
    add_box(&sheet, 8 * SCALE - depth);
    /* T is contact and one unit of depth. */
    assert_int_equal(pierce(&sheet) > 0, depth > 101);
    exact_sheet_fini(&sheet);
  }
}

static void a_shared_edge_is_no_intersection(void **state) {
  static const int one[][3] = {{4, 0, 4}, {4, 8, 9}, {0, 4, 7}};
  static const int two[][3] = {{4, 0, 4}, {4, 8, 9}, {8, 4, 1}};
  struct sheet sheet;
  (void)state;
  init_two_triangles(&sheet, one, two);
  assert_int_equal(pierce(&sheet), 0);
  exact_sheet_fini(&sheet);
}

static void a_shared_vertex_alone_is_no_intersection(void **state) {
  static const int one[][3] = {{8, 8, 8}, {2, 2, 8}, {2, 14, 8}};
  static const int two[][3] = {{8, 8, 8}, {14, 2, 2}, {14, 14, 14}};
  struct sheet sheet;
  (void)state;
  init_two_triangles(&sheet, one, two);
  assert_int_equal(pierce(&sheet), 0);
  exact_sheet_fini(&sheet);
}

static void from_a_shared_vertex_the_line_runs_inwards(void **state) {
  static const int one[][3] = {{0, 8, 8}, {16, 0, 8}, {16, 16, 8}};
  static const int two[][3] = {{0, 8, 8}, {16, 8, 16}, {16, 8, 0}};
  struct sheet sheet;
  (void)state;
  init_two_triangles(&sheet, one, two);
  assert_int_equal(pierce(&sheet), 1);
  assert_true(has_line(&sheet, (struct geom_point){0, 8, 8},
                       (struct geom_point){16, 8, 8}));
  assert_true(sheet.edge.item[sheet.edge.count - 1].point[0] !=
              sheet.edge.item[sheet.edge.count - 1].point[1]);
  exact_sheet_fini(&sheet);
}

/* A roof of two faces goes through the table: the two lines meet in one point
 * of the sheet, on the ridge, though it lies between the grid's points. */
static void neighbours_get_the_same_end(void **state) {
  uint64_t r = 1;
  int met = 0;
  (void)state;
  for (int i = 0; i < 500; i++) {
    const int ridge[2][3] = {
        {100 + exact_random_below(&r, 100), 500 + exact_random_below(&r, 100),
         exact_random_below(&r, 450)},
        {500 + exact_random_below(&r, 100), 500 + exact_random_below(&r, 100),
         550 + exact_random_below(&r, 450)}};
    const int wide[][3] = {
        {-3000, -3000, 500}, {9000, -3000, 500}, {-3000, 9000, 500}};
    int face[2][3][3];
    struct sheet sheet;
    size_t first;
    exact_sheet_init(&sheet);
    exact_add_face(&sheet, wide, 3, 1);
    for (int f = 0; f < 2; f++) {
      for (int k = 0; k < 2; k++)
        for (int c = 0; c < 3; c++)
          face[f][k][c] = ridge[f == 0 ? k : 1 - k][c];
      face[f][2][0] = 300 + exact_random_below(&r, 100);
      face[f][2][1] = f == 0 ? exact_random_below(&r, 300)
                             : 800 + exact_random_below(&r, 200);
      face[f][2][2] = exact_random_below(&r, 450);
      exact_add_face(&sheet, (const int(*)[3])face[f], 3, 1);
    }
    first = sheet.edge.count;
    if (pierce(&sheet) == 2) {
      const uint32_t *p = sheet.edge.item[first].point,
                     *q = sheet.edge.item[first + 1].point;
      assert_true(p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1]);
      assert_int_equal(sheet.point.count, 7 + 3);
      met++;
    }
    exact_sheet_fini(&sheet);
  }
  assert_true(met > 400);
}

/* ---- Pairs, in rationals ------------------------------------------------- */

/* floor(v + 1/2) */
static int64_t round_half_up(const mpq_t v) {
  mpq_t half;
  mpz_t rounded;
  int64_t result;
  mpq_init(half);
  mpz_init(rounded);
  mpq_set_si(half, 1, 2);
  mpq_add(half, half, v);
  mpz_fdiv_q(rounded, mpq_numref(half), mpq_denref(half));
  result = mpz_get_si(rounded);
  mpq_clear(half);
  mpz_clear(rounded);
  return result;
}

/* A point of space: x, y, z. */
struct point3 {
  mpq_t at[3];
};

static void plane_value(mpq_t to, const struct geom_point f[3],
                        struct geom_point p) {
  struct geom_plane plane = geom_plane_of(f[0], f[1], f[2]);
  rational_set_int128(mpq_numref(to), geom_plane_value(&plane, p));
  mpz_set_ui(mpq_denref(to), 1);
}

/* Where the sides of f go through g's plane: two places, the first before the
 * second; false: it is not on both sides of the plane. */
static bool cut_by_plane(const struct geom_point f[3],
                         const struct geom_point g[3], struct point3 end[2]) {
  int found = 0;
  mpq_t v[2], t;
  struct point3 at;
  mpq_inits(v[0], v[1], t, at.at[0], at.at[1], at.at[2], NULL);
  for (int k = 0; k < 3; k++) {
    struct geom_point a = f[k], b = f[(k + 1) % 3];
    const int64_t from[3] = {a.x, a.y, a.z}, to[3] = {b.x, b.y, b.z};
    int order = 0;
    plane_value(v[0], g, a);
    plane_value(v[1], g, b);
    if (mpq_sgn(v[0]) * mpq_sgn(v[1]) > 0 || mpq_equal(v[0], v[1]))
      continue;
    mpq_sub(t, v[0], v[1]);
    mpq_div(t, v[0], t);
    for (int c = 0; c < 3; c++) {
      mpq_set_si(at.at[c], to[c] - from[c], 1);
      mpq_mul(at.at[c], at.at[c], t);
      mpq_set_si(v[1], from[c], 1);
      mpq_add(at.at[c], at.at[c], v[1]);
    }
    for (int c = 0; c < 3 && order == 0 && found > 0; c++)
      order = mpq_cmp(at.at[c], end[0].at[c]);
    if (found == 0 || order != 0) {
      for (int c = 0; c < 3; c++) {
        if (found == 1)
          mpq_set(end[1].at[c], at.at[c]);
        if (found == 1 && order < 0)
          mpq_swap(end[0].at[c], end[1].at[c]);
        if (found == 0)
          mpq_set(end[0].at[c], at.at[c]);
      }
      found++;
    }
  }
  mpq_clears(v[0], v[1], t, at.at[0], at.at[1], at.at[2], NULL);
  return found >= 2;
}

static int compare_points(const struct point3 *p, const struct point3 *q) {
  int order = 0;
  for (int c = 0; c < 3 && order == 0; c++)
    order = mpq_cmp(p->at[c], q->at[c]);
  return order;
}

static struct geom_point rounded(const struct point3 *p) {
  return (struct geom_point){(int32_t)round_half_up(p->at[0]),
                             (int32_t)round_half_up(p->at[1]),
                             round_half_up(p->at[2])};
}

/* The segment that two triangles have in common, rounded; false: none that
 * has length on the page. */
static bool common_segment(const struct geom_point f[3],
                           const struct geom_point g[3],
                           struct geom_point end[2]) {
  struct point3 pf[2], pg[2];
  bool found = false;
  for (int k = 0; k < 2; k++)
    for (int c = 0; c < 3; c++)
      mpq_inits(pf[k].at[c], pg[k].at[c], NULL);
  if (cut_by_plane(f, g, pf) && cut_by_plane(g, f, pg)) {
    const struct point3 *low = compare_points(&pf[0], &pg[0]) > 0 ? pf : pg,
                        *high = compare_points(&pf[1], &pg[1]) < 0 ? &pf[1]
                                                                   : &pg[1];
    if (compare_points(low, high) < 0) {
      end[0] = rounded(low);
      end[1] = rounded(high);
      found = end[0].x != end[1].x || end[0].y != end[1].y;
    }
  }
  for (int k = 0; k < 2; k++)
    for (int c = 0; c < 3; c++)
      mpq_clears(pf[k].at[c], pg[k].at[c], NULL);
  return found;
}

/* Has f corners on both sides of g's plane, beyond contact? */
static bool straddles(const struct sheet *sheet, const struct geom_point f[3],
                      uint32_t g) {
  struct occluder occluder;
  bool behind = false, before = false;
  occluder_init(&occluder, sheet, g);
  for (int k = 0; k < 3; k++) {
    behind |= occluder_side(&occluder, f[k]) < 0;
    before |= occluder_side(&occluder, f[k]) > 0;
  }
  return behind && before;
}

/* The largest distance of side a-b of one triangle from the plane of the other,
 * within the other's projection, as a share of what rounding may do.
 * units  of the grid */
static long double side_share(double units, struct geom_point a,
                              struct geom_point b,
                              const struct geom_point g[3]) {
  struct geom_plane plane = geom_plane_of(g[0], g[1], g[2]);
  long double va = (long double)geom_plane_value(&plane, a),
              vb = (long double)geom_plane_value(&plane, b), low = 0, high = 1;
  for (int k = 0; k < 3; k++) {
    long double at_a = geom_orient2d(g[k], g[(k + 1) % 3], a),
                at_b = geom_orient2d(g[k], g[(k + 1) % 3], b);
    if (at_a < 0 && at_b < 0)
      return 0;
    if (at_a < 0)
      low = fmaxl(low, at_a / (at_a - at_b));
    if (at_b < 0)
      high = fminl(high, at_a / (at_a - at_b));
  }
  if (low > high - 1e-12L)
    return 0;
  return fmaxl(fabsl(va + low * (vb - va)), fabsl(va + high * (vb - va))) /
         (units * (fabsl((long double)plane.nx) + fabsl((long double)plane.ny) +
                   (long double)plane.nz));
}

/* The same of all sides of both. */
static long double overlap_share(double units, struct geom_point p[2][3]) {
  long double most = 0;
  for (int f = 0; f < 2; f++)
    for (int k = 0; k < 3; k++)
      most =
          fmaxl(most, side_share(units, p[f][k], p[f][(k + 1) % 3], p[1 - f]));
  return most;
}

static void check_pair(struct sheet *sheet, int *pierced, int *within) {
  struct geom_point p[2][3], end[2], a, b;
  int shared = 0;
  bool want;
  for (int f = 0; f < 2; f++)
    for (int k = 0; k < 3; k++)
      p[f][k] = sheet->point.item[sheet->triangle.item[f].point[k]];
  for (int k = 0; k < 9; k++)
    shared += geom_same_point(p[0][k / 3], p[1][k % 3]);
  want = shared < 2 && straddles(sheet, p[0], 1) && straddles(sheet, p[1], 0) &&
         common_segment(p[0], p[1], end);
  if (want && !((sheet->triangle_flags[0] | sheet->triangle_flags[1]) &
                SHEET_EDGE_ON)) {
    long double share = overlap_share(contact_grid_units(sheet), p);
    if (fabsl(share - 1) < 1e-9L)
      return;
    want = share > 1;
    *within += !want;
  }
  assert_int_equal(pierce(sheet), want);
  if (!want)
    return;
  a = end_of(sheet, sheet->edge.count - 1, 0);
  b = end_of(sheet, sheet->edge.count - 1, 1);
  assert_true((geom_same_point(a, end[0]) && geom_same_point(b, end[1])) ||
              (geom_same_point(a, end[1]) && geom_same_point(b, end[0])));
  ++*pierced;
}

static void pairs_pierce_where_rationals_say(void **state) {
  int pierced = 0, within = 0;
  (void)state;
  for (uint64_t seed = 1; seed <= 100000; seed++) {
    uint64_t r = seed;
    struct sheet sheet;
    exact_random_sheet(&sheet, (enum exact_kind)(seed % EXACT_KINDS), 2, &r);
    if (sheet.triangle.count == 2)
      check_pair(&sheet, &pierced, &within);
    exact_sheet_fini(&sheet);
  }
  assert_true(pierced > 5000 && within > 50);
}

/* ---- Surfaces that meet along an edge ------------------------------------ */

/* Eight ways from an upright line of the page, in order round it. */
static const int way[8][2] = {{7, 2},   {4, 7},   {-2, 7}, {-7, 4},
                              {-7, -2}, {-4, -7}, {2, -7}, {7, -4}};

/* A triangle on the line's part between two heights, `off` units of depth and
 * of x beside it. */
static void add_fan_triangle(struct sheet *sheet, const int to[2], int low,
                             int high, const int off[2]) {
  const int k = SCALE, x = 16 * k + off[0], z = 16 * k + off[1];
  const int corner[3][3] = {
      {x, low * k, z}, {x, high * k, z}, {x + to[0] * k, 8 * k, z + to[1] * k}};
  exact_add_face(sheet, corner, 3, 1);
}

/* Do b's ways stand on both sides of a's, and on neither of them? */
static bool are_between(const int a[2], const int b[2]) {
  int low = a[0] < a[1] ? a[0] : a[1], high = a[0] < a[1] ? a[1] : a[0];
  for (int k = 0; k < 2; k++)
    if (b[k] == low || b[k] == high)
      return false;
  return (low < b[0] && b[0] < high) != (low < b[1] && b[1] < high);
}

static void assert_upright(const struct sheet *sheet, int low, int high) {
  struct geom_point p = end_of(sheet, sheet->edge.count - 1, 0),
                    q = end_of(sheet, sheet->edge.count - 1, 1);
  assert_in_range(p.x, 16 * SCALE - 1, 16 * SCALE + 1);
  assert_in_range(q.x, 16 * SCALE - 1, 16 * SCALE + 1);
  assert_int_equal(p.y < q.y ? p.y : q.y, low * SCALE);
  assert_int_equal(p.y < q.y ? q.y : p.y, high * SCALE);
}

/* Two folded sheets, edge on edge, each of any two ways: they cross where the
 * ways alternate, and touch otherwise. */
static void check_folds(const int off[2], int *crossed) {
  static const int none[2] = {0, 0};
  for (int i = 0; i < 8 * 8 * 8 * 8; i++) {
    const int a[2] = {i % 8, i / 8 % 8}, b[2] = {i / 64 % 8, i / 512};
    struct sheet sheet;
    size_t lines;
    if (a[0] >= a[1] || b[0] == b[1])
      continue;
    exact_sheet_init(&sheet);
    for (int k = 0; k < 2; k++)
      add_fan_triangle(&sheet, way[a[k]], 2, 12, none);
    for (int k = 0; k < 2; k++)
      add_fan_triangle(&sheet, way[b[k]], 14, 6, off);
    lines = pierce(&sheet);
    if (lines != are_between(a, b))
      fail_msg("%zu lines: %d %d and %d %d, off by %d %d", lines, a[0], a[1],
               b[0], b[1], off[0], off[1]);
    if (lines == 1)
      assert_upright(&sheet, 6, 12);
    *crossed += lines == 1;
    exact_sheet_fini(&sheet);
  }
}

static void folds_cross_where_their_ways_alternate(void **state) {
  int crossed = 0;
  (void)state;
  for (int i = 0; i < 9; i++) {
    const int off[2] = {i % 3 - 1, i / 3 - 1};
    check_folds(off, &crossed);
  }
  assert_int_equal(crossed, 9 * 2 * 2 * 70);
}

/* A fold with its edge on a face, or off it by a unit of depth. */
static void a_fold_goes_through_a_face_it_lies_on(void **state) {
  static const int face[][3] = {
      {2, 0, 16}, {30, 0, 16}, {30, 16, 16}, {2, 16, 16}};
  (void)state;
  for (int i = 0; i < 3 * 64; i++) {
    const int off[2] = {0, i / 64 - 1}, a[2] = {i % 8, i / 8 % 8};
    bool through = a[0] / 4 != a[1] / 4 && way[a[0]][1] * way[a[1]][1] < 0;
    struct sheet sheet;
    exact_sheet_init(&sheet);
    exact_add_face(&sheet, face, 4, SCALE);
    for (int k = 0; k < 2; k++)
      add_fan_triangle(&sheet, way[a[k]], 2, 12, off);
    assert_int_equal(pierce(&sheet) > 0, through);
    exact_sheet_fini(&sheet);
  }
}

/* An edge that is all but upright may lean to one side, and the one that lies
 * on it to the other. */
static void edges_that_lean_apart_by_a_unit_are_joined(void **state) {
  static const int none[2] = {0, 0};
  (void)state;
  for (int lean = -1; lean <= 1; lean++) {
    struct sheet sheet;
    exact_sheet_init(&sheet);
    add_fan_triangle(&sheet, way[0], 2, 12, none);
    add_fan_triangle(&sheet, way[4], 2, 12, none);
    add_fan_triangle(&sheet, way[2], 6, 14, none);
    add_fan_triangle(&sheet, way[6], 6, 14, none);
    sheet.point.item[1].x += lean;
    assert_int_equal(pierce(&sheet), 1);
    assert_upright(&sheet, 6, 12);
    exact_sheet_fini(&sheet);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(crossed_sheets_have_a_line),
      cmocka_unit_test(what_is_hidden_is_no_edge),
      cmocka_unit_test(two_faces_seen_edge_on_have_no_line),
      cmocka_unit_test(a_box_on_a_table_makes_no_line),
      cmocka_unit_test(a_box_that_sinks_in_makes_a_line_all_round),
      cmocka_unit_test(contact_says_how_deep_touching_is),
      cmocka_unit_test(a_shared_edge_is_no_intersection),
      cmocka_unit_test(a_shared_vertex_alone_is_no_intersection),
      cmocka_unit_test(from_a_shared_vertex_the_line_runs_inwards),
      cmocka_unit_test(neighbours_get_the_same_end),
      cmocka_unit_test(folds_cross_where_their_ways_alternate),
      cmocka_unit_test(a_fold_goes_through_a_face_it_lies_on),
      cmocka_unit_test(edges_that_lean_apart_by_a_unit_are_joined),
      cmocka_unit_test(pairs_pierce_where_rationals_say),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
